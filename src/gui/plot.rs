//! Draws figures: a grid of panels with linked axes, a legend that hides curves, and a read-out under the pointer.

use egui::{Align2, FontId, Id, PointerButton, Pos2, Role as Access, Sense, Stroke, Ui, Vec2, vec2};
use egui_plot::{AxisHints, GridInput, GridMark, Plot, PlotItem as _, PlotResponse};

use super::curve::{Curve, is_discrete, line, value_at};
use super::theme;
use crate::paper::{FigureSpec, Panel, Series};

/// Panels are not drawn narrower or lower than this.
const LEAST_WIDTH: f32 = 185.0;
const LEAST_HEIGHT: f32 = 150.0;
/// What the last label of the horizontal axis, centred below the edge of the plot, takes to the right of it.
const LABEL_OVERHANG: f32 = 10.0;
/// Labels of a logarithmic axis keep this distance, in points.
const LABEL_DISTANCE: f64 = 44.0;
/// Height of the line with title and legend above a panel, where it does not wrap.
const TITLE_HEIGHT: f32 = 22.0;

/// Draws a figure with its remarks; the panels fill the height that is left, and scroll when it is too small.
pub fn figure_ui(ui: &mut Ui, figure: &FigureSpec, id_salt: &str) {
    notes_ui(ui, &figure.notes);
    if !figure.caption.is_empty() {
        ui.label(&figure.caption);
    }
    if !figure.see.is_empty() {
        ui.colored_label(theme::accent(ui), &figure.see);
    }
    let panels: Vec<&Panel> = figure.panels.iter().collect();
    egui::ScrollArea::vertical()
        .id_salt((id_salt, &figure.id))
        .auto_shrink([false, false])
        .show(ui, |ui| panels_ui(ui, &panels, figure.columns, &format!("{id_salt} {}", figure.id)));
}

/// Draws remarks of a computation in amber.
pub fn notes_ui(ui: &mut Ui, notes: &[String]) {
    for note in notes {
        ui.colored_label(theme::near(ui), note);
    }
}

/// Draws panels side by side into the height that is left, without scrolling of their own.
pub fn panels_ui(ui: &mut Ui, panels: &[&Panel], columns: usize, id_salt: &str) {
    if panels.is_empty() {
        ui.colored_label(theme::faint(ui), "nothing to draw");
        return;
    }
    let gap = theme::ITEM_GAP;
    let width = ui.available_width();
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a small positive number")]
    let fitting = ((width + gap) / (LEAST_WIDTH + gap)).floor().max(1.0) as usize;
    let wished = columns.clamp(1, panels.len().max(1));
    // where not all fit, an even share keeps related panels below each other
    let columns = (1..=wished).rev().find(|k| *k <= fitting && wished.is_multiple_of(*k)).unwrap_or(1);
    let rows = panels.len().div_ceil(columns);
    let height = ((ui.available_height() - gap) / rows as f32 - gap).max(LEAST_HEIGHT);
    let panel_width = (width - gap * (columns - 1) as f32) / columns as f32;
    for (row, row_panels) in panels.chunks(columns).enumerate() {
        // a row with a panel that has none below it is labelled as a whole, so that its panels have one height
        let x_label = (row + 1) * columns + row_panels.len() > panels.len();
        ui.horizontal_top(|ui| {
            ui.spacing_mut().item_spacing.x = gap;
            for (column, panel) in row_panels.iter().enumerate() {
                let at = row * columns + column;
                panel_ui(ui, panel, &Place { id_salt, at, size: vec2(panel_width, height), x_label });
            }
        });
    }
}

/// Where and as what a panel is drawn.
#[derive(Clone, Copy, Debug)]
pub struct Place<'a> {
    /// Name of the figure, which keeps the state of its panels and links their axes.
    pub id_salt: &'a str,
    /// Number of the panel in its figure.
    pub at: usize,
    /// Size with title.
    pub size: Vec2,
    /// Whether the horizontal axis is labelled.
    pub x_label: bool,
}

