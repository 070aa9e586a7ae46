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

use super::clarabel::{Answer, End, Limits, solve};
use super::expression::Expr;
use super::problem::Problem;
use super::program::{Goal, Program};
use super::scaled::Scaled;
use super::solution::{Found, Point, Settings, Stop};
use crate::numerics::Watch;

/// A margin in balanced coordinates is positive when it exceeds this: a hundred times the solver's tolerance.
const ZERO: f64 = 1e-7;

/// How far balanced variables may go at first: such a point is well conditioned.
const NARROW: f64 = 1e3;

/// How far balanced variables may go at all.
const WIDE: f64 = 1e6;

/// Decides whether a problem has a strictly feasible point, and finds the one with the largest margin.
///
/// # Errors
/// [`Stop::Infeasible`] with the block that stops it when the largest margin in balanced coordinates is below 1e-7;
/// [`Stop::Cancelled`]; [`Stop::GaveUp`] for a problem that is too large or not finite, and at the time limit.
pub fn feasible(problem: &Problem, settings: &Settings) -> Result<Found, Stop> {
    let mut run = Run::new(problem, &Expr::zeros(1, 1), settings)?;
    let interior =
        run.decide(None, &[NARROW, WIDE], &Step::new("largest margin", &settings.watch, 0.0, 1.0))?;
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
    let (interior, least) = run.least(settings.watch.part(0.0, 0.7))?;
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
    let (_, least) = run.least(settings.watch.clone())?;
    Ok(run.found(&least, Some(&least)))
}

/// What is being found, for whom to tell.
struct Step {
    label: String,
    watch: Watch,
}

impl Step {
    fn new(label: impl Into<String>, watch: &Watch, from: f32, to: f32) -> Self {
        Self { label: label.into(), watch: watch.part(from, to) }
    }
}

/// A point in balanced coordinates and its margin, recomputed.
#[derive(Clone, Debug)]
struct Candidate {
    xi: Vec<f64>,
    margin: f64,
}

struct Run<'a> {
    problem: &'a Problem,
    scaled: Scaled,
    settings: &'a Settings,
    name: String,
    seconds: f64,
    iterations: u32,
}

impl<'a> Run<'a> {
    fn new(problem: &'a Problem, objective: &Expr, settings: &'a Settings) -> Result<Self, Stop> {
        assert!(
            (objective.nrows(), objective.ncols()) == (1, 1),
            "the objective is {} x {}, not a scalar",
            objective.nrows(),
            objective.ncols()
        );
        assert!(objective.reach() <= problem.unknowns(), "the objective has a variable of another problem");
        let scaled = Scaled::new(problem, objective, settings)?;
        let name = match scaled.objective.terms.as_slice() {
            [(unknown, _)] => problem.name_of(*unknown).to_owned(),
            _ => "objective".to_owned(),
        };
        Ok(Self { problem, scaled, settings, name, seconds: settings.seconds, iterations: 0 })
    }

    /// One solve within what is left of the time.
    fn solve(&mut self, program: &Program, step: &Step) -> Result<Answer, Stop> {
        if self.seconds.is_nan() || self.seconds <= 0.0 {
            return Err(self.out_of_time(&step.label));
        }
        let limits = Limits { seconds: self.seconds, watch: &step.watch, label: &step.label };
        let answer = solve(program, &limits);
        self.seconds -= answer.seconds;
        self.iterations += answer.iterations;
        match answer.end {
            End::Cancelled => Err(Stop::Cancelled),
            End::OutOfTime => Err(self.out_of_time(&step.label)),
            _ => Ok(answer),
        }
    }

    fn out_of_time(&self, label: &str) -> Stop {
        Stop::GaveUp(format!(
            "The time limit of {} s was reached while finding the {label}: raise it or reduce the order",
            self.settings.seconds
        ))
    }

    /// Phase 1, with one width of the variables after the other until the margin is positive.
    fn decide(&mut self, level: Option<f64>, widths: &[f64], step: &Step) -> Result<Candidate, Stop> {
        let mut best: Option<(Candidate, String, String)> = None;
        for width in widths {
            let program = Program::new(&self.scaled, Goal::Margin { level, all: false }, *width);
            let answer = self.solve(&program, step)?;
            if matches!(answer.end, End::Infeasible | End::Unbounded) {
                continue;
            }
            let Some(candidate) = self.candidate(&answer) else { continue };
            if candidate.margin > ZERO {
                return Ok(candidate);
            }
            if best.as_ref().is_none_or(|(known, _, _)| known.margin < candidate.margin) {
                let (block, source) = self.blocking(&program, &answer);
                best = Some((candidate, block, source));
            }
        }
        match best {
            Some((found, block, source)) => Err(Stop::Infeasible { block, source, margin: found.margin }),
            None => Err(self.bounds_alone(step)?),
        }
    }

