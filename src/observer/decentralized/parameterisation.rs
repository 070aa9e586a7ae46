//! All observers of one subsystem, as affine functions of free matrices `Y` and `Z`.
#![expect(non_snake_case, reason = "matrix letters follow paper 000")]

use nalgebra::DMatrix;

use super::decoupled::{Decoupled, left_null, tidy};
use crate::numerics::{NumericsError, Tolerance, pseudo_inverse, stack, subspaces};

/// The observers of one subsystem for a given `R`.
///
/// ```text
/// N = Lambda_N - Y L_N,   Psi = Lambda_Psi - Y L_Psi,   T_bar D2_bar = Lambda_T - Y L_T
/// P = Lambda_P - Z M_P,   Q = Lambda_Q - Z M_Q
/// ```
///
/// The rows `[L_N L_Psi L_J]` are an orthonormal basis of the left null space of `Omega`: the paper's projector
/// `I - Omega Omega+` in their place has flat directions and entries that should be zero, which a solver exploits.
/// Directions of `Y` and `Z` that change neither the dynamics nor the estimate's response are left out: they are zero.
///
/// # Shapes
/// `Lambda_N`: beta x beta; `Lambda_Psi`: beta x r; `Lambda_T`: beta x q2; `L_N`, `L_Psi`, `L_T`: l rows;
/// `Lambda_P`: n x beta; `Lambda_Q`: n x r; `M_P`, `M_Q`: k rows.
///
/// # Source
/// Paper 000, (23)-(28); the extension `extended` is described at [`super::extended::extended`].
// ERRATUM(000, Delta_Psi): Omega Omega+ lacks its index i; the delta matrices are the blocks of L here.
#[derive(Clone, Debug, PartialEq)]
pub struct Parameterisation {
    /// The matrix R that fixes the order, beta x n.
    pub R: DMatrix<f64>,
    /// `N` at `Y = 0`.
    pub Lambda_N: DMatrix<f64>,
    /// `Psi` at `Y = 0`.
    pub Lambda_Psi: DMatrix<f64>,
    /// `T_bar D2_bar` at `Y = 0`.
    pub Lambda_T: DMatrix<f64>,
    /// What `Y` does to `N`.
    pub L_N: DMatrix<f64>,
    /// What `Y` does to `Psi`.
    pub L_Psi: DMatrix<f64>,
    /// What `Y` does to `T_bar D2_bar`; zero in the paper's parameterisation.
    pub L_T: DMatrix<f64>,
    /// `P` at `Z = 0`.
    pub Lambda_P: DMatrix<f64>,
    /// `Q` at `Z = 0`.
    pub Lambda_Q: DMatrix<f64>,
    /// What `Z` does to `P`.
    pub M_P: DMatrix<f64>,
    /// What `Z` does to `Q`.
    pub M_Q: DMatrix<f64>,
    /// Orthonormal columns: the directions of the paper's `Y` (and of `S`) that matter.
    keep_Y: DMatrix<f64>,
    /// Orthonormal columns: the directions of the paper's `Z` that matter.
    keep_Z: DMatrix<f64>,
    recipe: Recipe,
}

/// What turns `Y` and `Z` into the matrices of an observer.
///
/// ```text
/// T_bar = T_0 - S N_E                                        (S and N_E have no rows in the paper's form)
/// [N Psi J] = T_bar A_bar Omega+ - Y' L - N S [0 0 N_H],   [P Q F] = Omega+ - Z L - P S [0 0 N_H]
/// ```
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Recipe {
    pub(super) T_0: DMatrix<f64>,
    pub(super) N_E: DMatrix<f64>,
    pub(super) N_H: DMatrix<f64>,
    pub(super) Omega: DMatrix<f64>,
    pub(super) Omega_pinv: DMatrix<f64>,
    pub(super) L: DMatrix<f64>,
}

/// The matrices of one local observer under the paper's names.
///
/// ```text
/// s.xi = N xi + M u + J z,   x_hat = P xi - Q Phi B u + F z
/// ```
///
/// # Source
/// Paper 000, (11), (12).
#[derive(Clone, Debug, PartialEq)]
pub struct LocalMatrices {
    /// State matrix.
    pub N: DMatrix<f64>,
    /// Known input.
    pub M: DMatrix<f64>,
    /// Output injection.
    pub J: DMatrix<f64>,
    /// Observer state to estimate.
    pub P: DMatrix<f64>,
    /// Algebraic equations in the estimate: `x_hat = ... - Q Phi B u`.
    pub Q: DMatrix<f64>,
    /// Output to estimate.
    pub F: DMatrix<f64>,
    /// What the observer tracks: `xi -> T E x`.
    pub T: DMatrix<f64>,
    /// `T = T' - Psi Phi`.
    pub Psi: DMatrix<f64>,
}

