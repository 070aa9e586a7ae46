//! Power-of-two balancing of a whole problem, so that its data are of order one.
//!
//! Each block `F = F_0 + sum x_v F_v` is replaced by `D F D` with a positive diagonal `D`, each variable by
//! `x_v = s_v xi_v`. Both keep what is feasible and, being powers of two, round nothing.
//!
//! # Source
//! Curtis and Reid, "On the automatic scaling of matrices for Gaussian elimination", 1972: the logarithms of all
//! coefficients are made small in the sense of least squares. The result does not depend on the units of the states,
//! inputs and outputs that the inequalities were made from, whatever their spread.

use super::affine::Affine;

/// Exponents of two: `D = diag(2^rows)` for each block, `s_v = 2^variables[v]`.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Balance {
    pub(super) rows: Vec<Vec<i32>>,
    pub(super) variables: Vec<i32>,
}

/// The upper triangle of a block, column by column.
pub(super) struct Triangle<'a> {
    pub(super) size: usize,
    pub(super) upper: &'a [Affine],
}

/// Places `(row, column)` of an upper triangle, column by column.
pub(super) fn upper_triangle(size: usize) -> impl Iterator<Item = (usize, usize)> {
    (0..size).flat_map(|j| (0..=j).map(move |i| (i, j)))
}

/// One coefficient: `2^log` at (row, column), times a variable or constant.
struct Coefficient {
    row: usize,
    column: usize,
    variable: Option<usize>,
    log: f64,
    counts: bool,
}

/// Finds the balance of a problem with finite data.
pub(super) fn balance(blocks: &[Triangle<'_>], variables: usize) -> Balance {
    let sizes: Vec<usize> = blocks.iter().map(|block| block.size).collect();
    let rows: usize = sizes.iter().sum();
    let mut coefficients = coefficients(blocks, rows);
    // a pull to zero fixes what the coefficients leave open
    let first = least_squares(&coefficients, rows + variables);
    // rounding noise of the data must not weigh as much as the data
    const NOISE: f64 = -26.0;
    for coefficient in &mut coefficients {
        coefficient.counts = coefficient.after(&first) > NOISE;
    }
    let logs = least_squares(&coefficients, rows + variables);
    const MOST: f64 = 500.0;
    #[expect(clippy::cast_possible_truncation, reason = "clamped to +-500")]
    let exponents: Vec<i32> = logs.iter().map(|log| log.clamp(-MOST, MOST).round() as i32).collect();
    let (of_rows, of_variables) = exponents.split_at(rows);
    let mut rest = of_rows;
    let rows = sizes
        .iter()
        .map(|size| {
            let (block, after) = rest.split_at(*size);
            rest = after;
            block.to_vec()
        })
        .collect();
    Balance { rows, variables: of_variables.to_vec() }
}

fn coefficients(blocks: &[Triangle<'_>], rows: usize) -> Vec<Coefficient> {
    let mut found = Vec::new();
    let mut start = 0;
    for block in blocks {
        for ((i, j), entry) in upper_triangle(block.size).zip(block.upper) {
            let (row, column) = (start + i, start + j);
            let mut add = |variable, value: f64| {
                let log = value.abs().log2();
                if log.is_finite() {
                    found.push(Coefficient { row, column, variable, log, counts: true });
                }
            };
            add(None, entry.constant);
            for (variable, value) in &entry.terms {
                add(Some(rows + variable), *value);
            }
        }
        start += block.size;
    }
    found
}

impl Coefficient {
    /// The logarithm after scaling by `2^logs`.
    fn after(&self, logs: &[f64]) -> f64 {
        self.log + self.along(logs)
    }

    fn along(&self, logs: &[f64]) -> f64 {
        logs[self.row] + logs[self.column] + self.variable.map_or(0.0, |variable| logs[variable])
    }

    fn spread(&self, amount: f64, over: &mut [f64]) {
        over[self.row] += amount;
        over[self.column] += amount;
        if let Some(variable) = self.variable {
            over[variable] += amount;
        }
    }
}

/// `min sum (log + z_row + z_column + z_variable)^2 + PULL |z|^2` by conjugate gradients on the normal equations.
fn least_squares(coefficients: &[Coefficient], unknowns: usize) -> Vec<f64> {
    const PULL: f64 = 1e-6;
    const STEPS: usize = 300;
    const ENOUGH: f64 = 1e-10;
    let counting = || coefficients.iter().filter(|coefficient| coefficient.counts);
    let mut z = vec![0.0; unknowns];
    let mut residual = vec![0.0; unknowns];
    for coefficient in counting() {
        coefficient.spread(-coefficient.log, &mut residual);
    }
    let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(x, y)| x * y).sum::<f64>();
    let mut direction = residual.clone();
    let mut size = dot(&residual, &residual);
    let begin = size;
    for _ in 0..STEPS {
        if size <= ENOUGH * begin {
            break;
        }
        let mut image: Vec<f64> = direction.iter().map(|x| PULL * x).collect();
        for coefficient in counting() {
            coefficient.spread(coefficient.along(&direction), &mut image);
        }
        let step = size / dot(&direction, &image);
        z.iter_mut().zip(&direction).for_each(|(x, d)| *x += step * d);
        residual.iter_mut().zip(&image).for_each(|(x, d)| *x -= step * d);
        let next = dot(&residual, &residual);
        direction.iter_mut().zip(&residual).for_each(|(d, r)| *d = r + next / size * *d);
        size = next;
    }
    z
}

#[cfg(test)]
mod tests {
    use super::*;

    fn form(constant: f64, terms: &[(usize, f64)]) -> Affine {
        Affine { constant, terms: terms.to_vec() }
    }

    /// `[x1, x2; x2, x3 + 1]` in units `t` of the rows: every coefficient is `t_i t_j`.
    #[test]
    fn units_of_the_rows_are_undone() {
        let (t, u) = (2.0_f64.powi(-20), 2.0_f64.powi(17));
        let upper = [form(0.0, &[(0, t * t)]), form(0.0, &[(1, t * u)]), form(u * u, &[(2, u * u)])];
        let found = balance(&[Triangle { size: 2, upper: &upper }], 3);
        let d = &found.rows[0];
        let v = &found.variables;
        let after = [2 * d[0] + v[0] - 40, d[0] + d[1] + v[1] - 3, 2 * d[1] + v[2] + 34, 2 * d[1] + 34];
        assert!(after.iter().all(|x| x.abs() <= 1), "exponents after balancing {after:?}, found {found:?}");
    }

    #[test]
    fn rounding_noise_does_not_move_the_balance() {
        let clean = [form(1.0, &[(0, 1.0)]), form(0.0, &[(1, 1.0)]), form(1.0, &[(0, 2.0)])];
        let mut noisy = clean.clone();
        noisy[1] = form(1e-17, &[(1, 1.0)]);
        let of = |upper: &[Affine]| balance(&[Triangle { size: 2, upper }], 2);
        assert_eq!(of(&noisy), of(&clean), "an entry of 1e-17 among ones is noise");
    }

    #[test]
    fn nothing_to_balance_gives_ones() {
        let found = balance(&[Triangle { size: 1, upper: &[form(0.0, &[])] }], 1);
        assert_eq!(found, Balance { rows: vec![vec![0]], variables: vec![0] }, "zero data");
        assert_eq!(balance(&[], 0), Balance { rows: vec![], variables: vec![] }, "no data");
    }
}
