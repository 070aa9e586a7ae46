//! Trajectories against published examples, analytic solutions and an independent slow integrator.
#![expect(clippy::unwrap_used, clippy::expect_used, reason = "helpers of tests fail by panicking")]

use descry::numerics::{Block, Tolerance, block_matrix, side_by_side};
use descry::observer::LinearObserver;
use descry::simulation::{
    Inputs, Method, Plant, Silence, SimulationError, Span, Trajectory, Uncertainty, simulate,
};
use descry::system::{DescriptorSystem, TimeDomain};
use nalgebra::{DMatrix, DVector, dmatrix};
use serde_json::Value;

const NONE: Inputs<'static> =
    Inputs { known: &Silence, unknown: &Silence, noise: &Silence, jumps: &[], kinks: &[] };

fn plant(system: &DescriptorSystem) -> Plant {
    Plant::new(system, None, &Tolerance::default()).unwrap()
}

fn span(horizon: f64, samples: usize) -> Span {
    Span { horizon, samples }
}

/// An observer that copies the output: enough to exercise the common form.
fn output_only(n: usize, p: usize, k: usize, n_matrix: DMatrix<f64>, l: DMatrix<f64>) -> LinearObserver {
    let o = n_matrix.nrows();
    LinearObserver {
        N: n_matrix,
        L: l,
        H: DMatrix::zeros(o, k),
        P: DMatrix::zeros(n, o),
        V: DMatrix::zeros(n, p),
        W: DMatrix::zeros(n, k),
        Q: DMatrix::zeros(0, o),
        R: DMatrix::zeros(0, p),
        S: DMatrix::zeros(0, k),
    }
}

// ---------------------------------------------------------------- paper 004

fn reference() -> Value {
    serde_json::from_str(include_str!("reference/ex004.json")).unwrap()
}

fn matrix(value: &Value) -> DMatrix<f64> {
    let rows: Vec<Vec<f64>> = serde_json::from_value(value.clone()).unwrap();
    DMatrix::from_fn(rows.len(), rows[0].len(), |i, j| rows[i][j])
}

fn vector(value: &Value) -> DVector<f64> {
    DVector::from_vec(serde_json::from_value(value.clone()).unwrap())
}

fn example_004(data: &Value) -> DescriptorSystem {
    let of = |letter: &str| matrix(&data["inputs"][letter]);
    DescriptorSystem {
        time: TimeDomain::Continuous,
        E: of("Es"),
        A: of("As"),
        B: of("Bs"),
        C: of("Cs"),
        D: of("Ns"),
        F: DMatrix::zeros(1, 1),
    }
}

/// The observer of paper 004 (its eq. 5, with `L2` acting on `y`) from reference gains, in the common form.
fn observer_004(data: &Value, which: &str) -> LinearObserver {
    let gains = &data[which]["reference"];
    let of = |letter: &str| matrix(&gains[letter]);
    let (c, f) = (matrix(&data["rse"]["C"]), of("F"));
    let measured = matrix(&data["rse"]["y_from_u_ystar"]);
    let (from_u, from_y) = (measured.columns(0, 1).into_owned(), measured.columns(1, 1).into_owned());
    let order = f.nrows();
    let m1 = if which == "p_observer" { DMatrix::identity(4, 4) } else { of("M1") };
    let t2 = of("T2");
    let injection = of("L1") + of("L2");
    let proportional = LinearObserver {
        L: &injection * &from_y,
        H: &injection * &from_u + of("J"),
        N: f.clone(),
        P: m1.clone(),
        V: &t2 * &from_y,
        W: &t2 * &from_u,
        Q: DMatrix::zeros(0, order),
        R: DMatrix::zeros(0, 1),
        S: DMatrix::zeros(0, 1),
    };
    if which == "p_observer" {
        return proportional;
    }
    // f_hat' = L3 (y - C x_hat) = -L3 C M1 z + L3 (I - C T2) y
    let l3 = of("L3");
    let through = &l3 * (DMatrix::identity(3, 3) - &c * &t2);
    let t1n = if which == "full" { of("T1") * matrix(&data["rse"]["N"]) } else { matrix(&data["rse"]["N"]) };
    let back = -&l3 * &c * &m1;
    LinearObserver {
        N: block_matrix(&[
            &[Block::Of(&f), Block::Of(&t1n)],
            &[Block::Of(&back), Block::Of(&DMatrix::zeros(1, 1))],
        ]),
        L: descry::numerics::stack(&[&proportional.L, &(&through * &from_y)]),
        H: descry::numerics::stack(&[&proportional.H, &(&through * &from_u)]),
        P: side_by_side(&[&m1, &DMatrix::zeros(4, 1)]),
        Q: DMatrix::from_fn(1, order + 1, |_, j| if j == order { 1.0 } else { 0.0 }),
        R: DMatrix::zeros(1, 1),
        S: DMatrix::zeros(1, 1),
        ..proportional
    }
}

