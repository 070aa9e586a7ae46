//! Constant coefficients: exact steps between grid points, jumps and kinks.

use nalgebra::{DMatrix, DVector};

use super::SimulationError;
use super::joint::Joint;
use super::run::LARGEST_STATE;
use crate::numerics::NumericsError;
use crate::numerics::integrate::{NODES, Propagator, Segment};

/// Inputs are followed to this relative accuracy by the cubic of a step; steps are divided until they are.
const FOLLOWED: f64 = 1e-9;
/// Most parts of a step between two stops.
const MOST_PARTS: usize = 64;
/// Propagators that are kept for steps of the same length.
const KEPT: usize = 32;

/// All signals at the four nodes of a step.
type NodeValues = [DVector<f64>; 4];

/// Receives grid index, instant of evaluation and joint state; false ends the run.
type Sample<'s> = dyn FnMut(usize, f64, &DVector<f64>) -> bool + 's;

/// Runs over all segments; returns the number of steps, and the time at which a step overflowed.
pub(super) fn run(
    joint: &Joint<'_>,
    segments: &[Segment],
    start: DVector<f64>,
    sample: &mut Sample<'_>,
) -> Result<(usize, Option<f64>), SimulationError> {
    let (m, g) = joint.coefficients();
    let mut steps = Steps { m, g, kept: Vec::new(), same: 0.0 };
    let horizon = segments.last().map_or(0.0, |s| s.end);
    // a step may be off by this much: far below what a state moves in it
    steps.same = 1e-12 * horizon;
    let (mut w, mut count, mut parts, mut scale) = (start, 0, 1, 0.0_f64);
    for segment in segments {
        let mut now = segment.start;
        for (index, stop) in segment.stops() {
            if stop > now {
                // a rough stretch does not slow down what follows
                parts = (parts / 2).max(1);
                let inputs = loop {
                    let length = (stop - now) / parts as f64;
                    let (inputs, fits) = follow(joint, segment, (now, length, parts), &mut scale)?;
                    if fits || parts >= MOST_PARTS {
                        break inputs;
                    }
                    parts *= 2;
                };
                let propagator = match steps.of((stop - now) / inputs.len() as f64) {
                    Ok(propagator) => propagator,
                    Err(NumericsError::NotFinite { .. }) => return Ok((count, Some(stop))),
                    Err(error) => return Err(error.into()),
                };
                for values in &inputs {
                    w = propagator.step(&w, values);
                }
                count += inputs.len();
                now = stop;
            }
            if w.iter().any(|x| x.is_nan() || x.abs() > LARGEST_STATE) {
                return Ok((count, Some(stop)));
            }
            if let Some(index) = index
                && !sample(index, segment.inside(stop), &w)
            {
                return Ok((count, None));
            }
        }
    }
    Ok((count, None))
}

/// Inputs at the nodes of equal parts of a step, and whether their cubics follow the inputs closely.
fn follow(
    joint: &Joint<'_>,
    segment: &Segment,
    (start, length, parts): (f64, f64, usize),
    scale: &mut f64,
) -> Result<(Vec<NodeValues>, bool), SimulationError> {
    /// Weights of the cubic through the nodes at the middle of a step.
    const MIDDLE: [f64; 4] = [-0.125, 0.625, 0.625, -0.125];
    let at = |t: f64| joint.finite_values(segment.inside(t)).map(|values| Joint::stacked(&values));
    let mut inputs = Vec::with_capacity(parts);
    let mut fits = true;
    for part in 0..parts {
        let begin = start + length * part as f64;
        let [a, b, c, d] = NODES.map(|node| at(begin + node * length));
        let values = [a?, b?, c?, d?];
        let middle = at(begin + 0.5 * length)?;
        let mut cubic = DVector::zeros(middle.len());
        for (weight, value) in MIDDLE.iter().zip(&values) {
            cubic.axpy(*weight, value, 1.0);
            *scale = value.iter().fold(*scale, |s, x| s.max(x.abs()));
        }
        let off = cubic.iter().zip(middle.iter()).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        fits &= off <= FOLLOWED * *scale;
        inputs.push(values);
    }
    Ok((inputs, fits))
}

/// Propagators by step length.
struct Steps {
    m: DMatrix<f64>,
    g: DMatrix<f64>,
    kept: Vec<(f64, Propagator)>,
    same: f64,
}

impl Steps {
    fn of(&mut self, length: f64) -> Result<&Propagator, NumericsError> {
        let same = self.same;
        if let Some(found) = self.kept.iter().position(|(h, _)| (h - length).abs() <= same) {
            return Ok(&self.kept[found].1);
        }
        if self.kept.len() >= KEPT {
            // the first is the grid's own step and stays
            self.kept.truncate(1);
        }
        self.kept.push((length, Propagator::new(&self.m, &self.g, length)?));
        let last = self.kept.len() - 1;
        Ok(&self.kept[last].1)
    }
}
