//! Plain numbers and dual numbers behind one set of rules.

/// A number that knows how to pass through a differentiable function.
pub(super) trait Scalar: Copy {
    /// A number that does not depend on the variables.
    fn constant(value: f64) -> Self;

    /// The value without its derivative.
    fn value(self) -> f64;

    /// `f(self)`, given its value; the slope is asked for only where it is needed.
    fn chain(self, value: f64, slope: impl FnOnce() -> f64) -> Self;

    /// `f(self, other)`, given its value and, where needed, both partial derivatives.
    fn chain_pair(self, other: Self, value: f64, slopes: impl FnOnce() -> (f64, f64)) -> Self;
}

impl Scalar for f64 {
    fn constant(value: f64) -> Self {
        value
    }

    fn value(self) -> f64 {
        self
    }

    fn chain(self, value: Self, _slope: impl FnOnce() -> Self) -> Self {
        value
    }

    fn chain_pair(self, _other: Self, value: Self, _slopes: impl FnOnce() -> (Self, Self)) -> Self {
        value
    }
}

/// A value and its derivative in one direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Dual {
    pub(super) value: f64,
    pub(super) derivative: f64,
}

/// `slope * derivative`, where nothing that stands still is moved by an infinite slope.
fn product(slope: f64, derivative: f64) -> f64 {
    if derivative == 0.0 { 0.0 } else { slope * derivative }
}

impl Scalar for Dual {
    fn constant(value: f64) -> Self {
        Self { value, derivative: 0.0 }
    }

    fn value(self) -> f64 {
        self.value
    }

    fn chain(self, value: f64, slope: impl FnOnce() -> f64) -> Self {
        Self { value, derivative: product(slope(), self.derivative) }
    }

    fn chain_pair(self, other: Self, value: f64, slopes: impl FnOnce() -> (f64, f64)) -> Self {
        let (left, right) = slopes();
        Self { value, derivative: product(left, self.derivative) + product(right, other.derivative) }
    }
}
