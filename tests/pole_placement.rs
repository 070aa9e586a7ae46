//! Pole placement judged by eigenvalues and, without rounding, by exact arithmetic on the gain as it is stored.

#![cfg(not(target_arch = "wasm32"))]

mod exact;

use descry::numerics::{
    Complex64, NumericsError, Placement, PlacementError, PlacementMethod, PlacementOptions, PlacementWarning,
    Random, Tolerance, eigenvalues, observable_quotient, place_observer, spectral_distance,
};
use exact::{Root, pole_error};
use nalgebra::{DMatrix, dmatrix};
use proptest::prelude::*;
use proptest::test_runner::RngSeed;

fn place(a: &DMatrix<f64>, c: &DMatrix<f64>, poles: &[Complex64]) -> Result<Placement, PlacementError> {
    place_observer(a, c, poles, &PlacementOptions::default(), &Tolerance::default())
}

fn real(poles: &[f64]) -> Vec<Complex64> {
    poles.iter().map(|p| Complex64::from(*p)).collect()
}

fn largest(poles: &[Complex64]) -> f64 {
    poles.iter().map(|z| z.norm()).fold(0.0, f64::max)
}

/// Largest exact pole error relative to the largest pole; equal neighbours in the list count as a double root.
fn exact_error(a: &DMatrix<f64>, c: &DMatrix<f64>, gain: &DMatrix<f64>, poles: &[Complex64]) -> f64 {
    let error = |pole: &Complex64| {
        let times = poles.iter().filter(|z| *z == pole).count();
        pole_error(a, gain, c, *pole, if times == 2 { Root::Double } else { Root::Simple })
    };
    poles.iter().map(error).fold(0.0, f64::max) / largest(poles)
}

#[derive(serde::Deserialize)]
struct Case {
    name: String,
    #[serde(rename = "A")]
    a: Vec<Vec<f64>>,
    #[serde(rename = "B")]
    b: Vec<Vec<f64>>,
    poles: Vec<(f64, f64)>,
}

type ObserverProblem = (String, DMatrix<f64>, DMatrix<f64>, Vec<Complex64>);

/// The control problems (A, B) as observer problems (A', B').
#[expect(clippy::unwrap_used, reason = "the file is part of the repository")]
fn published_cases() -> Vec<ObserverProblem> {
    let cases: Vec<Case> = serde_json::from_str(include_str!("reference/pole_placement.json")).unwrap();
    let transposed = |rows: &[Vec<f64>]| DMatrix::from_fn(rows[0].len(), rows.len(), |i, j| rows[j][i]);
    let poles = |case: &Case| case.poles.iter().map(|&(re, im)| Complex64::new(re, im)).collect();
    cases
        .iter()
        .map(|case| (case.name.clone(), transposed(&case.a), transposed(&case.b), poles(case)))
        .collect()
}

#[test]
fn published_cases_are_placed_as_well_as_their_data_allow() {
    let cases = published_cases();
    assert_eq!(cases.len(), 8, "all published cases");
    for (name, a, c, poles) in cases {
        let found = place(&a, &c, &poles).unwrap();
        let exact = exact_error(&a, &c, &found.gain, &poles);
        println!(
            "{name}: exact {exact:.1e}, eigenvalues {:?}, expected {:.1e}, condition {:.1e}, {:?}",
            found.relative_error, found.expected_accuracy, found.condition, found.warnings
        );
        let hard_limit = match name.split_whitespace().next() {
            Some("Laub") => Some(2e-9),
            Some("Chow-Kokotovic") => Some(5e-3),
            _ => None,
        };
        if let Some(limit) = hard_limit {
            assert!(exact < limit, "{name}: exact error {exact:e}");
            let ratio = found.expected_accuracy / exact;
            assert!((0.1..10.0).contains(&ratio), "{name}: expected {:e}", found.expected_accuracy);
            let warned = found.warnings.iter().any(|w| matches!(w, PlacementWarning::IllConditioned { .. }));
            assert!(warned, "{name} is ill-conditioned: {:?}", found.warnings);
        } else {
            assert!(exact < 1e-10, "{name}: exact error {exact:e}");
            assert!(found.relative_error.is_some_and(|e| e < 1e-10), "{name}: {:?}", found.relative_error);
            assert_eq!(found.warnings, [], "{name} is well conditioned");
        }
    }
}

fn gaussian(random: &mut Random, rows: usize, columns: usize) -> DMatrix<f64> {
    DMatrix::from_fn(rows, columns, |_, _| random.normal())
}

