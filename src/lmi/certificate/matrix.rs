//! Matrices of intervals.

use std::ops::{Add, Mul, Neg, Sub};

use nalgebra::DMatrix;

use super::Interval;

/// A matrix of intervals, with the operations in which an inequality is written.
///
/// # Panics
/// The operations panic when shapes do not fit, as those of ordinary matrices do: a mistake of the caller, who has the
/// data checked before.
///
/// # Examples
/// ```
/// use descry::lmi::certificate::{IntervalMatrix, proved_positive_definite};
/// use nalgebra::dmatrix;
/// // -(A' X + X A) > 0 for A = [-1 1; 0 -2], X = I
/// let (a, x) = (IntervalMatrix::from(&dmatrix![-1.0, 1.0; 0.0, -2.0]), IntervalMatrix::identity(2));
/// assert!(proved_positive_definite(&-&(&x * &a).he()));
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct IntervalMatrix {
    entries: DMatrix<Interval>,
}

impl From<&DMatrix<f64>> for IntervalMatrix {
    /// The entries exactly; the whole line where an entry is not finite.
    fn from(matrix: &DMatrix<f64>) -> Self {
        Self {
            entries: DMatrix::from_fn(matrix.nrows(), matrix.ncols(), |i, j| Interval::point(matrix[(i, j)])),
        }
    }
}

impl IntervalMatrix {
    /// Entry by entry.
    pub fn from_fn(rows: usize, columns: usize, entry: impl FnMut(usize, usize) -> Interval) -> Self {
        Self { entries: DMatrix::from_fn(rows, columns, entry) }
    }

    /// Exact zeros.
    pub fn zeros(rows: usize, columns: usize) -> Self {
        Self::from_fn(rows, columns, |_, _| Interval::ZERO)
    }

    /// The identity, exactly.
    pub fn identity(n: usize) -> Self {
        Self::from_fn(n, n, |i, j| if i == j { Interval::ONE } else { Interval::ZERO })
    }

    /// Number of rows.
    pub fn nrows(&self) -> usize {
        self.entries.nrows()
    }

    /// Number of columns.
    pub fn ncols(&self) -> usize {
        self.entries.ncols()
    }

    /// The entry in row `i` and column `j`.
    ///
    /// # Panics
    /// When there is no such entry.
    pub fn at(&self, i: usize, j: usize) -> Interval {
        self.entries[(i, j)]
    }

    /// The transpose.
    pub fn transpose(&self) -> Self {
        Self::from_fn(self.ncols(), self.nrows(), |i, j| self.at(j, i))
    }

    /// `M + M'`.
    pub fn he(&self) -> Self {
        self + &self.transpose()
    }

    /// Every entry times one number or interval.
    pub fn scaled(&self, factor: Interval) -> Self {
        Self::from_fn(self.nrows(), self.ncols(), |i, j| self.at(i, j) * factor)
    }

    /// Matrices of equal height side by side.
    ///
    /// # Panics
    /// When the heights differ.
    pub fn side_by_side(blocks: &[&Self]) -> Self {
        let rows = blocks.first().map_or(0, |block| block.nrows());
        let mut result = Self::zeros(rows, blocks.iter().map(|block| block.ncols()).sum());
        let mut left = 0;
        for block in blocks {
            assert_eq!(block.nrows(), rows, "blocks side by side have equal heights");
            result.place(0, left, block);
            left += block.ncols();
        }
        result
    }

    /// A symmetric block matrix from its upper triangle, row by row: `[[a11, a12, a13], [a22, a23], [a33]]`.
    ///
    /// # Panics
    /// When the blocks do not fit.
    pub fn symmetric(upper: &[&[&Self]]) -> Self {
        let sizes: Vec<usize> =
            upper.iter().map(|row| row.first().map_or(0, |block| block.nrows())).collect();
        let n = sizes.iter().sum();
        let mut result = Self::zeros(n, n);
        let mut top = 0;
        for (i, row) in upper.iter().enumerate() {
            assert_eq!(row.len(), upper.len() - i, "row {i} of an upper triangle begins at the diagonal");
            let mut left = top;
            for (block, width) in row.iter().zip(&sizes[i..]) {
                assert_eq!(block.ncols(), *width, "blocks above each other have equal widths");
                result.place(top, left, block);
                if left > top {
                    result.place(left, top, &block.transpose());
                }
                left += width;
            }
            top += sizes[i];
        }
        result
    }

    fn place(&mut self, top: usize, left: usize, block: &Self) {
        self.entries
            .view_mut((top, left), block.entries.shape())
            .zip_apply(&block.entries, |to, from| *to = from);
    }

    fn zip(&self, other: &Self, operation: impl Fn(Interval, Interval) -> Interval) -> Self {
        assert_eq!(self.entries.shape(), other.entries.shape(), "sums have terms of equal shape");
        Self::from_fn(self.nrows(), self.ncols(), |i, j| operation(self.at(i, j), other.at(i, j)))
    }
}

impl Add for &IntervalMatrix {
    type Output = IntervalMatrix;

    fn add(self, other: Self) -> IntervalMatrix {
        self.zip(other, Add::add)
    }
}

impl Sub for &IntervalMatrix {
    type Output = IntervalMatrix;

    fn sub(self, other: Self) -> IntervalMatrix {
        self.zip(other, Sub::sub)
    }
}

impl Neg for &IntervalMatrix {
    type Output = IntervalMatrix;

    fn neg(self) -> IntervalMatrix {
        IntervalMatrix::from_fn(self.nrows(), self.ncols(), |i, j| -self.at(i, j))
    }
}

impl Mul for &IntervalMatrix {
    type Output = IntervalMatrix;

    fn mul(self, other: Self) -> IntervalMatrix {
        assert_eq!(self.ncols(), other.nrows(), "a product has equal inner sizes");
        IntervalMatrix::from_fn(self.nrows(), other.ncols(), |i, j| {
            (0..self.ncols()).fold(Interval::ZERO, |sum, k| sum + self.at(i, k) * other.at(k, j))
        })
    }
}
