//! Edits of the system: cells, pasted blocks, sizes; all matrices and the scenario follow.

use super::command::{Cell, Edit, Fill, Size};
use super::edit_sensor;
use super::state::{Draft, Field};
use super::update::Edited;
use crate::document::limits::MAX_SIDE;
use crate::document::{DescriptorData, Document, Entry, EntryMatrix, Matrix, PlantData, matrix_from_text};
use crate::numerics::Random;
use crate::system::Signal;

/// Changes the system of a document.
pub(super) fn change(document: &mut Document, edit: Edit) -> Edited {
    let PlantData::Descriptor(data) = &mut document.plant else {
        return Edited::Refused(
            "the system is given as a network: change its subsystem and its coupling, or expand it to matrices first"
                .to_owned(),
        );
    };
    match edit {
        Edit::Time(time) => data.time = time,
        Edit::Cell { cell, text } => match Entry::typed(&text) {
            Ok(entry) => data.matrix_mut(cell.matrix).set(cell.row, cell.column, entry),
            Err(error) => return Edited::Draft(Field::Cell(cell), Draft { text, error }),
        },
        Edit::Paste { cell, text } => return paste(document, cell, &text),
        Edit::Fill { matrix, fill } => filled(data.matrix_mut(matrix), fill),
        Edit::Size { of, grow } => return resize(document, of, grow),
        Edit::AddSensor { state } => {
            let outputs = data.matrix(Matrix::C).shape().0;
            let edited = resize(document, Size::Outputs, true);
            if let (Edited::Done, PlantData::Descriptor(data)) = (&edited, &mut document.plant) {
                data.matrix_mut(Matrix::C).set(outputs, state, Entry::number(1.0));
                edit_sensor::give_to_owner(document, state);
            }
            return edited;
        }
        _ => {}
    }
    Edited::Done
}

fn filled(matrix: &mut EntryMatrix, fill: Fill) {
    let (rows, columns) = matrix.shape();
    let mut random = Random::new(match fill {
        Fill::Random { seed } => seed,
        Fill::Zero | Fill::Identity | Fill::Scaled(_) => 0,
    });
    for i in 0..rows {
        for j in 0..columns {
            let value = match fill {
                Fill::Zero => 0.0,
                Fill::Identity => f64::from(u8::from(i == j)),
                Fill::Random { .. } => (random.normal() * 2.0).round(),
                Fill::Scaled(factor) => matrix.entry(i, j).map_or(0.0, |entry| entry.value) * factor,
            };
            if value.is_finite() {
                matrix.set(i, j, Entry::number(value));
            }
        }
    }
}

/// Puts a pasted block onto a matrix from the active cell on; one that reaches beyond it resizes the system.
fn paste(document: &mut Document, cell: Cell, text: &str) -> Edited {
    let pasted = match matrix_from_text(text) {
        Ok(pasted) => pasted,
        Err(error) => return Edited::Refused(format!("what was pasted is not a matrix: {error}")),
    };
    let PlantData::Descriptor(data) = &mut document.plant else { return Edited::Done };
    let (rows, columns) = data.matrix(cell.matrix).shape();
    // a block at least as large as the matrix replaces it; any other grows it as far as the block reaches
    let replaces = pasted.rows >= rows && pasted.columns >= columns;
    let at = if replaces { (0, 0) } else { (cell.row, cell.column) };
    let reached = (at.0 + pasted.rows, at.1 + pasted.columns);
    let shape = if replaces { reached } else { (reached.0.max(rows), reached.1.max(columns)) };
    if shape.0 > MAX_SIDE || shape.1 > MAX_SIDE {
        return Edited::Refused(format!(
            "the pasted block needs a {} x {} matrix; at most {MAX_SIDE} rows and columns are possible",
            shape.0, shape.1
        ));
    }
    if shape != (rows, columns) {
        reshape(document, cell.matrix, shape);
    }
    let PlantData::Descriptor(data) = &mut document.plant else { return Edited::Done };
    let matrix = data.matrix_mut(cell.matrix);
    for (k, (text, value)) in pasted.entries.iter().enumerate() {
        let entry = Entry::typed(text).unwrap_or_else(|_| Entry::number(*value));
        matrix.set(at.0 + k / pasted.columns, at.1 + k % pasted.columns, entry);
    }
    Edited::Done
}

/// Gives one matrix a shape and lets the others follow.
fn reshape(document: &mut Document, matrix: Matrix, (rows, columns): (usize, usize)) {
    let PlantData::Descriptor(data) = &document.plant else { return };
    let mut sizes = Sizes::of(data);
    match matrix {
        Matrix::E | Matrix::A => (sizes.equations, sizes.states) = (rows, columns),
        Matrix::B => (sizes.equations, sizes.inputs) = (rows, columns),
        Matrix::C => (sizes.outputs, sizes.states) = (rows, columns),
        Matrix::D => (sizes.equations, sizes.unknown) = (rows, columns),
        Matrix::F => (sizes.outputs, sizes.unknown) = (rows, columns),
    }
    // pasting B, C or D onto a square system keeps it square
    let square = data.matrix(Matrix::E).shape().0 == data.matrix(Matrix::E).shape().1;
    if square && matrix == Matrix::C {
        sizes.equations = sizes.states;
    }
    if square && matches!(matrix, Matrix::B | Matrix::D) {
        sizes.states = sizes.equations;
    }
    sizes.apply(document);
}

