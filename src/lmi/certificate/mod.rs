//! Proofs that a symmetric matrix is positive definite, whatever rounding did: the judge of what a solver returns.
//!
//! An inequality is evaluated from the finished design in [`IntervalMatrix`] arithmetic, which encloses the exact
//! result, and [`proved_positive_definite`] decides for every matrix within. No solver is involved, and no tolerance.

mod interval;
mod matrix;
mod positive_definite;

pub use interval::Interval;
pub use matrix::IntervalMatrix;
pub use positive_definite::{lower_bound, proved_positive_definite};
