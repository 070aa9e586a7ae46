//! The order of an observer: the matrix R whose image `R x` the observer's state has to complete.
#![expect(non_snake_case, reason = "matrix letters follow paper 000")]

use nalgebra::DMatrix;

use super::decoupled::{Decoupled, null_rows, scaled_to};
use crate::numerics::{NumericsError, RankDecision, Tolerance, rank, stack};
use crate::observer::Order;

/// A matrix `R` that does not fit.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum OrderError {
    /// Wrong number of columns.
    #[error(
        "R of subsystem {subsystem} has {found} columns, but {needed} are needed, one for each of its states"
    )]
    Columns {
        /// Name of the subsystem.
        subsystem: String,
        /// Columns of R.
        found: usize,
        /// States of the subsystem.
        needed: usize,
    },
    /// An infinite entry, or one that is not a number.
    #[error("R of subsystem {subsystem} has an entry that is not a finite number")]
    NotFinite {
        /// Name of the subsystem.
        subsystem: String,
    },
    /// Dependent rows.
    #[error("R of subsystem {subsystem} has rank {found}, but its {needed} rows must be independent: remove {}", needed - found)]
    RowRank {
        /// Name of the subsystem.
        subsystem: String,
        /// Its rank.
        found: usize,
        /// Its rows.
        needed: usize,
    },
    /// It does not complete what is known.
    #[error(
        "[R; Phi A; H] of subsystem {subsystem} has rank {found}, but {needed} is needed: R must complete what the outputs \
         and the algebraic equations tell; R = I always does"
    )]
    Incomplete {
        /// Name of the subsystem.
        subsystem: String,
        /// The rank.
        found: usize,
        /// States of the subsystem.
        needed: usize,
    },
    /// A decomposition failed.
    #[error(transparent)]
    Numerics(#[from] NumericsError),
}

/// `R` of an order.
///
/// ```text
/// full: R = I       reduced: rows of R span null H       minimal: rows of R span null [Phi A; H]
/// ```
///
/// [`Order::General`] has no meaning here and gives the full order.
///
/// # Shapes
/// beta x n with beta = n, n - rank H, n - rank [Phi A; H]; beta = 0 gives a static estimator.
///
/// # Errors
/// When a decomposition fails its check.
///
/// # Source
/// Paper 000, section IV B.
// ERRATUM(000, section IV): the orders n - m and n - r_phi - m hold only when H, or [Phi A; H], has full row rank.
pub fn chosen(
    decoupled: &Decoupled,
    order: Order,
    tolerance: &Tolerance,
) -> Result<DMatrix<f64>, NumericsError> {
    let Decoupled { H, .. } = decoupled;
    let n = decoupled.n_states();
    match order {
        Order::Full | Order::General => Ok(DMatrix::identity(n, n)),
        Order::Reduced => null_rows(&scaled_to(H, H), tolerance),
        Order::Minimal => null_rows(&known(decoupled), tolerance),
    }
}

/// `[Phi A; H]` with `A` and `H` scaled to norm one, which changes no rank.
fn known(decoupled: &Decoupled) -> DMatrix<f64> {
    let Decoupled { Phi_A, A_bar, H, .. } = decoupled;
    let data = if A_bar.norm() > Phi_A.norm() { A_bar } else { Phi_A };
    stack(&[&scaled_to(Phi_A, data), &scaled_to(H, H)])
}

/// Checks a matrix `R` that a person gives.
///
/// # Errors
/// [`OrderError`], with what was found and what is needed.
///
/// # Source
/// Paper 000, section IV B: `R_i` of full row rank, `rank Sigma_i = n_i`.
// ERRATUM(000, before eq. 23): "rank Sigma_i = n_ii" is n_i.
pub fn check(
    subsystem: &str,
    R: &DMatrix<f64>,
    decoupled: &Decoupled,
    tolerance: &Tolerance,
) -> Result<RankDecision, OrderError> {
    let n = decoupled.n_states();
    let subsystem = subsystem.to_owned();
    if R.nrows() > 0 && R.ncols() != n {
        return Err(OrderError::Columns { subsystem, found: R.ncols(), needed: n });
    }
    if R.iter().any(|x| !x.is_finite()) {
        return Err(OrderError::NotFinite { subsystem });
    }
    let rows = rank(R, 0.0, tolerance)?;
    if rows.rank < R.nrows() {
        return Err(OrderError::RowRank { subsystem, found: rows.rank, needed: R.nrows() });
    }
    let complete = completion(R, decoupled, tolerance)?;
    if complete.rank < n {
        return Err(OrderError::Incomplete { subsystem, found: complete.rank, needed: n });
    }
    Ok(complete)
}

/// Rank of `Sigma = [R; Phi A; H]`, which must be n.
///
/// # Errors
/// When a decomposition fails its check.
pub(super) fn completion(
    R: &DMatrix<f64>,
    decoupled: &Decoupled,
    tolerance: &Tolerance,
) -> Result<RankDecision, NumericsError> {
    let R = if R.nrows() == 0 { DMatrix::zeros(0, decoupled.n_states()) } else { scaled_to(R, R) };
    rank(&stack(&[&R, &known(decoupled)]), 0.0, tolerance)
}
