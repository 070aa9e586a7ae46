//! Properties of the system with their evidence as JSON.

use serde_json::{Map, Value, json};

use super::condition::{rank, verdict};
use super::{complex, complexes, number, numbers};
use crate::numerics::{ModePosition, Tolerance};
use crate::observer::Verdict;
use crate::system::DescriptorSystem;
use crate::system::properties::{
    ImpulseObservability, ModeCondition, PropertyError, Regularity, UnobservableMode, finite_eigenvalues,
    impulse_observability, index, r_detectability, r_observability, rank_e, rank_e_c, regularity,
};

/// All properties, each an object with `id` and `name`; one that could not be decided has an `error`.
pub(super) fn properties(system: &DescriptorSystem, tolerance: &Tolerance) -> Vec<Value> {
    let n = system.n_states();
    let all = [
        entry("regular", "regular", regularity(system, tolerance).map(|found| of_regularity(&found))),
        entry(
            "index",
            "index",
            index(system, tolerance).map(|found| {
                json!({
                    "value": found.index,
                    "infinite_degrees": found.infinite_degrees,
                    "gap": number(found.gap),
                    "fragile": found.fragile,
                })
            }),
        ),
        entry(
            "finite-eigenvalues",
            "finite eigenvalues",
            finite_eigenvalues(system, tolerance).map(|found| {
                json!({ "values": complexes(&found.values), "gap": number(found.gap), "fragile": found.fragile })
            }),
        ),
        entry(
            "rank-E",
            "rank E",
            rank_e(system, tolerance).map(|found| json!({ "value": found.rank, "evidence": [rank("E", &found, n)] })),
        ),
        entry(
            "rank-E-C",
            "rank [E; C] = n",
            rank_e_c(system, tolerance).map(|found| {
                let evidence = rank("[E; C]", &found.decision, found.needed);
                json!({ "verdict": verdict(Verdict::of(found.holds(), found.fragile())), "evidence": [evidence] })
            }),
        ),
        entry(
            "impulse-observable",
            "impulse observable",
            impulse_observability(system, tolerance).map(|found| of_impulses(&found)),
        ),
        entry("R-observable", "R-observable", r_observability(system, tolerance).map(|found| of_modes(&found))),
        entry("R-detectable", "R-detectable", r_detectability(system, tolerance).map(|found| of_modes(&found))),
    ];
    all.into()
}

fn entry(id: &str, name: &str, found: Result<Value, PropertyError>) -> Value {
    let mut map = Map::new();
    map.insert("id".to_owned(), json!(id));
    map.insert("name".to_owned(), json!(name));
    match found {
        Ok(Value::Object(more)) => map.extend(more),
        Ok(value) => {
            map.insert("value".to_owned(), value);
        }
        Err(error) => {
            map.insert("verdict".to_owned(), json!(verdict(Verdict::Undecided)));
            map.insert("error".to_owned(), json!(error.to_string()));
        }
    }
    Value::Object(map)
}

fn of_regularity(found: &Regularity) -> Value {
    let structure = &found.structure;
    json!({
        "verdict": verdict(Verdict::of(found.holds(), found.fragile())),
        "rows": structure.rows,
        "columns": structure.columns,
        "normal_rank": structure.normal_rank,
        "gap": number(structure.gap),
    })
}

fn of_impulses(found: &ImpulseObservability) -> Value {
    let ImpulseObservability { compressed, printed, witness, .. } = found;
    json!({
        "verdict": verdict(Verdict::of(found.holds(), found.fragile())),
        "evidence": [
            rank("[U2'A V2; C V2]", &compressed.decision, compressed.needed),
            rank("[E A; 0 E; 0 C]", &printed.decision, printed.needed),
        ],
        "witness": witness.as_ref().map(numbers),
    })
}

fn of_modes(found: &ModeCondition) -> Value {
    json!({
        "verdict": verdict(Verdict::of(found.holds(), found.fragile())),
        "normal_rank": found.normal_rank,
        "needed": found.needed,
        "free_direction": found.free_direction.as_ref().map(numbers),
        "modes": found.modes.iter().map(mode).collect::<Value>(),
        "gap": number(found.gap),
    })
}

fn mode(mode: &UnobservableMode) -> Value {
    let position = match mode.position {
        ModePosition::Stable => "stable",
        ModePosition::OnBoundary => "on the boundary",
        ModePosition::Unstable => "unstable",
    };
    json!({
        "s": complex(mode.s),
        "multiplicity": mode.multiplicity,
        "distance": number(mode.sigma),
        "position": position,
        "direction": complexes(&mode.direction),
    })
}
