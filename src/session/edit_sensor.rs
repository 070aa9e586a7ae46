//! A new sensor of a partitioned system belongs to the subsystem whose state it measures.

use crate::document::{Document, Entry, EntryMatrix, Matrix, PlantData};
use crate::paper::{PanelRecipe, Quantity};

/// Moves the last output behind the outputs of the subsystem that has the state, and gives it to that subsystem.
pub(super) fn give_to_owner(document: &mut Document, state: usize) {
    let PlantData::Descriptor(data) = &mut document.plant else { return };
    let (mut states, mut place) = (0, 0);
    let owner = data.partition.iter_mut().find(|subsystem| {
        states += subsystem.states;
        place += subsystem.outputs;
        state < states
    });
    let Some(owner) = owner else { return };
    owner.outputs += 1;
    for letter in [Matrix::C, Matrix::F] {
        let matrix = data.matrix_mut(letter);
        *matrix = last_row_at(matrix, place);
    }
    let noise = &mut document.scenario.noise;
    if place < noise.len() {
        noise[place..].rotate_right(1);
    }
    for figure in &mut document.figures {
        for noise in figure.runs.iter_mut().filter_map(|run| run.scenario.noise.as_mut()) {
            if place < noise.len() {
                noise[place..].rotate_right(1);
            }
        }
        for panel in &mut figure.panels {
            let PanelRecipe::Time { series, .. } = panel else { continue };
            for one in series.iter_mut().filter(|one| one.quantity == Quantity::Output && one.index >= place)
            {
                one.index += 1;
            }
        }
    }
}

/// The same rows with the last one moved up to a place.
fn last_row_at(matrix: &EntryMatrix, place: usize) -> EntryMatrix {
    let (rows, columns) = matrix.shape();
    let mut order: Vec<usize> = (0..rows).collect();
    if place < rows {
        order[place..].rotate_right(1);
    }
    let entry = |i: usize, j: usize| matrix.entry(i, j).cloned().unwrap_or_else(|| Entry::number(0.0));
    let entries = order.into_iter().flat_map(|i| (0..columns).map(move |j| (i, j)));
    EntryMatrix::from_entries(rows, columns, entries.map(|(i, j)| entry(i, j)).collect())
}
