//! Whether each method can be used on a plant, and why: one light and one sentence for each.

use super::analysis::{Light, MethodLight};
use crate::document::Document;
use crate::observer::{
    Assessment, Condition, Design, DesignChoice, DesignError, Method, Order, Verdict, conditions,
};
use crate::system::Model;

/// States up to which the other orders of a failing method are asked, too: each asks all conditions again.
const MOST_STATES: usize = 30;

/// The lights of all methods; the chosen one has been assessed, its conditions are known already.
pub(super) fn lights(
    model: &Model,
    document: &Document,
    assessment: Result<&Assessment, &String>,
) -> Vec<MethodLight> {
    let chosen = assessment.ok().filter(|assessment| assessment.choice.method == document.design.method);
    let light = |method: &Method| {
        let known = chosen.filter(|assessment| assessment.choice.method == *method);
        light(model, document, *method, known)
    };
    Method::ALL.iter().map(light).collect()
}

fn light(model: &Model, document: &Document, method: Method, known: Option<&Assessment>) -> MethodLight {
    if let Some(why) = method.missing(model) {
        return MethodLight { method, light: Light::Missing, why };
    }
    let chosen = &document.design;
    // an order that the method does not have stands for its usual one
    let usual = method.orders().first().copied().unwrap_or_default();
    let order = if method.orders().contains(&chosen.order) { chosen.order } else { usual };
    let choice = DesignChoice { method, order, ..chosen.clone() };
    let found = match known {
        Some(assessment) => Ok(assessment.conditions.clone()),
        None => conditions(model, &choice, &document.tolerance),
    };
    let mut result = match found {
        Ok(found) => judged(method, &found),
        Err(error) => MethodLight { method, light: Light::Fails, why: error.to_string() },
    };
    match result.light {
        Light::Fails => {
            let others = other_orders(model, document, &choice);
            // what would mend it stands in a line of its own
            let at = result.why.find('\n').unwrap_or(result.why.len());
            result.why.insert_str(at, &others);
        }
        Light::Exists | Light::Near => demands(&mut result, known.map(|assessment| &assessment.outcome)),
        Light::Missing => {}
    }
    result
}

/// The light that conditions give a method.
pub(super) fn judged(method: Method, found: &[Condition]) -> MethodLight {
    let light = |light, why: String| MethodLight { method, light, why };
    let needed = || found.iter().filter(|condition| condition.needed);
    if let Some(failed) = needed().find(|condition| condition.verdict == Verdict::Fails) {
        let mend = failed.remedies.first().map_or(String::new(), |remedy| format!("\n{remedy}"));
        return light(Light::Fails, format!("{} fails: {}{mend}", called(failed), failed.summary));
    }
    if let Some(open) = needed().find(|condition| condition.verdict == Verdict::Undecided) {
        return light(Light::Missing, format!("{} is not decided: {}", called(open), open.summary));
    }
    match needed().find(|condition| condition.verdict == Verdict::Fragile) {
        Some(near) => {
            light(Light::Near, format!("condition {} holds narrowly: {}", near.label, near.summary))
        }
        None => light(Light::Exists, "all conditions hold".to_owned()),
    }
}

/// A condition as people call it: `condition (9)`, but `Assumption 1`.
fn called(condition: &Condition) -> String {
    if condition.label.starts_with('(') {
        format!("condition {}", condition.label)
    } else {
        condition.label.clone()
    }
}

/// What a design by matrix inequalities adds to its conditions: whether the demands can be met is known of the chosen one.
fn demands(light: &mut MethodLight, outcome: Option<&Result<Design, DesignError>>) {
    if !light.method.uses_lmi() {
        return;
    }
    match outcome {
        None => light.why.push_str("; whether the demands can be met is seen when it is chosen"),
        Some(Ok(_)) => light.why.push_str(", and the matrix inequalities are feasible"),
        Some(Err(error @ DesignError::Infeasible(_))) => {
            light.light = Light::Fails;
            light.why = format!("the conditions hold, but the demands cannot be met: {error}");
        }
        Some(Err(error)) => {
            light.why = format!("{}, but there is no design: {error}", light.why);
        }
    }
}

/// Of which other orders a method exists whose conditions fail for one, as the end of a sentence.
fn other_orders(model: &Model, document: &Document, failing: &DesignChoice) -> String {
    let orders = failing.method.orders();
    if orders.len() < 2 {
        return String::new();
    }
    let holds = |order: &Order| {
        let choice = DesignChoice { order: *order, ..failing.clone() };
        conditions(model, &choice, &document.tolerance)
            .is_ok_and(|found| found.iter().all(|c| !c.needed || c.verdict.holds()))
    };
    let small = model.system.n_states() <= MOST_STATES;
    let others = orders.iter().filter(|order| small && **order != failing.order && holds(order));
    let others: Vec<&str> = others.map(|order| words(*order)).collect();
    let this = words(failing.order);
    if others.is_empty() {
        let either = if small { "; no other order exists either" } else { "" };
        return format!(" (asked {this}{either})");
    }
    format!(" (asked {this}); it exists {}", others.join(" and "))
}

fn words(order: Order) -> &'static str {
    match order {
        Order::Full => "of full order",
        Order::Reduced => "of reduced order",
        Order::General => "in the general form",
        Order::Minimal => "of minimal order",
    }
}
