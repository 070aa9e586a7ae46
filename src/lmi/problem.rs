//! A problem: matrix variables and the inequalities that hold between them.

use std::ops::Range;

use super::affine::Affine;
use super::expression::Expr;

/// Matrix variables and inequalities.
///
/// Variables are expressions at once; constraints are symmetric expressions, `> 0` ([`Self::strict`]) or `>= 0`
/// ([`Self::bound`]). An inequality `< 0` is stated as the negative `> 0`.
#[derive(Clone, Debug, Default)]
pub struct Problem {
    variables: Vec<Variable>,
    constraints: Vec<Constraint>,
}

#[derive(Clone, Debug)]
struct Variable {
    name: String,
    end: usize,
}

#[derive(Clone, Debug)]
pub(super) struct Constraint {
    pub(super) name: String,
    pub(super) source: String,
    pub(super) strict: bool,
    pub(super) expression: Expr,
}

impl Problem {
    /// A problem without variables and constraints.
    pub fn new() -> Self {
        Self::default()
    }

    /// A new symmetric variable, `size x size`.
    pub fn symmetric(&mut self, name: impl Into<String>, size: usize) -> Expr {
        let first = self.add_variable(name.into(), size * (size + 1) / 2);
        Expr::from_fn(size, size, |i, j| {
            let (row, column) = (i.min(j), i.max(j));
            Affine::variable(first + column * (column + 1) / 2 + row)
        })
    }

    /// A new variable without structure, `rows x columns`.
    pub fn matrix(&mut self, name: impl Into<String>, rows: usize, columns: usize) -> Expr {
        let first = self.add_variable(name.into(), rows * columns);
        Expr::from_fn(rows, columns, |i, j| Affine::variable(first + i + j * rows))
    }

    /// A new scalar variable (1 x 1).
    pub fn scalar(&mut self, name: impl Into<String>) -> Expr {
        self.matrix(name, 1, 1)
    }

    /// Demands `expression > 0`: takes part in the margin, `expression >= t I` in balanced coordinates.
    ///
    /// `name` and `source` (paper, equation) tell a person which block stops an infeasible problem.
    ///
    /// # Panics
    /// When the expression is not square or has a variable of another problem.
    pub fn strict(&mut self, name: impl Into<String>, source: impl Into<String>, expression: Expr) {
        self.add_constraint(Constraint {
            name: name.into(),
            source: source.into(),
            strict: true,
            expression,
        });
    }

    /// Demands `expression >= 0` without a margin: bounds on gains and conditioning, signs.
    ///
    /// # Panics
    /// As [`Self::strict`].
    pub fn bound(&mut self, name: impl Into<String>, source: impl Into<String>, expression: Expr) {
        self.add_constraint(Constraint {
            name: name.into(),
            source: source.into(),
            strict: false,
            expression,
        });
    }

    /// The number of scalar variables.
    pub fn unknowns(&self) -> usize {
        self.variables.last().map_or(0, |last| last.end)
    }

    /// The size that decides the effort: rows of all upper triangles, `sum n (n + 1) / 2`.
    pub fn rows(&self) -> usize {
        let triangle = |constraint: &Constraint| {
            let size = constraint.expression.nrows();
            size * (size + 1) / 2
        };
        self.constraints.iter().map(triangle).sum()
    }

    pub(super) fn constraints(&self) -> &[Constraint] {
        &self.constraints
    }

    /// The entries of a point that belong to one variable, for each variable.
    pub(super) fn ranges(&self) -> impl Iterator<Item = Range<usize>> {
        let starts = std::iter::once(0).chain(self.variables.iter().map(|variable| variable.end));
        starts.zip(&self.variables).map(|(start, variable)| start..variable.end)
    }

    /// The name of the variable that an entry of a point belongs to.
    pub(super) fn name_of(&self, unknown: usize) -> &str {
        self.variables.iter().find(|variable| unknown < variable.end).map_or("", |variable| &variable.name)
    }

    fn add_variable(&mut self, name: String, count: usize) -> usize {
        let first = self.unknowns();
        self.variables.push(Variable { name, end: first + count });
        first
    }

    fn add_constraint(&mut self, constraint: Constraint) {
        let expression = &constraint.expression;
        assert!(
            expression.nrows() == expression.ncols(),
            "constraint {} is {} x {}, not square",
            constraint.name,
            expression.nrows(),
            expression.ncols()
        );
        assert!(
            expression.reach() <= self.unknowns(),
            "constraint {} has a variable of another problem",
            constraint.name
        );
        debug_assert!(is_symmetric(expression), "constraint {} is not symmetric", constraint.name);
        self.constraints.push(constraint);
    }
}

/// Whether the halves agree but for rounding; entries that are not finite are judged elsewhere.
fn is_symmetric(expression: &Expr) -> bool {
    const ROUNDING: f64 = 1e-6;
    let size = expression.nrows();
    let pairs = || (0..size).flat_map(|j| (0..j).map(move |i| (i, j)));
    let amount =
        |form: &Affine| form.terms.iter().fold(form.constant.abs(), |most, (_, c)| most.max(c.abs()));
    let largest = pairs().map(|(i, j)| amount(expression.entry(i, j))).fold(0.0, f64::max);
    pairs().all(|(i, j)| {
        let halves = [(1.0, expression.entry(i, j)), (-1.0, expression.entry(j, i))];
        let apart = amount(&Affine::combination(halves.into_iter()));
        apart.is_nan() || apart <= ROUNDING * largest
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::dmatrix;

    #[test]
    fn sizes_are_those_of_the_triangles() {
        let mut problem = Problem::new();
        let x = problem.symmetric("X", 3);
        let w = problem.matrix("W", 3, 0);
        let t = problem.scalar("t");
        problem.bound("gain", "test", Expr::symmetric(vec![vec![x, w], vec![Expr::zeros(0, 0)]]));
        problem.strict("t > 0", "test", t);
        assert_eq!(problem.unknowns(), 7, "six of X, none of W, t");
        assert_eq!(problem.rows(), 7, "3 * 4 / 2 + 1");
        let names: Vec<&str> = (0..8).map(|unknown| problem.name_of(unknown)).collect();
        assert_eq!(names, ["X", "X", "X", "X", "X", "X", "t", ""], "an empty variable owns nothing");
    }

    #[test]
    #[should_panic(expected = "constraint lemma is not symmetric")]
    fn a_forgotten_transpose_is_noticed() {
        let mut problem = Problem::new();
        let x = problem.symmetric("X", 2);
        problem.strict("lemma", "test", x * dmatrix![0.0, 1.0; -1.0, 0.0]);
    }

    #[test]
    #[should_panic(expected = "variable of another problem")]
    fn a_foreign_variable_is_noticed() {
        let x = Problem::new().scalar("x");
        Problem::new().strict("x > 0", "test", x);
    }
}
