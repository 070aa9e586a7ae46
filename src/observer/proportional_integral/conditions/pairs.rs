//! Conditions on the pair whose poles are placed: (13) of the full, (22) and (23) of the reduced order.
#![expect(non_snake_case, reason = "matrix letters follow Koenig and Mammar 2002")]

use nalgebra::DMatrix;

use super::{Ask, condition, undecided};
use crate::numerics::{PbhMode, StabilityRegion, pbh_modes};
use crate::observer::proportional_integral::{Equivalent, full_order, hold, reduced_order};
use crate::observer::{Condition, Evidence, PointEvidence, Verdict, Witness};
use crate::system::TimeDomain;
use crate::system::properties::PropertyError;

/// What (13) is called.
pub(super) const NAME_13: &str = "detectability of the design pair";
/// What (23) is called.
const NAME_23: &str = "detectability of the reduced pair";

impl Ask<'_> {
    fn discrete(&self) -> bool {
        self.system.time == TimeDomain::Discrete
    }

    /// (13): every mode that the full-order observer cannot move is stable.
    // ERRATUM(004, appendix): the proof needs T1 of full column rank, which alternative 3 of (8) does not give; hence
    // (13) is asked of the T1 that is used.
    pub(super) fn condition_13(&self, equivalent: &Equivalent) -> Result<Condition, PropertyError> {
        let (A, C) = full_order::pair(equivalent, hold(self.system.time), self.tolerance)?;
        let mut result = condition(
            "(13)",
            NAME_13,
            if self.discrete() {
                "rank [zI-T1A -T1N; 0 (z-1)I; C 0] = n + nf for all |z| >= 1"
            } else {
                "rank [sI-T1A -T1N; 0 sI; C 0] = n + nf for all Re s >= 0"
            },
        );
        let of = if self.discrete() { "([T1A T1N; 0 I], [C 0])" } else { "([T1A T1N; 0 0], [C 0])" };
        self.fill_pair(&mut result, &A, &C, of)?;
        Ok(result)
    }

    /// (22) and (23): the reduced pair exists and is detectable.
    // ERRATUM(004, eqs. 22, 23): s I_n is s I_r; the pencil has r + nf columns.
    pub(super) fn conditions_22_23(&self, equivalent: &Equivalent) -> Result<Vec<Condition>, PropertyError> {
        let reduction = reduced_order::reduce(equivalent, self.tolerance)?;
        let needed = reduction.P1.ncols();
        let mut first = condition("(22)", "unmeasured part is determined", "rank C2 = n - r");
        let decision = reduction.C2_rank.clone();
        first.verdict = Verdict::of(decision.rank == needed, decision.fragile);
        first.summary = format!("rank {} of {needed} needed", decision.rank);
        first.evidence = vec![Evidence::rank("C2 = C P1", decision, needed)];
        if !first.verdict.holds() {
            let why = "its matrices are built on the left inverse of C2, which (22) does not give";
            return Ok(vec![first, undecided("(23)", NAME_23, why)]);
        }
        let (A, C) = reduced_order::pair(equivalent, &reduction, hold(self.system.time));
        let mut second = condition(
            "(23)",
            NAME_23,
            if self.discrete() {
                "rank [zI-Ar -N; 0 (z-1)I; P3C1 0] = r + nf for all |z| >= 1"
            } else {
                "rank [sI-Ar -N; 0 sI; P3C1 0] = r + nf for all Re s >= 0"
            },
        );
        let of = if self.discrete() { "([Ar N; 0 I], [P3C1 0])" } else { "([Ar N; 0 0], [P3C1 0])" };
        self.fill_pair(&mut second, &A, &C, of)?;
        Ok(vec![first, second])
    }

    fn fill_pair(
        &self,
        result: &mut Condition,
        A: &DMatrix<f64>,
        C: &DMatrix<f64>,
        of: &str,
    ) -> Result<(), PropertyError> {
        let modes = pbh_modes(A, C, self.tolerance)?;
        let region = StabilityRegion::of(self.discrete());
        let margin = region.margin(A.norm().max(1.0), self.tolerance);
        let bad: Vec<&PbhMode> =
            modes.iter().filter(|m| m.unobservable && !region.contains(m.value, margin)).collect();
        let hidden = modes.iter().filter(|m| m.unobservable).count();
        let near = |m: &PbhMode| {
            let ratio = m.distance / self.tolerance.mode;
            ratio > 1.0 && ratio < self.tolerance.gap && !region.contains(m.value, margin)
        };
        result.verdict = Verdict::of(bad.is_empty(), modes.iter().any(near));
        result.summary = match (bad.first(), hidden) {
            (Some(mode), _) => {
                format!("the mode {} is not observable and not stable", crate::observer::show(mode.value))
            }
            (None, 0) => {
                let closest = modes.iter().map(|m| m.distance).fold(f64::INFINITY, f64::min);
                format!(
                    "all {} modes are observable: every pole can be placed (closest distance {closest:.2e})",
                    A.nrows()
                )
            }
            (None, hidden) => format!("{hidden} fixed modes, all stable"),
        };
        let points = modes.iter().map(|m| PointEvidence {
            s: m.value,
            multiplicity: m.multiplicity,
            distance: m.distance,
            loses_rank: m.unobservable,
            stable: region.contains(m.value, margin),
        });
        result.evidence.push(Evidence::Points { of: of.to_owned(), points: points.collect() });
        result.witness = bad.first().map(|mode| Witness {
            s: Some(mode.value),
            direction: mode.direction.clone(),
            coordinates: (1..=A.nrows()).map(|i| format!("z{i}")).collect(),
        });
        Ok(())
    }
}
