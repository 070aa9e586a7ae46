//! The hierarchical observer: orders, and the local observers to be plugged in and out.

use egui::{RichText, Ui};

use super::super::{Output, formula};
use crate::document::PlantData;
use crate::observer::Design;
use crate::session::{Edit, NetworkEdit, Session};

/// Local observers that have a chip; of more, the graph and the chosen subsystem are used.
const CHIPS: usize = 60;

/// Draws the orders and a chip for each local observer.
pub(in crate::gui) fn show(ui: &mut Ui, session: &Session, design: Option<&Design>, out: &mut Output) {
    let PlantData::Network(data) = &session.document().plant else { return };
    if let Some(found) = design.and_then(|design| design.hierarchical.as_deref()) {
        let (nu, mu) = (found.hierarchy.N.ncols(), found.hierarchy.M.ncols());
        ui.horizontal_wrapped(|ui| {
            ui.label(RichText::new(format!("nu = {nu}, mu = {mu}:")).monospace()).on_hover_text(
                "nu = rank Gamma: directions in which the subsystems feel each other\nmu = states of a subsystem that its \
                 coupling output shows",
            );
            ui.label(format!("the global observer has nu mu = {} states,", found.hierarchy.order()));
            ui.label(format!("each local one {}", data.a.shape().0));
        });
    }
    ui.label(RichText::new("Local observers").strong());
    if data.local.is_empty() {
        formula::remark(ui, "No subsystem is measured locally: choose one in the place of the system.");
        return;
    }
    let plugged = session.document().design.plugged.as_deref();
    let mut edit = |edit: NetworkEdit| out.edit(Edit::Network(edit));
    ui.horizontal_wrapped(|ui| {
        for subsystem in data.local.iter().filter_map(|number| number.checked_sub(1)).take(CHIPS) {
            let is_in = plugged.is_none_or(|list| list.contains(&subsystem));
            let word = if is_in { "plugged in" } else { "out" };
            let response = ui.selectable_label(is_in, format!("{}: {word}", subsystem + 1)).on_hover_text(
                "Nothing else changes: the global observer and the other local ones stay as they are",
            );
            if response.clicked() {
                edit(NetworkEdit::Plug { subsystem: Some(subsystem), plugged: !is_in });
            }
        }
        if data.local.len() > CHIPS {
            formula::remark(ui, &format!("and {} more", data.local.len() - CHIPS));
        }
        if data.local.len() > 1 {
            for (name, plugged, label) in [
                ("all in", true, "Plug in all local observers"),
                ("all out", false, "Pull out all local observers"),
            ] {
                let response = ui.small_button(name);
                response.ctx.accesskit_node_builder(response.id, |node| node.set_label(label));
                if response.clicked() {
                    edit(NetworkEdit::Plug { subsystem: None, plugged });
                }
            }
        }
    });
}
