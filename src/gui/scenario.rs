//! The transport strip: horizon, initial state, inputs, noise and uncertainty of the simulation.

use egui::{CollapsingHeader, DragValue, Id, Response, Slider, Ui};

use super::text_field::text_field;
use super::{Output, Widgets, theme};
use crate::document::limits::MAX_SIDE;
use crate::document::{Document, EntryMatrix, Matrix, PlantData, ScenarioData};
use crate::session::{Edit, Field, Session, SignalList};
use crate::system::{Signal, TimeDomain};

/// Grids of the uncertainty beyond this size are edited in the document.
const LARGEST_GRID: usize = 12;
const SIGNAL_WIDTH: f32 = 150.0;

/// Draws the strip; one line when it is collapsed.
pub fn show(ui: &mut Ui, session: &Session, widgets: &mut Widgets, out: &mut Output) {
    let document = session.document();
    let sizes = Sizes::of(document);
    let screen = ui.ctx().content_rect();
    let roomy = screen.height() > 640.0 && screen.width() > theme::NARROW;
    let summary = clipped(summary(&document.scenario, sizes.discrete), ui.available_width());
    CollapsingHeader::new(summary).id_salt("scenario").default_open(roomy).show_unindented(ui, |ui| {
        ui.spacing_mut().item_spacing.y = 4.0;
        ui.horizontal_wrapped(|ui| levels(ui, &document.scenario, &sizes, out));
        ui.horizontal_wrapped(|ui| {
            signals(ui, session, widgets, (SignalList::Known, sizes.inputs), out);
            signals(ui, session, widgets, (SignalList::Unknown, sizes.unknown), out);
        });
        ui.horizontal_wrapped(|ui| initial(ui, session, widgets, sizes.states, out));
        errors(ui, session, &sizes);
        if let Some(data) = &document.scenario.uncertainty {
            CollapsingHeader::new("Amplitudes and frequencies of the uncertainty")
                .id_salt("uncertainty")
                .show(ui, |ui| {
                    uncertainty_grid(ui, session, widgets, (&data.amplitude, false), out);
                    uncertainty_grid(ui, session, widgets, (&data.frequency, true), out);
                });
        }
    });
}

/// Sizes that the fields follow.
struct Sizes {
    discrete: bool,
    states: usize,
    inputs: usize,
    unknown: usize,
    outputs: usize,
    editable: bool,
}

impl Sizes {
    fn of(document: &Document) -> Self {
        match &document.plant {
            PlantData::Descriptor(data) => Self {
                discrete: data.time == TimeDomain::Discrete,
                states: data.matrix(Matrix::E).shape().1,
                inputs: data.matrix(Matrix::B).shape().1,
                unknown: data.matrix(Matrix::D).shape().1,
                outputs: data.matrix(Matrix::C).shape().0,
                editable: true,
            },
            // where the subsystems start stands with each of them
            plant @ PlantData::Network(_) => {
                let outputs = crate::document::Sizes::of(plant).outputs;
                let outputs = if outputs > MAX_SIDE { 0 } else { outputs };
                Self { discrete: false, states: 0, inputs: 0, unknown: 0, outputs, editable: false }
            }
        }
    }
}

fn summary(scenario: &ScenarioData, discrete: bool) -> String {
    let unit = if discrete { "steps" } else { "s" };
    let mut text = format!("Scenario: {} {unit}", super::plot::short(scenario.horizon));
    for (letter, signals) in [("u", &scenario.u), ("d", &scenario.d)] {
        for (k, signal) in signals.iter().enumerate().take(2) {
            let shown: String = signal.text().chars().take(28).collect();
            text.extend([", ", letter, &(k + 1).to_string(), " = ", &shown]);
        }
    }
    text
}

