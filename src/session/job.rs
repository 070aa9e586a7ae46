//! What is computed away from the screen: requests and replies as data.

use serde::{Deserialize, Serialize};

use super::analysis::{Analysis, analyse_with};
use super::comparison::{ComparisonView, compared};
use super::free_report::FreeReport;
use crate::document::{Document, Subject, read_document};
use crate::numerics::Watch;
use crate::paper::FigureSpec;
use crate::simulation::Memo;

/// A computation that is asked for.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct JobRequest {
    /// Number of the request; replies carry it.
    pub id: u64,
    /// Revision of the document that it belongs to.
    pub revision: u64,
    /// The document, as text: what comes in is checked again on the other side.
    pub document: String,
    /// What to compute.
    pub task: Task,
}

/// What to compute.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Task {
    /// Properties, conditions, design, simulation and standard views.
    Analyse,
    /// The chosen design beside those that are kept.
    Compare,
    /// One figure of the document.
    Figure {
        /// Its id.
        id: String,
    },
}

/// What came of a request.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct JobReply {
    /// Number of the request.
    pub id: u64,
    /// Revision of the document.
    pub revision: u64,
    /// The outcome.
    pub outcome: Outcome,
}

/// The outcome of a computation, or a step on the way.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum Outcome {
    /// How far it is, from 0 to 1, and at what.
    Progress {
        /// Fraction.
        fraction: f32,
        /// What is being done.
        what: String,
    },
    /// The analysis of the document.
    Analysis(Box<Analysis>),
    /// A comparison, or why there is none.
    Comparison(Result<Box<ComparisonView>, String>),
    /// A figure, or why there is none.
    Figure {
        /// Its id.
        id: String,
        /// The figure.
        figure: Result<FigureSpec, String>,
    },
    /// The request could not be understood or the computation broke off.
    Failed(String),
}

/// Performs a request to its end; `None` when `watch` said stop.
pub fn perform(request: &JobRequest, watch: &Watch) -> Option<JobReply> {
    perform_with(&mut Memo::new(), request, watch)
}

/// The same with a memory of the designs of earlier requests.
pub fn perform_with(memo: &mut Memo, request: &JobRequest, watch: &Watch) -> Option<JobReply> {
    let reply = |outcome| JobReply { id: request.id, revision: request.revision, outcome };
    let document = match read_document(&request.document) {
        Ok(document) => document,
        Err(error) => return Some(reply(Outcome::Failed(error.to_string()))),
    };
    let outcome = match &request.task {
        Task::Analyse => Outcome::Analysis(Box::new(analyse_with(memo, &document, watch)?)),
        Task::Compare => Outcome::Comparison(compared(&document, memo, watch)?),
        Task::Figure { id } => {
            if !watch.go_on(0.0, "designing and simulating the figure") {
                return None;
            }
            Outcome::Figure { id: id.clone(), figure: figure(&document, id, watch) }
        }
    };
    Some(reply(outcome))
}

/// Id of the figure of a sweep; no figure of a document can have it.
pub(super) const TRADE_OFF: &str = "(trade-off)";

fn figure(document: &Document, id: &str, watch: &Watch) -> Result<FigureSpec, String> {
    if id == TRADE_OFF {
        return document.draw_trade_off(watch);
    }
    let recipe = document.figures.iter().find(|recipe| recipe.id == id);
    let recipe = recipe.ok_or_else(|| format!("the document has no figure \"{id}\""))?;
    let mut figure = document.draw(recipe, watch)?;
    if let Ok(Subject::Model(model)) = document.subject() {
        figure.notes = FreeReport::without_own(FreeReport::new(document, &model).as_ref(), figure.notes);
    }
    Ok(figure)
}
