//! Modes that no output injection can move: the PBH test at the eigenvalues, and deflation of what it finds.
//!
//! The rank of an observability matrix and the single-output staircase are not used: on systems with planted
//! unobservable modes the staircase missed every third one, the test below none.

use nalgebra::DMatrix;
use num_complex::Complex64;
use serde::{Deserialize, Serialize};

use super::pbh::tests;
use super::{NumericsError, Tolerance, eigenvalues, svd};

/// One eigenvalue of `A` (or cluster of nearly equal ones) with its distance from being unobservable.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PbhMode {
    /// The point of the cluster at which `[lambda I - A; C]` is closest to losing rank.
    pub value: Complex64,
    /// Number of eigenvalues of `A` in the cluster.
    pub multiplicity: usize,
    /// `sigma_min [value I - A; C] / norm [A; C]`.
    pub distance: f64,
    /// Number of independent unobservable directions at `value`.
    pub nullity: usize,
    /// `distance` is below [`Tolerance::mode`].
    pub unobservable: bool,
    /// The direction that is seen least, scaled so that its largest entry is 1.
    pub direction: Vec<Complex64>,
}

/// A pair split into what the output sees and what it does not.
///
/// ```text
/// [unobservable basis]' A [unobservable basis] = [A11 A12; 0 A22],   C [unobservable basis] = [0 C2]
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct ObservableQuotient {
    /// Orthonormal basis of the complement, `n x n_o`; `(basis' A basis, C basis)` is observable.
    pub basis: DMatrix<f64>,
    /// Orthonormal basis of the unobservable subspace, `n x (n - n_o)`.
    pub unobservable: DMatrix<f64>,
    /// Eigenvalues of `A` on the unobservable subspace: they are in the spectrum of `A - L C` for every `L`.
    pub fixed_modes: Vec<Complex64>,
    /// The PBH test of the pair as it was given.
    pub modes: Vec<PbhMode>,
}

/// Tests every eigenvalue of `A` for observability through `C` (Popov, Belevitch, Hautus).
///
/// ```text
/// lambda is observable  <=>  rank [lambda I - A; C] = n
/// ```
///
/// Nearly equal eigenvalues are tested as one: at their mean, at each of them, and at the point to which Newton steps
/// on the smallest singular value lead, since eigenvalues of Jordan blocks are known to half of the digits only.
///
/// # Shapes
/// `A` n x n, `C` p x n; `p = 0` is allowed and sees nothing.
///
/// # Tolerance
/// [`Tolerance::mode`] against the distance. A `C` more than a hundred times as large as `A` is scaled down first, so
/// that the unit of an output cannot hide the dynamics.
///
/// # Errors
/// [`NumericsError::Shape`] when the sizes do not fit; else as [`svd`] and [`eigenvalues`].
///
/// # Examples
/// ```
/// use descry::numerics::{Tolerance, pbh_modes};
/// let a = nalgebra::dmatrix![-1.0, 0.0; 0.0, -2.0];
/// let c = nalgebra::dmatrix![0.0, 1.0];
/// let modes = pbh_modes(&a, &c, &Tolerance::default())?;
/// assert!(modes.iter().all(|m| m.unobservable == (m.value.re > -1.5)), "the first state is not measured");
/// # Ok::<(), descry::numerics::NumericsError>(())
/// ```
pub fn pbh_modes(
    a: &DMatrix<f64>,
    c: &DMatrix<f64>,
    tolerance: &Tolerance,
) -> Result<Vec<PbhMode>, NumericsError> {
    let c = with_bounded_output(a, c)?;
    let tests = tests(a, &c, joint_norm(a, &c), tolerance)?;
    let mut modes = Vec::with_capacity(tests.len());
    for test in tests {
        let mirrored = (test.mode.value.im != 0.0).then(|| PbhMode {
            value: test.mode.value.conj(),
            direction: test.mode.direction.iter().map(Complex64::conj).collect(),
            ..test.mode.clone()
        });
        modes.push(test.mode);
        modes.extend(mirrored);
    }
    Ok(modes)
}

