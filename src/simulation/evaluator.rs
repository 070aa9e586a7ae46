//! Plant and observers at one instant: states, outputs, estimates and derivatives.

use nalgebra::{DMatrix, DVector, DVectorView};

use super::direct::Direct;
use super::joint::{Joint, Values};
use super::plant::{Frozen, Nonlinear};
use super::{Observed, SimulationError};

/// Why the equations have no value at an instant.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Trouble {
    /// A signal is not finite.
    Signal(SimulationError),
    /// The nonlinearity is not finite at a state.
    Nonlinearity { t: f64, x: Vec<f64> },
    /// No algebraic states were found.
    Algebraic { t: f64 },
    /// No estimate of an observer was found.
    Estimate { t: f64, observer: usize },
}

/// What an observer says at the instant.
#[derive(Clone, Debug)]
pub(super) struct Estimate {
    /// Estimated states.
    pub(super) x_hat: DVector<f64>,
    /// The nonlinearity at the estimate.
    pub(super) f: DVector<f64>,
    /// The estimate without the nonlinearity.
    pub(super) open: DVector<f64>,
    /// The last accepted `f`, from which an implicit equation is solved.
    pub(super) anchor: Option<DVector<f64>>,
    /// Whether `f` depends on what it adds to the estimate.
    pub(super) implicit: bool,
}

/// Evaluates plant and observers, with room for all that it computes on the way.
///
/// Implicit equations are solved by Newton's method from the last values that were accepted, so that a motion stays on
/// its branch; a change of the determinant's sign counts as no solution.
#[derive(Clone, Debug)]
pub(super) struct Evaluator<'a> {
    pub(super) joint: &'a Joint<'a>,
    pub(super) frozen: Frozen,
    frozen_at: f64,
    direct: Option<Direct>,
    /// Signals at the instant.
    pub(super) values: Values,
    /// When they were read: the last two stages of a step lie at the same instant.
    read_at: f64,
    /// States of the plant.
    pub(super) x: DVector<f64>,
    /// Outputs.
    pub(super) y: DVector<f64>,
    /// Derivative of the joint state (discrete: the next one).
    pub(super) derivative: DVector<f64>,
    pub(super) estimates: Vec<Estimate>,
    /// Why the last evaluation failed.
    pub(super) trouble: Option<Trouble>,
    pub(super) forcing: DVector<f64>,
    pub(super) f: DVector<f64>,
    pub(super) eta: DVector<f64>,
    pub(super) anchor: DVector<f64>,
    pub(super) sign: Option<f64>,
    pub(super) accepted_sign: Option<f64>,
    /// `[x; t]`
    pub(super) point: Vec<f64>,
}

impl<'a> Evaluator<'a> {
    /// Prepares evaluations from a given state of the plant, whose algebraic part chooses among several solutions.
    pub(super) fn new(joint: &'a Joint<'a>, x0: &[f64]) -> Self {
        let plant = joint.plant;
        let (n, p) = (plant.system().n_states(), plant.system().n_outputs());
        let nf = plant.nonlinear.as_ref().map_or(0, |nonlinear| nonlinear.term.n_components());
        let anchor = plant.algebraic_columns.tr_mul(&DVector::from_column_slice(x0));
        let estimates = joint.observers.iter().map(|observed| Estimate {
            x_hat: DVector::zeros(n),
            f: DVector::zeros(nf),
            open: DVector::zeros(n),
            anchor: None,
            implicit: joint.is_implicit(observed),
        });
        Self {
            joint,
            frozen: plant.freeze(0.0),
            frozen_at: 0.0,
            direct: Direct::new(joint),
            values: joint.silence(),
            read_at: f64::NAN,
            x: DVector::zeros(n),
            y: DVector::zeros(p),
            derivative: DVector::zeros(joint.order()),
            estimates: estimates.collect(),
            trouble: None,
            forcing: DVector::zeros(plant.system().n_equations()),
            f: DVector::zeros(nf),
            eta: anchor.clone(),
            anchor,
            sign: None,
            accepted_sign: None,
            point: vec![0.0; n + 1],
        }
    }

