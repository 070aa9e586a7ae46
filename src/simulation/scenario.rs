//! A scenario: initial state, signals, uncertainty and horizon as data.

use nalgebra::DVector;

use super::{Inputs, Plant, SimulationError, Span, Trajectory, Uncertainty, simulate};
use crate::expression::MAX_JUMPS;
use crate::numerics::Tolerance;
use crate::observer::LinearObserver;
use crate::system::{DescriptorSystem, Signal, TimeDomain};

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
}

impl Scenario {
    /// Simulates the plant with the observers beside it.
    ///
    /// # Errors
    /// As [`simulate`].
    pub fn run(
        &self,
        system: &DescriptorSystem,
        observers: &[&LinearObserver],
        tolerance: &Tolerance,
    ) -> Result<Trajectory, SimulationError> {
        let active = self.uncertainty.as_ref().filter(|uncertainty| uncertainty.scale != 0.0);
        let plant = Plant::new(system, active, tolerance)?;
        let starts: Vec<Vec<f64>> = observers.iter().map(|observer| vec![0.0; observer.order()]).collect();
        let observers: Vec<(&LinearObserver, &[f64])> =
            observers.iter().zip(&starts).map(|(observer, z0)| (*observer, z0.as_slice())).collect();
        let jumps = if system.time == TimeDomain::Discrete { Vec::new() } else { self.jumps()? };
        let inputs = Inputs {
            known: &|t: f64, out: &mut [f64]| values(&self.u, t, out),
            unknown: &|t: f64, out: &mut [f64]| values(&self.d, t, out),
            noise: &|t: f64, out: &mut [f64]| values(&self.noise, t, out),
            jumps: &jumps,
            kinks: &[],
        };
        let span = Span { horizon: self.horizon, samples: self.samples };
        simulate(&plant, &observers, self.x0.as_slice(), &inputs, span)
    }

    /// All instants at which a signal jumps, sorted.
    fn jumps(&self) -> Result<Vec<f64>, SimulationError> {
        let mut jumps = Vec::new();
        for signal in self.u.iter().chain(&self.d).chain(&self.noise) {
            let found = signal.jumps(0.0, self.horizon);
            if found.len() >= MAX_JUMPS {
                return Err(SimulationError::TooManyJumps {
                    signal: signal.text().to_owned(),
                    limit: MAX_JUMPS,
                });
            }
            jumps.extend(found);
        }
        jumps.sort_by(f64::total_cmp);
        jumps.dedup();
        Ok(jumps)
    }
}

fn values(signals: &[Signal], t: f64, out: &mut [f64]) {
    for (i, value) in out.iter_mut().enumerate() {
        *value = signals.get(i).map_or(0.0, |signal| signal.value(t));
    }
}
