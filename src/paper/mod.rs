//! L3: the papers as data: citations, example documents, figure recipes, errata.

mod bode;
mod compute;
mod errata;
mod figure;
mod motion;
mod palette;
mod recipe;
mod run;
pub mod standard;
mod standard_comparison;
mod standard_comparison_network;
pub mod standard_network;
mod standard_trade_off;

pub use compute::{compute_figure, compute_network_figure};
pub use errata::{
    Erratum, ErratumKind, GUARANTEE, OBSERVER, PrintedMatrix, Shown, UNCERTAINTY, errata, paper_examples,
    papers_with_errata, printed,
};
pub use figure::{Axis, FigureSpec, Panel, Role, Series};
pub use motion::Motion;
pub use palette::{PALETTE, colour};
pub use recipe::{
    DesignPatch, FigureRecipe, PanelRecipe, Quantity, RunRecipe, ScenarioPatch, SeriesRecipe, Transfer,
};
pub use run::{NetworkProblem, Problem};
pub use standard_comparison::{ComparisonFigures, comparison, design_colour};
pub use standard_comparison_network::network_comparison;
pub use standard_trade_off::trade_off_figure;

/// An example that comes with the program, as the text of a document.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Example {
    /// Key on the command line and in links.
    pub key: &'static str,
    /// Title in menus.
    pub title: &'static str,
    /// What it teaches, one sentence.
    pub teaches: &'static str,
    /// The document.
    pub text: &'static str,
}

/// All examples, the first of which opens when nothing else is asked for.
pub const EXAMPLES: [Example; 10] = [
    Example {
        key: "proportional-integral",
        title: "Koenig and Mammar: unknown input by an integral loop",
        teaches: "Nine figures of the paper: how fast poles catch an unknown input, and what that costs.",
        text: include_str!("../../assets/examples/proportional-integral.json"),
    },
    Example {
        key: "input-decoupled",
        title: "Input-decoupled observer of a system with free states",
        teaches: "More states than equations, and an unknown input that jumps: its estimate jumps with it, and no error ever \
                  sees it.",
        text: include_str!("../../assets/examples/input-decoupled.json"),
    },
    Example {
        key: "h-infinity-lipschitz",
        title: "Zerrougui et al.: H-infinity observer with a Lipschitz term",
        teaches: "Slide the decay rate and see the best attenuation gamma that any observer of that order can reach.",
        text: include_str!("../../assets/examples/h-infinity-lipschitz.json"),
    },
    Example {
        key: "decentralized",
        title: "Decentralized observers of two interconnected subsystems",
        teaches: "Two local observers that do not know each other's states: decoupled exactly, or attenuated.",
        text: include_str!("../../assets/examples/decentralized.json"),
    },
    Example {
        key: "hierarchical",
        title: "Ishizaki et al.: a network, as a whole and one by one",
        teaches: "One observer for what a network shows as a whole; local ones are plugged in and out without touching it.",
        text: include_str!("../../assets/examples/hierarchical.json"),
    },
    Example {
        key: "network-ring",
        title: "A ring of a thousand subsystems",
        teaches: "Five thousand states, estimated through six: the coupling has rank three, and only that counts.",
        text: include_str!("../../assets/examples/network-ring.json"),
    },
    Example {
        key: "unseen-impulse",
        title: "An impulse that no sensor sees",
        teaches: "Condition (9) fails; the witness names the state, and one more sensor mends it.",
        text: include_str!("../../assets/examples/unseen-impulse.json"),
    },
    Example {
        key: "input-in-constraint",
        title: "An unknown input in an algebraic equation",
        teaches: "Condition (8) fails, so the paper's observer does not exist; the general form does.",
        text: include_str!("../../assets/examples/input-in-constraint.json"),
    },
    Example {
        key: "discrete",
        title: "A sampled machine with a load step",
        teaches: "The same observer in discrete time: deadbeat poles, and a step that is learnt in a few samples.",
        text: include_str!("../../assets/examples/discrete.json"),
    },
    Example {
        key: "comparison",
        title: "One plant, five observers",
        teaches: "Offset, lag, noise: what proportional, integral, input-decoupled and H-infinity observers pay.",
        text: include_str!("../../assets/examples/comparison.json"),
    },
];

/// The example with that key.
pub fn example(key: &str) -> Option<&'static Example> {
    EXAMPLES.iter().find(|example| example.key == key)
}

/// A paper that the program implements.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Paper {
    /// Number used in documents and identifiers.
    pub key: &'static str,
    /// Citation.
    pub citation: &'static str,
}

/// The papers that are implemented.
pub const PAPERS: [Paper; 5] = [
    Paper {
        key: "000",
        citation: "\"Decentralized observers for large scale interconnected singular systems\", conference paper on the \
                   parameterisation of generalized Sylvester equations",
    },
    Paper {
        key: "001",
        citation: "\"Input-decoupled observer design for linear descriptor systems with unknown inputs\", conference paper on \
                   systems that are not square",
    },
    Paper {
        key: "002",
        citation: "M. Zerrougui, M. Darouach, L. Boutat-Baddas and H. Souley Ali, \"H-infinity observers design for a \
                   class of continuous time nonlinear singular systems\", Journal of Control Science and Engineering \
                   2011, article 967571",
    },
    Paper {
        key: "003",
        citation: "T. Ishizaki, Y. Sakai, K. Kashima and J. Imura, \"Hierarchical decentralized observer design for linearly \
                   coupled network systems\"",
    },
    Paper {
        key: "004",
        citation: "D. Koenig and S. Mammar, \"Design of proportional-integral observer for unknown input descriptor \
                   systems\", IEEE Transactions on Automatic Control 47 (2002) 2057-2062",
    },
];
