//! What drives the states that the equations leave free, and what the equations determine of the unknown inputs.

use egui::{Id, RichText, Ui};
use nalgebra::DMatrix;

use super::super::entry_grid::{EntryGrid, Typed, show as entry_grid};
use super::super::matrix_grid::cell_text;
use super::super::text_field::text_field;
use super::super::{Output, Widgets, formula, theme};
use super::signals::{SIGNAL_WIDTH, shapes};
use super::{Sizes, group, named};
use crate::document::FreeData;
use crate::observer::show as show_mode;
use crate::session::{Derived, Edit, Field, FreeEdit, FreeReport, Session};
use crate::system::Signal;

/// Feedbacks of more states than this are edited in the document.
const LARGEST_GRID: usize = 20;

/// Said while signals or a feedback are there and no state is free.
const NOTHING_FREE: &str = "Signals and feedback of free states wait: the equations determine every state.";

/// Draws what is free; nothing for a plant whose equations determine everything.
pub(super) fn show(
    ui: &mut Ui,
    session: &Session,
    derived: &Derived,
    widgets: &mut Widgets,
    out: &mut Output,
) {
    let document = session.document();
    let free = &document.scenario.free;
    let sizes = Sizes::of(document);
    let Some(analysis) = derived.analysis() else { return };
    let waits = *free != FreeData::default();
    let Some(report) = analysis.free.as_ref() else {
        if waits && sizes.equations == sizes.states {
            formula::remark(ui, NOTHING_FREE);
        }
        return;
    };
    if waits && report.n_free == 0 {
        formula::remark(ui, NOTHING_FREE);
    }
    if report.n_free > 0 {
        ui.horizontal_wrapped(|ui| {
            ui.label(RichText::new(count(report.n_free)).strong()).on_hover_text(
                "The equations say nothing about these combinations of states: any signal may drive them, and the observer \
                 must follow.",
            );
            for (index, direction) in report.directions.iter().enumerate() {
                signal(ui, session, widgets, (index, direction), out);
            }
        });
        for index in 0..report.n_free {
            error(ui, session, &format!("v{}", index + 1), &Field::FreeSignal(index));
        }
        let on = feedback_line(ui, free, report, sizes.states, out);
        if on {
            grid(ui, session, report, sizes.states, widgets, out);
        }
        modes(ui, report);
        waiting(ui, free, report);
    }
    if report.constrained > 0 {
        formula::remark(ui, &constrained(report.constrained, sizes.unknown));
    }
}

fn count(free: usize) -> String {
    if free == 1 { "One state is free:".to_owned() } else { format!("{free} states are free:") }
}

fn constrained(count: usize, unknown: usize) -> String {
    let (what, which) = if unknown == 1 {
        ("the unknown input".to_owned(), "its signal does not count")
    } else {
        (
            format!("{count} of {unknown} unknown inputs, as combinations"),
            "the signals of d count as far as they leave it",
        )
    };
    format!("The equations determine {what}: {which}.")
}

fn signal(
    ui: &mut Ui,
    session: &Session,
    widgets: &mut Widgets,
    (index, direction): (usize, &str),
    out: &mut Output,
) {
    let scenario = &session.document().scenario;
    let name = format!("v{}", index + 1);
    ui.label(direction);
    group(ui, SIGNAL_WIDTH + 88.0, |ui| {
        ui.label(format!("{name}(t) ="));
        let shown = scenario.free.signals.get(index).map_or("0", Signal::text);
        let draft = session.draft(&Field::FreeSignal(index));
        let id = Id::unique(("free", index));
        if let Some(text) = text_field(ui, widgets, (id, &name), shown, draft, SIGNAL_WIDTH) {
            out.edit(Edit::Free(FreeEdit::Signal { index, text }));
        }
        shapes(ui, scenario.horizon, &name, |text| {
            out.edit(Edit::Free(FreeEdit::Signal { index, text }));
        });
    });
}

fn error(ui: &mut Ui, session: &Session, name: &str, field: &Field) {
    if let Some(draft) = session.draft(field) {
        ui.colored_label(theme::bad(ui), format!("{name}: {}", draft.error));
    }
}