/// Draws one pair of axes with title and legend above.
pub fn panel_ui(ui: &mut Ui, panel: &Panel, place: &Place<'_>) {
    let id = Id::unique(("panel", place.id_salt, place.at));
    let hidden_before = ui.data(|data| data.get_temp::<u64>(id)).unwrap_or(0);
    let mut hidden = hidden_before;
    ui.allocate_ui_with_layout(place.size, egui::Layout::top_down(egui::Align::Min), |ui| {
        ui.set_width(place.size.x);
        ui.spacing_mut().item_spacing.y = 2.0;
        let top = ui.cursor().top();
        ui.horizontal_wrapped(|ui| {
            ui.spacing_mut().item_spacing = vec2(10.0, 0.0);
            ui.set_min_height(TITLE_HEIGHT - 2.0);
            if !panel.title.is_empty() {
                ui.strong(&panel.title);
            }
            for (k, series) in panel.series.iter().enumerate().take(64) {
                legend_entry(ui, series, id, (k, &mut hidden));
            }
        });
        let used = ui.cursor().top() - top;
        let height = (place.size.y - used).max(LEAST_HEIGHT - TITLE_HEIGHT);
        plot(ui, panel, place, (height, hidden_before));
    });
    if hidden != hidden_before {
        ui.data_mut(|data| data.insert_temp(id, hidden));
    }
}

fn is_hidden(hidden: u64, k: usize) -> bool {
    k < 64 && hidden >> k & 1 == 1
}

/// A sample of the line and the name of the curve; a click hides the curve.
fn legend_entry(ui: &mut Ui, series: &Series, id: Id, (k, hidden): (usize, &mut u64)) {
    const SAMPLE: f32 = 22.0;
    let font = egui::TextStyle::Small.resolve(ui.style());
    let is_off = is_hidden(*hidden, k);
    let text_colour = if is_off { theme::faint(ui) } else { ui.visuals().text_color() };
    let galley = ui.painter().layout_no_wrap(series.name.clone(), font, text_colour);
    let size = vec2(SAMPLE + 4.0 + galley.size().x, galley.size().y.max(18.0));
    let (_, rect) = ui.allocate_space(size);
    let response = ui.interact(rect, id.with(k), Sense::click());
    response.widget_info(|| egui::WidgetInfo::selected(Access::CheckBox, true, !is_off, &series.name));
    if response.clicked() {
        *hidden ^= 1 << k;
    }
    let colour = if is_off { theme::faint(ui).gamma_multiply(0.5) } else { theme::series(ui, series.colour) };
    let middle = rect.center().y;
    let path = vec![Pos2::new(rect.left(), middle), Pos2::new(rect.left() + SAMPLE, middle)];
    let mut shapes = Vec::new();
    line(path, series.role, Stroke::new(2.0, colour), &mut shapes);
    ui.painter().extend(shapes);
    let corner = Pos2::new(rect.left() + SAMPLE + 4.0, middle - galley.size().y / 2.0);
    ui.painter().galley(corner, galley, text_colour);
    if response.hovered() || response.has_focus() {
        ui.painter().hline(rect.x_range(), rect.bottom(), Stroke::new(1.0, theme::accent(ui)));
    }
    response.on_hover_cursor(egui::CursorIcon::PointingHand).on_hover_text("Click to hide or show");
}

