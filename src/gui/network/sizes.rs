//! Number of subsystems and sizes of one of them, with buttons for one more and one fewer.

use egui::{Id, RichText, Ui};

use super::super::system::{bump, steps};
use super::super::text_field::text_field;
use super::super::{Output, Widgets, theme};
use crate::document::NetworkData;
use crate::session::{Edit, Field, NetworkEdit, NetworkSize, Session};

/// Draws the sizes.
pub(super) fn show(
    ui: &mut Ui,
    session: &Session,
    data: &NetworkData,
    widgets: &mut Widgets,
    out: &mut Output,
) {
    let sizes = [
        (NetworkSize::States, "states each", data.a.shape().0),
        (NetworkSize::Channels, "channels", data.b.shape().1),
        (NetworkSize::GlobalOutputs, "rows of c_G", data.c_G.shape().0),
        (NetworkSize::LocalOutputs, "rows of c_L", data.c_L.shape().0),
        (NetworkSize::Combinations, "rows of Psi", data.Psi.shape().0),
    ];
    egui::Grid::new("network-sizes").num_columns(2).spacing([theme::ITEM_GAP, 4.0]).show(ui, |ui| {
        subsystems(ui, session, data, widgets, out);
        for (k, (of, name, count)) in sizes.into_iter().enumerate() {
            if let Some(grow) = steps(ui, name, name, count) {
                out.edit(Edit::Network(NetworkEdit::Size { of, grow }));
            }
            if k % 2 == 0 {
                ui.end_row();
            }
        }
    });
    if let Some(draft) = session.draft(&Field::Subsystems) {
        ui.colored_label(theme::bad(ui), format!("subsystems: {}", draft.error));
    }
}

/// The number of subsystems can be typed, too: networks are large.
fn subsystems(ui: &mut Ui, session: &Session, data: &NetworkData, widgets: &mut Widgets, out: &mut Output) {
    let of = NetworkSize::Subsystems;
    egui::Frame::new().fill(ui.visuals().faint_bg_color).corner_radius(4.0).inner_margin(3.0).show(
        ui,
        |ui| {
            ui.horizontal(|ui| {
                if bump(ui, "-", "Fewer subsystems") {
                    out.edit(Edit::Network(NetworkEdit::Size { of, grow: false }));
                }
                let (id, shown) = (Id::unique("subsystems"), data.n_subsystems().to_string());
                let draft = session.draft(&Field::Subsystems);
                if let Some(text) = text_field(ui, widgets, (id, "Subsystems"), &shown, draft, 52.0) {
                    out.edit(Edit::Network(NetworkEdit::Subsystems(text)));
                }
                if bump(ui, "+", "More subsystems") {
                    out.edit(Edit::Network(NetworkEdit::Size { of, grow: true }));
                }
                ui.label(RichText::new("subsystems").small());
            });
        },
    );
}
