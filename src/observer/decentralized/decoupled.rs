//! The local problem once `D_i1` is chosen: what is left of it when the exactly decoupled columns are projected out.
#![expect(non_snake_case, reason = "matrix letters follow paper 000")]

use nalgebra::DMatrix;

use super::LocalProblem;
use crate::numerics::{NumericsError, Tolerance, side_by_side, stack, subspaces};

/// The matrices of one subsystem from which every observer that decouples `D1` is built.
///
/// ```text
/// Phi [E D1] = 0,   Pi = I - D1 D1+,   E_bar = Pi E,   A_bar = Pi A
/// ```
///
/// # Shapes
/// `Phi`: r x e, empty when `[E D1]` has full row rank; `Pi`: e x e.
///
/// # Source
/// Paper 000, section III (`Phi_i`), (21), (22).
#[derive(Clone, Debug, PartialEq)]
pub struct Decoupled {
    /// Basis of the left null space of `[E D1]`, orthonormal rows, the largest entry of each row positive.
    ///
    /// The normalisation matters: gamma of a reduced or minimal order depends on the scale of `Phi`.
    // ERRATUM(000, Remark 2): "Phi_i = 0" for nonsingular E_i means that Phi_i has no rows.
    pub Phi: DMatrix<f64>,
    /// Projector along the exactly decoupled columns.
    pub Pi: DMatrix<f64>,
    /// `Pi E`.
    pub E_bar: DMatrix<f64>,
    /// `Pi A`.
    pub A_bar: DMatrix<f64>,
    /// `Phi A`.
    pub Phi_A: DMatrix<f64>,
    /// Output matrix.
    pub H: DMatrix<f64>,
    /// Exactly decoupled columns.
    pub D1: DMatrix<f64>,
    /// Attenuated columns.
    pub D2: DMatrix<f64>,
    /// `Pi D2`.
    pub D2_bar: DMatrix<f64>,
    /// `Phi D2`.
    pub Phi_D2: DMatrix<f64>,
    /// Distribution of the known inputs.
    pub B: DMatrix<f64>,
    /// Positions in [`LocalProblem::sources`] of the columns of `D2`.
    pub attenuated: Vec<usize>,
}

impl Decoupled {
    /// Splits `D` into the chosen columns and the others, and projects.
    ///
    /// # Errors
    /// When a decomposition fails its check.
    pub fn new(
        problem: &LocalProblem,
        chosen: &[usize],
        tolerance: &Tolerance,
    ) -> Result<Self, NumericsError> {
        let LocalProblem { E, A, B, H, D, .. } = problem;
        let attenuated: Vec<usize> = (0..D.ncols()).filter(|j| !chosen.contains(j)).collect();
        let (D1, D2) = (D.select_columns(chosen), D.select_columns(&attenuated));
        let directions = unit_columns(&D1, 1.0);
        let e = E.nrows();
        // Pi = I - D1 D1+ = I - U U' with an orthonormal basis U of range D1
        let range = subspaces(&directions, 0.0, tolerance)?.range;
        let Pi = tidy(DMatrix::identity(e, e) - &range * range.transpose(), 1.0);
        let Phi = left_null(&side_by_side(&[&scaled_to(E, E), &directions]), tolerance)?;
        let projected = |m: &DMatrix<f64>| tidy(&Pi * m, m.norm());
        let annihilated = |m: &DMatrix<f64>| tidy(&Phi * m, m.norm());
        Ok(Self {
            E_bar: projected(E),
            A_bar: projected(A),
            D2_bar: projected(&D2),
            Phi_A: annihilated(A),
            Phi_D2: annihilated(&D2),
            H: H.clone(),
            B: B.clone(),
            Phi,
            Pi,
            D1,
            D2,
            attenuated,
        })
    }

    /// Number of states n.
    pub fn n_states(&self) -> usize {
        self.E_bar.ncols()
    }

    /// `Theta = [E_bar; Phi A; H]`, of rank n under Assumption 1.
    ///
    /// # Source
    /// Paper 000, Lemma 1.
    pub fn theta(&self) -> DMatrix<f64> {
        stack(&[&self.E_bar, &self.Phi_A, &self.H])
    }

    /// `[Phi A; H]`, what is known of the state without dynamics.
    pub fn known(&self) -> DMatrix<f64> {
        stack(&[&self.Phi_A, &self.H])
    }
}

