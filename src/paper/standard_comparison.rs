//! The common views of several designs: states, errors, unknown inputs and gains, each design in its own colour.

use serde::{Deserialize, Serialize};

use super::compute::{bode_frequencies, samples, time_label};
use super::figure::{Axis, FigureSpec, Panel, Role, Series};
use super::recipe::Quantity;
use crate::numerics::{Complex64, complex_svd, eigenvalues};
use crate::observer::{ErrorGain, ErrorGains, ErrorStateSpace};
use crate::simulation::Trajectory;
use crate::simulation::comparison::{Compared, ComparedRun};
use crate::system::{DescriptorSystem, TimeDomain};
use nalgebra::DMatrix;

/// The figures of a comparison; those that would be empty are left out.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct ComparisonFigures {
    /// True states and all estimates.
    pub states: Option<FigureSpec>,
    /// The errors of all designs over each other.
    pub errors: Option<FigureSpec>,
    /// Unknown inputs and all estimates.
    pub unknown_input: Option<FigureSpec>,
    /// Largest gains over frequency, from unknown input and from noise.
    pub gains: Option<FigureSpec>,
}

impl ComparisonFigures {
    /// Those that exist, in the order in which they are offered.
    pub fn all(&self) -> impl Iterator<Item = &FigureSpec> {
        [&self.states, &self.errors, &self.unknown_input, &self.gains].into_iter().flatten()
    }
}

/// Number of the colour of true values.
pub(super) const TRUTH: usize = 7;
/// Numbers of the colours of designs: first those with a good contrast on any ground.
const DESIGNS: [usize; 7] = [0, 1, 2, 3, 5, 4, 6];

/// The colour of a design by its place in the table; the same on every picture.
pub fn design_colour(row: usize) -> usize {
    DESIGNS[row % DESIGNS.len()]
}

/// The stroke of a design: dashes where colours begin again, so that no two designs look the same.
pub(super) fn role_of(row: usize, first: Role) -> Role {
    if row < DESIGNS.len() { first } else { Role::Other }
}

/// Draws a comparison.
pub fn comparison(compared: &Compared, system: &DescriptorSystem) -> ComparisonFigures {
    let draw = Draw { compared, time: system.time };
    let (n, q) = (system.n_states(), system.n_unknown_inputs());
    let states = (0..n).map(|i| draw.panel(&format!("x{}", i + 1), Quantity::State, Quantity::Estimate, i));
    let unknown = (0..q).map(|i| {
        draw.panel(&format!("d{}", i + 1), Quantity::UnknownInput, Quantity::UnknownInputEstimate, i)
    });
    let errors = (0..n).map(|i| draw.errors(&format!("e{} = x{0} - x{0}_hat", i + 1), Quantity::Error, i));
    let errors_of_d =
        (0..q).map(|i| draw.errors(&format!("error of d{}", i + 1), Quantity::UnknownInputError, i));
    ComparisonFigures {
        states: figure(
            ("comparison-states", "States of all designs"),
            "True states (solid) and the estimates of all designs (dashed).",
            states.collect(),
        ),
        errors: figure(
            ("comparison-errors", "Errors of all designs"),
            "Estimation errors of all designs in the same scenario.",
            errors.chain(errors_of_d).collect(),
        ),
        unknown_input: figure(
            ("comparison-unknown-input", "Unknown input of all designs"),
            "Unknown inputs (solid) and the estimates of the designs that have one (dashed).",
            unknown.collect(),
        ),
        gains: gains(&draw),
    }
}

pub(super) struct Draw<'a> {
    pub(super) compared: &'a Compared,
    pub(super) time: TimeDomain,
}