impl Parameterisation {
    /// The paper's parameterisation for a given `R`.
    ///
    /// ```text
    /// [T_bar K] = R Theta+,   Omega = [T_bar E_bar; Phi A; H],   [N Psi J] = T_bar A_bar Omega+ - Y L
    /// ```
    ///
    /// # Errors
    /// When a decomposition fails its check.
    ///
    /// # Source
    /// Paper 000, (23), (25)-(27).
    // ERRATUM(000, eq. 27): Omega_i is printed with n_i + r_phi + m_i rows; it has beta_i + r_phi + m_i.
    pub fn paper(
        decoupled: &Decoupled,
        R: &DMatrix<f64>,
        tolerance: &Tolerance,
    ) -> Result<Self, NumericsError> {
        Self::assemble(decoupled, R, Recipe::paper(decoupled, R, tolerance)?, tolerance)
    }

    /// The affine functions of a recipe, with the directions left out that do not matter.
    ///
    /// # Errors
    /// When a decomposition fails its check.
    pub(super) fn assemble(
        decoupled: &Decoupled,
        R: &DMatrix<f64>,
        recipe: Recipe,
        tolerance: &Tolerance,
    ) -> Result<Self, NumericsError> {
        let Decoupled { A_bar, D2_bar, Phi_D2, .. } = decoupled;
        let (beta, r) = (R.nrows(), Phi_D2.nrows());
        let Recipe { T_0, N_E, Omega_pinv, L, .. } = &recipe;
        let Lambda = product(&[T_0, A_bar, Omega_pinv]);
        let free = stack(&[&product(&[N_E, A_bar, Omega_pinv]), L]);
        let estimate = product(&[Omega_pinv]);
        let of_state = |m: &DMatrix<f64>| m.columns(0, beta).into_owned();
        let of_phi = |m: &DMatrix<f64>| m.columns(beta, r).into_owned();
        let (L_N, L_Psi) = (of_state(&free), of_phi(&free));
        let L_T = stack(&[&product(&[N_E, D2_bar]), &DMatrix::zeros(L.nrows(), D2_bar.ncols())]);
        let (M_P, M_Q) = (of_state(L), of_phi(L));
        let keep_Y = effective(&[&L_N, &(&L_T - &L_Psi * Phi_D2)], tolerance)?;
        let keep_Z = effective(&[&M_P, &(&M_Q * Phi_D2)], tolerance)?;
        Ok(Self {
            R: R.clone(),
            Lambda_N: of_state(&Lambda),
            Lambda_Psi: of_phi(&Lambda),
            Lambda_T: product(&[T_0, D2_bar]),
            L_N: keep_Y.tr_mul(&L_N),
            L_Psi: keep_Y.tr_mul(&L_Psi),
            L_T: keep_Y.tr_mul(&L_T),
            Lambda_P: of_state(&estimate),
            Lambda_Q: of_phi(&estimate),
            M_P: keep_Z.tr_mul(&M_P),
            M_Q: keep_Z.tr_mul(&M_Q),
            keep_Y,
            keep_Z,
            recipe,
        })
    }

    /// Order beta of the observer.
    pub fn order(&self) -> usize {
        self.R.nrows()
    }

    /// `Omega = [T_bar E_bar; Phi A; H]`, of rank n.
    pub fn omega(&self) -> &DMatrix<f64> {
        &self.recipe.Omega
    }

    /// `T_bar` at `Y = 0`.
    pub fn t_bar(&self) -> &DMatrix<f64> {
        &self.recipe.T_0
    }

    /// `J` and `F` at zero free matrices.
    pub fn lambda_output(&self, decoupled: &Decoupled) -> (DMatrix<f64>, DMatrix<f64>) {
        let zero = |rows, columns| DMatrix::zeros(rows, columns);
        let n = decoupled.n_states();
        let found =
            self.recover(decoupled, &zero(self.order(), self.L_N.nrows()), &zero(n, self.M_P.nrows()));
        (found.J, found.F)
    }

