//! What linear matrix inequalities gave: the guarantee, what it rests on, and how near it is to what is possible.

use egui::{RichText, Sense, Stroke, Ui, vec2};

use super::super::{
    formula,
    plot::{short, short_up},
    theme,
};
use super::errata;
use crate::observer::{LmiResult, show as show_number};
use crate::paper::{GUARANTEE, Shown};

/// Draws a card for each subsystem.
pub(super) fn show(ui: &mut Ui, shown: Shown, results: &[LmiResult], discrete: bool) {
    if results.is_empty() {
        return;
    }
    ui.label(RichText::new("Guarantee").strong());
    errata::beside(ui, shown, (GUARANTEE, None), "the guarantee");
    for (k, result) in results.iter().enumerate() {
        let fill = ui.visuals().faint_bg_color;
        egui::Frame::new().fill(fill).corner_radius(5.0).inner_margin(7.0).show(ui, |ui| {
            ui.set_min_width(ui.available_width());
            ui.push_id(("guarantee", k), |ui| {
                one(ui, result, (results.len() > 1).then_some(k));
                numbers(ui, result, discrete);
            });
        });
    }
}

fn one(ui: &mut Ui, result: &LmiResult, subsystem: Option<usize>) {
    let proved = result.certificate.proved;
    let colour = if proved { theme::good(ui) } else { theme::near(ui) };
    ui.horizontal_wrapped(|ui| {
        if !result.name.is_empty() {
            let name = RichText::new(&result.name).strong();
            ui.label(subsystem.map_or(name.clone(), |k| name.color(theme::series(ui, k))));
        }
        if let Some(gamma) = result.gamma {
            ui.label(RichText::new(format!("gamma {}", short_up(gamma))).strong().size(17.0));
        }
        let word = if proved { "proved" } else { "not proved" };
        ui.label(RichText::new(word).color(colour).strong());
    });
    bracket(ui, result);
    if !result.certificate.statement.is_empty() {
        ui.label(&result.certificate.statement);
    }
    if !result.certificate.note.is_empty() {
        formula::remark(ui, &result.certificate.note);
    }
    if proved && result.certificate.margin > 0.0 {
        formula::remark(
            ui,
            &format!("smallest eigenvalue of the inequality at least {:.2e}", result.certificate.margin),
        );
    }
}

fn numbers(ui: &mut Ui, result: &LmiResult, discrete: bool) {
    let mut rows: Vec<(String, String)> = Vec::new();
    let mut add = |name: &str, value: Option<f64>| {
        rows.extend(value.map(|value| (name.to_owned(), short(value))));
    };
    add("least gamma found", result.gamma_best);
    for (name, value) in &result.bounds {
        add(&format!("not below: {name}"), Some(*value));
    }
    let unit = if discrete { "rad/step" } else { "rad/s" };
    if let Some(norm) = &result.h_infinity {
        let at = if norm.frequency.is_finite() {
            format!("H-infinity norm, at {} {unit}", short(norm.frequency))
        } else {
            "H-infinity norm, at infinite frequency".to_owned()
        };
        add(&at, Some(norm.norm));
    }
    add("contraction of the output equation", result.contraction);
    add("norm of the free gain", Some(result.gain));
    add("limit of the decay by fixed modes", result.fastest_decay.filter(|limit| limit.is_finite()));
    if !result.fixed_modes.is_empty() {
        let modes: Vec<String> = result.fixed_modes.iter().map(|mode| show_number(*mode)).collect();
        rows.push(("fixed modes".to_owned(), modes.join(", ")));
    }
    rows.push(("iterations of the solver".to_owned(), result.iterations.to_string()));
    const LINE: f32 = 17.0;
    egui::Grid::new("numbers").num_columns(2).min_row_height(LINE).spacing([10.0, 1.0]).show(ui, |ui| {
        ui.spacing_mut().interact_size.y = LINE;
        for (name, value) in rows {
            formula::remark(ui, &name);
            ui.label(RichText::new(value).small());
            ui.end_row();
        }
    });
}

/// Lower bounds, the least gamma that was found and the guarantee on one line: how much the proof gives away.
fn bracket(ui: &mut Ui, result: &LmiResult) {
    let Some(gamma) = result.gamma.filter(|gamma| *gamma > 0.0) else { return };
    let norm = result.h_infinity.as_ref().filter(|_| result.bounds.is_empty()).map(|found| found.norm);
    let bounds: Vec<f64> = result.bounds.iter().map(|(_, value)| *value).chain(norm).collect();
    let below = bounds.iter().copied().chain(result.gamma_best);
    let below: Vec<f64> = below.filter(|value| value.is_finite() && *value > 0.0).collect();
    let Some(least) = below.iter().copied().reduce(f64::min) else { return };
    let low = 0.97 * least.min(gamma);
    let high = 1.03 * below.iter().copied().fold(gamma, f64::max);
    let (rect, response) =
        ui.allocate_exact_size(vec2(ui.available_width().min(360.0), 18.0), Sense::hover());
    let painter = ui.painter();
    let x = |value: f64| {
        #[expect(clippy::cast_possible_truncation, reason = "a position on the screen")]
        let share = ((value - low) / (high - low)).clamp(0.0, 1.0) as f32;
        rect.left() + share * rect.width()
    };
    painter.hline(rect.x_range(), rect.center().y, Stroke::new(1.0, theme::faint(ui)));
    let tick = |value: f64, colour, width| {
        painter.vline(x(value), rect.top() + 2.0..=rect.bottom() - 2.0, Stroke::new(width, colour));
    };
    for bound in bounds {
        tick(bound, theme::near(ui), 2.0);
    }
    if let Some(best) = result.gamma_best {
        tick(best, theme::faint(ui), 2.0);
    }
    painter.circle_filled(egui::pos2(x(gamma), rect.center().y), 5.0, theme::good(ui));
    let words: Vec<String> =
        result.bounds.iter().map(|(name, value)| format!("{name}: {}", short(*value))).collect();
    response.on_hover_text(format!(
        "dot: gamma {}\ngrey: the least that was found\namber: no observer's guarantee can lie below\n{}",
        short(gamma),
        words.join("\n")
    ));
}
