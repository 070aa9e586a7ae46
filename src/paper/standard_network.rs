//! The standard views of a network: the whole, the subsystems that are estimated, some others, outputs.

use super::compute::{colour_of, role_of, time_label};
use super::figure::{Axis, FigureSpec, Panel, Series};
use super::motion::Motion;
use super::recipe::Quantity;
use super::standard::figure;
use crate::system::{Network, TimeDomain};

/// Panels of single states; more would be too small to be read.
const MOST_STATES: usize = 30;

/// Subsystems that are shown without being estimated, one panel each.
const MOST_OTHERS: usize = 4;

/// Panels of the whole.
const MOST_BLOCKS: usize = 8;

/// Curves in one panel; more would not be told apart.
const MOST_CURVES: usize = 8;

/// The subsystems that the standard views show, from zero.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Shown {
    /// Those of which states are estimated: a panel for each of these.
    observed: Vec<usize>,
    /// Some of those that are not: their true states in one panel.
    others: Vec<usize>,
    /// What is left out.
    notes: Vec<String>,
}

impl Shown {
    /// Estimated subsystems first, those of which only some states are after them; of all no more than can be read.
    pub fn of(network: &Network, estimated: &[usize]) -> Self {
        let n = network.a.nrows();
        let mut count = vec![0; network.n_subsystems()];
        for k in estimated {
            if let Some(count) = count.get_mut(k / n) {
                *count += 1;
            }
        }
        let with = |wanted: fn(usize, usize) -> bool| {
            let found = count.iter().enumerate().filter(move |(_, count)| wanted(**count, n));
            found.map(|(i, _)| i).collect::<Vec<usize>>()
        };
        let mut observed = with(|count, n| count == n);
        observed.extend(with(|count, n| count > 0 && count < n));
        let rest = with(|count, _| count == 0);
        let mut notes = Vec::new();
        if !rest.is_empty() {
            notes.push(format!(
                "not estimated, because the whole does not determine them and no local observer is plugged in: {}",
                listed(&rest)
            ));
        }
        let most = (MOST_STATES / n).max(1);
        if observed.len() > most {
            notes.push(format!("{most} of the {} subsystems that are estimated are shown", observed.len()));
            observed.truncate(most);
        }
        let others: Vec<usize> = rest.into_iter().take(MOST_OTHERS).collect();
        Self { observed, others, notes }
    }

    /// All of them, in the order in which they are shown.
    pub fn all(&self) -> Vec<usize> {
        self.observed.iter().chain(&self.others).copied().collect()
    }

    /// What is left out, and why.
    pub fn notes(&self) -> &[String] {
        &self.notes
    }
}

/// `subsystems 1, 2, 3 and 7 others`, from one.
fn listed(subsystems: &[usize]) -> String {
    const NAMED: usize = 6;
    let named: Vec<String> = subsystems.iter().take(NAMED).map(|i| (i + 1).to_string()).collect();
    let rest = subsystems.len().saturating_sub(NAMED);
    let others = if rest > 0 { format!(" and {rest} others") } else { String::new() };
    let word = if subsystems.len() == 1 { "subsystem" } else { "subsystems" };
    format!("{word} {}{others}", named.join(", "))
}

/// The whole in blocks, then each state of the subsystems that are estimated, then the others.
pub fn states(network: &Network, motion: &Motion, shown: &Shown) -> FigureSpec {
    let n = network.a.nrows();
    let mut panels: Vec<Panel> = blocks(motion)
        .map(|block| {
            let show = block.iter().flat_map(|&k| [(Quantity::Whole, k), (Quantity::WholeEstimate, k)]);
            panel(motion, &format!("{} of the whole", span(&block)), show)
        })
        .collect();
    for &i in &shown.observed {
        for j in (0..n).filter(|j| motion.estimated().binary_search(&(n * i + j)).is_ok()).take(MOST_STATES) {
            let k = n * i + j;
            let title = format!("x{} of subsystem {} (x{})", j + 1, i + 1, k + 1);
            panels.push(panel(motion, &title, [(Quantity::State, k), (Quantity::Estimate, k)]));
        }
    }
    for &i in &shown.others {
        let title = format!("subsystem {}, not estimated", i + 1);
        panels.push(panel(motion, &title, (0..n).take(MOST_CURVES).map(|j| (Quantity::State, n * i + j))));
    }
    let caption = "The state z of the network as a whole and the subsystems' states (solid) with their estimates (dashed).";
    FigureSpec { notes: notes(motion, shown), ..figure("states", "States", caption, panels.into_iter()) }
}

