//! Networks that are never written as one system.

#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

use super::*;

/// Everybody on a ring of `size` listens to the hubs of its arc and of the next one.
fn hub_ring(size: usize, hubs: usize) -> CouplingMatrix {
    let hub = |k: usize| (k % hubs) * (size / hubs);
    let entries = (0..size).flat_map(|i| {
        let arc = i * hubs / size;
        let position = (i * hubs) as f64 / size as f64 - arc as f64;
        [(i, hub(arc), -1.0 - position), (i, hub(arc + 1), 0.5 + position)]
    });
    CouplingMatrix::Sparse { rows: size, columns: size, entries: entries.collect() }
}

fn hub_network(size: usize, hubs: usize) -> Network {
    let Gamma = hub_ring(size, hubs);
    let mut Psi = DMatrix::zeros(2, size);
    for k in 0..hubs {
        Psi[(0, k * (size / hubs))] = 1.0;
        Psi[(1, k * (size / hubs))] = (k + 1) as f64;
    }
    Network { Gamma, Psi, local: vec![0, size / 2, size - 1], ..network() }.checked().unwrap()
}

fn many_poles() -> DesignChoice {
    let poles: Vec<f64> = (0..MOST_GLOBAL_STATES).map(|k| -2.0 - 0.25 * k as f64).collect();
    DesignChoice { poles: real(&poles), local_poles: local_poles(), ..DesignChoice::default() }
}

#[test]
fn a_thousand_subsystems_with_few_hubs_are_designed_checked_and_simulated() {
    let network = hub_network(1000, 3);
    let found = conditions(&network, &tolerance()).unwrap();
    for condition in found.iter().filter(|condition| condition.needed) {
        assert!(condition.verdict.holds(), "{}: {}", condition.id, condition.summary);
    }
    let design = design(&network, &many_poles(), &found, &tolerance()).unwrap();
    assert!(design.verification.verified(), "{:#?}", design.verification.checks);
    assert_eq!(design.observer.hierarchy.order(), 6, "nu = 3 hubs, mu = 2");
    let span = Span { horizon: 6.0, samples: 61 };
    let run = simulate_network(&network, &design.observer, &x0(5000), span, &[0, 500, 999, 7]).unwrap();
    for part in &run.subsystems[..3] {
        let error = (part.x.column(60) - part.x_hat.column(60)).norm();
        assert!(part.local && error < 1e-2, "subsystem {}: error {error:.1e}", part.subsystem);
    }
    let error = composite(&network, &design.observer).unwrap_err();
    assert!(
        error.to_string().contains(&LARGEST_COMPOSITE.to_string()),
        "too large to be written out: {error}"
    );
}

#[test]
fn sparse_and_dense_couplings_give_the_same_design() {
    for size in [12, 240] {
        let sparse = hub_network(size, 3);
        let dense = Network { Gamma: sparse.Gamma.dense().into(), ..sparse.clone() };
        let [first, second] = [&sparse, &dense].map(|network| {
            let found = conditions(network, &tolerance()).unwrap();
            design(network, &many_poles(), &found, &tolerance()).unwrap()
        });
        for name in ["N", "M", "Gamma_nu", "alpha_z", "gamma_z", "H"] {
            let of = |design: &HierarchicalDesign| {
                design.matrices.iter().find(|m| m.name == name).map(|m| m.value.clone()).unwrap()
            };
            close(&of(&first), &of(&second), 1e-7, name);
        }
        assert!(first.verification.verified() && second.verification.verified(), "{size} subsystems");
    }
}

