//! Every intent of a user, as data: the menu, the shortcuts and the tests are made of these.

use super::edit_compare::CompareEdit;
use super::edit_free::FreeEdit;
use super::model_edits::{LipschitzEdit, LmiEdit, PartitionEdit};
use super::network_edits::NetworkEdit;
use crate::document::Matrix;
use crate::numerics::Complex64;
use crate::observer::{Method, Order};
use crate::paper::{ComparisonFigures, FigureSpec};
use crate::system::TimeDomain;

/// What a person wants.
#[derive(Clone, Debug, PartialEq)]
pub enum Command {
    /// Open the text of a document; on an error nothing changes and the reason is shown.
    Open {
        /// The text.
        text: String,
    },
    /// Open an example by its key.
    OpenExample {
        /// Its key.
        key: String,
    },
    /// Begin with a small network of identical subsystems.
    NewNetwork,
    /// Undo the last step.
    Undo,
    /// Redo what was undone.
    Redo,
    /// Change the document.
    Edit(Edit),
    /// Change what is shown.
    Show(Show),
}

/// A change of the document; each is one step of the history unless it is part of a drag.
#[derive(Clone, Debug, PartialEq)]
pub enum Edit {
    /// The title.
    Title(String),
    /// The notes.
    Notes(String),
    /// Continuous or discrete time.
    Time(TimeDomain),
    /// One cell of a matrix, as typed.
    Cell {
        /// The matrix.
        cell: Cell,
        /// What was typed.
        text: String,
    },
    /// A pasted block; a block that is larger than what it is pasted onto replaces the whole matrix.
    Paste {
        /// The cell that was active.
        cell: Cell,
        /// What was pasted.
        text: String,
    },
    /// A whole matrix at once.
    Fill {
        /// The matrix.
        matrix: Matrix,
        /// With what.
        fill: Fill,
    },
    /// One more or one fewer state, input, output or unknown input; all matrices follow.
    Size {
        /// Of what.
        of: Size,
        /// Whether one is added, at the end, or the last one removed.
        grow: bool,
    },
    /// A further output that measures one state.
    AddSensor {
        /// The state, from zero.
        state: usize,
    },
    /// The method.
    Method(Method),
    /// The order.
    Order(Order),
    /// All poles, as typed: `-22, -3+2i, -3-2i`.
    Poles(String),
    /// One pole moved in the plane; its conjugate follows.
    MovePole {
        /// Its place in the list.
        index: usize,
        /// Where it is now.
        to: Complex64,
        /// The drag ends here.
        done: bool,
    },
    /// The bandwidth factor.
    Scale {
        /// The factor.
        scale: f64,
        /// The drag ends here.
        done: bool,
    },
    /// Initial state of one component, as typed.
    Initial {
        /// The state, from zero.
        state: usize,
        /// What was typed.
        text: String,
    },
    /// Initial states of all components as one expression in `i`, as typed; empty for zeros.
    InitialFormula(String),
    /// A signal, as typed.
    Signal {
        /// Which list.
        list: SignalList,
        /// Which component, from zero.
        index: usize,
        /// What was typed.
        text: String,
    },
    /// Horizon in seconds or steps.
    Horizon(f64),
    /// Number of recorded instants.
    Samples(usize),
    /// Factor on the uncertainty of `A`; creates an uncertainty of one percent when there is none.
    UncertaintyScale {
        /// The factor.
        scale: f64,
        /// The drag ends here.
        done: bool,
    },
    /// One cell of the uncertainty's amplitudes or frequencies, as typed.
    UncertaintyCell {
        /// Row, from zero.
        row: usize,
        /// Column, from zero.
        column: usize,
        /// The frequency in Hz, not the amplitude.
        frequency: bool,
        /// What was typed.
        text: String,
    },
    /// Measurement noise of one standard deviation on all outputs; zero removes it.
    NoiseLevel {
        /// Standard deviation.
        deviation: f64,
        /// The drag ends here.
        done: bool,
    },
    /// The multiplier of the rank threshold.
    RankTolerance(f64),
    /// Demands on designs by linear matrix inequalities.
    Lmi(LmiEdit),
    /// Subsystems.
    Partition(PartitionEdit),
    /// The nonlinearity.
    Lipschitz(LipschitzEdit),
    /// What drives the states that the equations leave free.
    Free(FreeEdit),
    /// The designs that are kept to be compared.
    Compare(CompareEdit),
    /// The network.
    Network(NetworkEdit),
}

