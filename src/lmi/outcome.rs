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
            let (asked, feasible) = (digits(*asked), towards(*feasible, *asked < *feasible));
            write!(f, "; {quantity} {asked} is asked, {feasible} is feasible")?;
        }
        Ok(())
    }
}

/// Five significant digits.
fn digits(x: f64) -> f64 {
    format!("{x:.4e}").parse().unwrap_or(x)
}

/// Five significant digits on the feasible side: rounded up or down, never to what is not feasible.
fn towards(x: f64, up: bool) -> f64 {
    let nearest = digits(x);
    if (up && nearest >= x) || (!up && nearest <= x) || x == 0.0 || !x.is_finite() {
        return nearest;
    }
    let unit = 10.0_f64.powf(x.abs().log10().floor() - 4.0);
    digits(if up { x + unit } else { x - unit })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_advice_is_rounded_to_the_feasible_side() {
        let nearest = |asked, feasible| {
            let nearest = vec![Nearest { quantity: "gamma".to_owned(), asked, feasible }];
            Infeasible { nearest, ..Infeasible::default() }.to_string()
        };
        let text = nearest(1e-3, 0.002_004_008_01);
        assert!(text.ends_with("gamma 0.001 is asked, 0.0020041 is feasible"), "up: {text}");
        let text = nearest(3.0, 0.993_456_78);
        assert!(text.ends_with("gamma 3 is asked, 0.99345 is feasible"), "down: {text}");
    }
}
