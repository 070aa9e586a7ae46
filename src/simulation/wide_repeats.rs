//! Equations that repeat others: they are found and left out, and what is left of them is reported.
#![expect(non_snake_case, reason = "matrix letters of the canonical form")]

use nalgebra::{DMatrix, DVector};

use super::{SimulationError, Trajectory, Uncertainty};
use crate::numerics::{NumericsError, Tolerance, side_by_side, subspaces};
use crate::observer::input_decoupled::Coordinates;
use crate::system::{DescriptorSystem, LipschitzTerm, Model};

/// Equations of a plant that follow from its other ones.
///
/// ```text
/// W' [E A B D G] = 0        W = combinations;  the rows on which W can be solved for are left out
/// ```
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Repeats {
    /// The equations that are left out, from zero, ascending.
    rows: Vec<usize>,
    /// `W`, e x rows.
    combinations: DMatrix<f64>,
}

impl Default for Repeats {
    fn default() -> Self {
        Self { rows: Vec::new(), combinations: DMatrix::zeros(0, 0) }
    }
}

impl Repeats {
    /// Finds them.
    ///
    /// # Tolerance
    /// The rank of `[A4 D2]`, relative to the norm of `[A D]`, and that of `W' [A B D G]`, relative to the norm of
    /// `[A B D G]`.
    ///
    /// # Errors
    /// When a decomposition fails its check.
    pub(super) fn of(model: &Model, at: &Coordinates, tolerance: &Tolerance) -> Result<Self, NumericsError> {
        let DescriptorSystem { A, B, D, .. } = &model.system;
        let size = side_by_side(&[A, D]).norm();
        let tied = at.M2.tr_mul(&subspaces(&at.algebraic(), size, tolerance)?.left_null);
        if tied.ncols() == 0 {
            return Ok(Self::default());
        }
        let mut all = side_by_side(&[A, B, D]);
        if let Some(term) = fitting(model) {
            all = side_by_side(&[&all, &term.G]);
        }
        let combinations = &tied * subspaces(&tied.tr_mul(&all), all.norm(), tolerance)?.left_null;
        Ok(Self { rows: solvable(&combinations), combinations })
    }

    /// The plant without them.
    pub(super) fn left_out(&self, model: &Model) -> Model {
        if self.rows.is_empty() {
            return model.clone();
        }
        let mut model = model.clone();
        let system = &mut model.system;
        for matrix in [&mut system.E, &mut system.A, &mut system.B, &mut system.D] {
            *matrix = self.rows_left_out(matrix);
        }
        if let Some(term) = &mut model.lipschitz {
            term.G = self.rows_left_out(&term.G);
        }
        model
    }

    /// A matrix with a row for each equation, without those of the equations that are left out.
    pub(super) fn rows_left_out(&self, matrix: &DMatrix<f64>) -> DMatrix<f64> {
        let kept: Vec<usize> = (0..matrix.nrows()).filter(|row| !self.rows.contains(row)).collect();
        DMatrix::from_fn(kept.len(), matrix.ncols(), |i, j| matrix[(kept[i], j)])
    }

    /// Refuses uncertain entries that would make an equation differ from those that it repeats.
    ///
    /// # Errors
    /// [`SimulationError::UncertainRepeats`]; a malformed uncertainty.
    pub(super) fn check(&self, uncertainty: &Uncertainty, A: &DMatrix<f64>) -> Result<(), SimulationError> {
        const PART: f64 = 1e-9;
        let takes_part =
            |row: usize| !self.rows.is_empty() && self.combinations.row(row).iter().any(|x| x.abs() > PART);
        let varying = uncertainty.varying(A)?;
        match varying.iter().find(|entry| takes_part(entry.row)) {
            None => Ok(()),
            Some(entry) => Err(SimulationError::UncertainRepeats {
                equations: self.named(),
                entry: format!("A[{}, {}]", entry.row + 1, entry.column + 1),
            }),
        }
    }

