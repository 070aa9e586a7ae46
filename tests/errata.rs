//! The errata of the papers, each with the computation behind the number that proves it.
#![cfg(not(target_arch = "wasm32"))]
#![expect(clippy::unwrap_used, clippy::panic, reason = "helpers of tests fail by panicking")]
#![expect(non_snake_case, reason = "matrix letters of the papers")]

use descry::document::{Document, read_document};
use descry::numerics::{
    Complex64, Tolerance, Watch, eigenvalues, observable_quotient, pseudo_inverse, rank, side_by_side,
    spectral_distance, stack,
};
use descry::observer::hierarchical::{Hierarchy, conditions as network_conditions};
use descry::observer::input_decoupled::{coordinates, paper_reduction};
use descry::observer::{Condition, Design, DesignChoice, Evidence, Method, Order, Verdict, assess};
use descry::paper::{Erratum, ErratumKind, errata, example, printed};
use descry::system::Network;
use descry::system::properties::finite_eigenvalues;
use nalgebra::{DMatrix, DVector, dmatrix};
use serde_json::Value;

fn tolerance() -> Tolerance {
    Tolerance::default()
}

fn erratum(paper: &str, place: &str) -> &'static Erratum {
    errata(paper)
        .find(|e| e.place == place)
        .unwrap_or_else(|| panic!("no erratum at {place} of paper {paper}"))
}

/// That the proof (or the correction) has this number, and that the computed one rounds to it.
fn says(erratum: &Erratum, number: &str, computed: f64) {
    let Erratum { place, correct, proof, .. } = erratum;
    assert!(proof.contains(number) || correct.contains(number), "{place}: {number} is not said: {proof}");
    let value: f64 = number.parse().unwrap();
    let digits = number.split('.').nth(1).map_or(0, str::len);
    let half = 0.5 * 10.0_f64.powi(-i32::try_from(digits).unwrap()) + 1e-12;
    assert!((computed - value).abs() <= half, "{place}: {number} is said, {computed} computed");
}

/// That the proof has these words.
fn words(erratum: &Erratum, text: &str) {
    assert!(erratum.proof.contains(text) || erratum.correct.contains(text), "{}: {text}", erratum.place);
}

fn matrix(value: &Value) -> DMatrix<f64> {
    let rows: Vec<Vec<f64>> = serde_json::from_value(value.clone()).unwrap();
    DMatrix::from_row_iterator(rows.len(), rows[0].len(), rows.into_iter().flatten())
}

fn off(found: &DMatrix<f64>, expected: &DMatrix<f64>) -> f64 {
    assert_eq!(found.shape(), expected.shape(), "shapes of {found} and {expected}");
    (found - expected).amax()
}

fn document(key: &str) -> Document {
    read_document(example(key).unwrap().text).unwrap()
}

fn designed(document: &Document, choice: &DesignChoice) -> Design {
    let model = document.model().unwrap();
    assess(&model, choice, &document.tolerance, &Watch::none()).unwrap().outcome.unwrap()
}

// ---- Paper 001 -----------------------------------------------------------------------------------------------------

fn reference_001() -> Value {
    serde_json::from_str(include_str!("reference/ex001.json")).unwrap()
}

fn design_001() -> Design {
    let document = document("input-decoupled");
    designed(&document, &document.design)
}

