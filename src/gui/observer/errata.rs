//! Misprints of the chosen method's paper: a list, and what is printed in the place of a matrix.

use egui::{CollapsingHeader, RichText, Ui};

use super::super::{formula, theme};
use crate::document::Document;
use crate::observer::Method;
use crate::paper::{Erratum, PrintedMatrix, errata};

/// Draws the list, folded at first.
pub(super) fn show(ui: &mut Ui, method: Method) {
    let paper = method.paper();
    let count = errata(paper).count();
    if count == 0 {
        return;
    }
    ui.separator();
    let title = format!("Misprints of paper {paper} ({count})");
    CollapsingHeader::new(RichText::new(title).strong()).id_salt(("misprints", paper)).show(ui, |ui| {
        for erratum in errata(paper) {
            let fill = ui.visuals().faint_bg_color;
            egui::Frame::new().fill(fill).corner_radius(5.0).inner_margin(7.0).show(ui, |ui| {
                ui.set_min_width(ui.available_width());
                one(ui, erratum);
            });
        }
    });
}

fn one(ui: &mut Ui, erratum: &Erratum) {
    ui.label(RichText::new(erratum.place).strong());
    for (word, text, colour) in
        [("printed", erratum.printed, theme::bad(ui)), ("ours", erratum.correct, theme::good(ui))]
    {
        ui.horizontal_wrapped(|ui| {
            ui.label(RichText::new(word).small().color(colour));
            ui.label(text);
        });
    }
    formula::remark(ui, erratum.proof);
}

/// Draws the misprints that concern a condition or a matrix, beside it; those in the numbers of the paper's example only
/// where the document is that example.
pub(super) fn beside(ui: &mut Ui, (paper, concerns): (&str, &str), document: &Document) {
    let belongs = |erratum: &&Erratum| {
        erratum.concerns == concerns && (!erratum.of_example() || document.paper == paper)
    };
    for erratum in errata(paper).filter(belongs) {
        formula::remark(
            ui,
            &format!(
                "Misprint, {}: printed \"{}\", correct \"{}\": {}",
                erratum.place, erratum.printed, erratum.correct, erratum.proof
            ),
        );
    }
}

/// Draws a matrix as it is printed; entries that should be others stand out.
pub(super) fn printed(ui: &mut Ui, known: &PrintedMatrix, digits: fn(f64) -> String) {
    ui.vertical(|ui| {
        formula::remark(ui, "printed");
        egui::Grid::new(("printed", known.name)).spacing([14.0, 2.0]).show(ui, |ui| {
            for (i, row) in known.printed.iter().enumerate() {
                for (j, value) in row.iter().enumerate() {
                    let text = RichText::new(digits(*value)).monospace();
                    let text = if known.differs(i, j) {
                        text.color(theme::near(ui)).strong()
                    } else {
                        text.color(theme::faint(ui))
                    };
                    ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| ui.label(text));
                }
                ui.end_row();
            }
        });
    });
}
