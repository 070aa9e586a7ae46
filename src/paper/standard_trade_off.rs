//! The picture of a sweep: what more speed gains, what it costs, and one against the other.

use super::figure::{Axis, FigureSpec, Panel, Role, Series};
use crate::observer::ErrorGain;
use crate::simulation::{Sweep, TradeOff, TradeOffPoint};
use crate::system::TimeDomain;

/// Number of the colour of the chosen design, that of true values in other pictures.
const CHOSEN: usize = 7;

/// A number of a design that a curve shows; what is not a positive number has no place on a logarithmic axis.
type Measure = fn(&TradeOffPoint) -> Option<f64>;

/// Name, colour and value of a curve.
type Curve = (&'static str, usize, Measure);

const GAINED: [Curve; 2] = [
    ("slowest mode of the error", 0, |point| point.design.margin),
    ("d is tracked up to", 1, |point| point.bandwidth),
];

const COSTS: [Curve; 7] = [
    ("guaranteed gamma", 2, |point| point.design.guaranteed),
    ("d to e", 3, |point| norm(&point.design.gains.d_to_e)),
    ("d to e_d", 1, |point| norm(&point.design.gains.d_to_e_d)),
    ("noise to e", 4, |point| norm(&point.design.gains.w_to_e)),
    ("noise to e_d", 5, |point| norm(&point.design.gains.w_to_e_d)),
    ("|L|", 6, |point| Some(point.design.output_gain)),
    ("|V|", 0, |point| Some(point.design.direct_gain)),
];

/// How many of the costs are gains to the error.
const ERRORS: usize = 5;

fn norm(gain: &ErrorGain) -> Option<f64> {
    gain.value()
}

/// Draws a sweep.
pub fn trade_off_figure(found: &TradeOff, time: TimeDomain) -> FigureSpec {
    let (label, logarithmic) = match (found.sweep, time) {
        (Sweep::Scale, _) => ("bandwidth factor", true),
        (Sweep::Decay, TimeDomain::Continuous) => ("decay (1/s): Re s < -decay", true),
        (Sweep::Decay, TimeDomain::Discrete) => ("decay: |z| < decay", false),
    };
    let x = Axis { label: label.to_owned(), logarithmic, range: None };
    let at = |point: &TradeOffPoint| Some(point.at);
    let speed = match time {
        TimeDomain::Continuous => "1/s, rad/s",
        TimeDomain::Discrete => "1 - |z|, rad/step",
    };
    let panels = [
        panel(found, "What is gained", x.clone(), (speed, at), &GAINED),
        panel(found, "What reaches the error, and the gains it takes", x, ("", at), &COSTS),
        against(found, speed),
    ];
    FigureSpec {
        id: "trade-off".to_owned(),
        title: "Trade-off".to_owned(),
        caption: match found.sweep {
            Sweep::Scale => "One design for each bandwidth factor; the vertical line is the chosen one.",
            Sweep::Decay => "One design for each demand on the decay; the vertical line is the chosen one.",
        }
        .to_owned(),
        see: "Faster modes forget the initial error sooner and follow the unknown input further; the noise that they pass \
              grows."
            .to_owned(),
        columns: 2,
        panels: panels.into_iter().filter(|panel| !panel.series.is_empty()).collect(),
        notes: found.notes.clone(),
    }
}

fn panel(found: &TradeOff, title: &str, x: Axis, (label, at): (&str, Measure), curves: &[Curve]) -> Panel {
    let mut panel = Panel {
        title: title.to_owned(),
        x,
        y: Axis { label: label.to_owned(), logarithmic: true, range: None },
        series: curves.iter().filter_map(|curve| series(found, at, curve)).collect(),
    };
    mark(&mut panel, found.chosen);
    panel
}

/// A curve over what `at` says; none when it has no point.
fn series(found: &TradeOff, at: Measure, (name, colour, value): &Curve) -> Option<Series> {
    let positive = |x: f64| x.is_finite() && x > 0.0;
    let point = |point: &TradeOffPoint| Some([at(point)?, value(point).filter(|y| positive(*y))?]);
    let points: Vec<[f64; 2]> = found.points.iter().filter_map(point).collect();
    (points.len() > 1).then(|| Series {
        name: (*name).to_owned(),
        role: Role::Response,
        colour: *colour,
        points,
    })
}

/// A vertical line where the chosen design stands.
fn mark(panel: &mut Panel, chosen: Option<f64>) {
    let (Some(at), Some([low_x, high_x, low, high])) = (chosen, panel.bounds()) else { return };
    if (low_x..=high_x).contains(&at) && low < high {
        panel.series.push(Series {
            name: "chosen".to_owned(),
            role: Role::Error,
            colour: CHOSEN,
            points: vec![[at, low], [at, high]],
        });
    }
}

/// What the error gains from noise (by matrix inequalities: the guaranteed attenuation) over the speed.
fn against(found: &TradeOff, speed: &str) -> Panel {
    let at: Measure = |point| point.bandwidth.or(point.design.margin).filter(|x| *x > 0.0);
    panel(
        &TradeOff { chosen: None, ..found.clone() },
        "One against the other",
        Axis { label: format!("speed ({speed})"), logarithmic: true, range: None },
        ("", at),
        &COSTS[..ERRORS],
    )
}
