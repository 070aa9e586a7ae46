//! L0: linear matrix inequalities as data, and the phases that solve them.
//!
//! A [`Problem`] holds matrix variables and constraints `F(x) > 0` or `F(x) >= 0`, each an affine matrix expression
//! ([`Expr`]) that is written as the block stands in the paper. [`feasible`], [`minimise`] and [`optimum`] balance the
//! problem, solve it and hand back a [`Point`]. What they find are candidates: a design is certified apart from them.
//!
//! ```
//! use descry::lmi::{Expr, Problem, Settings, minimise};
//! use nalgebra::dmatrix;
//! # fn main() -> Result<(), descry::lmi::Stop> {
//! // bounded real lemma: the least g with [A'X + XA + C'C, XB; B'X, -g I] < 0 is the squared H-infinity norm
//! let (a, b, c) = (dmatrix![-1.0], dmatrix![1.0], dmatrix![3.0]);
//! let mut problem = Problem::new();
//! let x = problem.symmetric("X", 1);
//! let g = problem.scalar("gamma^2");
//! let lemma = Expr::symmetric(vec![
//!     vec![(&x * &a).he() + Expr::constant(&(c.transpose() * &c)), &x * &b],
//!     vec![-g.times(&dmatrix![1.0])],
//! ]);
//! problem.strict("bounded real lemma", "example", -lemma);
//! problem.strict("X > 0", "example", x);
//! let found = minimise(&problem, &g, &Settings::default())?;
//! assert!((found.optimum.unwrap_or(f64::NAN) - 9.0).abs() < 1e-6); // |3 / (s + 1)| <= 3
//! # Ok(())
//! # }
//! ```

mod affine;
mod balance;
pub mod certificate;
mod clarabel;
mod expression;
mod operators;
mod optimise;
mod outcome;
mod phases;
mod problem;
mod program;
mod run;
mod scaled;
mod solution;

pub use expression::Expr;
pub use outcome::{Infeasible, Nearest, Outcome};
pub use phases::{feasible, minimise, optimum};
pub use problem::Problem;
pub use solution::{Found, Point, Settings, Stop};
