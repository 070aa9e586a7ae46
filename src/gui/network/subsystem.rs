//! The chosen subsystem: what it has locally, where it starts, what it receives in a large network.

use egui::{Checkbox, DragValue, Id, RichText, Ui};

use super::super::entry_grid::pasted_block;
use super::super::text_field::text_field;
use super::super::{Output, Widgets, formula, plot::short, theme};
use super::LARGEST_GRID;
use crate::document::limits::MAX_SIDE;
use crate::document::{InitialFormula, NetworkData, NetworkMatrix};
use crate::session::{Edit, Field, NetworkCell, NetworkEdit, Session};

/// Draws the chosen subsystem.
pub(super) fn show(
    ui: &mut Ui,
    session: &Session,
    data: &NetworkData,
    widgets: &mut Widgets,
    out: &mut Output,
) {
    let count = data.n_subsystems();
    ui.horizontal_wrapped(|ui| {
        ui.label(RichText::new("Subsystem").strong());
        let mut shown = widgets.network.subsystem + 1;
        let field = DragValue::new(&mut shown).range(1..=count).speed(0.05).update_while_editing(false);
        let response = ui.add(field);
        response.ctx.accesskit_node_builder(response.id, |node| node.set_label("Chosen subsystem"));
        if response.changed() {
            widgets.network.subsystem = shown.saturating_sub(1);
        }
        formula::remark(ui, &format!("of {count}; {} are measured locally", data.local.len()));
    });
    let k = widgets.network.subsystem;
    local(ui, session, data, k, out);
    initial(ui, session, data, k, widgets, out);
    if count > LARGEST_GRID {
        received(ui, session, data, k, widgets, out);
    }
}

fn local(ui: &mut Ui, session: &Session, data: &NetworkData, k: usize, out: &mut Output) {
    let mut measured = data.has_local_outputs(k);
    let mut plugged = data.is_plugged(k, session.document().design.plugged.as_deref());
    let mut edit = |edit: NetworkEdit| out.edit(Edit::Network(edit));
    ui.horizontal_wrapped(|ui| {
        if ui.checkbox(&mut measured, "measured locally").on_hover_text("y_i = c_L x_i is known").changed() {
            edit(NetworkEdit::Local { subsystem: Some(k), measured });
        }
        for (name, measured, label) in
            [("all", true, "Measure all locally"), ("none", false, "Measure none locally")]
        {
            let response = ui.small_button(name);
            response.ctx.accesskit_node_builder(response.id, |node| node.set_label(label));
            if response.clicked() {
                edit(NetworkEdit::Local { subsystem: None, measured });
            }
        }
    });
    ui.horizontal_wrapped(|ui| {
        let response = ui
            .add_enabled(measured, Checkbox::new(&mut plugged, "local observer plugged in"))
            .on_disabled_hover_text("A local observer needs local measurements");
        if response.changed() {
            edit(NetworkEdit::Plug { subsystem: Some(k), plugged });
        }
    });
}

/// The initial state of the subsystem, under the numbers that its states have in the whole network.
fn initial(
    ui: &mut Ui,
    session: &Session,
    data: &NetworkData,
    k: usize,
    widgets: &mut Widgets,
    out: &mut Output,
) {
    const SHOWN: usize = 20;
    // wide enough for an expression such as 5*sin(20)
    const WIDTH: f32 = 74.0;
    let states = data.a.shape().0;
    let scenario = &session.document().scenario;
    let formula = scenario.x0_formula.as_ref().filter(|_| scenario.x0.is_empty());
    let own = |state: usize| match (scenario.x0.get(state), formula) {
        (Some(entry), _) => entry.shown(),
        (None, Some(formula)) => short(formula.value(state)),
        (None, None) => "0".to_owned(),
    };
    let editable = data.states() <= MAX_SIDE;
    ui.horizontal_wrapped(|ui| {
        ui.label("starts from");
        for state in (k * states..).take(states.min(SHOWN)) {
            let name = format!("x{}(0)", state + 1);
            if !editable {
                ui.label(own(state)).on_hover_text(name);
                continue;
            }
            let draft = session.draft(&Field::Initial(state));
            let id = Id::unique(("network initial", state));
            if let Some(text) = text_field(ui, widgets, (id, &name), &own(state), draft, WIDTH) {
                out.edit(Edit::Initial { state, text });
            }
        }
        if states > SHOWN {
            formula::remark(ui, &format!("and {} more states", states - SHOWN));
        }
    });
    for state in (k * states..).take(states.min(SHOWN)) {
        if let Some(draft) = session.draft(&Field::Initial(state)) {
            ui.colored_label(theme::bad(ui), format!("x{}(0): {}", state + 1, draft.error));
        }
    }
    for_all(ui, session, formula.map_or("", InitialFormula::text), widgets, out);
}

