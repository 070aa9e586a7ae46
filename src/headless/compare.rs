//! `compare`: the chosen design beside those that are kept.

use super::load::load;
use super::{Answer, BAD_INPUT, DONE, Files, REFUSED, Refusal, Source, TableFormat};
use crate::document::comparison::{comparison_to_csv, comparison_to_markdown};
use crate::document::report::comparison_report;
use crate::document::{Document, Subject};
use crate::numerics::Watch;
use crate::simulation::comparison::{Compared, Comparison, compare as compare_designs};
use crate::system::{Model, Network};

/// The table of all designs.
pub(super) fn compare(source: &Source, format: TableFormat, files: &dyn Files) -> Result<Answer, Refusal> {
    let problem = load(source, files)?;
    let comparison = match &problem.subject {
        Subject::Model(model) => compared(&problem.document, model)?.comparison,
        Subject::Network(network) => compared_network(&problem.document, network)?.comparison,
    };
    let text = match format {
        TableFormat::Json => comparison_report(&problem.document, &comparison),
        TableFormat::Markdown => comparison_to_markdown(&comparison),
        TableFormat::Csv => comparison_to_csv(&comparison),
    };
    let mut remarks = remarks(&comparison);
    if format == TableFormat::Csv {
        // a table of numbers has no place for sentences
        remarks.extend(comparison.notes.iter().cloned());
    }
    Ok(Answer { text, remarks, code: code(&comparison) })
}

/// Compares the designs of a document.
pub(super) fn compared(document: &Document, model: &Model) -> Result<Compared, Refusal> {
    let scenario = document.scenario(&model.system);
    let contenders = document.contenders();
    compare_designs(model, &scenario, &contenders, &document.tolerance, &Watch::none()).ok_or_else(cancelled)
}

/// Compares the designs of a document for a network that is too large to be written as one system.
pub(super) fn compared_network(document: &Document, network: &Network) -> Result<Compared, Refusal> {
    document.compare_network(network, &Watch::none()).ok_or_else(cancelled)
}

fn cancelled() -> Refusal {
    Refusal::refused("the comparison was cancelled")
}

/// What became of designs that do not exist or are not verified.
fn remarks(comparison: &Comparison) -> Vec<String> {
    let rows = comparison.rows.iter();
    let remark = |row: &crate::simulation::comparison::ComparisonRow| match &row.outcome {
        Ok(design) if design.verified => None,
        Ok(_) => Some(format!("{}: the design is not verified", row.name)),
        Err(error) => Some(format!("{}: {error}", row.name)),
    };
    rows.filter_map(remark).collect()
}

fn code(comparison: &Comparison) -> u8 {
    let outcomes = || comparison.rows.iter().map(|row| &row.outcome);
    if outcomes().any(|outcome| outcome.as_ref().is_err_and(crate::observer::DesignError::is_bad_input)) {
        BAD_INPUT
    } else if outcomes().all(|outcome| outcome.as_ref().is_ok_and(|design| design.verified)) {
        DONE
    } else {
        REFUSED
    }
}
