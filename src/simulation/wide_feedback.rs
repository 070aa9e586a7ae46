//! How the free variables of a plant move its states, and a feedback that keeps it bounded.
#![expect(non_snake_case, reason = "matrix letters of the canonical form")]

use nalgebra::DMatrix;
use serde::{Deserialize, Serialize};

use super::{FreeVariables, SimulationError, WidePlant};
use crate::numerics::{
    Complex64, NumericsError, PlacementError, PlacementOptions, StabilityRegion, Tolerance, eigenvalues,
    observable_quotient, place_observer, pseudo_inverse, rank, side_by_side,
};
use crate::observer::input_decoupled::coordinates;
use crate::observer::show;
use crate::system::{Model, TimeDomain};

/// Most differential states for which a feedback is computed.
pub const MOST_FED_BACK: usize = 40;

/// The motion of a plant that its free variables drive, without other inputs.
///
/// ```text
/// x1' = A x1 + B v0,   x1 = S x        (discrete: x1[k+1])
/// ```
///
/// # Shapes
/// `A`: r x r with r = rank E; `B`: r x free variables; `S`: r x n.
#[derive(Clone, Debug, PartialEq)]
pub struct FreeMotion {
    /// State matrix; its eigenvalues are the modes of the plant.
    pub A: DMatrix<f64>,
    /// What the signals of the free variables do.
    pub B: DMatrix<f64>,
    /// The differential states.
    pub S: DMatrix<f64>,
}

impl FreeMotion {
    /// The modes of the plant.
    ///
    /// # Errors
    /// As [`eigenvalues`].
    pub fn modes(&self) -> Result<Vec<Complex64>, NumericsError> {
        eigenvalues(&self.A)
    }
}

/// A feedback of the free variables that keeps a plant bounded.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct BoundingFeedback {
    /// `K` of `v = v0 - K x`, free variables x n.
    pub feedback: DMatrix<f64>,
    /// The modes that it gives the plant, computed from the plant with the feedback as it is rounded.
    pub modes: Vec<Complex64>,
    /// What a person must know: that the modes are not quite those that were asked for.
    pub warning: Option<String>,
}

