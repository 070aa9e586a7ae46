//! The local observers of all subsystems as one observer of the composite plant.

use nalgebra::DMatrix;

use super::Local;
use super::certificate::observer;
use crate::observer::{LinearObserver, NamedMatrix};

/// One block-diagonal observer: `N = blkdiag N_i`, `L = blkdiag J_i`, `H = [M_1; M_2; ..]`, `P = blkdiag P_i`,
/// `V = blkdiag F_i`, `W = [-Q_1 Phi_1 B_1; ..]`.
///
/// # Shapes
/// In the order of the partition, so that outputs and states are those of the plant.
pub fn composite(locals: &[Local]) -> LinearObserver {
    let parts: Vec<LinearObserver> =
        locals.iter().map(|local| observer(&local.setup, &local.matrices)).collect();
    let diagonal = |of: fn(&LinearObserver) -> &DMatrix<f64>| block_diagonal(parts.iter().map(of));
    let stacked = |of: fn(&LinearObserver) -> &DMatrix<f64>| {
        let columns = parts.first().map_or(0, |part| of(part).ncols());
        let blocks: Vec<&DMatrix<f64>> = parts.iter().map(of).collect();
        if blocks.is_empty() { DMatrix::zeros(0, columns) } else { crate::numerics::stack(&blocks) }
    };
    LinearObserver {
        N: diagonal(|part| &part.N),
        L: diagonal(|part| &part.L),
        H: stacked(|part| &part.H),
        P: diagonal(|part| &part.P),
        V: diagonal(|part| &part.V),
        W: stacked(|part| &part.W),
        Q: diagonal(|part| &part.Q),
        R: diagonal(|part| &part.R),
        S: DMatrix::zeros(0, parts.first().map_or(0, |part| part.S.ncols())),
    }
}

fn block_diagonal<'a>(blocks: impl Iterator<Item = &'a DMatrix<f64>> + Clone) -> DMatrix<f64> {
    let rows = blocks.clone().map(DMatrix::nrows).sum();
    let columns = blocks.clone().map(DMatrix::ncols).sum();
    let mut result = DMatrix::zeros(rows, columns);
    let (mut top, mut left) = (0, 0);
    for block in blocks {
        result.view_mut((top, left), block.shape()).copy_from(block);
        top += block.nrows();
        left += block.ncols();
    }
    result
}

/// The matrices of all subsystems under the paper's names, each with its subsystem: `N (first)`.
pub(super) fn matrices(locals: &[Local]) -> Vec<NamedMatrix> {
    locals.iter().flat_map(of_one).filter(|matrix| !matrix.value.is_empty()).collect()
}

fn of_one(local: &Local) -> Vec<NamedMatrix> {
    let crate::observer::decentralized::LocalMatrices { N, M, J, P, Q, F, T, .. } = &local.matrices;
    let decoupled = &local.setup.decoupled;
    let all: [(&str, &str, &DMatrix<f64>); 11] = [
        ("N", "state matrix of the observer", N),
        ("M", "known input", M),
        ("J", "output into the observer", J),
        ("P", "observer state to estimate", P),
        ("Q", "algebraic equations in the estimate: -Q Phi B u", Q),
        ("F", "output to estimate", F),
        ("T", "what the observer tracks: T E x", T),
        ("Phi", "rows that annihilate E and the decoupled couplings", &decoupled.Phi),
        ("R", "what the observer's state completes", &local.setup.family.R),
        ("X", "Lyapunov matrix of the proof", &local.X),
        ("D1", "couplings that are decoupled exactly", &decoupled.D1),
    ];
    let named = |(name, meaning, value): (&str, &str, &DMatrix<f64>)| NamedMatrix {
        name: format!("{name} ({})", local.result.name),
        meaning: meaning.to_owned(),
        value: value.clone(),
    };
    all.into_iter().map(named).collect()
}

/// What a user should know of the local observers.
pub(super) fn notes(locals: &[Local]) -> Vec<String> {
    locals.iter().filter_map(note).collect()
}

fn note(local: &Local) -> Option<String> {
    let problem = &local.setup.problem;
    let name = &local.result.name;
    let sources: Vec<String> =
        local.setup.decoupled.attenuated.iter().map(|j| problem.source_name(problem.sources[*j])).collect();
    let still = if local.setup.family.order() == 0 { "; order 0, a static estimate" } else { "" };
    if local.setup.is_driven() {
        Some(format!(
            "{name}: {} drive its error, attenuated but not decoupled; it converges when they do{still}",
            sources.join(", ")
        ))
    } else if still.is_empty() {
        None
    } else {
        Some(format!("{name}: order 0, the estimate is static and exact"))
    }
}
