//! The plant reduced to its differential states.

use nalgebra::{DMatrix, DVector, Dyn, LU};
use serde::{Deserialize, Serialize};

use super::uncertainty::Varying;
use super::{SimulationError, Uncertainty};
use crate::numerics::{RankDecision, Tolerance, svd};
use crate::system::{DescriptorSystem, LipschitzTerm, Model, TimeDomain};

/// A square descriptor system of index 1 in the singular value coordinates of `E`, ready to run.
///
/// ```text
/// E = U1 S V1',   U = [U1 U2], V = [V1 V2] orthogonal,   x = V1 xi + V2 eta
/// S xi' = U1' (A(t) x + B u + G f(t, x) + D d)
///     0 = U2' (A(t) x + B u + G f(t, x) + D d)
/// linear:  eta = -A22(t)^-1 U2' (A(t) V1 xi + B u + D d),   A22 = U2' A V2
/// ```
///
/// `E` is constant, so the coordinates are; `A(t)` may vary, so `eta` is eliminated at every evaluation. Where `f`
/// depends on `eta`, the algebraic equations are solved by Newton's method; index 1 then means that
/// `A22 + U2' G df/dx V2` is regular along the motion.
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
    pub(super) nonlinear: Option<Nonlinear>,
    pub(super) tolerance: Tolerance,
}

/// The nonlinearity of a plant.
#[derive(Clone, Debug)]
pub(super) struct Nonlinear {
    pub(super) term: LipschitzTerm,
    /// For each state, whether `f` uses it.
    pub(super) seen: Vec<bool>,
    /// `U2' G`, (n - r) x nf.
    pub(super) weights: DMatrix<f64>,
    /// Whether `f` occurs in the algebraic equations.
    pub(super) enters: bool,
    /// Whether it occurs there with algebraic states.
    pub(super) implicit: bool,
}

/// Entries below this part of the largest count as rounding of zero.
const ZERO: f64 = 1e-14;

impl Nonlinear {
    fn new(term: LipschitzTerm, rows: &DMatrix<f64>, columns: &DMatrix<f64>) -> Self {
        let weights = rows * &term.G;
        let seen = term.states_seen();
        let enters = weights.amax() > ZERO * term.G.amax();
        let implicit = enters && sees(&seen, columns, 1.0);
        Self { term, seen, weights, enters, implicit }
    }
}

/// Whether a movement `matrix * v` of the states changes a state that `f` uses.
pub(super) fn sees(seen: &[bool], matrix: &DMatrix<f64>, size: f64) -> bool {
    let mut rows = matrix.row_iter().zip(seen);
    rows.any(|(row, seen)| *seen && row.amax() > ZERO * size)
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
    /// Prepares a linear system, and checks that it is square and of index 1.
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
        Self::prepared(system, None, uncertainty, tolerance)
    }

    /// Prepares a system with its nonlinearity.
    ///
    /// Where the algebraic equations contain algebraic states within the nonlinearity, index 1 is decided where the
    /// motion starts and on its way.
    ///
    /// # Errors
    /// As [`Self::new`], and for a nonlinearity that does not fit the system.
    pub fn of(
        model: &Model,
        uncertainty: Option<&Uncertainty>,
        tolerance: &Tolerance,
    ) -> Result<Self, SimulationError> {
        Self::prepared(&model.system, model.lipschitz.as_ref(), uncertainty, tolerance)
    }

    fn prepared(
        system: &DescriptorSystem,
        term: Option<&LipschitzTerm>,
        uncertainty: Option<&Uncertainty>,
        tolerance: &Tolerance,
    ) -> Result<Self, SimulationError> {
        let system = system.clone().checked()?;
        let (equations, states) = system.E.shape();
        if equations != states {
            return Err(SimulationError::NotSquare { equations, states });
        }
        let term = term.map(|term| term.clone().checked(&system)).transpose()?;
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
        let nonlinear = term
            .filter(|term| term.n_components() > 0)
            .map(|term| Nonlinear::new(term, &algebraic_rows, &algebraic_columns));
        // A22 = U2' A V2
        let a22 = &algebraic_rows * &system.A * &algebraic_columns;
        let index = decided(&a22, system.A.norm(), tolerance)?;
        if nonlinear.as_ref().is_none_or(|nonlinear| !nonlinear.implicit) {
            regular(&index)?;
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
            nonlinear,
            tolerance: *tolerance,
        })
    }

    /// The system that runs.
    pub fn system(&self) -> &DescriptorSystem {
        &self.system
    }

    /// The decision whether `A22` is regular at time zero, with its singular values.
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

    /// Whether the algebraic equations contain algebraic states within the nonlinearity.
    pub(super) fn is_implicit(&self) -> bool {
        self.nonlinear.as_ref().is_some_and(|nonlinear| nonlinear.implicit)
    }

    /// Whether the equations are linear with constant coefficients.
    pub(super) fn is_linear_and_constant(&self) -> bool {
        self.varying.is_empty() && self.nonlinear.is_none()
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

    /// Writes `B u + D d`.
    pub(super) fn forcing(&self, u: &DVector<f64>, d: &DVector<f64>, out: &mut DVector<f64>) {
        out.gemv(1.0, &self.system.B, u, 0.0);
        out.gemv(1.0, &self.system.D, d, 1.0);
    }

    /// The differential states `V1' x`.
    pub(super) fn differential(&self, x: &DVector<f64>) -> DVector<f64> {
        self.columns.tr_mul(x)
    }

    /// `V1`.
    pub(super) fn differential_columns(&self) -> &DMatrix<f64> {
        &self.columns
    }

    /// `S^-1 U1'`.
    pub(super) fn differential_rows(&self) -> &DMatrix<f64> {
        &self.rows
    }
}

impl Frozen {
    /// `A(t)`.
    pub(super) fn a(&self) -> &DMatrix<f64> {
        &self.a
    }

    /// Solves `A22 eta = right` in place; false where `A22` is singular.
    pub(super) fn solve(&self, right: &mut DVector<f64>) -> bool {
        self.a22.solve_mut(right)
    }
}

/// Whether `A22`, or its sum with the slope of the nonlinearity, is regular relative to the norm of `A`.
pub(super) fn decided(
    a22: &DMatrix<f64>,
    norm: f64,
    tolerance: &Tolerance,
) -> Result<RankDecision, SimulationError> {
    Ok(RankDecision::from_singular_values(a22.shape(), svd(a22)?.s, norm, tolerance))
}

/// Refuses a plant that is not of index 1.
pub(super) fn regular(index: &RankDecision) -> Result<(), SimulationError> {
    if index.rank == index.singular_values.len() {
        return Ok(());
    }
    Err(SimulationError::NotIndexOne {
        algebraic: index.singular_values.len(),
        smallest: index.smallest(),
        threshold: index.threshold,
    })
}
