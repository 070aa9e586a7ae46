//! The demands on a design by linear matrix inequalities, in the place of poles.

use egui::{RichText, Ui, UiBuilder};

use super::super::demand::{Demand, demand, line, name, switch};
use super::super::{Output, formula, plot::short, theme};
use crate::document::PlantData;
use crate::observer::{LmiChoice, LmiResult, Method};
use crate::session::{Derived, Edit, LmiEdit, Session};
use crate::system::TimeDomain;

/// Draws all demands.
pub(super) fn show(ui: &mut Ui, session: &Session, derived: &Derived, out: &mut Output) {
    ui.label(RichText::new("Demands").strong());
    let results = results(derived);
    let lmi = &session.document().design.lmi;
    // ids of their own: remarks that come and go above must not break off a drag
    let builder = UiBuilder::new().scope_id(egui::Id::unique("demands"));
    ui.scope_builder(builder, |ui| {
        let mut emit = |edit| out.edit(Edit::Lmi(edit));
        if is_discrete(session) {
            radius(ui, lmi, results, &mut emit);
        } else {
            rate(ui, lmi, results, &mut emit);
        }
        gain(ui, lmi, &mut emit);
        gamma(ui, lmi, results, &mut emit);
        egui::CollapsingHeader::new("More demands")
            .id_salt("more demands")
            .show_unindented(ui, |ui| more(ui, session.document().design.method, lmi, &mut emit));
    });
}

/// Whether the system is in discrete time.
pub(super) fn is_discrete(session: &Session) -> bool {
    matches!(&session.document().plant, PlantData::Descriptor(data) if data.time == TimeDomain::Discrete)
}

/// The newest results by linear matrix inequalities.
fn results(derived: &Derived) -> &[LmiResult] {
    let assessment = derived.analysis().and_then(|analysis| analysis.assessment.as_ref().ok());
    let design = assessment.and_then(|assessment| assessment.outcome.as_ref().ok());
    design.map_or(&[], |design| design.synthesis.lmi())
}

/// The limit that the fixed modes of all subsystems set.
fn limit(results: &[LmiResult], worse: fn(f64, f64) -> f64) -> Option<f64> {
    results.iter().filter_map(|result| result.fastest_decay).filter(|limit| limit.is_finite()).reduce(worse)
}

const SWITCH_OFF: &str = "Off: the error only has to vanish, however slowly.";

fn rate(ui: &mut Ui, lmi: &LmiChoice, results: &[LmiResult], emit: &mut impl FnMut(LmiEdit)) {
    const FIRST: f64 = 0.5;
    const SLIDER: [f64; 2] = [0.01, 100.0];
    let hint = "Decay rate alpha in 1/s: every mode of the error satisfies Re s < -alpha.";
    line(ui, |ui| {
        if let Some(on) = switch(ui, lmi.decay.is_some(), "Decay rate", SWITCH_OFF) {
            emit(LmiEdit::Decay { decay: on.then_some(FIRST), done: true });
        }
        let Some(decay) = lmi.decay else {
            formula::remark(ui, "stability alone");
            return;
        };
        let beyond = limit(results, f64::min).map(|limit| {
            (
                limit..=SLIDER[1],
                format!("A fixed mode is no faster than {}: grey cannot be reached.", short(limit)),
            )
        });
        let asked = Demand {
            name: "Decay rate",
            range: SLIDER[0]..=SLIDER[1],
            logarithmic: true,
            suffix: " /s",
            hint,
            beyond,
        };
        if let Some((decay, done)) = demand(ui, decay, &asked) {
            emit(LmiEdit::Decay { decay: Some(decay), done });
        }
    });
}

fn radius(ui: &mut Ui, lmi: &LmiChoice, results: &[LmiResult], emit: &mut impl FnMut(LmiEdit)) {
    const FIRST: f64 = 0.95;
    line(ui, |ui| {
        if let Some(on) = switch(ui, lmi.decay.is_some(), "Radius", SWITCH_OFF) {
            emit(LmiEdit::Decay { decay: on.then_some(FIRST), done: true });
        }
        let Some(decay) = lmi.decay else {
            formula::remark(ui, "stability alone");
            return;
        };
        let beyond = limit(results, f64::max).map(|limit| {
            (
                0.0..=limit,
                format!("A fixed mode lies at the radius {}: grey cannot be reached.", short(limit)),
            )
        });
        let asked = Demand {
            name: "Radius",
            range: 0.0..=1.0,
            logarithmic: false,
            suffix: "",
            hint: "Every mode of the error satisfies |z| < r: the smaller, the faster it vanishes.",
            beyond,
        };
        if let Some((decay, done)) = demand(ui, decay, &asked) {
            emit(LmiEdit::Decay { decay: Some(decay), done });
        }
    });
}

