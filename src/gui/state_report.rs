//! The state as data for tests of the page.

use nalgebra::DMatrix;
use serde::Serialize;

use super::Window;
use crate::document::{Matrix, PlantData};
use crate::numerics::Complex64;
use crate::observer::Verdict;
use crate::session::Task;

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
            Task::Figure { id } => format!("figure {id}"),
        }),
        failure: derived.failure().map(str::to_owned),
        poles: pairs(&document.design.poles),
        scale: document.design.scale,
        order: document.design.order.key(),
        method: document.design.method.key(),
        matrices: matrices(&document.plant),
        conditions: assessment.map_or_else(Vec::new, |assessment| {
            let condition =
                |c: &crate::observer::Condition| Condition { id: c.id.clone(), verdict: c.verdict };
            assessment.conditions.iter().map(condition).collect()
        }),
        verified: analysis.is_some_and(crate::session::Analysis::verified),
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

fn errors(analysis: Option<&crate::session::Analysis>) -> Vec<String> {
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
