//! Initial value problems: exactly where they are linear with constant coefficients, by one-step methods where not.

mod adaptive;
mod dense;
mod explicit;
mod exponential;
mod implicit;
mod schedule;

use nalgebra::DMatrix;

pub use adaptive::{Ending, Integrator, StepOptions};
pub use exponential::{NODES, Propagator, exponential};
pub use schedule::{Segment, segments};

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

/// Differential equations `w' = F(t, w)`, and what is to be done with their solution.
///
/// A value that does not exist is answered by false: the step is then repeated with a smaller one.
pub trait Flow {
    /// Writes `F(t, w)`; false where it has no value.
    fn derivative(&mut self, t: f64, state: &[f64], out: &mut [f64]) -> bool;
    /// Writes the Jacobian `dF/dw`; false where it has no value.
    fn jacobian(&mut self, t: f64, state: &[f64], out: &mut DMatrix<f64>) -> bool;
    /// Takes the state at a sample; false ends the integration.
    fn sample(&mut self, index: usize, t: f64, state: &[f64]) -> bool;
    /// Takes the state after a step; false ends the integration.
    fn accepted(&mut self, t: f64, state: &[f64]) -> bool;
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
    /// Steps that become too small: the solution ends, or something in it is too rough to be followed.
    #[error(
        "no step leads beyond t = {time:?}: the solution ends there, or an input or the nonlinearity is too rough \
         to be followed"
    )]
    Collapsed {
        /// Time that was reached.
        time: f64,
    },
}
