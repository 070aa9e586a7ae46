//! What a design by inequalities can end in.

/// The end of a design by inequalities; never a bare solver status.
#[derive(Clone, Debug, PartialEq)]
pub enum Outcome<T> {
    /// Found, and proved by the certificate.
    Verified(T),
    /// Found, but the certificate does not prove it.
    NotCertified {
        /// What was found.
        design: T,
        /// Which proof failed, for a person.
        why: String,
    },
    /// No solution exists.
    Infeasible(Infeasible),
    /// Stopped on request.
    Cancelled,
    /// Stopped without a decision: a limit was reached or the numbers do not allow one; the text says why.
    GaveUp(String),
}

/// Why there is no solution, and how far away one is.
#[derive(Clone, Debug, PartialEq)]
pub struct Infeasible {
    /// The name of the inequality that stops it.
    pub block: String,
    /// Where that inequality stands (paper, equation).
    pub source: String,
    /// The largest margin that is possible in balanced coordinates; zero or negative.
    pub margin: f64,
    /// For each quantity that was asked for, the nearest value that is feasible with the others unchanged.
    pub nearest: Vec<Nearest>,
}

/// The nearest feasible value of one quantity.
#[derive(Clone, Debug, PartialEq)]
pub struct Nearest {
    /// "gamma", "decay rate", "Lipschitz constant", "gain bound".
    pub quantity: String,
    /// The value that was asked for.
    pub asked: f64,
    /// The nearest value for which a solution exists.
    pub feasible: f64,
}
