//! Conditions on a single rank: `rank E`, `rank [E; C] = n`, impulse observability.

use nalgebra::DMatrix;
use serde::{Deserialize, Serialize};

use super::{PropertyError, check};
use crate::numerics::Block::{Of, Zero};
use crate::numerics::{RankDecision, Tolerance, block_matrix, normalised, rank, stack, subspaces};
use crate::system::DescriptorSystem;

/// A matrix that must have a certain rank.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct RankCondition {
    /// The rank that was found.
    pub decision: RankDecision,
    /// The rank that is needed.
    pub needed: usize,
}

impl RankCondition {
    /// The rank is the needed one.
    pub fn holds(&self) -> bool {
        self.decision.rank == self.needed
    }

    /// The decision could tip under a small change of the data.
    pub fn fragile(&self) -> bool {
        self.decision.fragile
    }
}

/// Whether the outputs show every impulse.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ImpulseObservability {
    /// Rank r of `E`, which splits the coordinates.
    pub rank_e: RankDecision,
    /// `rank [U2' A V2; C V2] = n - r`, the condition that decides.
    pub compressed: RankCondition,
    /// `rank [E A; 0 E; 0 C] = n + r`, the same condition as it is printed.
    pub printed: RankCondition,
    /// When it fails: a state in `ker E` that neither the algebraic equations nor the outputs show, `E w = 0`,
    /// `C w = 0`, `A w` in the range of `E`; its largest entry is one.
    pub witness: Option<Vec<f64>>,
}

impl ImpulseObservability {
    /// The system is impulse observable.
    pub fn holds(&self) -> bool {
        self.compressed.holds()
    }

    /// One of the decisions could tip, or the two forms of the condition disagree.
    pub fn fragile(&self) -> bool {
        self.rank_e.fragile || self.compressed.fragile() || self.printed.holds() != self.holds()
    }
}

/// Rank of `E`: the number of states that carry an initial value.
///
/// # Errors
/// [`PropertyError`] when the matrices do not fit or a decomposition fails.
pub fn rank_e(system: &DescriptorSystem, tolerance: &Tolerance) -> Result<RankDecision, PropertyError> {
    check(system)?;
    Ok(rank(&system.E, 0.0, tolerance)?)
}

/// Decides `rank [E; C] = n`: the outputs and `E x` together determine the state.
///
/// # Errors
/// As [`rank_e`].
pub fn rank_e_c(system: &DescriptorSystem, tolerance: &Tolerance) -> Result<RankCondition, PropertyError> {
    check(system)?;
    let decision = rank(&stack(&[&system.E, &system.C]), 0.0, tolerance)?;
    Ok(RankCondition { decision, needed: system.n_states() })
}

/// Decides whether the system is impulse observable.
///
/// ```text
/// rank [E A; 0 E; 0 C] = n + rank E    <=>    rank [U2' A V2; C V2] = n - rank E
/// U2 = left null space of E,  V2 = null space of E
/// ```
///
/// # Tolerance
/// Decided on the compressed matrix, whose threshold is relative to `norm [A; C]`: rounding noise of the compression
/// must not count as rank. The printed matrix is reported beside it; disagreement makes the decision fragile.
///
/// # Errors
/// As [`rank_e`].
///
/// # Source
/// Paper 004, equation (9) and Definition 3.
///
/// # Examples
/// ```
/// use descry::numerics::Tolerance;
/// use descry::system::{DescriptorSystem, properties::impulse_observability};
/// use nalgebra::dmatrix;
/// // x2' = x1, 0 = x2: differentiates, so x1 can hold an impulse that y = x2 does not show
/// let (e, a) = (dmatrix![0.0, 1.0; 0.0, 0.0], dmatrix![1.0, 0.0; 0.0, 1.0]);
/// let system = DescriptorSystem::autonomous(e, a, dmatrix![0.0, 1.0])?;
/// let found = impulse_observability(&system, &Tolerance::default())?;
/// assert!(!found.holds());
/// assert_eq!(found.witness, Some(vec![1.0, 0.0]));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn impulse_observability(
    system: &DescriptorSystem,
    tolerance: &Tolerance,
) -> Result<ImpulseObservability, PropertyError> {
    check(system)?;
    let DescriptorSystem { E: e, A: a, C: c, .. } = system;
    let n = system.n_states();

    let of_e = subspaces(e, 0.0, tolerance)?;
    let (r, v2) = (of_e.rank.rank, &of_e.null);

    // [U2' A V2; C V2]
    let reduced = stack(&[&(of_e.left_null.tr_mul(a) * v2), &(c * v2)]);
    let found = subspaces(&reduced, normalised(&stack(&[a, c])).1, tolerance)?;
    let witness = (found.null.ncols() > 0).then(|| witness(&(v2 * &found.null)));

    // [E A; 0 E; 0 C]
    let printed = rank(&block_matrix(&[&[Of(e), Of(a)], &[Zero, Of(e)], &[Zero, Of(c)]]), 0.0, tolerance)?;

    Ok(ImpulseObservability {
        rank_e: of_e.rank,
        compressed: RankCondition { decision: found.rank, needed: n - r },
        printed: RankCondition { decision: printed, needed: n + r },
        witness,
    })
}

