//! `compare`: the chosen design beside those that are kept.

use super::load::{Problem, document};
use super::{Answer, BAD_INPUT, DONE, Files, REFUSED, Refusal, Source, TableFormat};
use crate::document::comparison::{comparison_to_csv, comparison_to_markdown};
use crate::document::report::comparison_report;
use crate::document::{Document, Subject};
use crate::numerics::Watch;
use crate::simulation::comparison::{Compared, Comparison, compare as compare_designs, compare_network};

/// The table of all designs.
pub(super) fn compare(source: &Source, format: TableFormat, files: &dyn Files) -> Result<Answer, Refusal> {
    let document = document(source, files)?;
    let comparison = table(&document)?;
    let text = match format {
        TableFormat::Json => comparison_report(&document, &comparison),
        TableFormat::Markdown => comparison_to_markdown(&comparison),
        TableFormat::Csv => comparison_to_csv(&comparison),
    };
    Ok(Answer { text, remarks: remarks(&comparison), code: code(&comparison) })
}

/// Compares the designs of a document; of a large network without ever expanding it.
fn table(document: &Document) -> Result<Comparison, Refusal> {
    let subject = document.subject().map_err(|error| Refusal::bad_input(error.to_string()))?;
    let found = match subject {
        Subject::Network(network) => {
            compare_network(&network, &document.contenders(), &document.tolerance, &Watch::none())
        }
        Subject::Model(model) => {
            let problem = Problem { document: document.clone(), model: *model };
            Some(compared(&problem)?.comparison)
        }
    };
    found.ok_or_else(|| Refusal::refused("the comparison was cancelled"))
}

/// Compares the designs of a document with a plant that is written as one system.
pub(super) fn compared(problem: &Problem) -> Result<Compared, Refusal> {
    let Problem { document, model } = problem;
    let scenario = document.scenario(&model.system);
    let contenders = document.contenders();
    compare_designs(model, &scenario, &contenders, &document.tolerance, &Watch::none())
        .ok_or_else(|| Refusal::refused("the comparison was cancelled"))
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
