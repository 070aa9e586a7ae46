//! The modes of the whole, one eigenvalue of `Gamma_nu` at a time.
//!
//! With a diagonalisable `Gamma_nu` the pair `(alpha_z, gamma_z)` falls apart into blocks of the size of a subsystem:
//!
//! ```text
//! ker (pi I - alpha_z) = sum over lambda in Theta_pi of  ker (lambda I - Gamma_nu) kron ker (pi I - a_z - lambda b_z c_z)
//!             Theta_pi = { lambda in eig Gamma_nu : pi in eig (a_z + lambda b_z c_z) }
//! ```
//!
//! so that no matrix of order `nu mu` is decomposed.
#![expect(non_snake_case, reason = "matrix letters follow paper 003")]

use nalgebra::{DMatrix, Matrix};

use super::Hierarchy;
use crate::numerics::Block::{Minus, Of};
use crate::numerics::{Complex64, NumericsError, block_matrix, complex_svd, eigenvalues};

/// Eigenvalues closer than this, relative to the norm of their matrix, count as one.
const SAME: f64 = 1e-6;

/// Above this condition number of its eigenvectors `Gamma_nu` does not count as diagonalisable.
const LARGEST_CONDITION: f64 = 1e6;

/// An eigenvalue of `Gamma_nu` with an orthonormal basis of its eigenvectors.
#[derive(Clone, Debug)]
pub(super) struct Eigenspace {
    pub(super) lambda: Complex64,
    pub(super) vectors: DMatrix<Complex64>,
}

/// The eigenvectors of `Gamma_nu`.
#[derive(Clone, Debug)]
pub(super) struct Eigenspaces {
    pub(super) spaces: Vec<Eigenspace>,
    /// Condition number of all eigenvectors together; infinite when they do not span the space.
    pub(super) condition: f64,
}

impl Eigenspaces {
    /// # Errors
    /// As [`eigenvalues`] and [`complex_svd`].
    pub(super) fn of(Gamma_nu: &DMatrix<f64>) -> Result<Self, NumericsError> {
        let nu = Gamma_nu.nrows();
        let reach = SAME * Gamma_nu.norm();
        let mut spaces = Vec::new();
        for members in clusters(&eigenvalues(Gamma_nu)?, reach) {
            let lambda = mean(&members);
            let found = kernel(&shifted(lambda, &complex(Gamma_nu)), reach)?;
            let dimension = found.ncols().min(members.len());
            let vectors = found.columns(found.ncols() - dimension, dimension).into_owned();
            spaces.push(Eigenspace { lambda, vectors });
        }
        let all: Vec<_> = spaces.iter().flat_map(|space| space.vectors.column_iter()).collect();
        let condition = if all.len() < nu {
            f64::INFINITY
        } else if nu == 0 {
            1.0
        } else {
            let s = complex_svd(&DMatrix::from_columns(&all))?.s;
            s.first().copied().unwrap_or(1.0) / s.last().copied().unwrap_or(1.0)
        };
        Ok(Self { spaces, condition })
    }

    pub(super) fn diagonalisable(&self) -> bool {
        self.condition <= LARGEST_CONDITION
    }
}

/// `a_z + lambda b_z c_z`.
pub(super) fn block(hierarchy: &Hierarchy, lambda: Complex64) -> DMatrix<Complex64> {
    let bc = &hierarchy.b_z * &hierarchy.c_z;
    complex(&hierarchy.a_z) + complex(&bc) * lambda
}

/// The size of the blocks, which distances refer to.
pub(super) fn block_size(hierarchy: &Hierarchy) -> f64 {
    let bc = &hierarchy.b_z * &hierarchy.c_z;
    (hierarchy.a_z.norm() + hierarchy.Gamma_nu.norm() * bc.norm()).max(f64::MIN_POSITIVE)
}

/// Eigenvalues of `a_z + lambda b_z c_z`; of a complex block by the real matrix `[R -S; S R]`, whose other half, the
/// eigenvalues of the conjugate block, is sorted out.
///
/// # Errors
/// As [`eigenvalues`] and [`complex_svd`].
pub(super) fn block_eigenvalues(
    hierarchy: &Hierarchy,
    lambda: Complex64,
) -> Result<Vec<Complex64>, NumericsError> {
    let A = block(hierarchy, lambda);
    let (R, S) = (A.map(|z| z.re), A.map(|z| z.im));
    if lambda.im == 0.0 {
        return eigenvalues(&R);
    }
    let both = eigenvalues(&block_matrix(&[&[Of(&R), Minus(&S)], &[Of(&S), Of(&R)]]))?;
    let mut own = Vec::with_capacity(both.len());
    for pi in both {
        own.push((smallest(&shifted(pi, &A))?, pi));
    }
    own.sort_by(|x, y| x.0.total_cmp(&y.0));
    // an eigenvalue that both blocks share stands twice in the list and once among the mu that are kept
    own.truncate(A.nrows());
    Ok(own.into_iter().map(|(_, pi)| pi).collect())
}

