//! From a recipe to a figure: designs, simulates and samples; nothing is stored.

use crate::numerics::{Complex64, Tolerance, Watch};
use crate::observer::{Design, DesignChoice, LinearObserver, assess, unknown_input_response};
use crate::simulation::{Scenario, Trajectory};
use crate::system::{DescriptorSystem, Model, TimeDomain};

use super::figure::{Axis, FigureSpec, Panel, Role, Series};
use super::recipe::{FigureRecipe, PanelRecipe, Quantity, RunRecipe, ScenarioPatch, SeriesRecipe, Transfer};

/// A problem as figures see it.
#[derive(Clone, Copy, Debug)]
pub struct Problem<'a> {
    /// The plant.
    pub model: &'a Model,
    /// The chosen design, which runs may change.
    pub design: &'a DesignChoice,
    /// The scenario, which runs may change.
    pub scenario: &'a Scenario,
    /// Thresholds.
    pub tolerance: &'a Tolerance,
}

/// A run that was designed and, where a panel shows time, simulated.
struct Run {
    name: String,
    design: Design,
    trajectory: Option<Trajectory>,
}

/// Computes a figure.
///
/// # Errors
/// A sentence: which run has no design or no trajectory, and why.
pub fn compute_figure(
    problem: &Problem<'_>,
    recipe: &FigureRecipe,
    watch: &Watch,
) -> Result<FigureSpec, String> {
    let timed = recipe.panels.iter().any(|panel| matches!(panel, PanelRecipe::Time { .. }));
    let count = recipe.runs.len().max(1) as f32;
    let part = |k: usize| watch.part(k as f32 / count, (k + 1) as f32 / count);
    let runs = recipe.runs.iter().enumerate().map(|(k, run)| execute(problem, run, timed, &part(k)));
    let runs = runs.collect::<Result<Vec<_>, _>>()?;
    let mut notes: Vec<String> = Vec::new();
    for run in &runs {
        if !run.design.verification.verified() {
            notes.push(format!("{}: the design is not verified", run.name));
        }
        if let Some(trajectory) = &run.trajectory {
            for note in trajectory.note.iter().chain(&trajectory.remarks) {
                // runs of one plant have the same free states: said once
                if !notes.contains(note) {
                    notes.push(note.clone());
                }
            }
        }
    }
    let mut panels = Vec::new();
    for panel in &recipe.panels {
        match panel {
            PanelRecipe::Time { title, range, series } => {
                panels.push(time_panel(problem, title, *range, series, &runs));
            }
            PanelRecipe::Bode { title, transfer, from, to, range } => {
                let response = |run: &Run, omega| {
                    let s = frequency(problem.model.system.time, omega);
                    transfer_at(&problem.model.system, &run.design.observer, *transfer, (*from, *to), s)
                };
                panels.extend(bode_panels(title, *range, &runs, response));
            }
        }
    }
    Ok(FigureSpec {
        id: recipe.id.clone(),
        title: recipe.title.clone(),
        caption: recipe.caption.clone(),
        see: recipe.see.clone(),
        columns: recipe.columns.max(1),
        panels,
        notes,
    })
}

fn execute(problem: &Problem<'_>, run: &RunRecipe, timed: bool, watch: &Watch) -> Result<Run, String> {
    let name = if run.name.is_empty() { "estimate".to_owned() } else { run.name.clone() };
    let choice = run.design.applied(problem.design);
    let assessed = assess(problem.model, &choice, problem.tolerance, watch)
        .map_err(|error| format!("{name}: {error}"))?;
    let design = assessed.outcome.map_err(|error| format!("{name}: {error}"))?;
    let trajectory = if timed {
        let scenario = patched(problem.scenario, &run.scenario);
        let found = scenario.run(problem.model, &[(&design).into()], problem.tolerance, watch);
        Some(found.map_err(|error| format!("{name}: {error}"))?)
    } else {
        None
    };
    Ok(Run { name, design, trajectory })
}

