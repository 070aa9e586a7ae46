//! What a pole placement is asked for, what it returns, and what can go wrong.

use std::fmt;

use nalgebra::DMatrix;
use num_complex::Complex64;
use serde::{Deserialize, Serialize};

use crate::numerics::NumericsError;

/// How long the freedom that several outputs leave is searched for well-conditioned eigenvectors.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct PlacementOptions {
    /// Seed of the random starts: the same seed gives the same gain.
    pub seed: u64,
    /// Random starts, of which the best is improved.
    pub starts: usize,
    /// Largest number of sweeps over all eigenvectors.
    pub sweeps: usize,
}

impl Default for PlacementOptions {
    fn default() -> Self {
        Self { seed: 1, starts: 20, sweeps: 12 }
    }
}

/// The algorithm that gave a gain.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum PlacementMethod {
    /// Every mode is fixed: the gain is zero.
    NothingToPlace,
    /// As many independent outputs as states: `L = (A - diag(poles)) C^-1`.
    Direct,
    /// One independent output: Hessenberg form and a product over the poles; the gain is unique.
    SingleOutput,
    /// Eigenvectors chosen in the null spaces of `[A' - lambda I, C']` so that their condition number is small.
    NullSpace,
}

/// Something that a person must know about a gain.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum PlacementWarning {
    /// The poles depend strongly on the last digits of the gain.
    IllConditioned {
        /// Relative pole error that rounding the gain to double precision causes.
        expected: f64,
        /// Condition number of the closed-loop eigenvectors.
        condition: f64,
        /// Relative pole error seen in computed eigenvalues, when there are any.
        measured: Option<f64>,
    },
    /// Poles were repeated more often than the outputs allow and were moved apart.
    SplitRepeatedPoles {
        /// The poles that were assigned instead.
        assigned: Vec<Complex64>,
        /// The number of independent outputs.
        outputs: usize,
    },
    /// The closed loop is so sensitive that computed eigenvalues do not show its poles.
    Unverifiable {
        /// Relative error of the computed eigenvalues; `None` when there was no convergence.
        measured: Option<f64>,
        /// Relative pole error to expect in truth.
        expected: f64,
    },
}

impl fmt::Display for PlacementWarning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::IllConditioned { expected, condition, .. } => write!(
                f,
                "the placement is ill-conditioned (condition {condition:.1e}): rounding the gain alone moves the \
                 poles by {expected:.0e} of the largest; choose slower or more widely spread poles, or add an output"
            ),
            Self::SplitRepeatedPoles { outputs, .. } => write!(
                f,
                "with {outputs} independent outputs these repeated poles cannot be placed with independent \
                 eigenvectors; they were moved apart by a thousandth"
            ),
            Self::Unverifiable { measured: Some(measured), expected } => write!(
                f,
                "eigenvalues computed in double precision are off by {measured:.0e}, but the gain itself is good to \
                 {expected:.0e}: only exact arithmetic can show it"
            ),
            Self::Unverifiable { measured: None, expected } => write!(
                f,
                "the eigenvalues of A - L C could not be computed; the gain itself is good to {expected:.0e}"
            ),
        }
    }
}

/// A gain `L` and what it does: `eig(A - L C) = requested + fixed_modes`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Placement {
    /// The gain `L`, n x p.
    pub gain: DMatrix<f64>,
    /// The poles as they were asked for.
    pub requested: Vec<Complex64>,
    /// The eigenvalue of `A - L C` that belongs to each requested pole, in the same order; empty when floating-point
    /// arithmetic cannot see them ([`PlacementWarning::Unverifiable`]).
    pub achieved: Vec<Complex64>,
    /// Unobservable eigenvalues of `A`, which no gain moves.
    pub fixed_modes: Vec<Complex64>,
    /// Largest `|achieved - requested|` over the largest `|requested|` (over the norm of `A` when all are zero);
    /// `None` when there is nothing to compare.
    pub relative_error: Option<f64>,
    /// Condition number (2-norm) of the closed-loop eigenvectors; infinite for a repeated pole of a single output.
    pub condition: f64,
    /// Relative pole error that rounding the entries of `L` to double precision causes, to first order (for an m-fold
    /// pole of a single output: the m-th root of it).
    pub expected_accuracy: f64,
    /// The algorithm.
    pub method: PlacementMethod,
    /// What a person must know.
    pub warnings: Vec<PlacementWarning>,
}

/// Why no gain was computed.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum PlacementError {
    /// The number of poles is not the number of observable modes.
    #[error(
        "the list of poles has {found} entries, {needed} needed: one for each of {states} modes{}",
        except(fixed_modes)
    )]
    PoleCount {
        /// How many were given.
        found: usize,
        /// How many can be placed.
        needed: usize,
        /// The number of states.
        states: usize,
        /// The unobservable modes, which stay where they are.
        fixed_modes: Vec<Complex64>,
    },
    /// A pole is infinite or not a number.
    #[error("pole {} of the list is {pole}; give finite numbers", index + 1)]
    PoleNotFinite {
        /// Position in the list, from zero.
        index: usize,
        /// The pole.
        pole: Complex64,
    },
    /// No gain gives independent eigenvectors for these poles.
    #[error(
        "no gain was found that gives these poles independent eigenvectors; move poles that are close to each other apart"
    )]
    DependentEigenvectors,
    /// The gain leaves the range of double precision.
    #[error("the gain for these poles overflows; choose slower poles or scale the time")]
    Overflow,
    /// A matrix computation failed, or the data do not fit together.
    #[error(transparent)]
    Numerics(#[from] NumericsError),
}

fn except(fixed_modes: &[Complex64]) -> String {
    if fixed_modes.is_empty() {
        return String::new();
    }
    let listed: Vec<String> = fixed_modes
        .iter()
        .map(|z| if z.im == 0.0 { format!("{:.4}", z.re) } else { format!("{z:.4}") })
        .collect();
    format!(" except those that the outputs do not see ({})", listed.join(", "))
}
