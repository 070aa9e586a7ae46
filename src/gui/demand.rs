//! A number with a slider and a field, as the demands on a design are set.

use std::ops::RangeInclusive;

use egui::{DragValue, Response, Slider, Ui};

use super::theme;

/// Room for the name in front of a slider.
const NAME: f32 = 92.0;
/// Room for the number behind it.
const NUMBER: f32 = 64.0;

/// A number that a slider sets.
pub(super) struct Demand<'a> {
    /// Accessible name; the field beside the slider is called `name value`.
    pub name: &'a str,
    /// What the slider covers; the field takes more.
    pub range: RangeInclusive<f64>,
    /// Equal distances are equal factors.
    pub logarithmic: bool,
    /// What stands behind the number.
    pub suffix: &'a str,
    /// Explanation.
    pub hint: &'a str,
    /// The part of the slider that cannot be reached, and why.
    pub beyond: Option<(RangeInclusive<f64>, String)>,
}

/// Draws slider and field for a value that is in force; the new value and whether the drag ends with it.
pub(super) fn demand(ui: &mut Ui, value: f64, demand: &Demand<'_>) -> Option<(f64, bool)> {
    let mut wanted = value;
    ui.spacing_mut().slider_width = (ui.available_width() - NUMBER - 2.0 * theme::ITEM_GAP).max(60.0);
    let slider = Slider::new(&mut wanted, demand.range.clone())
        .logarithmic(demand.logarithmic)
        .show_value(false)
        .clamping(egui::SliderClamping::Never);
    let rail = ui.add(slider);
    named(&rail, demand.name);
    beyond(ui, &rail, demand);
    let hint = demand
        .beyond
        .as_ref()
        .map_or_else(|| demand.hint.to_owned(), |(_, why)| format!("{}\n{why}", demand.hint));
    let rail = rail.on_hover_text(hint);
    let speed = if demand.logarithmic { 0.01 * value.abs().max(1e-6) } else { 0.005 };
    let field = DragValue::new(&mut wanted)
        .speed(speed)
        .suffix(demand.suffix)
        .custom_formatter(|value, _| super::plot::short(value));
    let field = ui.add_sized([NUMBER, ui.spacing().interact_size.y], field);
    named(&field, &format!("{} value", demand.name));
    let changed = [&rail, &field].into_iter().any(|response| response.changed() || response.drag_stopped());
    let dragged = rail.dragged() || field.dragged();
    changed.then_some((wanted, !dragged))
}

fn named(response: &Response, name: &str) {
    response.ctx.accesskit_node_builder(response.id, |node| node.set_label(name));
}

/// Greys out what cannot be reached.
fn beyond(ui: &Ui, rail: &Response, demand: &Demand<'_>) {
    let Some((range, _)) = &demand.beyond else { return };
    let place = |value: f64| {
        let (low, high) = (*demand.range.start(), *demand.range.end());
        let share = if demand.logarithmic {
            (value.max(low) / low).ln() / (high / low).ln()
        } else {
            (value - low) / (high - low)
        };
        #[expect(clippy::cast_possible_truncation, reason = "a position on the screen")]
        let share = share.clamp(0.0, 1.0) as f32;
        rail.rect.left() + share * rail.rect.width()
    };
    let (from, to) = (place(*range.start()), place(*range.end()));
    if to - from < 1.0 {
        return;
    }
    let area = egui::Rect::from_x_y_ranges(from..=to, rail.rect.y_range());
    ui.painter().rect_filled(area, 2.0, ui.visuals().panel_fill.gamma_multiply(0.72));
    let border = if from > rail.rect.left() + 1.0 { from } else { to };
    ui.painter().vline(border, rail.rect.y_range(), egui::Stroke::new(1.5, theme::near(ui)));
}

/// A line that begins with a name, or with a box that switches the demand on and off.
pub(super) fn line<R>(ui: &mut Ui, content: impl FnOnce(&mut Ui) -> R) -> R {
    ui.horizontal(content).inner
}

/// A name in front of a demand that is always there.
pub(super) fn name(ui: &mut Ui, text: &str, hint: &str) {
    let size = egui::vec2(NAME, ui.spacing().interact_size.y);
    let layout = egui::Layout::left_to_right(egui::Align::Center);
    ui.allocate_ui_with_layout(size, layout, |ui| {
        ui.set_min_width(NAME);
        ui.label(text).on_hover_text(hint);
    });
}

/// A box in front of a demand that can be taken away; the new state when it was clicked.
pub(super) fn switch(ui: &mut Ui, on: bool, text: &str, hint: &str) -> Option<bool> {
    let mut wanted = on;
    let size = egui::vec2(NAME, ui.spacing().interact_size.y);
    let layout = egui::Layout::left_to_right(egui::Align::Center);
    let clicked = ui
        .allocate_ui_with_layout(size, layout, |ui| {
            ui.set_min_width(NAME);
            ui.checkbox(&mut wanted, text).on_hover_text(hint).changed()
        })
        .inner;
    clicked.then_some(wanted)
}
