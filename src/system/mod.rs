//! L1: what is observed: descriptor systems, their structure and their properties.

mod coupling;
mod descriptor;
mod lipschitz;
mod model;
mod network;
mod partition;
pub mod properties;
mod sampled_constant;
mod signal;

pub use coupling::CouplingMatrix;
pub use descriptor::{DescriptorSystem, SystemError, TimeDomain};
pub use lipschitz::{LipschitzError, LipschitzTerm, nonlinearity};
pub use model::Model;
pub use network::{MOST_GLOBAL_OUTPUTS, Network};
pub use partition::{PartitionError, Subsystem, check_partition};
pub use sampled_constant::{LargestRatio, SampleRegion, SampledConstant};
pub use signal::Signal;