/// Relative size below which an entry of a product counts as rounding.
const ROUNDING: f64 = 1e-14;

/// Size below which an entry of an orthonormal basis counts as rounding.
///
/// An optimiser multiplies such an entry by a gain of 1e15 and takes what it gets for a decision.
const BASIS_ROUNDING: f64 = 1e-12;

/// Entries of a product that are rounding, relative to the size of its factors, set to zero.
pub(super) fn tidy(mut matrix: DMatrix<f64>, size: f64) -> DMatrix<f64> {
    matrix.iter_mut().filter(|x| x.abs() <= ROUNDING * size).for_each(|x| *x = 0.0);
    matrix
}

/// Each column that is not zero scaled to the given norm.
pub(super) fn unit_columns(matrix: &DMatrix<f64>, size: f64) -> DMatrix<f64> {
    let mut result = matrix.clone();
    for mut column in result.column_iter_mut() {
        let norm = column.norm();
        if norm > 0.0 {
            column *= size / norm;
        }
    }
    result
}

/// Divided by the norm of the data it came from.
pub(super) fn scaled_to(matrix: &DMatrix<f64>, data: &DMatrix<f64>) -> DMatrix<f64> {
    let size = data.norm();
    if size > 0.0 { matrix / size } else { matrix.clone() }
}

/// Orthonormal rows that span `{f : f M = 0}` in a canonical form.
///
/// Unit vectors when the zero rows of `M` already span it, so that data with structure keep it; else the rows of the
/// decomposition with the largest entry of each positive, and entries that are rounding set to zero.
///
/// # Errors
/// When a decomposition fails its check.
pub(super) fn left_null(matrix: &DMatrix<f64>, tolerance: &Tolerance) -> Result<DMatrix<f64>, NumericsError> {
    let rows = matrix.nrows();
    let mut basis = subspaces(matrix, 0.0, tolerance)?.left_null.transpose();
    let zero: Vec<usize> = (0..rows).filter(|&i| matrix.row(i).iter().all(|x| *x == 0.0)).collect();
    if zero.len() == basis.nrows() {
        return Ok(DMatrix::identity(rows, rows).select_rows(&zero));
    }
    // the first of entries that are equal up to rounding, so that rounding does not choose
    const ALMOST: f64 = 1.0 - 1e-9;
    for mut row in basis.row_iter_mut() {
        let largest = row.amax();
        let sign = row.iter().find(|x| x.abs() >= ALMOST * largest).map_or(1.0, |x| x.signum());
        row.iter_mut().for_each(|x| *x = if x.abs() <= BASIS_ROUNDING { 0.0 } else { *x * sign });
    }
    Ok(basis)
}

/// Orthonormal rows that span the null space of `M`, in the form of [`left_null`].
///
/// # Errors
/// When a decomposition fails its check.
pub(super) fn null_rows(matrix: &DMatrix<f64>, tolerance: &Tolerance) -> Result<DMatrix<f64>, NumericsError> {
    left_null(&matrix.transpose(), tolerance)
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::dmatrix;

    #[test]
    fn a_basis_of_zero_rows_is_made_of_unit_vectors() {
        let found = left_null(&dmatrix![1.0, 1.0; 0.0, 0.0; 0.0, 1.0], &Tolerance::default()).unwrap();
        assert_eq!(found, dmatrix![0.0, 1.0, 0.0], "the second row is zero");
    }

    #[test]
    fn a_basis_is_orthonormal_with_positive_largest_entries() {
        let matrix = dmatrix![1.0; 3.0; -2.0; 0.5];
        let found = left_null(&matrix, &Tolerance::default()).unwrap();
        assert!((&found * &matrix).norm() < 1e-14, "annihilates: {found}");
        let gram = &found * found.transpose();
        assert!((gram - DMatrix::identity(3, 3)).norm() < 1e-14, "orthonormal: {found}");
        assert!(found.row_iter().all(|row| row.max() >= row.amax() - 1e-9), "signs are canonical: {found}");
    }

    #[test]
    fn the_empty_matrix_leaves_everything() {
        let found = left_null(&DMatrix::zeros(2, 0), &Tolerance::default()).unwrap();
        assert_eq!(found, DMatrix::identity(2, 2), "no column, no equation");
    }
}
