//! Collects a trajectory sample by sample.

use nalgebra::{DMatrix, DVector};

use super::joint::{Evaluation, Joint, Values};
use super::plant::Frozen;
use super::run::LARGEST_STATE;
use super::{InitialState, Method, ObserverTrajectory, SimulationError, Trajectory};

/// A matrix that grows by columns.
#[derive(Debug)]
struct Columns {
    rows: usize,
    data: Vec<f64>,
}

impl Columns {
    fn new(rows: usize) -> Self {
        Self { rows, data: Vec::new() }
    }

    fn push(&mut self, column: &DVector<f64>) {
        self.data.extend(column.iter());
    }

    fn matrix(self, columns: usize) -> DMatrix<f64> {
        DMatrix::from_vec(self.rows, columns, self.data)
    }
}

/// The growing columns of one observer.
#[derive(Debug)]
struct ObserverColumns {
    z: Columns,
    x_hat: Columns,
    d_hat: Columns,
}

/// The trajectory so far.
#[derive(Debug)]
pub(super) struct Record<'a> {
    joint: &'a Joint<'a>,
    t: Vec<f64>,
    u: Columns,
    d: Columns,
    y: Columns,
    x: Columns,
    observers: Vec<ObserverColumns>,
    /// Why the record was closed early.
    pub(super) note: Option<String>,
    /// What went wrong while a sample was taken.
    pub(super) error: Option<SimulationError>,
}

impl<'a> Record<'a> {
    pub(super) fn new(joint: &'a Joint<'a>) -> Self {
        let system = joint.plant.system();
        let observers = joint.observers.iter().map(|o| ObserverColumns {
            z: Columns::new(o.order()),
            x_hat: Columns::new(system.n_states()),
            d_hat: Columns::new(o.n_estimated_inputs()),
        });
        Self {
            joint,
            t: Vec::new(),
            u: Columns::new(system.n_inputs()),
            d: Columns::new(system.n_unknown_inputs()),
            y: Columns::new(system.n_outputs()),
            x: Columns::new(system.n_states()),
            observers: observers.collect(),
            note: None,
            error: None,
        }
    }

    /// Takes a sample for time `t`, evaluating signals at `inside`; false when the record ends here.
    pub(super) fn sample(&mut self, (t, inside): (f64, f64), at: &Frozen, w: &DVector<f64>) -> bool {
        match self.joint.finite_values(inside) {
            Ok(values) => {
                let evaluation = self.joint.evaluate(at, w, &values);
                self.push(t, w, &values, &evaluation)
            }
            Err(error) => {
                self.error = Some(error);
                false
            }
        }
    }

    /// Appends what was evaluated at time `t`; false when it is too large, and the record ends before it.
    pub(super) fn push(&mut self, t: f64, w: &DVector<f64>, values: &Values, found: &Evaluation) -> bool {
        let mut estimates = Vec::with_capacity(self.observers.len());
        let mut top = self.joint.plant.order();
        for o in &self.joint.observers {
            let z = w.rows(top, o.order()).into_owned();
            let x_hat = &o.P * &z + &o.V * &found.y + &o.W * &values.u;
            let d_hat = &o.Q * &z + &o.R * &found.y + &o.S * &values.u;
            top += o.order();
            estimates.push((z, x_hat, d_hat));
        }
        if !within(&found.x) || !within(&found.y) {
            self.close(t, "a state of the plant");
            return false;
        }
        if let Some(i) = estimates.iter().position(|(z, x, d)| !(within(z) && within(x) && within(d))) {
            self.close(t, &format!("a state of observer {}", i + 1));
            return false;
        }
        self.t.push(t);
        self.u.push(&values.u);
        self.d.push(&values.d);
        self.y.push(&found.y);
        self.x.push(&found.x);
        for (columns, (z, x_hat, d_hat)) in self.observers.iter_mut().zip(&estimates) {
            columns.z.push(z);
            columns.x_hat.push(x_hat);
            columns.d_hat.push(d_hat);
        }
        true
    }

    /// Ends the record before time `t`.
    pub(super) fn close(&mut self, t: f64, what: &str) {
        self.note = Some(format!(
            "stopped before t = {t:?}: {what} exceeds {LARGEST_STATE:e}; plant or observer seems unstable"
        ));
    }

    /// The finished trajectory.
    pub(super) fn finish(
        self,
        initial_state: InitialState,
        smallest_a22: f64,
        work: (Method, usize),
    ) -> Trajectory {
        let samples = self.t.len();
        let (d, x) = (self.d.matrix(samples), self.x.matrix(samples));
        let observer = |columns: ObserverColumns| {
            let x_hat = columns.x_hat.matrix(samples);
            let d_hat = columns.d_hat.matrix(samples);
            let e_d = if d_hat.nrows() == d.nrows() { &d - &d_hat } else { d_hat.clone() };
            ObserverTrajectory { z: columns.z.matrix(samples), e: &x - &x_hat, x_hat, d_hat, e_d }
        };
        let observers = self.observers.into_iter().map(observer).collect();
        Trajectory {
            t: self.t,
            u: self.u.matrix(samples),
            y: self.y.matrix(samples),
            observers,
            d,
            x,
            initial_state,
            smallest_a22,
            method: work.0,
            steps: work.1,
            note: self.note,
        }
    }
}

fn within(vector: &DVector<f64>) -> bool {
    vector.iter().all(|x| x.abs() <= LARGEST_STATE)
}
