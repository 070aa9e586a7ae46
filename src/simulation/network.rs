//! A network and its hierarchical observer in time, without expanding the network.
#![expect(non_snake_case, reason = "matrix letters follow paper 003")]

use nalgebra::{DMatrix, DVector};
use serde::{Deserialize, Serialize};

use super::{LARGEST_STATE, MOST_STATES, SimulationError, Span};
use crate::numerics::Block::{Of, Zero};
use crate::numerics::block_matrix;
use crate::numerics::integrate::exponential;
use crate::observer::hierarchical::{HierarchicalObserver, Hierarchy};
use crate::system::Network;

/// The whole of a network, its estimate, and chosen subsystems; every matrix has a column for each instant.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct NetworkTrajectory {
    /// Instants in seconds.
    pub t: Vec<f64>,
    /// `z = sigma_z x`, nu mu rows.
    pub z: DMatrix<f64>,
    /// Its estimate by the global observer.
    pub z_hat: DMatrix<f64>,
    /// The chosen subsystems, in the order in which they were asked for.
    pub subsystems: Vec<SubsystemTrajectory>,
    /// Why the trajectory ends early, if it does.
    pub note: Option<String>,
}

/// One subsystem beside its estimate.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SubsystemTrajectory {
    /// Its number, from zero.
    pub subsystem: usize,
    /// Whether `x_hat` comes from a local observer; else it is this subsystem's part of `sigma_z^+ z_hat`, the smallest
    /// state that shows `z_hat`.
    pub local: bool,
    /// Its state, n rows.
    pub x: DMatrix<f64>,
    /// The estimate, n rows.
    pub x_hat: DMatrix<f64>,
}

/// Simulates a network with its observer, which starts from zero.
///
/// Every step is exact, for any number of subsystems: with `Z = X N`, one column for each direction of the coupling,
///
/// ```text
/// Z'     = a Z + b c Z Gamma_nu',         y_G = vec(c_G Z (Psi N)')
/// x_i(t + h) = exp(a h) x_i(t) + W (Gamma N)_i',     W' = a W + b c Z,   W(t) = 0
/// x_hat_i(t + h) = E22 x_hat_i(t) + E21 x_i(t) + V (Gamma N)_i',
///                                         V' = (a - h_i c_L) V + b c_z Z_hat + h_i c_L W,   V(t) = 0
/// [E11 0; E21 E22] = exp([a 0; h_i c_L, a - h_i c_L] h)
/// ```
///
/// so that one matrix exponential of order `(2 + g) n nu + nu mu`, g different local gains, serves all subsystems.
///
/// # Shapes
/// `x0`: N n, the subsystems' states below each other; `shown`: subsystems from zero.
///
/// # Errors
/// Sizes that do not fit, an observer of another network, too many states (`MOST_STATES` for the exponential), or
/// samples. An unstable network is no error: the trajectory ends before a value exceeds [`LARGEST_STATE`].
///
/// # Source
/// Paper 003, equations (1)-(3), (8), (12).
pub fn simulate_network(
    network: &Network,
    observer: &HierarchicalObserver,
    x0: &[f64],
    span: Span,
    shown: &[usize],
) -> Result<NetworkTrajectory, SimulationError> {
    let grid = span.grid(false)?;
    let (n, size) = (network.a.nrows(), network.n_subsystems());
    check(network, observer, x0, shown)?;
    let h = grid.get(1).copied().unwrap_or(0.0);
    let stepper = Stepper::new(network, observer, h)?;
    let hierarchy = &observer.hierarchy;
    let X0 = DMatrix::from_column_slice(n, size, x0);
    let mut Z = &X0 * &hierarchy.N;
    let mut z_hat = DVector::zeros(hierarchy.order());
    let mut parts: Vec<Part> = shown.iter().map(|&i| Part::new(observer, i, &X0)).collect();
    let mut record = Record { parts: vec![PartRecord::default(); shown.len()], ..Record::default() };
    for &instant in &grid {
        if !record.push(instant, hierarchy, (&Z, &z_hat), &parts) {
            break;
        }
        let step = stepper.step(&Z, &z_hat);
        for part in &mut parts {
            part.advance(&stepper, &step, hierarchy);
        }
        (Z, z_hat) = (step.Z, step.z_hat);
    }
    Ok(record.finish((hierarchy.order(), n), &parts))
}

/// What has been seen so far, one vector for each instant.
#[derive(Default)]
struct Record {
    t: Vec<f64>,
    z: Vec<DVector<f64>>,
    z_hat: Vec<DVector<f64>>,
    parts: Vec<PartRecord>,
    note: Option<String>,
}

