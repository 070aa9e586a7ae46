//! Finite values of `s` at which a pencil loses full column rank.

use nalgebra::{DMatrix, DVector};
use num_complex::Complex64;
use serde::{Deserialize, Serialize};

use super::cluster::{CLUSTER_WIDTH, UnitPencil};
use super::{PencilStructure, normalised, pencil_structure};
use crate::numerics::{NumericsError, Tolerance, stack, svd};

/// One finite value of `s` at which a pencil loses full column rank.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct RankDropPoint {
    /// The point; for a multiple zero the mean of its cluster, which is far more exact than its members.
    pub s: Complex64,
    /// Algebraic multiplicity: the number of members.
    pub multiplicity: usize,
    /// The computed zeros that were taken as one point.
    pub members: Vec<Complex64>,
    /// `sigma_min (A - s E) / (norm A + |s| norm E)`: of the order of rounding at a true point.
    pub sigma: f64,
    /// Right null vector of `A - s E`, with one as its largest entry.
    pub direction: DVector<Complex64>,
}

/// Where a pencil `A - s E` loses full column rank.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum RankDrop {
    /// Full column rank for every finite `s`.
    Nowhere,
    /// Full column rank but for these points.
    Points(Vec<RankDropPoint>),
    /// For no `s` at all.
    Everywhere {
        /// A vector that `A - s E` maps to zero for every `s` when the smallest right index is zero, else at `s = 0`.
        direction: DVector<f64>,
    },
}

/// Where a pencil loses full column rank, with the structure that decided it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct RankDropAnalysis {
    /// The decision.
    pub drop: RankDrop,
    /// Kronecker structure it was read from.
    pub structure: PencilStructure,
    /// The structure is fragile, or the rank at one of the points does not drop as clearly as it should.
    pub fragile: bool,
}

impl RankDropAnalysis {
    /// The isolated points; none when the rank drops nowhere or everywhere.
    pub fn points(&self) -> &[RankDropPoint] {
        match &self.drop {
            RankDrop::Points(points) => points,
            RankDrop::Nowhere | RankDrop::Everywhere { .. } => &[],
        }
    }
}

/// Finds all finite `s` with `rank (A - s E) < n`, n the number of columns.
///
/// Everywhere when the pencil has right minimal indices; else exactly at the eigenvalues of its finite part. No value
/// of `s` is ever sampled to decide.
///
/// # Tolerance
/// `tolerance.pencil` decides the structure. Computed zeros within a relative distance of 1e-4 are taken as one multiple
/// zero when `sigma_min (A - s E) <= tolerance.mode (norm A + |s| norm E)` in the whole disk that they span.
///
/// # Errors
/// As [`pencil_structure`] and [`PencilStructure::finite_eigenvalues`].
///
/// # Examples
/// ```
/// use descry::numerics::{RankDrop, Tolerance, rank_drop_points};
/// // [s + 1; 0] and [s + 1; 1]
/// let (e, a) = (nalgebra::dmatrix![1.0; 0.0], nalgebra::dmatrix![-1.0; 0.0]);
/// assert!((rank_drop_points(&a, &e, &Tolerance::default())?.points()[0].s.re + 1.0).abs() < 1e-15);
/// let a = nalgebra::dmatrix![-1.0; 1.0];
/// assert_eq!(rank_drop_points(&a, &e, &Tolerance::default())?.drop, RankDrop::Nowhere);
/// # Ok::<(), descry::numerics::NumericsError>(())
/// ```
pub fn rank_drop_points(
    a: &DMatrix<f64>,
    e: &DMatrix<f64>,
    tolerance: &Tolerance,
) -> Result<RankDropAnalysis, NumericsError> {
    let structure = pencil_structure(a, e, tolerance)?;
    if let Some(&smallest) = structure.right_indices.first() {
        let direction = null_direction(a, e, smallest)?;
        let fragile = structure.fragile;
        return Ok(RankDropAnalysis { drop: RankDrop::Everywhere { direction }, structure, fragile });
    }
    let zeros = structure.finite_eigenvalues()?;
    let pencil = UnitPencil::new(a, e);
    let mut points = Vec::new();
    for members in pencil.clusters(&zeros, CLUSTER_WIDTH, tolerance.mode)? {
        points.push(pencil.point(members)?);
    }
    let fragile = structure.fragile || points.iter().any(|point| point.sigma > tolerance.mode);
    let drop = if points.is_empty() { RankDrop::Nowhere } else { RankDrop::Points(points) };
    Ok(RankDropAnalysis { drop, structure, fragile })
}

