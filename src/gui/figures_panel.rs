//! What happens: the views over time and frequency, the figures, the scenario.

use super::{Output, Widgets};
use crate::session::{Derived, Session};

/// Draws the place of the figures.
pub fn show(
    ui: &mut egui::Ui,
    session: &Session,
    derived: &Derived,
    widgets: &mut Widgets,
    out: &mut Output,
) {
    let _ = (ui, session, derived, widgets, out);
}
