//! Initial states by one expression follow the number of states.

use crate::document::{Document, Entry, Sizes};

/// Lists the values of an expression that has no finite value for one of the states; that one starts from zero.
pub(super) fn follow(document: &mut Document, before: &Document) -> Option<String> {
    let states = Sizes::of(&document.plant).states;
    let scenario = &mut document.scenario;
    let formula = scenario.x0_formula.as_ref().filter(|_| scenario.x0.is_empty())?;
    if states == Sizes::of(&before.plant).states {
        return None;
    }
    let values = formula.values(states);
    let bad = values.iter().position(|value| !value.is_finite())?;
    let told = format!(
        "the initial states are listed now: their expression {} has no finite value for i = {}",
        formula.text(),
        bad + 1
    );
    let entry = |value: f64| Entry::number(if value.is_finite() { value } else { 0.0 });
    scenario.x0 = values.into_iter().map(entry).collect();
    scenario.x0_formula = None;
    Some(told)
}
