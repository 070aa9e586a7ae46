//! Initial value problems `w' = M(t) w + forcing(t)`: exactly where `M` is constant, by a stiff solver where not.

mod exponential;
mod schedule;
mod stiff;

pub use exponential::{NODES, Propagator, exponential};
pub use schedule::{Segment, segments};
pub use stiff::{StiffOptions, StiffOutcome, stiff_segment};

/// A vector of signals as a function of time.
pub trait Signals {
    /// Writes the values at time `t`; the length of `out` is the number of signals that are asked for.
    fn value(&self, t: f64, out: &mut [f64]);
}

impl<F: Fn(f64, &mut [f64])> Signals for F {
    fn value(&self, t: f64, out: &mut [f64]) {
        self(t, out);
    }
}

/// The signal vector that is always zero, of any length.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Silence;

impl Signals for Silence {
    fn value(&self, _t: f64, out: &mut [f64]) {
        out.fill(0.0);
    }
}

/// Linear differential equations with forcing, `w' = M(t) w + forcing(t)`.
pub trait AffineFlow {
    /// Number of states.
    fn order(&self) -> usize;
    /// The derivative `M(t) w + forcing(t)`.
    fn derivative(&self, t: f64, state: &[f64], out: &mut [f64]);
    /// The Jacobian times a direction, `M(t) v`.
    fn product(&self, t: f64, direction: &[f64], out: &mut [f64]);
}

/// An integration that could not be completed.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum IntegrationError {
    /// The right-hand side has a value that is infinite or not a number.
    #[error("the derivative is not finite at t = {time:?}; look for an input that is not defined there")]
    NotFinite {
        /// Time of the evaluation.
        time: f64,
    },
    /// The work limit was reached.
    #[error(
        "{limit} steps did not reach the end, only t = {time:?}; shorten the horizon or slow the inputs down"
    )]
    TooManySteps {
        /// Time that was reached.
        time: f64,
        /// The limit.
        limit: usize,
    },
    /// The solver gave up.
    #[error("the stiff solver stopped at t = {time:?}: {reason}")]
    Solver {
        /// Time that was reached.
        time: f64,
        /// The solver's own words.
        reason: String,
    },
}
