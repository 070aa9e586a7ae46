//! Conditions on single ranks: (A1) and (A2).

use nalgebra::{DMatrix, DVector};

use super::{Ask, condition};
use crate::numerics::Block::{Of, Zero};
use crate::numerics::{Complex64, RankDecision, block_matrix, rank, stack, subspaces};
use crate::observer::proportional_integral::single_sensors;
use crate::observer::{Condition, Evidence, Verdict, Witness};
use crate::system::DescriptorSystem;
use crate::system::properties::PropertyError;

impl Ask<'_> {
    /// (A1): no combination of the algebraic equations is free of algebraic states and unknown inputs.
    pub(super) fn condition_a1(
        &self,
        needed: bool,
        general_exists: bool,
    ) -> Result<Condition, PropertyError> {
        let DescriptorSystem { E, A, D, .. } = self.system;
        let (e, n) = E.shape();
        let (r, q) = (self.at.r(), self.system.n_unknown_inputs());
        let decision = self.algebraic_rank()?;
        let printed =
            rank(&block_matrix(&[&[Zero, Of(E), Zero], &[Of(E), Of(A), Of(D)]]), 0.0, self.tolerance)?;
        let required = self.n_algebraic();
        let mut result = condition("(A1)", "impulse controllability", "rank [0 E 0; E A D] = m + r");
        self.fill(&mut result, &decision, &printed, (required, e + r));
        if !result.verdict.holds() {
            let left = subspaces(&self.at.algebraic(), self.at.scale, self.tolerance)?.left_null;
            result.witness = last_column(&(self.at.M2.transpose() * left)).map(|direction| Witness {
                s: None,
                direction,
                coordinates: (1..=e).map(|i| format!("equation {i}")).collect(),
            });
            let excess = required - decision.rank;
            result.summary = if e > n + q {
                format!(
                    "{}; it cannot hold with m = {e} equations for n + p = {} states and unknown inputs",
                    result.summary,
                    n + q
                )
            } else {
                let ties = if excess == 1 {
                    "one combination of the equations ties".to_owned()
                } else {
                    format!("{excess} combinations of the equations tie")
                };
                format!("{}; {ties} differential states and known inputs alone", result.summary)
            };
            if needed {
                let remedy = if general_exists {
                    "choose the general form, which does not need (A1): it exists for this system"
                } else {
                    "the general form does not need (A1), but its conditions (A2) and (A3) do not both hold either"
                };
                result.remedies.push(remedy.to_owned());
            }
        }
        result.evidence = vec![
            Evidence::rank("[U2'AV2 U2'D], on the null spaces of E", decision, required),
            Evidence::rank("[0 E 0; E A D]", printed, e + r),
        ];
        result.needed = needed;
        Ok(result)
    }

    /// (A2): algebraic equations and outputs together determine algebraic states and unknown inputs.
    pub(super) fn condition_a2(&self) -> Result<Condition, PropertyError> {
        let DescriptorSystem { E, A, C, D, F, .. } = self.system;
        let (n, p, q, r) =
            (self.system.n_states(), self.system.n_outputs(), self.system.n_unknown_inputs(), self.at.r());
        let decision = self.joint_rank()?;
        let blocks = block_matrix(&[&[Zero, Of(E), Zero], &[Of(E), Of(A), Of(D)], &[Zero, Of(C), Of(F)]]);
        let printed = rank(&blocks, 0.0, self.tolerance)?;
        let required = self.n_unknown();
        let mut result = condition(
            "(A2)",
            "impulse observability of state and input",
            "rank [0 E 0; E A D; 0 C F] = n + p + r",
        );
        self.fill(&mut result, &decision, &printed, (required, n + q + r));
        if !result.verdict.holds() {
            let joint = stack(&[&self.at.algebraic(), &self.at.measured()]);
            let null = subspaces(&joint, self.at.scale, self.tolerance)?.null;
            let x2 = self.at.N2.ncols();
            let lifted = stack(&[&(&self.at.N2 * null.rows(0, x2)), &null.rows(x2, q).into_owned()]);
            result.witness = last_column(&lifted).map(|direction| Witness {
                s: None,
                direction,
                coordinates: self.coordinate_names(),
            });
            let algebraic = self.algebraic_rank()?.rank;
            let Hidden { without_effect, only_differential: hidden, n_without_effect } =
                self.hidden_inputs()?;
            if let Some((what, remedy)) = self.said_of(&without_effect) {
                result.summary = format!("{}; {what}", result.summary);
                result.remedies.push(remedy);
            }
            if !hidden.is_empty() {
                result.summary =
                    format!("{}; {} nowhere but in differential equations", result.summary, stand(&hidden));
                result.remedies.push(format!(
                    "{} in no algebraic equation and in no output, and there it takes an integrator to find it: choose the \
                     proportional-integral observer, or measure something that contains it (a row of F)",
                    stand(&hidden)
                ));
            }
            // no output shows what has no effect
            let determined = required - n_without_effect;
            if p + algebraic < determined {
                result.remedies.push(format!(
                    "at least {} outputs are needed, there {} {p}: {determined} algebraic states and unknown inputs, of \
                     which the algebraic equations determine {algebraic}",
                    determined - algebraic,
                    if p == 1 { "is" } else { "are" }
                ));
            }
            // a sensor of a state shows no such input
            if hidden.is_empty() && without_effect.is_empty() {
                result.remedies.extend(single_sensors(self.system, |extended| {
                    let ask = Ask::new(extended, self.tolerance)?;
                    Ok(ask.joint_rank()?.rank == ask.n_unknown())
                })?);
            }
        }
        result.evidence = vec![
            Evidence::rank("[U2'AV2 U2'D; CV2 F], on the null spaces of E", decision, required),
            Evidence::rank("[0 E 0; E A D; 0 C F]", printed, n + q + r),
        ];
        Ok(result)
    }

    /// The unknown inputs of combinations that neither the algebraic equations nor the outputs contain, `ker [D2; F]`,
    /// parted by whether the differential equations contain them.
    fn hidden_inputs(&self) -> Result<Hidden, PropertyError> {
        let kernel = |D: &DMatrix<f64>| subspaces(&stack(&[D, &self.at.F]), self.at.scale, self.tolerance);
        let (unseen, nowhere) = (kernel(&self.at.D2)?.null, kernel(&self.system.D)?.null);
        let rest = &unseen - &nowhere * nowhere.tr_mul(&unseen);
        const PART: f64 = 1e-9;
        let names = |directions: &DMatrix<f64>| {
            let takes_part = |row: &usize| directions.row(*row).iter().any(|x| x.abs() > PART);
            (0..directions.nrows()).filter(takes_part).collect::<Vec<usize>>()
        };
        let only_differential = names(&rest).into_iter().map(|i| format!("d{}", i + 1)).collect();
        Ok(Hidden { without_effect: names(&nowhere), n_without_effect: nowhere.ncols(), only_differential })
    }

    /// What is said of unknown inputs without effect, and what to do; `None` when there are none.
    fn said_of(&self, without_effect: &[usize]) -> Option<(String, String)> {
        let DescriptorSystem { D, F, .. } = self.system;
        let is_zero = |i: &&usize| D.column(**i).iter().chain(F.column(**i).iter()).all(|x| *x == 0.0);
        let listed =
            |inputs: &[usize]| inputs.iter().map(|i| format!("d{}", i + 1)).collect::<Vec<_>>().join(", ");
        let zero: Vec<usize> = without_effect.iter().filter(is_zero).copied().collect();
        if let [one] = zero[..] {
            let what = format!("d{} has no effect at all", one + 1);
            let remedy = format!(
                "{what}: its columns of D and F are zero, so that no observer can estimate it; remove it, or enter what it \
                 acts on"
            );
            return Some((what, remedy));
        }
        if !zero.is_empty() {
            let what = format!("{} have no effect at all", listed(&zero));
            let remedy = format!(
                "{what}: their columns of D and F are zero, so that no observer can estimate them; remove them, or enter what \
                 they act on"
            );
            return Some((what, remedy));
        }
        if without_effect.is_empty() {
            return None;
        }
        let what = format!("a combination of {} has no effect at all", listed(without_effect));
        let remedy = format!(
            "{what}: their columns of [D; F] are dependent, so that no observer can tell them apart; replace them by fewer \
             unknown inputs"
        );
        Some((what, remedy))
    }

    /// Verdict and summary from the compressed rank, which decides, and the printed one beside it.
    fn fill(
        &self,
        result: &mut Condition,
        decision: &RankDecision,
        printed: &RankDecision,
        (required, printed_required): (usize, usize),
    ) {
        let holds = decision.rank == required;
        let agree = holds == (printed.rank == printed_required);
        result.verdict = Verdict::of(holds, decision.fragile || self.at.rank.fragile || !agree);
        let equation = match (agree, holds) {
            (true, true) => format!("{} = {printed_required}", printed.rank),
            (true, false) => format!("{} < {printed_required}", printed.rank),
            (false, _) => format!(
                "the printed matrix has rank {} of {printed_required} within its threshold, the compressed one decides",
                printed.rank
            ),
        };
        result.summary = if required == 0 {
            format!("{equation}; there is nothing to determine")
        } else {
            format!(
                "{equation}; on the algebraic part: rank {} of {required} needed, smallest singular value {:.3e}",
                decision.rank,
                if decision.singular_values.len() < required { 0.0 } else { decision.smallest() }
            )
        };
    }
}

/// Unknown inputs that neither the algebraic equations nor the outputs contain.
struct Hidden {
    /// Those that take part in a combination that stands nowhere at all, from zero.
    without_effect: Vec<usize>,
    /// Number of independent combinations that stand nowhere at all.
    n_without_effect: usize,
    /// Names of those that stand in differential equations.
    only_differential: Vec<String>,
}

/// `d1 stands`, or `a combination of d1 and d2 stands`.
fn stand(inputs: &[String]) -> String {
    match inputs {
        [one] => format!("{one} stands"),
        several => format!("a combination of {} stands", several.join(", ")),
    }
}

/// The last column, which belongs to the smallest singular value, with one as its largest entry.
fn last_column(directions: &DMatrix<f64>) -> Option<Vec<Complex64>> {
    let last: DVector<f64> = directions.column(directions.ncols().checked_sub(1)?).into_owned();
    if last.is_empty() {
        return None;
    }
    let largest = last[last.icamax()];
    Some(last.iter().map(|x| Complex64::from(x / largest)).collect())
}
