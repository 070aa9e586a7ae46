//! Paper 003 (Ishizaki, Sakai, Kashima, Imura): representation, conditions, designs and simulation of networks.
#![expect(clippy::unwrap_used, reason = "helpers of tests fail by panicking")]
#![expect(non_snake_case, reason = "matrix letters of the paper")]

// the same tests run in a browser
#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

#[cfg(target_arch = "wasm32")]
wasm_bindgen_test::wasm_bindgen_test_configure!(run_in_browser);

use descry::numerics::{
    Complex64, Random, Tolerance, eigenvalues, observable_quotient, pbh_modes, spectral_distance,
};
use descry::observer::hierarchical::{
    HierarchicalDesign, HierarchicalObserver, Hierarchy, HierarchyError, LARGEST_COMPOSITE, LocalObserver,
    MOST_GLOBAL_STATES, composite, conditions, conditions_for, design, design_global, design_local,
    verify_network,
};
use descry::observer::{Condition, DesignChoice, DesignError, Evidence, Verdict};
use descry::simulation::{FreeVariables, Scenario, Span, simulate_network};
use descry::system::{CouplingMatrix, Network};
use nalgebra::{DMatrix, DVector, dmatrix};
use serde_json::Value;

#[path = "paper_003/figures.rs"]
mod figures;
#[path = "paper_003/large.rs"]
mod large;
// a hundred and fifty systems with three decompositions each: too slow for a browser, and nothing in them depends on one
#[cfg(not(target_arch = "wasm32"))]
#[path = "paper_003/random.rs"]
mod random;
#[path = "paper_003/reference.rs"]
mod reference;
#[path = "paper_003/verdicts.rs"]
mod verdicts;

fn tolerance() -> Tolerance {
    Tolerance::default()
}

fn reference() -> Value {
    serde_json::from_str(include_str!("reference/ex003.json")).unwrap()
}

fn matrix(value: &Value) -> DMatrix<f64> {
    let rows: Vec<Vec<f64>> = serde_json::from_value(value.clone()).unwrap();
    DMatrix::from_row_iterator(rows.len(), rows[0].len(), rows.into_iter().flatten())
}

fn vector(value: &Value) -> DVector<f64> {
    DVector::from_vec(serde_json::from_value(value.clone()).unwrap())
}

fn spectrum(value: &Value) -> Vec<Complex64> {
    let pairs: Vec<[f64; 2]> = serde_json::from_value(value.clone()).unwrap();
    pairs.into_iter().map(|[re, im]| Complex64::new(re, im)).collect()
}

fn real(values: &[f64]) -> Vec<Complex64> {
    values.iter().map(|p| Complex64::from(*p)).collect()
}

fn network() -> Network {
    let inputs = &reference()["inputs"];
    let of = |key: &str| matrix(&inputs[key]);
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

fn choice() -> DesignChoice {
    DesignChoice {
        poles: real(&[-2.0, -2.5, -3.0, -3.5, -4.0, -4.5]),
        local_poles: local_poles(),
        ..DesignChoice::default()
    }
}

fn local_poles() -> Vec<Complex64> {
    real(&[-4.0, -4.5, -5.0, -5.5, -6.0])
}

fn designed(network: &Network) -> HierarchicalDesign {
    let asked = conditions(network, &tolerance()).unwrap();
    design(network, &choice(), &asked, &tolerance()).unwrap()
}

fn x0(states: usize) -> Vec<f64> {
    (1..=states).map(|k| 5.0 * (k as f64).sin()).collect()
}

fn close(found: &DMatrix<f64>, expected: &DMatrix<f64>, limit: f64, what: &str) {
    assert_eq!(found.shape(), expected.shape(), "{what}: shape");
    let error = (found - expected).norm() / expected.norm().max(1.0);
    assert!(error <= limit, "{what}: relative difference {error:.2e}\nfound {found}expected {expected}");
}

fn near(found: &[Complex64], expected: &[Complex64], limit: f64, what: &str) {
    let distance = spectral_distance(found, expected);
    assert!(distance <= limit, "{what}: {distance:.2e} apart\nfound {found:?}\nexpected {expected:?}");
}

fn find<'a>(conditions: &'a [Condition], id: &str) -> &'a Condition {
    conditions.iter().find(|condition| condition.id == id).unwrap()
}

