//! The only writer of a session: a command in, a changed session out.

use std::sync::Arc;

use super::apply::apply;
use super::command::{Cell, Command, Show};
use super::new_network::new_network;
use super::state::{Draft, Field, Session};
use crate::document::{Document, read_document};
use crate::paper::example;

/// Carries out a command.
///
/// What cannot be done leaves the document as it is and says why: in the status line, or, for something typed, beside
/// the field, which keeps the text.
pub fn update(session: &mut Session, command: Command) {
    match command {
        Command::Open { text } => open(session, &text, "the document"),
        Command::OpenExample { key } => match example(&key) {
            Some(example) => open(session, example.text, example.title),
            None => session.tell(format!("there is no example \"{key}\""), true),
        },
        Command::NewNetwork => begin(session, new_network(), "a new network"),
        Command::Undo => step(session, true),
        Command::Redo => step(session, false),
        Command::Edit(edit) => apply(session, edit),
        Command::Show(show) => match show {
            Show::Tab(tab) => session.view.tab = tab,
            Show::Figure(id) => session.view.figure = Some(id),
            Show::Compared(figure) => session.view.compared = figure,
            Show::Place(place) => session.view.place = place,
            Show::Theme(theme) => session.view.theme = theme,
        },
    }
}

fn open(session: &mut Session, text: &str, what: &str) {
    match read_document(text) {
        Ok(document) => begin(session, document, what),
        Err(error) => session.tell(format!("{what} was not opened: {error}"), true),
    }
}

/// Puts a whole document in place of the one before, as a step of the history.
fn begin(session: &mut Session, document: Document, what: &str) {
    let figure = document.figures.first().map(|figure| figure.id.clone());
    session.history.drag_ended();
    replace(session, document, None);
    session.drafts.clear();
    session.view.figure = figure;
    session.tell(format!("opened {what}"), false);
}

fn step(session: &mut Session, back: bool) {
    let now = Arc::clone(&session.document);
    let next = if back { session.history.undo(now) } else { session.history.redo(now) };
    if let Some(document) = next {
        session.document = document;
        session.drafts.clear();
        session.message = None;
        session.revision += 1;
        let known = |id: &String| session.document.figures.iter().any(|figure| figure.id == *id);
        if !session.view.figure.as_ref().is_some_and(known) {
            session.view.figure = session.document.figures.first().map(|figure| figure.id.clone());
        }
    }
}

/// Puts a changed document in force; an unchanged one leaves no step behind.
pub(super) fn replace(session: &mut Session, document: Document, drag: Option<String>) {
    if *session.document == document {
        return;
    }
    session.history.remember(Arc::clone(&session.document), drag);
    session.document = Arc::new(document);
    session.message = None;
    session.revision += 1;
}

/// What became of an edit.
pub(super) enum Edited {
    /// The document changed, or stayed as it is.
    Done,
    /// A typed text is not understood.
    Draft(Field, Draft),
    /// It cannot be done.
    Refused(String),
}

/// A short name for a cell, `A[1, 2]` counted from one.
pub fn cell_name(cell: Cell) -> String {
    format!("{}[{}, {}]", cell.matrix.letter(), cell.row + 1, cell.column + 1)
}
