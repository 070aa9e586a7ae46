//! Errata of the chosen method's paper: a list, and what is printed in the place of a matrix.

use egui::{CollapsingHeader, RichText, Ui};

use super::super::{formula, theme};
use crate::document::Document;
use crate::observer::Method;
use crate::paper::{Erratum, ErratumKind, PrintedMatrix, errata};

/// Draws the list, folded at first.
pub(super) fn show(ui: &mut Ui, method: Method) {
    let paper = method.paper();
    let count = errata(paper).count();
    if count == 0 {
        return;
    }
    ui.separator();
    let title = format!("Errata of paper {paper} ({count})");
    CollapsingHeader::new(RichText::new(title).strong()).id_salt(("errata", paper)).show(ui, |ui| {
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
    ui.horizontal_wrapped(|ui| {
        ui.label(RichText::new(erratum.place).strong());
        formula::remark(ui, erratum.kind.word());
    });
    let print = match erratum.kind {
        ErratumKind::NotUnique => theme::good(ui),
        ErratumKind::Omission => theme::near(ui),
        ErratumKind::Misprint | ErratumKind::Mistake => theme::bad(ui),
    };
    for (word, text, colour) in
        [("printed", erratum.printed, print), (erratum.kind.beside(), erratum.correct, theme::good(ui))]
    {
        ui.horizontal_wrapped(|ui| {
            ui.label(RichText::new(word).small().color(colour));
            ui.label(text);
        });
    }
    formula::remark(ui, erratum.proof);
}

/// Draws what concerns a condition or a matrix, beside it; what is in the numbers of the paper's example only where the
/// document is that example.
pub(super) fn beside(ui: &mut Ui, (paper, concerns): (&str, &str), document: &Document) {
    let belongs = |erratum: &&Erratum| {
        erratum.concerns == concerns && (!erratum.of_example() || document.is_printed_example(paper))
    };
    for erratum in errata(paper).filter(belongs) {
        let Erratum { kind, place, printed, correct, proof, .. } = erratum;
        let (word, beside) = (kind.word(), kind.beside());
        let capital: String = word.chars().take(1).flat_map(char::to_uppercase).collect();
        let rest: String = word.chars().skip(1).collect();
        formula::remark(
            ui,
            &format!("{capital}{rest}, {place}: printed \"{printed}\", {beside} \"{correct}\": {proof}"),
        );
    }
}

/// Draws a matrix as it is printed; entries that are wrong stand out.
pub(super) fn printed(ui: &mut Ui, known: &PrintedMatrix, digits: fn(f64) -> String) {
    ui.vertical(|ui| {
        match known.kind {
            ErratumKind::NotUnique => formula::remark(ui, "printed, right as well"),
            _ => formula::remark(ui, "printed"),
        }
        egui::Grid::new(("printed", known.name)).spacing([14.0, 2.0]).show(ui, |ui| {
            for (i, row) in known.printed.iter().enumerate() {
                for (j, value) in row.iter().enumerate() {
                    let text = RichText::new(digits(*value)).monospace();
                    let text = if known.is_wrong(i, j) {
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
