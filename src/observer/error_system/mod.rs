//! The error of a linear observer as a state space: from unknown input and measurement noise to `x_hat - x`, `d_hat - d`.
//!
//! With its claim `z -> T1 E x + T2 d` an observer's error does not depend on the plant's motion. In the coordinates
//! `zeta = z - T1 E x` nothing but the claimed identities and `W + G B = 0`, `G E = 0` is needed, in continuous and in
//! discrete time alike, whether or not `d` is estimated:
//! ```text
//! zeta'                    = N zeta + (L F - T1 D) d + L w
//! [x_hat - x; d_hat - d]   = [P; Q] zeta + ([V; R] F + G D - [0; I]) d + [V; R] w
//! ```
//! For a proportional-integral observer `L F - T1 D = -N T2`, which is the transfer function `s (s I - N)^-1` of the
//! paper without its derivative; for an input-decoupled one it vanishes. Without a claim the plant is reduced to its
//! differential states and taken along, as far as the error shows it.

mod claimed;
mod gains;
mod joint;
mod network;
#[cfg(test)]
mod tests;

use nalgebra::DMatrix;

pub use gains::{ErrorGain, ErrorGains};
pub use network::network_error_system;

use super::Design;
use crate::numerics::{Complex64, NumericsError, StabilityRegion, Tolerance};
use crate::system::{DescriptorSystem, TimeDomain};

/// `zeta' = A zeta + Bd d + Bw w`, `[x_hat - x; d_hat - d] = C zeta + Dd d + Dw w` (discrete: `zeta[k+1]`).
///
/// # Shapes
/// Rows of `C`: the estimated states, then the estimated unknown inputs. Columns of `Bd`: all unknown inputs; of `Bw`: all
/// outputs, each with its own noise.
#[derive(Clone, Debug, PartialEq)]
pub struct ErrorStateSpace {
    /// Dynamics of the error.
    pub a: DMatrix<f64>,
    /// Unknown input into the error.
    pub b_d: DMatrix<f64>,
    /// Noise into the error.
    pub b_w: DMatrix<f64>,
    /// What is seen of it.
    pub c: DMatrix<f64>,
    /// Unknown input to the error at once.
    pub d_d: DMatrix<f64>,
    /// Noise to the error at once.
    pub d_w: DMatrix<f64>,
    /// The states whose error the first rows are, from zero.
    pub states: Vec<usize>,
    /// Where modes have to lie.
    pub region: StabilityRegion,
    /// Whether modes of the plant take part.
    pub with_plant: bool,
    /// What rounding of `b_d`, `c` and `d_d` is relative to, entry by entry.
    terms: Terms,
}

/// Sums of the absolute values of the terms that were added up.
#[derive(Clone, Debug, PartialEq)]
struct Terms {
    b_d: DMatrix<f64>,
    c: DMatrix<f64>,
    d_d: DMatrix<f64>,
}

/// Why the error has no state space.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ErrorSystemError {
    /// The plant takes part and has free variables, or more equations than states.
    #[error(
        "the error depends on the plant, whose {equations} equations do not determine the motion of its {states} states: \
         only a plant with as many equations as states has a transfer function"
    )]
    NotSquare {
        /// Rows of `E`.
        equations: usize,
        /// Columns of `E`.
        states: usize,
    },
    /// The plant takes part and has impulses.
    #[error(
        "the error depends on the plant, which is not of index 1 (smallest singular value of U2' A V2: {smallest:.1e}): its \
         impulses have no finite gain"
    )]
    NotIndexOne {
        /// Smallest singular value.
        smallest: f64,
    },
    /// The plant, or a whole that local observers listen to, takes part and is too large.
    #[error(
        "the error has {found} states together with what drives it; gains of at most {most} are computed"
    )]
    TooLarge {
        /// States of all together.
        found: usize,
        /// The limit.
        most: usize,
    },
    /// A decomposition failed.
    #[error(transparent)]
    Numerics(#[from] NumericsError),
}

/// The error system of a design; of a design for a nonlinear plant the linear part, `f = 0`.
///
/// # Errors
/// [`ErrorSystemError`]: only designs without a claim need a square plant of index 1.
///
/// # Source
/// Claims: Koenig and Mammar 2002, (6), (7); paper 002, (10), (11); paper 003, (8).
pub fn error_system(
    system: &DescriptorSystem,
    design: &Design,
    tolerance: &Tolerance,
) -> Result<ErrorStateSpace, ErrorSystemError> {
    if let Some(claim) = &design.claim {
        return Ok(claimed::claimed(system, &design.observer, claim));
    }
    if let Some(found) = design.hierarchical.as_ref().and_then(|_| claimed::of_network(system, design)) {
        return Ok(found);
    }
    joint::joint(system, &design.observer, tolerance)
}

impl ErrorStateSpace {
    /// The transfer matrices from `d` and from `w` at a point; `None` at a mode.
    pub fn response(&self, s: Complex64) -> Option<(DMatrix<Complex64>, DMatrix<Complex64>)> {
        let complex = |m: &DMatrix<f64>| m.map(Complex64::from);
        let resolvent = self.resolvent(s)?;
        let of =
            |b: &DMatrix<f64>, d: &DMatrix<f64>| complex(&self.c) * (&resolvent * complex(b)) + complex(d);
        Some((of(&self.b_d, &self.d_d), of(&self.b_w, &self.d_w)))
    }

    /// `(s I - A)^-1`.
    fn resolvent(&self, s: Complex64) -> Option<DMatrix<Complex64>> {
        let n = self.a.nrows();
        let pencil = DMatrix::from_fn(n, n, |i, j| {
            let a = Complex64::from(-self.a[(i, j)]);
            if i == j { s + a } else { a }
        });
        let inverse = pencil.try_inverse()?;
        inverse.iter().all(|z| z.re.is_finite() && z.im.is_finite()).then_some(inverse)
    }

    /// The point of the boundary of stability that belongs to an angular frequency.
    pub fn point(&self, frequency: f64) -> Complex64 {
        match self.region {
            StabilityRegion::LeftHalfPlane => Complex64::new(0.0, frequency),
            StabilityRegion::UnitDisk => Complex64::from_polar(1.0, frequency),
        }
    }
}

/// Where the modes of a system's observers have to lie.
fn region(system: &DescriptorSystem) -> StabilityRegion {
    StabilityRegion::of(system.time == TimeDomain::Discrete)
}
