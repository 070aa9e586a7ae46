//! The coupling: its form, its graph, the chosen edge, `Gamma` and `Psi`.

use egui::{DragValue, Id, Response, RichText, Ui};

use super::super::text_field::text_field;
use super::super::{Output, Widgets, formula, theme};
use super::graph::{self, Act, Picture};
use super::links::Links;
use super::{LARGEST_GRID, matrices as grids};
use crate::document::{NetworkData, NetworkMatrix};
use crate::session::{CouplingForm, Edit, Field, NetworkCell, NetworkEdit, Session};

/// Draws the coupling.
pub(super) fn show(
    ui: &mut Ui,
    session: &Session,
    data: &NetworkData,
    widgets: &mut Widgets,
    out: &mut Output,
) {
    let links = widgets.network.links(session.revision(), data);
    ui.horizontal_wrapped(|ui| {
        ui.label(RichText::new("Coupling").strong());
        formula::remark(ui, "row i of Gamma is what subsystem i receives");
    });
    forms(ui, data, &links, widgets, out);
    picture(ui, session, &links, widgets, out);
    edge(ui, session, data, widgets, out);
}

/// Draws `Gamma` and `Psi`, or of large ones what can be read in a line.
pub(super) fn matrices(
    ui: &mut Ui,
    session: &Session,
    data: &NetworkData,
    widgets: &mut Widgets,
    out: &mut Output,
) {
    if data.n_subsystems() <= LARGEST_GRID {
        let both = [NetworkMatrix::Gamma, NetworkMatrix::Psi];
        grids::show(ui, session, data, &both, widgets, out);
        return;
    }
    let chosen = widgets.network.subsystem;
    let links = widgets.network.links(session.revision(), data);
    grids::head(ui, data, NetworkMatrix::Gamma, chosen, out);
    formula::remark(
        ui,
        &format!(
            "{} edges; the row of the chosen subsystem stands above, and a pasted block goes into any of its cells",
            links.total
        ),
    );
    grids::head(ui, data, NetworkMatrix::Psi, chosen, out);
    formula::remark(ui, &links.psi);
}

fn named(response: &Response, name: &str) {
    response.ctx.accesskit_node_builder(response.id, |node| node.set_label(name));
}

/// The usual forms, and the weight that they get.
fn forms(ui: &mut Ui, data: &NetworkData, links: &Links, widgets: &mut Widgets, out: &mut Output) {
    let count = data.n_subsystems();
    let seed = widgets.network.seed;
    let mut all = vec![
        (CouplingForm::Chain, "Chain", "Each with the one before and the one behind it"),
        (CouplingForm::Ring, "Ring", "A chain whose ends meet"),
        (CouplingForm::Star, "Star", "The first one with each of the others"),
        (CouplingForm::Complete, "Complete", "Each with all others"),
        (
            CouplingForm::Random { seed },
            "Random",
            "Each listens to a few others; click again for another one",
        ),
        (
            CouplingForm::Leaders { leaders: 1 },
            "Leader",
            "All listen to the first one: a coupling of rank one, whose global observer stays small",
        ),
    ];
    if count > 3 {
        let hint =
            "Three groups, each with a leader: a coupling of rank three, however many subsystems there are";
        all.push((CouplingForm::Leaders { leaders: 3 }, "Three leaders", hint));
    }
    ui.horizontal_wrapped(|ui| {
        for (form, name, hint) in all {
            let chosen = links.forms.iter().any(|(found, _)| *found == form);
            let weight = widgets.network.weight;
            if ui.selectable_label(chosen, name).on_hover_text(hint).clicked() {
                if matches!(form, CouplingForm::Random { .. }) {
                    widgets.network.seed = seed.wrapping_add(1);
                }
                out.edit(Edit::Network(NetworkEdit::Template { form, weight }));
            }
        }
        ui.label("weight")
            .on_hover_text("Weight of the edges of the next form or the next edge that is drawn");
        let field = DragValue::new(&mut widgets.network.weight).range(-1e6..=1e6).speed(0.05);
        named(&ui.add(field.update_while_editing(false)), "Weight of edges");
    });
}

