//! What the phases are told and what they hand back.

use std::fmt;

use nalgebra::DMatrix;

use super::expression::Expr;
use crate::numerics::Watch;

/// How to solve.
#[derive(Clone, Debug)]
pub struct Settings {
    /// How far [`super::minimise`] steps back from the least value, relative: 0.01 makes a strictly feasible point.
    pub back_off: f64,
    /// Time limit of one call, in seconds of solving.
    pub seconds: f64,
    /// The largest [`super::Problem::rows`] that is tried; the effort grows with its cube.
    pub most_rows: usize,
    /// Receives progress ("least gamma: iteration 7, gap 3e-5") and cancels.
    pub watch: Watch,
}

impl Default for Settings {
    fn default() -> Self {
        Self { back_off: 0.01, seconds: 10.0, most_rows: 1500, watch: Watch::none() }
    }
}

/// Values of all variables of a problem.
#[derive(Clone, Debug, PartialEq)]
pub struct Point {
    values: Vec<f64>,
}

impl Point {
    pub(super) fn new(values: Vec<f64>) -> Self {
        Self { values }
    }

    /// The value of an expression at this point.
    ///
    /// # Panics
    /// When the expression has a variable of another problem.
    pub fn value(&self, expression: &Expr) -> DMatrix<f64> {
        assert!(expression.reach() <= self.values.len(), "the expression has a variable of another problem");
        expression.value(&self.values)
    }

    /// The value of a scalar expression (1 x 1) at this point.
    ///
    /// # Panics
    /// When the expression is not 1 x 1 or has a variable of another problem.
    pub fn scalar(&self, expression: &Expr) -> f64 {
        assert!(
            (expression.nrows(), expression.ncols()) == (1, 1),
            "a scalar is needed, not {} x {}",
            expression.nrows(),
            expression.ncols()
        );
        self.value(expression)[(0, 0)]
    }
}

/// A candidate: what holds at its point is to be certified apart.
#[derive(Clone, Debug, PartialEq)]
pub struct Found {
    /// The values of the variables.
    pub point: Point,
    /// The least value of the objective that any point reaches.
    pub optimum: Option<f64>,
    /// The value of the objective at this point.
    pub objective: Option<f64>,
    /// The smallest eigenvalue of the strict blocks in balanced coordinates, at most 1; recomputed, not the solver's.
    pub margin: f64,
    /// Iterations of all phases together.
    pub iterations: u32,
}

/// Why there is no candidate.
#[derive(Clone, Debug, PartialEq)]
pub enum Stop {
    /// No point satisfies all inequalities.
    Infeasible {
        /// The name of the block with the largest multiplier.
        block: String,
        /// Where that block stands.
        source: String,
        /// The largest margin in balanced coordinates; zero or negative.
        margin: f64,
    },
    /// The watch said stop.
    Cancelled,
    /// A limit was reached or the numbers allow no decision; the text is for a person.
    GaveUp(String),
}

// not derived: thiserror would take the field `source` for an underlying error
impl fmt::Display for Stop {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Infeasible { block, source, margin } => {
                write!(
                    f,
                    "no solution exists: {block} ({source}) stops it; the largest margin is {margin:.1e}"
                )
            }
            Self::Cancelled => write!(f, "cancelled"),
            Self::GaveUp(why) => write!(f, "{why}"),
        }
    }
}

impl std::error::Error for Stop {}