#[test]
fn definitions_that_paper_001_omits_give_its_printed_matrices() {
    let (reference, document) = (reference_001(), document("input-decoupled"));
    let printed = |key: &str| matrix(&reference["printed"][key]);
    let system = document.system().unwrap();
    let at = coordinates(&system, &tolerance()).unwrap();
    // [A_bar21 A_bar22 D_bar1] = [A2 D1] P, [C_bar21 C_bar22 F_bar] = [C2 F] P with the P behind the printed W2+
    let P = dmatrix![1.0, 0.0, 1.0; 0.0, 2.0, 1.0; 0.0, -1.0, -1.0];
    let (differential, measured) = (at.differential() * &P, at.measured() * &P);
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
        let off = off(&found, &printed(name));
        assert!(off < 1e-14, "{name}: the printed matrix, off by {off:.1e}");
    }
    words(erratum("001", "(4)"), "to 1e-14");

    let misprint = erratum("001", "section III, W2+");
    says(misprint, "-1", P.determinant());
    words(misprint, "P = [1 0 1; 0 2 1; 0 -1 -1]");
    words(misprint, "[A4 D2] P = [1 0 0]");
    assert!(off(&(at.algebraic() * &P), &dmatrix![1.0, 0.0, 0.0]) == 0.0, "[A4 D2] P = [1 0 0]");
    assert!(off(&W2_pinv, &printed("W2p")) < 1e-14, "the printed W2+");
    // with the orthonormal basis of the program
    let ours = paper_reduction(&at, &tolerance()).unwrap();
    assert!(off(&ours.Y, &W1W2) < 1e-14, "W1 W2+ does not depend on P");

    let design = design_001();
    for name in ["K", "T1", "T2"] {
        let off = off(design.matrix(name).unwrap(), &printed(name));
        assert!(off < 1e-14, "{name} with M = I and N = I: off by {off:.1e}");
    }
    assert_eq!(design.matrix("N").unwrap(), &DMatrix::identity(4, 4), "N = I");
    words(erratum("001", "Theorem 2"), "to 1e-14");
}

#[test]
fn the_printed_l_of_paper_001_is_one_of_many() {
    let design = design_001();
    let (ours, theirs) = (design.matrix("L").unwrap(), matrix(&reference_001()["printed"]["L"]));
    let z = dmatrix![1.0; -1.0; 1.0];
    let free = &z * z.transpose() / 3.0;
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
    words(erratum("001", "section III, L"), "[-5/3 5/3 -5/3; 4/3 -4/3 4/3]");
}

#[test]
fn the_sign_in_g_of_paper_001_is_wrong() {
    let (design, document) = (design_001(), document("input-decoupled"));
    let at = coordinates(&document.system().unwrap(), &tolerance()).unwrap();
    let x2 = design.matrix("K").unwrap().rows(2, 2).into_owned();
    let row = |G: &DMatrix<f64>| &at.A3 + &at.A4 * &x2 + &at.D2 * G;
    assert!(row(design.matrix("G").unwrap()).amax() < 1e-14, "ours: [0 0]");
    let wrong = row(&matrix(&reference_001()["printed"]["G"]));
    assert!(off(&wrong, &dmatrix![0.0, 16.0 / 3.0]) < 1e-14, "printed: {wrong}");
    let misprint = erratum("001", "section III, d_hat");
    words(misprint, "[0 0] with -4/3");
    words(misprint, "[0 16/3] with +4/3");
    assert!(printed("001", "G", design.matrix("G").unwrap()).is_some(), "shown beside ours");
}

// ---- Paper 003 -----------------------------------------------------------------------------------------------------

fn network() -> Network {
    let reference: Value = serde_json::from_str(include_str!("reference/ex003.json")).unwrap();
    let of = |key: &str| matrix(&reference["inputs"][key]);
    Network {
        a: of("aI"),
        b: of("bI"),
        c: of("cI"),
        Gamma: of("Gam").into(),
        Psi: of("Psi"),
        c_G: of("cG"),
        c_L: of("cL"),
        local: vec![3],
    }
    .checked()
    .unwrap()
}

fn largest_outside_the_diagonal(m: &DMatrix<f64>) -> f64 {
    let outside = |(k, value): (usize, &f64)| if k / m.nrows() == k % m.nrows() { 0.0 } else { value.abs() };
    m.iter().enumerate().map(outside).fold(0.0, f64::max)
}

