//! The modes of the whole, one eigenvalue of `Gamma_nu` at a time: they explain what the PBH test of the whole decides.
//!
//! With a diagonalisable `Gamma_nu` the pair `(alpha_z, gamma_z)` falls apart into blocks of the size of a subsystem:
//!
//! ```text
//! ker (pi I - alpha_z) = sum over lambda in Theta_pi of  ker (lambda I - Gamma_nu) kron ker (pi I - a_z - lambda b_z c_z)
//!             Theta_pi = { lambda in eig Gamma_nu : pi in eig (a_z + lambda b_z c_z) }
//! ```
#![expect(non_snake_case, reason = "matrix letters follow paper 003")]

use nalgebra::{DMatrix, Matrix};

use super::Hierarchy;
use crate::numerics::Block::{Minus, Of, Zero};
use crate::numerics::{
    Complex64, NumericsError, PbhMode, Tolerance, block_matrix, complex_eigenvalues, complex_svd,
    eigenvalues, pbh_modes,
};

/// Eigenvalues closer than this, relative to the norm of their matrix, count as one.
const SAME: f64 = 1e-6;

/// How far a computed eigenvalue of a block may be from the true one, relative to the size of the blocks: Jordan blocks of
/// three are known to five digits.
const DOUBT: f64 = 1e-4;

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
fn block(hierarchy: &Hierarchy, lambda: Complex64) -> DMatrix<Complex64> {
    let bc = &hierarchy.b_z * &hierarchy.c_z;
    complex(&hierarchy.a_z) + complex(&bc) * lambda
}

/// The size of the blocks, which distances refer to.
fn block_size(hierarchy: &Hierarchy) -> f64 {
    let bc = &hierarchy.b_z * &hierarchy.c_z;
    (hierarchy.a_z.norm() + hierarchy.Gamma_nu.norm() * bc.norm()).max(f64::MIN_POSITIVE)
}

/// Eigenvalues of `a_z + lambda b_z c_z`.
///
/// # Errors
/// As [`eigenvalues`].
fn block_eigenvalues(hierarchy: &Hierarchy, lambda: Complex64) -> Result<Vec<Complex64>, NumericsError> {
    let A = block(hierarchy, lambda);
    if lambda.im == 0.0 { eigenvalues(&A.map(|z| z.re)) } else { complex_eigenvalues(&A) }
}

/// The PBH test of `(a_z + lambda b_z c_z, c_G M)`; a complex block is tested by its real embedding.
///
/// ```text
/// [R -S; S R], [c 0; 0 c]   has the modes of the block R + i S and of its conjugate
/// ```
///
/// What the conjugate block adds is left out again.
///
/// # Errors
/// As [`pbh_modes`].
pub(super) fn block_test(
    hierarchy: &Hierarchy,
    lambda: Complex64,
    tolerance: &Tolerance,
) -> Result<Vec<PbhMode>, NumericsError> {
    let A = block(hierarchy, lambda);
    let (R, S, c) = (A.map(|z| z.re), A.map(|z| z.im), &hierarchy.thin_c_GM());
    if lambda.im == 0.0 {
        return pbh_modes(&R, c, tolerance);
    }
    let both = block_matrix(&[&[Of(&R), Minus(&S)], &[Of(&S), Of(&R)]]);
    let outputs = block_matrix(&[&[Of(c), Zero], &[Zero, Of(c)]]);
    let size = SAME * block_size(hierarchy);
    let mut own = Vec::new();
    for mut mode in pbh_modes(&both, &outputs, tolerance)? {
        let (here, there) = (smallest(&shifted(mode.value, &A))?, smallest(&shifted(mode.value.conj(), &A))?);
        if here > there + size {
            continue;
        }
        if (here - there).abs() <= size && mode.multiplicity > 1 {
            mode.multiplicity /= 2; // both blocks have it
        }
        // the norm of the embedding is that of the block times the root of two
        mode.distance *= std::f64::consts::SQRT_2;
        own.push(mode);
    }
    Ok(own)
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
    /// Whether a combination of its directions is invisible.
    pub(super) hidden: bool,
}

