//! The phases: decide by the largest margin, optimise, step back and maximise the margin.
//!
//! 1. Largest `t <= 1` such that `F >= t I` for all strict blocks in balanced coordinates, `F >= 0` for the others.
//!    With every variable bounded the problem is feasible and bounded; the sign of `t` decides.
//! 2. The least objective. Where the solver gets stuck, bisection on the objective through phase 1 takes its place:
//!    slower, to four digits, but it always decides.
//! 3. The objective at most `back_off` above the least, and the largest margin again: a strictly feasible point of
//!    moderate size. Where the solver gets stuck, the point between those of phases 1 and 2 takes its place.
//!
//! Infeasibility is never taken from a solver's status, which is unreliable near the boundary.

use super::expression::Expr;
use super::problem::Problem;
use super::run::{Run, Step};
use super::solution::{Found, Settings, Stop};

/// Decides whether a problem has a strictly feasible point, and finds the one with the largest margin.
///
/// # Errors
/// [`Stop::Infeasible`] with the block that stops it when the largest margin in balanced coordinates is below 1e-7;
/// [`Stop::Cancelled`]; [`Stop::GaveUp`] for a problem that is too large or not finite, and at the time limit.
pub fn feasible(problem: &Problem, settings: &Settings) -> Result<Found, Stop> {
    let mut run = Run::new(problem, &Expr::zeros(1, 1), settings)?;
    let interior = run.interior(&Step::new("largest margin", &settings.watch, 0.0, 1.0))?;
    Ok(run.found(&interior, None))
}

/// Finds the least value of a scalar objective, steps back from it and maximises the margin there.
///
/// The point has `objective <= optimum + back_off |optimum|` and a positive margin.
///
/// # Errors
/// As [`feasible`]; [`Stop::GaveUp`] for an objective without a lower bound, too.
///
/// # Panics
/// When the objective is not 1 x 1 or has a variable of another problem.
pub fn minimise(problem: &Problem, objective: &Expr, settings: &Settings) -> Result<Found, Stop> {
    let mut run = Run::new(problem, objective, settings)?;
    let (interior, least) = run.least(&settings.watch.part(0.0, 0.7))?;
    let watch = Step::new("largest margin near the optimum", &settings.watch, 0.7, 1.0);
    let backed_off = run.back_off(&interior, &least, &watch)?;
    Ok(run.found(&backed_off, Some(&least)))
}

/// Finds the least value of a scalar objective and the point on the boundary that reaches it.
///
/// # Errors
/// As [`minimise`].
///
/// # Panics
/// As [`minimise`].
pub fn optimum(problem: &Problem, objective: &Expr, settings: &Settings) -> Result<Found, Stop> {
    let mut run = Run::new(problem, objective, settings)?;
    let (_, least) = run.least(&settings.watch)?;
    Ok(run.found(&least, Some(&least)))
}
