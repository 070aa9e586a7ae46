//! The error system against the joint response of plant and observer, which knows nothing of claims.

use nalgebra::{DMatrix, dmatrix};

use super::{ErrorGain, ErrorStateSpace, ErrorSystemError, error_system};
use crate::numerics::{Complex64, Random, StabilityRegion, Tolerance, Watch, complex_svd};
use crate::observer::{Design, DesignChoice, LmiChoice, Method, Order, assess, unknown_input_response};
use crate::system::{DescriptorSystem, Model, Network, TimeDomain};

const POINTS: [Complex64; 4] = [
    Complex64::new(0.0, 0.7),
    Complex64::new(0.0, 13.0),
    Complex64::new(0.8, 0.6),
    Complex64::new(1.7, -2.1),
];

/// A random plant of index 1; its unknown input enters differential equations only, which the paper's
/// proportional-integral observer needs.
fn plant(time: TimeDomain, seed: u64) -> DescriptorSystem {
    let mut random = Random::new(seed);
    let (n, r, p, q) = (4, 3, 3, 1);
    let mut normal = |rows, columns| DMatrix::from_fn(rows, columns, |_, _| random.normal());
    let (left, right) = (normal(n, n), normal(n, n));
    let mut unit = DMatrix::zeros(n, n);
    unit.view_mut((0, 0), (r, r)).fill_with_identity();
    let mut d = normal(n, q);
    d.rows_mut(r, n - r).fill(0.0);
    let size = if time == TimeDomain::Discrete { 0.5 } else { 1.0 };
    DescriptorSystem {
        time,
        E: &left * unit * &right,
        A: &left * normal(n, n) * size * &right,
        B: normal(n, 1),
        C: normal(p, n) * &right,
        D: &left * d,
        F: DMatrix::zeros(p, q),
    }
    .checked()
    .unwrap()
}

/// The same with an unknown input in every equation and output, which the input-decoupled observer needs.
fn fed_through(time: TimeDomain, seed: u64) -> DescriptorSystem {
    let mut random = Random::new(100 + seed);
    let mut normal = |rows, columns| DMatrix::from_fn(rows, columns, |_, _| random.normal());
    DescriptorSystem { D: normal(4, 1), F: normal(3, 1), ..plant(time, seed) }
}

fn choice(method: Method, order: Order, time: TimeDomain) -> DesignChoice {
    let poles: &[f64] = match time {
        TimeDomain::Continuous => &[-2.0, -3.0, -4.0, -5.0, -6.0],
        TimeDomain::Discrete => &[0.1, 0.2, -0.3, 0.4, 0.5],
    };
    let poles = poles.iter().copied().map(Complex64::from).collect();
    DesignChoice { method, order, poles, ..DesignChoice::default() }
}

fn designed(system: &DescriptorSystem, choice: &DesignChoice) -> Option<Design> {
    let model = Model::from(system.clone());
    assess(&model, choice, &Tolerance::default(), &Watch::none()).unwrap().outcome.ok()
}

fn states(system: &DescriptorSystem, design: &Design) -> ErrorStateSpace {
    error_system(system, design, &Tolerance::default()).unwrap()
}

/// Largest relative distance of the error system from the joint response of plant and observer.
fn off(system: &DescriptorSystem, design: &Design) -> f64 {
    let found = states(system, design);
    let q = design.observer.n_estimated_inputs();
    let n = system.n_states();
    let mut worst = 0.0_f64;
    for s in POINTS {
        let joint = unknown_input_response(s, system, &design.observer).unwrap();
        let (from_d, _) = found.response(s).unwrap();
        let mut own = DMatrix::<Complex64>::zeros(q, system.n_unknown_inputs());
        own.fill_with_identity();
        let e = from_d.rows(0, n) - (&joint.x_hat - &joint.x);
        let e_d = from_d.rows(n, q) - (&joint.d_hat - own);
        worst = worst.max((e.norm() + e_d.norm()) / (1.0 + joint.x.norm() + joint.x_hat.norm()));
    }
    worst
}

