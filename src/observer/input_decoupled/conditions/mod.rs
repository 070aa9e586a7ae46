//! Existence conditions (A1), (A2), (A3) of paper 001, with their evidence.

mod ranks;
mod zeros;

use super::{Coordinates, coordinates};
use crate::numerics::{RankDecision, Tolerance, rank, stack};
use crate::observer::proportional_integral::advise_units;
use crate::observer::{Condition, DesignChoice, Order};
use crate::system::properties::PropertyError;
use crate::system::{DescriptorSystem, Model};

const PAPER: &str = "Paper 001";

/// Existence conditions of the input-decoupled observer; (A1) is not needed by [`Order::General`].
///
/// The ranks are decided on the algebraic part, with the ranks as the paper prints them beside; (A3), a statement for
/// all s, on the modes of the pair whose poles are placed. No s is ever sampled.
///
/// # Errors
/// When the matrices do not fit together or a decomposition fails its check.
///
/// # Source
/// Paper 001, (A1)-(A3), Lemmas 1 and 2.
pub fn conditions(
    model: &Model,
    choice: &DesignChoice,
    tolerance: &Tolerance,
) -> Result<Vec<Condition>, PropertyError> {
    let system = model.system.clone().checked()?;
    let ask = Ask::new(&system, tolerance)?;
    let paper_form = choice.order != Order::General;
    let second = ask.condition_a2()?;
    let first_holds = ask.algebraic_rank()?.rank == ask.n_algebraic();
    let third = ask.condition_a3(paper_form && first_holds, second.verdict.holds())?;
    let general_exists = second.verdict.holds() && third.verdict.holds();
    let first = ask.condition_a1(paper_form, general_exists)?;
    let mut result = vec![first, second, third];
    advise_units(&system, &mut result);
    Ok(result)
}

/// The system, its coordinates and the thresholds that all conditions ask about.
struct Ask<'a> {
    system: &'a DescriptorSystem,
    at: Coordinates,
    tolerance: &'a Tolerance,
}

impl<'a> Ask<'a> {
    fn new(system: &'a DescriptorSystem, tolerance: &'a Tolerance) -> Result<Self, PropertyError> {
        Ok(Self { system, at: coordinates(system, tolerance)?, tolerance })
    }

    /// Number of algebraic equations, e - r.
    fn n_algebraic(&self) -> usize {
        self.at.M2.nrows()
    }

    /// Number of algebraic states and unknown inputs, n - r + q.
    fn n_unknown(&self) -> usize {
        self.at.N2.ncols() + self.system.n_unknown_inputs()
    }

    /// `rank [A4 D2]`, judged against the norm of the data.
    fn algebraic_rank(&self) -> Result<RankDecision, PropertyError> {
        Ok(rank(&self.at.algebraic(), self.at.scale, self.tolerance)?)
    }

    /// `rank [A4 D2; C2 F]`, judged against the norm of the data.
    fn joint_rank(&self) -> Result<RankDecision, PropertyError> {
        let joint = stack(&[&self.at.algebraic(), &self.at.measured()]);
        Ok(rank(&joint, self.at.scale, self.tolerance)?)
    }

    /// Names `x1 ...` of the states, then `d1 ...` of the unknown inputs.
    fn coordinate_names(&self) -> Vec<String> {
        let states = (1..=self.system.n_states()).map(|i| format!("x{i}"));
        states.chain((1..=self.system.n_unknown_inputs()).map(|i| format!("d{i}"))).collect()
    }
}

fn condition(label: &str, name: &str, formula: &str) -> Condition {
    Condition::asked(
        (format!("001-{}", label.trim_matches(['(', ')'])), label),
        name,
        formula,
        format!("{PAPER}, {label}"),
    )
}
