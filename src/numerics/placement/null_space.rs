//! Several outputs: eigenvectors chosen from the null spaces that the poles allow, as independent as possible.
//!
//! ```text
//! (A' - C' L') X = X Lambda,   x_j in S_j = ker V' (A' - lambda_j I),   V = orthonormal complement of the rows of C
//! ```
//!
//! # Source
//! Moore, "On the flexibility offered by state feedback in multivariable systems beyond closed loop eigenvalue
//! assignment", 1976; Kautsky, Nichols and Van Dooren, "Robust pole assignment in linear state feedback", 1985.

use nalgebra::{DMatrix, DVector};
use num_complex::Complex64;

use super::{PlacementError, PlacementOptions};
use crate::numerics::{NumericsError, PoleOrPair, Random, complex_svd, svd};

/// The vectors that can be left eigenvectors of `A - L C` for one pole or pair.
struct Slot {
    pole: PoleOrPair,
    /// First column of the eigenvector in the real matrix `X`; a pair takes two.
    column: usize,
    /// Orthonormal basis of `S_j`, n x r.
    basis: DMatrix<Complex64>,
}

/// A gain with its closed-loop eigenvectors.
#[derive(Clone, Debug)]
pub(super) struct Eigenstructure {
    /// Real n x n matrix of left eigenvectors of `A - L C`: `x`, or `sqrt 2 Re x` and `sqrt 2 Im x` of a pair.
    pub(super) x: DMatrix<f64>,
    /// Its inverse.
    pub(super) inverse: DMatrix<f64>,
    /// `L` for the orthonormal output rows, n x r.
    pub(super) gain: DMatrix<f64>,
}

/// Places the poles of `A - L C` for a `C` with orthonormal rows, r of them, `1 < r < n`.
///
/// # Errors
/// [`PlacementError::DependentEigenvectors`] when all starts have singular eigenvectors; else as [`svd`].
pub(super) fn place(
    a: &DMatrix<f64>,
    c: &DMatrix<f64>,
    poles: &[PoleOrPair],
    options: &PlacementOptions,
) -> Result<Eigenstructure, PlacementError> {
    let slots = slots(a, c, poles)?;
    let mut random = Random::new(options.seed);
    let mut best = (0..options.starts.max(1))
        .filter_map(|_| Candidate::random(&slots, &mut random))
        .min_by(|a, b| a.size.total_cmp(&b.size))
        .ok_or(PlacementError::DependentEigenvectors)?;
    // norm(X^-1) >= sqrt n for unit columns, with equality for orthogonal ones
    let ideal = (a.nrows() as f64).sqrt();
    for _ in 0..options.sweeps {
        const NEARLY_IDEAL: f64 = 1.02;
        const WORTHWHILE: f64 = 0.99;
        let before = best.size;
        if before <= NEARLY_IDEAL * ideal {
            break;
        }
        for slot in &slots {
            best.improve(slot);
        }
        if best.size > WORTHWHILE * before {
            break;
        }
    }
    let Candidate { x, inverse, .. } = best;
    let defect = a.tr_mul(&x) - scaled_by_poles(&x, poles);
    // C' L' X = A' X - X Lambda, and the rows of C are orthonormal
    let gain = x.transpose().lu().solve(&(c * defect).transpose());
    let gain = gain.ok_or(PlacementError::DependentEigenvectors)?;
    if gain.iter().all(|l| l.is_finite()) {
        Ok(Eigenstructure { x, inverse, gain })
    } else {
        Err(PlacementError::Overflow)
    }
}

fn slots(a: &DMatrix<f64>, c: &DMatrix<f64>, poles: &[PoleOrPair]) -> Result<Vec<Slot>, NumericsError> {
    let (r, n) = c.shape();
    let complement = svd(c)?.v.columns(r, n - r).into_owned();
    // V' (A' - lambda I)
    let seen = complement.tr_mul(&a.transpose());
    let mut column = 0;
    let mut result: Vec<Slot> = Vec::with_capacity(poles.len());
    for &pole in poles {
        let repeated = result.iter().find(|slot| slot.pole == pole).map(|slot| slot.basis.clone());
        let basis = match (repeated, pole) {
            (Some(basis), _) => basis,
            (None, PoleOrPair::Real(p)) => {
                let v = svd(&(&seen - complement.transpose() * p))?.v;
                v.columns(n - r, r).map(Complex64::from)
            }
            (None, PoleOrPair::Pair(z)) => {
                let shifted = DMatrix::from_fn(n - r, n, |i, j| seen[(i, j)] - z * complement[(j, i)]);
                complex_svd(&shifted)?.v.columns(n - r, r).into_owned()
            }
        };
        result.push(Slot { pole, column, basis });
        column += width(pole);
    }
    Ok(result)
}

fn width(pole: PoleOrPair) -> usize {
    match pole {
        PoleOrPair::Real(_) => 1,
        PoleOrPair::Pair(_) => 2,
    }
}

