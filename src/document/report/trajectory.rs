//! A trajectory as JSON: one list for each component.

use serde_json::{Map, Value, json};

use super::{matrix, number, numbers};
use crate::simulation::{Method, Trajectory};

/// Adds time, signals, states and estimates; matrices have a row for each component and a column for each instant.
pub(super) fn put(map: &mut Map<String, Value>, trajectory: &Trajectory) {
    let Trajectory { t, u, d, y, x, observers, initial_state, smallest_a22, method, steps, note, remarks } =
        trajectory;
    let mut put = |key: &str, value: Value| {
        map.insert(key.to_owned(), value);
    };
    put(
        "integration",
        json!({
            "method": match method {
                Method::Exponential => "matrix exponential",
                Method::Explicit => "explicit one-step method",
                Method::Implicit => "implicit one-step method",
                Method::Recursion => "recursion",
            },
            "steps": steps,
            "smallest_singular_value_of_A22": number(*smallest_a22),
        }),
    );
    put(
        "initial_state",
        json!({
            "given": numbers(&initial_state.given),
            "consistent": numbers(&initial_state.consistent),
            "change": number(initial_state.change),
        }),
    );
    put("note", json!(note));
    put("remarks", json!(remarks));
    put("t", numbers(t));
    for (key, values) in [("u", u), ("d", d), ("y", y), ("x", x)] {
        put(key, matrix(values));
    }
    let observer = |o: &crate::simulation::ObserverTrajectory| {
        json!({
            "z": matrix(&o.z),
            "x_hat": matrix(&o.x_hat),
            "d_hat": matrix(&o.d_hat),
            "e": matrix(&o.e),
            "e_d": matrix(&o.e_d),
            "contraction": o.contraction.map(number),
        })
    };
    put("observers", observers.iter().map(observer).collect());
}
