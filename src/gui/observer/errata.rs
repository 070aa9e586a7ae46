//! Misprints of the chosen method's paper: a list, and each beside what it concerns.

use egui::{CollapsingHeader, RichText, Ui};

use super::super::{formula, theme};
use crate::document::paper_of;
use crate::paper::{Erratum, PrintedMatrix, Shown, errata};
use crate::session::Session;

/// What decides which misprints belong on the screen.
pub(super) fn of(session: &Session) -> Shown {
    let document = session.document();
    let design = &document.design;
    Shown { method: design.method, order: design.order, example: paper_of(&document.plant) }
}

/// Draws the list, folded at first.
pub(super) fn show(ui: &mut Ui, shown: Shown) {
    let Some(paper) = shown.paper() else { return };
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

/// Draws the misprints that concern a condition, a matrix of a subsystem, the equation or the guarantee, beside it: a
/// fold that is always visible, open where only the numbers of the paper's example are at stake.
pub(super) fn beside(ui: &mut Ui, shown: Shown, (what, subsystem): (&str, Option<usize>), name: &str) {
    fold(ui, &shown.beside(what, subsystem).collect::<Vec<_>>(), name, true);
}

/// Draws the misprints that concern a figure or the uncertainty of the paper's example, whichever design is chosen.
pub(in crate::gui) fn beside_example(ui: &mut Ui, session: &Session, what: &str, name: &str) {
    fold(ui, &of(session).beside_example(what).collect::<Vec<_>>(), name, false);
}

fn fold(ui: &mut Ui, found: &[&Erratum], name: &str, open: bool) {
    let title = match found.len() {
        0 => return,
        1 => "Misprint in the paper".to_owned(),
        count => format!("{count} misprints in the paper"),
    };
    let open = open && found.iter().all(|erratum| erratum.of_example());
    let title = RichText::new(title).small().color(theme::near(ui));
    let header = CollapsingHeader::new(title)
        .id_salt(("beside", name))
        .default_open(open)
        .show(ui, |ui| {
            for erratum in found {
                let Erratum { place, printed, correct, proof, .. } = erratum;
                formula::remark(
                    ui,
                    &format!("Misprint, {place}: printed \"{printed}\", correct \"{correct}\": {proof}"),
                );
            }
        })
        .header_response;
    ui.ctx().accesskit_node_builder(header.id, |node| node.set_label(format!("Misprints beside {name}")));
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