fn known_004(t: f64, out: &mut [f64]) {
    out[0] = 5.0 * (2.0 * t).sin();
}

fn unknown_004(t: f64, out: &mut [f64]) {
    out[0] = 5.0 + 2.0 * (4.0 * t).sin();
}

fn inputs_004() -> Inputs<'static> {
    Inputs { known: &known_004, unknown: &unknown_004, ..NONE }
}

fn uncertainty_004(data: &Value) -> Uncertainty {
    Uncertainty {
        amplitude: matrix(&data["delta"]["delta"]),
        frequency: matrix(&data["delta"]["delta_prime_Hz"]),
        scale: 1.0,
    }
}

const X0: [f64; 4] = [0.5, 0.0, 0.0, 0.0];

/// Compares with the vectors of the reference file and returns the largest difference.
fn difference_004(data: &Value, key: &str, found: &Trajectory, observer: usize) -> f64 {
    let mut worst = 0.0_f64;
    for row in data["simulation"][key].as_array().unwrap() {
        let t = row["t"].as_f64().unwrap();
        let at = found.t.iter().position(|s| (s - t).abs() < 1e-9).expect("the grid holds every time");
        let own = &found.observers[observer];
        worst = worst.max((found.x.column(at) - vector(&row["x"])).amax());
        worst = worst.max((found.d.column(at) - vector(&row["f"])).amax());
        worst = worst.max((own.x_hat.column(at) - vector(&row["xhat"])).amax());
        worst =
            worst.max((own.d_hat.column(at) - vector(&row["fhat"])).iter().fold(0.0, |m, x| m.max(x.abs())));
        assert_eq!(own.e.column(at), found.x.column(at) - own.x_hat.column(at), "e = x - x_hat");
    }
    worst
}

#[test]
fn all_five_trajectories_of_paper_004_are_reproduced() {
    let data = reference();
    let system = example_004(&data);
    let tolerance = data["tolerances"]["sim_abs"].as_f64().unwrap();
    let designs = ["reduced", "full", "p_observer"].map(|which| observer_004(&data, which));
    let zeros = [0.0; 5];
    let observers: Vec<_> = designs.iter().map(|o| (o, &zeros[..o.order()])).collect();

    let nominal = simulate(&plant(&system), &observers, &X0, &inputs_004(), span(6.0, 601)).unwrap();
    assert_eq!(nominal.method, Method::Exponential, "constant coefficients");
    let uncertain = Plant::new(&system, Some(&uncertainty_004(&data)), &Tolerance::default()).unwrap();
    let uncertain = simulate(&uncertain, &observers, &X0, &inputs_004(), span(6.0, 601)).unwrap();
    assert_eq!(uncertain.method, Method::Explicit, "coefficients vary");
    for (key, found, observer) in [
        ("reduced_nominal", &nominal, 0),
        ("full_nominal_for_reference_gain", &nominal, 1),
        ("reduced_uncertain", &uncertain, 0),
        ("full_uncertain_for_reference_gain", &uncertain, 1),
        ("p_observer_uncertain_for_reference_gain", &uncertain, 2),
    ] {
        let worst = difference_004(&data, key, found, observer);
        println!("{key}: {worst:.1e}, {} steps", found.steps);
        assert!(worst < tolerance, "{key}: {worst:.1e}");
    }
    let change = nominal.initial_state.change;
    assert!((change - 0.5).abs() < 1e-12, "x3 and x4 of x0 are replaced, by {change}");
    assert_eq!(nominal.initial_state.given, X0, "the given state is reported");
    assert!((nominal.initial_state.consistent[2] + 0.5).abs() < 1e-12, "x3(0) = -x4(0) - x2(0)");
    assert!(nominal.smallest_a22 > 0.6 && uncertain.smallest_a22 > 0.6, "both keep index 1");
}

