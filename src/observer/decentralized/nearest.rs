//! When demands have no solution: the nearest ones that have, each changed alone.

use super::Setup;
use super::inequality::{Demands, Inequality};
use crate::lmi::{self, Nearest, Settings, Stop};

/// Relative distance from the boundary at which a nearest demand is reported, so that it can be reached.
const INSIDE: f64 = 1e-3;

/// Somebody no longer wanted it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cancelled;

/// The nearest feasible gamma, decay and gain bound, of those that are demanded and that alone make the rest feasible.
///
/// # Errors
/// [`Cancelled`].
pub(super) fn nearest(
    setup: &Setup,
    demands: &Demands,
    settings: &Settings,
) -> Result<Vec<Nearest>, Cancelled> {
    let search = Search { setup, settings };
    let mut result = Vec::new();
    let mut add = |quantity: &str, asked: Option<f64>, feasible: Option<f64>| {
        if let (Some(asked), Some(feasible)) = (asked, feasible) {
            result.push(Nearest { quantity: quantity.to_owned(), asked, feasible });
        }
    };
    add("gamma", demands.gamma, search.gamma(demands)?);
    add("decay rate", demands.decay, search.decay(demands)?);
    add("gain bound", demands.gain, search.gain(demands)?);
    Ok(result)
}

struct Search<'a> {
    setup: &'a Setup,
    settings: &'a Settings,
}

impl Search<'_> {
    /// Whether the demands have a solution.
    fn possible(&self, demands: &Demands) -> Result<bool, Cancelled> {
        match lmi::feasible(&Inequality::new(self.setup, demands).problem, self.settings) {
            Ok(_) => Ok(true),
            Err(Stop::Cancelled) => Err(Cancelled),
            Err(Stop::Infeasible { .. } | Stop::GaveUp(_)) => Ok(false),
        }
    }

    /// The least gamma with the other demands as they are.
    fn gamma(&self, demands: &Demands) -> Result<Option<f64>, Cancelled> {
        if demands.gamma.is_none() || !self.setup.is_driven() {
            return Ok(None);
        }
        let free = Inequality::new(self.setup, &Demands { gamma: None, ..*demands });
        match lmi::optimum(&free.problem, &free.gamma, self.settings) {
            Ok(found) => Ok(found.optimum.map(|scaled| free.attenuation_at(scaled) * (1.0 + INSIDE))),
            Err(Stop::Cancelled) => Err(Cancelled),
            Err(Stop::Infeasible { .. } | Stop::GaveUp(_)) => Ok(None),
        }
    }

    /// The fastest decay with the other demands as they are, by bisection between it and mere stability.
    fn decay(&self, demands: &Demands) -> Result<Option<f64>, Cancelled> {
        let Some(asked) = demands.decay else { return Ok(None) };
        let slowest = if self.setup.problem.is_discrete() { 1.0 } else { 0.0 };
        let at = |decay| Demands { decay: Some(decay), ..*demands };
        if !self.possible(&at(slowest))? {
            return Ok(None);
        }
        const STEPS: usize = 14;
        let (mut good, mut bad) = (slowest, asked);
        for _ in 0..STEPS {
            let middle = 0.5 * (good + bad);
            if self.possible(&at(middle))? {
                good = middle;
            } else {
                bad = middle;
            }
            if (good - bad).abs() <= INSIDE * good.abs() {
                break;
            }
        }
        Ok(Some(good))
    }

    /// A gain bound that suffices with the other demands as they are, to ten per cent.
    fn gain(&self, demands: &Demands) -> Result<Option<f64>, Cancelled> {
        let Some(asked) = demands.gain else { return Ok(None) };
        let at = |gain| Demands { gain: Some(gain), ..*demands };
        const DECADES: i32 = 4;
        let mut enough = None;
        for decade in 1..=DECADES {
            let gain = asked * 10_f64.powi(decade);
            if self.possible(&at(gain))? {
                enough = Some(gain);
                break;
            }
        }
        let Some(mut good) = enough else { return Ok(None) };
        let mut bad = 0.1 * good;
        while good > 1.1 * bad {
            let middle = (good * bad).sqrt();
            if self.possible(&at(middle))? {
                good = middle;
            } else {
                bad = middle;
            }
        }
        Ok(Some(good))
    }
}
