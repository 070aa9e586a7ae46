//! The one file that names `diffsol`: BDF steps over a stretch of time without jumps.

use std::cell::Cell;

use diffsol::{NalgebraLU, NalgebraMat, OdeBuilder, OdeSolverMethod as _, OdeSolverStopReason};

use super::{AffineFlow, IntegrationError};

/// Derivatives beyond this are treated as not finite: squares of their ratios to the tolerance still fit a double.
const LARGEST_DERIVATIVE: f64 = 1e100;

/// Accuracy and work of the stiff solver.
#[derive(Clone, Debug, PartialEq)]
pub struct StiffOptions {
    /// Relative tolerance of a step.
    pub relative: f64,
    /// Absolute tolerance of a step, one per state.
    pub absolute: Vec<f64>,
    /// Smallest step.
    pub smallest_step: f64,
    /// Number of steps after which the solver gives up.
    pub limit: usize,
}

/// Where an integration ended.
#[derive(Clone, Debug, PartialEq)]
pub struct StiffOutcome {
    /// State at the end; where the receiver stopped it, the state of the last step.
    pub state: Vec<f64>,
    /// Time of that state.
    pub time: f64,
    /// Number of steps.
    pub steps: usize,
    /// Whether the receiver stopped it.
    pub stopped: bool,
}

/// Integrates over `span` and hands out the state at the ascending `times` within it.
///
/// `receive(Some(k), w)` gets the state at `times[k]`, `receive(None, w)` the state after every step; the integration
/// ends early when it returns false. Steps end at the `kinks`, where the forcing is continuous but not smooth.
///
/// # Errors
/// [`IntegrationError`]: a derivative that is not finite, too many steps, or the solver's own failure.
pub fn stiff_segment(
    flow: &impl AffineFlow,
    span: (f64, f64),
    start: &[f64],
    (times, kinks): (&[f64], &[f64]),
    options: &StiffOptions,
    receive: &mut dyn FnMut(Option<usize>, &[f64]) -> bool,
) -> Result<StiffOutcome, IntegrationError> {
    let order = flow.order();
    // diffsol panics on values that are not numbers: it only ever sees finite ones, and the first other is kept here
    let bad: Cell<Option<f64>> = Cell::new(None);
    let guard = |t: f64, out: &mut [f64]| {
        if out.iter().any(|x| x.is_nan() || x.abs() > LARGEST_DERIVATIVE) {
            bad.set(bad.get().or(Some(t)));
            out.fill(0.0);
        }
    };
    let mut problem = OdeBuilder::<NalgebraMat<f64>>::new()
        .t0(span.0)
        .rtol(options.relative)
        .atol(options.absolute.iter().copied())
        .rhs_implicit(
            |w, _parameters, t, out| {
                flow.derivative(t, w, out);
                guard(t, out);
            },
            |_w, _parameters, t, direction, out| {
                flow.product(t, direction, out);
                guard(t, out);
            },
        )
        .init(|_parameters, _t, out| out.copy_from_slice(start), order)
        .build()
        .map_err(|error| failure(span.0, &error))?;
    problem.ode_options.min_timestep = options.smallest_step;
    // counted over the whole run, not per step
    problem.ode_options.max_nonlinear_solver_failures = options.limit;
    let mut solver = problem.bdf::<NalgebraLU<f64>>().map_err(|error| failure(span.0, &error))?;
    let mut stops = kinks.iter().copied().filter(|t| *t > span.0 && *t < span.1).chain([span.1]);
    let mut stop = stops.next().unwrap_or(span.1);
    solver.set_stop_time(stop).map_err(|error| failure(span.0, &error))?;
    let (mut next, mut steps) = (0, 0);
    loop {
        let reached = solver.state().t;
        if steps >= options.limit {
            return Err(IntegrationError::TooManySteps { time: reached, limit: options.limit });
        }
        let reason = solver.step();
        if let Some(time) = bad.get() {
            return Err(IntegrationError::NotFinite { time });
        }
        let reason = reason.map_err(|error| failure(reached, &error))?;
        steps += 1;
        let now = solver.state().t;
        let at_end = matches!(reason, OdeSolverStopReason::TstopReached) && stop >= span.1;
        while next < times.len() && (times[next] <= now || at_end) {
            let state = solver.interpolate(times[next].min(now)).map_err(|error| failure(now, &error))?;
            if !receive(Some(next), state.batch_as_slice(0)) {
                let (state, time) = (state.batch_as_slice(0).to_vec(), times[next]);
                return Ok(StiffOutcome { state, time, steps, stopped: true });
            }
            next += 1;
        }
        let stopped = !receive(None, solver.state().y.batch_as_slice(0));
        if at_end || stopped {
            let state = solver.state().y.batch_as_slice(0).to_vec();
            return Ok(StiffOutcome { state, time: now, steps, stopped });
        }
        if matches!(reason, OdeSolverStopReason::TstopReached) {
            stop = stops.next().unwrap_or(span.1);
            solver.set_stop_time(stop).map_err(|error| failure(now, &error))?;
        }
    }
}

fn failure(time: f64, error: &diffsol::DiffsolError) -> IntegrationError {
    IntegrationError::Solver { time, reason: error.to_string() }
}
