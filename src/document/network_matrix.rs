//! The matrices of a network by name.

use super::entry::Entry;
use super::model::NetworkData;

/// The matrices of a network.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum NetworkMatrix {
    /// State matrix `a` of a subsystem.
    State,
    /// Coupling input `b`.
    Input,
    /// Coupling output `c`.
    Output,
    /// Globally measured part `c_G`.
    GlobalOutput,
    /// Locally measured part `c_L`.
    LocalOutput,
    /// Coupling `Gamma` between subsystems.
    Gamma,
    /// Globally measured combinations `Psi`.
    Psi,
}

impl NetworkMatrix {
    /// All, in the order of reading.
    pub const ALL: [Self; 7] = [
        Self::State,
        Self::Input,
        Self::Output,
        Self::GlobalOutput,
        Self::LocalOutput,
        Self::Gamma,
        Self::Psi,
    ];

    /// The letter, as in documents.
    pub fn letter(self) -> &'static str {
        match self {
            Self::State => "a",
            Self::Input => "b",
            Self::Output => "c",
            Self::GlobalOutput => "c_G",
            Self::LocalOutput => "c_L",
            Self::Gamma => "Gamma",
            Self::Psi => "Psi",
        }
    }

    /// What it is, in words.
    pub fn meaning(self) -> &'static str {
        match self {
            Self::State => "one subsystem",
            Self::Input => "what the coupling does to a subsystem",
            Self::Output => "what a subsystem shows the others",
            Self::GlobalOutput => "what is measured globally of a subsystem",
            Self::LocalOutput => "what a local sensor measures of its subsystem",
            Self::Gamma => "who listens to whom: row i holds what subsystem i receives",
            Self::Psi => "the combinations of subsystems that are measured globally",
        }
    }
}

impl NetworkData {
    /// Rows and columns of a matrix.
    pub fn shape(&self, matrix: NetworkMatrix) -> (usize, usize) {
        match matrix {
            NetworkMatrix::State => self.a.shape(),
            NetworkMatrix::Input => self.b.shape(),
            NetworkMatrix::Output => self.c.shape(),
            NetworkMatrix::GlobalOutput => self.c_G.shape(),
            NetworkMatrix::LocalOutput => self.c_L.shape(),
            NetworkMatrix::Gamma => self.Gamma.shape(),
            NetworkMatrix::Psi => self.Psi.shape(),
        }
    }

    /// An entry of a matrix, from zero; `None` outside.
    pub fn entry(&self, matrix: NetworkMatrix, i: usize, j: usize) -> Option<Entry> {
        match matrix {
            NetworkMatrix::State => self.a.entry(i, j).cloned(),
            NetworkMatrix::Input => self.b.entry(i, j).cloned(),
            NetworkMatrix::Output => self.c.entry(i, j).cloned(),
            NetworkMatrix::GlobalOutput => self.c_G.entry(i, j).cloned(),
            NetworkMatrix::LocalOutput => self.c_L.entry(i, j).cloned(),
            NetworkMatrix::Gamma => self.Gamma.entry(i, j),
            NetworkMatrix::Psi => self.Psi.entry(i, j),
        }
    }

    /// Number of subsystems N.
    pub fn n_subsystems(&self) -> usize {
        self.Gamma.shape().0
    }

    /// Whether a subsystem, from zero, has local measurements.
    pub fn has_local_outputs(&self, subsystem: usize) -> bool {
        self.local.contains(&(subsystem + 1))
    }

    /// Whether a subsystem, from zero, has a local observer that is plugged in, of those that a choice names.
    pub fn is_plugged(&self, subsystem: usize, plugged: Option<&[usize]>) -> bool {
        self.has_local_outputs(subsystem) && plugged.is_none_or(|list| list.contains(&subsystem))
    }
}
