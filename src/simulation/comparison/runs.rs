//! All observers beside the same plant; one that spoils the common motion runs alone.

use std::sync::Arc;

use super::{Comparison, ErrorStateSpace};
use crate::numerics::{Tolerance, Watch};
use crate::observer::Design;
use crate::simulation::{
    NetworkTrajectory, Observed, ObserverTrajectory, Scenario, SimulationError, Trajectory,
};
use crate::system::Model;

/// A design that exists, with what is drawn of it.
#[derive(Clone, Debug)]
pub struct ComparedRun {
    /// Its row in the table.
    pub row: usize,
    /// Its error system, where it has one.
    pub errors: Option<ErrorStateSpace>,
    /// Its motion, where it can be simulated.
    pub motion: Option<Motion>,
    /// The motion of a network that is never written as one system: the whole and some subsystems.
    pub network: Option<NetworkTrajectory>,
}

/// A trajectory, which several observers may share, and the place of one of them in it.
#[derive(Clone, Debug)]
pub struct Motion {
    /// Plant and observers.
    pub trajectory: Arc<Trajectory>,
    /// Which of its observers.
    pub observer: usize,
}

impl Motion {
    /// The observer's own part.
    pub fn own(&self) -> &ObserverTrajectory {
        &self.trajectory.observers[self.observer]
    }
}

/// Runs all designs together. Where that is refused or ends early, each runs alone, so that only those suffer whose fault
/// it is. `None` when `watch` said stop.
pub(super) fn together(
    (model, scenario): (&Model, &Scenario),
    designs: &[(&str, &Design)],
    tolerance: &Tolerance,
    watch: &Watch,
) -> Option<Vec<Result<Motion, String>>> {
    if designs.is_empty() {
        return Some(Vec::new());
    }
    let all: Vec<Observed<'_>> = designs.iter().map(|(_, design)| (*design).into()).collect();
    let names: Vec<&str> = designs.iter().map(|(name, _)| *name).collect();
    match scenario.run(model, &all, tolerance, &watch.part(0.0, 0.5)) {
        Err(SimulationError::Cancelled) => return None,
        Ok(mut found) if found.note.is_none() || all.len() == 1 => {
            name_observers(&mut found, &names);
            let trajectory = Arc::new(found);
            let motion = |observer| Ok(Motion { trajectory: Arc::clone(&trajectory), observer });
            return Some((0..all.len()).map(motion).collect());
        }
        Ok(_) | Err(_) => {}
    }
    let mut result = Vec::new();
    for (k, (observed, name)) in all.iter().zip(names).enumerate() {
        let part = |k: usize| 0.5 + 0.5 * k as f32 / designs.len() as f32;
        let found = scenario.run(model, &[*observed], tolerance, &watch.part(part(k), part(k + 1)));
        result.push(match found {
            Err(SimulationError::Cancelled) => return None,
            Err(error) => Err(error.to_string()),
            Ok(mut found) => {
                name_observers(&mut found, &[name]);
                Ok(Motion { trajectory: Arc::new(found), observer: 0 })
            }
        });
    }
    Some(result)
}

/// Says which design `observer 1` is.
fn name_observers(trajectory: &mut Trajectory, names: &[&str]) {
    for text in trajectory.note.iter_mut().chain(&mut trajectory.remarks) {
        for (k, name) in names.iter().enumerate() {
            *text = text.replace(&format!("observer {} ", k + 1), &format!("observer \"{name}\" "));
        }
    }
}

/// Notes and remarks of all trajectories, each once; one that is not of all has the name of its design.
pub(super) fn notes(runs: &[ComparedRun], comparison: &Comparison) -> Vec<String> {
    let mut notes: Vec<String> = Vec::new();
    let mut add = |note: String| {
        if !notes.contains(&note) {
            notes.push(note);
        }
    };
    let motions = || runs.iter().filter_map(|run| Some((run.row, run.motion.as_ref()?)));
    for (row, motion) in motions() {
        let Trajectory { note, remarks, initial_state, .. } = motion.trajectory.as_ref();
        if let Some(note) = note {
            let of_all = motions().all(|(_, other)| other.trajectory.note.as_ref() == Some(note));
            let name = comparison.rows.get(row).map_or("", |row| row.name.as_str());
            add(if of_all { note.clone() } else { format!("{name}: {note}") });
        }
        remarks.iter().cloned().for_each(&mut add);
        if initial_state.change > 1e-9 {
            let values: Vec<String> = initial_state.consistent.iter().map(|x| format!("{x:.4}")).collect();
            add(format!(
                "x(0) was not consistent with the algebraic equations; it starts from ({})",
                values.join(", ")
            ));
        }
    }
    for row in &comparison.rows {
        if let Ok(design) = &row.outcome
            && let Err(why) = &design.scenario
        {
            add(format!("{}: {why}", row.name));
        }
    }
    notes
}
