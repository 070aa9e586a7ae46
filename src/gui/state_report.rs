//! The state as data for tests of the page.

use nalgebra::DMatrix;
use serde::Serialize;

use super::Window;
use crate::document::{DescriptorData, Document, Matrix, PlantData};
use crate::numerics::Complex64;
use crate::observer::{Design, DesignError, LmiChoice, LmiResult, Verdict};
use crate::session::{Analysis, Derived, Light, Task};
use crate::simulation::comparison::ComparisonRow;

/// What a test of the page can know without looking at pixels.
#[derive(Debug, Serialize)]
#[serde(rename_all = "camelCase")]
#[expect(clippy::struct_excessive_bools, reason = "a report of independent facts, not a state machine")]
pub(super) struct Report {
    title: String,
    revision: u64,
    /// Whether the analysis belongs to this revision.
    current: bool,
    running: Option<String>,
    failure: Option<String>,
    poles: Vec<[f64; 2]>,
    scale: f64,
    order: &'static str,
    method: &'static str,
    lmi: Lmi,
    /// Names of the kept designs.
    kept: Vec<String>,
    /// Rows of the newest comparison.
    compare: Vec<Compared>,
    /// Whether the comparison belongs to this revision.
    compared: bool,
    /// Subsystems of the partition.
    subsystems: usize,
    network: Option<Network>,
    /// Components of the nonlinearity.
    nonlinear: usize,
    matrices: Matrices,
    conditions: Vec<Condition>,
    verified: bool,
    spectrum: Vec<[f64; 2]>,
    errors: Vec<String>,
    rms: Vec<f64>,
    tab: &'static str,
    figure: Option<String>,
    figure_ready: bool,
    message: Option<Message>,
    drafts: usize,
    can_undo: bool,
    can_redo: bool,
    dark: Option<bool>,
    frames: u64,
    elapsed_ms: Option<f64>,
}

/// A network and its local observers; numbers of subsystems from one, as people see them.
#[derive(Debug, Serialize)]
#[serde(rename_all = "camelCase")]
struct Network {
    subsystems: usize,
    /// Entries of `Gamma` that are not zero.
    couplings: usize,
    /// Subsystems with local measurements.
    local: Vec<usize>,
    /// Those whose local observer is plugged in.
    plugged: Vec<usize>,
    local_poles: Vec<[f64; 2]>,
    /// States of the global observer, when there is one.
    global_order: Option<usize>,
}

/// The system's matrices, row by row.
#[derive(Debug, Default, Serialize)]
#[serde(rename_all = "UPPERCASE")]
struct Matrices {
    e: Rows,
    a: Rows,
    b: Rows,
    c: Rows,
    d: Rows,
    f: Rows,
}

type Rows = Vec<Vec<f64>>;

