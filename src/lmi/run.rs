//! What the phases share: a balanced problem, what is left of the time, and the decision by the largest margin.

use super::clarabel::{Answer, Effort, End, Limits, solve};
use super::expression::Expr;
use super::problem::Problem;
use super::program::{Goal, Program};
use super::scaled::{Block, Scaled};
use super::solution::{Found, Point, Settings, Stop};
use crate::numerics::Watch;

/// A margin in balanced coordinates is positive when it exceeds this: ten times the solver's tolerance.
const ZERO: f64 = 1e-7;

/// The solver's tolerance for a decision.
const DECIDE: f64 = 1e-8;

/// How far balanced variables may go at first.
pub(super) const NARROW: f64 = 1e3;

/// How far balanced variables may go at all.
pub(super) const WIDE: f64 = 1e6;

/// What is being found, for whom to tell.
pub(super) struct Step {
    pub(super) label: String,
    pub(super) watch: Watch,
}

impl Step {
    pub(super) fn new(label: impl Into<String>, watch: &Watch, from: f32, to: f32) -> Self {
        Self { label: label.into(), watch: watch.part(from, to) }
    }
}

/// A point in original coordinates, and its margin in balanced ones, recomputed.
#[derive(Clone, Debug)]
pub(super) struct Candidate {
    pub(super) x: Vec<f64>,
    pub(super) margin: f64,
    /// The largest entry in balanced coordinates, at least one.
    pub(super) size: f64,
}

/// What phase 1 says.
pub(super) enum Decision {
    Feasible(Candidate),
    Infeasible {
        block: String,
        source: String,
        margin: f64,
    },
    /// The solver got stuck, or the bounds alone contradict each other.
    Undecided,
}

pub(super) struct Run<'a> {
    pub(super) problem: &'a Problem,
    pub(super) scaled: Scaled,
    pub(super) settings: &'a Settings,
    pub(super) name: String,
    seconds: f64,
    iterations: u32,
}

impl<'a> Run<'a> {
    pub(super) fn new(problem: &'a Problem, objective: &Expr, settings: &'a Settings) -> Result<Self, Stop> {
        check_objective(problem, objective);
        let scaled = Scaled::new(problem, objective, settings)?;
        let name = match scaled.objective.terms.as_slice() {
            [(unknown, _)] => problem.name_of(*unknown).to_owned(),
            _ => "objective".to_owned(),
        };
        Ok(Self { problem, scaled, settings, name, seconds: settings.seconds, iterations: 0 })
    }

