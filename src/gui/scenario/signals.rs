//! Signals over time and the initial state.

use egui::{Id, Ui};

use super::super::text_field::text_field;
use super::super::{Output, Widgets, plot, theme};
use super::{Sizes, group, named};
use crate::document::Entry;
use crate::session::{Edit, Field, Session, SignalList};
use crate::system::Signal;

pub(super) const SIGNAL_WIDTH: f32 = 150.0;

/// Letter of a list of signals.
fn letter(list: SignalList) -> &'static str {
    match list {
        SignalList::Known => "u",
        SignalList::Unknown => "d",
        SignalList::Noise => "noise",
    }
}

/// Draws a field for each signal of a list.
pub(super) fn signals(
    ui: &mut Ui,
    session: &Session,
    widgets: &mut Widgets,
    (list, count): (SignalList, usize),
    out: &mut Output,
) {
    let scenario = &session.document().scenario;
    let present = match list {
        SignalList::Known => &scenario.u,
        SignalList::Unknown => &scenario.d,
        SignalList::Noise => &scenario.noise,
    };
    for index in 0..count {
        let name = format!("{}{}", letter(list), index + 1);
        let shown = present.get(index).map_or("0", Signal::text);
        group(ui, SIGNAL_WIDTH + 88.0, |ui| {
            ui.label(format!("{name}(t) ="));
            let draft = session.draft(&Field::Signal(list, index));
            let id = Id::unique(("signal", list as u8, index));
            if let Some(text) = text_field(ui, widgets, (id, &name), shown, draft, SIGNAL_WIDTH) {
                out.edit(Edit::Signal { list, index, text });
            }
            shapes(ui, scenario.horizon, &name, |text| {
                out.edit(Edit::Signal { list, index, text });
            });
        });
    }
}

/// A menu of usual inputs, fitted to the horizon.
pub(super) fn shapes(ui: &mut Ui, horizon: f64, name: &str, mut choose: impl FnMut(String)) {
    let short = |value: f64| plot::short(value);
    let rounded = |value: f64| short(format!("{value:.0e}").parse().unwrap_or(value));
    let menu = ui.menu_button("...", |ui| {
        let omega = rounded(4.0 * std::f64::consts::PI / horizon);
        for (title, text) in [
            ("Step", format!("step(t-{})", rounded(horizon / 3.0))),
            ("Pulse", format!("pulse(t, {}, {})", rounded(horizon / 4.0), rounded(horizon / 2.0))),
            ("Sine", format!("sin({omega}*t)")),
            ("Square", format!("square({omega}*t)")),
            ("Constant", "1".to_owned()),
            ("Zero", "0".to_owned()),
        ] {
            if ui.button(title).on_hover_text(&text).clicked() {
                choose(text);
                ui.close();
            }
        }
    });
    named(&menu.response, &format!("shapes for {name}"));
}

/// Draws a field for each component of the initial state.
pub(super) fn initial(
    ui: &mut Ui,
    session: &Session,
    widgets: &mut Widgets,
    states: usize,
    out: &mut Output,
) {
    if states == 0 {
        return;
    }
    let scenario = &session.document().scenario;
    let x0 = &scenario.x0;
    let formula = scenario.x0_formula.as_ref().filter(|_| x0.is_empty());
    let values = formula.map_or_else(Vec::new, |formula| formula.values(states));
    ui.label("x(0) =");
    for state in 0..states {
        let computed = || values.get(state).map_or(Entry::number(0.0), |value| Entry::number(*value));
        let shown = x0.get(state).cloned().unwrap_or_else(computed).shown();
        let draft = session.draft(&Field::Initial(state));
        let id = Id::unique(("initial", state));
        let name = format!("x{}(0)", state + 1);
        if let Some(text) = text_field(ui, widgets, (id, &name), &shown, draft, theme::CELL_WIDTH) {
            out.edit(Edit::Initial { state, text });
        }
    }
}

/// What is not understood, below the fields.
pub(super) fn errors(ui: &mut Ui, session: &Session, sizes: &Sizes) {
    let mut say = |name: String, field: &Field| {
        if let Some(draft) = session.draft(field) {
            ui.colored_label(theme::bad(ui), format!("{name}: {}", draft.error));
        }
    };
    for (list, count) in [(SignalList::Known, sizes.inputs), (SignalList::Unknown, sizes.unknown)] {
        for index in 0..count {
            say(format!("{}{}", letter(list), index + 1), &Field::Signal(list, index));
        }
    }
    for state in 0..sizes.states {
        say(format!("x{}(0)", state + 1), &Field::Initial(state));
    }
}
