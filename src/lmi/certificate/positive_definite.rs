//! Rump's test: a floating-point Cholesky factorisation that proves.

use nalgebra::DMatrix;

use super::{Interval, IntervalMatrix};

/// Whether every symmetric matrix within the intervals is positive definite; `true` is a proof, `false` is not the
/// opposite.
///
/// ```text
/// M = mid + rad,   fl-Cholesky of  mid - (g / (1 - g) trace mid + |rad| + underflow) I  runs to its end
///   =>   mid - |rad| I > 0   =>   M > 0,          g = (n + 2) u / (1 - (n + 2) u),   u = 2^-53
/// ```
///
/// Before, rows and columns are scaled by powers of two to a diagonal near 1, a congruence that changes no verdict; so
/// blocks of very different size do not hide each other. An empty matrix is positive definite. A matrix that is not
/// square is a mistake of the caller and not proved, one with an infinite end or a diagonal entry that may be zero or
/// negative is not proved either.
///
/// # Source
/// S. M. Rump, "Verification of positive definiteness", BIT Numerical Mathematics 46 (2006) 433-452.
pub fn proved_positive_definite(matrix: &IntervalMatrix) -> bool {
    let n = matrix.nrows();
    if matrix.ncols() != n {
        return false;
    }
    let Some(scaled) = unit_diagonal(matrix) else { return false };
    let Some((mut middle, radius)) = middle_and_radius(&scaled) else { return false };
    let shift = (rounding_of_cholesky(&middle) + radius).next_up();
    for i in 0..n {
        middle[(i, i)] = (middle[(i, i)] - shift).next_down();
    }
    cholesky_ends(middle)
}

/// A proved lower bound of the smallest eigenvalue of every symmetric matrix within, found by bisection.
///
/// Not negative exactly when [`proved_positive_definite`]; infinite for an empty matrix, minus infinity when an end is.
///
/// # Panics
/// When the matrix is not square.
pub fn lower_bound(matrix: &IntervalMatrix) -> f64 {
    let n = matrix.nrows();
    assert_eq!(matrix.ncols(), n, "an eigenvalue needs a square matrix");
    let shifted = |by: f64| {
        IntervalMatrix::from_fn(n, n, |i, j| {
            if i == j { matrix.at(i, j) - Interval::point(by) } else { matrix.at(i, j) }
        })
    };
    let proved = |by: f64| proved_positive_definite(&shifted(by));
    let least_diagonal = (0..n).map(|i| matrix.at(i, i).low()).fold(f64::INFINITY, f64::min);
    if n == 0 || least_diagonal == f64::NEG_INFINITY {
        return least_diagonal;
    }
    // every eigenvalue is below the smallest diagonal entry, and above minus the largest row sum
    let size = |x: Interval| x.low().abs().max(x.high().abs());
    let row = |i: usize| (0..n).fold(0.0, |sum: f64, j| (sum + size(matrix.at(i, j))).next_up());
    let largest_row = (0..n).map(row).fold(f64::MIN_POSITIVE, f64::max);
    let (mut low, mut high) = if proved(0.0) { (0.0, least_diagonal) } else { (-2.0 * largest_row, 0.0) };
    if !low.is_finite() || (low < 0.0 && !proved(low)) {
        return f64::NEG_INFINITY;
    }
    const STEPS: usize = 60;
    const WIDTH: f64 = 1e-6;
    for _ in 0..STEPS {
        if high - low <= WIDTH * low.abs() {
            break;
        }
        let middle = 0.5 * (low + high);
        if proved(middle) {
            low = middle;
        } else {
            high = middle;
        }
    }
    low
}

/// The matrix with rows and columns scaled to a diagonal from 1 to 4; `None` when a diagonal entry may not be positive.
fn unit_diagonal(matrix: &IntervalMatrix) -> Option<IntervalMatrix> {
    let n = matrix.nrows();
    let mut factors = Vec::with_capacity(n);
    for i in 0..n {
        let entry = matrix.at(i, i);
        if !(entry.low() > 0.0 && entry.high().is_finite()) {
            return None;
        }
        factors.push(root_power_of_two(entry.high()));
    }
    Some(IntervalMatrix::from_fn(n, n, |i, j| {
        // both triangles enclose the same number: the hull contains it whichever was computed more tightly
        let entry = matrix.at(i, j).hull(matrix.at(j, i));
        entry.times_power_of_two(factors[i]).times_power_of_two(factors[j])
    }))
}

/// A power of two `f` with `f^2 x` from 1 to 4, for a positive number that is not subnormal.
fn root_power_of_two(x: f64) -> f64 {
    const BIAS: u64 = 1023;
    const MANTISSA_BITS: u32 = 52;
    let biased = x.to_bits() >> MANTISSA_BITS;
    // floor(exponent / 2) = floor((biased + 1) / 2) - 512, since the bias is odd
    f64::from_bits((BIAS + 512 - biased.div_ceil(2)) << MANTISSA_BITS)
}

/// Midpoints, and a bound of the spectral norm of the radii: their largest row sum.
fn middle_and_radius(matrix: &IntervalMatrix) -> Option<(DMatrix<f64>, f64)> {
    let n = matrix.nrows();
    let mut middle = DMatrix::zeros(n, n);
    let mut radius = 0.0_f64;
    for i in 0..n {
        let mut row = 0.0_f64;
        for j in 0..n {
            let entry = matrix.at(i.min(j), i.max(j));
            let m = 0.5 * entry.low() + 0.5 * entry.high();
            middle[(i, j)] = m;
            row = (row + (entry.high() - m).next_up().max((m - entry.low()).next_up())).next_up();
        }
        radius = radius.max(row);
        if !row.is_finite() {
            return None;
        }
    }
    middle.iter().all(|x| x.is_finite()).then_some((middle, radius))
}

/// How far below zero an eigenvalue may lie although the floating-point factorisation ends.
fn rounding_of_cholesky(matrix: &DMatrix<f64>) -> f64 {
    const UNIT: f64 = 0.5 * f64::EPSILON;
    let n = matrix.nrows() as f64;
    let trace = matrix.diagonal().iter().fold(0.0, |sum: f64, x| (sum + x.max(0.0)).next_up());
    let operations = ((n + 2.0) * UNIT).next_up();
    let gamma = (operations / (1.0 - operations).next_down()).next_up();
    let relative = (gamma / (1.0 - gamma).next_down()).next_up();
    // the diagonal is below 4: Rump's term 4 n (n + largest diagonal entry) 2^-1074 is far below this
    let underflow = 4.0 * (n + 4.0) * (n + 4.0) * f64::MIN_POSITIVE;
    ((relative * trace).next_up() + underflow).next_up()
}

/// Whether a Cholesky factorisation in plain floating-point arithmetic runs to its end.
fn cholesky_ends(mut a: DMatrix<f64>) -> bool {
    let n = a.nrows();
    for j in 0..n {
        for k in 0..j {
            let factor = a[(j, k)];
            for i in j..n {
                let product = a[(i, k)] * factor;
                a[(i, j)] -= product;
            }
        }
        let pivot = a[(j, j)];
        if pivot.is_nan() || pivot <= 0.0 || pivot.is_infinite() {
            return false;
        }
        let root = pivot.sqrt();
        for i in j..n {
            a[(i, j)] /= root;
        }
    }
    true
}
