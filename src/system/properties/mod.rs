//! Properties of a descriptor system, each with the evidence that decides it.

mod modes;
mod ranks;
mod structure;

pub use modes::{ModeCondition, ModeCriterion, UnobservableMode, r_detectability, r_observability};
pub use ranks::{ImpulseObservability, RankCondition, impulse_observability, rank_e, rank_e_c};
pub use structure::{DescriptorIndex, FiniteSpectrum, Regularity, finite_eigenvalues, index, regularity};

use super::{DescriptorSystem, SystemError};
use crate::numerics::NumericsError;

/// A property that could not be decided.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum PropertyError {
    /// The matrices do not fit together.
    #[error(transparent)]
    System(#[from] SystemError),
    /// A computation failed.
    #[error(transparent)]
    Numerics(#[from] NumericsError),
}

/// Refuses systems whose matrices do not fit: the fields are public, so nothing else guarantees it.
fn check(system: &DescriptorSystem) -> Result<(), PropertyError> {
    system.clone().checked()?;
    Ok(())
}

/// A small system for the tests of this module: `E x' = A x, y = C x`.
#[cfg(test)]
fn autonomous(
    e: nalgebra::DMatrix<f64>,
    a: nalgebra::DMatrix<f64>,
    c: nalgebra::DMatrix<f64>,
) -> DescriptorSystem {
    DescriptorSystem::autonomous(e, a, c).unwrap()
}
