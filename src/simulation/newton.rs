//! Newton's method for the few unknowns of an implicit equation, to rounding.

use nalgebra::{DMatrix, DVector, Dyn, LU};

/// Most iterations.
const ITERATIONS: usize = 60;
/// Smallest part of a step that is taken.
const SMALLEST_PART: f64 = 1e-4;
/// Steps below this part of the unknowns may stop shrinking because of rounding.
const NEAR: f64 = 1e-9;

/// Residual and Jacobian of an equation at given unknowns; false where it has no value.
pub(super) type Equation<'e> = dyn FnMut(&DVector<f64>, &mut DVector<f64>, &mut DMatrix<f64>) -> bool + 'e;

/// Solves `residual(unknowns) = 0`, and returns the sign of the determinant of the Jacobian at the solution.
///
/// Steps are shortened until the next simplified step is shorter (the natural monotonicity test), which does not depend
/// on the scales of equations and unknowns. `size` is a usual size of the unknowns. None where there is no solution, or
/// none was reached.
///
/// # Source
/// P. Deuflhard, Newton Methods for Nonlinear Problems, 2004, section 3.3.
pub(super) fn newton(unknowns: &mut DVector<f64>, size: f64, equation: &mut Equation<'_>) -> Option<f64> {
    let n = unknowns.len();
    let (mut residual, mut jacobian) = (DVector::zeros(n), DMatrix::zeros(n, n));
    let (mut trial, mut previous) = (unknowns.clone(), f64::INFINITY);
    if !equation(unknowns, &mut residual, &mut jacobian) {
        return None;
    }
    for _ in 0..ITERATIONS {
        let factors = jacobian.clone().lu();
        let step = factors.solve(&residual).filter(|step| step.iter().all(|x| x.is_finite()))?;
        let (length, scale) = (step.amax(), unknowns.amax().max(size));
        let stagnates = length <= NEAR * scale && length >= 0.5 * previous;
        if length <= 4.0 * f64::EPSILON * scale || stagnates {
            *unknowns -= step;
            return Some(determinant_sign(&factors)).filter(|sign| *sign != 0.0);
        }
        previous = length;
        let mut part = 1.0;
        loop {
            trial.copy_from(unknowns);
            trial.axpy(-part, &step, 1.0);
            let valid = equation(&trial, &mut residual, &mut jacobian);
            let shorter = |next: DVector<f64>| next.amax() <= (1.0 - 0.25 * part) * length;
            if valid && (length <= NEAR * scale || factors.solve(&residual).is_some_and(shorter)) {
                break;
            }
            part *= 0.5;
            if part < SMALLEST_PART {
                return None;
            }
        }
        unknowns.copy_from(&trial);
    }
    None
}

/// The sign of the determinant of a factorised matrix, zero when it is singular.
pub(super) fn determinant_sign(factors: &LU<f64, Dyn, Dyn>) -> f64 {
    let flips: f64 = factors.p().determinant();
    let pivots = factors.u().diagonal();
    pivots.iter().map(|x| if *x == 0.0 { 0.0 } else { x.signum() }).product::<f64>() * flips
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::dvector;

    #[test]
    fn a_root_is_found_to_rounding_from_afar() {
        let mut x = dvector![40.0];
        let sign = newton(&mut x, 1.0, &mut |x, r, j| {
            r[0] = x[0].atan() - 0.5;
            j[(0, 0)] = 1.0 / (1.0 + x[0] * x[0]);
            true
        });
        assert!((x[0] - 0.5_f64.tan()).abs() < 1e-15, "plain steps would diverge: {}", x[0]);
        assert_eq!(sign, Some(1.0), "the slope is positive");
    }

    #[test]
    fn no_root_is_said() {
        let found = newton(&mut dvector![0.3], 1.0, &mut |x, r, j| {
            r[0] = x[0] * x[0] + 1.0;
            j[(0, 0)] = 2.0 * x[0];
            true
        });
        assert_eq!(found, None, "x^2 + 1 has no real root");
        assert_eq!(newton(&mut dvector![0.0], 1.0, &mut |_, _, _| false), None, "no value");
    }

    #[test]
    fn two_unknowns_of_different_size_are_solved_together() {
        let mut x = dvector![1.0, 1.0];
        let sign = newton(&mut x, 1.0, &mut |x, r, j| {
            r[0] = 1e8 * (x[0] * x[0] - 2.0);
            r[1] = x[1] - 1e-6 * x[0];
            j.copy_from_slice(&[2e8 * x[0], -1e-6, 0.0, 1.0]);
            true
        });
        assert!((x[0] - 2.0_f64.sqrt()).abs() < 1e-15 && (x[1] - 1e-6 * x[0]).abs() < 1e-20, "{x}");
        assert_eq!(sign, Some(1.0), "both slopes are positive");
    }
}
