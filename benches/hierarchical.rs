//! The hierarchical observer of growing networks (paper 003): everybody on a ring listens to a few hubs.

#![cfg_attr(target_arch = "wasm32", no_main)]
#![cfg(not(target_arch = "wasm32"))]

use descry::numerics::{Complex64, Tolerance};
use descry::observer::DesignChoice;
use descry::observer::hierarchical::{Hierarchy, conditions, design, verify_network};
use descry::simulation::{Span, simulate_network};
use descry::system::{CouplingMatrix, Network};
use nalgebra::{DMatrix, dmatrix};

/// Rank of the coupling.
const HUBS: usize = 3;
const SIZES: [usize; 5] = [125, 250, 500, 1000, 2000];

fn main() {
    divan::main();
}

/// The paper's subsystem of order five, `size` times; `Gamma` has two entries in each row and rank three.
fn network(size: usize) -> Network {
    let hub = |k: usize| (k % HUBS) * (size / HUBS);
    let entries = (0..size).flat_map(|i| {
        let arc = i * HUBS / size;
        let position = (i * HUBS) as f64 / size as f64 - arc as f64;
        [(i, hub(arc), -1.0 - position), (i, hub(arc + 1), 0.5 + position)]
    });
    let mut psi = DMatrix::zeros(2, size);
    for k in 0..HUBS {
        psi[(0, hub(k))] = 1.0;
        psi[(1, hub(k))] = (k + 1) as f64;
    }
    Network {
        a: dmatrix![
            -3.8, 1.0, 1.0, 1.0, 1.0; 0.0, -1.8, 2.0, 0.0, 0.0; 0.0, 0.0, -1.8, 2.0, 0.0;
            0.0, 0.0, 0.0, -1.8, 2.0; 0.0, 2.0, 0.0, 0.0, -1.8
        ],
        b: dmatrix![0.0; 0.0; 0.0; 0.0; 1.0],
        c: dmatrix![1.0, 0.0, 0.0, 0.0, 0.0],
        Gamma: CouplingMatrix::Sparse { rows: size, columns: size, entries: entries.collect() },
        Psi: psi,
        c_G: dmatrix![1.0, 0.0, 0.0, 0.0, 0.0],
        c_L: dmatrix![1.0, 0.0, 0.0, 0.0, 0.0; 0.0, 1.0, 0.0, 0.0, 0.0],
        local: (0..size).collect(),
    }
}

/// The same with all entries of `Gamma` written out.
fn dense(size: usize) -> Network {
    let network = network(size);
    Network { Gamma: network.Gamma.dense().into(), ..network }
}

fn poles(slowest: f64, count: u32) -> Vec<Complex64> {
    (0..count).map(|k| Complex64::from(slowest - 0.5 * f64::from(k))).collect()
}

fn choice() -> DesignChoice {
    DesignChoice { poles: poles(-2.0, 6), local_poles: poles(-4.0, 5), ..DesignChoice::default() }
}

#[divan::bench(args = SIZES)]
fn representation_sparse(bencher: divan::Bencher<'_, '_>, size: usize) {
    let network = network(size);
    bencher.bench(|| Hierarchy::of(&network, &Tolerance::default()));
}

#[divan::bench(args = SIZES)]
fn representation_dense(bencher: divan::Bencher<'_, '_>, size: usize) {
    let network = dense(size);
    bencher.bench(|| Hierarchy::of(&network, &Tolerance::default()));
}

#[divan::bench(args = SIZES)]
fn ask_conditions(bencher: divan::Bencher<'_, '_>, size: usize) {
    let network = network(size);
    bencher.bench(|| conditions(&network, &Tolerance::default()));
}

/// With a local observer on every subsystem.
#[divan::bench(args = SIZES)]
fn design_and_verify(bencher: divan::Bencher<'_, '_>, size: usize) {
    let network = network(size);
    bencher.bench(|| design(&network, &choice(), &[], &Tolerance::default()));
}

#[divan::bench(args = SIZES)]
fn verify_alone(bencher: divan::Bencher<'_, '_>, size: usize) {
    let network = network(size);
    let Ok(made) = design(&network, &choice(), &[], &Tolerance::default()) else { return };
    bencher.bench(|| verify_network(&network, &made.observer, &Tolerance::default()));
}

/// 401 instants, all subsystems recorded.
#[divan::bench(args = SIZES)]
fn simulate(bencher: divan::Bencher<'_, '_>, size: usize) {
    let network = network(size);
    let Ok(made) = design(&network, &choice(), &[], &Tolerance::default()) else { return };
    let x0: Vec<f64> = (1..=5 * size).map(|k| 5.0 * (k as f64).sin()).collect();
    let shown: Vec<usize> = (0..size).collect();
    let span = Span { horizon: 8.0, samples: 401 };
    bencher.bench(|| simulate_network(&network, &made.observer, &x0, span, &shown));
}
