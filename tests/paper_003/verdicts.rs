//! Verdicts where eigenvalues are multiple or defective, where something is missing, and where it is too much.

#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

use super::*;
use descry::document::{PlantData, read_document};

fn of_document(text: &str) -> Network {
    let PlantData::Network(data) = read_document(text).unwrap().plant else { unreachable!("a network") };
    data.network().unwrap()
}

/// A directed ring of nine whose output sees all harmonics but the first, with a mode that all blocks share.
fn ring_of_nine() -> Network {
    let angle = |k: usize, j: usize| 2.0 * std::f64::consts::PI * (k * j) as f64 / 9.0;
    let Psi = DMatrix::from_fn(7, 9, |i, j| match i {
        0 => 1.0,
        i if i % 2 == 1 => angle(i.div_ceil(2) + 1, j).cos(),
        i => angle(i.div_ceil(2) + 1, j).sin(),
    });
    let entries = (0..9).map(|i| (i, (i + 1) % 9, 3.0)).collect();
    Network {
        a: dmatrix![-1.0, 0.0; 0.0, -0.5],
        b: dmatrix![1.0; 0.0],
        c: dmatrix![1.0, 1.0],
        Gamma: CouplingMatrix::Sparse { rows: 9, columns: 9, entries },
        Psi,
        c_G: dmatrix![1.0, 1.0],
        c_L: DMatrix::identity(2, 2),
        local: vec![0],
    }
    .checked()
    .unwrap()
}

#[test]
fn a_mode_that_all_blocks_share_hides_no_other_mode_of_a_complex_block() {
    let found = conditions(&ring_of_nine(), &tolerance()).unwrap();
    let global = find(&found, "003-P1-global");
    assert_eq!(global.verdict, Verdict::Fails, "{}", global.summary);
    // -1 + 3 exp(2 pi i / 9)
    let s = global.witness.as_ref().unwrap().s.unwrap();
    assert!(
        (s.re - 1.298_133).abs() < 1e-5 && (s.im.abs() - 1.928_363).abs() < 1e-5,
        "the first harmonic: {s}"
    );
    assert_eq!(find(&found, "003-T2-i").verdict, Verdict::Fails, "it is the coupling that is not seen");
}

#[test]
fn a_defective_mode_that_is_hidden_is_found() {
    let network = of_document(include_str!("../documents/003-defective-whole.json"));
    let found = conditions(&network, &tolerance()).unwrap();
    let global = find(&found, "003-P1-global");
    assert_eq!(global.verdict, Verdict::Fails, "the mode 0.3 is hidden: {}", global.summary);
    let s = global.witness.as_ref().unwrap().s.unwrap();
    assert!((s - 0.3).norm() < 1e-6, "{s}");
}

#[test]
fn a_defective_block_fails_condition_ii_as_the_whole_does() {
    let network = of_document(include_str!("../documents/003-defective-block.json"));
    let hierarchy = Hierarchy::of(&network, &tolerance()).unwrap();
    let whole = pbh_modes(&hierarchy.alpha_z(), &hierarchy.gamma_z(), &tolerance()).unwrap();
    assert!(whole.iter().any(|mode| mode.unobservable), "the whole is not observable");
    let found = conditions(&network, &tolerance()).unwrap();
    let second = find(&found, "003-T2-ii");
    assert_eq!(second.verdict, Verdict::Fails, "{}", second.summary);
}

#[test]
fn what_a_block_hides_is_told_by_lambda_and_mode() {
    let network = of_document(include_str!("../documents/003-defective-block.json"));
    let found = conditions(&network, &tolerance()).unwrap();
    let second = find(&found, "003-T2-ii");
    assert_eq!(second.evidence.len(), 2, "one list for each of two lambda");
    for evidence in &second.evidence {
        let Evidence::Points { of, points } = evidence else { unreachable!("points") };
        assert!(of.contains("at lambda = ") && !points.is_empty(), "{of}");
        for point in points {
            assert_eq!(point.stable, point.s.re < -1e-9, "stable is said of the mode: {point:?}");
        }
    }
}

