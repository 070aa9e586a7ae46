//! The output equation of the observer, which is implicit where the nonlinearity acts on algebraic equations.

use nalgebra::DMatrix;

use super::plant::Plant;
use crate::numerics::{NumericsError, svd};

/// Factor by which a step of `x_hat <- P z + F y - Q Phi B u - Q Phi G f(x_hat)` shrinks a difference in `F_L x_hat`.
///
/// ```text
/// contraction = lambda |F_L Q Phi G|
/// ```
///
/// Below 1 the equation has exactly one solution, which the iteration finds. The matrix inequality implies it: insert
/// `e = -Q Phi G df` in its blocks 2 and 3. `None` where nothing is implicit: no nonlinearity, or `F_L Q Phi G = 0`.
///
/// # Errors
/// When a decomposition fails its check.
pub fn contraction(plant: &Plant, q_phi_g: &DMatrix<f64>) -> Result<Option<f64>, NumericsError> {
    let loop_gain = &plant.F_L * q_phi_g;
    if loop_gain.iter().all(|x| *x == 0.0) {
        return Ok(None);
    }
    Ok(svd(&loop_gain)?.s.first().map(|largest| plant.lambda * largest))
}
