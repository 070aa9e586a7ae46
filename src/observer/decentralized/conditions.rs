//! Existence conditions of decentralized observers, subsystem by subsystem, with their evidence.
#![expect(non_snake_case, reason = "matrix letters follow paper 000")]

use super::columns::{assumption_1, greedy, strong_detectability};
use super::conditions_modes::{fill_detectability, fixed_modes};
use super::decoupled::scaled_to;
use super::setup::{SetupError, check_counts, exact_columns};
use super::{Decoupled, LocalProblem, Setup, local_problems};
use crate::numerics::{Tolerance, rank, stack};
use crate::observer::{Condition, DesignChoice, Evidence, Verdict};
use crate::system::Model;
use crate::system::properties::PropertyError;

pub(super) const PAPER: &str = "Paper 000";

/// Existence conditions of the decentralized observers: first the partition, then those of each subsystem.
///
/// # Errors
/// When a decomposition fails its check.
///
/// # Source
/// Paper 000, section III, Assumption 1, Lemma 1; strong detectability and fixed modes decide what its Proposition 1 i)
/// takes for granted.
pub fn conditions(
    model: &Model,
    choice: &DesignChoice,
    tolerance: &Tolerance,
) -> Result<Vec<Condition>, PropertyError> {
    let mut partition =
        condition("partition", "(5), (6)", "partition", "E = blkdiag E_i,  H = blkdiag H_i,  A = [A_ij]");
    let cut = local_problems(model).map_err(|error| error.to_string());
    let counted = cut.and_then(|problems| match check_counts(choice, problems.len()) {
        Ok(()) => Ok(problems),
        Err(error) => Err(error.to_string()),
    });
    let problems = match counted {
        Ok(problems) => problems,
        Err(why) => {
            partition.verdict = Verdict::Fails;
            partition.summary = why;
            return Ok(vec![partition]);
        }
    };
    partition.verdict = Verdict::Holds;
    partition.summary = format!("{} subsystems; E and C are block diagonal", problems.len());
    let mut result = vec![partition];
    for (number, problem) in problems.iter().enumerate() {
        result.extend(local_conditions(problem, number, choice, tolerance)?);
    }
    Ok(result)
}

/// The conditions of one subsystem.
///
/// # Errors
/// When a decomposition fails its check.
pub fn local_conditions(
    problem: &LocalProblem,
    number: usize,
    choice: &DesignChoice,
    tolerance: &Tolerance,
) -> Result<Vec<Condition>, PropertyError> {
    let ask = Ask { problem, number, tolerance };
    let exact = match exact_columns(problem, number, choice, tolerance) {
        Ok(exact) => exact,
        Err(SetupError::Property(error)) => return Err(error),
        Err(error) => {
            let mut refused = ask.assumption_1_statement();
            refused.verdict = Verdict::Fails;
            refused.summary = error.to_string();
            return Ok(vec![refused]);
        }
    };
    let mut result = vec![ask.assumption_1(&exact)?];
    result.push(ask.lemma_1(&exact)?);
    result.push(ask.detectability(&exact)?);
    let exists = result.iter().all(|condition| condition.verdict.holds());
    if !exists {
        return Ok(result);
    }
    match Setup::new(problem, number, choice, tolerance) {
        Ok(setup) => {
            if choice.lmi.rows.get(number).is_some() {
                result.push(ask.completion(&setup)?);
            }
            result.push(fixed_modes(&ask, &setup, choice));
        }
        Err(SetupError::Property(error)) => return Err(error),
        Err(error) => {
            let mut refused = ask.completion_statement();
            refused.verdict = Verdict::Fails;
            refused.summary = error.to_string();
            refused.remedies.push("leave R to the program, or take R = I (full order)".to_owned());
            result.push(refused);
        }
    }
    Ok(result)
}

fn condition(id: &str, label: &str, name: &str, formula: &str) -> Condition {
    Condition::asked((format!("000-{id}"), label), name, formula, format!("{PAPER}, {label}"))
}

/// The subsystem that all conditions ask about.
pub(super) struct Ask<'a> {
    pub(super) problem: &'a LocalProblem,
    pub(super) number: usize,
    pub(super) tolerance: &'a Tolerance,
}

