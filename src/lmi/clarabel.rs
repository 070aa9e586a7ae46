//! The one file that names the semidefinite solver.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use clarabel::algebra::CscMatrix;
use clarabel::solver::{
    DefaultInfo, DefaultSettings, DefaultSolver, IPSolver as _, SolverStatus, SupportedConeT,
};

use super::program::{Cone, Program};
use crate::numerics::Watch;

/// What a solve may use, and whom it tells.
pub(super) struct Limits<'a> {
    pub(super) seconds: f64,
    pub(super) watch: &'a Watch,
    /// What is being found ("least gamma"), the beginning of the progress text.
    pub(super) label: &'a str,
    pub(super) effort: Effort,
}

/// How exactly to solve.
#[derive(Clone, Copy, Debug)]
pub(super) struct Effort {
    /// Tolerance of gap and feasibility.
    pub(super) tolerance: f64,
    /// The solve may end as soon as the least value is known to exceed this.
    pub(super) enough: Option<f64>,
}

/// How a solve ended.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum End {
    /// Within the tolerances.
    Solved,
    /// Within far wider tolerances, or stuck on the way: the point may still serve.
    Doubtful(String),
    Infeasible,
    Unbounded,
    /// The least value exceeds what was enough to know.
    Exceeded,
    Cancelled,
    OutOfTime,
}

/// The end of a solve and the last point.
#[derive(Clone, Debug)]
pub(super) struct Answer {
    pub(super) end: End,
    pub(super) x: Vec<f64>,
    /// One for each row of the program.
    pub(super) multipliers: Vec<f64>,
    /// `|value - dual value|` relative to the value where that exceeds one.
    pub(super) gap: f64,
    pub(super) iterations: u32,
    pub(super) seconds: f64,
}

/// Solves `min q'x` subject to `A x + s = b`, `s` in the cones. The data must be finite.
pub(super) fn solve(program: &Program, limits: &Limits<'_>) -> Answer {
    let (rows, columns) = (program.offsets.len(), program.objective.len());
    let entries = &program.entries;
    let matrix = CscMatrix::new_from_triplets(
        rows,
        columns,
        entries.iter().map(|entry| entry.0).collect(),
        entries.iter().map(|entry| entry.1).collect(),
        entries.iter().map(|entry| entry.2).collect(),
    );
    let cones: Vec<SupportedConeT<f64>> = program
        .cones
        .iter()
        .map(|cone| match *cone {
            Cone::Positive(count) => SupportedConeT::NonnegativeConeT(count),
            Cone::Semidefinite(size) => SupportedConeT::PSDTriangleConeT(size),
        })
        .collect();
    let no_squares = CscMatrix::zeros((columns, columns));
    let settings = settings(limits);
    match DefaultSolver::new(&no_squares, &program.objective, &matrix, &program.offsets, &cones, settings) {
        Ok(mut solver) => {
            let exceeded = Arc::new(AtomicBool::new(false));
            solver.set_termination_callback(report(limits, Arc::clone(&exceeded)));
            solver.solve();
            let mut answer = answer(&solver);
            if exceeded.load(Ordering::Relaxed) {
                answer.end = End::Exceeded;
            }
            answer
        }
        Err(error) => Answer {
            end: End::Doubtful(error.to_string()),
            x: Vec::new(),
            multipliers: Vec::new(),
            gap: f64::INFINITY,
            iterations: 0,
            seconds: 0.0,
        },
    }
}

fn settings(limits: &Limits<'_>) -> DefaultSettings<f64> {
    DefaultSettings {
        verbose: false,
        max_iter: 200,
        time_limit: limits.seconds,
        tol_gap_abs: limits.effort.tolerance,
        tol_gap_rel: limits.effort.tolerance,
        tol_feas: limits.effort.tolerance,
        // the blocks are small and dense
        chordal_decomposition_enable: false,
        ..DefaultSettings::default()
    }
}

/// Tells the watch of each iteration; `true` stops the solver.
fn report(
    limits: &Limits<'_>,
    exceeded: Arc<AtomicBool>,
) -> impl FnMut(&DefaultInfo<f64>) -> bool + Send + Sync + 'static {
    let (watch, label) = (limits.watch.clone(), limits.label.to_owned());
    let enough = limits.effort.enough;
    move |info| {
        // a feasible point of the dual problem bounds the least value from below
        const FEASIBLE: f64 = 1e-8;
        if enough.is_some_and(|enough| info.cost_dual > enough && info.res_dual < FEASIBLE) {
            exceeded.store(true, Ordering::Relaxed);
            return true;
        }
        // the gap falls from about one to 1e-9
        #[expect(clippy::cast_possible_truncation, reason = "a fraction")]
        let fraction = (-info.gap_rel.log10() / 9.0) as f32;
        let text = format!("{label}: iteration {}, gap {:.0e}", info.iterations, info.gap_rel);
        !watch.go_on(if fraction.is_finite() { fraction } else { 0.0 }, &text)
    }
}

