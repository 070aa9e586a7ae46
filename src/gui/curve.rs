//! A curve as an item of a plot: borrows its points, clips and thins them to what the screen can show.

use egui::{Color32, Pos2, Rect, Shape, Stroke, Ui};
use egui_plot::{PlotBounds, PlotGeometry, PlotItem, PlotItemBase, PlotTransform};

use crate::paper::{Axis, Role, Series};

/// A series on its way to the screen.
pub(super) struct Curve<'a> {
    points: &'a [[f64; 2]],
    role: Role,
    colour: Color32,
    logarithmic: [bool; 2],
    /// Points at least this far apart on the screen are marked.
    marked: f64,
    base: PlotItemBase,
}

impl<'a> Curve<'a> {
    /// A curve; on a logarithmic axis the coordinate of the plot is `log10` of the points' own.
    pub(super) fn new(series: &'a Series, colour: Color32, [x, y]: [&Axis; 2]) -> Self {
        Self {
            points: &series.points,
            role: series.role,
            colour,
            logarithmic: [x.logarithmic, y.logarithmic],
            marked: if is_discrete(x) { 3.5 } else { 12.0 },
            base: PlotItemBase::new(series.name.clone()),
        }
    }

    fn place(&self, [x, y]: [f64; 2]) -> Option<[f64; 2]> {
        let [x, y] = [(x, self.logarithmic[0]), (y, self.logarithmic[1])]
            .map(|(value, logarithmic)| if logarithmic { value.log10() } else { value });
        (x.is_finite() && y.is_finite()).then_some([x, y])
    }

    /// Runs of neighbouring points in screen coordinates, cut to a band around the visible part.
    fn runs(&self, transform: &PlotTransform) -> Vec<Vec<[f64; 2]>> {
        let frame = *transform.frame();
        let bounds = transform.bounds();
        let (low, high) = (bounds.min(), bounds.max());
        let scale_x = f64::from(frame.width()) / (high[0] - low[0]);
        let scale_y = f64::from(frame.height()) / (high[1] - low[1]);
        let screen = |[x, y]: [f64; 2]| {
            [
                f64::from(frame.left()) + (x - low[0]) * scale_x,
                f64::from(frame.bottom()) - (y - low[1]) * scale_y,
            ]
        };
        let band = frame.expand(8.0);
        let mut runs: Vec<Vec<[f64; 2]>> = vec![Vec::new()];
        let mut before: Option<[f64; 2]> = None;
        for point in self.points {
            let now = self.place(*point).map(screen).filter(|[x, y]| x.is_finite() && y.is_finite());
            match before.zip(now).and_then(|(a, b)| clipped(a, b, band)) {
                Some([a, b]) => match runs.last_mut() {
                    Some(run) if run.last() == Some(&a) => run.push(b),
                    Some(run) if run.is_empty() => run.extend([a, b]),
                    _ => runs.push(vec![a, b]),
                },
                None => runs.push(Vec::new()),
            }
            before = now;
        }
        runs.retain(|run| run.len() > 1);
        runs
    }

    fn stroke(&self) -> Stroke {
        let width = match self.role {
            Role::Truth | Role::Response => 1.8,
            Role::Estimate | Role::Other => 2.0,
            Role::Error => 1.2,
        };
        Stroke::new(if PlotItem::highlighted(self) { 2.0 * width } else { width }, self.colour)
    }
}

/// Draws a line in the style of a role; dashes grow where a line is so long that they would not be told apart.
pub(super) fn line(path: Vec<Pos2>, role: Role, stroke: Stroke, shapes: &mut Vec<Shape>) {
    let length: f32 = path.windows(2).map(|pair| pair[0].distance(pair[1])).sum();
    let factor = (length / 6000.0).max(1.0);
    match role {
        Role::Truth | Role::Error | Role::Response => shapes.push(Shape::line(path, stroke)),
        Role::Estimate => Shape::dashed_line_many(&path, stroke, 7.0 * factor, 4.0 * factor, shapes),
        Role::Other => Shape::dashed_line_many(&path, stroke, 2.0 * factor, 3.0 * factor, shapes),
    }
}

/// The part of a segment inside a rectangle (Liang and Barsky).
fn clipped(a: [f64; 2], b: [f64; 2], band: Rect) -> Option<[[f64; 2]; 2]> {
    let low = [f64::from(band.left()), f64::from(band.top())];
    let high = [f64::from(band.right()), f64::from(band.bottom())];
    let (mut from, mut to) = (0.0_f64, 1.0_f64);
    for k in [0, 1] {
        let step = b[k] - a[k];
        if step == 0.0 {
            if a[k] < low[k] || a[k] > high[k] {
                return None;
            }
            continue;
        }
        let (enter, leave) = ((low[k] - a[k]) / step, (high[k] - a[k]) / step);
        from = from.max(enter.min(leave));
        to = to.min(enter.max(leave));
    }
    let at = |s: f64| [a[0] + s * (b[0] - a[0]), a[1] + s * (b[1] - a[1])];
    // an end that is inside stays bit for bit, so that neighbouring segments join
    let start = if from == 0.0 { a } else { at(from) };
    let end = if to == 1.0 { b } else { at(to) };
    (from <= to).then_some([start, end])
}