#[test]
fn the_representation_is_that_of_the_reference() {
    let (reference, network) = (reference(), network());
    let found = Hierarchy::of(&network, &tolerance()).unwrap();
    assert_eq!((found.N.ncols(), found.M.ncols(), found.order()), (3, 2, 6), "nu, mu, n_z");
    assert!(!found.nu.fragile, "nu is clear: {:?}", found.nu);
    let invariant = &reference["gauge_invariant"];
    close(&(&found.N * found.N.transpose()), &matrix(&invariant["NNt"]), 1e-9, "N N'");
    close(&(&found.M * found.M.transpose()), &matrix(&invariant["MMt"]), 1e-9, "M M'");
    near(&eigenvalues(&found.Gamma_nu).unwrap(), &spectrum(&invariant["eig_Gamma_nu"]), 1e-9, "eig Gamma_nu");
    near(&eigenvalues(&found.alpha_z()).unwrap(), &spectrum(&invariant["eig_alpha_z"]), 1e-9, "eig alpha_z");
    // the bases are Gram-Schmidt of the rows in order, as in the paper, so that its own matrices come out
    let own = &reference["design"]["reference"];
    for (name, value, key) in [
        ("N", &found.N, "N"),
        ("M", &found.M, "M"),
        ("Gamma_nu", &found.Gamma_nu, "Gamma_nu"),
        ("a_z", &found.a_z, "az"),
        ("b_z", &found.b_z, "bz"),
        ("c_z", &found.c_z, "cz"),
        ("alpha_z", &found.alpha_z(), "alpha_z"),
        ("beta_z", &found.beta(3), "beta_z"),
        ("gamma_z", &found.gamma_z(), "gamma_z"),
    ] {
        close(value, &matrix(&own[key]), 1e-9, name);
    }
}

// ERRATUM(003, section III): N(2, 2) is printed as 0.41 instead of -0.41, Gamma_nu(3, 2) as 0.83 instead of 0.82.
#[test]
fn the_printed_matrices_are_ours_but_for_two_misprints() {
    let (printed, network) = (&reference()["printed"], network());
    let found = Hierarchy::of(&network, &tolerance()).unwrap();
    let mut N = matrix(&printed["N"]);
    let gram = N.tr_mul(&N);
    assert!((gram[(0, 1)] - 0.58).abs() < 0.01, "the printed N is not orthonormal: {gram}");
    assert!((N[(1, 1)] - found.N[(1, 1)]).abs() > 0.8, "its entry (2, 2) has the wrong sign");
    N[(1, 1)] *= -1.0;
    assert!((&N - &found.N).amax() < 0.005, "all others are rounded to two digits");
    let difference = (matrix(&printed["Gamma_nu"]) - &found.Gamma_nu).abs();
    assert!((difference[(2, 1)] - 0.00504).abs() < 1e-5, "0.82496 is printed as 0.83");
    assert!(difference.iter().filter(|d| **d > 0.005).count() == 1, "all others are rounded: {difference}");
}

#[test]
fn the_representation_obeys_its_identities_on_the_expanded_network() {
    let network = network();
    let found = Hierarchy::of(&network, &tolerance()).unwrap();
    let expanded = network.expanded();
    let sigma = found.sigma_z();
    assert_eq!(sigma.shape(), (6, 20), "sigma_z is nu mu x N n, not as printed");
    close(&(&sigma * &expanded.A), &(found.alpha_z() * &sigma), 1e-14, "sigma_z A = alpha_z sigma_z");
    close(&(found.gamma_z() * &sigma), &expanded.C.rows(0, 1).into_owned(), 1e-14, "gamma_z sigma_z");
    let fourth = expanded.A.rows(15, 5).into_owned();
    let mut right = found.beta(3) * &sigma;
    let sum = right.columns(15, 5) + &network.a;
    right.columns_mut(15, 5).copy_from(&sum);
    close(&fourth, &right, 1e-14, "x_4' = a x_4 + beta_4 z");
    near(
        &eigenvalues(&expanded.A).unwrap(),
        &spectrum(&reference()["gauge_invariant"]["eig_A"]),
        1e-4,
        "eig A",
    );
}

