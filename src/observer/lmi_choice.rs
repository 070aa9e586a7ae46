//! What a person asks of a design by linear matrix inequalities.
#![expect(non_snake_case, reason = "N and J are the letters of both papers")]

use nalgebra::DMatrix;
use serde::{Deserialize, Serialize};

use super::DesignError;

/// Demands on a design by linear matrix inequalities (papers 000 and 002).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct LmiChoice {
    /// Demand on the speed of the error. Continuous time: `Re s < -decay`, 1/s; discrete time: `|z| < decay`;
    /// `None`: stability alone.
    pub decay: Option<f64>,
    /// Bound on the norm of the free gains; `None`: not bounded.
    pub gain: Option<f64>,
    /// Bound kappa on the condition of the Lyapunov matrix: `t I <= X <= kappa t I`.
    pub conditioning: f64,
    /// Attenuation from disturbance to error: `None` for the least one, otherwise this one with the largest margin.
    pub gamma: Option<f64>,
    /// Relative distance kept from the least attenuation, so that the design is interior and its gains moderate.
    pub back_off: f64,
    /// Paper 002: the inequality (52) with its slack matrices; paper 000: the extended parameterisation.
    pub alternative: bool,
    /// `R`, one for each subsystem; empty: chosen by the order.
    pub rows: Vec<DMatrix<f64>>,
    /// Paper 000: for each subsystem the states of the others whose influence is decoupled exactly, numbered in the whole
    /// system from zero; `None`: as many as the conditions allow.
    pub decoupled: Option<Vec<Vec<usize>>>,
    /// Paper 002: an observer that is examined instead of designing one.
    pub given: Option<GivenObserver>,
    /// Time limit of one solution of the inequalities, in seconds.
    pub seconds: f64,
}

impl Default for LmiChoice {
    fn default() -> Self {
        Self {
            decay: None,
            gain: Some(100.0),
            conditioning: 1e4,
            gamma: None,
            back_off: 0.01,
            alternative: false,
            rows: Vec::new(),
            decoupled: None,
            given: None,
            seconds: 10.0,
        }
    }
}

impl LmiChoice {
    /// Whether the demands make sense: each is a size, a speed or a radius.
    ///
    /// # Errors
    /// [`DesignError::Demand`] with what was found and what is needed.
    pub(super) fn check(&self, discrete: bool) -> Result<(), DesignError> {
        let positive = |x: f64| x.is_finite() && x > 0.0;
        let refuse = |what: &str, found: f64, needed: &str| {
            Err(DesignError::Demand(format!("the {what} is {found}, but {needed} is needed")))
        };
        match self.decay {
            Some(decay) if discrete && !(positive(decay) && decay <= 1.0) => {
                return refuse("decay", decay, "a radius |z| between 0 and 1");
            }
            Some(decay) if !(decay.is_finite() && decay >= 0.0) => {
                return refuse("decay rate", decay, "a finite number that is not negative");
            }
            _ => {}
        }
        if let Some(gain) = self.gain.filter(|gain| !positive(*gain)) {
            return refuse("gain bound", gain, "a positive finite number");
        }
        if let Some(gamma) = self.gamma.filter(|gamma| !positive(*gamma)) {
            return refuse("attenuation gamma", gamma, "a positive finite number");
        }
        if !(self.conditioning.is_finite() && self.conditioning >= 1.0) {
            return refuse("bound on the condition of X", self.conditioning, "a finite number of at least 1");
        }
        if !(self.back_off.is_finite() && self.back_off >= 0.0) {
            return refuse("back-off", self.back_off, "a finite number that is not negative");
        }
        Ok(())
    }
}

/// The matrices of an observer that was designed elsewhere, for example as a paper prints them.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct GivenObserver {
    /// State matrix, q x q.
    pub N: DMatrix<f64>,
    /// Output injection, q x p.
    pub J: DMatrix<f64>,
    /// The attenuation that is claimed for it.
    pub gamma: Option<f64>,
}
