//! The state of the application: the document, what was typed but not understood, and what is shown.

use std::collections::BTreeMap;
use std::sync::Arc;

use super::command::{Cell, ComparedFigure, Place, SignalList, Tab, ThemeChoice};
use super::history::History;
use super::model_edits::{GivenPart, LipschitzMatrix};
use super::network_edits::NetworkCell;
use crate::document::{Document, DocumentError, read_document, write_document_compact};
use crate::paper::EXAMPLES;

/// The application without a screen; [`super::update`] is the only writer.
#[derive(Clone, Debug)]
pub struct Session {
    pub(super) document: Arc<Document>,
    pub(super) drafts: BTreeMap<Field, Draft>,
    pub(super) history: History,
    pub(super) view: View,
    pub(super) message: Option<Message>,
    pub(super) revision: u64,
}

/// A field that a person types into.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Field {
    /// A cell of a matrix.
    Cell(Cell),
    /// The list of poles.
    Poles,
    /// The initial state of one component.
    Initial(usize),
    /// The initial states of all components as one expression.
    InitialFormula,
    /// A signal.
    Signal(SignalList, usize),
    /// A cell of the uncertainty: row, column, whether it is the frequency.
    Uncertainty(usize, usize, bool),
    /// An entry of a given `R`: subsystem, row, column.
    Rows(usize, usize, usize),
    /// A part of the observer that is examined.
    Given(GivenPart),
    /// An entry of a matrix of the nonlinearity: row, column.
    Lipschitz(LipschitzMatrix, usize, usize),
    /// A component of the nonlinearity.
    Component(usize),
    /// The Lipschitz constant.
    LipschitzConstant,
    /// The signal of a free variable.
    FreeSignal(usize),
    /// An entry of the feedback of the free variables: row, column.
    FreeFeedback(usize, usize),
    /// The name of a kept design, from zero.
    KeptName(usize),
    /// A cell of a network's matrix.
    Network(NetworkCell),
    /// The number of subsystems of a network.
    Subsystems,
    /// The poles of the local observers.
    LocalPoles,
}

/// A text that was not understood; the last good value stays in force.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Draft {
    /// What was typed.
    pub text: String,
    /// Why it is not understood.
    pub error: String,
}

/// What is shown.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct View {
    /// View in the figures' place.
    pub tab: Tab,
    /// The chosen figure of the document, by its id.
    pub figure: Option<String>,
    /// The chosen figure of the comparison.
    pub compared: ComparedFigure,
    /// The place that a narrow screen shows.
    pub place: Place,
    /// Light or dark.
    pub theme: ThemeChoice,
}

/// A sentence for the status line.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Message {
    /// The sentence.
    pub text: String,
    /// Whether something went wrong.
    pub error: bool,
}

impl Session {
    /// A session with a document.
    pub fn new(document: Document) -> Self {
        let figure = document.figures.first().map(|figure| figure.id.clone());
        Self {
            document: Arc::new(document),
            drafts: BTreeMap::new(),
            history: History::default(),
            view: View { figure, ..View::default() },
            message: None,
            revision: 1,
        }
    }

    /// A session with the first example.
    ///
    /// # Errors
    /// When that example cannot be read, which a test excludes.
    pub fn with_first_example() -> Result<Self, DocumentError> {
        Ok(Self::new(read_document(EXAMPLES[0].text)?))
    }

    /// The document.
    pub fn document(&self) -> &Document {
        &self.document
    }

    /// The document as compact text, for jobs, links and storage.
    pub fn document_text(&self) -> String {
        write_document_compact(&self.document)
    }

    /// What was typed into a field and not understood.
    pub fn draft(&self, field: &Field) -> Option<&Draft> {
        self.drafts.get(field)
    }

    /// How many fields hold something that is not understood.
    pub fn n_drafts(&self) -> usize {
        self.drafts.len()
    }

    /// What is shown.
    pub fn view(&self) -> &View {
        &self.view
    }

    /// The sentence for the status line.
    pub fn message(&self) -> Option<&Message> {
        self.message.as_ref()
    }

    /// Number that grows with every change of the document.
    pub fn revision(&self) -> u64 {
        self.revision
    }

    /// Whether there is something to undo.
    pub fn can_undo(&self) -> bool {
        self.history.can_undo()
    }

    /// Whether there is something to redo.
    pub fn can_redo(&self) -> bool {
        self.history.can_redo()
    }

    /// Shows a sentence that does not come from a command, for example of a file that could not be read.
    pub fn tell(&mut self, text: impl Into<String>, error: bool) {
        self.message = Some(Message { text: text.into(), error });
    }
}
