//! What was simulated, by quantity: a plant as one system, or chosen subsystems of a network that is never expanded.
#![expect(non_snake_case, reason = "matrix letters follow paper 003")]

use nalgebra::DMatrix;

use super::compute::samples;
use super::recipe::Quantity;
use crate::observer::Design;
use crate::observer::hierarchical::HierarchicalObserver;
use crate::simulation::{NetworkTrajectory, SubsystemTrajectory, Trajectory, rms};
use crate::system::Network;

/// A trajectory of a plant beside one observer, with what the observer estimates of it.
///
/// Of a network, states and outputs are numbered as in [`Network::expanded`], whether it is expanded or not.
#[derive(Clone, Debug)]
pub struct Motion {
    t: Vec<f64>,
    /// Remarks of the simulation.
    notes: Vec<String>,
    /// The states whose estimate tends to the truth, ascending.
    estimated: Vec<usize>,
    /// State of a network as a whole, a row for each of its `nu mu` components; no rows for other plants and designs.
    z: DMatrix<f64>,
    /// Its estimate.
    z_hat: DMatrix<f64>,
    /// Components that belong to one direction of the coupling.
    mu: usize,
    source: Source,
}

#[derive(Clone, Debug)]
enum Source {
    System(Box<Trajectory>),
    Network(Box<Parts>),
}

/// The simulated part of a network.
#[derive(Clone, Debug)]
struct Parts {
    subsystems: Vec<SubsystemTrajectory>,
    /// States of each subsystem.
    n: usize,
    /// Global outputs, a row for each.
    y_global: DMatrix<f64>,
    c_L: DMatrix<f64>,
    /// Subsystems with local outputs, in the order of the outputs.
    local: Vec<usize>,
}

impl Motion {
    /// The motion of a plant as one system beside the first observer of the trajectory, which runs `design`.
    pub fn of_system(trajectory: Trajectory, design: &Design) -> Self {
        let whole = design.hierarchical.as_deref().and_then(|observer| whole(&trajectory, observer));
        let (z, z_hat) = whole.unwrap_or_else(|| (DMatrix::zeros(0, 0), DMatrix::zeros(0, 0)));
        Self {
            t: trajectory.t.clone(),
            notes: trajectory.note.iter().chain(&trajectory.remarks).cloned().collect(),
            estimated: design.estimated_states(trajectory.x.nrows()),
            z,
            z_hat,
            mu: design.hierarchical.as_deref().map_or(0, |observer| observer.hierarchy.M.ncols()),
            source: Source::System(Box::new(trajectory)),
        }
    }

    /// The motion of chosen subsystems of a network and of the whole.
    pub fn of_network(
        trajectory: NetworkTrajectory,
        network: &Network,
        observer: &HierarchicalObserver,
    ) -> Self {
        let parts = Parts {
            subsystems: trajectory.subsystems,
            n: network.a.nrows(),
            y_global: observer.hierarchy.gamma_z() * &trajectory.z,
            c_L: network.c_L.clone(),
            local: network.local.clone(),
        };
        Self {
            t: trajectory.t,
            notes: trajectory.note.into_iter().collect(),
            estimated: observer.estimated_states(),
            z: trajectory.z,
            z_hat: trajectory.z_hat,
            mu: observer.hierarchy.M.ncols(),
            source: Source::Network(Box::new(parts)),
        }
    }

    /// Instants.
    pub fn t(&self) -> &[f64] {
        &self.t
    }

    /// Remarks of the simulation.
    pub fn notes(&self) -> &[String] {
        &self.notes
    }

    /// The states that the observer estimates, from zero, in ascending order.
    pub fn estimated(&self) -> &[usize] {
        &self.estimated
    }

    /// Number of components of the whole of a network; zero for other plants and designs.
    pub fn order_of_whole(&self) -> usize {
        self.z.nrows()
    }

    /// How many components of the whole belong to each direction of the coupling.
    pub fn block_of_whole(&self) -> usize {
        self.mu
    }

