//! A design, or why there is none, as JSON.

use serde_json::{Map, Value, json};

use super::{complexes, matrix, number};
use crate::numerics::{Placement, PlacementMethod};
use crate::observer::{
    Assessment, Check, Design, DesignError, Injection, LinearObserver, LmiResult, Synthesis, Verification,
};

/// The outcome of a choice: `verified`, `not verified`, `does not exist`, `undecided`, `cancelled` or `bad input`.
pub(super) fn design(assessment: &Assessment) -> Value {
    let choice = &assessment.choice;
    let mut map = Map::new();
    let mut put = |key: &str, value: Value| {
        map.insert(key.to_owned(), value);
    };
    let verdict = match &assessment.outcome {
        Ok(design) if design.verification.verified() => "verified",
        Ok(_) => "not verified",
        Err(error) => verdict_of(error),
    };
    put("verdict", json!(verdict));
    put("title", json!(assessment.outcome.as_ref().ok().map(|design| &design.title)));
    put("method", json!(choice.method.key()));
    put("order", json!(choice.order.key()));
    put("scale", number(choice.scale));
    put("seed", json!(choice.seed));
    match &assessment.outcome {
        Ok(design) => found(&mut map, design),
        Err(error) => missing(&mut map, error),
    }
    Value::Object(map)
}

/// Why there is no design, in a word.
pub(super) fn verdict_of(error: &DesignError) -> &'static str {
    match error {
        error if error.is_bad_input() => "bad input",
        DesignError::GaveUp(_) | DesignError::Numerics(_) => "undecided",
        DesignError::Cancelled => "cancelled",
        _ => "does not exist",
    }
}

fn missing(map: &mut Map<String, Value>, error: &DesignError) {
    map.insert("error".to_owned(), json!(error.to_string()));
    let condition = match error {
        DesignError::Condition { id, .. } => Some(id),
        DesignError::Unsuitable(_)
        | DesignError::TooFewPoles { .. }
        | DesignError::Poles(_)
        | DesignError::Demand(_)
        | DesignError::Infeasible(_)
        | DesignError::Cancelled
        | DesignError::GaveUp(_)
        | DesignError::Numerics(_) => None,
    };
    map.insert("failed_condition".to_owned(), json!(condition));
}

fn found(map: &mut Map<String, Value>, design: &Design) {
    let mut put = |key: &str, value: Value| {
        map.insert(key.to_owned(), value);
    };
    let matrices: Map<String, Value> =
        design.matrices.iter().map(|named| (named.name.clone(), matrix(&named.value))).collect();
    let meanings: Map<String, Value> =
        design.matrices.iter().map(|named| (named.name.clone(), json!(named.meaning))).collect();
    put("order_number", json!(design.observer.order()));
    put("matrices", Value::Object(matrices));
    put("meanings", Value::Object(meanings));
    put("observer", observer(&design.observer));
    put("spectrum", complexes(&design.verification.spectrum));
    put("fixed_modes", complexes(&design.synthesis.fixed_modes()));
    match &design.synthesis {
        Synthesis::Poles(found) => {
            put("requested", complexes(&found.requested));
            put("placement", placement(found));
        }
        Synthesis::Lmi(results) => put("lmi", results.iter().map(lmi_result).collect()),
    }
    put("injection", design.injection.as_ref().map_or(Value::Null, injection));
    put("verification", verification(&design.verification));
    put("notes", json!(design.notes));
}

/// `z' = N z + L y + H u,  x_hat = P z + V y + W u,  d_hat = Q z + R y + S u`.
fn observer(observer: &LinearObserver) -> Value {
    let LinearObserver { N, L, H, P, V, W, Q, R, S } = observer;
    let all = [("N", N), ("L", L), ("H", H), ("P", P), ("V", V), ("W", W), ("Q", Q), ("R", R), ("S", S)];
    Value::Object(all.into_iter().map(|(name, value)| (name.to_owned(), matrix(value))).collect())
}

/// `+ state f(x_hat)` in the first, `+ estimate f(x_hat)` in the second equation of the observer.
fn injection(injection: &Injection) -> Value {
    json!({ "state": matrix(&injection.state), "estimate": matrix(&injection.estimate) })
}

fn lmi_result(result: &LmiResult) -> Value {
    let bounds: Map<String, Value> =
        result.bounds.iter().map(|(name, value)| (name.clone(), number(*value))).collect();
    json!({
        "name": result.name,
        "gamma": result.gamma.map(number),
        "gamma_best": result.gamma_best.map(number),
        "certificate": {
            "proved": result.certificate.proved,
            "margin": number(result.certificate.margin),
            "statement": result.certificate.statement,
            "note": result.certificate.note,
        },
        "h_infinity_norm": result.h_infinity.map(|found| json!({
            "norm": number(found.norm),
            "frequency": number(found.frequency),
            "lower": number(found.lower),
            "upper": number(found.upper),
        })),
        "lower_bounds": bounds,
        "contraction": result.contraction.map(number),
        "gain": number(result.gain),
        "fixed_modes": complexes(&result.fixed_modes),
        "fastest_decay": result.fastest_decay.map(number),
        "iterations": result.iterations,
    })
}

fn placement(placement: &Placement) -> Value {
    let method = match placement.method {
        PlacementMethod::NothingToPlace => "nothing to place",
        PlacementMethod::Direct => "direct",
        PlacementMethod::SingleOutput => "single output",
        PlacementMethod::NullSpace => "null space",
    };
    let warnings: Vec<String> = placement.warnings.iter().map(ToString::to_string).collect();
    json!({
        "algorithm": method,
        "achieved": complexes(&placement.achieved),
        "relative_error": placement.relative_error.map(number),
        "condition": number(placement.condition),
        "expected_accuracy": number(placement.expected_accuracy),
        "warnings": warnings,
    })
}

fn verification(verification: &Verification) -> Value {
    json!({
        "verified": verification.verified(),
        "checks": verification.checks.iter().map(check).collect::<Value>(),
        "skipped": verification.skipped,
    })
}

fn check(check: &Check) -> Value {
    json!({
        "name": check.name,
        "statement": check.statement,
        "value": number(check.value),
        "limit": number(check.limit),
        "passed": check.passed(),
    })
}