impl Draw<'_> {
    pub(super) fn name(&self, run: &ComparedRun) -> String {
        self.compared.comparison.rows.get(run.row).map_or_else(String::new, |row| row.name.clone())
    }

    /// The truth once, and the estimate of every design that has one.
    fn panel(&self, title: &str, truth: Quantity, estimate: Quantity, index: usize) -> Panel {
        let first = self.compared.runs.iter().filter_map(|run| run.motion.as_ref());
        // the longest trajectory: an unstable observer may have ended its own early
        let longest = first.max_by_key(|motion| motion.trajectory.t.len());
        let truth = longest.map(|motion| Series {
            name: truth.name(index),
            role: Role::Truth,
            colour: TRUTH,
            points: samples(&motion.trajectory, motion.observer, truth, index),
        });
        let estimates = self.curves(estimate, index, Role::Estimate);
        self.time_panel(title, truth.into_iter().chain(estimates).collect())
    }

    fn errors(&self, title: &str, quantity: Quantity, index: usize) -> Panel {
        self.time_panel(title, self.curves(quantity, index, Role::Error).collect())
    }

    fn curves(&self, quantity: Quantity, index: usize, role: Role) -> impl Iterator<Item = Series> {
        self.compared.runs.iter().filter_map(move |run| {
            let motion = run.motion.as_ref()?;
            let state = matches!(quantity, Quantity::Estimate | Quantity::Error);
            if state && !self.estimated(run, index) {
                return None;
            }
            let trajectory: &Trajectory = &motion.trajectory;
            let points = samples(trajectory, motion.observer, quantity, index);
            (!points.is_empty()).then(|| Series {
                name: self.name(run),
                role: role_of(run.row, role),
                colour: design_colour(run.row),
                points,
            })
        })
    }

    /// Whether a design estimates a state, by its row in the table.
    pub(super) fn estimated(&self, run: &ComparedRun, state: usize) -> bool {
        let row = self.compared.comparison.rows.get(run.row).and_then(|row| row.outcome.as_ref().ok());
        row.is_some_and(|row| row.estimated.binary_search(&state).is_ok())
    }

    fn time_panel(&self, title: &str, series: Vec<Series>) -> Panel {
        Panel {
            title: title.to_owned(),
            x: Axis { label: time_label(self.time), ..Axis::default() },
            y: Axis::default(),
            series,
        }
    }
}

/// A figure of the panels that have curves.
pub(super) fn figure((id, title): (&str, &str), caption: &str, panels: Vec<Panel>) -> Option<FigureSpec> {
    let panels: Vec<Panel> = panels.into_iter().filter(|panel| !panel.series.is_empty()).collect();
    (!panels.is_empty()).then(|| FigureSpec {
        id: id.to_owned(),
        title: title.to_owned(),
        caption: caption.to_owned(),
        columns: 2,
        panels,
        ..FigureSpec::default()
    })
}

/// A way through an error system: from `d` or from the noise, to the error of states or of unknown inputs.
#[derive(Clone, Copy)]
struct Path {
    title: &'static str,
    of: fn(&ErrorGains) -> &ErrorGain,
    noise: bool,
    unknown: bool,
}

const PATHS: [Path; 4] = [
    Path { title: "unknown input to error of x", of: |g| &g.d_to_e, noise: false, unknown: false },
    Path { title: "unknown input to error of d", of: |g| &g.d_to_e_d, noise: false, unknown: true },
    Path { title: "noise to error of x", of: |g| &g.w_to_e, noise: true, unknown: false },
    Path { title: "noise to error of d", of: |g| &g.w_to_e_d, noise: true, unknown: true },
];

/// The largest singular values of the error systems over frequency, whose maxima are the norms of the table.
pub(super) fn gains(draw: &Draw<'_>) -> Option<FigureSpec> {
    let range = range(draw)?;
    let frequencies = bode_frequencies(range);
    let mut panels = vec![Vec::new(); PATHS.len()];
    let mut silent: Vec<String> = Vec::new();
    for run in &draw.compared.runs {
        let row = draw.compared.comparison.rows.get(run.row).and_then(|row| row.outcome.as_ref().ok());
        let (Some(errors), Some(row)) = (&run.errors, row) else { continue };
        for (panel, path) in panels.iter_mut().zip(PATHS) {
            match (path.of)(&row.gains) {
                ErrorGain::Norm(found) => panel.push(Series {
                    name: draw.name(run),
                    role: role_of(run.row, Role::Response),
                    colour: design_colour(run.row),
                    points: curve(errors, path, &with_peak(&frequencies, range, found.frequency)),
                }),
                ErrorGain::Decoupled => silent.push(format!("{}: {}", draw.name(run), path.title)),
                ErrorGain::NotEstimated
                | ErrorGain::NoInput
                | ErrorGain::NotFinite(_)
                | ErrorGain::NotComputed(_) => {}
            }
        }
    }
    let panels = PATHS.iter().zip(panels).map(|(path, series)| Panel {
        title: path.title.to_owned(),
        x: Axis { label: "frequency (rad/s)".to_owned(), logarithmic: true, range: Some(range) },
        y: Axis { label: "largest gain (dB)".to_owned(), ..Axis::default() },
        series,
    });
    let caption =
        "Largest singular values of the error systems; their peaks are the H-infinity norms of the table.";
    let mut figure = figure(("comparison-gains", "Gains of all designs"), caption, panels.collect())?;
    if !silent.is_empty() {
        figure.caption = format!("{caption} Zero, hence not drawn: {}.", silent.join("; "));
    }
    Some(figure)
}

