//! The H-infinity norm of a stable linear system, by bisection on the spectrum of a Hamiltonian matrix.

mod balance;
mod level;
mod response;
#[cfg(test)]
mod tests;

use nalgebra::DMatrix;
use num_complex::Complex64;
use serde::{Deserialize, Serialize};

use super::{NumericsError, StabilityRegion, Tolerance, eigenvalues};
use balance::balanced;
use level::Level;
use response::{Gain, Response, largest_singular_value};

/// The largest gain of a stable system over all frequencies, and where it is reached.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct HInfinityNorm {
    /// The norm: the gain at `frequency`, hence `lower`.
    pub norm: f64,
    /// Frequency of the peak in rad/s (difference equations: rad/step, from 0 to pi); infinite when the gain is largest
    /// at infinite frequency.
    pub frequency: f64,
    /// A gain that was evaluated, hence never above the norm but for rounding.
    pub lower: f64,
    /// The level at which the Hamiltonian matrix shows no crossing any more.
    pub upper: f64,
}

/// Why there is no H-infinity norm.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum HInfinityError {
    /// A mode does not decay.
    #[error(
        "the norm is infinite: the mode {mode} is not stable ({}); stabilise it or remove it from the model",
        region.statement()
    )]
    Unstable {
        /// The mode that lies outside furthest.
        mode: Complex64,
        /// Where modes have to lie.
        region: StabilityRegion,
    },
    /// A computation failed, or the matrices do not fit.
    #[error(transparent)]
    Numerics(#[from] NumericsError),
}

/// Relative distance between the bounds at which the search ends; the square root of it is what near-double crossings
/// are apart, well above the rounding of eigenvalues.
const BRACKET: f64 = 1e-10;

/// Further steps above a lower bound that is nearly the gain at infinite frequency, where small steps make the Hamiltonian
/// matrix so large that rounding hides its crossings.
const WIDE_STEPS: [f64; 4] = [1e-3, 1e-4, 1e-6, 1e-8];

/// Levels after which the search gives up; each one squares the remaining error, five are usual.
const MOST_LEVELS: usize = 60;

/// The H-infinity norm of `G(s) = D + C (s I - A)^-1 B` (difference equations: of z).
///
/// ```text
/// norm G = max over w of sigma_max G(i w)     (discrete: G(exp(i w)))
/// sigma_max G(i w) = g for some w   <=>   i w is an eigenvalue of the Hamiltonian matrix M(g)
/// ```
///
/// From a lower bound, each step raises the level a little above it and evaluates the gain at the imaginary parts of
/// *all* eigenvalues of `M(g)` that could be crossings, and between them; the largest one is the next lower bound. No
/// threshold decides what is imaginary, and the lower bound is a gain that was seen. A discrete system is taken to the
/// half plane by the bilinear map at the one of -1 and 1 that is further from its modes. States are balanced first.
///
/// # Shapes
/// `A` n x n, `B` n x m, `C` p x n, `D` p x m; any of n, m, p may be zero.
///
/// # Tolerance
/// [`Tolerance::margin`]: a mode closer to the boundary counts as not stable.
///
/// # Errors
/// [`HInfinityError::Unstable`] with the worst mode; shapes that do not fit; entries that are not finite.
///
/// # Source
/// N. A. Bruinsma and M. Steinbuch, "A fast algorithm to compute the H-infinity norm of a transfer function matrix",
/// Systems and Control Letters 14 (1990) 287-293.
///
/// # Examples
/// ```
/// use descry::numerics::{StabilityRegion, Tolerance, h_infinity_norm};
/// use nalgebra::dmatrix;
/// // 3 / (s + 2)
/// let (a, b, c, d) = (dmatrix![-2.0], dmatrix![1.0], dmatrix![3.0], dmatrix![0.0]);
/// let found = h_infinity_norm(&a, &b, &c, &d, StabilityRegion::LeftHalfPlane, &Tolerance::default())?;
/// assert!((found.norm - 1.5).abs() < 1e-9 && found.frequency == 0.0);
/// # Ok::<(), descry::numerics::HInfinityError>(())
/// ```
pub fn h_infinity_norm(
    a: &DMatrix<f64>,
    b: &DMatrix<f64>,
    c: &DMatrix<f64>,
    d: &DMatrix<f64>,
    region: StabilityRegion,
    tolerance: &Tolerance,
) -> Result<HInfinityNorm, HInfinityError> {
    check(a, b, c, d)?;
    let (system, unit) = balanced(a, b, c, d);
    let modes = eigenvalues(&system.a)?;
    let margin = region.margin(system.a.norm(), tolerance);
    let furthest = modes.iter().copied().max_by(|x, y| region.excess(*x).total_cmp(&region.excess(*y)));
    if let Some(mode) = furthest.filter(|mode| !region.contains(*mode, margin)) {
        return Err(HInfinityError::Unstable { mode, region });
    }
    if modes.is_empty() || b.is_empty() || c.is_empty() {
        let norm = largest_singular_value(&d.map(Complex64::from))?;
        return Ok(HInfinityNorm { norm, frequency: 0.0, lower: norm, upper: norm });
    }
    let found = search(&Response::new(&system, region), &Level::new(&system, region, &modes)?, &modes)?;
    Ok(HInfinityNorm {
        norm: found.norm * unit,
        lower: found.lower * unit,
        upper: found.upper * unit,
        ..found
    })
}