#[test]
fn the_error_of_600_samples_is_below_1e_8() {
    let data = reference();
    let system = example_004(&data);
    let observer = observer_004(&data, "reduced");
    let run = |samples| {
        simulate(&plant(&system), &[(&observer, &[0.0; 3])], &X0, &inputs_004(), span(6.0, samples)).unwrap()
    };
    let (coarse, fine) = (run(600), run(599 * 16 + 1));
    let mut worst = 0.0_f64;
    for k in 0..600 {
        worst = worst.max((coarse.x.column(k) - fine.x.column(16 * k)).amax());
        let (a, b) = (&coarse.observers[0], &fine.observers[0]);
        worst = worst.max((a.d_hat.column(k) - b.d_hat.column(16 * k)).amax());
    }
    println!("600 samples: {worst:.1e}");
    assert!(worst < 1e-8, "against sixteen times as many: {worst:.1e}");
}

#[test]
fn few_samples_do_not_cost_accuracy() {
    let data = reference();
    let system = example_004(&data);
    let observer = observer_004(&data, "full");
    let run = |samples| {
        simulate(&plant(&system), &[(&observer, &[0.0; 5])], &X0, &inputs_004(), span(6.0, samples)).unwrap()
    };
    let (coarse, fine) = (run(7), run(601));
    let worst = (0..7)
        .map(|k| (coarse.observers[0].x_hat.column(k) - fine.observers[0].x_hat.column(100 * k)).amax())
        .fold(0.0, f64::max);
    assert!(worst < 1e-7, "seven samples against 601: {worst:.1e}");
}

// ---------------------------------------------------------------- analytic solutions

/// `x1' = -k x1 + d, 0 = x1 - x2`.
fn lag(k: f64) -> DescriptorSystem {
    DescriptorSystem {
        time: TimeDomain::Continuous,
        E: dmatrix![1.0, 0.0; 0.0, 0.0],
        A: dmatrix![-k, 0.0; 1.0, -1.0],
        B: DMatrix::zeros(2, 1),
        C: dmatrix![0.0, 1.0],
        D: dmatrix![1.0; 0.0],
        F: dmatrix![0.0],
    }
}

#[test]
fn the_exponential_matches_an_analytic_solution() {
    let found = simulate(&plant(&lag(2.0)), &[], &[1.0, 7.0], &NONE, span(3.0, 50)).unwrap();
    for (k, t) in found.t.iter().enumerate() {
        let exact = (-2.0 * t).exp();
        assert!((found.x[(0, k)] - exact).abs() < 1e-13, "x1({t}) = {} against {exact}", found.x[(0, k)]);
        assert!((found.x[(1, k)] - exact).abs() < 1e-13, "x2 follows x1 at {t}");
    }
    assert!((found.initial_state.change - 6.0).abs() < 1e-12, "x2(0) = 7 is replaced by 1");
}

/// A step of height one at `t = 1.234`, between the points of the grids used here.
fn late_step(t: f64, out: &mut [f64]) {
    out[0] = if t >= 1.234 { 1.0 } else { 0.0 };
}

#[test]
fn a_step_between_grid_points_is_exact() {
    let exact = |t: f64| if t < 1.234 { 0.0 } else { -0.5 * (-2.0 * (t - 1.234)).exp_m1() };
    let inputs = Inputs { unknown: &late_step, jumps: &[1.234], ..NONE };
    let varying = Uncertainty {
        amplitude: dmatrix![0.0, 0.0; 1e-300, 0.0],
        frequency: dmatrix![0.0, 0.0; 1.0, 0.0],
        scale: 1.0,
    };
    let still = plant(&lag(2.0));
    let moving = Plant::new(&lag(2.0), Some(&varying), &Tolerance::default()).unwrap();
    for (plant, limit) in [(&still, 1e-13), (&moving, 1e-7)] {
        let found = simulate(plant, &[], &[0.0, 0.0], &inputs, span(3.0, 61)).unwrap();
        for (k, t) in found.t.iter().enumerate() {
            let error = (found.x[(0, k)] - exact(*t)).abs();
            assert!(error < limit, "{:?} at {t}: {error:.1e}", found.method);
        }
    }
}

#[test]
fn a_grid_point_on_a_jump_shows_the_later_side() {
    // y = x + d: the output jumps with the input
    let mut system = lag(1.0);
    system.F = dmatrix![1.0];
    let step = |t: f64, out: &mut [f64]| out[0] = if t >= 0.3 { 1.0 } else { 0.0 };
    let inputs = Inputs { unknown: &step, jumps: &[0.3], ..NONE };
    let found = simulate(&plant(&system), &[], &[0.0, 0.0], &inputs, span(1.0, 11)).unwrap();
    assert_eq!((found.d[(0, 2)], found.d[(0, 3)]), (0.0, 1.0), "before and at the jump");
    assert!((found.y[(0, 3)] - 1.0).abs() < 1e-12, "x is still at zero: y = {}", found.y[(0, 3)]);
}

