//! The existence conditions, live: formula, numbers, singular values, and why.

use egui::{RichText, Sense, Stroke, Ui, vec2};

use super::super::{Output, Widgets, formula, network, theme};
use super::errata;
use crate::numerics::RankDecision;
use crate::observer::{Condition, Evidence, SetEvidence, Verdict, Witness, show as show_number};
use crate::paper::Shown;
use crate::session::Edit;

/// Draws all conditions of an assessment.
pub(super) fn show(
    ui: &mut Ui,
    shown: Shown,
    conditions: &[Condition],
    widgets: &mut Widgets,
    out: &mut Output,
) {
    let mut explained = false;
    for condition in conditions {
        if condition.id.starts_with("003-T2") && !explained {
            explained = true;
            formula::remark(
                ui,
                "Theorem 2 explains the verdict on the whole; the test of its modes decides.",
            );
        }
        let fill = ui.visuals().faint_bg_color;
        egui::Frame::new().fill(fill).corner_radius(5.0).inner_margin(7.0).show(ui, |ui| {
            ui.set_min_width(ui.available_width());
            one(ui, shown, condition, widgets, out);
        });
    }
}

fn one(ui: &mut Ui, shown: Shown, condition: &Condition, widgets: &mut Widgets, out: &mut Output) {
    let colour = theme::verdict(ui, condition.verdict);
    ui.horizontal_wrapped(|ui| {
        lamp(ui, condition.verdict);
        ui.label(RichText::new(&condition.label).strong());
        ui.label(&condition.name);
        let word = match condition.verdict {
            Verdict::Undecided if condition.needed => "not decided",
            verdict => theme::verdict_word(verdict),
        };
        ui.label(RichText::new(word).color(colour).strong());
        if !condition.needed {
            ui.label(RichText::new("not needed here").small().color(theme::faint(ui)));
        }
        let open = widgets.open_condition.as_deref() == Some(condition.id.as_str());
        let response = ui.selectable_label(open, "why");
        response
            .ctx
            .accesskit_node_builder(response.id, |node| node.set_label(format!("Why {}", condition.label)));
        if response.clicked() {
            widgets.open_condition = if open { None } else { Some(condition.id.clone()) };
        }
    });
    formula::show(ui, &condition.formula);
    formula::remark(ui, &condition.summary);
    if let Some(Evidence::Rank { decision, .. }) = condition.evidence.first() {
        singular_values(ui, decision);
    }
    if widgets.open_condition.as_deref() == Some(condition.id.as_str()) || condition.verdict == Verdict::Fails
    {
        why(ui, condition, out);
    }
    errata::beside(ui, shown, (&condition.id, None), &condition.id);
}

/// A dot whose shape says the same as its colour: full, ring or cross.
fn lamp(ui: &mut Ui, verdict: Verdict) {
    let (rect, _) = ui.allocate_exact_size(vec2(12.0, 12.0), Sense::hover());
    let (centre, painter) = (rect.center(), ui.painter());
    let colour = theme::verdict(ui, verdict);
    let stroke = Stroke::new(2.0, colour);
    match verdict {
        Verdict::Holds => {
            painter.circle_filled(centre, 5.0, colour);
        }
        Verdict::Fragile | Verdict::Undecided => {
            painter.circle_stroke(centre, 4.5, stroke);
        }
        Verdict::Fails => {
            for tip in [vec2(4.0, 4.0), vec2(4.0, -4.0)] {
                painter.line_segment([centre - tip, centre + tip], stroke);
            }
        }
    }
}

fn why(ui: &mut Ui, condition: &Condition, out: &mut Output) {
    if let Some(witness) = &condition.witness {
        ui.label(RichText::new(unseen(witness)).color(theme::bad(ui)));
        let entries: Vec<String> = witness
            .coordinates
            .iter()
            .zip(&witness.direction)
            .filter(|(_, z)| z.norm() > 1e-9)
            .map(|(name, z)| format!("{name} = {}", show_number(*z)))
            .collect();
        formula::remark(ui, &format!("direction: {}", entries.join(", ")));
    }
    for remedy in &condition.remedies {
        ui.horizontal_wrapped(|ui| {
            ui.label(format!("What would mend it: {remedy}"));
            if let Some(state) = sensor(remedy)
                && ui.button(format!("Add a sensor of x{}", state + 1)).clicked()
            {
                out.edit(Edit::AddSensor { state });
            }
            if let Some((text, edit)) = network::mend::button(&condition.id, remedy)
                && ui.button(text).clicked()
            {
                out.edit(edit);
            }
        });
    }
    // where observability is asked, it does not matter whether a mode decays
    let observability = condition.id.starts_with("003-T2") || condition.id.starts_with("003-C1");
    for evidence in &condition.evidence {
        evidence_row(ui, evidence, observability);
    }
    formula::remark(ui, &condition.source);
}

/// What a witness shows, in a sentence.
fn unseen(witness: &Witness) -> String {
    let names = witness.main_coordinates().join(", ");
    let starts = |word: &str| witness.main_coordinates().iter().any(|name| name.starts_with(word));
    match witness.s {
        Some(s) if starts("coupling direction") => format!(
            "The eigenvalue lambda = {} of the coupling, along {names}, is seen by no global output.",
            show_number(s)
        ),
        Some(s) if starts("shown state") => {
            format!("The mode s = {} along {names} is driven by no coupling input.", show_number(s))
        }
        Some(s) => format!("The mode s = {} along {names} is seen by no sensor.", show_number(s)),
        None if starts("equation") => {
            let of = if names.contains(", ") { "A combination of " } else { "The " };
            format!("{of}{names} determines neither an algebraic state nor an unknown input.")
        }
        None if starts("d") => format!("A sudden change along {names} is not seen at once by any sensor."),
        None => format!("An impulse along {names} is seen by no sensor."),
    }
}

