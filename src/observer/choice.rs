//! Which observer a person asks for.

use serde::{Deserialize, Serialize};

use super::{
    Condition, Design, DesignError, LmiChoice, decentralized, h_infinity, hierarchical, input_decoupled,
    proportional, proportional_integral,
};
use crate::numerics::{Complex64, Tolerance, Watch};
use crate::system::properties::PropertyError;
use crate::system::{Model, TimeDomain};

/// The design methods.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Method {
    /// Proportional observer (Darouach and Boutayeb 1995).
    Proportional,
    /// Proportional-integral observer (paper 004).
    #[default]
    ProportionalIntegral,
    /// Input-decoupled observer of state and unknown input (paper 001).
    InputDecoupled,
    /// H-infinity observer for Lipschitz descriptor systems (paper 002).
    HInfinity,
    /// Decentralized observers of interconnected subsystems (paper 000).
    Decentralized,
    /// Hierarchical decentralized observer of a network (paper 003).
    Hierarchical,
}

impl Method {
    /// All methods, in the order in which they are offered.
    pub const ALL: [Self; 6] = [
        Self::ProportionalIntegral,
        Self::Proportional,
        Self::InputDecoupled,
        Self::HInfinity,
        Self::Decentralized,
        Self::Hierarchical,
    ];

    /// The key in documents.
    pub fn key(self) -> &'static str {
        match self {
            Self::Proportional => "proportional",
            Self::ProportionalIntegral => "proportional-integral",
            Self::InputDecoupled => "input-decoupled",
            Self::HInfinity => "h-infinity-lipschitz",
            Self::Decentralized => "decentralized",
            Self::Hierarchical => "hierarchical",
        }
    }

    /// The name on screen.
    pub fn title(self) -> &'static str {
        match self {
            Self::Proportional => "Proportional",
            Self::ProportionalIntegral => "Proportional-integral",
            Self::InputDecoupled => "Input-decoupled",
            Self::HInfinity => "H-infinity",
            Self::Decentralized => "Decentralized",
            Self::Hierarchical => "Hierarchical",
        }
    }

    /// Key of the paper that it comes from.
    pub fn paper(self) -> &'static str {
        match self {
            Self::Proportional | Self::ProportionalIntegral => "004",
            Self::InputDecoupled => "001",
            Self::HInfinity => "002",
            Self::Decentralized => "000",
            Self::Hierarchical => "003",
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
            Self::InputDecoupled => {
                "Estimates the state and the unknown input of a system of any shape; the errors die out whatever the unknown \
                 input does."
            }
            Self::HInfinity => {
                "Estimates the state of a plant with a Lipschitz nonlinearity; the effect of the disturbance d on the \
                 error is bounded by the least gamma."
            }
            Self::Decentralized => {
                "One local observer for each subsystem of a partition; the other subsystems' states are decoupled \
                 exactly or attenuated."
            }
            Self::Hierarchical => {
                "One global observer for what a network of identical subsystems shows as a whole, and local ones that are \
                 plugged in and out."
            }
        }
    }

    /// What a plant lacks, or has too much of, for this method; `None` when the method can be tried.
    pub fn missing(self, model: &Model) -> Option<String> {
        let system = &model.system;
        let sentence = match self {
            Self::Proportional | Self::ProportionalIntegral | Self::InputDecoupled
                if model.lipschitz.is_some() =>
            {
                "observers by pole placement do not take a Lipschitz term: choose the H-infinity observer, or remove the \
                 term to design for the linear part"
            }
            Self::ProportionalIntegral if system.n_unknown_inputs() == 0 => {
                proportional_integral::NO_UNKNOWN_INPUT
            }
            Self::HInfinity if system.time == TimeDomain::Discrete => {
                "the H-infinity observer is for differential equations: this system is in discrete time"
            }
            Self::Decentralized if model.lipschitz.is_some() => {
                "decentralized observers do not take a Lipschitz term: remove it to design for the linear part"
            }
            Self::Decentralized if model.partition.is_empty() => {
                "decentralized observers need subsystems: partition the system"
            }
            Self::Hierarchical if model.network.is_none() => {
                "the hierarchical observer is for a network of identical subsystems: open or make a network"
            }
            Self::Proportional
            | Self::ProportionalIntegral
            | Self::InputDecoupled
            | Self::HInfinity
            | Self::Decentralized
            | Self::Hierarchical => return None,
        };
        Some(sentence.to_owned())
    }

    /// The orders that the method offers, the usual one first.
    pub fn orders(self) -> &'static [Order] {
        match self {
            Self::ProportionalIntegral => &[Order::Reduced, Order::Full, Order::General],
            Self::Proportional => &[Order::Reduced, Order::Full],
            Self::InputDecoupled => &[Order::Full, Order::General],
            Self::HInfinity | Self::Decentralized => &[Order::Reduced, Order::Full, Order::Minimal],
            Self::Hierarchical => &[Order::Full],
        }
    }

    /// Whether the gains come from linear matrix inequalities instead of pole placement.
    pub fn uses_lmi(self) -> bool {
        matches!(self, Self::HInfinity | Self::Decentralized)
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
    /// Minimal order: neither what the outputs nor what the algebraic equations tell is estimated again.
    Minimal,
}

