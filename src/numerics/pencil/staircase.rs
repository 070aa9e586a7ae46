//! The staircase: singular value decompositions alone, no eigenvalues, hence no false finite ones.

use nalgebra::DMatrix;

use super::{PencilStructure, check, normalised};
use crate::numerics::{NumericsError, Tolerance, svd};

/// Finds the Kronecker structure of `A - s E` by orthogonal transformations alone.
///
/// ```text
/// 1. V = [null E, range E']: the first nu columns of E V vanish
/// 2. U compresses the rows of A V on those nu columns to rank mu
/// 3. drop these mu rows and nu columns; repeat until E has full column rank
/// step i:  nu_i - mu_i      right minimal indices equal to i - 1
///          mu_i - nu_(i+1)  infinite elementary divisors of degree i
/// ```
///
/// The same on the transpose of what is left gives the left minimal indices; the rest is the finite part.
///
/// # Shapes
/// `a`, `e`: m x n, any m and n (also none).
///
/// # Tolerance
/// Singular values count when they exceed `tolerance.pencil` times the norm of the *original* `A` or `E`: a threshold
/// relative to what is left would turn rounding noise into eigenvalues.
///
/// # Errors
/// [`NumericsError::Shape`] and [`NumericsError::NotFinite`] for bad input, [`NumericsError::Unreliable`] when a
/// decomposition fails or the finite part does not come out square.
///
/// # Source
/// Van Dooren, "The computation of Kronecker's canonical form of a singular pencil", 1979.
///
/// # Examples
/// ```
/// use descry::numerics::{Tolerance, pencil_structure};
/// let e = nalgebra::dmatrix![1.0, 0.0, 0.0; 0.0, 0.0, 1.0; 0.0, 0.0, 0.0];
/// let a = nalgebra::dmatrix![-3.0, 0.0, 0.0; 0.0, 1.0, 0.0; 0.0, 0.0, 1.0];
/// let found = pencil_structure(&a, &e, &Tolerance::default())?;
/// assert_eq!(found.index(), Some(2));
/// assert!((found.finite_eigenvalues()?[0].re + 3.0).abs() < 1e-14);
/// # Ok::<(), descry::numerics::NumericsError>(())
/// ```
pub fn pencil_structure(
    a: &DMatrix<f64>,
    e: &DMatrix<f64>,
    tolerance: &Tolerance,
) -> Result<PencilStructure, NumericsError> {
    check(a, e)?;
    let (rows, columns) = a.shape();
    let ((unit_a, norm_a), (unit_e, norm_e)) = (normalised(a), normalised(e));
    let mut gap = f64::INFINITY;
    let (rest, steps) = deflate(Pencil { a: unit_a, e: unit_e }, tolerance.pencil, &mut gap)?;
    let (right_indices, mut infinite_degrees) = blocks(&steps);
    let (rest, steps) = deflate(rest.transposed(), tolerance.pencil, &mut gap)?;
    let (left_indices, more) = blocks(&steps);
    infinite_degrees.extend(more);
    infinite_degrees.sort_unstable();
    let finite = rest.transposed();
    if !finite.a.is_square() {
        let what = "staircase of a pencil";
        return Err(NumericsError::Unreliable { what, rows, columns, residual: tolerance.pencil / gap });
    }
    Ok(PencilStructure {
        rows,
        columns,
        n_finite: finite.a.nrows(),
        normal_rank: columns - right_indices.len(),
        right_indices,
        left_indices,
        infinite_degrees,
        gap,
        fragile: gap < tolerance.gap,
        finite_a: finite.a * norm_a,
        finite_e: finite.e * norm_e,
    })
}

/// A pencil `a - s e` on its way down the staircase.
struct Pencil {
    a: DMatrix<f64>,
    e: DMatrix<f64>,
}

impl Pencil {
    fn transposed(&self) -> Self {
        Self { a: self.a.transpose(), e: self.e.transpose() }
    }
}

/// One step: `nullity` columns of `E` vanish, on which `A` has rank `rank`.
struct Step {
    nullity: usize,
    rank: usize,
}

/// Takes off right singular blocks and infinite elementary divisors until `E` has full column rank.
fn deflate(mut pencil: Pencil, threshold: f64, gap: &mut f64) -> Result<(Pencil, Vec<Step>), NumericsError> {
    let mut steps = Vec::new();
    loop {
        let columns = pencil.e.ncols();
        let of_e = svd(&pencil.e)?;
        let kept = count_above(&of_e.s, threshold, gap);
        if kept == columns {
            return Ok((pencil, steps));
        }
        let (range, null) = (of_e.v.columns(0, kept), of_e.v.columns(kept, columns - kept));
        let of_a = svd(&(&pencil.a * null))?;
        let rank = count_above(&of_a.s, threshold, gap);
        steps.push(Step { nullity: columns - kept, rank });
        let rest = of_a.u.columns(rank, pencil.a.nrows() - rank).transpose();
        pencil = Pencil { a: &rest * (&pencil.a * range), e: &rest * (&pencil.e * range) };
    }
}

