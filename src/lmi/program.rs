//! The conic program of a phase: `min q'x` subject to `A x + s = b`, `s` in a product of cones.
//!
//! A symmetric matrix enters as the vector of its upper triangle, column by column, off-diagonals times `sqrt 2`.
//! A block `F_0 + sum x_v F_v >= 0` gives the rows `-svec(F_v)` of `A` and `svec(F_0)` of `b`.

use std::f64::consts::SQRT_2;

use super::affine::Affine;
use super::balance::upper_triangle;
use super::scaled::{Block, Scaled};

/// A cone of slacks.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Cone {
    /// That many non-negative numbers.
    Positive(usize),
    /// A positive semidefinite matrix of that size.
    Semidefinite(usize),
}

/// The program; entries of `A` are (row, column, value).
#[derive(Clone, Debug, Default)]
pub(super) struct Program {
    pub(super) objective: Vec<f64>,
    pub(super) entries: Vec<(usize, usize, f64)>,
    pub(super) offsets: Vec<f64>,
    pub(super) cones: Vec<Cone>,
    /// For each block of the problem the rows of its diagonal.
    pub(super) diagonals: Vec<Vec<usize>>,
}

/// What a phase looks for.
#[derive(Clone, Copy, Debug)]
pub(super) enum Goal {
    /// The largest `t <= 1` with `F >= t I` for the strict blocks, or for all; with the objective at most `level`.
    Margin { level: Option<f64>, all: bool },
    /// The least objective.
    Least,
}

impl Program {
    /// Assembles the program of one phase; every `|xi_v| <= width`.
    pub(super) fn new(scaled: &Scaled, goal: Goal, width: f64) -> Self {
        let unknowns = scaled.unknowns();
        let mut program = Self::default();
        match goal {
            Goal::Margin { level, .. } => {
                program.objective = vec![0.0; unknowns + 1];
                program.objective[unknowns] = -1.0;
                // 1 - t >= 0
                program.push(&Affine { constant: 1.0, terms: vec![(unknowns, -1.0)] }, 1.0);
                if let Some(level) = level {
                    program.push_level(&scaled.objective, level);
                }
            }
            Goal::Least => {
                program.objective = vec![0.0; unknowns];
                for (index, value) in &scaled.objective.terms {
                    program.objective[*index] = *value;
                }
            }
        }
        for index in 0..unknowns {
            for sign in [1.0, -1.0] {
                // the offset stays one: a large one would loosen the solver's relative tolerances
                program.push(&Affine { constant: 1.0, terms: vec![(index, sign / width)] }, 1.0);
            }
        }
        program.push_blocks(scaled, goal);
        program
    }

    /// `level - objective >= 0`, of order one.
    fn push_level(&mut self, objective: &Affine, level: f64) {
        const LEAST: f64 = 1e-6;
        let size = level.abs().max(LEAST);
        let distance = Affine { constant: level, terms: Vec::new() };
        let row = Affine::combination([(1.0 / size, &distance), (-1.0 / size, objective)].into_iter());
        self.push(&row, 1.0);
    }

    fn push_blocks(&mut self, scaled: &Scaled, goal: Goal) {
        let margin = |block: &Block| match goal {
            Goal::Margin { all, .. } if all || block.strict => Some(scaled.unknowns()),
            _ => None,
        };
        self.diagonals = vec![Vec::new(); scaled.blocks.len()];
        for wanted in [true, false] {
            for (number, block) in scaled.blocks.iter().enumerate() {
                if (block.size == 1) != wanted {
                    continue;
                }
                for ((i, j), entry) in upper_triangle(block.size).zip(&block.upper) {
                    if i == j {
                        self.diagonals[number].push(self.offsets.len());
                        let mut entry = entry.clone();
                        entry.terms.extend(margin(block).map(|t| (t, -1.0)));
                        self.push(&entry, 1.0);
                    } else {
                        self.push(entry, SQRT_2);
                    }
                }
                if block.size > 1 {
                    self.cones.push(Cone::Semidefinite(block.size));
                }
            }
            if wanted {
                self.cones.push(Cone::Positive(self.offsets.len()));
            }
        }
    }

