//! Everything that follows from a document: recomputed, never stored, never edited.

use serde::{Deserialize, Serialize};

use super::light::lights;
use crate::document::Document;
use crate::numerics::{Complex64, Tolerance, Watch};
use crate::observer::{Assessment, Method, Verdict, assess};
use crate::paper::{FigureSpec, standard};
use crate::system::properties::{
    finite_eigenvalues, impulse_observability, index, r_detectability, r_observability, rank_e, rank_e_c,
    regularity,
};
use crate::system::{DescriptorSystem, Model, TimeDomain};

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

/// Whether a method can be used.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct MethodLight {
    /// The method.
    pub method: Method,
    /// The light.
    pub light: Light,
    /// Why.
    pub why: String,
}

/// A light of a method.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Light {
    /// Its conditions hold.
    Exists,
    /// They hold narrowly.
    Near,
    /// One fails.
    Fails,
    /// Data are missing.
    Missing,
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
    /// Root mean square of each state's error over the second half of the horizon.
    pub rms: Vec<f64>,
    /// Root mean square of each unknown input's error over the second half of the horizon.
    pub rms_unknown: Vec<f64>,
    /// What a person should know: a projected initial state, a trajectory that was cut off.
    pub notes: Vec<String>,
}

/// Computes everything that follows from a document; `None` when `watch` said stop.
pub fn analyse(document: &Document, watch: &Watch) -> Option<Analysis> {
    let tolerance = &document.tolerance;
    let model = match document.model() {
        Ok(model) => model,
        Err(error) => return Some(Analysis::failed(&error.to_string())),
    };
    let system = &model.system;
    if !watch.go_on(0.0, "properties") {
        return None;
    }
    let properties = properties(system, tolerance);
    let plant_eigenvalues =
        finite_eigenvalues(system, tolerance).map(|found| found.values).unwrap_or_default();
    if !watch.go_on(0.1, "conditions") {
        return None;
    }
    let assessment =
        assess(&model, &document.design, tolerance, &watch.part(0.1, 0.8)).map_err(|error| error.to_string());
    let methods = lights(&model, document, assessment.as_ref());
    if !watch.go_on(0.8, "simulation") {
        return None;
    }
    let simulation = simulation(document, &model, assessment.as_ref(), &watch.part(0.8, 1.0));
    let design = assessment.as_ref().ok().and_then(|a| a.outcome.as_ref().ok());
    let bode = design.and_then(|design| standard::bode(system, design));
    Some(Analysis { properties, plant_eigenvalues, methods, assessment, simulation, bode })
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
    Ok(Simulation {
        rms: trajectory.rms(&observer.e, half),
        rms_unknown: trajectory.rms(&observer.e_d, half),
        states: standard::states(&trajectory, system.time, &model.partition),
        errors: standard::errors(&trajectory, system.time, &model.partition),
        unknown_input: standard::unknown_inputs(&trajectory, system.time),
        notes,
    })
}

fn properties(system: &DescriptorSystem, tolerance: &Tolerance) -> Vec<Property> {
    let mut result = vec![sizes(system)];
    let mut add = |name: &str, found: Result<(String, String, Option<Verdict>), String>| {
        let (value, detail, verdict) = found
            .unwrap_or_else(|error| ("could not be decided".to_owned(), error, Some(Verdict::Undecided)));
        result.push(Property { name: name.to_owned(), value, detail, verdict });
    };
    let question = |holds: bool, fragile: bool| Some(Verdict::of(holds, fragile));
    add(
        "Regular",
        text(regularity(system, tolerance)).map(|found| {
            let structure = &found.structure;
            let detail = format!(
                "normal rank {} of the {} x {} pencil",
                structure.normal_rank, structure.rows, structure.columns
            );
            (yes_no(found.holds()), detail, question(found.holds(), found.fragile()))
        }),
    );
    add(
        "Index",
        text(index(system, tolerance)).map(|found| match found.index {
            Some(index) => (index.to_string(), "largest infinite elementary divisor".to_owned(), None),
            None => ("none".to_owned(), "the pencil is singular".to_owned(), None),
        }),
    );
    add(
        "rank E",
        text(rank_e(system, tolerance)).map(|found| {
            let detail = format!("smallest counted singular value {:.3e}", found.smallest_counted());
            (format!("{} of {}", found.rank, system.n_states()), detail, None)
        }),
    );
    add(
        "rank [E; C] = n",
        text(rank_e_c(system, tolerance)).map(|found| {
            (
                format!("{} of {}", found.decision.rank, found.needed),
                "observable at infinity".to_owned(),
                question(found.holds(), found.fragile()),
            )
        }),
    );
    add(
        "Impulse observable",
        text(impulse_observability(system, tolerance)).map(|found| {
            let detail = format!("rank {} of {} needed", found.printed.decision.rank, found.printed.needed);
            (yes_no(found.holds()), detail, question(found.holds(), found.fragile()))
        }),
    );
    for (name, found) in [
        ("R-observable", r_observability(system, tolerance)),
        ("R-detectable", r_detectability(system, tolerance)),
    ] {
        add(
            name,
            text(found).map(|found| {
                let points: Vec<String> =
                    found.modes.iter().map(|mode| crate::observer::show(mode.s)).collect();
                let detail = match (&found.free_direction, points.is_empty()) {
                    (Some(_), _) => "rank is below n for every s".to_owned(),
                    (None, true) => "no unobservable finite mode".to_owned(),
                    (None, false) => format!("unobservable at s = {}", points.join(", ")),
                };
                (yes_no(found.holds()), detail, question(found.holds(), found.fragile()))
            }),
        );
    }
    result
}

fn text<T, E: std::fmt::Display>(found: Result<T, E>) -> Result<T, String> {
    found.map_err(|error| error.to_string())
}

fn yes_no(holds: bool) -> String {
    if holds { "yes" } else { "no" }.to_owned()
}

fn sizes(system: &DescriptorSystem) -> Property {
    let time = match system.time {
        TimeDomain::Continuous => "continuous time",
        TimeDomain::Discrete => "discrete time",
    };
    Property {
        name: "Size".to_owned(),
        value: format!("{} states", system.n_states()),
        detail: format!(
            "{} equations, {} known inputs, {} outputs, {} unknown inputs, {time}",
            system.n_equations(),
            system.n_inputs(),
            system.n_outputs(),
            system.n_unknown_inputs()
        ),
        verdict: None,
    }
}