fn gain(ui: &mut Ui, lmi: &LmiChoice, emit: &mut impl FnMut(LmiEdit)) {
    const FIRST: f64 = 100.0;
    let off = "Off: gains are not bounded; the least gamma may then ask for gains beyond all reason.";
    line(ui, |ui| {
        if let Some(on) = switch(ui, lmi.gain.is_some(), "Gain bound", off) {
            emit(LmiEdit::Gain { gain: on.then_some(FIRST), done: true });
        }
        let Some(gain) = lmi.gain else {
            formula::remark(ui, "unbounded");
            return;
        };
        let asked = Demand {
            name: "Gain bound",
            range: 0.01..=1e4,
            logarithmic: true,
            suffix: "",
            hint: "Bound on the norm of the free gain: small gains pass less noise.",
            beyond: None,
        };
        if let Some((gain, done)) = demand(ui, gain, &asked) {
            emit(LmiEdit::Gain { gain: Some(gain), done });
        }
    });
}

fn gamma(ui: &mut Ui, lmi: &LmiChoice, results: &[LmiResult], emit: &mut impl FnMut(LmiEdit)) {
    let hint =
        "The attenuation: energy of the error at most gamma squared times the energy of the disturbance.";
    line(ui, |ui| {
        name(ui, "gamma", hint);
        if ui.selectable_label(lmi.gamma.is_none(), "Least").clicked() && lmi.gamma.is_some() {
            emit(LmiEdit::Gamma { gamma: None, done: true });
        }
        let given = ui.selectable_label(lmi.gamma.is_some(), "Given");
        if given.on_hover_text("This attenuation, with the largest margin").clicked() && lmi.gamma.is_none() {
            let found = results.iter().filter_map(|result| result.gamma).fold(0.0, f64::max);
            let start =
                if found > 0.0 { format!("{:.2e}", 1.05 * found).parse().unwrap_or(found) } else { 1.0 };
            emit(LmiEdit::Gamma { gamma: Some(start), done: true });
        }
    });
    if let Some(gamma) = lmi.gamma {
        line(ui, |ui| {
            name(ui, "", hint);
            let asked = Demand {
                name: "gamma",
                range: 1e-3..=1e3,
                logarithmic: true,
                suffix: "",
                hint,
                beyond: None,
            };
            if let Some((gamma, done)) = demand(ui, gamma, &asked) {
                emit(LmiEdit::Gamma { gamma: Some(gamma), done });
            }
        });
    }
}

fn more(ui: &mut Ui, method: Method, lmi: &LmiChoice, emit: &mut impl FnMut(LmiEdit)) {
    let row = |ui: &mut Ui, text: &str, value: f64, asked: &Demand<'_>| {
        line(ui, |ui| {
            name(ui, text, asked.hint);
            demand(ui, value, asked)
        })
    };
    let conditioning = Demand {
        name: "Conditioning",
        range: 1.0..=1e8,
        logarithmic: true,
        suffix: "",
        hint: "Bound kappa on the condition of the Lyapunov matrix: t I <= X <= kappa t I.",
        beyond: None,
    };
    if let Some((conditioning, done)) = row(ui, "Conditioning", lmi.conditioning, &conditioning) {
        emit(LmiEdit::Conditioning { conditioning, done });
    }
    if lmi.gamma.is_none() {
        let back_off = Demand {
            name: "Back-off",
            range: 0.01..=100.0,
            logarithmic: true,
            suffix: " %",
            hint: "Distance kept from the least gamma, so that the gains stay moderate and the proof has room.",
            beyond: None,
        };
        if let Some((percent, done)) = row(ui, "Back-off", 100.0 * lmi.back_off, &back_off) {
            emit(LmiEdit::BackOff { back_off: percent / 100.0, done });
        }
    }
    let seconds = Demand {
        name: "Time limit",
        range: 0.5..=120.0,
        logarithmic: true,
        suffix: " s",
        hint: "Time limit of one solution of the inequalities.",
        beyond: None,
    };
    if let Some((seconds, done)) = row(ui, "Time limit", lmi.seconds, &seconds) {
        emit(LmiEdit::Seconds { seconds, done });
    }
    let (text, hint) = match method {
        Method::HInfinity => (
            "Inequality (52) as printed, with slack matrices",
            "The same least gamma by a larger inequality: the slack matrices change nothing.",
        ),
        _ => (
            "Extended parameterisation",
            "Not in the paper: more observers of the same order, so gamma is never worse and fixed modes may go.",
        ),
    };
    let mut alternative = lmi.alternative;
    if ui.checkbox(&mut alternative, text).on_hover_text(hint).changed() {
        emit(LmiEdit::Alternative(alternative));
    }
    ui.add_space(theme::ITEM_GAP);
}