#[test]
fn every_condition_of_the_example_holds_as_in_the_reference() {
    let (reference, network) = (reference(), network());
    let found = conditions(&network, &tolerance()).unwrap();
    for condition in &found {
        assert_eq!(condition.verdict, Verdict::Holds, "{}: {}", condition.id, condition.summary);
    }
    assert_eq!(found.iter().filter(|c| c.needed).count(), 4, "(11) twice and Proposition 1 twice");
    let Evidence::Points { points, .. } = &find(&found, "003-T2-iii").evidence[0] else {
        unreachable!("points")
    };
    let expected = reference["conditions"]["theorem2"]["iii_list"].as_array().unwrap();
    assert_eq!(points.len(), expected.len(), "number of different pi");
    let scale = {
        let h = Hierarchy::of(&network, &tolerance()).unwrap();
        let size = h.a_z.norm() + h.Gamma_nu.norm() * (&h.b_z * &h.c_z).norm();
        size.hypot(h.gamma_z().norm())
    };
    for entry in expected {
        let pi = spectrum(&Value::Array(vec![entry["pi"].clone()]))[0];
        let point = points.iter().min_by(|a, b| (a.s - pi).norm().total_cmp(&(b.s - pi).norm())).unwrap();
        assert!((point.s - pi).norm() < 1e-9, "pi = {pi}");
        assert_eq!(point.multiplicity as u64, entry["theta"].as_u64().unwrap(), "|Theta_pi| at {pi}");
        let smin = entry["smin"].as_f64().unwrap();
        assert!(
            (point.distance * scale - smin).abs() < 1e-9,
            "sigma_min at {pi}: {}",
            point.distance * scale
        );
    }
    let Evidence::Points { points, .. } = &find(&found, "003-P1-local").evidence[0] else {
        unreachable!("points")
    };
    for entry in reference["conditions"]["local"].as_array().unwrap() {
        let s = spectrum(&Value::Array(vec![entry["lam"].clone()]))[0];
        let point = points.iter().find(|point| (point.s - s).norm() < 1e-9).unwrap();
        assert!((point.distance - entry["sigma_rel"].as_f64().unwrap()).abs() < 1e-9, "distance at {s}");
    }
}

#[test]
fn the_design_has_the_unique_gain_and_both_spectra() {
    let (reference, network) = (reference(), network());
    let found = designed(&network);
    assert!(found.verification.verified(), "{:#?}", found.verification.checks);
    let hierarchy = &found.observer.hierarchy;
    let expected = &reference["design"];
    close(&found.observer.global.H, &matrix(&expected["reference"]["H"]), 1e-9, "H is unique for one output");
    let lifted = hierarchy.N.kronecker(&hierarchy.M) * &found.observer.global.H;
    close(&lifted, &matrix(&expected["gauge_invariant_NkronM_H"]), 1e-9, "(N kron M) H");
    let spectra = &found.verification.spectrum;
    near(&spectra[..6], &spectrum(&expected["eig_global"]), 1e-6, "eig(alpha_z - H gamma_z)");
    near(&spectra[6..], &spectrum(&expected["eig_local"]), 1e-8, "eig(a - h c_L)");
    assert!(found.observer.global.placement.fixed_modes.is_empty(), "nothing is fixed");
}