/// The same of one subsystem.
#[derive(Clone, Default)]
struct PartRecord {
    x: Vec<DVector<f64>>,
    x_hat: Vec<DVector<f64>>,
}

impl Record {
    /// Adds an instant; `false` when a state has grown too large to go on.
    fn push(
        &mut self,
        instant: f64,
        hierarchy: &Hierarchy,
        (Z, z_hat): (&DMatrix<f64>, &DVector<f64>),
        parts: &[Part],
    ) -> bool {
        let z = DVector::from_column_slice(hierarchy.M.tr_mul(Z).as_slice());
        let values = parts.iter().flat_map(|part| part.x.iter().chain(part.x_hat.iter()));
        if z.iter().chain(z_hat).chain(values).any(|x| x.is_nan() || x.abs() > LARGEST_STATE) {
            self.note =
                Some(format!("the trajectory ends at t = {instant:.6}: a state exceeds {LARGEST_STATE:e}"));
            return false;
        }
        let estimate = hierarchy.state_of(z_hat);
        for (part, record) in parts.iter().zip(&mut self.parts) {
            record.x.push(part.x.clone());
            let smallest = || estimate.column(part.subsystem).into_owned();
            record.x_hat.push(if part.gain.is_some() { part.x_hat.clone() } else { smallest() });
        }
        self.t.push(instant);
        self.z.push(z);
        self.z_hat.push(z_hat.clone());
        true
    }

    fn finish(self, (order, n): (usize, usize), parts: &[Part]) -> NetworkTrajectory {
        let matrix = |rows: usize, columns: &[DVector<f64>]| {
            if columns.is_empty() { DMatrix::zeros(rows, 0) } else { DMatrix::from_columns(columns) }
        };
        let subsystems = parts.iter().zip(&self.parts).map(|(part, record)| SubsystemTrajectory {
            subsystem: part.subsystem,
            local: part.gain.is_some(),
            x: matrix(n, &record.x),
            x_hat: matrix(n, &record.x_hat),
        });
        NetworkTrajectory {
            z: matrix(order, &self.z),
            z_hat: matrix(order, &self.z_hat),
            subsystems: subsystems.collect(),
            t: self.t,
            note: self.note,
        }
    }
}

fn check(
    network: &Network,
    observer: &HierarchicalObserver,
    x0: &[f64],
    shown: &[usize],
) -> Result<(), SimulationError> {
    let network = network.clone().checked()?;
    let (n, size) = (network.a.nrows(), network.n_subsystems());
    let shape = |what: &str, found, needed, reason| {
        Err(SimulationError::Shape { what: what.to_owned(), found, needed, reason })
    };
    if x0.len() != n * size {
        return shape("the initial state x0", (x0.len(), 1), (n * size, 1), "it has an entry for each state");
    }
    if x0.iter().any(|x| !x.is_finite()) {
        return Err(SimulationError::NotFinite { what: "the initial state x0".to_owned() });
    }
    let found = (observer.hierarchy.M.nrows(), observer.hierarchy.N.nrows());
    if found != (n, size) {
        return shape(
            "the observer's state of all subsystems",
            found,
            (n, size),
            "it belongs to another network",
        );
    }
    let outputs = network.Psi.nrows() * network.c_G.nrows();
    let (found, needed) = (observer.global.H.shape(), (observer.hierarchy.order(), outputs));
    if found != needed {
        return shape("the observer's gain H", found, needed, "it has a column for each global output");
    }
    if let Some(last) = shown.iter().max().filter(|last| **last >= size) {
        return shape(
            "the list of subsystems",
            (last + 1, 1),
            (size, 1),
            "a subsystem to be shown is one of the N",
        );
    }
    Ok(())
}

/// A chosen subsystem on its way.
struct Part {
    subsystem: usize,
    /// Number of its gain among the different ones; `None` without a local observer.
    gain: Option<usize>,
    x: DVector<f64>,
    x_hat: DVector<f64>,
}

impl Part {
    fn new(observer: &HierarchicalObserver, subsystem: usize, X0: &DMatrix<f64>) -> Self {
        let gain = observer.distinct_locals().iter().position(|(_, users)| users.contains(&subsystem));
        let x = X0.column(subsystem).into_owned();
        Self { subsystem, gain, x_hat: DVector::zeros(x.len()), x }
    }

