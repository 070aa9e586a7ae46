//! Edits of what drives the states that a plant's equations leave free.

use nalgebra::DMatrix;

use super::state::{Draft, Field};
use super::update::Edited;
use crate::document::limits::MAX_SIDE;
use crate::document::{Document, Entry, EntryMatrix, FreeData, Sizes, matrix_from_text};
use crate::system::Signal;

/// A change of `v = v0(t) - K x`.
#[derive(Clone, Debug, PartialEq)]
pub enum FreeEdit {
    /// A signal `v0`, as typed.
    Signal {
        /// Which, from zero.
        index: usize,
        /// What was typed.
        text: String,
    },
    /// A whole feedback `K`; `None` takes it away.
    Feedback(Option<DMatrix<f64>>),
    /// One entry of the feedback, as typed; rows that are missing before it are filled with zeros.
    Cell {
        /// Row, from zero.
        row: usize,
        /// Column, from zero.
        column: usize,
        /// What was typed.
        text: String,
    },
    /// A whole feedback, as pasted.
    Paste(String),
}

/// Changes what drives the free states.
pub(super) fn change(document: &mut Document, edit: FreeEdit) -> Edited {
    let states = Sizes::of(&document.plant).states;
    let free = &mut document.scenario.free;
    match edit {
        FreeEdit::Signal { index, text } => match (Signal::parse(&text), Signal::parse("0")) {
            (Err(error), _) => {
                let draft = Draft { text, error: error.to_string() };
                return Edited::Draft(Field::FreeSignal(index), draft);
            }
            (Ok(signal), Ok(zero)) if index < MAX_SIDE => {
                // signals that are too many for now wait
                let count = free.signals.len().max(index + 1);
                free.signals.resize(count, zero);
                free.signals[index] = signal;
            }
            _ => {}
        },
        FreeEdit::Feedback(None) => free.feedback = None,
        FreeEdit::Feedback(Some(matrix)) => return whole(free, &EntryMatrix::from_matrix(&matrix), states),
        FreeEdit::Cell { row, column, text } => match Entry::typed(&text) {
            Err(error) => return Edited::Draft(Field::FreeFeedback(row, column), Draft { text, error }),
            Ok(entry) if row < MAX_SIDE && column < states && states <= MAX_SIDE => {
                let old = free.feedback.take().unwrap_or_else(|| EntryMatrix::zeros(row + 1, states));
                let mut matrix = old.resized(old.shape().0.max(row + 1), states);
                matrix.set(row, column, entry);
                free.feedback = Some(matrix);
            }
            Ok(_) => {}
        },
        FreeEdit::Paste(text) => match matrix_from_text(&text) {
            Err(error) => return Edited::Refused(format!("what was pasted is not a matrix: {error}")),
            Ok(pasted) => {
                let entry = |(text, value): &(String, f64)| {
                    Entry::typed(text).unwrap_or_else(|_| Entry::number(*value))
                };
                let entries = pasted.entries.iter().map(entry).collect();
                let matrix = EntryMatrix::from_entries(pasted.rows, pasted.columns, entries);
                return whole(free, &matrix, states);
            }
        },
    }
    Edited::Done
}

/// Puts a whole feedback in force that fits the states.
fn whole(free: &mut FreeData, matrix: &EntryMatrix, states: usize) -> Edited {
    let (rows, columns) = matrix.shape();
    if columns != states || !(1..=MAX_SIDE).contains(&rows) || states > MAX_SIDE {
        return Edited::Refused(format!(
            "the feedback is {rows} x {columns}: it needs a row for each free variable and {states} columns, one for each \
             state"
        ));
    }
    if matrix.values().iter().any(|x| !x.is_finite()) {
        return Edited::Refused("the feedback has entries that are not finite".to_owned());
    }
    free.feedback = Some(matrix.clone());
    Edited::Done
}

/// Lets the feedbacks of the scenario and of the figures follow the number of states.
pub(super) fn follow_sizes(document: &mut Document) {
    let states = Sizes::of(&document.plant).states;
    if let Some(feedback) = &mut document.scenario.free.feedback {
        *feedback = feedback.resized(feedback.shape().0, states);
    }
    let runs = document.figures.iter_mut().flat_map(|figure| figure.runs.iter_mut());
    let patches = runs.filter_map(|run| run.scenario.free.as_mut());
    for feedback in patches.filter_map(|free| free.feedback.as_mut()) {
        if feedback.ncols() != states {
            *feedback = feedback.clone().resize_horizontally(states, 0.0);
        }
    }
}
