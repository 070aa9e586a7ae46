//! L3: the versioned file format, links, pasted matrices, exports.

pub mod comparison;
mod coupling;
mod cursor;
mod draw;
mod duplicates;
mod entry;
mod error;
mod export_csv;
mod export_svg;
mod figures;
mod import;
mod import_cells;
mod import_latex;
mod initial;
mod json;
pub mod limits;
mod link;
mod lmi;
mod matrix_text;
mod model;
mod network;
mod network_matrix;
mod pretty;
mod printed_example;
mod read;
pub mod report;
mod write;

pub use entry::{Entry, EntryMatrix};
pub use error::DocumentError;
pub use export_csv::{figure_to_csv, motion_to_csv, trajectory_to_csv};
pub use export_svg::figure_to_svg;
pub use import::{ImportError, PastedMatrix, matrix_from_text};
pub use initial::InitialFormula;
pub use json::to_json;
pub use link::{LinkError, from_link_fragment, is_link_fragment, to_link_fragment};
pub use matrix_text::{MatrixSyntax, matrix_to_text};
pub use model::{
    CHOSEN, Coupling, DescriptorData, Document, FreeData, KeptDesign, LipschitzData, Matrix, NetworkData,
    PlantData, ScenarioData, Subject, UncertaintyData,
};
pub use network_matrix::NetworkMatrix;
pub use read::{Sizes, read_document};
pub use write::{write_document, write_document_compact};

use figures::read_figures;

/// The format version that this program writes, and the newest that it reads.
pub const VERSION: u64 = 1;

/// The known word nearest to a mistyped one, when it is near enough to be meant.
pub(crate) fn nearest<'a>(word: &str, known: &[&'a str]) -> Option<&'a str> {
    let distance = |other: &str| edit_distance(&word.to_lowercase(), &other.to_lowercase());
    let near = known.iter().map(|other| (distance(other), *other)).min_by_key(|(d, _)| *d);
    near.filter(|(d, other)| *d <= 1 + other.len() / 4).map(|(_, other)| other)
}

/// Levenshtein distance of two short words.
fn edit_distance(a: &str, b: &str) -> usize {
    let b: Vec<char> = b.chars().collect();
    let mut row: Vec<usize> = (0..=b.len()).collect();
    for (i, x) in a.chars().enumerate() {
        let mut diagonal = row[0];
        row[0] = i + 1;
        for (j, y) in b.iter().enumerate() {
            let substituted = diagonal + usize::from(x != *y);
            diagonal = row[j + 1];
            row[j + 1] = substituted.min(row[j] + 1).min(diagonal + 1);
        }
    }
    row[b.len()]
}
