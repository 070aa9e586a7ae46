//! The blocks of a partitioned system in its matrices: coloured cells, separators that can be dragged.

use egui::{Color32, CursorIcon, Id, Rect, Role, Sense, Stroke, Ui, vec2};

use super::matrix_grid::{BRACKET, GAP, HEADER, ROW_HEIGHT};
use super::{Output, theme};
use crate::document::Matrix;
use crate::session::{Cell, Edit, PartitionEdit, Share};
use crate::system::Subsystem;

/// Where the cells of a matrix lie.
#[derive(Clone, Copy)]
pub(super) struct Cells {
    /// With the names of the columns.
    pub rect: Rect,
    /// Without them.
    pub body: Rect,
    /// Width of a cell.
    pub width: f32,
}

/// The ground of a cell that belongs to a subsystem.
///
/// Blocks of one subsystem have its colour; a coupling has a faint shade of the subsystem that it comes from.
pub(super) fn fill(ui: &Ui, partition: &[Subsystem], cell: Cell) -> Option<Color32> {
    if partition.is_empty() {
        return None;
    }
    let row = owner(partition, cell.row, rows_of(cell.matrix))?;
    match cell.matrix {
        Matrix::E | Matrix::A | Matrix::C => {
            let column = owner(partition, cell.column, |s| s.states)?;
            Some(theme::block(ui, column, row != column))
        }
        Matrix::B | Matrix::D | Matrix::F => Some(theme::block(ui, row, true)),
    }
}

fn rows_of(matrix: Matrix) -> fn(&Subsystem) -> usize {
    match matrix {
        Matrix::C | Matrix::F => |s| s.outputs,
        Matrix::E | Matrix::A | Matrix::B | Matrix::D => |s| s.equations,
    }
}

fn owner(partition: &[Subsystem], index: usize, size: fn(&Subsystem) -> usize) -> Option<usize> {
    let mut end = 0;
    partition.iter().position(|subsystem| {
        end += size(subsystem);
        index < end
    })
}

/// The borders behind all subsystems but the last.
fn borders(partition: &[Subsystem], size: fn(&Subsystem) -> usize) -> Vec<usize> {
    let sums = partition.iter().scan(0, |sum, subsystem| {
        *sum += size(subsystem);
        Some(*sum)
    });
    sums.take(partition.len().saturating_sub(1)).collect()
}

/// Draws the separators; those between columns have a grip above the cells that can be dragged.
pub(super) fn separators(ui: &Ui, partition: &[Subsystem], matrix: Matrix, cells: Cells, out: &mut Output) {
    if partition.is_empty() {
        return;
    }
    let stroke = Stroke::new(1.5, ui.visuals().text_color().gamma_multiply(0.75));
    for border in borders(partition, rows_of(matrix)) {
        let y = cells.body.top() + 1.0 + border as f32 * (ROW_HEIGHT + GAP) - GAP / 2.0;
        ui.painter().hline(cells.body.x_range().shrink(3.0), y, stroke);
    }
    if !matches!(matrix, Matrix::E | Matrix::A | Matrix::C) {
        return;
    }
    for (k, border) in borders(partition, |s| s.states).into_iter().enumerate() {
        let x = cells.body.left() + BRACKET + border as f32 * (cells.width + GAP) - GAP / 2.0;
        ui.painter().vline(x, cells.body.y_range(), stroke);
        grip(ui, (matrix, k, border), x, cells, out);
    }
}

/// The handle of a separator between columns.
fn grip(ui: &Ui, (matrix, border, at): (Matrix, usize, usize), x: f32, cells: Cells, out: &mut Output) {
    let centre = egui::pos2(x, cells.rect.top() + HEADER / 2.0);
    let place = Rect::from_center_size(centre, vec2(18.0, HEADER + 6.0));
    let id = Id::unique(("separator", matrix.letter(), border));
    let response = ui.interact(place, id, Sense::drag());
    response.widget_info(|| {
        let name = format!("separator {} of {}", border + 1, matrix.letter());
        egui::WidgetInfo::labeled(Role::Splitter, true, name)
    });
    let active = response.hovered() || response.dragged();
    let colour = if active { theme::accent(ui) } else { ui.visuals().text_color().gamma_multiply(0.75) };
    let tip = centre + vec2(0.0, HEADER / 2.0);
    let wings = [tip + vec2(-4.5, -8.0), tip + vec2(4.5, -8.0), tip];
    ui.painter().add(egui::Shape::convex_polygon(wings.to_vec(), colour, Stroke::NONE));
    if active {
        ui.ctx().set_cursor_icon(CursorIcon::ResizeColumn);
    }
    let Some(pointer) =
        response.interact_pointer_pos().filter(|_| response.dragged() || response.drag_stopped())
    else {
        return;
    };
    let columns = (pointer.x - cells.body.left() - BRACKET) / (cells.width + GAP);
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a small count, not negative"
    )]
    let to = columns.round().max(0.0) as usize;
    let done = response.drag_stopped();
    if to != at || done {
        out.edit(Edit::Partition(PartitionEdit::Move { border, share: Share::States, to, done }));
    }
}
