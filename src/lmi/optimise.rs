//! Phases 2 and 3: the least objective, and the point behind it.

use super::clarabel::{Effort, End};
use super::program::{Goal, Program};
use super::run::{Candidate, Decision, NARROW, Run, Step, WIDE, largest};
use super::solution::Stop;
use crate::numerics::Watch;

impl Run<'_> {
    /// Phases 1 and 2: a point with the largest margin and one with the least objective.
    pub(super) fn least(&mut self, watch: &Watch) -> Result<(Candidate, Candidate), Stop> {
        let interior = self.interior(&Step::new("largest margin", watch, 0.0, 0.4))?;
        if self.scaled.objective.terms.is_empty() {
            return Ok((interior.clone(), interior));
        }
        let step = Step::new(format!("least {}", self.name), watch, 0.4, 1.0);
        let least = match self.least_by_solver(&step)? {
            Some(found) => found,
            None => self.least_by_bisection(&interior, &step)?,
        };
        Ok((interior, least))
    }

    /// Phase 2 by the solver; `None` when it gets stuck.
    ///
    /// An answer that is far away or doubtful is found once more with the first answer as the unit of all variables
    /// and blocks: the solver's tolerances are relative to the largest entry, and absolute below one.
    fn least_by_solver(&mut self, step: &Step) -> Result<Option<Candidate>, Stop> {
        const FAR: f64 = 1e4;
        const SMALL: f64 = 1e-2;
        let Some((first, solved)) = self.trusted_least(step)? else { return Ok(None) };
        let value = (self.objective(&first) - self.scaled.objective.constant).abs();
        if solved && first.size <= FAR && value >= SMALL {
            return Ok(Some(first));
        }
        let centred = self.scaled.centred(self.problem, &self.scaled.balanced_point(&first.x));
        let kept = std::mem::replace(&mut self.scaled, centred);
        let again = self.trusted_least(step);
        self.scaled = kept;
        Ok(Some(again?.map_or(first, |(second, _)| self.measured(second.x))))
    }

    /// The solver's answer when gap and violation are small, and whether it is within all tolerances.
    fn trusted_least(&mut self, step: &Step) -> Result<Option<(Candidate, bool)>, Stop> {
        const LARGEST: f64 = 1e-6;
        const OPTIMISE: f64 = 1e-9;
        let program = Program::new(&self.scaled, Goal::Least, WIDE);
        let answer = self.solve(&program, step, Effort { tolerance: OPTIMISE, enough: None })?;
        if answer.end == End::Unbounded {
            return Err(self.unbounded());
        }
        let Some(found) = self.candidate(&answer) else { return Ok(None) };
        let doubt = answer.gap.max(-found.margin / found.size);
        if doubt.is_nan() || doubt > LARGEST {
            return Ok(None);
        }
        if self.at_the_edge(&found) {
            return Err(self.unbounded());
        }
        Ok(Some((found, answer.end == End::Solved)))
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
            // what cannot be decided is not taken for feasible
            match self.decide(Some(level), WIDE, None, step)? {
                Decision::Feasible(found) => {
                    high = level.min(self.objective(&found));
                    best = found;
                    stride *= 4.0;
                    if high < -0.1 * WIDE {
                        return Err(self.unbounded());
                    }
                }
                Decision::Infeasible { .. } | Decision::Undecided => low = Some(level),
            }
        }
        Ok(best)
    }

    /// Whether a variable of the objective is where only the bound on all variables stops it.
    fn at_the_edge(&self, candidate: &Candidate) -> bool {
        let xi = self.scaled.balanced_point(&candidate.x);
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
    pub(super) fn back_off(
        &mut self,
        interior: &Candidate,
        least: &Candidate,
        step: &Step,
    ) -> Result<Candidate, Stop> {
        // what the back-off of an optimum near zero is relative to, in balanced units
        const NOTHING: f64 = 1e-3;
        let optimum = self.objective(least);
        let level = optimum + self.settings.back_off.max(0.0) * optimum.abs().max(NOTHING);
        if self.objective(interior) <= level {
            return Ok(interior.clone());
        }
        let width = NARROW.max(10.0 * largest(&self.scaled.balanced_point(&least.x)));
        match self.decide(Some(level), width, None, step) {
            Ok(Decision::Feasible(found)) => Ok(found),
            Err(Stop::Cancelled) => Err(Stop::Cancelled),
            // stuck, no margin or out of time
            Ok(_) | Err(_) => Ok(self.between(interior, least, level)),
        }
    }

    /// The point between two whose objective is at the level; its margin is at least the same mean of theirs.
    fn between(&self, interior: &Candidate, least: &Candidate, level: f64) -> Candidate {
        let (high, low) = (self.objective(interior), self.objective(least));
        let share = if high > low { ((level - low) / (high - low)).clamp(0.0, 1.0) } else { 1.0 };
        let mean = |(x, y): (&f64, &f64)| share * x + (1.0 - share) * y;
        let x: Vec<f64> = interior.x.iter().zip(&least.x).map(mean).collect();
        self.measured(x)
    }

    pub(super) fn measured(&self, x: Vec<f64>) -> Candidate {
        let xi = self.scaled.balanced_point(&x);
        Candidate { x, margin: self.scaled.smallest_eigenvalue(&xi, true).min(1.0), size: largest(&xi) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lmi::{Expr, Problem, Settings};
    use nalgebra::dmatrix;

    /// `[x, 2; 2, y] > 0`, least `x + y`: 4 at `x = y = 2`.
    fn problem() -> (Problem, Expr) {
        let mut problem = Problem::new();
        let (x, y) = (problem.scalar("x"), problem.scalar("y"));
        let two = Expr::constant(&dmatrix![2.0]);
        problem.strict("block", "test", Expr::symmetric(vec![vec![x.clone(), two], vec![y.clone()]]));
        (problem, x + y)
    }

    fn step() -> Step {
        Step::new("test", &Watch::none(), 0.0, 1.0)
    }

    #[test]
    fn bisection_agrees_with_the_solver() {
        let ((problem, objective), settings) = (problem(), Settings::default());
        let mut run = Run::new(&problem, &objective, &settings).unwrap();
        let interior = run.interior(&step()).unwrap();
        let solver = run.least_by_solver(&step()).unwrap().unwrap();
        let bisection = run.least_by_bisection(&interior, &step()).unwrap();
        let value = |candidate: &Candidate| run.scaled.original_objective(run.objective(candidate));
        assert!((value(&solver) - 4.0).abs() < 1e-7, "solver {}", value(&solver));
        assert!((0.0..1e-3).contains(&(value(&bisection) - 4.0)), "bisection {}", value(&bisection));
        assert!(bisection.margin > 0.0, "bisection ends inside: margin {}", bisection.margin);
    }

    #[test]
    fn bisection_notices_an_objective_without_bound() {
        let ((problem, objective), settings) = (problem(), Settings::default());
        let mut run = Run::new(&problem, &-objective, &settings).unwrap();
        let interior = run.interior(&step()).unwrap();
        let stop = run.least_by_bisection(&interior, &step()).unwrap_err();
        assert!(matches!(&stop, Stop::GaveUp(why) if why.contains("no lower bound")), "{stop}");
    }

    #[test]
    fn between_two_points_the_objective_is_at_the_level_and_the_margin_positive() {
        let ((problem, objective), settings) = (problem(), Settings::default());
        let mut run = Run::new(&problem, &objective, &settings).unwrap();
        let (interior, least) = run.least(&Watch::none()).unwrap();
        let level = 1.01 * run.objective(&least);
        let found = run.between(&interior, &least, level);
        assert!((run.objective(&found) / level - 1.0).abs() < 1e-9, "objective {}", run.objective(&found));
        assert!(found.margin > 0.0, "margin {}", found.margin);
    }
}
