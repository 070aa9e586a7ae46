//! Runs plant and observers together over a horizon.

use nalgebra::DVector;

use super::joint::Joint;
use super::record::Record;
use super::{InitialState, Inputs, Method, Plant, SimulationError, Trajectory, constant, varying};
use crate::numerics::integrate::segments;
use crate::observer::LinearObserver;

/// A state, output or estimate beyond this ends a trajectory.
pub const LARGEST_STATE: f64 = 1e12;
/// Most samples of a trajectory.
pub const MOST_SAMPLES: usize = 100_000;
/// Most states of plant and observers together.
pub const MOST_STATES: usize = 400;

/// The instants of a trajectory: an even grid over `0..=horizon`.
///
/// In discrete time the instants are `0, 1, ..., floor(horizon)`, and `samples` has no meaning.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Span {
    /// Last instant, in seconds (discrete: steps).
    pub horizon: f64,
    /// Number of instants, the first at zero and the last at the horizon.
    pub samples: usize,
}

impl Span {
    /// The grid, after checking the limits.
    pub(super) fn grid(self, discrete: bool) -> Result<Vec<f64>, SimulationError> {
        let least = if discrete { 1.0 } else { 0.0 };
        if !(self.horizon.is_finite() && self.horizon > 0.0 && self.horizon >= least) {
            return Err(SimulationError::Horizon { found: self.horizon });
        }
        let most = MOST_SAMPLES;
        if discrete {
            let grid: Vec<f64> =
                (0..=most).map(|k| k as f64).take_while(|k| *k <= self.horizon).take(most + 1).collect();
            let found = grid.len();
            return if found > most { Err(SimulationError::Samples { found, most }) } else { Ok(grid) };
        }
        if !(2..=most).contains(&self.samples) {
            return Err(SimulationError::Samples { found: self.samples, most });
        }
        let last = self.samples - 1;
        Ok((0..=last).map(|k| self.horizon * (k as f64 / last as f64)).collect())
    }
}

/// Simulates one plant with any number of observers beside it.
///
/// ```text
/// E x' = A(t) x + B u + D d,   y = C x + F d + noise,   each observer driven by u and y
/// ```
///
/// All observers see the same plant, the same inputs and the same noise. The initial state keeps `E x0`; its algebraic
/// part follows from the inputs at time zero. Constant coefficients are integrated by the matrix exponential, varying
/// ones by a stiff solver, discrete time by its recursion.
///
/// # Shapes
/// `x0`: n; each `z0`: the order of its observer.
///
/// # Errors
/// [`SimulationError`], with the reason in words. An unstable plant or observer is no error: the trajectory ends before
/// a value exceeds [`LARGEST_STATE`], and says so in its note.
pub fn simulate(
    plant: &Plant,
    observers: &[(&LinearObserver, &[f64])],
    x0: &[f64],
    inputs: &Inputs<'_>,
    span: Span,
) -> Result<Trajectory, SimulationError> {
    let grid = span.grid(plant.is_discrete())?;
    let designs: Vec<&LinearObserver> = observers.iter().map(|(observer, _)| *observer).collect();
    let joint = Joint::new(plant, &designs, *inputs)?;
    let n = plant.system().n_states();
    let found = n + observers.iter().map(|(o, _)| o.order()).sum::<usize>();
    if found > MOST_STATES {
        return Err(SimulationError::TooLarge { found, most: MOST_STATES });
    }
    check_vector("the initial state x0", x0, n)?;
    for (i, (observer, z0)) in observers.iter().enumerate() {
        check_vector(&format!("the initial state z0 of observer {}", i + 1), z0, observer.order())?;
    }
    let horizon = grid.last().copied().unwrap_or(0.0);
    let smallest = plant.smallest_a22(horizon)?;

    // w(0) = [V1' x0; z0_1; z0_2; ...]
    let xi = plant.differential(&DVector::from_column_slice(x0));
    let own = observers.iter().flat_map(|(_, z0)| z0.iter());
    let start = DVector::from_iterator(joint.order(), xi.iter().chain(own).copied());

    let mut record = Record::new(&joint);
    let pieces = segments(&grid, inputs.jumps, inputs.kinks);
    let first = pieces.first().map_or(0.0, |piece| piece.inside(0.0));
    let initial = initial_state(&joint, x0, &xi, if plant.is_discrete() { 0.0 } else { first })?;
    let work = if plant.is_discrete() {
        (Method::Recursion, recursion(&joint, &grid, start, &mut record)?)
    } else if plant.varies() {
        (Method::Stiff, varying::run(&joint, &grid, &pieces, start, &mut record)?)
    } else {
        let mut sample =
            |index: usize, inside: f64, w: &DVector<f64>, at: &_| record.sample((grid[index], inside), at, w);
        let (steps, overflow) = constant::run(&joint, &pieces, start, &mut sample)?;
        if let (Some(t), None) = (overflow, &record.note) {
            record.close(t, "a state");
        }
        (Method::Exponential, steps)
    };
    match record.error.take() {
        Some(error) => Err(error),
        None => Ok(record.finish(initial, smallest, work)),
    }
}

fn check_vector(what: &str, vector: &[f64], needed: usize) -> Result<(), SimulationError> {
    if vector.len() != needed {
        return Err(SimulationError::Shape {
            what: what.to_owned(),
            found: (vector.len(), 1),
            needed: (needed, 1),
            reason: "it has an entry for each state",
        });
    }
    if vector.iter().any(|x| !x.is_finite()) {
        return Err(SimulationError::NotFinite { what: what.to_owned() });
    }
    Ok(())
}

/// The consistent state with the same `E x`, and how far it is from the given one.
fn initial_state(
    joint: &Joint<'_>,
    x0: &[f64],
    xi: &DVector<f64>,
    t: f64,
) -> Result<InitialState, SimulationError> {
    let values = joint.finite_values(t)?;
    let forcing = joint.plant.forcing(&values.u, &values.d);
    let x = joint.plant.state(&joint.plant.freeze(t), xi, &forcing);
    let change = x.iter().zip(x0).map(|(new, old)| (new - old).abs()).fold(0.0, f64::max);
    Ok(InitialState { given: x0.to_vec(), consistent: x.iter().copied().collect(), change })
}

/// `w[k+1] = M(k) w[k] + ...`, with the algebraic states eliminated at every step.
fn recursion(
    joint: &Joint<'_>,
    grid: &[f64],
    start: DVector<f64>,
    record: &mut Record<'_>,
) -> Result<usize, SimulationError> {
    let mut w = start;
    for (k, t) in grid.iter().copied().enumerate() {
        let at = joint.plant.freeze(t);
        let values = joint.finite_values(t)?;
        let found = joint.evaluate(&at, &w, &values);
        if !record.push(t, &w, &values, &found) {
            return Ok(k);
        }
        w = found.derivative;
    }
    Ok(grid.len() - 1)
}
