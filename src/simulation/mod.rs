//! L3: plant and observer together in time.

pub mod comparison;
mod constant;
mod direct;
mod error;
mod evaluator;
mod implicit;
mod index;
mod jacobian;
mod joint;
mod motion;
mod network;
mod newton;
mod observed;
mod plant;
mod record;
mod run;
mod scenario;
mod singularity;
mod trajectory;
mod uncertainty;
mod wide;
mod wide_feedback;
mod wide_run;

pub use crate::numerics::integrate::{Signals, Silence};
pub use error::SimulationError;
pub use joint::Inputs;
pub use network::{NetworkTrajectory, SubsystemTrajectory, simulate_network};
pub use observed::Observed;
pub use plant::{InitialState, Plant};
pub use run::{LARGEST_STATE, MOST_SAMPLES, MOST_STATES, Span, simulate, simulate_observed};
pub use scenario::Scenario;
pub use trajectory::{Method, ObserverTrajectory, Trajectory, rms};
pub use uncertainty::Uncertainty;
pub use wide::{FreeVariables, WidePlant};
pub use wide_feedback::{BoundingFeedback, FeedbackError, FreeMotion, MOST_FED_BACK};
