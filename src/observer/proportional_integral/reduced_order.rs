//! Observer of reduced order r + nf (paper 004, section III B).
#![expect(non_snake_case, reason = "matrix letters follow Koenig and Mammar 2002")]

use nalgebra::DMatrix;

use super::realize::{Matrices, realize};
use super::{Equivalent, PoleRequest, Realized, augmented, named};
use crate::numerics::{NumericsError, RankDecision, Tolerance, null_space, pseudo_inverse, rank, subspaces};
use crate::observer::{DesignError, NamedMatrix};

/// The system in the coordinates `x1 = E x`, `x2 = P1' x`, with the measured part of `x2` eliminated.
///
/// ```text
/// P = [E+ P1],   [A1 A2] = A P,   [C1 C2] = C P,   P3 C2 = 0
/// Ar = A1 - A2 C2+ C1,   Cr = P3 C1
/// ```
///
/// # Shapes
/// `E_pinv`: n x r; `P1`: n x (n - r); `A2`: r x (n - r); `C1`: q x r; `C2_pinv`: (n - r) x q;
/// `P3`: (q - n + r) x q; `Ar`: r x r; `Cr`: (q - n + r) x r.
///
/// # Source
/// Koenig and Mammar 2002, (15)-(18).
#[derive(Clone, Debug)]
pub struct Reduction {
    /// Right inverse of `E`.
    pub E_pinv: DMatrix<f64>,
    /// Orthonormal basis of the null space of `E`.
    pub P1: DMatrix<f64>,
    /// Coupling of `x2` into `x1`.
    pub A2: DMatrix<f64>,
    /// Output matrix of `x1`.
    pub C1: DMatrix<f64>,
    /// Left inverse of the output matrix of `x2`.
    pub C2_pinv: DMatrix<f64>,
    /// Rank of `C2`, which (22) wants to be n - r.
    pub C2_rank: RankDecision,
    /// Outputs that do not see `x2`.
    pub P3: DMatrix<f64>,
    /// State matrix of the reduced pair.
    pub Ar: DMatrix<f64>,
    /// Output matrix of the reduced pair.
    pub Cr: DMatrix<f64>,
}

/// Reduces a system whose `E` has full row rank.
///
/// # Errors
/// When a decomposition fails its check.
// ERRATUM(004, eq. 19): the print has E1+; it is E+. ERRATUM(004, Algorithm 2): A P2 is A P.
pub fn reduce(equivalent: &Equivalent, tolerance: &Tolerance) -> Result<Reduction, NumericsError> {
    let Equivalent { E, A, C, .. } = equivalent;
    let scale = C.norm();
    let E_pinv = pseudo_inverse(E, tolerance)?;
    let P1 = tidy_basis(E, null_space(E, 0.0, tolerance)?);
    let (A1, A2) = (A * &E_pinv, A * &P1);
    let (C1, C2) = (C * &E_pinv, C * &P1);
    let C2_rank = rank(&C2, scale, tolerance)?;
    let C2_pinv = pseudo_inverse(&C2, tolerance)?;
    let P3 = subspaces(&C2, scale, tolerance)?.left_null.transpose();
    let Ar = A1 - &A2 * &C2_pinv * &C1;
    let Cr = &P3 * &C1;
    Ok(Reduction { E_pinv, P1, A2, C1, C2_pinv, C2_rank, P3, Ar, Cr })
}

/// Replaces a null-space basis by unit vectors when the zero columns of `E` already span the null space.
fn tidy_basis(E: &DMatrix<f64>, basis: DMatrix<f64>) -> DMatrix<f64> {
    let zero: Vec<usize> = (0..E.ncols()).filter(|&j| E.column(j).iter().all(|x| *x == 0.0)).collect();
    if zero.len() == basis.ncols() {
        return DMatrix::identity(E.ncols(), E.ncols()).select_columns(&zero);
    }
    basis
}

/// The pair of condition (23), whose unobservable modes no reduced-order observer can move.
pub(super) fn pair(
    equivalent: &Equivalent,
    reduction: &Reduction,
    hold: f64,
) -> (DMatrix<f64>, DMatrix<f64>) {
    augmented(&reduction.Ar, &equivalent.N, &reduction.Cr, hold)
}

/// Designs the observer of order r + nf.
///
/// ```text
/// [Lb2; Lb3] places   [Ar, N; 0, 0] - [Lb2; Lb3] [Cr 0]
/// F = Ar - Lb2 Cr,   L1 = A2 C2+,   L2 = Lb2 P3,   L3 = Lb3 P3,   J = B
/// M1 = E+ - P1 C2+ C1,   T2 = P1 C2+,   T1 = I
/// ```
///
/// # Errors
/// Pole lists that do not fit, and decompositions that fail their check.
///
/// # Source
/// Koenig and Mammar 2002, (19), (20), Algorithm 2.
pub(super) fn design(
    equivalent: &Equivalent,
    hold: f64,
    request: &PoleRequest<'_>,
) -> Result<Realized, DesignError> {
    let reduction = reduce(equivalent, request.tolerance)?;
    let (Aa, Ca) = pair(equivalent, &reduction, hold);
    let placement = request.place(&Aa, &Ca)?;
    let Reduction { E_pinv, P1, A2, C1, C2_pinv, P3, Ar, Cr, .. } = reduction;
    let r = Ar.nrows();
    let Lb2 = placement.gain.rows(0, r).into_owned();
    let Lb3 = placement.gain.rows(r, equivalent.N.ncols()).into_owned();
    let matrices = Matrices {
        F: &Ar - &Lb2 * &Cr,
        L1: A2 * &C2_pinv,
        L2: &Lb2 * &P3,
        L3: &Lb3 * &P3,
        J: equivalent.B.clone(),
        M1: E_pinv - &P1 * &C2_pinv * C1,
        T1: DMatrix::identity(r, r),
        T2: P1 * C2_pinv,
    };
    let (observer, claim) = realize(equivalent, &matrices, hold);
    let mut matrices = named(matrices);
    let mut add = |name: &str, meaning: &str, value| {
        matrices.push(NamedMatrix { name: name.to_owned(), meaning: meaning.to_owned(), value });
    };
    add("Ar", "state matrix of the reduced pair", Ar);
    add("Cr", "output matrix of the reduced pair", Cr);
    add("Lb2", "proportional gain of the reduced pair", Lb2);
    add("Lb3", "integral gain of the reduced pair", Lb3);
    Ok(Realized { matrices, observer, claim, placement })
}