/// The last column, which belongs to the smallest singular value, with one as its largest entry.
fn witness(directions: &DMatrix<f64>) -> Vec<f64> {
    let last = directions.column(directions.ncols() - 1);
    let largest = last[last.icamax()];
    last.iter().map(|x| x / largest).collect()
}

#[cfg(test)]
mod tests {
    use super::super::autonomous;
    use super::*;
    use nalgebra::dmatrix;

    fn differentiator(c: DMatrix<f64>) -> DescriptorSystem {
        autonomous(dmatrix![0.0, 1.0; 0.0, 0.0], dmatrix![1.0, 0.0; 0.0, 1.0], c)
    }

    fn decide(system: &DescriptorSystem) -> ImpulseObservability {
        impulse_observability(system, &Tolerance::default()).unwrap()
    }

    #[test]
    fn an_output_that_sees_the_impulse_is_enough() {
        let found = decide(&differentiator(dmatrix![1.0, 0.0]));
        assert!(found.holds() && !found.fragile() && found.witness.is_none(), "y = x1 shows it: {found:?}");
    }

    #[test]
    fn without_outputs_impulses_stay_hidden() {
        let found = decide(&differentiator(DMatrix::zeros(0, 2)));
        assert!(!found.holds() && !found.fragile(), "nothing is measured: {found:?}");
        assert_eq!((found.printed.decision.rank, found.printed.needed), (2, 3), "the printed matrix agrees");
    }

    #[test]
    fn an_output_gain_near_the_threshold_is_fragile() {
        let found = decide(&differentiator(dmatrix![1e-13, 1.0]));
        assert!(found.fragile(), "1e-13 is neither data nor noise: {found:?}");
        let found = decide(&differentiator(dmatrix![1e-8, 1.0]));
        assert!(found.holds() && !found.fragile(), "1e-8 is data: {found:?}");
        let found = decide(&differentiator(dmatrix![1e-19, 1.0]));
        assert!(!found.holds() && !found.fragile(), "1e-19 is noise: {found:?}");
    }

    #[test]
    fn a_rectangular_system_is_decided_too() {
        let found = decide(&autonomous(dmatrix![1.0, 0.0], dmatrix![0.0, 1.0], dmatrix![0.0, 1.0]));
        assert!(found.holds() && found.printed.holds(), "the free state is measured: {found:?}");
        let found = decide(&autonomous(dmatrix![1.0, 0.0], dmatrix![0.0, 1.0], dmatrix![1.0, 0.0]));
        assert_eq!(found.witness, Some(vec![0.0, 1.0]), "the free state is not measured");
    }

    #[test]
    fn nonsingular_e_has_no_impulses() {
        let found = decide(&autonomous(DMatrix::identity(2, 2), DMatrix::zeros(2, 2), DMatrix::zeros(0, 2)));
        assert!(found.holds(), "an empty condition: {found:?}");
    }

    #[test]
    fn rank_e_c_fails_without_the_second_output() {
        let system = differentiator(dmatrix![1.0, 0.0]);
        assert!(rank_e_c(&system, &Tolerance::default()).unwrap().holds(), "E sees x2, C sees x1");
        let system = differentiator(dmatrix![0.0, 1.0]);
        let found = rank_e_c(&system, &Tolerance::default()).unwrap();
        assert_eq!((found.decision.rank, found.needed), (1, 2), "nobody sees x1");
        assert_eq!(rank_e(&system, &Tolerance::default()).unwrap().rank, 1);
    }
}
