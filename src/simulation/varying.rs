//! Coefficients that vary in time: the stiff solver on the reduced equations.

use std::cell::{Ref, RefCell};

use nalgebra::DVector;

use super::joint::{Joint, Values};
use super::plant::Frozen;
use super::record::Record;
use super::run::LARGEST_STATE;
use super::{SimulationError, constant};
use crate::numerics::integrate::{AffineFlow, Segment, StiffOptions, stiff_segment};

/// Relative tolerance of a step.
const RELATIVE: f64 = 1e-8;
/// Absolute tolerance of a step, relative to the usual size of each state.
const ABSOLUTE: f64 = 1e-10;
/// Steps after which a segment is given up.
const MOST_STEPS: usize = 500_000;

/// The joint equations within one segment.
#[derive(Debug)]
struct Flow<'a> {
    joint: &'a Joint<'a>,
    segment: &'a Segment,
    silence: Values,
    /// The last instant that was frozen: the solver asks for each several times.
    cache: RefCell<(f64, Frozen)>,
}

impl Flow<'_> {
    fn frozen(&self, t: f64) -> Ref<'_, Frozen> {
        if self.cache.borrow().0 != t {
            *self.cache.borrow_mut() = (t, self.joint.plant.freeze(t));
        }
        Ref::map(self.cache.borrow(), |(_, frozen)| frozen)
    }

    fn apply(&self, t: f64, state: &[f64], values: &Values, out: &mut [f64]) {
        let w = DVector::from_column_slice(state);
        let found = self.joint.evaluate(&self.frozen(t), &w, values);
        out.copy_from_slice(found.derivative.as_slice());
    }
}

impl AffineFlow for Flow<'_> {
    fn order(&self) -> usize {
        self.joint.order()
    }

    fn derivative(&self, t: f64, state: &[f64], out: &mut [f64]) {
        self.apply(t, state, &self.joint.values(self.segment.inside(t)), out);
    }

    fn product(&self, t: f64, direction: &[f64], out: &mut [f64]) {
        self.apply(t, direction, &self.silence, out);
    }
}

/// Runs over all segments, each with a solver of its own; returns the number of steps.
pub(super) fn run(
    joint: &Joint<'_>,
    grid: &[f64],
    segments: &[Segment],
    start: DVector<f64>,
    record: &mut Record<'_>,
) -> Result<usize, SimulationError> {
    let horizon = grid.last().copied().unwrap_or(0.0);
    let options = StiffOptions {
        relative: RELATIVE,
        absolute: usual_sizes(joint, segments, &start).into_iter().map(|s| ABSOLUTE * s).collect(),
        smallest_step: 1e-20 * horizon,
        limit: MOST_STEPS,
    };
    let (mut w, mut steps) = (start, 0);
    for segment in segments {
        let flow = Flow {
            joint,
            segment,
            silence: joint.silence(),
            cache: RefCell::new((segment.start, joint.plant.freeze(segment.start))),
        };
        let mut samples = segment.samples.as_slice();
        // a sample at the start needs no step
        if let Some(((index, t), rest)) = samples.split_first()
            && *t <= segment.start
        {
            if !record.sample((grid[*index], segment.inside(*t)), &joint.plant.freeze(*t), &w) {
                return Ok(steps);
            }
            samples = rest;
        }
        if joint.order() == 0 {
            for (index, t) in samples {
                if !record.sample((grid[*index], segment.inside(*t)), &joint.plant.freeze(*t), &w) {
                    return Ok(steps);
                }
            }
            continue;
        }
        let times: Vec<f64> = samples.iter().map(|(_, t)| *t).collect();
        let mut receive = |index: Option<usize>, state: &[f64]| match index {
            Some(k) => {
                let (index, t) = samples[k];
                let w = DVector::from_column_slice(state);
                record.sample((grid[index], segment.inside(t)), &joint.plant.freeze(t), &w)
            }
            None => state.iter().all(|x| x.abs() <= LARGEST_STATE),
        };
        let span = (segment.start, segment.end);
        let stops = (times.as_slice(), segment.kinks.as_slice());
        let outcome = match stiff_segment(&flow, span, w.as_slice(), stops, &options, &mut receive) {
            Ok(outcome) => outcome,
            Err(error) => return Err(explained(joint, segment, error)),
        };
        steps += outcome.steps;
        if outcome.stopped {
            if record.note.is_none() && record.error.is_none() {
                record.close(outcome.time, "a state");
            }
            return Ok(steps);
        }
        w = DVector::from_vec(outcome.state);
    }
    Ok(steps)
}

/// Names the signal when it is the reason why a derivative is not finite.
fn explained(
    joint: &Joint<'_>,
    segment: &Segment,
    error: crate::numerics::integrate::IntegrationError,
) -> SimulationError {
    use crate::numerics::integrate::IntegrationError::NotFinite;
    if let NotFinite { time } = error
        && let Err(signal) = joint.finite_values(segment.inside(time))
    {
        return signal;
    }
    error.into()
}

/// The largest value of each state in the nominal motion, as its usual size.
fn usual_sizes(joint: &Joint<'_>, segments: &[Segment], start: &DVector<f64>) -> Vec<f64> {
    /// States that hardly move are measured by this part of the largest.
    const LEAST: f64 = 1e-6;
    let nominal = joint.plant.nominal();
    let calm = Joint { plant: &nominal, observers: joint.observers.clone(), inputs: joint.inputs };
    let mut sizes = start.abs();
    let mut sample = |_: usize, _: f64, w: &DVector<f64>, _: &Frozen| {
        sizes = sizes.zip_map(w, |size, x| size.max(x.abs()));
        true
    };
    // an overflow or a signal without value shows again, and is reported, in the run itself
    let known = constant::run(&calm, segments, start.clone(), &mut sample).is_ok();
    let largest = if known { sizes.amax() } else { 0.0 };
    let least = if largest > 0.0 { LEAST * largest.max(1e-20) } else { 1.0 };
    sizes.iter().map(|s| s.max(least)).collect()
}
