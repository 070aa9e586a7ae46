//! This system: sizes, matrices, properties.

use super::{Output, Widgets};
use crate::session::{Derived, Session};

/// Draws the place of the system.
pub fn show(
    ui: &mut egui::Ui,
    session: &Session,
    derived: &Derived,
    widgets: &mut Widgets,
    out: &mut Output,
) {
    let _ = (ui, session, derived, widgets, out);
}
