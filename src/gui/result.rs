//! The designed observer: badge, checks, gains under the paper's names.

use egui::{RichText, Ui};

use super::{formula, theme};
use crate::document::{MatrixSyntax, matrix_to_text};
use crate::observer::{Assessment, Design, NamedMatrix};
use crate::paper::errata;

/// Draws the badge of an assessment: what came of the design, in words.
pub(super) fn badge(ui: &mut Ui, assessment: &Assessment) {
    let (colour, word, sentence) = match &assessment.outcome {
        Ok(design) if design.verification.verified() => {
            (theme::good(ui), "verified", format!("{}: every check passed", design.title))
        }
        Ok(design) => {
            let failed: Vec<&str> = design.verification.failures().map(|check| check.name.as_str()).collect();
            (
                theme::near(ui),
                "not verified",
                format!("{}: the check of {} fails", design.title, failed.join(", ")),
            )
        }
        Err(error) if error.is_bad_input() => (theme::near(ui), "poles needed", error.to_string()),
        Err(error) => (theme::bad(ui), "does not exist", error.to_string()),
    };
    egui::Frame::new().stroke(egui::Stroke::new(1.5, colour)).corner_radius(5.0).inner_margin(7.0).show(
        ui,
        |ui| {
            ui.set_min_width(ui.available_width());
            ui.horizontal_wrapped(|ui| {
                ui.label(RichText::new(word).color(colour).strong());
                ui.label(sentence);
            });
        },
    );
}

/// Draws the gains, the checks and the notes of a design.
pub(super) fn show(ui: &mut Ui, design: &Design) {
    for note in &design.notes {
        ui.label(RichText::new(note).small().color(theme::near(ui)));
    }
    egui::CollapsingHeader::new("Gains").default_open(true).show(ui, |ui| {
        for matrix in &design.matrices {
            named_matrix(ui, matrix);
        }
        formula::remark(ui, "Observer: z' = F z + (L1 + L2) y + J u + T1 N f_hat, f_hat' = L3 (y - C x_hat), x_hat = M1 z + T2 y, where y = [-B1 u; y*] holds the algebraic equations and the measurements.");
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

fn named_matrix(ui: &mut Ui, matrix: &NamedMatrix) {
    ui.horizontal(|ui| {
        ui.label(RichText::new(&matrix.name).strong());
        formula::remark(ui, &matrix.meaning);
        ui.menu_button("copy", |ui| {
            for syntax in MatrixSyntax::ALL {
                if ui.button(syntax.name()).clicked() {
                    ui.ctx().copy_text(matrix_to_text(&matrix.value, syntax, &matrix.name));
                    ui.close();
                }
            }
        });
    });
    egui::ScrollArea::horizontal().id_salt(("named", &matrix.name)).auto_shrink([false, true]).show(
        ui,
        |ui| {
            egui::Grid::new(("named-grid", &matrix.name)).spacing([14.0, 2.0]).show(ui, |ui| {
                for row in matrix.value.row_iter() {
                    for value in row.iter() {
                        let text = RichText::new(digits(*value)).monospace();
                        let text = if value.abs() < 1e-12 { text.color(theme::faint(ui)) } else { text };
                        ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| ui.label(text));
                    }
                    ui.end_row();
                }
            });
        },
    );
    for erratum in errata("004").filter(|erratum| erratum.concerns == matrix.name) {
        formula::remark(
            ui,
            &format!(
                "Misprint, {}: printed \"{}\", correct \"{}\"",
                erratum.place, erratum.printed, erratum.correct
            ),
        );
    }
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
