//! Curves in pixels: clipped to the axes, without repeated points.

use super::scale::Scale;

/// A rectangle in pixels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Frame {
    pub(super) left: f64,
    pub(super) top: f64,
    pub(super) right: f64,
    pub(super) bottom: f64,
}

impl Frame {
    /// The part of a segment inside the rectangle (Liang and Barsky), both ends.
    fn clip(&self, [ax, ay]: [f64; 2], [bx, by]: [f64; 2]) -> Option<[[f64; 2]; 2]> {
        let (dx, dy) = (bx - ax, by - ay);
        let (mut enter, mut leave) = (0.0_f64, 1.0_f64);
        let sides =
            [(-dx, ax - self.left), (dx, self.right - ax), (-dy, ay - self.top), (dy, self.bottom - ay)];
        for (direction, distance) in sides {
            if direction == 0.0 {
                if distance < 0.0 {
                    return None;
                }
            } else if direction < 0.0 {
                enter = enter.max(distance / direction);
            } else {
                leave = leave.min(distance / direction);
            }
        }
        let at = |part: f64| [part.mul_add(dx, ax), part.mul_add(dy, ay)];
        (enter <= leave).then(|| [at(enter), at(leave)])
    }

    pub(super) fn contains(&self, [x, y]: [f64; 2]) -> bool {
        x >= self.left && x <= self.right && y >= self.top && y <= self.bottom
    }
}

/// The visible pieces of a curve, in pixels; a point that is not finite interrupts it.
pub(super) fn pieces(points: &[[f64; 2]], x: &Scale, y: &Scale, frame: &Frame) -> Vec<Vec<[f64; 2]>> {
    let mut pieces: Vec<Vec<[f64; 2]>> = Vec::new();
    let mut last: Option<[f64; 2]> = None;
    let mut joined = false;
    for &[px, py] in points {
        let here = x.pixel(px).and_then(|x| y.pixel(py).map(|y| [x, y]));
        let segment = last.zip(here).and_then(|(a, b)| Some((frame.clip(a, b)?, b)));
        match (segment, pieces.last_mut()) {
            (Some(([_, to], end)), Some(piece)) if joined => {
                piece.push(to);
                joined = to == end;
            }
            (Some(([from, to], end)), _) => {
                pieces.push(vec![from, to]);
                joined = to == end;
            }
            (None, _) => joined = false,
        }
        // a curve of a single point, or a point after a gap, is not a segment: it begins with the next one
        last = here;
    }
    pieces
}

/// The `d` of a path, two decimals, points that fall on the one before left out.
pub(super) fn path(pieces: &[Vec<[f64; 2]>]) -> String {
    let mut text = String::new();
    for piece in pieces {
        let mut before = String::new();
        for (i, [x, y]) in piece.iter().enumerate() {
            let point = format!("{} {}", decimal(*x), decimal(*y));
            if i == 0 {
                text.push('M');
            } else if point == before {
                continue;
            } else {
                text.push('L');
            }
            text.push_str(&point);
            before = point;
        }
    }
    text
}

/// Two decimals at most, without a negative zero.
pub(super) fn decimal(x: f64) -> String {
    let text = format!("{x:.2}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" { "0".to_owned() } else { text.to_owned() }
}

#[cfg(test)]
mod tests {
    use super::*;

    const FRAME: Frame = Frame { left: 0.0, top: 0.0, right: 10.0, bottom: 10.0 };

    fn found(points: &[[f64; 2]]) -> String {
        // one value is one pixel
        let scale = Scale::new([0.0, 10.0], false, [0.0, 10.0]);
        path(&pieces(points, &scale, &scale, &FRAME))
    }

    #[test]
    fn a_curve_is_cut_where_it_leaves_the_axes() {
        assert_eq!(found(&[[-5.0, 5.0], [15.0, 5.0]]), "M0 5L10 5", "enters left, leaves right");
        assert_eq!(
            found(&[[2.0, 2.0], [2.0, 20.0], [4.0, 20.0], [4.0, 2.0]]),
            "M2 2L2 10M4 10L4 2",
            "two pieces"
        );
        assert_eq!(found(&[[20.0, 1.0], [30.0, 2.0]]), "", "nothing outside");
    }

    #[test]
    fn points_that_are_not_finite_interrupt_a_curve() {
        assert_eq!(
            found(&[[1.0, 1.0], [2.0, 1.0], [3.0, f64::NAN], [4.0, 1.0], [5.0, 1.0]]),
            "M1 1L2 1M4 1L5 1"
        );
    }

    #[test]
    fn only_exact_repetitions_are_dropped() {
        assert_eq!(found(&[[1.0, 1.0], [1.001, 1.0], [1.0, 1.001], [2.0, 1.0]]), "M1 1L2 1", "same pixels");
        assert_eq!(
            found(&[[1.0, 1.0], [2.0, 1.0], [3.0, 1.0]]),
            "M1 1L2 1L3 1",
            "a straight line keeps its points"
        );
    }
}
