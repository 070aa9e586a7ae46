//! Paper 001 (input-decoupled observers): conditions, designs and misprints against the reference numbers.
#![expect(clippy::unwrap_used, clippy::panic, reason = "helpers of tests fail by panicking")]
#![expect(non_snake_case, reason = "matrix letters of the paper")]

// the same tests run in a browser
#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

#[cfg(target_arch = "wasm32")]
wasm_bindgen_test::wasm_bindgen_test_configure!(run_in_browser);

use descry::numerics::{
    Complex64, RankDecision, Tolerance, complex_svd, eigenvalues, pseudo_inverse, rank_drop_points,
    side_by_side, spectral_distance, stack,
};
use descry::observer::input_decoupled::{
    conditions, coordinates, design, general_reduction, paper_reduction, verify_decoupled,
};
use descry::observer::{
    Condition, Design, DesignChoice, DesignError, Evidence, LinearObserver, Order, Verdict,
};
use descry::system::{DescriptorSystem, LipschitzTerm, Model, TimeDomain};
use nalgebra::{DMatrix, DVector, dmatrix};
use serde_json::Value;

#[path = "paper_001/elsewhere.rs"]
mod elsewhere;
#[path = "paper_001/figures.rs"]
mod figures;
#[path = "paper_001/narrow.rs"]
mod narrow;
#[path = "paper_001/random.rs"]
mod random;
#[path = "paper_001/reference.rs"]
mod reference_file;
#[path = "paper_001/simulation.rs"]
mod simulation;

fn reference() -> Value {
    serde_json::from_str(include_str!("reference/ex001.json")).unwrap()
}

fn matrix(value: &Value) -> DMatrix<f64> {
    let rows: Vec<Vec<f64>> = serde_json::from_value(value.clone()).unwrap();
    DMatrix::from_row_iterator(rows.len(), rows[0].len(), rows.into_iter().flatten())
}

fn complex_matrix(value: &Value) -> DMatrix<Complex64> {
    let rows: Vec<Vec<[f64; 2]>> = serde_json::from_value(value.clone()).unwrap();
    let entries = rows.iter().flatten().map(|[re, im]| Complex64::new(*re, *im));
    DMatrix::from_row_iterator(rows.len(), rows[0].len(), entries)
}

fn poles(value: &Value) -> Vec<Complex64> {
    let pairs: Vec<[f64; 2]> = serde_json::from_value(value.clone()).unwrap();
    pairs.into_iter().map(|[re, im]| Complex64::new(re, im)).collect()
}

/// The paper's example.
fn example() -> DescriptorSystem {
    let inputs = &reference()["inputs"];
    let [E, A, B, C, D, F] = ["E", "A", "B", "C", "D", "F"].map(|name| matrix(&inputs[name]));
    DescriptorSystem { time: TimeDomain::Continuous, E, A, B, C, D, F }.checked().unwrap()
}

fn choice(order: Order, poles: &[f64]) -> DesignChoice {
    let poles = poles.iter().copied().map(Complex64::from).collect();
    DesignChoice { order, poles, ..DesignChoice::default() }
}

fn asked(system: &DescriptorSystem, order: Order) -> Vec<Condition> {
    conditions(&system.clone().into(), &choice(order, &[]), &Tolerance::default()).unwrap()
}

fn designed(system: &DescriptorSystem, choice: &DesignChoice) -> Result<Design, DesignError> {
    let model: Model = system.clone().into();
    let found = conditions(&model, choice, &Tolerance::default()).unwrap();
    design(&model, choice, &found, &Tolerance::default())
}

/// The design of the paper's example with the paper's poles.
fn paper_design(order: Order) -> Design {
    let wished = poles(&reference()["poles"]);
    let choice = DesignChoice { order, poles: wished, ..DesignChoice::default() };
    designed(&example(), &choice).unwrap()
}

fn verified(design: &Design) {
    assert!(design.verification.verified(), "{}: {:#?}", design.title, design.verification);
}

fn close(found: &DMatrix<f64>, expected: &DMatrix<f64>, limit: f64, what: &str) {
    assert_eq!(found.shape(), expected.shape(), "{what}: shape");
    let error = (found - expected).norm() / expected.norm().max(1.0);
    assert!(error <= limit, "{what}: relative difference {error:.2e}\nfound {found}expected {expected}");
}

fn found<'a>(conditions: &'a [Condition], label: &str) -> &'a Condition {
    conditions.iter().find(|c| c.label == label).unwrap_or_else(|| panic!("no condition {label}"))
}

