//! The common views of several observers of a network that is never written as one system.

use super::compute::time_label;
use super::figure::{Axis, FigureSpec, Panel, Role, Series};
use super::recipe::Quantity;
use super::standard_comparison::{ComparisonFigures, Draw, TRUTH, design_colour, figure, gains, role_of};
use crate::simulation::comparison::{Compared, ComparedRun};
use crate::simulation::{NetworkTrajectory, SubsystemTrajectory};
use crate::system::{Network, TimeDomain};

/// Components of the whole that have a panel.
const MOST_OF_WHOLE: usize = 4;

/// Draws a comparison of observers of a network: the first components of the whole, which all designs estimate, then the
/// states of the subsystems that were simulated.
pub fn network_comparison(compared: &Compared, network: &Network) -> ComparisonFigures {
    let draw = Draw { compared, time: TimeDomain::Continuous };
    let motions: Vec<(&ComparedRun, &NetworkTrajectory)> =
        compared.runs.iter().filter_map(|run| Some((run, run.network.as_ref()?))).collect();
    let notes = left_out(compared, network, &motions);
    let with_notes = |figure: FigureSpec| FigureSpec { notes: notes.clone(), ..figure };
    let views = Views { draw: &draw, motions };
    ComparisonFigures {
        states: figure(
            ("comparison-states", "States of all designs"),
            "True states of the whole z and of subsystems (solid) and the estimates of all designs (dashed).",
            views.panels(network, false),
        )
        .map(with_notes),
        errors: figure(
            ("comparison-errors", "Errors of all designs"),
            "Estimation errors of all designs in the same scenario; nothing is claimed of states that a design does not \
             estimate.",
            views.panels(network, true),
        )
        .map(with_notes),
        unknown_input: None,
        gains: gains(&draw),
    }
}

/// What the figures leave out.
fn left_out(
    compared: &Compared,
    network: &Network,
    motions: &[(&ComparedRun, &NetworkTrajectory)],
) -> Vec<String> {
    let shown = motions.first().map_or(0, |(_, motion)| motion.subsystems.len());
    let n = network.a.nrows();
    let rows = compared.comparison.rows.iter().filter_map(|row| row.outcome.as_ref().ok());
    let mut estimated: Vec<usize> =
        rows.flat_map(|row| row.estimated.iter().map(|state| state / n)).collect();
    estimated.sort_unstable();
    estimated.dedup();
    let whole = motions.first().map_or(0, |(_, motion)| motion.z.nrows());
    let of_whole = (whole > MOST_OF_WHOLE)
        .then(|| format!("the first {MOST_OF_WHOLE} of {whole} components of the whole are shown"));
    let of_parts = (estimated.len() > shown).then(|| {
        format!(
            "{shown} of the {} subsystems that are estimated are shown; the table has the errors of all",
            estimated.len()
        )
    });
    of_whole.into_iter().chain(of_parts).collect()
}

struct Views<'a> {
    draw: &'a Draw<'a>,
    motions: Vec<(&'a ComparedRun, &'a NetworkTrajectory)>,
}

impl Views<'_> {
    fn panels(&self, network: &Network, errors: bool) -> Vec<Panel> {
        let n = network.a.nrows();
        let Some(&(_, first)) = self.motions.iter().max_by_key(|(_, motion)| motion.t.len()) else {
            return Vec::new();
        };
        let whole = (0..first.z.nrows().min(MOST_OF_WHOLE)).map(|k| {
            let of = |motion: &NetworkTrajectory, estimate: bool| -> Vec<f64> {
                let all = if estimate { &motion.z_hat } else { &motion.z };
                all.row(k).iter().copied().collect()
            };
            let name = Quantity::Whole.name(k);
            let title = if errors { format!("{name} - {name}_hat") } else { format!("{name} of the whole") };
            self.panel(&title, (&name, first, errors), of, |_| true)
        });
        let parts = first.subsystems.iter().enumerate().flat_map(|(place, part)| {
            (0..n).map(move |j| (place, j, n * part.subsystem + j, part.subsystem))
        });
        let parts = parts.map(|(place, j, k, subsystem)| {
            let of = move |motion: &NetworkTrajectory, estimate: bool| -> Vec<f64> {
                let Some(SubsystemTrajectory { x, x_hat, .. }) = motion.subsystems.get(place) else {
                    return Vec::new();
                };
                (if estimate { x_hat } else { x }).row(j).iter().copied().collect()
            };
            let name = Quantity::State.name(k);
            let title = if errors {
                format!("e{} = {name} - {name}_hat", k + 1)
            } else {
                format!("x{} of subsystem {} ({name})", j + 1, subsystem + 1)
            };
            self.panel(&title, (&name, first, errors), of, |run| self.draw.estimated(run, k))
        });
        whole.chain(parts).collect()
    }

    /// Truth and estimates of one component, or its errors.
    fn panel(
        &self,
        title: &str,
        (name, longest, errors): (&str, &NetworkTrajectory, bool),
        of: impl Fn(&NetworkTrajectory, bool) -> Vec<f64>,
        estimated: impl Fn(&ComparedRun) -> bool,
    ) -> Panel {
        let points = |motion: &NetworkTrajectory, values: Vec<f64>| -> Vec<[f64; 2]> {
            motion.t.iter().zip(values).map(|(t, value)| [*t, value]).collect()
        };
        let truth = (!errors).then(|| Series {
            name: name.to_owned(),
            role: Role::Truth,
            colour: TRUTH,
            points: points(longest, of(longest, false)),
        });
        let curves = self.motions.iter().filter(|(run, _)| estimated(run)).map(|(run, motion)| {
            let mut values = of(motion, true);
            if errors {
                let truth = of(motion, false);
                values = truth.into_iter().zip(values).map(|(x, x_hat)| x - x_hat).collect();
            }
            Series {
                name: self.draw.name(run),
                role: role_of(run.row, if errors { Role::Error } else { Role::Estimate }),
                colour: design_colour(run.row),
                points: points(motion, values),
            }
        });
        Panel {
            title: title.to_owned(),
            x: Axis { label: time_label(TimeDomain::Continuous), ..Axis::default() },
            y: Axis::default(),
            series: truth.into_iter().chain(curves).collect(),
        }
    }
}
