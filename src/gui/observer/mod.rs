//! This observer: methods, order, poles or demands, conditions, result.

mod audit;
mod badge;
mod conditions;
mod demands;
pub(super) mod errata;
mod lmi_result;
mod methods;
mod poles;
mod result;
mod rows;

pub(super) use methods::sentence;

use egui::{RichText, Ui};

use super::{Output, Widgets, compare, network, theme};
use crate::observer::{Assessment, Method};
use crate::paper::Shown;
use crate::session::{Derived, Session};

/// Draws the place of the observer.
pub fn show(ui: &mut Ui, session: &Session, derived: &Derived, widgets: &mut Widgets, out: &mut Output) {
    ui.add_space(theme::ITEM_GAP);
    ui.label(RichText::new("Observer").heading());
    methods::tiles(ui, session, derived, out);
    methods::reasons(ui, derived);
    methods::orders(ui, session, out);
    badge::stale(ui, session, derived);
    let shown = errata::of(session);
    let assessment = match derived.analysis().map(|analysis| &analysis.assessment) {
        Some(Ok(assessment)) => {
            badge::show(ui, session, assessment, out);
            compare::keep(ui, session, out);
            Some(assessment)
        }
        Some(Err(why)) => {
            ui.colored_label(theme::bad(ui), why);
            None
        }
        None => {
            ui.label("computing");
            None
        }
    };
    if session.document().design.method.uses_lmi() {
        demands::show(ui, session, derived, out);
        poles::plane(ui, session, derived, out);
        rows::show(ui, session, derived, widgets, out);
        audit::show(ui, session, derived, widgets, out);
        // last, since it comes and goes: nothing that a person types into may jump
        if let Some(Ok(design)) = assessment.map(|assessment| &assessment.outcome) {
            lmi_result::show(ui, shown, design.synthesis.lmi(), demands::is_discrete(session));
        }
    } else {
        if session.document().design.method == Method::Hierarchical {
            let design = assessment.and_then(|assessment| assessment.outcome.as_ref().ok());
            network::observer::show(ui, session, design, out);
        }
        poles::show(ui, session, derived, widgets, out);
    }
    if let Some(assessment) = assessment {
        found(ui, session, assessment, widgets, out);
    }
    errata::show(ui, shown);
}

/// Draws the conditions and the design; until the newest has arrived they are those of the choice before.
fn found(ui: &mut Ui, session: &Session, assessment: &Assessment, widgets: &mut Widgets, out: &mut Output) {
    let choice = &assessment.choice;
    let shown = Shown { method: choice.method, order: choice.order, ..errata::of(session) };
    if !assessment.conditions.is_empty() {
        ui.separator();
        ui.label(RichText::new("Conditions").strong());
        conditions::show(ui, shown, &assessment.conditions, widgets, out);
    }
    if let Ok(design) = &assessment.outcome {
        ui.separator();
        ui.label(RichText::new("Result").strong());
        result::show(ui, session.document(), shown, design);
    }
}
