//! How the free variables of a plant move its states, and a feedback that keeps it bounded.
#![expect(non_snake_case, reason = "matrix letters of the canonical form")]

use nalgebra::DMatrix;
use serde::{Deserialize, Serialize};

use super::{FreeVariables, SimulationError, WidePlant};
use crate::numerics::{
    Complex64, NumericsError, PlacementError, PlacementOptions, StabilityRegion, Tolerance, eigenvalues,
    observable_quotient, place_observer, pseudo_inverse, rank,
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
    /// The modes that it gives the plant.
    pub modes: Vec<Complex64>,
}

/// Why there is no such feedback, or no need for one.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum FeedbackError {
    /// Nothing to feed back to.
    #[error("the equations leave no state free: nothing can be fed back")]
    NothingFree,
    /// The plant is bounded as it is.
    #[error("the plant is bounded without feedback: its modes are {}", listed(modes))]
    BoundedAlready {
        /// Its modes.
        modes: Vec<Complex64>,
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
        let algebraic = rank(&at.A4, at.scale, tolerance)?;
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
    /// Proposed are pairs `s (-1 +- i)`, as fast as the fastest mode that is not stable (one for a plant of integrators).
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
            return Err(FeedbackError::BoundedAlready { modes });
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
        let poles: Vec<Complex64> = stay.chain(proposed(&moved, region)).collect();
        // a first feedback need not be the best conditioned one
        let options = PlacementOptions { starts: 4, sweeps: 4, ..PlacementOptions::default() };
        let placed = place_observer(&dual, &inputs, &poles, &options, tolerance)?;
        let modes = poles.into_iter().chain(reached.fixed_modes).collect();
        Ok(BoundingFeedback { feedback: placed.gain.transpose() * motion.S, modes })
    }
}

