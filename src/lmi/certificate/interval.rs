//! Intervals of real numbers with outward rounding.

use std::ops::{Add, Mul, Neg, Sub};

/// A closed interval that contains the exact result of every operation on members of its operands.
///
/// Every computed bound is moved to the next representable number outwards, which covers rounding to nearest, underflow
/// included. What is not a number becomes the whole line, so that nothing is ever proved from it.
///
/// # Examples
/// ```
/// use descry::lmi::certificate::Interval;
/// let sum = Interval::point(0.1) + Interval::point(0.2);
/// assert!(sum.low() <= 0.3 && 0.3 < sum.high() && sum.high() - sum.low() < 2e-16);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Interval {
    low: f64,
    high: f64,
}

impl Interval {
    /// Exactly zero.
    pub const ZERO: Self = Self { low: 0.0, high: 0.0 };
    /// Exactly one.
    pub const ONE: Self = Self { low: 1.0, high: 1.0 };
    /// The whole line.
    pub const ENTIRE: Self = Self { low: f64::NEG_INFINITY, high: f64::INFINITY };

    /// One number exactly; the whole line for what is not a finite number.
    pub fn point(x: f64) -> Self {
        if x.is_finite() { Self { low: x, high: x } } else { Self::ENTIRE }
    }

    /// Lower end.
    pub fn low(self) -> f64 {
        self.low
    }

    /// Upper end.
    pub fn high(self) -> f64 {
        self.high
    }

    /// Whether the number lies within.
    pub fn contains(self, x: f64) -> bool {
        self.low <= x && x <= self.high
    }

    /// The smallest interval around both.
    pub fn hull(self, other: Self) -> Self {
        Self { low: self.low.min(other.low), high: self.high.max(other.high) }
    }

    /// Both ends one representable number outwards.
    fn outward(low: f64, high: f64) -> Self {
        if low.is_nan() || high.is_nan() {
            return Self::ENTIRE;
        }
        Self { low: low.next_down(), high: high.next_up() }
    }

    /// Times a power of two, which is exact unless it leaves the range of normal numbers.
    pub(super) fn times_power_of_two(self, factor: f64) -> Self {
        let (low, high) = (self.low * factor, self.high * factor);
        let exact = |before: f64, after: f64| before == 0.0 || after.is_normal();
        if exact(self.low, low) && exact(self.high, high) {
            return Self { low, high };
        }
        Self::outward(low, high)
    }

    fn is_zero(self) -> bool {
        self == Self::ZERO
    }
}

impl Add for Interval {
    type Output = Self;

    /// Zero adds nothing, hence exactly.
    fn add(self, other: Self) -> Self {
        if self.is_zero() {
            return other;
        }
        if other.is_zero() {
            return self;
        }
        Self::outward(self.low + other.low, self.high + other.high)
    }
}

impl Neg for Interval {
    type Output = Self;

    fn neg(self) -> Self {
        Self { low: -self.high, high: -self.low }
    }
}

impl Sub for Interval {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Mul for Interval {
    type Output = Self;

    /// Zero and one multiply exactly; zero times the whole line is zero, since the line stands for one real number.
    fn mul(self, other: Self) -> Self {
        if self.is_zero() || other.is_zero() {
            return Self::ZERO;
        }
        if self == Self::ONE {
            return other;
        }
        if other == Self::ONE {
            return self;
        }
        let products =
            [self.low * other.low, self.low * other.high, self.high * other.low, self.high * other.high];
        // `f64::min` and `f64::max` would pass over a NaN
        if products.iter().any(|x| x.is_nan()) {
            return Self::ENTIRE;
        }
        let low = products.into_iter().fold(f64::INFINITY, f64::min);
        let high = products.into_iter().fold(f64::NEG_INFINITY, f64::max);
        Self::outward(low, high)
    }
}