/// Distinct poles in the left half plane, some of them in pairs.
fn spread_poles(random: &mut Random, n: usize) -> Vec<Complex64> {
    let mut poles = Vec::new();
    while poles.len() < n {
        let re = -1.0 - 0.5 * poles.len() as f64 - 0.3 * random.uniform();
        if poles.len() + 2 <= n && random.uniform() < 0.4 {
            let z = Complex64::new(re, 0.5 + random.uniform());
            poles.extend([z, z.conj()]);
        } else {
            poles.push(Complex64::from(re));
        }
    }
    poles
}

fn config() -> ProptestConfig {
    ProptestConfig {
        cases: 60,
        rng_seed: RngSeed::Fixed(17),
        failure_persistence: None,
        ..ProptestConfig::default()
    }
}

proptest! {
    #![proptest_config(config())]

    #[test]
    fn random_pairs_are_placed(seed in any::<u64>(), n in 2_usize..=8, p in 1_usize..=3) {
        let mut random = Random::new(seed);
        let (a, c) = (gaussian(&mut random, n, n), gaussian(&mut random, p.min(n), n));
        let poles = spread_poles(&mut random, n);
        let found = place(&a, &c, &poles).unwrap();
        let exact = exact_error(&a, &c, &found.gain, &poles);
        let allowed = 1e-10_f64.max(100.0 * found.expected_accuracy);
        prop_assert!(exact < allowed, "n {}, p {}: exact {:e}, expected {:e}", n, p, exact, found.expected_accuracy);
        if found.warnings.is_empty() {
            prop_assert!(found.relative_error.unwrap() < if n <= 6 { 1e-6 } else { 1e-3 }, "{:?}", found);
        }
        prop_assert_eq!(found.achieved.len() == n, found.relative_error.is_some(), "a measure needs eigenvalues");
    }

    #[test]
    fn poles_repeated_within_the_outputs_are_exact(seed in any::<u64>(), n in 4_usize..=8, p in 2_usize..=3) {
        let mut random = Random::new(seed);
        let (a, c) = (gaussian(&mut random, n, n), gaussian(&mut random, p, n));
        let mut poles = spread_poles(&mut random, n - p);
        poles.extend(vec![Complex64::from(-0.7); p]);
        let found = place(&a, &c, &poles).unwrap();
        prop_assert!(found.condition < 1e6, "independent eigenvectors exist: {:e}", found.condition);
        prop_assert!(found.relative_error.unwrap() < 1e-8, "{:?}", found);
        prop_assert_eq!(found.warnings, vec![]);
    }

    #[test]
    fn poles_repeated_beyond_the_outputs_are_split(seed in any::<u64>(), p in 2_usize..=3, extra in 1_usize..=2) {
        let mut random = Random::new(seed);
        let n = p + extra;
        let (a, c) = (gaussian(&mut random, n, n), gaussian(&mut random, p, n));
        let found = place(&a, &c, &vec![Complex64::from(-2.0); n]).unwrap();
        let assigned = found.warnings.iter().find_map(|w| match w {
            PlacementWarning::SplitRepeatedPoles { assigned, .. } => Some(assigned.clone()),
            _ => None,
        });
        let assigned = assigned.expect("the split is reported");
        prop_assert!(assigned.iter().all(|z| (z + 2.0).norm() <= 2.001e-3), "{:?}", assigned);
        prop_assert!(spectral_distance(&found.achieved, &assigned) < 1e-6, "{:?}", found);
    }

    #[test]
    fn duplicate_outputs_change_nothing(seed in any::<u64>(), n in 2_usize..=5, p in 1_usize..=2) {
        let mut random = Random::new(seed);
        let (a, c) = (gaussian(&mut random, n, n), gaussian(&mut random, p.min(n), n));
        let doubled = DMatrix::from_fn(2 * c.nrows(), n, |i, j| c[(i / 2, j)]);
        let poles = spread_poles(&mut random, n);
        let found = place(&a, &doubled, &poles).unwrap();
        prop_assert!(found.relative_error.unwrap() < 1e-6, "{:?}", found);
        for k in 0..c.nrows() {
            let difference = found.gain.column(2 * k) - found.gain.column(2 * k + 1);
            prop_assert!(difference.norm() <= 1e-9 * found.gain.norm(), "equal sensors get equal weights");
        }
    }

    #[test]
    fn present_eigenvalues_can_be_kept(seed in any::<u64>(), n in 2_usize..=7, p in 2_usize..=3) {
        let mut random = Random::new(seed);
        let (a, c) = (gaussian(&mut random, n, n), gaussian(&mut random, p.min(n), n));
        let poles = eigenvalues(&a).unwrap();
        let found = place(&a, &c, &poles).unwrap();
        prop_assert!(found.relative_error.unwrap() < 1e-9, "{:?}", found);
    }

    #[test]
    fn sparse_data_with_any_structure_are_placed(seed in any::<u64>(), n in 1_usize..=6, p in 1_usize..=3) {
        let mut random = Random::new(seed);
        let mut sparse = |rows: usize| DMatrix::from_fn(rows, n, |_, _| match random.uniform() {
            u if u < 0.2 => 1.0,
            u if u < 0.35 => -1.0,
            _ => 0.0,
        });
        let (a, c) = (sparse(n), sparse(p));
        let seen = observable_quotient(&a, &c, &Tolerance::default()).unwrap().basis.ncols();
        let poles = spread_poles(&mut random, seen);
        let found = place(&a, &c, &poles).unwrap();
        prop_assert_eq!(found.fixed_modes.len(), n - seen);
        prop_assert_eq!(found.gain.shape(), (n, p));
        let allowed = 1e-8_f64.max(1e-11 * found.condition);
        prop_assert!(found.relative_error.is_none_or(|e| e < allowed), "{:?}", found);
        if seen == n && found.relative_error.is_none() {
            let exact = exact_error(&a, &c, &found.gain, &poles);
            prop_assert!(exact < 1e-9_f64.max(100.0 * found.expected_accuracy), "exact {:e}: {:?}", exact, found);
        }
    }

    #[test]
    fn unobservable_modes_stay(seed in any::<u64>(), seen in 1_usize..=5, hidden in 1_usize..=3, p in 1_usize..=3) {
        let mut random = Random::new(seed);
        let n = seen + hidden;
        let mut a = gaussian(&mut random, n, n);
        a.view_mut((hidden, 0), (seen, hidden)).fill(0.0);
        let mut c = gaussian(&mut random, p, n);
        c.columns_mut(0, hidden).fill(0.0);
        let fixed = eigenvalues(&a.view((0, 0), (hidden, hidden)).into_owned()).unwrap();
        let q = gaussian(&mut random, n, n).qr().q();
        let (a, c) = (&q * a * q.transpose(), c * q.transpose());

        let poles = spread_poles(&mut random, seen);
        let found = place(&a, &c, &poles).unwrap();
        prop_assert!(spectral_distance(&found.fixed_modes, &fixed) < 1e-6, "{:?} and {:?}", found.fixed_modes, fixed);
        let allowed = 1e-8_f64.max(1e-11 * found.condition);
        prop_assert!(found.relative_error.unwrap() < allowed, "{:?}", found);
        let all: Vec<Complex64> = poles.iter().chain(&fixed).copied().collect();
        let spectrum = eigenvalues(&(&a - &found.gain * &c)).unwrap();
        prop_assert!(spectral_distance(&spectrum, &all) < 10.0 * allowed * largest(&all), "{:?} and {:?}", spectrum, all);

        let error = place(&a, &c, &spread_poles(&mut random, n)).unwrap_err();
        prop_assert!(
            matches!(&error, PlacementError::PoleCount { needed, .. } if *needed == seen),
            "{} poles are needed: {}", seen, error
        );
    }
}

