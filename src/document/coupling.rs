//! A coupling entry by entry: reading, changing, resizing; a list of entries stays one.

use std::collections::BTreeMap;

use super::entry::{Entry, EntryMatrix};
use super::limits::MAX_SIDE;
use super::model::Coupling;

/// Rows and columns up to which a coupling is written out in full, so that its entries can be expressions.
const WRITTEN_OUT: usize = 20;

impl Coupling {
    /// A coupling from its entries `(row, column, value)`, from zero: written out while it is small, else a list.
    ///
    /// Of two entries at one place the later counts; entries outside are ignored.
    pub fn from_entries(rows: usize, columns: usize, entries: &[(usize, usize, f64)]) -> Self {
        let mut coupling = if rows.max(columns) <= WRITTEN_OUT {
            Self::Dense(EntryMatrix::zeros(rows, columns))
        } else {
            Self::Sparse { rows, columns, entries: Vec::new() }
        };
        match &mut coupling {
            Self::Dense(matrix) => {
                for &(i, j, value) in entries {
                    matrix.set(i, j, Entry::number(value));
                }
            }
            Self::Sparse { entries: list, .. } => *list = listed(entries.iter().copied(), (rows, columns)),
        }
        coupling
    }

    /// The entry in row `i` and column `j`, from zero; `None` outside.
    pub fn entry(&self, i: usize, j: usize) -> Option<Entry> {
        match self {
            Self::Dense(matrix) => matrix.entry(i, j).cloned(),
            Self::Sparse { rows, columns, entries } => (i < *rows && j < *columns).then(|| {
                let found = entries.iter().rev().find(|entry| (entry.0, entry.1) == (i + 1, j + 1));
                Entry::number(found.map_or(0.0, |entry| entry.2))
            }),
        }
    }

    /// The value in row `i` and column `j`, from zero; zero outside.
    pub fn value(&self, i: usize, j: usize) -> f64 {
        self.entry(i, j).map_or(0.0, |entry| entry.value)
    }

    /// All entries that are not zero, `(row, column, value)` from zero, row by row.
    pub fn entries(&self) -> Vec<(usize, usize, f64)> {
        match self {
            Self::Dense(matrix) => {
                let (rows, columns) = matrix.shape();
                let places = (0..rows).flat_map(|i| (0..columns).map(move |j| (i, j)));
                let value = |(i, j)| (i, j, matrix.entry(i, j).map_or(0.0, |entry| entry.value));
                places.map(value).filter(|entry| entry.2 != 0.0).collect()
            }
            Self::Sparse { entries, .. } => {
                unique(entries).into_iter().map(|((i, j), v)| (i, j, v)).collect()
            }
        }
    }

    /// How many entries a document holds for it: all of a matrix that is written out, else those of the list.
    pub fn n_entries(&self) -> usize {
        match self {
            Self::Dense(matrix) => matrix.shape().0 * matrix.shape().1,
            Self::Sparse { entries, .. } => entries.len(),
        }
    }

    /// Replaces an entry, from zero; out of range is ignored.
    ///
    /// A list keeps values only: a small one is written out when an expression comes, a large one takes its value.
    pub fn set(&mut self, i: usize, j: usize, entry: Entry) {
        self.set_block((i, j), 1, vec![entry]);
    }

    /// Replaces a block of entries, row by row, whose first stands at `(row, column)`, from zero; what is out of range
    /// is ignored.
    pub fn set_block(&mut self, at: (usize, usize), columns: usize, block: Vec<Entry>) {
        let typed = block.iter().any(|entry| entry.text.is_some());
        let (height, width) = self.shape();
        if typed && height.max(width) <= WRITTEN_OUT {
            *self = Self::Dense(self.written_out());
        }
        let columns = columns.max(1);
        let place = |k: usize| (at.0 + k / columns, at.1 + k % columns);
        match self {
            Self::Dense(matrix) => {
                for (k, entry) in block.into_iter().enumerate() {
                    let (i, j) = place(k);
                    matrix.set(i, j, entry);
                }
            }
            Self::Sparse { rows, columns: width, entries } => {
                let mut all = unique(entries);
                all.extend(block.iter().enumerate().map(|(k, entry)| (place(k), entry.value)));
                *entries = listed(all.into_iter().map(|((i, j), value)| (i, j, value)), (*rows, *width));
            }
        }
    }

