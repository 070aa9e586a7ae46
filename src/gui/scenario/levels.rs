//! Horizon, samples, noise and uncertainty.

use egui::{DragValue, Response, Slider, Ui};

use super::super::{Output, plot};
use super::{Sizes, group, named};
use crate::document::ScenarioData;
use crate::session::Edit;
use crate::system::Signal;

/// Whether a change by dragging ends with this frame.
fn done(response: &Response) -> bool {
    !response.dragged()
}

/// Draws what applies to the scenario as a whole.
pub(super) fn levels(ui: &mut Ui, scenario: &ScenarioData, sizes: &Sizes, out: &mut Output) {
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
        .custom_formatter(|value, _| plot::short(value));
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
