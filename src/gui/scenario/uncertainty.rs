//! Amplitudes and frequencies of the uncertainty, entry by entry.

use egui::{Id, Ui};

use super::super::text_field::text_field;
use super::super::{Output, Widgets, theme};
use crate::document::EntryMatrix;
use crate::session::{Edit, Field, Session};

/// Grids beyond this size are edited in the document.
const LARGEST_GRID: usize = 12;

/// Draws one of the two grids.
pub(super) fn grid(
    ui: &mut Ui,
    session: &Session,
    widgets: &mut Widgets,
    (matrix, frequency): (&EntryMatrix, bool),
    out: &mut Output,
) {
    let what = if frequency { "frequency" } else { "amplitude" };
    ui.label(if frequency { "Frequencies in Hz" } else { "Relative amplitudes" });
    let (rows, columns) = matrix.shape();
    if rows.max(columns) > LARGEST_GRID {
        ui.colored_label(theme::faint(ui), format!("{rows} x {columns}: too large to be edited here"));
        return;
    }
    egui::Grid::new(("uncertainty", frequency)).spacing([3.0, 3.0]).show(ui, |ui| {
        for row in 0..rows {
            for column in 0..columns {
                let shown = matrix.entry(row, column).map(crate::document::Entry::shown).unwrap_or_default();
                let draft = session.draft(&Field::Uncertainty(row, column, frequency));
                let id = Id::unique(("uncertainty", row, column, frequency));
                let name = format!("{what}[{}, {}]", row + 1, column + 1);
                if let Some(text) = text_field(ui, widgets, (id, &name), &shown, draft, theme::CELL_WIDTH) {
                    out.edit(Edit::UncertaintyCell { row, column, frequency, text });
                }
            }
            ui.end_row();
        }
    });
    for row in 0..rows {
        for column in 0..columns {
            if let Some(draft) = session.draft(&Field::Uncertainty(row, column, frequency)) {
                let name = format!("{what}[{}, {}]", row + 1, column + 1);
                ui.colored_label(theme::bad(ui), format!("{name}: {}", draft.error));
            }
        }
    }
}