fn ranks(condition: &Condition) -> Vec<(&RankDecision, usize)> {
    let rank = |e| match e {
        &Evidence::Rank { ref decision, required, .. } => Some((decision, required)),
        Evidence::Points { .. } | Evidence::Sets { .. } => None,
    };
    condition.evidence.iter().filter_map(rank).collect()
}

/// The invariant zeros that (A3) shows.
fn zeros(condition: &Condition) -> Vec<Complex64> {
    let points = |e: &Evidence| match e {
        Evidence::Points { points, .. } => points.clone(),
        Evidence::Rank { .. } | Evidence::Sets { .. } => Vec::new(),
    };
    let points = condition.evidence.iter().flat_map(points).filter(|p| p.loses_rank);
    points.flat_map(|p| std::iter::repeat_n(p.s, p.multiplicity)).collect()
}

fn complex(m: &DMatrix<f64>) -> DMatrix<Complex64> {
    m.map(Complex64::from)
}

/// `[u; y] -> [x_hat; d_hat]` at `s`.
fn transfer(o: &LinearObserver, s: Complex64) -> DMatrix<Complex64> {
    let unit = DMatrix::<f64>::identity(o.order(), o.order());
    let inverse = unit.zip_map(&o.N, |e, a| s * e - a).try_inverse().unwrap();
    let into = complex(&side_by_side(&[&o.H, &o.L]));
    let out = complex(&stack(&[&o.P, &o.Q]));
    let direct = complex(&stack(&[&side_by_side(&[&o.W, &o.V]), &side_by_side(&[&o.S, &o.R])]));
    out * inverse * into + direct
}

#[test]
fn conditions_of_the_example_have_the_reference_ranks() {
    let reference = &reference()["conditions"];
    for order in [Order::Full, Order::General] {
        let conditions = asked(&example(), order);
        for (label, key) in [("(A1)", "A1"), ("(A2)", "A2")] {
            let condition = found(&conditions, label);
            assert_eq!(condition.verdict, Verdict::Holds, "{label}: {}", condition.summary);
            let (compressed, printed) = (ranks(condition)[0], ranks(condition)[1]);
            let expected = &reference[key];
            let number = |name: &str| usize::try_from(expected[name].as_u64().unwrap()).unwrap();
            assert_eq!((printed.0.rank, printed.1), (number("rank"), number("required")), "{label} printed");
            assert_eq!(
                (compressed.0.rank, compressed.1),
                (number("compressed_rank"), number("compressed_required")),
                "{label} compressed"
            );
            let smallest = expected["compressed_smin"].as_f64().unwrap();
            assert!((compressed.0.smallest() - smallest).abs() < 1e-9 * smallest, "{label}: {compressed:?}");
            let smallest = expected["sr"].as_f64().unwrap();
            assert!((printed.0.smallest_counted() - smallest).abs() < 1e-9, "{label}: {printed:?}");
        }
        let third = found(&conditions, "(A3)");
        assert_eq!(third.verdict, Verdict::Holds, "{}", third.summary);
        assert_eq!(zeros(third), poles(&reference["A3"]["zeros"]), "no invariant zeros");
        assert_eq!(found(&conditions, "(A1)").needed, order == Order::Full, "(A1) is the paper's form alone");
    }
}

#[test]
fn the_example_has_the_unique_matrices_of_the_reference() {
    let reference = &reference()["reference"];
    let limit = reference_file::allowed("matrix_rel");
    let design = paper_design(Order::Full);
    verified(&design);
    for (name, key) in [
        ("M", "Mt"),
        ("N", "N"),
        ("A_tilde", "At"),
        ("B_tilde", "Bt"),
        ("C_tilde", "Ct"),
        ("B2_tilde", "B2t"),
        ("W1W2_pinv", "W1W2p"),
        ("H", "H"),
        ("J1", "J1"),
        ("J2", "J2"),
        ("K", "K"),
        ("T1", "T1"),
        ("T2", "T2"),
        ("G", "G"),
        ("Q1", "Q1"),
        ("Q2", "Q2"),
    ] {
        // B~2 vanishes and has no entries above rounding
        close(design.matrix(name).unwrap(), &matrix(&reference[key]), limit, name);
    }
    let at = coordinates(&example(), &Tolerance::default()).unwrap();
    let pair = paper_reduction(&at, &Tolerance::default()).unwrap();
    for (name, value, key) in [("R1", &pair.R1, "R1"), ("R2", &pair.R2, "R2"), ("R3", &pair.R3, "R3")] {
        close(value, &matrix(&reference[key]), limit, name);
    }
    // of L only L (I - W2 W2+) is determined
    let W2 = matrix(&reference["W2"]);
    let free = DMatrix::identity(3, 3) - &W2 * matrix(&reference["W2p"]);
    let (ours, theirs) = (design.matrix("L").unwrap() * &free, matrix(&reference["L"]) * &free);
    close(&ours, &theirs, limit, "L (I - W2 W2+)");
    close(design.matrix("L").unwrap(), &ours, 1e-12, "ours has no share that has no effect");
}

