//! The nonlinearity `G f(x)`: its matrices, its components, its Lipschitz constant.

use egui::{CollapsingHeader, Id, RichText, Ui};

use super::super::entry_grid::{EntryGrid, Typed, show as grid};
use super::super::matrix_grid::cell_text;
use super::super::text_field::text_field;
use super::super::{Output, Widgets, formula, theme};
use super::partition::shape;
use super::steps;
use crate::document::{Entry, EntryMatrix, LipschitzData, PlantData};
use crate::session::{Derived, Edit, Field, LipschitzEdit, LipschitzMatrix, Session};

/// Draws the nonlinearity, or a button that adds one.
pub(super) fn show(
    ui: &mut Ui,
    session: &Session,
    derived: &Derived,
    widgets: &mut Widgets,
    out: &mut Output,
) {
    let PlantData::Descriptor(data) = &session.document().plant else { return };
    let Some(lipschitz) = &data.lipschitz else {
        ui.horizontal_wrapped(|ui| {
            ui.label(RichText::new("Nonlinearity").strong());
            let hint = "For H-infinity observers: G f(x) with |f(a) - f(b)| <= lambda |F_L (a - b)|";
            if ui.button("Add a nonlinearity").on_hover_text(hint).clicked() {
                out.edit(Edit::Lipschitz(LipschitzEdit::Add));
            }
        });
        return;
    };
    CollapsingHeader::new(RichText::new("Nonlinearity G f(x)").strong())
        .id_salt("lipschitz")
        .default_open(true)
        .show_unindented(ui, |ui| {
            sizes(ui, lipschitz, out);
            components(ui, session, widgets, lipschitz, out);
            constant(ui, session, widgets, lipschitz, out);
            exceeded(ui, derived);
            let f = |column: usize| format!("f{}", column + 1);
            matrix(ui, session, widgets, ("G", LipschitzMatrix::G, &lipschitz.G, &f), out);
            let x = |column: usize| format!("x{}", column + 1);
            matrix(ui, session, widgets, ("F_L", LipschitzMatrix::Arguments, &lipschitz.F_L, &x), out);
            if ui.button("Remove the nonlinearity").clicked() {
                out.edit(Edit::Lipschitz(LipschitzEdit::Remove));
            }
        });
}

fn sizes(ui: &mut Ui, lipschitz: &LipschitzData, out: &mut Output) {
    ui.horizontal_wrapped(|ui| {
        let counts = [
            (LipschitzMatrix::G, "components", lipschitz.f.len()),
            (LipschitzMatrix::Arguments, "rows of F_L", lipschitz.F_L.shape().0),
        ];
        for (of, word, count) in counts {
            if let Some(grow) = steps(ui, word, word, count) {
                out.edit(Edit::Lipschitz(LipschitzEdit::Size { of, grow }));
            }
        }
    });
}

fn components(
    ui: &mut Ui,
    session: &Session,
    widgets: &mut Widgets,
    lipschitz: &LipschitzData,
    out: &mut Output,
) {
    for (index, shown) in lipschitz.f.iter().enumerate() {
        let name = format!("f{}", index + 1);
        let draft = session.draft(&Field::Component(index));
        ui.horizontal(|ui| {
            ui.label(format!("{name}(x) ="));
            let id = Id::unique(("component", index));
            let width = ui.available_width() - theme::BLOCK_GAP;
            if let Some(text) = text_field(ui, widgets, (id, &name), shown, draft, width) {
                out.edit(Edit::Lipschitz(LipschitzEdit::Component { index, text }));
            }
        });
        if let Some(draft) = draft {
            ui.colored_label(theme::bad(ui), format!("{name}: {}", draft.error));
        }
    }
}

fn constant(
    ui: &mut Ui,
    session: &Session,
    widgets: &mut Widgets,
    lipschitz: &LipschitzData,
    out: &mut Output,
) {
    let draft = session.draft(&Field::LipschitzConstant);
    ui.horizontal(|ui| {
        ui.label("lambda =").on_hover_text("|f(a) - f(b)| <= lambda |F_L (a - b)| for all a, b and t");
        let shown = Entry::number(lipschitz.constant).shown();
        let id = Id::unique("Lipschitz constant");
        if let Some(text) = text_field(ui, widgets, (id, "Lipschitz constant"), &shown, draft, 90.0) {
            out.edit(Edit::Lipschitz(LipschitzEdit::Constant(text)));
        }
    });
    if let Some(draft) = draft {
        ui.colored_label(theme::bad(ui), format!("lambda: {}", draft.error));
    }
}

/// What the analysis says of the constant: that the simulated states exceeded it, for example.
fn exceeded(ui: &mut Ui, derived: &Derived) {
    let Some(analysis) = derived.analysis() else { return };
    let simulated = analysis.simulation.iter().flat_map(|simulation| &simulation.notes);
    let conditions = analysis.assessment.iter().flat_map(|assessment| &assessment.conditions);
    let refuted = conditions.filter(|c| c.name.contains("Lipschitz constant") && !c.verdict.holds());
    for condition in refuted {
        ui.colored_label(theme::bad(ui), &condition.summary);
    }
    for note in simulated.filter(|note| note.contains("Lipschitz constant")) {
        ui.colored_label(theme::near(ui), note);
    }
}

type Named<'a> = (&'a str, LipschitzMatrix, &'a EntryMatrix, &'a dyn Fn(usize) -> String);

fn matrix(
    ui: &mut Ui,
    session: &Session,
    widgets: &mut Widgets,
    (name, matrix, entries, column): Named<'_>,
    out: &mut Output,
) {
    ui.horizontal(|ui| {
        ui.label(RichText::new(name).strong().size(16.0));
        formula::remark(ui, &shape(entries));
    });
    let shown = |row, column| entries.entry(row, column).map(cell_text).unwrap_or_default();
    let draft = |row, column| session.draft(&Field::Lipschitz(matrix, row, column)).cloned();
    let spec = EntryGrid { name, shape: entries.shape(), shown: &shown, draft: &draft, column };
    match grid(ui, widgets, &spec) {
        Some(Typed::Cell(row, column, text)) => {
            out.edit(Edit::Lipschitz(LipschitzEdit::Cell { matrix, row, column, text }));
        }
        Some(Typed::Block { text, .. }) => out.edit(Edit::Lipschitz(LipschitzEdit::Paste { matrix, text })),
        None => {}
    }
}