    /// The same entries in another shape: cut off at the end or filled with zeros.
    ///
    /// What no longer fits into a matrix that is written out becomes a list of its values.
    pub fn resized(&self, rows: usize, columns: usize) -> Self {
        match self {
            Self::Dense(matrix) if rows.max(columns) <= MAX_SIDE => {
                Self::Dense(matrix.resized(rows, columns))
            }
            _ => {
                let entries = listed(self.entries().into_iter(), (rows, columns));
                Self::Sparse { rows, columns, entries }
            }
        }
    }

    /// All entries; for small couplings only.
    fn written_out(&self) -> EntryMatrix {
        match self {
            Self::Dense(matrix) => matrix.clone(),
            Self::Sparse { .. } => EntryMatrix::from_matrix(&self.values()),
        }
    }
}

/// The entries of a list by their places, from zero.
fn unique(entries: &[(usize, usize, f64)]) -> BTreeMap<(usize, usize), f64> {
    entries.iter().map(|&(i, j, value)| ((i - 1, j - 1), value)).collect()
}

/// A document's list from entries `(row, column, value)`, from zero: sorted, without zeros.
fn listed(
    entries: impl Iterator<Item = (usize, usize, f64)>,
    (rows, columns): (usize, usize),
) -> Vec<(usize, usize, f64)> {
    let sorted: BTreeMap<(usize, usize), f64> = entries
        .filter(|(i, j, _)| *i < rows && *j < columns)
        .map(|(i, j, value)| ((i + 1, j + 1), value))
        .collect();
    sorted.into_iter().filter(|(_, value)| *value != 0.0).map(|((i, j), value)| (i, j, value)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sparse(side: usize) -> Coupling {
        Coupling::Sparse { rows: side, columns: side, entries: vec![(2, 1, 3.0), (1, 2, -1.0), (2, 1, 4.0)] }
    }

    #[test]
    fn the_later_of_two_entries_at_one_place_counts() {
        let coupling = sparse(30);
        assert_eq!((coupling.value(1, 0), coupling.value(0, 1)), (4.0, -1.0), "as the document reads it");
        assert_eq!(coupling.entries(), [(0, 1, -1.0), (1, 0, 4.0)], "row by row, each place once");
        assert!(coupling.entry(30, 0).is_none(), "outside");
    }

    #[test]
    fn a_large_list_stays_a_list() {
        let mut coupling = sparse(30);
        coupling.set(5, 6, Entry::typed("1/4").unwrap());
        coupling.set(1, 0, Entry::number(0.0));
        let expected = vec![(1, 2, -1.0), (6, 7, 0.25)];
        assert_eq!(coupling, Coupling::Sparse { rows: 30, columns: 30, entries: expected }, "values only");
        coupling.set(30, 0, Entry::number(1.0));
        assert_eq!(coupling.n_entries(), 2, "outside is ignored");
    }

    #[test]
    fn a_small_list_is_written_out_for_an_expression() {
        let mut coupling = sparse(3);
        coupling.set(2, 2, Entry::number(7.0));
        assert!(matches!(coupling, Coupling::Sparse { .. }), "a number needs no other form");
        coupling.set(0, 0, Entry::typed("1/3").unwrap());
        assert_eq!(coupling.entry(0, 0).unwrap().text.as_deref(), Some("1/3"), "the expression stays");
        assert_eq!(
            (coupling.value(1, 0), coupling.value(2, 2)),
            (4.0, 7.0),
            "with the entries that were there"
        );
    }

    #[test]
    fn what_outgrows_a_matrix_becomes_a_list() {
        let mut dense = Coupling::from_entries(2, 2, &[(0, 0, -1.0), (0, 1, 1.0)]);
        assert!(matches!(dense, Coupling::Dense(_)), "small");
        dense = dense.resized(MAX_SIDE + 1, MAX_SIDE + 1);
        assert_eq!(dense.entries(), [(0, 0, -1.0), (0, 1, 1.0)], "the same entries");
        assert!(matches!(dense, Coupling::Sparse { .. }), "a document writes no larger matrix out");
        assert_eq!(dense.resized(1, 1).entries(), [(0, 0, -1.0)], "cut off");
    }

    #[test]
    fn a_block_goes_into_both_forms() {
        let block: Vec<Entry> = [1.0, 2.0, 0.0, 4.0].map(Entry::number).into();
        for mut coupling in [sparse(30), Coupling::from_entries(3, 3, &[(1, 0, 4.0), (0, 1, -1.0)])] {
            coupling.set_block((1, 0), 2, block.clone());
            let found = [(1, 0), (1, 1), (2, 0), (2, 1), (0, 1)].map(|(i, j)| coupling.value(i, j));
            assert_eq!(found, [1.0, 2.0, 0.0, 4.0, -1.0], "{coupling:?}");
        }
    }
}