#[test]
fn states_that_follow_their_input_at_once_are_exact_for_stiff_poles() {
    // x' = -k x + d with d = 5 + 2 sin 4t
    for k in [3300.0, 1e5] {
        let inputs = Inputs { unknown: &unknown_004, ..NONE };
        let found = simulate(&plant(&lag(k)), &[], &[0.0, 0.0], &inputs, span(6.0, 600)).unwrap();
        let forced = |t: f64| {
            let (s, c) = (4.0 * t).sin_cos();
            5.0 / k + 2.0 * (k * s - 4.0 * c) / (k * k + 16.0)
        };
        for (i, t) in found.t.iter().enumerate() {
            let exact = forced(*t) - forced(0.0) * (-k * t).exp();
            let error = k * (found.x[(0, i)] - exact).abs();
            assert!(error < 1e-8, "k = {k}, t = {t}: {error:.1e} of the input's size");
        }
    }
}

// ---------------------------------------------------------------- independent integrator

/// Classical Runge-Kutta steps for `w' = f(t, w)`.
fn runge_kutta(
    f: impl Fn(f64, &DVector<f64>) -> DVector<f64>,
    (start, end, steps): (f64, f64, usize),
    mut w: DVector<f64>,
) -> DVector<f64> {
    let h = (end - start) / steps as f64;
    for k in 0..steps {
        let t = start + h * k as f64;
        let k1 = f(t, &w);
        let k2 = f(t + 0.5 * h, &(&w + 0.5 * h * &k1));
        let k3 = f(t + 0.5 * h, &(&w + 0.5 * h * &k2));
        let k4 = f(t + h, &(&w + h * &k3));
        w += h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
    }
    w
}

#[test]
fn a_hundred_times_faster_observer_agrees_with_slow_integration() {
    let data = reference();
    let mut observer = observer_004(&data, "reduced");
    // poles -2200, -1800, -2600 of s^3 + (b + 1) s^2 + (b + 1 + a) s + c, the error matrix of the reduced design
    let (b, ab, c) = (6599.0, 14_360_000.0, 1.0296e10);
    let a = ab - b - 1.0;
    observer.N[(0, 1)] = -1.0 - a;
    observer.N[(1, 1)] = -b;
    observer.N[(2, 1)] = -c;
    // y_c = [0; u; y*]: z' contains L2 y*, f_hat' = L3 y*
    observer.L = dmatrix![a; b; c];
    let system = example_004(&data);
    let found =
        simulate(&plant(&system), &[(&observer, &[0.0; 3])], &X0, &inputs_004(), span(0.5, 51)).unwrap();
    // reduced by hand: x1' = x3 + f, x2' = x1, x4 = x1, x3 = u - x2 - x4
    let full = |t: f64, w: &DVector<f64>| {
        let (u, f) = (5.0 * (2.0 * t).sin(), 5.0 + 2.0 * (4.0 * t).sin());
        let z = w.rows(2, 3);
        let own = &observer.N * z + &observer.L * w[1] + &observer.H * u;
        DVector::from_vec(vec![u - w[1] - w[0] + f, w[0], own[0], own[1], own[2]])
    };
    let slow = runge_kutta(full, (0.0, 0.5, 25_000), DVector::from_vec(vec![0.5, 0.0, 0.0, 0.0, 0.0]));
    let own = &found.observers[0];
    let last = found.t.len() - 1;
    let error = (found.x[(0, last)] - slow[0]).abs().max((own.z.column(last) - slow.rows(2, 3)).amax());
    println!("100 Lambda: {error:.1e}");
    assert!(error < 1e-6, "fast observer against 25 000 small steps: {error:.1e}");
    assert!(own.e_d[(0, last)].abs() < 0.1, "f is estimated closely: {}", own.e_d[(0, last)]);
}

/// Piecewise linear through pseudo-random values every 0.05 s.
fn rough(t: f64) -> f64 {
    let value = |k: f64| (12.9898 * (k + 1.0)).sin() * 43_758.5 % 1.0;
    let k = (t / 0.05).floor();
    let part = t / 0.05 - k;
    value(k) * (1.0 - part) + value(k + 1.0) * part
}

