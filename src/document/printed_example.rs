//! Whether a document holds the example that a paper prints.

use std::sync::OnceLock;

use super::{DescriptorData, Document, EntryMatrix, NetworkData, PlantData, read_document};
use crate::paper::EXAMPLES;

impl Document {
    /// Whether the plant is that of the example that a paper prints: named as such, and with its numbers.
    ///
    /// Design, scenario and local observers of a network may be others.
    pub fn is_printed_example(&self, paper: &str) -> bool {
        static PRINTED: OnceLock<Vec<Document>> = OnceLock::new();
        if self.paper != paper {
            return false;
        }
        let read = || EXAMPLES.iter().filter_map(|example| read_document(example.text).ok()).collect();
        // of several examples from a paper the first is the printed one
        let printed = PRINTED.get_or_init(read).iter().find(|document| document.paper == paper);
        printed.is_some_and(|printed| same_numbers(&self.plant, &printed.plant))
    }
}

fn same_numbers(one: &PlantData, other: &PlantData) -> bool {
    let same = |one: &EntryMatrix, other: &EntryMatrix| {
        one.shape() == other.shape() && one.values() == other.values()
    };
    match (one, other) {
        (PlantData::Descriptor(one), PlantData::Descriptor(other)) => {
            let DescriptorData { time, matrices, partition, lipschitz } = other;
            one.time == *time
                && one.matrices.iter().zip(matrices).all(|(one, other)| same(one, other))
                && one.partition == *partition
                && one.lipschitz.is_some() == lipschitz.is_some()
        }
        (PlantData::Network(one), PlantData::Network(other)) => {
            let NetworkData { a, b, c, Gamma, Psi, c_G, c_L, .. } = other;
            one.states() == other.states()
                && same(&one.a, a)
                && same(&one.b, b)
                && same(&one.c, c)
                && same(&one.c_G, c_G)
                && same(&one.c_L, c_L)
                && one.Psi.values() == Psi.values()
                && one.Gamma.coupling() == Gamma.coupling()
        }
        _ => false,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::document::{Entry, Matrix};
    use crate::paper::example;

    fn opened(key: &str) -> Document {
        read_document(example(key).unwrap().text).unwrap()
    }

    #[test]
    fn the_printed_example_is_known_by_name_and_numbers() {
        let printed = opened("input-decoupled");
        assert!(
            printed.is_printed_example("001") && !printed.is_printed_example("004"),
            "of its paper alone"
        );
        let mut nameless = printed.clone();
        nameless.paper.clear();
        assert!(!nameless.is_printed_example("001"), "equal numbers are not enough");
        let mut changed = printed.clone();
        if let PlantData::Descriptor(data) = &mut changed.plant {
            data.matrix_mut(Matrix::A).set(2, 1, Entry::typed("3").unwrap());
        }
        assert!(!changed.is_printed_example("001"), "another plant");
        if let PlantData::Descriptor(data) = &mut changed.plant {
            data.matrix_mut(Matrix::A).set(2, 1, Entry::typed("4/2").unwrap());
        }
        assert!(changed.is_printed_example("001"), "the same number, typed otherwise");
        for (key, paper) in
            [("decentralized", "000"), ("hierarchical", "003"), ("proportional-integral", "004")]
        {
            assert!(opened(key).is_printed_example(paper), "{key}");
        }
        assert!(!opened("network-ring").is_printed_example("003"), "no paper prints the ring");
    }
}
