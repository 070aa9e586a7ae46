//! Coefficients that vary in time, and nonlinear equations: one-step methods on the reduced equations.

use nalgebra::{DMatrix, DVector};

use super::evaluator::Evaluator;
use super::record::Record;
use super::run::{LARGEST_STATE, STEP, fraction};
use super::singularity::Singularity;
use super::{Method, SimulationError};
use crate::numerics::Watch;
use crate::numerics::integrate::{Ending, Flow, IntegrationError, Integrator, Segment, StepOptions};

/// Relative error of a step.
const RELATIVE: f64 = 3e-9;
/// First and smallest step, relative to the horizon.
const FIRST_STEP: f64 = 1e-4;
const SMALLEST_STEP: f64 = 1e-15;
/// Steps after which a motion is given up.
const MOST_STEPS: usize = 500_000;
/// Steps between two looks whether the motion is still wanted.
const BETWEEN_LOOKS: usize = 64;

/// The joint equations within one segment, and their record.
struct Motion<'m, 'a> {
    evaluator: Evaluator<'a>,
    record: &'m mut Record<'a>,
    segment: &'m Segment,
    grid: &'m [f64],
    watch: &'m Watch,
    singularity: Singularity,
    count: usize,
}

impl Flow for Motion<'_, '_> {
    fn derivative(&mut self, t: f64, state: &[f64], out: &mut [f64]) -> bool {
        if !self.evaluator.evaluate(self.segment.inside(t), state) {
            return false;
        }
        out.copy_from_slice(self.evaluator.derivative.as_slice());
        out.iter().all(|x| x.is_finite())
    }

    fn jacobian(&mut self, t: f64, state: &[f64], out: &mut DMatrix<f64>) -> bool {
        self.evaluator.jacobian(self.segment.inside(t), state, out)
    }

    fn sample(&mut self, index: usize, t: f64, state: &[f64]) -> bool {
        if !self.evaluator.evaluate(self.segment.inside(t), state) {
            self.end(t);
            return false;
        }
        self.evaluator.accept();
        self.record.push(self.grid[index], state, &mut self.evaluator)
    }

    fn accepted(&mut self, t: f64, state: &[f64]) -> bool {
        self.count += 1;
        let horizon = self.grid.last().copied().unwrap_or(t);
        if self.count.is_multiple_of(BETWEEN_LOOKS) && !self.watch.go_on(fraction(t, horizon), STEP) {
            self.record.stop(SimulationError::Cancelled);
            return false;
        }
        if !state.iter().all(|x| x.abs() <= LARGEST_STATE) {
            self.record.overflow(t);
            return false;
        }
        let inside = self.segment.inside(t);
        if self.evaluator.iterates() {
            if !self.evaluator.evaluate(inside, state) {
                self.end(t);
                return false;
            }
            if let Err(error) = self.singularity.meet(&mut self.evaluator, inside) {
                self.record.stop(error);
                return false;
            }
        }
        self.evaluator.accept();
        true
    }
}

impl Motion<'_, '_> {
    /// Ends the record because the equations have no value beyond `t`.
    fn end(&mut self, t: f64) {
        let error = match self.evaluator.trouble.take() {
            Some(trouble) => self.singularity.explain(t, trouble),
            None => IntegrationError::NotFinite { time: t }.into(),
        };
        self.record.stop(error);
    }

    /// Ends the record because the integrator gave up.
    fn give_up(&mut self, error: IntegrationError) {
        let (IntegrationError::NotFinite { time } | IntegrationError::Collapsed { time }) = error else {
            self.record.stop(error.into());
            return;
        };
        match self.evaluator.trouble.take() {
            Some(trouble) => {
                let error = self.singularity.explain(time, trouble);
                self.record.stop(error);
            }
            None if self.singularity.is_near() => {
                let error = self.singularity.error(time);
                self.record.stop(error);
            }
            None => self.record.stop(error.into()),
        }
    }
}

/// How a motion was computed.
pub(super) struct Work {
    pub(super) method: Method,
    pub(super) steps: usize,
    /// Smallest singular value of the algebraic equations that was met.
    pub(super) smallest: f64,
}

/// Runs over all segments from a start at which the evaluator stands; how it ended is left in the record.
pub(super) fn run<'a>(
    (evaluator, singularity): (Evaluator<'a>, Singularity),
    (grid, segments): (&[f64], &[Segment]),
    start: &DVector<f64>,
    record: &mut Record<'a>,
    watch: &Watch,
) -> Work {
    let horizon = grid.last().copied().unwrap_or(0.0);
    let options = StepOptions {
        relative: RELATIVE,
        first_step: FIRST_STEP * horizon,
        smallest_step: SMALLEST_STEP * horizon,
        limit: MOST_STEPS,
    };
    let mut integrator = Integrator::new(start.as_slice(), options);
    let Some(segment) = segments.first() else {
        return Work { method: Method::Explicit, steps: 0, smallest: singularity.smallest() };
    };
    let mut motion = Motion { evaluator, record, segment, grid, watch, singularity, count: 0 };
    for segment in segments {
        motion.segment = segment;
        match integrator.over(&mut motion, segment) {
            Ok(Ending::Reached) => {}
            Ok(Ending::Stopped) => break,
            Err(error) => {
                motion.give_up(error);
                break;
            }
        }
    }
    let method = if integrator.is_stiff() { Method::Implicit } else { Method::Explicit };
    Work { method, steps: integrator.steps(), smallest: motion.singularity.smallest() }
}
