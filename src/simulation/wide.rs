//! Plants with other numbers of equations and states, completed by what drives their free variables.
#![expect(non_snake_case, reason = "matrix letters of the canonical form")]

use nalgebra::{DMatrix, DVector};

use super::wide_directions::{canonical, combination};
use super::wide_repeats::{Repeats, violation};
use super::{Plant, SimulationError, Uncertainty};
use crate::expression::Expression;
use crate::numerics::Block::{Of, Zero};
use crate::numerics::{Tolerance, block_matrix, null_space, rank, side_by_side, stack, subspaces};
use crate::observer::input_decoupled::coordinates;
use crate::system::{DescriptorSystem, LipschitzError, LipschitzTerm, Model, Signal, nonlinearity};

/// What drives the states that a plant's equations leave free.
///
/// ```text
/// v = v0(t) - feedback x
/// ```
///
/// Missing signals and rows of the feedback stand for zeros, as in a scenario; those that are too many wait.
///
/// # Shapes
/// `signals`: one for each free variable; `feedback`: free variables x n.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FreeVariables {
    /// The signals `v0`.
    pub signals: Vec<Signal>,
    /// State feedback, so that a plant that is unstable with free signals alone stays bounded.
    pub feedback: Option<DMatrix<f64>>,
}

/// A plant of any shape with its free variables and its constrained unknown inputs, completed to a square one.
///
/// In the coordinates of `E = diag(I, 0)` the algebraic equations are `0 = A3 x1 + A4 x2 + B2 u + D2 d`.
/// ```text
/// x2 = A4^+ (-A3 x1 - B2 u - D2 d) + ker(A4) v                       free: what A4 does not see
/// d  = d_given - M^+ Z' (A3 x1 + B2 u + D2 d_given),   Z' A4 = 0,  M = Z' D2     constrained: what A4 leaves over
/// ```
/// Both hold for the states `[x; d]` of the square plant that has these equations below its own:
/// ```text
/// 0 = (W' + feedback) x - v0         W = orthonormal basis of the free directions, in x
/// 0 = R' (d_given - d)               R = orthonormal basis of ker M
/// ```
/// so that a plant of any shape runs through the same integrators as a square one. Equations that repeat others, of which
/// some combination vanishes in `[E A B D]`, are left out before.
///
/// # Source
/// Paper 001, system (2), whose free states the paper does not simulate.
#[derive(Clone, Debug)]
pub struct WidePlant {
    /// `W`, n x free variables: `v = W' x`. Independent of the basis that a decomposition happens to give.
    pub directions: DMatrix<f64>,
    /// Number of combinations of the unknown inputs that the algebraic equations determine.
    pub constrained: usize,
    /// `R`, q x (q - constrained): combinations of the unknown inputs that follow their signals.
    unconstrained: DMatrix<f64>,
    /// Size of the plant's own equations, to which those that are added are scaled.
    scale: f64,
    /// Equations that are left out.
    pub(super) repeats: Repeats,
}

impl WidePlant {
    /// The completion that a plant needs to run; `None` for one that runs as it is: square and of index 1.
    ///
    /// # Errors
    /// [`SimulationError::NotIndexOne`] for a square plant that is not of index 1 and that no completion helps: its
    /// equations tie differential states. Else as [`Self::new`].
    pub fn needed(
        model: &Model,
        x0: &DVector<f64>,
        u0: &DVector<f64>,
        tolerance: &Tolerance,
    ) -> Result<Option<Self>, SimulationError> {
        if !model.system.E.is_square() {
            return Self::new(model, x0, u0, tolerance).map(Some);
        }
        match Plant::of(model, None, tolerance) {
            Err(refused @ SimulationError::NotIndexOne { .. }) => {
                Self::new(model, x0, u0, tolerance).map(Some).map_err(|_unsolved| refused)
            }
            Err(other) => Err(other),
            Ok(_) => Ok(None),
        }
    }

    /// Splits what the equations determine from what is free.
    ///
    /// # Tolerance
    /// Ranks of `E`, `A4` and `M`, the latter two relative to the norm of `[A D]`: outputs do not move a plant.
    ///
    /// # Errors
    /// [`SimulationError::Overdetermined`] when `[A4 D2]` has no full row rank and the equations that are too many do not
    /// repeat others, with the violation for the initial state `x0` and the known input `u0` at the start;
    /// [`SimulationError::System`] for a malformed system.
    pub fn new(
        model: &Model,
        x0: &DVector<f64>,
        u0: &DVector<f64>,
        tolerance: &Tolerance,
    ) -> Result<Self, SimulationError> {
        let system = model.system.clone().checked()?;
        let at = coordinates(&system, tolerance)?;
        let repeats = Repeats::of(model, &at, tolerance)?;
        if let Some(split) = Self::split(&repeats.left_out(model), tolerance)? {
            return Ok(Self { repeats, ..split });
        }
        let (combinations, residual) = violation(model, &at, (x0, u0), tolerance)?;
        Err(SimulationError::Overdetermined { combinations, algebraic: at.M2.nrows(), residual })
    }

