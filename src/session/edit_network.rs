//! Edits of a network: cells, pasted blocks, sizes, local measurements and local observers.

use super::edit_coupling;
use super::network_edits::{Measure, NetworkCell, NetworkEdit, NetworkSize};
use super::new_network;
use super::poles;
use super::state::{Draft, Field};
use super::update::Edited;
use crate::document::limits::{MAX_SIDE, MAX_SUBSYSTEMS};
use crate::document::{
    Coupling, Document, Entry, EntryMatrix, NetworkData, NetworkMatrix, PlantData, matrix_from_text,
};
use crate::system::MOST_GLOBAL_OUTPUTS;

/// Changes the network of a document; what else the document holds follows afterwards.
pub(super) fn change(document: &mut Document, edit: NetworkEdit) -> Edited {
    match edit {
        NetworkEdit::LocalPoles(text) => {
            return match poles::parse(&text) {
                Ok(found) => {
                    document.design.local_poles = found;
                    Edited::Done
                }
                Err(error) => Edited::Draft(Field::LocalPoles, Draft { text, error }),
            };
        }
        NetworkEdit::MoveLocalPole { index, to, .. } => {
            if to.re.is_finite() && to.im.is_finite() {
                poles::drag_local(document, index, to);
            }
            return Edited::Done;
        }
        NetworkEdit::Expand => return new_network::expand(document),
        _ => {}
    }
    let PlantData::Network(data) = &mut document.plant else {
        return Edited::Refused("the system is given by its matrices: it is not a network".to_owned());
    };
    let edited = match edit {
        NetworkEdit::Plug { subsystem, plugged } => {
            return plug(data, &mut document.design.plugged, subsystem, plugged);
        }
        NetworkEdit::Local { subsystem, measured } => return local(data, subsystem, measured),
        NetworkEdit::Cell { cell, text } => match Entry::typed(&text) {
            Ok(entry) => set(data, cell, entry),
            Err(error) => Edited::Draft(Field::Network(cell), Draft { text, error }),
        },
        NetworkEdit::Paste { cell, text } => paste(data, cell, &text),
        NetworkEdit::Size { of, grow } => resize(data, of, grow),
        NetworkEdit::Subsystems(text) => subsystems(data, text),
        NetworkEdit::Template { form, weight } => edit_coupling::apply(data, form, weight),
        NetworkEdit::Edge { to, from, text, balanced } => {
            edit_coupling::edge(data, (to, from), text, balanced)
        }
        NetworkEdit::Measure(measure) => mend(data, measure),
        NetworkEdit::LocalPoles(_) | NetworkEdit::MoveLocalPole { .. } | NetworkEdit::Expand => Edited::Done,
    };
    poles::provide(document);
    edited
}

fn set(data: &mut NetworkData, cell: NetworkCell, entry: Entry) -> Edited {
    let NetworkCell { matrix, row, column } = cell;
    match matrix {
        NetworkMatrix::State => data.a.set(row, column, entry),
        NetworkMatrix::Input => data.b.set(row, column, entry),
        NetworkMatrix::Output => data.c.set(row, column, entry),
        NetworkMatrix::GlobalOutput => data.c_G.set(row, column, entry),
        NetworkMatrix::LocalOutput => data.c_L.set(row, column, entry),
        NetworkMatrix::Gamma => return edit_coupling::set(&mut data.Gamma, (row, column), entry),
        NetworkMatrix::Psi => return edit_coupling::set(&mut data.Psi, (row, column), entry),
    }
    Edited::Done
}

/// The sizes of a network.
#[derive(Clone, Copy, PartialEq)]
struct Sizes {
    subsystems: usize,
    states: usize,
    channels: usize,
    global: usize,
    local: usize,
    combinations: usize,
}

impl Sizes {
    fn of(data: &NetworkData) -> Self {
        Self {
            subsystems: data.n_subsystems(),
            states: data.a.shape().0,
            channels: data.b.shape().1,
            global: data.c_G.shape().0,
            local: data.c_L.shape().0,
            combinations: data.Psi.shape().0,
        }
    }

    /// Resizes every matrix; the coupling keeps its form where it is one of the usual ones.
    fn apply(self, data: &mut NetworkData) {
        let Self { subsystems, states, channels, global, local, combinations } = self;
        let fit = |matrix: &mut EntryMatrix, rows, columns| {
            if matrix.shape() != (rows, columns) {
                *matrix = matrix.resized(rows, columns);
            }
        };
        fit(&mut data.a, states, states);
        fit(&mut data.b, states, channels);
        fit(&mut data.c, channels, states);
        fit(&mut data.c_G, global, states);
        fit(&mut data.c_L, local, states);
        if data.Gamma.shape() != (subsystems, subsystems) {
            data.Gamma = edit_coupling::continued(&data.Gamma, subsystems);
        }
        if data.Psi.shape() != (combinations, subsystems) {
            data.Psi = data.Psi.resized(combinations, subsystems);
        }
        data.local.retain(|number| *number <= subsystems);
    }
}

