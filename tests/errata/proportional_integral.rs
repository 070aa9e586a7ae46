//! Numbers against paper 004.

use super::{Computation, Proof, compute, designed, document, off, rank_of, tolerance};
use descry::numerics::Complex64;
use descry::numerics::{
    complex_svd, eigenvalues, null_space, observable_quotient, pseudo_inverse, side_by_side, stack,
};
use descry::observer::{Design, DesignChoice, Method, Order};
use descry::system::DescriptorSystem;
use nalgebra::{DMatrix, dmatrix};

const PROOFS: [(&str, Computation); 14] = [
    ("after equation (4)", size_of_y),
    ("equation (5)", proportional_gain),
    ("Theorem 4", left_inverse_is_needed),
    ("Algorithm 1", left_inverse),
    ("before equation (16)", impulse_observable),
    ("equation (19)", estimate),
    ("equations (22), (23) and appendix", columns),
    ("Algorithm 2", coordinates),
    ("section IV, case 1", products),
    ("section IV, bounds of the uncertainty", bounds),
    ("section IV, check of (8)", check_of_8),
    ("section IV, bandwidth", bandwidth),
    ("appendix, proof of (12)", imaginary_axis),
    ("appendix, left factor of (13)", left_factor),
];

#[test]
fn numbers_of_paper_004_are_computed() {
    compute("004", &PROOFS);
}

fn system() -> DescriptorSystem {
    document("proportional-integral").system().unwrap()
}

fn design(order: Order) -> Design {
    let document = document("proportional-integral");
    let choice = DesignChoice { method: Method::ProportionalIntegral, order, ..document.design.clone() };
    designed(&document, &choice)
}

/// The first two rows, which are differential: the matrices of (4).
fn upper(matrix: &DMatrix<f64>) -> DMatrix<f64> {
    matrix.rows(0, 2).into_owned()
}

/// `C = [A1; C*]` of (4), with the algebraic rows of A*.
fn C(system: &DescriptorSystem) -> DMatrix<f64> {
    stack(&[&system.A.rows(2, 2).into_owned(), &system.C])
}

/// `P1`, a basis of the null space of E.
fn P1(system: &DescriptorSystem) -> DMatrix<f64> {
    null_space(&upper(&system.E), 0.0, &tolerance()).unwrap()
}

fn size_of_y(proof: &Proof) {
    let system = system();
    let (e, m, r) = (system.E.nrows(), system.C.nrows(), rank_of(&system.E));
    let q = C(&system).nrows();
    assert_eq!(q, m + e - r, "q = m + e - r");
    proof.counts("3", q);
    proof.counts("6", q + m + e - r);
}

fn proportional_gain(proof: &Proof) {
    let reduced = design(Order::Reduced);
    // e1' = Ar e1 + N ef, ef' = -L3 Cr e1: what is left when L2 multiplies y_hat
    let [Ar, Cr, L3] = ["Ar", "Cr", "Lb3"].map(|name| reduced.matrix(name).unwrap());
    let wrong = stack(&[
        &side_by_side(&[Ar, &dmatrix![1.0; 0.0]]),
        &side_by_side(&[&-(L3 * Cr), &DMatrix::zeros(1, 1)]),
    ]);
    let modes = eigenvalues(&wrong).unwrap();
    let pair = modes.iter().find(|z| z.im > 0.0).unwrap();
    proof.says("-22.1", modes.iter().find(|z| z.im == 0.0).unwrap().re);
    proof.words("10.5 +- 18.8i");
    proof.says("10.5", pair.re);
    assert!((pair.im - 18.8).abs() <= 0.05, "imaginary part {}", pair.im);
}

/// The rank of (12) at a point.
fn rank_12(s: Complex64, E: &DMatrix<f64>, A: &DMatrix<f64>, N: &DMatrix<f64>, C: &DMatrix<f64>) -> usize {
    let (states, inputs) = (E.ncols(), N.ncols());
    let constant = stack(&[
        &side_by_side(&[&-A, &-N]),
        &DMatrix::zeros(inputs, states + inputs),
        &side_by_side(&[C, &DMatrix::zeros(C.nrows(), inputs)]),
    ]);
    let mut slope = DMatrix::zeros(constant.nrows(), constant.ncols());
    slope.view_mut((0, 0), E.shape()).copy_from(E);
    slope.view_mut((E.nrows(), states), (inputs, inputs)).fill_with_identity();
    let pencil = slope.map(Complex64::from) * s + constant.map(Complex64::from);
    complex_svd(&pencil).unwrap().s.iter().filter(|sigma| **sigma > 1e-9).count()
}

