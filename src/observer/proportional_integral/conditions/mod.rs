//! Existence conditions (8)-(13), (22), (23) of paper 004, with their evidence.

mod modes;
mod pairs;
mod ranks;
mod sensors;

pub(in crate::observer) use sensors::single_sensors;

use super::{compressed, restricted};
use crate::numerics::Tolerance;
use crate::observer::{Condition, Order, Verdict};
use crate::system::DescriptorSystem;
use crate::system::properties::{PropertyError, r_detectability};

const PAPER: &str = "Koenig and Mammar 2002";

/// Existence conditions of the proportional-integral observer; `needed` marks those of the chosen order.
///
/// # Errors
/// When a decomposition fails its check.
///
/// # Source
/// Koenig and Mammar 2002, Theorems 1-5. Every condition "for all s" is decided at exact finite zeros.
pub fn conditions(
    system: &DescriptorSystem,
    order: Order,
    tolerance: &Tolerance,
) -> Result<Vec<Condition>, PropertyError> {
    let ask = Ask { system, tolerance };
    let paper_form = order != Order::General;
    let eight = ask.condition_8(paper_form)?;
    let exists = eight.verdict.holds();
    let mut result = vec![eight, ask.no_feedthrough(paper_form), ask.condition_9()?, ask.condition_10()?];
    if order == Order::General {
        advise_units(system, &mut result);
        return Ok(result);
    }
    if !exists {
        for (label, name) in [("(11)", "left inverse"), ("(13)", pairs::NAME_13)] {
            result.push(undecided(
                label,
                name,
                "it is asked of the equivalent system (4), which (8) does not give",
            ));
        }
        return Ok(result);
    }
    let equivalent = restricted(system, tolerance)?;
    let eleven = ask.condition_11(&equivalent)?;
    let inverse = eleven.verdict.holds();
    result.push(eleven);
    match order {
        Order::Full if inverse => result.push(ask.condition_13(&equivalent)?),
        Order::Full => result.push(undecided(
            "(13)",
            pairs::NAME_13,
            "its T1 is part of the left inverse, which (11) does not give",
        )),
        Order::Reduced => result.extend(ask.conditions_22_23(&equivalent)?),
        Order::General | Order::Minimal => {}
    }
    advise_units(system, &mut result);
    Ok(result)
}

/// Decades that the entries of a system may span before units are worth a word.
const USUAL_SPAN: f64 = 7.0;

/// Where a condition does not clearly hold and the entries span many decades, proposes other units.
pub(in crate::observer) fn advise_units(system: &DescriptorSystem, conditions: &mut [Condition]) {
    let entries = system.matrices().into_iter().flat_map(|(_, matrix)| matrix.iter());
    let sizes = entries.filter(|x| **x != 0.0).map(|x| x.abs().log10());
    let (low, high) =
        sizes.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| (low.min(x), high.max(x)));
    let span = high - low;
    if span < USUAL_SPAN {
        return;
    }
    for condition in conditions.iter_mut().filter(|c| matches!(c.verdict, Verdict::Fragile | Verdict::Fails))
    {
        condition.remedies.push(format!(
            "the entries span {span:.0} decades, which makes this decision unreliable: choose units in which they are \
             closer to 1 (for example ms, kOhm and uF)"
        ));
    }
}

/// Existence conditions of an observer that estimates states alone: (9) and R-detectability.
///
/// # Errors
/// When a decomposition fails its check.
///
/// # Source
/// Darouach and Boutayeb 1995, Theorem 1; Koenig and Mammar 2002, Definitions 1 and 3.
pub fn ordinary_conditions(
    system: &DescriptorSystem,
    order: Order,
    tolerance: &Tolerance,
) -> Result<Vec<Condition>, PropertyError> {
    let ask = Ask { system, tolerance };
    let nine = ask.condition_9()?;
    let usable = nine.verdict.holds();
    let found = r_detectability(system, tolerance)?;
    let mut detectable = ask.detectability(&found);
    if !detectable.verdict.holds() {
        detectable.remedies = ask.sensors(|extended| Ok(r_detectability(extended, tolerance)?.holds()))?;
    }
    let mut result = vec![nine, detectable];
    if usable {
        let equivalent = compressed(system, tolerance)?;
        result.push(ask.condition_11(&equivalent)?);
        if order == Order::Reduced {
            result.extend(ask.conditions_22_23(&equivalent)?);
        }
    }
    advise_units(system, &mut result);
    Ok(result)
}

/// The system and the thresholds that all conditions ask about.
struct Ask<'a> {
    system: &'a DescriptorSystem,
    tolerance: &'a Tolerance,
}

/// The equation number without its brackets, as it stands in an identifier.
fn id(label: &str) -> String {
    format!("004-{}", label.trim_matches(['(', ')']))
}

fn condition(label: &str, name: &str, formula: &str) -> Condition {
    Condition::asked((id(label), label), name, formula, format!("{PAPER}, equation {label}"))
}

fn undecided(label: &str, name: &str, why: &str) -> Condition {
    Condition { summary: why.to_owned(), needed: true, ..condition(label, name, "") }
}

impl Ask<'_> {
    /// Names `x1 ...` of the states, then `d1 ...` of the unknown inputs.
    fn coordinates(&self) -> Vec<String> {
        let states = (1..=self.system.n_states()).map(|i| format!("x{i}"));
        states.chain((1..=self.system.n_unknown_inputs()).map(|i| format!("d{i}"))).collect()
    }
}
