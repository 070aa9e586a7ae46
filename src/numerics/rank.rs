//! Rank decisions with their evidence.

use nalgebra::DMatrix;
use serde::{Deserialize, Serialize};

use super::{NumericsError, Tolerance, singular_values};

/// A numerical rank and everything it was decided on.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct RankDecision {
    /// Rows of the matrix.
    pub rows: usize,
    /// Columns of the matrix.
    pub columns: usize,
    /// Number of singular values above the threshold.
    pub rank: usize,
    /// All singular values, descending.
    pub singular_values: Vec<f64>,
    /// Singular values above this count.
    pub threshold: f64,
    /// `sigma_rank / sigma_(rank+1)`, infinite when no smaller singular value is left or it is exactly zero.
    pub gap: f64,
    /// The gap, or the distance of a value from the threshold, is so small that the decision could tip.
    pub fragile: bool,
}

impl RankDecision {
    /// The smallest singular value that counts; zero for rank zero.
    pub fn smallest_counted(&self) -> f64 {
        self.rank.checked_sub(1).map_or(0.0, |last| self.singular_values[last])
    }

    /// The smallest singular value of all; infinite for an empty matrix.
    pub fn smallest(&self) -> f64 {
        self.singular_values.last().copied().unwrap_or(f64::INFINITY)
    }

    /// Decides on given singular values.
    pub fn from_singular_values(
        shape: (usize, usize),
        singular_values: Vec<f64>,
        scale: f64,
        tolerance: &Tolerance,
    ) -> Self {
        let (rows, columns) = shape;
        let largest = singular_values.first().copied().unwrap_or(0.0);
        let threshold = tolerance.rank * rows.max(columns) as f64 * f64::EPSILON * largest.max(scale);
        let rank = singular_values.iter().filter(|s| **s > threshold).count();
        let below = singular_values.get(rank).copied().unwrap_or(0.0);
        let above = rank.checked_sub(1).map_or(0.0, |last| singular_values[last]);
        let gap = if below == 0.0 { f64::INFINITY } else { above / below };
        // what is left out is plain rounding up to max(rows, columns) * EPSILON * scale, hence no reason for doubt
        let rounding = threshold / tolerance.rank;
        let close = rank > 0 && (gap < tolerance.gap || above < threshold * tolerance.gap);
        let fragile = close || below > rounding;
        Self { rows, columns, rank, singular_values, threshold, gap, fragile }
    }
}

/// Decides the rank of a matrix.
///
/// ```text
/// rank M = #{ i : sigma_i > threshold },   threshold = tolerance.rank * max(rows, columns) * eps * max(sigma_1, scale)
/// ```
///
/// # Tolerance
/// `scale` is the norm of the *original* data when `M` was computed from it: a compressed block that is nothing but
/// rounding noise would otherwise get full rank. Pass `0.0` for data as they were given.
///
/// # Errors
/// As [`super::svd`].
///
/// # Examples
/// ```
/// use descry::numerics::{rank, Tolerance};
/// let decision = rank(&nalgebra::dmatrix![1.0, 2.0; 2.0, 4.0], 0.0, &Tolerance::default())?;
/// assert_eq!(decision.rank, 1);
/// # Ok::<(), descry::numerics::NumericsError>(())
/// ```
pub fn rank(matrix: &DMatrix<f64>, scale: f64, tolerance: &Tolerance) -> Result<RankDecision, NumericsError> {
    Ok(RankDecision::from_singular_values(matrix.shape(), singular_values(matrix)?, scale, tolerance))
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::dmatrix;

    #[test]
    fn rank_follows_the_gap() {
        let decision = rank(&dmatrix![1.0, 0.0; 0.0, 1e-17], 0.0, &Tolerance::default()).unwrap();
        assert_eq!(decision.rank, 1, "1e-17 beside 1 is rounding: {decision:?}");
        let decision = rank(&dmatrix![1.0, 0.0; 0.0, 1e-6], 0.0, &Tolerance::default()).unwrap();
        assert_eq!(decision.rank, 2, "1e-6 beside 1 is data: {decision:?}");
        assert!(!decision.fragile, "a millionth is far from the threshold");
    }

    #[test]
    fn a_value_near_the_threshold_is_fragile() {
        let decision = rank(&dmatrix![1.0, 0.0; 0.0, 1e-14], 0.0, &Tolerance::default()).unwrap();
        assert!(
            decision.fragile,
            "1e-14 is within a factor of a thousand of the threshold {}",
            decision.threshold
        );
    }

    #[test]
    fn plain_rounding_below_the_threshold_is_not_fragile() {
        let third = 1.0 / 3.0;
        let noisy = dmatrix![0.1, 0.3, 0.7; third, 1.0, 7.0 / 3.0; 0.7, 2.1, 4.9];
        let decision = rank(&noisy, 0.0, &Tolerance::default()).unwrap();
        assert_eq!((decision.rank, decision.fragile), (1, false), "multiples of one row: {decision:?}");
    }

    #[test]
    fn noise_of_a_compressed_block_has_rank_zero_against_its_origin() {
        let noise = dmatrix![1e-16, -2e-16; 3e-16, 1e-16];
        assert_eq!(rank(&noise, 0.0, &Tolerance::default()).unwrap().rank, 2, "alone it looks regular");
        assert_eq!(
            rank(&noise, 1.0, &Tolerance::default()).unwrap().rank,
            0,
            "against data of norm 1 it is nothing"
        );
    }

    #[test]
    fn empty_matrices_have_rank_zero() {
        assert_eq!(rank(&DMatrix::zeros(0, 3), 0.0, &Tolerance::default()).unwrap().rank, 0, "no rows");
    }
}