#[test]
fn bases_and_coupling_of_paper_003_are_misprinted() {
    let reference: Value = serde_json::from_str(include_str!("reference/ex003.json")).unwrap();
    let found = Hierarchy::of(&network(), &tolerance()).unwrap();
    let mut N = matrix(&reference["printed"]["N"]);
    let misprint = erratum("003", "section III, N");
    says(misprint, "0.58", largest_outside_the_diagonal(&N.tr_mul(&N)));
    N[(1, 1)] = -0.41;
    assert!(largest_outside_the_diagonal(&N.tr_mul(&N)) < 1e-15, "nothing is left");

    let column = |fives: usize| (0.25 * f64::from(u8::try_from(fives).unwrap())).sqrt();
    says(erratum("003", "section III, M"), "1.118", column(5));
    assert_eq!((column(4), found.M.shape()), (1.0, (5, 2)), "four entries of 0.5");

    let misprint = erratum("003", "section III, Gamma_nu");
    says(misprint, "0.82496", found.Gamma_nu[(2, 1)]);
    says(misprint, "0.82", found.Gamma_nu[(2, 1)]);
    for (name, value) in [("N", &found.N), ("M", &found.M), ("Gamma_nu", &found.Gamma_nu)] {
        assert!(printed("003", name, value).is_some(), "{name} is shown beside ours");
    }
}

#[test]
fn shapes_in_paper_003_do_not_fit() {
    let (network, found) = (network(), Hierarchy::of(&network(), &tolerance()).unwrap());
    assert_eq!(found.sigma_z().shape(), (6, 20), "N' kron M'");
    words(erratum("003", "(12)"), "is 6 x 20");
    let e = dmatrix![0.0; 0.0; 0.0; 1.0];
    let stacked = stack(&[&network.Psi.kronecker(&network.c_G), &e.transpose().kronecker(&network.c_L)]);
    let misprint = erratum("003", "(14) and (15)");
    says(misprint, "20", stacked.ncols() as f64);
    says(misprint, "40", 2.0 * network.expanded().A.nrows() as f64);
    // L = diag(N kron M, e_I kron I)
    let first = found.N.kronecker(&found.M);
    let second = e.kronecker(&DMatrix::<f64>::identity(5, 5));
    let shape = (first.nrows() + second.nrows(), first.ncols() + second.ncols());
    assert_eq!(shape, (40, 11), "L");
    words(erratum("003", "Theorem 1, last line of the proof"), "L is 40 x 11, and X has 11 entries");
}

fn condition<'a>(conditions: &'a [Condition], id: &str) -> &'a Condition {
    conditions.iter().find(|c| c.id == id).unwrap()
}

#[test]
fn two_equal_modes_are_enough_against_theorem_2_of_paper_003() {
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
    let found = network_conditions(&network, &tolerance()).unwrap();
    for id in ["003-T2-i", "003-T2-ii"] {
        assert!(condition(&found, id).verdict.holds(), "{id}: {}", condition(&found, id).summary);
    }
    assert_eq!(condition(&found, "003-P1-global").verdict, Verdict::Fails, "not even detectable");
    let Evidence::Points { points, .. } = &condition(&found, "003-T2-iii").evidence[0] else {
        panic!("points")
    };
    assert_eq!(points.iter().map(|p| p.multiplicity).max(), Some(2), "|Theta_pi| is never larger than 2");
    let shared = points.iter().find(|p| p.loses_rank).unwrap();
    assert_eq!(shared.multiplicity, 2, "|Theta_pi| = 2 where observability is lost");
    says(erratum("003", "Theorem 2 (iii)"), "0.5", shared.s.re);
}

#[test]
fn a_common_root_is_more_than_equal_polynomials_in_paper_003() {
    let Hierarchy { a_z, b_z, c_z, .. } = Hierarchy::of(&network(), &tolerance()).unwrap();
    let modes = eigenvalues(&(&a_z + &b_z * &c_z)).unwrap();
    let misprint = erratum("003", "Corollary 1, proof");
    for number in ["0.4361", "-4.0361"] {
        let wished: f64 = number.parse().unwrap();
        let pi = modes.iter().min_by(|a, b| (*a - wished).norm().total_cmp(&(*b - wished).norm())).unwrap();
        says(misprint, number, pi.re);
        // d = det(pi I - a_z), n = d c_z (pi I - a_z)^-1 b_z
        let pencil = DMatrix::<f64>::identity(2, 2) * pi.re - &a_z;
        let d = pencil.determinant();
        let n = d * (&c_z * pencil.try_inverse().unwrap() * &b_z)[(0, 0)];
        assert!((d - n).abs() < 1e-12 && (n - 1.0).abs() < 1e-12, "d = {d}, n = {n} at {pi}");
    }
    words(misprint, "where n = 1");
}

