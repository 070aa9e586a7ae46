//! Observer of full order n + nf (paper 004, section III A).
#![expect(non_snake_case, reason = "matrix letters follow Koenig and Mammar 2002")]

use nalgebra::DMatrix;

use super::realize::{Matrices, realize};
use super::{Equivalent, PoleRequest, Realized, augmented, named};
use crate::numerics::{NumericsError, Tolerance, pseudo_inverse, stack};
use crate::observer::DesignError;

/// `[T1 T2] = [E; C]^+`, so that `T1 E + T2 C = I` under (11).
///
/// # Shapes
/// `T1`: n x r; `T2`: n x q.
///
/// # Source
/// Koenig and Mammar 2002, (6).
pub fn left_inverse(
    equivalent: &Equivalent,
    tolerance: &Tolerance,
) -> Result<(DMatrix<f64>, DMatrix<f64>), NumericsError> {
    let Equivalent { E, C, .. } = equivalent;
    let T = pseudo_inverse(&stack(&[E, C]), tolerance)?;
    Ok((T.columns(0, E.nrows()).into_owned(), T.columns(E.nrows(), C.nrows()).into_owned()))
}

/// The pair of condition (13), whose unobservable modes no full-order observer can move.
///
/// ```text
/// ([T1 A, T1 N; 0, hold], [C 0])
/// ```
pub(super) fn pair(
    equivalent: &Equivalent,
    hold: f64,
    tolerance: &Tolerance,
) -> Result<(DMatrix<f64>, DMatrix<f64>), NumericsError> {
    let (T1, _) = left_inverse(equivalent, tolerance)?;
    let Equivalent { A, N, C, .. } = equivalent;
    Ok(augmented(&(&T1 * A), &(&T1 * N), C, hold))
}

/// Designs the observer of order n + nf.
///
/// ```text
/// [L2; L3] places   A_obs = [T1 A, T1 N; 0, 0] - [L2; L3] [C 0]
/// F = T1 A - L2 C,   L1 = F T2,   J = T1 B,   M1 = I
/// ```
///
/// # Errors
/// Pole lists that do not fit, and decompositions that fail their check.
///
/// # Source
/// Koenig and Mammar 2002, (5)-(7), Algorithm 1.
pub(super) fn design(
    equivalent: &Equivalent,
    hold: f64,
    request: &PoleRequest<'_>,
) -> Result<Realized, DesignError> {
    let (T1, T2) = left_inverse(equivalent, request.tolerance)?;
    let Equivalent { A, B, N, C, .. } = equivalent;
    let n = A.ncols();
    let (Aa, Ca) = augmented(&(&T1 * A), &(&T1 * N), C, hold);
    let placement = request.place(&Aa, &Ca)?;
    // A_obs = Aa - [L2; L3] [C 0]
    let L2 = placement.gain.rows(0, n).into_owned();
    let L3 = placement.gain.rows(n, N.ncols()).into_owned();
    let F = &T1 * A - &L2 * C;
    let matrices = Matrices { L1: &F * &T2, J: &T1 * B, M1: DMatrix::identity(n, n), F, L2, L3, T1, T2 };
    let (observer, claim) = realize(equivalent, &matrices, hold);
    Ok(Realized { matrices: named(matrices), observer, claim, placement })
}
