//! Gains at single frequencies.

use nalgebra::DMatrix;
use num_complex::Complex64;

use super::StateSpace;
use crate::numerics::{NumericsError, StabilityRegion, complex_svd};

/// A gain and the frequency at which it was evaluated.
#[derive(Clone, Copy, Debug)]
pub(super) struct Gain {
    pub(super) frequency: f64,
    /// `sigma_max G`.
    pub(super) value: f64,
    /// Size of the terms that were added up to it.
    pub(super) terms: f64,
}

impl Gain {
    /// The larger gain, with the larger of the sizes of terms.
    pub(super) fn larger(self, other: Self) -> Self {
        let terms = self.terms.max(other.terms);
        let best = if other.value > self.value { other } else { self };
        Self { terms, ..best }
    }
}

/// Evaluates `G` on the boundary of a stability region.
#[derive(Debug)]
pub(super) struct Response<'a> {
    system: &'a StateSpace,
    b: DMatrix<Complex64>,
    c: DMatrix<Complex64>,
    region: StabilityRegion,
}

impl<'a> Response<'a> {
    pub(super) fn new(system: &'a StateSpace, region: StabilityRegion) -> Self {
        Self { system, b: system.b.map(Complex64::from), c: system.c.map(Complex64::from), region }
    }

    /// `|D|`, the gain at infinite frequency; a discrete system, which has none, begins at zero frequency.
    pub(super) fn at_infinity(&self) -> Result<Gain, NumericsError> {
        if self.region == StabilityRegion::UnitDisk {
            return self.at(0.0);
        }
        let value = largest_singular_value(&self.system.d.map(Complex64::from))?;
        Ok(Gain { frequency: f64::INFINITY, value, terms: value })
    }

    /// Frequencies to begin with: both ends, and the resonances of the modes.
    pub(super) fn start(&self, modes: &[Complex64]) -> Vec<f64> {
        let mut result = vec![0.0];
        match self.region {
            StabilityRegion::LeftHalfPlane => {
                result.extend(modes.iter().flat_map(|mode| [mode.im.abs(), mode.norm()]));
            }
            StabilityRegion::UnitDisk => {
                result.push(std::f64::consts::PI);
                result.extend(modes.iter().map(|mode| mode.arg().abs()));
            }
        }
        result
    }

    /// `sigma_max (D + C (s I - A)^-1 B)` at `s = i w`, or at `z = exp(i w)`.
    ///
    /// A point that meets a mode exactly, which only rounding can bring about, has no gain to offer.
    pub(super) fn at(&self, frequency: f64) -> Result<Gain, NumericsError> {
        let StateSpace { a, d, .. } = self.system;
        let s = match self.region {
            StabilityRegion::LeftHalfPlane => Complex64::new(0.0, frequency),
            StabilityRegion::UnitDisk => Complex64::from_polar(1.0, frequency),
        };
        let pencil = DMatrix::from_fn(a.nrows(), a.ncols(), |i, j| {
            if i == j { s - a[(i, j)] } else { Complex64::from(-a[(i, j)]) }
        });
        let nothing = Gain { frequency, value: 0.0, terms: 0.0 };
        let Some(state) = pencil.lu().solve(&self.b) else { return Ok(nothing) };
        let terms = self.c.norm() * state.norm() + d.norm();
        let value = &self.c * state + d.map(Complex64::from);
        if !terms.is_finite() || value.iter().any(|z| !z.is_finite()) {
            return Ok(nothing);
        }
        Ok(Gain { frequency, value: largest_singular_value(&value)?, terms })
    }
}

/// The largest singular value; zero for an empty matrix.
pub(super) fn largest_singular_value(matrix: &DMatrix<Complex64>) -> Result<f64, NumericsError> {
    match matrix.shape() {
        (0, _) | (_, 0) => Ok(0.0),
        (1, _) | (_, 1) => Ok(matrix.norm()),
        _ => Ok(complex_svd(matrix)?.s.first().copied().unwrap_or(0.0)),
    }
}
