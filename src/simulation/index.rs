//! Whether an uncertain plant keeps index 1 over the whole horizon.

use nalgebra::DMatrix;

use super::newton::determinant_sign;
use super::{Plant, SimulationError};
use crate::numerics::svd;

/// Samples per period of the fastest uncertainty.
const PER_PERIOD: f64 = 40.0;
/// Most instants that are looked at.
const MOST: usize = 200_000;
/// Refinements of an instant: intervals shrink by a factor of about 1e-12.
const REFINEMENTS: usize = 60;

/// `A22` at one instant: the sign of its determinant, and a bound within `sqrt(n)` below its smallest singular value.
#[derive(Clone, Copy, Debug)]
struct Look {
    t: f64,
    sign: f64,
    bound: f64,
}

impl Plant {
    /// The smallest singular value of `A22(t)` over `0..=horizon`.
    ///
    /// Looks at many instants, and closer wherever the determinant changes its sign or the bound has a low minimum.
    /// In discrete time only the steps themselves count.
    ///
    /// # Tolerance
    /// `pencil`, relative to the norm of `A`: below it the plant counts as having lost index 1.
    ///
    /// # Errors
    /// [`SimulationError::LosesIndexOne`] with the first such instant.
    pub(super) fn smallest_a22(&self, horizon: f64) -> Result<f64, SimulationError> {
        if self.is_implicit() {
            // decided along the motion
            return Ok(f64::INFINITY);
        }
        if !self.varies() || self.algebraic_rows.nrows() == 0 {
            return Ok(self.index_decision().smallest());
        }
        let fastest = self.varying.iter().map(|v| v.frequency.abs()).fold(0.0, f64::max);
        let wanted = (PER_PERIOD * fastest * horizon).max(1000.0);
        let discrete = self.is_discrete();
        let mut count = 1;
        while count < MOST && (count as f64) < wanted {
            count *= 2;
        }
        let step = if discrete { 1.0 } else { horizon / count as f64 };
        let first = self.look(0.0);
        let (mut before, mut here, mut lowest) = (first, first, first);
        let mut k = 1;
        while k as f64 * step <= horizon * (1.0 + f64::EPSILON) && k <= MOST {
            let next = self.look(k as f64 * step);
            if !discrete && next.sign * here.sign <= 0.0 {
                return Err(self.lost(self.sign_change(here, next))?);
            }
            let valley = here.bound <= before.bound && here.bound <= next.bound;
            if !discrete && valley && here.bound < 0.1 * first.bound {
                here = self.valley(before.t, next.t);
            }
            for look in [here, next] {
                if look.bound < lowest.bound {
                    lowest = look;
                }
            }
            if self.is_singular(lowest)? {
                return Err(self.lost(lowest.t)?);
            }
            (before, here) = (Look { t: k as f64 * step - step, ..here }, next);
            k += 1;
        }
        self.sigma(lowest.t)
    }

    fn look(&self, t: f64) -> Look {
        let factors = self.algebraic_block(t).lu();
        let sign = determinant_sign(&factors);
        let bound = factors.try_inverse().map_or(0.0, |inverse| inverse.norm().recip());
        Look { t, sign, bound }
    }

    /// The instant between two looks of different sign at which `A22` is singular.
    fn sign_change(&self, mut left: Look, mut right: Look) -> f64 {
        for _ in 0..REFINEMENTS {
            let middle = self.look(0.5 * (left.t + right.t));
            if middle.sign * left.sign <= 0.0 {
                right = middle;
            } else {
                left = middle;
            }
        }
        right.t
    }

    /// The look with the lowest bound in an interval, by the golden section.
    fn valley(&self, mut left: f64, mut right: f64) -> Look {
        const RATIO: f64 = 0.618_033_988_749_894_9;
        let mut a = self.look(right - RATIO * (right - left));
        let mut b = self.look(left + RATIO * (right - left));
        for _ in 0..REFINEMENTS {
            if a.bound <= b.bound {
                right = b.t;
                (b, a) = (a, self.look(b.t - RATIO * (b.t - left)));
            } else {
                left = a.t;
                (a, b) = (b, self.look(a.t + RATIO * (right - a.t)));
            }
        }
        if a.bound <= b.bound { a } else { b }
    }

    fn sigma(&self, t: f64) -> Result<f64, SimulationError> {
        Ok(svd(&self.algebraic_block(t))?.s.last().copied().unwrap_or(f64::INFINITY))
    }

    fn is_singular(&self, look: Look) -> Result<bool, SimulationError> {
        let threshold = self.tolerance.pencil * self.system().A.norm();
        // the bound spares the decomposition where it decides already
        Ok(look.bound <= threshold && self.sigma(look.t)? <= threshold)
    }

    fn lost(&self, time: f64) -> Result<SimulationError, SimulationError> {
        let smallest = self.sigma(time)?;
        let weight = |m: &DMatrix<f64>, at: usize| m.column(at).norm();
        let columns = self.algebraic_columns.transpose();
        let enters = |row, column| weight(&self.algebraic_rows, row) * weight(&columns, column) > 1e-9;
        let entries: Vec<String> = self
            .varying
            .iter()
            .filter(|v| enters(v.row, v.column))
            .map(|v| format!("A[{}, {}]", v.row + 1, v.column + 1))
            .collect();
        Ok(SimulationError::LosesIndexOne { time, smallest, entries: entries.join(", ") })
    }
}
