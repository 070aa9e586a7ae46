//! Intents on what designs by linear matrix inequalities need: demands, subsystems, the nonlinearity.

use nalgebra::DMatrix;

use crate::observer::GivenObserver;

/// A change of the demands on a design by linear matrix inequalities.
#[derive(Clone, Debug, PartialEq)]
pub enum LmiEdit {
    /// The demand on the speed of the error; `None` takes it away.
    Decay {
        /// Decay rate, or radius in discrete time.
        decay: Option<f64>,
        /// The drag ends here.
        done: bool,
    },
    /// The bound on the free gains; `None` takes it away.
    Gain {
        /// The bound.
        gain: Option<f64>,
        /// The drag ends here.
        done: bool,
    },
    /// The bound on the condition of the Lyapunov matrix.
    Conditioning {
        /// The bound.
        conditioning: f64,
        /// The drag ends here.
        done: bool,
    },
    /// The attenuation; `None` asks for the least.
    Gamma {
        /// The attenuation.
        gamma: Option<f64>,
        /// The drag ends here.
        done: bool,
    },
    /// The relative distance from the least attenuation.
    BackOff {
        /// The distance.
        back_off: f64,
        /// The drag ends here.
        done: bool,
    },
    /// The time limit of one solution.
    Seconds {
        /// In seconds.
        seconds: f64,
        /// The drag ends here.
        done: bool,
    },
    /// The method's other form of the inequalities.
    Alternative(bool),
    /// All matrices `R`; none lets the order choose.
    Rows(Vec<DMatrix<f64>>),
    /// One entry of an `R`, as typed.
    RowsCell {
        /// Whose, from zero.
        subsystem: usize,
        /// Row, from zero.
        row: usize,
        /// Column, from zero.
        column: usize,
        /// What was typed.
        text: String,
    },
    /// A whole `R`, as pasted.
    RowsPaste {
        /// Whose, from zero.
        subsystem: usize,
        /// What was pasted.
        text: String,
    },
    /// The states that are decoupled exactly, one list for each subsystem; `None`: as many as possible.
    Decoupled(Option<Vec<Vec<usize>>>),
    /// Whether one subsystem decouples one state exactly.
    Decouple {
        /// The subsystem, from zero.
        subsystem: usize,
        /// The state of another subsystem, numbered in the whole system from zero.
        state: usize,
        /// Exactly, not only attenuated.
        exactly: bool,
    },
    /// An observer that is examined; `None` designs one again.
    Examine(Option<GivenObserver>),
    /// A part of the observer that is examined, as typed or pasted.
    Given {
        /// Which part.
        part: GivenPart,
        /// What was typed; an empty attenuation claims none.
        text: String,
    },
}

/// The parts of an observer that is examined.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum GivenPart {
    /// The state matrix.
    N,
    /// The output injection.
    J,
    /// The attenuation that is claimed.
    Gamma,
}

/// A change of the partition into subsystems.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum PartitionEdit {
    /// Divides a subsystem, or the whole system, where `E` and `C` allow it, next to its middle.
    Split {
        /// The subsystem, from zero; of a system that is not partitioned, 0.
        subsystem: usize,
    },
    /// Joins a subsystem with the next one, the last with the one before it.
    Join {
        /// The subsystem, from zero.
        subsystem: usize,
    },
    /// Takes the partition away.
    Clear,
    /// The name of a subsystem.
    Name {
        /// The subsystem, from zero.
        subsystem: usize,
        /// Its name.
        name: String,
    },
    /// Moves the border behind a subsystem; the other borders there follow as far as `E` and `C` need it.
    Move {
        /// The subsystem before the border, from zero.
        border: usize,
        /// What the border divides.
        share: Share,
        /// How many of these lie before the border in the whole system.
        to: usize,
        /// The drag ends here.
        done: bool,
    },
}

/// What subsystems share among each other.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Share {
    /// States, and equations with them where both go in step.
    States,
    /// Equations.
    Equations,
    /// Outputs.
    Outputs,
}

/// A change of the nonlinearity `G f(x)`.
#[derive(Clone, Debug, PartialEq)]
pub enum LipschitzEdit {
    /// Adds a nonlinearity to a system that has none.
    Add,
    /// Takes it away.
    Remove,
    /// One entry of its matrices, as typed.
    Cell {
        /// The matrix.
        matrix: LipschitzMatrix,
        /// Row, from zero.
        row: usize,
        /// Column, from zero.
        column: usize,
        /// What was typed.
        text: String,
    },
    /// A whole matrix, as pasted; it brings its number of components or rows along.
    Paste {
        /// The matrix.
        matrix: LipschitzMatrix,
        /// What was pasted.
        text: String,
    },
    /// One component, as typed.
    Component {
        /// Which, from zero.
        index: usize,
        /// What was typed.
        text: String,
    },
    /// The Lipschitz constant, as typed.
    Constant(String),
    /// One more or one fewer component, or row of `F_L`, at the end.
    Size {
        /// Of what: `G` for components, `F_L` for its rows.
        of: LipschitzMatrix,
        /// Whether one is added.
        grow: bool,
    },
}

/// The matrices of a nonlinearity.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum LipschitzMatrix {
    /// Distribution of the components over the equations.
    G,
    /// The combinations of states that the nonlinearity depends on.
    Arguments,
}
