//! Signals in time as data: an expression in `t`.

use crate::expression::{Expression, ExpressionError};

/// A scalar signal, an expression in the time `t` (seconds, or steps in discrete time).
///
/// `5+2*sin(4*t)`, `step(t-1)`, `square(2*pi*t)`, `0.1*noise(t/0.05, 7)`: equality is equality of the text.
#[derive(Clone, Debug, PartialEq)]
pub struct Signal(Expression);

impl Signal {
    /// Reads an expression in `t`.
    ///
    /// # Errors
    /// What is not understood, with its position.
    pub fn parse(text: &str) -> Result<Self, ExpressionError> {
        Ok(Self(Expression::parse(text, &["t"])?))
    }

    /// The expression as typed.
    pub fn text(&self) -> &str {
        self.0.text()
    }

    /// The value at time `t`.
    pub fn value(&self, t: f64) -> f64 {
        self.0.value(&[t])
    }

    /// The instants within `from..to` at which the signal jumps.
    pub fn jumps(&self, from: f64, to: f64) -> Vec<f64> {
        self.0.jumps(from, to)
    }

    /// The instants between `from` and `to` at which the signal is continuous but not smooth.
    pub fn kinks(&self, from: f64, to: f64) -> Vec<f64> {
        self.0.kinks(from, to)
    }

    /// Whether the signal is zero at all times.
    pub fn is_zero(&self) -> bool {
        self.0.is_zero()
    }
}
