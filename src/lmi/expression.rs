//! Affine matrix expressions: what stands in the blocks of a linear matrix inequality.

use nalgebra::DMatrix;

use super::affine::Affine;

/// A matrix whose entries are affine in the variables of a [`super::Problem`]; a variable is one, too.
///
/// Sums, differences, negatives and products with constant matrices are written with operators, on values and on
/// references. Blocks without rows or without columns are welcome everywhere.
///
/// # Panics
/// All operations panic when shapes do not fit: a mistake in the source of an inequality, never of user data.
///
/// # Examples
/// ```
/// use descry::lmi::{Expr, Problem};
/// use nalgebra::dmatrix;
/// let mut problem = Problem::new();
/// let x = problem.symmetric("X", 2);
/// let (a, b) = (dmatrix![0.0, 1.0; -2.0, -3.0], dmatrix![0.0; 1.0]);
/// let block = Expr::symmetric(vec![
///     vec![-(&x * &a).he(), &x * &b],
///     vec![Expr::identity(1)],
/// ]);
/// assert_eq!((block.nrows(), block.ncols()), (3, 3));
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Expr {
    rows: usize,
    columns: usize,
    entries: Vec<Affine>, // column by column
}

impl Expr {
    /// A constant matrix.
    pub fn constant(matrix: &DMatrix<f64>) -> Self {
        let entries = matrix.iter().map(|x| Affine::constant(*x)).collect();
        Self { rows: matrix.nrows(), columns: matrix.ncols(), entries }
    }

    /// The zero matrix.
    pub fn zeros(rows: usize, columns: usize) -> Self {
        Self { rows, columns, entries: vec![Affine::default(); rows * columns] }
    }

    /// The identity matrix.
    pub fn identity(size: usize) -> Self {
        Self::from_fn(size, size, |i, j| Affine::constant(if i == j { 1.0 } else { 0.0 }))
    }

    /// Number of rows.
    pub fn nrows(&self) -> usize {
        self.rows
    }

    /// Number of columns.
    pub fn ncols(&self) -> usize {
        self.columns
    }

    /// The transpose.
    #[must_use]
    pub fn transpose(&self) -> Self {
        Self::from_fn(self.columns, self.rows, |i, j| self.entry(j, i).clone())
    }

    /// `X + X'`.
    ///
    /// # Panics
    /// When the expression is not square.
    #[must_use]
    pub fn he(&self) -> Self {
        assert!(self.rows == self.columns, "X + X' of a {} x {} expression", self.rows, self.columns);
        Self::from_fn(self.rows, self.columns, |i, j| {
            Affine::combination([(1.0, self.entry(i, j)), (1.0, self.entry(j, i))].into_iter())
        })
    }

    /// The expression times a number.
    #[must_use]
    pub fn scaled(&self, factor: f64) -> Self {
        let scaled = |entry: &Affine| Affine::combination(std::iter::once((factor, entry)));
        Self { entries: self.entries.iter().map(scaled).collect(), ..*self }
    }

    /// A scalar expression (1 x 1) times a constant matrix.
    ///
    /// # Panics
    /// When the expression is not 1 x 1.
    #[must_use]
    pub fn times(&self, matrix: &DMatrix<f64>) -> Self {
        assert!(
            (self.rows, self.columns) == (1, 1),
            "a scalar is needed, not {} x {}",
            self.rows,
            self.columns
        );
        Self::from_fn(matrix.nrows(), matrix.ncols(), |i, j| {
            Affine::combination(std::iter::once((matrix[(i, j)], self.entry(0, 0))))
        })
    }

    /// The sum of the diagonal, 1 x 1.
    ///
    /// # Panics
    /// When the expression is not square.
    #[must_use]
    pub fn trace(&self) -> Self {
        assert!(self.rows == self.columns, "trace of a {} x {} expression", self.rows, self.columns);
        let sum = Affine::combination((0..self.rows).map(|i| (1.0, self.entry(i, i))));
        Self { rows: 1, columns: 1, entries: vec![sum] }
    }

    /// `[A B C ...]`.
    ///
    /// # Panics
    /// When the heights differ.
    pub fn side_by_side(parts: &[Self]) -> Self {
        let rows = parts.first().map_or(0, Self::nrows);
        assert!(parts.iter().all(|part| part.rows == rows), "parts of different height side by side");
        let entries = parts.iter().flat_map(|part| part.entries.iter().cloned()).collect();
        Self { rows, columns: parts.iter().map(Self::ncols).sum(), entries }
    }

    /// `[A; B; C; ...]`.
    ///
    /// # Panics
    /// When the widths differ.
    pub fn stack(parts: &[Self]) -> Self {
        let columns = parts.first().map_or(0, Self::ncols);
        assert!(parts.iter().all(|part| part.columns == columns), "parts of different width stacked");
        let mut entries = Vec::new();
        for j in 0..columns {
            for part in parts {
                entries.extend((0..part.rows).map(|i| part.entry(i, j).clone()));
            }
        }
        Self { rows: parts.iter().map(Self::nrows).sum(), columns, entries }
    }

