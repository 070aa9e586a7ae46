//! From a recipe to a figure: designs, simulates and samples; nothing is stored.

use crate::numerics::Watch;
use crate::observer::LinearObserver;
use crate::simulation::Trajectory;
use crate::system::TimeDomain;

pub(super) use super::bode::{bode_curve, bode_frequencies, frequency};
use super::bode::{bode_panels, transfer_at};
use super::figure::{Axis, FigureSpec, Panel, Role, Series};
use super::motion::Motion;
use super::recipe::{FigureRecipe, PanelRecipe, Quantity, SeriesRecipe};
use super::run::{NetworkProblem, Problem, Run, Subject, execute};

/// Computes a figure of a plant as one system.
///
/// # Errors
/// A sentence: which run has no design or no trajectory, and why.
pub fn compute_figure(
    problem: &Problem<'_>,
    recipe: &FigureRecipe,
    watch: &Watch,
) -> Result<FigureSpec, String> {
    compute(Subject::Model(problem), recipe, watch)
}

/// Computes a figure of a network that is never written as one system; only the subsystems it shows are simulated.
///
/// # Errors
/// As [`compute_figure`].
pub fn compute_network_figure(
    problem: &NetworkProblem<'_>,
    recipe: &FigureRecipe,
    watch: &Watch,
) -> Result<FigureSpec, String> {
    compute(Subject::Network(problem), recipe, watch)
}

fn compute(subject: Subject<'_>, recipe: &FigureRecipe, watch: &Watch) -> Result<FigureSpec, String> {
    let runs = execute(subject, recipe, watch)?;
    let mut notes: Vec<String> = Vec::new();
    for run in &runs {
        if !run.design.verification.verified() {
            notes.push(format!("{}: the design is not verified", run.name));
        }
        for note in run.motion.iter().flat_map(Motion::notes) {
            // runs of one plant have the same free states: said once
            if !notes.contains(note) {
                notes.push(note.clone());
            }
        }
    }
    let mut panels = Vec::new();
    for panel in &recipe.panels {
        match panel {
            PanelRecipe::Time { title, range, series } => {
                panels.push(time_panel(subject.time(), (title, *range), series, &runs));
                notes.extend(series.iter().filter_map(|series| missing(series, &runs)));
            }
            PanelRecipe::Bode { title, transfer, from, to, range } => {
                let Subject::Model(problem) = subject else {
                    return Err("a frequency response needs the plant as one system".to_owned());
                };
                let response = |observer: &LinearObserver, omega| {
                    let s = frequency(problem.model.system.time, omega);
                    transfer_at(&problem.model.system, observer, *transfer, (*from, *to), s)
                };
                let observers: Vec<(&str, &LinearObserver)> =
                    runs.iter().map(|run| (run.name.as_str(), &run.design.observer)).collect();
                panels.extend(bode_panels(title, *range, &observers, response));
            }
        }
    }
    notes.dedup();
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

/// What a person should know of a curve that has no points.
fn missing(recipe: &SeriesRecipe, runs: &[Run]) -> Option<String> {
    let motion = runs.get(recipe.run)?.motion.as_ref()?;
    let name = recipe.quantity.name(recipe.index);
    match recipe.quantity {
        Quantity::Estimate | Quantity::Error if motion.estimated().binary_search(&recipe.index).is_err() => {
            Some(format!("{name} is left out: the observer does not estimate this state"))
        }
        Quantity::Whole | Quantity::WholeEstimate | Quantity::WholeError => match motion.order_of_whole() {
            0 => Some(format!(
                "{name} is left out: the hierarchical observer alone knows a state of the whole"
            )),
            order if recipe.index >= order => {
                Some(format!("{name} is left out: the whole has {order} states"))
            }
            _ => None,
        },
        _ => None,
    }
}

fn time_panel(
    time: TimeDomain,
    (title, range): (&str, Option<[f64; 2]>),
    recipes: &[SeriesRecipe],
    runs: &[Run],
) -> Panel {
    let mut series: Vec<Series> = Vec::new();
    for recipe in recipes {
        let Some(motion) = runs.get(recipe.run).and_then(|run| run.motion.as_ref()) else { continue };
        let points = motion.samples(recipe.quantity, recipe.index);
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
    Panel {
        title: title.to_owned(),
        x: Axis { label: time_label(time), ..Axis::default() },
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
    matches!(role_of(quantity), Role::Estimate | Role::Error)
}

/// The stroke of a quantity.
pub(super) fn role_of(quantity: Quantity) -> Role {
    match quantity {
        Quantity::State | Quantity::UnknownInput | Quantity::Input | Quantity::Output | Quantity::Whole => {
            Role::Truth
        }
        Quantity::Estimate | Quantity::UnknownInputEstimate | Quantity::WholeEstimate => Role::Estimate,
        Quantity::Error | Quantity::UnknownInputError | Quantity::WholeError => Role::Error,
    }
}

/// The same colour for a state, its estimate and its error; unknown inputs have their own.
pub(super) fn colour_of(quantity: Quantity, index: usize) -> usize {
    match quantity {
        Quantity::State
        | Quantity::Estimate
        | Quantity::Error
        | Quantity::Output
        | Quantity::Input
        | Quantity::Whole
        | Quantity::WholeEstimate
        | Quantity::WholeError => index,
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
        Quantity::Whole | Quantity::WholeEstimate | Quantity::WholeError => None,
    };
    let row = matrix.filter(|m| index < m.nrows()).map(|m| m.row(index));
    row.map_or(Vec::new(), |row| trajectory.t.iter().zip(row.iter()).map(|(t, value)| [*t, *value]).collect())
}
