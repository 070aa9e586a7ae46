//! Plant and observers as one set of equations.

use nalgebra::{DMatrix, DVector};

use super::evaluator::Evaluator;
use super::plant::sees;
use super::run::LARGEST_STATE;
use super::{Observed, Plant, SimulationError};
use crate::numerics::integrate::Signals;
use crate::observer::{Injection, LinearObserver};
use crate::system::DescriptorSystem;

/// Everything that drives plant and observers from outside.
#[derive(Clone, Copy)]
pub struct Inputs<'a> {
    /// Known inputs, k signals.
    pub known: &'a dyn Signals,
    /// Unknown inputs, q signals.
    pub unknown: &'a dyn Signals,
    /// Measurement noise, p signals.
    pub noise: &'a dyn Signals,
    /// Instants where a signal jumps, in any order.
    pub jumps: &'a [f64],
    /// Instants where a signal is continuous but not smooth, in any order.
    pub kinks: &'a [f64],
}

impl std::fmt::Debug for Inputs<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Inputs")
            .field("jumps", &self.jumps)
            .field("kinks", &self.kinks)
            .finish_non_exhaustive()
    }
}

/// Values of all signals at one instant, stacked `[u; d; v]` with the noise `v`.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Values {
    pub(super) u: DVector<f64>,
    pub(super) d: DVector<f64>,
    pub(super) v: DVector<f64>,
}

/// Plant, observers and inputs, whose shapes fit together.
///
/// ```text
/// w = [xi; z_1; z_2; ...],   y = C x + F d + v
/// z_i' = N_i z_i + L_i y + H_i u + S_i f(t, x_hat_i),   x_hat_i = P_i z_i + V_i y + W_i u + M_i f(t, x_hat_i)
/// ```
#[derive(Clone, Debug)]
pub(super) struct Joint<'a> {
    pub(super) plant: &'a Plant,
    pub(super) observers: Vec<Observed<'a>>,
    pub(super) inputs: Inputs<'a>,
}

