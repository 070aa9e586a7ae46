//! A matrix as an editable grid: cells like a spreadsheet's, brackets like a book's.

use egui::{Align2, FontId, Id, Key, Rect, RichText, Sense, Stroke, Ui, vec2};

use super::text_field::text_field;
use super::{Output, Widgets, blocks, theme};
use crate::document::{DescriptorData, Matrix, MatrixSyntax, matrix_to_text};
use crate::session::{Cell, Edit, Field, Fill, Session, cell_name};

/// The widget id of a cell, the same in every frame.
pub fn cell_id(cell: Cell) -> Id {
    Id::unique(("cell", cell.matrix.letter(), cell.row, cell.column))
}

/// Draws two matrices, side by side where both fit; `F` only when there is something to feed through.
pub(super) fn show_pair(
    ui: &mut Ui,
    session: &Session,
    data: &DescriptorData,
    pair: [Matrix; 2],
    widgets: &mut Widgets,
    out: &mut Output,
) {
    let shown = |matrix: &Matrix| *matrix != Matrix::F || !data.matrix(*matrix).values().is_empty();
    let matrices: Vec<Matrix> = pair.into_iter().filter(shown).collect();
    let least = |matrix: &Matrix| {
        let columns = data.matrix(*matrix).shape().1.max(3) as f32;
        2.0 * BRACKET + columns * (NARROWEST + GAP)
    };
    let needed: f32 = matrices.iter().map(|matrix| least(matrix) + theme::BLOCK_GAP).sum();
    let room = ui.available_width();
    if matrices.len() < 2 || needed > room {
        for matrix in matrices {
            show(ui, session, data, matrix, widgets, out);
        }
        return;
    }
    ui.horizontal_top(|ui| {
        for matrix in matrices {
            ui.vertical(|ui| {
                ui.set_max_width(least(&matrix) / needed * room);
                show(ui, session, data, matrix, widgets, out);
            });
        }
    });
}

/// Draws one matrix with its name, its menu and its cells.
fn show(
    ui: &mut Ui,
    session: &Session,
    data: &DescriptorData,
    matrix: Matrix,
    widgets: &mut Widgets,
    out: &mut Output,
) {
    let sheet = Sheet { session, data };
    let (rows, columns) = data.matrix(matrix).shape();
    ui.horizontal(|ui| {
        ui.label(RichText::new(matrix.letter()).strong().size(16.0));
        let about = RichText::new(format!("{rows} x {columns}")).small().color(theme::faint(ui));
        ui.label(about).on_hover_text(matrix.meaning());
        menu(ui, data, matrix, out);
    });
    if rows == 0 || columns == 0 {
        let hint = match matrix {
            Matrix::C => "no outputs: add one above",
            Matrix::B => "no known inputs",
            Matrix::D => "no unknown inputs: add one above",
            Matrix::E | Matrix::A | Matrix::F => "empty",
        };
        ui.label(RichText::new(hint).small().color(theme::faint(ui)));
        return;
    }
    egui::ScrollArea::horizontal().id_salt(("grid", matrix.letter())).auto_shrink([true, true]).show(
        ui,
        |ui| {
            cells(ui, sheet, matrix, widgets, out);
        },
    );
}

/// Width below which a cell does not show a usual number.
pub(super) const NARROWEST: f32 = 38.0;
/// Height of a row.
pub(super) const ROW_HEIGHT: f32 = 24.0;
/// Distance between cells.
pub(super) const GAP: f32 = 3.0;
/// Room for the brackets on both sides.
pub(super) const BRACKET: f32 = 8.0;
/// Room for the names of the columns.
pub(super) const HEADER: f32 = 14.0;

/// The document's matrices and what was typed into their cells.
#[derive(Clone, Copy)]
struct Sheet<'a> {
    session: &'a Session,
    data: &'a DescriptorData,
}

fn cells(ui: &mut Ui, sheet: Sheet<'_>, matrix: Matrix, widgets: &mut Widgets, out: &mut Output) {
    let Sheet { data, .. } = sheet;
    let (rows, columns) = data.matrix(matrix).shape();
    let wanted = theme::CELL_WIDTH;
    let fitting = (ui.available_width() - 2.0 * BRACKET) / columns as f32 - GAP;
    let width = wanted.min(fitting.max(NARROWEST));
    let size = vec2(
        2.0 * BRACKET + columns as f32 * (width + GAP) - GAP,
        HEADER + rows as f32 * (ROW_HEIGHT + GAP) - GAP + 2.0,
    );
    let (rect, _) = ui.allocate_exact_size(size, Sense::hover());
    column_names(ui, rect, matrix, columns, width);
    let body = Rect::from_min_max(rect.min + vec2(0.0, HEADER), rect.max);
    brackets(ui, body);
    for row in 0..rows {
        for column in 0..columns {
            let cell = Cell { matrix, row, column };
            let corner = body.min
                + vec2(BRACKET + column as f32 * (width + GAP), 1.0 + row as f32 * (ROW_HEIGHT + GAP));
            let place = Rect::from_min_size(corner, vec2(width, ROW_HEIGHT));
            one_cell(ui, place, sheet, cell, widgets, out);
        }
    }
    blocks::separators(ui, &data.partition, matrix, blocks::Cells { rect, body, width }, out);
}

