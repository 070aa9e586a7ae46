//! Whether each method can be used on a plant, and why: one light and one sentence for each.

use serde::{Deserialize, Serialize};

use super::{Assessment, Condition, Design, DesignChoice, DesignError, Method, Order, Verdict, conditions};
use crate::numerics::Tolerance;
use crate::system::{Model, Network};

/// Whether a method can be used.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct MethodLight {
    /// The method.
    pub method: Method,
    /// The light.
    pub light: Light,
    /// Why: what stands in a line of its own says what would mend it.
    pub why: String,
}

/// A light of a method.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Light {
    /// Its conditions hold, and where a design was asked for, it is there and verified.
    Exists,
    /// Its conditions hold narrowly, or hold without the design that was asked for.
    Near,
    /// A condition fails, or the demands cannot be met.
    Fails,
    /// Data are missing.
    Missing,
}

impl Light {
    /// The key in reports.
    pub fn key(self) -> &'static str {
        match self {
            Self::Exists => "exists",
            Self::Near => "near",
            Self::Fails => "fails",
            Self::Missing => "missing",
        }
    }
}

/// What is known of the chosen method already, so that it is not asked again.
#[derive(Clone, Copy, Debug)]
pub struct Known<'a> {
    /// Its conditions.
    pub conditions: &'a [Condition],
    /// The design or why there is none; `None` when no design was asked for.
    pub outcome: Option<&'a Result<Design, DesignError>>,
}

impl<'a> From<&'a Assessment> for Known<'a> {
    fn from(assessment: &'a Assessment) -> Self {
        Self { conditions: &assessment.conditions, outcome: Some(&assessment.outcome) }
    }
}

/// States up to which the other orders of a failing method are asked, too: each asks all conditions again.
const MOST_STATES: usize = 30;

/// The lights of all methods on a plant, with the order and the demands of the chosen design where a method has them.
pub fn lights(
    model: &Model,
    chosen: &DesignChoice,
    tolerance: &Tolerance,
    known: Option<Known<'_>>,
) -> Vec<MethodLight> {
    let light = |method: &Method| {
        let known = known.filter(|_| *method == chosen.method);
        light((model, tolerance), *method, chosen, known)
    };
    Method::ALL.iter().map(light).collect()
}

/// The lights of all methods on a network that is too large to be written as one system; `found` are the conditions of the
/// hierarchical observer, or why they cannot be decided, `outcome` its design, where one was asked for.
pub fn network_lights(
    network: &Network,
    found: Result<&[Condition], &str>,
    outcome: Option<&Result<Design, DesignError>>,
) -> Vec<MethodLight> {
    let light = |method: &Method| {
        let method = *method;
        let (light, why) = match (method.missing_for(network), found) {
            (Some(why), _) => (Light::Missing, why),
            (None, Ok(found)) => return designed(judged(method, found), outcome),
            (None, Err(error)) => (Light::Fails, error.to_owned()),
        };
        MethodLight { method, light, why }
    };
    Method::ALL.iter().map(light).collect()
}

fn light(
    (model, tolerance): (&Model, &Tolerance),
    method: Method,
    chosen: &DesignChoice,
    known: Option<Known<'_>>,
) -> MethodLight {
    if let Some(why) = method.missing(model) {
        return MethodLight { method, light: Light::Missing, why };
    }
    // an order that the method does not have stands for its usual one
    let usual = method.orders().first().copied().unwrap_or_default();
    let offered = method.orders().contains(&chosen.order);
    let choice = DesignChoice { method, order: if offered { chosen.order } else { usual }, ..chosen.clone() };
    let found = match known {
        Some(known) if offered => Ok(known.conditions.to_vec()),
        _ => conditions(model, &choice, tolerance),
    };
    let mut result = match found {
        Ok(found) => judged(method, &found),
        Err(error) => MethodLight { method, light: Light::Fails, why: error.to_string() },
    };
    if result.light == Light::Fails {
        let others = other_orders(model, &choice, tolerance);
        // what would mend it stands in a line of its own
        let at = result.why.find('\n').unwrap_or(result.why.len());
        result.why.insert_str(at, &others);
        return result;
    }
    if !offered && chosen.method == method {
        let orders: Vec<&str> = method.orders().iter().map(|order| order.key()).collect();
        result.light = Light::Near;
        result.why = format!(
            "{} {}, but there is no design: this method has no {} order; choose {}",
            result.why,
            words(choice.order),
            chosen.order.key(),
            orders.join(" or ")
        );
        return result;
    }
    designed(result, known.and_then(|known| known.outcome))
}

/// The light that conditions give a method.
fn judged(method: Method, found: &[Condition]) -> MethodLight {
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

/// What the design that was asked for adds to conditions that hold.
fn designed(light: MethodLight, outcome: Option<&Result<Design, DesignError>>) -> MethodLight {
    let MethodLight { method, light: by_conditions, why } = light;
    if !matches!(by_conditions, Light::Exists | Light::Near) {
        return MethodLight { method, light: by_conditions, why };
    }
    let (light, why) = match outcome {
        None if method.uses_lmi() => {
            (by_conditions, format!("{why}; whether the demands can be met is seen when it is designed"))
        }
        Some(Ok(design)) if !design.verification.verified() => {
            let failed = design.verification.failures().next().map_or("a check", |check| check.name.as_str());
            (Light::Near, format!("{why}, but the design is not verified: {failed} fails"))
        }
        Some(Ok(_)) if method.uses_lmi() => {
            (by_conditions, format!("{why}, and the matrix inequalities are feasible"))
        }
        None | Some(Ok(_)) => (by_conditions, why),
        Some(Err(error @ DesignError::Infeasible(_))) => {
            (Light::Fails, format!("the conditions hold, but the demands cannot be met: {error}"))
        }
        Some(Err(error)) => (Light::Near, format!("{why}, but there is no design: {error}")),
    };
    MethodLight { method, light, why }
}

/// Of which other orders a method exists whose conditions fail for one, as the end of a sentence.
fn other_orders(model: &Model, failing: &DesignChoice, tolerance: &Tolerance) -> String {
    let orders = failing.method.orders();
    if orders.len() < 2 {
        return String::new();
    }
    let holds = |order: &Order| {
        let choice = DesignChoice { order: *order, ..failing.clone() };
        conditions(model, &choice, tolerance)
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