#[test]
fn it_is_the_joint_response_of_plant_and_observer_for_every_method_and_order() {
    for time in [TimeDomain::Continuous, TimeDomain::Discrete] {
        let mut made = 0;
        for seed in 0..12 {
            let system = plant(time, seed);
            for method in [Method::Proportional, Method::ProportionalIntegral] {
                for &order in method.orders() {
                    let Some(design) = designed(&system, &choice(method, order, time)) else { continue };
                    made += 1;
                    let off = off(&system, &design);
                    assert!(off < 1e-7, "{time:?}, seed {seed}, {}: off by {off:.1e}", design.title);
                }
            }
        }
        assert!(made > 50, "{time:?}: {made} designs exist");
    }
}

#[test]
fn a_feedthrough_and_an_unknown_input_in_a_constraint_are_taken_along() {
    let mut made = 0;
    for seed in 0..12 {
        let system = fed_through(TimeDomain::Continuous, seed);
        for (method, order) in [
            (Method::ProportionalIntegral, Order::General),
            (Method::InputDecoupled, Order::Full),
            (Method::Proportional, Order::Reduced),
            (Method::Proportional, Order::Full),
        ] {
            let choice = choice(method, order, TimeDomain::Continuous);
            let Some(design) = designed(&system, &choice) else { continue };
            made += 1;
            let off = off(&system, &design);
            assert!(off < 1e-7, "seed {seed}, {}: off by {off:.1e}", design.title);
        }
    }
    assert!(made > 30, "{made} designs exist");
}

/// The example of paper 002, whose error system its own tests know; without its nonlinearity.
fn disturbed() -> DescriptorSystem {
    DescriptorSystem {
        time: TimeDomain::Continuous,
        E: dmatrix![0.0, 1.0, 0.0; 0.0, 0.0, 1.0; 0.0, 0.0, 0.0],
        A: dmatrix![1.0, 0.0, 0.0; 0.0, 1.0, 0.0; 1.0, 0.0, 1.0],
        B: dmatrix![1.0; 1.0; 1.0],
        C: dmatrix![1.0, 0.0, 0.0],
        D: dmatrix![1.0, 1.0; 1.0, -1.0; 1.0, 1.0],
        F: dmatrix![1.0, 1.0],
    }
}

#[test]
fn of_an_h_infinity_observer_it_is_the_error_system_of_its_paper() {
    let system = disturbed();
    let lmi = LmiChoice { decay: Some(0.5), ..LmiChoice::default() };
    let choice = DesignChoice { lmi, ..choice(Method::HInfinity, Order::Reduced, TimeDomain::Continuous) };
    let design = designed(&system, &choice).unwrap();
    let off = off(&system, &design);
    assert!(off < 1e-9, "off by {off:.1e}");
    let gains = states(&system, &design).gains(&Tolerance::default()).unwrap();
    let own = design.synthesis.lmi()[0].h_infinity.unwrap();
    let found = gains.d_to_e.value().unwrap();
    assert!((found - own.norm).abs() < 1e-9 * own.norm, "{found} and {}", own.norm);
    assert!(found <= design.synthesis.lmi()[0].gamma.unwrap(), "within the guarantee");
    assert_eq!(gains.d_to_e_d, ErrorGain::NotEstimated, "d is attenuated, not estimated");
}

#[test]
fn an_input_decoupled_observer_does_not_hear_the_unknown_input() {
    for time in [TimeDomain::Continuous, TimeDomain::Discrete] {
        let mut made = 0;
        for seed in 0..12 {
            let system = fed_through(time, seed);
            for order in [Order::Full, Order::General] {
                let choice = choice(Method::InputDecoupled, order, time);
                let Some(design) = designed(&system, &choice) else { continue };
                made += 1;
                let gains = states(&system, &design).gains(&Tolerance::default()).unwrap();
                assert_eq!(gains.d_to_e, ErrorGain::Decoupled, "seed {seed}, {}", design.title);
                assert_eq!(gains.d_to_e_d, ErrorGain::Decoupled, "seed {seed}, {}", design.title);
                assert!(gains.w_to_e.value().unwrap() > 0.0, "noise is heard");
            }
        }
        assert!(made > 12, "{time:?}: {made} designs exist");
    }
}