#[test]
fn verification_agrees_with_the_expanded_error_system() {
    let network = network();
    let asked = conditions(&network, &tolerance()).unwrap();
    // apart from the global poles: a double eigenvalue of the composite would be known to half the digits alone
    let apart = DesignChoice { local_poles: real(&[-4.25, -4.75, -5.25, -5.75, -6.25]), ..choice() };
    let found = design(&network, &apart, &asked, &tolerance()).unwrap();
    let (one, expanded) = (composite(&network, &found.observer).unwrap(), network.expanded());
    near(&eigenvalues(&one.N).unwrap(), &found.verification.spectrum, 1e-6, "spectrum of the composite");
    // T A = N_o T + L C for T = [sigma_z; e_4' kron I]
    let mut T = DMatrix::zeros(11, 20);
    T.rows_mut(0, 6).copy_from(&found.observer.hierarchy.sigma_z());
    T.view_mut((6, 15), (5, 5)).fill_with_identity();
    close(&(&one.N * &T + &one.L * &expanded.C), &(&T * &expanded.A), 1e-13, "error dynamics");
    assert_eq!(
        one.P.rows(15, 5).columns(6, 5),
        DMatrix::<f64>::identity(5, 5),
        "x_hat_4 is its own estimate"
    );
    let rest = one.P.view((0, 0), (15, 6)).into_owned();
    let whole = found.observer.hierarchy.sigma_z().transpose();
    assert_eq!(rest, whole.rows(0, 15).into_owned(), "the others are read from the whole");
}

#[test]
fn a_wrong_observer_is_not_verified() {
    let network = network();
    let failed = |observer: &HierarchicalObserver| -> Vec<String> {
        let result = verify_network(&network, observer, &tolerance()).unwrap();
        result.failures().map(|check| check.name.clone()).collect()
    };
    let good = designed(&network).observer;
    assert!(failed(&good).is_empty(), "the observer as designed passes");
    let mut wrong = good.clone();
    wrong.global.H[(0, 0)] += 0.1;
    assert_eq!(failed(&wrong), ["spectrum of the global observer"], "another gain");
    let mut wrong = good.clone();
    wrong.hierarchy.Gamma_nu[(0, 0)] += 0.1;
    assert!(failed(&wrong).contains(&"dynamics of the whole".to_owned()), "{:?}", failed(&wrong));
    let mut wrong = good.clone();
    wrong.hierarchy.Gamma_N[(3, 1)] += 1e-6;
    let names = failed(&wrong);
    assert!(names.contains(&"drive of every subsystem".to_owned()), "{names:?}");
    assert!(names.contains(&"local error dynamics".to_owned()), "{names:?}");
    // ERRATUM(003, section III): the printed N(2, 2) = +0.41
    let mut wrong = good;
    wrong.hierarchy.N[(1, 1)] *= -1.0;
    let names = failed(&wrong);
    assert!(
        names.contains(&"orthonormal N".to_owned())
            && names.contains(&"row space of the coupling".to_owned()),
        "the failing checks are named: {names:?}"
    );
}

#[test]
fn local_observers_come_and_go_without_touching_the_global_one() {
    let network = Network { local: vec![1, 3], ..network() };
    let hierarchy = Hierarchy::of(&network, &tolerance()).unwrap();
    let global = design_global(&hierarchy, &choice(), &tolerance()).unwrap();
    let mut observer = HierarchicalObserver::new(hierarchy, global.clone());
    let local = design_local(&network, &choice(), &tolerance()).unwrap();
    assert!(
        verify_network(&network, &observer, &tolerance()).unwrap().verified(),
        "the global observer alone"
    );
    observer.plug_in(&network, 3, local.clone()).unwrap();
    let slow = DesignChoice { scale: 0.5, ..choice() };
    observer.plug_in(&network, 1, design_local(&network, &slow, &tolerance()).unwrap()).unwrap();
    let both = verify_network(&network, &observer, &tolerance()).unwrap();
    assert!(both.verified() && both.spectrum.len() == 16, "two different local observers: {:?}", both.checks);
    assert_eq!(composite(&network, &observer).unwrap().order(), 16, "6 + 2 * 5");
    let refused = observer.plug_in(&network, 0, local).unwrap_err();
    assert!(refused.to_string().contains("subsystem 1 has no local measurements"), "{refused}");
    assert!(observer.pull_out(1).is_some() && observer.pull_out(1).is_none(), "taken out once");
    assert_eq!(observer.locals().map(|(i, _)| i).collect::<Vec<_>>(), [3], "the other one stays");
    assert_eq!(observer.global, global, "the global observer is what it was");
}

