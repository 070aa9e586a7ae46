//! Everything that is known of a plant: its matrices, its nonlinearity, its subsystems.

use super::{DescriptorSystem, LipschitzTerm, Network, Subsystem};

/// A descriptor system with what some methods need besides its matrices.
///
/// ```text
/// E x' = A x + B u + G f(x) + D d,   y = C x + F d
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Model {
    /// The matrices.
    pub system: DescriptorSystem,
    /// The nonlinearity `G f(x)`, if there is one.
    pub lipschitz: Option<LipschitzTerm>,
    /// The subsystems; empty when the system is not partitioned.
    pub partition: Vec<Subsystem>,
    /// The network whose matrices these are, when the plant is given as one.
    pub network: Option<Network>,
}

impl From<DescriptorSystem> for Model {
    fn from(system: DescriptorSystem) -> Self {
        Self { system, lipschitz: None, partition: Vec::new(), network: None }
    }
}

impl From<Network> for Model {
    /// Expands the network: for small ones only.
    fn from(network: Network) -> Self {
        Self { network: Some(network.clone()), ..Self::from(network.expanded()) }
    }
}
