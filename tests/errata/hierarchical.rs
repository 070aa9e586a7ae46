//! Numbers against paper 003.

use super::{Computation, Proof, compute, document, matrix, rank_of, tolerance};
use descry::document::PlantData;
use descry::numerics::{Complex64, eigenvalues, observable_quotient, spectral_distance, stack};
use descry::observer::hierarchical::{Hierarchy, conditions};
use descry::observer::{Condition, Evidence, Verdict};
use descry::paper::printed;
use descry::system::Network;
use nalgebra::{DMatrix, DVector, dmatrix};
use serde_json::Value;

const PROOFS: [(&str, Computation); 12] = [
    ("Proposition 1", local_error),
    ("(12)", projection),
    ("(14) and (15)", outputs),
    ("Theorem 1, last line of the proof", initial_state),
    ("Theorem 2 (iii)", two_equal_modes),
    ("Theorem 2, proof of (a)", observable_by_13),
    ("Corollary 1, proof", common_root),
    ("section III, N", basis_of_the_coupling),
    ("section III, M", basis_of_a_subsystem),
    ("section III, Gamma_nu", coupling),
    ("section III, rank of the observability matrix", fourth_subsystem),
    ("Fig. 6, caption", caption),
];

#[test]
fn numbers_of_paper_003_are_computed() {
    compute("003", &PROOFS);
}

fn network() -> Network {
    let PlantData::Network(data) = document("hierarchical").plant else { panic!("the example is a network") };
    data.network().unwrap()
}

fn hierarchy() -> Hierarchy {
    Hierarchy::of(&network(), &tolerance()).unwrap()
}

fn reference(key: &str) -> DMatrix<f64> {
    let reference: Value = serde_json::from_str(include_str!("../reference/ex003.json")).unwrap();
    matrix(&reference["printed"][key])
}

fn largest_outside_the_diagonal(m: &DMatrix<f64>) -> f64 {
    let outside = |(k, value): (usize, &f64)| if k / m.nrows() == k % m.nrows() { 0.0 } else { value.abs() };
    m.iter().enumerate().map(outside).fold(0.0, f64::max)
}

fn local_error(proof: &Proof) {
    let network = network();
    let design = super::designed(&document("hierarchical"), &document("hierarchical").design);
    proof.size("5 x 5", &(design.matrix("h_4").unwrap() * &network.c_L));
    assert_eq!(network.a.shape(), (5, 5), "a_I");
    proof.size("6 x 6", &hierarchy().alpha_z());
}

fn projection(proof: &Proof) {
    proof.size("6 x 20", &hierarchy().sigma_z());
    proof.counts("20", network().expanded().A.nrows());
}

/// `e_I` of the example, where I = {4}.
fn e() -> DMatrix<f64> {
    dmatrix![0.0; 0.0; 0.0; 1.0]
}

fn outputs(proof: &Proof) {
    let network = network();
    let stacked = stack(&[&network.Psi.kronecker(&network.c_G), &e().transpose().kronecker(&network.c_L)]);
    proof.counts("20", stacked.ncols());
    proof.counts("40", 2 * network.expanded().A.nrows());
}

fn initial_state(proof: &Proof) {
    let found = hierarchy();
    // L = diag(N kron M, e_I kron I)
    let first = found.N.kronecker(&found.M);
    let second = e().kronecker(&DMatrix::<f64>::identity(5, 5));
    proof.size("40 x 11", &DMatrix::zeros(first.nrows() + second.nrows(), first.ncols() + second.ncols()));
    proof.counts("11", found.alpha_z().nrows() + network().a.nrows());
}

fn condition<'a>(conditions: &'a [Condition], id: &str) -> &'a Condition {
    conditions.iter().find(|c| c.id == id).unwrap()
}

fn two_equal_modes(proof: &Proof) {
    let network = Network {
        a: dmatrix![-1.0, 0.0; 0.0, 0.5],
        b: dmatrix![1.0; 0.0],
        c: dmatrix![1.0, 1.0],
        Gamma: dmatrix![1.0, 0.0; 0.0, 2.0].into(),
        Psi: dmatrix![1.0, 1.0],
        c_G: dmatrix![1.0, 1.0],
        c_L: DMatrix::identity(2, 2),
        local: vec![0],
    };
    let found = conditions(&network, &tolerance()).unwrap();
    for id in ["003-T2-i", "003-T2-ii"] {
        assert!(condition(&found, id).verdict.holds(), "{id}: {}", condition(&found, id).summary);
    }
    assert_eq!(condition(&found, "003-P1-global").verdict, Verdict::Fails, "not even detectable");
    let Evidence::Points { points, .. } = &condition(&found, "003-T2-iii").evidence[0] else {
        panic!("points")
    };
    let largest = points.iter().map(|p| p.multiplicity).max().unwrap();
    proof.counts("2", largest);
    let shared = points.iter().find(|p| p.loses_rank).unwrap();
    assert_eq!(shared.multiplicity, 2, "|Theta_pi| = 2 where observability is lost");
    proof.says("0.5", shared.s.re);
}

