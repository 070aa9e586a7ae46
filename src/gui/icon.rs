//! The window's icon: a true state and an estimate that comes closer, drawn by arithmetic.

/// Side in pixels.
const SIDE: u32 = 64;

/// The icon.
pub(super) fn icon() -> egui::IconData {
    let mut rgba = Vec::with_capacity((SIDE * SIDE * 4) as usize);
    for row in 0..SIDE {
        for column in 0..SIDE {
            rgba.extend(pixel(f64::from(column) + 0.5, f64::from(row) + 0.5));
        }
    }
    egui::IconData { rgba, width: SIDE, height: SIDE }
}

/// Colour at a point: ground, the state in white, the dashed estimate in orange.
fn pixel(x: f64, y: f64) -> [u8; 4] {
    const GROUND: [f64; 3] = [31.0, 95.0, 139.0];
    const STATE: [f64; 3] = [255.0, 255.0, 255.0];
    const ESTIMATE: [f64; 3] = [255.0, 180.0, 84.0];
    let side = f64::from(SIDE);
    let curve = |x: f64| side * 0.5 + 13.0 * (x * 0.15 - 1.0).sin();
    let slope = |x: f64| 13.0 * 0.15 * (x * 0.15 - 1.0).cos();
    let away = |x: f64| 22.0 * (-x / 18.0).exp();
    let near = |distance: f64, slope: f64| (3.0 - distance.abs() / slope.hypot(1.0)).clamp(0.0, 1.0);
    let inside = (8.0..side - 8.0).contains(&x);
    let state = if inside { near(y - curve(x), slope(x)) } else { 0.0 };
    let dash = inside && (x / 5.0).rem_euclid(2.0) < 1.3;
    let estimate = if dash { near(y - curve(x) - away(x), slope(x) - away(x) / 18.0) } else { 0.0 };
    // a square with round corners
    let corner = |v: f64| (v - side / 2.0).abs() - (side / 2.0 - 14.0);
    let outside = corner(x).max(0.0).hypot(corner(y).max(0.0)) - 14.0;
    let alpha = (0.5 - outside).clamp(0.0, 1.0);
    let mix = |k: usize| {
        let value = GROUND[k] + (STATE[k] - GROUND[k]) * state;
        value + (ESTIMATE[k] - value) * estimate
    };
    [mix(0), mix(1), mix(2), 255.0 * alpha].map(byte)
}

fn byte(value: f64) -> u8 {
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "clamped to the range of a byte"
    )]
    let byte = value.clamp(0.0, 255.0).round() as u8;
    byte
}
