//! Whether a nonlinearity keeps the Lipschitz constant that is claimed for it, by samples.

use nalgebra::DMatrix;

use super::plant::Plant;
use crate::numerics::{NumericsError, Random, Tolerance, pseudo_inverse, svd};

/// The steepest slope among the samples.
#[derive(Clone, Debug, PartialEq)]
pub struct SteepestSample {
    /// Largest `|df| / |F_L dx|`; infinite when `f` depends on a state that `F_L` does not show.
    pub slope: f64,
    /// The state there.
    pub x: Vec<f64>,
    /// The time there.
    pub t: f64,
    /// How many states were tried.
    pub samples: usize,
}

impl SteepestSample {
    /// Whether the slope exceeds a constant by more than rounding.
    pub fn exceeds(&self, constant: f64) -> bool {
        const ROUNDING: f64 = 1e-9;
        self.slope > constant * (1.0 + ROUNDING) + f64::MIN_POSITIVE
    }
}

/// Sizes of the boxes in which states are drawn.
const REACHES: [f64; 4] = [0.1, 1.0, 10.0, 100.0];
/// States in each box.
const SAMPLES: usize = 64;
/// Times are drawn from zero to this.
const LONGEST: f64 = 100.0;
/// Seed of the samples, so that a verdict does not change from one look to the next.
const SEED: u64 = 2;

/// Searches for a slope of the nonlinearity above its Lipschitz constant.
///
/// ```text
/// J = df/dx at random states of four magnitudes,   slope = |J F_L+|,   infinite when J (I - F_L+ F_L) is not zero
/// ```
///
/// Samples can refute a constant, never prove it. States at which `f` is not defined are passed over. `None` without a
/// nonlinearity.
///
/// # Errors
/// When a decomposition fails its check.
pub fn sample_slope(plant: &Plant, tolerance: &Tolerance) -> Result<Option<SteepestSample>, NumericsError> {
    let n = plant.n();
    if plant.f.is_empty() {
        return Ok(None);
    }
    let pinv = pseudo_inverse(&plant.F_L, tolerance)?;
    let hidden = DMatrix::identity(n, n) - &pinv * &plant.F_L;
    let mut random = Random::new(SEED);
    let mut best = SteepestSample { slope: 0.0, x: vec![0.0; n], t: 0.0, samples: 0 };
    for sample in 0..=REACHES.len() * SAMPLES {
        // the origin first, where many a nonlinearity is steepest
        let reach = sample.checked_sub(1).map_or(0.0, |k| REACHES[k / SAMPLES]);
        let mut values: Vec<f64> = (0..n).map(|_| reach * (2.0 * random.uniform() - 1.0)).collect();
        let t = if sample == 0 { 0.0 } else { LONGEST * random.uniform() };
        values.push(t);
        let jacobian = jacobian(plant, &values);
        if jacobian.iter().any(|x| !x.is_finite()) {
            continue;
        }
        best.samples += 1;
        let slope = slope(&jacobian, &pinv, &hidden)?;
        if slope > best.slope {
            values.truncate(n);
            best = SteepestSample { slope, x: values, t, ..best };
        }
    }
    Ok(Some(best))
}

fn jacobian(plant: &Plant, values: &[f64]) -> DMatrix<f64> {
    let mut direction = vec![0.0; values.len()];
    let mut result = DMatrix::zeros(plant.f.len(), plant.n());
    for j in 0..plant.n() {
        direction[j] = 1.0;
        for (i, f) in plant.f.iter().enumerate() {
            result[(i, j)] = f.dual(values, &direction).1;
        }
        direction[j] = 0.0;
    }
    result
}

fn slope(jacobian: &DMatrix<f64>, pinv: &DMatrix<f64>, hidden: &DMatrix<f64>) -> Result<f64, NumericsError> {
    const ROUNDING: f64 = 1e-10;
    if (jacobian * hidden).norm() > ROUNDING * jacobian.norm() {
        return Ok(f64::INFINITY);
    }
    Ok(svd(&(jacobian * pinv))?.s.first().copied().unwrap_or(0.0))
}
