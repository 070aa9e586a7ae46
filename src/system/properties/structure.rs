//! Regularity, index and finite eigenvalues: what the pencil `A - s E` alone decides.

use num_complex::Complex64;
use serde::{Deserialize, Serialize};

use super::{PropertyError, check};
use crate::numerics::{PencilStructure, Tolerance, pencil_structure};
use crate::system::DescriptorSystem;

/// Whether `det (s E - A)` is defined and not identically zero.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Regularity {
    /// Kronecker structure: shape, normal rank, minimal indices.
    pub structure: PencilStructure,
}

impl Regularity {
    /// As many equations as states.
    pub fn is_square(&self) -> bool {
        self.structure.rows == self.structure.columns
    }

    /// The system is regular: unique solutions for consistent initial states.
    pub fn holds(&self) -> bool {
        self.structure.is_regular()
    }

    /// The decision could tip under a small change of the data.
    pub fn fragile(&self) -> bool {
        self.structure.fragile
    }
}

/// Index of a system.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct DescriptorIndex {
    /// Nilpotency index; zero for nonsingular `E`, `None` for a system that is not regular.
    pub index: Option<usize>,
    /// Degrees of the infinite elementary divisors, ascending; the index is the largest.
    pub infinite_degrees: Vec<usize>,
    /// Smallest factor between a singular value of the staircase and its threshold.
    pub gap: f64,
    /// The decision could tip under a small change of the data.
    pub fragile: bool,
}

/// Finite eigenvalues of a system.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct FiniteSpectrum {
    /// Finite eigenvalues with multiplicity, sorted by real part.
    pub values: Vec<Complex64>,
    /// Rank of `A - s E` for almost all `s`.
    pub normal_rank: usize,
    /// Smallest factor between a singular value of the staircase and its threshold.
    pub gap: f64,
    /// Their number could tip under a small change of the data.
    pub fragile: bool,
}

/// Decides whether the system is regular: square with `det (s E - A)` not identically zero.
///
/// # Errors
/// [`PropertyError`] when the matrices do not fit or a decomposition fails.
pub fn regularity(system: &DescriptorSystem, tolerance: &Tolerance) -> Result<Regularity, PropertyError> {
    check(system)?;
    Ok(Regularity { structure: pencil_structure(&system.A, &system.E, tolerance)? })
}

/// Index of the system: the largest degree of an infinite elementary divisor of `A - s E`.
///
/// # Errors
/// As [`regularity`].
pub fn index(system: &DescriptorSystem, tolerance: &Tolerance) -> Result<DescriptorIndex, PropertyError> {
    let structure = regularity(system, tolerance)?.structure;
    Ok(DescriptorIndex {
        index: structure.index(),
        gap: structure.gap,
        fragile: structure.fragile,
        infinite_degrees: structure.infinite_degrees,
    })
}

/// Finite eigenvalues: the finite `s` at which the rank of `A - s E` falls below its normal rank.
///
/// # Errors
/// As [`regularity`], and when the eigenvalues fail their own check.
pub fn finite_eigenvalues(
    system: &DescriptorSystem,
    tolerance: &Tolerance,
) -> Result<FiniteSpectrum, PropertyError> {
    let structure = regularity(system, tolerance)?.structure;
    Ok(FiniteSpectrum {
        values: structure.finite_eigenvalues()?,
        normal_rank: structure.normal_rank,
        gap: structure.gap,
        fragile: structure.fragile,
    })
}

#[cfg(test)]
mod tests {
    use super::super::autonomous;
    use super::*;
    use nalgebra::{DMatrix, dmatrix};

    #[test]
    fn a_rectangular_system_is_never_regular() {
        let system = autonomous(dmatrix![1.0, 0.0], dmatrix![0.0, 1.0], dmatrix![1.0, 0.0]);
        let found = regularity(&system, &Tolerance::default()).unwrap();
        assert!(!found.holds() && !found.is_square(), "one equation, two states: {found:?}");
        assert_eq!(index(&system, &Tolerance::default()).unwrap().index, None, "hence no index");
    }

    #[test]
    fn a_square_singular_pencil_is_not_regular() {
        let e = dmatrix![1.0, 0.0; 0.0, 0.0];
        let found = regularity(&autonomous(e.clone(), e, dmatrix![1.0, 0.0]), &Tolerance::default()).unwrap();
        assert!(found.is_square() && !found.holds(), "det (s E - A) = 0 for every s: {found:?}");
    }

    #[test]
    fn a_shape_that_does_not_fit_is_an_error_not_a_panic() {
        let mut system = autonomous(DMatrix::identity(2, 2), DMatrix::identity(2, 2), dmatrix![1.0, 0.0]);
        system.C = DMatrix::zeros(1, 3);
        let error = regularity(&system, &Tolerance::default()).unwrap_err();
        assert!(error.to_string().starts_with("C is 1 x 3"), "{error}");
    }

    #[test]
    fn finite_eigenvalues_leave_out_the_infinite_ones() {
        let e = dmatrix![1.0, 0.0, 0.0; 0.0, 0.0, 1.0; 0.0, 0.0, 0.0];
        let a = dmatrix![-3.0, 0.0, 0.0; 0.0, 1.0, 0.0; 0.0, 0.0, 1.0];
        let found =
            finite_eigenvalues(&autonomous(e, a, dmatrix![1.0, 0.0, 0.0]), &Tolerance::default()).unwrap();
        assert_eq!(found.values.len(), 1, "two of three are infinite: {found:?}");
        assert!((found.values[0] + 3.0).norm() < 1e-14, "{found:?}");
    }
}