#[test]
fn lists_of_poles_are_told_apart() {
    let network = network();
    let asked = conditions(&network, &tolerance()).unwrap();
    let short = DesignChoice { local_poles: local_poles()[..3].to_vec(), ..choice() };
    let made = design(&network, &short, &asked, &tolerance()).unwrap();
    assert_eq!(
        made.observer.left_out,
        [
            "no local observer is plugged in: poles of the local observer: 3 poles are given, but this design places 5: \
             add 2"
        ],
        "which list; the global observer stays"
    );
    let few = DesignChoice { poles: real(&[-1.0]), ..choice() };
    let error = design(&network, &few, &asked, &tolerance()).unwrap_err();
    assert!(error.to_string().starts_with("poles of the global observer: 1 poles"), "{error}");
}

/// Sections 3.3 of the mathematics: what the centralized pair sees.
#[test]
fn the_expanded_pair_hides_nine_stable_modes() {
    let reference = reference();
    let expanded = network().expanded();
    let found = observable_quotient(&expanded.A, &expanded.C, &tolerance()).unwrap();
    assert_eq!(found.basis.ncols() as u64, reference["rank_O20"].as_u64().unwrap(), "rank of O_20");
    near(&found.fixed_modes, &spectrum(&reference["unobservable_modes_of_A_C"]), 1e-4, "hidden modes");
    assert!(found.fixed_modes.iter().all(|z| z.re < 0.0), "the centralized pair is detectable");
    assert!(found.unobservable.rows(15, 5).norm() < 1e-8, "x_4 is seen by a centralized observer, too");
}

#[test]
fn simulation_without_expansion_agrees_with_the_expanded_one() {
    let network = Network { local: vec![1, 3], ..network() };
    let observer = designed(&network).observer;
    let one = composite(&network, &observer).unwrap();
    let scenario = Scenario {
        horizon: 6.0,
        samples: 61,
        x0: DVector::from_vec(x0(20)),
        u: Vec::new(),
        d: Vec::new(),
        noise: Vec::new(),
        uncertainty: None,
        free: FreeVariables::default(),
    };
    let whole = scenario.run_linear(&network.expanded(), &[&one], &tolerance()).unwrap();
    let span = Span { horizon: 6.0, samples: 61 };
    let found = simulate_network(&network, &observer, &x0(20), span, &[0, 1, 2, 3]).unwrap();
    for (i, part) in found.subsystems.iter().enumerate() {
        close(&part.x, &whole.x.rows(5 * i, 5).into_owned(), 1e-10, "x");
        close(&part.x_hat, &whole.observers[0].x_hat.rows(5 * i, 5).into_owned(), 1e-9, "x_hat");
    }
    close(&found.z_hat, &whole.observers[0].z.rows(0, 6).into_owned(), 1e-9, "z_hat");
}

#[test]
fn simulation_refuses_what_does_not_fit() {
    let network = network();
    let observer = designed(&network).observer;
    let span = Span { horizon: 1.0, samples: 11 };
    for (states, shown) in [(19, vec![3]), (20, vec![4])] {
        let result = simulate_network(&network, &observer, &x0(states), span, &shown);
        assert!(result.is_err(), "{states} initial values, subsystems {shown:?}");
    }
    let other = Network { Psi: DMatrix::zeros(2, 4), ..network };
    assert!(simulate_network(&other, &observer, &x0(20), span, &[]).is_err(), "another global output");
}

