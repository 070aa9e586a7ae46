//! The matrices of a network as grids, as many side by side as fit.

use egui::{RichText, Ui};

use super::super::entry_grid::{EntryGrid, Typed, show as grid};
use super::super::matrix_grid::{BRACKET, GAP, NARROWEST, cell_text};
use super::super::{Output, Widgets, formula, theme};
use crate::document::{MatrixSyntax, NetworkData, NetworkMatrix, matrix_to_text};
use crate::session::{Edit, Field, Measure, NetworkCell, NetworkEdit, Session};

/// Draws some of the matrices.
pub(super) fn show(
    ui: &mut Ui,
    session: &Session,
    data: &NetworkData,
    matrices: &[NetworkMatrix],
    widgets: &mut Widgets,
    out: &mut Output,
) {
    let room = ui.available_width();
    let least = |matrix: &NetworkMatrix| {
        // name, size and menu stand above even a single column
        const HEAD: f32 = 86.0;
        let columns = data.shape(*matrix).1 as f32;
        (2.0 * BRACKET + columns * (NARROWEST + GAP)).max(HEAD) + theme::ITEM_GAP
    };
    let mut rest = matrices;
    while !rest.is_empty() {
        let widths = rest.iter().scan(0.0, |sum, matrix| {
            *sum += least(matrix);
            Some(*sum)
        });
        let fitting = widths.take_while(|width| *width <= room).count().max(1);
        let (line, behind) = rest.split_at(fitting);
        rest = behind;
        if let [alone] = line {
            one(ui, session, data, *alone, widgets, out);
            continue;
        }
        let needed: f32 = line.iter().map(least).sum();
        ui.horizontal_top(|ui| {
            for matrix in line {
                ui.vertical(|ui| {
                    ui.set_max_width(least(matrix) / needed * room - theme::ITEM_GAP);
                    one(ui, session, data, *matrix, widgets, out);
                });
            }
        });
    }
}

/// Draws one matrix with its name, its menu and its cells.
fn one(
    ui: &mut Ui,
    session: &Session,
    data: &NetworkData,
    matrix: NetworkMatrix,
    widgets: &mut Widgets,
    out: &mut Output,
) {
    head(ui, data, matrix, widgets.network.subsystem, out);
    let name = matrix.letter();
    let at = |row, column| NetworkCell { matrix, row, column };
    let shown =
        |row, column| data.entry(matrix, row, column).map_or_else(String::new, |entry| cell_text(&entry));
    let draft = |row, column| session.draft(&Field::Network(at(row, column))).cloned();
    let column = |column: usize| match matrix {
        NetworkMatrix::Input => format!("u{}", column + 1),
        NetworkMatrix::Gamma | NetworkMatrix::Psi => (column + 1).to_string(),
        _ => format!("x{}", column + 1),
    };
    let spec = EntryGrid { name, shape: data.shape(matrix), shown: &shown, draft: &draft, column: &column };
    match grid(ui, widgets, &spec) {
        Some(Typed::Cell(row, column, text)) => {
            out.edit(Edit::Network(NetworkEdit::Cell { cell: at(row, column), text }));
        }
        Some(Typed::Block { at: (row, column), text }) => {
            out.edit(Edit::Network(NetworkEdit::Paste { cell: at(row, column), text }));
        }
        None => {}
    }
}

/// Name, size and menu of a matrix.
pub(super) fn head(ui: &mut Ui, data: &NetworkData, matrix: NetworkMatrix, chosen: usize, out: &mut Output) {
    let (rows, columns) = data.shape(matrix);
    ui.horizontal(|ui| {
        ui.label(RichText::new(matrix.letter()).strong().size(16.0)).on_hover_text(matrix.meaning());
        formula::remark(ui, &format!("{rows} x {columns}"));
        menu(ui, data, matrix, chosen, out);
    });
}

fn menu(ui: &mut Ui, data: &NetworkData, matrix: NetworkMatrix, chosen: usize, out: &mut Output) {
    let button = ui.menu_button("...", |ui| {
        let mut item = |text: String, measure: Measure| {
            if ui.button(text).clicked() {
                out.edit(Edit::Network(NetworkEdit::Measure(measure)));
                ui.close();
            }
        };
        match matrix {
            NetworkMatrix::Psi => {
                let (number, subsystem) = (chosen + 1, chosen);
                item(format!("Only what subsystem {number} receives"), Measure::ReceivedOnly { subsystem });
                item(format!("Also what subsystem {number} receives"), Measure::Received { subsystem });
            }
            NetworkMatrix::GlobalOutput => {
                item("As c".to_owned(), Measure::CouplingOutputOnly);
                item("Also the rows of c".to_owned(), Measure::CouplingOutput);
            }
            _ => {}
        }
        copy(ui, data, matrix);
        ui.label(
            RichText::new("Paste a whole matrix into any cell:\nMATLAB, NumPy, Julia, LaTeX, Excel").small(),
        );
    });
    button.response.ctx.accesskit_node_builder(button.response.id, |node| {
        node.set_label(format!("Menu of {}", matrix.letter()));
    });
}

/// Copies a matrix that is not too large to be written out.
fn copy(ui: &mut Ui, data: &NetworkData, matrix: NetworkMatrix) {
    const LARGEST: usize = 200;
    let (rows, columns) = data.shape(matrix);
    if rows.max(columns) > LARGEST {
        return;
    }
    ui.menu_button("Copy as", |ui| {
        for syntax in MatrixSyntax::ALL {
            if ui.button(syntax.name()).clicked() {
                let values = nalgebra::DMatrix::from_fn(rows, columns, |i, j| {
                    data.entry(matrix, i, j).map_or(0.0, |entry| entry.value)
                });
                ui.ctx().copy_text(matrix_to_text(&values, syntax, matrix.letter()));
                ui.close();
            }
        }
    });
}
