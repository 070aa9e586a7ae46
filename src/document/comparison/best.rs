//! Which value of a line is the best, where its values can be compared at all.

use super::TableCell;
use super::lines::digits;
use crate::simulation::comparison::ComparisonRow;

/// Which of two values is the better one.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Better {
    Smaller,
    Larger,
    /// The smaller one, among designs that estimate the same states: who estimates less errs in less.
    SmallerOfSameStates,
    /// The smaller one, among designs of one method: what is guaranteed means something else for each.
    SmallerOfSameMethod,
    Neither,
}

impl Better {
    /// Whether the values of two designs stand for the same quantity.
    fn comparable(self, a: &ComparisonRow, b: &ComparisonRow) -> bool {
        let estimated = |row: &ComparisonRow| row.outcome.as_ref().ok().map(|found| found.estimated.clone());
        match self {
            Self::Smaller | Self::Larger => true,
            Self::SmallerOfSameStates => estimated(a) == estimated(b),
            Self::SmallerOfSameMethod => a.method == b.method,
            Self::Neither => false,
        }
    }
}

/// Marks the best values of verified designs, unless all are equal as far as they are shown, or they cannot be compared.
pub(super) fn mark(cells: &mut [TableCell], rows: &[ComparisonRow], better: Better) {
    let verified = |row: &ComparisonRow| row.outcome.as_ref().is_ok_and(|design| design.verified);
    let rank = |value: f64| if better == Better::Larger { -value } else { value };
    let judged: Vec<(usize, f64)> = cells
        .iter()
        .zip(rows)
        .enumerate()
        .filter_map(|(k, (cell, row))| Some((k, rank(cell.value.filter(|_| verified(row))?))))
        .collect();
    let Some(&(first, _)) = judged.first() else { return };
    let Some(best) = judged.iter().map(|(_, value)| *value).reduce(f64::min) else { return };
    let shown = digits(best.abs());
    let is_best = |value: f64| value == best || digits(value.abs()) == shown;
    if judged.len() < 2
        || judged.iter().any(|(k, _)| !better.comparable(&rows[first], &rows[*k]))
        || judged.iter().all(|(_, value)| is_best(*value))
    {
        return;
    }
    for (k, value) in judged {
        cells[k].best = is_best(value);
    }
}