/// A vector of the pencil's right singular part.
fn null_direction(
    a: &DMatrix<f64>,
    e: &DMatrix<f64>,
    smallest_index: usize,
) -> Result<DVector<f64>, NumericsError> {
    let unit_a = normalised(a).0;
    let matrix = if smallest_index == 0 { stack(&[&unit_a, &normalised(e).0]) } else { unit_a };
    let last = matrix.ncols() - 1;
    let vector = svd(&matrix)?.v.column(last).into_owned();
    let largest = vector[vector.icamax()];
    Ok(vector / largest)
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::dmatrix;

    fn analyse(a: &DMatrix<f64>, e: &DMatrix<f64>) -> RankDropAnalysis {
        rank_drop_points(a, e, &Tolerance::default()).unwrap()
    }

    #[test]
    fn a_defective_double_zero_is_one_point() {
        let a = dmatrix![-1.0, 1.0, 0.3; 0.0, -1.0, 0.7; 0.0, 0.0, -4.0];
        let found = analyse(&a, &DMatrix::identity(3, 3));
        let double = found.points().iter().find(|p| p.multiplicity == 2).unwrap();
        assert!((double.s + 1.0).norm() < 1e-12, "mean of the cluster: {double:?}");
        assert!((double.direction[0] - 1.0).norm() < 1e-7, "the only eigenvector is e1: {double:?}");
    }

    #[test]
    fn near_but_distinct_zeros_stay_apart() {
        let a = DMatrix::from_diagonal(&nalgebra::dvector![-1.0, -1.00001, -1.00002]);
        let found = analyse(&a, &DMatrix::identity(3, 3));
        assert_eq!(found.points().len(), 3, "their middle is itself a zero, yet they are three: {found:?}");
    }

    #[test]
    fn slow_zeros_beside_large_data_stay_apart() {
        let a = DMatrix::from_diagonal(&nalgebra::dvector![-1.0, -2.0, -3.0, -1e6]);
        let found = analyse(&a, &DMatrix::identity(4, 4));
        assert_eq!(found.points().len(), 4, "{found:?}");
    }

    #[test]
    fn a_double_zero_at_the_origin_is_found() {
        let a = dmatrix![0.0, 1.0; 0.0, 0.0];
        let found = analyse(&a, &DMatrix::identity(2, 2));
        assert_eq!((found.points().len(), found.points()[0].multiplicity), (1, 2), "{found:?}");
        assert_eq!(analyse(&DMatrix::zeros(2, 2), &DMatrix::identity(2, 2)).points().len(), 1, "A = 0");
    }

    #[test]
    fn direction_is_a_null_vector_at_a_complex_point() {
        let (a, e) = (dmatrix![0.0, 1.0; -5.0, -2.0; 0.0, 0.0], dmatrix![1.0, 0.0; 0.0, 1.0; 0.0, 0.0]);
        let found = analyse(&a, &e);
        assert_eq!(found.points().len(), 2, "a conjugate pair: {found:?}");
        for point in found.points() {
            let matrix = a.zip_map(&e, |a, e| Complex64::from(a) - point.s * e);
            assert!((matrix * &point.direction).norm() < 1e-13, "(A - s E) v = 0: {point:?}");
            assert!((point.direction.camax() - 1.0).abs() < 1e-15, "largest entry one");
        }
    }

    #[test]
    fn a_state_that_no_equation_contains_drops_the_rank_everywhere() {
        let found = analyse(&dmatrix![1.0, 0.0], &dmatrix![1.0, 0.0]);
        let RankDrop::Everywhere { direction } = found.drop else { panic!("{found:?}") };
        assert!((direction - nalgebra::dvector![0.0, 1.0]).norm() < 1e-15, "the second state is free");
    }
}