/// As many stable poles as there are modes to be moved, all different.
fn proposed(moved: &[Complex64], region: StabilityRegion) -> Vec<Complex64> {
    let fastest = moved.iter().map(|mode| mode.norm()).fold(0.0, f64::max);
    let speed = if fastest > 0.0 { fastest } else { 1.0 };
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
mod tests {
    use super::*;
    use crate::numerics::spectral_distance;
    use crate::system::DescriptorSystem;
    use nalgebra::{DVector, dmatrix};

    fn model(time: TimeDomain, E: DMatrix<f64>, A: DMatrix<f64>, D: DMatrix<f64>) -> Model {
        let (e, n, q) = (E.nrows(), E.ncols(), D.ncols());
        let system = DescriptorSystem {
            time,
            E,
            A,
            B: DMatrix::zeros(e, 0),
            C: DMatrix::identity(n, n),
            D,
            F: DMatrix::zeros(n, q),
        };
        system.checked().unwrap().into()
    }

    fn wide(model: &Model) -> WidePlant {
        let x0 = DVector::zeros(model.system.n_states());
        WidePlant::new(model, &x0, &DVector::zeros(0), &Tolerance::default()).unwrap()
    }

    fn bounded(model: &Model) -> Result<BoundingFeedback, FeedbackError> {
        wide(model).bounding_feedback(model, &Tolerance::default())
    }

    /// The modes of the plant with a feedback.
    fn modes(model: &Model, feedback: DMatrix<f64>) -> Vec<Complex64> {
        let free = FreeVariables { signals: Vec::new(), feedback: Some(feedback) };
        wide(model).motion(model, &free, &Tolerance::default()).unwrap().modes().unwrap()
    }

    /// Random plants; the modes are those of the plant with its feedback, found without the formulas above.
    #[test]
    fn a_bounding_feedback_gives_the_modes_that_it_names() {
        let mut random = crate::numerics::Random::new(5);
        for time in [TimeDomain::Continuous, TimeDomain::Discrete] {
            for (e, n, q) in [(3, 4, 1), (2, 5, 0), (4, 6, 2), (1, 3, 0), (5, 6, 0)] {
                let mut fill = |rows, columns| DMatrix::from_fn(rows, columns, |_, _| random.normal());
                let mut E = fill(e, n);
                if e > 2 {
                    E.row_mut(e - 1).fill(0.0);
                }
                let plant = model(time, E, 3.0 * fill(e, n), fill(e, q));
                let found = match bounded(&plant) {
                    Ok(found) => found,
                    Err(FeedbackError::BoundedAlready { .. }) => continue,
                    Err(error) => panic!("{e} x {n}: {error}"),
                };
                let region = StabilityRegion::of(time == TimeDomain::Discrete);
                assert!(found.modes.iter().all(|z| region.contains(*z, 0.0)), "stable: {:?}", found.modes);
                let off = spectral_distance(&modes(&plant, found.feedback.clone()), &found.modes);
                assert!(off < 1e-6, "{time:?} {e} x {n}: modes off by {off:.1e}, {}", found.feedback);
            }
        }
    }

    #[test]
    fn stable_modes_stay_and_are_not_made_fast() {
        // x1' = -100 x1 + x3, x2' = 2 x2 + x3, x3 free
        let plant = model(
            TimeDomain::Continuous,
            dmatrix![1.0, 0.0, 0.0; 0.0, 1.0, 0.0],
            dmatrix![-100.0, 0.0, 1.0; 0.0, 2.0, 1.0],
            DMatrix::zeros(2, 0),
        );
        let found = bounded(&plant).unwrap();
        let off = spectral_distance(&found.modes, &[-100.0, -2.0].map(Complex64::from));
        assert!(off < 1e-9, "{:?}", found.modes);
        assert!(found.feedback[(0, 0)].abs() < 1e-9, "what is stable is not fed back: {}", found.feedback);
    }

    #[test]
    fn modes_out_of_reach_are_named() {
        // x1' = x1 whatever x2 does
        let plant = |pole: f64| {
            let E = dmatrix![1.0, 0.0, 0.0; 0.0, 1.0, 0.0];
            model(TimeDomain::Continuous, E, dmatrix![pole, 0.0, 0.0; 0.0, 3.0, 1.0], DMatrix::zeros(2, 0))
        };
        let error = bounded(&plant(1.0)).unwrap_err();
        assert_eq!(
            error.to_string(),
            "the free variables do not reach the mode 1 of the plant, which is not stable: no feedback of them keeps it \
             bounded"
        );
        let found = bounded(&plant(-1.0)).unwrap();
        assert!(found.modes.contains(&Complex64::from(-1.0)), "a stable one may stay: {:?}", found.modes);
    }

    #[test]
    fn what_needs_no_feedback_says_so() {
        let plant =
            model(TimeDomain::Continuous, dmatrix![1.0, 0.0], dmatrix![-2.0, 1.0], DMatrix::zeros(1, 0));
        let error = bounded(&plant).unwrap_err();
        assert_eq!(error.to_string(), "the plant is bounded without feedback: its modes are -2");
        let square = model(TimeDomain::Continuous, dmatrix![1.0], dmatrix![2.0], DMatrix::zeros(1, 0));
        assert_eq!(bounded(&square).unwrap_err(), FeedbackError::NothingFree, "x' = 2 x");
    }

    #[test]
    fn an_unknown_input_that_the_equations_fix_belongs_to_the_modes() {
        // x1' = 3 x1 + x2 + d, 0 = x1 + d: d = -x1, so that x1' = 2 x1 + x2
        let plant = model(
            TimeDomain::Continuous,
            dmatrix![1.0, 0.0; 0.0, 0.0],
            dmatrix![3.0, 1.0; 1.0, 0.0],
            dmatrix![1.0; 1.0],
        );
        let open = wide(&plant).motion(&plant, &FreeVariables::default(), &Tolerance::default()).unwrap();
        assert!((open.A[(0, 0)].abs() - 2.0).abs() < 1e-14, "{}", open.A);
        let found = bounded(&plant).unwrap();
        assert!((modes(&plant, found.feedback)[0] + 2.0).norm() < 1e-12, "moved to -2");
    }
}
