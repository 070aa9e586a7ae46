//! Orthonormal bases of null spaces and ranges, and the pseudo-inverse.

use nalgebra::DMatrix;

use super::{NumericsError, RankDecision, Tolerance, svd};

/// The four fundamental subspaces of a matrix as orthonormal bases, with the rank decision that split them.
///
/// ```text
/// M = [range, left_null] * diag(S, 0) * [row_space, null]'
/// ```
#[derive(Clone, Debug)]
pub struct Subspaces {
    /// The rank decision.
    pub rank: RankDecision,
    /// Orthonormal basis of the range, rows x rank.
    pub range: DMatrix<f64>,
    /// Orthonormal basis of the left null space: `left_null' M = 0`, rows x (rows - rank).
    pub left_null: DMatrix<f64>,
    /// Orthonormal basis of the row space, columns x rank.
    pub row_space: DMatrix<f64>,
    /// Orthonormal basis of the null space: `M null = 0`, columns x (columns - rank).
    pub null: DMatrix<f64>,
}

/// Splits a matrix into its four fundamental subspaces.
///
/// # Tolerance
/// `scale` as in [`super::rank`].
///
/// # Errors
/// As [`svd`].
pub fn subspaces(
    matrix: &DMatrix<f64>,
    scale: f64,
    tolerance: &Tolerance,
) -> Result<Subspaces, NumericsError> {
    let (rows, columns) = matrix.shape();
    let found = svd(matrix)?;
    let rank = RankDecision::from_singular_values((rows, columns), found.s, scale, tolerance);
    let r = rank.rank;
    Ok(Subspaces {
        range: found.u.columns(0, r).into_owned(),
        left_null: found.u.columns(r, rows - r).into_owned(),
        row_space: found.v.columns(0, r).into_owned(),
        null: found.v.columns(r, columns - r).into_owned(),
        rank,
    })
}

/// Orthonormal basis of the null space, columns x (columns - rank).
///
/// # Errors
/// As [`svd`].
pub fn null_space(
    matrix: &DMatrix<f64>,
    scale: f64,
    tolerance: &Tolerance,
) -> Result<DMatrix<f64>, NumericsError> {
    Ok(subspaces(matrix, scale, tolerance)?.null)
}

/// Moore-Penrose inverse, columns x rows; singular values below the rank threshold count as zero.
///
/// ```text
/// M M+ M = M,   M+ M M+ = M+,   M M+ and M+ M symmetric
/// ```
///
/// # Errors
/// As [`svd`].
pub fn pseudo_inverse(matrix: &DMatrix<f64>, tolerance: &Tolerance) -> Result<DMatrix<f64>, NumericsError> {
    let found = svd(matrix)?;
    let rank = RankDecision::from_singular_values(matrix.shape(), found.s, 0.0, tolerance);
    let r = rank.rank;
    let scaled = DMatrix::from_fn(matrix.ncols(), r, |i, j| found.v[(i, j)] / rank.singular_values[j]);
    Ok(scaled * found.u.columns(0, r).transpose())
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::dmatrix;

    fn tolerance() -> Tolerance {
        Tolerance::default()
    }

    #[test]
    fn bases_annihilate_and_are_orthonormal() {
        let matrix = dmatrix![1.0, 2.0, 3.0; 2.0, 4.0, 6.0; 1.0, 0.0, 1.0; 0.0, 0.0, 0.0];
        let found = subspaces(&matrix, 0.0, &tolerance()).unwrap();
        assert_eq!(found.rank.rank, 2, "two independent rows");
        assert!((&matrix * &found.null).norm() < 1e-14, "M null = 0");
        assert!(found.left_null.tr_mul(&matrix).norm() < 1e-14, "left_null' M = 0");
        let gram = found.left_null.tr_mul(&found.left_null);
        assert!((gram - DMatrix::identity(2, 2)).norm() < 1e-14, "orthonormal columns");
    }

    /// The matrix on which nalgebra's pseudo-inverse is wrong (dimforge/nalgebra#1172).
    #[test]
    fn penrose_conditions_hold_on_a_rank_one_matrix() {
        let m = dmatrix![1.0; -1.0; -1.0; 1.0; 0.0; -1.0] * dmatrix![1.0, -1.0, -1.0, 0.0];
        let p = pseudo_inverse(&m, &tolerance()).unwrap();
        assert!((&m * &p * &m - &m).norm() < 1e-13, "M M+ M = M");
        assert!((&p * &m * &p - &p).norm() < 1e-14, "M+ M M+ = M+");
        assert!((&m * &p - (&m * &p).transpose()).norm() < 1e-14, "M M+ symmetric");
        assert!((&p * &m - (&p * &m).transpose()).norm() < 1e-14, "M+ M symmetric");
    }

    #[test]
    fn empty_matrix_has_the_whole_space_as_null_space() {
        assert_eq!(
            null_space(&DMatrix::zeros(0, 3), 0.0, &tolerance()).unwrap().shape(),
            (3, 3),
            "no equations"
        );
        assert_eq!(
            pseudo_inverse(&DMatrix::zeros(0, 3), &tolerance()).unwrap().shape(),
            (3, 0),
            "transposed shape"
        );
    }
}
