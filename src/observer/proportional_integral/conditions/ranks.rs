//! Conditions on single ranks: (8), no feedthrough, (9), (11).

use super::{Ask, PAPER, condition};
use crate::numerics::{rank, side_by_side, stack};
use crate::observer::proportional_integral::{Alternative, Equivalent, choose_alternative};
use crate::observer::{Condition, Evidence, Verdict, Witness};
use crate::system::DescriptorSystem;
use crate::system::properties::{PropertyError, impulse_observability};

impl Ask<'_> {
    /// (8): one of three ranks, so that system (4) exists.
    // ERRATUM(004, section IV): "rank [E* N*; C* 0] = rank E*" in the example should read rank [E* N*] = rank E*.
    pub(super) fn condition_8(&self, needed: bool) -> Result<Condition, PropertyError> {
        let DescriptorSystem { E, C, D, .. } = self.system;
        let (e, n) = E.shape();
        let of_e = rank(E, 0.0, self.tolerance)?;
        let of_ed = rank(&side_by_side(&[E, D]), 0.0, self.tolerance)?;
        let of_ec = rank(&stack(&[E, C]), 0.0, self.tolerance)?;
        let r = of_e.rank;
        let chosen = choose_alternative(self.system, self.tolerance)?;
        let fragile = of_e.fragile
            || match chosen {
                Some(Alternative::FullRowRank) => false,
                Some(Alternative::UnknownInputInRange) => of_ed.fragile,
                Some(Alternative::FullColumnRank) => of_ec.fragile,
                None => of_ed.fragile || of_ec.fragile,
            };
        let numbers = format!(
            "rank [E* N*] = {}, rank E* = {r}, rank [E*; C*] = {} with e = {e}, n = {n}",
            of_ed.rank, of_ec.rank
        );
        let mut result = condition(
            "(8)",
            "equivalent system exists",
            "rank [E* N*] = rank E*  or  rank E* = e  or  rank [E*; C*] = n",
        );
        result.verdict = Verdict::of(chosen.is_some(), fragile);
        result.summary = match chosen {
            Some(Alternative::FullColumnRank) => format!(
                "{numbers}; used: {}, the weak alternative, so (13) decides on the T1 that results",
                Alternative::FullColumnRank.formula()
            ),
            Some(alternative) => format!("{numbers}; used: {}", alternative.formula()),
            None => {
                format!("{numbers}: none of the three holds, the unknown input enters an algebraic equation")
            }
        };
        if chosen.is_none() {
            result.remedies.push("choose the general form, which does not need (8)".to_owned());
        }
        result.evidence = vec![
            Evidence::rank("[E* N*]", of_ed, r),
            Evidence::rank("E*", of_e, e),
            Evidence::rank("[E*; C*]", of_ec, n),
        ];
        result.needed = needed;
        Ok(result)
    }

    /// The paper's outputs have no feedthrough of the unknown input.
    pub(super) fn no_feedthrough(&self, needed: bool) -> Condition {
        let largest = if self.system.F.is_empty() { 0.0 } else { self.system.F.amax() };
        let mut result = condition("(1)", "no feedthrough", "F = 0");
        result.source = format!("{PAPER}, equation (1): y* = C* x");
        result.verdict = Verdict::of(largest == 0.0, false);
        result.summary = if largest == 0.0 {
            "the unknown input does not act on the outputs".to_owned()
        } else {
            result.remedies.push("choose the general form, which takes a feedthrough".to_owned());
            format!("F has an entry of size {largest}, but system (1) has y* = C* x")
        };
        result.needed = needed;
        result
    }

    /// (9): impulse observability.
    pub(super) fn condition_9(&self) -> Result<Condition, PropertyError> {
        let found = impulse_observability(self.system, self.tolerance)?;
        let (n, r) = (self.system.n_states(), found.rank_e.rank);
        let mut result = condition("(9)", "impulse observability", "rank [E* A*; 0 E*; 0 C*] = n + rank E*");
        result.verdict = Verdict::of(found.holds(), found.fragile());
        let printed = found.printed.decision.rank;
        let equation = if printed == n + r {
            format!("{printed} = {n} + {r}")
        } else if found.holds() {
            format!(
                "the printed matrix has rank {printed} within its threshold, not {n} + {r}; the compressed one decides"
            )
        } else {
            format!("{printed} < {n} + {r}")
        };
        result.summary = format!(
            "{equation}; on the algebraic part: rank {} of {} needed, smallest singular value {:.3e}",
            found.compressed.decision.rank,
            found.compressed.needed,
            found.compressed.decision.smallest()
        );
        if let Some(direction) = &found.witness {
            result.witness = Some(Witness {
                s: None,
                direction: direction.iter().map(|x| (*x).into()).collect(),
                coordinates: self.coordinates(),
            });
        }
        if !found.holds() {
            result.remedies =
                self.sensors(|extended| Ok(impulse_observability(extended, self.tolerance)?.holds()))?;
        }
        result.evidence = vec![
            Evidence::rank(
                "[U2'A*V2; C*V2], on the null spaces of E*",
                found.compressed.decision,
                found.compressed.needed,
            ),
            Evidence::rank("[E* A*; 0 E*; 0 C*]", found.printed.decision, found.printed.needed),
        ];
        Ok(result)
    }

    /// (11): the left inverse `[T1 T2]` exists.
    pub(super) fn condition_11(&self, equivalent: &Equivalent) -> Result<Condition, PropertyError> {
        let n = self.system.n_states();
        let scale = self.system.E.norm().max(self.system.A.norm()).max(self.system.C.norm());
        let decision = rank(&stack(&[&equivalent.E, &equivalent.C]), scale, self.tolerance)?;
        let mut result = condition("(11)", "left inverse", "rank [E; C] = n");
        result.verdict = Verdict::of(decision.rank == n, decision.fragile);
        result.summary = format!("rank {} of {n} needed, in the equivalent system (4)", decision.rank);
        result.evidence = vec![Evidence::rank("[E; C]", decision, n)];
        Ok(result)
    }
}
