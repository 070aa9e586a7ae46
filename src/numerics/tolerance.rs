//! The one set of thresholds that every verdict depends on, visible to the user.

use serde::{Deserialize, Serialize};

/// Thresholds of all rank, zero and stability decisions; there is no hidden one beside it.
///
/// # Source
/// Values measured on planted systems, see ARCHITECTURE.md ("Tolerances").
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Tolerance {
    /// Rank: a singular value counts when it exceeds `rank * max(rows, columns) * EPSILON * scale`,
    /// where `scale` is the largest of the matrix's own norm and the norm of the data it was computed from.
    pub rank: f64,
    /// Staircase of a pencil: relative to the norms of the original pencil, since rounding accumulates over its steps.
    pub pencil: f64,
    /// PBH test: `sigma_min [lambda I - A; C] / norm [A; C]` below this is an unobservable mode.
    pub mode: f64,
    /// Distance from the stability boundary below which a mode counts as not stable (relative to the data's norm).
    pub margin: f64,
    /// A rank decision with a gap below this is reported as fragile.
    pub gap: f64,
    /// Residuals of design equations, relative to the size of their terms.
    pub residual: f64,
}

impl Default for Tolerance {
    fn default() -> Self {
        Self { rank: 8.0, pencil: 1e-9, mode: 1e-9, margin: 1e-9, gap: 1e3, residual: 1e-8 }
    }
}
