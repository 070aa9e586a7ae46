//! The coupling of a network: who listens to whom, dense or as a list of entries.

use nalgebra::DMatrix;

/// A matrix of couplings, which in large networks holds few entries.
///
/// Row i says what subsystem i receives: `u_i = sum_j Gamma_ij w_j`.
#[derive(Clone, Debug, PartialEq)]
pub enum CouplingMatrix {
    /// All entries.
    Dense(DMatrix<f64>),
    /// Only the entries that are not zero.
    Sparse {
        /// Number of rows.
        rows: usize,
        /// Number of columns.
        columns: usize,
        /// `(row, column, value)`, from zero; entries of one place add up.
        entries: Vec<(usize, usize, f64)>,
    },
}

impl CouplingMatrix {
    /// Rows and columns.
    pub fn shape(&self) -> (usize, usize) {
        match self {
            Self::Dense(matrix) => matrix.shape(),
            Self::Sparse { rows, columns, .. } => (*rows, *columns),
        }
    }

    /// Rows of the matrix.
    pub fn nrows(&self) -> usize {
        self.shape().0
    }

    /// All entries; for small networks only.
    pub fn dense(&self) -> DMatrix<f64> {
        match self {
            Self::Dense(matrix) => matrix.clone(),
            Self::Sparse { rows, columns, entries } => {
                let mut matrix = DMatrix::zeros(*rows, *columns);
                for &(i, j, value) in entries {
                    matrix[(i, j)] += value;
                }
                matrix
            }
        }
    }

    /// `Gamma X`.
    ///
    /// # Panics
    /// When `X` has not as many rows as the matrix has columns.
    pub fn times(&self, x: &DMatrix<f64>) -> DMatrix<f64> {
        let (rows, columns) = self.shape();
        assert_eq!(x.nrows(), columns, "rows of the factor");
        match self {
            Self::Dense(matrix) => matrix * x,
            Self::Sparse { entries, .. } => {
                let mut result = DMatrix::zeros(rows, x.ncols());
                for (mut to, from) in result.column_iter_mut().zip(x.column_iter()) {
                    for &(i, j, value) in entries {
                        to[i] += value * from[j];
                    }
                }
                result
            }
        }
    }

    /// `Gamma' X`.
    ///
    /// # Panics
    /// When `X` has not as many rows as the matrix.
    pub fn transposed_times(&self, x: &DMatrix<f64>) -> DMatrix<f64> {
        let (rows, columns) = self.shape();
        assert_eq!(x.nrows(), rows, "rows of the factor");
        match self {
            Self::Dense(matrix) => matrix.tr_mul(x),
            Self::Sparse { entries, .. } => {
                let mut result = DMatrix::zeros(columns, x.ncols());
                for (mut to, from) in result.column_iter_mut().zip(x.column_iter()) {
                    for &(i, j, value) in entries {
                        to[j] += value * from[i];
                    }
                }
                result
            }
        }
    }

    /// The columns of the transpose that belong to `rows` rows from `first` on: a strip of `Gamma'`, dense.
    ///
    /// Strips let a caller go through a large matrix without holding all of it.
    pub fn strip(&self, first: usize, rows: usize) -> DMatrix<f64> {
        match self {
            Self::Dense(matrix) => matrix.rows(first, rows).transpose(),
            Self::Sparse { columns, entries, .. } => {
                let mut strip = DMatrix::zeros(*columns, rows);
                for &(i, j, value) in entries.iter().filter(|(i, _, _)| (first..first + rows).contains(i)) {
                    strip[(j, i - first)] += value;
                }
                strip
            }
        }
    }

    /// The matrix of absolute values, which bounds what rounding can leave in products.
    pub fn abs(&self) -> Self {
        match self {
            Self::Dense(matrix) => Self::Dense(matrix.abs()),
            Self::Sparse { rows, columns, entries } => Self::Sparse {
                rows: *rows,
                columns: *columns,
                entries: entries.iter().map(|&(i, j, value)| (i, j, value.abs())).collect(),
            },
        }
    }

    /// The place of the first entry that is not finite.
    pub fn not_finite(&self) -> Option<(usize, usize)> {
        match self {
            Self::Dense(matrix) => {
                let at = matrix.iter().position(|x| !x.is_finite())?;
                Some((at % matrix.nrows(), at / matrix.nrows()))
            }
            Self::Sparse { entries, .. } => {
                entries.iter().find(|(_, _, value)| !value.is_finite()).map(|&(i, j, _)| (i, j))
            }
        }
    }

    /// One more than the largest row and column of an entry: what the shape must cover at least.
    pub(super) fn reach(&self) -> (usize, usize) {
        match self {
            Self::Dense(matrix) => matrix.shape(),
            Self::Sparse { entries, .. } => entries
                .iter()
                .fold((0, 0), |(rows, columns), &(i, j, _)| (rows.max(i + 1), columns.max(j + 1))),
        }
    }
}

impl From<DMatrix<f64>> for CouplingMatrix {
    fn from(matrix: DMatrix<f64>) -> Self {
        Self::Dense(matrix)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::dmatrix;

    fn sparse() -> CouplingMatrix {
        CouplingMatrix::Sparse { rows: 3, columns: 3, entries: vec![(0, 1, 2.0), (2, 0, -1.0), (0, 1, 0.5)] }
    }

    #[test]
    fn products_of_a_list_are_those_of_its_dense_matrix() {
        let (list, dense) = (sparse(), sparse().dense());
        assert_eq!(dense[(0, 1)], 2.5, "entries of one place add up");
        let x = dmatrix![1.0, 4.0; 2.0, 5.0; 3.0, 6.0];
        assert_eq!(list.times(&x), &dense * &x, "Gamma X");
        assert_eq!(list.transposed_times(&x), dense.tr_mul(&x), "Gamma' X");
        assert_eq!(list.strip(1, 2), dense.rows(1, 2).transpose(), "columns of Gamma'");
        assert_eq!(
            CouplingMatrix::from(dense.clone()).strip(0, 1),
            dense.rows(0, 1).transpose(),
            "dense strip"
        );
    }

    #[test]
    fn an_entry_that_is_not_finite_is_found_in_both_forms() {
        let mut matrix = DMatrix::zeros(3, 3);
        matrix[(2, 1)] = f64::NAN;
        assert_eq!(CouplingMatrix::from(matrix).not_finite(), Some((2, 1)), "dense");
        let list = CouplingMatrix::Sparse { rows: 3, columns: 3, entries: vec![(2, 1, f64::INFINITY)] };
        assert_eq!(list.not_finite(), Some((2, 1)), "sparse");
    }
}