    /// One solve within what is left of the time.
    pub(super) fn solve(&mut self, program: &Program, step: &Step, effort: Effort) -> Result<Answer, Stop> {
        if self.seconds.is_nan() || self.seconds <= 0.0 {
            return Err(self.out_of_time(&step.label));
        }
        let limits = Limits { seconds: self.seconds, watch: &step.watch, label: &step.label, effort };
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

    /// Phase 1: narrow first, because such a point is well conditioned, then wide.
    pub(super) fn interior(&mut self, step: &Step) -> Result<Candidate, Stop> {
        if let Decision::Feasible(found) = self.decide(None, NARROW, Some(ZERO), step)? {
            return Ok(found);
        }
        match self.decide(None, WIDE, None, step)? {
            Decision::Feasible(found) => Ok(found),
            Decision::Infeasible { block, source, margin } => Err(Stop::Infeasible { block, source, margin }),
            Decision::Undecided => Err(self.bounds_alone(step)?),
        }
    }

    /// Whether there is a positive margin with the objective at most `level` and all variables within `width`.
    ///
    /// With `enough` the solve may end as soon as the margin is known to be below `-enough`.
    pub(super) fn decide(
        &mut self,
        level: Option<f64>,
        width: f64,
        enough: Option<f64>,
        step: &Step,
    ) -> Result<Decision, Stop> {
        const CLOSE: f64 = 1e-6;
        let program = Program::new(&self.scaled, Goal::Margin { level, all: false }, width);
        let answer = self.solve(&program, step, Effort { tolerance: DECIDE, enough })?;
        if matches!(answer.end, End::Infeasible | End::Unbounded) {
            return Ok(Decision::Undecided);
        }
        let Some(candidate) = self.candidate(&answer) else { return Ok(Decision::Undecided) };
        if candidate.margin > ZERO {
            return Ok(Decision::Feasible(candidate));
        }
        let decided =
            answer.end == End::Exceeded || answer.gap <= CLOSE || candidate.margin + answer.gap <= ZERO;
        if !decided {
            return Ok(Decision::Undecided);
        }
        let strict = |block: &Block| block.strict;
        let (block, source) = self.blocking(&program, &answer, strict).unwrap_or_default();
        Ok(Decision::Infeasible { block, source, margin: candidate.margin })
    }

    /// The point of an answer when it keeps the bounds up to rounding.
    pub(super) fn candidate(&self, answer: &Answer) -> Option<Candidate> {
        const ROUNDING: f64 = 1e-6;
        let xi = answer.x.get(..self.scaled.unknowns())?;
        if !xi.iter().all(|x| x.is_finite()) {
            return None;
        }
        let size = largest(xi);
        let margin = self.scaled.smallest_eigenvalue(xi, true).min(1.0);
        let kept = self.scaled.smallest_eigenvalue(xi, false) >= -ROUNDING * size;
        let x = self.scaled.original(xi);
        (kept && margin > f64::NEG_INFINITY).then_some(Candidate { x, margin, size })
    }

    /// Name and source of the block with the largest multiplier: what stops a larger margin.
    fn blocking(
        &self,
        program: &Program,
        answer: &Answer,
        judged: impl Fn(&Block) -> bool,
    ) -> Option<(String, String)> {
        let traces = program.multiplier_traces(&answer.multipliers);
        let judged = self.scaled.blocks.iter().zip(traces).filter(|(block, _)| judged(block));
        let (block, _) = judged.max_by(|a, b| a.1.total_cmp(&b.1))?;
        let constraint = self.problem.constraints().get(block.constraint)?;
        Some((constraint.name.clone(), constraint.source.clone()))
    }

    /// Why phase 1 has no point at all: the bounds contradict each other, or the numbers do not allow a decision.
    fn bounds_alone(&mut self, step: &Step) -> Result<Stop, Stop> {
        let program = Program::new(&self.scaled, Goal::Margin { level: None, all: true }, WIDE);
        let answer = self.solve(&program, step, Effort { tolerance: DECIDE, enough: None })?;
        let margin = answer.x.get(..self.scaled.unknowns()).map_or(f64::NAN, |xi| {
            self.scaled.smallest_eigenvalue(xi, true).min(self.scaled.smallest_eigenvalue(xi, false))
        });
        let contradicting = margin < -ZERO && answer.end == End::Solved;
        let most = contradicting.then(|| self.blocking(&program, &answer, |_| true)).flatten();
        if let Some((block, source)) = most {
            return Ok(Stop::Infeasible { block, source, margin });
        }
        let why =
            "The numbers of the inequalities do not allow a decision: choose units in which they are closer";
        Ok(Stop::GaveUp(why.to_owned()))
    }

    pub(super) fn objective(&self, candidate: &Candidate) -> f64 {
        self.scaled.objective.value(&self.scaled.balanced_point(&candidate.x))
    }

    pub(super) fn found(&self, candidate: &Candidate, least: Option<&Candidate>) -> Found {
        let in_original = |candidate: &Candidate| self.scaled.original_objective(self.objective(candidate));
        Found {
            point: Point::new(candidate.x.clone()),
            optimum: least.map(in_original),
            objective: least.map(|_| in_original(candidate)),
            margin: candidate.margin,
            iterations: self.iterations,
        }
    }
}

/// A mistake in the source, never of user data.
fn check_objective(problem: &Problem, objective: &Expr) {
    assert!(
        (objective.nrows(), objective.ncols()) == (1, 1),
        "the objective is {} x {}, not a scalar",
        objective.nrows(),
        objective.ncols()
    );
    assert!(objective.reach() <= problem.unknowns(), "the objective has a variable of another problem");
}

/// The largest amount, at least one.
pub(super) fn largest(xi: &[f64]) -> f64 {
    xi.iter().fold(1.0, |most, x| most.max(x.abs()))
}