#[test]
fn noise_with_kinks_is_followed_accurately_by_both_methods() {
    let data = reference();
    let system = example_004(&data);
    let observer = observer_004(&data, "reduced");
    let uncertainty = uncertainty_004(&data);
    let noise = |t: f64, out: &mut [f64]| out[0] = 0.01 * rough(t);
    let kinks: Vec<f64> = (1..40).map(|k| f64::from(k) * 0.05).collect();
    let inputs = Inputs { noise: &noise, kinks: &kinks, ..inputs_004() };
    for varies in [false, true] {
        let plant = Plant::new(&system, varies.then_some(&uncertainty), &Tolerance::default()).unwrap();
        let found = simulate(&plant, &[(&observer, &[0.0; 3])], &X0, &inputs, span(2.0, 200)).unwrap();
        let varying = |i: usize, j: usize, t: f64| {
            let wave = (std::f64::consts::TAU * uncertainty.frequency[(i, j)] * t).sin();
            system.A[(i, j)] * (1.0 + if varies { uncertainty.amplitude[(i, j)] * wave } else { 0.0 })
        };
        let full = |t: f64, w: &DVector<f64>| {
            let (u, f) = (5.0 * (2.0 * t).sin(), 5.0 + 2.0 * (4.0 * t).sin());
            let x4 = -varying(2, 0, t) * w[0] / varying(2, 3, t);
            let x3 = (u - varying(3, 1, t) * w[1] - varying(3, 3, t) * x4) / varying(3, 2, t);
            let own = &observer.N * w.rows(2, 3) + &observer.L * (w[1] + 0.01 * rough(t)) + &observer.H * u;
            let x1 = varying(0, 2, t) * x3 + f;
            DVector::from_vec(vec![x1, varying(1, 0, t) * w[0], own[0], own[1], own[2]])
        };
        // steps that end at every kink
        let start = DVector::from_vec(vec![0.5, 0.0, 0.0, 0.0, 0.0]);
        let slow = runge_kutta(full, (0.0, 2.0, 40_000), start);
        let last = found.t.len() - 1;
        let error = (found.observers[0].z.column(last) - slow.rows(2, 3)).amax();
        println!("kinks, {:?}: {error:.1e} of {:.1}, {} steps", found.method, slow[4], found.steps);
        assert!(error < 1e-6, "{:?}: {error:.1e}", found.method);
    }
}

// ---------------------------------------------------------------- refusals

#[test]
fn a_plant_that_loses_index_1_is_refused_with_the_time() {
    let data = reference();
    let system = example_004(&data);
    let mut uncertainty = uncertainty_004(&data);
    // a34 (1 + 1.5 sin(2 pi 0.35 t)) first vanishes where sin = -2/3
    uncertainty.amplitude[(2, 3)] = 1.5;
    let expected = (std::f64::consts::PI + (2.0_f64 / 3.0).asin()) / (std::f64::consts::TAU * 0.35);
    let plant = Plant::new(&system, Some(&uncertainty), &Tolerance::default()).unwrap();
    let error = simulate(&plant, &[], &X0, &inputs_004(), span(6.0, 600)).unwrap_err();
    let SimulationError::LosesIndexOne { time, smallest, entries } = &error else { panic!("{error}") };
    assert!((time - expected).abs() < 1e-9, "at {time}, expected {expected}");
    assert!(*smallest < 1e-9, "singular there: {smallest:.1e}");
    assert!(entries.contains("A[3, 4]") && !entries.contains("A[1, 3]"), "only what enters A22: {entries}");
    // before that instant it runs
    assert!(simulate(&plant, &[], &X0, &inputs_004(), span(1.5, 600)).is_ok(), "regular until {expected}");
    // touching zero without a change of sign
    let touching = DescriptorSystem {
        E: dmatrix![1.0, 0.0, 0.0; 0.0, 0.0, 0.0; 0.0, 0.0, 0.0],
        A: dmatrix![-1.0, 0.0, 0.0; 0.0, 1.0, 0.0; 0.0, 0.0, 1.0],
        ..DescriptorSystem::autonomous(
            DMatrix::identity(3, 3),
            DMatrix::identity(3, 3),
            dmatrix![1.0, 0.0, 0.0],
        )
        .unwrap()
    };
    let both = Uncertainty {
        amplitude: dmatrix![0.0, 0.0, 0.0; 0.0, 2.0, 0.0; 0.0, 0.0, 2.0],
        frequency: DMatrix::from_element(3, 3, 0.1234),
        scale: 1.0,
    };
    let plant = Plant::new(&touching, Some(&both), &Tolerance::default()).unwrap();
    let error = simulate(&plant, &[], &[1.0; 3], &NONE, span(10.0, 100)).unwrap_err();
    assert!(
        matches!(error, SimulationError::LosesIndexOne { .. }),
        "the determinant only touches zero: {error}"
    );
}

