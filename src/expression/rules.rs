//! Values and derivatives of all operations.

use super::function::{Binary, Ternary, Unary};
use super::noise::noise;
use super::scalar::Scalar;
use super::wave::{cycles, modulo, sawtooth, sign, square, step};

/// Truth as a number.
pub(super) fn truth(condition: bool) -> f64 {
    f64::from(u8::from(condition))
}

/// A function that is flat wherever it has a derivative.
fn flat<S: Scalar>(x: S, value: f64) -> S {
    x.chain(value, || 0.0)
}

/// An operation on one number.
pub(super) fn unary<S: Scalar>(operation: Unary, argument: S) -> S {
    let x = argument.value();
    match operation {
        Unary::Negative => argument.chain(-x, || -1.0),
        Unary::Not => flat(argument, truth(x == 0.0)),
        Unary::Sin => argument.chain(x.sin(), || x.cos()),
        Unary::Cos => argument.chain(x.cos(), || -x.sin()),
        Unary::Tan => {
            let value = x.tan();
            argument.chain(value, || 1.0 + value * value)
        }
        Unary::Asin => argument.chain(x.asin(), || 1.0 / ((1.0 - x) * (1.0 + x)).sqrt()),
        Unary::Acos => argument.chain(x.acos(), || -1.0 / ((1.0 - x) * (1.0 + x)).sqrt()),
        Unary::Atan => argument.chain(x.atan(), || 1.0 / (1.0 + x * x)),
        Unary::Sinh => argument.chain(x.sinh(), || x.cosh()),
        Unary::Cosh => argument.chain(x.cosh(), || x.sinh()),
        Unary::Tanh => {
            let value = x.tanh();
            argument.chain(value, || (1.0 - value) * (1.0 + value))
        }
        Unary::Exp => {
            let value = x.exp();
            argument.chain(value, || value)
        }
        Unary::Log => argument.chain(x.ln(), || 1.0 / x),
        Unary::Log10 => argument.chain(x.log10(), || std::f64::consts::LOG10_E / x),
        Unary::Sqrt => {
            let value = x.sqrt();
            argument.chain(value, || 0.5 / value)
        }
        Unary::Abs => argument.chain(x.abs(), || sign(x)),
        Unary::Sign => flat(argument, sign(x)),
        Unary::Floor => flat(argument, x.floor()),
        Unary::Ceil => flat(argument, x.ceil()),
        Unary::Round => flat(argument, x.round()),
        Unary::Step => flat(argument, step(x)),
        Unary::Square => flat(argument, square(x)),
        Unary::Sawtooth => argument.chain(sawtooth(x), || std::f64::consts::FRAC_1_PI),
        Unary::Ramp => argument.chain(if x < 0.0 { 0.0 } else { x }, || truth(x > 0.0)),
    }
}

/// An operation on two numbers.
pub(super) fn binary<S: Scalar>(operation: Binary, left: S, right: S) -> S {
    let (a, b) = (left.value(), right.value());
    let smooth = |value: f64, slopes: (f64, f64)| left.chain_pair(right, value, || slopes);
    let truth = |condition: bool| smooth(truth(condition), (0.0, 0.0));
    match operation {
        Binary::Add => smooth(a + b, (1.0, 1.0)),
        Binary::Subtract => smooth(a - b, (1.0, -1.0)),
        Binary::Multiply => smooth(a * b, (b, a)),
        Binary::Divide => {
            let quotient = a / b;
            left.chain_pair(right, quotient, || (1.0 / b, -quotient / b))
        }
        Binary::Power => power(left, right),
        Binary::Less => truth(a < b),
        Binary::LessEqual => truth(a <= b),
        Binary::Greater => truth(a > b),
        Binary::GreaterEqual => truth(a >= b),
        Binary::Equal => truth(a == b),
        Binary::NotEqual => truth(a != b),
        Binary::And => truth(a != 0.0 && b != 0.0),
        Binary::Or => truth(a != 0.0 || b != 0.0),
        Binary::Atan2 => left.chain_pair(right, a.atan2(b), || {
            let square = a * a + b * b;
            (b / square, -a / square)
        }),
        // A value that is not a number is not hidden by the other one.
        Binary::Min => {
            if a <= b || a.is_nan() {
                left
            } else {
                right
            }
        }
        Binary::Max => {
            if a >= b || a.is_nan() {
                left
            } else {
                right
            }
        }
        Binary::Mod => {
            left.chain_pair(right, modulo(a, b), || (1.0, if b == 0.0 { 0.0 } else { -cycles(a, b).floor() }))
        }
        Binary::Noise => {
            let (value, slope) = noise(a, b);
            smooth(value, (slope, 0.0))
        }
    }
}

