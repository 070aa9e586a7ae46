//! Kronecker structure of a real pencil `A - s E` of any shape.

mod cluster;
mod staircase;
mod zeros;

use nalgebra::DMatrix;
use num_complex::Complex64;
use serde::{Deserialize, Serialize};

use super::{NumericsError, eigenvalues, svd};

pub use staircase::pencil_structure;
pub use zeros::{RankDrop, RankDropAnalysis, RankDropPoint, rank_drop_points};

/// Kronecker structure of a pencil `A - s E`, and the regular part that carries its finite eigenvalues.
///
/// ```text
/// P (A - s E) Q = diag( L_right..., L_left'..., I - s N_infinite..., finite_a - s finite_e )
/// ```
///
/// with `L_k` the k x (k+1) singular block, `N` nilpotent Jordan blocks and `finite_e` nonsingular.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PencilStructure {
    /// Rows of `A` and `E`.
    pub rows: usize,
    /// Columns of `A` and `E`.
    pub columns: usize,
    /// Right (column) minimal indices, ascending; empty when the pencil has full column rank for almost all `s`.
    pub right_indices: Vec<usize>,
    /// Left (row) minimal indices, ascending; empty when the pencil has full row rank for almost all `s`.
    pub left_indices: Vec<usize>,
    /// Degrees of the infinite elementary divisors, ascending; the largest is the index of a regular pencil.
    pub infinite_degrees: Vec<usize>,
    /// Number of finite eigenvalues, with multiplicity.
    pub n_finite: usize,
    /// Rank of `A - s E` for almost all `s`.
    pub normal_rank: usize,
    /// Smallest factor that separates a singular value of any step from the threshold `tolerance.pencil`.
    pub gap: f64,
    /// The gap is below `tolerance.gap`: the structure could tip under a small change of the data.
    pub fragile: bool,
    /// `A` of the finite part, square.
    pub finite_a: DMatrix<f64>,
    /// `E` of the finite part, square, nonsingular.
    pub finite_e: DMatrix<f64>,
}

impl PencilStructure {
    /// Square with `det (A - s E)` not identically zero: neither right nor left minimal indices.
    pub fn is_regular(&self) -> bool {
        self.right_indices.is_empty() && self.left_indices.is_empty()
    }

    /// Nilpotency index of a regular pencil (zero for nonsingular `E`); `None` for a singular pencil.
    pub fn index(&self) -> Option<usize> {
        self.is_regular().then(|| self.infinite_degrees.last().copied().unwrap_or(0))
    }

    /// The finite eigenvalues: those of `finite_e^-1 finite_a`, sorted as [`super::sort_spectrum`] does.
    ///
    /// # Errors
    /// [`NumericsError::Singular`] when `finite_e` has no inverse, else as [`eigenvalues`].
    pub fn finite_eigenvalues(&self) -> Result<Vec<Complex64>, NumericsError> {
        let Some(matrix) = self.finite_e.clone().lu().solve(&self.finite_a) else {
            let smallest = svd(&self.finite_e)?.s.last().copied().unwrap_or(0.0);
            return Err(NumericsError::Singular { what: "E of the pencil's finite part", smallest });
        };
        eigenvalues(&matrix)
    }
}

/// Refuses pencils whose matrices differ in shape or have entries that are not finite.
fn check(a: &DMatrix<f64>, e: &DMatrix<f64>) -> Result<(), NumericsError> {
    if a.shape() != e.shape() {
        return Err(NumericsError::Shape {
            what: "E of the pencil A - s E",
            found: format!("{} x {}", e.nrows(), e.ncols()),
            needed: format!("{} x {}, the shape of A,", a.nrows(), a.ncols()),
        });
    }
    for matrix in [a, e] {
        if matrix.iter().any(|x| !x.is_finite()) {
            return Err(NumericsError::NotFinite { rows: matrix.nrows(), columns: matrix.ncols() });
        }
    }
    Ok(())
}

/// A matrix divided by its norm, and that norm (one for a zero matrix); extreme entries do not overflow.
pub(crate) fn normalised(matrix: &DMatrix<f64>) -> (DMatrix<f64>, f64) {
    let largest = if matrix.is_empty() { 0.0 } else { matrix.amax() };
    if largest == 0.0 {
        return (matrix.clone(), 1.0);
    }
    let unit = matrix / largest;
    let norm = unit.norm();
    (unit / norm, largest * norm)
}
