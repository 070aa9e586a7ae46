//! The descriptor system in the one set of letters that all papers are converted to.
#![expect(non_snake_case, reason = "matrix letters of the canonical form")]

use nalgebra::DMatrix;
use serde::{Deserialize, Serialize};

/// Differential or difference equations.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum TimeDomain {
    /// `E x'(t) = ...`, time in seconds.
    #[default]
    Continuous,
    /// `E x[k+1] = ...`, time in steps.
    Discrete,
}

/// A descriptor system; `E` may be singular and need not be square.
///
/// ```text
/// E x' = A x + B u + D d        (discrete: E x[k+1] = ...)
///    y = C x + F d
/// ```
///
/// # Shapes
/// `E`, `A`: e x n; `B`: e x k; `C`: p x n; `D`: e x q; `F`: p x q, with n states, k known inputs, p outputs and
/// q unknown inputs.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct DescriptorSystem {
    /// Differential or difference equations.
    pub time: TimeDomain,
    /// Matrix of the derivatives, e x n.
    pub E: DMatrix<f64>,
    /// State matrix, e x n.
    pub A: DMatrix<f64>,
    /// Distribution of the known inputs, e x k.
    pub B: DMatrix<f64>,
    /// Output matrix, p x n.
    pub C: DMatrix<f64>,
    /// Distribution of the unknown inputs, e x q.
    pub D: DMatrix<f64>,
    /// Feedthrough of the unknown inputs to the outputs, p x q.
    pub F: DMatrix<f64>,
}

/// A matrix that does not fit the others, or has entries that are not finite.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum SystemError {
    /// Wrong shape.
    #[error("{matrix} is {} x {}, but {} x {} is needed: {reason}", found.0, found.1, needed.0, needed.1)]
    Shape {
        /// Letter of the matrix.
        matrix: &'static str,
        /// Its shape.
        found: (usize, usize),
        /// The shape that fits.
        needed: (usize, usize),
        /// Why that shape is needed.
        reason: &'static str,
    },
    /// An infinite entry, or one that is not a number.
    #[error("{matrix}[{}, {}] is not a finite number", row + 1, column + 1)]
    NotFinite {
        /// Letter of the matrix.
        matrix: &'static str,
        /// Row, from zero.
        row: usize,
        /// Column, from zero.
        column: usize,
    },
    /// More states than one descriptor system may have.
    #[error("the network has {found} states together; as one descriptor system it may have at most {limit}")]
    TooLarge {
        /// States together.
        found: usize,
        /// The limit.
        limit: usize,
    },
    /// More global outputs than a network may have.
    #[error(
        "Psi kron c_G has {found} rows, one for each pair of a row of Psi and a row of c_G; at most {limit} are possible: \
         leave out rows that are combinations of others, which show nothing more"
    )]
    GlobalOutputs {
        /// Rows of `Psi kron c_G`.
        found: usize,
        /// The limit, [`super::MOST_GLOBAL_OUTPUTS`].
        limit: usize,
    },
    /// No states at all.
    #[error("E has no columns: a system needs at least one state")]
    NoStates,
}

impl DescriptorSystem {
    /// A system without inputs, in continuous time: `E x' = A x, y = C x`.
    ///
    /// # Errors
    /// As [`Self::checked`].
    pub fn autonomous(E: DMatrix<f64>, A: DMatrix<f64>, C: DMatrix<f64>) -> Result<Self, SystemError> {
        let (equations, outputs) = (E.nrows(), C.nrows());
        let none = |rows| DMatrix::zeros(rows, 0);
        Self {
            time: TimeDomain::Continuous,
            E,
            A,
            B: none(equations),
            C,
            D: none(equations),
            F: none(outputs),
        }
        .checked()
    }

    /// Number of states n, the columns of `E`.
    pub fn n_states(&self) -> usize {
        self.E.ncols()
    }

    /// Number of equations e, the rows of `E`.
    pub fn n_equations(&self) -> usize {
        self.E.nrows()
    }

    /// Number of known inputs k.
    pub fn n_inputs(&self) -> usize {
        self.B.ncols()
    }

    /// Number of unknown inputs q.
    pub fn n_unknown_inputs(&self) -> usize {
        self.D.ncols()
    }

    /// Number of outputs p.
    pub fn n_outputs(&self) -> usize {
        self.C.nrows()
    }

    /// The six matrices with their letters, in the order of reading.
    pub fn matrices(&self) -> [(&'static str, &DMatrix<f64>); 6] {
        [("E", &self.E), ("A", &self.A), ("B", &self.B), ("C", &self.C), ("D", &self.D), ("F", &self.F)]
    }

    /// Checks shapes and entries, and returns the system when all fit.
    ///
    /// # Errors
    /// The first matrix whose shape does not fit or that has an entry which is not finite.
    pub fn checked(self) -> Result<Self, SystemError> {
        let (e, n) = self.E.shape();
        let (k, p, q) = (self.n_inputs(), self.n_outputs(), self.n_unknown_inputs());
        if n == 0 {
            return Err(SystemError::NoStates);
        }
        let needed: [(&DMatrix<f64>, (usize, usize), &'static str); 6] = [
            (&self.E, (e, n), ""),
            (&self.A, (e, n), "A has the shape of E"),
            (&self.B, (e, k), "B has a row for each equation, as E"),
            (&self.C, (p, n), "C has a column for each state, as E"),
            (&self.D, (e, q), "D has a row for each equation, as E"),
            (&self.F, (p, q), "F has a row for each output (C) and a column for each unknown input (D)"),
        ];
        for ((matrix, _), (given, shape, reason)) in self.matrices().into_iter().zip(needed) {
            if given.shape() != shape {
                return Err(SystemError::Shape { matrix, found: given.shape(), needed: shape, reason });
            }
            if let Some(at) = given.iter().position(|x| !x.is_finite()) {
                let (row, column) = (at % given.nrows(), at / given.nrows());
                return Err(SystemError::NotFinite { matrix, row, column });
            }
        }
        Ok(self)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::dmatrix;

    #[test]
    fn a_wrong_shape_names_matrix_found_and_needed() {
        let error = DescriptorSystem::autonomous(
            DMatrix::identity(2, 2),
            DMatrix::identity(2, 3),
            dmatrix![1.0, 0.0],
        )
        .unwrap_err();
        assert_eq!(
            error.to_string(),
            "A is 2 x 3, but 2 x 2 is needed: A has the shape of E",
            "message for a person"
        );
    }

    #[test]
    fn nan_is_named_by_its_place() {
        let error = DescriptorSystem::autonomous(
            DMatrix::identity(2, 2),
            dmatrix![0.0, 1.0; f64::NAN, 0.0],
            dmatrix![1.0, 0.0],
        )
        .unwrap_err();
        assert_eq!(error.to_string(), "A[2, 1] is not a finite number", "row and column counted from one");
    }
}