    /// What a person should know of them, with what is left of them along a motion; `None` when there are none.
    pub(super) fn remark(&self, system: &DescriptorSystem, motion: &Trajectory) -> Option<String> {
        let DescriptorSystem { A, B, D, .. } = system;
        if self.rows.is_empty() {
            return None;
        }
        // W' E = 0: nothing of the derivative is left
        let right = A * &motion.x + B * &motion.u + D * &motion.d;
        let left = self.combinations.tr_mul(&right).iter().fold(0.0, |l: f64, x| l.max(x.abs()));
        let (follow, are) = if self.rows.len() == 1 { ("follows", "is") } else { ("follow", "are") };
        Some(format!(
            "{} {follow} from the others and {are} left out; along the motion the difference is at most {left:.1e}",
            self.named()
        ))
    }

    /// `equation 3`, `equations 3, 4`.
    fn named(&self) -> String {
        let numbers: Vec<String> = self.rows.iter().map(|row| (row + 1).to_string()).collect();
        let word = if numbers.len() == 1 { "equation" } else { "equations" };
        format!("{word} {}", numbers.join(", "))
    }
}

/// As many rows as there are columns on which the columns are independent, ascending; of rows that serve about as well the
/// last, since a person adds below.
fn solvable(columns: &DMatrix<f64>) -> Vec<usize> {
    const ABOUT: f64 = 0.1;
    let mut rest = columns.clone();
    let mut rows = Vec::new();
    for _ in 0..columns.ncols() {
        let sizes: Vec<f64> = rest.row_iter().map(|row| row.norm()).collect();
        let largest = sizes.iter().fold(0.0, |l: f64, x| l.max(*x));
        let Some(row) = sizes.iter().rposition(|x| *x > 0.0 && *x >= ABOUT * largest) else { break };
        // what this row determines is taken from the others
        let direction = rest.row(row).transpose() / sizes[row];
        rest -= &rest * &direction * direction.transpose();
        rest.row_mut(row).fill(0.0);
        rows.push(row);
    }
    rows.sort_unstable();
    rows
}

/// The nonlinearity, where its `G` has a row for each equation.
fn fitting(model: &Model) -> Option<&LipschitzTerm> {
    model.lipschitz.as_ref().filter(|term| term.G.nrows() == model.system.n_equations())
}

/// How many combinations of the algebraic equations contain neither `x2` nor `d` and are no repetition of others, and the
/// largest of them at the start; not a number where the start does not fit the plant.
pub(super) fn violation(
    model: &Model,
    at: &Coordinates,
    (x0, u0): (&DVector<f64>, &DVector<f64>),
    tolerance: &Tolerance,
) -> Result<(usize, f64), NumericsError> {
    let DescriptorSystem { E, A, B, D, .. } = &model.system;
    let size = side_by_side(&[A, D]).norm();
    let tied = at.M2.tr_mul(&subspaces(&at.algebraic(), size, tolerance)?.left_null);
    let mut all = side_by_side(&[A, B, D]);
    if let Some(term) = fitting(model) {
        all = side_by_side(&[&all, &term.G]);
    }
    let found = subspaces(&tied.tr_mul(&all), all.norm(), tolerance)?;
    let combinations = found.rank.rank;
    if x0.len() != E.ncols() || u0.len() != B.ncols() {
        return Ok((combinations, f64::NAN));
    }
    let x1 = &at.N1 * (&at.M1 * E * x0);
    let mut left = A * x1 + B * u0;
    if let Some(term) = fitting(model) {
        left += &term.G * term.value(0.0, x0);
    }
    let left = (tied * found.range).tr_mul(&left);
    Ok((combinations, left.iter().fold(0.0, |largest: f64, x| largest.max(x.abs()))))
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::dmatrix;

    #[test]
    fn the_later_one_of_two_equal_equations_is_left_out() {
        assert_eq!(solvable(&dmatrix![0.0; 2.0; -1.0]), [2], "three times, nothing to choose but the last");
        assert_eq!(solvable(&dmatrix![1.0; 1.0; 1e-9]), [1], "what hardly takes part cannot be solved for");
        let two = dmatrix![0.0, 0.0; 1.0, 0.0; 1.0, 1.0; 0.0, 1.0];
        assert_eq!(solvable(&two), [2, 3], "two combinations, two rows");
    }
}
