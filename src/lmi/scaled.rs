//! A problem in balanced coordinates: checked, symmetrised, scaled by powers of two.

use nalgebra::DMatrix;

use super::affine::Affine;
use super::balance::{Triangle, balance, upper_triangle};
use super::expression::Expr;
use super::problem::Problem;
use super::solution::{Settings, Stop};
use crate::numerics::eigenvalues;

/// One constraint `D F(S xi) D`, its upper triangle column by column.
#[derive(Clone, Debug)]
pub(super) struct Block {
    /// Number of the constraint in the problem.
    pub(super) constraint: usize,
    pub(super) strict: bool,
    pub(super) size: usize,
    pub(super) upper: Vec<Affine>,
}

/// All constraints and the objective in balanced coordinates.
#[derive(Clone, Debug)]
pub(super) struct Scaled {
    pub(super) blocks: Vec<Block>,
    pub(super) objective: Affine,
    variables: Vec<i32>,
    objective_exponent: i32,
}

impl Scaled {
    /// Checks size and finiteness, then balances. Constraints without rows are left out.
    pub(super) fn new(problem: &Problem, objective: &Expr, settings: &Settings) -> Result<Self, Stop> {
        check_size(problem, settings)?;
        let mut blocks = Vec::new();
        for (number, constraint) in problem.constraints().iter().enumerate() {
            let size = constraint.expression.nrows();
            let upper: Vec<Affine> = upper_triangle(size)
                .map(|(i, j)| {
                    let halves =
                        [(0.5, constraint.expression.entry(i, j)), (0.5, constraint.expression.entry(j, i))];
                    Affine::combination(halves.into_iter())
                })
                .collect();
            if !upper.iter().all(Affine::is_finite) {
                return Err(not_finite(&format!("{} ({})", constraint.name, constraint.source)));
            }
            if size > 0 {
                blocks.push(Block { constraint: number, strict: constraint.strict, size, upper });
            }
        }
        let objective = objective.entry(0, 0);
        if !objective.is_finite() {
            return Err(not_finite("The objective"));
        }
        let scaled = Self::balanced(blocks, objective, problem.unknowns());
        // beyond this the solver's arithmetic cannot tell a solution from none
        const LARGEST: f64 = 1e12;
        let fits = |entry: &Affine| {
            entry.is_finite() && entry.constant.abs().max(entry.largest_coefficient()) <= LARGEST
        };
        if scaled.blocks.iter().all(|block| block.upper.iter().all(fits)) && fits(&scaled.objective) {
            Ok(scaled)
        } else {
            let why = "The numbers of the inequalities span more than double precision holds, in whatever units: \
                       look for an entry that is far larger or smaller than the others";
            Err(Stop::GaveUp(why.to_owned()))
        }
    }

    fn balanced(mut blocks: Vec<Block>, objective: &Affine, unknowns: usize) -> Self {
        let triangles: Vec<Triangle<'_>> =
            blocks.iter().map(|block| Triangle { size: block.size, upper: &block.upper }).collect();
        let found = balance(&triangles, unknowns);
        for (block, rows) in blocks.iter_mut().zip(&found.rows) {
            for ((i, j), entry) in upper_triangle(block.size).zip(&mut block.upper) {
                *entry = scale(entry, rows[i] + rows[j], &found.variables);
            }
        }
        let plain = scale(objective, 0, &found.variables);
        let objective_exponent = exponent_of(plain.largest_coefficient());
        let objective = scale(objective, -objective_exponent, &found.variables);
        Self { blocks, objective, variables: found.variables, objective_exponent }
    }

    /// The same problem in coordinates in which a point and the blocks at it are of order one.
    ///
    /// The variables of one matrix keep their ratios.
    pub(super) fn centred(&self, problem: &Problem, xi: &[f64]) -> Self {
        let exponents = self.sizes(problem, xi);
        let blocks = self.blocks.iter().map(|block| block.centred(xi, &exponents)).collect();
        let plain = scale(&self.objective, 0, &exponents);
        let shift = exponent_of(plain.largest_coefficient());
        Self {
            blocks,
            objective: scale(&plain, -shift, &vec![0; exponents.len()]),
            variables: self.variables.iter().zip(&exponents).map(|(old, new)| old + new).collect(),
            objective_exponent: self.objective_exponent + shift,
        }
    }