/// Puts a pasted block onto a matrix from the active cell on; one that reaches beyond it resizes the network.
fn paste(data: &mut NetworkData, cell: NetworkCell, text: &str) -> Edited {
    let pasted = match matrix_from_text(text) {
        Ok(pasted) => pasted,
        Err(error) => return Edited::Refused(format!("what was pasted is not a matrix: {error}")),
    };
    let (rows, columns) = data.shape(cell.matrix);
    let replaces = pasted.rows >= rows && pasted.columns >= columns;
    let at = if replaces { (0, 0) } else { (cell.row, cell.column) };
    let reached = (at.0 + pasted.rows, at.1 + pasted.columns);
    let mut shape = if replaces { reached } else { (reached.0.max(rows), reached.1.max(columns)) };
    if matches!(cell.matrix, NetworkMatrix::State | NetworkMatrix::Gamma) && shape.0 != shape.1 {
        if replaces {
            let letter = cell.matrix.letter();
            return Edited::Refused(format!(
                "the pasted matrix is {} x {}, but {letter} is square: paste as many rows as columns",
                shape.0, shape.1
            ));
        }
        shape = (shape.0.max(shape.1), shape.0.max(shape.1));
    }
    let mut sizes = Sizes::of(data);
    match cell.matrix {
        NetworkMatrix::State => sizes.states = shape.0,
        NetworkMatrix::Input => (sizes.states, sizes.channels) = shape,
        NetworkMatrix::Output => (sizes.channels, sizes.states) = shape,
        NetworkMatrix::GlobalOutput => (sizes.global, sizes.states) = shape,
        NetworkMatrix::LocalOutput => (sizes.local, sizes.states) = shape,
        NetworkMatrix::Gamma => sizes.subsystems = shape.0,
        NetworkMatrix::Psi => (sizes.combinations, sizes.subsystems) = shape,
    }
    if let Some(refused) = beyond(&sizes) {
        return refused;
    }
    sizes.apply(data);
    let typed = |(text, value): &(String, f64)| Entry::typed(text).unwrap_or_else(|_| Entry::number(*value));
    let entries: Vec<Entry> = pasted.entries.iter().map(typed).collect();
    match cell.matrix {
        NetworkMatrix::Gamma => edit_coupling::set_block(&mut data.Gamma, at, pasted.columns, entries),
        NetworkMatrix::Psi => edit_coupling::set_block(&mut data.Psi, at, pasted.columns, entries),
        matrix => {
            for (k, entry) in entries.into_iter().enumerate() {
                let (row, column) = (at.0 + k / pasted.columns, at.1 + k % pasted.columns);
                set(data, NetworkCell { matrix, row, column }, entry);
            }
            Edited::Done
        }
    }
}

/// Why sizes are beyond the limits, if they are.
fn beyond(sizes: &Sizes) -> Option<Edited> {
    let Sizes { subsystems, states, channels, global, local, combinations } = *sizes;
    let all = [
        ("subsystems", subsystems, MAX_SUBSYSTEMS),
        ("states of a subsystem", states, MAX_SIDE),
        ("coupling channels", channels, MAX_SIDE),
        ("rows of c_G", global, MAX_SIDE),
        ("rows of c_L", local, MAX_SIDE),
        ("rows of Psi", combinations, MAX_SUBSYSTEMS),
        ("rows of Psi times rows of c_G", global * combinations, MOST_GLOBAL_OUTPUTS),
    ];
    all.into_iter().find(|(_, wanted, limit)| wanted > limit).map(|(what, wanted, limit)| {
        Edited::Refused(format!("{wanted} {what} are wanted; at most {limit} are possible"))
    })
}

fn resize(data: &mut NetworkData, of: NetworkSize, grow: bool) -> Edited {
    let mut sizes = Sizes::of(data);
    let (size, what) = match of {
        NetworkSize::Subsystems => (&mut sizes.subsystems, "subsystem"),
        NetworkSize::States => (&mut sizes.states, "state in each subsystem"),
        NetworkSize::Channels => (&mut sizes.channels, "coupling channel"),
        NetworkSize::GlobalOutputs => (&mut sizes.global, "row of c_G"),
        NetworkSize::LocalOutputs => (&mut sizes.local, "row of c_L"),
        NetworkSize::Combinations => (&mut sizes.combinations, "row of Psi"),
    };
    if !grow && *size <= 1 {
        return Edited::Refused(format!("a network needs at least one {what}"));
    }
    *size = if grow { *size + 1 } else { *size - 1 };
    if let Some(refused) = beyond(&sizes).filter(|_| grow) {
        return refused;
    }
    sizes.apply(data);
    Edited::Done
}