#[test]
fn spectrum_and_transfer_function_are_unique() {
    let reference = reference();
    let unique = &reference["unique"];
    let design = paper_design(Order::Full);
    let expected = poles(&unique["eig_H"]);
    let distance = spectral_distance(&design.verification.spectrum, &expected);
    let largest = expected.iter().map(|z| z.norm()).fold(0.0, f64::max);
    let limit = reference_file::allowed("eig_rel_single_output") * largest;
    assert!(distance < limit, "spectrum off by {distance:.2e}");
    let placement = design.synthesis.placement().unwrap();
    assert_eq!(placement.fixed_modes, poles(&unique["fixed_unobservable_modes"]), "nothing is fixed");
    assert_eq!(placement.gain.ncols() as u64, unique["n_compressed_outputs"].as_u64().unwrap(), "one output");
    let expected = (
        complex_matrix(&unique["tf_xhat_from_u_y_at_1_3j"]),
        complex_matrix(&unique["tf_dhat_from_u_y_at_1_3j"]),
    );
    assert_eq!(unique["tf_unique"], true, "whatever the coordinates");
    let check = |observer: &LinearObserver, what: &str| {
        let value = transfer(observer, Complex64::new(0.0, 1.3));
        for (value, expected) in [(value.rows(0, 4), &expected.0), (value.rows(4, 1), &expected.1)] {
            let off = (value - expected).norm() / expected.norm();
            let limit = reference_file::allowed("tf_rel");
            assert!(off < limit, "{what}: transfer function off by {off:.2e}");
        }
    };
    check(&design.observer, "identity coordinates");
    // a combination of the equations makes E dense in rows, so that singular value coordinates are used
    let mixed = dmatrix![1.0, 2.0, 0.5; -1.0, 1.0, 1.0; 0.3, 0.0, 2.0];
    let plain = example();
    let system = DescriptorSystem {
        E: &mixed * &plain.E,
        A: &mixed * &plain.A,
        B: &mixed * &plain.B,
        D: &mixed * &plain.D,
        ..plain
    };
    let design = designed(&system, &choice(Order::Full, &[-1.0, -2.0])).unwrap();
    verified(&design);
    check(&design.observer, "after mixing the equations");
}

#[test]
fn everything_printed_agrees_except_the_sign_in_g() {
    let reference = reference();
    let printed = &reference["printed"];
    let limit = reference_file::allowed("matrix_rel");
    let design = paper_design(Order::Full);
    for (name, key) in [
        ("A_tilde", "At"),
        ("B_tilde", "Bt"),
        ("C_tilde", "Ct"),
        ("W1W2_pinv", "W1W2p"),
        ("H", "H"),
        ("J1", "J1"),
        ("J2", "J2"),
        ("K", "K"),
        ("T1", "T1"),
        ("T2", "T2"),
        ("Q1", "Q1"),
        ("Q2", "Q2"),
    ] {
        close(design.matrix(name).unwrap(), &matrix(&printed[key]), limit, name);
    }
    let at = coordinates(&example(), &Tolerance::default()).unwrap();
    assert_eq!((&at.A3, &at.B2), (&matrix(&printed["A3"]), &matrix(&printed["B2"])), "A3 and B2");

    // the printed W2+ belongs to a P that is not printed
    let P = matrix(&reference["P_printed"]);
    let wanted = dmatrix![1.0, 0.0, 0.0];
    close(&(at.algebraic() * &P), &wanted, 1e-15, "[A4 D2] P = [I 0]");
    let W1 = at.differential() * P.columns(1, 2);
    let W2 = at.measured() * P.columns(1, 2);
    let W2_pinv = pseudo_inverse(&W2, &Tolerance::default()).unwrap();
    close(&W2_pinv, &matrix(&printed["W2p"]), limit, "W2+");
    close(&(W1 * &W2_pinv), design.matrix("W1W2_pinv").unwrap(), limit, "W1 W2+ does not depend on P");
    // the printed L is one of a family
    let free = DMatrix::identity(3, 3) - W2 * W2_pinv;
    close(&(matrix(&printed["L"]) * free), design.matrix("L").unwrap(), limit, "L (I - W2 W2+)");

    // ERRATUM(001, section III): the algebraic row A3 x1 + A4 x2 + B2 u + D2 d must vanish for every z
    let x2 = design.matrix("K").unwrap().rows(2, 2).into_owned();
    let row = |G: &DMatrix<f64>| &at.A3 + &at.A4 * &x2 + &at.D2 * G;
    let ours = row(design.matrix("G").unwrap());
    assert!(ours.norm() < 1e-14, "ours: the coefficient of z is {ours}");
    close(&row(&matrix(&printed["G"])), &dmatrix![0.0, 16.0 / 3.0], 1e-14, "printed: the coefficient of z");
    close(design.matrix("G").unwrap(), &dmatrix![5.0 / 3.0, -4.0 / 3.0], 1e-14, "G");
}

