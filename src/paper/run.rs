//! The runs of a figure: designs and simulates one choice in one scenario.

use super::motion::Motion;
use super::recipe::{FigureRecipe, PanelRecipe, Quantity, RunRecipe, ScenarioPatch};
use crate::numerics::{Tolerance, Watch};
use crate::observer::{Assessment, Design, DesignChoice, assess, assess_network};
use crate::simulation::{Scenario, Span, simulate_network};
use crate::system::{Model, Network, TimeDomain};

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

/// A network that is too large to be written as one system, as figures see it.
#[derive(Clone, Copy, Debug)]
pub struct NetworkProblem<'a> {
    /// The network.
    pub network: &'a Network,
    /// The chosen design, which runs may change.
    pub design: &'a DesignChoice,
    /// Initial state, the subsystems' states below each other.
    pub x0: &'a [f64],
    /// Horizon and samples; runs may change the horizon.
    pub span: Span,
    /// Thresholds.
    pub tolerance: &'a Tolerance,
}

/// Either kind of problem.
#[derive(Clone, Copy)]
pub(super) enum Subject<'a> {
    Model(&'a Problem<'a>),
    Network(&'a NetworkProblem<'a>),
}

/// A run that was designed and, where a panel shows time, simulated.
pub(super) struct Run {
    pub(super) name: String,
    pub(super) design: Design,
    pub(super) motion: Option<Motion>,
}

impl Subject<'_> {
    pub(super) fn time(&self) -> TimeDomain {
        match self {
            Self::Model(problem) => problem.model.system.time,
            Self::Network(_) => TimeDomain::Continuous,
        }
    }

    fn assess(&self, run: &RunRecipe, watch: &Watch) -> Result<Assessment, String> {
        let found = match self {
            Self::Model(problem) => {
                assess(problem.model, &run.design.applied(problem.design), problem.tolerance, watch)
            }
            Self::Network(problem) => {
                assess_network(problem.network, &run.design.applied(problem.design), problem.tolerance)
            }
        };
        found.map_err(|error| error.to_string())
    }

    fn simulate(
        &self,
        run: &RunRecipe,
        design: &Design,
        shown: &[usize],
        watch: &Watch,
    ) -> Result<Motion, String> {
        match self {
            Self::Model(problem) => {
                let scenario = patched(problem.scenario, &run.scenario);
                let found = scenario.run(problem.model, &[design.into()], problem.tolerance, watch);
                Ok(Motion::of_system(found.map_err(|error| error.to_string())?, design))
            }
            Self::Network(problem) => {
                let span =
                    Span { horizon: run.scenario.horizon.unwrap_or(problem.span.horizon), ..problem.span };
                let observer = design.hierarchical.as_deref().ok_or("the design is not one for a network")?;
                let found = simulate_network(problem.network, observer, problem.x0, span, shown);
                let found = found.map_err(|error| error.to_string())?;
                Ok(Motion::of_network(found, problem.network, observer))
            }
        }
    }

    /// The subsystems of a network that a figure shows, ascending.
    fn shown(&self, recipe: &FigureRecipe) -> Vec<usize> {
        let Self::Network(NetworkProblem { network, .. }) = self else { return Vec::new() };
        let global = network.Psi.nrows() * network.c_G.nrows();
        let timed = recipe.panels.iter().flat_map(|panel| match panel {
            PanelRecipe::Time { series, .. } => series.as_slice(),
            PanelRecipe::Bode { .. } => &[],
        });
        let mut shown: Vec<usize> = timed
            .filter_map(|series| match series.quantity {
                Quantity::State | Quantity::Estimate | Quantity::Error => {
                    Some(series.index / network.a.nrows())
                }
                Quantity::Output => {
                    let local = series.index.checked_sub(global)?.checked_div(network.c_L.nrows())?;
                    network.local.get(local).copied()
                }
                _ => None,
            })
            .filter(|subsystem| *subsystem < network.n_subsystems())
            .collect();
        shown.sort_unstable();
        shown.dedup();
        shown
    }
}

/// Designs every run of a figure, and simulates it where a panel shows time.
pub(super) fn execute(
    subject: Subject<'_>,
    recipe: &FigureRecipe,
    watch: &Watch,
) -> Result<Vec<Run>, String> {
    let timed = recipe.panels.iter().any(|panel| matches!(panel, PanelRecipe::Time { .. }));
    let shown = subject.shown(recipe);
    let count = recipe.runs.len().max(1) as f32;
    let one = |(k, run): (usize, &RunRecipe)| {
        let watch = watch.part(k as f32 / count, (k + 1) as f32 / count);
        let name = if run.name.is_empty() { "estimate" } else { run.name.as_str() };
        let found = subject.assess(run, &watch).and_then(|assessed| {
            let design = assessed.outcome.map_err(|error| error.to_string())?;
            let motion = timed.then(|| subject.simulate(run, &design, &shown, &watch)).transpose()?;
            Ok(Run { name: name.to_owned(), design, motion })
        });
        found.map_err(|error| format!("{name}: {error}"))
    };
    recipe.runs.iter().enumerate().map(one).collect()
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
