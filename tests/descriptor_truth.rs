//! The properties of fifteen systems from the literature against exact (symbolic) reference values.
#![expect(
    clippy::unwrap_used,
    clippy::panic,
    reason = "helpers of tests, which clippy takes for library code"
)]

use descry::numerics::{Complex64, Tolerance, matching, rank};
use descry::system::DescriptorSystem;
use descry::system::properties::{
    ModeCondition, finite_eigenvalues, impulse_observability, index, r_detectability, r_observability,
    rank_e, rank_e_c, regularity,
};
use nalgebra::DMatrix;
use serde_json::Value;

struct Case {
    name: String,
    system: DescriptorSystem,
    truth: Value,
}

fn cases() -> Vec<Case> {
    let text = include_str!("reference/descriptor_truth.json");
    let all: Vec<Value> = serde_json::from_str(text).unwrap();
    let case = |value: &Value| Case {
        name: value["name"].as_str().unwrap().to_owned(),
        system: DescriptorSystem::autonomous(matrix(&value["E"]), matrix(&value["A"]), matrix(&value["C"]))
            .unwrap(),
        truth: value["truth"].clone(),
    };
    all.iter().map(case).collect()
}

fn matrix(value: &Value) -> DMatrix<f64> {
    let rows: Vec<Vec<f64>> = serde_json::from_value(value.clone()).unwrap();
    DMatrix::from_fn(rows.len(), rows[0].len(), |i, j| rows[i][j])
}

/// Reads `-0.5 - 0.866*I`, `1.9e-18*I`, `-15.0`; what is smaller than 1e-15 is zero.
fn complex(text: &str) -> Complex64 {
    let mut result = Complex64::ZERO;
    for term in text.replace("- ", "+ -").split(" + ") {
        match term.strip_suffix("*I") {
            Some(imaginary) => result.im += imaginary.parse::<f64>().unwrap(),
            None => result.re += term.parse::<f64>().unwrap(),
        }
    }
    if result.norm() < 1e-15 { Complex64::ZERO } else { result }
}

/// Roots with multiplicity of the polynomials that occur in the file.
fn roots(polynomial: &str) -> Vec<(Complex64, usize)> {
    let zero = (Complex64::ZERO, 2);
    match polynomial {
        "1" => vec![],
        "s**2" => vec![zero],
        "s**2*(s - 2)" => vec![zero, (Complex64::from(2.0), 1)],
        "s**2 + 2*s + 3" => {
            let root = Complex64::new(-1.0, 2.0_f64.sqrt());
            vec![(root, 1), (root.conj(), 1)]
        }
        other => panic!("a polynomial without known roots: {other}"),
    }
}

fn assert_same_values(found: &[Complex64], expected: &[Complex64], name: &str) {
    let pairs = matching(expected, found)
        .unwrap_or_else(|| panic!("{name}: {found:?} where {expected:?} are expected"));
    for (i, j) in pairs {
        let (wanted, got) = (expected[i], found[j]);
        let simple = expected.iter().filter(|&&z| (z - wanted).norm() < 1e-9).count() == 1;
        let limit = if simple { 1e-9 * wanted.norm().max(1e-3) } else { 1e-6 * wanted.norm().max(1.0) };
        assert!((wanted - got).norm() <= limit, "{name}: {got} where {wanted} is expected");
    }
}

#[test]
fn there_are_fifteen_systems() {
    assert_eq!(cases().len(), 15, "the file was read whole");
}

#[test]
fn ranks_agree() {
    for Case { name, system, truth } in cases() {
        let tolerance = Tolerance::default();
        assert_eq!(rank_e(&system, &tolerance).unwrap().rank, truth["rankE"], "{name}: rank E");
        let found = rank_e_c(&system, &tolerance).unwrap();
        assert_eq!(found.decision.rank, truth["rank_EC"], "{name}: rank [E; C]");
        assert_eq!(found.holds(), truth["rank_EC_full"], "{name}: rank [E; C] = n");
        assert!(!found.fragile(), "{name}: {found:?}");
    }
}

#[test]
fn regularity_and_index_agree() {
    for Case { name, system, truth } in cases() {
        let found = regularity(&system, &Tolerance::default()).unwrap();
        assert_eq!(found.holds(), truth["regular"], "{name}: {found:?}");
        // its entries span nine decades: 1e-6 of the norm counts, but is close to the threshold
        assert_eq!(found.fragile(), name.contains("RLC"), "{name}: {found:?}");
        let found = index(&system, &Tolerance::default()).unwrap();
        assert_eq!(serde_json::json!(found.index), truth["index"], "{name}: {found:?}");
    }
}