    /// For each variable the exponent of the largest entry of its matrix.
    fn sizes(&self, problem: &Problem, xi: &[f64]) -> Vec<i32> {
        let mut exponents = vec![0; self.unknowns()];
        for range in problem.ranges() {
            let largest =
                xi.get(range.clone()).unwrap_or_default().iter().fold(0.0_f64, |most, x| most.max(x.abs()));
            if let Some(of_matrix) = exponents.get_mut(range) {
                of_matrix.fill(exponent_of(largest));
            }
        }
        exponents
    }

    pub(super) fn unknowns(&self) -> usize {
        self.variables.len()
    }

    /// `xi = S^-1 x`.
    pub(super) fn balanced_point(&self, x: &[f64]) -> Vec<f64> {
        x.iter().zip(&self.variables).map(|(x, exponent)| times_power(*x, -exponent)).collect()
    }

    /// `x = S xi`.
    pub(super) fn original(&self, xi: &[f64]) -> Vec<f64> {
        xi.iter().zip(&self.variables).map(|(x, exponent)| times_power(*x, *exponent)).collect()
    }

    /// A value of the balanced objective in the units of the original one.
    pub(super) fn original_objective(&self, balanced: f64) -> f64 {
        times_power(balanced, self.objective_exponent)
    }

    /// The smallest eigenvalue over the strict blocks, or over the others; infinite when there are none, negative
    /// infinity when an eigenvalue cannot be computed.
    pub(super) fn smallest_eigenvalue(&self, xi: &[f64], strict: bool) -> f64 {
        let chosen = self.blocks.iter().filter(|block| block.strict == strict);
        chosen.map(|block| block.smallest_eigenvalue(xi)).fold(f64::INFINITY, f64::min)
    }
}

impl Block {
    /// `D F D` with ones on the diagonal at `xi`, the variables `2^exponents` larger.
    fn centred(&self, xi: &[f64], exponents: &[i32]) -> Self {
        let diagonal = upper_triangle(self.size).zip(&self.upper).filter(|((i, j), _)| i == j);
        // half the exponent, up or down: D^2 is a power of four
        let rows: Vec<i32> = diagonal.map(|(_, entry)| -exponent_of(entry.value(xi)).div_euclid(2)).collect();
        let scaled = upper_triangle(self.size).zip(&self.upper);
        let upper = scaled.map(|((i, j), entry)| scale(entry, rows[i] + rows[j], exponents)).collect();
        Self { upper, ..*self }
    }

    fn smallest_eigenvalue(&self, xi: &[f64]) -> f64 {
        let mut matrix = DMatrix::zeros(self.size, self.size);
        for ((i, j), entry) in upper_triangle(self.size).zip(&self.upper) {
            let value = entry.value(xi);
            matrix[(i, j)] = value;
            matrix[(j, i)] = value;
        }
        eigenvalues(&matrix).map_or(f64::NEG_INFINITY, |found| {
            found.iter().map(|lambda| lambda.re).fold(f64::INFINITY, f64::min)
        })
    }
}

fn check_size(problem: &Problem, settings: &Settings) -> Result<(), Stop> {
    let rows = problem.rows();
    if rows <= settings.most_rows {
        return Ok(());
    }
    let limit = settings.most_rows;
    Err(Stop::GaveUp(format!(
        "The inequalities have {rows} rows (upper triangles of all blocks), the limit is {limit}: reduce the order, \
         divide the plant into subsystems or raise the limit"
    )))
}

fn not_finite(what: &str) -> Stop {
    Stop::GaveUp(format!("{what} has an entry that is not finite: check the matrices it is made from"))
}

