//! What a simulation found: signals, states and estimates over time.

use nalgebra::DMatrix;
use serde::{Deserialize, Serialize};

use super::InitialState;

/// How the equations were integrated.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Method {
    /// Matrix exponential: constant coefficients.
    Exponential,
    /// Explicit one-step method of order 5: coefficients that vary in time, a nonlinearity, many kinks.
    Explicit,
    /// Linearly implicit one-step method of order 5, which has taken over because of stiffness.
    Implicit,
    /// The difference equation itself.
    Recursion,
}

/// Plant and observers on one grid of instants; every matrix has a column for each instant.
///
/// At an instant where an input jumps, the column shows the values just after it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Trajectory {
    /// Instants, in seconds; in discrete time 0, 1, 2, ...
    pub t: Vec<f64>,
    /// Known inputs, k rows.
    pub u: DMatrix<f64>,
    /// Unknown inputs, q rows.
    pub d: DMatrix<f64>,
    /// Measured outputs with their noise, p rows.
    pub y: DMatrix<f64>,
    /// States of the plant, n rows.
    pub x: DMatrix<f64>,
    /// One for each observer, in the order in which they were given.
    pub observers: Vec<ObserverTrajectory>,
    /// What became of the given initial state.
    pub initial_state: InitialState,
    /// Smallest singular value of `A22(t)` (nonlinear: of `A22 + U2' G df/dx V2`) over the horizon; infinite for a plant
    /// without algebraic equations.
    pub smallest_a22: f64,
    /// How the equations were integrated.
    pub method: Method,
    /// Number of steps of the integrator.
    pub steps: usize,
    /// Why the trajectory ends early, if it does.
    pub note: Option<String>,
    /// What a person should know about the equations: output equations that do not contract, a Lipschitz constant that
    /// is exceeded.
    pub remarks: Vec<String>,
}

/// One observer beside the plant.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ObserverTrajectory {
    /// Own states, o rows.
    pub z: DMatrix<f64>,
    /// Estimated states, n rows.
    pub x_hat: DMatrix<f64>,
    /// Estimated unknown inputs, q rows, or none for an observer that does not estimate them.
    pub d_hat: DMatrix<f64>,
    /// Estimation error `x - x_hat`, n rows.
    pub e: DMatrix<f64>,
    /// Error of the unknown input `d - d_hat`, as many rows as `d_hat`.
    pub e_d: DMatrix<f64>,
    /// For an estimate that depends on itself through the nonlinearity: the largest factor by which its equation
    /// stretches a difference; below 1 there is one estimate only.
    pub contraction: Option<f64>,
}

impl Trajectory {
    /// Root mean square of each row of an error from `from_t` on; see [`rms`].
    pub fn rms(&self, e: &DMatrix<f64>, from_t: f64) -> Vec<f64> {
        rms(&self.t, e, from_t)
    }
}

/// Root mean square of each row of `e` over the instants `t >= from_t`; zero when there are none.
///
/// # Examples
/// ```
/// use descry::simulation::rms;
/// let e = nalgebra::dmatrix![9.0, 3.0, -3.0; 9.0, 0.0, 0.0];
/// assert_eq!(rms(&[0.0, 1.0, 2.0], &e, 0.5), [3.0, 0.0]);
/// ```
pub fn rms(t: &[f64], e: &DMatrix<f64>, from_t: f64) -> Vec<f64> {
    let from = t.partition_point(|t| *t < from_t).min(e.ncols());
    let tail = e.columns(from, e.ncols() - from);
    let count = tail.ncols().max(1) as f64;
    tail.row_iter().map(|row| (row.norm_squared() / count).sqrt()).collect()
}
