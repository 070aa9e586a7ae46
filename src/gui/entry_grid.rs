//! A small editable matrix that is not one of the system's: `R`, `G`, `F_L`.

use egui::{Align2, FontId, Id, Key, Rect, Sense, Ui, vec2};

use super::matrix_grid::{BRACKET, GAP, HEADER, NARROWEST, ROW_HEIGHT, brackets};
use super::text_field::text_field;
use super::{Widgets, theme};
use crate::document::matrix_from_text;
use crate::session::Draft;

/// What is drawn.
pub(super) struct EntryGrid<'a> {
    /// Its name, to which the accessible names `R[1, 2]` of the cells belong.
    pub name: &'a str,
    /// Rows and columns.
    pub shape: (usize, usize),
    /// What a cell shows.
    pub shown: &'a dyn Fn(usize, usize) -> String,
    /// What was typed into a cell and not understood.
    pub draft: &'a dyn Fn(usize, usize) -> Option<Draft>,
    /// Names of the columns.
    pub column: &'a dyn Fn(usize) -> String,
}

/// What a person did.
#[derive(Debug)]
pub(super) enum Typed {
    /// Typed into a cell.
    Cell(usize, usize, String),
    /// Pasted a block of numbers while a cell was active.
    Block {
        /// Row and column of the cell.
        at: (usize, usize),
        /// What was pasted.
        text: String,
    },
}

/// Draws the grid and what is not understood below it.
pub(super) fn show(ui: &mut Ui, widgets: &mut Widgets, grid: &EntryGrid<'_>) -> Option<Typed> {
    let mut typed = None;
    if let Some((at, text)) = pasted(ui, grid) {
        widgets.typing = None;
        typed = Some(Typed::Block { at, text });
    }
    let area = egui::ScrollArea::horizontal().id_salt(("entries", grid.name)).auto_shrink([true, true]);
    if let Some(cell) = area.show(ui, |ui| cells(ui, widgets, grid)).inner {
        typed = Some(cell);
    }
    for (row, column) in places(grid.shape) {
        if let Some(draft) = (grid.draft)(row, column) {
            let name = cell_name(grid, row, column);
            ui.colored_label(theme::bad(ui), format!("{name}: {}", draft.error));
        }
    }
    typed
}

fn places((rows, columns): (usize, usize)) -> impl Iterator<Item = (usize, usize)> {
    (0..rows).flat_map(move |row| (0..columns).map(move |column| (row, column)))
}

fn cell_name(grid: &EntryGrid<'_>, row: usize, column: usize) -> String {
    format!("{}[{}, {}]", grid.name, row + 1, column + 1)
}

fn id(grid: &EntryGrid<'_>, row: usize, column: usize) -> Id {
    Id::unique(("entry", grid.name, row, column))
}

fn cells(ui: &mut Ui, widgets: &mut Widgets, grid: &EntryGrid<'_>) -> Option<Typed> {
    let (rows, columns) = grid.shape;
    let fitting = (ui.available_width() - 2.0 * BRACKET) / columns.max(1) as f32 - GAP;
    let width = theme::CELL_WIDTH.min(fitting.max(NARROWEST));
    let size = vec2(
        2.0 * BRACKET + columns as f32 * (width + GAP) - GAP,
        HEADER + rows as f32 * (ROW_HEIGHT + GAP) - GAP + 2.0,
    );
    let (rect, _) = ui.allocate_exact_size(size, Sense::hover());
    for column in 0..columns {
        let x = rect.min.x + BRACKET + column as f32 * (width + GAP) + width / 2.0;
        let at = egui::pos2(x, rect.min.y + HEADER - 2.0);
        let font = FontId::proportional(10.5);
        ui.painter().text(at, Align2::CENTER_BOTTOM, (grid.column)(column), font, theme::faint(ui));
    }
    let body = Rect::from_min_max(rect.min + vec2(0.0, HEADER), rect.max);
    brackets(ui, body);
    let mut typed = None;
    for (row, column) in places(grid.shape) {
        let corner =
            body.min + vec2(BRACKET + column as f32 * (width + GAP), 1.0 + row as f32 * (ROW_HEIGHT + GAP));
        let place = Rect::from_min_size(corner, vec2(width, ROW_HEIGHT));
        let mut child = ui.new_child(
            egui::UiBuilder::new().max_rect(place).layout(egui::Layout::left_to_right(egui::Align::Center)),
        );
        let (shown, draft) = ((grid.shown)(row, column), (grid.draft)(row, column));
        if shown == "0" && draft.is_none() {
            child.visuals_mut().override_text_color = Some(theme::faint(ui).gamma_multiply(0.75));
        }
        let (id, name) = (id(grid, row, column), cell_name(grid, row, column));
        let text = text_field(&mut child, widgets, (id, &name), &shown, draft.as_ref(), width);
        step(ui, grid, (row, column), text.is_some());
        typed = text.map(|text| Typed::Cell(row, column, text)).or(typed);
    }
    typed
}

/// Enter, up and down lead to the neighbour in the same column.
fn step(ui: &Ui, grid: &EntryGrid<'_>, (row, column): (usize, usize), committed: bool) {
    let own = id(grid, row, column);
    if !ui.memory(|memory| memory.has_focus(own) || (committed && memory.had_focus_last_frame(own))) {
        return;
    }
    let (up, down) = ui.input(|input| {
        (input.key_pressed(Key::ArrowUp), input.key_pressed(Key::ArrowDown) || input.key_pressed(Key::Enter))
    });
    let next = if up { row.checked_sub(1) } else { (down && row + 1 < grid.shape.0).then_some(row + 1) };
    if let Some(next) = next {
        ui.memory_mut(|memory| memory.request_focus(id(grid, next, column)));
    }
}

/// Takes a pasted block while one of the cells is active, before its text field sees it.
fn pasted(ui: &Ui, grid: &EntryGrid<'_>) -> Option<((usize, usize), String)> {
    let active = ui.memory(egui::Memory::focused)?;
    let own = places(grid.shape).find(|(row, column)| id(grid, *row, *column) == active)?;
    Some((own, pasted_block(ui)?))
}

/// Takes a pasted block of more than one number out of the input.
pub(super) fn pasted_block(ui: &Ui) -> Option<String> {
    let mut pasted = None;
    ui.input_mut(|input| {
        input.events.retain(|event| match event {
            egui::Event::Paste(text) if matrix_from_text(text).is_ok_and(|m| m.entries.len() > 1) => {
                pasted = Some(text.clone());
                false
            }
            _ => true,
        });
    });
    pasted
}