/// Largest error of the estimates over all trajectories `x e^(s t)` of a plant.
fn bias(system: &DescriptorSystem, o: &LinearObserver, s: Complex64) -> (f64, f64) {
    let DescriptorSystem { E, A, B, C, D, F, .. } = system;
    let (n, k, q) = (E.ncols(), B.ncols(), D.ncols());
    let pencil = side_by_side(&[A, B, D])
        .zip_map(&side_by_side(&[E, &DMatrix::zeros(E.nrows(), k + q)]), |a, e| Complex64::from(a) - s * e);
    let found = complex_svd(&pencil).unwrap();
    let paths = found.v.columns(E.nrows(), n + k + q - E.nrows());
    let (x, u, d) = (paths.rows(0, n), paths.rows(n, k), paths.rows(n + k, q));
    let y = complex(C) * x + complex(F) * d;
    let drive =
        DMatrix::from_fn(k + y.nrows(), paths.ncols(), |i, j| if i < k { u[(i, j)] } else { y[(i - k, j)] });
    let estimate = transfer(o, s) * drive;
    ((estimate.rows(0, n) - x).norm(), (estimate.rows(n, q) - d).norm())
}

#[test]
fn the_observer_is_unbiased_for_every_unknown_input() {
    let tolerance = reference()["unbiasedness_test"]["tol"].as_f64().unwrap();
    for order in [Order::Full, Order::General] {
        let design = paper_design(order);
        for s in [Complex64::new(0.0, 1.3), Complex64::new(2.0, -0.7)] {
            let (x, d) = bias(&example(), &design.observer, s);
            assert!(x < tolerance && d < tolerance, "{order:?}: x off by {x:.1e}, d by {d:.1e}");
            assert!(x < 1e-13 && d < 1e-13, "{order:?}: x off by {x:.1e}, d by {d:.1e}");
        }
    }
}

#[test]
fn the_general_form_places_the_same_poles() {
    let design = paper_design(Order::General);
    verified(&design);
    assert!(design.title.contains("general form"), "{}", design.title);
    let expected = [-1.0, -2.0].map(Complex64::from);
    let distance = spectral_distance(&design.verification.spectrum, &expected);
    assert!(distance < 1e-9, "spectrum off by {distance:.2e}");
}

/// n = m and p = 0 in the paper's letters: square, and without unknown inputs, so that W2 has no columns.
const SQUARE_AND_QUIET: random::Size = random::Size { e: 4, n: 4, r: 3, k: 1, q: 0, p: 2 };

#[test]
fn complex_poles_are_placed_also_where_nothing_is_unknown() {
    let wide_and_quiet = random::Size { n: 5, ..SQUARE_AND_QUIET };
    for (i, size) in [SQUARE_AND_QUIET, wide_and_quiet, random::SIZES[1]].iter().enumerate() {
        let system = random::planted(size, &[], 500 + i as u64);
        let wished = [(-1.0, 2.0), (-1.0, -2.0), (-3.0, 0.0)].map(|(re, im)| Complex64::new(re, im));
        for order in [Order::Full, Order::General] {
            let choice = DesignChoice { order, poles: wished.to_vec(), ..DesignChoice::default() };
            let design = designed(&system, &choice).unwrap();
            verified(&design);
            assert_eq!(design.observer.n_estimated_inputs(), size.q, "{size:?}: no estimate of nothing");
            let off = spectral_distance(&design.verification.spectrum, &wished);
            let limit = reference_file::allowed("eig_rel_multi_output") * 5.0_f64.sqrt();
            assert!(off < limit, "{size:?} {order:?}: spectrum off by {off:.1e}");
            let (x, d) = bias(&system, &design.observer, Complex64::new(0.4, 1.1));
            assert!(x < 1e-9 && d < 1e-9, "{size:?} {order:?}: biased by {x:.1e}, {d:.1e}");
        }
    }
}