    fn push(&mut self, form: &Affine, factor: f64) {
        let row = self.offsets.len();
        self.entries.extend(form.terms.iter().map(|(index, value)| (row, *index, -factor * value)));
        self.offsets.push(factor * form.constant);
    }

    /// For each block the trace of its multiplier: how strongly it stops a larger margin.
    pub(super) fn multiplier_traces(&self, multipliers: &[f64]) -> Vec<f64> {
        let at = |row: &usize| multipliers.get(*row).copied().unwrap_or(0.0);
        self.diagonals.iter().map(|rows| rows.iter().map(at).sum()).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lmi::{Expr, Problem, Settings};
    use nalgebra::dmatrix;

    /// `X > 0` for `X = [x0, x1; x1, x2]` and the bound `5 - x2 >= 0`; all data are ones but the five.
    fn scaled() -> Scaled {
        let mut problem = Problem::new();
        let x = problem.symmetric("X", 2);
        let last = dmatrix![0.0, 1.0] * &x * dmatrix![0.0; 1.0];
        problem.strict("X > 0", "test", x.clone());
        problem.bound("x2 <= 5", "test", Expr::constant(&dmatrix![5.0]) - last);
        Scaled::new(&problem, &x.trace(), &Settings::default()).unwrap()
    }

    /// `b - A x` for one row.
    fn slack(program: &Program, row: usize, x: &[f64]) -> f64 {
        let of_row = program.entries.iter().filter(|entry| entry.0 == row);
        program.offsets[row] - of_row.map(|(_, column, value)| value * x[*column]).sum::<f64>()
    }

    #[test]
    fn slacks_are_the_triangle_with_weighted_off_diagonals_minus_the_margin() {
        let (scaled, x, t) = (scaled(), [2.0, 3.0, 4.0], 0.5);
        let program = Program::new(&scaled, Goal::Margin { level: None, all: false }, 10.0);
        let point = [&scaled.balanced_point(&x)[..], &[t]].concat();
        assert_eq!(program.cones, [Cone::Positive(8), Cone::Semidefinite(2)], "t, six sides, one bound, X");
        let rows = program.offsets.len();
        let upper: Vec<f64> = scaled.blocks[0].upper.iter().map(|entry| entry.value(&point)).collect();
        let found: Vec<f64> = (rows - 3..rows).map(|row| slack(&program, row, &point)).collect();
        assert_eq!(found, [upper[0] - t, SQRT_2 * upper[1], upper[2] - t], "x00 - t, sqrt 2 x01, x11 - t");
        assert_eq!(slack(&program, 0, &point), 0.5, "1 - t");
        let bound = scaled.blocks[1].upper[0].value(&point);
        assert_eq!(slack(&program, 7, &point), bound, "a bound has no margin");
    }

    #[test]
    fn a_level_limits_the_objective() {
        let scaled = scaled();
        let program = Program::new(&scaled, Goal::Margin { level: Some(4.0), all: false }, 10.0);
        let (below, above) = ([1.0, 0.0, 1.0, 0.0], [9.0, 0.0, 9.0, 0.0]);
        let value = |xi: &[f64]| (4.0 - scaled.objective.value(xi)) / 4.0;
        for xi in [below, above] {
            assert!((slack(&program, 1, &xi) - value(&xi)).abs() < 1e-15, "(level - objective) / |level|");
        }
    }

    #[test]
    fn traces_of_multipliers_are_sums_over_diagonals() {
        let program = Program::new(&scaled(), Goal::Margin { level: None, all: false }, 10.0);
        let multipliers: Vec<f64> = (0..program.offsets.len()).map(|row| row as f64).collect();
        assert_eq!(program.multiplier_traces(&multipliers), [8.0 + 10.0, 7.0], "rows 8 and 10 of X, row 7");
    }
}