fn plot(ui: &mut Ui, panel: &Panel, place: &Place<'_>, (height, hidden): (f32, u64)) {
    let logarithmic = panel.x.logarithmic;
    let group = Id::unique(("axes", place.id_salt, logarithmic, &panel.x.label));
    // on a touch screen a finger over a plot scrolls the page; with a mouse a drag chooses what to enlarge
    let touch = ui.input(egui::InputState::has_touch_screen);
    let mut plot = Plot::new((place.id_salt, place.at))
        .id(Id::unique(("plot", place.id_salt, place.at)))
        .width(place.size.x - LABEL_OVERHANG)
        .height(height)
        .sense(if touch { Sense::click() } else { Sense::click_and_drag() })
        .allow_scroll(false)
        .allow_drag(false)
        .allow_axis_zoom_drag(false)
        .allow_boxed_zoom(!touch)
        .boxed_zoom_pointer_button(PointerButton::Primary)
        .show_y(false)
        .set_margin_fraction(vec2(0.0, 0.07))
        .custom_x_axes(vec![x_axis(ui, panel, place)])
        .custom_y_axes(vec![y_axis(ui, panel, f64::from(height))])
        .y_grid_spacer(|input| lines(&input, 30.0))
        .grid_color(theme::faint(ui).gamma_multiply(0.35))
        .grid_fade(0.0)
        .link_axis(group, [true, false])
        .link_cursor(group, [true, false]);
    if panel.y.logarithmic {
        plot = plot.y_grid_spacer(decades);
    }
    plot = if logarithmic {
        plot.x_grid_spacer(decades)
    } else {
        plot.x_grid_spacer(|input| lines(&input, 56.0))
    };
    if let Some([low, high]) = panel.x.range {
        let place = |x: f64| if logarithmic { x.log10() } else { x };
        if place(low).is_finite() && place(high) > place(low) {
            plot = plot.default_x_bounds(place(low), place(high));
        }
    }
    let curves: Vec<Curve<'_>> = panel
        .series
        .iter()
        .enumerate()
        .filter(|(k, _)| !is_hidden(hidden, *k))
        .map(|(_, series)| Curve::new(series, theme::series(ui, series.colour), [&panel.x, &panel.y]))
        .collect();
    if let Some([low, high]) = panel.y.range.filter(|_| !panel.y.logarithmic) {
        plot = plot.default_y_bounds(low, high);
    } else if let Some([low, high]) = widened(&curves) {
        plot = plot.include_y(low).include_y(high);
    }
    let response = plot.show(ui, |plot| curves.into_iter().for_each(|curve| plot.add(curve)));
    let name = if panel.title.is_empty() { &panel.y.label } else { &panel.title };
    let names: Vec<&str> = panel.series.iter().map(|series| series.name.as_str()).collect();
    ui.ctx().accesskit_node_builder(response.response.id, |node| {
        node.set_role(Access::GraphicsDocument);
        node.set_label(format!("plot {name}: {}", names.join(", ")));
    });
    read_out(ui, panel, hidden, &response);
}

fn x_axis<'a>(ui: &Ui, panel: &Panel, place: &Place<'_>) -> AxisHints<'a> {
    let width = f64::from((place.size.x - 50.0).max(50.0));
    let logarithmic = panel.x.logarithmic;
    let label = if place.x_label { panel.x.label.as_str() } else { "" };
    axis(ui, AxisHints::new_x(), label).formatter(move |mark, range| {
        if logarithmic { decade(mark.value, range.end() - range.start(), width) } else { tick(mark.value) }
    })
}

fn y_axis<'a>(ui: &Ui, panel: &Panel, height: f64) -> AxisHints<'a> {
    let logarithmic = panel.y.logarithmic;
    axis(ui, AxisHints::new_y(), &panel.y.label).min_thickness(38.0).formatter(move |mark, range| {
        if logarithmic { decade(mark.value, range.end() - range.start(), height) } else { tick(mark.value) }
    })
}

fn axis<'a>(ui: &Ui, hints: AxisHints<'a>, label: &str) -> AxisHints<'a> {
    let small = egui::TextStyle::Small.resolve(ui.style());
    hints
        .label(egui::RichText::new(label).small())
        .label_spacing(4.0..=5.0)
        .tick_label_font(small)
        .tick_label_color(theme::faint(ui))
}