#[test]
fn a_proportional_integral_observer_hears_what_changes() {
    let system = plant(TimeDomain::Continuous, 1);
    let choice = choice(Method::ProportionalIntegral, Order::Reduced, TimeDomain::Continuous);
    let found = states(&system, &designed(&system, &choice).unwrap());
    let (at_zero, _) = found.response(Complex64::from(0.0)).unwrap();
    assert!(at_zero.norm() < 1e-9, "a constant is estimated without offset: {}", at_zero.norm());
    let gains = found.gains(&Tolerance::default()).unwrap();
    assert!(gains.d_to_e_d.value().unwrap() >= 1.0 - 1e-9, "what is infinitely fast is missed: {gains:?}");
}

#[test]
fn without_its_claim_the_same_error_is_found_from_the_joint_system() {
    let (mut stable, mut unstable) = (0, 0);
    for seed in 0..12 {
        let mut system = fed_through(TimeDomain::Continuous, seed);
        if seed % 2 == 0 {
            system.A -= &system.E * 6.0;
        }
        for (method, order) in [
            (Method::ProportionalIntegral, Order::General),
            (Method::InputDecoupled, Order::Full),
            (Method::Proportional, Order::Reduced),
        ] {
            let choice = choice(method, order, TimeDomain::Continuous);
            let Some(design) = designed(&system, &choice) else { continue };
            let expected = states(&system, &design);
            let joint = states(&system, &Design { claim: None, ..design.clone() });
            assert!(joint.with_plant && !expected.with_plant, "two ways");
            if joint.a.nrows() > design.observer.order() {
                stable += 1;
            } else {
                unstable += 1;
            }
            for s in POINTS {
                let (from_d, from_w) = expected.response(s).unwrap();
                let (d, w) = joint.response(s).unwrap();
                let off = (from_d - d).norm() / (1.0 + joint.terms.c.norm());
                let off_w = (&from_w - w).norm() / from_w.norm();
                assert!(off < 1e-6 && off_w < 1e-6, "seed {seed}, {}: {off:.1e}, {off_w:.1e}", design.title);
            }
            if method == Method::InputDecoupled {
                let gains = joint.gains(&Tolerance::default()).unwrap();
                assert_eq!(gains.d_to_e, ErrorGain::Decoupled, "seed {seed}");
            }
        }
    }
    assert!(stable > 5 && unstable > 5, "{stable} stable and {unstable} unstable plants");
}

#[test]
fn an_error_that_shows_an_unstable_plant_has_no_finite_gain() {
    let system = DescriptorSystem {
        D: dmatrix![1.0; 0.0],
        F: dmatrix![0.0],
        ..DescriptorSystem::autonomous(
            DMatrix::identity(2, 2),
            dmatrix![0.5, 0.0; 0.0, -1.0],
            dmatrix![1.0, 1.0],
        )
        .unwrap()
    };
    let choice = choice(Method::ProportionalIntegral, Order::Full, TimeDomain::Continuous);
    let mut design = designed(&system, &choice).unwrap();
    design.claim = None;
    design.observer.P *= 1.5;
    let gains = states(&system, &design).gains(&Tolerance::default()).unwrap();
    let ErrorGain::NotFinite(why) = &gains.d_to_e else { panic!("{gains:?}") };
    assert!(why.contains("0.5"), "names the mode of the plant: {why}");
    design.observer.P /= 1.5;
    let wide = DescriptorSystem { E: dmatrix![1.0, 0.0], A: dmatrix![0.5, 1.0], D: dmatrix![1.0], ..system };
    let error = error_system(&wide, &design, &Tolerance::default()).unwrap_err();
    assert_eq!(error, ErrorSystemError::NotSquare { equations: 1, states: 2 });
}

