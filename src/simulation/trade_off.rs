//! What more speed costs: one design after another along a sweep of the bandwidth factor, or of the demanded decay.

use nalgebra::DMatrix;
use serde::{Deserialize, Serialize};

use super::comparison::{ComparedDesign, LINEAR_PART, judged};
use crate::numerics::{Complex64, Tolerance, Watch, complex_svd};
use crate::observer::{DesignChoice, DesignError, ErrorStateSpace, LmiChoice, assess_knowing, conditions};
use crate::system::{Model, TimeDomain};

/// Designs along a sweep of the bandwidth factor.
const FACTORS: usize = 31;
/// The range of the factor, which is that of its slider.
const FACTOR: [f64; 2] = [0.1, 100.0];
/// Designs along a sweep of the decay.
const DECAYS: usize = 15;
/// A gain below this counts as tracked: -3 dB.
const TRACKED: f64 = std::f64::consts::FRAC_1_SQRT_2;
/// Frequencies at which the tracking of an unknown input is looked at before the edge is refined.
const FREQUENCIES: usize = 121;

/// What is swept.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Sweep {
    /// The bandwidth factor, which multiplies all poles.
    Scale,
    /// The decay that matrix inequalities have to keep.
    Decay,
}

/// Designs along a sweep, in the order of their speed.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct TradeOff {
    /// What is swept.
    pub sweep: Sweep,
    /// Where the chosen design stands, if it does.
    pub chosen: Option<f64>,
    /// The designs that exist.
    pub points: Vec<TradeOffPoint>,
    /// What the norms leave out, and why the sweep ends where it does, or has gaps.
    pub notes: Vec<String>,
}

/// One design of a sweep.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct TradeOffPoint {
    /// The factor or the decay.
    pub at: f64,
    /// What is known of the design.
    pub design: ComparedDesign,
    /// Up to this angular frequency, in rad/s (discrete: rad/step), the unknown input is tracked: the gain from `d` to
    /// `d_hat - d` stays below -3 dB. `None` where it is not estimated, is not tracked at all, or is tracked everywhere.
    pub bandwidth: Option<f64>,
}

/// Designs along a sweep of the choice's own knob: the bandwidth factor for pole placement, the decay for matrix
/// inequalities. `None` when `watch` said stop.
///
/// # Errors
/// A sentence when not a single design exists.
pub fn trade_off(
    model: &Model,
    choice: &DesignChoice,
    tolerance: &Tolerance,
    watch: &Watch,
) -> Option<Result<TradeOff, String>> {
    let (sweep, chosen, values) = sweep(model, choice);
    let notes = model.lipschitz.iter().map(|_| LINEAR_PART.to_owned()).collect();
    let mut found = TradeOff { sweep, chosen, points: Vec::new(), notes };
    let mut last = None;
    // a factor moves poles, on which no condition depends; a decay may decide a condition
    let asked = match sweep {
        Sweep::Scale => conditions(model, choice, tolerance).ok(),
        Sweep::Decay => None,
    };
    for (k, &at) in values.iter().enumerate() {
        let part = |k: usize| k as f32 / values.len() as f32;
        if !watch.go_on(part(k), "designs along the sweep") {
            return None;
        }
        let choice = swept(choice, sweep, at);
        let conditions = match &asked {
            Some(asked) => Ok(asked.clone()),
            None => conditions(model, &choice, tolerance),
        };
        let watch = watch.part(part(k), part(k + 1));
        let outcome = conditions
            .map_err(|error| DesignError::Numerics(error.to_string()))
            .and_then(|found| assess_knowing(model, &choice, found, tolerance, &watch).outcome);
        let judged = outcome.and_then(|design| Ok(judged(&model.system, &design, tolerance)?));
        match judged {
            Ok((design, errors)) => {
                let bandwidth =
                    errors.as_ref().and_then(|errors| bandwidth(errors, &design.spectrum, model.system.time));
                found.points.push(TradeOffPoint { at, design, bandwidth });
            }
            Err(DesignError::Cancelled) => return None,
            Err(error) => {
                last = Some(error.to_string());
                // every further demand is harder, and each refusal is searched for what would be feasible
                if sweep == Sweep::Decay {
                    found.notes.push(format!("at a decay of {at:.3} there is no design: {error}"));
                    break;
                }
            }
        }
    }
    Some(match last {
        Some(error) if found.points.is_empty() => Err(error),
        Some(error) if sweep == Sweep::Scale => {
            found.notes.push(format!("some factors have no design: {error}"));
            Ok(found)
        }
        _ => Ok(found),
    })
}