#[test]
fn a_plant_of_index_2_is_refused() {
    let nilpotent = DescriptorSystem::autonomous(
        dmatrix![0.0, 1.0; 0.0, 0.0],
        DMatrix::identity(2, 2),
        dmatrix![1.0, 0.0],
    )
    .unwrap();
    let error = Plant::new(&nilpotent, None, &Tolerance::default()).unwrap_err();
    assert!(matches!(error, SimulationError::NotIndexOne { algebraic: 1, .. }), "{error}");
    assert!(error.to_string().contains("impulses"), "says what would happen: {error}");
}

#[test]
fn a_plant_that_is_not_square_is_refused() {
    let wide =
        DescriptorSystem::autonomous(dmatrix![1.0, 0.0], dmatrix![1.0, 1.0], dmatrix![1.0, 0.0]).unwrap();
    let error = Plant::new(&wide, None, &Tolerance::default()).unwrap_err();
    assert_eq!(error, SimulationError::NotSquare { equations: 1, states: 2 }, "one equation for two states");
}

#[test]
fn limits_and_shapes_are_named() {
    let plant = plant(&lag(1.0));
    let run = |x0: &[f64], span: Span| simulate(&plant, &[], x0, &NONE, span).unwrap_err().to_string();
    assert!(run(&[0.0], span(1.0, 10)).contains("x0 is 1 x 1, but 2 x 1"), "{}", run(&[0.0], span(1.0, 10)));
    assert!(run(&[0.0, f64::NAN], span(1.0, 10)).contains("x0"), "not a number");
    for horizon in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert!(run(&[0.0; 2], span(horizon, 10)).contains("horizon"), "horizon {horizon}");
    }
    for samples in [0, 1, 100_001] {
        assert!(run(&[0.0; 2], span(1.0, samples)).contains("samples"), "{samples} samples");
    }
    let mut observer = output_only(2, 1, 1, dmatrix![-1.0], dmatrix![1.0]);
    observer.V = DMatrix::zeros(3, 1);
    let error = simulate(&plant, &[(&observer, &[0.0])], &[0.0; 2], &NONE, span(1.0, 10)).unwrap_err();
    assert!(error.to_string().starts_with("V of observer 1 is 3 x 1"), "{error}");
    let large = output_only(2, 1, 1, DMatrix::zeros(399, 399), DMatrix::zeros(399, 1));
    let error = simulate(&plant, &[(&large, &[0.0; 399])], &[0.0; 2], &NONE, span(1.0, 10)).unwrap_err();
    assert_eq!(error, SimulationError::TooLarge { found: 401, most: 400 }, "two states and 399");
    let wrong = Uncertainty { amplitude: dmatrix![1.0], frequency: dmatrix![1.0], scale: 1.0 };
    let error = Plant::new(&lag(1.0), Some(&wrong), &Tolerance::default()).unwrap_err();
    assert!(error.to_string().contains("amplitude is 1 x 1"), "{error}");
}

#[test]
fn a_signal_without_value_is_named_by_both_methods() {
    let hole = |t: f64, out: &mut [f64]| out[0] = if t > 0.5 { f64::NAN } else { 1.0 };
    let inputs = Inputs { unknown: &hole, ..NONE };
    let uncertainty = Uncertainty {
        amplitude: DMatrix::from_element(2, 2, 0.1),
        frequency: DMatrix::from_element(2, 2, 1.0),
        scale: 1.0,
    };
    for uncertainty in [None, Some(&uncertainty)] {
        let plant = Plant::new(&lag(1.0), uncertainty, &Tolerance::default()).unwrap();
        let error = simulate(&plant, &[], &[0.0; 2], &inputs, span(1.0, 100)).unwrap_err();
        assert!(
            matches!(error, SimulationError::Signal { signal: "unknown input", index: 0, .. }),
            "{error}"
        );
    }
}

