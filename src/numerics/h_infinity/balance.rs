//! State coordinates in which inputs, dynamics and outputs have like sizes.

use nalgebra::DMatrix;

use super::StateSpace;

/// The system in balanced coordinates with unit inputs and outputs, and the factor that gives its gains back.
///
/// ```text
/// A -> S^-1 A S,   B -> S^-1 B / |B|,   C -> C S / |C|,   D -> D / (|B| |C|),     S diagonal with powers of two
/// ```
///
/// `S` evens out the rows and columns of `[A B; C 0]` (Parlett and Reinsch 1969), so that the units of a state do not
/// matter; powers of two make it exact.
pub(super) fn balanced(
    a: &DMatrix<f64>,
    b: &DMatrix<f64>,
    c: &DMatrix<f64>,
    d: &DMatrix<f64>,
) -> (StateSpace, f64) {
    let mut system = StateSpace { a: a.clone(), b: b.clone(), c: c.clone(), d: d.clone() };
    const SWEEPS: usize = 20;
    for _ in 0..SWEEPS {
        if !sweep(&mut system) {
            break;
        }
    }
    let size = |m: &DMatrix<f64>| power_of_two(m.iter().fold(0.0, |most: f64, x| most.max(x.abs())));
    let (of_b, of_c) = (size(&system.b), size(&system.c));
    let unit = of_b * of_c;
    if !(unit.is_finite() && unit > 0.0 && (1.0 / unit).is_finite()) {
        return (system, 1.0);
    }
    system.b /= of_b;
    system.c /= of_c;
    system.d /= unit;
    (system, unit)
}

/// The power of two closest to a positive number; 1 for zero.
fn power_of_two(x: f64) -> f64 {
    if x > 0.0 { x.log2().round().exp2() } else { 1.0 }
}

/// Scales each state once; whether one of them changed.
fn sweep(system: &mut StateSpace) -> bool {
    let StateSpace { a, b, c, .. } = system;
    let size = |sum: f64, x: &f64| sum + x.abs();
    let mut changed = false;
    for i in 0..a.nrows() {
        let inside = a[(i, i)].abs();
        let column = a.column(i).iter().fold(0.0, size) - inside + c.column(i).iter().fold(0.0, size);
        let row = a.row(i).iter().fold(0.0, size) - inside + b.row(i).iter().fold(0.0, size);
        if column <= 0.0 || row <= 0.0 || !(column / row).is_finite() {
            continue;
        }
        // f = 2^k with column * f close to row / f
        let f = (0.5 * (row / column).log2()).round().exp2();
        if f.is_normal() && column * f + row / f < 0.95 * (column + row) {
            a.column_mut(i).iter_mut().chain(c.column_mut(i).iter_mut()).for_each(|x| *x *= f);
            a.row_mut(i).iter_mut().chain(b.row_mut(i).iter_mut()).for_each(|x| *x /= f);
            changed = true;
        }
    }
    changed
}