/// Two coupling strengths share the mode `q`, which (i) and (ii) cannot know of.
fn shared_mode(q: f64) -> Network {
    Network {
        a: dmatrix![-1.0, 0.0; 0.0, q],
        b: dmatrix![1.0; 0.0],
        c: dmatrix![1.0, 1.0],
        Gamma: dmatrix![1.0, 0.0; 0.0, 2.0].into(),
        Psi: dmatrix![1.0, 1.0],
        c_G: dmatrix![1.0, 1.0],
        c_L: DMatrix::identity(2, 2),
        local: vec![0],
    }
}

// ERRATUM(003, Theorem 2 (iii)): with the printed |Theta_pi| > 2 this network would count as observable.
#[test]
fn two_coupling_strengths_are_enough_to_hide_a_shared_mode() {
    let network = shared_mode(0.5);
    let found = conditions(&network, &tolerance()).unwrap();
    for id in ["003-11-Psi", "003-11-cG", "003-T2-i", "003-T2-ii"] {
        assert!(find(&found, id).verdict.holds(), "{id}: {}", find(&found, id).summary);
    }
    for id in ["003-T2-iii", "003-C1-iii", "003-P1-global"] {
        assert_eq!(find(&found, id).verdict, Verdict::Fails, "{id}: {}", find(&found, id).summary);
    }
    let Evidence::Points { points, .. } = &find(&found, "003-T2-iii").evidence[0] else {
        unreachable!("points")
    };
    let shared = points.iter().find(|point| point.loses_rank).unwrap();
    assert_eq!(shared.multiplicity, 2, "|Theta_pi| = 2");
    let witness = find(&found, "003-P1-global").witness.clone().unwrap();
    assert!((witness.s.unwrap() - 0.5).norm() < 1e-9, "the mode is the uncontrollable one");
    let remedies = &find(&found, "003-P1-global").remedies;
    assert!(remedies.iter().any(|r| r == "adding row 1 of Gamma to Psi would restore it"), "{remedies:?}");
    let error = design(&network, &choice(), &found, &tolerance()).unwrap_err();
    assert!(matches!(error, DesignError::Condition { ref id, .. } if id == "003-P1-global"), "{error}");
}

#[test]
fn a_hidden_mode_that_decays_is_no_obstacle() {
    let network = shared_mode(-0.5);
    let found = conditions(&network, &tolerance()).unwrap();
    assert_eq!(find(&found, "003-T2-iii").verdict, Verdict::Fails, "still not observable");
    let global = find(&found, "003-P1-global");
    assert_eq!(global.verdict, Verdict::Holds, "but detectable: {}", global.summary);
    let design = design(&network, &choice(), &found, &tolerance()).unwrap();
    assert!(design.verification.verified(), "{:#?}", design.verification.checks);
    assert_eq!(design.observer.global.placement.fixed_modes.len(), 1, "one mode stays");
    assert!(
        design.notes.iter().any(|note| note.contains("fixed modes") && note.contains("-0.5")),
        "{:?}",
        design.notes
    );
}

#[test]
fn outputs_outside_the_whole_are_refused_with_a_remedy() {
    let network =
        Network { Psi: dmatrix![1.0, 0.0, 0.0, 0.0], c_G: dmatrix![0.0, 1.0, 0.0, 0.0, 0.0], ..network() };
    let found = conditions(&network, &tolerance()).unwrap();
    for (id, word) in [("003-11-Psi", "rows of Gamma"), ("003-11-cG", "c_I a_I")] {
        let condition = find(&found, id);
        assert_eq!(condition.verdict, Verdict::Fails, "{id}: {}", condition.summary);
        assert!(condition.remedies[0].contains(word), "{:?}", condition.remedies);
    }
    let slightly = Network { Psi: dmatrix![1.0, -1.0 + 1e-9, 0.0, 0.0], ..self::network() };
    let found = conditions(&slightly, &tolerance()).unwrap();
    assert_eq!(find(&found, "003-11-Psi").verdict, Verdict::Fragile, "3e-10 outside is narrow");
}

