//! The only writer of a session: a command in, a changed session out.

use std::sync::Arc;

use super::command::{Cell, Command, Edit, Show};
use super::state::{Draft, Field, Message, Session};
use super::{edit_plant, edit_scenario, poles};
use crate::document::{Document, EntryMatrix, PlantData, limits, read_document};
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
        Command::Undo => step(session, true),
        Command::Redo => step(session, false),
        Command::Edit(edit) => apply(session, edit),
        Command::Show(show) => match show {
            Show::Tab(tab) => session.view.tab = tab,
            Show::Figure(id) => session.view.figure = Some(id),
            Show::Place(place) => session.view.place = place,
            Show::Theme(theme) => session.view.theme = theme,
        },
    }
}

fn open(session: &mut Session, text: &str, what: &str) {
    match read_document(text) {
        Ok(document) => {
            let figure = document.figures.first().map(|figure| figure.id.clone());
            session.history.drag_ended();
            replace(session, document, None);
            session.drafts.clear();
            session.view.figure = figure;
            session.tell(format!("opened {what}"), false);
        }
        Err(error) => session.tell(format!("{what} was not opened: {error}"), true),
    }
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
fn replace(session: &mut Session, document: Document, drag: Option<String>) {
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

fn apply(session: &mut Session, edit: Edit) {
    let drag = drag_key(&edit);
    let ends = drag.as_ref().is_none_or(|(_, done)| *done);
    let field = typed_field(&edit);
    let overwritten = match &edit {
        Edit::Paste { cell, .. } => Some(cell.matrix),
        Edit::Fill { matrix, .. } => Some(*matrix),
        _ => None,
    };
    let mut document = (*session.document).clone();
    match change(&mut document, edit) {
        Edited::Done => {
            if let Some(field) = field {
                session.drafts.remove(&field);
            }
            let sizes_before = sizes(&session.document);
            let sizes_after = sizes(&document);
            if sizes_before != sizes_after {
                session.drafts.retain(|field, _| matches!(field, Field::Poles));
            }
            if let Some(matrix) = overwritten {
                session
                    .drafts
                    .retain(|field, _| !matches!(field, Field::Cell(cell) if cell.matrix == matrix));
            }
            replace(session, document, drag.map(|(key, _)| key));
        }
        Edited::Draft(field, draft) => {
            session.drafts.insert(field, draft);
        }
        Edited::Refused(why) => session.message = Some(Message { text: why, error: true }),
    }
    if ends {
        session.history.drag_ended();
    }
}

fn sizes(document: &Document) -> Vec<(usize, usize)> {
    match &document.plant {
        PlantData::Descriptor(data) => data.matrices.iter().map(EntryMatrix::shape).collect(),
        PlantData::Network(_) => Vec::new(),
    }
}

/// Key of a drag and whether it ends with this edit; `None` for an edit that is a step of its own.
fn drag_key(edit: &Edit) -> Option<(String, bool)> {
    match edit {
        Edit::MovePole { index, done, .. } => Some((format!("pole {index}"), *done)),
        Edit::Scale { done, .. } => Some(("scale".to_owned(), *done)),
        Edit::UncertaintyScale { done, .. } => Some(("uncertainty".to_owned(), *done)),
        Edit::NoiseLevel { done, .. } => Some(("noise".to_owned(), *done)),
        Edit::Title(_) => Some(("title".to_owned(), false)),
        Edit::Notes(_) => Some(("notes".to_owned(), false)),
        Edit::Horizon(_) => Some(("horizon".to_owned(), false)),
        _ => None,
    }
}

/// The field whose draft an edit clears when it is understood.
fn typed_field(edit: &Edit) -> Option<Field> {
    match edit {
        Edit::Cell { cell, .. } => Some(Field::Cell(*cell)),
        Edit::Poles(_) | Edit::MovePole { .. } => Some(Field::Poles),
        Edit::Initial { state, .. } => Some(Field::Initial(*state)),
        Edit::Signal { list, index, .. } => Some(Field::Signal(*list, *index)),
        Edit::UncertaintyCell { row, column, frequency, .. } => {
            Some(Field::Uncertainty(*row, *column, *frequency))
        }
        _ => None,
    }
}

fn change(document: &mut Document, edit: Edit) -> Edited {
    match edit {
        Edit::Title(title) => document.title = clipped(title),
        Edit::Notes(notes) => document.notes = clipped(notes),
        Edit::Time(_)
        | Edit::Cell { .. }
        | Edit::Paste { .. }
        | Edit::Fill { .. }
        | Edit::Size { .. }
        | Edit::AddSensor { .. } => {
            let edited = edit_plant::change(document, edit);
            edit_plant::drop_broken_partition(document);
            poles::provide(document);
            return edited;
        }
        Edit::Method(method) => {
            document.design.method = method;
            poles::provide(document);
        }
        Edit::Order(order) => {
            document.design.order = order;
            poles::provide(document);
        }
        Edit::Poles(text) => match poles::parse(&text) {
            Ok(found) => document.design.poles = found,
            Err(error) => return Edited::Draft(Field::Poles, Draft { text, error }),
        },
        Edit::MovePole { index, to, .. } => {
            if to.re.is_finite() && to.im.is_finite() {
                poles::drag(document, index, to);
            }
        }
        Edit::Scale { scale, .. } => {
            if scale.is_finite() {
                document.design.scale = scale.clamp(0.01, 1000.0);
            }
        }
        Edit::RankTolerance(rank) => {
            if rank.is_finite() {
                document.tolerance.rank = rank.clamp(1.0, 1e12);
            }
        }
        Edit::Initial { .. }
        | Edit::Signal { .. }
        | Edit::Horizon(_)
        | Edit::Samples(_)
        | Edit::UncertaintyScale { .. }
        | Edit::UncertaintyCell { .. }
        | Edit::NoiseLevel { .. } => return edit_scenario::change(document, edit),
    }
    Edited::Done
}

fn clipped(text: String) -> String {
    if text.len() <= limits::MAX_TEXT { text } else { text.chars().take(limits::MAX_TEXT / 4).collect() }
}

/// A short name for a cell, `A[1, 2]` counted from one.
pub fn cell_name(cell: Cell) -> String {
    format!("{}[{}, {}]", cell.matrix.letter(), cell.row + 1, cell.column + 1)
}