impl Ask<'_> {
    /// A condition on this subsystem: its name carries the subsystem's.
    pub(super) fn statement(&self, id: &str, label: &str, name: &str, formula: &str) -> Condition {
        let name = format!("{name} ({})", self.problem.name);
        condition(&format!("{id}-{}", self.number + 1), label, &name, formula)
    }

    fn assumption_1_statement(&self) -> Condition {
        self.statement(
            "A1",
            "Assumption 1",
            "unknown couplings can be decoupled",
            "rank [E_i D_i1; Phi_i A_ii 0; H_i 0] = n_i + rank D_i1",
        )
    }

    fn assumption_1(&self, exact: &[usize]) -> Result<Condition, PropertyError> {
        let found = assumption_1(self.problem, exact, self.tolerance)?;
        let mut result = self.assumption_1_statement();
        result.verdict = Verdict::of(found.holds(), found.fragile());
        let names: Vec<String> =
            exact.iter().map(|j| self.problem.source_name(self.problem.sources[*j])).collect();
        let decoupled = if names.is_empty() { "nothing".to_owned() } else { names.join(", ") };
        let (rank, columns) = (found.of_columns.rank, found.of_columns.columns);
        result.summary = if rank < columns {
            format!("decoupled exactly: {decoupled}; but their {columns} columns D_i1 have rank {rank}")
        } else {
            let sign = if found.holds() { "=" } else { "<" };
            format!(
                "decoupled exactly: {decoupled}; rank {} {sign} {} + {rank}, smallest singular value {:.3e}",
                found.decision.rank,
                self.problem.n_states(),
                found.decision.smallest()
            )
        };
        if !found.holds() {
            result.remedies = self.fewer_columns(exact)?;
            let sensors =
                self.sensors(|problem| Ok(assumption_1(problem, exact, self.tolerance)?.holds()))?;
            result.remedies.extend(sensors);
        }
        result.evidence = vec![
            Evidence::rank("D_i1, columns scaled to norm 1", found.of_columns, columns),
            Evidence::rank(
                "[E_i D_i1; Phi_i A_ii 0; H_i 0], blocks scaled to norm 1",
                found.decision,
                found.needed,
            ),
        ];
        Ok(result)
    }

    /// What the conditions allow to decouple.
    fn fewer_columns(&self, exact: &[usize]) -> Result<Vec<String>, PropertyError> {
        let allowed = greedy(self.problem, self.tolerance)?;
        if exact.is_empty() || allowed == exact {
            return Ok(Vec::new());
        }
        let names: Vec<String> =
            allowed.iter().map(|j| self.problem.source_name(self.problem.sources[*j])).collect();
        Ok(vec![if names.is_empty() {
            "decouple nothing exactly: attenuate all couplings".to_owned()
        } else {
            format!("decouple only {} exactly and attenuate the others", names.join(", "))
        }])
    }

    fn lemma_1(&self, exact: &[usize]) -> Result<Condition, PropertyError> {
        let Decoupled { E_bar, Phi_A, H, .. } = Decoupled::new(self.problem, exact, self.tolerance)?;
        let LocalProblem { E, A, .. } = self.problem;
        let Theta = stack(&[&scaled_to(&E_bar, E), &scaled_to(&Phi_A, A), &scaled_to(&H, &H)]);
        let decision = rank(&Theta, 0.0, self.tolerance)?;
        let n = self.problem.n_states();
        let mut result = self.statement(
            "L1",
            "Lemma 1",
            "the state is determined by what is decoupled",
            "rank [(I-D_i1*D_i1+)E_i; Phi_i*A_ii; H_i] = n_i",
        );
        result.verdict = Verdict::of(decision.rank == n, decision.fragile);
        result.summary = format!(
            "rank {} of {n} needed, smallest singular value {:.3e}; equivalent to Assumption 1",
            decision.rank,
            decision.smallest()
        );
        result.evidence = vec![Evidence::rank("Theta_i, blocks scaled to norm 1", decision, n)];
        Ok(result)
    }

    fn detectability(&self, exact: &[usize]) -> Result<Condition, PropertyError> {
        let found = strong_detectability(self.problem, exact, self.tolerance)?;
        let region = if self.problem.is_discrete() { "|z| >= 1" } else { "Re s >= 0" };
        let mut result = self.statement(
            "detectable",
            "Prop. 1 i)",
            "strong detectability",
            &format!("rank [sE_i-A_ii -D_i1; H_i 0] = n_i + rank D_i1  for all {region}"),
        );
        fill_detectability(self, &mut result, &found, exact);
        if !found.holds() {
            result.remedies = self.fewer_columns(exact)?;
            let sensors =
                self.sensors(|problem| Ok(strong_detectability(problem, exact, self.tolerance)?.holds()))?;
            result.remedies.extend(sensors);
        }
        Ok(result)
    }

    fn completion_statement(&self) -> Condition {
        self.statement(
            "R",
            "(24)",
            "R completes what is known",
            "rank [R_i; Phi_i*A_ii; H_i] = n_i,  R_i of full row rank",
        )
    }

    fn completion(&self, setup: &Setup) -> Result<Condition, PropertyError> {
        let n = self.problem.n_states();
        let decision = super::order::completion(&setup.family.R, &setup.decoupled, self.tolerance)?;
        let mut result = self.completion_statement();
        result.verdict = Verdict::of(decision.rank == n, decision.fragile);
        result.summary = format!("rank {} of {n} needed; order {}", decision.rank, setup.family.order());
        result.evidence =
            vec![Evidence::rank("[R_i; Phi_i A_ii; H_i], blocks scaled to norm 1", decision, n)];
        Ok(result)
    }

    /// States of the subsystem whose measurement alone would make a condition hold, as sentences.
    fn sensors(
        &self,
        holds: impl Fn(&LocalProblem) -> Result<bool, PropertyError>,
    ) -> Result<Vec<String>, PropertyError> {
        const LARGEST: usize = 16;
        let n = self.problem.n_states();
        if n > LARGEST {
            return Ok(Vec::new());
        }
        let mut remedies = Vec::new();
        for i in 0..n {
            let mut row = nalgebra::DMatrix::zeros(1, n);
            row[(0, i)] = 1.0;
            let H = stack(&[&self.problem.H, &row]);
            if holds(&LocalProblem { H, ..self.problem.clone() })? {
                remedies.push(format!("measure x{}", self.problem.first_state + i + 1));
            }
        }
        Ok(remedies)
    }
}
