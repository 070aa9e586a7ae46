//! A document: everything that a person edits, saves and shares.
#![expect(non_snake_case, reason = "matrix letters of the canonical form")]

use std::collections::BTreeMap;

use super::entry::{Entry, EntryMatrix};
use super::initial::InitialFormula;
use super::limits::{MAX_EXPANDED, MAX_NAME};
use crate::numerics::Tolerance;
use crate::observer::DesignChoice;
use crate::paper::FigureRecipe;
use crate::simulation::comparison::Contender;
use crate::simulation::{FreeVariables, Scenario};
use crate::system::{
    CouplingMatrix, DescriptorSystem, LipschitzTerm, Model, Network, Signal, Subsystem, SystemError,
    TimeDomain, nonlinearity,
};

/// A problem as a person wrote it: system, design choice, scenario and figures.
#[derive(Clone, Debug, PartialEq)]
pub struct Document {
    /// Title.
    pub title: String,
    /// Notes of the author, free text.
    pub notes: String,
    /// The paper whose example this is, for example `004`; empty for own work.
    pub paper: String,
    /// The system.
    pub plant: PlantData,
    /// The chosen design.
    pub design: DesignChoice,
    /// What happens in the simulation.
    pub scenario: ScenarioData,
    /// Thresholds.
    pub tolerance: Tolerance,
    /// Designs that are kept beside the chosen one, to be compared with it.
    pub kept: Vec<KeptDesign>,
    /// Figures that can be drawn from it.
    pub figures: Vec<FigureRecipe>,
}

/// The chosen design's name in a comparison.
pub const CHOSEN: &str = "chosen";

/// A design that is kept beside the chosen one.
#[derive(Clone, Debug, PartialEq)]
pub struct KeptDesign {
    /// Its name in tables and legends.
    pub name: String,
    /// The choice.
    pub design: DesignChoice,
}

impl KeptDesign {
    /// Why a text cannot be the name of a kept design, and what to do.
    pub fn refused_name(name: &str) -> Option<String> {
        let length = name.chars().count();
        if name.trim().is_empty() {
            Some("a name is needed, for example \"proportional\"".to_owned())
        } else if name.trim() == CHOSEN {
            Some("this is the name of the chosen design: take another".to_owned())
        } else if length > MAX_NAME {
            Some(format!(
                "the name has {length} characters, and at most {MAX_NAME} fit above a column: take a shorter one"
            ))
        } else {
            None
        }
    }
}

/// The two ways to give a system.
#[derive(Clone, Debug, PartialEq)]
pub enum PlantData {
    /// Matrices of one descriptor system, perhaps partitioned, perhaps with a Lipschitz term.
    Descriptor(DescriptorData),
    /// Identical subsystems and their coupling.
    Network(NetworkData),
}

/// Matrices of a descriptor system as typed.
#[derive(Clone, Debug, PartialEq)]
pub struct DescriptorData {
    /// Differential or difference equations.
    pub time: TimeDomain,
    /// The matrices E, A, B, C, D, F in the order of [`Matrix`].
    pub matrices: [EntryMatrix; 6],
    /// Interconnected subsystems; empty when the system is not partitioned.
    pub partition: Vec<Subsystem>,
    /// Lipschitz term.
    pub lipschitz: Option<LipschitzData>,
}

/// The matrices of a descriptor system.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Matrix {
    /// Matrix of the derivatives.
    E,
    /// State matrix.
    A,
    /// Known inputs.
    B,
    /// Outputs.
    C,
    /// Unknown inputs.
    D,
    /// Feedthrough of unknown inputs.
    F,
}

impl Matrix {
    /// All, in the order of reading.
    pub const ALL: [Self; 6] = [Self::E, Self::A, Self::B, Self::C, Self::D, Self::F];

    /// The letter.
    pub fn letter(self) -> &'static str {
        match self {
            Self::E => "E",
            Self::A => "A",
            Self::B => "B",
            Self::C => "C",
            Self::D => "D",
            Self::F => "F",
        }
    }

    /// What it is, in words.
    pub fn meaning(self) -> &'static str {
        match self {
            Self::E => "derivatives",
            Self::A => "states",
            Self::B => "known inputs",
            Self::C => "outputs",
            Self::D => "unknown inputs",
            Self::F => "unknown inputs in the outputs",
        }
    }
}

/// A Lipschitz term as typed.
#[derive(Clone, Debug, PartialEq)]
pub struct LipschitzData {
    /// Distribution of the nonlinearity.
    pub G: EntryMatrix,
    /// The states that it depends on.
    pub F_L: EntryMatrix,
    /// Its components, expressions in `x1 ... xn` and `t`.
    pub f: Vec<String>,
    /// The Lipschitz constant.
    pub constant: f64,
}

