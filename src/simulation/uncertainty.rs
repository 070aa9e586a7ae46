//! Entries of the state matrix that vary in time.

use std::f64::consts::TAU;

use nalgebra::DMatrix;
use serde::{Deserialize, Serialize};

use super::SimulationError;

/// Relative variations of the entries of `A`, entry by entry.
///
/// ```text
/// a_ij(t) = a_ij (1 + scale * amplitude_ij * sin(2 pi frequency_ij t))
/// ```
///
/// # Shapes
/// Both matrices have the shape of `A`; frequencies in Hz (per step in discrete time). Entries that are zero stay zero.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Uncertainty {
    /// Relative amplitudes.
    pub amplitude: DMatrix<f64>,
    /// Frequencies in Hz.
    pub frequency: DMatrix<f64>,
    /// One factor for all amplitudes.
    pub scale: f64,
}

/// An entry of `A` that varies: place, nominal value times amplitude, frequency.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Varying {
    pub(super) row: usize,
    pub(super) column: usize,
    swing: f64,
    pub(super) frequency: f64,
}

impl Varying {
    /// What is added to the nominal entry at time `t`.
    pub(super) fn deviation(&self, t: f64) -> f64 {
        self.swing * (TAU * self.frequency * t).sin()
    }
}

impl Uncertainty {
    /// The entries of `a` that really vary.
    pub(super) fn varying(&self, a: &DMatrix<f64>) -> Result<Vec<Varying>, SimulationError> {
        for (what, matrix) in [("amplitude", &self.amplitude), ("frequency", &self.frequency)] {
            if matrix.shape() != a.shape() {
                return Err(SimulationError::Shape {
                    what: format!("the uncertainty's {what}"),
                    found: matrix.shape(),
                    needed: a.shape(),
                    reason: "it has an entry for each entry of A",
                });
            }
            if matrix.iter().any(|x| !x.is_finite()) {
                return Err(SimulationError::NotFinite { what: format!("the uncertainty's {what}") });
            }
        }
        if !self.scale.is_finite() {
            return Err(SimulationError::NotFinite { what: "the uncertainty's scale".to_owned() });
        }
        let entries = (0..a.ncols()).flat_map(|column| (0..a.nrows()).map(move |row| (row, column)));
        let entries = entries.map(|(row, column)| Varying {
            row,
            column,
            swing: a[(row, column)] * self.scale * self.amplitude[(row, column)],
            frequency: self.frequency[(row, column)],
        });
        Ok(entries.filter(|entry| entry.swing != 0.0 && entry.frequency != 0.0).collect())
    }
}