/// Minimal indices and degrees of infinite elementary divisors that the steps stand for.
fn blocks(steps: &[Step]) -> (Vec<usize>, Vec<usize>) {
    let (mut indices, mut degrees) = (Vec::new(), Vec::new());
    for (i, step) in steps.iter().enumerate() {
        let next = steps.get(i + 1).map_or(0, |s| s.nullity);
        indices.extend(std::iter::repeat_n(i, step.nullity - step.rank));
        degrees.extend(std::iter::repeat_n(i + 1, step.rank.saturating_sub(next)));
    }
    (indices, degrees)
}

/// Counts singular values above the threshold and keeps track of the smallest ratio to it.
fn count_above(singular_values: &[f64], threshold: f64, gap: &mut f64) -> usize {
    for s in singular_values.iter().map(|s| s.abs()) {
        // a zero may come with a minus sign
        *gap = gap.min(if s > threshold { s / threshold } else { threshold / s });
    }
    singular_values.iter().filter(|s| **s > threshold).count()
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::dmatrix;

    fn found(a: &DMatrix<f64>, e: &DMatrix<f64>) -> PencilStructure {
        pencil_structure(a, e, &Tolerance::default()).unwrap()
    }

    #[test]
    fn nonsingular_e_has_index_zero() {
        let structure = found(&dmatrix![0.0, 1.0; -2.0, -3.0], &dmatrix![2.0, 0.0; 0.0, 1.0]);
        assert_eq!((structure.index(), structure.n_finite), (Some(0), 2), "an ordinary system in disguise");
    }

    #[test]
    fn a_single_right_block_is_recognised() {
        // L_2 = [-s 1 0; 0 -s 1]
        let a = dmatrix![0.0, 1.0, 0.0; 0.0, 0.0, 1.0];
        let e = dmatrix![1.0, 0.0, 0.0; 0.0, 1.0, 0.0];
        let structure = found(&a, &e);
        assert_eq!((structure.right_indices, structure.normal_rank), (vec![2], 2), "one block of index 2");
        let structure = found(&a.transpose(), &e.transpose());
        assert_eq!((structure.left_indices, structure.normal_rank), (vec![2], 2), "its transpose");
    }

    #[test]
    fn a_zero_pencil_has_only_zero_indices() {
        let structure = found(&DMatrix::zeros(2, 3), &DMatrix::zeros(2, 3));
        assert_eq!((structure.right_indices.len(), structure.left_indices.len()), (3, 2), "no rank at all");
        assert_eq!(structure.index(), None, "a singular pencil has no index");
    }

    #[test]
    fn empty_pencils_are_legal() {
        assert_eq!(found(&DMatrix::zeros(0, 2), &DMatrix::zeros(0, 2)).right_indices, [0, 0], "no rows");
        assert_eq!(found(&DMatrix::zeros(2, 0), &DMatrix::zeros(2, 0)).left_indices, [0, 0], "no columns");
        assert_eq!(found(&DMatrix::zeros(0, 0), &DMatrix::zeros(0, 0)).index(), Some(0), "nothing");
    }

    #[test]
    fn the_scale_of_the_data_does_not_matter() {
        let (a, e) = (dmatrix![1.0, 2.0; 3.0, 5.0], dmatrix![1.0, 1.0; 1.0, 1.0]);
        for scale in [1e-200, 1e-12, 1e12, 1e200] {
            assert_eq!(found(&(&a * scale), &(&e / scale)).index(), Some(1), "scale {scale:e}");
        }
    }

    #[test]
    fn a_value_near_the_threshold_is_fragile() {
        let e = dmatrix![1.0, 0.0; 0.0, 1e-8];
        assert!(found(&DMatrix::identity(2, 2), &e).fragile, "1e-8 is ten times the threshold");
        let e = dmatrix![1.0, 0.0; 0.0, 1e-3];
        assert!(!found(&DMatrix::identity(2, 2), &e).fragile, "1e-3 is far above it");
    }

    #[test]
    fn matrices_of_different_shape_are_refused() {
        let error = pencil_structure(&DMatrix::zeros(2, 2), &DMatrix::zeros(2, 3), &Tolerance::default());
        assert_eq!(
            error.unwrap_err().to_string(),
            "E of the pencil A - s E: 2 x 3 where 2 x 2, the shape of A, is needed",
            "message for a person"
        );
    }
}