#[test]
fn an_undetectable_subsystem_names_the_missing_sensor() {
    let network = Network { c_L: dmatrix![1.0, 0.0, 0.0, 0.0, 0.0], a: network().a, ..network() };
    let blind = Network { c_L: DMatrix::zeros(0, 5), ..network.clone() };
    let found = conditions(&blind, &tolerance()).unwrap();
    let local = find(&found, "003-P1-local");
    assert_eq!(local.verdict, Verdict::Fails, "nothing is measured: {}", local.summary);
    assert!(local.summary.contains("0.2"), "the unstable mode: {}", local.summary);
    assert!(!local.remedies.is_empty() && local.needed, "{:?}", local.remedies);
    let without = Network { local: Vec::new(), ..blind };
    let found = conditions(&without, &tolerance()).unwrap();
    assert!(!find(&found, "003-P1-local").needed, "no local observer is asked for");
    let design = design(&without, &choice(), &found, &tolerance()).unwrap();
    assert!(
        design.verification.verified() && design.observer.locals().count() == 0,
        "the global observer alone"
    );
}

#[test]
fn a_defective_coupling_is_left_to_the_pbh_test() {
    let Gamma = dmatrix![-1.0, 1.0, 0.0; 0.0, -1.0, 1.0; 0.0, 0.0, -1.0].into();
    let network =
        Network { Gamma, Psi: dmatrix![1.0, 0.0, 0.0], local: vec![0], ..network() }.checked().unwrap();
    let found = conditions(&network, &tolerance()).unwrap();
    let third = find(&found, "003-T2-iii");
    assert_eq!(third.verdict, Verdict::Undecided, "{}", third.summary);
    assert!(third.summary.contains("not diagonalisable"), "{}", third.summary);
    assert_eq!(find(&found, "003-P1-global").verdict, Verdict::Holds, "the chain ends at the output");
    let design = design(&network, &choice(), &found, &tolerance()).unwrap();
    assert!(design.verification.verified(), "{:#?}", design.verification.checks);
}

#[test]
fn nothing_coupled_is_nothing_to_estimate_globally() {
    let Gamma = DMatrix::zeros(4, 4).into();
    let network = Network { Gamma, Psi: DMatrix::zeros(0, 4), ..network() };
    let found = conditions(&network, &tolerance()).unwrap();
    let design = design(&network, &choice(), &found, &tolerance()).unwrap();
    assert_eq!(design.observer.hierarchy.order(), 0, "nu = 0");
    assert!(design.verification.verified(), "{:#?}", design.verification.checks);
    let span = Span { horizon: 4.0, samples: 5 };
    let run = simulate_network(&network, &design.observer, &x0(20), span, &[3]).unwrap();
    let part = &run.subsystems[0];
    assert!((part.x.column(4) - part.x_hat.column(4)).norm() < 1e-3, "the local observer works alone");
}

#[test]
fn a_stable_whole_needs_no_global_output() {
    let network = Network { Psi: DMatrix::zeros(0, 4), ..network() };
    let found = conditions(&network, &tolerance()).unwrap();
    let global = find(&found, "003-P1-global");
    assert!(global.verdict.holds() && global.summary.contains("6 fixed modes"), "{}", global.summary);
    let design = design(&network, &choice(), &found, &tolerance()).unwrap();
    assert!(design.verification.verified(), "{:#?}", design.verification.checks);
    assert_eq!(design.observer.global.H.shape(), (6, 0), "there is nothing to feed back");
    let span = Span { horizon: 100.0, samples: 11 };
    let run = simulate_network(&network, &design.observer, &x0(20), span, &[3]).unwrap();
    let error = |k: usize| (run.subsystems[0].x.column(k) - run.subsystems[0].x_hat.column(k)).norm();
    assert!(error(10) < 0.1 * error(0), "it converges with the slowest mode, -0.068: {}", error(10));
}
