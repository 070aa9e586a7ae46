//! Everything that follows from a document: recomputed, never stored, never edited.

use serde::{Deserialize, Serialize};

use super::analysis_network as of_network;
use super::analysis_properties::properties;
use super::free_report::FreeReport;
use crate::document::{Document, Subject};
use crate::numerics::{Complex64, Watch};
use crate::observer::hierarchical::Hierarchy;
use crate::observer::{Assessment, Known, MethodLight, Verdict, lights};
use crate::paper::{FigureSpec, Motion, standard};
use crate::simulation::Memo;
use crate::system::Model;
use crate::system::properties::finite_eigenvalues;

/// What follows from a document.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Analysis {
    /// Properties of the system.
    pub properties: Vec<Property>,
    /// Finite eigenvalues of the plant.
    pub plant_eigenvalues: Vec<Complex64>,
    /// A light for each method.
    pub methods: Vec<MethodLight>,
    /// Conditions and design of the chosen method, or why they could not be asked.
    pub assessment: Result<Assessment, String>,
    /// Simulation, or why there is none.
    pub simulation: Result<Simulation, String>,
    /// Frequency responses of the design.
    pub bode: Option<FigureSpec>,
    /// What the equations leave free, for a plant that is not square.
    pub free: Option<FreeReport>,
}

/// A property of the system with its evidence in words.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Property {
    /// Name.
    pub name: String,
    /// The value or verdict in a few words.
    pub value: String,
    /// What it was decided on.
    pub detail: String,
    /// How it came out, where it is a question.
    pub verdict: Option<Verdict>,
}

/// The standard views of a simulation.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Simulation {
    /// States.
    pub states: FigureSpec,
    /// Errors.
    pub errors: FigureSpec,
    /// Unknown inputs, known inputs, outputs.
    pub unknown_input: FigureSpec,
    /// The states that the observer estimates and the simulation shows, from zero, in ascending order.
    pub estimated: Vec<usize>,
    /// Root mean square of the error of each of these states over the second half of the horizon.
    pub rms: Vec<f64>,
    /// Root mean square of `norm(z - z_hat)` over the second half of the horizon, where a network is observed as a whole.
    pub rms_whole: Option<f64>,
    /// Root mean square of each unknown input's error over the second half of the horizon.
    pub rms_unknown: Vec<f64>,
    /// What a person should know: a projected initial state, a trajectory that was cut off.
    pub notes: Vec<String>,
}

/// Computes everything that follows from a document; `None` when `watch` said stop.
pub fn analyse(document: &Document, watch: &Watch) -> Option<Analysis> {
    analyse_with(&mut Memo::new(), document, watch)
}

/// The same with a memory of earlier designs.
pub(super) fn analyse_with(memo: &mut Memo, document: &Document, watch: &Watch) -> Option<Analysis> {
    let tolerance = &document.tolerance;
    let model = match document.subject() {
        Ok(Subject::Model(model)) => model,
        Ok(Subject::Network(network)) => return of_network::analyse(document, &network, watch),
        Err(error) => return Some(Analysis::failed(&error.to_string())),
    };
    let system = &model.system;
    if !watch.go_on(0.0, "properties") {
        return None;
    }
    let mut properties = properties(system, tolerance);
    if let Some(network) = &model.network {
        let hierarchy = Hierarchy::of(network, tolerance);
        properties.extend(of_network::structure(network, &hierarchy));
    }
    let plant_eigenvalues =
        finite_eigenvalues(system, tolerance).map(|found| found.values).unwrap_or_default();
    if !watch.go_on(0.1, "conditions") {
        return None;
    }
    let assessment = memo
        .assess(&model, &document.design, tolerance, &watch.part(0.1, 0.8))
        .map(|found| (*found).clone())
        .map_err(|error| error.to_string());
    let known = assessment.as_ref().ok().map(Known::from);
    let methods = lights(&model, &document.design, tolerance, known);
    if !watch.go_on(0.8, "simulation") {
        return None;
    }
    let free = FreeReport::new(document, &model);
    let simulation = simulation(document, &model, assessment.as_ref(), &watch.part(0.8, 1.0)).map(|found| {
        let notes = FreeReport::without_own(free.as_ref(), found.notes);
        Simulation { notes, ..found }
    });
    let design = assessment.as_ref().ok().and_then(|a| a.outcome.as_ref().ok());
    let bode = design.and_then(|design| standard::bode(system, design));
    Some(Analysis { properties, plant_eigenvalues, methods, assessment, simulation, bode, free })
}

impl Analysis {
    fn failed(why: &str) -> Self {
        Self {
            properties: Vec::new(),
            plant_eigenvalues: Vec::new(),
            methods: Vec::new(),
            assessment: Err(why.to_owned()),
            simulation: Err(why.to_owned()),
            bode: None,
            free: None,
        }
    }

    /// Whether a design exists and is verified.
    pub fn verified(&self) -> bool {
        self.assessment.as_ref().is_ok_and(Assessment::verified)
    }
}

fn simulation(
    document: &Document,
    model: &Model,
    assessment: Result<&Assessment, &String>,
    watch: &Watch,
) -> Result<Simulation, String> {
    let system = &model.system;
    let assessment = assessment.map_err(Clone::clone)?;
    let design =
        assessment.outcome.as_ref().map_err(|error| format!("there is no observer to simulate: {error}"))?;
    let scenario = document.scenario(system);
    let trajectory = scenario
        .run(model, &[design.into()], &document.tolerance, watch)
        .map_err(|error| error.to_string())?;
    let half = trajectory.t.last().copied().unwrap_or(0.0) / 2.0;
    let observer = &trajectory.observers[0];
    let mut notes: Vec<String> = trajectory.note.iter().chain(&trajectory.remarks).cloned().collect();
    if trajectory.initial_state.change > 1e-9 {
        let values: Vec<String> =
            trajectory.initial_state.consistent.iter().map(|x| format!("{x:.4}")).collect();
        notes.push(format!(
            "x(0) was not consistent with the algebraic equations; it starts from ({})",
            values.join(", ")
        ));
    }
    if let Some(network) = &model.network {
        let motion = Motion::of_system(trajectory, design);
        return Ok(of_network::views(network, &motion, notes));
    }
    Ok(Simulation {
        estimated: design.estimated_states(system.n_states()),
        rms: trajectory.rms(&observer.e, half),
        rms_whole: None,
        rms_unknown: trajectory.rms(&observer.e_d, half),
        states: standard::states(&trajectory, system.time, &model.partition),
        errors: standard::errors(&trajectory, system.time, &model.partition),
        unknown_input: standard::unknown_inputs(&trajectory, system.time),
        notes,
    })
}
