//! The wished poles of designs by pole placement.

use egui::{RichText, Ui, vec2};

use super::super::text_field::text_field;
use super::super::{Output, Widgets, pole_plane, theme};
use crate::session::{Derived, Edit, Field, Session, Tab, poles_text};

/// Draws the list, the bandwidth and the plane of poles.
pub(super) fn show(
    ui: &mut Ui,
    session: &Session,
    derived: &Derived,
    widgets: &mut Widgets,
    out: &mut Output,
) {
    let design = &session.document().design;
    ui.label(RichText::new("Poles").strong());
    let draft = session.draft(&Field::Poles);
    let shown = poles_text(&design.poles);
    let width = ui.available_width();
    if let Some(text) = text_field(ui, widgets, (egui::Id::unique("poles"), "Poles"), &shown, draft, width) {
        out.edit(Edit::Poles(text));
    }
    if let Some(draft) = draft {
        ui.colored_label(theme::bad(ui), &draft.error);
    }
    scale(ui, session, out);
    plane(ui, session, derived, out);
}

/// Draws the plane, unless the view of poles shows it, larger.
pub(super) fn plane(ui: &mut Ui, session: &Session, derived: &Derived, out: &mut Output) {
    let elsewhere = !theme::is_narrow(ui) && session.view().tab == Tab::Poles;
    if !elsewhere {
        let size = vec2(ui.available_width(), 190.0);
        ui.allocate_ui(size, |ui| pole_plane::pole_plane_ui(ui, session, derived, size, out));
    }
}

/// The bandwidth slider, the papers' multiple of Lambda.
fn scale(ui: &mut Ui, session: &Session, out: &mut Output) {
    let mut scale = session.document().design.scale;
    ui.horizontal(|ui| {
        ui.label("Lambda x").on_hover_text("All poles times this factor: more bandwidth catches the unknown input faster and passes more noise.");
        ui.spacing_mut().slider_width = (ui.available_width() - 80.0).max(80.0);
        let slider = egui::Slider::new(&mut scale, 0.1..=100.0).logarithmic(true).max_decimals(3).clamping(egui::SliderClamping::Never);
        let response = ui.add(slider);
        response.ctx.accesskit_node_builder(response.id, |node| node.set_label("Lambda scale"));
        if response.changed() || response.drag_stopped() {
            out.edit(Edit::Scale { scale, done: !response.dragged() });
        }
    });
}