/// What is swept, where the chosen design stands, and the values in the order of growing speed.
fn sweep(model: &Model, choice: &DesignChoice) -> (Sweep, Option<f64>, Vec<f64>) {
    if !choice.method.uses_lmi() {
        let values = between(FACTOR, FACTORS);
        return (Sweep::Scale, Some(choice.scale), with(values, choice.scale, false));
    }
    let chosen = choice.lmi.decay;
    match model.system.time {
        TimeDomain::Continuous => {
            let middle = chosen.filter(|decay| *decay > 0.0).unwrap_or(1.0);
            let values = between([0.05 * middle, 20.0 * middle], DECAYS);
            (Sweep::Decay, chosen, with(values, middle, false))
        }
        TimeDomain::Discrete => {
            let values = (1..=DECAYS).rev().map(|k| k as f64 / DECAYS as f64).collect();
            (
                Sweep::Decay,
                chosen,
                chosen.map_or_else(|| Vec::clone(&values), |at| with(values.clone(), at, true)),
            )
        }
    }
}

/// Values evenly spaced on a logarithmic axis, with both ends.
fn between([low, high]: [f64; 2], count: usize) -> Vec<f64> {
    (0..count).map(|k| low * (high / low).powf(k as f64 / (count - 1) as f64)).collect()
}

/// A sorted list with one value more.
fn with(mut values: Vec<f64>, value: f64, descending: bool) -> Vec<f64> {
    values.push(value);
    values.sort_by(f64::total_cmp);
    values.dedup();
    if descending {
        values.reverse();
    }
    values
}

fn swept(choice: &DesignChoice, sweep: Sweep, at: f64) -> DesignChoice {
    match sweep {
        Sweep::Scale => DesignChoice { scale: at, ..choice.clone() },
        Sweep::Decay => {
            // an observer that is examined has the decay it has
            let lmi = LmiChoice { decay: Some(at), gamma: None, given: None, ..choice.lmi.clone() };
            DesignChoice { lmi, ..choice.clone() }
        }
    }
}

/// The edge of the frequencies at which the unknown input is tracked.
fn bandwidth(errors: &ErrorStateSpace, spectrum: &[Complex64], time: TimeDomain) -> Option<f64> {
    let first = errors.states.len();
    if errors.c.nrows() == first {
        return None;
    }
    let gain = |frequency: f64| -> Option<f64> {
        let (of_d, _) = errors.response(errors.point(frequency))?;
        let rows: DMatrix<Complex64> = of_d.rows(first, of_d.nrows() - first).into_owned();
        complex_svd(&rows).ok()?.s.first().copied()
    };
    let range = match time {
        TimeDomain::Continuous => {
            let speeds = || spectrum.iter().map(|mode| mode.norm()).filter(|speed| *speed > 0.0);
            [1e-4 * speeds().reduce(f64::min)?, 1e4 * speeds().reduce(f64::max)?]
        }
        TimeDomain::Discrete => [1e-4, std::f64::consts::PI],
    };
    let grid = between(range, FREQUENCIES);
    let edge = grid.iter().position(|frequency| gain(*frequency).is_some_and(|gain| gain > TRACKED))?;
    let (mut low, mut high) = (*grid.get(edge.checked_sub(1)?)?, *grid.get(edge)?);
    for _ in 0..40 {
        let middle = (low * high).sqrt();
        if gain(middle).is_some_and(|gain| gain > TRACKED) {
            high = middle;
        } else {
            low = middle;
        }
    }
    Some(low)
}