#[test]
fn the_fourth_subsystem_of_paper_003_is_observable_from_the_outputs_together() {
    let system = network().expanded();
    let quotient = observable_quotient(&system.A, &system.C, &tolerance()).unwrap();
    let misprint = erratum("003", "section III, rank of the observability matrix");
    says(misprint, "20", system.A.nrows() as f64);
    says(misprint, "11", quotient.basis.ncols() as f64);
    says(misprint, "9", quotient.fixed_modes.len() as f64);
    for state in 15..20 {
        let unit = DVector::from_fn(20, |i, _| if i == state { 1.0 } else { 0.0 });
        let left = &unit - &quotient.basis * quotient.basis.tr_mul(&unit);
        assert!(left.norm() < 1e-9, "component {} of x_4 is observable: {:.1e}", state - 14, left.norm());
    }
    let pair = [Complex64::new(-1.8, 2.0), Complex64::new(-1.8, -2.0)];
    let wished: Vec<Complex64> = (0..3).flat_map(|_| [Complex64::from(-3.8), pair[0], pair[1]]).collect();
    let off = spectral_distance(&quotient.fixed_modes, &wished);
    assert!(off < 1e-3, "-3.8 and -1.8 +- 2i, three times each: off by {off:.1e}");
}

// ---- Paper 000 -----------------------------------------------------------------------------------------------------

#[test]
fn numbers_against_paper_000_are_those_of_its_own_data() {
    let document = read_document(include_str!("documents/000-partition.json")).unwrap();
    let system = document.system().unwrap();
    let growing =
        finite_eigenvalues(&system, &tolerance()).unwrap().values.iter().map(|z| z.re).fold(-1.0, f64::max);
    let misprint = erratum("000", "section V, figures");
    words(misprint, "+2.97e-4");
    assert!((growing - 2.97e-4).abs() < 0.005e-4, "eigenvalue {growing}");
    says(misprint, "500", 1.0 / system.A[(1, 1)].abs());
    // row 1 of [P Q F] [T E; Phi A; H] = I with the printed F_1 = [2/3 1/3; ...]
    let (F12, entry) = (1.0 / 3.0, system.A[(2, 2)]);
    says(erratum("000", "section V, Q_1 Phi_1 B_1"), "111.1", -F12 / entry);
    // fixed modes: the second states, which no output shows
    let misprint = erratum("000", "Proposition 1");
    says(misprint, "-0.002", system.A[(1, 1)]);
    says(misprint, "-0.0004", system.A[(4, 4)]);
    // Y_1 = N_1 (row 2 of Z_1)
    let (Y, Z): ([f64; 4], [f64; 4]) = ([0.44, 0.0008, 0.13, -0.13], [-222.04, -0.40, -67.98, 67.98]);
    for (y, z) in Y.into_iter().zip(Z) {
        assert!((-0.002 * z - y).abs() < 0.0061, "{y} from {z}");
    }
    says(erratum("000", "section V, last entry of Y_1"), "-0.27", -0.002 * 135.97);
    // orders
    let below =
        stack(&[&system.A.view((2, 0), (1, 3)).into_owned(), &system.C.view((0, 0), (2, 3)).into_owned()]);
    let misprint = erratum("000", "section IV, orders");
    let found = rank(&below, 0.0, &tolerance()).unwrap().rank;
    words(misprint, &format!("rank [Phi A; H] = {found} leaves {}", 3 - found));
    let blocks = below.rows(1, 2).into_owned();
    assert_eq!(
        rank(&blocks, 0.0, &tolerance()).unwrap().rank,
        2,
        "rank H = m: the reduced order is as printed"
    );
}

