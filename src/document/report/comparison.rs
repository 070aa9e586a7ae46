//! A comparison of designs as JSON.

use serde_json::{Map, Value, json};

use super::{complex, complexes, design::verdict_of, number, numbers};
use crate::observer::{ErrorGain, ErrorGains};
use crate::simulation::comparison::{ComparedDesign, Comparison, ComparisonRow, ErrorSize, ScenarioErrors};

/// Adds the designs and the remarks.
pub(super) fn put(map: &mut Map<String, Value>, comparison: &Comparison) {
    map.insert("designs".to_owned(), comparison.rows.iter().map(row).collect());
    map.insert("norms_of_linear_part".to_owned(), json!(comparison.linear_part));
    map.insert("notes".to_owned(), json!(comparison.notes));
}

fn row(row: &ComparisonRow) -> Value {
    let mut map = Map::new();
    let mut put = |key: &str, value: Value| map.insert(key.to_owned(), value);
    put("name", json!(row.name));
    put("method", json!(row.method.key()));
    put("order", json!(row.order.key()));
    match &row.outcome {
        Ok(design) => {
            put("verdict", json!(if design.verified { "verified" } else { "not verified" }));
            map.extend(found(design));
        }
        Err(error) => {
            put("verdict", json!(verdict_of(error)));
            put("error", json!(error.to_string()));
        }
    }
    Value::Object(map)
}

fn found(design: &ComparedDesign) -> Map<String, Value> {
    let ComparedDesign {
        title,
        order,
        states: _,
        estimated,
        verified: _,
        spectrum,
        slowest,
        margin,
        fixed_modes,
        output_gain,
        direct_gain,
        chosen_gain,
        guaranteed,
        gains,
        scenario,
    } = design;
    let all = [
        ("title", json!(title)),
        ("order_number", json!(order)),
        ("estimated_states", estimated.iter().map(|state| state + 1).collect()),
        ("spectrum", complexes(spectrum)),
        ("slowest_mode", slowest.map_or(Value::Null, complex)),
        ("decay", margin.map_or(Value::Null, number)),
        ("fixed_modes", complexes(fixed_modes)),
        (
            "gain_norms",
            json!({ "L": number(*output_gain), "V": number(*direct_gain), "chosen": number(*chosen_gain) }),
        ),
        ("guaranteed_gamma", guaranteed.map_or(Value::Null, number)),
        ("h_infinity_norms", norms(gains)),
        ("scenario", scenario.as_ref().map_or_else(|why| json!({ "error": why }), errors)),
    ];
    all.into_iter().map(|(key, value)| (key.to_owned(), value)).collect()
}

fn norms(gains: &ErrorGains) -> Value {
    let ErrorGains { d_to_e, d_to_e_d, w_to_e, w_to_e_d } = gains;
    json!({
        "d to e": norm(d_to_e, "no unknown input"),
        "d to e_d": norm(d_to_e_d, "no unknown input"),
        "noise to e": norm(w_to_e, "no output, hence no noise"),
        "noise to e_d": norm(w_to_e_d, "no output, hence no noise"),
    })
}

/// A norm, or why there is none; `lacking` is what the plant has not when there is no such input.
fn norm(gain: &ErrorGain, lacking: &str) -> Value {
    match gain {
        ErrorGain::Norm(found) => json!({ "norm": number(found.norm), "frequency": number(found.frequency) }),
        ErrorGain::Decoupled => json!({ "norm": 0, "decoupled": true }),
        ErrorGain::NotEstimated => json!({ "norm": null, "why": "not estimated" }),
        ErrorGain::NoInput => json!({ "norm": null, "why": format!("the plant has {lacking}") }),
        ErrorGain::NotFinite(why) | ErrorGain::NotComputed(why) => json!({ "norm": null, "why": why }),
    }
}

/// Lists with an entry for each state and estimated unknown input; `null` for a state that is not estimated.
fn errors(errors: &ScenarioErrors) -> Value {
    type Of = fn(&ErrorSize) -> f64;
    let of = |of: Of| {
        let states: Value = errors
            .states
            .iter()
            .map(|size| size.as_ref().map_or(Value::Null, |size| number(of(size))))
            .collect();
        let unknown: Vec<f64> = errors.unknown.iter().map(of).collect();
        let together = |size: &Option<ErrorSize>| size.as_ref().map_or(Value::Null, |size| number(of(size)));
        json!({
            "states": states,
            "unknown_inputs": numbers(&unknown),
            "all_states": together(&errors.all_states),
            "all_unknown_inputs": together(&errors.all_unknown),
        })
    };
    json!({
        "rms": of(|size| size.rms),
        "largest": of(|size| size.largest),
        "rms_second_half": of(|size| size.late_rms),
        "largest_second_half": of(|size| size.late_largest),
    })
}