/// Splits off everything that the output does not see.
///
/// Null vectors at the unobservable eigenvalues are collected into an orthonormal basis and deflated; this repeats on
/// the rest until nothing is found, which also takes the longer chains of Jordan blocks.
///
/// # Shapes
/// `A` n x n, `C` p x n.
///
/// # Tolerance
/// As [`pbh_modes`]; the rest is always judged against the norm of the pair as it was given.
///
/// # Errors
/// As [`pbh_modes`].
pub fn observable_quotient(
    a: &DMatrix<f64>,
    c: &DMatrix<f64>,
    tolerance: &Tolerance,
) -> Result<ObservableQuotient, NumericsError> {
    let n = a.nrows();
    let modes = pbh_modes(a, c, tolerance)?;
    let c = with_bounded_output(a, c)?;
    let scale = joint_norm(a, &c);
    let mut q = DMatrix::<f64>::identity(n, n);
    let mut k = 0;
    while k < n && modes.iter().any(|mode| mode.unobservable) {
        let rest = q.columns(k, n - k).into_owned();
        let directions = unseen_directions(&rest.tr_mul(&(a * &rest)), &(&c * &rest), scale, tolerance)?;
        let Some(directions) = directions else { break };
        let found = svd(&directions)?;
        let largest = found.s.first().copied().unwrap_or(0.0);
        let r = found.s.iter().filter(|s| **s > DIRECTION_TOLERANCE * largest).count();
        q.columns_mut(k, n - k).copy_from(&(rest * found.u));
        k += r;
    }
    let unobservable = q.columns(0, k).into_owned();
    let fixed_modes = eigenvalues(&unobservable.tr_mul(&(a * &unobservable)))?;
    Ok(ObservableQuotient { basis: q.columns(k, n - k).into_owned(), unobservable, fixed_modes, modes })
}

/// Null vectors from different eigenvalues count as independent when the singular values of their matrix exceed this,
/// relative to the largest.
const DIRECTION_TOLERANCE: f64 = 1e-6;

/// The columns of real and imaginary parts of all null vectors; `None` when everything is observable.
fn unseen_directions(
    a: &DMatrix<f64>,
    c: &DMatrix<f64>,
    scale: f64,
    tolerance: &Tolerance,
) -> Result<Option<DMatrix<f64>>, NumericsError> {
    let mut columns = Vec::new();
    for test in tests(a, c, scale, tolerance)? {
        if !test.mode.unobservable {
            continue;
        }
        for column in test.null.column_iter() {
            columns.push(column.map(|z| z.re));
            if test.mode.value.im != 0.0 {
                columns.push(column.map(|z| z.im));
            }
        }
    }
    Ok(if columns.is_empty() { None } else { Some(DMatrix::from_columns(&columns)) })
}

fn joint_norm(a: &DMatrix<f64>, c: &DMatrix<f64>) -> f64 {
    a.norm().hypot(c.norm())
}

/// Checks the shapes and scales an output down that would dwarf `A`.
fn with_bounded_output(a: &DMatrix<f64>, c: &DMatrix<f64>) -> Result<DMatrix<f64>, NumericsError> {
    let n = a.nrows();
    if !a.is_square() || c.ncols() != n {
        return Err(NumericsError::Shape {
            what: "observability of a pair (A, C)",
            found: format!("A {} x {} and C {} x {}", n, a.ncols(), c.nrows(), c.ncols()),
            needed: "a square A and a C with as many columns".to_owned(),
        });
    }
    for matrix in [a, c] {
        if matrix.iter().any(|x| !x.is_finite()) {
            return Err(NumericsError::NotFinite { rows: matrix.nrows(), columns: matrix.ncols() });
        }
    }
    const LARGEST_RATIO: f64 = 100.0;
    let limit = LARGEST_RATIO * a.norm();
    let excess = if limit > 0.0 { c.norm() / limit } else { 1.0 };
    Ok(if excess > 1.0 { c / excess } else { c.clone() })
}

#[cfg(test)]
#[path = "fixed_modes_tests.rs"]
mod tests_of_planted_modes;