    /// A symmetric block matrix from its upper triangle, row by row: `[[a11, a12, a13], [a22, a23], [a33]]`.
    ///
    /// # Panics
    /// When the blocks do not fit together.
    pub fn symmetric(upper: Vec<Vec<Self>>) -> Self {
        let blocks = upper.len();
        let sizes: Vec<usize> = upper.iter().map(|row| row.first().map_or(0, Self::nrows)).collect();
        let starts: Vec<usize> = sizes
            .iter()
            .scan(0, |next, size| {
                let start = *next;
                *next += size;
                Some(start)
            })
            .collect();
        let size: usize = sizes.iter().sum();
        let mut whole = Self::zeros(size, size);
        for (k, row) in upper.into_iter().enumerate() {
            assert!(
                row.len() == blocks - k,
                "row {} of the upper triangle has {} blocks instead of {}",
                k + 1,
                row.len(),
                blocks - k
            );
            for (l, block) in (k..).zip(row) {
                assert!(
                    (block.rows, block.columns) == (sizes[k], sizes[l]),
                    "block ({}, {}) is {} x {} where {} x {} is needed",
                    k + 1,
                    l + 1,
                    block.rows,
                    block.columns,
                    sizes[k],
                    sizes[l]
                );
                for j in 0..block.columns {
                    for i in 0..block.rows {
                        let entry = block.entry(i, j).clone();
                        let (row, column) = (starts[k] + i, starts[l] + j);
                        if k != l {
                            whole.entries[column + row * size] = entry.clone();
                        }
                        whole.entries[row + column * size] = entry;
                    }
                }
            }
        }
        whole
    }

    pub(super) fn from_fn(rows: usize, columns: usize, entry: impl Fn(usize, usize) -> Affine) -> Self {
        let entries = (0..columns).flat_map(|j| (0..rows).map(move |i| (i, j)));
        Self { rows, columns, entries: entries.map(|(i, j)| entry(i, j)).collect() }
    }

    pub(super) fn entry(&self, row: usize, column: usize) -> &Affine {
        &self.entries[row + column * self.rows]
    }

    /// The number of variables that a point needs to have for this expression.
    pub(super) fn reach(&self) -> usize {
        self.entries.iter().map(Affine::reach).max().unwrap_or(0)
    }

    pub(super) fn value(&self, point: &[f64]) -> DMatrix<f64> {
        DMatrix::from_iterator(self.rows, self.columns, self.entries.iter().map(|entry| entry.value(point)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lmi::Problem;
    use nalgebra::dmatrix;

    /// `X` (2 x 2 symmetric) holds 1, 2, 3 as `x11, x12, x22`; `w` (1 x 2) holds 4, 5.
    const POINT: [f64; 5] = [1.0, 2.0, 3.0, 4.0, 5.0];

    fn variables() -> (Expr, Expr) {
        let mut problem = Problem::new();
        (problem.symmetric("X", 2), problem.matrix("W", 1, 2))
    }

    #[test]
    fn variables_are_numbered_as_the_upper_triangle_column_by_column() {
        let (x, w) = variables();
        assert_eq!(x.value(&POINT), dmatrix![1.0, 2.0; 2.0, 3.0], "symmetric variable");
        assert_eq!(w.value(&POINT), dmatrix![4.0, 5.0], "full variable");
    }

    #[test]
    fn blocks_from_the_upper_triangle_make_the_symmetric_matrix() {
        let (x, w) = variables();
        let whole = Expr::symmetric(vec![vec![x, w.transpose()], vec![Expr::identity(1)]]);
        let expected = dmatrix![1.0, 2.0, 4.0; 2.0, 3.0, 5.0; 4.0, 5.0, 1.0];
        assert_eq!(whole.value(&POINT), expected, "[X W'; W 1]");
    }

    #[test]
    fn stacks_and_rows_keep_their_parts_in_order() {
        let (x, w) = variables();
        let wide = Expr::side_by_side(&[w.clone(), Expr::zeros(1, 0), w.trace_of_first()]);
        assert_eq!(wide.value(&POINT), dmatrix![4.0, 5.0, 4.0], "[W, nothing, w1]");
        let tall = Expr::stack(&[Expr::zeros(0, 2), x, w]);
        assert_eq!(tall.value(&POINT), dmatrix![1.0, 2.0; 2.0, 3.0; 4.0, 5.0], "[nothing; X; W]");
    }

    #[test]
    fn scalar_times_a_matrix_and_trace() {
        let (x, _) = variables();
        assert_eq!(x.trace().value(&POINT), dmatrix![4.0], "1 + 3");
        assert_eq!(x.trace().times(&dmatrix![1.0, -2.0]).value(&POINT), dmatrix![4.0, -8.0], "4 * [1 -2]");
        assert_eq!(x.scaled(0.5).value(&POINT), dmatrix![0.5, 1.0; 1.0, 1.5], "X / 2");
    }

    #[test]
    #[should_panic(expected = "block (1, 2) is 2 x 2 where 2 x 1 is needed")]
    fn a_block_that_does_not_fit_is_named() {
        let (x, _) = variables();
        let _ = Expr::symmetric(vec![vec![x.clone(), x], vec![Expr::identity(1)]]);
    }

    #[test]
    fn blocks_without_rows_vanish() {
        let (x, _) = variables();
        let whole = Expr::symmetric(vec![
            vec![Expr::zeros(0, 0), Expr::zeros(0, 2), Expr::zeros(0, 0)],
            vec![x.clone(), Expr::zeros(2, 0)],
            vec![Expr::zeros(0, 0)],
        ]);
        assert_eq!(whole, x, "empty rows and columns add nothing");
        assert_eq!(Expr::symmetric(Vec::new()), Expr::zeros(0, 0), "no blocks at all");
    }

    impl Expr {
        fn trace_of_first(&self) -> Self {
            Self { rows: 1, columns: 1, entries: vec![self.entry(0, 0).clone()] }
        }
    }
}