/// `X Lambda` with the real 2 x 2 block `[re im; -im re]` of each pair.
pub(super) fn scaled_by_poles(x: &DMatrix<f64>, poles: &[PoleOrPair]) -> DMatrix<f64> {
    let mut result = x.clone();
    let mut k = 0;
    for &pole in poles {
        match pole {
            PoleOrPair::Real(p) => result.column_mut(k).scale_mut(p),
            PoleOrPair::Pair(z) => {
                result.set_column(k, &(x.column(k) * z.re - x.column(k + 1) * z.im));
                result.set_column(k + 1, &(x.column(k) * z.im + x.column(k + 1) * z.re));
            }
        }
        k += width(pole);
    }
    result
}

/// The eigenvector that starts at a column of a real matrix of eigenvectors.
pub(super) fn eigenvector(x: &DMatrix<f64>, column: usize, pole: PoleOrPair) -> DVector<Complex64> {
    match pole {
        PoleOrPair::Real(_) => x.column(column).map(Complex64::from),
        PoleOrPair::Pair(_) => x.column(column).zip_map(&x.column(column + 1), |re, im| {
            Complex64::new(re, im) * std::f64::consts::FRAC_1_SQRT_2
        }),
    }
}

/// Eigenvectors under construction.
struct Candidate {
    x: DMatrix<f64>,
    inverse: DMatrix<f64>,
    /// Frobenius norm of the inverse: with unit columns, the condition number up to a constant.
    size: f64,
}

impl Candidate {
    fn new(x: DMatrix<f64>) -> Option<Self> {
        let inverse = x.clone().try_inverse()?;
        let size = inverse.norm();
        size.is_finite().then_some(Self { x, inverse, size })
    }

    fn random(slots: &[Slot], random: &mut Random) -> Option<Self> {
        let n = slots.first()?.basis.nrows();
        let mut x = DMatrix::zeros(n, n);
        for slot in slots {
            let mut draw = || {
                let re = random.normal();
                let im = if matches!(slot.pole, PoleOrPair::Pair(_)) { random.normal() } else { 0.0 };
                Complex64::new(re, im)
            };
            let weights = DVector::from_fn(slot.basis.ncols(), |_, _| draw());
            write(&mut x, slot, &weights)?;
        }
        Self::new(x)
    }

    /// Turns one eigenvector towards the direction that is orthogonal to all others, kept if the condition improves.
    fn improve(&mut self, slot: &Slot) {
        // rows of the inverse are orthogonal to all other columns
        let rows = self.inverse.transpose();
        let orthogonal = eigenvector(&rows, slot.column, slot.pole);
        let weights = slot.basis.ad_mul(&orthogonal);
        let mut x = self.x.clone();
        if write(&mut x, slot, &weights).is_none() {
            return;
        }
        if let Some(candidate) = Self::new(x)
            && candidate.size < self.size
        {
            *self = candidate;
        }
    }
}

/// Writes the unit eigenvector with the given weights into its column or columns; `None` for a zero vector.
fn write(x: &mut DMatrix<f64>, slot: &Slot, weights: &DVector<Complex64>) -> Option<()> {
    let vector = &slot.basis * weights;
    let norm = vector.norm();
    if !(norm > 0.0 && norm.is_finite()) {
        return None;
    }
    match slot.pole {
        PoleOrPair::Real(_) => x.set_column(slot.column, &vector.map(|z| z.re / norm)),
        PoleOrPair::Pair(_) => {
            let scale = std::f64::consts::SQRT_2 / norm;
            x.set_column(slot.column, &vector.map(|z| z.re * scale));
            x.set_column(slot.column + 1, &vector.map(|z| z.im * scale));
        }
    }
    Some(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::dmatrix;

    fn example() -> (DMatrix<f64>, DMatrix<f64>, Vec<PoleOrPair>) {
        let a = dmatrix![0.0, 1.0, 0.0, 0.3; 0.0, 0.2, 1.0, 0.0; -0.5, 0.0, 0.0, 1.0; 0.1, 0.0, 0.4, 0.0];
        let c = dmatrix![1.0, 0.0, 0.0, 0.0; 0.0, 0.0, 0.6, 0.8];
        (
            a,
            c,
            vec![PoleOrPair::Real(-1.0), PoleOrPair::Pair(Complex64::new(-2.0, 1.5)), PoleOrPair::Real(-3.0)],
        )
    }

    #[test]
    fn eigenvectors_belong_to_the_closed_loop() {
        let (a, c, poles) = example();
        let found = place(&a, &c, &poles, &PlacementOptions::default()).unwrap();
        let closed = (&a - &found.gain * &c).transpose();
        let residual = (closed * &found.x - scaled_by_poles(&found.x, &poles)).norm();
        assert!(residual < 1e-12, "(A - L C)' X = X Lambda: {residual:e}");
        assert!((found.x.norm() - 2.0).abs() < 1e-12, "four columns of unit size");
    }

    #[test]
    fn sweeps_make_the_eigenvectors_more_independent() {
        let (a, c, poles) = example();
        let size = |starts, sweeps| {
            let options = PlacementOptions { seed: 3, starts, sweeps };
            place(&a, &c, &poles, &options).unwrap().inverse.norm()
        };
        assert!(size(1, 10) < 0.9 * size(1, 0), "from {} to {}", size(1, 0), size(1, 10));
        assert!(size(20, 10) <= 1.05 * size(1, 10), "more starts do not hurt");
    }
}
