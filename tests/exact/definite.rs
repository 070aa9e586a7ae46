//! Exact judgement of definiteness: every finite `f64` is a rational number.

#![expect(clippy::unwrap_used, reason = "a judge that meets a doubtful number must stop")]

use nalgebra::DMatrix;
use num_rational::BigRational;
use num_traits::{Signed as _, Zero as _};

/// A matrix of rational numbers, row by row.
pub(crate) type Exact = Vec<Vec<BigRational>>;

/// The number itself.
pub(crate) fn rational(x: f64) -> BigRational {
    BigRational::from_float(x).unwrap()
}

/// Every entry without rounding.
pub(crate) fn exact(matrix: &DMatrix<f64>) -> Exact {
    matrix.row_iter().map(|row| row.iter().map(|x| rational(*x)).collect()).collect()
}

/// Whether a symmetric matrix is positive definite, by the signs of its exact pivots.
pub(crate) fn positive_definite(matrix: &Exact) -> bool {
    let mut rest = matrix.clone();
    let n = rest.len();
    for k in 0..n {
        let pivot = rest[k][k].clone();
        if !pivot.is_positive() {
            return false;
        }
        let row = rest[k].clone();
        for below in rest.iter_mut().skip(k + 1) {
            let factor = &below[k] / &pivot;
            if !factor.is_zero() {
                below.iter_mut().zip(&row).skip(k).for_each(|(x, above)| *x -= &factor * above);
            }
        }
    }
    true
}
