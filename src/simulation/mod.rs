//! L3: plant and observer together in time.

mod constant;
mod error;
mod index;
mod joint;
mod network;
mod plant;
mod record;
mod run;
mod scenario;
mod trajectory;
mod uncertainty;
mod varying;

pub use crate::numerics::integrate::{Signals, Silence};
pub use error::SimulationError;
pub use joint::Inputs;
pub use network::{NetworkTrajectory, SubsystemTrajectory, simulate_network};
pub use plant::{InitialState, Plant};
pub use run::{LARGEST_STATE, MOST_SAMPLES, MOST_STATES, Span, simulate};
pub use scenario::Scenario;
pub use trajectory::{Method, ObserverTrajectory, Trajectory, rms};
pub use uncertainty::Uncertainty;
