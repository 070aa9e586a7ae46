//! Expressions as programs for a stack of numbers.

use super::function::{Binary, Operation};
use super::rules::{binary, ternary, unary, whole_power};
use super::scalar::{Dual, Scalar};

/// Stack of nearly every expression; larger ones take [`LARGE_STACK`].
const SMALL_STACK: usize = 8;
/// Room for the deepest expression that is read: two waiting numbers per level.
pub(super) const LARGE_STACK: usize = 160;
/// Exponents up to this size are repeated products.
const LARGEST_WHOLE_POWER: f64 = 64.0;

/// One step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Instruction {
    Constant(f64),
    Variable(usize),
    WholePower(i32),
    Operation(Operation),
}

impl Instruction {
    /// How many numbers it takes from the stack.
    pub(super) fn arity(self) -> usize {
        match self {
            Self::Constant(_) | Self::Variable(_) => 0,
            Self::WholePower(_) => 1,
            Self::Operation(operation) => operation.arity(),
        }
    }
}

/// Instructions in postfix order, constants folded.
#[derive(Clone, Debug, Default)]
pub(super) struct Program {
    pub(super) code: Vec<Instruction>,
    height: usize,
    /// Largest number of values on the stack.
    pub(super) highest: usize,
}

impl Program {
    /// Appends an instruction; one whose operands are all constants becomes their result.
    pub(super) fn push(&mut self, instruction: Instruction) {
        let instruction = self.simplified(instruction);
        let arity = instruction.arity();
        self.height = (self.height + 1).saturating_sub(arity);
        self.highest = self.highest.max(self.height);
        self.code.push(instruction);
        let operands = self.code.len().saturating_sub(arity + 1);
        let folds = arity > 0
            && self.code[operands..self.code.len() - 1].iter().all(|i| matches!(i, Instruction::Constant(_)));
        if folds {
            let value = run::<f64, SMALL_STACK>(&self.code[operands..], |_| f64::NAN);
            self.code.truncate(operands);
            self.code.push(Instruction::Constant(value));
        }
    }

    /// `x^k` with a whole constant `k` needs no logarithm.
    fn simplified(&mut self, instruction: Instruction) -> Instruction {
        if instruction == Instruction::Operation(Operation::Binary(Binary::Power))
            && let Some(Instruction::Constant(exponent)) = self.code.last().copied()
            && exponent.fract() == 0.0
            && exponent.abs() <= LARGEST_WHOLE_POWER
        {
            self.code.pop();
            self.height = self.height.saturating_sub(1);
            #[expect(clippy::cast_possible_truncation, reason = "whole and at most 64")]
            return Instruction::WholePower(exponent as i32);
        }
        instruction
    }

    /// The value, when no variable occurs.
    pub(super) fn constant(&self) -> Option<f64> {
        match self.code.as_slice() {
            [Instruction::Constant(value)] => Some(*value),
            _ => None,
        }
    }

    /// Whether the variable of that index occurs.
    pub(super) fn uses(&self, variable: usize) -> bool {
        self.code.contains(&Instruction::Variable(variable))
    }

    /// The value.
    pub(super) fn value(&self, values: &[f64]) -> f64 {
        let variable = |k: usize| values.get(k).copied().unwrap_or(f64::NAN);
        self.run(&self.code, variable)
    }

    /// The value of a part of this program.
    pub(super) fn part(&self, code: &[Instruction], values: &[f64]) -> f64 {
        self.run(code, |k: usize| values.get(k).copied().unwrap_or(f64::NAN))
    }

    /// Value and directional derivative.
    pub(super) fn dual(&self, values: &[f64], direction: &[f64]) -> (f64, f64) {
        let variable = |k: usize| Dual {
            value: values.get(k).copied().unwrap_or(f64::NAN),
            derivative: direction.get(k).copied().unwrap_or(0.0),
        };
        let result = self.run(&self.code, variable);
        (result.value, result.derivative)
    }

    fn run<S: Scalar>(&self, code: &[Instruction], variable: impl Fn(usize) -> S) -> S {
        if self.highest <= SMALL_STACK {
            run::<S, SMALL_STACK>(code, variable)
        } else {
            run::<S, LARGE_STACK>(code, variable)
        }
    }

    /// Where the operand begins whose last instruction is `last`.
    pub(super) fn operand_start(&self, last: usize) -> usize {
        let mut needed = 1;
        for start in (0..=last).rev() {
            needed = needed + self.code[start].arity() - 1;
            if needed == 0 {
                return start;
            }
        }
        0
    }
}

/// Runs the code on a stack of `N`; the parser saw to it that `N` suffices and that no operand is missing.
fn run<S: Scalar, const N: usize>(code: &[Instruction], variable: impl Fn(usize) -> S) -> S {
    let mut stack = [S::constant(0.0); N];
    let mut top = 0;
    for instruction in code {
        top -= instruction.arity();
        stack[top] = match *instruction {
            Instruction::Constant(value) => S::constant(value),
            Instruction::Variable(index) => variable(index),
            Instruction::WholePower(exponent) => whole_power(stack[top], exponent),
            Instruction::Operation(Operation::Unary(operation)) => unary(operation, stack[top]),
            Instruction::Operation(Operation::Binary(operation)) => {
                binary(operation, stack[top], stack[top + 1])
            }
            Instruction::Operation(Operation::Ternary(operation)) => {
                ternary(operation, stack[top], stack[top + 1], stack[top + 2])
            }
        };
        top += 1;
    }
    stack[0]
}
