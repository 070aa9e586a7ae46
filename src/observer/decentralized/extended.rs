//! The extended parameterisation, which leaves `T_bar` free where the paper pins it to a least-squares solution.
#![expect(non_snake_case, reason = "matrix letters follow paper 000")]

use nalgebra::DMatrix;

use super::decoupled::{Decoupled, left_null};
use super::parameterisation::{Parameterisation, Recipe};
use crate::numerics::{NumericsError, Tolerance, stack};

/// All solutions of (23) with the paper's `K_Phi`, and all observers that belong to them.
///
/// ```text
/// [N_E N_H] [E_bar; H] = 0,   T_bar = T_0 - S N_E,   K_H = K_H0 - S N_H
/// [N Psi J] = T_bar A_bar Omega+ - Y L - N S [0 0 N_H]
/// [P Q F]   =             Omega+ - Z L - P S [0 0 N_H]
/// ```
///
/// with `T_0`, `Omega` and `L` of the paper, which is the case `S = 0`. They solve (22) since
/// `T_bar E_bar = T_0 E_bar + S N_H H`. The inequality stays linear, in `X`, `X [S Y]` and `Z`, so that its gamma is
/// never above the paper's; reduced and minimal orders exist here whose fixed modes the paper's choice makes unstable.
///
/// # Errors
/// When a decomposition fails its check.
///
/// # Source
/// Extension of paper 000, (23)-(27).
pub fn extended(
    decoupled: &Decoupled,
    R: &DMatrix<f64>,
    tolerance: &Tolerance,
) -> Result<Parameterisation, NumericsError> {
    let Decoupled { E_bar, H, .. } = decoupled;
    let annihilators = left_null(&stack(&[E_bar, H]), tolerance)?;
    let recipe = Recipe {
        N_E: annihilators.columns(0, E_bar.nrows()).into_owned(),
        N_H: annihilators.columns(E_bar.nrows(), H.nrows()).into_owned(),
        ..Recipe::paper(decoupled, R, tolerance)?
    };
    Parameterisation::assemble(decoupled, R, recipe, tolerance)
}