/// Slower modes than this share of the fastest are rounding of a mode at zero.
const SLOWEST: f64 = 1e-9;

/// Two decades around the modes of all error systems and one around all peaks, whole decades.
fn range(draw: &Draw<'_>) -> Option<[f64; 2]> {
    let runs = || draw.compared.runs.iter().filter_map(|run| Some((run, run.errors.as_ref()?)));
    runs().next()?;
    if draw.time == TimeDomain::Discrete {
        return Some([1e-3, std::f64::consts::PI]);
    }
    let modes = runs().flat_map(|(_, errors)| eigenvalues(&errors.a).unwrap_or_default());
    let mut speeds: Vec<f64> = modes.map(Complex64::norm).filter(|speed| *speed > 0.0).collect();
    let fastest = speeds.iter().copied().fold(0.0, f64::max);
    speeds.retain(|speed| *speed > SLOWEST * fastest);
    let rows = draw.compared.comparison.rows.iter().filter_map(|row| row.outcome.as_ref().ok());
    let peaks = rows.flat_map(|row| PATHS.map(|path| peak((path.of)(&row.gains)))).flatten();
    let (mut low, mut high) = (f64::INFINITY, 0.0_f64);
    let around = speeds.into_iter().map(|speed| (speed, 100.0)).chain(peaks.map(|peak| (peak, 10.0)));
    for (at, factor) in around {
        (low, high) = (low.min(at / factor), high.max(at * factor));
    }
    // without modes and peaks nothing depends on the frequency
    let [low, high] = if low.is_finite() { [low, high] } else { [1e-2, 1e2] };
    Some([10_f64.powf(low.log10().floor()), 10_f64.powf(high.log10().ceil())])
}

/// The frequency of a peak that a logarithmic axis can show.
fn peak(gain: &ErrorGain) -> Option<f64> {
    match gain {
        ErrorGain::Norm(found) => Some(found.frequency).filter(|at| *at > 0.0 && at.is_finite()),
        _ => None,
    }
}

/// The frequencies of a curve with the one of its peak, which may be too narrow for the others.
fn with_peak(frequencies: &[f64], [low, high]: [f64; 2], peak: f64) -> Vec<f64> {
    let mut all = frequencies.to_vec();
    all.extend((low..=high).contains(&peak).then_some(peak));
    all.sort_by(f64::total_cmp);
    all
}

/// Gains in dB; gaps where there is none.
fn curve(errors: &ErrorStateSpace, path: Path, frequencies: &[f64]) -> Vec<[f64; 2]> {
    let n = errors.states.len();
    let point = |omega: f64| {
        let (from_d, from_w) = errors.response(errors.point(omega))?;
        let all = if path.noise { from_w } else { from_d };
        let part = if path.unknown { all.rows(n, all.nrows() - n) } else { all.rows(0, n) };
        let gain = largest(&part.into_owned())?;
        (gain > 0.0).then(|| [omega, 20.0 * gain.log10()])
    };
    frequencies.iter().filter_map(|omega| point(*omega)).collect()
}

fn largest(matrix: &DMatrix<Complex64>) -> Option<f64> {
    complex_svd(matrix).ok()?.s.first().copied()
}
