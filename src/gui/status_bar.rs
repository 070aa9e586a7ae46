//! The status line: what is being computed, messages, verdict.

use egui::Ui;

use super::{Output, theme};
use crate::session::{Derived, Session};

/// Draws the status line.
pub(super) fn show(ui: &mut Ui, session: &Session, derived: &Derived, out: &mut Output) {
    ui.horizontal_wrapped(|ui| {
        if let Some((_, fraction, what)) = derived.running() {
            ui.add(egui::ProgressBar::new(fraction).desired_width(90.0).desired_height(10.0));
            ui.label(if what.is_empty() { "computing" } else { what });
            if ui.button("Cancel").clicked() {
                out.cancel = true;
            }
        } else if let Some(failure) = derived.failure() {
            if derived.was_cancelled() {
                ui.colored_label(theme::near(ui), "cancelled: the last results stay");
            } else {
                ui.colored_label(theme::bad(ui), format!("the computation broke off: {failure}"));
            }
            if ui.button("Compute again").clicked() {
                out.again = true;
            }
        } else {
            let took =
                derived.elapsed_ms().map(|ms| format!("conditions, design and simulation in {ms:.0} ms"));
            ui.colored_label(theme::good(ui), took.as_deref().unwrap_or("up to date"));
        }
        ui.separator();
        match session.message() {
            Some(message) if message.error => ui.colored_label(theme::bad(ui), &message.text),
            Some(message) => ui.label(&message.text),
            None => ui.colored_label(theme::faint(ui), "every change can be undone"),
        };
        let drafts = session.n_drafts();
        if drafts > 0 {
            ui.separator();
            let text = if drafts == 1 { "1 entry is".to_owned() } else { format!("{drafts} entries are") };
            ui.colored_label(
                theme::bad(ui),
                format!("{text} not understood; the last good values are in force"),
            );
        }
    });
}
