//! What one matrix inequality costs, from its assembly to the point: stability and the bounded real lemma.

#![cfg_attr(target_arch = "wasm32", no_main)]
#![cfg(not(target_arch = "wasm32"))]

use descry::lmi::{Expr, Problem, Settings, feasible, minimise};
use descry::numerics::Random;
use nalgebra::DMatrix;

fn main() {
    divan::main();
}

fn random_matrix(random: &mut Random, rows: usize, columns: usize) -> DMatrix<f64> {
    DMatrix::from_fn(rows, columns, |_, _| random.normal())
}

/// Random and stable: the shift exceeds the norm.
fn stable(random: &mut Random, n: usize) -> DMatrix<f64> {
    let a = random_matrix(random, n, n);
    let shift = 0.5 * a.norm() + 1.0;
    a - DMatrix::identity(n, n) * shift
}

/// `-(A'P + PA) > 0`, `P > 0`.
#[divan::bench(args = [4, 8])]
fn lyapunov(bencher: divan::Bencher<'_, '_>, n: usize) {
    let a = stable(&mut Random::new(1), n);
    let settings = Settings::default();
    bencher.bench(|| {
        let mut problem = Problem::new();
        let p = problem.symmetric("P", n);
        problem.strict("Lyapunov", "bench", -(&p * &a).he());
        problem.strict("P > 0", "bench", p);
        feasible(&problem, &settings)
    });
}

/// The least `g` with `[A'X + XA + C'C, XB; B'X, -g I] < 0`, one per cent back from it.
#[divan::bench(args = [4, 8])]
fn bounded_real(bencher: divan::Bencher<'_, '_>, n: usize) {
    let mut random = Random::new(2);
    let a = stable(&mut random, n);
    let (b, c) = (random_matrix(&mut random, n, 2), random_matrix(&mut random, 2, n));
    let settings = Settings::default();
    bencher.bench(|| {
        let mut problem = Problem::new();
        let x = problem.symmetric("X", n);
        let g = problem.scalar("gamma^2");
        let lemma = Expr::symmetric(vec![
            vec![(&x * &a).he() + Expr::constant(&c.tr_mul(&c)), &x * &b],
            vec![-g.times(&DMatrix::identity(2, 2))],
        ]);
        problem.strict("bounded real lemma", "bench", -lemma);
        problem.strict("X > 0", "bench", x);
        minimise(&problem, &g, &settings)
    });
}
