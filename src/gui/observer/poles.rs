//! The wished poles of designs by pole placement.

use egui::{Id, RichText, Ui, vec2};

use super::super::text_field::text_field;
use super::super::{Output, Widgets, pole_plane, theme};
use crate::numerics::Complex64;
use crate::observer::Method;
use crate::session::{Derived, Edit, Field, NetworkEdit, Session, Tab, poles_text};

/// Draws the list, the bandwidth and the plane of poles; of a hierarchical observer both lists.
pub(super) fn show(
    ui: &mut Ui,
    session: &Session,
    derived: &Derived,
    widgets: &mut Widgets,
    out: &mut Output,
) {
    let design = &session.document().design;
    if design.method == Method::Hierarchical {
        let global =
            List { title: "Poles of the global observer", name: "Global poles", field: Field::Poles };
        if let Some(text) = list(ui, session, widgets, &global, &design.poles) {
            out.edit(Edit::Poles(text));
        }
        let local =
            List { title: "Poles of the local observers", name: "Local poles", field: Field::LocalPoles };
        if let Some(text) = list(ui, session, widgets, &local, &design.local_poles) {
            out.edit(Edit::Network(NetworkEdit::LocalPoles(text)));
        }
    } else {
        let only = List { title: "Poles", name: "Poles", field: Field::Poles };
        if let Some(text) = list(ui, session, widgets, &only, &design.poles) {
            out.edit(Edit::Poles(text));
        }
    }
    scale(ui, session, out);
    plane(ui, session, derived, out);
}

/// A list of poles that is typed.
struct List {
    title: &'static str,
    /// Accessible name.
    name: &'static str,
    field: Field,
}

/// Draws a list; the text when it was changed.
fn list(
    ui: &mut Ui,
    session: &Session,
    widgets: &mut Widgets,
    list: &List,
    poles: &[Complex64],
) -> Option<String> {
    ui.label(RichText::new(list.title).strong());
    let draft = session.draft(&list.field);
    let (id, width) = (Id::unique(("poles", list.name)), ui.available_width());
    let text = text_field(ui, widgets, (id, list.name), &poles_text(poles), draft, width);
    if let Some(draft) = draft {
        ui.colored_label(theme::bad(ui), &draft.error);
    }
    text
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
