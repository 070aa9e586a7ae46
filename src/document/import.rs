//! Whole matrices pasted from other programs.
//!
//! ```text
//! MATLAB, Octave, Julia   A = [1 2; 3 -1/3];       [1, 2 ...
//! NumPy, JSON, printed    np.array([[1, 2], [3, 4]])    [[1. 2.]\n [3. 4.]]
//! Mathematica             {{1, 2}, {3, 4}}
//! Rust (nalgebra)         dmatrix![1.0, 2.0; 3.0, 4.0]
//! LaTeX                   \begin{bmatrix} 1 & \frac{1}{3} \\ 0 & \sqrt{2} \end{bmatrix}
//! spreadsheets            tab, comma or semicolon between the cells; decimal commas with tab and semicolon
//! ```

use nalgebra::DMatrix;

use super::import_cells::{Rows, bracket_rows, delimited_rows, nested_rows};
use super::import_latex::latex_rows;
use crate::expression::{ExpressionError, constant};

/// Most rows, and most columns.
pub(super) const MAX_SIDE: usize = 200;
/// Longest text, in bytes.
const MAX_BYTES: usize = 1_000_000;

/// A matrix that was read, with the text of each entry.
#[derive(Clone, Debug, PartialEq)]
pub struct PastedMatrix {
    /// Number of rows, at least one.
    pub rows: usize,
    /// Number of columns, at least one.
    pub columns: usize,
    /// Text (which [`constant`] reads) and value of each entry, row by row.
    pub entries: Vec<(String, f64)>,
}

impl PastedMatrix {
    /// The values, rows x columns.
    pub fn values(&self) -> DMatrix<f64> {
        DMatrix::from_row_iterator(self.rows, self.columns, self.entries.iter().map(|(_, value)| *value))
    }
}

/// A text that is not a matrix.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum ImportError {
    /// No entry at all.
    #[error("there is no entry in the text; paste a matrix such as [1 2; 3 4]")]
    Empty,
    /// More text than is read.
    #[error("the text has {bytes} bytes; at most {MAX_BYTES} are read")]
    TooLong {
        /// How many there are.
        bytes: usize,
    },
    /// More rows or columns than are read.
    #[error("the matrix has more than {MAX_SIDE} rows or columns; at most {MAX_SIDE} x {MAX_SIDE} are read")]
    TooLarge,
    /// Rows of different lengths.
    #[error("row {row} has {found}, but the first row has {first}; every row needs as many entries as the first",
        found = entries(*found), first = entries(*first))]
    Ragged {
        /// The row, from one.
        row: usize,
        /// How many entries it has.
        found: usize,
        /// How many the first row has.
        first: usize,
    },
    /// An entry that is not a finite number.
    #[error("row {row}, column {column}: `{text}`: {reason}")]
    Entry {
        /// The row, from one.
        row: usize,
        /// The column, from one.
        column: usize,
        /// What stands there, shortened.
        text: String,
        /// Why it is not a number.
        reason: ExpressionError,
    },
    /// A bracket without its partner.
    #[error("a bracket has no partner: `{missing}` is missing")]
    Bracket {
        /// The bracket to add.
        missing: &'static str,
    },
    /// Something beside the matrix that would change its meaning.
    #[error("`{text}` beside the matrix is not understood; paste the matrix alone")]
    Beside {
        /// What stands there, shortened.
        text: String,
    },
}

fn entries(count: usize) -> String {
    if count == 1 { "1 entry".to_owned() } else { format!("{count} entries") }
}

/// Reads a whole matrix in any of the notations above; a single number is a 1 x 1 matrix.
///
/// Without brackets a line of cells between semicolons is a row, as spreadsheets write it, and `1,5;2,5` on it are decimal
/// commas; `1 2; 3 4` and lines that end in a semicolon are rows between semicolons, as in MATLAB.
///
/// # Errors
/// What was found, in which row and column, and what is needed.
///
/// # Examples
/// ```
/// use descry::document::matrix_from_text;
/// let matrix = matrix_from_text("A = [1 -2; 0 -1/4];")?;
/// assert_eq!((matrix.rows, matrix.columns), (2, 2));
/// assert_eq!(matrix.entries[3], ("-1/4".to_owned(), -0.25));
/// # Ok::<(), descry::document::ImportError>(())
/// ```
pub fn matrix_from_text(text: &str) -> Result<PastedMatrix, ImportError> {
    if text.len() > MAX_BYTES {
        return Err(ImportError::TooLong { bytes: text.len() });
    }
    let text = text.replace("\r\n", "\n").replace('\r', "\n").replace(['\u{feff}', '\u{200b}'], "");
    let text = text.replace(['\u{a0}', '\u{202f}', '\u{2009}'], " ");
    let rows = if text.contains("\\begin") || text.contains('\\') {
        latex_rows(&text)?
    } else {
        let text = without_comments(&text);
        match text.find(['[', '{']) {
            Some(start) => enclosed(&text, start)?,
            None => delimited_rows(right_hand_side(text.trim()).unwrap_or(text.trim_matches(['\n', ' '])))?,
        }
    };
    evaluated(&rows)
}

