//! Formulas drawn as mathematics: block matrices in brackets between running text.

use egui::{Align, Layout, RichText, Stroke, Ui, vec2};

use super::theme;
use crate::observer::{Formula, FormulaPart};

const LINE: f32 = 17.0;

/// Draws a formula on one line, wrapping between its parts where the panel is narrow.
pub(super) fn show(ui: &mut Ui, formula: &Formula) {
    if formula.0.is_empty() {
        return;
    }
    let rows = formula.0.iter().map(|part| match part {
        FormulaPart::Text(_) => 1,
        FormulaPart::Matrix(rows) => rows.len(),
    });
    let height = rows.max().unwrap_or(1) as f32 * LINE + 8.0;
    let layout = Layout::left_to_right(Align::Center).with_main_wrap(true);
    let response = ui.allocate_ui_with_layout(vec2(ui.available_width(), height), layout, |ui| {
        ui.spacing_mut().item_spacing = vec2(5.0, 4.0);
        ui.set_row_height(height);
        for part in &formula.0 {
            match part {
                FormulaPart::Text(text) => {
                    ui.label(text);
                }
                FormulaPart::Matrix(rows) => block(ui, rows),
            }
        }
    });
    response
        .response
        .ctx
        .accesskit_node_builder(response.response.id, |node| node.set_label(formula.plain()));
}

fn block(ui: &mut Ui, rows: &[Vec<String>]) {
    let font = egui::TextStyle::Body.resolve(ui.style());
    let columns = rows.iter().map(Vec::len).max().unwrap_or(0);
    let colour = ui.visuals().text_color();
    let galley = |text: &str| ui.painter().layout_no_wrap(text.to_owned(), font.clone(), colour);
    let cells: Vec<Vec<_>> = rows.iter().map(|row| row.iter().map(|text| galley(text)).collect()).collect();
    let width_of =
        |j: usize| cells.iter().filter_map(|row| row.get(j)).map(|g| g.size().x).fold(0.0, f32::max);
    let widths: Vec<f32> = (0..columns).map(width_of).collect();
    const GAP: f32 = 9.0;
    const MARGIN: f32 = 7.0;
    let width = widths.iter().sum::<f32>() + GAP * columns.saturating_sub(1) as f32 + 2.0 * MARGIN;
    let height = rows.len() as f32 * LINE + 2.0;
    let (rect, _) = ui.allocate_exact_size(vec2(width, height), egui::Sense::hover());
    let painter = ui.painter();
    let stroke = Stroke::new(1.2, colour);
    for (x, tip) in [(rect.left() + 1.0, 4.0), (rect.right() - 1.0, -4.0)] {
        painter.vline(x, rect.y_range(), stroke);
        painter.hline(if tip > 0.0 { x..=x + tip } else { x + tip..=x }, rect.top(), stroke);
        painter.hline(if tip > 0.0 { x..=x + tip } else { x + tip..=x }, rect.bottom(), stroke);
    }
    let mut y = rect.top() + 1.0;
    for row in cells {
        let mut x = rect.left() + MARGIN;
        for (j, cell) in row.into_iter().enumerate() {
            let offset = vec2((widths[j] - cell.size().x) / 2.0, (LINE - cell.size().y) / 2.0);
            painter.galley(egui::pos2(x, y) + offset, cell, colour);
            x += widths[j] + GAP;
        }
        y += LINE;
    }
}

/// A faint line of small text.
pub(super) fn remark(ui: &mut Ui, text: &str) {
    ui.label(RichText::new(text).small().color(theme::faint(ui)));
}
