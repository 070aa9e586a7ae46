//! Bases that depend on their space alone, and matrices without rounding noise.

use nalgebra::DMatrix;

/// What an entry must exceed to count, relative to the size of the terms it was made of.
const ROUNDING: f64 = 64.0 * f64::EPSILON;

/// The matrix with entries below the rounding of its terms set to zero.
///
/// A solver makes use of every entry, also of those that should be zero; `terms` is the size of what was added up.
pub(super) fn tidy(matrix: &DMatrix<f64>, terms: f64) -> DMatrix<f64> {
    matrix.map(|x| if x.abs() <= ROUNDING * terms { 0.0 } else { x })
}

/// A product with entries below rounding set to zero.
pub(super) fn product(factors: &[&DMatrix<f64>]) -> DMatrix<f64> {
    let Some((first, rest)) = factors.split_first() else { return DMatrix::zeros(0, 0) };
    let whole = rest.iter().fold((*first).clone(), |left, right| left * *right);
    tidy(&whole, factors.iter().map(|factor| factor.norm()).product())
}

/// Another orthonormal basis (rows) of the same space, which does not depend on the one that is given.
///
/// ```text
/// pivot = the unit vector with the longest projection (the first of equal ones), row = that projection / its length,
/// the rest of the space likewise
/// ```
///
/// The pivot entry of a row is positive; a space of coordinate axes gives unit vectors in their order.
pub(super) fn orthonormal_rows(basis: &DMatrix<f64>) -> DMatrix<f64> {
    // lengths that are equal up to rounding, so that rounding does not choose
    const ALMOST: f64 = 1.0 - 1e-9;
    let (rows, columns) = basis.shape();
    let mut projector = basis.tr_mul(basis);
    let mut result = DMatrix::zeros(rows, columns);
    for k in 0..rows {
        let largest = projector.diagonal().iter().copied().fold(0.0, f64::max);
        let Some(pivot) = (0..columns).find(|&j| projector[(j, j)] >= ALMOST * largest && largest > 0.0)
        else {
            break;
        };
        let mut row = projector.row(pivot).into_owned();
        // once more against the earlier rows: deflation alone loses orthogonality
        for earlier in 0..k {
            let known = result.row(earlier).into_owned();
            row -= &known * known.dot(&row);
        }
        row /= row.norm();
        projector -= row.tr_mul(&row);
        result.set_row(k, &row);
    }
    tidy(&result, 1.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numerics::Random;
    use nalgebra::dmatrix;

    #[test]
    fn a_space_of_axes_gives_unit_vectors() {
        let root = 0.5_f64.sqrt();
        let rotated = dmatrix![0.0, root, -root; 0.0, -root, -root];
        let found = orthonormal_rows(&rotated);
        let error = (&found - dmatrix![0.0, 1.0, 0.0; 0.0, 0.0, 1.0]).norm();
        assert!(error < 1e-15, "second and third axis: {found}");
    }

    #[test]
    fn the_basis_depends_on_the_space_alone() {
        let mut random = Random::new(8);
        for trial in 0..30 {
            let (k, n) = (1 + trial % 3, 4 + trial % 2);
            let basis = DMatrix::from_fn(n, k, |_, _| random.normal()).qr().q().transpose();
            let turn = DMatrix::from_fn(k, k, |_, _| random.normal()).qr().q();
            let (one, other) = (orthonormal_rows(&basis), orthonormal_rows(&(turn * &basis)));
            assert!((&one - &other).norm() < 1e-12, "trial {trial}: {one} {other}");
            assert!((&one * one.transpose() - DMatrix::identity(k, k)).norm() < 1e-13, "orthonormal");
            assert!((&one * basis.tr_mul(&basis) - &one).norm() < 1e-13, "the same space");
        }
    }

    #[test]
    fn entries_that_cancel_are_zero() {
        let found = product(&[&dmatrix![0.1, 0.2], &dmatrix![0.2; -0.1]]);
        assert_eq!(found, dmatrix![0.0], "0.02 - 0.02");
    }
}