#[test]
fn finite_eigenvalues_agree() {
    for Case { name, system, truth } in cases() {
        let expected: Vec<String> = serde_json::from_value(truth["finite_eigs"].clone()).unwrap();
        let expected: Vec<Complex64> = expected.iter().map(|text| complex(text)).collect();
        let found = finite_eigenvalues(&system, &Tolerance::default()).unwrap();
        if truth["regular"] == false {
            // the file lists roots of det (s E - A), which vanishes here; the rank still drops at s = 0, from 3 to 2
            let rank_at_zero = rank(&system.A, 0.0, &Tolerance::default()).unwrap().rank;
            assert_eq!((found.normal_rank, rank_at_zero), (3, 2), "{name}: {found:?}");
            assert_same_values(&found.values, &[Complex64::ZERO], &name);
            continue;
        }
        assert_same_values(&found.values, &expected, &name);
    }
}

#[test]
fn impulse_observability_agrees_in_both_forms() {
    for Case { name, system, truth } in cases() {
        let found = impulse_observability(&system, &Tolerance::default()).unwrap();
        assert_eq!(found.holds(), truth["impulse_observable"], "{name}: {found:?}");
        assert_eq!(found.printed.holds(), found.holds(), "{name}: the printed matrix says otherwise");
        assert!(!found.fragile(), "{name}: {found:?}");
        let Some(witness) = found.witness else { continue };
        let w = nalgebra::DVector::from_vec(witness);
        assert!((&system.E * &w).norm() < 1e-12, "{name}: E w = 0");
        assert!((&system.C * &w).norm() < 1e-12, "{name}: C w = 0");
    }
}

#[test]
fn r_observability_and_r_detectability_agree() {
    for Case { name, system, truth } in cases() {
        let found = r_observability(&system, &Tolerance::default()).unwrap();
        assert_eq!(found.holds(), truth["R_observable"], "{name}: {found:?}");
        let found = r_detectability(&system, &Tolerance::default()).unwrap();
        assert_eq!(found.holds(), truth["R_detectable"], "{name}: {found:?}");
    }
}

#[test]
fn unobservable_modes_are_the_roots_of_the_reference_polynomial() {
    for Case { name, system, truth } in cases() {
        let found = r_observability(&system, &Tolerance::default()).unwrap();
        let Some(polynomial) = truth["finite_unobservable_poly"].as_str() else {
            assert!(
                found.free_direction.is_some(),
                "{name}: no polynomial means no rank anywhere: {found:?}"
            );
            continue;
        };
        let expected = roots(polynomial);
        assert_eq!(found.modes.len(), expected.len(), "{name}: {found:?}");
        for (root, multiplicity) in expected {
            let mode = found.modes.iter().find(|mode| (mode.s - root).norm() < 1e-9);
            let mode = mode.unwrap_or_else(|| panic!("{name}: {root} is missing in {found:?}"));
            assert_eq!(mode.multiplicity, multiplicity, "{name}: {mode:?}");
            assert_annihilates(&name, &system, &found, mode.s, &mode.direction);
        }
    }
}

#[test]
fn evidence_survives_the_way_to_a_worker_and_back() {
    fn returned<T: serde::Serialize + serde::de::DeserializeOwned>(value: &T) -> T {
        postcard::from_bytes(&postcard::to_stdvec(value).unwrap()).unwrap()
    }
    for Case { name, system, .. } in cases() {
        let tolerance = Tolerance::default();
        let found = impulse_observability(&system, &tolerance).unwrap();
        assert_eq!(returned(&found), found, "{name}: impulse observability");
        let found = r_detectability(&system, &tolerance).unwrap();
        assert_eq!(returned(&found), found, "{name}: R-detectability");
        let found = regularity(&system, &tolerance).unwrap();
        assert_eq!(returned(&found), found, "{name}: regularity");
    }
}

/// `(A - s E) v = 0` and `C v = 0`.
fn assert_annihilates(
    name: &str,
    system: &DescriptorSystem,
    found: &ModeCondition,
    s: Complex64,
    v: &[Complex64],
) {
    let v = nalgebra::DVector::from_column_slice(v);
    let pencil = system.A.zip_map(&system.E, |a, e| Complex64::from(a) - s * e);
    assert!((pencil * &v).norm() < 1e-9, "{name}: (A - s E) v = 0, {found:?}");
    assert!((system.C.map(Complex64::from) * &v).norm() < 1e-9, "{name}: C v = 0, {found:?}");
}
