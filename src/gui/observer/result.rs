//! The designed observer: badge, checks, gains under the paper's names.

use egui::{RichText, Ui};

use super::super::{formula, theme};
use super::errata;
use crate::document::{Document, MatrixSyntax, PlantData, matrix_to_text};
use crate::observer::{Design, Method, NamedMatrix};
use crate::paper::{OBSERVER, Shown, printed};
use crate::system::TimeDomain;

/// Draws the gains, the checks and the notes of a design.
pub(super) fn show(ui: &mut Ui, document: &Document, shown: Shown, design: &Design) {
    let discrete =
        matches!(&document.plant, PlantData::Descriptor(data) if data.time == TimeDomain::Discrete);
    for note in &design.notes {
        ui.label(RichText::new(note).small().color(theme::near(ui)));
    }
    egui::CollapsingHeader::new("Gains").default_open(true).show(ui, |ui| {
        for matrix in &design.matrices {
            named_matrix(ui, document, shown, matrix);
        }
        formula::remark(ui, equations(shown.method, discrete));
        errata::beside(ui, shown, (OBSERVER, None), "the observer");
    });
    egui::CollapsingHeader::new("Verification").default_open(false).show(ui, |ui| {
        for check in &design.verification.checks {
            let (colour, word) =
                if check.passed() { (theme::good(ui), "passed") } else { (theme::bad(ui), "failed") };
            ui.horizontal_wrapped(|ui| {
                ui.label(RichText::new(word).color(colour).strong());
                ui.label(&check.name);
            });
            formula::remark(
                ui,
                &format!("{}; found {:.2e}, limit {:.0e}", check.statement, check.value, check.limit),
            );
        }
        for skipped in &design.verification.skipped {
            formula::remark(ui, &format!("not checked: {skipped}"));
        }
    });
}

/// The observer in the letters of its paper.
fn equations(method: Method, discrete: bool) -> &'static str {
    match method {
        Method::Proportional | Method::ProportionalIntegral if discrete => {
            "Observer: z[k+1] = F z + (L1 + L2) y + J u + T1 N f_hat, f_hat[k+1] = f_hat + L3 (y - C x_hat), \
             x_hat = M1 z + T2 y, where y = [-B1 u; y*] holds the algebraic equations and the measurements."
        }
        Method::Proportional | Method::ProportionalIntegral => {
            "Observer: z' = F z + (L1 + L2) y + J u + T1 N f_hat, f_hat' = L3 (y - C x_hat), x_hat = M1 z + T2 y, where \
             y = [-B1 u; y*] holds the algebraic equations and the measurements."
        }
        Method::InputDecoupled if discrete => {
            "Observer: z[k+1] = H z + J1 u + J2 y, x_hat = K z + T1 u + T2 y, d_hat = G z + Q1 u + Q2 y; the errors are \
             K H^k e0 and G H^k e0 whatever the unknown input does."
        }
        Method::InputDecoupled => {
            "Observer: z' = H z + J1 u + J2 y, x_hat = K z + T1 u + T2 y, d_hat = G z + Q1 u + Q2 y; the errors are K e^(H t) e0 \
             and G e^(H t) e0 whatever the unknown input does."
        }
        Method::Hierarchical => {
            "Global observer: z_hat' = (alpha_z - H gamma_z) z_hat + H y_G; each local one: x_hat_i' = (a - h_i c_L) x_hat_i + \
             beta_i z_hat + h_i y_i."
        }
        Method::HInfinity => {
            "Observer: z' = N z + J y + H u + T G f(x_hat), x_hat = P z - Q Phi B u + F y - Q Phi G f(x_hat): the estimate \
             stands on both sides and is found by iteration, which converges by the guarantee."
        }
        Method::Decentralized => {
            "Each subsystem: xi' = N xi + M u + J z, x_hat = P xi - Q Phi B u + F z (in discrete time xi[k+1]), where z are \
             its own outputs."
        }
    }
}

/// Rows and columns up to which a matrix is shown at once.
const SHOWN: usize = 12;
/// Rows and columns of a larger one that are shown when a person opens it.
const OPENED: usize = 40;