/// Points of the closed right half plane, among them the ones that the proof of (12) distinguishes.
fn points() -> impl Iterator<Item = Complex64> {
    let grid = [0.0, 0.5, 1.0, 2.5];
    grid.into_iter().flat_map(move |re| grid.map(|im| Complex64::new(re, im)))
}

fn left_inverse_is_needed(proof: &Proof) {
    let E = dmatrix![1.0, 0.0, 0.0; 0.0, 1.0, 0.0];
    let A = dmatrix![0.0, 0.0, 1.0; 0.0, 0.0, 0.0];
    let (N, C) = (dmatrix![0.0; 1.0], dmatrix![1.0, 0.0, 0.0; 0.0, 1.0, 0.0]);
    for s in points() {
        assert_eq!(rank_12(s, &E, &A, &N, &C), 4, "(12) at {s}");
    }
    let joint = stack(&[&E, &C]);
    proof.counts("2", rank_of(&joint));
    proof.counts("3", joint.ncols());
}

fn left_inverse(proof: &Proof) {
    let full = design(Order::Full);
    proof.size("4 x 5", &side_by_side(&[full.matrix("T1").unwrap(), full.matrix("T2").unwrap()]));
    proof.size("4 x 2", &pseudo_inverse(&upper(&system().E), &tolerance()).unwrap());
}

fn impulse_observable(proof: &Proof) {
    let mut system = system();
    let nine = |system: &DescriptorSystem| {
        let DescriptorSystem { E, A, C, .. } = system;
        let zero = DMatrix::zeros(E.nrows(), E.ncols());
        let below = DMatrix::zeros(C.nrows(), E.ncols());
        rank_of(&stack(&[&side_by_side(&[E, A]), &side_by_side(&[&zero, E]), &side_by_side(&[&below, C])]))
    };
    proof.counts("6", nine(&system));
    system.C = dmatrix![1.0, 0.0, 0.0, 0.0];
    let DescriptorSystem { E, A, D, .. } = &system;
    proof.counts("4", rank_12(Complex64::from(0.0), E, A, D, &system.C));
    proof.counts("2", rank_of(&(C(&system) * P1(&system))));
    proof.counts("5", E.ncols() + D.ncols());
    assert_eq!(nine(&system), 6, "(9) holds as before");
}

fn estimate(proof: &Proof) {
    let (system, reduced) = (system(), design(Order::Reduced));
    let E = upper(&system.E);
    proof.size("4 x 2", &pseudo_inverse(&E, &tolerance()).unwrap());
    let [M1, T2] = ["M1", "T2"].map(|name| reduced.matrix(name).unwrap());
    let left = M1 * &E + T2 * C(&system) - DMatrix::identity(4, 4);
    proof.vanishes(left.amax());
}

fn columns(proof: &Proof) {
    let (system, reduced) = (system(), design(Order::Reduced));
    let (states, inputs) = (system.E.ncols(), system.D.ncols());
    proof.counts("3", rank_of(&system.E) + inputs);
    proof.counts("5", states + inputs);
    proof.size("2 x 2", reduced.matrix("Ar").unwrap());
}

fn coordinates(proof: &Proof) {
    let system = system();
    let C2 = C(&system) * P1(&system);
    let P3 = null_space(&C2.transpose(), 0.0, &tolerance()).unwrap().transpose();
    let P2 = stack(&[&P3, &pseudo_inverse(&C2, &tolerance()).unwrap()]);
    proof.size("3 x 3", &P2);
    proof.size("2 x 4", &upper(&system.A));
    let E_pinv = pseudo_inverse(&upper(&system.E), &tolerance()).unwrap();
    proof.size("4 x 4", &side_by_side(&[&E_pinv, &P1(&system)]));
}

fn products(proof: &Proof) {
    let A = system().A;
    let mut change = DMatrix::zeros(4, 4);
    change[(0, 2)] = 0.09;
    let wrong = &A * (DMatrix::identity(4, 4) + change);
    proof.says("1", wrong[(0, 2)]);
    proof.says("0.09", wrong[(1, 2)]);
    proof.says("-0.09", wrong[(2, 2)]);
    proof.vanishes(A[(1, 2)].abs() + A[(2, 2)].abs());
}