#[test]
fn a_tampered_observer_is_found_out() {
    let design = paper_design(Order::Full);
    let (system, tolerance) = (example(), Tolerance::default());
    let claim = design.claim.clone().unwrap();
    let expected = [-1.0, -2.0].map(Complex64::from);
    let failures = |observer: &LinearObserver, claim| {
        let result = verify_decoupled(&system, observer, claim, &expected, &tolerance).unwrap();
        result.failures().map(|check| check.name.clone()).collect::<Vec<_>>()
    };
    assert_eq!(failures(&design.observer, &claim), [""; 0], "as designed");
    // the printed G
    let mut wrong = design.observer.clone();
    wrong.Q[(0, 1)] = 4.0 / 3.0;
    assert_eq!(failures(&wrong, &claim), ["unbiased estimate", "unknown input decoupled"], "printed G");
    // a share of the unknown input in z: decoupled from constant d only
    let mut share = claim.clone();
    share.T[(0, 3)] = 1.0;
    assert!(failures(&design.observer, &share).contains(&"unknown input not tracked".to_owned()), "d in T");
    let mut wrong = design.observer.clone();
    wrong.L[(1, 2)] += 1e-3;
    let found = failures(&wrong, &claim);
    assert!(found.contains(&"unknown input decoupled".to_owned()), "J2 off by 1e-3: {found:?}");
}

#[test]
fn discrete_time_is_designed_with_poles_in_the_unit_disk() {
    let system = DescriptorSystem { time: TimeDomain::Discrete, ..example() };
    for order in [Order::Full, Order::General] {
        verified(&designed(&system, &choice(order, &[0.5, -0.25])).unwrap());
    }
    // a zero outside the unit disk, though in the left half plane
    let planted = random::planted(&random::SIZES[0], &[-1.5], 3);
    let discrete = DescriptorSystem { time: TimeDomain::Discrete, ..planted.clone() };
    assert_eq!(found(&asked(&planted, Order::Full), "(A3)").verdict, Verdict::Holds, "stable: Re s < 0");
    assert_eq!(found(&asked(&discrete, Order::Full), "(A3)").verdict, Verdict::Fails, "not stable: |z| > 1");
}

#[test]
fn planted_stable_zeros_are_fixed_modes_of_every_design() {
    for (i, size) in random::SIZES.iter().enumerate() {
        for planted in [&[-1.5][..], &[-0.4, -3.0]] {
            let planted = &planted[..planted.len().min(size.r)];
            let system = random::planted(size, planted, i as u64);
            let expected: Vec<Complex64> = planted.iter().copied().map(Complex64::from).collect();
            for order in [Order::Full, Order::General] {
                let conditions = asked(&system, order);
                for condition in &conditions {
                    assert!(condition.verdict.holds(), "{size:?} {}: {}", condition.label, condition.summary);
                }
                let shown = zeros(found(&conditions, "(A3)"));
                let off = spectral_distance(&shown, &expected);
                assert!(off < 1e-7, "{size:?} {order:?}: zeros {shown:?} instead of {planted:?}");
                let free: Vec<f64> = (0..size.r - planted.len()).map(|k| -1.0 - 0.5 * k as f64).collect();
                let design = designed(&system, &choice(order, &free)).unwrap();
                verified(&design);
                let fixed = &design.synthesis.placement().unwrap().fixed_modes;
                assert!(spectral_distance(fixed, &expected) < 1e-7, "{size:?}: fixed modes {fixed:?}");
            }
        }
    }
}