/// The switch of the feedback and the button that computes one; whether there is one.
fn feedback_line(ui: &mut Ui, free: &FreeData, report: &FreeReport, states: usize, out: &mut Output) -> bool {
    let on = free.feedback.is_some();
    ui.horizontal_wrapped(|ui| {
        let mut wanted = on;
        let hint = "v = v0(t) - feedback x: the free states may depend on all states";
        let response = ui.checkbox(&mut wanted, "State feedback").on_hover_text(hint);
        named(&response, "State feedback");
        if response.changed() {
            let zeros = DMatrix::zeros(report.n_free, states);
            out.edit(Edit::Free(FreeEdit::Feedback(wanted.then_some(zeros))));
        }
        let button = egui::Button::new("Keep the plant bounded");
        match &report.bounding {
            Ok(found) => {
                let hint = format!("Gives {} the modes {}", subject(report), list(&found.modes));
                if ui.add(button).on_hover_text(hint).clicked() {
                    out.edit(Edit::Free(FreeEdit::Feedback(Some(found.feedback.clone()))));
                }
                if let Some(warning) = &found.warning {
                    ui.label(RichText::new(warning).small().color(theme::near(ui)));
                }
            }
            Err(why) => {
                ui.add_enabled(false, button).on_disabled_hover_text(why);
                formula::remark(ui, why);
            }
        }
    });
    on
}

fn grid(
    ui: &mut Ui,
    session: &Session,
    report: &FreeReport,
    states: usize,
    widgets: &mut Widgets,
    out: &mut Output,
) {
    if states > LARGEST_GRID || report.n_free > LARGEST_GRID {
        formula::remark(ui, &format!("feedback {} x {states}: too large to be edited here", report.n_free));
        return;
    }
    let feedback = session.document().scenario.free.feedback.as_ref();
    let shown = |row: usize, column: usize| {
        feedback.and_then(|matrix| matrix.entry(row, column)).map_or_else(|| "0".to_owned(), cell_text)
    };
    let draft = |row, column| session.draft(&Field::FreeFeedback(row, column)).cloned();
    let column = |column: usize| format!("x{}", column + 1);
    let shape = (report.n_free, states);
    let spec = EntryGrid { name: "feedback", shape, shown: &shown, draft: &draft, column: &column };
    match entry_grid(ui, widgets, &spec) {
        Some(Typed::Cell(row, column, text)) => {
            out.edit(Edit::Free(FreeEdit::Cell { row, column, text }));
        }
        Some(Typed::Block { text, .. }) => out.edit(Edit::Free(FreeEdit::Paste(text))),
        None => {}
    }
}

/// What has the modes: the plant, or what of it is linear and certain.
fn subject(report: &FreeReport) -> &'static str {
    if report.linear_part { "the linear part of the plant" } else { "the plant" }
}

/// The modes of the plant, and whether it grows.
fn modes(ui: &mut Ui, report: &FreeReport) {
    let subject = subject(report).replacen('t', "T", 1);
    match &report.modes {
        Ok(modes) if modes.is_empty() => {}
        Ok(modes) if report.unstable.is_empty() => {
            formula::remark(ui, &format!("{subject} stays bounded: its modes are {}.", list(modes)));
        }
        Ok(modes) => {
            let (all, growing) = (list(modes), list(&report.unstable));
            let text = if modes.len() == report.unstable.len() {
                format!("{subject} may grow: its modes {all} do not decay.")
            } else {
                format!("{subject} may grow: of its modes {all} not all decay ({growing}).")
            };
            ui.label(RichText::new(text).small().color(theme::near(ui)));
        }
        Err(why) => {
            ui.colored_label(theme::bad(ui), why);
        }
    }
}

/// Signals and rows that are more than there are free states.
fn waiting(ui: &mut Ui, free: &FreeData, report: &FreeReport) {
    let rows = free.feedback.as_ref().map_or(0, |matrix| matrix.shape().0);
    for (given, what) in [(free.signals.len(), "signals"), (rows, "rows of the feedback")] {
        if given > report.n_free {
            let text = format!("{} {what} wait for more free states.", given - report.n_free);
            formula::remark(ui, &text);
        }
    }
}

fn list(modes: &[crate::numerics::Complex64]) -> String {
    modes.iter().map(|mode| show_mode(*mode)).collect::<Vec<_>>().join(", ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_the_equations_determine_is_said_in_words() {
        assert_eq!(
            constrained(1, 1),
            "The equations determine the unknown input: its signal does not count."
        );
        assert!(
            constrained(2, 3).starts_with("The equations determine 2 of 3 unknown inputs"),
            "some of them"
        );
    }
}
