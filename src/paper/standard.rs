//! The standard views of any design: states, errors, unknown input, Bode.

use super::compute::{bode_curve, bode_frequencies, colour_of, frequency, role_of, samples, time_label};
use super::figure::{Axis, FigureSpec, Panel, Role, Series};
use super::recipe::Quantity;
use crate::numerics::Complex64;
use crate::observer::{Design, LinearObserver, Response, unknown_input_response};
use crate::simulation::Trajectory;
use crate::system::{DescriptorSystem, Subsystem, TimeDomain};

/// True and estimated states, one panel each; in a partitioned system the title names the subsystem.
pub fn states(trajectory: &Trajectory, time: TimeDomain, partition: &[Subsystem]) -> FigureSpec {
    let panel = |i| {
        let title = owner(partition, i)
            .map_or_else(|| format!("x{}", i + 1), |name| format!("x{} of subsystem {name}", i + 1));
        panel(trajectory, time, &title, &[(Quantity::State, i), (Quantity::Estimate, i)])
    };
    figure(
        "states",
        "States",
        "True states (solid) and estimates (dashed).",
        (0..trajectory.x.nrows()).map(panel),
    )
}

/// Estimation errors in one panel for each subsystem, and the error of the unknown input in another.
pub fn errors(trajectory: &Trajectory, time: TimeDomain, partition: &[Subsystem]) -> FigureSpec {
    let of = |quantity, count: usize| (0..count).map(move |i| (quantity, i)).collect::<Vec<_>>();
    let all = of(Quantity::Error, trajectory.x.nrows());
    let mut panels = Vec::new();
    let mut rest = all.as_slice();
    for (k, subsystem) in partition.iter().enumerate() {
        let (own, others) = rest.split_at(subsystem.states.min(rest.len()));
        let title = format!("e = x - x_hat of subsystem {}", name(subsystem, k));
        panels.push(panel(trajectory, time, &title, own));
        rest = others;
    }
    if !rest.is_empty() {
        panels.push(panel(trajectory, time, "e = x - x_hat", rest));
    }
    let estimated = trajectory.observers.first().map_or(0, |o| o.d_hat.nrows());
    if estimated > 0 {
        panels.push(panel(trajectory, time, "d - d_hat", &of(Quantity::UnknownInputError, estimated)));
    }
    figure("errors", "Errors", "Estimation errors.", panels.into_iter())
}

/// Name of the subsystem that a state belongs to.
fn owner(partition: &[Subsystem], state: usize) -> Option<String> {
    let mut first = 0;
    for (k, subsystem) in partition.iter().enumerate() {
        first += subsystem.states;
        if state < first {
            return Some(name(subsystem, k));
        }
    }
    None
}

/// The name of a subsystem, or its number when it has none.
fn name(subsystem: &Subsystem, k: usize) -> String {
    if subsystem.name.is_empty() { (k + 1).to_string() } else { subsystem.name.clone() }
}

/// Unknown inputs with their estimates, known inputs and outputs.
pub fn unknown_inputs(trajectory: &Trajectory, time: TimeDomain) -> FigureSpec {
    let unknown = (0..trajectory.d.nrows()).map(|i| {
        panel(
            trajectory,
            time,
            &format!("d{}", i + 1),
            &[(Quantity::UnknownInput, i), (Quantity::UnknownInputEstimate, i)],
        )
    });
    let all = |quantity, count: usize| (0..count).map(move |i| (quantity, i)).collect::<Vec<_>>();
    let inputs = (trajectory.u.nrows() > 0)
        .then(|| panel(trajectory, time, "known inputs", &all(Quantity::Input, trajectory.u.nrows())));
    let outputs = (trajectory.y.nrows() > 0)
        .then(|| panel(trajectory, time, "measured outputs", &all(Quantity::Output, trajectory.y.nrows())));
    figure(
        "unknown-input",
        "Unknown input",
        "Unknown inputs (solid) with their estimates (dashed); known inputs and measured outputs.",
        unknown.chain(inputs).chain(outputs),
    )
}