// ---- Paper 002 -----------------------------------------------------------------------------------------------------

#[test]
fn numbers_against_paper_002_are_those_of_the_reference() {
    // tests/paper_002.rs computes both
    let reference: Value = serde_json::from_str(include_str!("reference/ex002.json")).unwrap();
    let number = |key: &str| reference["printed"][key].as_f64().unwrap();
    let misprint = erratum("002", "section 4");
    says(misprint, "17.62", number("min_certified_gamma2_of_printed_observer"));
    says(misprint, "4.198", number("frozen_slope_hinf_at_plus1"));
    says(misprint, "3.124", 9.762_f64.sqrt());
    // Omega with T~: its pseudo-inverse has the printed P = (1/17) [0 -6; 17 0; 0 12]
    let Omega = dmatrix![0.0, 1.0, 0.0; 0.0, 0.0, 2.0 / 3.0; 1.0, 0.0, 1.0; 1.0, 0.0, 0.0];
    let P = pseudo_inverse(&Omega, &tolerance()).unwrap().columns(0, 2).into_owned();
    assert!(off(&(P * 17.0), &dmatrix![0.0, -6.0; 17.0, 0.0; 0.0, 12.0]) < 1e-13, "P");
    words(erratum("002", "definition of Omega"), "(1/17) [0 -6; 17 0; 0 12]");
}

// ---- Paper 004 -----------------------------------------------------------------------------------------------------

#[test]
fn numbers_against_paper_004_are_computed_from_its_example() {
    let document = document("proportional-integral");
    let system = document.system().unwrap();
    let choice = DesignChoice { order: Order::Reduced, ..document.design.clone() };
    let reduced = designed(&document, &choice);
    // e1' = Ar e1 + N ef, ef' = -L3 Cr e1: what is left when L2 multiplies y_hat
    let [Ar, Cr, L3] = ["Ar", "Cr", "Lb3"].map(|name| reduced.matrix(name).unwrap());
    let wrong = stack(&[
        &side_by_side(&[Ar, &dmatrix![1.0; 0.0]]),
        &side_by_side(&[&-(L3 * Cr), &DMatrix::zeros(1, 1)]),
    ]);
    let modes = eigenvalues(&wrong).unwrap();
    let misprint = erratum("004", "equation (5)");
    let real = modes.iter().find(|z| z.im == 0.0).unwrap();
    let pair = modes.iter().find(|z| z.im > 0.0).unwrap();
    says(misprint, "-22.1", real.re);
    words(misprint, "10.5 +- 18.8i");
    says(misprint, "10.5", pair.re);
    assert!((pair.im - 18.8).abs() <= 0.05, "imaginary part {}", pair.im);
    // [T1 T2] of the full order
    let full = designed(
        &document,
        &DesignChoice { method: Method::ProportionalIntegral, order: Order::Full, ..choice },
    );
    let width = full.matrix("T1").unwrap().ncols() + full.matrix("T2").unwrap().ncols();
    words(erratum("004", "Algorithm 1"), &format!("[T1 T2] is 4 x {width}, and E^+ is 4 x 2"));
    // A22 on the last two rows and columns
    let determinant = |d34: f64, d43: f64| {
        let A = &system.A;
        A[(2, 2)] * A[(3, 3)] - A[(2, 3)] * (1.0 + d34) * A[(3, 2)] * (1.0 + d43)
    };
    for (d34, d43) in [(0.3, -0.7), (-1.0, 2.0), (9.0, 0.1)] {
        let expected = -(1.0 + d34) * (1.0 + d43);
        assert!((determinant(d34, d43) - expected).abs() < 1e-12, "det A22 at {d34}, {d43}");
    }
    words(
        erratum("004", "section IV, bounds of the uncertainty"),
        "det A22 = -(1 + delta_34) (1 + delta_43) is 0",
    );
}
