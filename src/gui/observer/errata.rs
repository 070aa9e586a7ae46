//! Errata of the chosen method's paper: a list, and each beside what it concerns.

use egui::{CollapsingHeader, RichText, Ui};

use super::super::{formula, theme};
use crate::document::paper_of;
use crate::paper::{Erratum, ErratumKind, PrintedMatrix, Shown, errata};
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
    let [first, rest @ ..] = found else { return };
    let alike = rest.iter().all(|erratum| erratum.kind == first.kind);
    let title = match (rest.len(), alike) {
        (0, _) if first.kind == ErratumKind::NotUnique => "Print in the paper is not unique".to_owned(),
        (0, _) => format!("{} in the paper", capitalised(first.kind.word())),
        (more, true) if first.kind != ErratumKind::NotUnique => {
            format!("{} {}s in the paper", more + 1, first.kind.word())
        }
        (more, _) => format!("{} errata in the paper", more + 1),
    };
    let open = open && found.iter().all(|erratum| erratum.of_example());
    let title = RichText::new(title).small().color(theme::near(ui));
    let header = CollapsingHeader::new(title)
        .id_salt(("beside", name))
        .default_open(open)
        .show(ui, |ui| found.iter().for_each(|erratum| in_words(ui, erratum)))
        .header_response;
    ui.ctx().accesskit_node_builder(header.id, |node| node.set_label(format!("Errata beside {name}")));
}

fn in_words(ui: &mut Ui, erratum: &Erratum) {
    let Erratum { kind, place, printed, correct, proof, .. } = erratum;
    let (word, beside) = (capitalised(kind.word()), kind.beside());
    formula::remark(ui, &format!("{word}, {place}: printed \"{printed}\", {beside} \"{correct}\": {proof}"));
}

/// A word with a capital letter at its beginning.
fn capitalised(word: &str) -> String {
    let (first, rest) = word.split_at(word.chars().next().map_or(0, char::len_utf8));
    first.to_uppercase() + rest
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