/// What the columns multiply: states, inputs or unknown inputs.
fn column_names(ui: &Ui, rect: Rect, matrix: Matrix, columns: usize, width: f32) {
    let letter = match matrix {
        Matrix::E => "x'",
        Matrix::A | Matrix::C => "x",
        Matrix::B => "u",
        Matrix::D | Matrix::F => "d",
    };
    for column in 0..columns {
        let x = rect.min.x + BRACKET + column as f32 * (width + GAP) + width / 2.0;
        let name =
            if matrix == Matrix::E { format!("x{}'", column + 1) } else { format!("{letter}{}", column + 1) };
        let font = FontId::proportional(10.5);
        ui.painter().text(
            egui::pos2(x, rect.min.y + HEADER - 2.0),
            Align2::CENTER_BOTTOM,
            name,
            font,
            theme::faint(ui),
        );
    }
}

/// The brackets of a matrix.
pub(super) fn brackets(ui: &Ui, rect: Rect) {
    let stroke = Stroke::new(1.3, ui.visuals().text_color());
    let painter = ui.painter();
    for (x, tip) in [(rect.left() + 2.0, 4.0), (rect.right() - 2.0, -4.0)] {
        painter.vline(x, rect.y_range(), stroke);
        for y in [rect.top(), rect.bottom()] {
            painter.line_segment([egui::pos2(x, y), egui::pos2(x + tip, y)], stroke);
        }
    }
}

fn one_cell(ui: &mut Ui, place: Rect, sheet: Sheet<'_>, cell: Cell, widgets: &mut Widgets, out: &mut Output) {
    let Sheet { session, data } = sheet;
    let Some(entry) = data.matrix(cell.matrix).entry(cell.row, cell.column) else { return };
    let draft = session.draft(&Field::Cell(cell));
    let id = cell_id(cell);
    let dimmed = entry.value == 0.0 && entry.text.is_none() && draft.is_none();
    let mut child = ui.new_child(
        egui::UiBuilder::new().max_rect(place).layout(egui::Layout::left_to_right(egui::Align::Center)),
    );
    if dimmed {
        child.visuals_mut().override_text_color = Some(theme::faint(ui).gamma_multiply(0.75));
    }
    if let Some(fill) = blocks::fill(ui, &data.partition, cell) {
        child.visuals_mut().text_edit_bg_color = Some(fill);
    }
    let name = cell_name(cell);
    let typed = text_field(&mut child, widgets, (id, &name), &entry.shown(), draft, place.width());
    if child.memory(|memory| memory.has_focus(id)) {
        widgets.active_cell = Some(cell);
    }
    let moved = neighbour(ui, data, cell, id, typed.is_some());
    if let Some(next) = moved {
        ui.memory_mut(|memory| memory.request_focus(cell_id(next)));
    }
    if let Some(text) = typed {
        out.edit(Edit::Cell { cell, text });
    }
    if let Some(draft) = draft {
        child.interact(place, id.with("hint"), Sense::hover()).on_hover_text(&draft.error);
    }
}

/// The cell that Enter, up or down lead to from the focused one.
fn neighbour(ui: &Ui, data: &DescriptorData, cell: Cell, id: Id, committed: bool) -> Option<Cell> {
    let focused = ui.memory(|memory| memory.has_focus(id) || (committed && memory.had_focus_last_frame(id)));
    if !focused {
        return None;
    }
    let (rows, _) = data.matrix(cell.matrix).shape();
    let (up, down) = ui.input(|input| {
        (input.key_pressed(Key::ArrowUp), input.key_pressed(Key::ArrowDown) || input.key_pressed(Key::Enter))
    });
    if up && cell.row > 0 {
        return Some(Cell { row: cell.row - 1, ..cell });
    }
    (down && cell.row + 1 < rows).then(|| Cell { row: cell.row + 1, ..cell })
}

fn menu(ui: &mut Ui, data: &DescriptorData, matrix: Matrix, out: &mut Output) {
    let button = ui.menu_button("...", |ui| {
        for (name, fill) in [
            ("Clear", Fill::Zero),
            ("Identity", Fill::Identity),
            ("Random whole numbers", Fill::Random { seed: 1 + matrix as u64 }),
            ("Double", Fill::Scaled(2.0)),
            ("Halve", Fill::Scaled(0.5)),
        ] {
            if ui.button(name).clicked() {
                out.edit(Edit::Fill { matrix, fill });
                ui.close();
            }
        }
        ui.separator();
        ui.menu_button("Copy as", |ui| {
            for syntax in MatrixSyntax::ALL {
                if ui.button(syntax.name()).clicked() {
                    ui.ctx().copy_text(matrix_to_text(
                        &data.matrix(matrix).values(),
                        syntax,
                        matrix.letter(),
                    ));
                    ui.close();
                }
            }
        });
        ui.label(
            RichText::new("Paste a whole matrix into any cell:\nMATLAB, NumPy, Julia, LaTeX, Excel").small(),
        );
    });
    button.response.ctx.accesskit_node_builder(button.response.id, |node| {
        node.set_label(format!("Menu of {}", matrix.letter()));
    });
}