    /// Orthonormal rows of the left null space of `Omega`.
    pub fn left_null_of_omega(&self) -> &DMatrix<f64> {
        &self.recipe.L
    }

    /// The observer of given free matrices.
    ///
    /// # Shapes
    /// `Y`: beta x rows of `L_N`; `Z`: n x rows of `M_P`.
    ///
    /// # Source
    /// Paper 000, (19), (21), (27).
    pub fn recover(&self, decoupled: &Decoupled, Y: &DMatrix<f64>, Z: &DMatrix<f64>) -> LocalMatrices {
        let Recipe { T_0, N_E, N_H, Omega_pinv, L, .. } = &self.recipe;
        let Decoupled { A_bar, Phi, Pi, B, .. } = decoupled;
        let (beta, r, m) = (self.order(), Phi.nrows(), N_H.ncols());
        let free = Y * self.keep_Y.transpose();
        let (S, Y) = (free.columns(0, N_E.nrows()), free.columns(N_E.nrows(), L.nrows()));
        let T_bar = T_0 - S * N_E;
        // (27)
        let dynamics = &T_bar * A_bar * Omega_pinv - Y * L;
        let estimate = Omega_pinv - Z * self.keep_Z.transpose() * L;
        let parts = |joined: &DMatrix<f64>| {
            let of_state = joined.columns(0, beta).into_owned();
            let of_output = joined.columns(beta + r, m) - &of_state * S * N_H;
            (of_state, joined.columns(beta, r).into_owned(), of_output)
        };
        let (N, Psi, J) = parts(&dynamics);
        let (P, Q, F) = parts(&estimate);
        // (19), (21): T = T_bar Pi - Psi Phi
        let T = T_bar * Pi - &Psi * Phi;
        LocalMatrices { M: &T * B, N, J, P, Q, F, T, Psi }
    }
}

impl Recipe {
    /// `T_bar` and `Omega` of the paper.
    ///
    /// # Errors
    /// When a decomposition fails its check.
    pub(super) fn paper(
        decoupled: &Decoupled,
        R: &DMatrix<f64>,
        tolerance: &Tolerance,
    ) -> Result<Self, NumericsError> {
        let Decoupled { E_bar, Phi_A, H, .. } = decoupled;
        // (25)
        let Theta_pinv = pseudo_inverse(&decoupled.theta(), tolerance)?;
        let of_equations = Theta_pinv.columns(0, E_bar.nrows()).into_owned();
        let T_bar = product(&[R, &of_equations]);
        let Omega = stack(&[&product(&[&T_bar, E_bar]), Phi_A, H]);
        Ok(Self {
            N_E: DMatrix::zeros(0, E_bar.nrows()),
            N_H: DMatrix::zeros(0, H.nrows()),
            Omega_pinv: pseudo_inverse(&Omega, tolerance)?,
            L: left_null(&Omega, tolerance)?,
            T_0: T_bar,
            Omega,
        })
    }
}

/// The product of matrices with entries that are rounding set to zero.
fn product(factors: &[&DMatrix<f64>]) -> DMatrix<f64> {
    let size = factors.iter().map(|factor| factor.norm()).product();
    let Some((first, rest)) = factors.split_first() else { return DMatrix::zeros(0, 0) };
    tidy(rest.iter().fold((*first).clone(), |left, right| left * *right), size)
}

/// Orthonormal columns that span the rows' combinations on which at least one of the matrices depends.
fn effective(matrices: &[&DMatrix<f64>], tolerance: &Tolerance) -> Result<DMatrix<f64>, NumericsError> {
    let rows = matrices.first().map_or(0, |m| m.nrows());
    let scaled: Vec<DMatrix<f64>> = matrices.iter().map(|m| super::decoupled::scaled_to(m, m)).collect();
    let joined = crate::numerics::side_by_side(&scaled.iter().collect::<Vec<_>>());
    let found = subspaces(&joined, 0.0, tolerance)?;
    if found.rank.rank == rows {
        return Ok(DMatrix::identity(rows, rows));
    }
    // in the coordinates as they are when the rows that matter are simply those that are not zero
    let nonzero: Vec<usize> = (0..rows).filter(|&i| joined.row(i).iter().any(|x| *x != 0.0)).collect();
    if nonzero.len() == found.rank.rank {
        return Ok(DMatrix::identity(rows, rows).select_columns(&nonzero));
    }
    Ok(found.range)
}

#[cfg(test)]
#[path = "parameterisation_tests.rs"]
mod tests;
