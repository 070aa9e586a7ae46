//! The edges of a network's graph, as far as they are drawn.

use std::collections::BTreeSet;

use super::super::plot::short;
use crate::document::NetworkData;
use crate::session::{CouplingForm, coupling_forms};

/// Most edges that are drawn: more than these would be one black disc.
const DRAWN: usize = 1500;

/// An edge: one subsystem listens to another.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Link {
    /// Who listens, from zero.
    pub to: usize,
    /// To whom, from zero.
    pub from: usize,
    /// How strongly: `Gamma[to, from]`.
    pub weight: f64,
    /// Whether the other listens, too: then both edges are bent.
    pub mutual: bool,
}

/// The edges and the diagonal of a coupling.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Links {
    /// Edges that are drawn: all, or evenly chosen ones.
    pub drawn: Vec<Link>,
    /// How many there are.
    pub total: usize,
    /// Diagonal of `Gamma`.
    pub own: Vec<f64>,
    /// Largest absolute weight.
    pub largest: f64,
    /// The usual forms that the coupling has.
    pub forms: Vec<(CouplingForm, f64)>,
    /// Which subsystems have local measurements.
    pub measured: Vec<bool>,
    /// For each subsystem whom it listens to, itself included when it has an entry.
    pub listens: Vec<Vec<usize>>,
    /// The entries of `Psi` in a line, as far as they can be read in one.
    pub psi: String,
}

/// The entries of `Psi`, as far as they can be read in a line.
fn listed(data: &NetworkData) -> String {
    const SHOWN: usize = 12;
    let entries = data.Psi.entries();
    let one = |(i, j, value): &(usize, usize, f64)| format!("Psi[{}, {}] = {}", i + 1, j + 1, short(*value));
    let mut text = entries.iter().take(SHOWN).map(one).collect::<Vec<_>>().join(", ");
    if entries.len() > SHOWN {
        text.extend([" and ", &(entries.len() - SHOWN).to_string(), " more"]);
    }
    if text.is_empty() { "nothing is measured globally: all entries are zero".to_owned() } else { text }
}

impl Links {
    /// Collects the edges of a network.
    pub(super) fn of(data: &NetworkData) -> Self {
        let count = data.n_subsystems();
        let entries = data.Gamma.entries();
        let mut own = vec![0.0; count];
        for (i, _, value) in entries.iter().filter(|(i, j, _)| i == j) {
            own[*i] = *value;
        }
        let mut listens = vec![Vec::new(); count];
        for (i, j, _) in &entries {
            if let Some(row) = listens.get_mut(*i) {
                row.push(*j);
            }
        }
        let edges: Vec<&(usize, usize, f64)> = entries.iter().filter(|(i, j, _)| i != j).collect();
        let places: BTreeSet<(usize, usize)> = edges.iter().map(|(to, from, _)| (*to, *from)).collect();
        let stride = edges.len().div_ceil(DRAWN).max(1);
        let link = |(to, from, weight): &(usize, usize, f64)| Link {
            to: *to,
            from: *from,
            weight: *weight,
            mutual: places.contains(&(*from, *to)),
        };
        let mut measured = vec![false; count];
        for place in data.local.iter().filter_map(|number| number.checked_sub(1)) {
            if let Some(place) = measured.get_mut(place) {
                *place = true;
            }
        }
        Self {
            drawn: edges.iter().step_by(stride).map(|edge| link(edge)).collect(),
            total: edges.len(),
            own,
            largest: edges.iter().map(|edge| edge.2.abs()).fold(0.0, f64::max),
            forms: coupling_forms(&data.Gamma),
            measured,
            listens,
            psi: listed(data),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::document::{Coupling, PlantData, read_document};

    fn network(side: usize, entries: Vec<(usize, usize, f64)>) -> NetworkData {
        let text = include_str!("../../../tests/documents/003-network.json");
        let PlantData::Network(mut data) = read_document(text).unwrap().plant else {
            unreachable!("a network")
        };
        data.Gamma = Coupling::Sparse { rows: side, columns: side, entries };
        data
    }

    #[test]
    fn edges_lead_from_whom_is_listened_to() {
        let links = Links::of(&network(4, vec![(1, 2, 2.0), (2, 1, -3.0), (3, 1, 1.0), (2, 2, 5.0)]));
        assert_eq!(links.drawn[0], Link { to: 0, from: 1, weight: 2.0, mutual: true }, "1 listens to 2");
        assert!(!links.drawn[2].mutual, "1 does not listen to 3");
        assert_eq!((links.own[1], links.largest, links.total), (5.0, 3.0, 3), "the diagonal is no edge");
        assert_eq!(links.listens, [vec![1], vec![0, 1], vec![0], vec![]], "row by row");
        assert_eq!(links.psi, "Psi[1, 1] = 1, Psi[1, 2] = -1", "in a line");
        assert_eq!(links.measured, [false, false, false, true], "subsystem 4 has a sensor");
    }

    #[test]
    fn no_more_edges_are_drawn_than_can_be_seen() {
        let entries = (1..=200).flat_map(|i| (1..=200).map(move |j| (i, j, 1.0))).collect();
        let links = Links::of(&network(200, entries));
        assert_eq!(links.total, 200 * 199, "all are counted");
        assert!(links.drawn.len() <= DRAWN && links.drawn.len() > DRAWN / 2, "{}", links.drawn.len());
        let listeners: BTreeSet<usize> = links.drawn.iter().map(|link| link.to).collect();
        assert_eq!(listeners.len(), 200, "evenly chosen");
    }
}
