//! Edits of the nonlinearity `G f(x)`.

use super::model_edits::{LipschitzEdit, LipschitzMatrix};
use super::state::{Draft, Field};
use super::update::Edited;
use crate::document::limits::{MAX_SIDE, MAX_TEXT};
use crate::document::{Document, Entry, EntryMatrix, LipschitzData, Matrix, PlantData, matrix_from_text};
use crate::system::nonlinearity;

/// Largest constant that documents hold.
const LARGEST: f64 = 1e6;

/// Changes the nonlinearity of a document.
pub(super) fn change(document: &mut Document, edit: LipschitzEdit) -> Edited {
    let PlantData::Descriptor(data) = &mut document.plant else {
        return Edited::Refused(
            "the subsystems of a network are linear: it takes no nonlinearity".to_owned(),
        );
    };
    let (equations, states) = data.matrix(Matrix::E).shape();
    match edit {
        LipschitzEdit::Add => {
            data.lipschitz.get_or_insert_with(|| first(equations, states));
            return Edited::Done;
        }
        LipschitzEdit::Remove => {
            data.lipschitz = None;
            return Edited::Done;
        }
        _ => {}
    }
    let Some(lipschitz) = &mut data.lipschitz else { return Edited::Done };
    match edit {
        LipschitzEdit::Add | LipschitzEdit::Remove => {}
        LipschitzEdit::Cell { matrix, row, column, text } => match Entry::typed(&text) {
            Ok(entry) => matrix_of(lipschitz, matrix).set(row, column, entry),
            Err(error) => {
                return Edited::Draft(Field::Lipschitz(matrix, row, column), Draft { text, error });
            }
        },
        LipschitzEdit::Paste { matrix, text } => {
            return paste(lipschitz, matrix, &text, (equations, states));
        }
        LipschitzEdit::Component { index, text } => {
            let text = text.trim().to_owned();
            let understood = nonlinearity(&text, states).map_err(|error| error.to_string());
            let short =
                || (text.len() <= MAX_TEXT).then_some(()).ok_or_else(|| "this is too long".to_owned());
            match (understood.and_then(|_| short()), lipschitz.f.get_mut(index)) {
                (Ok(()), Some(component)) => *component = text,
                (Ok(()), None) => {}
                (Err(error), _) => return Edited::Draft(Field::Component(index), Draft { text, error }),
            }
        }
        LipschitzEdit::Constant(text) => match constant(&text) {
            Ok(value) => lipschitz.constant = value,
            Err(error) => return Edited::Draft(Field::LipschitzConstant, Draft { text, error }),
        },
        LipschitzEdit::Size { of, grow } => return resize(lipschitz, of, grow),
    }
    Edited::Done
}

/// A nonlinearity to begin with: the sine of the first state in the first equation.
fn first(equations: usize, states: usize) -> LipschitzData {
    let unit = |rows, columns| {
        let mut matrix = EntryMatrix::zeros(rows, columns);
        matrix.set(0, 0, Entry::number(1.0));
        matrix
    };
    LipschitzData {
        G: unit(equations, 1),
        F_L: unit(1, states),
        f: vec!["sin(x1)".to_owned()],
        constant: 1.0,
    }
}

fn matrix_of(lipschitz: &mut LipschitzData, matrix: LipschitzMatrix) -> &mut EntryMatrix {
    match matrix {
        LipschitzMatrix::G => &mut lipschitz.G,
        LipschitzMatrix::Arguments => &mut lipschitz.F_L,
    }
}

fn constant(text: &str) -> Result<f64, String> {
    let value = Entry::typed(text)?.value;
    if (0.0..=LARGEST).contains(&value) {
        return Ok(value);
    }
    Err(format!("a Lipschitz constant lies between 0 and {LARGEST:e}"))
}