impl Order {
    /// All orders, in the order in which they are offered.
    pub const ALL: [Self; 4] = [Self::Reduced, Self::Full, Self::General, Self::Minimal];

    /// The key in documents.
    pub fn key(self) -> &'static str {
        match self {
            Self::Full => "full",
            Self::Reduced => "reduced",
            Self::General => "general",
            Self::Minimal => "minimal",
        }
    }
}

/// The chosen design: method, order, poles and demands; what the method does not use waits unchanged.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct DesignChoice {
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
    /// The wished poles of local observers, where a method has any besides; `poles` are those of the global one.
    pub local_poles: Vec<Complex64>,
    /// The subsystems whose local observer is plugged in, from zero; `None` for all that have local measurements.
    pub plugged: Option<Vec<usize>>,
    /// Demands on designs by linear matrix inequalities.
    pub lmi: LmiChoice,
}

impl Default for DesignChoice {
    fn default() -> Self {
        Self {
            method: Method::default(),
            order: Order::default(),
            poles: Vec::new(),
            scale: 1.0,
            seed: 1,
            local_poles: Vec::new(),
            plugged: None,
            lmi: LmiChoice::default(),
        }
    }
}

/// Conditions and design of one choice on one system.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Assessment {
    /// The choice.
    pub choice: DesignChoice,
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

/// Asks the conditions of a choice; none when the plant lacks what the method needs.
///
/// # Errors
/// When a decomposition fails its check.
pub fn conditions(
    model: &Model,
    choice: &DesignChoice,
    tolerance: &Tolerance,
) -> Result<Vec<Condition>, PropertyError> {
    if choice.method.missing(model).is_some() {
        return Ok(Vec::new());
    }
    match choice.method {
        Method::Proportional => proportional::conditions(&model.system, choice, tolerance),
        Method::ProportionalIntegral => {
            proportional_integral::conditions(&model.system, choice.order, tolerance)
        }
        Method::InputDecoupled => input_decoupled::conditions(model, choice, tolerance),
        Method::HInfinity => h_infinity::conditions(model, choice, tolerance),
        Method::Decentralized => decentralized::conditions(model, choice, tolerance),
        Method::Hierarchical => match &model.network {
            Some(network) => hierarchical::conditions_for(network, choice, tolerance),
            None => Ok(Vec::new()),
        },
    }
}

/// Asks the conditions of a choice and designs when they hold.
///
/// `watch` hears of the progress of a design by linear matrix inequalities and can stop it.
///
/// # Errors
/// When a decomposition fails its check while the conditions are asked; failures of the design are in the outcome.
pub fn assess(
    model: &Model,
    choice: &DesignChoice,
    tolerance: &Tolerance,
    watch: &Watch,
) -> Result<Assessment, PropertyError> {
    let conditions = conditions(model, choice, tolerance)?;
    Ok(assess_knowing(model, choice, conditions, tolerance, watch))
}

/// Designs when the conditions hold, which were asked before; where poles are placed, those of another choice of the same
/// method and order are the same.
pub fn assess_knowing(
    model: &Model,
    choice: &DesignChoice,
    conditions: Vec<Condition>,
    tolerance: &Tolerance,
    watch: &Watch,
) -> Assessment {
    let outcome = match choice.method.missing(model) {
        Some(why) => Err(DesignError::Unsuitable(why)),
        None => designed(model, choice, &conditions, tolerance, watch),
    };
    Assessment { choice: choice.clone(), conditions, outcome }
}

/// The design of a method that has the data it needs.
fn designed(
    model: &Model,
    choice: &DesignChoice,
    conditions: &[Condition],
    tolerance: &Tolerance,
    watch: &Watch,
) -> Result<Design, DesignError> {
    match choice.method {
        Method::Proportional => proportional::design(&model.system, choice, conditions, tolerance),
        Method::ProportionalIntegral => {
            proportional_integral::design(&model.system, choice, conditions, tolerance)
        }
        Method::InputDecoupled => input_decoupled::design(model, choice, conditions, tolerance),
        Method::HInfinity => h_infinity::design(model, choice, conditions, tolerance, watch),
        Method::Decentralized => decentralized::design(model, choice, conditions, tolerance, watch),
        Method::Hierarchical => match &model.network {
            Some(network) => hierarchical::design(network, choice, conditions, tolerance)?.common(network),
            None => Err(DesignError::Unsuitable("the plant is no network".to_owned())),
        },
    }
}