    /// The point of an answer when it keeps the bounds up to rounding.
    fn candidate(&self, answer: &Answer) -> Option<Candidate> {
        const ROUNDING: f64 = 1e-6;
        let xi = answer.x.get(..self.scaled.unknowns())?.to_vec();
        if !xi.iter().all(|x| x.is_finite()) {
            return None;
        }
        let size = xi.iter().fold(1.0_f64, |most, x| most.max(x.abs()));
        let margin = self.scaled.smallest_eigenvalue(&xi, true).min(1.0);
        let kept = self.scaled.smallest_eigenvalue(&xi, false) >= -ROUNDING * size;
        (kept && margin > f64::NEG_INFINITY).then_some(Candidate { xi, margin })
    }

    /// The block with the largest multiplier at the largest margin.
    fn blocking(&self, program: &Program, answer: &Answer) -> (String, String) {
        let traces = program.multiplier_traces(&answer.multipliers);
        let judged = self.scaled.blocks.iter().zip(traces);
        let strict = judged.filter(|(block, _)| block.strict);
        let most = strict.max_by(|a, b| a.1.total_cmp(&b.1));
        most.and_then(|(block, _)| self.problem.constraints().get(block.constraint))
            .map_or_else(Default::default, |found| (found.name.clone(), found.source.clone()))
    }

    /// Why phase 1 has no point at all: the bounds contradict each other, or the numbers do not allow a decision.
    fn bounds_alone(&mut self, step: &Step) -> Result<Stop, Stop> {
        let program = Program::new(&self.scaled, Goal::Margin { level: None, all: true }, WIDE);
        let answer = self.solve(&program, step)?;
        let margin = answer.x.get(..self.scaled.unknowns()).map_or(f64::NAN, |xi| {
            self.scaled.smallest_eigenvalue(xi, true).min(self.scaled.smallest_eigenvalue(xi, false))
        });
        if margin < -ZERO && answer.end == End::Solved {
            let traces = program.multiplier_traces(&answer.multipliers);
            let most = self.scaled.blocks.iter().zip(traces).max_by(|a, b| a.1.total_cmp(&b.1));
            let constraint = most.and_then(|(block, _)| self.problem.constraints().get(block.constraint));
            if let Some(found) = constraint {
                return Ok(Stop::Infeasible {
                    block: found.name.clone(),
                    source: found.source.clone(),
                    margin,
                });
            }
        }
        Ok(Stop::GaveUp(
            "The numbers of the inequalities do not allow a decision: choose units in which they are closer together"
                .to_owned(),
        ))
    }

    /// Phases 1 and 2: a point with the largest margin and one with the least objective.
    fn least(&mut self, watch: Watch) -> Result<(Candidate, Candidate), Stop> {
        let interior = self.decide(None, &[NARROW, WIDE], &Step::new("largest margin", &watch, 0.0, 0.4))?;
        if self.scaled.objective.terms.is_empty() {
            return Ok((interior.clone(), interior));
        }
        let step = Step::new(format!("least {}", self.name), &watch, 0.4, 1.0);
        let least = match self.least_by_solver(&step)? {
            Some(found) => found,
            None => self.least_by_bisection(&interior, &step)?,
        };
        Ok((interior, least))
    }

    /// Phase 2 by the solver; `None` when it gets stuck.
    fn least_by_solver(&mut self, step: &Step) -> Result<Option<Candidate>, Stop> {
        // the solver's tolerances are absolute below one: a small optimum is enlarged and found once more
        const SMALL: f64 = 1e-2;
        const NOTHING: f64 = 1e-7;
        const LARGEST_GAP: f64 = 1e-6;
        let mut factor = 1.0;
        let mut best = None;
        for _ in 0..2 {
            let program = Program::new(&self.scaled, Goal::Least { factor }, WIDE);
            let answer = self.solve(&program, step)?;
            if answer.end == End::Unbounded {
                return Err(self.unbounded());
            }
            let Some(found) = self.candidate(&answer) else { break };
            let size = found.xi.iter().fold(1.0_f64, |most, x| most.max(x.abs()));
            if found.margin < -LARGEST_GAP * size || answer.gap.is_nan() || answer.gap > LARGEST_GAP {
                break;
            }
            if self.at_the_edge(&found.xi) {
                return Err(self.unbounded());
            }
            let value = (self.objective(&found) - self.scaled.objective.constant).abs();
            best = Some(found);
            if value * factor >= SMALL || value < NOTHING {
                break;
            }
            factor = 1.0 / value;
        }
        Ok(best)
    }