/// The state that a remedy proposes to measure, from zero.
fn sensor(remedy: &str) -> Option<usize> {
    let number = remedy.strip_prefix("measure x")?.split(':').next()?;
    number.parse::<usize>().ok()?.checked_sub(1)
}

fn evidence_row(ui: &mut Ui, evidence: &Evidence, observability: bool) {
    match evidence {
        Evidence::Rank { of, decision, required } => {
            formula::remark(
                ui,
                &format!(
                    "{of}: rank {} of {required} needed; threshold {:.1e}, gap {}",
                    decision.rank,
                    decision.threshold,
                    gap(decision.gap)
                ),
            );
            singular_values(ui, decision);
        }
        Evidence::Points { of, points } => {
            let none = if points.is_empty() { " no finite point loses rank" } else { "" };
            formula::remark(ui, &format!("{of}:{none}"));
            for point in points {
                let state = match (point.loses_rank, point.stable) {
                    (false, _) => "seen",
                    (true, _) if observability => "not seen",
                    (true, true) => "not seen, but stable",
                    (true, false) => "not seen and not stable",
                };
                formula::remark(
                    ui,
                    &format!("s = {}: {state}, distance {:.1e}", show_number(point.s), point.distance),
                );
            }
        }
        Evidence::Sets { of, names, sets } => {
            formula::remark(ui, &format!("{of}:"));
            for set in sets {
                formula::remark(ui, &set_line(names, set));
            }
        }
    }
}

/// One set with its element, size and dimension.
fn set_line([element, set, space]: &[String; 3], found: &SetEvidence) -> String {
    let members: Vec<String> = found.members.iter().map(|member| show_number(*member)).collect();
    format!(
        "{element} = {}, {set} = {{{}}}, |{set}| = {}, dim {space} = {}",
        show_number(found.element),
        members.join(", "),
        members.len(),
        found.dimension
    )
}

fn gap(gap: f64) -> String {
    if gap.is_infinite() { "infinite".to_owned() } else { format!("{gap:.1e}") }
}

/// Singular values as ticks on a logarithmic line, with the threshold.
fn singular_values(ui: &mut Ui, decision: &RankDecision) {
    let largest = decision.singular_values.first().copied().unwrap_or(0.0);
    if largest <= 0.0 {
        return;
    }
    let (rect, response) =
        ui.allocate_exact_size(vec2(ui.available_width().min(320.0), 16.0), Sense::hover());
    let painter = ui.painter();
    let (low, high) = ((largest * 1e-18).log10(), largest.log10() + 0.3);
    let x = |value: f64| {
        let at = (value.max(largest * 1e-18).log10() - low) / (high - low);
        #[expect(clippy::cast_possible_truncation, reason = "a position on the screen")]
        let at = at as f32;
        rect.left() + at * rect.width()
    };
    painter.hline(rect.x_range(), rect.center().y, Stroke::new(1.0, theme::faint(ui)));
    for &value in &decision.singular_values {
        let counted = value > decision.threshold;
        let colour = if counted { theme::good(ui) } else { theme::bad(ui) };
        painter.vline(x(value), rect.top() + 2.0..=rect.bottom() - 2.0, Stroke::new(3.0, colour));
    }
    let dashes = egui::Shape::dashed_line(
        &[egui::pos2(x(decision.threshold), rect.top()), egui::pos2(x(decision.threshold), rect.bottom())],
        Stroke::new(1.0, ui.visuals().text_color()),
        3.0,
        2.0,
    );
    painter.extend(dashes);
    let values: Vec<String> = decision.singular_values.iter().map(|s| format!("{s:.3e}")).collect();
    response.on_hover_text(format!(
        "singular values {}\nthreshold {:.1e} (dashed), gap {}",
        values.join(", "),
        decision.threshold,
        gap(decision.gap)
    ));
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numerics::Complex64;

    #[test]
    fn a_set_is_listed_with_its_size() {
        let names = ["pi", "Theta_pi", "V_pi"].map(str::to_owned);
        let members = vec![Complex64::from(1.0), Complex64::from(2.0)];
        let set = SetEvidence { element: Complex64::from(0.5), members, dimension: 2 };
        let line = "pi = 0.5, Theta_pi = {1, 2}, |Theta_pi| = 2, dim V_pi = 2";
        assert_eq!(set_line(&names, &set), line, "element, members, size, dimension");
    }

    #[test]
    fn a_witness_is_a_sentence_of_what_it_shows() {
        let witness = |s: Option<f64>, name: &str| Witness {
            s: s.map(Complex64::from),
            direction: vec![Complex64::from(1.0)],
            coordinates: vec![name.to_owned()],
        };
        assert_eq!(unseen(&witness(Some(2.0), "x1")), "The mode s = 2 along x1 is seen by no sensor.");
        assert_eq!(
            unseen(&witness(Some(-3.0), "coupling direction 2")),
            "The eigenvalue lambda = -3 of the coupling, along coupling direction 2, is seen by no global output."
        );
        assert_eq!(
            unseen(&witness(Some(0.5), "shown state 2")),
            "The mode s = 0.5 along shown state 2 is driven by no coupling input."
        );
        assert_eq!(unseen(&witness(None, "x1")), "An impulse along x1 is seen by no sensor.");
        assert!(unseen(&witness(None, "d1")).starts_with("A sudden change along d1"), "an unknown input");
        assert!(
            unseen(&witness(None, "equation 3")).starts_with("The equation 3 determines neither"),
            "an equation"
        );
    }
}
