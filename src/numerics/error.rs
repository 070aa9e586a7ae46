//! What can go wrong in a computation on finite matrices.

use num_complex::Complex64;

/// A numerical computation that could not be completed or checked.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum NumericsError {
    /// An entry is infinite or not a number.
    #[error("the {rows} x {columns} matrix has an entry that is not finite")]
    NotFinite {
        /// Rows of the offending matrix.
        rows: usize,
        /// Columns of the offending matrix.
        columns: usize,
    },
    /// A factorisation did not converge, or its result failed the residual check.
    #[error(
        "the {what} of a {rows} x {columns} matrix failed its own check (residual {residual:.1e}); scale the data"
    )]
    Unreliable {
        /// Name of the factorisation.
        what: &'static str,
        /// Rows of the offending matrix.
        rows: usize,
        /// Columns of the offending matrix.
        columns: usize,
        /// Relative residual that was found; infinite when there was no convergence.
        residual: f64,
    },
    /// Two matrices that belong together have different sizes.
    #[error("{what}: {found} where {needed} is needed")]
    Shape {
        /// What was being assembled or solved.
        what: &'static str,
        /// The size that was found.
        found: String,
        /// The size that is needed.
        needed: String,
    },
    /// A linear system has no unique solution.
    #[error("{what} is singular (smallest singular value {smallest:.1e})")]
    Singular {
        /// Name of the matrix.
        what: &'static str,
        /// Its smallest singular value.
        smallest: f64,
    },
    /// A list of poles is not closed under complex conjugation.
    #[error("the pole {pole} has no conjugate partner in the list; add {}", pole.conj())]
    NotConjugate {
        /// The pole without a partner.
        pole: Complex64,
    },
    /// The wrong number of poles was given.
    #[error("{found} poles were given, {needed} are needed")]
    PoleCount {
        /// How many were given.
        found: usize,
        /// How many the pair has to place.
        needed: usize,
    },
}
