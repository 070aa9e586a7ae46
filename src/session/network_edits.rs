//! Intents on a network of identical subsystems (paper 003): matrices, sizes, coupling, local observers.

use crate::document::NetworkMatrix;
use crate::numerics::Complex64;

/// A change of a network.
#[derive(Clone, Debug, PartialEq)]
pub enum NetworkEdit {
    /// One cell of a matrix, as typed.
    Cell {
        /// The cell.
        cell: NetworkCell,
        /// What was typed.
        text: String,
    },
    /// A pasted block; a block that is larger than what it is pasted onto replaces the whole matrix.
    Paste {
        /// The cell that was active.
        cell: NetworkCell,
        /// What was pasted.
        text: String,
    },
    /// One more or one fewer, at the end; all matrices follow.
    Size {
        /// Of what.
        of: NetworkSize,
        /// Whether one is added.
        grow: bool,
    },
    /// The number of subsystems, as typed.
    Subsystems(String),
    /// One of the usual couplings in place of `Gamma`.
    Template {
        /// Its form.
        form: CouplingForm,
        /// Weight of an edge.
        weight: f64,
    },
    /// What one subsystem receives from another, as typed: `Gamma[to, from]`.
    Edge {
        /// The subsystem that listens, from zero.
        to: usize,
        /// The one that it listens to, from zero.
        from: usize,
        /// What was typed.
        text: String,
        /// The diagonal follows, so that the sum of the row stays as it is.
        balanced: bool,
    },
    /// Whether a subsystem has local measurements.
    Local {
        /// The subsystem, from zero; `None` for all of them.
        subsystem: Option<usize>,
        /// Whether it has.
        measured: bool,
    },
    /// Whether a local observer is plugged in.
    Plug {
        /// The subsystem, from zero; `None` for all that have local measurements.
        subsystem: Option<usize>,
        /// Whether it is.
        plugged: bool,
    },
    /// Further or other measurements, as the existence conditions ask for them.
    Measure(Measure),
    /// All poles of the local observers, as typed: `-22, -3+2i, -3-2i`.
    LocalPoles(String),
    /// One pole of the local observers moved in the plane; its conjugate follows.
    MoveLocalPole {
        /// Its place in the list.
        index: usize,
        /// Where it is now.
        to: Complex64,
        /// The drag ends here.
        done: bool,
    },
    /// The network written out as the matrices of one system.
    Expand,
}

/// A cell of a network's matrix, rows and columns from zero.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct NetworkCell {
    /// The matrix.
    pub matrix: NetworkMatrix,
    /// Row.
    pub row: usize,
    /// Column.
    pub column: usize,
}

/// The sizes of a network that steppers change.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NetworkSize {
    /// Number of subsystems N.
    Subsystems,
    /// States of a subsystem n.
    States,
    /// Coupling channels m: columns of `b` and rows of `c`.
    Channels,
    /// Rows of `c_G`.
    GlobalOutputs,
    /// Rows of `c_L`.
    LocalOutputs,
    /// Rows of `Psi`.
    Combinations,
}

/// Usual couplings. The diagonal makes the sum of each row zero, so that subsystems in equal states do not feel each
/// other; of leaders it is zero.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CouplingForm {
    /// Each with the one before and the one behind it.
    Chain,
    /// A chain whose ends meet.
    Ring,
    /// The first one with each of the others.
    Star,
    /// Each with all others.
    Complete,
    /// Each listens to a few others by chance, reproducible by the seed.
    Random {
        /// The seed.
        seed: u64,
    },
    /// Everybody listens to the leader of its group, leaders to the next leader: a coupling whose rank is the number of
    /// leaders, so that the global observer stays small however many subsystems there are.
    Leaders {
        /// How many.
        leaders: usize,
    },
}

/// Measurements that mend a condition.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Measure {
    /// `Psi` becomes a row of `Gamma`: what is measured globally is what one subsystem receives.
    ReceivedOnly {
        /// The subsystem, from zero.
        subsystem: usize,
    },
    /// `Psi` gets a further row: what a subsystem receives.
    Received {
        /// The subsystem, from zero.
        subsystem: usize,
    },
    /// `c_G` becomes `c`.
    CouplingOutputOnly,
    /// `c_G` gets the rows of `c` besides its own.
    CouplingOutput,
    /// `c_L` gets a row that measures one state of the subsystem.
    LocalState {
        /// The state, from zero.
        state: usize,
    },
}