/// Demands on a design by linear matrix inequalities, and what came of them.
#[derive(Debug, Serialize)]
#[serde(rename_all = "camelCase")]
struct Lmi {
    decay: Option<f64>,
    gain: Option<f64>,
    asked_gamma: Option<f64>,
    given_rows: usize,
    examines: bool,
    /// One for each subsystem, or for the whole system.
    results: Vec<LmiOutcome>,
    /// The block that stops the inequalities.
    infeasible: Option<String>,
    /// Lights of all methods.
    lights: Vec<(&'static str, Light)>,
}

#[derive(Debug, Serialize)]
#[serde(rename_all = "camelCase")]
struct LmiOutcome {
    name: String,
    gamma: Option<f64>,
    gamma_best: Option<f64>,
    proved: bool,
    iterations: u32,
}

/// A design of the comparison.
#[derive(Debug, Serialize)]
struct Compared {
    name: String,
    method: &'static str,
    /// Number of its own states, when it exists.
    order: Option<usize>,
    verified: bool,
    error: Option<String>,
}

#[derive(Debug, Serialize)]
struct Condition {
    id: String,
    verdict: Verdict,
}

#[derive(Debug, Serialize)]
struct Message {
    text: String,
    error: bool,
}

/// Reports the state of a window.
pub(super) fn report(window: &Window) -> Report {
    let (session, derived) = (window.app().session(), window.app().derived());
    let document = session.document();
    let analysis = derived.analysis();
    let assessment = analysis.and_then(|analysis| analysis.assessment.as_ref().ok());
    let design = assessment.and_then(|assessment| assessment.outcome.as_ref().ok());
    let simulation = analysis.and_then(|analysis| analysis.simulation.as_ref().ok());
    let view = session.view();
    let figure_ready = view.figure.as_deref().is_some_and(|id| matches!(derived.figure(id), Some(Ok(_))));
    Report {
        title: document.title.clone(),
        revision: session.revision(),
        current: derived.is_current(session.revision()),
        running: derived.running().map(|(task, ..)| match task {
            Task::Analyse => "analysis".to_owned(),
            Task::Compare => "comparison".to_owned(),
            Task::Figure { id } => format!("figure {id}"),
        }),
        failure: derived.failure().map(str::to_owned),
        poles: pairs(&document.design.poles),
        scale: document.design.scale,
        order: document.design.order.key(),
        method: document.design.method.key(),
        lmi: lmi(&document.design.lmi, analysis, design),
        kept: document.kept.iter().map(|kept| kept.name.clone()).collect(),
        compare: compare(derived),
        compared: derived.is_compared(session.revision()),
        subsystems: descriptor(&document.plant).map_or(0, |data| data.partition.len()),
        network: network(document, design),
        nonlinear: descriptor(&document.plant)
            .and_then(|data| data.lipschitz.as_ref())
            .map_or(0, |lipschitz| lipschitz.f.len()),
        matrices: matrices(&document.plant),
        conditions: assessment.map_or_else(Vec::new, |assessment| {
            let condition =
                |c: &crate::observer::Condition| Condition { id: c.id.clone(), verdict: c.verdict };
            assessment.conditions.iter().map(condition).collect()
        }),
        verified: analysis.is_some_and(Analysis::verified),
        spectrum: design.map_or_else(Vec::new, |design| pairs(&design.verification.spectrum)),
        errors: errors(analysis),
        rms: simulation.map_or_else(Vec::new, |simulation| simulation.rms.clone()),
        tab: view.tab.title(),
        figure: view.figure.clone(),
        figure_ready,
        message: session.message().map(|m| Message { text: m.text.clone(), error: m.error }),
        drafts: session.n_drafts(),
        can_undo: session.can_undo(),
        can_redo: session.can_redo(),
        dark: match view.theme {
            crate::session::ThemeChoice::System => None,
            crate::session::ThemeChoice::Light => Some(false),
            crate::session::ThemeChoice::Dark => Some(true),
        },
        frames: window.frames(),
        elapsed_ms: derived.elapsed_ms(),
    }
}

fn descriptor(plant: &PlantData) -> Option<&DescriptorData> {
    match plant {
        PlantData::Descriptor(data) => Some(data),
        PlantData::Network(_) => None,
    }
}

fn network(document: &Document, design: Option<&Design>) -> Option<Network> {
    let PlantData::Network(data) = &document.plant else { return None };
    let choice = &document.design;
    let plugged = |number: &&usize| data.is_plugged(number.saturating_sub(1), choice.plugged.as_deref());
    Some(Network {
        subsystems: data.n_subsystems(),
        couplings: data.Gamma.entries().len(),
        local: data.local.clone(),
        plugged: data.local.iter().filter(plugged).copied().collect(),
        local_poles: pairs(&choice.local_poles),
        global_order: design
            .and_then(|design| design.hierarchical.as_deref())
            .map(|observer| observer.hierarchy.order()),
    })
}

fn lmi(choice: &LmiChoice, analysis: Option<&Analysis>, design: Option<&Design>) -> Lmi {
    let outcome = |result: &LmiResult| LmiOutcome {
        name: result.name.clone(),
        gamma: result.gamma,
        gamma_best: result.gamma_best,
        proved: result.certificate.proved,
        iterations: result.iterations,
    };
    let assessment = analysis.and_then(|analysis| analysis.assessment.as_ref().ok());
    let infeasible = match assessment.map(|assessment| &assessment.outcome) {
        Some(Err(DesignError::Infeasible(infeasible))) => Some(infeasible.block.clone()),
        _ => None,
    };
    let lights = analysis.map_or_else(Vec::new, |analysis| {
        analysis.methods.iter().map(|light| (light.method.key(), light.light)).collect()
    });
    Lmi {
        decay: choice.decay,
        gain: choice.gain,
        asked_gamma: choice.gamma,
        given_rows: choice.rows.len(),
        examines: choice.given.is_some(),
        results: design.map_or(&[][..], |design| design.synthesis.lmi()).iter().map(outcome).collect(),
        infeasible,
        lights,
    }
}

fn compare(derived: &Derived) -> Vec<Compared> {
    let Some(Ok(view)) = derived.comparison() else { return Vec::new() };
    let row = |row: &ComparisonRow| {
        let design = row.outcome.as_ref();
        Compared {
            name: row.name.clone(),
            method: row.method.key(),
            order: design.ok().map(|design| design.order),
            verified: design.is_ok_and(|design| design.verified),
            error: design.err().map(ToString::to_string),
        }
    };
    view.comparison.rows.iter().map(row).collect()
}

fn errors(analysis: Option<&Analysis>) -> Vec<String> {
    let Some(analysis) = analysis else { return Vec::new() };
    let mut errors = Vec::new();
    match &analysis.assessment {
        Err(error) => errors.push(error.clone()),
        Ok(assessment) => errors.extend(assessment.outcome.as_ref().err().map(ToString::to_string)),
    }
    errors.extend(analysis.simulation.as_ref().err().cloned());
    errors
}

fn pairs(values: &[Complex64]) -> Vec<[f64; 2]> {
    values.iter().map(|value| [value.re, value.im]).collect()
}

fn matrices(plant: &PlantData) -> Matrices {
    let PlantData::Descriptor(data) = plant else { return Matrices::default() };
    let rows = |matrix: Matrix| {
        let values: DMatrix<f64> = data.matrix(matrix).values();
        values.row_iter().map(|row| row.iter().copied().collect()).collect()
    };
    Matrices {
        e: rows(Matrix::E),
        a: rows(Matrix::A),
        b: rows(Matrix::B),
        c: rows(Matrix::C),
        d: rows(Matrix::D),
        f: rows(Matrix::F),
    }
}