/// Limits around curves that hardly vary, so that rounding errors are not blown up to the height of the plot.
fn widened(curves: &[Curve<'_>]) -> Option<[f64; 2]> {
    let mut range: Option<[f64; 2]> = None;
    for bounds in curves.iter().map(Curve::bounds).filter(egui_plot::PlotBounds::is_finite_y) {
        let [low, high] = range.unwrap_or([f64::INFINITY, f64::NEG_INFINITY]);
        range = Some([low.min(bounds.min()[1]), high.max(bounds.max()[1])]);
    }
    let [low, high] = range?;
    let size = low.abs().max(high.abs());
    (high - low <= 1e-9 * size || size < 1e-14).then(|| {
        let pad = if size < 1e-14 { 1.0 } else { 0.1 * size };
        [low - pad, high + pad]
    })
}

/// The values of all curves at the pointer, in the upper corner away from it.
fn read_out(ui: &Ui, panel: &Panel, hidden: u64, response: &PlotResponse<()>) {
    let Some(pointer) = response.response.hover_pos() else { return };
    let at = response.transform.value_from_position(pointer).x;
    let discrete = is_discrete(&panel.x);
    let x = if panel.x.logarithmic { 10_f64.powf(at) } else { at };
    let x = if discrete && !panel.x.logarithmic { x.round() } else { x };
    let quantity = panel.x.label.split([' ', '(']).next().unwrap_or("x");
    let mut lines = vec![(format!("{quantity} = {}", short(x)), ui.visuals().text_color())];
    for (k, series) in panel.series.iter().enumerate() {
        if let Some(value) = value_at(&series.points, x, discrete).filter(|_| !is_hidden(hidden, k)) {
            lines.push((format!("{} = {}", series.name, short(value)), theme::series(ui, series.colour)));
        }
    }
    let frame = *response.transform.frame();
    let painter = ui.painter().with_clip_rect(frame.intersect(ui.clip_rect()));
    let font = FontId::proportional(12.0);
    let galleys: Vec<_> = lines
        .into_iter()
        .map(|(text, colour)| (painter.layout_no_wrap(text, font.clone(), colour), colour))
        .collect();
    let size = galleys
        .iter()
        .fold(Vec2::ZERO, |size, (galley, _)| vec2(size.x.max(galley.size().x), size.y + galley.size().y));
    let inner = frame.shrink(8.0);
    let left = pointer.x > frame.center().x;
    let (anchor, corner) =
        if left { (Align2::LEFT_TOP, inner.left_top()) } else { (Align2::RIGHT_TOP, inner.right_top()) };
    let rect = anchor.anchor_size(corner, size);
    painter.rect_filled(rect.expand(4.0), 4.0, ui.visuals().window_fill.gamma_multiply(0.88));
    let mut top = rect.min;
    for (galley, colour) in galleys {
        let step = galley.size().y;
        painter.galley(top, galley, colour);
        top.y += step;
    }
}

/// A number with four significant digits.
pub fn short(value: f64) -> String {
    let magnitude = value.abs();
    if value == 0.0 {
        "0".to_owned()
    } else if !(1e-3..1e5).contains(&magnitude) {
        format!("{value:.2e}")
    } else {
        let rounded: f64 = format!("{value:.3e}").parse().unwrap_or(value);
        format!("{rounded}")
    }
}

/// A guaranteed bound in the same digits, never below `value`.
pub fn short_up(value: f64) -> String {
    let nearest = short(value);
    if nearest.parse::<f64>().is_ok_and(|shown| shown >= value) {
        return nearest;
    }
    // one unit of the last digit that is shown
    let digits = if (1e-3..1e5).contains(&value.abs()) { 3.0 } else { 2.0 };
    short(value + 10_f64.powf(value.abs().log10().floor() - digits))
}

/// A tick of a linear axis.
fn tick(value: f64) -> String {
    let magnitude = value.abs();
    if magnitude < 1e-15 {
        "0".to_owned()
    } else if (1e-3..1e5).contains(&magnitude) {
        let rounded: f64 = format!("{value:.6e}").parse().unwrap_or(value);
        format!("{rounded}")
    } else {
        let rounded: f64 = format!("{value:.6e}").parse().unwrap_or(value);
        format!("{rounded:e}")
    }
}

/// Grid lines at multiples of 1, 2 or 5 times a power of ten, at least `apart` points from each other.
fn lines(input: &GridInput, apart: f64) -> Vec<GridMark> {
    // the plot gives eight points as its finest step
    let step = round_step(input.base_step_size / 8.0 * apart);
    multiples(step, input.bounds.0, input.bounds.1)
        .into_iter()
        .map(|value| GridMark { value, step_size: step })
        .collect()
}

/// The nearest of 1, 2, 5 times a power of ten, upwards.
pub(super) fn round_step(least: f64) -> f64 {
    let unit = 10_f64.powf(least.clamp(1e-300, 1e300).log10().floor());
    [1.0, 2.0, 5.0].into_iter().map(|factor| factor * unit).find(|step| *step >= least).unwrap_or(10.0 * unit)
}

/// The multiples of a step between two limits.
pub(super) fn multiples(step: f64, low: f64, high: f64) -> Vec<f64> {
    let first = (low / step - 1e-9).ceil();
    let count = (high / step + 1e-9).floor() - first;
    // adding zero turns -0 into 0
    (0..=200_u8).map(f64::from).take_while(|k| *k <= count).map(|k| (first + k) * step + 0.0).collect()
}

/// Lines of a logarithmic axis: decades, and 2 to 9 between them where few decades are shown.
///
/// The step of a decade is the distance of labels, since the plot leaves out labels that are higher or wider than the
/// step of their line.
#[expect(clippy::needless_pass_by_value, reason = "the signature of a grid spacer")]
fn decades(input: GridInput) -> Vec<GridMark> {
    let (low, high) = input.bounds;
    // the plot gives eight points as its finest step
    let every = decades_between_labels(high - low, (high - low) / input.base_step_size * 8.0);
    let digits = if high - low > 3.0 { 1..2_u8 } else { 1..10 };
    let mut marks = Vec::new();
    for decade in multiples(1.0, low.floor(), high) {
        for digit in digits.clone() {
            let value = decade + f64::from(digit).log10();
            marks.push(GridMark { value, step_size: if digit == 1 { every } else { 0.3 } });
        }
    }
    marks.retain(|mark| (low - 1e-9..=high + 1e-9).contains(&mark.value));
    marks
}

/// Label of a line of a logarithmic axis that shows `span` decades on `width` points.
///
/// Only decades have one, at least [`LABEL_DISTANCE`] apart, unless hardly more than one decade is shown.
fn decade(value: f64, span: f64, width: f64) -> String {
    let nearest = value.round();
    let whole = (value - nearest).abs() < 1e-9;
    let every = decades_between_labels(span, width);
    if whole && nearest.rem_euclid(every) > 0.5 || !whole && span > 1.2 {
        return String::new();
    }
    if (-3.5..4.5).contains(&value) { short(10_f64.powf(value)) } else { format!("1e{nearest}") }
}

fn decades_between_labels(span: f64, width: f64) -> f64 {
    (LABEL_DISTANCE * span / width).ceil().max(1.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short() {
        let shown = [0.0, 0.5, -22.0, 1.0 / 3.0, 1e-7, 123_456.0].map(short);
        assert_eq!(shown, ["0", "0.5", "-22", "0.3333", "1.00e-7", "1.23e5"], "four digits at most");
        assert_eq!([0.1 + 0.2, 1e6, 5e-17].map(tick), ["0.3", "1e6", "0"], "ticks without rounding errors");
    }

    #[test]
    fn logarithmic_axes_are_labelled_at_decades() {
        assert_eq!(
            [-2.0, 0.0, 3.0, 6.0].map(|v| decade(v, 5.0, 400.0)),
            ["0.01", "1", "1000", "1e6"],
            "powers of ten"
        );
        assert_eq!(decade(2_f64.log10(), 5.0, 400.0), "", "no label between decades");
        assert_eq!(decade(2_f64.log10(), 1.0, 400.0), "2", "unless hardly a decade is shown");
        let marks = decades(GridInput { bounds: (-0.5, 1.0), base_step_size: 0.1 });
        assert_eq!(marks.iter().filter(|mark| mark.step_size == 1.0).count(), 2, "1 and 10");
        // twelve decades on 140 points: 12 points are less than the height of a label
        let marks = decades(GridInput { bounds: (-3.0, 9.0), base_step_size: 12.0 / 140.0 * 8.0 });
        assert!(marks.iter().all(|mark| mark.step_size * 140.0 / 12.0 >= 44.0), "labels have room");
    }

    #[test]
    fn steps_are_round() {
        assert_eq!([0.7, 1.0, 1.3, 3.0, 7.0].map(round_step), [1.0, 1.0, 2.0, 5.0, 10.0], "1, 2, 5");
        assert_eq!(multiples(2.0, -3.0, 6.0), [-2.0, 0.0, 2.0, 4.0, 6.0], "with both ends");
    }

    #[test]
    fn a_constant_gets_room() {
        let series = Series { points: vec![[0.0, 5.0], [1.0, 5.0 + 1e-13]], ..Series::default() };
        let curve = [Curve::new(&series, egui::Color32::BLACK, [&crate::paper::Axis::default(); 2])];
        let [low, high] = widened(&curve).expect("widened");
        assert!(low < 4.6 && high > 5.4, "a tenth on either side: {low} {high}");
    }
}
