//! Tests of the parameterisation on random subsystems.

use super::super::{Decoupled, LocalProblem, Parameterisation, chosen, extended};
use super::LocalMatrices;
use crate::numerics::{Random, Tolerance};
use crate::observer::Order;
use crate::system::TimeDomain;
use nalgebra::DMatrix;

/// A random subsystem with `rank E < n`, two outputs and three couplings.
fn problem(random: &mut Random) -> LocalProblem {
    let mut fill = |rows, columns| DMatrix::from_fn(rows, columns, |_, _| random.normal());
    let (left, right) = (fill(4, 4), fill(4, 4));
    let mut middle = DMatrix::identity(4, 4);
    middle[(3, 3)] = 0.0;
    LocalProblem {
        name: "random".to_owned(),
        time: TimeDomain::Continuous,
        E: left * middle * right,
        A: fill(4, 4),
        B: fill(4, 1),
        H: fill(2, 4),
        D: fill(4, 3),
        sources: vec![4, 5, 6],
        states_of_plant: 7,
        first_state: 0,
    }
}

/// Largest residual of the four equations of Proposition 1, relative to the gains.
fn residual(problem: &LocalProblem, decoupled: &Decoupled, found: &LocalMatrices) -> f64 {
    let LocalProblem { E, A, B, H, .. } = problem;
    let LocalMatrices { N, M, J, P, Q, F, T, .. } = found;
    let size = 1.0 + N.norm() * T.norm() + J.norm() + (P.norm() + Q.norm() + F.norm()) * (1.0 + T.norm());
    let track = T * E;
    let unit = DMatrix::identity(A.ncols(), A.ncols());
    [
        N * &track - T * A + J * H,
        T * &decoupled.D1,
        M - T * B,
        P * &track + Q * &decoupled.Phi * A + F * H - unit,
    ]
    .iter()
    .map(|m| m.norm() / size)
    .fold(0.0, f64::max)
}

/// Every member of both families is an unbiased observer that decouples `D1`.
#[test]
fn every_member_satisfies_proposition_1() {
    let mut random = Random::new(3);
    let tolerance = Tolerance::default();
    for _ in 0..20 {
        let problem = problem(&mut random);
        let decoupled = Decoupled::new(&problem, &[1], &tolerance).unwrap();
        for order in [Order::Full, Order::Reduced, Order::Minimal] {
            let rows = chosen(&decoupled, order, &tolerance).unwrap();
            for family in [
                Parameterisation::paper(&decoupled, &rows, &tolerance).unwrap(),
                extended(&decoupled, &rows, &tolerance).unwrap(),
            ] {
                let mut fill = |rows, columns| DMatrix::from_fn(rows, columns, |_, _| random.normal());
                let y = fill(rows.nrows(), family.L_N.nrows());
                let z = fill(4, family.M_P.nrows());
                let found = family.recover(&decoupled, &y, &z);
                let worst = residual(&problem, &decoupled, &found);
                assert!(worst < 1e-11, "{order:?}: residual {worst:.2e}");
                // the affine functions that the inequality is built from give the same matrices
                let close = |a: &DMatrix<f64>, b: &DMatrix<f64>| (a - b).norm() <= 1e-11 * (1.0 + b.norm());
                assert!(close(&(&family.Lambda_N - &y * &family.L_N), &found.N), "{order:?}: N");
                assert!(close(&(&family.Lambda_P - &z * &family.M_P), &found.P), "{order:?}: P");
                let psi = &family.Lambda_Psi - &y * &family.L_Psi;
                let t_d2 = &family.Lambda_T - &y * &family.L_T - psi * &decoupled.Phi_D2;
                assert!(close(&t_d2, &(&found.T * &decoupled.D2)), "{order:?}: T D2");
                let q_d2 = (&family.Lambda_Q - &z * &family.M_Q) * &decoupled.Phi_D2;
                assert!(close(&q_d2, &(&found.Q * &decoupled.Phi_D2)), "{order:?}: Q Phi D2");
            }
        }
    }
}

/// Scaling `Phi` is no freedom of ours: its rows are orthonormal.
#[test]
fn phi_is_orthonormal_and_annihilates() {
    let mut random = Random::new(5);
    let problem = problem(&mut random);
    let decoupled = Decoupled::new(&problem, &[], &Tolerance::default()).unwrap();
    let gram = &decoupled.Phi * decoupled.Phi.transpose();
    assert!((gram - DMatrix::identity(1, 1)).norm() < 1e-14, "{}", decoupled.Phi);
    assert!((&decoupled.Phi * &problem.E).norm() < 1e-13, "Phi E = 0");
    assert_eq!(decoupled.Pi, DMatrix::identity(4, 4), "nothing is decoupled");
}