#[test]
fn a_planted_unstable_zero_fails_the_third_condition_with_a_witness() {
    for (i, size) in random::SIZES.iter().enumerate() {
        for planted in [0.7, 0.0] {
            let system = random::planted(size, &[planted], 100 + i as u64);
            let conditions = asked(&system, Order::Full);
            let third = found(&conditions, "(A3)");
            assert_eq!(third.verdict, Verdict::Fails, "{size:?} {planted}: {}", third.summary);
            let witness = third.witness.as_ref().unwrap();
            let (s, n) = (witness.s.unwrap(), system.n_states());
            assert!((s - planted).norm() < 1e-8, "at {s} instead of {planted}");
            assert_eq!(witness.coordinates.len(), n + system.n_unknown_inputs(), "x and d");
            let direction = DVector::from_column_slice(&witness.direction);
            let (x, d) = (direction.rows(0, n), direction.rows(n, system.n_unknown_inputs()));
            let pencil = system.A.zip_map(&system.E, |a, e| Complex64::from(a) - s * e);
            let residual = (pencil * x + complex(&system.D) * d).norm()
                + (complex(&system.C) * x + complex(&system.F) * d).norm();
            assert!(residual < 1e-8, "(A - s E) x + D d = 0, C x + F d = 0: {residual:.1e}");
            assert!(!third.remedies.is_empty(), "sensors are proposed");
            let error = designed(&system, &choice(Order::Full, &[-1.0; 9])).unwrap_err();
            assert!(matches!(error, DesignError::Condition { ref id, .. } if id == "001-A3"), "{error}");
        }
    }
}

#[test]
fn zeros_of_the_pair_are_those_of_the_rectangular_pencil() {
    for (i, size) in random::SIZES.iter().enumerate() {
        let system = random::planted(size, &[-0.8], 200 + i as u64);
        let DescriptorSystem { E, A, C, D, F, .. } = &system;
        let q = D.ncols();
        let a = stack(&[&side_by_side(&[A, D]), &side_by_side(&[C, F])]);
        let wide = side_by_side(&[E, &DMatrix::zeros(E.nrows(), q)]);
        let e = stack(&[&wide, &DMatrix::zeros(C.nrows(), E.ncols() + q)]);
        let pencil = rank_drop_points(&a, &e, &Tolerance::default()).unwrap();
        let expected: Vec<Complex64> = pencil.points().iter().map(|p| p.s).collect();
        for order in [Order::Full, Order::General] {
            let shown = zeros(found(&asked(&system, order), "(A3)"));
            let off = spectral_distance(&shown, &expected);
            assert!(off < 1e-7, "{size:?}: {shown:?} by the pair, {expected:?} by the pencil");
        }
    }
}

#[test]
fn both_forms_differ_by_output_injection_alone() {
    for (i, size) in random::SIZES.iter().enumerate() {
        let system = random::planted(size, &[], 300 + i as u64);
        let at = coordinates(&system, &Tolerance::default()).unwrap();
        let paper = paper_reduction(&at, &Tolerance::default()).unwrap();
        let general = general_reduction(&at, &Tolerance::default()).unwrap();
        let difference = &paper.A - &general.A;
        let C_pinv = pseudo_inverse(&paper.C, &Tolerance::default()).unwrap();
        let left = (&difference - &difference * C_pinv * &paper.C).norm();
        assert!(left < 1e-9 * (1.0 + paper.A.norm()), "{size:?}: A differs by more than X C: {left:.1e}");
        let wished: Vec<f64> = (0..size.r).map(|k| -1.0 - 0.5 * k as f64).collect();
        for order in [Order::Full, Order::General] {
            let found = designed(&system, &choice(order, &wished)).unwrap();
            verified(&found);
            let expected: Vec<Complex64> = wished.iter().copied().map(Complex64::from).collect();
            let spectrum = eigenvalues(&found.observer.N).unwrap();
            let off = spectral_distance(&spectrum, &expected);
            assert!(off < 1e-6, "{size:?} {order:?}: spectrum off by {off:.1e}");
        }
    }
}

