//! Misprints in reports.

use serde_json::{Value, json};

use crate::paper::Erratum;

pub(super) fn erratum(erratum: &Erratum) -> Value {
    let Erratum { paper, place, concerns, printed, correct, proof } = erratum;
    json!({
        "paper": paper, "place": place, "concerns": concerns, "printed": printed, "correct": correct, "proof": proof,
    })
}
