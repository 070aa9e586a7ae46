//! Proportional observer for descriptor systems (Darouach and Boutayeb 1995), with which paper 004 compares.
//!
//! It is the observer of paper 004 without the integral part: the unknown input is not estimated and disturbs the
//! estimate. Every algebraic equation becomes an output, so that only (9) and R-detectability are needed.
//!
//! | paper | program | meaning |
//! |---|---|---|
//! | E, A, B, C | `E`, `A`, `B`, `C` of [`DescriptorSystem`] | the system |
//! | F, L1, L2, J, M1, T1, T2 | [`super::NamedMatrix`] of the same name | `z' = F z + (L1 + L2) y + J u`, `x_hat = M1 z + T2 y` |

use nalgebra::DMatrix;

use super::proportional_integral::{compressed, finish, ordinary_conditions};
use super::{Condition, Design, DesignChoice, DesignError};
use crate::numerics::Tolerance;
use crate::system::DescriptorSystem;
use crate::system::properties::PropertyError;

/// The system as the proportional observer sees it: without its unknown inputs.
pub fn without_unknown_inputs(system: &DescriptorSystem) -> DescriptorSystem {
    DescriptorSystem {
        D: DMatrix::zeros(system.n_equations(), 0),
        F: DMatrix::zeros(system.n_outputs(), 0),
        ..system.clone()
    }
}

/// Existence conditions of the proportional observer.
///
/// # Errors
/// When a decomposition fails its check.
pub fn conditions(
    system: &DescriptorSystem,
    choice: &DesignChoice,
    tolerance: &Tolerance,
) -> Result<Vec<Condition>, PropertyError> {
    ordinary_conditions(&without_unknown_inputs(system), choice.order, tolerance)
}

/// Designs the proportional observer of the chosen order; `general` is the same as `full`.
///
/// # Errors
/// The first needed condition that fails, poles that do not fit, or a decomposition that fails its check.
///
/// # Source
/// Darouach and Boutayeb 1995; Koenig and Mammar 2002, (5) without the integral part.
pub fn design(
    system: &DescriptorSystem,
    choice: &DesignChoice,
    conditions: &[Condition],
    tolerance: &Tolerance,
) -> Result<Design, DesignError> {
    let system = without_unknown_inputs(system);
    let equivalent = compressed(&system, tolerance)?;
    finish("proportional observer", &system, &equivalent, choice, conditions, tolerance)
}
