//! What a changed network asks of the rest of the document: initial state, signals, figures, chosen subsystems.

use crate::document::limits::{MAX_BYTES, MAX_SIDE};
use crate::document::{
    Coupling, Document, Entry, EntryMatrix, FreeData, NetworkData, PlantData, write_document,
};
use crate::observer::{DesignChoice, LmiChoice};
use crate::paper::{PanelRecipe, Quantity};
use crate::system::Signal;

/// Adapts a document whose network changed, and says in sentences what had to go.
///
/// What belongs to a subsystem stays with it: states and outputs are numbered through the whole network, so that
/// their numbers change with the sizes of a subsystem.
///
/// # Errors
/// When the document would become larger than what is read back.
pub(super) fn follow(document: &mut Document, before: &Document) -> Result<Vec<String>, String> {
    let (PlantData::Network(old), PlantData::Network(new)) = (&before.plant, &document.plant) else {
        return Ok(Vec::new());
    };
    if old == new {
        return Ok(Vec::new());
    }
    let (old, new) = (Numbers::of(old), Numbers::of(new));
    let mut gone = Vec::new();
    if old != new {
        gone.extend(scenario(document, &old, &new));
        gone.extend(figures(document, &old, &new));
        let kept = document.kept.iter_mut().map(|kept| &mut kept.design);
        for design in kept.chain([&mut document.design]) {
            choice(design, &new);
        }
    }
    bounded(document)?;
    Ok(gone)
}

/// How states and outputs are numbered through a network.
#[derive(PartialEq)]
struct Numbers {
    subsystems: usize,
    /// States of a subsystem.
    states: usize,
    /// Rows of `c_G` and of `Psi`.
    global: (usize, usize),
    /// Rows of `c_L`.
    outputs: usize,
    /// Subsystems with local measurements, from zero.
    local: Vec<usize>,
}

/// What an output belongs to.
#[derive(Clone, Copy, PartialEq)]
enum Output {
    /// Row of `Psi`, row of `c_G`.
    Global(usize, usize),
    /// Subsystem, row of `c_L`.
    Local(usize, usize),
}

impl Numbers {
    fn of(data: &NetworkData) -> Self {
        Self {
            subsystems: data.n_subsystems(),
            states: data.a.shape().0,
            global: (data.c_G.shape().0, data.Psi.shape().0),
            outputs: data.c_L.shape().0,
            local: data.local.iter().map(|number| number - 1).collect(),
        }
    }

    fn n_states(&self) -> usize {
        self.subsystems * self.states
    }

    fn n_outputs(&self) -> usize {
        self.global.0 * self.global.1 + self.local.len() * self.outputs
    }

    /// The number that a state of another numbering has here; `None` when it is gone.
    fn state(&self, k: usize, other: &Self) -> Option<usize> {
        let (subsystem, state) = (k / other.states.max(1), k % other.states.max(1));
        (subsystem < self.subsystems && state < self.states).then_some(subsystem * self.states + state)
    }

    fn output_at(&self, k: usize) -> Option<Output> {
        let global = self.global.0 * self.global.1;
        let Some(behind) = k.checked_sub(global) else {
            return Some(Output::Global(k / self.global.0, k % self.global.0));
        };
        let subsystem = *self.local.get(behind.checked_div(self.outputs)?)?;
        Some(Output::Local(subsystem, behind % self.outputs))
    }

    /// The number that an output of another numbering has here; `None` when it is gone.
    fn output(&self, k: usize, other: &Self) -> Option<usize> {
        match other.output_at(k)? {
            Output::Global(row, part) => {
                (row < self.global.1 && part < self.global.0).then_some(row * self.global.0 + part)
            }
            Output::Local(subsystem, row) => {
                let place = self.local.iter().position(|local| *local == subsystem)?;
                (row < self.outputs).then_some(self.global.0 * self.global.1 + place * self.outputs + row)
            }
        }
    }
}

/// The items of a list under their new numbers; what is new has the default.
fn renumbered<T: Clone>(
    items: &[T],
    count: usize,
    default: &T,
    number: impl Fn(usize) -> Option<usize>,
) -> Vec<T> {
    let mut result = vec![default.clone(); count];
    for (k, item) in items.iter().enumerate() {
        if let Some(place) = number(k).and_then(|at| result.get_mut(at)) {
            place.clone_from(item);
        }
    }
    result
}

/// Noise with one signal for each output; empty when there are more outputs than a document lists signals for.
fn noise(signals: &[Signal], old: &Numbers, new: &Numbers) -> Vec<Signal> {
    let count = new.n_outputs();
    let Ok(zero) = Signal::parse("0") else { return Vec::new() };
    if signals.is_empty() || count > MAX_SIDE {
        return Vec::new();
    }
    renumbered(signals, count, &zero, |k| new.output(k, old))
}

