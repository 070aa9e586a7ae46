//! L0: scalar expressions that people type: entries of matrices, signals in time, nonlinearities.
//!
//! ```text
//! operators    + - * / ^ (also .* ./ .^), < <= > >= == ~= (also !=), & | ~ (also && || !)
//! precedence   ^, then signs and ~, then * /, then + -, then comparisons, then &, then |   (all from the left)
//! constants    pi
//! smooth       sin cos tan asin acos atan atan2 sinh cosh tanh exp log (= ln) log10 sqrt pow(x, y)
//! with kinks   abs min(x, y) max(x, y) ramp(x) noise(x, seed)
//! with jumps   sign floor ceil round mod(x, y) step square sawtooth pulse(t, start, stop) if(condition, a, b)
//! ```
//!
//! The rules are those of MATLAB: `-2^2` is -4, `2^3^2` is 64, `2^-1` is 0.5. There is no implicit product and no
//! constant `e` (write `exp(1)`).

mod error;
mod function;
mod jumps;
mod kinks;
mod noise;
mod parse;
mod program;
mod rules;
mod scalar;
mod suggest;
mod token;
mod wave;

use std::sync::Arc;

pub use error::{ExpressionError, ExpressionProblem};
pub use jumps::MAX_JUMPS;
use program::Program;

/// Longest text that is read, in characters.
pub const MAX_CHARACTERS: usize = 2_000;
/// Deepest nesting of parentheses, signs and right operands.
pub const MAX_DEPTH: usize = 64;
/// Largest number of operators and function calls.
pub const MAX_OPERATIONS: usize = 500;

/// A scalar expression in named variables: the text as typed, and its compiled form.
///
/// Two expressions are equal when their texts and variables are. A clone shares everything.
///
/// # Examples
/// ```
/// use descry::expression::Expression;
/// let signal = Expression::parse("5 + 2*sin(4*t)", &["t"])?;
/// assert_eq!(signal.value(&[0.0]), 5.0);
/// assert_eq!(signal.dual(&[0.0], &[1.0]), (5.0, 8.0));
/// # Ok::<(), descry::expression::ExpressionError>(())
/// ```
#[derive(Clone, Debug)]
pub struct Expression(Arc<Parsed>);

#[derive(Debug)]
struct Parsed {
    text: String,
    variables: Vec<String>,
    program: Program,
}

impl PartialEq for Expression {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.0, &other.0)
            || (self.0.text == other.0.text && self.0.variables == other.0.variables)
    }
}

impl Expression {
    /// Reads an expression in the given variables, whose values [`Self::value`] takes in the same order.
    ///
    /// # Errors
    /// The first place that cannot be read, and what is expected there.
    pub fn parse(text: &str, variables: &[&str]) -> Result<Self, ExpressionError> {
        let program = parse::parse(text, variables)?;
        let variables = variables.iter().map(|name| (*name).to_owned()).collect();
        Ok(Self(Arc::new(Parsed { text: text.to_owned(), variables, program })))
    }

    /// The text as it was typed.
    pub fn text(&self) -> &str {
        &self.0.text
    }

    /// The variables, in the order of their values.
    pub fn variables(&self) -> &[String] {
        &self.0.variables
    }

    /// The value; not a number outside the domain (`sqrt(-1)`) or when a value that is used is missing.
    pub fn value(&self, values: &[f64]) -> f64 {
        self.0.program.value(values)
    }

    /// The value `f(v)` and the directional derivative `d/ds f(v + s w)` at `s = 0`.
    ///
    /// At a jump the derivative is that of the branch taken, at a kink that of one side (zero for `abs` at 0). A
    /// component of the direction that is missing counts as zero.
    pub fn dual(&self, values: &[f64], direction: &[f64]) -> (f64, f64) {
        self.0.program.dual(values, direction)
    }

    /// Whether the value is the same whatever the variables are, because none of them occurs.
    pub fn is_constant(&self) -> bool {
        self.0.program.constant().is_some()
    }

    /// Whether no variable occurs and the value is zero.
    pub fn is_zero(&self) -> bool {
        self.0.program.constant() == Some(0.0)
    }

    /// Whether the variable occurs.
    pub fn uses(&self, variable: &str) -> bool {
        self.0.variables.iter().position(|name| name == variable).is_some_and(|k| self.0.program.uses(k))
    }

    /// The instants in `from < t <= to` where the expression may jump, ascending; the first 10,000 of them.
    ///
    /// An instant is the first floating-point number on the new branch of a `step`, `sign`, `floor`, `ceil`, `round`,
    /// `mod`, `square`, `sawtooth`, `pulse`, comparison, `if`, `&`, `|` or `~`, moved by at most a few units in the last
    /// place to the decimal number next to it. Found by sampling on a grid of 20,000 cells and bisection: two changes
    /// of a branch within one cell that undo each other are missed (never those of arguments that are monotone in t).
    /// Branches that depend on other variables than `t` are left out: their instants are not known beforehand.
    pub fn jumps(&self, from: f64, to: f64) -> Vec<f64> {
        let time = self.0.variables.iter().position(|name| name == "t");
        time.map_or_else(Vec::new, |time| {
            jumps::jumps(&self.0.program, time, self.0.variables.len(), (from, to))
        })
    }
}

impl Expression {
    /// The instants in `from < t < to` where the expression is continuous but not smooth, ascending; at most 10,000.
    ///
    /// Whole arguments of `noise`, zeros of the arguments of `abs` and `ramp`, equal arguments of `min` and `max`. Found
    /// exactly where the argument of a noise is linear in time, else as [`Self::jumps`] does. Where the slope stays the
    /// same nevertheless, because the noise is switched off, say, there is no kink.
    pub fn kinks(&self, from: f64, to: f64) -> Vec<f64> {
        let time = self.0.variables.iter().position(|name| name == "t");
        time.map_or_else(Vec::new, |time| {
            kinks::kinks(&self.0.program, time, self.0.variables.len(), (from, to))
        })
    }
}

/// The finite number that an entry of a matrix stands for: `-1/3`, `1e-3`, `sqrt(2)`, `2*pi`.
///
/// # Errors
/// As [`Expression::parse`], and when the value is infinite or not a number.
///
/// # Examples
/// ```
/// use descry::expression::constant;
/// assert_eq!(constant("-1/4")?, -0.25);
/// assert_eq!(constant("1/0").unwrap_err().to_string(), "1/0 is infinite; a finite number is needed");
/// # Ok::<(), descry::expression::ExpressionError>(())
/// ```
pub fn constant(text: &str) -> Result<f64, ExpressionError> {
    let value = parse::parse(text, &[])?.value(&[]);
    if value.is_finite() {
        return Ok(value);
    }
    let what = if value.is_nan() { "not a number" } else { "infinite" };
    Err(ExpressionError {
        position: 0,
        problem: ExpressionProblem::NotFinite { text: text.trim().to_owned(), what },
    })
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod random_tests;
#[cfg(test)]
mod tests;