/// A network as typed; the matrices in the order a, b, c, `c_G`, `c_L`.
#[derive(Clone, Debug, PartialEq)]
pub struct NetworkData {
    /// State matrix of a subsystem.
    pub a: EntryMatrix,
    /// Coupling input of a subsystem.
    pub b: EntryMatrix,
    /// Coupling output of a subsystem.
    pub c: EntryMatrix,
    /// Globally measured part of a subsystem.
    pub c_G: EntryMatrix,
    /// Locally measured part of a subsystem.
    pub c_L: EntryMatrix,
    /// Coupling between subsystems.
    pub Gamma: Coupling,
    /// Globally measured combinations.
    pub Psi: Coupling,
    /// Subsystems with local measurements, from one.
    pub local: Vec<usize>,
}

/// A matrix that may be large and sparse.
#[derive(Clone, Debug, PartialEq)]
pub enum Coupling {
    /// Rows of entries.
    Dense(EntryMatrix),
    /// `(row, column, value)`, from one.
    Sparse {
        /// Rows.
        rows: usize,
        /// Columns.
        columns: usize,
        /// Entries that are not zero.
        entries: Vec<(usize, usize, f64)>,
    },
}

impl Coupling {
    /// Rows and columns.
    pub fn shape(&self) -> (usize, usize) {
        match self {
            Self::Dense(matrix) => matrix.shape(),
            Self::Sparse { rows, columns, .. } => (*rows, *columns),
        }
    }

    /// The values.
    pub fn values(&self) -> nalgebra::DMatrix<f64> {
        match self {
            Self::Dense(matrix) => matrix.values(),
            Self::Sparse { rows, columns, entries } => {
                let mut matrix = nalgebra::DMatrix::zeros(*rows, *columns);
                for &(i, j, value) in entries {
                    matrix[(i - 1, j - 1)] = value;
                }
                matrix
            }
        }
    }

    /// The values in the form in which they are given: a list of entries stays one; of two entries at one place the
    /// later counts.
    pub fn coupling(&self) -> CouplingMatrix {
        match self {
            Self::Dense(matrix) => matrix.values().into(),
            Self::Sparse { rows, columns, entries } => {
                let unique: BTreeMap<(usize, usize), f64> =
                    entries.iter().map(|&(i, j, value)| ((i - 1, j - 1), value)).collect();
                CouplingMatrix::Sparse {
                    rows: *rows,
                    columns: *columns,
                    entries: unique.into_iter().map(|((i, j), value)| (i, j, value)).collect(),
                }
            }
        }
    }
}

/// A scenario as typed.
#[derive(Clone, Debug, PartialEq)]
pub struct ScenarioData {
    /// Horizon in seconds or steps.
    pub horizon: f64,
    /// Output samples.
    pub samples: usize,
    /// Initial state, an entry for each state or none; the algebraic part is projected.
    pub x0: Vec<Entry>,
    /// Initial state as one expression, which counts while there are no entries.
    pub x0_formula: Option<InitialFormula>,
    /// Known inputs.
    pub u: Vec<Signal>,
    /// Unknown inputs.
    pub d: Vec<Signal>,
    /// Measurement noise, one signal per output.
    pub noise: Vec<Signal>,
    /// Time-varying uncertainty of `A`.
    pub uncertainty: Option<UncertaintyData>,
    /// What drives the states that the equations leave free.
    pub free: FreeData,
}

/// `v = v0(t) - feedback x`, see [`FreeVariables`].
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FreeData {
    /// The signals `v0`; missing ones are zero.
    pub signals: Vec<Signal>,
    /// State feedback, a row for each free variable and a column for each state.
    pub feedback: Option<EntryMatrix>,
}

impl FreeData {
    /// As typed by a program: plain numbers.
    pub fn of(free: &FreeVariables) -> Self {
        Self { signals: free.signals.clone(), feedback: free.feedback.as_ref().map(EntryMatrix::from_matrix) }
    }

    /// The values.
    pub fn values(&self) -> FreeVariables {
        FreeVariables {
            signals: self.signals.clone(),
            feedback: self.feedback.as_ref().map(EntryMatrix::values),
        }
    }
}

/// `a_ij(t) = a_ij (1 + scale * amplitude_ij * sin(2 pi frequency_ij t))`.
#[derive(Clone, Debug, PartialEq)]
pub struct UncertaintyData {
    /// Relative amplitudes, e x n.
    pub amplitude: EntryMatrix,
    /// Frequencies in Hz, e x n.
    pub frequency: EntryMatrix,
    /// Factor on all amplitudes.
    pub scale: f64,
}

impl DescriptorData {
    /// A matrix as typed.
    pub fn matrix(&self, matrix: Matrix) -> &EntryMatrix {
        &self.matrices[matrix as usize]
    }

