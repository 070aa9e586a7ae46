//! The runnable form that all linear observers share.
#![expect(non_snake_case, reason = "matrix letters of the common observer form")]

use nalgebra::DMatrix;
use serde::{Deserialize, Serialize};

/// A linear observer in the form that every design of this crate is converted to.
///
/// ```text
///    z'  = N z + L y + H u         (discrete: z[k+1] = ...)
/// x_hat  = P z + V y + W u
/// d_hat  = Q z + R y + S u
/// ```
///
/// `y` is the measured output of the descriptor system and `u` its known input.
///
/// # Shapes
/// order o, n states, q estimated unknown inputs (none for a proportional observer), p outputs, k known inputs:
/// `N`: o x o; `L`: o x p; `H`: o x k; `P`: n x o; `V`: n x p; `W`: n x k; `Q`: q x o; `R`: q x p; `S`: q x k.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct LinearObserver {
    /// State matrix, o x o.
    pub N: DMatrix<f64>,
    /// Output injection, o x p.
    pub L: DMatrix<f64>,
    /// Known input, o x k.
    pub H: DMatrix<f64>,
    /// Observer state to state estimate, n x o.
    pub P: DMatrix<f64>,
    /// Output to state estimate, n x p.
    pub V: DMatrix<f64>,
    /// Known input to state estimate, n x k.
    pub W: DMatrix<f64>,
    /// Observer state to unknown-input estimate, q x o.
    pub Q: DMatrix<f64>,
    /// Output to unknown-input estimate, q x p.
    pub R: DMatrix<f64>,
    /// Known input to unknown-input estimate, q x k.
    pub S: DMatrix<f64>,
}

impl LinearObserver {
    /// Order o: the number of its own states.
    pub fn order(&self) -> usize {
        self.N.nrows()
    }

    /// Number of unknown inputs that it estimates.
    pub fn n_estimated_inputs(&self) -> usize {
        self.Q.nrows()
    }
}

/// How a plant's nonlinearity `G f(x)` enters an observer, at the estimate instead of the state.
///
/// ```text
///    z'  = N z + L y + H u + state * f(x_hat)
/// x_hat  = P z + V y + W u + estimate * f(x_hat)          an implicit equation when `F_L estimate` is not zero
/// ```
///
/// # Shapes
/// `state`: o x nf; `estimate`: n x nf.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Injection {
    /// Into the observer's state: `T G`.
    pub state: DMatrix<f64>,
    /// Into the estimate: `-Q Phi G`.
    pub estimate: DMatrix<f64>,
}
