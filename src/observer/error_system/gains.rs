//! H-infinity norms of an error system.

use nalgebra::DMatrix;
use serde::{Deserialize, Serialize};

use super::ErrorStateSpace;
use crate::numerics::{Complex64, HInfinityError, HInfinityNorm, NumericsError, Tolerance, h_infinity_norm};

/// The largest gain from an input to a part of the error.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum ErrorGain {
    /// The norm, with the frequency of the peak.
    Norm(HInfinityNorm),
    /// Zero but for the rounding of the design: the input does not reach the error.
    Decoupled,
    /// The observer does not estimate it.
    NotEstimated,
    /// The plant has no such input: no unknown input, or no output and hence no noise.
    NoInput,
    /// There is no finite gain: why.
    NotFinite(String),
    /// The gain is not known: why.
    NotComputed(String),
}

impl ErrorGain {
    /// The gain as a number, where there is one: zero when decoupled.
    pub fn value(&self) -> Option<f64> {
        match self {
            Self::Norm(found) => Some(found.norm),
            Self::Decoupled => Some(0.0),
            Self::NotEstimated | Self::NoInput | Self::NotFinite(_) | Self::NotComputed(_) => None,
        }
    }
}

/// Gains from unknown input and noise to the errors of state and unknown input.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ErrorGains {
    /// Unknown input to `x_hat - x`.
    pub d_to_e: ErrorGain,
    /// Unknown input to `d_hat - d`.
    pub d_to_e_d: ErrorGain,
    /// Noise to `x_hat - x`.
    pub w_to_e: ErrorGain,
    /// Noise to `d_hat - d`.
    pub w_to_e_d: ErrorGain,
}

impl ErrorGains {
    /// The same words for all four, when there is no error system.
    pub fn none(why: &str) -> Self {
        let gain = || ErrorGain::NotComputed(why.to_owned());
        Self { d_to_e: gain(), d_to_e_d: gain(), w_to_e: gain(), w_to_e_d: gain() }
    }
}

/// Input and output of a gain as parts of the error system, and the sizes that rounding is relative to.
struct Path {
    b: DMatrix<f64>,
    c: DMatrix<f64>,
    d: DMatrix<f64>,
    size_b: DMatrix<f64>,
    size_c: DMatrix<f64>,
    size_d: DMatrix<f64>,
}

impl ErrorStateSpace {
    /// The H-infinity norms of the error system.
    ///
    /// ```text
    /// |G| = max over w of sigma_max (D + C (i w I - A)^-1 B)     (discrete: at exp(i w))
    /// ```
    ///
    /// # Tolerance
    /// A gain that does not exceed [`Tolerance::residual`] times what the absolute values of its terms give at the peak,
    /// `|C| |(i w I - A)^-1| |B| + |D|`, is one of the residuals of the design's own equations: the input is decoupled.
    ///
    /// # Errors
    /// When a decomposition fails its check. A gain that is not finite is no error.
    pub fn gains(&self, tolerance: &Tolerance) -> Result<ErrorGains, NumericsError> {
        let (n, rows) = (self.states.len(), self.c.nrows());
        let (state, input) = ((0, n), (n, rows - n));
        Ok(ErrorGains {
            d_to_e: self.gain(&self.of_d(state), tolerance)?,
            d_to_e_d: self.gain(&self.of_d(input), tolerance)?,
            w_to_e: self.gain(&self.of_w(state), tolerance)?,
            w_to_e_d: self.gain(&self.of_w(input), tolerance)?,
        })
    }

    fn of_d(&self, rows: (usize, usize)) -> Path {
        let part = |m: &DMatrix<f64>| m.rows(rows.0, rows.1).into_owned();
        Path {
            b: self.b_d.clone(),
            c: part(&self.c),
            d: part(&self.d_d),
            size_b: self.terms.b_d.clone(),
            size_c: part(&self.terms.c),
            size_d: part(&self.terms.d_d),
        }
    }

    fn of_w(&self, rows: (usize, usize)) -> Path {
        let part = |m: &DMatrix<f64>| m.rows(rows.0, rows.1).into_owned();
        let (c, d) = (part(&self.c), part(&self.d_w));
        let (size_c, size_d) = (part(&self.terms.c), d.abs());
        Path { b: self.b_w.clone(), size_b: self.b_w.abs(), c, d, size_c, size_d }
    }

    fn gain(&self, path: &Path, tolerance: &Tolerance) -> Result<ErrorGain, NumericsError> {
        if path.c.nrows() == 0 {
            return Ok(ErrorGain::NotEstimated);
        }
        if path.b.ncols() == 0 {
            return Ok(ErrorGain::NoInput);
        }
        match h_infinity_norm(&self.a, &path.b, &path.c, &path.d, self.region, tolerance) {
            Ok(found) if found.norm <= tolerance.residual * self.terms_at(found.frequency, path) => {
                Ok(ErrorGain::Decoupled)
            }
            Ok(found) => Ok(ErrorGain::Norm(found)),
            Err(HInfinityError::Unstable { mode, .. }) => {
                let mode = super::super::show(mode);
                Ok(ErrorGain::NotFinite(if self.with_plant {
                    format!(
                        "the error depends on the state of the plant, and the mode {mode} of both is not stable"
                    )
                } else {
                    format!("the error is not stable (mode {mode})")
                }))
            }
            Err(HInfinityError::Numerics(error)) => Err(error),
        }
    }

    /// `norm (|C| |(i w I - A)^-1| |B| + |D|)`.
    fn terms_at(&self, frequency: f64, path: &Path) -> f64 {
        let through = if frequency.is_finite() { self.resolvent(self.point(frequency)) } else { None };
        let direct = path.size_d.norm();
        through.map_or(direct, |resolvent| {
            (&path.size_c * resolvent.map(Complex64::norm) * &path.size_b).norm() + direct
        })
    }
}
