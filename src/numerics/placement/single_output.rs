//! The unique gain for one output: Hessenberg form and a product over the poles.
//!
//! No step subtracts what an earlier one added, so that every entry of the gain keeps its relative accuracy even where
//! the entries differ by twenty orders of magnitude; any multiplicity of the poles is allowed.

use nalgebra::{DMatrix, DVector};
use num_complex::Complex64;

use super::PlacementError;
use crate::numerics::PoleOrPair;

/// `A'` in the coordinates of the chain `c', A' c', A'^2 c' ...`.
///
/// ```text
/// basis' A' basis = hessenberg (upper Hessenberg),   c basis = [first 0 ... 0]
/// ```
#[derive(Clone, Debug)]
pub(super) struct Chain {
    /// Orthogonal, n x n; its first `order` columns span what the output sees.
    pub(super) basis: DMatrix<f64>,
    /// Upper Hessenberg in its first `order` columns; zero below the leading `order` x `order` block.
    pub(super) hessenberg: DMatrix<f64>,
    /// The only nonzero entry of the output.
    pub(super) first: f64,
    /// Length of the chain.
    pub(super) order: usize,
    /// Only rows and columns were swapped: every entry is one of the data, free of rounding.
    pub(super) exact: bool,
}

impl Chain {
    /// Reduces a pair by orthogonal similarities.
    ///
    /// Where a column has a single nonzero entry it is swapped into place instead of reflected, so that structured
    /// data (chains of integrators, companion matrices) stay exact.
    pub(super) fn new(a: &DMatrix<f64>, c: &DVector<f64>) -> Self {
        let n = a.nrows();
        let mut chain = Self {
            basis: DMatrix::identity(n, n),
            hessenberg: a.transpose(),
            first: 0.0,
            order: 0,
            exact: true,
        };
        let mut column = c.clone();
        while chain.order < n && chain.compress(&column) {
            if chain.order == 0 {
                chain.first = chain.basis.column(0).dot(c);
            }
            chain.order += 1;
            let done = chain.order;
            column = chain.hessenberg.view((done, done - 1), (n - done, 1)).column(0).into_owned();
        }
        chain
    }

    /// Turns the remaining coordinates so that a column over them has its first entry only; false for a zero column.
    fn compress(&mut self, column: &DVector<f64>) -> bool {
        let start = self.order;
        let nonzero: Vec<usize> = (0..column.len()).filter(|&i| column[i] != 0.0).collect();
        match nonzero[..] {
            [] => return false,
            [only] => {
                self.hessenberg.swap_rows(start, start + only);
                self.hessenberg.swap_columns(start, start + only);
                self.basis.swap_columns(start, start + only);
            }
            _ => {
                self.reflect(column);
                if let Some(previous) = start.checked_sub(1) {
                    self.hessenberg.view_mut((start + 1, previous), (column.len() - 1, 1)).fill(0.0);
                }
                self.exact = false;
            }
        }
        true
    }

    /// Householder reflection of the coordinates from `order` on that maps the column to a multiple of the first axis.
    fn reflect(&mut self, column: &DVector<f64>) {
        let (start, length) = (self.order, column.len());
        let mut u = column / column.amax();
        u[0] += u.norm().copysign(u[0]);
        u.normalize_mut();
        let mut rows = self.hessenberg.rows_mut(start, length);
        let projection = u.transpose() * &rows;
        rows -= &u * projection * 2.0;
        for matrix in [&mut self.hessenberg, &mut self.basis] {
            let mut columns = matrix.columns_mut(start, length);
            let projection = &columns * &u;
            columns -= projection * u.transpose() * 2.0;
        }
    }

