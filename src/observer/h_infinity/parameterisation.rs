//! All observers of a given `R`, as affine functions of one free matrix.
#![expect(non_snake_case, reason = "matrix letters follow paper 002")]

use nalgebra::DMatrix;

use super::basis::{clean_inverse, inexact_product, orthonormal_rows, product, tidy};
use super::plant::Plant;
use crate::numerics::{NumericsError, Tolerance, null_space, pseudo_inverse, side_by_side, stack, subspaces};
use crate::observer::Order;

/// The observers that belong to a matrix `R`, for a free matrix `Z`.
///
/// ```text
/// N = Lambda_N - Z L_N,   Psi = Lambda_Psi - Z L_Psi,   J = Lambda_J - Z L_J,   T = T_tilde - Psi Phi
/// T G = Lambda_TG - Z L_TG,   phi1 = J F - T D = Lambda_phi1 - Z L_phi1
/// ```
///
/// The rows `[L_N L_Psi L_J]` are an orthonormal basis of the left null space of `Omega`. The paper has the projector
/// `I - Omega Omega+` in their place: the same observers, but with flat directions and entries that are zero only up to
/// rounding, which a solver exploits.
///
/// # Shapes
/// q = rows of `R`, l = q + r + p - n: `Lambda_N` q x q, `Lambda_Psi` q x r, `Lambda_J` q x p, `Lambda_TG` q x nf,
/// `Lambda_phi1` q x nd, the matrices `L_*` l rows, `P` n x q, `Q` n x r, `V` n x p, `phi2` n x nd.
///
/// # Source
/// Paper 002, (38)-(51).
#[derive(Clone, Debug, PartialEq)]
pub struct Parameterisation {
    /// The matrix that fixes the order.
    pub R: DMatrix<f64>,
    /// `T` at `Psi = 0`, the paper's T with a tilde.
    pub T_tilde: DMatrix<f64>,
    /// `[T_tilde E; Phi A; C]`.
    pub Omega: DMatrix<f64>,
    /// `N` at `Z = 0`.
    pub Lambda_N: DMatrix<f64>,
    /// `Psi` at `Z = 0`.
    pub Lambda_Psi: DMatrix<f64>,
    /// `J` at `Z = 0`.
    pub Lambda_J: DMatrix<f64>,
    /// `T G` at `Z = 0`.
    pub Lambda_TG: DMatrix<f64>,
    /// `phi1` at `Z = 0`.
    pub Lambda_phi1: DMatrix<f64>,
    /// What `Z` does to `N`.
    pub L_N: DMatrix<f64>,
    /// What `Z` does to `Psi`.
    pub L_Psi: DMatrix<f64>,
    /// What `Z` does to `J`.
    pub L_J: DMatrix<f64>,
    /// What `Z` does to `T G`.
    pub L_TG: DMatrix<f64>,
    /// What `Z` does to `phi1`.
    pub L_phi1: DMatrix<f64>,
    /// Observer state to estimate.
    pub P: DMatrix<f64>,
    /// Algebraic equations to estimate.
    pub Q: DMatrix<f64>,
    /// Output to estimate, the paper's F.
    pub V: DMatrix<f64>,
    /// `Q Phi G`: the nonlinearity in the estimate.
    pub Q_Phi_G: DMatrix<f64>,
    /// `Q Phi D + V F`: the disturbance in the error.
    pub phi2: DMatrix<f64>,
}

/// One observer of the family under the paper's names; its F is `V`.
#[derive(Clone, Debug, PartialEq)]
pub struct Matrices {
    /// State matrix, q x q.
    pub N: DMatrix<f64>,
    /// Output injection, q x p.
    pub J: DMatrix<f64>,
    /// Known input, q x k.
    pub H: DMatrix<f64>,
    /// What the observer tracks: `z -> T E x`, q x e.
    pub T: DMatrix<f64>,
    /// `T = T_tilde - Psi Phi`, q x r.
    pub Psi: DMatrix<f64>,
    /// Observer state to estimate, n x q.
    pub P: DMatrix<f64>,
    /// Algebraic equations to estimate, n x r.
    pub Q: DMatrix<f64>,
    /// Output to estimate, n x p.
    pub V: DMatrix<f64>,
}