/// One expression for the initial states of all subsystems.
fn for_all(ui: &mut Ui, session: &Session, shown: &str, widgets: &mut Widgets, out: &mut Output) {
    let draft = session.draft(&Field::InitialFormula);
    ui.horizontal(|ui| {
        ui.label("all by x_i(0) =").on_hover_text(
            "An expression in i, the number of the state in the whole network, such as 5*sin(i); empty for rest",
        );
        let id = Id::unique("initial states");
        let width = (ui.available_width() - theme::BLOCK_GAP).clamp(60.0, 220.0);
        if let Some(text) = text_field(ui, widgets, (id, "Initial states of all"), shown, draft, width) {
            out.edit(Edit::InitialFormula(text));
        }
    });
    if let Some(draft) = draft {
        ui.colored_label(theme::bad(ui), format!("x_i(0): {}", draft.error));
    }
}

/// The row of `Gamma` and the column of `Psi` of a subsystem, in a network that is too large for grids.
fn received(
    ui: &mut Ui,
    session: &Session,
    data: &NetworkData,
    k: usize,
    widgets: &mut Widgets,
    out: &mut Output,
) {
    const SHOWN: usize = 24;
    let links = widgets.network.links(session.revision(), data);
    let mut row = links.listens.get(k).cloned().unwrap_or_default();
    if !row.contains(&k) {
        row.push(k);
        row.sort_unstable();
    }
    let listed = row.len();
    let gamma = row.into_iter().take(SHOWN).map(|column| (NetworkMatrix::Gamma, k, column));
    let psi = (0..data.Psi.shape().0).take(SHOWN).map(|row| (NetworkMatrix::Psi, row, k));
    for (matrix, row, column) in gamma.chain(psi) {
        cell(ui, session, data, NetworkCell { matrix, row, column }, widgets, out);
    }
    if listed > SHOWN {
        formula::remark(ui, &format!("and {} more entries of this row", listed - SHOWN));
    }
}

fn cell(
    ui: &mut Ui,
    session: &Session,
    data: &NetworkData,
    cell: NetworkCell,
    widgets: &mut Widgets,
    out: &mut Output,
) {
    let NetworkCell { matrix, row, column } = cell;
    let name = format!("{}[{}, {}]", matrix.letter(), row + 1, column + 1);
    let shown = data.entry(matrix, row, column).map_or_else(String::new, |entry| entry.shown());
    let draft = session.draft(&Field::Network(cell));
    let id = Id::unique(("listed entry", matrix.letter(), row, column));
    if ui.memory(|memory| memory.has_focus(id))
        && let Some(text) = pasted_block(ui)
    {
        widgets.typing = None;
        out.edit(Edit::Network(NetworkEdit::Paste { cell, text }));
        return;
    }
    ui.horizontal(|ui| {
        ui.add_sized([110.0, ui.spacing().interact_size.y], egui::Label::new(format!("{name} =")));
        if let Some(text) = text_field(ui, widgets, (id, &name), &shown, draft, 90.0) {
            out.edit(Edit::Network(NetworkEdit::Cell { cell, text }));
        }
        if matrix == NetworkMatrix::Gamma && row != column {
            formula::remark(ui, &format!("listens to {}", column + 1));
        }
    });
    if let Some(draft) = draft {
        ui.colored_label(theme::bad(ui), format!("{name}: {}", draft.error));
    }
}
