//! Networks out of nothing, and systems out of networks.

use super::edit_lmi;
use super::poles;
use super::update::Edited;
use crate::document::limits::MAX_SIDE;
use crate::document::{
    Coupling, DescriptorData, Document, Entry, EntryMatrix, NetworkData, PlantData, ScenarioData,
};
use crate::numerics::{Complex64, Tolerance};
use crate::observer::{DesignChoice, Method, Order};
use crate::system::TimeDomain;

/// A network to begin with: four oscillators on a chain, whose observer exists.
///
/// ```text
/// x1' = x2,   x2' = -2 x1 - x2 + u_i,   w_i = x1
/// ```
pub(super) fn new_network() -> Document {
    let matrix = |rows: usize, columns: usize, values: &[f64]| {
        EntryMatrix::from_entries(rows, columns, values.iter().copied().map(Entry::number).collect())
    };
    let shown = || matrix(1, 2, &[1.0, 0.0]);
    let gamma = [
        -1.0, 1.0, 0.0, 0.0, //
        1.0, -2.0, 1.0, 0.0, //
        0.0, 1.0, -2.0, 1.0, //
        0.0, 0.0, 1.0, -1.0,
    ];
    let data = NetworkData {
        a: matrix(2, 2, &[0.0, 1.0, -2.0, -1.0]),
        b: matrix(2, 1, &[0.0, 1.0]),
        c: shown(),
        c_G: shown(),
        c_L: shown(),
        Gamma: Coupling::Dense(matrix(4, 4, &gamma)),
        Psi: Coupling::Dense(matrix(1, 4, &[-1.0, 1.0, 0.0, 0.0])),
        local: vec![1, 4],
    };
    let real = |values: &[f64]| values.iter().copied().map(Complex64::from).collect();
    Document {
        title: "New network".to_owned(),
        notes: String::new(),
        paper: String::new(),
        plant: PlantData::Network(data),
        design: DesignChoice {
            method: Method::Hierarchical,
            order: Order::Full,
            poles: real(&[-3.0, -3.5, -4.0, -4.5, -5.0, -5.5]),
            local_poles: real(&[-4.0, -5.0]),
            ..DesignChoice::default()
        },
        scenario: ScenarioData {
            x0: [1.0, 0.0, -1.0, 0.0, 2.0, 0.0, -2.0, 0.0].map(Entry::number).into(),
            ..ScenarioData::empty()
        },
        tolerance: Tolerance::default(),
        kept: Vec::new(),
        figures: Vec::new(),
    }
}

/// Writes a network out as the matrices of one system; the hierarchical observer, which needs the network, gives way.
pub(super) fn expand(document: &mut Document) -> Edited {
    let PlantData::Network(data) = &document.plant else {
        return Edited::Refused("the system is given by its matrices already".to_owned());
    };
    let network = match data.network() {
        Ok(network) => network,
        Err(error) => return Edited::Refused(error.to_string()),
    };
    let (states, outputs) = (data.states(), crate::document::Sizes::of(&document.plant).outputs);
    if states.max(outputs) > MAX_SIDE {
        return Edited::Refused(format!(
            "as one system the network has {states} states and {outputs} outputs; matrices are written out up to \
             {MAX_SIDE} of each"
        ));
    }
    let system = network.expanded();
    let parts = [&system.E, &system.A, &system.B, &system.C, &system.D, &system.F];
    document.plant = PlantData::Descriptor(DescriptorData {
        time: TimeDomain::Continuous,
        matrices: parts.map(EntryMatrix::from_matrix),
        partition: Vec::new(),
        lipschitz: None,
    });
    if document.design.method == Method::Hierarchical {
        edit_lmi::choose_method(document, Method::Proportional);
    }
    document.design.plugged = None;
    for kept in &mut document.kept {
        kept.design.plugged = None;
    }
    for run in document.figures.iter_mut().flat_map(|figure| figure.runs.iter_mut()) {
        run.design.plugged = None;
    }
    poles::provide(document);
    Edited::Done
}