impl<'a> Joint<'a> {
    /// Joins a plant and observers after checking that their shapes fit.
    pub(super) fn new(
        plant: &'a Plant,
        observers: &[Observed<'a>],
        inputs: Inputs<'a>,
    ) -> Result<Self, SimulationError> {
        for (i, observed) in observers.iter().enumerate() {
            check(i, observed.observer, plant.system())?;
            if let Some(injection) = observed.injection {
                check_injection(i, injection, observed.observer.order(), plant)?;
            }
        }
        Ok(Self { plant, observers: observers.to_vec(), inputs })
    }

    /// Number of states of plant and observers together.
    pub(super) fn order(&self) -> usize {
        self.plant.order() + self.observers.iter().map(|o| o.observer.order()).sum::<usize>()
    }

    /// Number of signals of all kinds.
    pub(super) fn n_signals(&self) -> usize {
        let system = self.plant.system();
        system.n_inputs() + system.n_unknown_inputs() + system.n_outputs()
    }

    /// All signals zero.
    pub(super) fn silence(&self) -> Values {
        let system = self.plant.system();
        Values {
            u: DVector::zeros(system.n_inputs()),
            d: DVector::zeros(system.n_unknown_inputs()),
            v: DVector::zeros(system.n_outputs()),
        }
    }

    /// Reads all signals at time `t`, finite or not.
    pub(super) fn read(&self, t: f64, values: &mut Values) {
        self.inputs.known.value(t, values.u.as_mut_slice());
        self.inputs.unknown.value(t, values.d.as_mut_slice());
        self.inputs.noise.value(t, values.v.as_mut_slice());
    }

    /// The first signal without a finite value.
    pub(super) fn silent(values: &Values, time: f64) -> Option<SimulationError> {
        Self::first(values, |x| !x.is_finite()).map(|(signal, index)| SimulationError::Signal {
            signal,
            index,
            time,
        })
    }

    /// The name of the first signal that is too large to be followed.
    pub(super) fn too_large(values: &Values) -> Option<String> {
        Self::first(values, |x| x.abs() > LARGEST_STATE)
            .map(|(signal, index)| format!("{signal} {}", index + 1))
    }

    fn first(values: &Values, is: fn(&f64) -> bool) -> Option<(&'static str, usize)> {
        let named =
            [("known input", &values.u), ("unknown input", &values.d), ("measurement noise", &values.v)];
        named.into_iter().find_map(|(signal, vector)| vector.iter().position(is).map(|index| (signal, index)))
    }

    /// All signals at time `t`.
    pub(super) fn finite_values(&self, t: f64) -> Result<Values, SimulationError> {
        let mut values = self.silence();
        self.read(t, &mut values);
        Self::silent(&values, t).map_or(Ok(values), Err)
    }

    /// Whether an observer's estimate depends on itself through the nonlinearity.
    pub(super) fn is_implicit(&self, observed: &Observed<'_>) -> bool {
        observed.injection.zip(self.plant.nonlinear.as_ref()).is_some_and(|(injection, nonlinear)| {
            sees(&nonlinear.seen, &injection.estimate, injection.estimate.amax())
        })
    }

    /// Whether all equations are linear with constant coefficients.
    pub(super) fn is_linear_and_constant(&self) -> bool {
        self.plant.is_linear_and_constant()
    }

    /// Constant coefficients `w' = M w + G [u; d; v]`, column by column.
    pub(super) fn coefficients(&self) -> (DMatrix<f64>, DMatrix<f64>) {
        let mut evaluator = Evaluator::new(self, &vec![0.0; self.plant.system().n_states()]);
        let mut column = |w: &[f64], values: Values| {
            evaluator.values = values;
            if evaluator.evaluate_given(0.0, w).is_err() {
                evaluator.derivative.fill(f64::NAN);
            }
            evaluator.derivative.clone()
        };
        let order = self.order();
        let mut unit = vec![0.0; order];
        let mut m = DMatrix::zeros(order, order);
        for j in 0..order {
            unit[j] = 1.0;
            m.set_column(j, &column(&unit, self.silence()));
            unit[j] = 0.0;
        }
        let mut g = DMatrix::zeros(order, self.n_signals());
        for j in 0..self.n_signals() {
            let mut signal = DVector::zeros(self.n_signals());
            signal[j] = 1.0;
            g.set_column(j, &column(&unit, self.unstacked(&signal)));
        }
        (m, g)
    }

    /// `[u; d; v]` as one vector.
    pub(super) fn stacked(values: &Values) -> DVector<f64> {
        let all = values.u.iter().chain(values.d.iter()).chain(values.v.iter());
        let length = values.u.len() + values.d.len() + values.v.len();
        DVector::from_iterator(length, all.copied())
    }

    fn unstacked(&self, all: &DVector<f64>) -> Values {
        let Values { u, d, v } = self.silence();
        Values {
            u: all.rows(0, u.len()).into_owned(),
            d: all.rows(u.len(), d.len()).into_owned(),
            v: all.rows(u.len() + d.len(), v.len()).into_owned(),
        }
    }
}

/// Checks the nine shapes of an observer against its plant.
pub(super) fn check(
    i: usize,
    observer: &LinearObserver,
    system: &DescriptorSystem,
) -> Result<(), SimulationError> {
    let (n, p, k) = (system.n_states(), system.n_outputs(), system.n_inputs());
    let o = observer.order();
    let q = if observer.n_estimated_inputs() == 0 { 0 } else { system.n_unknown_inputs() };
    let own = "N is square, and Q has a row for each unknown input, or none";
    let states = "P, V and W have a row for each state of the plant";
    let outputs = "L, V and R have a column for each output of the plant";
    let inputs = "H, W and S have a column for each known input of the plant";
    let needed = [
        ("N", &observer.N, (o, o), own),
        ("Q", &observer.Q, (q, o), own),
        ("L", &observer.L, (o, p), outputs),
        ("H", &observer.H, (o, k), inputs),
        ("P", &observer.P, (n, o), states),
        ("V", &observer.V, (n, p), if observer.V.ncols() == p { states } else { outputs }),
        ("W", &observer.W, (n, k), if observer.W.ncols() == k { states } else { inputs }),
        ("R", &observer.R, (q, p), if observer.R.ncols() == p { own } else { outputs }),
        ("S", &observer.S, (q, k), if observer.S.ncols() == k { own } else { inputs }),
    ];
    for (letter, matrix, needed, reason) in needed {
        let what = format!("{letter} of observer {}", i + 1);
        if matrix.shape() != needed {
            return Err(SimulationError::Shape { what, found: matrix.shape(), needed, reason });
        }
        if matrix.iter().any(|x| !x.is_finite()) {
            return Err(SimulationError::NotFinite { what });
        }
    }
    Ok(())
}

/// Checks that the nonlinearity can enter an observer as it says.
fn check_injection(
    i: usize,
    injection: &Injection,
    order: usize,
    plant: &Plant,
) -> Result<(), SimulationError> {
    let Some(nonlinear) = &plant.nonlinear else {
        return Err(SimulationError::NoNonlinearity { observer: i });
    };
    let (n, nf) = (plant.system().n_states(), nonlinear.term.n_components());
    let reason = "it has a column for each component of f, and a row for each state that f enters";
    for (name, matrix, needed) in
        [("state", &injection.state, (order, nf)), ("estimate", &injection.estimate, (n, nf))]
    {
        let what = format!("the injection into the {name} of observer {}", i + 1);
        if matrix.shape() != needed {
            return Err(SimulationError::Shape { what, found: matrix.shape(), needed, reason });
        }
        if matrix.iter().any(|x| !x.is_finite()) {
            return Err(SimulationError::NotFinite { what });
        }
    }
    Ok(())
}
