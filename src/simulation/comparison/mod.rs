//! Several designs of one plant side by side: what each is, what it lets through, and how it does in one scenario.

mod errors;
mod judged;
mod network;
mod runs;

use serde::{Deserialize, Serialize};

pub use errors::{ErrorSize, ScenarioErrors};
pub(super) use judged::judged;
pub use network::{NetworkScenario, compare_network};
pub use runs::{ComparedRun, Motion};

use std::sync::Arc;

use super::{Memo, Scenario};
use crate::numerics::{Complex64, Tolerance, Watch};
use crate::observer::{DesignChoice, DesignError, ErrorGains, ErrorStateSpace, Method, Order};
use crate::system::Model;

/// A design that is to be compared.
#[derive(Clone, Copy, Debug)]
pub struct Contender<'a> {
    /// Its name in tables and legends.
    pub name: &'a str,
    /// The choice.
    pub choice: &'a DesignChoice,
}

/// The table of a comparison: one row for each design, in the order in which they were given.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Comparison {
    /// The designs.
    pub rows: Vec<ComparisonRow>,
    /// Whether the plant has a nonlinearity, so that the norms are those of its linear part.
    pub linear_part: bool,
    /// What a person should know: what the norms leave out, a projected initial state, a trajectory that was cut off.
    pub notes: Vec<String>,
}

/// One design of a comparison.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ComparisonRow {
    /// Its name.
    pub name: String,
    /// Its method.
    pub method: Method,
    /// The order that was asked for.
    pub order: Order,
    /// What is known of it, or why there is no design.
    pub outcome: Result<ComparedDesign, DesignError>,
}

/// What is known of a design that exists.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ComparedDesign {
    /// Method and order in words.
    pub title: String,
    /// Number of its own states.
    pub order: usize,
    /// Number of the plant's states.
    pub states: usize,
    /// Those of the plant's states whose estimate tends to the truth, from zero, in ascending order.
    pub estimated: Vec<usize>,
    /// Whether every check was passed.
    pub verified: bool,
    /// Eigenvalues of the error dynamics.
    pub spectrum: Vec<Complex64>,
    /// The eigenvalue nearest to the boundary of stability; none for an observer without states.
    pub slowest: Option<Complex64>,
    /// Its distance from the boundary, `-Re s` or `1 - |z|`: the guaranteed rate of decay.
    pub margin: Option<f64>,
    /// Modes that no gain can move.
    pub fixed_modes: Vec<Complex64>,
    /// `|L|`, the largest gain from `y` to the observer's states.
    pub output_gain: f64,
    /// `|V|`, the largest gain from `y` to the estimate at once.
    pub direct_gain: f64,
    /// Norm of the gain that was chosen: by the placements, or by the matrix inequalities; the largest of all.
    pub chosen_gain: f64,
    /// The attenuation that is proved, the largest of all subsystems.
    pub guaranteed: Option<f64>,
    /// H-infinity norms of the error system; for a nonlinear plant of its linear part.
    pub gains: ErrorGains,
    /// Errors of the scenario, or why there are none.
    pub scenario: Result<ScenarioErrors, String>,
}

/// A comparison with what its figures are drawn from.
#[derive(Clone, Debug, Default)]
pub struct Compared {
    /// The table.
    pub comparison: Comparison,
    /// The designs that exist, each with its motion.
    pub runs: Vec<ComparedRun>,
}

/// Designs all contenders, computes the gains of their errors, and runs them together in one scenario.
///
/// A design that does not exist does not stop the others, nor does one that cannot be simulated. `None` when `watch` said
/// stop.
pub fn compare(
    model: &Model,
    scenario: &Scenario,
    contenders: &[Contender<'_>],
    tolerance: &Tolerance,
    watch: &Watch,
) -> Option<Compared> {
    compare_with(&mut Memo::new(), (model, scenario), contenders, tolerance, watch)
}

/// The same with a memory of what was designed before.
pub fn compare_with(
    memo: &mut Memo,
    (model, scenario): (&Model, &Scenario),
    contenders: &[Contender<'_>],
    tolerance: &Tolerance,
    watch: &Watch,
) -> Option<Compared> {
    let count = contenders.len().max(1) as f32;
    let mut comparison = Comparison { linear_part: model.lipschitz.is_some(), ..Comparison::default() };
    let mut found = Vec::new();
    for (k, contender) in contenders.iter().enumerate() {
        let watch = watch.part(0.8 * k as f32 / count, 0.8 * (k + 1) as f32 / count);
        if !watch.go_on(0.0, &format!("designing {}", contender.name)) {
            return None;
        }
        let assessed = memo.assess(model, contender.choice, tolerance, &watch.part(0.0, 0.7));
        if !watch.go_on(0.7, &format!("gains of {}", contender.name)) {
            return None;
        }
        let outcome = assessed.map_err(undecided).and_then(|assessment| {
            let judged = memo.judged(model, &assessment, tolerance).map_err(undecided)?;
            let Some((row, errors)) = judged else {
                return Err(assessment.outcome.as_ref().err().cloned().unwrap_or(DesignError::Cancelled));
            };
            found.push((k, Arc::clone(&assessment), errors));
            Ok(row)
        });
        let DesignChoice { method, order, .. } = *contender.choice;
        comparison.rows.push(ComparisonRow { name: contender.name.to_owned(), method, order, outcome });
    }
    let found: Vec<_> = found
        .iter()
        .filter_map(|(row, assessment, errors)| Some((*row, assessment.outcome.as_ref().ok()?, errors)))
        .collect();
    let designs: Vec<_> = found.iter().map(|(row, design, _)| (contenders[*row].name, *design)).collect();
    let motions = runs::together((model, scenario), &designs, tolerance, &watch.part(0.8, 1.0))?;
    let mut runs = Vec::new();
    for ((row, design, errors), motion) in found.into_iter().zip(motions) {
        let errors_of = motion.as_ref().map(|motion| errors::of(motion, design)).map_err(Clone::clone);
        if let Ok(row) = &mut comparison.rows[row].outcome {
            row.scenario = errors_of;
        }
        runs.push(ComparedRun { row, errors: errors.clone(), motion: motion.ok(), network: None });
    }
    let linear = comparison.linear_part.then(|| LINEAR_PART.to_owned());
    comparison.notes = linear.into_iter().chain(runs::notes(&runs, &comparison)).collect();
    Some(Compared { comparison, runs })
}

/// What the norms of a nonlinear plant are worth.
pub(super) const LINEAR_PART: &str = "the plant has a Lipschitz term: H-infinity norms are those of the error of the linear \
                                      part, f = 0; of the whole plant only the guaranteed gamma says something";

/// Conditions that cannot be decided, as a reason why there is no design.
fn undecided(error: impl std::fmt::Display) -> DesignError {
    DesignError::Numerics(error.to_string())
}