/// The `R` of an order when none is given: `I`, rows that complete `C`, or rows that complete `[Phi A; C]`.
///
/// # Errors
/// When a decomposition fails its check.
pub fn default_rows(
    plant: &Plant,
    order: Order,
    tolerance: &Tolerance,
) -> Result<DMatrix<f64>, NumericsError> {
    let n = plant.n();
    let unseen = |matrix: &DMatrix<f64>| {
        null_space(matrix, 0.0, tolerance).map(|basis| orthonormal_rows(&basis.transpose()))
    };
    match order {
        Order::Full | Order::General => Ok(DMatrix::identity(n, n)),
        Order::Reduced => unseen(&plant.system.C),
        Order::Minimal => unseen(&plant.known()),
    }
}

impl Parameterisation {
    /// All observers of a given `R`, which has full row rank and completes `[Phi A; C]` to rank n.
    ///
    /// # Errors
    /// When a decomposition fails its check.
    pub fn new(plant: &Plant, R: &DMatrix<f64>, tolerance: &Tolerance) -> Result<Self, NumericsError> {
        let system = &plant.system;
        let (e, q, r, p) = (system.n_equations(), R.nrows(), plant.Phi.nrows(), system.n_outputs());
        // (45), (46): [T_tilde K] = R [E; Phi A; C]+
        let (Theta_pinv, of_Theta) = clean_inverse(&plant.Theta(), tolerance)?;
        let T_K = inexact_product(&[R, &Theta_pinv], of_Theta);
        let T_tilde = T_K.columns(0, e).into_owned();
        // ERRATUM(002, definition of Omega): the copied text has T, which Phi E = 0 makes the same; T is not known yet
        let Omega = stack(&[&product(&[&T_tilde, &system.E]), &plant.known()]);
        let (Omega_pinv, of_Omega) = clean_inverse(&Omega, tolerance)?;
        let noise = of_Theta + of_Omega;
        let L = orthonormal_rows(&subspaces(&Omega, 0.0, tolerance)?.left_null.transpose());
        // (47): [N Psi J] = T_tilde A Omega+ - Z L,   (48): [P Q F] = Omega+
        let Lambda = inexact_product(&[&T_tilde, &system.A, &Omega_pinv], noise);
        let parts = |joined: &DMatrix<f64>| {
            let part = |from, width| joined.columns(from, width).into_owned();
            (part(0, q), part(q, r), part(q + r, p))
        };
        let ((Lambda_N, Lambda_Psi, Lambda_J), (L_N, L_Psi, L_J)) = (parts(&Lambda), parts(&L));
        let (P, Q, V) = parts(&Omega_pinv);
        let (Phi_G, Phi_D) = (product(&[&plant.Phi, &plant.acting()]), product(&[&plant.Phi, &system.D]));
        let sum = |terms: [DMatrix<f64>; 2]| {
            tidy(&(&terms[0] + &terms[1]), noise * (terms[0].norm() + terms[1].norm()))
        };
        // ERRATUM(002, Delta_TD): the copied text has -Delta_Psi Lambda Phi D; the Lambda belongs to the next symbol
        let Lambda_TG = sum([product(&[&T_tilde, &plant.acting()]), -product(&[&Lambda_Psi, &Phi_G])]);
        let L_TG = -product(&[&L_Psi, &Phi_G]);
        let direct = sum([product(&[&Lambda_J, &system.F]), -product(&[&T_tilde, &system.D])]);
        Ok(Self {
            Lambda_phi1: sum([direct, product(&[&Lambda_Psi, &Phi_D])]),
            L_phi1: sum([product(&[&L_J, &system.F]), product(&[&L_Psi, &Phi_D])]),
            Q_Phi_G: product(&[&Q, &Phi_G]),
            phi2: sum([product(&[&Q, &Phi_D]), product(&[&V, &system.F])]),
            R: R.clone(),
            T_tilde,
            Omega,
            Lambda_N,
            Lambda_Psi,
            Lambda_J,
            Lambda_TG,
            L_N,
            L_Psi,
            L_J,
            L_TG,
            P,
            Q,
            V,
        })
    }