/// The rows within the brackets that open at `start`; what stands around them must not matter.
fn enclosed(text: &str, start: usize) -> Result<Rows, ImportError> {
    let (before, rest) = text.split_at(start);
    let before = before.trim();
    let call = right_hand_side(before).unwrap_or(before);
    if !is_wrapper(call) {
        return Err(ImportError::Beside { text: shortened(before) });
    }
    let end = matching(rest)?;
    let (inside, after) = (&rest[1..end], &rest[end + 1..]);
    let after = after.trim();
    let kind = after.split_once("dtype").map_or(after, |(before, _)| before);
    let closing = |c: char| c.is_whitespace() || matches!(c, ')' | ';' | ',' | '"' | '\'' | '$' | '.');
    let transposed =
        after.starts_with('\'') && !call.ends_with('\'') || after.contains(".T") || after.starts_with(".'");
    if transposed || !kind.chars().all(closing) {
        return Err(ImportError::Beside { text: shortened(after) });
    }
    let inner = inside.trim_start();
    if inner.starts_with(['[', '{']) { nested_rows(inner) } else { bracket_rows(inside) }
}

/// Calls and markers that leave a matrix as it is.
fn is_wrapper(call: &str) -> bool {
    let call = call.strip_suffix('(').unwrap_or(call).trim();
    let name = call.rsplit(['.', ':']).next().unwrap_or(call);
    let known =
        ["", "array", "asarray", "matrix", "mat", "Matrix", "dmatrix!", "matrix!", "Float64", "list", "N"];
    let path = &call[..call.len() - name.len()];
    known.contains(&name) && path.chars().all(|c| c.is_ascii_alphanumeric() || matches!(c, '.' | ':' | '_'))
}

/// What follows `A =`, `A :=`, `let A =` or `A: type =`.
fn right_hand_side(text: &str) -> Option<&str> {
    let (left, right) = text.split_once('=')?;
    let named = |c: char| c.is_alphanumeric() || matches!(c, '_' | ' ' | ':' | '<' | '>' | '.' | '\n');
    let begins = left.trim_start().starts_with(|c: char| c.is_alphabetic() || c == '_');
    (begins && left.chars().all(named)).then(|| right.trim())
}

/// Where the bracket closes that opens the text.
fn matching(text: &str) -> Result<usize, ImportError> {
    let mut open = Vec::new();
    for (place, c) in text.char_indices() {
        match c {
            '[' => open.push(("]", ']')),
            '{' => open.push(("}", '}')),
            ']' | '}' => match open.pop() {
                Some((_, partner)) if partner == c => {}
                Some((missing, _)) => return Err(ImportError::Bracket { missing }),
                None => return Err(ImportError::Bracket { missing: "[" }),
            },
            _ => {}
        }
        if open.is_empty() {
            return Ok(place);
        }
    }
    Err(ImportError::Bracket { missing: open.last().map_or("]", |(missing, _)| missing) })
}

/// Without `% ...` and `# ...`, and with lines that `...` continues joined.
fn without_comments(text: &str) -> String {
    let mut joined = String::with_capacity(text.len());
    for line in text.lines() {
        let line = line.split(['%', '#']).next().unwrap_or("");
        if let Some((kept, _)) = line.split_once("...") {
            joined.push_str(kept);
            joined.push(' ');
        } else {
            joined.push_str(line);
            joined.push('\n');
        }
    }
    joined
}

/// Values of all entries; all rows must have the same length.
fn evaluated(rows: &Rows) -> Result<PastedMatrix, ImportError> {
    let columns = rows.first().map_or(0, Vec::len);
    if columns == 0 {
        return Err(ImportError::Empty);
    }
    if rows.len() > MAX_SIDE || columns > MAX_SIDE {
        return Err(ImportError::TooLarge);
    }
    let mut entries = Vec::with_capacity(rows.len() * columns);
    for (i, row) in rows.iter().enumerate() {
        if row.len() != columns {
            return Err(ImportError::Ragged { row: i + 1, found: row.len(), first: columns });
        }
        for (j, cell) in row.iter().enumerate() {
            let text = common_notation(cell);
            let value = constant(&text).map_err(|reason| ImportError::Entry {
                row: i + 1,
                column: j + 1,
                text: shortened(&text),
                reason,
            })?;
            entries.push((text, value));
        }
    }
    Ok(PastedMatrix { rows: rows.len(), columns, entries })
}

/// Python's, Julia's and Mathematica's notation of an entry in that of [`crate::expression`].
fn common_notation(cell: &str) -> String {
    let mut text = cell.trim().to_owned();
    for (theirs, ours) in [
        ("numpy.", ""),
        ("np.", ""),
        ("math.", ""),
        ("**", "^"),
        ("//", "/"),
        ("*^", "e"),
        ("Sqrt[", "sqrt("),
        ("Exp[", "exp("),
        ("Sin[", "sin("),
        ("Cos[", "cos("),
        ("]", ")"),
    ] {
        if text.contains(theirs) {
            text = text.replace(theirs, ours);
        }
    }
    text
}

/// At most 40 characters.
fn shortened(text: &str) -> String {
    if text.chars().count() <= 40 {
        return text.to_owned();
    }
    let mut short: String = text.chars().take(37).collect();
    short.push_str("...");
    short
}

#[cfg(test)]
#[path = "import_tests.rs"]
mod tests;
