//! Conditions with their evidence as JSON.

use serde_json::{Value, json};

use super::{complexes, number, numbers};
use crate::numerics::RankDecision;
use crate::observer::{Condition, Evidence, PointEvidence, SetEvidence, Verdict, Witness};

pub(super) fn condition(condition: &Condition) -> Value {
    let Condition {
        id,
        label,
        name,
        formula,
        source,
        verdict: found,
        summary,
        evidence,
        witness,
        remedies,
        needed,
    } = condition;
    json!({
        "id": id,
        "label": label,
        "name": name,
        "statement": formula.plain(),
        "source": source,
        "needed": needed,
        "verdict": verdict(*found),
        "summary": summary,
        "evidence": evidence.iter().map(self::evidence).collect::<Value>(),
        "witness": witness.as_ref().map(self::witness),
        "remedies": remedies,
    })
}

/// The verdict as a word.
pub(super) fn verdict(verdict: Verdict) -> &'static str {
    match verdict {
        Verdict::Holds => "holds",
        Verdict::Fragile => "fragile",
        Verdict::Fails => "fails",
        Verdict::Undecided => "undecided",
    }
}

fn evidence(evidence: &Evidence) -> Value {
    match evidence {
        Evidence::Rank { of, decision, required } => rank(of, decision, *required),
        Evidence::Points { of, points } => {
            json!({ "kind": "points", "of": of, "points": points.iter().map(point).collect::<Value>() })
        }
        Evidence::Sets { of, names: [element, set, space], sets } => {
            let one = |found: &SetEvidence| {
                json!({
                    "element": super::complex(found.element),
                    "members": complexes(&found.members),
                    "size": found.members.len(),
                    "dimension": found.dimension,
                })
            };
            json!({
                "kind": "sets", "of": of, "element": element, "set": set, "space": space,
                "sets": sets.iter().map(one).collect::<Value>(),
            })
        }
    }
}

/// A rank decision beside the rank that is required.
pub(super) fn rank(of: &str, decision: &RankDecision, required: usize) -> Value {
    json!({
        "kind": "rank",
        "of": of,
        "rows": decision.rows,
        "columns": decision.columns,
        "rank": decision.rank,
        "required": required,
        "singular_values": numbers(&decision.singular_values),
        "threshold": number(decision.threshold),
        "gap": number(decision.gap),
        "fragile": decision.fragile,
    })
}

fn point(point: &PointEvidence) -> Value {
    json!({
        "s": super::complex(point.s),
        "multiplicity": point.multiplicity,
        "distance": number(point.distance),
        "loses_rank": point.loses_rank,
        "stable": point.stable,
    })
}

fn witness(witness: &Witness) -> Value {
    json!({
        "s": witness.s.map(super::complex),
        "coordinates": witness.coordinates.iter().take(witness.direction.len()).collect::<Vec<_>>(),
        "direction": complexes(&witness.direction),
        "main": witness.main_coordinates(),
    })
}
