//! L1: what is observed: descriptor systems, their structure and their properties.

mod descriptor;
pub mod properties;

pub use descriptor::{DescriptorSystem, SystemError, TimeDomain};
