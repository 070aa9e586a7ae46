//! Everything that is decided about one subsystem before its inequality is solved.
#![expect(non_snake_case, reason = "matrix letters follow paper 000")]

use nalgebra::DMatrix;

use super::columns::{ColumnError, by_hand, greedy};
use super::order::{self, OrderError};
use super::{Decoupled, LocalProblem, Parameterisation, extended};
use crate::numerics::{Complex64, NumericsError, StabilityRegion, Tolerance, observable_quotient};
use crate::observer::DesignChoice;
use crate::system::properties::PropertyError;

/// A subsystem with its decoupled columns, its order and all its observers.
#[derive(Clone, Debug)]
pub struct Setup {
    /// The subsystem.
    pub problem: LocalProblem,
    /// Positions in [`LocalProblem::sources`] of the exactly decoupled columns.
    pub exact: Vec<usize>,
    /// The subsystem after the exact decoupling.
    pub decoupled: Decoupled,
    /// All observers of the chosen order.
    pub family: Parameterisation,
    /// Eigenvalues of `N` that no free gain moves.
    pub fixed_modes: Vec<Complex64>,
}

/// A choice that does not fit its subsystem.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum SetupError {
    /// Columns that cannot be decoupled.
    #[error(transparent)]
    Columns(#[from] ColumnError),
    /// A matrix R that does not fit.
    #[error(transparent)]
    Order(#[from] OrderError),
    /// The choice has lists for another number of subsystems.
    #[error("{what} is given for {found} subsystems, but there are {needed}")]
    Count {
        /// The list.
        what: &'static str,
        /// Its length.
        found: usize,
        /// Number of subsystems.
        needed: usize,
    },
    /// A decomposition failed.
    #[error(transparent)]
    Property(#[from] PropertyError),
}

impl From<NumericsError> for SetupError {
    fn from(error: NumericsError) -> Self {
        Self::Property(error.into())
    }
}

/// Checks that the lists of a choice have an entry for each subsystem.
///
/// # Errors
/// [`SetupError::Count`].
pub(super) fn check_counts(choice: &DesignChoice, subsystems: usize) -> Result<(), SetupError> {
    let rows = choice.lmi.rows.len();
    let decoupled = choice.lmi.decoupled.as_ref().map_or(subsystems, Vec::len);
    let lists =
        [("R", if rows == 0 { subsystems } else { rows }), ("the list of decoupled states", decoupled)];
    match lists.into_iter().find(|(_, found)| *found != subsystems) {
        Some((what, found)) => Err(SetupError::Count { what, found, needed: subsystems }),
        None => Ok(()),
    }
}

/// The columns that a choice decouples exactly in one subsystem: by hand, or as many as the conditions allow.
///
/// # Errors
/// States that cannot be named, or a decomposition that fails its check.
pub fn exact_columns(
    problem: &LocalProblem,
    number: usize,
    choice: &DesignChoice,
    tolerance: &Tolerance,
) -> Result<Vec<usize>, SetupError> {
    match &choice.lmi.decoupled {
        Some(lists) => Ok(by_hand(problem, lists.get(number).map_or(&[], Vec::as_slice))?),
        None => Ok(greedy(problem, tolerance)?),
    }
}

impl Setup {
    /// Prepares the subsystem with the given number, from zero.
    ///
    /// # Errors
    /// [`SetupError`]: columns or a matrix `R` that do not fit.
    pub fn new(
        problem: &LocalProblem,
        number: usize,
        choice: &DesignChoice,
        tolerance: &Tolerance,
    ) -> Result<Self, SetupError> {
        let exact = exact_columns(problem, number, choice, tolerance)?;
        let decoupled = Decoupled::new(problem, &exact, tolerance)?;
        let R = match choice.lmi.rows.get(number) {
            Some(R) => {
                order::check(&problem.name, R, &decoupled, tolerance)?;
                if R.nrows() == 0 { DMatrix::zeros(0, problem.n_states()) } else { R.clone() }
            }
            None => order::chosen(&decoupled, choice.order, tolerance)?,
        };
        let family = if choice.lmi.alternative {
            extended(&decoupled, &R, tolerance)?
        } else {
            Parameterisation::paper(&decoupled, &R, tolerance)?
        };
        let fixed_modes = observable_quotient(&family.Lambda_N, &family.L_N, tolerance)?.fixed_modes;
        Ok(Self { problem: problem.clone(), exact, decoupled, family, fixed_modes })
    }

    /// The region in which the error has to decay.
    pub fn region(&self) -> StabilityRegion {
        StabilityRegion::of(self.problem.is_discrete())
    }

    /// The limit that the fixed modes set to the demand on the decay: `-max Re s`, in discrete time `max |z|`.
    pub fn fastest_decay(&self) -> Option<f64> {
        let speed = |s: &Complex64| if self.problem.is_discrete() { s.norm() } else { s.re };
        let slowest = self.fixed_modes.iter().map(speed).reduce(f64::max);
        if self.problem.is_discrete() { slowest } else { slowest.map(|rate| -rate) }
    }

    /// Whether the attenuated columns can act on the estimate at all.
    ///
    /// They cannot when `Phi D2 = 0` and `Pi D2 = 0`, the latter being of no matter for order zero: gamma is then zero.
    pub fn is_driven(&self) -> bool {
        let Decoupled { D2_bar, Phi_D2, .. } = &self.decoupled;
        let acts = |matrix: &DMatrix<f64>| matrix.iter().any(|x| *x != 0.0);
        acts(Phi_D2) || (self.family.order() > 0 && acts(D2_bar))
    }

    /// Whether the fixed modes allow stability.
    pub fn stabilisable(&self, tolerance: &Tolerance) -> bool {
        let region = self.region();
        let margin = region.margin(self.family.Lambda_N.norm(), tolerance);
        self.fixed_modes.iter().all(|mode| region.contains(*mode, margin))
    }
}
