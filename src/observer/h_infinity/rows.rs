//! The matrix `R`: given by a person or chosen by the order, and judged before it is used.
#![expect(non_snake_case, reason = "matrix letters follow paper 002")]

use nalgebra::DMatrix;

use super::parameterisation::default_rows;
use super::plant::Plant;
use crate::numerics::{NumericsError, RankDecision, Tolerance, rank, stack};
use crate::observer::DesignChoice;

/// `R` with the two ranks that it has to have.
#[derive(Clone, Debug)]
pub(super) struct Rows {
    pub(super) R: DMatrix<f64>,
    /// Whether a person gave it.
    pub(super) given: bool,
    /// Rank of `R`; its rows have to be independent.
    pub(super) own: RankDecision,
    /// Rank of `[R; Phi A; C]`; n is needed.
    pub(super) sigma: RankDecision,
}

impl Rows {
    /// The rows of a choice; `Err` holds the reason in words when they do not fit the plant at all.
    ///
    /// # Errors
    /// When a decomposition fails its check.
    pub(super) fn of(
        plant: &Plant,
        choice: &DesignChoice,
        tolerance: &Tolerance,
    ) -> Result<Result<Self, String>, NumericsError> {
        let given = choice.lmi.rows.first();
        let R = match given {
            Some(R) => R.clone(),
            None => default_rows(plant, choice.order, tolerance)?,
        };
        let n = plant.n();
        if R.ncols() != n {
            let (q, columns) = R.shape();
            return Ok(Err(format!("R is {q} x {columns}, but it needs {n} columns, one for each state")));
        }
        if let Some(at) = R.iter().position(|x| !x.is_finite()) {
            let (row, column) = (at % R.nrows() + 1, at / R.nrows() + 1);
            return Ok(Err(format!("R[{row}, {column}] is not a finite number")));
        }
        let own = rank(&R, 0.0, tolerance)?;
        let sigma = rank(&stack(&[&R, &plant.known()]), 0.0, tolerance)?;
        Ok(Ok(Self { R, given: given.is_some(), own, sigma }))
    }

    /// Why the rows cannot be used; `None` when they can.
    pub(super) fn refusal(&self, n: usize) -> Option<String> {
        let q = self.R.nrows();
        if self.own.rank < q {
            return Some(format!(
                "R has {q} rows but rank {}: its rows have to be independent (R = I always works)",
                self.own.rank
            ));
        }
        (self.sigma.rank < n).then(|| {
            format!(
                "rank [R; Phi A; C] = {}, but {n} is needed: add rows to R that see the {} missing directions (R = I \
                 always works)",
                self.sigma.rank,
                n - self.sigma.rank
            )
        })
    }
}
