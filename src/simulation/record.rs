//! Collects a trajectory sample by sample.

use nalgebra::{DMatrix, DVector};

use super::evaluator::Evaluator;
use super::joint::Joint;
use super::motion::Work;
use super::run::LARGEST_STATE;
use super::{InitialState, ObserverTrajectory, SimulationError, Trajectory};

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
    /// Largest factor of its output equation, and when it occurred.
    contraction: Option<(f64, f64)>,
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
            z: Columns::new(o.observer.order()),
            x_hat: Columns::new(system.n_states()),
            d_hat: Columns::new(o.observer.n_estimated_inputs()),
            contraction: None,
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

    /// Appends what was evaluated last, for time `t`; false when it is too large, and the record ends before it.
    pub(super) fn push(&mut self, t: f64, w: &[f64], evaluator: &mut Evaluator<'_>) -> bool {
        evaluator.complete_estimates(t, w);
        let values = evaluator.values.clone();
        if let Some(signal) = Joint::too_large(&values) {
            self.close_by_signal(t, &signal);
            return false;
        }
        if !within(&evaluator.x) || !within(&evaluator.y) {
            self.close(t, "a state of the plant");
            return false;
        }
        let mut unknown = Vec::with_capacity(self.observers.len());
        let mut top = self.joint.plant.order();
        for (i, (observed, own)) in self.joint.observers.iter().zip(&evaluator.estimates).enumerate() {
            let o = observed.observer;
            let z = DVector::from_column_slice(&w[top..top + o.order()]);
            top += o.order();
            let d_hat = &o.Q * &z + &o.R * &evaluator.y + &o.S * &values.u;
            if !(within(&z) && within(&own.x_hat) && within(&d_hat)) {
                self.close(t, &format!("a state of observer {}", i + 1));
                return false;
            }
            unknown.push((z, d_hat));
        }
        self.t.push(t);
        self.u.push(&values.u);
        self.d.push(&values.d);
        self.y.push(&evaluator.y);
        self.x.push(&evaluator.x);
        for (i, (columns, (z, d_hat))) in self.observers.iter_mut().zip(&unknown).enumerate() {
            columns.z.push(z);
            columns.x_hat.push(&evaluator.estimates[i].x_hat);
            columns.d_hat.push(d_hat);
            if let Some(factor) = evaluator.contraction(t, i)
                && columns.contraction.is_none_or(|(largest, _)| factor > largest)
            {
                columns.contraction = Some((factor, t));
            }
        }
        true
    }

    /// Ends the record before time `t`.
    fn close(&mut self, t: f64, what: &str) {
        self.note = Some(format!(
            "stopped before t = {t:?}: {what} exceeds {LARGEST_STATE:e}; plant or observer seems unstable"
        ));
    }

    fn close_by_signal(&mut self, t: f64, signal: &str) {
        self.note = Some(format!(
            "stopped before t = {t:?}: {signal} exceeds {LARGEST_STATE:e}; choose a signal that stays smaller"
        ));
    }

    /// Ends the record before time `t` because a state became too large, by itself or by an input.
    pub(super) fn overflow(&mut self, t: f64) {
        match self.joint.finite_values(t).map(|values| Joint::too_large(&values)) {
            Ok(None) => self.close(t, "a state"),
            Ok(Some(signal)) => self.close_by_signal(t, &signal),
            Err(error) => self.error = Some(error),
        }
    }

    /// Ends the record by an error; by a note where what was found so far is worth showing.
    pub(super) fn stop(&mut self, error: SimulationError) {
        let only_ends =
            matches!(error, SimulationError::NoEstimate { .. } | SimulationError::Nonlinearity { .. });
        if only_ends && !self.t.is_empty() {
            self.note = Some(format!("the trajectory ends early: {error}"));
        } else {
            self.error = Some(error);
        }
    }

    /// The finished trajectory.
    pub(super) fn finish(self, initial_state: InitialState, work: &Work) -> Trajectory {
        let remarks = self.remarks();
        let samples = self.t.len();
        let (d, x) = (self.d.matrix(samples), self.x.matrix(samples));
        let observer = |columns: ObserverColumns| {
            let x_hat = columns.x_hat.matrix(samples);
            let d_hat = columns.d_hat.matrix(samples);
            let e_d = if d_hat.nrows() == d.nrows() { &d - &d_hat } else { d_hat.clone() };
            ObserverTrajectory {
                z: columns.z.matrix(samples),
                e: &x - &x_hat,
                x_hat,
                d_hat,
                e_d,
                contraction: columns.contraction.map(|(factor, _)| factor),
            }
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
            smallest_a22: work.smallest,
            method: work.method,
            steps: work.steps,
            note: self.note,
            remarks,
        }
    }

    /// Output equations that do not contract, in words.
    fn remarks(&self) -> Vec<String> {
        let worst = self.observers.iter().enumerate().filter_map(|(i, o)| o.contraction.map(|c| (i, c)));
        let worst = worst.filter(|(_, (factor, _))| *factor >= 1.0);
        let remark = |(i, (factor, t)): (usize, (f64, f64))| {
            format!(
                "the output equation of observer {} does not contract: its slope reaches {factor:.4} at t = {t:.4}, \
                 below 1 is needed for one estimate only; Newton's method follows one",
                i + 1
            )
        };
        worst.map(remark).collect()
    }
}

fn within(vector: &DVector<f64>) -> bool {
    vector.iter().all(|x| x.abs() <= LARGEST_STATE)
}
