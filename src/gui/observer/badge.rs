//! What came of a design, in words; never a bare status.

use egui::{Color32, RichText, Ui};

use super::super::{
    Output, formula,
    plot::{short, short_up},
    theme,
};
use crate::document::PlantData;
use crate::lmi::{Infeasible, Nearest};
use crate::observer::{Assessment, Design, DesignError, Method};
use crate::session::{Derived, Edit, LipschitzEdit, LmiEdit, PartitionEdit, Session};

/// Says when what is shown belongs to an earlier document, because the newest computation was stopped.
pub(super) fn stale(ui: &mut Ui, session: &Session, derived: &Derived) {
    let stopped = derived.running().is_none() && !derived.is_current(session.revision());
    if let Some(why) = derived.failure().filter(|_| stopped) {
        let text = format!("{why}: the results below belong to the demands before");
        framed(ui, theme::near(ui), "not up to date", &text);
    }
}

/// Draws the badge of an assessment.
pub(super) fn show(ui: &mut Ui, session: &Session, assessment: &Assessment, out: &mut Output) {
    match &assessment.outcome {
        Ok(design) => {
            let (colour, word, sentence) = made(ui, design, assessment.choice.lmi.given.is_some());
            framed(ui, colour, word, &sentence);
        }
        Err(error) => {
            let (colour, word) = failed(ui, error, assessment.choice.lmi.given.is_some());
            framed(ui, colour, word, &error_text(error));
            match error {
                DesignError::Infeasible(infeasible) => mend(ui, session, infeasible, out),
                DesignError::Unsuitable(_) => provide(ui, session, out),
                _ => {}
            }
        }
    }
}

fn framed(ui: &mut Ui, colour: Color32, word: &str, sentence: &str) {
    let stroke = egui::Stroke::new(1.5, colour);
    egui::Frame::new().stroke(stroke).corner_radius(5.0).inner_margin(7.0).show(ui, |ui| {
        ui.set_min_width(ui.available_width());
        ui.horizontal_wrapped(|ui| {
            ui.label(RichText::new(word).color(colour).strong());
            ui.label(sentence);
        });
    });
}

fn made(ui: &Ui, design: &Design, examined: bool) -> (Color32, &'static str, String) {
    let gammas: Vec<String> =
        design.synthesis.lmi().iter().filter_map(|result| result.gamma).map(short_up).collect();
    let title = if gammas.is_empty() {
        design.title.clone()
    } else {
        format!("gamma {}: {}", gammas.join(" and "), design.title)
    };
    let unproved: Vec<&str> = design
        .synthesis
        .lmi()
        .iter()
        .filter(|result| !result.certificate.proved)
        .map(|result| result.certificate.note.as_str())
        .collect();
    if !unproved.is_empty() {
        let notes: Vec<&str> = unproved.into_iter().filter(|note| !note.is_empty()).collect();
        let reason = if notes.is_empty() { String::new() } else { format!(": {}", notes.join("; ")) };
        let word = if examined { "not certified" } else { "feasible, but not certified" };
        return (theme::near(ui), word, format!("{title}{reason}"));
    }
    if design.verification.verified() {
        return (theme::good(ui), "verified", format!("{title}: every check passed"));
    }
    let failed: Vec<&str> = design.verification.failures().map(|check| check.name.as_str()).collect();
    (theme::near(ui), "not verified", format!("{title}: the check of {} fails", failed.join(", ")))
}

fn failed(ui: &Ui, error: &DesignError, examined: bool) -> (Color32, &'static str) {
    match error {
        DesignError::TooFewPoles { .. } | DesignError::Poles(_) => (theme::near(ui), "poles needed"),
        DesignError::Condition { .. } => (theme::bad(ui), "does not exist"),
        DesignError::Unsuitable(_) | DesignError::Demand(_) if examined => {
            (theme::near(ui), "cannot be examined")
        }
        DesignError::Demand(_) => (theme::near(ui), "demand does not fit"),
        DesignError::Unsuitable(_) => (theme::faint(ui), "not for this system"),
        DesignError::Infeasible(_) => (theme::bad(ui), "infeasible"),
        DesignError::Cancelled => (theme::near(ui), "cancelled"),
        DesignError::GaveUp(_) => (theme::near(ui), "gave up"),
        DesignError::Numerics(_) => (theme::near(ui), "not decided"),
    }
}

