//! Edits of the scenario: initial state, signals, uncertainty, noise.

use super::command::{Edit, SignalList};
use super::state::{Draft, Field};
use super::update::Edited;
use crate::document::limits::{MAX_HORIZON, MAX_SAMPLES, MAX_SIDE};
use crate::document::{Document, Entry, EntryMatrix, InitialFormula, ScenarioData, Sizes, UncertaintyData};
use crate::system::Signal;

/// Changes the scenario of a document.
pub(super) fn change(document: &mut Document, edit: Edit) -> Edited {
    let sizes = Sizes::of(&document.plant);
    let scenario = &mut document.scenario;
    match edit {
        Edit::Horizon(horizon) if horizon.is_finite() => {
            scenario.horizon = horizon.clamp(1e-3, MAX_HORIZON);
        }
        Edit::Samples(samples) => {
            let most = usize::try_from(MAX_SAMPLES).unwrap_or(usize::MAX);
            scenario.samples = samples.clamp(2, most);
        }
        Edit::Initial { state, text } => match Entry::typed(&text) {
            Ok(entry) => return set_initial(scenario, sizes.states, (state, entry)),
            Err(error) => return Edited::Draft(Field::Initial(state), Draft { text, error }),
        },
        Edit::InitialFormula(text) if text.trim().is_empty() => {
            scenario.x0.clear();
            scenario.x0_formula = None;
        }
        Edit::InitialFormula(text) => match InitialFormula::checked(&text, sizes.states) {
            Ok(formula) => {
                scenario.x0.clear();
                scenario.x0_formula = Some(formula);
            }
            Err(error) => return Edited::Draft(Field::InitialFormula, Draft { text, error }),
        },
        Edit::Signal { list, index, text } => match Signal::parse(&text) {
            Ok(signal) => return set_signal(scenario, &sizes, (list, index), signal),
            Err(error) => {
                return Edited::Draft(Field::Signal(list, index), Draft { text, error: error.to_string() });
            }
        },
        Edit::UncertaintyScale { scale, .. } if scale.is_finite() => match uncertainty(scenario, &sizes) {
            Ok(data) => data.scale = scale.clamp(0.0, 1000.0),
            Err(refused) => return refused,
        },
        Edit::UncertaintyCell { row, column, frequency, text } => {
            match (Entry::typed(&text), uncertainty(scenario, &sizes)) {
                (Err(error), _) => {
                    return Edited::Draft(Field::Uncertainty(row, column, frequency), Draft { text, error });
                }
                (Ok(_), Err(refused)) => return refused,
                (Ok(entry), Ok(data)) => {
                    let matrix = if frequency { &mut data.frequency } else { &mut data.amplitude };
                    matrix.set(row, column, entry);
                }
            }
        }
        Edit::NoiseLevel { deviation, .. } if deviation.is_finite() => {
            if sizes.outputs > MAX_SIDE {
                return too_many("outputs", sizes.outputs);
            }
            let interval = scenario.horizon / 300.0;
            let signal = |i: usize| noise_signal(deviation.clamp(0.0, 1e3), interval, i);
            scenario.noise =
                if deviation > 0.0 { (0..sizes.outputs).filter_map(signal).collect() } else { Vec::new() };
        }
        _ => {}
    }
    Edited::Done
}

/// Sets the initial state of one component; values of an expression for all become entries first.
fn set_initial(scenario: &mut ScenarioData, states: usize, (state, entry): (usize, Entry)) -> Edited {
    if states > MAX_SIDE {
        return too_many("states", states);
    }
    if state < states {
        let values = scenario.initial_values(states);
        if scenario.x0.is_empty() {
            scenario.x0 = values.into_iter().map(Entry::number).collect();
        }
        scenario.x0_formula = None;
        scenario.x0.resize(states, Entry::number(0.0));
        scenario.x0[state] = entry;
    }
    Edited::Done
}

/// The sentence for a network that is too large to be edited by components.
fn too_many(what: &str, count: usize) -> Edited {
    Edited::Refused(format!("the system has {count} {what}; this can be edited for at most {MAX_SIDE}"))
}

/// Seeded noise of one standard deviation for output `i`.
fn noise_signal(deviation: f64, interval: f64, i: usize) -> Option<Signal> {
    Signal::parse(&format!("{deviation}*noise(t/{interval}, {})", i + 1)).ok()
}

fn set_signal(
    scenario: &mut ScenarioData,
    sizes: &Sizes,
    (list, index): (SignalList, usize),
    signal: Signal,
) -> Edited {
    let (signals, count, what) = match list {
        SignalList::Known => (&mut scenario.u, sizes.inputs, "known inputs"),
        SignalList::Unknown => (&mut scenario.d, sizes.unknown, "unknown inputs"),
        SignalList::Noise => (&mut scenario.noise, sizes.outputs, "outputs"),
    };
    if count > MAX_SIDE {
        return too_many(what, count);
    }
    if let (true, Ok(zero)) = (index < count, Signal::parse("0")) {
        signals.resize(count, zero);
        signals[index] = signal;
    }
    Edited::Done
}

/// The uncertainty, created with one percent at 0.1 to 0.9 Hz where there is none.
fn uncertainty<'a>(scenario: &'a mut ScenarioData, sizes: &Sizes) -> Result<&'a mut UncertaintyData, Edited> {
    let (e, n) = (sizes.equations, sizes.states);
    if e.max(n) > MAX_SIDE {
        return Err(too_many("states", n));
    }
    Ok(scenario.uncertainty.get_or_insert_with(|| {
        let frequency = |k: usize| Entry::number((k % 9 + 1) as f64 / 10.0);
        UncertaintyData {
            amplitude: EntryMatrix::from_entries(e, n, vec![Entry::number(0.01); e * n]),
            frequency: EntryMatrix::from_entries(e, n, (0..e * n).map(frequency).collect()),
            scale: 1.0,
        }
    }))
}