/// A header does not wrap: one that is too long would make the whole place wider than a narrow screen.
fn clipped(text: String, width: f32) -> String {
    const CHARACTER: f32 = 7.5;
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a small count, not negative"
    )]
    let fits = ((width / CHARACTER).max(12.0)) as usize - 6;
    if text.chars().count() <= fits {
        return text;
    }
    text.chars().take(fits).chain("...".chars()).collect()
}

/// Whether a change by dragging ends with this frame.
fn done(response: &Response) -> bool {
    !response.dragged()
}

/// Widgets that stay together when a line wraps.
fn group(ui: &mut Ui, width: f32, content: impl FnOnce(&mut Ui)) {
    let size = egui::vec2(width.min(ui.max_rect().width()), ui.spacing().interact_size.y);
    ui.allocate_ui_with_layout(size, egui::Layout::left_to_right(egui::Align::Center), content);
}

fn named(response: &Response, name: &str) {
    response.ctx.accesskit_node_builder(response.id, |node| node.set_label(name));
}

fn levels(ui: &mut Ui, scenario: &ScenarioData, sizes: &Sizes, out: &mut Output) {
    group(ui, 130.0, |ui| {
        let mut horizon = scenario.horizon;
        let value = DragValue::new(&mut horizon)
            .range(1e-3..=crate::document::limits::MAX_HORIZON)
            .speed(if sizes.discrete { 0.5 } else { 0.01 * scenario.horizon.max(1e-3) })
            .max_decimals(if sizes.discrete { 0 } else { 4 })
            .suffix(if sizes.discrete { " steps" } else { " s" });
        ui.label("Horizon");
        let response = ui.add(value);
        named(&response, "Horizon");
        if response.changed() {
            out.edit(Edit::Horizon(horizon));
        }
    });
    if !sizes.discrete {
        group(ui, 110.0, |ui| {
            let mut samples = scenario.samples;
            ui.label("samples");
            let response = ui.add(DragValue::new(&mut samples).range(2..=20_000).speed(5.0));
            named(&response, "Samples");
            if response.changed() {
                out.edit(Edit::Samples(samples));
            }
        });
    }
    ui.spacing_mut().slider_width = 72.0;
    if sizes.outputs > 0 {
        group(ui, 175.0, |ui| noise(ui, scenario, out));
    }
    if !sizes.editable {
        return;
    }
    group(ui, 220.0, |ui| uncertainty(ui, scenario, out));
}

fn uncertainty(ui: &mut Ui, scenario: &ScenarioData, out: &mut Output) {
    let scale = scenario.uncertainty.as_ref().map_or(0.0, |data| data.scale);
    let mut wanted = scale;
    ui.label("uncertainty");
    let slider = Slider::new(&mut wanted, 0.0..=10.0)
        .clamping(egui::SliderClamping::Edits)
        .prefix("x ")
        .step_by(0.1)
        .fixed_decimals(1);
    let response = ui
        .add(slider)
        .on_hover_text("Factor on the time-varying uncertainty of A, which the observer does not know");
    named(&response, "Uncertainty");
    if response.changed() && wanted != scale || response.drag_stopped() {
        out.edit(Edit::UncertaintyScale { scale: wanted, done: done(&response) });
    }
}

fn noise(ui: &mut Ui, scenario: &ScenarioData, out: &mut Output) {
    let level = noise_level(&scenario.noise);
    let mut wanted = level.unwrap_or(0.0);
    ui.label("noise");
    let slider = Slider::new(&mut wanted, 0.0..=1.0)
        .logarithmic(true)
        .smallest_positive(1e-4)
        .clamping(egui::SliderClamping::Edits)
        .custom_formatter(|value, _| super::plot::short(value));
    let hint = match level {
        Some(_) => "Standard deviation of the noise on every output",
        None => "The document has noise of its own; moving this replaces it",
    };
    let response = ui.add(slider).on_hover_text(hint);
    named(&response, "Noise");
    if response.changed() && level != Some(wanted) || response.drag_stopped() {
        out.edit(Edit::NoiseLevel { deviation: wanted, done: done(&response) });
    }
}