/// The reason; of infeasible demands without the nearest ones, which have buttons.
fn error_text(error: &DesignError) -> String {
    let DesignError::Infeasible(infeasible) = error else { return error.to_string() };
    let source =
        if infeasible.source.is_empty() { String::new() } else { format!(" ({})", infeasible.source) };
    format!("no observer meets these demands: {}{source} stops them", infeasible.block)
}

/// A button for the data that the method needs and the system lacks.
fn provide(ui: &mut Ui, session: &Session, out: &mut Output) {
    let document = session.document();
    let PlantData::Descriptor(data) = &document.plant else { return };
    let lacks_partition = document.design.method == Method::Decentralized && data.partition.is_empty();
    if lacks_partition && ui.button("Divide the system into subsystems").clicked() {
        out.edit(Edit::Partition(PartitionEdit::Split { subsystem: 0 }));
    }
}

/// Buttons for the nearest demands that can be met, each changed alone.
fn mend(ui: &mut Ui, session: &Session, infeasible: &Infeasible, out: &mut Output) {
    if infeasible.nearest.is_empty() {
        return;
    }
    ui.horizontal_wrapped(|ui| {
        ui.label("Possible, each alone:");
        for nearest in &infeasible.nearest {
            let text = format!("Use {} {}", nearest.quantity, short(rounded(nearest)));
            match edit(session, nearest) {
                Some(edit) => {
                    let hint = format!("{} instead of {}", short(nearest.feasible), short(nearest.asked));
                    if ui.button(text).on_hover_text(hint).clicked() {
                        out.edit(edit);
                    }
                }
                None => formula::remark(ui, &text),
            }
        }
    });
}

/// A number of three digits on the feasible side of the nearest one.
fn rounded(nearest: &Nearest) -> f64 {
    let Nearest { asked, feasible, .. } = nearest;
    if *feasible == 0.0 || !feasible.is_finite() {
        return *feasible;
    }
    let unit = 10_f64.powf(feasible.abs().log10().floor() - 2.0);
    let steps = feasible / unit;
    // away from what was asked
    let steps = if feasible > asked { (steps - 1e-9).ceil() } else { (steps + 1e-9).floor() };
    // times a power of ten below one is not exact, divided by its inverse is
    if unit < 1.0 { steps / (1.0 / unit).round() } else { steps * unit }
}

/// What puts a nearest demand in force.
fn edit(session: &Session, nearest: &Nearest) -> Option<Edit> {
    let value = rounded(nearest);
    let lmi = |edit| Some(Edit::Lmi(edit));
    match nearest.quantity.as_str() {
        "gamma" => lmi(LmiEdit::Gamma { gamma: Some(value), done: true }),
        word if word.starts_with("decay") => {
            let slowest = value == 0.0 && session.document().design.lmi.decay.is_some();
            lmi(LmiEdit::Decay { decay: if slowest { None } else { Some(value) }, done: true })
        }
        word if word.starts_with("gain") => lmi(LmiEdit::Gain { gain: Some(value), done: true }),
        "Lipschitz constant" => Some(Edit::Lipschitz(LipschitzEdit::Constant(value.to_string()))),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_nearest_demand_is_rounded_to_its_feasible_side() {
        let round = |asked, feasible| rounded(&Nearest { quantity: String::new(), asked, feasible });
        assert_eq!(round(1.0, 0.835_9), 0.835, "a slower decay rate");
        assert_eq!(round(2.0, 2.290_5), 2.3, "a larger gamma");
        assert_eq!(round(0.1, 0.1234), 0.124, "a larger radius");
        assert_eq!(round(10.0, 1234.0), 1240.0, "a larger gain");
        assert_eq!(round(1.0, 0.83), 0.83, "three digits stay as they are");
    }
}