/// A mode of the whole.
#[derive(Clone, Debug)]
pub(super) struct BlockMode {
    pub(super) pi: Complex64,
    /// Numbers of the eigenvalues of `Gamma_nu` that have it: the set `Theta_pi`.
    pub(super) theta: Vec<usize>,
    /// Dimension of its eigenspace.
    pub(super) dimension: usize,
    /// Smallest singular value of `gamma_z` on the orthonormalised eigenspace, relative to the size of the pair.
    pub(super) distance: f64,
    /// The direction within the eigenspace that is seen least, in the coordinates of z, largest entry 1.
    pub(super) direction: Vec<Complex64>,
}

/// All modes of the whole, with what the global output sees of them.
///
/// # Errors
/// As [`complex_svd`].
pub(super) fn block_modes(
    hierarchy: &Hierarchy,
    found: &Eigenspaces,
) -> Result<Vec<BlockMode>, NumericsError> {
    let reach = SAME * block_size(hierarchy);
    let mut pairs = Vec::new();
    for (k, space) in found.spaces.iter().enumerate() {
        for pi in block_eigenvalues(hierarchy, space.lambda)? {
            pairs.push((pi, k));
        }
    }
    let gamma = complex(&hierarchy.gamma_z());
    let scale = block_size(hierarchy).hypot(gamma.norm());
    let mut modes = Vec::new();
    for members in clusters(&pairs.iter().map(|(pi, _)| *pi).collect::<Vec<_>>(), reach) {
        let pi = mean(&members);
        let mut theta: Vec<usize> =
            pairs.iter().filter(|(other, _)| members.contains(other)).map(|(_, k)| *k).collect();
        theta.sort_unstable();
        theta.dedup();
        let mut columns = Vec::new();
        for &k in &theta {
            let space = &found.spaces[k];
            let kernel = kernel(&shifted(pi, &block(hierarchy, space.lambda)), reach)?;
            let product = space.vectors.kronecker(&kernel);
            columns.extend(product.column_iter().map(Matrix::into_owned));
        }
        if columns.is_empty() {
            continue;
        }
        let V = DMatrix::from_columns(&columns).qr().q();
        let seen = complex_svd(&(&gamma * &V))?;
        let least = if seen.s.len() < V.ncols() { 0.0 } else { seen.s.last().copied().unwrap_or(0.0) };
        let direction = (&V * seen.v.column(V.ncols() - 1)).iter().copied().collect();
        modes.push(BlockMode {
            pi,
            theta,
            dimension: V.ncols(),
            distance: least / scale,
            direction: normalised(direction),
        });
    }
    Ok(modes)
}

/// Smallest singular value of `[pi I - A; c]`, zero columns counting as seen.
///
/// # Errors
/// As [`complex_svd`].
pub(super) fn smallest(matrix: &DMatrix<Complex64>) -> Result<f64, NumericsError> {
    Ok(complex_svd(matrix)?.s.last().copied().unwrap_or(f64::INFINITY))
}

/// `s I - A`.
pub(super) fn shifted(s: Complex64, A: &DMatrix<Complex64>) -> DMatrix<Complex64> {
    DMatrix::from_diagonal_element(A.nrows(), A.ncols(), s) - A
}

pub(super) fn complex(matrix: &DMatrix<f64>) -> DMatrix<Complex64> {
    matrix.map(Complex64::from)
}

/// Orthonormal vectors whose images are no longer than `limit`; at least one, for a matrix that is known to be singular.
fn kernel(matrix: &DMatrix<Complex64>, limit: f64) -> Result<DMatrix<Complex64>, NumericsError> {
    let n = matrix.ncols();
    let found = complex_svd(matrix)?;
    let nullity = found.s.iter().filter(|s| **s <= limit).count().max(1).min(n);
    Ok(found.v.columns(n - nullity, nullity).into_owned())
}

/// Groups of values that lie within `reach` of their first member.
fn clusters(values: &[Complex64], reach: f64) -> Vec<Vec<Complex64>> {
    let mut result: Vec<Vec<Complex64>> = Vec::new();
    for &value in values {
        let near =
            |group: &&mut Vec<Complex64>| group.first().is_some_and(|first| (first - value).norm() <= reach);
        match result.iter_mut().find(near) {
            Some(group) => group.push(value),
            None => result.push(vec![value]),
        }
    }
    result
}

/// The mean of a group, real when the group lies on the real axis.
fn mean(members: &[Complex64]) -> Complex64 {
    members.iter().sum::<Complex64>() / members.len().max(1) as f64
}

/// Divides by the entry of largest absolute value.
fn normalised(vector: Vec<Complex64>) -> Vec<Complex64> {
    let largest =
        vector.iter().copied().fold(Complex64::ZERO, |a, b| if b.norm() > a.norm() { b } else { a });
    if largest.norm() == 0.0 { vector } else { vector.into_iter().map(|z| z / largest).collect() }
}
