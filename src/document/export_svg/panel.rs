//! One pair of axes with its curves.

use super::curve::{Frame, decimal, path, pieces};
use super::legend::legend;
use super::scale::Scale;
use super::stroke::Stroke;
use super::text::{self, Anchor};
use crate::paper::{Axis, Panel};

const SIZE: f64 = 10.0;
const LABEL: f64 = 11.0;

/// Draws a panel into a rectangle.
pub(super) fn panel(panel: &Panel, outer: &Frame) -> String {
    let above = if panel.title.is_empty() { 10.0 } else { 24.0 };
    let below = if panel.x.label.is_empty() { 24.0 } else { 40.0 };
    let frame = Frame {
        left: outer.left + if panel.y.label.is_empty() { 48.0 } else { 64.0 },
        top: outer.top + above,
        right: outer.right - 12.0,
        bottom: outer.bottom - below,
    };
    let horizontal = limits_x(panel);
    let x = Scale::new(horizontal, panel.x.logarithmic, [frame.left, frame.right]);
    let y = Scale::new(limits_y(panel, horizontal), panel.y.logarithmic, [frame.bottom, frame.top]);

    let mut svg = String::from("<g>\n");
    grid(&mut svg, &x, &y, &frame);
    let curves: Vec<Vec<Vec<[f64; 2]>>> =
        panel.series.iter().map(|series| pieces(&series.points, &x, &y, &frame)).collect();
    for (series, pieces) in panel.series.iter().zip(&curves) {
        if !pieces.is_empty() {
            svg.push_str(&Stroke::of(series, &panel.series).path(&path(pieces)));
        }
    }
    svg.push_str(&border(&frame));
    names(&mut svg, panel, outer, &frame);
    let entries = legend_entries(panel);
    svg.push_str(&legend(&entries, &frame, &curves.concat()));
    svg.push_str("</g>\n");
    svg
}

/// The box of the axes.
fn border(frame: &Frame) -> String {
    format!(
        "<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" fill=\"none\" stroke=\"#444\" stroke-width=\"0.8\"/>\n",
        decimal(frame.left),
        decimal(frame.top),
        decimal(frame.right - frame.left),
        decimal(frame.bottom - frame.top)
    )
}

/// A line of the grid.
fn grid_line(from: [f64; 2], to: [f64; 2], major: bool) -> String {
    let (colour, width) = if major { ("#d0d0d0", "0.6") } else { ("#ececec", "0.5") };
    let [ax, ay, bx, by] = [from[0], from[1], to[0], to[1]].map(decimal);
    format!("<path d=\"M{ax} {ay}L{bx} {by}\" stroke=\"{colour}\" stroke-width=\"{width}\"/>\n")
}

/// Named curves, unless there is a single one that the title already names.
fn legend_entries(panel: &Panel) -> Vec<(&str, Stroke)> {
    let series = panel.series.iter().filter(|series| !series.name.is_empty());
    let entries: Vec<(&str, Stroke)> =
        series.map(|series| (series.name.as_str(), Stroke::of(series, &panel.series))).collect();
    match entries.as_slice() {
        [(name, _)] if *name == panel.title => Vec::new(),
        _ => entries,
    }
}

fn names(svg: &mut String, panel: &Panel, outer: &Frame, frame: &Frame) {
    let (middle, centre) = (f64::midpoint(frame.left, frame.right), f64::midpoint(frame.top, frame.bottom));
    if !panel.title.is_empty() {
        svg.push_str(&text::bold([middle, frame.top - 7.0], LABEL, Anchor::Middle, &panel.title));
    }
    if !panel.x.label.is_empty() {
        svg.push_str(&text::text([middle, frame.bottom + 30.0], LABEL, Anchor::Middle, &panel.x.label));
    }
    if !panel.y.label.is_empty() {
        svg.push_str(&text::upwards([outer.left + 14.0, centre], LABEL, &panel.y.label));
    }
}

/// Grid lines and tick labels.
fn grid(svg: &mut String, x: &Scale, y: &Scale, frame: &Frame) {
    let (mut horizontal, mut vertical) = (x.usual_ticks(), y.ticks(30.0));
    // the minor grid lies beneath the major one
    horizontal.sort_by_key(|tick| tick.label.is_some());
    vertical.sort_by_key(|tick| tick.label.is_some());
    for (tick, at) in horizontal.iter().filter_map(|tick| Some((tick, x.pixel(tick.value)?))) {
        svg.push_str(&grid_line([at, frame.top], [at, frame.bottom], tick.label.is_some()));
    }
    for (tick, at) in vertical.iter().filter_map(|tick| Some((tick, y.pixel(tick.value)?))) {
        svg.push_str(&grid_line([frame.left, at], [frame.right, at], tick.label.is_some()));
    }
    for tick in &horizontal {
        if let (Some(label), Some(at)) = (&tick.label, x.pixel(tick.value)) {
            svg.push_str(&text::label([at, frame.bottom + 14.0], SIZE, Anchor::Middle, label));
        }
    }
    for tick in &vertical {
        if let (Some(label), Some(at)) = (&tick.label, y.pixel(tick.value)) {
            svg.push_str(&text::label([frame.left - 5.0, at + 0.35 * SIZE], SIZE, Anchor::End, label));
        }
    }
}

fn limits_x(panel: &Panel) -> [f64; 2] {
    panel.x.range.unwrap_or_else(|| {
        let xs = panel.series.iter().flat_map(|s| &s.points).map(|p| p[0]);
        extent(xs, &panel.x).unwrap_or(if panel.x.logarithmic { [0.1, 10.0] } else { [0.0, 1.0] })
    })
}

/// Limits that fit the points between the horizontal ones, with a little air.
fn limits_y(panel: &Panel, [left, right]: [f64; 2]) -> [f64; 2] {
    const AIR: f64 = 0.06;
    panel.y.range.unwrap_or_else(|| {
        let inside = panel.series.iter().flat_map(|s| &s.points).filter(|p| p[0] >= left && p[0] <= right);
        match extent(inside.map(|p| p[1]), &panel.y) {
            Some([low, high]) if panel.y.logarithmic => {
                let air = (high / low).powf(AIR);
                [low / air, high * air]
            }
            Some([low, high]) => [low - AIR * (high - low), high + AIR * (high - low)],
            None if panel.y.logarithmic => [0.1, 10.0],
            None => [-1.0, 1.0],
        }
    })
}

/// Smallest and largest value that an axis can show.
fn extent(values: impl Iterator<Item = f64>, axis: &Axis) -> Option<[f64; 2]> {
    let shown = values.filter(|x| x.is_finite() && (!axis.logarithmic || *x > 0.0));
    shown.fold(None, |limits: Option<[f64; 2]>, x| {
        Some(limits.map_or([x, x], |[low, high]| [low.min(x), high.max(x)]))
    })
}
