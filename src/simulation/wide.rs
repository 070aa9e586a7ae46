//! Plants with other numbers of equations and states, completed by what drives their free variables.
#![expect(non_snake_case, reason = "matrix letters of the canonical form")]

use nalgebra::{DMatrix, DVector};

use super::{SimulationError, Uncertainty};
use crate::expression::Expression;
use crate::numerics::Block::{Of, Zero};
use crate::numerics::{
    NumericsError, Tolerance, block_matrix, null_space, rank, side_by_side, stack, subspaces,
};
use crate::observer::input_decoupled::{Coordinates, coordinates};
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
/// so that a plant of any shape runs through the same integrators as a square one.
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
}

impl WidePlant {
    /// Splits what the equations determine from what is free.
    ///
    /// # Tolerance
    /// Ranks of `E`, `A4` and `M`, the latter two relative to the norm of `[A D; C F]`.
    ///
    /// # Errors
    /// [`SimulationError::Overdetermined`] when `[A4 D2]` has no full row rank, with the violation for the initial state
    /// `x0` and the known input `u0` at the start; [`SimulationError::System`] for a malformed system.
    pub fn new(
        model: &Model,
        x0: &DVector<f64>,
        u0: &DVector<f64>,
        tolerance: &Tolerance,
    ) -> Result<Self, SimulationError> {
        let system = model.system.clone().checked()?;
        let at = coordinates(&system, tolerance)?;
        let of_a4 = subspaces(&at.A4, at.scale, tolerance)?;
        let Zt = of_a4.left_null.transpose();
        let M = &Zt * &at.D2;
        let found = rank(&M, at.scale, tolerance)?.rank;
        if found < M.nrows() {
            let residual = violation(model, &at, (x0, u0), tolerance)?;
            return Err(SimulationError::Overdetermined {
                combinations: M.nrows() - found,
                algebraic: at.M2.nrows(),
                residual,
            });
        }
        let size = side_by_side(&[&system.A, &system.D]).norm();
        Ok(Self {
            directions: canonical(&(&at.N2 * of_a4.null)),
            constrained: M.nrows(),
            unconstrained: null_space(&M, at.scale, tolerance)?,
            scale: if size > 0.0 { size } else { 1.0 },
        })
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
            let mut all = DMatrix::zeros(m.nrows() + rows, m.ncols() + columns);
            all.view_mut((0, 0), m.shape()).copy_from(m);
            all
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

/// A linear combination of states in words: `0.7071 x3 - 0.7071 x4`, `-x2`.
fn combination(coefficients: impl Iterator<Item = f64>) -> String {
    const NOTHING: f64 = 1e-9;
    let mut text = String::new();
    for (j, x) in coefficients.enumerate().filter(|(_, x)| x.abs() > NOTHING) {
        text.push_str(match (text.is_empty(), x < 0.0) {
            (true, false) => "",
            (true, true) => "-",
            (false, false) => " + ",
            (false, true) => " - ",
        });
        let size = format!("{:.4}", x.abs());
        if size != "1.0000" {
            text.extend([size.as_str(), " "]);
        }
        text.extend(["x", &(j + 1).to_string()]);
    }
    text
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

/// The largest entry of the algebraic equations that contain neither `x2` nor `d`, at the start.
fn violation(
    model: &Model,
    at: &Coordinates,
    (x0, u0): (&DVector<f64>, &DVector<f64>),
    tolerance: &Tolerance,
) -> Result<f64, NumericsError> {
    let rest = subspaces(&at.algebraic(), at.scale, tolerance)?.left_null;
    if x0.len() != at.N1.nrows() || u0.len() != at.B2.ncols() {
        return Ok(f64::NAN);
    }
    let x1 = &at.M1 * &model.system.E * x0;
    let mut left = &at.A3 * x1 + &at.B2 * u0;
    if let Some(term) = model.lipschitz.as_ref().filter(|term| term.G.nrows() == at.M2.ncols()) {
        left += &at.M2 * &term.G * term.value(0.0, x0);
    }
    Ok(rest.tr_mul(&left).iter().fold(0.0, |largest: f64, x| largest.max(x.abs())))
}

/// Two diagonal entries of a projector closer than this count as equal, so that rounding does not choose between them.
const TIE: f64 = 1e-9;

/// The orthonormal basis of the same space that does not depend on the one that is given.
///
/// The projection of the coordinate that lies closest to the space (the first of equals) is one, with a positive entry
/// there; then the same with what is left. They are sorted by these coordinates, so that a new state behind the others
/// adds its direction behind theirs.
fn canonical(basis: &DMatrix<f64>) -> DMatrix<f64> {
    let mut projector = basis * basis.transpose();
    let mut found = Vec::new();
    for _ in 0..basis.ncols() {
        let largest = projector.diagonal().iter().fold(0.0, |l: f64, x| l.max(*x));
        let Some(pivot) = projector.diagonal().iter().position(|x| *x >= largest - TIE) else { break };
        let direction = projector.column(pivot) / largest.sqrt().max(f64::MIN_POSITIVE);
        let direction = direction.normalize();
        projector -= &direction * direction.transpose();
        found.push((pivot, direction));
    }
    found.sort_by_key(|(pivot, _)| *pivot);
    let columns: Vec<DVector<f64>> = found.into_iter().map(|(_, direction)| direction).collect();
    if columns.is_empty() { DMatrix::zeros(basis.nrows(), 0) } else { DMatrix::from_columns(&columns) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{dmatrix, dvector};

    #[test]
    fn free_directions_do_not_depend_on_the_basis() {
        let basis = dmatrix![0.0, 0.0; 0.6, 0.0; 0.0, 1.0; -0.8, 0.0];
        let (s, c) = (0.7_f64.sin(), 0.7_f64.cos());
        let turned = &basis * dmatrix![c, s; s, -c];
        let (one, other) = (canonical(&basis), canonical(&turned));
        assert!((&one - &other).norm() < 1e-15, "{one}{other}");
        assert_eq!(one.column(0).into_owned(), dvector![0.0, 0.0, 1.0, 0.0], "x3 itself is free");
        assert!(one[(3, 1)] > 0.0, "the largest entry is positive: {one}");
    }

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
    fn combinations_read_as_they_are_written() {
        let words = |x: &[f64]| combination(x.iter().copied());
        assert_eq!(
            words(&[0.0, 0.0, 0.5_f64.sqrt(), -0.5_f64.sqrt()]),
            "0.7071 x3 - 0.7071 x4",
            "a difference"
        );
        assert_eq!(words(&[0.0, 1.0]), "x2", "a state itself");
        assert_eq!(words(&[-1.0, 0.25, 1e-12]), "-x1 + 0.2500 x2", "rounding is not shown");
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