/// The standard deviation of noise as this strip sets it; `None` for noise of another form.
fn noise_level(noise: &[Signal]) -> Option<f64> {
    let Some(first) = noise.first() else { return Some(0.0) };
    let (deviation, _) = first.text().split_once("*noise(")?;
    let level: f64 = deviation.trim().parse().ok()?;
    let same = |signal: &Signal| signal.text().split_once("*noise(").is_some_and(|(d, _)| d == deviation);
    noise.iter().all(same).then_some(level)
}

/// Letter of a list of signals.
fn letter(list: SignalList) -> &'static str {
    match list {
        SignalList::Known => "u",
        SignalList::Unknown => "d",
        SignalList::Noise => "noise",
    }
}

fn signals(
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
fn shapes(ui: &mut Ui, horizon: f64, name: &str, mut choose: impl FnMut(String)) {
    let short = |value: f64| super::plot::short(value);
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

fn initial(ui: &mut Ui, session: &Session, widgets: &mut Widgets, states: usize, out: &mut Output) {
    if states == 0 {
        return;
    }
    let x0 = &session.document().scenario.x0;
    ui.label("x(0) =");
    for state in 0..states {
        let shown = x0.get(state).map_or_else(|| "0".to_owned(), crate::document::Entry::shown);
        let draft = session.draft(&Field::Initial(state));
        let id = Id::unique(("initial", state));
        let name = format!("x{}(0)", state + 1);
        if let Some(text) = text_field(ui, widgets, (id, &name), &shown, draft, theme::CELL_WIDTH) {
            out.edit(Edit::Initial { state, text });
        }
    }
}

/// What is not understood, below the fields.
fn errors(ui: &mut Ui, session: &Session, sizes: &Sizes) {
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

fn uncertainty_grid(
    ui: &mut Ui,
    session: &Session,
    widgets: &mut Widgets,
    (matrix, frequency): (&EntryMatrix, bool),
    out: &mut Output,
) {
    let what = if frequency { "frequency" } else { "amplitude" };
    ui.label(if frequency { "Frequencies in Hz" } else { "Relative amplitudes" });
    let (rows, columns) = matrix.shape();
    if rows.max(columns) > LARGEST_GRID {
        ui.colored_label(theme::faint(ui), format!("{rows} x {columns}: too large to be edited here"));
        return;
    }
    egui::Grid::new(("uncertainty", frequency)).spacing([3.0, 3.0]).show(ui, |ui| {
        for row in 0..rows {
            for column in 0..columns {
                let shown = matrix.entry(row, column).map(crate::document::Entry::shown).unwrap_or_default();
                let draft = session.draft(&Field::Uncertainty(row, column, frequency));
                let id = Id::unique(("uncertainty", row, column, frequency));
                let name = format!("{what}[{}, {}]", row + 1, column + 1);
                if let Some(text) = text_field(ui, widgets, (id, &name), &shown, draft, theme::CELL_WIDTH) {
                    out.edit(Edit::UncertaintyCell { row, column, frequency, text });
                }
            }
            ui.end_row();
        }
    });
    for row in 0..rows {
        for column in 0..columns {
            if let Some(draft) = session.draft(&Field::Uncertainty(row, column, frequency)) {
                let name = format!("{what}[{}, {}]", row + 1, column + 1);
                ui.colored_label(theme::bad(ui), format!("{name}: {}", draft.error));
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_level_of_noise_is_read_back() {
        let signal = |text: &str| Signal::parse(text).expect("a signal");
        assert_eq!(noise_level(&[]), Some(0.0), "no noise");
        let both = [signal("0.02*noise(t/0.02, 1)"), signal("0.02*noise(t/0.02, 2)")];
        assert_eq!(noise_level(&both), Some(0.02), "set by the slider");
        assert_eq!(noise_level(&[signal("sin(50*t)")]), None, "of another form");
    }
}
