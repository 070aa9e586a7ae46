//! Periodic signals and remainders, with edges that lie where a person expects them.

use std::f64::consts::{PI, TAU};

/// `x / period`, set to the nearest whole number when it differs from it by rounding only.
///
/// Without this `square(2*pi*t)` would miss an edge at some of the instants that were sampled exactly on it.
pub(super) fn cycles(x: f64, period: f64) -> f64 {
    let quotient = x / period;
    let whole = quotient.round();
    if (quotient - whole).abs() <= 2.0 * f64::EPSILON * whole.abs() { whole } else { quotient }
}

/// The sign of `sin(x)`, with +1 on `[0, pi)` and -1 on `[pi, 2 pi)`.
pub(super) fn square(x: f64) -> f64 {
    let half = cycles(x, PI).floor().rem_euclid(2.0);
    if half.is_nan() {
        f64::NAN
    } else if half == 0.0 {
        1.0
    } else {
        -1.0
    }
}

/// A line from -1 at the multiples of `2 pi` up to 1 just before the next.
pub(super) fn sawtooth(x: f64) -> f64 {
    let turns = cycles(x, TAU);
    2.0 * (turns - turns.floor()) - 1.0
}

/// `x - floor(x / y) * y`: the sign is that of `y`, and `modulo(x, 0) = x`.
///
/// As in MATLAB the result is exactly zero when `x / y` is a whole number but for rounding (`mod(0.3, 0.1)`).
pub(super) fn modulo(x: f64, y: f64) -> f64 {
    if y == 0.0 {
        return x;
    }
    let quotient = cycles(x, y);
    if quotient == quotient.floor() && quotient.is_finite() && y.fract() != 0.0 {
        return 0.0;
    }
    let remainder = x % y;
    if remainder != 0.0 && (remainder < 0.0) != (y < 0.0) { remainder + y } else { remainder }
}

/// -1, 0 or 1.
pub(super) fn sign(x: f64) -> f64 {
    if x == 0.0 || x.is_nan() { x } else { x.signum() }
}

/// 0 before zero, 1 from zero on.
pub(super) fn step(x: f64) -> f64 {
    if x.is_nan() {
        x
    } else if x < 0.0 {
        0.0
    } else {
        1.0
    }
}
