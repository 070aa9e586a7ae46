//! An observer as it runs beside a plant.

use crate::observer::{Design, Injection, LinearObserver};

/// An observer, and how the plant's nonlinearity enters it, if it does.
#[derive(Clone, Copy, Debug)]
pub struct Observed<'a> {
    /// The linear part.
    pub observer: &'a LinearObserver,
    /// The nonlinearity at the estimate.
    pub injection: Option<&'a Injection>,
}

impl<'a> From<&'a LinearObserver> for Observed<'a> {
    fn from(observer: &'a LinearObserver) -> Self {
        Self { observer, injection: None }
    }
}

impl<'a> From<&'a Design> for Observed<'a> {
    fn from(design: &'a Design) -> Self {
        Self { observer: &design.observer, injection: design.injection.as_ref() }
    }
}