/// State-space matrices that belong together.
#[derive(Clone, Debug)]
struct StateSpace {
    a: DMatrix<f64>,
    b: DMatrix<f64>,
    c: DMatrix<f64>,
    d: DMatrix<f64>,
}

fn check(
    a: &DMatrix<f64>,
    b: &DMatrix<f64>,
    c: &DMatrix<f64>,
    d: &DMatrix<f64>,
) -> Result<(), NumericsError> {
    let n = a.nrows();
    if !a.is_square() || b.nrows() != n || c.ncols() != n || d.shape() != (c.nrows(), b.ncols()) {
        let shape = |m: &DMatrix<f64>| format!("{} x {}", m.nrows(), m.ncols());
        return Err(NumericsError::Shape {
            what: "H-infinity norm of D + C (s I - A)^-1 B",
            found: format!("A {}, B {}, C {}, D {}", shape(a), shape(b), shape(c), shape(d)),
            needed: "A n x n, B n x m, C p x n, D p x m".to_owned(),
        });
    }
    match [a, b, c, d].iter().find(|m| m.iter().any(|x| !x.is_finite())) {
        Some(m) => Err(NumericsError::NotFinite { rows: m.nrows(), columns: m.ncols() }),
        None => Ok(()),
    }
}

/// Raises the lower bound until no gain lies above it.
fn search(
    response: &Response<'_>,
    level: &Level,
    modes: &[Complex64],
) -> Result<HInfinityNorm, NumericsError> {
    let mut best = response.at_infinity()?;
    for frequency in response.start(modes) {
        best = best.larger(response.at(frequency)?);
    }
    for _ in 0..MOST_LEVELS {
        // below the rounding of its own terms a gain is zero, and no Hamiltonian matrix is worth forming
        let upper = (best.value * (1.0 + BRACKET)).max(f64::EPSILON * best.terms);
        if upper == 0.0 {
            return Ok(HInfinityNorm { norm: 0.0, frequency: best.frequency, lower: 0.0, upper: 0.0 });
        }
        let mut found = vec![level.crossings(upper)?];
        if level.is_near_infinity(upper) {
            for step in WIDE_STEPS {
                found.push(level.crossings(best.value * (1.0 + step))?);
            }
        }
        for frequency in found.into_iter().flat_map(with_midpoints) {
            best = best.larger(response.at(frequency)?);
        }
        if best.value <= upper {
            let Gain { frequency, value: norm, .. } = best;
            return Ok(HInfinityNorm { norm, frequency, lower: norm, upper });
        }
    }
    Err(NumericsError::Unreliable {
        what: "H-infinity norm",
        rows: modes.len(),
        columns: modes.len(),
        residual: f64::INFINITY,
    })
}

/// The frequencies themselves and the arithmetic and geometric means of neighbours.
fn with_midpoints(mut frequencies: Vec<f64>) -> Vec<f64> {
    frequencies.sort_by(f64::total_cmp);
    frequencies.dedup();
    let means = frequencies.windows(2).filter_map(|pair| match pair {
        [low, high] => Some([0.5 * (low + high), (low * high).sqrt()]),
        _ => None,
    });
    let means: Vec<f64> = means.flatten().collect();
    frequencies.extend(means);
    frequencies
}