    fn advance(&mut self, stepper: &Stepper, step: &Step, hierarchy: &Hierarchy) {
        let listens = hierarchy.Gamma_N.row(self.subsystem).transpose();
        if let Some(local) = self.gain.and_then(|gain| stepper.locals.get(gain).zip(step.V.get(gain))) {
            let (Local { from_x, from_x_hat }, V) = local;
            self.x_hat = from_x_hat * &self.x_hat + from_x * &self.x + V * &listens;
        }
        self.x = &stepper.free * &self.x + &step.W * &listens;
    }
}

/// What one step makes of the whole, and what it adds to every subsystem.
struct Step {
    Z: DMatrix<f64>,
    z_hat: DVector<f64>,
    W: DMatrix<f64>,
    V: Vec<DMatrix<f64>>,
}

/// `[E21, E22]` of one local gain.
struct Local {
    from_x: DMatrix<f64>,
    from_x_hat: DMatrix<f64>,
}

/// Exact steps of one length.
struct Stepper {
    /// Maps `[vec Z; z_hat]` to `[vec Z; z_hat; vec W; vec V ...]` one step later.
    whole: DMatrix<f64>,
    /// `exp(a h)`.
    free: DMatrix<f64>,
    locals: Vec<Local>,
    shape: (usize, usize),
}

impl Stepper {
    fn new(network: &Network, observer: &HierarchicalObserver, h: f64) -> Result<Self, SimulationError> {
        let Network { a, b, c, c_G, c_L, .. } = network;
        let HierarchicalObserver { hierarchy, global, .. } = observer;
        let (n, nu) = (a.nrows(), hierarchy.N.ncols());
        let gains = observer.distinct_locals();
        let (block, own) = (n * nu, hierarchy.order());
        let order = (2 + gains.len()) * block + own;
        if order > MOST_STATES {
            return Err(SimulationError::TooLarge { found: order, most: MOST_STATES });
        }
        let unit = DMatrix::<f64>::identity(nu, nu);
        let bc = b * c;
        let mut m = DMatrix::zeros(order, order);
        let (w, drive) = (block + own, unit.kronecker(&bc));
        // Z' = a Z + b c Z Gamma_nu'
        let of_Z = unit.kronecker(a) + hierarchy.Gamma_nu.kronecker(&bc);
        m.view_mut((0, 0), (block, block)).copy_from(&of_Z);
        // z_hat' = (alpha_z - H gamma_z) z_hat + H vec(c_G Z (Psi N)')
        let H = &global.H;
        m.view_mut((block, 0), (own, block)).copy_from(&(H * hierarchy.Psi_N.kronecker(c_G)));
        let closed = hierarchy.alpha_z() - H * hierarchy.gamma_z();
        m.view_mut((block, block), (own, own)).copy_from(&closed);
        // W' = a W + b c Z
        m.view_mut((w, 0), (block, block)).copy_from(&drive);
        m.view_mut((w, w), (block, block)).copy_from(&unit.kronecker(a));
        let mut locals = Vec::with_capacity(gains.len());
        for (k, (local, _)) in gains.iter().enumerate() {
            let (v, injection) = (w + (k + 1) * block, &local.h * c_L);
            let closed = a - &injection;
            // V' = (a - h c_L) V + b c_z Z_hat + h c_L W
            m.view_mut((v, block), (block, own)).copy_from(&unit.kronecker(&hierarchy.bc_z));
            m.view_mut((v, w), (block, block)).copy_from(&unit.kronecker(&injection));
            m.view_mut((v, v), (block, block)).copy_from(&unit.kronecker(&closed));
            let pair = block_matrix(&[&[Of(a), Zero], &[Of(&injection), Of(&closed)]]);
            let pair = exponential(&(pair * h))?;
            let part = |column| pair.view((n, column), (n, n)).into_owned();
            locals.push(Local { from_x: part(0), from_x_hat: part(n) });
        }
        Ok(Self {
            whole: exponential(&(m * h))?.columns(0, w).into_owned(),
            free: exponential(&(a * h))?,
            locals,
            shape: (n, nu),
        })
    }

    fn step(&self, Z: &DMatrix<f64>, z_hat: &DVector<f64>) -> Step {
        let state = DVector::from_iterator(Z.len() + z_hat.len(), Z.iter().chain(z_hat).copied());
        let next = &self.whole * state;
        let (n, nu) = self.shape;
        let part = |at: usize| DMatrix::from_column_slice(n, nu, &next.as_slice()[at..at + n * nu]);
        let w = n * nu + z_hat.len();
        Step {
            Z: part(0),
            z_hat: next.rows(n * nu, z_hat.len()).into_owned(),
            W: part(w),
            V: (1..=self.locals.len()).map(|k| part(w + k * n * nu)).collect(),
        }
    }
}
