//! Frequency responses: transfer functions of a design, sampled as magnitude and phase.

use super::figure::{Axis, Panel, Role, Series};
use super::recipe::Transfer;
use crate::numerics::Complex64;
use crate::observer::{LinearObserver, unknown_input_response};
use crate::system::{DescriptorSystem, TimeDomain};

/// The point of the complex plane that belongs to an angular frequency: `i omega`, or `e^(i omega)` per step.
pub(super) fn frequency(time: TimeDomain, omega: f64) -> Complex64 {
    match time {
        TimeDomain::Continuous => Complex64::new(0.0, omega),
        TimeDomain::Discrete => Complex64::from_polar(1.0, omega),
    }
}

/// A transfer function at one point; `None` where it does not exist.
pub(super) fn transfer_at(
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

/// Magnitude in dB above phase in degrees (unwrapped), one curve for each named observer.
pub(super) fn bode_panels(
    title: &str,
    range: [f64; 2],
    observers: &[(&str, &LinearObserver)],
    response: impl Fn(&LinearObserver, f64) -> Option<Complex64>,
) -> [Panel; 2] {
    let frequencies = bode_frequencies(range);
    let curve = |observer: &LinearObserver| {
        bode_curve(&frequencies, frequencies.iter().map(|omega| response(observer, *omega)))
    };
    let curves: Vec<(String, [Vec<[f64; 2]>; 2])> =
        observers.iter().map(|(name, observer)| ((*name).to_owned(), curve(observer))).collect();
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