/// `[C; C A; ...; C A^(n-1)]`.
fn observability(A: &DMatrix<f64>, C: &DMatrix<f64>) -> DMatrix<f64> {
    let mut blocks = vec![C.clone()];
    while blocks.len() < A.nrows() {
        blocks.push(blocks[blocks.len() - 1].clone() * A);
    }
    stack(&blocks.iter().collect::<Vec<_>>())
}

fn observable_by_13(proof: &Proof) {
    let Network { a, b, c, .. } = network();
    let (coupled, shown) = (observability(&a, &(&b * &c)), observability(&a, &c));
    let Hierarchy { a_z, c_z, .. } = hierarchy();
    for matrix in [&coupled, &shown, &stack(&[&coupled, &shown]), &observability(&a_z, &c_z)] {
        proof.counts("2", rank_of(matrix));
    }
}

fn common_root(proof: &Proof) {
    let Hierarchy { a_z, b_z, c_z, .. } = hierarchy();
    let modes = eigenvalues(&(&a_z + &b_z * &c_z)).unwrap();
    for number in ["0.4361", "-4.0361"] {
        let wished: f64 = number.parse().unwrap();
        let pi = modes.iter().min_by(|a, b| (*a - wished).norm().total_cmp(&(*b - wished).norm())).unwrap();
        proof.says(number, pi.re);
        // d = det(pi I - a_z), n = d c_z (pi I - a_z)^-1 b_z
        let pencil = DMatrix::<f64>::identity(2, 2) * pi.re - &a_z;
        let d = pencil.determinant();
        let n = d * (&c_z * pencil.try_inverse().unwrap() * &b_z)[(0, 0)];
        assert!((d - n).abs() < 1e-12 && (n - 1.0).abs() < 1e-12, "d = {d}, n = {n} at {pi}");
    }
    proof.words("where n = 1");
}

fn basis_of_the_coupling(proof: &Proof) {
    let mut N = reference("N");
    proof.says("0.58", largest_outside_the_diagonal(&N.tr_mul(&N)));
    N[(1, 1)] = -0.41;
    assert!(largest_outside_the_diagonal(&N.tr_mul(&N)) < 1e-15, "nothing is left");
    assert!(printed("003", "N", &hierarchy().N).is_some(), "shown beside ours");
}

fn basis_of_a_subsystem(proof: &Proof) {
    let column = |fives: u8| (0.25 * f64::from(fives)).sqrt();
    proof.says("1.118", column(5));
    proof.says("1", column(4));
    assert_eq!(hierarchy().M.shape(), (5, 2), "four entries of 0.5");
    assert!(printed("003", "M", &hierarchy().M).is_some(), "shown beside ours");
}

fn coupling(proof: &Proof) {
    let Gamma_nu = hierarchy().Gamma_nu;
    proof.says("0.82496", Gamma_nu[(2, 1)]);
    proof.says("0.82", Gamma_nu[(2, 1)]);
    assert!(printed("003", "Gamma_nu", &Gamma_nu).is_some(), "shown beside ours");
}

fn fourth_subsystem(proof: &Proof) {
    let system = network().expanded();
    let quotient = observable_quotient(&system.A, &system.C, &tolerance()).unwrap();
    proof.counts("20", system.A.nrows());
    proof.counts("11", quotient.basis.ncols());
    proof.counts("9", quotient.fixed_modes.len());
    for state in 15..20 {
        let unit = DVector::from_fn(20, |i, _| if i == state { 1.0 } else { 0.0 });
        let left = &unit - &quotient.basis * quotient.basis.tr_mul(&unit);
        assert!(left.norm() < 1e-9, "component {} of x_4 is observable: {:.1e}", state - 14, left.norm());
    }
    let pair = [Complex64::new(-1.8, 2.0), Complex64::new(-1.8, -2.0)];
    let wished: Vec<Complex64> = (0..3).flat_map(|_| [Complex64::from(-3.8), pair[0], pair[1]]).collect();
    let off = spectral_distance(&quotient.fixed_modes, &wished);
    assert!(off < 1e-3, "-3.8 and -1.8 +- 2i, three times each: off by {off:.1e}");
    proof.words("-3.8 three times and -1.8 +- 2i three times");
}

fn caption(proof: &Proof) {
    proof.counts("5", network().a.nrows());
    proof.words(&format!("R^{}", network().expanded().A.nrows()));
}