#[test]
fn deadbeat_poles_of_a_chain_are_exact() {
    for n in 1..=6 {
        // companion form: y = x_n, characteristic polynomial s^n - 1 - 2 s - 3 s^2 ...
        let a =
            DMatrix::from_fn(
                n,
                n,
                |i, j| {
                    if j + 1 == n { (i + 1) as f64 } else { f64::from(u8::from(i == j + 1)) }
                },
            );
        let c = DMatrix::from_fn(1, n, |_, j| f64::from(u8::from(j + 1 == n)));
        let found = place(&a, &c, &vec![Complex64::ZERO; n]).unwrap();
        let closed = &a - &found.gain * &c;
        assert_eq!(
            closed.pow(u32::try_from(n).unwrap()),
            DMatrix::zeros(n, n),
            "n = {n}: dead after n steps"
        );
        assert_eq!(found.method, PlacementMethod::SingleOutput, "one output");
    }
}

#[test]
fn deadbeat_poles_of_full_data_are_nilpotent_to_rounding() {
    let mut random = Random::new(5);
    for n in 2..=6 {
        let (a, c) = (gaussian(&mut random, n, n), gaussian(&mut random, 1, n));
        let found = place(&a, &c, &vec![Complex64::ZERO; n]).unwrap();
        let closed = &a - &found.gain * &c;
        let power =
            closed.pow(u32::try_from(n).unwrap()).norm() / closed.norm().powi(i32::try_from(n).unwrap());
        assert!(power < 1e-13, "n = {n}: (A - L C)^n = {power:e}");
    }
}

