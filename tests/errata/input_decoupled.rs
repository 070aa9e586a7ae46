//! Numbers against paper 001.

use super::{Computation, Proof, compute, designed, document, matrix, off, tolerance};
use descry::numerics::pseudo_inverse;
use descry::observer::Design;
use descry::observer::input_decoupled::{Coordinates, coordinates, paper_reduction};
use descry::paper::{ErratumKind, printed};
use nalgebra::{DMatrix, dmatrix};
use serde_json::Value;

const PROOFS: [(&str, Computation); 5] = [
    ("(4)", definitions),
    ("Theorem 2", coordinates_of_theorem_2),
    ("section III, W2+", pseudo_inverse_of_w2),
    ("section III, L", gain),
    ("section III, d_hat", unknown_input),
];

#[test]
fn numbers_of_paper_001_are_computed() {
    compute("001", &PROOFS);
}

fn reference(key: &str) -> DMatrix<f64> {
    let reference: Value = serde_json::from_str(include_str!("../reference/ex001.json")).unwrap();
    matrix(&reference["printed"][key])
}

fn design() -> Design {
    let document = document("input-decoupled");
    designed(&document, &document.design)
}

fn at() -> Coordinates {
    coordinates(&document("input-decoupled").system().unwrap(), &tolerance()).unwrap()
}

/// The P behind the printed W2+.
fn P() -> DMatrix<f64> {
    dmatrix![1.0, 0.0, 1.0; 0.0, 2.0, 1.0; 0.0, -1.0, -1.0]
}

fn definitions(proof: &Proof) {
    let at = at();
    // [A_bar21 A_bar22 D_bar1] = [A2 D1] P, [C_bar21 C_bar22 F_bar] = [C2 F] P
    let (differential, measured) = (at.differential() * P(), at.measured() * P());
    let (A_bar21, W1) = (differential.columns(0, 1), differential.columns(1, 2));
    let (C_bar21, W2) = (measured.columns(0, 1), measured.columns(1, 2).into_owned());
    let A_bar1 = &at.A1 - A_bar21 * &at.A3;
    let (B_bar1, C_bar1) = (&at.B1 - A_bar21 * &at.B2, &at.C1 - C_bar21 * &at.A3);
    let B_bar2 = -(C_bar21 * &at.B2);
    let W2_pinv = pseudo_inverse(&W2, &tolerance()).unwrap();
    let W1W2 = W1 * &W2_pinv;
    let free = DMatrix::identity(3, 3) - &W2 * &W2_pinv;
    for (name, found) in [
        ("At", &A_bar1 - &W1W2 * &C_bar1),
        ("Bt", B_bar1 - &W1W2 * B_bar2),
        ("Ct", &free * C_bar1),
        ("W1W2p", W1W2.clone()),
    ] {
        proof.below("1e-14", off(&found, &reference(name)));
    }
    // with the orthonormal basis of the program
    let ours = paper_reduction(&at, &tolerance()).unwrap();
    assert!(off(&ours.Y, &W1W2) < 1e-14, "W1 W2+ does not depend on P");
}

fn coordinates_of_theorem_2(proof: &Proof) {
    let design = design();
    for name in ["K", "T1", "T2"] {
        proof.below("1e-14", off(design.matrix(name).unwrap(), &reference(name)));
    }
    assert_eq!(design.matrix("N").unwrap(), &DMatrix::identity(4, 4), "N = I");
}

fn pseudo_inverse_of_w2(proof: &Proof) {
    proof.says("-1", P().determinant());
    proof.words("P = [1 0 1; 0 2 1; 0 -1 -1]");
    proof.words("[A4 D2] P = [1 0 0]");
    assert!(off(&(at().algebraic() * P()), &dmatrix![1.0, 0.0, 0.0]) == 0.0, "[A4 D2] P = [1 0 0]");
    let W2 = (at().measured() * P()).columns(1, 2).into_owned();
    proof.below("1e-14", off(&pseudo_inverse(&W2, &tolerance()).unwrap(), &reference("W2p")));
}

fn gain(proof: &Proof) {
    let design = design();
    let (ours, theirs) = (design.matrix("L").unwrap(), reference("L"));
    let z = dmatrix![1.0; -1.0; 1.0];
    let free = &z * z.transpose() / 3.0;
    proof.counts("1", super::rank_of(&free));
    for L in [ours, &theirs] {
        let acts = L * &z / 3.0;
        assert!(off(&acts, &dmatrix![-5.0 / 3.0; 4.0 / 3.0]) < 1e-13, "L [1; -1; 1] / 3 = {acts}");
        let H = design.matrix("A_tilde").unwrap() - L * design.matrix("C_tilde").unwrap();
        assert!(off(&H, &dmatrix![-1.0, 3.0; 0.0, -2.0]) < 1e-13, "the same H: {H}");
    }
    let found = printed("001", "L", ours).unwrap();
    assert_eq!(found.kind, ErratumKind::NotUnique, "shown beside ours");
    assert!(!found.is_wrong(0, 0), "ours differs, and both are right");
    assert!(off(ours, &(&theirs * free)) < 1e-13, "ours is the share of the printed one that acts");
    proof.words("[-5/3 5/3 -5/3; 4/3 -4/3 4/3]");
}

fn unknown_input(proof: &Proof) {
    let (design, at) = (design(), at());
    let x2 = design.matrix("K").unwrap().rows(2, 2).into_owned();
    let row = |G: &DMatrix<f64>| &at.A3 + &at.A4 * &x2 + &at.D2 * G;
    assert!(row(design.matrix("G").unwrap()).amax() < 1e-14, "ours: [0 0]");
    let wrong = row(&reference("G"));
    assert!(off(&wrong, &dmatrix![0.0, 16.0 / 3.0]) < 1e-14, "printed: {wrong}");
    proof.noted("16/3");
    proof.words("[0 0] with -4/3");
    proof.words("[0 16/3] with +4/3");
    assert!(printed("001", "G", design.matrix("G").unwrap()).is_some(), "shown beside ours");
}
