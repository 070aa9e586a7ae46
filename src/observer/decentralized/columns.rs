//! Which couplings are decoupled exactly (`D_i1`) and which are attenuated (`D_i2`).
#![expect(non_snake_case, reason = "matrix letters follow paper 000")]

use nalgebra::DMatrix;

use super::LocalProblem;
use super::decoupled::{Decoupled, scaled_to, unit_columns};
use crate::numerics::Block::{Of, Zero};
use crate::numerics::{RankDecision, Tolerance, block_matrix, rank, side_by_side};
use crate::system::DescriptorSystem;
use crate::system::properties::{ModeCondition, PropertyError, r_detectability};

/// A choice that cannot be made.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error(
    "subsystem {subsystem} cannot decouple {source_name}: {why}; its couplings are {}",
    if couplings.is_empty() { "none" } else { couplings }
)]
pub struct ColumnError {
    /// The subsystem.
    pub subsystem: String,
    /// The state that was named.
    pub source_name: String,
    /// Why not.
    pub why: &'static str,
    /// What could be named, as text.
    pub couplings: String,
}

/// The positions in [`LocalProblem::sources`] of the states that a person wants decoupled.
///
/// States that do not act on the subsystem are decoupled by themselves and left out.
///
/// # Errors
/// A state of the subsystem itself, or a number beyond the plant's.
pub fn by_hand(problem: &LocalProblem, wished: &[usize]) -> Result<Vec<usize>, ColumnError> {
    let own = problem.first_state..problem.first_state + problem.n_states();
    let refuse = |source: usize, why| {
        let couplings: Vec<String> = problem.sources.iter().map(|s| problem.source_name(*s)).collect();
        ColumnError {
            subsystem: problem.name.clone(),
            source_name: problem.source_name(source),
            why,
            couplings: couplings.join(", "),
        }
    };
    for &source in wished {
        if own.contains(&source) {
            return Err(refuse(source, "that is one of its own states"));
        }
        if source >= problem.states_of_plant && !problem.sources.contains(&source) {
            return Err(refuse(source, "the plant has no such state"));
        }
    }
    Ok((0..problem.sources.len()).filter(|j| wished.contains(&problem.sources[*j])).collect())
}

/// Decouples as many columns as possible, one after the other in the order of the plant's states.
///
/// A column is taken when, with it, `D_i1` keeps full column rank, Assumption 1 holds, and the subsystem stays strongly
/// detectable (the last only if it is so without any column).
///
/// # Errors
/// When a decomposition fails its check.
///
/// # Source
/// Paper 000, Remark 1.
// ERRATUM(000, Remark 1): "the full rank column part of D_i" may violate Assumption 1; which columns are decoupled is a
// choice of the design.
pub fn greedy(problem: &LocalProblem, tolerance: &Tolerance) -> Result<Vec<usize>, PropertyError> {
    let mut chosen = Vec::new();
    let detectable = strong_detectability(problem, &chosen, tolerance)?.holds();
    for candidate in 0..problem.sources.len() {
        chosen.push(candidate);
        let keep = assumption_1(problem, &chosen, tolerance)?.holds()
            && (!detectable || strong_detectability(problem, &chosen, tolerance)?.holds());
        if !keep {
            chosen.pop();
        }
    }
    Ok(chosen)
}

/// The ranks of Assumption 1.
#[derive(Clone, Debug, PartialEq)]
pub struct Assumption1 {
    /// Rank of `D_i1`, which must be its number of columns.
    pub of_columns: RankDecision,
    /// Rank of `[E D1; Phi A 0; H 0]`.
    pub decision: RankDecision,
    /// `n + rank D1`.
    pub needed: usize,
}

impl Assumption1 {
    /// Both ranks are as needed.
    pub fn holds(&self) -> bool {
        self.of_columns.rank == self.of_columns.columns && self.decision.rank == self.needed
    }

    /// One of the decisions could tip.
    pub fn fragile(&self) -> bool {
        self.of_columns.fragile || self.decision.fragile
    }
}

/// Asks Assumption 1 for a choice of columns.
///
/// ```text
/// D1 of full column rank,   rank [E D1; Phi A 0; H 0] = n + rank D1
/// ```
///
/// # Tolerance
/// `E`, `A`, `H` and each column of `D1` are scaled to norm one first, which changes no rank: couplings may be smaller
/// than `E` by any factor.
///
/// # Errors
/// When a decomposition fails its check.
///
/// # Source
/// Paper 000, Assumption 1.
pub fn assumption_1(
    problem: &LocalProblem,
    chosen: &[usize],
    tolerance: &Tolerance,
) -> Result<Assumption1, PropertyError> {
    let D1 = unit_columns(&problem.D.select_columns(chosen), 1.0);
    let of_columns = rank(&D1, 0.0, tolerance)?;
    let Decoupled { Phi_A, .. } = Decoupled::new(problem, chosen, tolerance)?;
    let LocalProblem { E, A, H, .. } = problem;
    let matrix = block_matrix(&[
        &[Of(&scaled_to(E, E)), Of(&D1)],
        &[Of(&scaled_to(&Phi_A, A)), Zero],
        &[Of(&scaled_to(H, H)), Zero],
    ]);
    let decision = rank(&matrix, 0.0, tolerance)?;
    let needed = problem.n_states() + of_columns.rank;
    Ok(Assumption1 { of_columns, decision, needed })
}

/// Decides strong detectability for a choice of columns.
///
/// ```text
/// rank [sE-A -D1; H 0] = n + rank D1   for all Re s >= 0   (discrete: all |s| >= 1)
/// ```
///
/// Every observer that decouples `D1` exactly needs it; for the full order it is sufficient together with Assumption 1.
///
/// # Errors
/// When a decomposition fails its check.
///
/// # Source
/// Stability of `N_i` in paper 000, Proposition 1 i), which its existence conditions leave out.
// ERRATUM(000, Proposition 1): "existence" needs strong detectability besides Assumption 1.
pub fn strong_detectability(
    problem: &LocalProblem,
    chosen: &[usize],
    tolerance: &Tolerance,
) -> Result<ModeCondition, PropertyError> {
    let LocalProblem { time, E, A, H, D, .. } = problem;
    let q1 = chosen.len();
    let size = if A.norm() > 0.0 { A.norm() } else { 1.0 };
    let D1 = unit_columns(&D.select_columns(chosen), size);
    let zeros = |rows| DMatrix::zeros(rows, q1);
    // s [E 0] - [A D1] on the joint state (x, v1), seen by [H 0]
    let joint = DescriptorSystem {
        time: *time,
        E: side_by_side(&[E, &zeros(E.nrows())]),
        A: side_by_side(&[A, &D1]),
        B: DMatrix::zeros(E.nrows(), 0),
        C: side_by_side(&[H, &zeros(H.nrows())]),
        D: DMatrix::zeros(E.nrows(), 0),
        F: DMatrix::zeros(H.nrows(), 0),
    };
    r_detectability(&joint, tolerance)
}
