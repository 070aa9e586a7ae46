//! What lies under the poles: stability, the region of a demand, grid, eigenvalues of the plant, fixed modes.

use egui::{Align2, FontId, Pos2, Rect, Stroke, StrokeKind, Ui, Vec2, vec2};

use super::super::plot::{multiples, round_step, short};
use super::super::theme;
use super::{Poles, View};
use crate::numerics::Complex64;

/// The unstable region, the grid, the axes and the unit circle.
pub(super) fn background(ui: &Ui, rect: Rect, view: &View, poles: &Poles) {
    let discrete = poles.discrete;
    let painter = ui.painter().with_clip_rect(rect.intersect(ui.clip_rect()));
    let plain = ui.visuals().extreme_bg_color;
    let unstable = theme::bad(ui).gamma_multiply(0.09);
    let origin = view.screen(Complex64::new(0.0, 0.0), rect);
    painter.rect_filled(rect, 4.0, plain);
    let border = Stroke::new(1.2, theme::bad(ui).gamma_multiply(0.6));
    if discrete {
        #[expect(clippy::cast_possible_truncation, reason = "screen coordinates")]
        let radius = (1.0 / view.per_point).min(1e5) as f32;
        painter.rect_filled(rect, 4.0, unstable);
        painter.circle_filled(origin, radius, plain);
        painter.circle_stroke(origin, radius, border);
    } else if origin.x < rect.right() {
        let right = Rect::from_min_max(Pos2::new(origin.x.max(rect.left()), rect.top()), rect.max);
        painter.rect_filled(right, 0.0, unstable);
        painter.vline(origin.x, rect.y_range(), border);
    }
    if let Some(decay) = poles.decay {
        region(ui, rect, view, decay, discrete);
    }
    let step = round_step(70.0 * view.per_point);
    let faint = Stroke::new(1.0, theme::faint(ui).gamma_multiply(0.22));
    let axis = Stroke::new(1.0, theme::faint(ui).gamma_multiply(0.7));
    let font = FontId::proportional(11.0);
    let low = view.value(rect.left_bottom(), rect);
    let high = view.value(rect.right_top(), rect);
    for value in multiples(step, low.re, high.re) {
        let x = view.screen(Complex64::new(value, 0.0), rect).x;
        painter.vline(x, rect.y_range(), if value == 0.0 { axis } else { faint });
        let at = Pos2::new(x + 3.0, rect.bottom() - 2.0);
        painter.text(at, Align2::LEFT_BOTTOM, short(value), font.clone(), theme::faint(ui));
    }
    for value in multiples(step, low.im, high.im) {
        let y = view.screen(Complex64::new(0.0, value), rect).y;
        painter.hline(rect.x_range(), y, if value == 0.0 { axis } else { faint });
        if value != 0.0 {
            let at = Pos2::new(rect.right() - 4.0, y - 1.0);
            let text = format!("{}i", short(value));
            painter.text(at, Align2::RIGHT_BOTTOM, text, font.clone(), theme::faint(ui));
        }
    }
    painter.rect_stroke(rect, 4.0, ui.visuals().widgets.noninteractive.bg_stroke, StrokeKind::Inside);
}

/// The region that the demand on the decay leaves to the error: a half plane or a disk.
fn region(ui: &Ui, rect: Rect, view: &View, decay: f64, discrete: bool) {
    let painter = ui.painter().with_clip_rect(rect.intersect(ui.clip_rect()));
    let colour = theme::accent(ui);
    let (fill, stroke) = (colour.gamma_multiply(0.13), Stroke::new(1.6, colour));
    let origin = view.screen(Complex64::new(0.0, 0.0), rect);
    let font = FontId::proportional(11.5);
    if discrete {
        #[expect(clippy::cast_possible_truncation, reason = "screen coordinates")]
        let radius = (decay / view.per_point).min(1e5) as f32;
        painter.circle(origin, radius, fill, stroke);
        let at = origin + vec2(0.0, -radius + 3.0);
        painter.text(at, Align2::CENTER_TOP, format!("|z| < {}", short(decay)), font, colour);
    } else {
        let border = view.screen(Complex64::from(-decay), rect).x;
        if border > rect.left() {
            let right = border.min(rect.right());
            painter.rect_filled(Rect::from_min_max(rect.min, Pos2::new(right, rect.bottom())), 4.0, fill);
            painter.vline(border, rect.y_range(), stroke);
        }
        let at = Pos2::new(border.max(rect.left() + 90.0) - 4.0, rect.top() + 4.0);
        painter.text(at, Align2::RIGHT_TOP, format!("Re s < -{}", short(decay)), font, colour);
    }
}

/// Eigenvalues of the plant as squares, fixed modes as rings.
pub(super) fn marks(ui: &Ui, rect: Rect, view: &View, poles: &Poles) {
    let painter = ui.painter().with_clip_rect(rect.intersect(ui.clip_rect()));
    let square = Stroke::new(1.4, theme::faint(ui));
    for plant in &poles.plant {
        let mark = Rect::from_center_size(view.screen(*plant, rect), Vec2::splat(9.0));
        painter.rect_stroke(mark, 0.0, square, StrokeKind::Middle);
    }
    for fixed in &poles.fixed {
        painter.circle_stroke(view.screen(*fixed, rect), 6.5, Stroke::new(2.0, theme::near(ui)));
    }
}