#[test]
fn an_unstable_plant_is_cut_off_with_a_note() {
    let uncertainty = Uncertainty {
        amplitude: DMatrix::from_element(2, 2, 0.1),
        frequency: DMatrix::from_element(2, 2, 1.0),
        scale: 1.0,
    };
    for uncertainty in [None, Some(&uncertainty)] {
        let plant = Plant::new(&lag(-5.0), uncertainty, &Tolerance::default()).unwrap();
        let found = simulate(&plant, &[], &[1.0, 1.0], &NONE, span(100.0, 1001)).unwrap();
        let note = found.note.as_deref().unwrap_or_default();
        assert!(note.contains("unstable"), "{:?}: {note}", found.method);
        // exp(5 t) = 1e12 at t = 5.53
        let last = found.t.last().copied().unwrap_or_default();
        assert!((5.2..5.8).contains(&last), "{:?} ends at {last}", found.method);
        assert_eq!(found.x.ncols(), found.t.len(), "all columns end together");
    }
    let violent = simulate(&plant(&lag(-1e6)), &[], &[1.0, 1.0], &NONE, span(1.0, 11)).unwrap();
    assert_eq!((violent.t.len(), violent.note.is_some()), (1, true), "even when the first step overflows");
}

// ---------------------------------------------------------------- discrete time and edges

#[test]
fn discrete_time_is_the_recursion() {
    // x1+ = 0.5 x1 + x2, 0 = x1 - 2 x2 + d: x1+ = x1 + d / 2
    let system = DescriptorSystem {
        time: TimeDomain::Discrete,
        A: dmatrix![0.5, 1.0; 1.0, -2.0],
        D: dmatrix![0.0; 1.0],
        ..lag(0.0)
    };
    let ramp = |t: f64, out: &mut [f64]| out[0] = t;
    let observer = output_only(2, 1, 1, dmatrix![0.5], dmatrix![1.0]);
    let inputs = Inputs { unknown: &ramp, ..NONE };
    let found =
        simulate(&plant(&system), &[(&observer, &[4.0])], &[1.0, 9.0], &inputs, span(20.5, 0)).unwrap();
    assert_eq!((found.method, found.t.len(), found.steps), (Method::Recursion, 21, 20), "steps 0 to 20");
    let (mut x1, mut z) = (1.0, 4.0);
    for k in 0..21 {
        let d = k as f64;
        let x2 = 0.5 * (x1 + d);
        assert!((found.x[(0, k)] - x1).abs() < 1e-11 && (found.x[(1, k)] - x2).abs() < 1e-11, "step {k}");
        assert!((found.observers[0].z[(0, k)] - z).abs() < 1e-11, "observer at step {k}");
        z = 0.5 * z + x2;
        x1 += 0.5 * d;
    }
}

#[test]
fn a_purely_algebraic_plant_runs() {
    let system = DescriptorSystem { E: DMatrix::zeros(2, 2), ..lag(2.0) };
    let uncertainty = Uncertainty {
        amplitude: DMatrix::from_element(2, 2, 0.1),
        frequency: DMatrix::from_element(2, 2, 1.0),
        scale: 1.0,
    };
    for uncertainty in [None, Some(&uncertainty)] {
        let plant = Plant::new(&system, uncertainty, &Tolerance::default()).unwrap();
        let inputs = Inputs { unknown: &unknown_004, ..NONE };
        let found = simulate(&plant, &[], &[1.0, 1.0], &inputs, span(1.0, 5)).unwrap();
        assert!((found.x[(0, 0)] - 2.5).abs() < 1e-12, "x1 = d / 2 at once, also at t = 0");
        assert_eq!(found.t.len(), 5, "no state to integrate");
    }
}

#[test]
fn a_plant_without_algebraic_part_runs() {
    let system = DescriptorSystem { E: DMatrix::identity(2, 2), ..lag(1.0) };
    let found = simulate(&plant(&system), &[], &[1.0, 0.0], &NONE, span(1.0, 5)).unwrap();
    assert!((found.x[(1, 4)] - (-1.0_f64).exp()).abs() < 1e-12, "x2 = t exp(-t)");
    assert_eq!((found.smallest_a22, found.initial_state.change), (f64::INFINITY, 0.0), "nothing algebraic");
}

#[test]
fn comparing_designs_does_not_change_the_plant() {
    let data = reference();
    let plant =
        Plant::new(&example_004(&data), Some(&uncertainty_004(&data)), &Tolerance::default()).unwrap();
    let observer = observer_004(&data, "full");
    let alone = simulate(&plant, &[], &X0, &inputs_004(), span(3.0, 100)).unwrap();
    let observed = simulate(&plant, &[(&observer, &[0.0; 5])], &X0, &inputs_004(), span(3.0, 100)).unwrap();
    let difference = (&alone.x - &observed.x).amax();
    assert!(difference < 1e-6, "plant with and without observer: {difference:.1e}");
    let e = &observed.observers[0].e;
    let rms = observed.rms(e, 1.0);
    assert!(rms.len() == 4 && rms.iter().all(|r| *r < 0.2), "after a second the errors are small: {rms:?}");
}