fn subsystems(data: &mut NetworkData, text: String) -> Edited {
    let wanted = text.trim().parse::<usize>().ok().filter(|count| (1..=MAX_SUBSYSTEMS).contains(count));
    let Some(subsystems) = wanted else {
        let error = format!("a whole number from 1 to {MAX_SUBSYSTEMS} is needed");
        return Edited::Draft(Field::Subsystems, Draft { text, error });
    };
    Sizes { subsystems, ..Sizes::of(data) }.apply(data);
    Edited::Done
}

/// The sentence for a subsystem that is not there.
fn no_such(data: &NetworkData, subsystem: usize) -> Edited {
    Edited::Refused(format!(
        "there is no subsystem {}: the network has {}",
        subsystem + 1,
        data.n_subsystems()
    ))
}

fn local(data: &mut NetworkData, subsystem: Option<usize>, measured: bool) -> Edited {
    let count = data.n_subsystems();
    match subsystem {
        Some(subsystem) if subsystem >= count => return no_such(data, subsystem),
        Some(subsystem) => {
            data.local.retain(|number| *number != subsystem + 1);
            if measured {
                let place = data.local.partition_point(|number| *number < subsystem + 1);
                data.local.insert(place, subsystem + 1);
            }
        }
        None => data.local = if measured { (1..=count).collect() } else { Vec::new() },
    }
    Edited::Done
}

/// Plugs a local observer in or out; when all are plugged in, the choice names none, so that it holds for all to come.
fn plug(
    data: &NetworkData,
    choice: &mut Option<Vec<usize>>,
    subsystem: Option<usize>,
    plugged: bool,
) -> Edited {
    let measured = || data.local.iter().map(|number| number - 1);
    let Some(subsystem) = subsystem else {
        *choice = if plugged { None } else { Some(Vec::new()) };
        return Edited::Done;
    };
    if subsystem >= data.n_subsystems() {
        return no_such(data, subsystem);
    }
    if plugged && !data.has_local_outputs(subsystem) {
        return Edited::Refused(format!(
            "subsystem {} has no local measurements, which a local observer needs: measure it locally first",
            subsystem + 1
        ));
    }
    let mut list: Vec<usize> = choice.take().unwrap_or_else(|| measured().collect());
    list.retain(|other| *other != subsystem);
    if plugged {
        list.push(subsystem);
    }
    list.sort_unstable();
    list.dedup();
    *choice = if measured().all(|other| list.binary_search(&other).is_ok()) { None } else { Some(list) };
    Edited::Done
}

/// Changes measurements as a condition asks for them.
fn mend(data: &mut NetworkData, measure: Measure) -> Edited {
    let mut sizes = Sizes::of(data);
    let received = |data: &NetworkData, subsystem: usize| -> Vec<Entry> {
        (0..data.n_subsystems()).filter_map(|j| data.Gamma.entry(subsystem, j)).collect()
    };
    match measure {
        Measure::ReceivedOnly { subsystem } | Measure::Received { subsystem }
            if subsystem >= sizes.subsystems =>
        {
            return no_such(data, subsystem);
        }
        Measure::ReceivedOnly { subsystem } => {
            let row = received(data, subsystem);
            data.Psi = empty(&data.Psi, 1);
            return edit_coupling::set_block(&mut data.Psi, (0, 0), sizes.subsystems, row);
        }
        Measure::Received { subsystem } => {
            let at = sizes.combinations;
            sizes.combinations += 1;
            let row = received(data, subsystem);
            if let Some(refused) = beyond(&sizes) {
                return refused;
            }
            sizes.apply(data);
            return edit_coupling::set_block(&mut data.Psi, (at, 0), sizes.subsystems, row);
        }
        Measure::CouplingOutputOnly => data.c_G.clone_from(&data.c),
        Measure::CouplingOutput => {
            let rows = data.c_G.shape().0;
            sizes.global += sizes.channels;
            if let Some(refused) = beyond(&sizes) {
                return refused;
            }
            sizes.apply(data);
            copy_rows(&data.c, &mut data.c_G, rows);
        }
        Measure::LocalState { state } => {
            sizes.local += 1;
            if state >= sizes.states {
                return Edited::Refused(format!("a subsystem has {} states only", sizes.states));
            }
            if let Some(refused) = beyond(&sizes) {
                return refused;
            }
            sizes.apply(data);
            data.c_L.set(sizes.local - 1, state, Entry::number(1.0));
        }
    }
    Edited::Done
}

/// Zeros in the form that a coupling has.
fn empty(like: &Coupling, rows: usize) -> Coupling {
    let columns = like.shape().1;
    match like {
        Coupling::Dense(_) => Coupling::Dense(EntryMatrix::zeros(rows, columns)),
        Coupling::Sparse { .. } => Coupling::Sparse { rows, columns, entries: Vec::new() },
    }
}

fn copy_rows(from: &EntryMatrix, to: &mut EntryMatrix, first: usize) {
    let (rows, columns) = from.shape();
    for i in 0..rows {
        for j in 0..columns {
            if let Some(entry) = from.entry(i, j) {
                to.set(first + i, j, entry.clone());
            }
        }
    }
}