    /// The split of a plant without repeated equations; `None` when `[A4 D2]` has no full row rank.
    fn split(model: &Model, tolerance: &Tolerance) -> Result<Option<Self>, SimulationError> {
        let system = &model.system;
        let at = coordinates(system, tolerance)?;
        let size = side_by_side(&[&system.A, &system.D]).norm();
        let of_a4 = subspaces(&at.A4, size, tolerance)?;
        let M = of_a4.left_null.transpose() * &at.D2;
        if rank(&M, size, tolerance)?.rank < M.nrows() {
            return Ok(None);
        }
        Ok(Some(Self {
            directions: canonical(&(&at.N2 * of_a4.null)),
            constrained: M.nrows(),
            unconstrained: null_space(&M, size, tolerance)?,
            scale: if size > 0.0 { size } else { 1.0 },
            repeats: Repeats::default(),
        }))
    }

    /// Number of free variables.
    pub fn n_free(&self) -> usize {
        self.directions.ncols()
    }

    /// The free directions in words: `v1 = 0.7071 x3 - 0.7071 x4`.
    pub fn named_directions(&self) -> Vec<String> {
        let named = self.directions.column_iter().enumerate();
        named
            .map(|(i, direction)| format!("v{} = {}", i + 1, combination(direction.iter().copied())))
            .collect()
    }

    /// What a person should know of the free states; `None` when there are none.
    pub fn remark(&self) -> Option<String> {
        let named = self.named_directions();
        let count = named.len();
        (count > 0).then(|| format!("the equations leave {count} free, as chosen: {}", named.join(", ")))
    }

    /// The completed plant with the states `[x; d]` and the unknown inputs `[d_given; v0]`.
    ///
    /// # Errors
    /// [`SimulationError::Shape`] and [`SimulationError::NotFinite`] for a feedback that does not fit,
    /// [`SimulationError::Lipschitz`] for a nonlinearity.
    pub(super) fn completed(&self, model: &Model, free: &FreeVariables) -> Result<Model, SimulationError> {
        let model = &self.repeats.left_out(model);
        let DescriptorSystem { time, E, A, B, C, D, F } = &model.system;
        let (e, n, q, k) = (E.nrows(), E.ncols(), D.ncols(), B.ncols());
        let (nv, nd) = (self.n_free(), self.unconstrained.ncols());
        let mut follow = self.directions.transpose();
        if let Some(feedback) = &free.feedback {
            follow += fitted(feedback, (nv, n))?;
        }
        let follow = follow * self.scale;
        let given = self.unconstrained.transpose() * self.scale;
        let signals = DMatrix::identity(nv, nv) * self.scale;
        let system = DescriptorSystem {
            time: *time,
            E: stack(&[&side_by_side(&[E, &DMatrix::zeros(e, q)]), &DMatrix::zeros(nv + nd, n + q)]),
            A: stack(&[
                &side_by_side(&[A, D]),
                &side_by_side(&[&follow, &DMatrix::zeros(nv, q)]),
                &side_by_side(&[&DMatrix::zeros(nd, n), &-&given]),
            ]),
            B: stack(&[B, &DMatrix::zeros(nv + nd, k)]),
            C: side_by_side(&[C, F]),
            D: block_matrix(&[
                &[Of(&DMatrix::zeros(e, q)), Zero],
                &[Zero, Of(&-signals)],
                &[Of(&given), Zero],
            ]),
            F: DMatrix::zeros(C.nrows(), q + nv),
        };
        let widen = |term: &LipschitzTerm| widened(&term.clone().checked(&model.system)?, nv + nd, q);
        let lipschitz = model.lipschitz.as_ref().map(widen).transpose()?;
        Ok(Model { lipschitz, ..Model::from(system) })
    }

    /// The uncertainty of the completed plant: what is added does not vary.
    pub(super) fn uncertain(&self, given: &Uncertainty) -> Uncertainty {
        let (rows, columns) = (self.n_free() + self.unconstrained.ncols(), self.unconstrained.nrows());
        let padded = |m: &DMatrix<f64>| {
            let kept = self.repeats.rows_left_out(m);
            let shape = (kept.nrows() + rows, kept.ncols() + columns);
            kept.resize(shape.0, shape.1, 0.0)
        };
        Uncertainty {
            amplitude: padded(&given.amplitude),
            frequency: padded(&given.frequency),
            scale: given.scale,
        }
    }
}

/// A feedback with a row for each free variable: cut off at the end or filled with zeros.
fn fitted(feedback: &DMatrix<f64>, needed: (usize, usize)) -> Result<DMatrix<f64>, SimulationError> {
    let what = "the feedback of the free variables".to_owned();
    if feedback.ncols() != needed.1 {
        return Err(SimulationError::Shape {
            what,
            found: feedback.shape(),
            needed,
            reason: "it has a row for each free variable and a column for each state",
        });
    }
    if feedback.iter().any(|x| !x.is_finite()) {
        return Err(SimulationError::NotFinite { what });
    }
    Ok(feedback.clone().resize(needed.0, needed.1, 0.0))
}

