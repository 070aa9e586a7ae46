//! (being written)
use super::Output;
use crate::session::{Derived, Session};
/// The plane.
pub fn pole_plane_ui(
    ui: &mut egui::Ui,
    session: &Session,
    derived: &Derived,
    size: egui::Vec2,
    out: &mut Output,
) {
    let _ = (ui, session, derived, size, out);
}
