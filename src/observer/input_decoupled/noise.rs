//! What of a computed pair is data, and what is nothing but the rounding of the terms that it was computed from.

use nalgebra::DMatrix;

use crate::numerics::{NumericsError, RankDecision, Tolerance, normalised, svd};

/// The Frobenius norm, zero for an empty matrix; extreme entries do not overflow.
pub(super) fn size(matrix: &DMatrix<f64>) -> f64 {
    if matrix.iter().all(|x| *x == 0.0) { 0.0 } else { normalised(matrix).1 }
}

/// A state matrix, or zero when it is rounding of terms of size `terms`.
///
/// # Tolerance
/// [`Tolerance::rank`], as for a rank.
pub(super) fn cleaned_state(state: DMatrix<f64>, terms: f64, tolerance: &Tolerance) -> DMatrix<f64> {
    let rounding = tolerance.rank * state.nrows() as f64 * f64::EPSILON * terms;
    if size(&state) <= rounding { state * 0.0 } else { state }
}

/// An output matrix without the combinations that are rounding of terms of size `terms`, and the rank decision, relative
/// to the norm of the matrix.
///
/// # Errors
/// As [`svd`].
pub(super) fn cleaned_output(
    output: &DMatrix<f64>,
    terms: f64,
    tolerance: &Tolerance,
) -> Result<(DMatrix<f64>, RankDecision), NumericsError> {
    let (unit, norm) = normalised(output);
    let found = svd(&unit)?;
    let rank = RankDecision::from_singular_values(unit.shape(), found.s, terms / norm, tolerance);
    let r = rank.rank;
    if rank.singular_values[r..].iter().all(|s| *s == 0.0) {
        return Ok((output.clone(), rank));
    }
    let kept = DMatrix::from_fn(unit.nrows(), r, |i, j| found.u[(i, j)] * rank.singular_values[j]);
    Ok((kept * found.v.columns(0, r).transpose() * norm, rank))
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::dmatrix;

    #[test]
    fn rounding_is_zero_and_data_stay() {
        let tolerance = Tolerance::default();
        let noisy = dmatrix![1.0, 2.0; 1e-17, -3e-17];
        let (cleaned, rank) = cleaned_output(&noisy, 1.0, &tolerance).unwrap();
        assert_eq!(rank.rank, 1, "one row counts: {rank:?}");
        assert!((&cleaned - &noisy).norm() < 1e-15, "the row that counts stays: {cleaned}");
        let (cleaned, rank) = cleaned_output(&dmatrix![2e-17, -1e-17], 1.0, &tolerance).unwrap();
        assert_eq!(
            (rank.rank, cleaned),
            (0, DMatrix::zeros(1, 2)),
            "nothing but rounding of terms of size one"
        );
        let faint = dmatrix![2e-200, -1e-200];
        let (cleaned, rank) = cleaned_output(&faint, 1e-200, &tolerance).unwrap();
        assert_eq!((rank.rank, rank.fragile, cleaned), (1, false, faint), "the unit does not matter");
        assert_eq!(cleaned_state(dmatrix![1e-17], 1.0, &tolerance), dmatrix![0.0], "rounding");
        assert_eq!(cleaned_state(dmatrix![1e-12], 1.0, &tolerance), dmatrix![1e-12], "data");
    }

    #[test]
    fn nothing_has_no_rank_and_no_size() {
        let (cleaned, rank) = cleaned_output(&DMatrix::zeros(0, 2), 0.0, &Tolerance::default()).unwrap();
        assert_eq!((rank.rank, cleaned.shape()), (0, (0, 2)), "no outputs");
        assert_eq!(size(&DMatrix::zeros(2, 2)), 0.0, "a zero matrix");
    }
}