    /// Points of a component over time; empty when it was not simulated, or is not estimated.
    pub fn samples(&self, quantity: Quantity, index: usize) -> Vec<[f64; 2]> {
        if matches!(quantity, Quantity::Estimate | Quantity::Error)
            && self.estimated.binary_search(&index).is_err()
        {
            return Vec::new();
        }
        let row = match (quantity, &self.source) {
            (Quantity::Whole, _) => row_of(&self.z, index),
            (Quantity::WholeEstimate, _) => row_of(&self.z_hat, index),
            (Quantity::WholeError, _) => difference(&self.z, &self.z_hat, index),
            (_, Source::System(trajectory)) => return samples(trajectory, 0, quantity, index),
            (_, Source::Network(parts)) => parts.row(quantity, index),
        };
        self.t.iter().zip(row).map(|(t, value)| [*t, value]).collect()
    }

    /// Root mean square of a component over the instants `t >= from_t`; `None` when it was not simulated, or is not
    /// estimated.
    pub fn rms(&self, quantity: Quantity, index: usize, from_t: f64) -> Option<f64> {
        let values: Vec<f64> = self.samples(quantity, index).into_iter().map(|[_, value]| value).collect();
        let row = DMatrix::from_row_slice(1, values.len(), &values);
        if values.is_empty() { None } else { rms(&self.t, &row, from_t).first().copied() }
    }
}

/// `z = sigma_z x` and its estimate, which are the first states of the composite observer.
fn whole(trajectory: &Trajectory, observer: &HierarchicalObserver) -> Option<(DMatrix<f64>, DMatrix<f64>)> {
    let hierarchy = &observer.hierarchy;
    let (n, size, order) = (hierarchy.M.nrows(), hierarchy.N.nrows(), hierarchy.order());
    let own = trajectory.observers.first()?;
    if own.z.nrows() < order || trajectory.x.nrows() != n * size {
        return None;
    }
    let mut z = DMatrix::zeros(order, trajectory.x.ncols());
    for (mut to, x) in z.column_iter_mut().zip(trajectory.x.column_iter()) {
        let X = DMatrix::from_iterator(n, size, x.iter().copied());
        to.copy_from(&hierarchy.z(&X));
    }
    Some((z, own.z.rows(0, order).into_owned()))
}

impl Parts {
    /// The values of a component; none when it was not simulated.
    fn row(&self, quantity: Quantity, index: usize) -> Vec<f64> {
        let (subsystem, state) = (index / self.n, index % self.n);
        let part = || self.subsystems.iter().find(|part| part.subsystem == subsystem);
        match quantity {
            Quantity::State => part().map(|part| row_of(&part.x, state)),
            Quantity::Estimate => part().map(|part| row_of(&part.x_hat, state)),
            Quantity::Error => part().map(|part| difference(&part.x, &part.x_hat, state)),
            Quantity::Output => self.output(index),
            Quantity::UnknownInput
            | Quantity::UnknownInputEstimate
            | Quantity::UnknownInputError
            | Quantity::Input
            | Quantity::Whole
            | Quantity::WholeEstimate
            | Quantity::WholeError => None,
        }
        .unwrap_or_default()
    }

    /// `y = [y_G; c_L x_i for i in local]`.
    fn output(&self, index: usize) -> Option<Vec<f64>> {
        let Some(local) = index.checked_sub(self.y_global.nrows()) else {
            return Some(row_of(&self.y_global, index));
        };
        let subsystem = *self.local.get(local.checked_div(self.c_L.nrows())?)?;
        let part = self.subsystems.iter().find(|part| part.subsystem == subsystem)?;
        let y = self.c_L.row(local % self.c_L.nrows()) * &part.x;
        Some(y.iter().copied().collect())
    }
}

fn row_of(matrix: &DMatrix<f64>, index: usize) -> Vec<f64> {
    if index < matrix.nrows() { matrix.row(index).iter().copied().collect() } else { Vec::new() }
}

fn difference(truth: &DMatrix<f64>, estimate: &DMatrix<f64>, index: usize) -> Vec<f64> {
    row_of(truth, index).into_iter().zip(row_of(estimate, index)).map(|(x, y)| x - y).collect()
}