#[test]
fn the_general_form_exists_where_the_first_condition_fails() {
    for seed in 0..10 {
        let system = random::without_a1(seed);
        let conditions = asked(&system, Order::Full);
        let first = found(&conditions, "(A1)");
        assert_eq!(first.verdict, Verdict::Fails, "{}", first.summary);
        assert!(
            first.remedies[0].contains("it exists"),
            "the general form is proposed: {:?}",
            first.remedies
        );
        // a combination of equations without algebraic states and unknown inputs
        let witness = first.witness.as_ref().unwrap();
        assert!(witness.coordinates[0] == "equation 1", "{witness:?}");
        let w = DVector::from_iterator(witness.direction.len(), witness.direction.iter().map(|z| z.re));
        let null = descry::numerics::null_space(&system.E, 0.0, &Tolerance::default()).unwrap();
        let seen = (system.E.tr_mul(&w)).norm()
            + (w.transpose() * &system.A * null).norm()
            + (system.D.tr_mul(&w)).norm();
        assert!(seen < 1e-12, "w' E = 0, w' A V2 = 0, w' D = 0: {seen:.1e}");
        let error = designed(&system, &choice(Order::Full, &[-1.0, -2.0, -3.0])).unwrap_err();
        assert!(error.to_string().starts_with("condition (A1) does not hold"), "{error}");
        let design = designed(&system, &choice(Order::General, &[-1.0, -2.0, -3.0])).unwrap();
        verified(&design);
        let (x, d) = bias(&system, &design.observer, Complex64::new(0.4, 1.1));
        assert!(x < 1e-9 && d < 1e-9, "unbiased all the same: {x:.1e}, {d:.1e}");
    }
}

#[test]
fn the_second_condition_fails_without_an_output_and_names_sensors() {
    let mut system = example();
    system.C = system.C.rows(0, 1).into_owned();
    system.F = system.F.rows(0, 1).into_owned();
    let conditions = asked(&system, Order::Full);
    let second = found(&conditions, "(A2)");
    assert_eq!(second.verdict, Verdict::Fails, "three unknowns, two equations: {}", second.summary);
    assert!(
        second.remedies[0].contains("at least 2 outputs are needed, there is 1"),
        "{:?}",
        second.remedies
    );
    assert!(second.remedies[1..].iter().any(|r| r.starts_with("measure x4")), "{:?}", second.remedies);
    let direction: Vec<f64> = second.witness.as_ref().unwrap().direction.iter().map(|z| z.re).collect();
    let (x, d) = (DVector::from_column_slice(&direction[..4]), DVector::from_column_slice(&direction[4..]));
    let unseen = (&system.E * &x).norm()
        + (system.A.rows(2, 1) * &x + system.D.rows(2, 1) * &d).norm()
        + (&system.C * &x + &system.F * &d).norm();
    assert!(unseen < 1e-14, "E x = 0, the algebraic row and the output do not see it: {unseen:.1e}");
    let third = found(&conditions, "(A3)");
    assert_eq!(third.verdict, Verdict::Fails, "rank 4 < 5 for every s: {}", third.summary);
    assert!(third.summary.contains("for every s"), "{}", third.summary);
    // with the proposed sensor it holds
    system.C = stack(&[&system.C, &dmatrix![0.0, 0.0, 0.0, 1.0]]);
    system.F = stack(&[&system.F, &dmatrix![0.0]]);
    assert_eq!(found(&asked(&system, Order::Full), "(A2)").verdict, Verdict::Holds, "mended");
}

#[test]
fn decisions_near_the_threshold_are_fragile() {
    // algebraic row 0 = x1 + a x2 + a d with one output that sees x2 and one that sees d
    let system = |a: f64| DescriptorSystem {
        time: TimeDomain::Continuous,
        E: dmatrix![1.0, 0.0; 0.0, 0.0],
        A: dmatrix![-1.0, 1.0; 1.0, a],
        B: DMatrix::zeros(2, 0),
        C: dmatrix![1.0, 1.0; 1.0, 0.0],
        D: dmatrix![0.0; a],
        F: dmatrix![0.0; 1.0],
    };
    for (a, verdict) in [
        (1.0, Verdict::Holds),
        (1e-8, Verdict::Holds),
        (2e-14, Verdict::Fragile),
        (1e-18, Verdict::Fails),
        (0.0, Verdict::Fails),
    ] {
        let conditions = asked(&system(a), Order::Full);
        let first = found(&conditions, "(A1)");
        assert_eq!(first.verdict, verdict, "A4 = D2 = {a:e}: {}", first.summary);
    }
    // the same for (A2): the outputs see d by f alone
    let second = |f: f64| DescriptorSystem { F: dmatrix![0.0; f], D: dmatrix![0.0; 0.0], ..system(1.0) };
    for (f, verdict) in
        [(1.0, Verdict::Holds), (1e-8, Verdict::Holds), (2e-14, Verdict::Fragile), (1e-18, Verdict::Fails)]
    {
        let conditions = asked(&second(f), Order::Full);
        let found = found(&conditions, "(A2)");
        assert_eq!(found.verdict, verdict, "F = {f:e}: {}", found.summary);
    }
}