    /// Evaluates everything at an instant; false, with a reason in `trouble`, where there is no value.
    pub(super) fn evaluate(&mut self, t: f64, w: &[f64]) -> bool {
        if self.read_at != t {
            self.joint.read(t, &mut self.values);
            self.read_at = t;
        }
        let found = match Joint::silent(&self.values, t) {
            Some(signal) => Err(Trouble::Signal(signal)),
            None => self.evaluate_given(t, w),
        };
        match found {
            Ok(()) => true,
            Err(trouble) => {
                self.trouble = Some(trouble);
                false
            }
        }
    }

    /// As [`Self::evaluate`], with the signals that stand in `values`.
    pub(super) fn evaluate_given(&mut self, t: f64, w: &[f64]) -> Result<(), Trouble> {
        if let Some(mut direct) = self.direct.take() {
            let found = self.evaluate_directly(&mut direct, t, w);
            self.direct = Some(direct);
            return found;
        }
        let joint = self.joint;
        let (plant, system) = (joint.plant, joint.plant.system());
        if plant.varies() && self.frozen_at != t {
            (self.frozen, self.frozen_at) = (plant.freeze(t), t);
        }
        let w = DVectorView::from_slice(w, w.len());
        let r = plant.order();
        plant.forcing(&self.values.u, &self.values.d, &mut self.forcing);
        self.x.gemv(1.0, plant.differential_columns(), &w.rows(0, r), 0.0);
        self.algebraic(t)?;
        // y = C x + F d + v
        self.y.copy_from(&self.values.v);
        self.y.gemv(1.0, &system.C, &self.x, 1.0);
        self.y.gemv(1.0, &system.F, &self.values.d, 1.0);
        // xi' = S^-1 U1' (A x + forcing); the forcing contains G f
        self.forcing.gemv(1.0, self.frozen.a(), &self.x, 1.0);
        self.derivative.rows_mut(0, r).gemv(1.0, plant.differential_rows(), &self.forcing, 0.0);
        let mut top = r;
        for (i, Observed { observer, injection }) in joint.observers.iter().enumerate() {
            let order = observer.order();
            let z = w.rows(top, order);
            if injection.is_some() {
                self.estimate(t, i, &z)?;
            }
            let mut own = self.derivative.rows_mut(top, order);
            own.gemv(1.0, &observer.N, &z, 0.0);
            own.gemv(1.0, &observer.L, &self.y, 1.0);
            own.gemv(1.0, &observer.H, &self.values.u, 1.0);
            if let Some(injection) = injection {
                own.gemv(1.0, &injection.state, &self.estimates[i].f, 1.0);
            }
            top += order;
        }
        Ok(())
    }

    /// Completes `x` by its algebraic part, and the forcing by `G f(t, x)`.
    fn algebraic(&mut self, t: f64) -> Result<(), Trouble> {
        let Some(nonlinear) = &self.joint.plant.nonlinear else { return self.complete(t) };
        if nonlinear.implicit {
            self.solve_implicit(t, nonlinear)?;
            self.nonlinearity(t, nonlinear)
        } else if nonlinear.enters {
            // f uses no algebraic state
            self.nonlinearity(t, nonlinear)?;
            self.complete(t)
        } else {
            self.complete(t)?;
            self.nonlinearity(t, nonlinear)
        }
    }

    /// `eta = -A22^-1 U2' (A x + forcing)`, `x += V2 eta`.
    fn complete(&mut self, t: f64) -> Result<(), Trouble> {
        let plant = self.joint.plant;
        if plant.algebraic_rows.nrows() == 0 {
            return Ok(());
        }
        let mut all = self.forcing.clone();
        all.gemv(1.0, self.frozen.a(), &self.x, 1.0);
        self.eta.gemv(-1.0, &plant.algebraic_rows, &all, 0.0);
        if !self.frozen.solve(&mut self.eta) {
            return Err(Trouble::Algebraic { t });
        }
        self.x.gemv(1.0, &plant.algebraic_columns, &self.eta, 1.0);
        Ok(())
    }