fn scenario(document: &mut Document, old: &Numbers, new: &Numbers) -> Vec<String> {
    let scenario = &mut document.scenario;
    let mut gone = Vec::new();
    if !scenario.x0.is_empty() {
        let number = |k| new.state(k, old);
        scenario.x0 = renumbered(&scenario.x0, new.n_states(), &Entry::number(0.0), number);
    }
    let noisy = !scenario.noise.is_empty();
    scenario.noise = noise(&scenario.noise, old, new);
    if noisy && scenario.noise.is_empty() {
        gone.push(format!("the noise went: it is listed for at most {MAX_SIDE} outputs"));
    }
    if old.n_states() != new.n_states() {
        if scenario.uncertainty.take().is_some() {
            gone.push("the uncertainty went with the sizes that it was made for".to_owned());
        }
        scenario.free = FreeData::default();
    }
    gone
}

/// Figures follow; those that show what is gone go with it.
fn figures(document: &mut Document, old: &Numbers, new: &Numbers) -> Vec<String> {
    let number = |quantity: Quantity, k: usize| match quantity {
        Quantity::State | Quantity::Estimate | Quantity::Error => new.state(k, old),
        Quantity::Output => new.output(k, old),
        // how many states the whole has follows from ranks, so that the figure judges the number
        Quantity::Whole | Quantity::WholeEstimate | Quantity::WholeError => Some(k),
        Quantity::UnknownInput
        | Quantity::UnknownInputEstimate
        | Quantity::UnknownInputError
        | Quantity::Input => None,
    };
    let mut gone = Vec::new();
    document.figures.retain_mut(|figure| {
        for run in &mut figure.runs {
            if let Some(signals) = &mut run.scenario.noise {
                *signals = noise(signals, old, new);
            }
            if old.n_states() != new.n_states() {
                run.scenario.free = None;
            }
            if let Some(plugged) = &mut run.design.plugged {
                plugged.retain(|subsystem| new.local.contains(subsystem));
            }
            if let Some(lmi) = &mut run.design.lmi {
                decoupled(lmi, new);
            }
        }
        let complete = figure.panels.iter_mut().all(|panel| match panel {
            PanelRecipe::Time { series, .. } => {
                series.iter_mut().all(|one| number(one.quantity, one.index).map(|k| one.index = k).is_some())
            }
            PanelRecipe::Bode { .. } => true,
        });
        if !complete {
            let name = if figure.title.is_empty() { &figure.id } else { &figure.title };
            gone.push(format!("the figure \"{name}\" went with what it shows"));
        }
        complete
    });
    gone
}

fn choice(design: &mut DesignChoice, new: &Numbers) {
    if let Some(plugged) = &mut design.plugged {
        plugged.retain(|subsystem| new.local.contains(subsystem));
    }
    decoupled(&mut design.lmi, new);
}

/// Lists of decoupled states go when they name states that are gone; the chosen method decides what they mean.
fn decoupled(lmi: &mut LmiChoice, new: &Numbers) {
    let states = new.n_states();
    lmi.decoupled.take_if(|lists| lists.iter().flatten().any(|state| *state >= states));
}

/// Refuses a network that no document could hold any more.
fn bounded(document: &Document) -> Result<(), String> {
    let PlantData::Network(data) = &document.plant else { return Ok(()) };
    let matrices = [&data.a, &data.b, &data.c, &data.c_G, &data.c_L].map(matrix_bytes);
    let coupling = coupling_bytes(&data.Gamma) + coupling_bytes(&data.Psi);
    let states: usize = document.scenario.x0.iter().map(entry_bytes).sum();
    // writing a large document out takes longer than a keystroke may: only where it could be too large
    if matrices.iter().sum::<usize>() + coupling + states + 16 * data.local.len() < MAX_BYTES / 4 * 3 {
        return Ok(());
    }
    let found = write_document(document).len();
    if found <= MAX_BYTES {
        return Ok(());
    }
    Err(format!(
        "the document would have {:.1} MB; at most {:.1} MB are read: couple fewer subsystems, or use shorter entries",
        found as f64 / 1e6,
        MAX_BYTES as f64 / 1e6
    ))
}

/// Bytes that a number takes in a document, at most.
fn number_bytes(value: f64) -> usize {
    const SHORT: f64 = 1e4;
    if value.fract() == 0.0 && value.abs() < SHORT { 5 } else { 24 }
}

fn entry_bytes(entry: &Entry) -> usize {
    const INDENTED: usize = 8;
    INDENTED + entry.text.as_ref().map_or_else(|| number_bytes(entry.value), |text| 2 * text.len() + 2)
}

fn matrix_bytes(matrix: &EntryMatrix) -> usize {
    let (rows, columns) = matrix.shape();
    let places = (0..rows).flat_map(|i| (0..columns).map(move |j| (i, j)));
    places.filter_map(|(i, j)| matrix.entry(i, j)).map(entry_bytes).sum()
}

fn coupling_bytes(coupling: &Coupling) -> usize {
    // each entry of a list stands on a line of its own, with two numbers of at most four digits before it
    const LINE: usize = 26;
    match coupling {
        Coupling::Dense(matrix) => matrix_bytes(matrix),
        Coupling::Sparse { entries, .. } => entries.iter().map(|entry| LINE + number_bytes(entry.2)).sum(),
    }
}