fn picture(ui: &mut Ui, session: &Session, links: &Links, widgets: &mut Widgets, out: &mut Output) {
    let chosen = widgets.network.subsystem;
    let plugged = session.document().design.plugged.as_deref();
    let picture = Picture { links, plugged, chosen, edge: (chosen, widgets.network.from) };
    let act = graph::show(ui, &picture);
    graph::legend(ui, &picture);
    let mut notes = vec!["Click a node: its local observer in or out.".to_owned()];
    if links.own.len() <= graph::WIDGETS {
        notes.push("Drag from node to node: an edge.".to_owned());
    }
    if links.drawn.len() < links.total {
        notes.push(format!("{} of {} edges are drawn.", links.drawn.len(), links.total));
    }
    if links.own.len() > super::geometry::Circle::INSIDE && links.own.iter().any(|own| *own != 0.0) {
        notes.push("The diagonal is not drawn.".to_owned());
    }
    formula::remark(ui, &notes.join(" "));
    match act {
        Some(Act::Node(subsystem)) => {
            widgets.network.subsystem = subsystem;
            let measured = links.measured.get(subsystem) == Some(&true);
            let is_in = measured && plugged.is_none_or(|list| list.contains(&subsystem));
            let edit = NetworkEdit::Plug { subsystem: Some(subsystem), plugged: !is_in };
            out.edit(Edit::Network(edit));
        }
        Some(Act::Edge(to, from)) => (widgets.network.subsystem, widgets.network.from) = (to, from),
        Some(Act::Join(to, from)) => {
            (widgets.network.subsystem, widgets.network.from) = (to, from);
            let there = links.drawn.iter().any(|link| (link.to, link.from) == (to, from));
            if !there {
                let (text, balanced) = (widgets.network.weight.to_string(), widgets.network.balanced);
                out.edit(Edit::Network(NetworkEdit::Edge { to, from, text, balanced }));
            }
        }
        None => {}
    }
}

/// The chosen edge: who listens to whom, and how strongly.
fn edge(ui: &mut Ui, session: &Session, data: &NetworkData, widgets: &mut Widgets, out: &mut Output) {
    let count = data.n_subsystems();
    let number = |ui: &mut Ui, value: &mut usize, name: &str| {
        let mut shown = *value + 1;
        let field = DragValue::new(&mut shown).range(1..=count).speed(0.05).update_while_editing(false);
        let response = ui.add(field);
        named(&response, name);
        if response.changed() {
            *value = shown.saturating_sub(1);
        }
    };
    let (mut to, mut from) = (widgets.network.subsystem, widgets.network.from);
    let balanced = widgets.network.balanced;
    let field = Field::Network(NetworkCell { matrix: NetworkMatrix::Gamma, row: to, column: from });
    let draft = session.draft(&field);
    let entry = data.Gamma.entry(to, from);
    ui.horizontal_wrapped(|ui| {
        number(ui, &mut to, "Listening subsystem");
        ui.label("listens to");
        number(ui, &mut from, "Subsystem listened to");
        ui.label("with weight");
        let shown = entry.as_ref().map_or_else(String::new, crate::document::Entry::shown);
        let id = Id::unique(("edge weight", widgets.network.subsystem, widgets.network.from));
        if let Some(text) = text_field(ui, widgets, (id, "Edge weight"), &shown, draft, theme::CELL_WIDTH) {
            let (to, from) = (widgets.network.subsystem, widgets.network.from);
            out.edit(Edit::Network(NetworkEdit::Edge { to, from, text, balanced }));
        }
        let there = entry.as_ref().is_some_and(|entry| entry.value != 0.0);
        if ui.add_enabled(there, egui::Button::new("Remove")).clicked() {
            out.edit(Edit::Network(NetworkEdit::Edge { to, from, text: "0".to_owned(), balanced }));
        }
        let hint =
            "The diagonal Gamma[i, i] follows, so that subsystems in equal states do not feel each other";
        ui.checkbox(&mut widgets.network.balanced, "row sums stay").on_hover_text(hint);
    });
    if let Some(draft) = draft.filter(|_| count > LARGEST_GRID) {
        ui.colored_label(theme::bad(ui), format!("weight: {}", draft.error));
    }
    (widgets.network.subsystem, widgets.network.from) = (to, from);
}
