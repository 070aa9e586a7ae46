//! The instants at which an expression of time jumps.

use super::function::Operation;
use super::program::{Instruction, Program};
use super::rules::{binary_branch, ternary_branch, unary_branch};

/// Most instants that are returned.
pub const MAX_JUMPS: usize = 10_000;
/// Cells of the grid.
const CELLS: u32 = 20_000;

/// As documented at [`super::Expression::jumps`]; `time` is the index of t among `variables` variables.
pub(super) fn jumps(program: &Program, time: usize, variables: usize, interval: (f64, f64)) -> Vec<f64> {
    let (from, to) = interval;
    if !(from.is_finite() && to.is_finite() && (to - from).is_finite() && from < to) {
        return Vec::new();
    }
    let mut values = vec![f64::NAN; variables];
    let mut instants: Vec<f64> = switches(program, time, has_branches)
        .iter()
        .flat_map(|switch| {
            let branch = |t: f64| {
                values[time] = t;
                switch.branch(program, &values)
            };
            Search::new(branch).over(from, to)
        })
        .collect();
    for instant in &mut instants {
        *instant = instant.min(to);
    }
    instants.sort_by(f64::total_cmp);
    // A `sign` changes twice where it passes zero, and several terms may jump together.
    instants.dedup_by(|later, earlier| *later - *earlier <= 8.0 * f64::EPSILON * later.abs());
    instants.truncate(MAX_JUMPS);
    instants
}

/// An operation that has branches, and the code of its operands.
pub(super) struct Switch<'a> {
    pub(super) operation: Operation,
    pub(super) operands: Vec<&'a [Instruction]>,
}

/// All operations of a kind whose branch is decided by time alone.
pub(super) fn switches(program: &Program, time: usize, is_kind: fn(Operation) -> bool) -> Vec<Switch<'_>> {
    let mut found = Vec::new();
    for (index, instruction) in program.code.iter().enumerate() {
        let Instruction::Operation(operation) = *instruction else { continue };
        if !is_kind(operation) {
            continue;
        }
        let mut operands = Vec::new();
        let mut end = index;
        for _ in 0..operation.arity() {
            let start = program.operand_start(end - 1);
            operands.insert(0, &program.code[start..end]);
            end = start;
        }
        if matches!(operation, Operation::Ternary(super::function::Ternary::If)) {
            operands.truncate(1);
        }
        let mut variables = operands.iter().flat_map(|code| code.iter()).filter_map(|i| match i {
            Instruction::Variable(index) => Some(*index),
            _ => None,
        });
        let first = variables.next();
        if first == Some(time) && variables.all(|variable| variable == time) {
            found.push(Switch { operation, operands });
        }
    }
    found
}

fn has_branches(operation: Operation) -> bool {
    match operation {
        Operation::Unary(operation) => unary_branch(operation, 0.0).is_some(),
        Operation::Binary(operation) => binary_branch(operation, 0.0, 1.0).is_some(),
        Operation::Ternary(_) => true,
    }
}

impl Switch<'_> {
    /// The value of an operand.
    pub(super) fn operand(&self, k: usize, program: &Program, values: &[f64]) -> f64 {
        self.operands.get(k).map_or(0.0, |code| program.part(code, values))
    }

    /// A number that changes where the branch does.
    fn branch(&self, program: &Program, values: &[f64]) -> f64 {
        let operand = |k: usize| self.operand(k, program, values);
        let branch = match self.operation {
            Operation::Unary(operation) => unary_branch(operation, operand(0)),
            Operation::Binary(operation) => binary_branch(operation, operand(0), operand(1)),
            Operation::Ternary(operation) => {
                Some(ternary_branch(operation, operand(0), operand(1), operand(2)))
            }
        };
        // Outside the domain counts as one branch.
        branch.filter(|value| !value.is_nan()).unwrap_or(f64::INFINITY)
    }
}

/// Looks for the changes of one branch, from left to right.
pub(super) struct Search<F> {
    branch: F,
    found: Vec<f64>,
}

impl<F: FnMut(f64) -> f64> Search<F> {
    pub(super) fn new(branch: F) -> Self {
        Self { branch, found: Vec::new() }
    }

    pub(super) fn over(mut self, from: f64, to: f64) -> Vec<f64> {
        let step = (to - from) / f64::from(CELLS);
        let mut left = (from, (self.branch)(from));
        for cell in 1..=CELLS {
            let t = if cell == CELLS { to } else { from + step * f64::from(cell) };
            let right = (t, (self.branch)(t));
            self.within(left, right);
            left = right;
        }
        self.found
    }

    /// Bisects until the ends are neighbouring numbers; at most about 60 levels for each change.
    fn within(&mut self, left: (f64, f64), right: (f64, f64)) {
        if left.1 == right.1 || self.found.len() >= MAX_JUMPS {
            return;
        }
        let t = left.0 + (right.0 - left.0) / 2.0;
        if t <= left.0 || t >= right.0 {
            let instant = self.plain(right);
            self.found.push(instant);
            return;
        }
        let middle = (t, (self.branch)(t));
        self.within(left, middle);
        self.within(middle, right);
    }

    /// The decimal number within rounding of the instant, when it is on the new branch as well.
    fn plain(&mut self, (t, branch): (f64, f64)) -> f64 {
        let decimal = format!("{t:.12e}").parse().unwrap_or(t);
        let near = (decimal - t).abs() <= 8.0 * f64::EPSILON * t.abs();
        if near && (self.branch)(decimal) == branch { decimal } else { t }
    }
}
