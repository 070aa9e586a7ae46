//! The general design, which does not need condition (8) and takes a feedthrough F.
#![expect(non_snake_case, reason = "matrix letters follow Koenig and Mammar 2002")]

use nalgebra::DMatrix;

use super::{Equivalent, PoleRequest, Realized};
use crate::numerics::Block::{Of, Zero};
use crate::numerics::{NumericsError, Tolerance, block_matrix, pseudo_inverse, side_by_side, stack};
use crate::observer::{Claim, DesignError, LinearObserver, NamedMatrix};

/// The system augmented by its unknown input as a state, row-compressed by `E` alone.
///
/// ```text
/// Ea = [U1' E, 0; 0, I],   Aa = [U1' A, U1' D; 0, hold],   Ca = [U2' A, U2' D; C, F],   [T1 T2] = [Ea; Ca]^+
/// ```
#[derive(Clone, Debug)]
pub struct Augmented {
    /// State matrix `Aa`, (r + nf) x (n + nf).
    pub A: DMatrix<f64>,
    /// Output matrix `Ca`, q x (n + nf).
    pub C: DMatrix<f64>,
    /// Left inverse on the derivatives, (n + nf) x (r + nf).
    pub T1: DMatrix<f64>,
    /// Left inverse on the outputs, (n + nf) x q.
    pub T2: DMatrix<f64>,
}

/// Augments a row-compressed system.
///
/// # Errors
/// When a decomposition fails its check.
pub fn augment(
    equivalent: &Equivalent,
    hold: f64,
    tolerance: &Tolerance,
) -> Result<Augmented, NumericsError> {
    let Equivalent { E, A, N, N_output, C, .. } = equivalent;
    let nf = N.ncols();
    let unit = DMatrix::identity(nf, nf);
    let Ea = block_matrix(&[&[Of(E), Zero], &[Zero, Of(&unit)]]);
    let Aa = block_matrix(&[&[Of(A), Of(N)], &[Zero, Of(&(&unit * hold))]]);
    let Ca = side_by_side(&[C, N_output]);
    let T = pseudo_inverse(&stack(&[&Ea, &Ca]), tolerance)?;
    Ok(Augmented {
        T1: T.columns(0, Ea.nrows()).into_owned(),
        T2: T.columns(Ea.nrows(), Ca.nrows()).into_owned(),
        A: Aa,
        C: Ca,
    })
}

/// Designs the proportional observer of the augmented system: order n + nf, unknown input among the states.
///
/// ```text
/// z' = F z + (L1 + L2) y + J u,   [x_hat; f_hat] = z + T2 y,   F = T1 Aa - L2 Ca,   L1 = F T2,   J = T1 [B; 0]
/// ```
///
/// # Errors
/// Pole lists that do not fit, and decompositions that fail their check.
///
/// # Source
/// Extension of Koenig and Mammar 2002 (not in the paper): exists if and only if (9) and (10) hold.
/// Darouach and Boutayeb 1995 on the augmented system.
pub(super) fn design(
    equivalent: &Equivalent,
    hold: f64,
    request: &PoleRequest<'_>,
) -> Result<Realized, DesignError> {
    let Augmented { A, C, T1, T2 } = augment(equivalent, hold, request.tolerance)?;
    let Equivalent { top, bottom, B, N, y_u, y_y, .. } = equivalent;
    let (r, nf, b) = (top.nrows(), N.ncols(), bottom.nrows());
    let n = A.ncols() - nf;
    let placement = request.place(&(&T1 * &A), &C)?;
    let L2 = placement.gain.clone();
    let F = &T1 * &A - &L2 * &C;
    let L1 = &F * &T2;
    let J = &T1 * stack(&[B, &DMatrix::zeros(nf, B.ncols())]);
    let injection = &L1 + &L2;
    let unit = DMatrix::<f64>::identity(n + nf, n + nf);
    let (T2x, T2f) = (T2.rows(0, n), T2.rows(n, nf));
    let observer = LinearObserver {
        N: F.clone(),
        L: &injection * y_y,
        H: &J + &injection * y_u,
        P: unit.rows(0, n).into_owned(),
        V: T2x * y_y,
        W: T2x * y_u,
        Q: unit.rows(n, nf).into_owned(),
        R: T2f * y_y,
        S: T2f * y_u,
    };
    let claim = Claim {
        T: side_by_side(&[
            &(T1.columns(0, r) * top - injection.columns(0, b) * bottom),
            &T1.columns(r, nf).into_owned(),
        ]),
        G: T2.columns(0, b) * bottom,
    };
    let named = |(name, meaning, value): (&str, &str, DMatrix<f64>)| NamedMatrix {
        name: name.to_owned(),
        meaning: meaning.to_owned(),
        value,
    };
    let matrices = [
        ("F", "observer state matrix", F),
        ("L1", "injection F T2", L1),
        ("L2", "injection that places the poles", L2),
        ("J", "known input", J),
        ("T1", "left inverse on the derivatives", T1),
        ("T2", "left inverse on the extended outputs", T2),
    ];
    Ok(Realized { matrices: matrices.into_iter().map(named).collect(), observer, claim, placement })
}
