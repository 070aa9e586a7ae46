//! Runs plant and observers together over a horizon.

use nalgebra::DVector;

use super::evaluator::Evaluator;
use super::joint::Joint;
use super::motion::Work;
use super::record::Record;
use super::singularity::Singularity;
use super::{InitialState, Inputs, Method, Observed, Plant, SimulationError, Trajectory, constant, motion};
use crate::numerics::Watch;
use crate::numerics::integrate::{Segment, segments};
use crate::observer::LinearObserver;
use crate::system::SampleRegion;

/// A signal, state, output or estimate beyond this ends a trajectory.
pub const LARGEST_STATE: f64 = 1e12;
/// Most samples of a trajectory.
pub const MOST_SAMPLES: usize = 100_000;
/// Most states of plant and observers together.
pub const MOST_STATES: usize = 400;
/// Samples between two looks whether the simulation is still wanted.
const BETWEEN_LOOKS: usize = 64;
/// What a watch is told.
pub(super) const STEP: &str = "simulation";
/// Kinks between grid points up to which exact steps are faster than steps with error control.
const MOST_CROSSINGS: usize = 32;
/// Instants of a trajectory at which its Lipschitz constant is looked at.
const LIPSCHITZ_SAMPLES: usize = 200;

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

/// Simulates one plant with any number of linear observers beside it; see [`simulate_observed`].
///
/// # Errors
/// As [`simulate_observed`].
pub fn simulate(
    plant: &Plant,
    observers: &[(&LinearObserver, &[f64])],
    x0: &[f64],
    inputs: &Inputs<'_>,
    span: Span,
) -> Result<Trajectory, SimulationError> {
    let observers: Vec<(Observed<'_>, &[f64])> =
        observers.iter().map(|(observer, z0)| ((*observer).into(), *z0)).collect();
    simulate_observed(plant, &observers, x0, inputs, span, &Watch::none())
}

/// Simulates one plant with any number of observers beside it.
///
/// ```text
/// E x' = A(t) x + B u + G f(t, x) + D d,   y = C x + F d + noise,   each observer driven by u and y
/// ```
///
/// All observers see the same plant, the same inputs and the same noise. The initial state keeps `E x0`; its algebraic
/// part follows from the inputs at time zero, and where it has several solutions from what is given. Linear equations
/// with constant coefficients are integrated by the matrix exponential, others by one-step methods with error control,
/// discrete time by its recursion. `watch` is asked on the way.
///
/// # Shapes
/// `x0`: n; each initial state of an observer: its order.
///
/// # Errors
/// [`SimulationError`], with the reason in words. An unstable plant or observer is no error: the trajectory ends before
/// a value exceeds [`LARGEST_STATE`], and says so in its note.
pub fn simulate_observed(
    plant: &Plant,
    observers: &[(Observed<'_>, &[f64])],
    x0: &[f64],
    inputs: &Inputs<'_>,
    span: Span,
    watch: &Watch,
) -> Result<Trajectory, SimulationError> {
    let grid = span.grid(plant.is_discrete())?;
    let designs: Vec<Observed<'_>> = observers.iter().map(|(observed, _)| *observed).collect();
    let joint = Joint::new(plant, &designs, *inputs)?;
    check_states(plant, observers, x0)?;
    if !watch.go_on(0.0, STEP) {
        return Err(SimulationError::Cancelled);
    }
    let horizon = grid.last().copied().unwrap_or(0.0);
    let smallest = plant.smallest_a22(horizon)?;

    // w(0) = [V1' x0; z0_1; z0_2; ...]
    let xi = plant.differential(&DVector::from_column_slice(x0));
    let own = observers.iter().flat_map(|(_, z0)| z0.iter());
    let start = DVector::from_iterator(joint.order(), xi.iter().chain(own).copied());

    let mut record = Record::new(&joint);
    let pieces = segments(&grid, inputs.jumps, inputs.kinks);
    let first = if plant.is_discrete() { 0.0 } else { pieces.first().map_or(0.0, |piece| piece.inside(0.0)) };
    let (evaluator, singularity, initial) = started(&joint, x0, &start, first)?;
    let mut work = if plant.is_discrete() {
        recursion((evaluator, singularity), &grid, start, &mut record, watch)
    } else if joint.is_linear_and_constant() && crossings(&pieces) <= MOST_CROSSINGS {
        exponential(evaluator, (&grid, &pieces), start, &mut record, watch)?
    } else {
        motion::run((evaluator, singularity), (&grid, &pieces), &start, &mut record, watch)
    };
    if let Some(error) = record.error.take() {
        return Err(error);
    }
    work.smallest = work.smallest.min(smallest);
    let mut trajectory = record.finish(initial, &work);
    trajectory.remarks.extend(lipschitz_remark(plant, &trajectory)?);
    Ok(trajectory)
}

/// How far a simulation is, for a watch.
#[expect(clippy::cast_possible_truncation, reason = "progress needs no more digits")]
pub(super) fn fraction(done: f64, all: f64) -> f32 {
    (done / all) as f32
}

/// Kinks between grid points: each needs steps of a length of its own.
fn crossings(pieces: &[Segment]) -> usize {
    pieces.iter().flat_map(Segment::stops).filter(|(index, _)| index.is_none()).count()
}

fn check_states(
    plant: &Plant,
    observers: &[(Observed<'_>, &[f64])],
    x0: &[f64],
) -> Result<(), SimulationError> {
    let n = plant.system().n_states();
    let found = n + observers.iter().map(|(o, _)| o.observer.order()).sum::<usize>();
    if found > MOST_STATES {
        return Err(SimulationError::TooLarge { found, most: MOST_STATES });
    }
    check_vector("the initial state x0", x0, n)?;
    for (i, (o, z0)) in observers.iter().enumerate() {
        check_vector(&format!("the initial state z0 of observer {}", i + 1), z0, o.observer.order())?;
    }
    Ok(())
}

pub(super) fn check_vector(what: &str, vector: &[f64], needed: usize) -> Result<(), SimulationError> {
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

/// The evaluator at the consistent start with the same `E x`, and how far that is from the given one.
fn started<'a>(
    joint: &'a Joint<'a>,
    x0: &[f64],
    start: &DVector<f64>,
    t: f64,
) -> Result<(Evaluator<'a>, Singularity, InitialState), SimulationError> {
    let mut evaluator = Evaluator::new(joint, x0);
    let mut singularity = Singularity::new();
    if !evaluator.evaluate(t, start.as_slice()) {
        let trouble = evaluator.trouble.take();
        return Err(trouble.map_or(SimulationError::NoAlgebraicSolution { time: t }, |trouble| {
            singularity.explain(t, trouble)
        }));
    }
    singularity.meet(&mut evaluator, t)?;
    evaluator.accept();
    let x = &evaluator.x;
    let change = x.iter().zip(x0).map(|(new, old)| (new - old).abs()).fold(0.0, f64::max);
    let initial = InitialState { given: x0.to_vec(), consistent: x.iter().copied().collect(), change };
    Ok((evaluator, singularity, initial))
}

/// Exact steps of linear equations with constant coefficients.
fn exponential<'a>(
    mut evaluator: Evaluator<'a>,
    (grid, pieces): (&[f64], &[Segment]),
    start: DVector<f64>,
    record: &mut Record<'a>,
    watch: &Watch,
) -> Result<Work, SimulationError> {
    let (joint, mut count) = (evaluator.joint, 0_usize);
    let mut sample = |index: usize, inside: f64, w: &DVector<f64>| {
        count += 1;
        if count.is_multiple_of(BETWEEN_LOOKS)
            && !watch.go_on(fraction(index as f64, grid.len() as f64), STEP)
        {
            record.stop(SimulationError::Cancelled);
            return false;
        }
        if evaluator.evaluate(inside, w.as_slice()) {
            return record.push(grid[index], w.as_slice(), &mut evaluator);
        }
        let trouble = evaluator.trouble.take();
        record.stop(trouble.map_or(SimulationError::NoAlgebraicSolution { time: inside }, |trouble| {
            Singularity::new().explain(inside, trouble)
        }));
        false
    };
    let (steps, overflow) = constant::run(joint, pieces, start, &mut sample)?;
    if let (Some(t), None) = (overflow, &record.note) {
        record.overflow(t);
    }
    Ok(Work { method: Method::Exponential, steps, smallest: f64::INFINITY })
}

/// `w[k+1] = F(k, w[k])`, with the algebraic states eliminated at every step.
fn recursion<'a>(
    (mut evaluator, mut singularity): (Evaluator<'a>, Singularity),
    grid: &[f64],
    start: DVector<f64>,
    record: &mut Record<'a>,
    watch: &Watch,
) -> Work {
    let (mut w, mut steps) = (start, 0);
    for (k, t) in grid.iter().copied().enumerate() {
        if k % BETWEEN_LOOKS == BETWEEN_LOOKS - 1 && !watch.go_on(fraction(t, grid.len() as f64), STEP) {
            record.stop(SimulationError::Cancelled);
            break;
        }
        steps = k;
        if !evaluator.evaluate(t, w.as_slice()) {
            let trouble = evaluator.trouble.take();
            record.stop(trouble.map_or(SimulationError::NoAlgebraicSolution { time: t }, |trouble| {
                singularity.explain(t, trouble)
            }));
            break;
        }
        if let Err(error) = singularity.meet(&mut evaluator, t) {
            record.stop(error);
            break;
        }
        evaluator.accept();
        if !record.push(t, w.as_slice(), &mut evaluator) {
            break;
        }
        w.copy_from(&evaluator.derivative);
    }
    Work { method: Method::Recursion, steps, smallest: singularity.smallest() }
}

/// Whether the motion or an estimate came where the Lipschitz constant does not hold.
fn lipschitz_remark(plant: &Plant, trajectory: &Trajectory) -> Result<Option<String>, SimulationError> {
    let Some(nonlinear) = &plant.nonlinear else { return Ok(None) };
    let states = [&trajectory.x].into_iter().chain(trajectory.observers.iter().map(|o| &o.x_hat));
    let points = states.flat_map(|states| {
        let times = trajectory.t.iter().copied();
        times.zip(states.column_iter()).map(|(t, x)| (t, x.into_owned()))
    });
    let region = SampleRegion::Points(points.collect());
    let found = nonlinear.term.sampled_constant(&region, LIPSCHITZ_SAMPLES, 1, &plant.tolerance)?;
    Ok(found.exceeded.then(|| found.statement()))
}
