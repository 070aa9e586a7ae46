//! Examining an observer that was designed elsewhere: its matrices, its claim, the verdict.

use egui::{CollapsingHeader, Id, Ui};
use nalgebra::DMatrix;

use super::super::entry_grid::pasted_block;
use super::super::text_field::text_field;
use super::super::{Output, Widgets, formula, plot::short, theme};
use crate::document::{Entry, Sizes};
use crate::observer::{GivenObserver, LmiResult, Method};
use crate::session::{Derived, Edit, Field, GivenPart, LmiEdit, Session};

/// Draws the fields; only paper 002 gives observers to examine.
pub(super) fn show(
    ui: &mut Ui,
    session: &Session,
    derived: &Derived,
    widgets: &mut Widgets,
    out: &mut Output,
) {
    let design = &session.document().design;
    if design.method != Method::HInfinity {
        return;
    }
    CollapsingHeader::new("Examine a given observer")
        .id_salt(("audit", design.lmi.given.is_some()))
        .default_open(design.lmi.given.is_some())
        .show_unindented(ui, |ui| match &design.lmi.given {
            None => {
                formula::remark(
                    ui,
                    "Type or paste N and J, as a paper prints them: is the attenuation true that is claimed?",
                );
                if ui.button("Examine instead of designing").clicked() {
                    out.edit(Edit::Lmi(LmiEdit::Examine(Some(start(session, derived)))));
                }
            }
            Some(given) => {
                matrix(ui, session, widgets, (GivenPart::N, "N"), &given.N, out);
                matrix(ui, session, widgets, (GivenPart::J, "J"), &given.J, out);
                claim(ui, session, widgets, given.gamma, out);
                verdict(ui, given.gamma, results(derived));
                if ui.button("Design again").on_hover_text("Remove the given observer").clicked() {
                    out.edit(Edit::Lmi(LmiEdit::Examine(None)));
                }
            }
        });
}

fn results(derived: &Derived) -> &[LmiResult] {
    let assessment = derived.analysis().and_then(|analysis| analysis.assessment.as_ref().ok());
    let examined = assessment.filter(|assessment| assessment.choice.lmi.given.is_some());
    let design = examined.and_then(|assessment| assessment.outcome.as_ref().ok());
    design.map_or(&[], |design| design.synthesis.lmi())
}

/// The own design, as a start for own changes.
fn start(session: &Session, derived: &Derived) -> GivenObserver {
    let assessment = derived.analysis().and_then(|analysis| analysis.assessment.as_ref().ok());
    let design = assessment.and_then(|assessment| assessment.outcome.as_ref().ok());
    let sizes = Sizes::of(&session.document().plant);
    let found = |letter| design.and_then(|design| design.matrix(letter)).cloned();
    match (found("N"), found("J")) {
        (Some(n), Some(j)) if !n.is_empty() && j.ncols() == sizes.outputs => {
            GivenObserver { N: n, J: j, gamma: None }
        }
        _ => GivenObserver {
            N: -DMatrix::identity(sizes.states, sizes.states),
            J: DMatrix::zeros(sizes.states, sizes.outputs),
            gamma: None,
        },
    }
}

/// A matrix on one line, `[0 -1.996; 0.667 -2.121]`.
fn on_one_line(matrix: &DMatrix<f64>) -> String {
    let row = |i: usize| {
        let entries = matrix.row(i).iter().map(|value| Entry::number(*value).shown()).collect::<Vec<_>>();
        entries.join(" ")
    };
    format!("[{}]", (0..matrix.nrows()).map(row).collect::<Vec<_>>().join("; "))
}

fn matrix(
    ui: &mut Ui,
    session: &Session,
    widgets: &mut Widgets,
    (part, letter): (GivenPart, &str),
    value: &DMatrix<f64>,
    out: &mut Output,
) {
    let id = Id::unique(("given", letter));
    if ui.memory(|memory| memory.has_focus(id))
        && let Some(text) = pasted_block(ui)
    {
        widgets.typing = None;
        out.edit(Edit::Lmi(LmiEdit::Given { part, text }));
        return;
    }
    field(ui, session, widgets, (part, id, letter), &on_one_line(value), out);
}

fn claim(ui: &mut Ui, session: &Session, widgets: &mut Widgets, gamma: Option<f64>, out: &mut Output) {
    let shown = gamma.map_or_else(String::new, |gamma| Entry::number(gamma).shown());
    let id = Id::unique(("given", "gamma"));
    field(ui, session, widgets, (GivenPart::Gamma, id, "Claimed gamma"), &shown, out);
}

fn field(
    ui: &mut Ui,
    session: &Session,
    widgets: &mut Widgets,
    (part, id, label): (GivenPart, Id, &str),
    shown: &str,
    out: &mut Output,
) {
    let draft = session.draft(&Field::Given(part));
    ui.horizontal(|ui| {
        let short = if part == GivenPart::Gamma { "gamma <=" } else { label };
        ui.add_sized([56.0, ui.spacing().interact_size.y], egui::Label::new(format!("{short} ")));
        let name = if part == GivenPart::Gamma { label.to_owned() } else { format!("given {label}") };
        let width = ui.available_width();
        if let Some(text) = text_field(ui, widgets, (id, &name), shown, draft, width) {
            out.edit(Edit::Lmi(LmiEdit::Given { part, text }));
        }
    });
    if let Some(draft) = draft {
        ui.colored_label(theme::bad(ui), format!("{label}: {}", draft.error));
    }
}

/// Whether the claim is true, as far as it can be proved.
fn verdict(ui: &mut Ui, claimed: Option<f64>, results: &[LmiResult]) {
    let Some(result) = results.first() else { return };
    let lower = result.bounds.iter().max_by(|a, b| a.1.total_cmp(&b.1));
    let (colour, text) = match (claimed, lower, result.gamma.filter(|_| result.certificate.proved)) {
        (Some(claimed), Some((name, bound)), _) if *bound > claimed * (1.0 + 1e-9) => (
            theme::bad(ui),
            format!(
                "The claim is false: {name} needs at least {}, but {} is claimed.",
                short(*bound),
                short(claimed)
            ),
        ),
        (Some(claimed), _, Some(gamma)) if gamma <= claimed => {
            (theme::good(ui), format!("The claim is true: {} is proved.", short(gamma)))
        }
        (Some(claimed), _, Some(gamma)) => (
            theme::near(ui),
            format!("{} is claimed, {} is the best that could be proved.", short(claimed), short(gamma)),
        ),
        (None, _, Some(gamma)) => (theme::good(ui), format!("{} is proved for this observer.", short(gamma))),
        (_, _, None) => (theme::near(ui), "No attenuation could be proved for this observer.".to_owned()),
    };
    ui.colored_label(colour, text);
}
