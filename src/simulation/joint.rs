//! Plant and observers as one set of linear equations.

use nalgebra::{DMatrix, DVector};

use super::plant::Frozen;
use super::{Plant, SimulationError};
use crate::numerics::integrate::Signals;
use crate::observer::LinearObserver;

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
/// w = [xi; z_1; z_2; ...],   y = C x + F d + v,   z_i' = N_i z_i + L_i y + H_i u
/// ```
#[derive(Clone, Debug)]
pub(super) struct Joint<'a> {
    pub(super) plant: &'a Plant,
    pub(super) observers: Vec<&'a LinearObserver>,
    pub(super) inputs: Inputs<'a>,
}

/// The whole system at one instant.
#[derive(Clone, Debug)]
pub(super) struct Evaluation {
    pub(super) x: DVector<f64>,
    pub(super) y: DVector<f64>,
    pub(super) derivative: DVector<f64>,
}

impl<'a> Joint<'a> {
    /// Joins a plant and observers after checking that their shapes fit.
    pub(super) fn new(
        plant: &'a Plant,
        observers: &[&'a LinearObserver],
        inputs: Inputs<'a>,
    ) -> Result<Self, SimulationError> {
        for (i, observer) in observers.iter().enumerate() {
            check(i, observer, plant)?;
        }
        Ok(Self { plant, observers: observers.to_vec(), inputs })
    }

    /// Number of states of plant and observers together.
    pub(super) fn order(&self) -> usize {
        self.plant.order() + self.observers.iter().map(|o| o.order()).sum::<usize>()
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

    /// All signals at time `t`, finite or not.
    pub(super) fn values(&self, t: f64) -> Values {
        let mut values = self.silence();
        self.inputs.known.value(t, values.u.as_mut_slice());
        self.inputs.unknown.value(t, values.d.as_mut_slice());
        self.inputs.noise.value(t, values.v.as_mut_slice());
        values
    }

    /// All signals at time `t`.
    pub(super) fn finite_values(&self, t: f64) -> Result<Values, SimulationError> {
        let values = self.values(t);
        for (signal, vector) in
            [("known input", &values.u), ("unknown input", &values.d), ("measurement noise", &values.v)]
        {
            if let Some(index) = vector.iter().position(|x| !x.is_finite()) {
                return Err(SimulationError::Signal { signal, index, time: t });
            }
        }
        Ok(values)
    }

    /// States, outputs and derivatives (discrete: next states) at one instant.
    pub(super) fn evaluate(&self, at: &Frozen, w: &DVector<f64>, values: &Values) -> Evaluation {
        let r = self.plant.order();
        let system = self.plant.system();
        let forcing = self.plant.forcing(&values.u, &values.d);
        let x = self.plant.state(at, &w.rows(0, r).into_owned(), &forcing);
        let y = &system.C * &x + &system.F * &values.d + &values.v;
        let mut derivative = DVector::zeros(w.len());
        derivative.rows_mut(0, r).copy_from(&self.plant.derivative(at, &x, &forcing));
        let mut top = r;
        for observer in &self.observers {
            let order = observer.order();
            let own = &observer.N * w.rows(top, order) + &observer.L * &y + &observer.H * &values.u;
            derivative.rows_mut(top, order).copy_from(&own);
            top += order;
        }
        Evaluation { x, y, derivative }
    }

    /// Constant coefficients `w' = M w + G [u; d; v]`, column by column from [`Self::evaluate`].
    pub(super) fn coefficients(&self) -> (DMatrix<f64>, DMatrix<f64>) {
        let at = self.plant.freeze(0.0);
        let (order, silence) = (self.order(), self.silence());
        let rest = DVector::zeros(order);
        let mut m = DMatrix::zeros(order, order);
        for j in 0..order {
            let mut unit = rest.clone();
            unit[j] = 1.0;
            m.set_column(j, &self.evaluate(&at, &unit, &silence).derivative);
        }
        let mut g = DMatrix::zeros(order, self.n_signals());
        for j in 0..self.n_signals() {
            let mut unit = DVector::zeros(self.n_signals());
            unit[j] = 1.0;
            g.set_column(j, &self.evaluate(&at, &rest, &self.unstacked(&unit)).derivative);
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
fn check(i: usize, observer: &LinearObserver, plant: &Plant) -> Result<(), SimulationError> {
    let system = plant.system();
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