    /// Phase 2 by deciding level after level.
    fn least_by_bisection(&mut self, interior: &Candidate, step: &Step) -> Result<Candidate, Stop> {
        const DIGITS: f64 = 1e-4;
        const NOTHING: f64 = 1e-6;
        const MOST: u32 = 60;
        let mut best = interior.clone();
        let mut high = self.objective(&best);
        let mut low = None;
        let mut stride = high.abs().max(1.0);
        for _ in 0..MOST {
            let level = match low {
                None => high - stride,
                Some(low) if high - low <= DIGITS * high.abs().max(NOTHING) => return Ok(best),
                Some(low) => 0.5 * (low + high),
            };
            match self.decide(Some(level), &[WIDE], step) {
                Ok(found) => {
                    high = level.min(self.objective(&found));
                    best = found;
                    stride *= 4.0;
                    if self.at_the_edge(&best.xi) {
                        return Err(self.unbounded());
                    }
                }
                Err(Stop::Infeasible { .. }) => low = Some(level),
                Err(stop @ (Stop::Cancelled | Stop::GaveUp(_))) => return Err(stop),
            }
        }
        Ok(best)
    }

    /// Whether a variable of the objective is where only the bound on all variables stops it.
    fn at_the_edge(&self, xi: &[f64]) -> bool {
        let far = |(index, _): &(usize, f64)| xi.get(*index).is_some_and(|x| x.abs() > 0.9 * WIDE);
        self.scaled.objective.terms.iter().any(far)
    }

    fn unbounded(&self) -> Stop {
        Stop::GaveUp(format!(
            "{} has no lower bound under these inequalities: bound it or the variables it depends on",
            self.name
        ))
    }

    /// Phase 3.
    fn back_off(&mut self, interior: &Candidate, least: &Candidate, step: &Step) -> Result<Candidate, Stop> {
        // what the back-off of an optimum near zero is relative to, in balanced units
        const NOTHING: f64 = 1e-3;
        let optimum = self.objective(least);
        let level = optimum + self.settings.back_off.max(0.0) * optimum.abs().max(NOTHING);
        if self.objective(interior) <= level {
            return Ok(interior.clone());
        }
        let width = least.xi.iter().fold(NARROW, |most, x| most.max(10.0 * x.abs()));
        match self.decide(Some(level), &[width], step) {
            Ok(found) => Ok(found),
            Err(Stop::Infeasible { .. } | Stop::GaveUp(_)) => Ok(self.between(interior, least, level)),
            Err(Stop::Cancelled) => Err(Stop::Cancelled),
        }
    }

    /// The point between two whose objective is at the level; its margin is at least the same mean of theirs.
    fn between(&self, interior: &Candidate, least: &Candidate, level: f64) -> Candidate {
        let (high, low) = (self.objective(interior), self.objective(least));
        let share = if high > low { ((level - low) / (high - low)).clamp(0.0, 1.0) } else { 1.0 };
        let mean = |(x, y): (&f64, &f64)| share * x + (1.0 - share) * y;
        let xi: Vec<f64> = interior.xi.iter().zip(&least.xi).map(mean).collect();
        let margin = self.scaled.smallest_eigenvalue(&xi, true).min(1.0);
        Candidate { xi, margin }
    }

    fn objective(&self, candidate: &Candidate) -> f64 {
        self.scaled.objective.value(&candidate.xi)
    }

    fn found(&self, candidate: &Candidate, least: Option<&Candidate>) -> Found {
        let in_original = |candidate: &Candidate| self.scaled.original_objective(self.objective(candidate));
        Found {
            point: Point::new(self.scaled.original(&candidate.xi)),
            optimum: least.map(in_original),
            objective: least.map(|_| in_original(candidate)),
            margin: candidate.margin,
            iterations: self.iterations,
        }
    }
}