/// The form with its variables replaced by `2^variables[v] xi_v`, all times `2^exponent`.
fn scale(form: &Affine, exponent: i32, variables: &[i32]) -> Affine {
    let term = |(index, value): &(usize, f64)| (*index, times_power(*value, exponent + variables[*index]));
    Affine {
        constant: times_power(form.constant, exponent),
        terms: form.terms.iter().map(term).filter(|(_, value)| *value != 0.0).collect(),
    }
}

/// The nearest power of two, as its exponent; zero for what has none.
fn exponent_of(x: f64) -> i32 {
    const MOST: f64 = 100.0;
    let log = x.abs().log2();
    #[expect(clippy::cast_possible_truncation, reason = "clamped to +-100")]
    let exponent = log.clamp(-MOST, MOST).round() as i32;
    if log.is_finite() { exponent } else { 0 }
}

/// `x 2^exponent` without overflow on the way.
fn times_power(x: f64, exponent: i32) -> f64 {
    let half = exponent / 2;
    x * f64::exp2(f64::from(half)) * f64::exp2(f64::from(exponent - half))
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::dmatrix;

    /// `[x0 + 3e8, 1e4 x1; ., x2]` and the objective `1e6 x0`.
    fn problem() -> (Problem, Expr) {
        let mut problem = Problem::new();
        let x = problem.symmetric("X", 2);
        let units = dmatrix![1.0, 0.0; 0.0, 1e4];
        let block = &units * &x * &units + Expr::constant(&dmatrix![3e8, 0.0; 0.0, 0.0]);
        problem.strict("block", "test", block);
        let first = dmatrix![1.0, 0.0] * x * dmatrix![1.0; 0.0];
        (problem, first.scaled(1e6))
    }

    fn inertia(scaled: &Scaled, x: &[f64]) -> bool {
        scaled.smallest_eigenvalue(&scaled.balanced_point(x), true) > 0.0
    }

    #[test]
    fn balancing_and_centring_keep_what_is_feasible_and_the_objective() {
        let (problem, objective) = problem();
        let plain = Scaled::new(&problem, &objective, &Settings::default()).unwrap();
        let centre = [2e3, 0.1, 40.0];
        let centred = plain.centred(&problem, &plain.balanced_point(&centre));
        for scaled in [&plain, &centred] {
            assert_eq!(
                scaled.original(&scaled.balanced_point(&centre)),
                centre,
                "powers of two round nothing"
            );
            assert!(inertia(scaled, &[0.0, 1e3, 1.0]), "3e8 * 1e8 > (1e3 * 1e4)^2");
            assert!(!inertia(scaled, &[0.0, 2e4, 1.0]), "3e8 * 1e8 < (2e4 * 1e4)^2");
            let value = scaled.original_objective(scaled.objective.value(&scaled.balanced_point(&centre)));
            assert_eq!(value, 2e9, "1e6 * 2e3");
        }
        let xi = centred.balanced_point(&centre);
        let matrix = centred.blocks[0].upper.iter().map(|entry| entry.value(&xi)).collect::<Vec<_>>();
        assert!(
            xi.iter().all(|x| x.abs() <= 2.0)
                && [matrix[0], matrix[2]].iter().all(|x| (0.25..=4.0).contains(x)),
            "the centre {xi:?} and its diagonal {matrix:?} are of order one"
        );
    }

    #[test]
    fn numbers_that_no_units_bring_together_are_refused() {
        let mut problem = Problem::new();
        let x = problem.scalar("x");
        let block = Expr::symmetric(vec![
            vec![x.clone() + Expr::identity(1), x.scaled(1e90)],
            vec![x.clone() + Expr::identity(1)],
        ]);
        problem.strict("block", "test", block);
        let Err(Stop::GaveUp(why)) = Scaled::new(&problem, &x, &Settings::default()) else {
            panic!("1e90 x beside x and 1");
        };
        assert!(why.contains("far larger"), "{why}");
    }
}
