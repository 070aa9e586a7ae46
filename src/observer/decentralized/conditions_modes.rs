//! Conditions on modes: strong detectability of a subsystem and the fixed modes of the chosen order.

use super::Setup;
use super::conditions::Ask;
use crate::numerics::StabilityRegion;
use crate::observer::{Condition, DesignChoice, Evidence, PointEvidence, Verdict, show};
use crate::system::properties::ModeCondition;

/// Fills the verdict on strong detectability from its evidence.
pub(super) fn fill_detectability(
    ask: &Ask<'_>,
    result: &mut Condition,
    found: &ModeCondition,
    exact: &[usize],
) {
    let first = ask.problem.first_state;
    let states = (1..=ask.problem.n_states()).map(|i| format!("x{}", first + i));
    let couplings = exact.iter().map(|j| ask.problem.source_name(ask.problem.sources[*j]));
    let coordinates = states.chain(couplings).collect();
    result.decide_on_modes(found, "[sE_i-A_ii -D_i1; H_i 0]", coordinates, |modes| {
        if modes.is_empty() {
            return "no invariant zeros: every mode of the full order can be moved".to_owned();
        }
        let zeros: Vec<String> = modes.iter().map(|mode| show(mode.s)).collect();
        format!("invariant zeros {}, all stable: modes of every full-order observer", zeros.join(", "))
    });
}

/// The modes of the chosen order that no free gain moves, and the fastest decay that they allow.
///
/// They are the unobservable modes of `(Lambda_N, L_N)`. For `R = I` they are the invariant zeros; for other `R` the
/// paper's `T_bar` may add some that no strongly detectable subsystem has.
pub(super) fn fixed_modes(ask: &Ask<'_>, setup: &Setup, choice: &DesignChoice) -> Condition {
    let region = setup.region();
    let name = "fixed modes of the chosen order";
    let formula = match region {
        StabilityRegion::LeftHalfPlane => "rank [sI-Lambda_Ni; L_Ni] = beta_i  for all Re s >= 0",
        StabilityRegion::UnitDisk => "rank [zI-Lambda_Ni; L_Ni] = beta_i  for all |z| >= 1",
    };
    let mut result = ask.statement("fixed", "(27)", name, formula);
    let stable = setup.stabilisable(ask.tolerance);
    result.verdict = Verdict::of(stable, false);
    let shown: Vec<String> = setup.fixed_modes.iter().map(|mode| show(*mode)).collect();
    let (order, shown) = (setup.family.order(), shown.join(", "));
    result.summary = match setup.fastest_decay() {
        _ if order == 0 => "order 0: the estimate is static, there is no mode".to_owned(),
        None => format!("none of {order}: every decay rate can be reached if the gain may be large"),
        Some(limit) if stable => {
            let limit = show(limit.into());
            match region {
                StabilityRegion::LeftHalfPlane => format!("{shown}: decay rates below {limit} are possible"),
                StabilityRegion::UnitDisk => format!("{shown}: |z| above {limit} is possible"),
            }
        }
        Some(_) => format!("{shown}: not all of them are stable"),
    };
    let margin = region.margin(setup.family.Lambda_N.norm(), ask.tolerance);
    let points = setup.fixed_modes.iter().map(|&s| PointEvidence {
        s,
        multiplicity: 1,
        distance: 0.0,
        loses_rank: true,
        stable: region.contains(s, margin),
    });
    result.evidence.push(Evidence::Points { of: "(Lambda_Ni, L_Ni)".to_owned(), points: points.collect() });
    if !stable {
        if !choice.lmi.alternative {
            result.remedies.push("choose the extended parameterisation, which leaves T_bar free".to_owned());
        }
        result.remedies.push("choose the full order: its fixed modes are the invariant zeros".to_owned());
    }
    result
}
