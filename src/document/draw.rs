//! Figures of a document, whatever its plant is.

use super::{Document, Subject};
use crate::numerics::Watch;
use crate::paper::{
    FigureRecipe, FigureSpec, NetworkProblem, Problem, compute_figure, compute_network_figure,
    trade_off_figure,
};
use crate::simulation::comparison::{Compared, NetworkScenario, compare_network};
use crate::simulation::{Span, trade_off};
use crate::system::Network;

impl Document {
    /// Computes a figure for this document's plant, design and scenario.
    ///
    /// # Errors
    /// A sentence: which run has no design or no trajectory, and why.
    pub fn draw(&self, recipe: &FigureRecipe, watch: &Watch) -> Result<FigureSpec, String> {
        let (design, tolerance) = (&self.design, &self.tolerance);
        match self.subject().map_err(|error| error.to_string())? {
            Subject::Model(model) => {
                let scenario = &self.scenario(&model.system);
                compute_figure(&Problem { model: &model, design, scenario, tolerance }, recipe, watch)
            }
            Subject::Network(network) => {
                let (network, x0, span) = (&*network, &self.initial_state(), self.span());
                compute_network_figure(
                    &NetworkProblem { network, design, x0, span, tolerance },
                    recipe,
                    watch,
                )
            }
        }
    }

    /// Draws designs along a sweep of the chosen design's bandwidth factor, or of the decay that it has to keep.
    ///
    /// # Errors
    /// A sentence: why there is no design, or that the network is too large.
    pub fn draw_trade_off(&self, watch: &Watch) -> Result<FigureSpec, String> {
        let model = match self.subject().map_err(|error| error.to_string())? {
            Subject::Model(model) => model,
            Subject::Network(_) => {
                return Err("a network that is too large to be written as one system is not swept".to_owned());
            }
        };
        let found = trade_off(&model, &self.design, &self.tolerance, watch);
        Ok(trade_off_figure(&found.ok_or("cancelled")??, model.system.time))
    }

    /// Compares the designs of this document for its network, which is too large to be written as one system; `None` when
    /// `watch` said stop.
    pub fn compare_network(&self, network: &Network, watch: &Watch) -> Option<Compared> {
        let noisy = self.scenario.noise.iter().any(|signal| !signal.is_zero());
        let scenario = NetworkScenario { x0: &self.initial_state(), span: self.span(), noisy };
        compare_network(network, scenario, &self.contenders(), &self.tolerance, watch)
    }

    /// Horizon and samples of the scenario.
    pub fn span(&self) -> Span {
        Span { horizon: self.scenario.horizon, samples: self.scenario.samples }
    }
}
