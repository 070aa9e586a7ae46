//! Choices on networks that are too large to be written as one system.

use super::hierarchical::{Hierarchy, HierarchyError, LARGEST_COMPOSITE};
use super::{Assessment, DesignChoice, DesignError, Method, hierarchical};
use crate::numerics::Tolerance;
use crate::system::Network;
use crate::system::properties::PropertyError;

impl Method {
    /// Why the method cannot be tried on a network that is never expanded; `None` for the hierarchical observer.
    pub fn missing_for(self, network: &Network) -> Option<String> {
        let states = network.a.nrows() * network.n_subsystems();
        (self != Self::Hierarchical).then(|| {
            format!(
                "this method needs the plant as one system, and the network has {} * {} = {states} states; at most \
                 {LARGEST_COMPOSITE} are written as one: choose the hierarchical observer, or fewer subsystems",
                network.n_subsystems(),
                network.a.nrows()
            )
        })
    }
}

/// Asks the conditions of a choice and designs when they hold, for a network of any size: it is never expanded.
///
/// Without conditions and design for every method but the hierarchical observer, see [`Method::missing_for`].
///
/// # Errors
/// As [`assess`](super::assess).
pub fn assess_network(
    network: &Network,
    choice: &DesignChoice,
    tolerance: &Tolerance,
) -> Result<Assessment, PropertyError> {
    assess_hierarchy(network, Hierarchy::of(network, tolerance), choice, tolerance)
}

/// The same with a representation that is known.
///
/// # Errors
/// As [`assess`](super::assess).
pub fn assess_hierarchy(
    network: &Network,
    hierarchy: Result<Hierarchy, HierarchyError>,
    choice: &DesignChoice,
    tolerance: &Tolerance,
) -> Result<Assessment, PropertyError> {
    let choice = choice.clone();
    if let Some(why) = choice.method.missing_for(network) {
        return Ok(Assessment { choice, conditions: Vec::new(), outcome: Err(DesignError::Unsuitable(why)) });
    }
    let conditions = hierarchical::conditions_of(network, &hierarchy, &choice, tolerance)?;
    let outcome = hierarchical::design_of(network, hierarchy, &choice, &conditions, tolerance)
        .and_then(|design| design.common(network));
    Ok(Assessment { choice, conditions, outcome })
}
