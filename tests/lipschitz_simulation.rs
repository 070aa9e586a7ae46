//! Nonlinear plants and observers in time: printed vectors, closed forms, an independent integrator, and refusals.
#![expect(clippy::unwrap_used, reason = "helpers of tests fail by panicking")]

use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

use descry::numerics::{Tolerance, Watch};
use descry::observer::{Injection, LinearObserver};
use descry::simulation::{
    FreeVariables, Method, Observed, Scenario, SimulationError, Trajectory, Uncertainty,
};
use descry::system::{DescriptorSystem, LipschitzTerm, Model, Signal, TimeDomain, nonlinearity};
use nalgebra::{DMatrix, DVector, dmatrix, dvector};
use serde_json::Value;

fn matrix(value: &Value) -> DMatrix<f64> {
    let rows: Vec<Vec<f64>> = serde_json::from_value(value.clone()).unwrap();
    DMatrix::from_fn(rows.len(), rows[0].len(), |i, j| rows[i][j])
}

fn vector(value: &Value) -> DVector<f64> {
    DVector::from_vec(serde_json::from_value(value.clone()).unwrap())
}

fn signals(texts: &[&str]) -> Vec<Signal> {
    texts.iter().map(|text| Signal::parse(text).unwrap()).collect()
}

fn scenario(horizon: f64, samples: usize, x0: DVector<f64>) -> Scenario {
    Scenario {
        horizon,
        samples,
        x0,
        u: Vec::new(),
        d: Vec::new(),
        noise: Vec::new(),
        uncertainty: None,
        free: FreeVariables::default(),
    }
}

/// `E x' = A x + G f(x) + B u`, `y = C x` with the first state as the output.
fn model(e: DMatrix<f64>, a: DMatrix<f64>, g: DMatrix<f64>, f: &[&str]) -> Model {
    let n = a.ncols();
    let mut c = DMatrix::zeros(1, n);
    c[0] = 1.0;
    let system = DescriptorSystem {
        B: DMatrix::from_fn(n, 1, |i, _| f64::from(u8::from(i == 0))),
        ..DescriptorSystem::autonomous(e, a, c).unwrap()
    };
    let f = f.iter().map(|text| nonlinearity(text, n).unwrap()).collect();
    let term = LipschitzTerm { G: g, F_L: DMatrix::identity(n, n), f, constant: 10.0 };
    Model { lipschitz: Some(term), ..Model::from(system) }
}