/// Numbers in -1..1 from a seed.
fn draw(seed: &mut u64) -> f64 {
    *seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
    (*seed >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
}

#[test]
fn any_system_gives_a_trajectory_or_a_reason() {
    let mut seed = 2026;
    let (mut whole, mut cut, mut refused, mut failed) = (0, 0, 0, 0);
    for case in 0..150 {
        let n = 1 + case % 6;
        let mut any = |rows: usize, columns: usize, size: f64| {
            DMatrix::from_fn(rows, columns, |_, _| size * draw(&mut seed))
        };
        let size = [1.0, 1e-6, 1e3, 1e8][case / 6 % 4];
        let mut e = any(n, n, 1.0);
        e.columns_mut(0, case % 3 % n).fill(0.0);
        let system = DescriptorSystem {
            time: if case % 10 == 0 { TimeDomain::Discrete } else { TimeDomain::Continuous },
            E: e,
            A: any(n, n, size),
            B: any(n, 2, 1.0),
            C: any(2, n, 1.0),
            D: any(n, 1, size),
            F: any(2, 1, 1.0),
        };
        let uncertainty = Uncertainty {
            amplitude: any(n, n, 0.3),
            frequency: any(n, n, [1.0, 30.0][case % 2]),
            scale: f64::from(u8::from(case % 3 != 0)),
        };
        let mut observer = output_only(n, 2, 2, any(3, 3, size), any(3, 2, size));
        observer.P = any(n, 3, 1.0);
        let jumps: Vec<f64> = any(4, 1, 2.0).iter().flat_map(|t| [*t, t + 1e-12, t + 1e-9]).collect();
        let steps = |t: f64, out: &mut [f64]| {
            out.fill(jumps.iter().filter(|jump| t >= **jump).count() as f64);
        };
        let kinks: Vec<f64> = any(20, 1, 2.0).iter().copied().chain([0.5, 1.0]).collect();
        let inputs =
            Inputs { known: &steps, unknown: &unknown_004, noise: &steps, jumps: &jumps, kinks: &kinks };
        let start = any(n, 1, 1.0);
        let horizon = if case % 10 == 0 { 30.0 } else { 1.0 };
        let found = Plant::new(&system, Some(&uncertainty), &Tolerance::default()).and_then(|plant| {
            simulate(&plant, &[(&observer, &[0.0; 3])], start.as_slice(), &inputs, span(horizon, 31))
        });
        match found {
            Ok(trajectory) => {
                let finite = trajectory.x.iter().chain(trajectory.y.iter()).all(|x| x.is_finite());
                assert!(finite, "case {case}: a trajectory is finite");
                assert_eq!(trajectory.x.ncols(), trajectory.t.len(), "case {case}: a column per instant");
                assert!(
                    trajectory.t.len() == 31 || trajectory.note.is_some(),
                    "case {case}: cut without a note"
                );
                if trajectory.note.is_some() { cut += 1 } else { whole += 1 }
            }
            Err(SimulationError::Integration(error)) => {
                println!("case {case}: {error}");
                failed += 1;
            }
            Err(error) => {
                assert!(!error.to_string().is_empty(), "case {case}: a reason in words");
                refused += 1;
            }
        }
    }
    println!("{whole} whole, {cut} cut off, {refused} refused, {failed} failed");
    assert!(whole > 20 && cut > 5 && refused > 5, "{whole} whole, {cut} cut off, {refused} refused");
    assert!(failed <= 5, "the stiff solver failed {failed} times");
}

#[test]
fn a_signal_that_jumps_too_often_is_refused_and_named() {
    let signal = descry::system::Signal::parse("square(1e5*t)").unwrap();
    let system = descry::system::DescriptorSystem {
        B: nalgebra::dmatrix![1.0],
        ..descry::system::DescriptorSystem::autonomous(
            nalgebra::dmatrix![1.0],
            nalgebra::dmatrix![-1.0],
            nalgebra::dmatrix![1.0],
        )
        .unwrap()
    };
    let scenario = descry::simulation::Scenario {
        horizon: 6.0,
        samples: 61,
        x0: nalgebra::dvector![0.0],
        u: vec![signal],
        d: Vec::new(),
        noise: Vec::new(),
        uncertainty: None,
        free: descry::simulation::FreeVariables::default(),
    };
    let error = scenario.run_linear(&system, &[], &Tolerance::default()).unwrap_err().to_string();
    assert!(error.contains("square(1e5*t)") && error.contains("10000"), "{error}");
}