    /// Order q of the observers.
    pub fn order(&self) -> usize {
        self.R.nrows()
    }

    /// Number of columns of the free matrix.
    pub fn free_columns(&self) -> usize {
        self.L_N.nrows()
    }

    /// The family without directions of `Z` that change nothing in the error, such as the split between equal sensors.
    ///
    /// # Errors
    /// When a decomposition fails its check.
    pub fn without_idle_directions(self, tolerance: &Tolerance) -> Result<Self, NumericsError> {
        let effect = side_by_side(&[&self.L_N, &self.L_TG, &self.L_phi1]);
        let found = subspaces(&effect, 1.0, tolerance)?;
        if found.rank.rank == effect.nrows() {
            return Ok(self);
        }
        let keep = orthonormal_rows(&found.range.transpose());
        let kept = |m: &DMatrix<f64>| product(&[&keep, m]);
        Ok(Self {
            L_N: kept(&self.L_N),
            L_Psi: kept(&self.L_Psi),
            L_J: kept(&self.L_J),
            L_TG: kept(&self.L_TG),
            L_phi1: kept(&self.L_phi1),
            ..self
        })
    }

    /// The observer of a free matrix, q x l.
    ///
    /// # Source
    /// Paper 002, (47), (48); `T = T_tilde - Psi Phi`, `H = T B`.
    // ERRATUM(002, before 38): "T = T + Psi Phi" of the copied text is T_tilde = T + Psi Phi
    pub fn recover(&self, plant: &Plant, Z: &DMatrix<f64>) -> Matrices {
        let Psi = &self.Lambda_Psi - Z * &self.L_Psi;
        let T = &self.T_tilde - &Psi * &plant.Phi;
        Matrices {
            N: &self.Lambda_N - Z * &self.L_N,
            J: &self.Lambda_J - Z * &self.L_J,
            H: &T * &plant.system.B,
            T,
            Psi,
            P: self.P.clone(),
            Q: self.Q.clone(),
            V: self.V.clone(),
        }
    }

    /// The family that has one member alone: the one of a free matrix, q x l.
    pub fn fixed_at(&self, Z: &DMatrix<f64>) -> Self {
        let none = |m: &DMatrix<f64>| DMatrix::zeros(0, m.ncols());
        Self {
            Lambda_N: &self.Lambda_N - Z * &self.L_N,
            Lambda_Psi: &self.Lambda_Psi - Z * &self.L_Psi,
            Lambda_J: &self.Lambda_J - Z * &self.L_J,
            Lambda_TG: &self.Lambda_TG - Z * &self.L_TG,
            Lambda_phi1: &self.Lambda_phi1 - Z * &self.L_phi1,
            L_N: none(&self.L_N),
            L_Psi: none(&self.L_Psi),
            L_J: none(&self.L_J),
            L_TG: none(&self.L_TG),
            L_phi1: none(&self.L_phi1),
            ..self.clone()
        }
    }

    /// The free matrix of the member nearest to given `N` and `J`.
    ///
    /// `N` decides how the error behaves, hence it is matched first, by least squares; what that leaves open is matched
    /// to `J`.
    ///
    /// # Errors
    /// When a decomposition fails its check.
    pub fn nearest(
        &self,
        N: &DMatrix<f64>,
        J: &DMatrix<f64>,
        tolerance: &Tolerance,
    ) -> Result<DMatrix<f64>, NumericsError> {
        let by_N = (&self.Lambda_N - N) * pseudo_inverse(&self.L_N, tolerance)?;
        let open = subspaces(&self.L_N, 1.0, tolerance)?.left_null;
        let rest = &self.Lambda_J - J - &by_N * &self.L_J;
        let by_J = rest * pseudo_inverse(&open.tr_mul(&self.L_J), tolerance)?;
        Ok(by_N + by_J * open.transpose())
    }
}
