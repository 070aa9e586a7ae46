//! The comparison of a document's designs, as a screen shows it.

use serde::{Deserialize, Serialize};

use super::free_report::FreeReport;
use crate::document::{Document, Subject};
use crate::numerics::Watch;
use crate::paper::{ComparisonFigures, comparison as figures, network_comparison};
use crate::simulation::Memo;
use crate::simulation::comparison::{Comparison, compare_with};

/// Table and figures of a comparison.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct ComparisonView {
    /// The table, the chosen design first.
    pub comparison: Comparison,
    /// The common figures.
    pub figures: ComparisonFigures,
}

/// Compares the chosen design of a document with those that are kept; `None` when `watch` said stop.
pub(super) fn compared(
    document: &Document,
    memo: &mut Memo,
    watch: &Watch,
) -> Option<Result<Box<ComparisonView>, String>> {
    let contenders = document.contenders();
    let tolerance = &document.tolerance;
    let view = match document.subject() {
        Err(error) => return Some(Err(error.to_string())),
        Ok(Subject::Network(network)) => {
            let found = document.compare_network(&network, watch)?;
            ComparisonView { figures: network_comparison(&found, &network), comparison: found.comparison }
        }
        Ok(Subject::Model(model)) => {
            let scenario = document.scenario(&model.system);
            let found = compare_with(memo, (&model, &scenario), &contenders, tolerance, watch)?;
            let figures = figures(&found, &model.system);
            let Comparison { rows, linear_part, notes } = found.comparison;
            // what stands in the scenario's place is not said again
            let notes = FreeReport::without_own(FreeReport::new(document, &model).as_ref(), notes);
            ComparisonView { comparison: Comparison { rows, linear_part, notes }, figures }
        }
    };
    Some(Ok(Box::new(view)))
}
