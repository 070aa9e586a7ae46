//! How the design of decentralized observers grows with the number of subsystems.

#![cfg_attr(target_arch = "wasm32", no_main)]
#![cfg(not(target_arch = "wasm32"))]
#![expect(non_snake_case, reason = "matrix letters of the canonical form")]

use descry::numerics::{Tolerance, Watch};
use descry::observer::decentralized::{LocalProblem, design_subsystems, local_problems};
use descry::observer::{DesignChoice, Method, Order};
use descry::platform::native::Threads;
use descry::system::{DescriptorSystem, Model, Subsystem, TimeDomain};
use nalgebra::DMatrix;

fn main() {
    divan::main();
}

/// A ring of subsystems of the kind of paper 000, section V, each driven by the next one.
fn ring(count: usize) -> Vec<LocalProblem> {
    let n = 3 * count;
    let (mut E, mut A, mut C) = (DMatrix::identity(n, n), DMatrix::zeros(n, n), DMatrix::zeros(2 * count, n));
    for part in 0..count {
        let (own, next) = (3 * part, 3 * ((part + 1) % count));
        for (k, (a, d)) in [(-1e-3, 1e-3), (-2e-3, -2e-3), (-3e-3, -3e-3)].into_iter().enumerate() {
            A[(own + k, own + k)] = a;
            A[(own + k, next + k)] += d;
        }
        E[(own + 2, own + 2)] = 0.0;
        C[(2 * part, own)] = 1.0;
        C[(2 * part + 1, own)] = 1.0;
        C[(2 * part + 1, own + 2)] = 1.0;
    }
    let Ok(mut system) = DescriptorSystem::autonomous(E, A, C) else { unreachable!("the shapes fit") };
    system.time = TimeDomain::Discrete;
    let part = |_| Subsystem { name: "part".to_owned(), states: 3, equations: 3, outputs: 2 };
    let model = Model { partition: (0..count).map(part).collect(), ..Model::from(system) };
    let Ok(problems) = local_problems(&model) else { unreachable!("the partition fits") };
    problems
}

fn design(problems: &[LocalProblem], watch: &Watch) -> usize {
    let choice =
        DesignChoice { method: Method::Decentralized, order: Order::Reduced, ..DesignChoice::default() };
    let outcomes = design_subsystems(problems, &choice, &Tolerance::default(), watch);
    outcomes.map_or(0, |outcomes| outcomes.len())
}

#[divan::bench(args = [2, 8, 32])]
fn one_after_the_other(bencher: divan::Bencher<'_, '_>, count: usize) {
    let problems = ring(count);
    bencher.bench(|| design(&problems, &Watch::none()));
}

#[divan::bench(args = [2, 8, 32])]
fn on_all_processors(bencher: divan::Bencher<'_, '_>, count: usize) {
    let problems = ring(count);
    bencher.bench(|| design(&problems, &Watch::none().on(Threads)));
}
