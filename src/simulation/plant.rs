//! The plant reduced to its differential states.

use nalgebra::{DMatrix, DVector, Dyn, LU};
use serde::{Deserialize, Serialize};

use super::uncertainty::Varying;
use super::{SimulationError, Uncertainty};
use crate::numerics::{RankDecision, Tolerance, svd};
use crate::system::{DescriptorSystem, TimeDomain};

/// A square descriptor system of index 1 in the singular value coordinates of `E`, ready to run.
///
/// ```text
/// E = U1 S V1',   U = [U1 U2], V = [V1 V2] orthogonal,   x = V1 xi + V2 eta
/// S xi' = U1' (A(t) x + B u + D d)
///     0 = U2' (A(t) x + B u + D d)       =>   eta = -A22(t)^-1 U2' (A(t) V1 xi + B u + D d),   A22 = U2' A V2
/// ```
///
/// `E` is constant, so the coordinates are; `A(t)` may vary, so `eta` is eliminated at every evaluation.
#[derive(Clone, Debug)]
pub struct Plant {
    system: DescriptorSystem,
    pub(super) varying: Vec<Varying>,
    /// `S^-1 U1'`, r x n.
    rows: DMatrix<f64>,
    /// `U2'`, (n - r) x n.
    pub(super) algebraic_rows: DMatrix<f64>,
    /// `V1`, n x r.
    columns: DMatrix<f64>,
    /// `V2`, n x (n - r).
    pub(super) algebraic_columns: DMatrix<f64>,
    index: RankDecision,
    pub(super) tolerance: Tolerance,
}

/// What became of a given initial state: `E x` is kept, the rest follows from the algebraic equations.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct InitialState {
    /// The state that was given.
    pub given: Vec<f64>,
    /// The consistent state that the plant starts from.
    pub consistent: Vec<f64>,
    /// Largest change of an entry.
    pub change: f64,
}

/// `A` and the factors of `A22` at one instant.
#[derive(Clone, Debug)]
pub(super) struct Frozen {
    a: DMatrix<f64>,
    a22: LU<f64, Dyn, Dyn>,
}

impl Plant {
    /// Prepares a system, and checks that it is square and of index 1.
    ///
    /// # Tolerance
    /// The ranks of `E` and of `A22`, the latter relative to the norm of `A`.
    ///
    /// # Errors
    /// [`SimulationError`] for a malformed system or uncertainty, a system that is not square, or not of index 1.
    ///
    /// # Source
    /// Singular value coordinates: D. J. Bender, A. J. Laub, The linear-quadratic optimal regulator for descriptor
    /// systems, IEEE Transactions on Automatic Control 32, 1987.
    pub fn new(
        system: &DescriptorSystem,
        uncertainty: Option<&Uncertainty>,
        tolerance: &Tolerance,
    ) -> Result<Self, SimulationError> {
        let system = system.clone().checked()?;
        let (equations, states) = system.E.shape();
        if equations != states {
            return Err(SimulationError::NotSquare { equations, states });
        }
        let varying = uncertainty.map_or(Ok(Vec::new()), |u| u.varying(&system.A))?;
        // E = U1 S V1'
        let e = svd(&system.E)?;
        let r = RankDecision::from_singular_values((states, states), e.s.clone(), 0.0, tolerance).rank;
        let mut rows = e.u.columns(0, r).transpose();
        for (mut row, s) in rows.row_iter_mut().zip(&e.s) {
            row /= *s;
        }
        let algebraic_rows = e.u.columns(r, states - r).transpose();
        let algebraic_columns = e.v.columns(r, states - r).into_owned();
        // A22 = U2' A V2
        let a22 = svd(&(&algebraic_rows * &system.A * &algebraic_columns))?.s;
        let shape = (states - r, states - r);
        let index = RankDecision::from_singular_values(shape, a22, system.A.norm(), tolerance);
        if index.rank < states - r {
            return Err(SimulationError::NotIndexOne {
                algebraic: states - r,
                smallest: index.smallest(),
                threshold: index.threshold,
            });
        }
        let columns = e.v.columns(0, r).into_owned();
        Ok(Self {
            system,
            varying,
            rows,
            algebraic_rows,
            columns,
            algebraic_columns,
            index,
            tolerance: *tolerance,
        })
    }

    /// The system that runs.
    pub fn system(&self) -> &DescriptorSystem {
        &self.system
    }

    /// The decision that `A22` is regular at time zero, with its singular values.
    pub fn index_decision(&self) -> &RankDecision {
        &self.index
    }

    /// Number of differential states, the rank of `E`.
    pub fn order(&self) -> usize {
        self.columns.ncols()
    }

    /// Whether `A` varies in time.
    pub fn varies(&self) -> bool {
        !self.varying.is_empty()
    }

    pub(super) fn is_discrete(&self) -> bool {
        self.system.time == TimeDomain::Discrete
    }

    /// The same plant without its uncertainty.
    pub(super) fn nominal(&self) -> Self {
        Self { varying: Vec::new(), ..self.clone() }
    }

    /// `A(t)`.
    pub(super) fn state_matrix(&self, t: f64) -> DMatrix<f64> {
        let mut a = self.system.A.clone();
        for entry in &self.varying {
            a[(entry.row, entry.column)] += entry.deviation(t);
        }
        a
    }

    /// `A22(t)`.
    pub(super) fn algebraic_block(&self, t: f64) -> DMatrix<f64> {
        &self.algebraic_rows * self.state_matrix(t) * &self.algebraic_columns
    }

    /// Everything that an evaluation at time `t` needs.
    pub(super) fn freeze(&self, t: f64) -> Frozen {
        let a = self.state_matrix(t);
        let a22 = (&self.algebraic_rows * &a * &self.algebraic_columns).lu();
        Frozen { a, a22 }
    }

    /// `B u + D d`.
    pub(super) fn forcing(&self, u: &DVector<f64>, d: &DVector<f64>) -> DVector<f64> {
        &self.system.B * u + &self.system.D * d
    }

    /// The differential states `V1' x`.
    pub(super) fn differential(&self, x: &DVector<f64>) -> DVector<f64> {
        self.columns.tr_mul(x)
    }

    /// `x = V1 xi + V2 eta`; not finite where `A22` is exactly singular.
    pub(super) fn state(&self, at: &Frozen, xi: &DVector<f64>, forcing: &DVector<f64>) -> DVector<f64> {
        let mut x = &self.columns * xi;
        if self.algebraic_rows.nrows() > 0 {
            let mut eta = &self.algebraic_rows * (&at.a * &x + forcing);
            if !at.a22.solve_mut(&mut eta) {
                eta.fill(f64::NAN);
            }
            x.gemv(-1.0, &self.algebraic_columns, &eta, 1.0);
        }
        x
    }

    /// `xi' = S^-1 U1' (A x + forcing)` (discrete: the next `xi`).
    pub(super) fn derivative(&self, at: &Frozen, x: &DVector<f64>, forcing: &DVector<f64>) -> DVector<f64> {
        &self.rows * (&at.a * x + forcing)
    }
}