fn patched(scenario: &Scenario, patch: &ScenarioPatch) -> Scenario {
    let ScenarioPatch { u, d, noise, horizon, uncertainty_scale, free } = patch;
    let mut scenario = scenario.clone();
    if let Some(u) = u {
        scenario.u.clone_from(u);
    }
    if let Some(d) = d {
        scenario.d.clone_from(d);
    }
    if let Some(noise) = noise {
        scenario.noise.clone_from(noise);
    }
    if let Some(horizon) = horizon {
        scenario.horizon = *horizon;
    }
    if let (Some(uncertainty), Some(scale)) = (&mut scenario.uncertainty, uncertainty_scale) {
        uncertainty.scale = *scale;
    }
    if let Some(free) = free {
        scenario.free.clone_from(free);
    }
    scenario
}

fn time_panel(
    problem: &Problem<'_>,
    title: &str,
    range: Option<[f64; 2]>,
    recipes: &[SeriesRecipe],
    runs: &[Run],
) -> Panel {
    let mut series: Vec<Series> = Vec::new();
    for recipe in recipes {
        let Some(trajectory) = runs.get(recipe.run).and_then(|run| run.trajectory.as_ref()) else { continue };
        let points = samples(trajectory, 0, recipe.quantity, recipe.index);
        let quantity = recipe.quantity.name(recipe.index);
        let name = match (recipe.name.is_empty(), runs.len() > 1 && is_estimate(recipe.quantity)) {
            (false, _) => recipe.name.clone(),
            (true, true) => format!("{quantity} {}", runs[recipe.run].name),
            (true, false) => quantity,
        };
        let mut role = role_of(recipe.quantity);
        if role == Role::Estimate && series.iter().any(|other| other.role == Role::Estimate) {
            role = Role::Other;
        }
        series.push(Series {
            name,
            role,
            colour: colour_of(recipe.quantity, recipe.index) + recipe.run,
            points,
        });
    }
    let label = time_label(problem.model.system.time);
    Panel {
        title: title.to_owned(),
        x: Axis { label, ..Axis::default() },
        y: Axis { label: String::new(), logarithmic: false, range },
        series,
    }
}

/// Label of a time axis.
pub(super) fn time_label(time: TimeDomain) -> String {
    match time {
        TimeDomain::Continuous => "t (s)".to_owned(),
        TimeDomain::Discrete => "k (steps)".to_owned(),
    }
}

fn is_estimate(quantity: Quantity) -> bool {
    matches!(
        quantity,
        Quantity::Estimate | Quantity::Error | Quantity::UnknownInputEstimate | Quantity::UnknownInputError
    )
}

/// The stroke of a quantity.
pub(super) fn role_of(quantity: Quantity) -> Role {
    match quantity {
        Quantity::State | Quantity::UnknownInput | Quantity::Input | Quantity::Output => Role::Truth,
        Quantity::Estimate | Quantity::UnknownInputEstimate => Role::Estimate,
        Quantity::Error | Quantity::UnknownInputError => Role::Error,
    }
}

/// The same colour for a state, its estimate and its error; unknown inputs have their own.
pub(super) fn colour_of(quantity: Quantity, index: usize) -> usize {
    match quantity {
        Quantity::State | Quantity::Estimate | Quantity::Error | Quantity::Output | Quantity::Input => index,
        Quantity::UnknownInput | Quantity::UnknownInputEstimate | Quantity::UnknownInputError => 7 + index,
    }
}

/// Points of a component of a trajectory; empty when the observer does not estimate it.
pub(super) fn samples(
    trajectory: &Trajectory,
    observer: usize,
    quantity: Quantity,
    index: usize,
) -> Vec<[f64; 2]> {
    let observer = trajectory.observers.get(observer);
    let matrix = match quantity {
        Quantity::State => Some(&trajectory.x),
        Quantity::UnknownInput => Some(&trajectory.d),
        Quantity::Input => Some(&trajectory.u),
        Quantity::Output => Some(&trajectory.y),
        Quantity::Estimate => observer.map(|o| &o.x_hat),
        Quantity::Error => observer.map(|o| &o.e),
        Quantity::UnknownInputEstimate => observer.map(|o| &o.d_hat),
        Quantity::UnknownInputError => observer.map(|o| &o.e_d),
    };
    let row = matrix.filter(|m| index < m.nrows()).map(|m| m.row(index));
    row.map_or(Vec::new(), |row| trajectory.t.iter().zip(row.iter()).map(|(t, value)| [*t, *value]).collect())
}

/// The point of the complex plane that belongs to an angular frequency: `i omega`, or `e^(i omega)` per step.
pub(super) fn frequency(time: TimeDomain, omega: f64) -> Complex64 {
    match time {
        TimeDomain::Continuous => Complex64::new(0.0, omega),
        TimeDomain::Discrete => Complex64::from_polar(1.0, omega),
    }
}