/// All modes of the whole, with what the global output sees of them.
///
/// The hidden modes that the PBH test of the whole has found come first: it knows multiple eigenvalues to more digits than
/// the eigenvalues of a block, and those of these within the doubt about them are left out.
///
/// # Errors
/// As [`complex_svd`].
pub(super) fn block_modes(
    hierarchy: &Hierarchy,
    found: &Eigenspaces,
    whole: &[PbhMode],
    tolerance: &Tolerance,
) -> Result<Vec<BlockMode>, NumericsError> {
    let reach = SAME * block_size(hierarchy);
    let doubt = DOUBT * block_size(hierarchy);
    let mut modes = Vec::new();
    let mut known: Vec<(Complex64, Vec<usize>)> = Vec::new();
    for mode in whole.iter().filter(|mode| mode.unobservable) {
        let mut theta = Vec::new();
        for (k, space) in found.spaces.iter().enumerate() {
            if smallest(&shifted(mode.value, &block(hierarchy, space.lambda)))? <= reach {
                theta.push(k);
            }
        }
        modes.extend(seen(hierarchy, found, (mode.value, &theta), (reach, SAME), tolerance)?);
        known.push((mode.value, theta));
    }
    let mut pairs = Vec::new();
    for (k, space) in found.spaces.iter().enumerate() {
        for pi in block_eigenvalues(hierarchy, space.lambda)? {
            if !known.iter().any(|(hidden, theta)| theta.contains(&k) && (hidden - pi).norm() <= doubt) {
                pairs.push((pi, k));
            }
        }
    }
    for members in clusters(&pairs.iter().map(|(pi, _)| *pi).collect::<Vec<_>>(), reach) {
        let mut theta: Vec<usize> =
            pairs.iter().filter(|(other, _)| members.contains(other)).map(|(_, k)| *k).collect();
        theta.sort_unstable();
        theta.dedup();
        modes.extend(seen(hierarchy, found, (mean(&members), &theta), (reach, tolerance.mode), tolerance)?);
    }
    Ok(modes)
}

/// What the global output sees of one mode; `None` when no block has it.
fn seen(
    hierarchy: &Hierarchy,
    found: &Eigenspaces,
    (pi, theta): (Complex64, &[usize]),
    (reach, limit): (f64, f64),
    tolerance: &Tolerance,
) -> Result<Option<BlockMode>, NumericsError> {
    let gamma = complex(&hierarchy.thin_gamma_z());
    let scale = block_size(hierarchy).hypot(gamma.norm());
    let mut columns = Vec::new();
    for &k in theta {
        let space = &found.spaces[k];
        let kernel = kernel(&shifted(pi, &block(hierarchy, space.lambda)), reach)?;
        let product = space.vectors.kronecker(&kernel);
        columns.extend(product.column_iter().map(Matrix::into_owned));
    }
    if columns.is_empty() {
        return Ok(None);
    }
    let V = DMatrix::from_columns(&columns).qr().q();
    let s = complex_svd(&(&gamma * &V))?.s;
    let least = if s.len() < V.ncols() { 0.0 } else { s.last().copied().unwrap_or(0.0) };
    let distance = least / scale;
    let hidden = distance <= limit.max(tolerance.mode);
    Ok(Some(BlockMode { pi, theta: theta.to_vec(), dimension: V.ncols(), distance, hidden }))
}

/// Smallest singular value; infinite for a matrix without entries.
///
/// # Errors
/// As [`complex_svd`].
fn smallest(matrix: &DMatrix<Complex64>) -> Result<f64, NumericsError> {
    Ok(complex_svd(matrix)?.s.last().copied().unwrap_or(f64::INFINITY))
}

/// `s I - A`.
fn shifted(s: Complex64, A: &DMatrix<Complex64>) -> DMatrix<Complex64> {
    DMatrix::from_diagonal_element(A.nrows(), A.ncols(), s) - A
}

fn complex(matrix: &DMatrix<f64>) -> DMatrix<Complex64> {
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
