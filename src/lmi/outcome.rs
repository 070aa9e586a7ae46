//! What came of a design by linear matrix inequalities: never a bare status of a solver.

use std::fmt;

use serde::{Deserialize, Serialize};

/// The outcome of a design.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum Outcome<T> {
    /// A design whose guarantee is proved apart from the solver.
    Verified(T),
    /// A design that the solver holds to be feasible, but whose guarantee could not be proved.
    NotCertified {
        /// The design.
        design: T,
        /// What could not be proved.
        why: String,
    },
    /// There is no such design.
    Infeasible(Infeasible),
    /// Somebody no longer wanted it.
    Cancelled,
    /// The computation came to no decision: why.
    GaveUp(String),
}

/// Why inequalities have no solution.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Infeasible {
    /// Name of the block that stops it.
    pub block: String,
    /// Paper and equation of that block.
    pub source: String,
    /// The largest margin that was reached, negative.
    pub margin: f64,
    /// Demands that would be feasible, each changed alone.
    pub nearest: Vec<Nearest>,
}

/// A demand that is too strict, and the nearest one that is not.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Nearest {
    /// What: `gamma`, `decay rate`, `gain bound`, `Lipschitz constant`.
    pub quantity: String,
    /// What was asked.
    pub asked: f64,
    /// What is feasible.
    pub feasible: f64,
}

impl fmt::Display for Infeasible {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "the inequalities have no solution: {} ({}) stops them", self.block, self.source)?;
        for Nearest { quantity, asked, feasible } in &self.nearest {
            write!(f, "; {quantity} {asked:.4} is asked, {feasible:.4} is feasible")?;
        }
        Ok(())
    }
}