fn named_matrix(ui: &mut Ui, document: &Document, shown: Shown, matrix: &NamedMatrix) {
    let (rows, columns) = matrix.value.shape();
    let large = rows.max(columns) > SHOWN;
    ui.horizontal(|ui| {
        ui.label(RichText::new(&matrix.name).strong());
        let size = if large { format!("{rows} x {columns}: ") } else { String::new() };
        formula::remark(ui, &format!("{size}{}", matrix.meaning));
        ui.menu_button("copy", |ui| {
            for syntax in MatrixSyntax::ALL {
                if ui.button(syntax.name()).clicked() {
                    ui.ctx().copy_text(matrix_to_text(&matrix.value, syntax, &matrix.name));
                    ui.close();
                }
            }
        });
    });
    if large {
        folded_entries(ui, matrix);
    } else {
        shown_entries(ui, shown, matrix);
    }
    let place = (letter(matrix), subsystem(document, matrix));
    errata::beside(ui, shown, place, &matrix.name);
}

/// A local observer's matrix carries the name of its subsystem, `N (first)`: its letter.
fn letter(matrix: &NamedMatrix) -> &str {
    matrix.name.split(" (").next().unwrap_or_default()
}

/// The number of the subsystem whose name a matrix carries, from one.
fn subsystem(document: &Document, matrix: &NamedMatrix) -> Option<usize> {
    let PlantData::Descriptor(data) = &document.plant else { return None };
    let (_, name) = matrix.name.strip_suffix(')')?.split_once(" (")?;
    data.partition.iter().position(|subsystem| subsystem.name == name).map(|k| k + 1)
}

fn folded_entries(ui: &mut Ui, matrix: &NamedMatrix) {
    egui::CollapsingHeader::new(format!("entries of {}", matrix.name))
        .id_salt(("named-large", &matrix.name))
        .default_open(false)
        .show(ui, |ui| {
            egui::ScrollArea::horizontal()
                .id_salt(("named", &matrix.name))
                .auto_shrink([false, true])
                .show(ui, |ui| entries(ui, matrix));
        });
}

fn shown_entries(ui: &mut Ui, shown: Shown, matrix: &NamedMatrix) {
    let known = shown
        .example
        .filter(|paper| *paper == shown.method.paper())
        .and_then(|paper| printed(paper, letter(matrix), &matrix.value));
    egui::ScrollArea::horizontal().id_salt(("named", &matrix.name)).auto_shrink([false, true]).show(
        ui,
        |ui| match known {
            None => entries(ui, matrix),
            Some(known) => {
                ui.horizontal_top(|ui| {
                    errata::printed(ui, known, digits);
                    // a separator would be as tall as the window
                    ui.add_space(theme::BLOCK_GAP);
                    ui.vertical(|ui| {
                        formula::remark(ui, "ours");
                        entries(ui, matrix);
                    });
                });
            }
        },
    );
}

/// The entries of a matrix, of a very large one the first.
fn entries(ui: &mut Ui, matrix: &NamedMatrix) {
    let (rows, columns) = matrix.value.shape();
    if rows.max(columns) > OPENED {
        formula::remark(ui, &format!("the first {OPENED} rows and columns; copying takes all"));
    }
    egui::Grid::new(("named-grid", &matrix.name)).spacing([14.0, 2.0]).show(ui, |ui| {
        for row in matrix.value.row_iter().take(OPENED) {
            for value in row.iter().take(OPENED) {
                let text = RichText::new(digits(*value)).monospace();
                let text = if value.abs() < 1e-12 { text.color(theme::faint(ui)) } else { text };
                ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| ui.label(text));
            }
            ui.end_row();
        }
    });
}

/// Four decimals, or powers of ten where they would not show the number.
fn digits(x: f64) -> String {
    const NOTHING: f64 = 1e-12;
    if x.abs() < NOTHING {
        return "0".to_owned();
    }
    if x.abs() >= 1e5 || x.abs() < 1e-3 {
        return format!("{x:.3e}");
    }
    let fixed = format!("{x:.4}");
    fixed.trim_end_matches('0').trim_end_matches('.').to_owned()
}
