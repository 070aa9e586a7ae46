//! Whether nonlinear algebraic equations keep index 1 along the motion, and why a motion ends.

use super::SimulationError;
use super::evaluator::{Evaluator, Trouble};
use super::plant::decided;

/// A motion that ends below this part of the first singular value ends because of it.
const NEAR: f64 = 1e-3;

/// Smallest singular values of `A22 + U2' G df/dx V2`: the first, the last and the smallest that were met.
///
/// Infinite for a plant whose algebraic equations are linear in the algebraic states: [`super::Plant`] has decided then.
#[derive(Clone, Copy, Debug)]
pub(super) struct Singularity {
    first: f64,
    last: f64,
    smallest: f64,
}

impl Singularity {
    /// Nothing met yet.
    pub(super) fn new() -> Self {
        Self { first: f64::INFINITY, last: f64::INFINITY, smallest: f64::INFINITY }
    }

    /// Looks at the last evaluation.
    ///
    /// # Errors
    /// [`SimulationError::SingularAlgebraic`] where the equations are not of index 1.
    pub(super) fn meet(&mut self, evaluator: &mut Evaluator<'_>, t: f64) -> Result<(), SimulationError> {
        let plant = evaluator.joint.plant;
        if !plant.is_implicit() {
            return Ok(());
        }
        let block = evaluator.algebraic_block(t);
        let index = decided(&block, block.norm().max(plant.system().A.norm()), &plant.tolerance)?;
        self.last = index.smallest();
        self.smallest = self.smallest.min(self.last);
        if self.first.is_infinite() {
            self.first = self.last;
        }
        if index.rank < block.nrows() { Err(self.error(t)) } else { Ok(()) }
    }

    /// The smallest singular value so far.
    pub(super) fn smallest(&self) -> f64 {
        self.smallest
    }

    /// Whether the equations are nearly singular compared with the start.
    pub(super) fn is_near(&self) -> bool {
        self.last < NEAR * self.first
    }

    /// The loss of index 1 as an error.
    pub(super) fn error(&self, time: f64) -> SimulationError {
        SimulationError::SingularAlgebraic { time, smallest: self.last }
    }

    /// Why there is no value at or beyond a time.
    pub(super) fn explain(&self, time: f64, trouble: Trouble) -> SimulationError {
        match trouble {
            Trouble::Signal(error) => error,
            Trouble::Algebraic { .. } if self.is_near() => self.error(time),
            Trouble::Algebraic { .. } => SimulationError::NoAlgebraicSolution { time },
            Trouble::Estimate { observer, .. } => SimulationError::NoEstimate { observer, time },
            Trouble::Nonlinearity { x, .. } => {
                let state = x.iter().map(|x| format!("{x:.4}")).collect::<Vec<_>>().join(", ");
                SimulationError::Nonlinearity { time, state: format!("({state})") }
            }
        }
    }
}