#[test]
fn more_equations_than_unknowns_need_the_general_form() {
    // e = 3 > n + q = 2: x1' = -x1, 0 = x1 - x2, 0 = 2 x1 - 2 x2
    let system = DescriptorSystem {
        time: TimeDomain::Continuous,
        E: dmatrix![1.0, 0.0; 0.0, 0.0; 0.0, 0.0],
        A: dmatrix![-1.0, 0.0; 1.0, -1.0; 2.0, -2.0],
        B: DMatrix::zeros(3, 0),
        C: dmatrix![1.0, 0.0],
        D: DMatrix::zeros(3, 0),
        F: DMatrix::zeros(1, 0),
    };
    let conditions = asked(&system, Order::Full);
    let first = found(&conditions, "(A1)");
    assert_eq!(first.verdict, Verdict::Fails, "{}", first.summary);
    assert!(first.summary.contains("m = 3 equations for n + p = 2"), "{}", first.summary);
    assert!(first.remedies[0].contains("general form"), "{:?}", first.remedies);
    verified(&designed(&system, &choice(Order::General, &[-3.0])).unwrap());
}

#[test]
fn no_rank_and_full_rank_of_e_are_designed_and_noted() {
    // rank E = 0: two algebraic equations, x and d follow from y at once
    let system = DescriptorSystem {
        time: TimeDomain::Continuous,
        E: DMatrix::zeros(1, 2),
        A: dmatrix![1.0, 2.0],
        B: dmatrix![1.0],
        C: dmatrix![1.0, 0.0; 0.0, 1.0],
        D: dmatrix![1.0],
        F: dmatrix![0.0; 0.0],
    };
    for order in [Order::Full, Order::General] {
        let design = designed(&system, &choice(order, &[])).unwrap();
        verified(&design);
        assert_eq!(design.observer.order(), 0, "a static estimate");
        assert!(design.notes.iter().any(|note| note.starts_with("rank E = 0")), "{:?}", design.notes);
    }
    // rank E = m < n: no algebraic equation, one free state; rank E = m = n: an ordinary system
    let wide = DescriptorSystem {
        E: dmatrix![1.0, 0.0],
        A: dmatrix![1.0, 1.0],
        B: dmatrix![1.0],
        C: dmatrix![1.0, 0.0; 0.0, 1.0; 1.0, 1.0],
        D: dmatrix![0.5],
        F: dmatrix![0.0; 1.0; 0.0],
        ..system
    };
    let ordinary = DescriptorSystem {
        E: dmatrix![1.0, 0.0; 0.0, 1.0],
        A: dmatrix![0.0, 1.0; 2.0, 1.0],
        B: dmatrix![0.0; 1.0],
        C: dmatrix![1.0, 0.0; 0.0, 1.0],
        D: dmatrix![0.0; 1.0],
        F: dmatrix![0.0; 1.0],
        ..wide.clone()
    };
    for system in [wide, ordinary] {
        for order in [Order::Full, Order::General] {
            let design = designed(&system, &choice(order, &[-1.0, -2.0])).unwrap();
            verified(&design);
            assert!(design.notes.iter().any(|note| note.contains("the paper assumes")), "{:?}", design.notes);
        }
    }
}

#[test]
fn unsuitable_data_are_refused_in_words() {
    let error = designed(&example(), &choice(Order::Reduced, &[-1.0, -2.0])).unwrap_err();
    assert!(error.to_string().contains("has one order, rank E, and no reduced order"), "{error}");
    let error = designed(&example(), &choice(Order::Full, &[-1.0])).unwrap_err();
    assert_eq!(error, DesignError::TooFewPoles { given: 1, needed: 2 }, "one pole is missing");
    let mut model: Model = example().into();
    model.lipschitz = Some(LipschitzTerm {
        G: DMatrix::zeros(3, 0),
        F_L: DMatrix::zeros(0, 4),
        f: Vec::new(),
        constant: 1.0,
    });
    let error = design(&model, &choice(Order::Full, &[-1.0, -2.0]), &[], &Tolerance::default()).unwrap_err();
    assert!(error.to_string().contains("does not take a Lipschitz term"), "{error}");
    let mut system = example();
    system.F = DMatrix::zeros(3, 2);
    let error = conditions(&system.into(), &choice(Order::Full, &[]), &Tolerance::default()).unwrap_err();
    assert!(error.to_string().starts_with("F is 3 x 2, but 3 x 1 is needed"), "{error}");
}