/// Keeps at most four points per column of pixels: the first, the lowest, the highest and the last.
fn thinned(run: &[[f64; 2]], width: f32) -> Vec<Pos2> {
    #[expect(clippy::cast_possible_truncation, reason = "clipped to the screen before")]
    let position = |point: &[f64; 2]| Pos2::new(point[0] as f32, point[1] as f32);
    if run.len() as f64 <= 4.0 * f64::from(width) {
        return run.iter().map(position).collect();
    }
    let mut kept = Vec::new();
    for column in run.chunk_by(|a, b| a[0].floor() == b[0].floor()) {
        let mut chosen = [0, column.len() - 1, 0, 0];
        for (k, point) in column.iter().enumerate() {
            if point[1] < column[chosen[2]][1] {
                chosen[2] = k;
            }
            if point[1] > column[chosen[3]][1] {
                chosen[3] = k;
            }
        }
        chosen.sort_unstable();
        kept.extend(chosen.iter().map(|k| position(&column[*k])));
    }
    kept.dedup();
    kept
}

impl PlotItem for Curve<'_> {
    fn shapes(&self, _ui: &Ui, transform: &PlotTransform, shapes: &mut Vec<Shape>) {
        let frame = *transform.frame();
        let stroke = self.stroke();
        for run in self.runs(transform) {
            let width = run[run.len() - 1][0] - run[0][0];
            if width / run.len() as f64 > self.marked {
                for point in thinned(&run, frame.width()) {
                    shapes.push(Shape::circle_filled(point, 0.6 + stroke.width, stroke.color));
                }
            }
            line(thinned(&run, frame.width()), self.role, stroke, shapes);
        }
    }

    fn initialize(&mut self, _x_range: std::ops::RangeInclusive<f64>) {}

    fn color(&self) -> Color32 {
        self.colour
    }

    fn geometry(&self) -> PlotGeometry<'_> {
        PlotGeometry::None
    }

    fn bounds(&self) -> PlotBounds {
        let mut bounds = PlotBounds::NOTHING;
        for [x, y] in self.points.iter().filter_map(|point| self.place(*point)) {
            bounds.extend_with_x(x);
            bounds.extend_with_y(y);
        }
        bounds
    }

    fn base(&self) -> &PlotItemBase {
        &self.base
    }

    fn base_mut(&mut self) -> &mut PlotItemBase {
        &mut self.base
    }
}

/// Whether an axis counts steps of discrete time.
pub(super) fn is_discrete(axis: &Axis) -> bool {
    axis.label.starts_with('k')
}

/// The value of a curve at `x`, between its points; with `nearest`, the value of the nearest point.
pub(super) fn value_at(points: &[[f64; 2]], x: f64, nearest: bool) -> Option<f64> {
    let after = points.partition_point(|point| point[0] < x);
    let b = points.get(after)?;
    let Some(a) = after.checked_sub(1).map(|k| points[k]) else {
        return (b[0] == x || nearest).then_some(b[1]);
    };
    if nearest {
        return Some(if x - a[0] < b[0] - x { a[1] } else { b[1] });
    }
    let span = b[0] - a[0];
    Some(if span > 0.0 { a[1] + (b[1] - a[1]) * (x - a[0]) / span } else { b[1] })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn segments_are_cut_at_the_band() {
        let band = Rect::from_min_max(Pos2::new(0.0, 0.0), Pos2::new(10.0, 10.0));
        let cut = clipped([5.0, 5.0], [5.0, 1e9], band);
        assert_eq!(cut, Some([[5.0, 5.0], [5.0, 10.0]]), "a steep segment ends at the edge");
        assert_eq!(clipped([-5.0, 20.0], [15.0, 20.0], band), None, "a segment outside is left out");
        assert_eq!(clipped([1.0, 1.0], [2.0, 3.0], band), Some([[1.0, 1.0], [2.0, 3.0]]), "inside: as it is");
    }

    #[test]
    fn values_between_points_are_interpolated() {
        let points = [[0.0, 0.0], [1.0, 2.0], [2.0, 2.0]];
        assert_eq!(value_at(&points, 0.25, false), Some(0.5), "between two points");
        assert_eq!(value_at(&points, 0.25, true), Some(0.0), "the nearest sample");
        assert_eq!(value_at(&points, 0.0, false), Some(0.0), "at the first point");
        assert_eq!(value_at(&points, 2.5, false), None, "behind the last point");
        assert_eq!(value_at(&points, -0.5, false), None, "before the first point");
    }

    #[test]
    fn thinning_keeps_peaks() {
        let mut run: Vec<[f64; 2]> = (0..10_000).map(|k| [f64::from(k) * 0.01, 0.0]).collect();
        run[5_003][1] = 7.0;
        let kept = thinned(&run, 100.0);
        assert!(kept.len() <= 4 * 101, "at most four per column: {}", kept.len());
        assert!(kept.iter().any(|point| point.y == 7.0), "the peak is kept");
    }
}
