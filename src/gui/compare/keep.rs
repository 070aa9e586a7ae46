//! Keeping the chosen design, from the observer's place.

use egui::Ui;

use super::super::observer::sentence;
use super::super::{Output, theme};
use crate::session::{CompareEdit, Edit, Place, Session, Show, Tab, why_not_kept};

/// Whether the chosen design can be kept, and what that does or why not.
pub(super) fn possible(session: &Session) -> (bool, String) {
    match why_not_kept(session.document()) {
        Some(why) => (false, sentence(&why)),
        None => (true, "Keeps the chosen design beside those that you try next.".to_owned()),
    }
}

/// Draws a button that keeps the chosen design, and the way to the comparison.
pub(in super::super) fn keep(ui: &mut Ui, session: &Session, out: &mut Output) {
    ui.horizontal_wrapped(|ui| {
        let (possible, hint) = possible(session);
        let button = ui.add_enabled(possible, egui::Button::new("Keep to compare"));
        if button.on_hover_text(&hint).on_disabled_hover_text(&hint).clicked() {
            out.edit(Edit::Compare(CompareEdit::Keep));
        }
        let count = session.document().kept.len();
        if count == 0 {
            return;
        }
        let text =
            if count == 1 { "1 design is kept:".to_owned() } else { format!("{count} designs are kept:") };
        ui.colored_label(theme::faint(ui), text);
        if ui.button("Compare them").clicked() {
            out.show(Show::Tab(Tab::Compare));
            out.show(Show::Place(Place::Figures));
        }
    });
}