#[test]
fn a_dense_coupling_of_low_rank_is_found_in_a_large_ring() {
    // the first harmonic of a ring: Gamma_ij = 2/N cos(2 pi (i - j) / N) has rank two
    let size = 400;
    let angle = |i: usize| 2.0 * std::f64::consts::PI * i as f64 / size as f64;
    let Gamma = DMatrix::from_fn(size, size, |i, j| -2.0 / size as f64 * (angle(i) - angle(j)).cos());
    let Psi = DMatrix::from_fn(2, size, |i, j| if i == 0 { angle(j).cos() } else { angle(j).sin() });
    let network = Network { Gamma: Gamma.into(), Psi, local: vec![5], ..network() };
    let found = conditions(&network, &tolerance()).unwrap();
    let design = design(&network, &many_poles(), &found, &tolerance()).unwrap();
    assert_eq!(design.observer.hierarchy.N.ncols(), 2, "cosine and sine");
    assert!(design.verification.verified(), "{:#?}", design.verification.checks);
}

#[test]
fn a_plain_ring_is_refused_with_found_and_allowed() {
    for (size, exact) in [(60, "exactly nu mu = 59 * 2 = 118 states"), (1000, "at least nu mu = ")] {
        let ring = (0..size).flat_map(|i| [(i, i, -1.0), (i, (i + 1) % size, 1.0)]);
        let Gamma = CouplingMatrix::Sparse { rows: size, columns: size, entries: ring.collect() };
        let network = Network { Gamma, Psi: DMatrix::zeros(0, size), ..network() };
        let error = Hierarchy::of(&network, &tolerance()).unwrap_err();
        assert!(
            matches!(error, HierarchyError::TooLarge { mu: 2, allowed: MOST_GLOBAL_STATES, .. }),
            "{error}"
        );
        let text = error.to_string();
        assert!(text.contains(exact) && text.contains("at most 48"), "{text}");
        let found = conditions(&network, &tolerance()).unwrap();
        assert_eq!(find(&found, "003-P1-global").verdict, Verdict::Undecided, "not asked");
        assert!(design(&network, &choice(), &found, &tolerance()).is_err(), "and not designed");
    }
}

#[test]
fn larger_wholes_are_decided_by_the_test_of_the_whole() {
    for (seed, hide) in [(1, false), (2, true), (3, false), (4, true)] {
        let mut random = Random::new(seed);
        let mut network = hub_network(40, 10);
        let Psi = DMatrix::from_fn(3, 10, |_, _| random.normal());
        let mut global = DMatrix::zeros(3, 40);
        for k in 0..10 {
            // a hub without listeners among the outputs is not seen when nobody who is seen listens to it
            if !(hide && k == 4) {
                global.column_mut(4 * k).copy_from(&Psi.column(k));
            }
        }
        network.Psi = global;
        let CouplingMatrix::Sparse { rows, columns, entries } = network.Gamma else { unreachable!("sparse") };
        // hubs of different strength, so that their chain has a basis of eigenvectors
        let own = |i: usize, j: usize| if i == j { 1.0 + 0.07 * j as f64 } else { 1.0 };
        let listens = |i: usize, j: usize| !hide || j != 16 || i == 16 || i == 17;
        let entries = entries.into_iter().filter(|&(i, j, _)| listens(i, j));
        let entries = entries.map(|(i, j, value)| (i, j, value * own(i, j)));
        network.Gamma = CouplingMatrix::Sparse { rows, columns, entries: entries.collect() };
        let hierarchy = Hierarchy::of(&network, &tolerance()).unwrap();
        assert_eq!(hierarchy.order(), 20, "ten hubs");
        let found = conditions(&network, &tolerance()).unwrap();
        let global = find(&found, "003-P1-global");
        let modes = pbh_modes(&hierarchy.alpha_z(), &hierarchy.gamma_z(), &tolerance()).unwrap();
        let whole = modes.iter().all(|mode| !mode.unobservable || mode.value.re < -1e-6);
        assert_eq!(global.verdict.holds(), whole, "{seed}: {}", global.summary);
        let Evidence::Points { points, .. } = &global.evidence[0] else { unreachable!("points") };
        let hidden = (
            points.iter().filter(|point| point.loses_rank).count(),
            modes.iter().filter(|mode| mode.unobservable).count(),
        );
        assert_eq!(hidden.0, hidden.1, "{seed}: number of hidden modes");
        assert_eq!(hide, modes.iter().any(|mode| mode.unobservable), "{seed}: as planted");
    }
}