fn resize(document: &mut Document, of: Size, grow: bool) -> Edited {
    let PlantData::Descriptor(data) = &document.plant else { return Edited::Done };
    let mut sizes = Sizes::of(data);
    let square = sizes.equations == sizes.states;
    let (size, least, what) = match of {
        Size::States => (&mut sizes.states, 1, "state"),
        Size::Equations => (&mut sizes.equations, 1, "equation"),
        Size::Inputs => (&mut sizes.inputs, 0, "known input"),
        Size::Outputs => (&mut sizes.outputs, 0, "output"),
        Size::UnknownInputs => (&mut sizes.unknown, 0, "unknown input"),
    };
    if grow && *size >= MAX_SIDE {
        return Edited::Refused(format!("at most {MAX_SIDE} are possible"));
    }
    if !grow && *size <= least {
        return Edited::Refused(if least == 0 {
            format!("there is no {what} to remove")
        } else {
            format!("a system needs at least one {what}")
        });
    }
    *size = if grow { *size + 1 } else { *size - 1 };
    if of == Size::States && square {
        sizes.equations = sizes.states;
    }
    sizes.apply(document);
    Edited::Done
}

/// The sizes of a system.
#[derive(Clone, Copy)]
struct Sizes {
    states: usize,
    equations: usize,
    inputs: usize,
    outputs: usize,
    unknown: usize,
}

impl Sizes {
    fn of(data: &DescriptorData) -> Self {
        let [e, _, b, c, d, _] = data.matrices.each_ref().map(EntryMatrix::shape);
        Self { states: e.1, equations: e.0, inputs: b.1, outputs: c.0, unknown: d.1 }
    }

    /// Resizes every matrix, the initial state, the signals and the uncertainty.
    fn apply(self, document: &mut Document) {
        let Self { states, equations, inputs, outputs, unknown } = self;
        let PlantData::Descriptor(data) = &mut document.plant else { return };
        let shapes = [
            (equations, states),
            (equations, states),
            (equations, inputs),
            (outputs, states),
            (equations, unknown),
            (outputs, unknown),
        ];
        for (matrix, (rows, columns)) in data.matrices.iter_mut().zip(shapes) {
            *matrix = matrix.resized(rows, columns);
        }
        let scenario = &mut document.scenario;
        if !scenario.x0.is_empty() {
            scenario.x0.resize(states, Entry::number(0.0));
        }
        if let Ok(zero) = Signal::parse("0") {
            let lists =
                [(&mut scenario.u, inputs), (&mut scenario.d, unknown), (&mut scenario.noise, outputs)];
            for (signals, count) in lists {
                if !signals.is_empty() {
                    signals.resize(count, zero.clone());
                }
            }
        }
        if let Some(data) = &mut scenario.uncertainty {
            data.amplitude = data.amplitude.resized(equations, states);
            data.frequency = data.frequency.resized(equations, states);
        }
        drop_broken_figures(document, self);
    }
}

/// Removes figures that show components which no longer exist.
fn drop_broken_figures(document: &mut Document, sizes: Sizes) {
    use crate::paper::{PanelRecipe, Quantity, Transfer};
    let exists = |quantity: Quantity, index: usize| match quantity {
        Quantity::State | Quantity::Estimate | Quantity::Error => index < sizes.states,
        Quantity::UnknownInput | Quantity::UnknownInputEstimate | Quantity::UnknownInputError => {
            index < sizes.unknown
        }
        Quantity::Input => index < sizes.inputs,
        Quantity::Output => index < sizes.outputs,
        // of networks only
        Quantity::Whole | Quantity::WholeEstimate | Quantity::WholeError => false,
    };
    let fits = |signals: &Option<Vec<Signal>>, count: usize| {
        signals.as_ref().is_none_or(|signals| signals.is_empty() || signals.len() == count)
    };
    if let Ok(zero) = Signal::parse("0") {
        let fit = |signals: &mut Option<Vec<Signal>>, count: usize| {
            if let Some(signals) = signals.as_mut().filter(|signals| !signals.is_empty()) {
                signals.resize(count, zero.clone());
            }
        };
        for run in document.figures.iter_mut().flat_map(|figure| figure.runs.iter_mut()) {
            fit(&mut run.scenario.u, sizes.inputs);
            fit(&mut run.scenario.d, sizes.unknown);
            fit(&mut run.scenario.noise, sizes.outputs);
        }
    }
    document.figures.retain(|figure| {
        let runs = figure.runs.iter().all(|run| {
            fits(&run.scenario.u, sizes.inputs)
                && fits(&run.scenario.d, sizes.unknown)
                && fits(&run.scenario.noise, sizes.outputs)
        });
        let panels = figure.panels.iter().all(|panel| match panel {
            PanelRecipe::Time { series, .. } => series.iter().all(|s| exists(s.quantity, s.index)),
            PanelRecipe::Bode { transfer, from, to, .. } => {
                let limit = if *transfer == Transfer::UnknownInput { sizes.unknown } else { sizes.states };
                *from < sizes.unknown && *to < limit
            }
        });
        runs && panels
    });
}
