//! Errata in reports.

use serde_json::{Value, json};

use crate::paper::Erratum;

pub(super) fn erratum(erratum: &Erratum) -> Value {
    let Erratum { paper, kind, place, concerns, printed, correct, proof } = erratum;
    json!({
        "paper": paper, "kind": kind.word(), "place": place, "concerns": concerns, "printed": printed, "correct": correct, "proof": proof,
    })
}
