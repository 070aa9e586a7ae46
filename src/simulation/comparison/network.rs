//! Hierarchical observers of a network that is too large to be written as one system.

use nalgebra::DMatrix;

use super::errors::{ErrorSize, ScenarioErrors, sizes, together};
use super::judged::judged_by_itself;
use super::runs::ComparedRun;
use super::{Compared, ComparedDesign, ComparisonRow, Contender, undecided};
use crate::numerics::{NumericsError, StabilityRegion, Tolerance, Watch};
use crate::observer::hierarchical::HierarchicalObserver;
use crate::observer::{
    Design, DesignError, ErrorGains, ErrorStateSpace, Method, assess_network, network_error_system,
};
use crate::simulation::{NetworkTrajectory, SimulationError, Span, simulate_network};
use crate::system::Network;

/// States of subsystems that are simulated at a time, so that memory does not grow with the network.
const MOST_STATES: usize = 500;

/// What happens to a network that is never expanded: its initial state, and how long it is watched.
#[derive(Clone, Copy, Debug)]
pub struct NetworkScenario<'a> {
    /// Initial states of all subsystems below each other.
    pub x0: &'a [f64],
    /// Horizon and samples.
    pub span: Span,
    /// Whether there is measurement noise, which is not simulated.
    pub noisy: bool,
}

/// Designs all contenders for a network of any size, which is never expanded: only hierarchical observers. Each runs in
/// the same scenario, and errors are those of all states that it estimates. `None` when `watch` said stop.
pub fn compare_network(
    network: &Network,
    scenario: NetworkScenario<'_>,
    contenders: &[Contender<'_>],
    tolerance: &Tolerance,
    watch: &Watch,
) -> Option<Compared> {
    let states = network.a.nrows() * network.n_subsystems();
    let only = format!(
        "the network has {states} states, too many to be written as one system: only the hierarchical observer, which \
         never does that, can be designed"
    );
    let mut found = Compared::default();
    let mut designs = Vec::new();
    let part = |k: usize, of: f32| (k as f32 + of) / contenders.len().max(1) as f32;
    for (k, contender) in contenders.iter().enumerate() {
        if !watch.go_on(part(k, 0.0), &format!("designing {}", contender.name)) {
            return None;
        }
        let choice = contender.choice;
        let outcome = if choice.method == Method::Hierarchical {
            assess_network(network, choice, tolerance)
                .map_err(undecided)
                .and_then(|assessment| assessment.outcome)
        } else {
            Err(DesignError::Unsuitable(only.clone()))
        };
        if !watch.go_on(part(k, 0.4), &format!("gains and errors of {}", contender.name)) {
            return None;
        }
        let outcome = outcome.and_then(|design| {
            let (row, errors, note) = row(network, scenario, &design, tolerance).map_err(undecided)?;
            let note = note.map(|note| format!("{}: {note}", contender.name));
            found.comparison.notes.extend(note);
            found.runs.push(ComparedRun { row: k, errors, motion: None, network: None });
            designs.push(design);
            Ok(row)
        });
        let (name, method, order) = (contender.name.to_owned(), choice.method, choice.order);
        found.comparison.rows.push(ComparisonRow { name, method, order, outcome });
    }
    let shown = shown(network, &found);
    for (run, design) in found.runs.iter_mut().zip(&designs) {
        let Some(observer) = design.hierarchical.as_deref() else { continue };
        run.network = simulate_network(network, observer, scenario.x0, scenario.span, &shown).ok();
    }
    if scenario.noisy && !designs.is_empty() {
        found.comparison.notes.push(
            "measurement noise is not simulated in a network of this size: its effect is the norm from noise to e"
                .to_owned(),
        );
    }
    Some(found)
}

/// The row of a design, its error system, and what became of its motion.
fn row(
    network: &Network,
    scenario: NetworkScenario<'_>,
    design: &Design,
    tolerance: &Tolerance,
) -> Result<(ComparedDesign, Option<ErrorStateSpace>, Option<String>), NumericsError> {
    let Some(observer) = design.hierarchical.as_deref() else {
        let why = "the design is not one for a network";
        let gains = ErrorGains::none(why);
        return Ok((judged_by_itself(design, StabilityRegion::LeftHalfPlane, gains)?, None, None));
    };
    let errors = network_error_system(network, observer);
    let gains = match &errors {
        Ok(errors) => errors.gains(tolerance).unwrap_or_else(|error| ErrorGains::none(&error.to_string())),
        Err(error) => ErrorGains::none(&error.to_string()),
    };
    let mut row = judged_by_itself(design, StabilityRegion::LeftHalfPlane, gains)?;
    let (found, note) = match errors_of(network, scenario, observer, &row.estimated) {
        Ok((found, ended)) => (Ok(found), ended),
        Err(error) => (Err(error.to_string()), Some(error.to_string())),
    };
    row.scenario = found;
    Ok((row, errors.ok(), note))
}

/// The errors of all estimated states, and why the motion ends early, if it does.
fn errors_of(
    network: &Network,
    scenario: NetworkScenario<'_>,
    observer: &HierarchicalObserver,
    estimated: &[usize],
) -> Result<(ScenarioErrors, Option<String>), SimulationError> {
    let n = network.a.nrows();
    let mut states: Vec<Option<ErrorSize>> = vec![None; n * network.n_subsystems()];
    let mut subsystems: Vec<usize> = estimated.iter().map(|state| state / n).collect();
    subsystems.dedup();
    let mut note = None;
    for part in subsystems.chunks((MOST_STATES / n).max(1)) {
        let NetworkTrajectory { t, subsystems, note: ended, .. } =
            simulate_network(network, observer, scenario.x0, scenario.span, part)?;
        for subsystem in &subsystems {
            let e: DMatrix<f64> = &subsystem.x - &subsystem.x_hat;
            for (j, size) in sizes(&t, &e).into_iter().enumerate() {
                let k = n * subsystem.subsystem + j;
                // of a subsystem without local observer the whole may determine some states alone
                states[k] = Some(size).filter(|_| estimated.binary_search(&k).is_ok());
            }
        }
        note = note.or(ended);
    }
    let all_states = together(states.iter().flatten());
    Ok((ScenarioErrors { states, unknown: Vec::new(), all_states, all_unknown: None }, note))
}

/// Subsystems that figures show: those that most designs estimate, no more than can be read.
fn shown(network: &Network, found: &Compared) -> Vec<usize> {
    const MOST_SHOWN: usize = 12;
    let n = network.a.nrows();
    let mut count = vec![0_usize; network.n_subsystems()];
    for row in found.comparison.rows.iter().filter_map(|row| row.outcome.as_ref().ok()) {
        for state in &row.estimated {
            count[state / n] += 1;
        }
    }
    let mut subsystems: Vec<usize> = (0..count.len()).filter(|i| count[*i] > 0).collect();
    subsystems.sort_by_key(|i| std::cmp::Reverse(count[*i]));
    subsystems.truncate((MOST_SHOWN / n).max(1));
    subsystems.sort_unstable();
    subsystems
}
