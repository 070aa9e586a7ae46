//! Which observer a person asks for.

use serde::{Deserialize, Serialize};

use super::{Condition, Design, DesignError, proportional, proportional_integral};
use crate::numerics::{Complex64, Tolerance};
use crate::system::DescriptorSystem;
use crate::system::properties::PropertyError;

/// The design methods.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Method {
    /// Proportional observer (Darouach and Boutayeb 1995).
    Proportional,
    /// Proportional-integral observer (paper 004).
    #[default]
    ProportionalIntegral,
}

impl Method {
    /// All methods, in the order in which they are offered.
    pub const ALL: [Self; 2] = [Self::ProportionalIntegral, Self::Proportional];

    /// The key in documents.
    pub fn key(self) -> &'static str {
        match self {
            Self::Proportional => "proportional",
            Self::ProportionalIntegral => "proportional-integral",
        }
    }

    /// The name on screen.
    pub fn title(self) -> &'static str {
        match self {
            Self::Proportional => "Proportional",
            Self::ProportionalIntegral => "Proportional-integral",
        }
    }

    /// One sentence: what it estimates and what it needs.
    pub fn description(self) -> &'static str {
        match self {
            Self::Proportional => {
                "Estimates the state. Unknown inputs and model errors leave an offset in the estimate."
            }
            Self::ProportionalIntegral => {
                "Estimates the state and the unknown input by an integral loop; constant unknown inputs leave no offset."
            }
        }
    }
}

/// The order of an observer.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Order {
    /// Full order: every state is estimated dynamically.
    Full,
    /// Reduced order: what the outputs already tell is not estimated again; better conditioned.
    #[default]
    Reduced,
    /// General form on the augmented system, which does not need condition (8).
    General,
}

impl Order {
    /// All orders, in the order in which they are offered.
    pub const ALL: [Self; 3] = [Self::Reduced, Self::Full, Self::General];

    /// The key in documents.
    pub fn key(self) -> &'static str {
        match self {
            Self::Full => "full",
            Self::Reduced => "reduced",
            Self::General => "general",
        }
    }
}

/// A design by pole placement.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PoleDesign {
    /// Method.
    pub method: Method,
    /// Order.
    pub order: Order,
    /// The wished poles; an order that needs fewer takes the first ones.
    pub poles: Vec<Complex64>,
    /// Bandwidth factor (the papers' multiple of Lambda), from 0.01 to 1000.
    pub scale: f64,
    /// Seed of the placement's random starts, so that gains are reproducible.
    pub seed: u64,
}

impl Default for PoleDesign {
    fn default() -> Self {
        Self { method: Method::default(), order: Order::default(), poles: Vec::new(), scale: 1.0, seed: 1 }
    }
}

/// Conditions and design of one choice on one system.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Assessment {
    /// The choice.
    pub choice: PoleDesign,
    /// Every condition of the method, needed or not.
    pub conditions: Vec<Condition>,
    /// The design, or why there is none.
    pub outcome: Result<Design, DesignError>,
}

impl Assessment {
    /// Whether a design exists and passed its verification.
    pub fn verified(&self) -> bool {
        self.outcome.as_ref().is_ok_and(|design| design.verification.verified())
    }
}

/// Asks the conditions of a choice.
///
/// # Errors
/// When a decomposition fails its check.
pub fn conditions(
    system: &DescriptorSystem,
    choice: &PoleDesign,
    tolerance: &Tolerance,
) -> Result<Vec<Condition>, PropertyError> {
    match choice.method {
        Method::Proportional => proportional::conditions(system, choice, tolerance),
        Method::ProportionalIntegral => proportional_integral::conditions(system, choice.order, tolerance),
    }
}

/// Asks the conditions of a choice and designs when they hold.
///
/// # Errors
/// When a decomposition fails its check while the conditions are asked; failures of the design are in the outcome.
pub fn assess(
    system: &DescriptorSystem,
    choice: &PoleDesign,
    tolerance: &Tolerance,
) -> Result<Assessment, PropertyError> {
    let conditions = conditions(system, choice, tolerance)?;
    let outcome = match choice.method {
        Method::Proportional => proportional::design(system, choice, &conditions, tolerance),
        Method::ProportionalIntegral => proportional_integral::design(system, choice, &conditions, tolerance),
    };
    Ok(Assessment { choice: choice.clone(), conditions, outcome })
}