/// A transfer function at one point; `None` where it does not exist.
fn transfer_at(
    system: &DescriptorSystem,
    observer: &LinearObserver,
    transfer: Transfer,
    (from, to): (usize, usize),
    s: Complex64,
) -> Option<Complex64> {
    match transfer {
        Transfer::EstimateToState => estimate_to_state(observer, from, to, s),
        Transfer::UnknownInput | Transfer::UnknownInputToError => {
            let response = unknown_input_response(s, system, observer)?;
            let matrix = match transfer {
                Transfer::UnknownInput => response.d_hat,
                Transfer::UnknownInputToError | Transfer::EstimateToState => response.x - response.x_hat,
            };
            (to < matrix.nrows() && from < matrix.ncols()).then(|| matrix[(to, from)])
        }
    }
}

/// `M1 (s I - F)^-1 T1 N`: the blocks of the common form, with the integral rows left out.
fn estimate_to_state(observer: &LinearObserver, from: usize, to: usize, s: Complex64) -> Option<Complex64> {
    let q = observer.n_estimated_inputs();
    let o = observer.order().checked_sub(q)?;
    if from >= q || to >= observer.P.nrows() || o == 0 {
        return None;
    }
    let unit = nalgebra::DMatrix::<Complex64>::identity(o, o);
    let state = observer.N.view((0, 0), (o, o)).map(Complex64::from);
    let input = observer.N.view((0, o + from), (o, 1)).map(Complex64::from);
    let z = (unit * s - state).lu().solve(&input)?;
    let row = observer.P.view((to, 0), (1, o)).map(Complex64::from);
    Some((row * z)[(0, 0)])
}

/// Points per curve of a Bode panel.
const BODE_POINTS: usize = 241;

/// Magnitude in dB above phase in degrees (unwrapped), one curve per run.
fn bode_panels(
    title: &str,
    range: [f64; 2],
    runs: &[Run],
    response: impl Fn(&Run, f64) -> Option<Complex64>,
) -> [Panel; 2] {
    let frequencies = bode_frequencies(range);
    let curve = |run: &Run| bode_curve(&frequencies, frequencies.iter().map(|omega| response(run, *omega)));
    let curves: Vec<(String, [Vec<[f64; 2]>; 2])> =
        runs.iter().map(|run| (run.name.clone(), curve(run))).collect();
    let panel = |which: usize, title: &str, label: &str| Panel {
        title: title.to_owned(),
        x: Axis { label: "frequency (rad/s)".to_owned(), logarithmic: true, range: Some(range) },
        y: Axis { label: label.to_owned(), ..Axis::default() },
        series: curves
            .iter()
            .enumerate()
            .map(|(colour, (name, points))| Series {
                name: name.clone(),
                role: Role::Response,
                colour,
                points: points[which].clone(),
            })
            .collect(),
    };
    [panel(0, title, "magnitude (dB)"), panel(1, "", "phase (degrees)")]
}

/// Frequencies of a Bode curve, evenly spaced on a logarithmic axis.
pub(super) fn bode_frequencies(range: [f64; 2]) -> Vec<f64> {
    let (low, high) = (range[0].ln(), range[1].ln());
    (0..BODE_POINTS).map(|k| (low + (high - low) * k as f64 / (BODE_POINTS - 1) as f64).exp()).collect()
}

/// Magnitude in dB and unwrapped phase in degrees of a response; gaps where it does not exist.
pub(super) fn bode_curve(
    frequencies: &[f64],
    response: impl Iterator<Item = Option<Complex64>>,
) -> [Vec<[f64; 2]>; 2] {
    let mut magnitude = Vec::new();
    let mut phase: Vec<[f64; 2]> = Vec::new();
    for (&omega, value) in frequencies.iter().zip(response) {
        let Some(value) = value.filter(|z| z.norm() > 0.0 && z.norm().is_finite()) else { continue };
        magnitude.push([omega, 20.0 * value.norm().log10()]);
        let mut degrees = value.arg().to_degrees();
        if let Some([_, last]) = phase.last() {
            degrees += ((last - degrees) / 360.0).round() * 360.0;
        }
        phase.push([omega, degrees]);
    }
    [magnitude, phase]
}
