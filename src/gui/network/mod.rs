//! A network of identical subsystems: its equations, sizes and matrices, its coupling, its local observers.

mod coupling;
mod geometry;
mod graph;
mod links;
mod matrices;
pub(super) mod mend;
pub(super) mod observer;
mod sizes;
mod subsystem;

use std::sync::Arc;

use egui::{RichText, Ui};

use super::{Output, Widgets, theme};
use crate::document::{NetworkData, NetworkMatrix};
use crate::session::{Edit, NetworkEdit, Session};
use links::Links;

/// Up to this many subsystems `Gamma` and `Psi` are grids; beyond it the entries of one subsystem are listed.
const LARGEST_GRID: usize = 12;

/// What the screen remembers of a network: the chosen subsystem and edge, and how edges are made.
#[derive(Clone, Debug)]
pub struct NetworkWidgets {
    /// The chosen subsystem, from zero: the one that listens.
    subsystem: usize,
    /// The one that it listens to, from zero.
    from: usize,
    /// Weight of new edges.
    weight: f64,
    /// New edges change the diagonal, too.
    balanced: bool,
    /// Seed of the next random coupling.
    seed: u64,
    /// The edges, with the revision of the document that they belong to.
    links: Option<(u64, Arc<Links>)>,
}

impl Default for NetworkWidgets {
    fn default() -> Self {
        Self { subsystem: 0, from: 1, weight: 1.0, balanced: true, seed: 1, links: None }
    }
}

impl NetworkWidgets {
    /// The edges of a network; they are collected once for each revision of its document.
    fn links(&mut self, revision: u64, data: &NetworkData) -> Arc<Links> {
        if let Some((of, links)) = &self.links
            && *of == revision
        {
            return Arc::clone(links);
        }
        let links = Arc::new(Links::of(data));
        self.links = Some((revision, Arc::clone(&links)));
        links
    }

    /// Chosen numbers of a network that has become smaller.
    fn stay_within(&mut self, count: usize) {
        let last = count.saturating_sub(1);
        self.subsystem = self.subsystem.min(last);
        self.from = self.from.min(last);
    }
}

/// Draws the network in the place of the system.
pub(super) fn show(
    ui: &mut Ui,
    session: &Session,
    data: &NetworkData,
    widgets: &mut Widgets,
    out: &mut Output,
) {
    widgets.network.stay_within(data.n_subsystems());
    ui.add_space(theme::ITEM_GAP);
    equations(ui);
    sizes::show(ui, session, data, widgets, out);
    ui.add_space(theme::ITEM_GAP);
    coupling::show(ui, session, data, widgets, out);
    ui.add_space(theme::ITEM_GAP);
    subsystem::show(ui, session, data, widgets, out);
    ui.add_space(theme::ITEM_GAP);
    coupling::matrices(ui, session, data, widgets, out);
    ui.add_space(theme::ITEM_GAP);
    ui.label(RichText::new("One subsystem").strong());
    let own = [
        NetworkMatrix::State,
        NetworkMatrix::Input,
        NetworkMatrix::Output,
        NetworkMatrix::GlobalOutput,
        NetworkMatrix::LocalOutput,
    ];
    matrices::show(ui, session, data, &own, widgets, out);
    ui.add_space(theme::ITEM_GAP);
    let hint = "Write the network out as one system E x' = A x, y = C x; undo brings it back";
    if ui.button("Expand to matrices").on_hover_text(hint).clicked() {
        out.edit(Edit::Network(NetworkEdit::Expand));
    }
}

fn equations(ui: &mut Ui) {
    for line in [
        ["x_i' = a x_i + b u_i", "w_i = c x_i", "u = (Gamma kron I) w"],
        ["y_G = (Psi kron c_G) x", "y_i = c_L x_i", ""],
    ] {
        ui.horizontal_wrapped(|ui| {
            ui.spacing_mut().item_spacing.x = 18.0;
            for part in line.into_iter().filter(|part| !part.is_empty()) {
                ui.add(egui::Label::new(RichText::new(part).monospace()).extend());
            }
        });
    }
}
