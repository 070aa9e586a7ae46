//! Whether a plant is the example of a paper, whatever else of the document was edited.

use std::sync::OnceLock;

use super::{Coupling, DescriptorData, EntryMatrix, LipschitzData, NetworkData, PlantData, read_document};
use crate::paper::{example, paper_examples};

/// The paper whose example a plant is: the same matrices, partition and nonlinearity.
///
/// Names, the time domain, which paper 000 does not print, and how an entry is typed make no difference.
pub fn paper_of(plant: &PlantData) -> Option<&'static str> {
    known().iter().find(|(_, known)| same(known, plant)).map(|(paper, _)| *paper)
}

/// The papers' plants, read once.
fn known() -> &'static [(&'static str, PlantData)] {
    static KNOWN: OnceLock<Vec<(&'static str, PlantData)>> = OnceLock::new();
    KNOWN.get_or_init(|| {
        let read =
            |(paper, key): (&'static str, &str)| Some((paper, read_document(example(key)?.text).ok()?.plant));
        paper_examples().filter_map(read).collect()
    })
}

fn same(a: &PlantData, b: &PlantData) -> bool {
    match (a, b) {
        (PlantData::Descriptor(a), PlantData::Descriptor(b)) => same_descriptor(a, b),
        (PlantData::Network(a), PlantData::Network(b)) => same_network(a, b),
        _ => false,
    }
}

fn same_descriptor(a: &DescriptorData, b: &DescriptorData) -> bool {
    let terms = match (&a.lipschitz, &b.lipschitz) {
        (Some(a), Some(b)) => same_term(a, b),
        (a, b) => a.is_none() && b.is_none(),
    };
    let subsystem = |(a, b): (&crate::system::Subsystem, &crate::system::Subsystem)| {
        (a.states, a.equations, a.outputs) == (b.states, b.equations, b.outputs)
    };
    terms
        && a.matrices.iter().zip(&b.matrices).all(|(a, b)| same_matrix(a, b))
        && a.partition.len() == b.partition.len()
        && a.partition.iter().zip(&b.partition).all(subsystem)
}

#[expect(clippy::float_cmp, reason = "the same number, not one that is near")]
fn same_term(a: &LipschitzData, b: &LipschitzData) -> bool {
    same_matrix(&a.G, &b.G) && same_matrix(&a.F_L, &b.F_L) && a.f == b.f && a.constant == b.constant
}

fn same_network(a: &NetworkData, b: &NetworkData) -> bool {
    let parts =
        |data: &NetworkData| [&data.a, &data.b, &data.c, &data.c_G, &data.c_L].map(EntryMatrix::values);
    // shapes first: a large network is never written out
    let same_coupling = |a: &Coupling, b: &Coupling| a.shape() == b.shape() && a.values() == b.values();
    same_coupling(&a.Gamma, &b.Gamma)
        && same_coupling(&a.Psi, &b.Psi)
        && parts(a) == parts(b)
        && a.local == b.local
}

fn same_matrix(a: &EntryMatrix, b: &EntryMatrix) -> bool {
    a.shape() == b.shape() && a.values() == b.values()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::document::{Document, Entry, Matrix};
    use crate::paper::EXAMPLES;
    use crate::system::TimeDomain;

    fn document(key: &str) -> Document {
        read_document(example(key).unwrap().text).unwrap()
    }

    #[test]
    fn each_paper_has_one_example_and_no_other_document_is_taken_for_it() {
        for example in EXAMPLES {
            let expected = paper_examples().find(|(_, key)| *key == example.key).map(|(paper, _)| paper);
            assert_eq!(paper_of(&document(example.key).plant), expected, "{}", example.key);
        }
    }

    #[test]
    fn an_edited_plant_is_no_example_but_the_time_domain_and_names_are_free() {
        let mut edited = document("decentralized");
        let PlantData::Descriptor(data) = &mut edited.plant else { panic!("a descriptor system") };
        data.time = TimeDomain::Continuous;
        "left".clone_into(&mut data.partition[0].name);
        assert_eq!(paper_of(&edited.plant), Some("000"), "the paper prints neither");
        let PlantData::Descriptor(data) = &mut edited.plant else { panic!("a descriptor system") };
        data.matrix_mut(Matrix::A).set(0, 0, Entry::number(-0.5));
        assert_eq!(paper_of(&edited.plant), None, "another matrix");
    }

    #[test]
    fn a_plant_without_its_nonlinearity_is_another() {
        let mut edited = document("h-infinity-lipschitz");
        let PlantData::Descriptor(data) = &mut edited.plant else { panic!("a descriptor system") };
        data.lipschitz = None;
        assert_eq!(paper_of(&edited.plant), None, "the linear part alone");
    }
}