#[test]
fn theta_sets_are_evidence() {
    let found = conditions(&network(), &tolerance()).unwrap();
    let sets = find(&found, "003-T2-iii").evidence.iter().find_map(|evidence| match evidence {
        Evidence::Sets { names, sets, .. } => Some((names, sets)),
        _ => None,
    });
    let (names, sets) = sets.unwrap();
    assert_eq!(names, &["pi", "Theta_pi", "V_pi"]);
    let of = |pi: f64| sets.iter().find(|set| (set.element - pi).norm() < 1e-9).unwrap();
    assert!((of(-2.8).members[0] + 3.0).norm() < 1e-9, "a_z - 3 b_z c_z has the mode -2.8: {sets:?}");
    assert!(sets.iter().all(|set| set.members.len() == 1 && set.dimension == 1), "{sets:?}");
}

/// Nearly as many outputs as are possible, all combinations of one.
#[test]
fn more_outputs_than_states_are_reduced_and_give_the_same_observer() {
    let few = network();
    let mut random = Random::new(5);
    let Psi = DMatrix::from_fn(66, 1, |_, _| random.normal()) * &few.Psi;
    let c_G = DMatrix::from_fn(3, 1, |_, _| random.normal()) * &few.c_G;
    let many = Network { Psi, c_G, ..few.clone() };
    let found = conditions(&many, &tolerance()).unwrap();
    assert!(found.iter().filter(|c| c.needed).all(|c| c.verdict.holds()), "{found:#?}");
    let made = design(&many, &choice(), &found, &tolerance()).unwrap();
    assert_eq!(made.observer.global.H.shape(), (6, 198), "a column for each output");
    assert!(made.verification.verified(), "{:#?}", made.verification.checks);
    let (one, all) = (designed(&few), &made.observer);
    let feedback = |observer: &HierarchicalObserver| &observer.global.H * observer.hierarchy.gamma_z();
    close(&feedback(all), &feedback(&one.observer), 1e-8, "H gamma_z");
}

#[test]
fn a_coupling_without_effect_leaves_local_observers_alone() {
    let size = 100;
    let ring = (0..size).flat_map(|i| [(i, i, -1.0), (i, (i + 1) % size, 1.0)]);
    let Gamma = CouplingMatrix::Sparse { rows: size, columns: size, entries: ring.collect() };
    let (Psi, c_G) = (DMatrix::from_element(1, size, 1.0), DMatrix::zeros(1, 5));
    let network = Network { b: DMatrix::zeros(5, 1), Gamma, Psi, c_G, local: vec![3], ..network() };
    let found = conditions(&network, &tolerance()).unwrap();
    for condition in found.iter().filter(|condition| condition.needed) {
        assert!(condition.verdict.holds(), "{}: {}", condition.id, condition.summary);
    }
    let made = design(&network, &choice(), &found, &tolerance()).unwrap();
    assert_eq!(made.observer.hierarchy.order(), 0, "mu = 0");
    assert!(made.verification.verified(), "{:#?}", made.verification.checks);
    let span = Span { horizon: 4.0, samples: 5 };
    let run = simulate_network(&network, &made.observer, &x0(500), span, &[3]).unwrap();
    let part = &run.subsystems[0];
    assert!((part.x.column(4) - part.x_hat.column(4)).norm() < 1e-3, "the local observer works alone");
    let seeing = Network { c_G: self::network().c_G, ..network };
    let found = conditions(&seeing, &tolerance()).unwrap();
    assert_eq!(find(&found, "003-11-cG").verdict, Verdict::Fails, "nothing is shown that c_G could see");
}