/// The largest gains of a grid of frequencies, from `d` and from noise to the error of the states.
fn on_a_grid(found: &ErrorStateSpace, points: u16) -> (f64, f64) {
    let part = |k: u16| f64::from(k) / f64::from(points);
    let frequency = |k: u16| match found.region {
        StabilityRegion::LeftHalfPlane => 10_f64.powf(-3.0 + 7.0 * part(k)),
        StabilityRegion::UnitDisk => std::f64::consts::PI * part(k),
    };
    let n = found.states.len();
    let largest = |m: DMatrix<Complex64>| complex_svd(&m).unwrap().s[0];
    (0..=points).fold((0.0, 0.0), |(of_d, of_w): (f64, f64), k| {
        let (d, w) = found.response(found.point(frequency(k))).unwrap();
        (of_d.max(largest(d.rows(0, n).into_owned())), of_w.max(largest(w.rows(0, n).into_owned())))
    })
}

#[test]
fn no_gain_on_a_grid_exceeds_a_norm() {
    for time in [TimeDomain::Continuous, TimeDomain::Discrete] {
        for seed in 0..3 {
            let system = plant(time, seed);
            for (method, order) in [
                (Method::Proportional, Order::Reduced),
                (Method::Proportional, Order::Full),
                (Method::ProportionalIntegral, Order::Reduced),
                (Method::ProportionalIntegral, Order::Full),
            ] {
                let Some(design) = designed(&system, &choice(method, order, time)) else { continue };
                let found = states(&system, &design);
                let gains = found.gains(&Tolerance::default()).unwrap();
                let (of_d, of_w) = on_a_grid(&found, 250);
                for (name, gain, grid) in [("d", gains.d_to_e, of_d), ("noise", gains.w_to_e, of_w)] {
                    let norm = gain.value().unwrap();
                    let what = format!("{time:?}, seed {seed}, {}, from {name}", design.title);
                    assert!(grid <= norm * (1.0 + 1e-9), "{what}: {grid} on the grid, norm {norm}");
                    assert!(grid >= 0.93 * norm, "{what}: {grid} on the grid, norm {norm}");
                }
            }
        }
    }
}

/// Three subsystems with a stable and an unstable network mode, all with local measurements.
fn network() -> Network {
    Network {
        a: dmatrix![0.0, 1.0; -2.0, -1.0],
        b: dmatrix![0.0; 1.0],
        c: dmatrix![1.0, 0.0],
        Gamma: dmatrix![1.0, -0.5, 0.0; 0.3, 4.0, 0.2; 1.3, 3.5, 0.2].into(),
        Psi: dmatrix![1.0, -0.5, 0.0; 0.3, 4.0, 0.2],
        c_G: dmatrix![1.0, 0.0],
        c_L: dmatrix![1.0, 0.0],
        local: vec![0, 1, 2],
    }
}

#[test]
fn of_a_network_the_local_estimates_are_judged() {
    let model = Model::from(network().checked().unwrap());
    let poles = |poles: &[f64]| poles.iter().copied().map(Complex64::from).collect();
    let mut choice = DesignChoice {
        poles: poles(&[-2.0, -2.5, -3.0, -3.5, -4.0, -4.5]),
        local_poles: poles(&[-5.0, -6.0]),
        ..choice(Method::Hierarchical, Order::Full, TimeDomain::Continuous)
    };
    let mut design = |plugged| {
        choice.plugged = plugged;
        assess(&model, &choice, &Tolerance::default(), &Watch::none()).unwrap().outcome.unwrap()
    };
    let all = design(None);
    let found = states(&model.system, &all).gains(&Tolerance::default()).unwrap();
    let joint = states(&model.system, &Design { hierarchical: None, ..all });
    assert!(joint.with_plant, "the plant is unstable and taken along as far as it shows");
    let joint = joint.gains(&Tolerance::default()).unwrap();
    let norm = found.w_to_e.value().unwrap();
    assert!((norm - joint.w_to_e.value().unwrap()).abs() < 1e-6 * norm, "{found:?} and {joint:?}");
    assert_eq!(found.d_to_e, ErrorGain::NoInput, "networks have no unknown input");
    let one = states(&model.system, &design(Some(vec![1])));
    assert_eq!(one.states, [2, 3], "the states of the subsystem with a local observer");
    let one = one.gains(&Tolerance::default()).unwrap().w_to_e.value().unwrap();
    assert!(one > 0.0 && one < norm, "a part of the error: {one} of {norm}");
}