/// A cell of a matrix, rows and columns from zero.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Cell {
    /// The matrix.
    pub matrix: Matrix,
    /// Row.
    pub row: usize,
    /// Column.
    pub column: usize,
}

/// Contents for a whole matrix.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Fill {
    /// Zeros.
    Zero,
    /// Ones on the diagonal.
    Identity,
    /// Small whole numbers by chance, reproducible by the seed.
    Random {
        /// The seed.
        seed: u64,
    },
    /// Every entry times a factor.
    Scaled(f64),
}

/// The sizes of a system.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Size {
    /// States and, for as long as the system is square, equations.
    States,
    /// Equations alone, which makes a system rectangular.
    Equations,
    /// Known inputs.
    Inputs,
    /// Outputs.
    Outputs,
    /// Unknown inputs.
    UnknownInputs,
}

/// The lists of signals of a scenario.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum SignalList {
    /// Known inputs.
    Known,
    /// Unknown inputs.
    Unknown,
    /// Measurement noise.
    Noise,
}

/// A change of what is shown; not part of the history.
#[derive(Clone, Debug, PartialEq)]
pub enum Show {
    /// A view of the figures' place.
    Tab(Tab),
    /// A figure of the document.
    Figure(String),
    /// A figure of the comparison.
    Compared(ComparedFigure),
    /// On narrow screens: one of the three places.
    Place(Place),
    /// Light or dark.
    Theme(ThemeChoice),
}

/// The views in the figures' place.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Tab {
    /// True and estimated states.
    #[default]
    Overview,
    /// States, one panel each.
    States,
    /// Estimation errors.
    Errors,
    /// Unknown input, known inputs, outputs.
    UnknownInput,
    /// Poles in the complex plane.
    Poles,
    /// Frequency responses.
    Bode,
    /// Designs along a sweep of the bandwidth or of the decay.
    TradeOff,
    /// The chosen design beside those that are kept.
    Compare,
    /// Figures of the document.
    Figures,
}

impl Tab {
    /// All views, in the order in which they are offered.
    pub const ALL: [Self; 9] = [
        Self::Overview,
        Self::States,
        Self::Errors,
        Self::UnknownInput,
        Self::Poles,
        Self::Bode,
        Self::TradeOff,
        Self::Compare,
        Self::Figures,
    ];

    /// The name on screen.
    pub fn title(self) -> &'static str {
        match self {
            Self::Overview => "Overview",
            Self::States => "States",
            Self::Errors => "Errors",
            Self::UnknownInput => "Unknown input",
            Self::Poles => "Poles",
            Self::Bode => "Bode",
            Self::TradeOff => "Trade-off",
            Self::Compare => "Compare",
            Self::Figures => "Paper figures",
        }
    }
}

/// The figures of a comparison.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ComparedFigure {
    /// True states and all estimates.
    #[default]
    States,
    /// The errors of all designs.
    Errors,
    /// Unknown inputs and all estimates.
    UnknownInput,
    /// Largest gains over frequency.
    Gains,
}

impl ComparedFigure {
    /// All, in the order in which they are offered.
    pub const ALL: [Self; 4] = [Self::States, Self::Errors, Self::UnknownInput, Self::Gains];

    /// The name on screen.
    pub fn title(self) -> &'static str {
        match self {
            Self::States => "All states",
            Self::Errors => "All errors",
            Self::UnknownInput => "All unknown inputs",
            Self::Gains => "All gains",
        }
    }

    /// The figure, unless it would be empty.
    pub fn of(self, figures: &ComparisonFigures) -> Option<&FigureSpec> {
        match self {
            Self::States => figures.states.as_ref(),
            Self::Errors => figures.errors.as_ref(),
            Self::UnknownInput => figures.unknown_input.as_ref(),
            Self::Gains => figures.gains.as_ref(),
        }
    }
}

/// The three places of the instrument, of which a narrow screen shows one.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Place {
    /// The system.
    System,
    /// The observer.
    Observer,
    /// What happens.
    #[default]
    Figures,
}

/// Light, dark, or as the machine is set.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ThemeChoice {
    /// As the machine is set.
    #[default]
    System,
    /// Light.
    Light,
    /// Dark.
    Dark,
}