#[test]
fn invertible_output_is_solved_directly() {
    let mut random = Random::new(6);
    let (a, c) = (gaussian(&mut random, 4, 4), gaussian(&mut random, 4, 4));
    let poles = [real(&[-2.0, -2.0]), vec![Complex64::new(-2.0, 1.0), Complex64::new(-2.0, -1.0)]].concat();
    let found = place(&a, &c, &poles).unwrap();
    assert_eq!((found.method, found.condition), (PlacementMethod::Direct, 1.0), "orthogonal eigenvectors");
    assert!(found.relative_error.unwrap() < 1e-13, "{found:?}");
}

#[test]
fn structured_chain_may_be_longer_than_rounding_sees() {
    let (_, a, c, poles) = published_cases().swap_remove(6);
    let shorter = place(&a, &c, &poles[1..]).unwrap_err();
    assert!(
        matches!(shorter, PlacementError::PoleCount { .. }),
        "neither 10 nor the modes seen by PBH: {shorter}"
    );
}

#[test]
fn repetition_that_rosenbrock_forbids_is_split() {
    // observability indices 3 and 1: two double poles with independent eigenvectors would need 2 and 2
    let a = dmatrix![0.0, 1.0, 0.0, 0.0; 0.0, 0.0, 1.0, 0.0; 0.0, 0.0, 0.0, 0.0; 0.0, 0.0, 0.0, 0.0];
    let c = dmatrix![1.0, 0.0, 0.0, 0.0; 0.0, 0.0, 0.0, 1.0];
    let found = place(&a, &c, &real(&[-1.0, -1.0, -2.0, -2.0])).unwrap();
    assert!(
        matches!(found.warnings[0], PlacementWarning::SplitRepeatedPoles { outputs: 2, .. }),
        "{found:?}"
    );
    assert!(found.relative_error.unwrap() < 2e-3, "moved by a thousandth: {found:?}");
}

#[test]
fn wrong_lists_are_refused_with_what_is_needed() {
    let (a, c) = (dmatrix![0.0, 1.0; 0.0, 0.0], dmatrix![1.0, 0.0]);
    let count = place(&a, &c, &real(&[-1.0])).unwrap_err();
    assert!(matches!(count, PlacementError::PoleCount { found: 1, needed: 2, .. }), "{count}");
    let hidden =
        place(&dmatrix![-1.0, 0.0; 0.0, -2.0], &dmatrix![1.0, 0.0], &real(&[-3.0, -4.0])).unwrap_err();
    let message = "the list of poles has 2 entries, 1 needed: one for each of 2 modes except those that the outputs do not see \
                   (-2.0000)";
    assert_eq!(hidden.to_string(), message, "the message says which mode cannot be placed");
    let lone = [Complex64::new(-1.0, 1.0), Complex64::from(-1.0)];
    let lone = place(&a, &c, &lone).unwrap_err();
    assert!(matches!(lone, PlacementError::Numerics(NumericsError::NotConjugate { .. })), "{lone}");
    let infinite = place(&a, &c, &real(&[-1.0, f64::NEG_INFINITY])).unwrap_err();
    assert!(matches!(infinite, PlacementError::PoleNotFinite { index: 1, .. }), "{infinite}");
    let shape = place(&a, &dmatrix![1.0], &real(&[-1.0, -2.0])).unwrap_err();
    assert!(matches!(shape, PlacementError::Numerics(NumericsError::Shape { .. })), "{shape}");
    let nan = place(&dmatrix![f64::NAN, 1.0; 0.0, 0.0], &c, &real(&[-1.0, -2.0])).unwrap_err();
    assert!(matches!(nan, PlacementError::Numerics(NumericsError::NotFinite { .. })), "{nan}");
}

#[test]
fn nothing_to_place_is_a_zero_gain() {
    let found = place(&dmatrix![-1.0, 2.0; 0.0, -3.0], &DMatrix::zeros(2, 2), &[]).unwrap();
    assert_eq!(found.gain, DMatrix::zeros(2, 2), "no output, no correction");
    assert_eq!((found.method, found.fixed_modes.len()), (PlacementMethod::NothingToPlace, 2), "{found:?}");
    let empty = place(&DMatrix::zeros(0, 0), &DMatrix::zeros(1, 0), &[]).unwrap();
    assert_eq!(empty.gain.shape(), (0, 1), "no states");
}

#[test]
fn same_seed_gives_the_same_gain() {
    let (_, a, c, poles) = published_cases().swap_remove(1);
    assert_eq!(place(&a, &c, &poles).unwrap(), place(&a, &c, &poles).unwrap(), "no hidden state");
}
