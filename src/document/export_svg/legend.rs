//! The legend of a panel: put where it covers least of the curves.

use super::curve::{Frame, decimal};
use super::stroke::Stroke;
use super::text::{self, Anchor};

const SIZE: f64 = 10.0;
const ROW: f64 = 14.0;
const SAMPLE: f64 = 22.0;
const MARGIN: f64 = 6.0;

/// Draws the legend of named strokes over curves that are already clipped to the frame.
pub(super) fn legend(entries: &[(&str, Stroke)], frame: &Frame, curves: &[Vec<[f64; 2]>]) -> String {
    if entries.is_empty() {
        return String::new();
    }
    let rows = fitting_rows(entries.len(), frame);
    let columns = entries.len().div_ceil(rows);
    let widest = entries.iter().map(|(name, _)| text::width(name, SIZE)).fold(0.0, f64::max);
    let column = SAMPLE + widest + 14.0;
    let (wide, high) = (column * columns as f64 + 6.0, ROW * rows as f64 + 6.0);
    let place = best_place([wide, high], frame, curves);
    let mut svg = format!(
        "<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" rx=\"3\" fill=\"#fff\" fill-opacity=\"0.85\" \
         stroke=\"#ccc\" stroke-width=\"0.5\"/>\n",
        decimal(place.left),
        decimal(place.top),
        decimal(wide),
        decimal(high)
    );
    for (i, (name, stroke)) in entries.iter().enumerate() {
        let x = place.left + 6.0 + column * (i / rows) as f64;
        let y = place.top + 3.0 + ROW * ((i % rows) as f64 + 0.5);
        let line = format!("M{} {y}L{} {y}", decimal(x), decimal(x + SAMPLE), y = decimal(y));
        svg.push_str(&stroke.path(&line));
        svg.push_str(&text::text([x + SAMPLE + 5.0, y + 0.35 * SIZE], SIZE, Anchor::Start, name));
    }
    svg
}

/// As many rows as fill at most two thirds of the frame's height.
fn fitting_rows(count: usize, frame: &Frame) -> usize {
    let most = (1..=count).take_while(|rows| *rows as f64 * ROW + 6.0 <= (frame.bottom - frame.top) / 1.5);
    most.last().unwrap_or(1)
}

/// The corner or middle of an edge with the fewest curve points beneath; the upper right when all are equal.
fn best_place([wide, high]: [f64; 2], frame: &Frame, curves: &[Vec<[f64; 2]>]) -> Frame {
    let (right, bottom) = (frame.right - MARGIN - wide, frame.bottom - MARGIN - high);
    let (left, top) = (frame.left + MARGIN, frame.top + MARGIN);
    let (middle, centre) = (f64::midpoint(left, right), f64::midpoint(top, bottom));
    let corners = [
        [right, top],
        [right, bottom],
        [left, top],
        [left, bottom],
        [middle, top],
        [middle, bottom],
        [right, centre],
        [left, centre],
    ];
    let at = |[x, y]: [f64; 2]| Frame { left: x, top: y, right: x + wide, bottom: y + high };
    let mut best = at(corners[0]);
    let mut fewest = f64::INFINITY;
    for corner in corners {
        let frame = at(corner);
        let hidden = curves.iter().map(|curve| covered(curve, &frame)).sum::<f64>();
        if hidden < fewest {
            (best, fewest) = (frame, hidden);
        }
    }
    best
}

/// Length of a curve inside a rectangle, in pixels.
fn covered(curve: &[[f64; 2]], frame: &Frame) -> f64 {
    const STEP: f64 = 3.0;
    let mut length = 0.0;
    for pair in curve.windows(2) {
        let [[ax, ay], [bx, by]] = [pair[0], pair[1]];
        let whole = (bx - ax).hypot(by - ay);
        let parts = (whole / STEP).ceil().clamp(1.0, 1000.0);
        let mut k = 0.5;
        while k < parts {
            if frame.contains([ax + (bx - ax) * k / parts, ay + (by - ay) * k / parts]) {
                length += whole / parts;
            }
            k += 1.0;
        }
    }
    length
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_legend_avoids_the_curve() {
        let frame = Frame { left: 0.0, top: 0.0, right: 200.0, bottom: 100.0 };
        let rising = vec![[0.0, 100.0], [200.0, 0.0]];
        let place = best_place([60.0, 20.0], &frame, std::slice::from_ref(&rising));
        assert_eq!(covered(&rising, &place), 0.0, "{place:?}");
        assert!(place.left > 100.0 && place.top > 50.0, "below a rising curve: {place:?}");
        let empty = best_place([60.0, 20.0], &frame, &[]);
        assert!(empty.left > 100.0 && empty.top < 50.0, "upper right by default: {empty:?}");
    }

    #[test]
    fn many_entries_go_into_columns() {
        let frame = Frame { left: 0.0, top: 0.0, right: 200.0, bottom: 100.0 };
        assert_eq!(fitting_rows(3, &frame), 3, "one column");
        assert_eq!(fitting_rows(20, &frame), 4, "five columns of four");
    }
}
