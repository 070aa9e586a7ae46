//! From a reduction and a gain to Theorem 2's observer, its runnable form and its claim.
#![expect(non_snake_case, reason = "matrix letters follow paper 001")]

use nalgebra::DMatrix;

use super::{Coordinates, Reduction};
use crate::numerics::{side_by_side, stack};
use crate::observer::{Claim, LinearObserver};

/// The paper's matrices of Theorem 2.
///
/// ```text
/// z'    = H z + J1 u + J2 y
/// x_hat = K z + T1 u + T2 y
/// d_hat = G z + Q1 u + Q2 y
/// ```
#[derive(Clone, Debug)]
pub(super) struct Theorem2 {
    pub(super) H: DMatrix<f64>,
    pub(super) J1: DMatrix<f64>,
    pub(super) J2: DMatrix<f64>,
    pub(super) K: DMatrix<f64>,
    pub(super) T1: DMatrix<f64>,
    pub(super) T2: DMatrix<f64>,
    pub(super) G: DMatrix<f64>,
    pub(super) Q1: DMatrix<f64>,
    pub(super) Q2: DMatrix<f64>,
}

impl Theorem2 {
    /// The observer of a reduction with the gain `Lc` (r x s) on the pair's output.
    ///
    /// ```text
    /// H = A - Lc C,   J1 = B + Lc U_out,   J2 = Y + Lc Y_out
    /// K = N [I; R1x],  T1 = N [0; R2x],  T2 = N [0; R3x],   G = R1d,  Q1 = R2d,  Q2 = R3d
    /// ```
    ///
    /// # Source
    /// Paper 001, Theorem 2.
    // ERRATUM(001, section III): the example's G is printed [5/3 4/3]; it is [5/3 -4/3].
    pub(super) fn new(at: &Coordinates, reduction: &Reduction, Lc: &DMatrix<f64>) -> Self {
        let Reduction { A, B, Y, C, U_out, Y_out, R1, R2, R3, .. } = reduction;
        let x2 = at.N2.ncols();
        let states = |R: &DMatrix<f64>| &at.N2 * R.rows(0, x2);
        let inputs = |R: &DMatrix<f64>| R.rows(x2, R.nrows() - x2).into_owned();
        Self {
            H: A - Lc * C,
            J1: B + Lc * U_out,
            J2: Y + Lc * Y_out,
            K: &at.N1 + states(R1),
            T1: states(R2),
            T2: states(R3),
            G: inputs(R1),
            Q1: inputs(R2),
            Q2: inputs(R3),
        }
    }

    /// The common runnable form.
    pub(super) fn observer(&self) -> LinearObserver {
        let Self { H, J1, J2, K, T1, T2, G, Q1, Q2 } = self.clone();
        LinearObserver { N: H, L: J2, H: J1, P: K, V: T2, W: T1, Q: G, R: Q2, S: Q1 }
    }
}

/// What the observer claims: `z` tracks `x1 = T E x` with no share of the unknown input.
///
/// ```text
/// T = [M1 + (state + Lc output) M2, 0],   G = [N2 0; 0 I] estimate M2
/// ```
pub(super) fn claim(at: &Coordinates, reduction: &Reduction, Lc: &DMatrix<f64>) -> Claim {
    let Coordinates { M1, M2, N2, .. } = at;
    let Reduction { state, output, estimate, .. } = reduction;
    let (x2, q) = (N2.ncols(), at.F.ncols());
    let track = M1 + (state + Lc * output) * M2;
    let states = N2 * estimate.rows(0, x2) * M2;
    let inputs = estimate.rows(x2, q) * M2;
    Claim { T: side_by_side(&[&track, &DMatrix::zeros(track.nrows(), q)]), G: stack(&[&states, &inputs]) }
}
