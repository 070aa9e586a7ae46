//! L2: observers: existence conditions, designs, verification.

mod realization;

pub use realization::LinearObserver;