/// Why there is no such feedback, or no need for one.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum FeedbackError {
    /// Nothing to feed back to.
    #[error("the equations leave no state free: nothing can be fed back")]
    NothingFree,
    /// The plant is bounded as it is.
    #[error(
        "{} is bounded without feedback: its modes are {}",
        if *linear_part { "the linear part of the plant" } else { "the plant" },
        listed(modes)
    )]
    BoundedAlready {
        /// Its modes.
        modes: Vec<Complex64>,
        /// Whether there is more to the plant than what has these modes: a nonlinearity or uncertain entries.
        linear_part: bool,
    },
    /// A mode that is not stable and that no free variable reaches.
    #[error(
        "the free variables do not reach the {} {} of the plant, which {} not stable: no feedback of them keeps it bounded",
        if modes.len() == 1 { "mode" } else { "modes" },
        listed(modes),
        if modes.len() == 1 { "is" } else { "are" }
    )]
    NotControllable {
        /// These modes.
        modes: Vec<Complex64>,
    },
    /// More states than feedback is computed for.
    #[error("the plant has {found} differential states; a feedback is computed for at most {MOST_FED_BACK}")]
    TooLarge {
        /// How many there are.
        found: usize,
    },
    /// The gain does not do what it should.
    #[error(
        "the feedback that was found leaves the modes {} of the plant, which are not all stable: they depend too strongly on \
         its last digits. Type a feedback, or scale the states",
        listed(modes)
    )]
    Inaccurate {
        /// The modes of the plant with it.
        modes: Vec<Complex64>,
    },
    /// No gain was found.
    #[error("no feedback was found: {0}")]
    Placement(#[from] PlacementError),
    /// The plant cannot be completed, or a decomposition failed.
    #[error(transparent)]
    Simulation(#[from] SimulationError),
}

impl From<NumericsError> for FeedbackError {
    fn from(error: NumericsError) -> Self {
        Self::Simulation(error.into())
    }
}

fn listed(modes: &[Complex64]) -> String {
    modes.iter().map(|mode| show(*mode)).collect::<Vec<_>>().join(", ")
}

impl WidePlant {
    /// The motion that the signals of the free variables drive, with the feedback in force.
    ///
    /// A nonlinearity does not count.
    ///
    /// # Errors
    /// [`SimulationError::FreeFeedback`] for a feedback that cancels the free variables; a feedback of the wrong shape; what
    /// the system itself does not allow.
    pub fn motion(
        &self,
        model: &Model,
        free: &FreeVariables,
        tolerance: &Tolerance,
    ) -> Result<FreeMotion, SimulationError> {
        let linear = Model::from(model.system.clone());
        let completed = self.completed(&linear, free)?.system;
        let at = coordinates(&completed, tolerance)?;
        let size = side_by_side(&[&completed.A, &completed.D]).norm();
        let algebraic = rank(&at.A4, size, tolerance)?;
        if algebraic.rank < at.A4.ncols() {
            return Err(SimulationError::FreeFeedback);
        }
        // 0 = A3 x1 + A4 x2 + D2 [d; v0]
        let solved = &at.A2 * pseudo_inverse(&at.A4, tolerance)?;
        let driven = &at.D1 - &solved * &at.D2;
        let first = completed.D.ncols() - self.n_free();
        Ok(FreeMotion {
            A: &at.A1 - solved * &at.A3,
            B: driven.columns(first, self.n_free()).into_owned(),
            S: (&at.M1 * &completed.E).columns(0, model.system.n_states()).into_owned(),
        })
    }

    /// A feedback that moves the modes of a plant that are not stable, and leaves the others where they are.
    ///
    /// ```text
    /// eig(A - B K1) = stable modes of A + proposed ones,   K = K1 S
    /// ```
    /// Proposed are pairs `s (-1 +- i)`, as fast as the fastest mode that is not stable; `s = 1` for integrators, whose computed
    /// modes are rounding.
    ///
    /// # Errors
    /// When it is not needed, or not possible, and why.
    pub fn bounding_feedback(
        &self,
        model: &Model,
        tolerance: &Tolerance,
    ) -> Result<BoundingFeedback, FeedbackError> {
        if self.n_free() == 0 {
            return Err(FeedbackError::NothingFree);
        }
        let motion = self.motion(model, &FreeVariables::default(), tolerance)?;
        let region = StabilityRegion::of(model.system.time == TimeDomain::Discrete);
        let margin = region.margin(motion.A.norm().max(1.0), tolerance);
        let unstable = |modes: &[Complex64]| -> Vec<Complex64> {
            modes.iter().copied().filter(|mode| !region.contains(*mode, margin)).collect()
        };
        let modes = motion.modes()?;
        if unstable(&modes).is_empty() {
            let linear_part = model.lipschitz.is_some();
            return Err(FeedbackError::BoundedAlready { modes, linear_part });
        }
        let found = motion.A.nrows();
        if found > MOST_FED_BACK {
            return Err(FeedbackError::TooLarge { found });
        }
        let (dual, inputs) = (motion.A.transpose(), motion.B.transpose());
        let reached = observable_quotient(&dual, &inputs, tolerance)?;
        let fixed = unstable(&reached.fixed_modes);
        if !fixed.is_empty() {
            return Err(FeedbackError::NotControllable { modes: fixed });
        }
        let movable = eigenvalues(&reached.basis.tr_mul(&(&dual * &reached.basis)))?;
        let moved = unstable(&movable);
        let stay = movable.iter().copied().filter(|mode| region.contains(*mode, margin));
        // the size of the data in units of s
        let size = model.system.A.norm() / model.system.E.norm().max(f64::MIN_POSITIVE);
        let poles: Vec<Complex64> = stay.chain(proposed(&moved, region, size)).collect();
        // a first feedback need not be the best conditioned one
        let options = PlacementOptions { starts: 4, sweeps: 4, ..PlacementOptions::default() };
        let placed = place_observer(&dual, &inputs, &poles, &options, tolerance)?;
        let gain = placed.gain.transpose();
        let modes = eigenvalues(&(&motion.A - &motion.B * &gain))?;
        if !unstable(&modes).is_empty() {
            return Err(FeedbackError::Inaccurate { modes });
        }
        let warning = missed(&poles, &modes, placed.relative_error);
        Ok(BoundingFeedback { feedback: gain * motion.S, modes, warning })
    }
}

/// What is said of modes that are not those that were asked for, or that cannot be computed; `None` when they are.
fn missed(asked: &[Complex64], found: &[Complex64], relative_error: Option<f64>) -> Option<String> {
    if relative_error.is_some_and(|error| error <= NOTICEABLE) {
        return None;
    }
    Some(format!(
        "the modes depend strongly on the last digits of this feedback: asked for {}, found {}",
        listed(asked),
        listed(found)
    ))
}

/// Relative distance of the modes from those that were asked for above which it is said.
const NOTICEABLE: f64 = 1e-3;

/// As many stable poles as there are modes to be moved, all different; `size` is that of the plant in units of `s`.
fn proposed(moved: &[Complex64], region: StabilityRegion, size: f64) -> Vec<Complex64> {
    // a chain of k integrators is computed to the k-th root of rounding; longer ones are rare
    const LONGEST: usize = 4;
    let chain = moved.len().clamp(2, LONGEST) as f64;
    let rounding = f64::EPSILON.powf(chain.recip()) * size.max(f64::MIN_POSITIVE);
    let fastest = moved.iter().map(|mode| mode.norm()).fold(0.0, f64::max);
    let speed = if fastest > rounding { fastest } else { 1.0 };
    let pair = |k: usize| match region {
        StabilityRegion::LeftHalfPlane => Complex64::new(-1.0, 1.0) * speed * (1.0 + 0.5 * k as f64),
        StabilityRegion::UnitDisk => Complex64::new(0.5, 0.5) * 0.8_f64.powf(k as f64),
    };
    let mut poles: Vec<Complex64> = (0..moved.len() / 2).flat_map(|k| [pair(k), pair(k).conj()]).collect();
    if moved.len() % 2 == 1 {
        poles.push(Complex64::from(pair(moved.len() / 2).re));
    }
    poles
}

#[cfg(test)]
#[path = "wide_feedback_tests.rs"]
mod tests;