fn resize(lipschitz: &mut LipschitzData, of: LipschitzMatrix, grow: bool) -> Edited {
    let (what, count) = match of {
        LipschitzMatrix::G => ("component", lipschitz.f.len()),
        LipschitzMatrix::Arguments => ("row of F_L", lipschitz.F_L.shape().0),
    };
    if !grow && count <= 1 {
        return Edited::Refused(format!(
            "a nonlinearity needs at least one {what}; it can be removed as a whole"
        ));
    }
    if grow && count >= MAX_SIDE {
        return Edited::Refused(format!("at most {MAX_SIDE} are possible"));
    }
    let count = if grow { count + 1 } else { count - 1 };
    match of {
        LipschitzMatrix::G => {
            lipschitz.f.resize(count, "0".to_owned());
            lipschitz.G = lipschitz.G.resized(lipschitz.G.shape().0, count);
        }
        LipschitzMatrix::Arguments => {
            lipschitz.F_L = lipschitz.F_L.resized(count, lipschitz.F_L.shape().1);
        }
    }
    Edited::Done
}

/// Puts a whole `G` or `F_L` in force; the side that the system determines must fit.
fn paste(lipschitz: &mut LipschitzData, of: LipschitzMatrix, text: &str, system: (usize, usize)) -> Edited {
    let pasted = match matrix_from_text(text) {
        Ok(pasted) => pasted,
        Err(error) => return Edited::Refused(format!("what was pasted is not a matrix: {error}")),
    };
    let (rows, columns) = (pasted.rows, pasted.columns);
    let (fits, needed) = match of {
        LipschitzMatrix::G => (rows == system.0, format!("G needs {} rows, one for each equation", system.0)),
        LipschitzMatrix::Arguments => {
            (columns == system.1, format!("F_L needs {} columns, one for each state", system.1))
        }
    };
    if !fits || rows == 0 || columns == 0 || rows.max(columns) > MAX_SIDE {
        return Edited::Refused(format!("the pasted matrix is {rows} x {columns}: {needed}"));
    }
    let entry = |(text, value): &(String, f64)| Entry::typed(text).unwrap_or_else(|_| Entry::number(*value));
    let entries = EntryMatrix::from_entries(rows, columns, pasted.entries.iter().map(entry).collect());
    match of {
        LipschitzMatrix::G => {
            lipschitz.f.resize(columns, "0".to_owned());
            lipschitz.G = entries;
        }
        LipschitzMatrix::Arguments => lipschitz.F_L = entries,
    }
    Edited::Done
}

/// Lets a nonlinearity follow the system's sizes; says which components had to go.
pub(super) fn follow_sizes(document: &mut Document) -> Option<String> {
    let PlantData::Descriptor(data) = &mut document.plant else { return None };
    let (equations, states) = data.matrix(Matrix::E).shape();
    let lipschitz = data.lipschitz.as_mut()?;
    let understood: Vec<bool> = lipschitz.f.iter().map(|f| nonlinearity(f, states).is_ok()).collect();
    let gone: Vec<String> =
        lipschitz.f.iter().zip(&understood).filter(|(_, good)| !**good).map(|(f, _)| f.clone()).collect();
    let kept: Vec<usize> = (0..understood.len()).filter(|k| understood[*k]).collect();
    let entry = |i: usize, j: usize| lipschitz.G.entry(i, j).cloned().unwrap_or_else(|| Entry::number(0.0));
    let cells = (0..equations).flat_map(|i| kept.iter().map(move |j| (i, *j))).map(|(i, j)| entry(i, j));
    let distribution = EntryMatrix::from_entries(equations, kept.len(), cells.collect());
    lipschitz.G = distribution;
    lipschitz.f = kept.iter().filter_map(|k| lipschitz.f.get(*k).cloned()).collect();
    lipschitz.F_L = lipschitz.F_L.resized(lipschitz.F_L.shape().0, states);
    if gone.is_empty() {
        return None;
    }
    let what = gone.join(", ");
    if kept.is_empty() {
        data.lipschitz = None;
        return Some(format!("the nonlinearity {what} went with the state that it needs"));
    }
    Some(format!("the component {what} of the nonlinearity went with the state that it needs"))
}