    /// A matrix as typed, to change it.
    pub fn matrix_mut(&mut self, matrix: Matrix) -> &mut EntryMatrix {
        &mut self.matrices[matrix as usize]
    }

    /// The checked system.
    ///
    /// # Errors
    /// The first matrix that does not fit.
    pub fn system(&self) -> Result<DescriptorSystem, SystemError> {
        let [E, A, B, C, D, F] = self.matrices.each_ref().map(EntryMatrix::values);
        DescriptorSystem { time: self.time, E, A, B, C, D, F }.checked()
    }
}

impl LipschitzData {
    /// The term; `None` when a component is not understood (reading a document checks that).
    pub fn term(&self, n_states: usize) -> Option<LipschitzTerm> {
        let f = self.f.iter().map(|text| nonlinearity(text, n_states).ok()).collect::<Option<Vec<_>>>()?;
        Some(LipschitzTerm { G: self.G.values(), F_L: self.F_L.values(), f, constant: self.constant })
    }
}

impl NetworkData {
    /// States of all subsystems together, N n.
    pub fn states(&self) -> usize {
        self.a.shape().0 * self.Gamma.shape().0
    }

    /// The checked network.
    ///
    /// # Errors
    /// The first matrix that does not fit.
    pub fn network(&self) -> Result<Network, SystemError> {
        Network {
            a: self.a.values(),
            b: self.b.values(),
            c: self.c.values(),
            Gamma: self.Gamma.coupling(),
            Psi: self.Psi.values(),
            c_G: self.c_G.values(),
            c_L: self.c_L.values(),
            local: self.local.iter().map(|i| i - 1).collect(),
        }
        .checked()
    }
}

/// What a document's design is for.
#[derive(Clone, Debug, PartialEq)]
pub enum Subject {
    /// A plant as one system; a small network is expanded.
    Model(Box<Model>),
    /// A network with more than [`MAX_EXPANDED`] states: only the hierarchical observer, which never expands it, can be
    /// designed.
    Network(Box<Network>),
}

/// A network that is small enough to be written as one system.
fn expandable(data: &NetworkData) -> Result<Network, SystemError> {
    let found = data.states();
    if found > MAX_EXPANDED {
        return Err(SystemError::TooLarge { found, limit: MAX_EXPANDED });
    }
    data.network()
}

impl Document {
    /// The system as one descriptor system.
    ///
    /// # Errors
    /// The first matrix that does not fit.
    pub fn system(&self) -> Result<DescriptorSystem, SystemError> {
        match &self.plant {
            PlantData::Descriptor(data) => data.system(),
            PlantData::Network(data) => Ok(expandable(data)?.expanded()),
        }
    }

    /// What is designed for: the plant as one system, or a network that is too large to be one.
    ///
    /// # Errors
    /// The first matrix that does not fit.
    pub fn subject(&self) -> Result<Subject, SystemError> {
        match &self.plant {
            PlantData::Network(data) if data.states() > MAX_EXPANDED => {
                Ok(Subject::Network(Box::new(data.network()?)))
            }
            _ => Ok(Subject::Model(Box::new(self.model()?))),
        }
    }

    /// The system with its nonlinearity and its partition.
    ///
    /// # Errors
    /// The first matrix that does not fit.
    pub fn model(&self) -> Result<Model, SystemError> {
        let data = match &self.plant {
            PlantData::Network(data) => return Ok(expandable(data)?.into()),
            PlantData::Descriptor(data) => data,
        };
        let system = data.system()?;
        let lipschitz = data.lipschitz.as_ref().and_then(|lipschitz| lipschitz.term(system.n_states()));
        Ok(Model { lipschitz, partition: data.partition.clone(), ..Model::from(system) })
    }

    /// The chosen design and those that are kept beside it, for a comparison.
    pub fn contenders(&self) -> Vec<Contender<'_>> {
        let chosen = Contender { name: CHOSEN, choice: &self.design };
        let kept = self.kept.iter().map(|kept| Contender { name: &kept.name, choice: &kept.design });
        std::iter::once(chosen).chain(kept).collect()
    }

    /// The scenario with missing signals and initial states filled by zeros.
    pub fn scenario(&self, system: &DescriptorSystem) -> Scenario {
        let ScenarioData { horizon, samples, u, d, noise, uncertainty, free, .. } = &self.scenario;
        let x0 = self.scenario.initial_values(system.n_states());
        let uncertainty = uncertainty.as_ref().map(|data| crate::simulation::Uncertainty {
            amplitude: data.amplitude.values(),
            frequency: data.frequency.values(),
            scale: data.scale,
        });
        Scenario {
            horizon: *horizon,
            samples: *samples,
            x0: nalgebra::DVector::from_vec(x0),
            u: u.clone(),
            d: d.clone(),
            noise: noise.clone(),
            uncertainty,
            free: free.values(),
        }
    }
}