/// Errors of the whole and of the subsystems that are estimated; nothing is claimed of the others.
pub fn errors(network: &Network, motion: &Motion, shown: &Shown) -> FigureSpec {
    let n = network.a.nrows();
    let whole = blocks(motion).map(|block| {
        let title = format!("z - z_hat, {}", span(&block));
        panel(motion, &title, block.iter().map(|&k| (Quantity::WholeError, k)))
    });
    let subsystems = shown.observed.iter().map(|&i| {
        let title = format!("e = x - x_hat of subsystem {}", i + 1);
        panel(motion, &title, (0..n).take(MOST_CURVES).map(|j| (Quantity::Error, n * i + j)))
    });
    let panels: Vec<Panel> = whole.chain(subsystems).collect();
    let caption = "Errors of the whole and of the subsystems that are estimated.";
    FigureSpec { notes: notes(motion, shown), ..figure("errors", "Errors", caption, panels.into_iter()) }
}

/// The global outputs, and the local ones of the subsystems shown.
pub fn outputs(network: &Network, motion: &Motion, shown: &Shown) -> FigureSpec {
    let (global, q) = (network.Psi.nrows() * network.c_G.nrows(), network.c_L.nrows());
    let all =
        |first: usize, count: usize| (0..count.min(MOST_CURVES)).map(move |k| (Quantity::Output, first + k));
    let mut panels = vec![panel(motion, "global outputs", all(0, global))];
    for i in shown.all() {
        if let Some(place) = network.local.iter().position(|other| *other == i) {
            panels.push(panel(
                motion,
                &format!("outputs of subsystem {}", i + 1),
                all(global + q * place, q),
            ));
        }
    }
    panels.retain(|panel| !panel.series.is_empty());
    let caption = "What the observers are given: global outputs, and local outputs of subsystems.";
    figure("unknown-input", "Outputs", caption, panels.into_iter())
}

/// Components of the whole that belong together, as many as can be read.
fn blocks(motion: &Motion) -> impl Iterator<Item = Vec<usize>> {
    let (order, block) = (motion.order_of_whole(), motion.block_of_whole().clamp(1, MOST_CURVES));
    (0..order).step_by(block).take(MOST_BLOCKS).map(move |k| (k..order.min(k + block)).collect())
}

/// What the views leave out.
fn notes(motion: &Motion, shown: &Shown) -> Vec<String> {
    let last = blocks(motion).flatten().last().map_or(0, |k| k + 1);
    let order = motion.order_of_whole();
    let left_out = (last < order).then(|| format!("{last} of the {order} components of the whole are shown"));
    left_out.into_iter().chain(shown.notes.iter().cloned()).collect()
}

/// `z1` or `z3 to z4`.
fn span(block: &[usize]) -> String {
    let name = |k: Option<&usize>| k.map_or(String::new(), |k| Quantity::Whole.name(*k));
    let (first, last) = (name(block.first()), name(block.last()));
    if first == last { first } else { format!("{first} to {last}") }
}

fn panel(motion: &Motion, title: &str, show: impl IntoIterator<Item = (Quantity, usize)>) -> Panel {
    let series = show.into_iter().filter_map(|(quantity, index)| {
        let points = motion.samples(quantity, index);
        (!points.is_empty()).then(|| Series {
            name: quantity.name(index),
            role: role_of(quantity),
            colour: colour_of(quantity, index),
            points,
        })
    });
    Panel {
        title: title.to_owned(),
        x: Axis { label: time_label(TimeDomain::Continuous), ..Axis::default() },
        y: Axis::default(),
        series: series.collect(),
    }
}