    /// `f(t, x)`, and the forcing with `G f`.
    fn nonlinearity(&mut self, t: f64, nonlinear: &Nonlinear) -> Result<(), Trouble> {
        self.value(t, nonlinear)?;
        self.forcing.gemv(1.0, &nonlinear.term.G, &self.f, 1.0);
        Ok(())
    }

    /// `f(t, x)`.
    pub(super) fn value(&mut self, t: f64, nonlinear: &Nonlinear) -> Result<(), Trouble> {
        place(&mut self.point, &self.x, t);
        nonlinear.term.value_into(&self.point, self.f.as_mut_slice());
        if self.f.iter().any(|f| !f.is_finite()) {
            return Err(Trouble::Nonlinearity { t, x: self.x.iter().copied().collect() });
        }
        Ok(())
    }

    /// `A22 + U2' G df/dx V2` at the last evaluation.
    pub(super) fn algebraic_block(&mut self, t: f64) -> DMatrix<f64> {
        let plant = self.joint.plant;
        let slopes = self.slopes(t, None);
        let all = plant.nonlinear.as_ref().map(|nonlinear| &nonlinear.weights * slopes);
        let mut block = &plant.algebraic_rows * self.frozen.a();
        if let Some(all) = all {
            block += all;
        }
        block * &plant.algebraic_columns
    }

    /// `df/dx` at the state, or at the estimate of an observer; nf x n.
    pub(super) fn slopes(&mut self, t: f64, observer: Option<usize>) -> DMatrix<f64> {
        let x = observer.map_or(&self.x, |i| &self.estimates[i].x_hat);
        let mut slopes = DMatrix::zeros(self.f.len(), x.len());
        if let Some(nonlinear) = &self.joint.plant.nonlinear {
            place(&mut self.point, x, t);
            nonlinear.term.jacobian_into(&self.point, &mut vec![0.0; x.len()], &mut slopes);
        }
        slopes
    }

    /// `A(t)` of the last evaluation.
    pub(super) fn a(&self) -> &DMatrix<f64> {
        self.frozen.a()
    }

    /// `x_hat = P z + V y + W u + M f(t, x_hat)` for an observer, solved for `f`.
    fn estimate(&mut self, t: f64, i: usize, z: &DVectorView<'_, f64>) -> Result<(), Trouble> {
        let Observed { observer, .. } = self.joint.observers[i];
        let open = &mut self.estimates[i].open;
        open.gemv(1.0, &observer.P, z, 0.0);
        open.gemv(1.0, &observer.V, &self.y, 1.0);
        open.gemv(1.0, &observer.W, &self.values.u, 1.0);
        self.solve_estimate(t, i)
    }

    /// Computes the estimates that the last evaluation did not need.
    pub(super) fn complete_estimates(&mut self, t: f64, w: &[f64]) {
        let mut top = self.joint.plant.order();
        for i in 0..self.estimates.len() {
            let Observed { observer, injection } = self.joint.observers[i];
            let order = observer.order();
            if injection.is_none() && self.direct.is_none() {
                let z = DVectorView::from_slice(&w[top..top + order], order);
                // without injection there is nothing to solve
                let plain = self.estimate(t, i, &z);
                debug_assert!(plain.is_ok(), "a linear estimate has a value");
            }
            top += order;
        }
    }

    /// The last evaluation belongs to the motion: implicit equations are solved from here on.
    pub(super) fn accept(&mut self) {
        self.anchor.copy_from(&self.eta);
        self.accepted_sign = self.sign;
        for estimate in &mut self.estimates {
            if estimate.implicit {
                estimate.anchor = Some(estimate.f.clone());
            }
        }
        self.trouble = None;
    }

    /// Whether an equation is solved by iteration.
    pub(super) fn iterates(&self) -> bool {
        self.joint.plant.is_implicit() || self.estimates.iter().any(|estimate| estimate.implicit)
    }
}

/// `[x; t]`.
pub(super) fn place(point: &mut [f64], x: &DVector<f64>, t: f64) {
    if let Some((last, states)) = point.split_last_mut() {
        states.copy_from_slice(x.as_slice());
        *last = t;
    }
}