fn bounds(proof: &Proof) {
    let A = system().A;
    let determinant =
        |d34: f64, d43: f64| A[(2, 2)] * A[(3, 3)] - A[(2, 3)] * (1.0 + d34) * A[(3, 2)] * (1.0 + d43);
    for (d34, d43) in [(0.3, -0.7), (-1.0, 2.0), (9.0, 0.1)] {
        let expected = -(1.0 + d34) * (1.0 + d43);
        assert!((determinant(d34, d43) - expected).abs() < 1e-12, "det A22 at {d34}, {d43}");
    }
    proof.words("det A22 = -(1 + delta_34) (1 + delta_43) is 0");
    proof.vanishes(determinant(-1.0, 0.5));
}

fn check_of_8(proof: &Proof) {
    let DescriptorSystem { E, D, C, .. } = system();
    let printed = |C: &DMatrix<f64>| {
        rank_of(&stack(&[&side_by_side(&[&E, &D]), &side_by_side(&[C, &DMatrix::zeros(1, 1)])]))
    };
    for found in [rank_of(&E), rank_of(&side_by_side(&[&E, &D])), printed(&C)] {
        proof.counts("2", found);
    }
    proof.counts("3", printed(&dmatrix![0.0, 0.0, 1.0, 0.0]));
}

fn bandwidth(proof: &Proof) {
    let document = document("proportional-integral");
    let slowed = DesignChoice { order: Order::Reduced, scale: 0.1, ..document.design.clone() };
    let reduced = designed(&document, &slowed);
    let largest = slowed.poles.iter().map(|pole| (pole * 0.1).norm()).fold(0.0, f64::max);
    proof.says("3.3", largest);
    // f_hat / f = 1 - s [0 I] (s I - Aobs)^-1 [0; I]
    let [Ar, Cr, Lb2, Lb3] = ["Ar", "Cr", "Lb2", "Lb3"].map(|name| reduced.matrix(name).unwrap());
    let Aobs = stack(&[
        &side_by_side(&[&(Ar - Lb2 * Cr), &dmatrix![1.0; 0.0]]),
        &side_by_side(&[&-(Lb3 * Cr), &DMatrix::zeros(1, 1)]),
    ]);
    let response = |w: f64| {
        let s = Complex64::new(0.0, w);
        let pencil = DMatrix::<Complex64>::identity(3, 3) * s - Aobs.map(Complex64::from);
        (Complex64::from(1.0) - s * pencil.try_inverse().unwrap()[(2, 2)]).norm()
    };
    let (mut inside, mut outside) = (0.0, 3.3);
    for _ in 0..60 {
        let middle = 0.5 * (inside + outside);
        if response(middle) > 0.5_f64.sqrt() {
            inside = middle;
        } else {
            outside = middle;
        }
    }
    proof.says("1.09", inside);
    proof.says("0.108", response(4.0));
    proof.says("0.164", response(3.3));
}

fn imaginary_axis(proof: &Proof) {
    let A = dmatrix![0.0, 1.0, 0.0; -1.0, 0.0, 0.0; 0.0, 0.0, -1.0];
    let (N, C) = (dmatrix![0.0; 0.0; 1.0], dmatrix![0.0, 0.0, 1.0]);
    let rank = |s| rank_12(s, &DMatrix::identity(3, 3), &A, &N, &C);
    for s in points().filter(|s| s.re > 0.0 || s.norm() == 0.0) {
        proof.counts("4", rank(s));
    }
    proof.counts("3", rank(Complex64::i()));
}

fn left_factor(proof: &Proof) {
    let (E, A) = (dmatrix![1.0, 0.0; 0.0, 0.0], dmatrix![1.0, 0.0; 1.0, 1.0]);
    let (N, C) = (dmatrix![0.0; 1.0], dmatrix![0.0, 1.0]);
    for s in points() {
        assert_eq!(rank_12(s, &E, &A, &N, &C), 3, "(10) at {s}");
    }
    assert_eq!(rank_of(&stack(&[&E, &C])), 2, "the third alternative of (8), which gives (9)");
    let T1 = pseudo_inverse(&stack(&[&E, &C]), &tolerance()).unwrap().columns(0, 2).into_owned();
    let joint = stack(&[&side_by_side(&[&(&T1 * A), &(&T1 * N)]), &DMatrix::zeros(1, 3)]);
    let quotient =
        observable_quotient(&joint, &side_by_side(&[&C, &DMatrix::zeros(1, 1)]), &tolerance()).unwrap();
    let mut modes: Vec<f64> = quotient.fixed_modes.iter().map(|mode| mode.re).collect();
    modes.sort_by(f64::total_cmp);
    assert_eq!(modes.len(), 2, "{modes:?}");
    proof.vanishes(modes[0]);
    proof.says("1", modes[1]);
    assert!(off(&(&T1 * &T1), &T1) < 1e-15 && rank_of(&T1) == 1, "T1 has not full column rank");
}
