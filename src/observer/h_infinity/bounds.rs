//! Lower bounds of the attenuation without any inequality: H-infinity norms with the nonlinearity frozen.
#![expect(non_snake_case, reason = "matrix letters follow paper 002")]

use nalgebra::DMatrix;

use super::parameterisation::Matrices;
use super::plant::Plant;
use crate::numerics::{
    HInfinityError, HInfinityNorm, NumericsError, StabilityRegion, Tolerance, h_infinity_norm,
};

/// The error system of a finished observer.
///
/// ```text
/// eps' = N eps + T G df + phi1 d,   e = P eps - Q Phi G df + phi2 d,   |df| <= lambda |F_L e|
/// phi1 = J F - T D,                 phi2 = Q Phi D + V F
/// ```
///
/// # Source
/// Paper 002, (10), (11).
#[derive(Clone, Debug, PartialEq)]
pub struct ErrorSystem {
    /// State matrix.
    pub N: DMatrix<f64>,
    /// Nonlinearity into the state.
    pub TG: DMatrix<f64>,
    /// Disturbance into the state.
    pub phi1: DMatrix<f64>,
    /// State to error.
    pub P: DMatrix<f64>,
    /// Nonlinearity out of the error.
    pub Q_Phi_G: DMatrix<f64>,
    /// Disturbance into the error.
    pub phi2: DMatrix<f64>,
}

impl ErrorSystem {
    /// The error system from the matrices of the observer and the plant alone.
    pub fn new(plant: &Plant, observer: &Matrices) -> Self {
        let Matrices { N, J, T, P, Q, V, .. } = observer;
        let (D, F) = (&plant.system.D, &plant.system.F);
        let Q_Phi = Q * &plant.Phi;
        Self {
            N: N.clone(),
            TG: T * plant.acting(),
            phi1: J * F - T * D,
            P: P.clone(),
            Q_Phi_G: &Q_Phi * plant.acting(),
            phi2: Q_Phi * D + V * F,
        }
    }

    /// Norm from `d` to the error when `df = S F_L e`; `None` when the output equation has no solution for this `S`.
    ///
    /// ```text
    /// F_L e = (I + F_L Q Phi G S)^-1 F_L (P eps + phi2 d)
    /// ```
    ///
    /// # Errors
    /// [`HInfinityError::Unstable`] when the frozen error does not decay.
    pub fn frozen(
        &self,
        F_L: &DMatrix<f64>,
        S: &DMatrix<f64>,
        tolerance: &Tolerance,
    ) -> Result<Option<HInfinityNorm>, HInfinityError> {
        let unit = DMatrix::identity(F_L.nrows(), F_L.nrows());
        let Some(inverse) = (unit + F_L * &self.Q_Phi_G * S).try_inverse() else { return Ok(None) };
        let feedback = S * inverse * F_L;
        let (of_state, of_disturbance) = (&feedback * &self.P, feedback * &self.phi2);
        let found = h_infinity_norm(
            &(&self.N + &self.TG * &of_state),
            &(&self.phi1 + &self.TG * &of_disturbance),
            &(&self.P - &self.Q_Phi_G * &of_state),
            &(&self.phi2 - &self.Q_Phi_G * &of_disturbance),
            StabilityRegion::LeftHalfPlane,
            tolerance,
        )?;
        Ok(Some(found))
    }

    /// Norm from `d` to the error of the linear part.
    ///
    /// # Errors
    /// [`HInfinityError::Unstable`] when `N` is not stable.
    pub fn linear(&self, tolerance: &Tolerance) -> Result<HInfinityNorm, HInfinityError> {
        let Self { N, phi1, P, phi2, .. } = self;
        h_infinity_norm(N, phi1, P, phi2, StabilityRegion::LeftHalfPlane, tolerance)
    }
}

/// Most slopes that are tried.
const MOST_SLOPES: usize = 64;

/// Norms with the nonlinearity frozen at slopes of the largest size, each with its name: what no guarantee for all
/// nonlinearities of this Lipschitz constant can be below.
///
/// `S = +-lambda` for one component that depends on one combination of states. Otherwise `+-lambda` at each single entry
/// of `S` and along its diagonal, which all have norm lambda. An error that does not decay counts as infinite.
///
/// # Errors
/// When a decomposition fails its check.
pub fn frozen_slopes(
    plant: &Plant,
    system: &ErrorSystem,
    tolerance: &Tolerance,
) -> Result<Vec<(String, f64)>, NumericsError> {
    let (nf, l) = (system.TG.ncols(), plant.F_L.nrows());
    let mut shapes: Vec<(String, DMatrix<f64>)> = Vec::new();
    if nf > 0 && nf.min(l) > 1 {
        shapes.push((" along the diagonal".to_owned(), DMatrix::identity(nf, l)));
    }
    for (i, j) in (0..nf).flat_map(|i| (0..l).map(move |j| (i, j))) {
        let mut one = DMatrix::zeros(nf, l);
        one[(i, j)] = 1.0;
        let name =
            if nf * l == 1 { String::new() } else { format!(" of f{} along F_L x, row {}", i + 1, j + 1) };
        shapes.push((name, one));
    }
    let mut result = Vec::new();
    for (name, shape) in shapes.into_iter().take(MOST_SLOPES / 2) {
        for sign in [1.0, -1.0] {
            let slope = sign * plant.lambda;
            let norm = match system.frozen(&plant.F_L, &(&shape * slope), tolerance) {
                Ok(Some(found)) => found.norm,
                Ok(None) => continue,
                Err(HInfinityError::Unstable { .. }) => f64::INFINITY,
                Err(HInfinityError::Numerics(error)) => return Err(error),
            };
            result.push((format!("frozen slope {slope:+}{name}"), norm));
        }
    }
    Ok(result)
}
