//! Small pictures of spectra, all at the same scale.

use egui::{Color32, Pos2, Rect, Stroke, Ui, Vec2};

use super::super::theme;
use crate::numerics::Complex64;
use crate::simulation::comparison::{ComparedDesign, Comparison};

/// What all pictures show: `[re low, re high, im half]`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Window {
    low: f64,
    high: f64,
    half: f64,
    discrete: bool,
}

impl Window {
    /// A window that shows every mode of every design, and the boundary of stability.
    pub(super) fn around(comparison: &Comparison, discrete: bool) -> Self {
        let designs = comparison.rows.iter().filter_map(|row| row.outcome.as_ref().ok());
        let modes = designs.flat_map(|design| design.spectrum.iter());
        let (low, high, half) = modes.fold((0.0_f64, 0.0_f64, 0.0_f64), |(low, high, half), mode| {
            (low.min(mode.re), high.max(mode.re), half.max(mode.im.abs()))
        });
        if discrete {
            let edge = low.abs().max(high).max(half).max(1.0) * 1.1;
            return Self { low: -edge, high: edge, half: edge, discrete };
        }
        let span = (high - low).max(1e-6);
        Self {
            low: low - 0.08 * span,
            high: high + 0.12 * span,
            half: (1.15 * half).max(0.2 * span),
            discrete,
        }
    }

    #[expect(clippy::cast_possible_truncation, reason = "screen coordinates")]
    fn place(&self, z: Complex64, rect: Rect) -> Pos2 {
        let x = (z.re - self.low) / (self.high - self.low);
        let y = 0.5 - 0.5 * z.im / self.half;
        rect.min + Vec2::new(x as f32 * rect.width(), y as f32 * rect.height())
    }
}

/// Draws the spectrum of a design: dots, rings where modes are fixed, the boundary of stability.
pub(super) fn picture(ui: &Ui, rect: Rect, window: &Window, design: &ComparedDesign, colour: Color32) {
    // a circle stays round
    let rect = if window.discrete {
        Rect::from_center_size(rect.center(), Vec2::splat(rect.width().min(rect.height())))
    } else {
        rect
    };
    let painter = ui.painter().with_clip_rect(rect.expand(3.0).intersect(ui.clip_rect()));
    painter.rect_filled(rect, 3.0, ui.visuals().extreme_bg_color);
    let axis = Stroke::new(1.0, theme::faint(ui).gamma_multiply(0.5));
    let boundary = Stroke::new(1.2, theme::bad(ui).gamma_multiply(0.6));
    let origin = window.place(Complex64::new(0.0, 0.0), rect);
    painter.hline(rect.x_range(), origin.y, axis);
    if window.discrete {
        let edge = window.place(Complex64::new(1.0, 0.0), rect);
        painter.circle_stroke(origin, edge.x - origin.x, boundary);
    } else {
        painter.vline(origin.x, rect.y_range(), boundary);
    }
    for mode in &design.spectrum {
        painter.circle_filled(window.place(*mode, rect), 3.2, colour);
    }
    for mode in &design.fixed_modes {
        painter.circle_stroke(window.place(*mode, rect), 5.5, Stroke::new(1.5, theme::near(ui)));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_empty_comparison_still_has_a_window() {
        let rect = Rect::from_min_size(Pos2::ZERO, Vec2::new(100.0, 60.0));
        for discrete in [false, true] {
            let window = Window::around(&Comparison::default(), discrete);
            let at = window.place(Complex64::new(0.0, 0.0), rect);
            assert!(rect.contains(at), "the origin is inside: {at:?}");
        }
    }
}