fn answer(solver: &DefaultSolver<f64>) -> Answer {
    let solution = &solver.solution;
    let end = match solution.status {
        SolverStatus::Solved => End::Solved,
        SolverStatus::PrimalInfeasible => End::Infeasible,
        SolverStatus::DualInfeasible => End::Unbounded,
        SolverStatus::CallbackTerminated => End::Cancelled,
        SolverStatus::MaxTime => End::OutOfTime,
        SolverStatus::AlmostSolved => End::Doubtful("the solution is of reduced accuracy".to_owned()),
        SolverStatus::AlmostPrimalInfeasible => End::Doubtful("probably infeasible".to_owned()),
        SolverStatus::AlmostDualInfeasible => End::Doubtful("probably unbounded".to_owned()),
        SolverStatus::MaxIterations => End::Doubtful("too many iterations".to_owned()),
        SolverStatus::NumericalError | SolverStatus::InsufficientProgress | SolverStatus::Unsolved => {
            End::Doubtful("the solver makes no further progress".to_owned())
        }
    };
    let (value, dual) = (solution.obj_val, solution.obj_val_dual);
    Answer {
        end,
        x: solution.x.clone(),
        multipliers: solution.z.clone(),
        gap: (value - dual).abs() / value.abs().min(dual.abs()).max(1.0),
        iterations: solution.iterations,
        seconds: solution.solve_time,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// `min x` with `x >= 1` and `[x, 2; 2, x] >= 0`: the answer is 2.
    fn program() -> Program {
        Program {
            objective: vec![1.0],
            entries: vec![(0, 0, -1.0), (1, 0, -1.0), (3, 0, -1.0)],
            offsets: vec![-1.0, 0.0, 2.0 * std::f64::consts::SQRT_2, 0.0],
            cones: vec![Cone::Positive(1), Cone::Semidefinite(2)],
            ..Program::default()
        }
    }

    fn run(program: &Program, watch: &Watch, seconds: f64, enough: Option<f64>) -> Answer {
        solve(program, &Limits { seconds, watch, label: "test", effort: Effort { tolerance: 1e-9, enough } })
    }

    #[test]
    fn a_small_program_is_solved_with_its_multipliers() {
        let answer = run(&program(), &Watch::none(), 5.0, None);
        assert_eq!(answer.end, End::Solved, "{answer:?}");
        assert!((answer.x[0] - 2.0).abs() < 1e-8, "x = {}", answer.x[0]);
        // stationarity: 1 = z0 + tr Z; x >= 1 is idle
        assert!(answer.multipliers[0].abs() < 1e-7, "idle bound: {:?}", answer.multipliers);
        assert!(
            (answer.multipliers[1] + answer.multipliers[3] - 1.0).abs() < 1e-7,
            "{:?}",
            answer.multipliers
        );
    }

    #[test]
    fn ends_are_told_apart() {
        let stop = Watch::new(|_, text| !text.starts_with("test: iteration 1"));
        assert_eq!(run(&program(), &stop, 5.0, None).end, End::Cancelled, "the watch said stop");
        assert_eq!(run(&program(), &Watch::none(), 0.0, None).end, End::OutOfTime, "no time at all");
        assert_eq!(run(&program(), &Watch::none(), 5.0, Some(1.5)).end, End::Exceeded, "2 exceeds 1.5");
        assert_eq!(run(&program(), &Watch::none(), 5.0, Some(2.5)).end, End::Solved, "2 does not exceed 2.5");
        let mut unbounded = program();
        unbounded.objective = vec![-1.0];
        assert_eq!(run(&unbounded, &Watch::none(), 5.0, None).end, End::Unbounded, "x may grow");
        let mut infeasible = program();
        infeasible.entries[0].2 = 1.0;
        assert_eq!(run(&infeasible, &Watch::none(), 5.0, None).end, End::Infeasible, "x <= -1 and x >= 2");
    }

    #[test]
    fn a_mistaken_program_is_an_answer_not_a_panic() {
        let mut wrong = program();
        wrong.cones.pop();
        assert!(
            matches!(run(&wrong, &Watch::none(), 5.0, None).end, End::Doubtful(_)),
            "rows without a cone"
        );
    }
}
