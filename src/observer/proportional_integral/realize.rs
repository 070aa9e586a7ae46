//! From the paper's matrices to the common runnable form and its claim.
#![expect(non_snake_case, reason = "matrix letters follow Koenig and Mammar 2002")]

use nalgebra::DMatrix;

use super::Equivalent;
use crate::numerics::Block::{Minus, Of, Zero};
use crate::numerics::{block_matrix, side_by_side, stack};
use crate::observer::{Claim, LinearObserver};

/// Matrices of observer (5), which full and reduced order share.
///
/// ```text
/// z'     = F z + (L1 + L2) y + J u + T1 N f_hat
/// f_hat' = L3 (y - C x_hat)          (discrete: f_hat[k+1] = f_hat + L3 (y - C x_hat))
/// x_hat  = M1 z + T2 y
/// ```
#[derive(Clone, Debug)]
pub(super) struct Matrices {
    /// Observer state matrix.
    pub(super) F: DMatrix<f64>,
    /// Injection of the output that belongs to `F T2`.
    pub(super) L1: DMatrix<f64>,
    /// Injection that places the poles.
    pub(super) L2: DMatrix<f64>,
    /// Integral gain.
    pub(super) L3: DMatrix<f64>,
    /// Known input.
    pub(super) J: DMatrix<f64>,
    /// Observer state to state estimate.
    pub(super) M1: DMatrix<f64>,
    /// What `z` tracks: `z -> T1 E x`.
    pub(super) T1: DMatrix<f64>,
    /// Output to state estimate.
    pub(super) T2: DMatrix<f64>,
}

/// The runnable observer on the measured output `y*`, with `hold` = 0 (continuous) or 1 (discrete) in the integral row.
///
/// # Source
/// Koenig and Mammar 2002, (5) and (7).
// ERRATUM(004, eq. 5): the print has L2 y_hat; L2 multiplies y. With y_hat the error matrix of the example is unstable.
pub(super) fn realize(equivalent: &Equivalent, m: &Matrices, hold: f64) -> (LinearObserver, Claim) {
    let Equivalent { top, bottom, N, C, y_u, y_y, .. } = equivalent;
    let Matrices { F, L1, L2, L3, J, M1, T1, T2 } = m;
    let (nz, nf, n, b) = (F.nrows(), N.ncols(), C.ncols(), bottom.nrows());
    let (k, p, q) = (y_u.ncols(), y_y.ncols(), C.nrows());
    let T1N = T1 * N;
    let integral = -(L3 * C * M1);
    let hold = DMatrix::identity(nf, nf) * hold;
    // injection of the extended output y = y_u u + y_y y*
    let into_z = L1 + L2;
    let into_f = L3 * (DMatrix::identity(q, q) - C * T2);
    let injection = stack(&[&into_z, &into_f]);
    let observer = LinearObserver {
        N: block_matrix(&[&[Of(F), Of(&T1N)], &[Of(&integral), Of(&hold)]]),
        L: &injection * y_y,
        H: stack(&[J, &DMatrix::zeros(nf, k)]) + &injection * y_u,
        P: side_by_side(&[M1, &DMatrix::zeros(n, nf)]),
        V: T2 * y_y,
        W: T2 * y_u,
        Q: side_by_side(&[&DMatrix::zeros(nf, nz), &DMatrix::identity(nf, nf)]),
        R: DMatrix::zeros(nf, p),
        S: DMatrix::zeros(nf, k),
    };
    // z - T1 E x, written with the algebraic rows that the injection of -B1 u = A1 x uses
    let track = T1 * top - into_z.columns(0, b) * bottom;
    let track_f = into_f.columns(0, b) * bottom;
    let claim = Claim {
        T: block_matrix(&[&[Of(&track), Zero], &[Minus(&track_f), Of(&DMatrix::identity(nf, nf))]]),
        G: stack(&[&(T2.columns(0, b) * bottom), &DMatrix::zeros(nf, top.ncols())]),
    };
    (observer, claim)
}
