//! The transport strip: horizon, initial state, inputs, free states, noise and uncertainty of the simulation.

mod free;
mod levels;
mod signals;
mod uncertainty;

use egui::{CollapsingHeader, Response, Ui};

use super::observer::errata;
use super::{Output, Widgets, theme};
use crate::document::limits::MAX_SIDE;
use crate::document::{self, Document, Matrix, PlantData, ScenarioData};
use crate::paper::UNCERTAINTY;
use crate::session::{Derived, Session, SignalList};
use crate::system::TimeDomain;

/// Draws the strip; one line when it is collapsed.
pub fn show(ui: &mut Ui, session: &Session, derived: &Derived, widgets: &mut Widgets, out: &mut Output) {
    let document = session.document();
    let sizes = Sizes::of(document);
    let screen = ui.ctx().content_rect();
    let roomy = screen.height() > 640.0 && screen.width() > theme::NARROW;
    let summary = clipped(summary(&document.scenario, &sizes), ui.available_width());
    CollapsingHeader::new(summary).id_salt("scenario").default_open(roomy).show_unindented(ui, |ui| {
        ui.spacing_mut().item_spacing.y = 4.0;
        ui.horizontal_wrapped(|ui| levels::levels(ui, &document.scenario, &sizes, out));
        ui.horizontal_wrapped(|ui| {
            signals::signals(ui, session, widgets, (SignalList::Known, sizes.inputs), out);
            signals::signals(ui, session, widgets, (SignalList::Unknown, sizes.unknown), out);
        });
        ui.horizontal_wrapped(|ui| signals::initial(ui, session, widgets, sizes.states, out));
        signals::errors(ui, session, &sizes);
        free::show(ui, session, derived, widgets, out);
        if let Some(data) = &document.scenario.uncertainty {
            CollapsingHeader::new("Amplitudes and frequencies of the uncertainty")
                .id_salt("uncertainty")
                .show(ui, |ui| {
                    uncertainty::grid(ui, session, widgets, (&data.amplitude, false), out);
                    uncertainty::grid(ui, session, widgets, (&data.frequency, true), out);
                });
            errata::beside_example(ui, session, UNCERTAINTY, "the uncertainty");
        }
    });
}

/// Sizes that the fields follow.
struct Sizes {
    discrete: bool,
    states: usize,
    equations: usize,
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
                equations: data.matrix(Matrix::E).shape().0,
                inputs: data.matrix(Matrix::B).shape().1,
                unknown: data.matrix(Matrix::D).shape().1,
                outputs: data.matrix(Matrix::C).shape().0,
                editable: true,
            },
            // where the subsystems start stands with each of them
            plant @ PlantData::Network(_) => Self {
                discrete: false,
                states: 0,
                equations: 0,
                inputs: 0,
                unknown: 0,
                outputs: Some(document::Sizes::of(plant).outputs).filter(|n| *n <= MAX_SIDE).unwrap_or(0),
                editable: false,
            },
        }
    }
}

fn summary(scenario: &ScenarioData, sizes: &Sizes) -> String {
    let wide = sizes.equations < sizes.states;
    let unit = if sizes.discrete { "steps" } else { "s" };
    let mut text = format!("Scenario: {} {unit}", super::plot::short(scenario.horizon));
    let free = if wide { scenario.free.signals.as_slice() } else { &[] };
    for (letter, signals) in [("u", scenario.u.as_slice()), ("d", &scenario.d), ("v", free)] {
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

/// Widgets that stay together when a line wraps.
fn group(ui: &mut Ui, width: f32, content: impl FnOnce(&mut Ui)) {
    let size = egui::vec2(width.min(ui.max_rect().width()), ui.spacing().interact_size.y);
    ui.allocate_ui_with_layout(size, egui::Layout::left_to_right(egui::Align::Center), content);
}

fn named(response: &Response, name: &str) {
    response.ctx.accesskit_node_builder(response.id, |node| node.set_label(name));
}
