//! A scenario: initial state, signals, uncertainty and horizon as data.

use nalgebra::DVector;

use super::{
    FreeVariables, Inputs, Observed, Plant, SimulationError, Span, Trajectory, Uncertainty, WidePlant,
    simulate_observed, wide_run,
};
use crate::expression::MAX_JUMPS;
use crate::numerics::{Tolerance, Watch};
use crate::observer::LinearObserver;
use crate::system::{DescriptorSystem, LipschitzTerm, Model, Signal, TimeDomain};

/// What happens to a plant and its observers.
///
/// Empty lists of signals stand for zeros. Observers start from zero.
#[derive(Clone, Debug, PartialEq)]
pub struct Scenario {
    /// Last instant, in seconds (discrete: steps).
    pub horizon: f64,
    /// Number of instants that are recorded.
    pub samples: usize,
    /// Initial state; the algebraic part is projected.
    pub x0: DVector<f64>,
    /// Known inputs.
    pub u: Vec<Signal>,
    /// Unknown inputs.
    pub d: Vec<Signal>,
    /// Measurement noise.
    pub noise: Vec<Signal>,
    /// Time-varying uncertainty of `A`.
    pub uncertainty: Option<Uncertainty>,
    /// What drives the states that the equations leave free.
    pub free: FreeVariables,
}

impl Scenario {
    /// Simulates a plant of any shape with the observers beside it; `watch` can cancel it.
    ///
    /// A plant with as many equations as states and of index 1 has no free variables; any other is completed as
    /// [`WidePlant`] says. What is free, what is corrected and what repeats stands in the trajectory's remarks.
    ///
    /// # Errors
    /// As [`simulate_observed`]; [`SimulationError::Overdetermined`] for equations that contradict what is given.
    pub fn run(
        &self,
        model: &Model,
        observers: &[Observed<'_>],
        tolerance: &Tolerance,
        watch: &Watch,
    ) -> Result<Trajectory, SimulationError> {
        let mut u0 = DVector::zeros(model.system.n_inputs());
        values(&self.u, 0.0, u0.as_mut_slice());
        if let Some(wide) = WidePlant::needed(model, &self.x0, &u0, tolerance)? {
            return wide_run::run(self, model, &wide, observers, tolerance, watch);
        }
        let given = model.system.n_unknown_inputs();
        self.run_with(model, observers, (given, &[]), tolerance, watch)
    }

    /// Simulates a square plant whose unknown inputs are `given` signals of the scenario and, behind them, `more`.
    pub(super) fn run_with(
        &self,
        model: &Model,
        observers: &[Observed<'_>],
        (given, more): (usize, &[Signal]),
        tolerance: &Tolerance,
        watch: &Watch,
    ) -> Result<Trajectory, SimulationError> {
        let active = self.uncertainty.as_ref().filter(|uncertainty| uncertainty.scale != 0.0);
        let plant = Plant::of(model, active, tolerance)?;
        let starts: Vec<Vec<f64>> = observers.iter().map(|o| vec![0.0; o.observer.order()]).collect();
        let observers: Vec<(Observed<'_>, &[f64])> =
            observers.iter().zip(&starts).map(|(observer, z0)| (*observer, z0.as_slice())).collect();
        let (mut jumps, mut kinks) = (Vec::new(), Vec::new());
        if model.system.time == TimeDomain::Continuous {
            jumps = self.jumps(more, model.lipschitz.as_ref())?;
            kinks = self.kinks(more, model.lipschitz.as_ref());
        }
        let unknown = |t: f64, out: &mut [f64]| {
            let (first, rest) = out.split_at_mut(given.min(out.len()));
            values(&self.d, t, first);
            values(more, t, rest);
        };
        let inputs = Inputs {
            known: &|t: f64, out: &mut [f64]| values(&self.u, t, out),
            unknown: &unknown,
            noise: &|t: f64, out: &mut [f64]| values(&self.noise, t, out),
            jumps: &jumps,
            kinks: &kinks,
        };
        let span = Span { horizon: self.horizon, samples: self.samples };
        simulate_observed(&plant, &observers, self.x0.as_slice(), &inputs, span, watch)
    }

    /// Simulates a linear plant with linear observers beside it.
    ///
    /// # Errors
    /// As [`Self::run`].
    pub fn run_linear(
        &self,
        system: &DescriptorSystem,
        observers: &[&LinearObserver],
        tolerance: &Tolerance,
    ) -> Result<Trajectory, SimulationError> {
        let observers: Vec<Observed<'_>> = observers.iter().map(|observer| (*observer).into()).collect();
        self.run(&Model::from(system.clone()), &observers, tolerance, &Watch::none())
    }

    /// All instants at which a signal, or the nonlinearity in time alone, jumps, sorted.
    fn jumps(&self, more: &[Signal], term: Option<&LipschitzTerm>) -> Result<Vec<f64>, SimulationError> {
        let signals = self.signals(more).map(|signal| (signal.text(), signal.jumps(0.0, self.horizon)));
        let nonlinear = term.into_iter().flat_map(|term| &term.f);
        let nonlinear = nonlinear.map(|f| (f.text(), f.jumps(0.0, self.horizon)));
        let mut jumps = Vec::new();
        for (text, found) in signals.chain(nonlinear) {
            if found.len() >= MAX_JUMPS {
                return Err(SimulationError::TooManyJumps { signal: text.to_owned(), limit: MAX_JUMPS });
            }
            jumps.extend(found);
        }
        Ok(sorted(jumps))
    }

    /// All instants at which a signal, or the nonlinearity in time alone, is not smooth, sorted.
    fn kinks(&self, more: &[Signal], term: Option<&LipschitzTerm>) -> Vec<f64> {
        let signals = self.signals(more).flat_map(|signal| signal.kinks(0.0, self.horizon));
        let nonlinear = term.into_iter().flat_map(|term| &term.f);
        sorted(signals.chain(nonlinear.flat_map(|f| f.kinks(0.0, self.horizon))).collect())
    }

    fn signals<'a>(&'a self, more: &'a [Signal]) -> impl Iterator<Item = &'a Signal> {
        self.u.iter().chain(&self.d).chain(&self.noise).chain(more)
    }
}

fn sorted(mut instants: Vec<f64>) -> Vec<f64> {
    instants.sort_by(f64::total_cmp);
    instants.dedup();
    instants
}

/// Writes the values of signals; zero where there is none.
pub(super) fn values(signals: &[Signal], t: f64, out: &mut [f64]) {
    for (i, value) in out.iter_mut().enumerate() {
        *value = signals.get(i).map_or(0.0, |signal| signal.value(t));
    }
}