    /// `h[k + 1, k]` of the chain.
    pub(super) fn subdiagonals(&self) -> impl Iterator<Item = f64> + '_ {
        (1..self.order).map(|k| self.hessenberg[(k, k - 1)])
    }

    /// The first columns of the basis, n x order.
    pub(super) fn observable_basis(&self) -> DMatrix<f64> {
        self.basis.columns(0, self.order).into_owned()
    }

    /// Ackermann's formula in the coordinates of the chain.
    ///
    /// ```text
    /// l = (prod_i (A - p_i I)) e_n / (first * prod_k h[k + 1, k])
    /// ```
    ///
    /// # Errors
    /// [`PlacementError::Overflow`] when an entry leaves the range of double precision.
    pub(super) fn gain(&self, poles: &[PoleOrPair]) -> Result<DVector<f64>, PlacementError> {
        let k = self.order;
        let a = self.hessenberg.view((0, 0), (k, k)).transpose();
        let mut l = DVector::zeros(k);
        l[k - 1] = 1.0;
        // dividing as the product grows keeps it within range
        let mut divisors = std::iter::once(self.first).chain(self.subdiagonals());
        for pole in poles {
            match *pole {
                PoleOrPair::Real(p) => l = &a * &l - &l * p,
                PoleOrPair::Pair(z) => {
                    // (A - z I)(A - conj(z) I) = (A - re I)^2 + im^2 I
                    let shifted = &a * &l - &l * z.re;
                    l = &a * &shifted - shifted * z.re + &l * (z.im * z.im);
                    l /= divisors.next().unwrap_or(1.0);
                }
            }
            l /= divisors.next().unwrap_or(1.0);
        }
        if l.iter().all(|x| x.is_finite()) { Ok(l) } else { Err(PlacementError::Overflow) }
    }

    /// Left eigenvector of the closed loop for a pole, in the coordinates of the chain, last entry 1.
    ///
    /// ```text
    /// (lambda I - H) x = e_1 det(lambda I - H) / prod_k h[k + 1, k]
    /// ```
    pub(super) fn eigenvector(&self, pole: Complex64) -> DVector<Complex64> {
        let k = self.order;
        let h = &self.hessenberg;
        let mut x = DVector::from_element(k, Complex64::ZERO);
        x[k - 1] = Complex64::ONE;
        for i in (1..k).rev() {
            let known: Complex64 = (i + 1..k).map(|j| x[j] * h[(i, j)]).sum();
            x[i - 1] = ((pole - h[(i, i)]) * x[i] - known) / h[(i, i - 1)];
        }
        x
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{dmatrix, dvector};

    #[test]
    fn structured_data_stay_exact() {
        // y = x3, x2' = x1, x3' = x2: the chain runs 3, 2, 1
        let a = dmatrix![0.0, 0.0, 0.0; 1.0, 0.0, 0.0; 0.0, 1.0, 0.0];
        let chain = Chain::new(&a, &dvector![0.0, 0.0, 2.0]);
        assert!(chain.exact && chain.order == 3, "{chain:?}");
        assert_eq!(chain.first, 2.0, "the output's entry");
        let gain = &chain.basis * chain.gain(&[PoleOrPair::Real(-1.0); 3]).unwrap();
        // (s + 1)^3 = s^3 + 3 s^2 + 3 s + 1
        assert_eq!(gain, dvector![0.5, 1.5, 1.5], "halves of the binomial coefficients, exactly");
    }

    #[test]
    fn reduction_is_a_similarity() {
        let a = dmatrix![1.0, 2.0, 0.5; -1.0, 0.3, 2.0; 0.7, -0.4, -1.0];
        let c = dvector![1.0, -2.0, 0.5];
        let chain = Chain::new(&a, &c);
        assert!(!chain.exact && chain.order == 3, "{chain:?}");
        let again = &chain.basis * &chain.hessenberg * chain.basis.transpose();
        assert!((again - a.transpose()).norm() < 1e-14, "A' = Q H Q'");
        assert_eq!(chain.hessenberg[(2, 0)], 0.0, "upper Hessenberg");
        let output = chain.basis.tr_mul(&c);
        assert!((output - dvector![chain.first, 0.0, 0.0]).norm() < 1e-14, "c Q = [first 0 0]");
    }

    #[test]
    fn chain_ends_where_the_output_sees_no_further() {
        let a = dmatrix![-1.0, 0.0, 0.0; 0.0, -2.0, 3.0; 5.0, 0.0, -4.0];
        let chain = Chain::new(&a, &dvector![1.0, 0.0, 0.0]);
        assert_eq!((chain.order, chain.exact), (1, true), "x1 does not depend on the others");
    }
}
