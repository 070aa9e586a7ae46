//! Matrices of entries that a person typed: numbers or expressions.

use nalgebra::DMatrix;
use serde::{Deserialize, Serialize};
use serde_json::{Number, Value, json};

use super::DocumentError;
use super::cursor::Cursor;
use super::limits::MAX_SIDE;
use crate::expression;

/// A matrix entry: a number, or an expression such as `-1/3` with its value.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Entry {
    /// The value.
    pub value: f64,
    /// The expression as typed; `None` for a plain number.
    pub text: Option<String>,
}

impl Entry {
    /// A plain number.
    pub fn number(value: f64) -> Self {
        Self { value, text: None }
    }

    /// Reads what a person typed.
    ///
    /// # Errors
    /// The sentence of the expression reader.
    pub fn typed(text: &str) -> Result<Self, String> {
        let text = text.trim();
        let value = expression::constant(text).map_err(|error| error.to_string())?;
        let plain = text.parse::<f64>().is_ok_and(|number| number.to_bits() == value.to_bits());
        Ok(Self { value, text: (!plain).then(|| text.to_owned()) })
    }

    /// What a cell shows.
    pub fn shown(&self) -> String {
        self.text.clone().unwrap_or_else(|| {
            let magnitude = self.value.abs();
            if magnitude != 0.0 && !(1e-4..1e7).contains(&magnitude) {
                format!("{:e}", self.value)
            } else {
                format!("{}", self.value)
            }
        })
    }

    pub(super) fn read(cursor: &Cursor<'_>) -> Result<Self, DocumentError> {
        if cursor.is_number() {
            return Ok(Self::number(cursor.number()?));
        }
        if !cursor.is_text() {
            return Err(cursor.error("a number or an expression in quotes, such as \"-1/3\", is needed here"));
        }
        let text = cursor.text()?;
        Self::typed(text).map_err(|message| cursor.error(format!("an entry must be a constant: {message}")))
    }

    fn write(&self) -> Value {
        match &self.text {
            Some(text) => json!(text),
            None => number(self.value),
        }
    }
}

/// A number in JSON, whole ones without a fraction.
pub(super) fn number(value: f64) -> Value {
    const EXACT: f64 = 9.0e15;
    if value == 0.0 && value.is_sign_negative() {
        return json!(-0.0);
    }
    if value.fract() == 0.0 && value.abs() < EXACT {
        #[expect(clippy::cast_possible_truncation, reason = "whole and below 2^53")]
        return json!(value as i64);
    }
    Number::from_f64(value).map_or(Value::Null, Value::Number)
}

/// A dense matrix of entries, row by row.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct EntryMatrix {
    rows: usize,
    columns: usize,
    entries: Vec<Entry>,
}

impl EntryMatrix {
    /// Plain numbers.
    pub fn from_matrix(matrix: &DMatrix<f64>) -> Self {
        let entries = (0..matrix.nrows()).flat_map(|i| (0..matrix.ncols()).map(move |j| (i, j)));
        let entries = entries.map(|at| Entry::number(matrix[at])).collect();
        Self { rows: matrix.nrows(), columns: matrix.ncols(), entries }
    }

    /// Zeros.
    pub fn zeros(rows: usize, columns: usize) -> Self {
        Self { rows, columns, entries: vec![Entry::number(0.0); rows * columns] }
    }

    /// From entries row by row.
    ///
    /// # Panics
    /// When the number of entries is not `rows * columns`: a mistake of the caller.
    pub fn from_entries(rows: usize, columns: usize, entries: Vec<Entry>) -> Self {
        assert_eq!(entries.len(), rows * columns, "entries fill the matrix");
        Self { rows, columns, entries }
    }

    /// Rows and columns.
    pub fn shape(&self) -> (usize, usize) {
        (self.rows, self.columns)
    }

    /// The entry in row `i` and column `j`, from zero.
    pub fn entry(&self, i: usize, j: usize) -> Option<&Entry> {
        (i < self.rows && j < self.columns).then(|| &self.entries[i * self.columns + j])
    }

    /// Replaces an entry; out of range is ignored.
    pub fn set(&mut self, i: usize, j: usize, entry: Entry) {
        if i < self.rows && j < self.columns {
            self.entries[i * self.columns + j] = entry;
        }
    }

    /// The values.
    pub fn values(&self) -> DMatrix<f64> {
        DMatrix::from_row_iterator(self.rows, self.columns, self.entries.iter().map(|entry| entry.value))
    }

    /// The same entries in another shape: cut off at the end or filled with zeros.
    pub fn resized(&self, rows: usize, columns: usize) -> Self {
        let entry = |i: usize, j: usize| self.entry(i, j).cloned().unwrap_or_else(|| Entry::number(0.0));
        let entries =
            (0..rows).flat_map(|i| (0..columns).map(move |j| (i, j))).map(|(i, j)| entry(i, j)).collect();
        Self { rows, columns, entries }
    }

    /// Reads a list of rows of equal length.
    pub(super) fn read(cursor: &Cursor<'_>) -> Result<Self, DocumentError> {
        let rows = cursor.list(MAX_SIDE, "rows")?;
        let mut entries = Vec::new();
        let mut columns = 0;
        for (i, row) in rows.iter().enumerate() {
            let items = row.list(MAX_SIDE, "entries")?;
            if i == 0 {
                columns = items.len();
            } else if items.len() != columns {
                return Err(DocumentError::at(
                    &format!("{}, row {}", cursor.path(), i + 1),
                    format!("{} entries", items.len()),
                    format!("the first row has {columns}; all rows need the same number"),
                ));
            }
            for (j, item) in items.into_iter().enumerate() {
                let place = format!("{}[{}, {}]", cursor.path(), i + 1, j + 1);
                entries.push(Entry::read(&item.renamed(place))?);
            }
        }
        Ok(Self { rows: rows.len(), columns, entries })
    }

    /// Writes a list of rows.
    pub(super) fn write(&self) -> Value {
        let row = |i: usize| {
            Value::Array((0..self.columns).map(|j| self.entries[i * self.columns + j].write()).collect())
        };
        Value::Array((0..self.rows).map(row).collect())
    }
}