/// Bode diagrams of the joint system: `d -> d_hat` and `d -> e`, for the first unknown input.
pub fn bode(system: &DescriptorSystem, design: &Design) -> Option<FigureSpec> {
    if system.n_unknown_inputs() == 0 {
        return None;
    }
    let range = bode_range(&design.observer, system.time);
    let frequencies = bode_frequencies(range);
    // every curve comes from the same joint solve at each frequency
    let responses: Vec<Option<Response>> = frequencies
        .iter()
        .map(|omega| unknown_input_response(frequency(system.time, *omega), system, &design.observer))
        .collect();
    let curve = |value: &dyn Fn(&Response) -> Complex64| {
        bode_curve(&frequencies, responses.iter().map(|response| response.as_ref().map(value)))
    };
    let mut magnitudes = Vec::new();
    let mut phases = Vec::new();
    let mut add = |name: String, role, colour, [magnitude, phase]: [Vec<[f64; 2]>; 2]| {
        if !magnitude.is_empty() {
            magnitudes.push(Series { name: name.clone(), role, colour, points: magnitude });
            phases.push(Series { name, role, colour, points: phase });
        }
    };
    if design.observer.n_estimated_inputs() > 0 {
        add("d1 to d1_hat".to_owned(), Role::Response, 7, curve(&|r| r.d_hat[(0, 0)]));
    }
    let mut silent: Vec<String> = Vec::new();
    for i in 0..system.n_states().min(MOST_CURVES) {
        if responses.iter().flatten().all(|r| is_rounding(r, i)) {
            silent.push(format!("e{}", i + 1));
            continue;
        }
        add(format!("d1 to e{}", i + 1), Role::Error, i, curve(&|r| r.x[(i, 0)] - r.x_hat[(i, 0)]));
    }
    if magnitudes.is_empty() {
        return None;
    }
    let x = Axis { label: "frequency (rad/s)".to_owned(), logarithmic: true, range: Some(range) };
    let panel = |title: &str, label: &str, series| Panel {
        title: title.to_owned(),
        x: x.clone(),
        y: Axis { label: label.to_owned(), ..Axis::default() },
        series,
    };
    let mut caption =
        "From the unknown input to its estimate and to the errors, plant and observer together.".to_owned();
    if !silent.is_empty() {
        caption = format!("{caption} Zero, hence not drawn: d1 to {}.", silent.join(", "));
    }
    let panels = [panel("", "magnitude (dB)", magnitudes), panel("", "phase (degrees)", phases)];
    Some(figure("bode", "Bode", &caption, panels.into_iter()))
}

/// Share of state and estimate below which their difference is rounding.
const ROUNDING: f64 = 1e-10;

/// Whether the error of a state is nothing but what rounding leaves of state and estimate.
fn is_rounding(response: &Response, state: usize) -> bool {
    let column = |m: &nalgebra::DMatrix<Complex64>| m.column(0).norm();
    let size = column(&response.x) + column(&response.x_hat);
    (response.x[(state, 0)] - response.x_hat[(state, 0)]).norm() <= ROUNDING * size
}

/// Error curves in one Bode diagram; more would not be told apart.
const MOST_CURVES: usize = 6;

/// Two decades around the observer's own speed, a whole number of decades.
fn bode_range(observer: &LinearObserver, time: TimeDomain) -> [f64; 2] {
    if time == TimeDomain::Discrete {
        return [1e-3, std::f64::consts::PI];
    }
    let speed = observer.N.norm().max(1e-3) / (observer.order().max(1) as f64).sqrt();
    let decade = speed.log10().round();
    [10_f64.powf(decade - 4.0), 10_f64.powf(decade + 2.0)]
}

pub(super) fn figure(
    id: &str,
    title: &str,
    caption: &str,
    panels: impl Iterator<Item = Panel>,
) -> FigureSpec {
    FigureSpec {
        id: id.to_owned(),
        title: title.to_owned(),
        caption: caption.to_owned(),
        columns: 2,
        panels: panels.collect(),
        ..FigureSpec::default()
    }
}

fn panel(trajectory: &Trajectory, time: TimeDomain, title: &str, show: &[(Quantity, usize)]) -> Panel {
    let series = show.iter().filter_map(|&(quantity, index)| {
        let points = samples(trajectory, 0, quantity, index);
        (!points.is_empty()).then(|| Series {
            name: quantity.name(index),
            role: role_of(quantity),
            colour: colour_of(quantity, index),
            points,
        })
    });
    Panel {
        title: title.to_owned(),
        x: Axis { label: time_label(time), ..Axis::default() },
        y: Axis::default(),
        series: series.collect(),
    }
}