#[test]
fn the_local_side_never_takes_the_global_observer_away() {
    let mut a = network().a;
    a[(0, 0)] = 3.8;
    let network = Network { a, c_L: dmatrix![0.0, 1.0, 0.0, 0.0, 0.0], ..network() };
    let nobody = DesignChoice { plugged: Some(Vec::new()), ..choice() };
    for (choice, needed) in [(nobody, false), (choice(), true)] {
        let found = conditions_for(&network, &choice, &tolerance()).unwrap();
        let local = find(&found, "003-P1-local");
        assert_eq!(
            (local.verdict, local.needed),
            (Verdict::Fails, needed),
            "3.8 is not seen: {}",
            local.summary
        );
        let made = design(&network, &choice, &found, &tolerance()).unwrap();
        assert!(made.verification.verified(), "the global observer: {:#?}", made.verification.checks);
        assert_eq!(made.observer.locals().count(), 0, "none that could be plugged in");
        assert_eq!(made.observer.left_out.len(), usize::from(needed), "{:?}", made.observer.left_out);
        assert!(made.observer.left_out.iter().all(|why| made.notes.contains(why)), "{:?}", made.notes);
    }
    let outside = DesignChoice { plugged: Some(vec![3, 0]), ..choice() };
    let found = conditions_for(&self::network(), &outside, &tolerance()).unwrap();
    let made = design(&self::network(), &outside, &found, &tolerance()).unwrap();
    assert_eq!(made.observer.locals().map(|(i, _)| i).collect::<Vec<_>>(), [3], "the one that is measured");
    assert!(made.observer.left_out[0].contains("subsystem 1 has no local measurements"), "{:?}", made.notes);
}

#[test]
fn rows_of_c_that_b_does_not_pass_on_are_no_remedy() {
    let network = Network {
        b: dmatrix![0.0, 0.0; 0.0, 0.0; 0.0, 0.0; 0.0, 0.0; 1.0, 1.0],
        c: dmatrix![1.0, 0.0, 0.0, 0.0, 0.0; 0.0, 0.0, 1.0, 0.0, 0.0],
        c_G: dmatrix![0.0, 1.0, 0.0, 0.0, 0.0],
        ..network()
    };
    let hierarchy = Hierarchy::of(&network, &tolerance()).unwrap();
    let outside = |c: &DMatrix<f64>| (c - c * &hierarchy.M * hierarchy.M.transpose()).norm();
    assert!(outside(&network.c) > 0.1, "b passes only the sum of both rows on");
    let found = conditions(&network, &tolerance()).unwrap();
    let remedy = &find(&found, "003-11-cG").remedies[0];
    assert!(
        remedy.contains("rows of b_I c_I, b_I c_I a_I") && !remedy.contains("for example c_I"),
        "{remedy}"
    );
    let mended = Network { c_G: (&network.b * &network.c).rows(4, 1).into_owned(), ..network };
    let found = conditions(&mended, &tolerance()).unwrap();
    assert!(find(&found, "003-11-cG").verdict.holds(), "a row of b c: {found:#?}");
    let poles: Vec<f64> = (0..20).map(|k| -2.0 - 0.25 * f64::from(k)).collect();
    let choice = DesignChoice { poles: real(&poles), ..choice() };
    if find(&found, "003-P1-global").verdict.holds() {
        let made = design(&mended, &choice, &found, &tolerance()).unwrap();
        assert!(made.verification.verified(), "m = 2: {:#?}", made.verification.checks);
    } else {
        unreachable!("the whole is detectable: {}", find(&found, "003-P1-global").summary);
    }
}

