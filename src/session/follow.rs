//! What an edit of one part asks of the others: partition, nonlinearity and demands keep fitting the system.

use nalgebra::DMatrix;

use super::edit_lmi::{fit_given, follow_time, time};
use super::follow_kept::follow_kept;
use super::{edit_free, edit_lipschitz, follow_initial, follow_network};
use crate::document::{Document, EntryMatrix, Matrix, PlantData, Sizes};
use crate::observer::Method;
use crate::system::{Subsystem, check_partition};

/// Adapts an edited document to itself, and says in sentences what had to go.
///
/// # Errors
/// When the edit put an entry where the partition needs a zero: which entry, and what to do; when a network grew beyond
/// what a document holds.
pub(super) fn follow(document: &mut Document, before: &Document) -> Result<Vec<String>, String> {
    let mut gone = follow_network::follow(document, before)?;
    gone.extend(follow_initial::follow(document, before));
    gone.extend(edit_lipschitz::follow_sizes(document));
    edit_free::follow_sizes(document);
    gone.extend(partition(document, before)?);
    gone.extend(fit_design(document, before));
    gone.extend(follow_kept(document, before));
    Ok(gone)
}

/// Adapts the chosen design to the plant of its document.
pub(super) fn fit_design(document: &mut Document, before: &Document) -> Vec<String> {
    let mut gone = Vec::new();
    gone.extend(follow_time(document, time(before)));
    gone.extend(rows(document, before));
    decoupled(document);
    let outputs = Sizes::of(&document.plant).outputs;
    let examined = document.design.lmi.given.is_some();
    fit_given(&mut document.design.lmi, outputs);
    if examined && document.design.lmi.given.is_none() {
        gone.push("the observer that was examined does not fit so many outputs".to_owned());
    }
    gone
}

/// The last subsystem takes what is new and gives what is gone; one without a state left goes.
fn partition(document: &mut Document, before: &Document) -> Result<Vec<String>, String> {
    let PlantData::Descriptor(data) = &mut document.plant else { return Ok(Vec::new()) };
    if data.partition.is_empty() {
        return Ok(Vec::new());
    }
    let mut gone = Vec::new();
    let (equations, states) = data.matrix(Matrix::E).shape();
    let outputs = data.matrix(Matrix::C).shape().0;
    let found = totals(&data.partition);
    if found != [states, equations, outputs] {
        resize(&mut data.partition, [states, equations, outputs]);
        gone = without_empty(&mut data.partition);
    }
    if data.partition.is_empty() {
        document.design.lmi.decoupled = None;
        return Ok(gone);
    }
    let Ok(system) = data.system() else { return Ok(gone) };
    let Err(error) = check_partition(&system, &data.partition) else { return Ok(gone) };
    if shapes(&before.plant) == shapes(&document.plant) {
        return Err(format!("{error}; move the border or remove the partition first"));
    }
    if let PlantData::Descriptor(data) = &mut document.plant {
        data.partition.clear();
    }
    document.design.lmi.decoupled = None;
    Ok(vec![format!("the partition went: {error}")])
}

fn shapes(plant: &PlantData) -> Option<[(usize, usize); 6]> {
    match plant {
        PlantData::Descriptor(data) => Some(data.matrices.each_ref().map(EntryMatrix::shape)),
        PlantData::Network(_) => None,
    }
}

/// States, equations and outputs of all subsystems together.
fn totals(partition: &[Subsystem]) -> [usize; 3] {
    let sum = |size: fn(&Subsystem) -> usize| partition.iter().map(size).sum();
    [sum(|s| s.states), sum(|s| s.equations), sum(|s| s.outputs)]
}

fn resize(partition: &mut [Subsystem], needed: [usize; 3]) {
    let sizes: [fn(&mut Subsystem) -> &mut usize; 3] =
        [|s| &mut s.states, |s| &mut s.equations, |s| &mut s.outputs];
    for ((size, needed), found) in sizes.into_iter().zip(needed).zip(totals(partition)) {
        let mut excess = found.saturating_sub(needed);
        for subsystem in partition.iter_mut().rev() {
            let less = excess.min(*size(subsystem));
            *size(subsystem) -= less;
            excess -= less;
        }
        if let Some(last) = partition.last_mut() {
            *size(last) += needed.saturating_sub(found);
        }
    }
}

/// Lets the last subsystems go whose states are all gone; what else they had, the one before takes.
fn without_empty(partition: &mut Vec<Subsystem>) -> Vec<String> {
    let mut gone = Vec::new();
    while let Some(last) = partition.pop_if(|last| last.states == 0) {
        gone.push(format!("{} went with its last state", named(&last.name)));
        if let Some(before) = partition.last_mut() {
            before.equations += last.equations;
            before.outputs += last.outputs;
        }
    }
    if !gone.is_empty() && partition.len() < 2 {
        partition.clear();
        gone.push("the system is no longer partitioned".to_owned());
    }
    gone
}

fn named(name: &str) -> String {
    if name.is_empty() { "a subsystem".to_owned() } else { format!("the subsystem \"{name}\"") }
}

/// Given matrices `R` go when the order, the method or the states change that they were made for.
fn rows(document: &mut Document, before: &Document) -> Option<String> {
    if document.design.lmi.rows.is_empty() || !document.design.method.uses_lmi() {
        return None;
    }
    let reordered =
        before.design.method == document.design.method && before.design.order != document.design.order;
    let misfit = fits(before) && !fits(document);
    let switched = before.design.method != document.design.method && !fits(document);
    if !(reordered || misfit || switched) {
        return None;
    }
    document.design.lmi.rows.clear();
    Some("the given R no longer fits: R is chosen by the order again".to_owned())
}

/// Whether there is one `R` for each subsystem, with a column for each of its states.
fn fits(document: &Document) -> bool {
    let found: Vec<usize> = document.design.lmi.rows.iter().map(DMatrix::ncols).collect();
    match (&document.plant, document.design.method) {
        (PlantData::Descriptor(data), Method::Decentralized) => {
            found == data.partition.iter().map(|s| s.states).collect::<Vec<_>>()
        }
        (plant, _) => found == [Sizes::of(plant).states],
    }
}

/// Lists of decoupled states: one for each subsystem, only of states that the others have.
fn decoupled(document: &mut Document) {
    let PlantData::Descriptor(data) = &document.plant else { return };
    let Some(lists) = &mut document.design.lmi.decoupled else { return };
    let states = data.matrix(Matrix::E).shape().1;
    for list in lists.iter_mut() {
        list.retain(|state| *state < states);
    }
    if data.partition.is_empty() {
        return;
    }
    lists.resize(data.partition.len(), Vec::new());
    let mut first = 0;
    for (list, subsystem) in lists.iter_mut().zip(&data.partition) {
        let own = first..first + subsystem.states;
        list.retain(|state| !own.contains(state));
        list.sort_unstable();
        list.dedup();
        first = own.end;
    }
}