/// A nonlinearity of the plant as one of the completed plant, in the same states by name.
fn widened(term: &LipschitzTerm, rows: usize, columns: usize) -> Result<LipschitzTerm, LipschitzError> {
    let states = term.F_L.ncols() + columns;
    let read = |(index, f): (usize, &Expression)| {
        nonlinearity(f.text(), states).map_err(|_problem| LipschitzError::Variables {
            index,
            text: f.text().to_owned(),
            found: f.variables().join(", "),
            states: term.F_L.ncols(),
        })
    };
    Ok(LipschitzTerm {
        G: stack(&[&term.G, &DMatrix::zeros(rows, term.G.ncols())]),
        F_L: side_by_side(&[&term.F_L, &DMatrix::zeros(term.F_L.nrows(), columns)]),
        f: term.f.iter().enumerate().map(read).collect::<Result<_, _>>()?,
        constant: term.constant,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::dmatrix;

    fn model(E: DMatrix<f64>, A: DMatrix<f64>, D: DMatrix<f64>) -> Model {
        let (e, n, q) = (E.nrows(), E.ncols(), D.ncols());
        let system = DescriptorSystem {
            time: crate::system::TimeDomain::Continuous,
            E,
            A,
            B: DMatrix::zeros(e, 0),
            C: DMatrix::identity(n, n),
            D,
            F: DMatrix::zeros(n, q),
        };
        system.checked().unwrap().into()
    }

    fn split(model: &Model) -> Result<WidePlant, SimulationError> {
        let x0 = DVector::from_element(model.system.n_states(), 1.0);
        WidePlant::new(model, &x0, &DVector::zeros(0), &Tolerance::default())
    }

    #[test]
    fn free_variables_and_constrained_inputs_are_counted() {
        // x1' = x3, 0 = x1 + d1: two free states, one of two unknown inputs is fixed
        let plant = model(
            dmatrix![1.0, 0.0, 0.0; 0.0, 0.0, 0.0],
            dmatrix![0.0, 0.0, 1.0; 1.0, 0.0, 0.0],
            dmatrix![0.0, 0.0; 1.0, 0.0],
        );
        let found = split(&plant).unwrap();
        assert_eq!((found.n_free(), found.constrained), (2, 1), "{found:?}");
        let completed = found.completed(&plant, &FreeVariables::default()).unwrap().system;
        assert_eq!(completed.E.shape(), (5, 5), "square in [x; d]");
    }

    #[test]
    fn equations_without_anything_to_determine_are_refused_with_their_violation() {
        // 0 = x1 - 3 x1 and nothing algebraic in it
        let plant = model(
            dmatrix![1.0, 0.0; 0.0, 0.0; 0.0, 0.0],
            dmatrix![-1.0, 0.0; 1.0, 1.0; -2.0, 1.0],
            DMatrix::zeros(3, 0),
        );
        let error = split(&plant).unwrap_err();
        let SimulationError::Overdetermined { combinations, algebraic, residual } = error else {
            panic!("{error}")
        };
        assert_eq!((combinations, algebraic), (1, 2), "one of two equations is too many");
        // the difference of both rows, normalised: (1 + 2) x1 / sqrt 2
        assert!((residual - 3.0 / 2.0_f64.sqrt()).abs() < 1e-14, "violated by {residual}");
    }

    #[test]
    fn rows_of_a_feedback_that_are_missing_are_zero_and_those_that_are_too_many_wait() {
        // x1' = x1 + x2 + x3: two free states
        let plant = model(dmatrix![1.0, 0.0, 0.0], dmatrix![1.0, 1.0, 1.0], DMatrix::zeros(1, 0));
        let found = split(&plant).unwrap();
        let completed = |rows: usize| {
            let all = dmatrix![2.0, 0.0, 0.0; 3.0, 0.0, 0.0; 4.0, 0.0, 0.0];
            let feedback = Some(all.rows(0, rows).into_owned());
            let given = FreeVariables { signals: Vec::new(), feedback };
            found.completed(&plant, &given).unwrap().system.A
        };
        assert_eq!(completed(3), completed(2), "the third row waits");
        assert_eq!(completed(1)[(2, 0)], 0.0, "the second row is zero");
        assert!(completed(2)[(2, 0)] > 0.0, "the second row acts");
    }

    #[test]
    fn a_feedback_of_the_wrong_shape_is_named() {
        let plant = model(dmatrix![1.0, 0.0], dmatrix![0.0, 1.0], DMatrix::zeros(1, 0));
        let free = FreeVariables { signals: Vec::new(), feedback: Some(dmatrix![1.0]) };
        let error = split(&plant).unwrap().completed(&plant, &free).unwrap_err();
        assert!(
            error.to_string().starts_with("the feedback of the free variables is 1 x 1, but 1 x 2"),
            "{error}"
        );
    }
}