/// `a^b`, with slopes `b a^(b-1)` and `a^b ln a`.
fn power<S: Scalar>(left: S, right: S) -> S {
    let (a, b) = (left.value(), right.value());
    let value = a.powf(b);
    left.chain_pair(right, value, || {
        let base = if b == 0.0 { 0.0 } else { b * a.powf(b - 1.0) };
        let exponent = if a == 0.0 && b > 0.0 { 0.0 } else { value * a.ln() };
        (base, exponent)
    })
}

/// `x^k` by repeated squaring, hence the same on every platform.
pub(super) fn whole_power<S: Scalar>(argument: S, exponent: i32) -> S {
    let x = argument.value();
    argument.chain(repeated_product(x, exponent), || {
        if exponent == 0 { 0.0 } else { f64::from(exponent) * repeated_product(x, exponent - 1) }
    })
}

fn repeated_product(x: f64, exponent: i32) -> f64 {
    let (mut rest, mut square, mut product) = (exponent.unsigned_abs(), x, 1.0);
    while rest > 0 {
        if rest & 1 == 1 {
            product *= square;
        }
        square *= square;
        rest >>= 1;
    }
    if exponent < 0 { 1.0 / product } else { product }
}

/// An operation on three numbers.
pub(super) fn ternary<S: Scalar>(operation: Ternary, first: S, second: S, third: S) -> S {
    let (x, y, z) = (first.value(), second.value(), third.value());
    match operation {
        Ternary::If if x.is_nan() => S::constant(f64::NAN),
        Ternary::If => {
            if x == 0.0 {
                third
            } else {
                second
            }
        }
        Ternary::Pulse if x.is_nan() || y.is_nan() || z.is_nan() => S::constant(f64::NAN),
        Ternary::Pulse => S::constant(truth(y <= x && x < z)),
    }
}

/// A number that changes exactly where the operation changes its branch; `None` when it has no branches.
pub(super) fn unary_branch(operation: Unary, x: f64) -> Option<f64> {
    Some(match operation {
        Unary::Not => truth(x == 0.0),
        Unary::Sign => sign(x),
        Unary::Floor => x.floor(),
        Unary::Ceil => x.ceil(),
        Unary::Round => x.round(),
        Unary::Step => step(x),
        Unary::Square => cycles(x, std::f64::consts::PI).floor(),
        Unary::Sawtooth => cycles(x, std::f64::consts::TAU).floor(),
        _ => return None,
    })
}

/// As [`unary_branch`].
pub(super) fn binary_branch(operation: Binary, a: f64, b: f64) -> Option<f64> {
    Some(match operation {
        Binary::Mod => {
            if b == 0.0 {
                0.0
            } else {
                cycles(a, b).floor()
            }
        }
        Binary::Less
        | Binary::LessEqual
        | Binary::Greater
        | Binary::GreaterEqual
        | Binary::And
        | Binary::Or => binary(operation, a, b),
        Binary::Equal | Binary::NotEqual => sign(a - b),
        _ => return None,
    })
}

/// As [`unary_branch`].
pub(super) fn ternary_branch(operation: Ternary, x: f64, y: f64, z: f64) -> f64 {
    match operation {
        Ternary::If => truth(x != 0.0),
        Ternary::Pulse => truth(y <= x) + 2.0 * truth(z <= x),
    }
}