#[test]
fn conditions_that_are_not_asked_do_not_fail() {
    // an undriven mode, which every block has; the output sees every direction of the coupling
    let network = Network {
        a: dmatrix![-1.0, 0.0; 0.0, -0.5],
        b: dmatrix![1.0; 0.0],
        c: dmatrix![1.0, 1.0],
        Gamma: dmatrix![1.0, 0.0; 0.0, 2.0].into(),
        Psi: DMatrix::identity(2, 2),
        c_G: dmatrix![1.0, 1.0],
        c_L: DMatrix::identity(2, 2),
        local: vec![0],
    };
    let found = conditions(&network, &tolerance()).unwrap();
    let verdicts = |found: &[Condition]| ["003-T2-iii", "003-C1-iii"].map(|id| find(found, id).verdict);
    assert_eq!(verdicts(&found), [Verdict::Holds, Verdict::Undecided], "rank Psi N = nu");
    let defective = Network { Gamma: dmatrix![1.0, 1.0; 0.0, 1.0].into(), ..network.clone() };
    let found = conditions(&defective, &tolerance()).unwrap();
    assert_eq!(verdicts(&found), [Verdict::Holds, Verdict::Undecided], "diagonalisable or not");
    let blind = Network { Psi: dmatrix![1.0, 0.0], ..network };
    let found = conditions(&blind, &tolerance()).unwrap();
    assert_eq!(find(&found, "003-T2-i").verdict, Verdict::Fails, "the second direction is not seen");
    assert_eq!(find(&found, "003-C1-iii").verdict, Verdict::Undecided, "it builds on (i)");
}

#[test]
fn each_row_of_an_output_is_judged_by_its_own_size() {
    let network = Network { Psi: dmatrix![1e9, -1e9, 0.0, 0.0; 1.0, 0.0, 0.0, 0.0], ..network() };
    let found = conditions(&network, &tolerance()).unwrap();
    assert_eq!(find(&found, "003-11-Psi").verdict, Verdict::Fails, "a large row does not excuse a small one");
}

#[test]
fn a_whole_beyond_the_limit_is_not_decided_but_the_rest_is() {
    let ring = (0..60).flat_map(|i| [(i, i, -1.0), (i, (i + 1) % 60, 1.0)]);
    let Gamma = CouplingMatrix::Sparse { rows: 60, columns: 60, entries: ring.collect() };
    let mut Psi = DMatrix::zeros(1, 60);
    (Psi[(0, 0)], Psi[(0, 1)]) = (1.0, -1.0);
    let network = Network { Gamma, Psi, ..network() };
    let found = conditions(&network, &tolerance()).unwrap();
    for id in ["003-11-Psi", "003-11-cG", "003-P1-local"] {
        assert!(find(&found, id).verdict.holds(), "{id}: {}", find(&found, id).summary);
    }
    assert_eq!(find(&found, "003-P1-global").verdict, Verdict::Undecided, "59 * 2 states");
    let error = design(&network, &choice(), &found, &tolerance()).unwrap_err();
    assert!(matches!(error, DesignError::Unsuitable(_)), "{error}");
    assert!(error.to_string().contains("is not decided: ") && error.to_string().contains("118"), "{error}");
}

/// The cost of a subsystem of order sixty is that of its modes, not of its observability matrix.
#[test]
fn subsystems_of_order_sixty_are_decided() {
    let n = 60;
    let a = DMatrix::from_fn(n, n, |i, j| match (i, j) {
        (0, 1) => 1.0,
        (1, 0) => -1.0,
        (i, 0) if i > 1 => 0.3,
        (i, j) if i == j => -1.0 - 0.1 * i as f64,
        _ => 0.0,
    });
    let unit = |k: usize| DMatrix::from_fn(1, n, |_, j| f64::from(u8::from(j == k)));
    let network = Network {
        b: unit(1).transpose(),
        c: unit(0),
        c_G: unit(0),
        c_L: DMatrix::identity(n, n),
        a,
        ..network()
    }
    .checked()
    .unwrap();
    let found = Hierarchy::of(&network, &tolerance()).unwrap();
    assert_eq!((found.M.ncols(), found.mu.rank, found.mu.rows), (2, 2, 3600), "mu, as of the printed matrix");
    assert_eq!(descry::observer::hierarchical::proposed_order(&network, 48), Some(6), "nu mu = 3 * 2");
}
