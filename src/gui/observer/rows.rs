//! The matrix `R`, which the observer's state completes: chosen by the order, or given.
#![expect(non_snake_case, reason = "R is the letter of the papers")]

use egui::{RichText, Ui};
use nalgebra::DMatrix;

use super::super::entry_grid::{EntryGrid, Typed, show as grid};
use super::super::matrix_grid::cell_text;
use super::super::{Output, Widgets, formula};
use crate::document::{Entry, PlantData, Sizes};
use crate::observer::{Design, Method};
use crate::session::{Derived, Edit, Field, LmiEdit, Session};

/// Draws the choice and, where `R` is given, one grid for each subsystem.
pub(super) fn show(
    ui: &mut Ui,
    session: &Session,
    derived: &Derived,
    widgets: &mut Widgets,
    out: &mut Output,
) {
    let rows = &session.document().design.lmi.rows;
    ui.horizontal_wrapped(|ui| {
        let hint = "The observer's state follows what the rows of R pick, beside what outputs and algebraic equations tell.";
        ui.label(RichText::new("R").strong()).on_hover_text(hint);
        if ui.selectable_label(rows.is_empty(), "Chosen by the order").clicked() && !rows.is_empty() {
            out.edit(Edit::Lmi(LmiEdit::Rows(Vec::new())));
        }
        let given = ui.selectable_label(!rows.is_empty(), "Given").on_hover_text("Edit R entry by entry");
        if given.clicked() && rows.is_empty() {
            out.edit(Edit::Lmi(LmiEdit::Rows(start(session, derived))));
        }
    });
    for (subsystem, R) in rows.iter().enumerate() {
        one(ui, session, subsystem, R, widgets, out);
    }
}

/// Names of what has an `R` each, with the states that it picks from.
fn owners(session: &Session) -> Vec<(String, usize)> {
    let document = session.document();
    match (&document.plant, document.design.method) {
        (PlantData::Descriptor(data), Method::Decentralized) => {
            data.partition.iter().map(|s| (s.name.clone(), s.states)).collect()
        }
        (plant, _) => vec![(String::new(), Sizes::of(plant).states)],
    }
}

/// What the program chose, as a start for own changes; the identity where it is not known.
fn start(session: &Session, derived: &Derived) -> Vec<DMatrix<f64>> {
    let assessment = derived.analysis().and_then(|analysis| analysis.assessment.as_ref().ok());
    let design = assessment.and_then(|assessment| assessment.outcome.as_ref().ok());
    let chosen = |name: &str, states: usize| {
        let found = design.and_then(|design| matrix_of(design, "R", name));
        found.filter(|R| R.ncols() == states && R.nrows() > 0).cloned()
    };
    owners(session)
        .into_iter()
        .map(|(name, states)| chosen(&name, states).unwrap_or_else(|| DMatrix::identity(states, states)))
        .collect()
}

/// The matrix of a design, of one subsystem where there are some.
pub(super) fn matrix_of<'a>(design: &'a Design, letter: &str, subsystem: &str) -> Option<&'a DMatrix<f64>> {
    design.matrix(&format!("{letter} ({subsystem})")).or_else(|| design.matrix(letter))
}

fn one(
    ui: &mut Ui,
    session: &Session,
    subsystem: usize,
    R: &DMatrix<f64>,
    widgets: &mut Widgets,
    out: &mut Output,
) {
    let owners = owners(session);
    let several = owners.len() > 1;
    let owner = owners.get(subsystem).map(|(name, _)| name.clone()).unwrap_or_default();
    let name = if several { format!("R{}", subsystem + 1) } else { "R".to_owned() };
    ui.horizontal(|ui| {
        if several {
            formula::remark(ui, &owner);
        }
        for (symbol, word, rows) in [("-", "Fewer", R.nrows() - 1), ("+", "More", R.nrows() + 1)] {
            let button = egui::Button::new(symbol).min_size(egui::vec2(24.0, 24.0));
            let response = ui.add_enabled(rows > 0 && rows <= R.ncols(), button);
            response
                .ctx
                .accesskit_node_builder(response.id, |node| node.set_label(format!("{word} rows of {name}")));
            if response.clicked() {
                let mut all = session.document().design.lmi.rows.clone();
                if let Some(own) = all.get_mut(subsystem) {
                    own.resize_mut(rows, R.ncols(), 0.0);
                }
                out.edit(Edit::Lmi(LmiEdit::Rows(all)));
            }
        }
        formula::remark(ui, &format!("{} x {}", R.nrows(), R.ncols()));
    });
    let shown = |row: usize, column: usize| {
        R.get((row, column)).map_or_else(String::new, |value| cell_text(&Entry::number(*value)))
    };
    let draft = |row, column| session.draft(&Field::Rows(subsystem, row, column)).cloned();
    let column = |column: usize| format!("x{}", column + 1);
    let spec = EntryGrid { name: &name, shape: R.shape(), shown: &shown, draft: &draft, column: &column };
    match grid(ui, widgets, &spec) {
        Some(Typed::Cell(row, column, text)) => {
            out.edit(Edit::Lmi(LmiEdit::RowsCell { subsystem, row, column, text }));
        }
        Some(Typed::Block { text, .. }) => out.edit(Edit::Lmi(LmiEdit::RowsPaste { subsystem, text })),
        None => {}
    }
}