fn run(
    scenario: &Scenario,
    model: &Model,
    observers: &[Observed<'_>],
) -> Result<Trajectory, SimulationError> {
    scenario.run(model, observers, &Tolerance::default(), &Watch::none())
}

/// An observer of one state with `x_hat = P z + V y`.
fn observer(n: DMatrix<f64>, l: DMatrix<f64>, p: DMatrix<f64>, v: DMatrix<f64>) -> LinearObserver {
    let (o, states) = (n.nrows(), p.nrows());
    LinearObserver {
        N: n,
        L: l,
        H: DMatrix::zeros(o, 1),
        P: p,
        V: v,
        W: DMatrix::zeros(states, 1),
        Q: DMatrix::zeros(0, o),
        R: DMatrix::zeros(0, 1),
        S: DMatrix::zeros(0, 1),
    }
}

// ---------------------------------------------------------------- paper 002

fn example_002() -> Model {
    let ones = dmatrix![1.0; 1.0; 1.0];
    let system = DescriptorSystem {
        time: TimeDomain::Continuous,
        E: dmatrix![0.0, 1.0, 0.0; 0.0, 0.0, 1.0; 0.0, 0.0, 0.0],
        A: dmatrix![1.0, 0.0, 0.0; 0.0, 1.0, 0.0; 1.0, 0.0, 1.0],
        B: ones.clone(),
        C: dmatrix![1.0, 0.0, 0.0],
        D: dmatrix![1.0, 1.0; 1.0, -1.0; 1.0, 1.0],
        F: dmatrix![1.0, 1.0],
    };
    let term = LipschitzTerm {
        G: ones,
        F_L: dmatrix![0.0, 1.0, 0.0],
        f: vec![nonlinearity("sin(x2)", 3).unwrap()],
        constant: 1.0,
    };
    Model { lipschitz: Some(term), ..Model::from(system) }
}

/// The printed observer, made exact, in the common form; `Phi B = Phi G = 1`.
fn observer_002(data: &Value) -> (LinearObserver, Injection) {
    let of = |letter: &str| matrix(&data[letter]);
    let back = -of("Q");
    let linear = LinearObserver {
        N: of("N"),
        L: of("J"),
        H: of("H"),
        P: of("P"),
        V: of("F"),
        W: back.clone(),
        Q: DMatrix::zeros(0, 2),
        R: DMatrix::zeros(0, 1),
        S: DMatrix::zeros(0, 1),
    };
    (linear, Injection { state: of("T") * dmatrix![1.0; 1.0; 1.0], estimate: back })
}

fn scenario_002(horizon: f64, samples: usize, d: &[&str]) -> Scenario {
    Scenario {
        u: signals(&["sin(2*t)"]),
        d: signals(d),
        ..scenario(horizon, samples, dvector![0.0, 0.5, 0.5])
    }
}

fn worst_002(rows: &Value, time: impl Fn(&Value) -> f64, x_hat: &str, found: &Trajectory) -> f64 {
    let mut worst = 0.0_f64;
    let rows: Vec<(f64, &Value)> = match rows {
        Value::Object(map) => map.iter().map(|(t, row)| (t.parse().unwrap(), row)).collect(),
        other => other.as_array().unwrap().iter().map(|row| (time(row), row)).collect(),
    };
    assert!(rows.len() >= 5, "there is something to compare");
    for (t, row) in rows {
        let at = found.t.iter().position(|s| (s - t).abs() < 1e-9).unwrap();
        worst = worst.max((found.x.column(at) - vector(&row["x"])).amax());
        worst = worst.max((found.observers[0].x_hat.column(at) - vector(&row[x_hat])).amax());
    }
    worst
}

#[test]
fn the_printed_observer_of_002_follows_its_vectors() {
    let data: Value = serde_json::from_str(include_str!("reference/ex002_trajectory.json")).unwrap();
    let (linear, injection) = observer_002(&data);
    let observed = Observed { observer: &linear, injection: Some(&injection) };
    let found = run(&scenario_002(10.0, 101, &[]), &example_002(), &[observed]).unwrap();
    let worst = worst_002(&data["ref"], |row| row["t"].as_f64().unwrap(), "xhat", &found);
    println!("{worst:.1e}, {} steps, {:?}", found.steps, found.method);
    assert!(worst < 1e-6, "{worst:.1e}");
    assert_eq!(found.method, Method::Explicit, "nothing is stiff");
    assert!(found.remarks.is_empty() && found.note.is_none(), "{:?}", found.remarks);
    let expected = -0.5 - 0.5_f64.sin();
    assert!((found.initial_state.consistent[0] - expected).abs() < 1e-12, "x1(0) contains sin(x2)");
    assert_eq!(found.observers[0].contraction, None, "F_L Q Phi G = 0: the estimate is explicit");
}

#[test]
fn four_hundred_kinks_of_noise_agree_with_an_independent_integrator() {
    let vectors: Value = serde_json::from_str(include_str!("reference/ex002_trajectory.json")).unwrap();
    let reference: Value = serde_json::from_str(include_str!("reference/ex002_noise.json")).unwrap();
    let (linear, injection) = observer_002(&vectors);
    let observed = Observed { observer: &linear, injection: Some(&injection) };
    let noise = ["0.2*noise(t/0.05, 1)*(t < 20)", "0.2*noise(t/0.05, 2)*(t < 20)"];
    let found = run(&scenario_002(40.0, 801, &noise), &example_002(), &[observed]).unwrap();
    let worst = worst_002(&reference["ref"], |row| row["t"].as_f64().unwrap(), "x_hat", &found);
    println!("{worst:.1e}, {} steps", found.steps);
    assert!(worst < 1e-6, "{worst:.1e}");
    assert!(found.steps < 2000, "one or two steps for each kink, not fifty: {}", found.steps);
    let last = found.observers[0].e.column(800).amax();
    assert!(last < 1e-3, "without noise the error decays: {last:.1e}");
}

#[test]
fn a_linear_observer_runs_beside_a_nonlinear_plant() {
    let data: Value = serde_json::from_str(include_str!("reference/ex002_trajectory.json")).unwrap();
    let (linear, injection) = observer_002(&data);
    let with = Observed { observer: &linear, injection: Some(&injection) };
    let found = run(&scenario_002(10.0, 101, &[]), &example_002(), &[(&linear).into(), with]).unwrap();
    let alone = run(&scenario_002(10.0, 101, &[]), &example_002(), &[]).unwrap();
    assert!((&found.x - &alone.x).amax() < 1e-7, "observers do not move the plant");
    let last = |i: usize| found.observers[i].e.column(100).amax();
    assert!(last(1) < 5e-3 && last(0) > 10.0 * last(1), "{:.1e} without, {:.1e} with f", last(0), last(1));
}

// ---------------------------------------------------------------- closed forms

#[test]
fn the_pendulum_returns_after_its_elliptic_period() {
    // x1'' = -x3, 0 = x3 - sin x1: the algebraic state contains f
    let plant = model(
        dmatrix![1.0, 0.0, 0.0; 0.0, 1.0, 0.0; 0.0, 0.0, 0.0],
        dmatrix![0.0, 1.0, 0.0; 0.0, 0.0, -1.0; 0.0, 0.0, 1.0],
        dmatrix![0.0; 0.0; -1.0],
        &["sin(x1)"],
    );
    // period 2 pi / agm(1, cos(amplitude / 2))
    let (mut a, mut b) = (1.0, 1.0_f64.cos());
    for _ in 0..8 {
        (a, b) = (f64::midpoint(a, b), (a * b).sqrt());
    }
    let period = std::f64::consts::TAU / a;
    let found = run(&scenario(3.0 * period, 301, dvector![2.0, 0.0, 0.0]), &plant, &[]).unwrap();
    for k in [100, 200, 300] {
        let off = (found.x[(0, k)] - 2.0).abs().max(found.x[(1, k)].abs());
        assert!(off < 1e-6, "after {} periods: {off:.1e}", k / 100);
    }
    let energy = |k: usize| 0.5 * found.x[(1, k)].powi(2) - found.x[(0, k)].cos();
    let drift = (0..301).map(|k| (energy(k) - energy(0)).abs()).fold(0.0, f64::max);
    let between = (0..301).map(|k| (found.x[(2, k)] - found.x[(0, k)].sin()).abs()).fold(0.0, f64::max);
    println!("energy drifts by {drift:.1e} in {} steps", found.steps);
    assert!(drift < 1e-6 && between < 1e-15, "energy {drift:.1e}, x3 - sin x1 {between:.1e}");
}

/// The root of `x - cos x - level` between -4 and 4, by bisection.
fn root(level: f64) -> f64 {
    let (mut low, mut high) = (-4.0_f64, 4.0_f64);
    for _ in 0..80 {
        let middle = f64::midpoint(low, high);
        if middle - 0.5 * middle.cos() < level { low = middle } else { high = middle }
    }
    f64::midpoint(low, high)
}

#[test]
fn an_implicit_algebraic_equation_is_solved_at_every_instant() {
    // x1' = -x1, 0 = x2 - 0.5 cos x2 - x1
    let plant = model(
        dmatrix![1.0, 0.0; 0.0, 0.0],
        dmatrix![-1.0, 0.0; -1.0, 1.0],
        dmatrix![0.0; -0.5],
        &["cos(x2)"],
    );
    let found = run(&scenario(4.0, 81, dvector![2.0, 0.0]), &plant, &[]).unwrap();
    for (k, t) in found.t.iter().enumerate() {
        let level = 2.0 * (-t).exp();
        assert!((found.x[(0, k)] - level).abs() < 1e-8, "x1({t})");
        let off = (found.x[(1, k)] - root(found.x[(0, k)])).abs();
        assert!(off < 1e-14, "x2({t}) is off by {off:.1e}");
    }
    // A22 + U2' G df/dx V2 = 1 + 0.5 sin x2 with x2 from 0.45 to 1.96 (signs of U2, V2 aside)
    assert!((1.2..1.25).contains(&found.smallest_a22), "1 + 0.5 sin 0.45: {}", found.smallest_a22);
    assert!((found.initial_state.consistent[1] - root(2.0)).abs() < 1e-14, "the start is consistent");
}

/// `x1' = -1 + u`, `0 = x2^2 - x1`.
fn fold() -> Model {
    model(
        dmatrix![1.0, 0.0; 0.0, 0.0],
        dmatrix![0.0, 0.0; -1.0, 0.0],
        dmatrix![0.0, -1.0; 1.0, 0.0],
        &["x2^2", "1"],
    )
}

#[test]
fn the_given_state_chooses_among_several_solutions() {
    for sign in [1.0, -1.0] {
        let found = run(&scenario(0.9, 10, dvector![1.0, sign * 0.6]), &fold(), &[]).unwrap();
        let off = (0..10).map(|k| (found.x[(1, k)] - sign * (1.0 - found.t[k]).sqrt()).abs());
        let off = off.fold(0.0, f64::max);
        assert!(off < 1e-8, "x2 = {sign} sqrt(1 - t): {off:.1e}");
    }
}

#[test]
fn a_singular_jacobian_on_the_way_is_reported_with_its_time() {
    let error = run(&scenario(2.0, 101, dvector![1.0, 1.0]), &fold(), &[]).unwrap_err();
    let SimulationError::SingularAlgebraic { time, smallest } = error else { panic!("{error}") };
    assert!((time - 1.0).abs() < 1e-5, "the fold is reached at 1, reported {time}");
    assert!(smallest < 1e-2, "2 x2 tends to zero: {smallest:.1e}");
    let error = run(&scenario(2.0, 101, dvector![0.0, 0.0]), &fold(), &[]).unwrap_err().to_string();
    assert!(error.contains("t = 0.000000"), "singular from the start: {error}");
    let error = run(&scenario(2.0, 101, dvector![-1.0, 1.0]), &fold(), &[]).unwrap_err();
    assert_eq!(error, SimulationError::NoAlgebraicSolution { time: 0.0 }, "x2^2 = -1");
}

#[test]
fn a_stiff_observer_is_left_to_the_implicit_method() {
    // z' = -k (z - y) follows y = x1 at the distance y' / k
    let plant =
        model(DMatrix::identity(2, 2), dmatrix![0.0, 1.0; 0.0, 0.0], dmatrix![0.0; -1.0], &["sin(x1)"]);
    let k = 1e5;
    let fast = observer(dmatrix![-k], dmatrix![k], dmatrix![1.0; 0.0], dmatrix![0.0; 0.0]);
    let found = run(&scenario(10.0, 201, dvector![1.0, 0.0]), &plant, &[(&fast).into()]).unwrap();
    println!("{:?} in {} steps", found.method, found.steps);
    assert_eq!(found.method, Method::Implicit, "the observer is a hundred thousand times faster");
    assert!(found.steps < 2000, "{} steps", found.steps);
    for at in 1..201 {
        let (x1, x2) = (found.x[(0, at)], found.x[(1, at)]);
        let follows = x1 - x2 / k - x1.sin() / (k * k);
        let off = (found.observers[0].z[(0, at)] - follows).abs();
        assert!(off < 1e-7, "at {}: {off:.1e}", found.t[at]);
    }
}

#[test]
fn a_nonlinearity_that_jumps_in_time_and_an_uncertain_entry_are_followed() {
    // x' = -x (1 + 0.5 sin 2 pi t) - step(t - 1.03) x
    let plant = model(dmatrix![1.0], dmatrix![-1.0], dmatrix![-1.0], &["step(t - 1.03)*x1"]);
    let uncertainty = Uncertainty { amplitude: dmatrix![0.5], frequency: dmatrix![1.0], scale: 1.0 };
    let scenario = Scenario { uncertainty: Some(uncertainty), ..scenario(3.0, 31, dvector![1.0]) };
    let found = run(&scenario, &plant, &[]).unwrap();
    for (k, t) in found.t.iter().enumerate() {
        let turn = std::f64::consts::TAU;
        let exponent = t + 0.5 * (1.0 - (turn * t).cos()) / turn + (t - 1.03).max(0.0);
        let off = (found.x[(0, k)] - (-exponent).exp()).abs();
        assert!(off < 5e-8, "at {t}: {off:.1e}");
    }
}

#[test]
fn discrete_time_is_the_nonlinear_recursion() {
    // x1+ = 0.9 sin x1 + x2, 0 = x2 - 0.5 cos x2 - 0.1 x1; z+ = 0.5 z + y + f1(x_hat), x_hat = [z; y]
    let mut plant = model(
        dmatrix![1.0, 0.0; 0.0, 0.0],
        dmatrix![0.0, 1.0; -0.1, 1.0],
        dmatrix![0.9, 0.0; 0.0, -0.5],
        &["sin(x1)", "cos(x2)"],
    );
    plant.system.time = TimeDomain::Discrete;
    let linear = observer(dmatrix![0.5], dmatrix![1.0], dmatrix![1.0; 0.0], dmatrix![0.0; 1.0]);
    let injection = Injection { state: dmatrix![1.0, 0.0], estimate: DMatrix::zeros(2, 2) };
    let observed = Observed { observer: &linear, injection: Some(&injection) };
    let found = run(&scenario(30.0, 0, dvector![1.0, 0.0]), &plant, &[observed]).unwrap();
    let (mut x1, mut z) = (1.0_f64, 0.0_f64);
    for k in 0..=30 {
        let x2 = root(0.1 * x1);
        let off = (found.x.column(k) - dvector![x1, x2]).amax();
        let off = off.max((found.observers[0].x_hat.column(k) - dvector![z, x1]).amax());
        assert!(off < 1e-12, "step {k}: {off:.1e}");
        z = 0.5 * z + x1 + z.sin();
        x1 = 0.9 * x1.sin() + x2;
    }
    assert_eq!((found.method, found.steps), (Method::Recursion, 30), "no integrator");
}

// ---------------------------------------------------------------- the estimate's own equation

/// `x' = -x`, observed by `x_hat = y + gain f(x_hat)`.
fn own_equation(f: &str, gain: f64, x0: f64) -> Trajectory {
    let plant = model(dmatrix![1.0], dmatrix![-1.0], dmatrix![0.0], &[f]);
    let linear = observer(dmatrix![-1.0], dmatrix![0.0], dmatrix![0.0], dmatrix![1.0]);
    let injection = Injection { state: dmatrix![1.0], estimate: dmatrix![gain] };
    let observed = Observed { observer: &linear, injection: Some(&injection) };
    run(&scenario(5.0, 101, dvector![x0]), &plant, &[observed]).unwrap()
}

#[test]
fn the_estimate_satisfies_its_own_equation_to_rounding() {
    for gain in [0.7, 1.5] {
        let found = own_equation("sin(x1)", gain, 4.0);
        let own = &found.observers[0];
        let off = (0..101).map(|k| (own.x_hat[k] - found.x[k] - gain * own.x_hat[k].sin()).abs());
        let off = off.fold(0.0, f64::max);
        assert!(off < 1e-14, "gain {gain}: {off:.1e}");
        let factor = own.contraction.unwrap();
        assert!(factor <= gain && factor > 0.9 * gain, "slope at most {gain}: {factor}");
        let told = found.remarks.iter().any(|remark| remark.contains("does not contract"));
        assert_eq!(told, gain > 1.0, "gain {gain}: {:?}", found.remarks);
    }
}

#[test]
fn an_estimate_without_solution_ends_the_trajectory() {
    // x_hat = y + x_hat^2 has a solution for y <= 1/4 only: y = -exp(-t) + ... falls from -1, so start above
    let found = own_equation("x1^2", -1.0, -0.2);
    assert!(found.note.is_none(), "y > -1/4 all the time: {:?}", found.note);
    let plant = model(dmatrix![1.0], dmatrix![1.0], dmatrix![0.0], &["x1^2"]);
    let linear = observer(dmatrix![-1.0], dmatrix![0.0], dmatrix![0.0], dmatrix![1.0]);
    let injection = Injection { state: dmatrix![1.0], estimate: dmatrix![1.0] };
    let observed = Observed { observer: &linear, injection: Some(&injection) };
    // y = 0.1 exp(t) passes 1/4 at ln 2.5
    let found = run(&scenario(2.0, 201, dvector![0.1]), &plant, &[observed]).unwrap();
    let note = found.note.unwrap();
    let last = *found.t.last().unwrap();
    assert!(note.contains("output equation") && note.contains("observer 1"), "{note}");
    assert!((last - 2.5_f64.ln()).abs() < 0.02, "ends at {last}, expected {}", 2.5_f64.ln());
}

#[test]
fn a_lipschitz_constant_that_the_motion_exceeds_is_told() {
    let mut plant = example_002();
    if let Some(term) = &mut plant.lipschitz {
        term.constant = 0.5;
    }
    let found = run(&scenario_002(10.0, 101, &[]), &plant, &[]).unwrap();
    assert_eq!(found.remarks.len(), 1, "{:?}", found.remarks);
    let remark = &found.remarks[0];
    assert!(remark.contains("0.5 is exceeded") && remark.contains("t ="), "says where: {remark}");
}

// ---------------------------------------------------------------- ends and refusals

#[test]
fn an_input_that_overflows_is_named_in_every_method() {
    let linear = Model::from(DescriptorSystem {
        B: dmatrix![1.0],
        ..DescriptorSystem::autonomous(dmatrix![1.0], dmatrix![-1.0], dmatrix![1.0]).unwrap()
    });
    let nonlinear = model(dmatrix![1.0], dmatrix![-1.0], dmatrix![1.0], &["sin(x1)"]);
    let mut discrete = nonlinear.clone();
    discrete.system.time = TimeDomain::Discrete;
    for plant in [&linear, &nonlinear, &discrete] {
        let scenario = Scenario { u: signals(&["exp(3*t)"]), ..scenario(20.0, 401, dvector![0.0]) };
        let found = run(&scenario, plant, &[]).unwrap();
        let note = found.note.unwrap();
        assert!(note.contains("known input 1 exceeds"), "{:?}: {note}", found.method);
        assert!(!note.contains("unstable"), "{note}");
    }
    // by itself it is still the plant
    let unstable = model(dmatrix![1.0], dmatrix![5.0], dmatrix![1.0], &["sin(x1)"]);
    let note = run(&scenario(20.0, 401, dvector![1.0]), &unstable, &[]).unwrap().note.unwrap();
    assert!(note.contains("unstable"), "{note}");
}

#[test]
fn a_motion_that_escapes_or_leaves_the_domain_ends_with_a_note() {
    // x = 1 / (1 - t)
    let escape = model(dmatrix![1.0], dmatrix![0.0], dmatrix![1.0], &["x1^2"]);
    let found = run(&scenario(2.0, 201, dvector![1.0]), &escape, &[]).unwrap();
    let last = *found.t.last().unwrap();
    assert!(found.note.is_some() && (0.97..1.0).contains(&last), "{last}: {:?}", found.note);
    // x' = -1 / sqrt(x): x^(3/2) = 1 - 1.5 t
    let domain = model(dmatrix![1.0], dmatrix![0.0], dmatrix![-1.0], &["1/sqrt(x1)"]);
    let found = run(&scenario(2.0, 201, dvector![1.0]), &domain, &[]).unwrap();
    let note = found.note.unwrap();
    assert!(note.contains("no finite value"), "{note}");
    let last = *found.t.last().unwrap();
    assert!((last - 2.0 / 3.0).abs() < 0.02, "ends at {last}");
}

#[test]
fn a_simulation_can_be_cancelled_in_every_method() {
    let linear =
        Model::from(DescriptorSystem::autonomous(dmatrix![1.0], dmatrix![-1.0], dmatrix![1.0]).unwrap());
    let nonlinear = model(dmatrix![1.0], dmatrix![-1.0], dmatrix![1.0], &["sin(30*x1 + 500*t)"]);
    let mut discrete = nonlinear.clone();
    discrete.system.time = TimeDomain::Discrete;
    for plant in [&linear, &nonlinear, &discrete] {
        let asked = Arc::new(AtomicUsize::new(0));
        let count = Arc::clone(&asked);
        let watch = Watch::new(move |_, _| count.fetch_add(1, Ordering::Relaxed) < 3);
        let long = scenario(1000.0, 2000, dvector![1.0]);
        let error = long.run(plant, &[], &Tolerance::default(), &watch).unwrap_err();
        assert_eq!(error, SimulationError::Cancelled, "{plant:?}");
        assert_eq!(asked.load(Ordering::Relaxed), 4, "it stops when it is told");
    }
}

#[test]
fn what_does_not_fit_is_named() {
    let plant = example_002();
    let data: Value = serde_json::from_str(include_str!("reference/ex002_trajectory.json")).unwrap();
    let (linear, injection) = observer_002(&data);
    let says = |model: &Model, injection: &Injection| {
        let observed = Observed { observer: &linear, injection: Some(injection) };
        run(&scenario_002(1.0, 11, &[]), model, &[observed]).unwrap_err().to_string()
    };
    let wrong = says(&plant, &Injection { state: dmatrix![1.0], ..injection.clone() });
    assert!(wrong.starts_with("the injection into the state of observer 1 is 1 x 1, but 2 x 1"), "{wrong}");
    let wrong = says(&plant, &Injection { estimate: dmatrix![1.0; f64::NAN; 1.0], ..injection.clone() });
    assert!(wrong.contains("the estimate of observer 1") && wrong.contains("finite"), "{wrong}");
    let wrong = says(&Model { lipschitz: None, ..plant.clone() }, &injection);
    assert!(wrong.contains("the plant has no nonlinearity"), "{wrong}");
    let mut other = plant.clone();
    if let Some(term) = &mut other.lipschitz {
        term.G = dmatrix![1.0];
    }
    let wrong = says(&other, &injection);
    assert!(wrong.starts_with("G is 1 x 1, but 3 x 1 is needed"), "{wrong}");
}
