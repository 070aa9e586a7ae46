//! Plants with free variables in time: the paper's example and cases with closed forms.

#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

use super::*;
use descry::numerics::Watch;
use descry::simulation::{
    FreeVariables, Inputs, Plant, Scenario, SimulationError, Span, Trajectory, Uncertainty, WidePlant,
    simulate,
};
use descry::system::{Signal, nonlinearity};
use nalgebra::dvector;

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

/// The paper's example from the reference initial state.
fn scenario_001(horizon: f64, samples: usize, d: &str) -> Scenario {
    Scenario {
        u: signals(&["sin(t)", "0.5*cos(2*t)"]),
        d: signals(&[d]),
        ..scenario(horizon, samples, dvector![1.0, -1.0, 0.0, 0.0])
    }
}

fn run(
    system: &DescriptorSystem,
    scenario: &Scenario,
    free: &FreeVariables,
    observers: &[&Design],
) -> Result<Trajectory, SimulationError> {
    let observed: Vec<_> = observers.iter().map(|design| (*design).into()).collect();
    let scenario = Scenario { free: free.clone(), ..scenario.clone() };
    scenario.run(&system.clone().into(), &observed, &Tolerance::default(), &Watch::none())
}

fn following(texts: &[&str]) -> FreeVariables {
    FreeVariables { signals: signals(texts), feedback: None }
}

/// `e^M` by Taylor series after scaling, apart from the product's own exponential.
pub(crate) fn exponential(m: &DMatrix<f64>) -> DMatrix<f64> {
    let (mut halvings, mut size) = (10, m.norm());
    while size > 1.0 {
        (halvings, size) = (halvings + 1, size / 2.0);
    }
    let small = m / 2.0_f64.powi(halvings);
    let mut term = DMatrix::identity(m.nrows(), m.ncols());
    let mut sum = term.clone();
    for k in 1..12 {
        term = term * &small / f64::from(k);
        sum += &term;
    }
    for _ in 0..halvings {
        sum = &sum * &sum;
    }
    sum
}

/// Largest distance of the errors from `K e^(H t) e0` and `G e^(H t) e0`, relative to the initial error.
pub(crate) fn off_the_law(design: &Design, found: &Trajectory, x1: &[usize]) -> f64 {
    let [H, K] = ["H", "K"].map(|name| design.matrix(name).unwrap());
    // without unknown inputs there is no G
    let none = DMatrix::zeros(0, H.ncols());
    let G = design.matrix("G").unwrap_or(&none);
    let observer = &found.observers[0];
    let e0 = observer.z.column(0) - found.x.column(0).select_rows(x1);
    let mut worst = 0.0_f64;
    for (i, t) in found.t.iter().enumerate() {
        let e = exponential(&(H * *t)) * &e0;
        // the program's error is x - x_hat, the paper's x_hat - x
        worst = worst.max((observer.e.column(i) + K * &e).amax());
        worst = worst.max((observer.e_d.column(i) + G * &e).norm());
    }
    worst / e0.amax()
}

#[test]
fn errors_are_exponentials_whatever_the_unknown_input_and_the_free_states_do() {
    let design = paper_design(Order::Full);
    // the plant is unstable with v = 0; feedback puts its modes at -1 +- i
    let feedback = dmatrix![5.0, -1.0, 0.0, 0.0] / 2.0_f64.sqrt();
    let bounded = FreeVariables { signals: signals(&["0.5*sin(1.7*t)"]), feedback: Some(feedback.clone()) };
    for d in ["0", "1.5*sin(3*t)", "1.5*sin(3*t) + 2*square(0.8*t)", "5*step(t-1) + exp(0.3*t)"] {
        let found = run(&example(), &scenario_001(6.0, 301, d), &bounded, &[&design]).unwrap();
        let off = off_the_law(&design, &found, &[0, 1]);
        assert!(off < 1e-8, "d = {d}: off by {off:.1e}");
        assert!(found.x.amax() < 40.0, "d = {d}: the plant is bounded, {}", found.x.amax());
        let last = found.observers[0].e_d.column(300).amax();
        assert!(last < 0.02, "d = {d}: e^-6 is left of the error of d, {last:.1e}");
    }
    let at = coordinates(&example(), &Tolerance::default()).unwrap();
    let kernel = dmatrix![1.0; -1.0] / 2.0_f64.sqrt();
    let A4_pinv = pseudo_inverse(&at.A4, &Tolerance::default()).unwrap();
    let closed = &at.A1 - &at.A2 * (A4_pinv * &at.A3 + kernel * feedback.columns(0, 2));
    let spectrum = eigenvalues(&closed).unwrap();
    let wished = [Complex64::new(-1.0, 1.0), Complex64::new(-1.0, -1.0)];
    assert!(spectral_distance(&spectrum, &wished) < 1e-12, "{spectrum:?}");
    // without inputs the plant follows e^(closed t)
    let quiet = scenario(3.0, 31, dvector![1.0, -1.0, 0.0, 0.0]);
    let free = FreeVariables { signals: Vec::new(), feedback: Some(feedback) };
    let found = run(&example(), &quiet, &free, &[]).unwrap();
    for (i, t) in found.t.iter().enumerate() {
        let x1 = exponential(&(&closed * *t)) * dvector![1.0, -1.0];
        let off = (found.x.column(i).rows(0, 2) - x1).amax();
        assert!(off < 1e-10, "t = {t}: off by {off:.1e}");
    }
}

#[test]
fn random_designs_obey_the_law_of_their_errors() {
    for (i, size) in random::SIZES.iter().enumerate().filter(|(_, size)| size.e < size.n) {
        let system = random::planted(size, &[], 400 + i as u64);
        let poles: Vec<f64> = (0..size.r).map(|k| -1.0 - 0.5 * k as f64).collect();
        for order in [Order::Full, Order::General] {
            let design = designed(&system, &choice(order, &poles)).unwrap();
            let mut all = scenario(0.5, 51, DVector::from_element(size.n, 1.0));
            all.u = signals(&["cos(3*t)"; 2][..size.k]);
            all.d = signals(&["square(5*t)", "sin(7*t)"][..size.q]);
            let free = following(&["sin(4*t)", "step(t-0.2)", "1"]);
            let found = run(&system, &all, &free, &[&design]).unwrap();
            let [H, K, G] = ["H", "K", "G"].map(|name| design.matrix(name).cloned());
            let (H, K) = (H.unwrap(), K.unwrap());
            let G = G.unwrap_or_else(|| DMatrix::zeros(0, size.r));
            let at = coordinates(&system, &Tolerance::default()).unwrap();
            let e0 = -(&at.M1 * &system.E * found.x.column(0));
            let (observer, scale) = (&found.observers[0], found.x.amax() + e0.amax() * K.norm());
            for (k, t) in found.t.iter().enumerate() {
                let e = exponential(&(&H * *t)) * &e0;
                let off = (observer.e.column(k) + &K * &e).amax() / scale;
                assert!(off < 1e-8, "{size:?} {order:?}: e at t = {t} off by {off:.1e}");
                let off = (observer.e_d.column(k) + &G * &e).norm() / scale;
                assert!(off < 1e-8, "{size:?} {order:?}: e_d at t = {t} off by {off:.1e}");
            }
        }
    }
}

fn plain(E: DMatrix<f64>, A: DMatrix<f64>, D: DMatrix<f64>) -> DescriptorSystem {
    let (e, n, q) = (E.nrows(), E.ncols(), D.ncols());
    DescriptorSystem {
        time: TimeDomain::Continuous,
        E,
        A,
        B: DMatrix::zeros(e, 0),
        C: DMatrix::identity(n, n),
        D,
        F: DMatrix::zeros(n, q),
    }
    .checked()
    .unwrap()
}

#[test]
fn an_unknown_input_that_the_equations_fix_is_corrected_and_reported() {
    // x1' = -x1 + x2 + d1, 0 = x1 + d1: d1 = -x1 whatever is given, x1' = -2 x1 + x2; d2 goes to y2 alone
    let mut system = plain(
        dmatrix![1.0, 0.0, 0.0; 0.0, 0.0, 0.0],
        dmatrix![-1.0, 1.0, 0.0; 1.0, 0.0, 0.0],
        dmatrix![1.0, 0.0; 1.0, 0.0],
    );
    system.F = dmatrix![0.0, 0.0; 0.0, 1.0; 0.0, 0.0];
    let mut all = scenario(2.0, 21, dvector![2.0, 9.0, 9.0]);
    all.d = signals(&["5", "sin(t)"]);
    let found = run(&system, &all, &following(&["1", "cos(t)"]), &[]).unwrap();
    for (i, t) in found.t.iter().enumerate() {
        let x1 = 0.5 + 1.5 * (-2.0 * t).exp();
        let expected = dvector![x1, 1.0, t.cos()];
        assert!((found.x.column(i) - &expected).amax() < 1e-9, "x at t = {t}: {}", found.x.column(i));
        let d = dvector![-x1, t.sin()];
        assert!((found.d.column(i) - &d).amax() < 1e-9, "d at t = {t}: {}", found.d.column(i));
        assert!((found.y[(1, i)] - 1.0 - t.sin()).abs() < 1e-9, "the corrected d reaches the outputs");
    }
    assert_eq!(found.initial_state.consistent, [2.0, 1.0, 1.0], "x1(0) is kept, the rest follows");
    assert!((found.initial_state.change - 8.0).abs() < 1e-12, "x2 and x3 were 9");
    let remark = found.remarks.iter().find(|r| r.contains("corrected")).unwrap();
    assert!(remark.contains("determine 1 of") && remark.contains("7.0000e0"), "5 + x1(0): {remark}");
}

#[test]
fn discrete_wide_plants_run_by_their_recursion() {
    let mut system = plain(dmatrix![1.0, 0.0], dmatrix![0.5, 1.0], DMatrix::zeros(1, 0));
    system.time = TimeDomain::Discrete;
    let found = run(&system, &scenario(5.0, 2, dvector![1.0, 0.0]), &following(&["t"]), &[]).unwrap();
    let mut x = 1.0;
    for k in 0..=5_usize {
        assert!((found.x[(0, k)] - x).abs() < 1e-14, "x1[{k}] = {}", found.x[(0, k)]);
        x = 0.5 * x + k as f64;
    }
}

#[test]
fn uncertainty_and_nonlinearity_of_wide_plants_count() {
    // x1' = -(1 + 0.5 sin 2 pi t) x1
    let system = plain(dmatrix![1.0, 0.0], dmatrix![-1.0, 0.0], DMatrix::zeros(1, 0));
    let mut all = scenario(2.0, 21, dvector![1.0, 0.0]);
    all.uncertainty =
        Some(Uncertainty { amplitude: dmatrix![0.5, 0.0], frequency: dmatrix![1.0, 0.0], scale: 1.0 });
    let found = run(&system, &all, &FreeVariables::default(), &[]).unwrap();
    for (i, t) in found.t.iter().enumerate() {
        let turn = std::f64::consts::TAU;
        let expected = (-t + 0.5 * ((turn * t).cos() - 1.0) / turn).exp();
        assert!((found.x[(0, i)] - expected).abs() < 1e-7, "t = {t}: {}", found.x[(0, i)]);
    }
    // x1' = -x1 + x1^2: x1 = 1 / (1 + e^t) from 1/2
    let mut model: Model = system.into();
    model.lipschitz = Some(LipschitzTerm {
        G: dmatrix![1.0],
        F_L: DMatrix::identity(2, 2),
        f: vec![nonlinearity("x1^2", 2).unwrap()],
        constant: 1.0,
    });
    let all = scenario(2.0, 21, dvector![0.5, 0.0]);
    let found = Scenario { free: following(&["sin(t)"]), ..all }
        .run(&model, &[], &Tolerance::default(), &Watch::none())
        .unwrap();
    for (i, t) in found.t.iter().enumerate() {
        let expected = 1.0 / (1.0 + t.exp());
        assert!((found.x[(0, i)] - expected).abs() < 1e-7, "t = {t}: {}", found.x[(0, i)]);
        assert!((found.x[(1, i)] - t.sin()).abs() < 1e-9, "x2 follows its signal");
    }
}

#[test]
fn tall_plants_and_feedback_that_cancels_are_refused_in_words() {
    let tall = plain(dmatrix![1.0; 0.0], dmatrix![-1.0; 2.0], DMatrix::zeros(2, 0));
    let error = run(&tall, &scenario(1.0, 11, dvector![3.0]), &FreeVariables::default(), &[]).unwrap_err();
    assert_eq!(
        error,
        SimulationError::Overdetermined { combinations: 1, algebraic: 1, residual: 6.0 },
        "0 = 2 x1 with x1(0) = 3"
    );
    assert!(error.to_string().contains("violated by 6.000e0"), "{error}");
    let wide = plain(dmatrix![1.0, 0.0], dmatrix![-1.0, 1.0], DMatrix::zeros(1, 0));
    let free = FreeVariables { signals: Vec::new(), feedback: Some(dmatrix![0.0, -1.0]) };
    let error = run(&wide, &scenario(1.0, 11, dvector![1.0, 0.0]), &free, &[]).unwrap_err();
    assert_eq!(error, SimulationError::FreeFeedback, "v = x2 = v0 + x2 says nothing of x2");
    let error = run(&wide, &scenario(1.0, 11, dvector![1.0]), &free, &[]).unwrap_err();
    assert!(error.to_string().contains("initial state x0 is 1 x 1, but 2 x 1 is needed"), "{error}");
}

#[test]
fn free_variables_of_the_example_are_named() {
    let (x0, u0) = (dvector![1.0, -1.0, 0.0, 0.0], dvector![0.0, 0.5]);
    let found = WidePlant::new(&example().into(), &x0, &u0, &Tolerance::default()).unwrap();
    let half = 0.5_f64.sqrt();
    close(&found.directions, &dmatrix![0.0; 0.0; half; -half], 1e-15, "v = (x3 - x4) / sqrt 2");
    assert_eq!((found.n_free(), found.constrained), (1, 0), "every unknown input is free");
}

#[test]
fn square_plants_whose_equations_leave_a_state_free_are_completed() {
    // x1' = -x1 + x2 + d, 0 = x1 + d: the equations determine d, and x2 is free
    let mut square =
        plain(DMatrix::from_diagonal(&dvector![1.0, 0.0]), dmatrix![-1.0, 1.0; 1.0, 0.0], dmatrix![1.0; 1.0]);
    square.C = dmatrix![1.0, 0.0; 0.0, 1.0];
    square.F = dmatrix![0.0; 1.0];
    let design = designed(&square, &choice(Order::Full, &[-3.0])).unwrap();
    verified(&design);
    let mut all = scenario(2.0, 21, dvector![2.0, 0.0]);
    all.d = signals(&["5"]);
    let found = run(&square, &all, &following(&["1"]), &[&design]).unwrap();
    for (i, t) in found.t.iter().enumerate() {
        // x1' = -2 x1 + 1
        let x1 = 0.5 + 1.5 * (-2.0 * t).exp();
        assert!((found.x.column(i) - dvector![x1, 1.0]).amax() < 1e-9, "t = {t}: {}", found.x.column(i));
        assert!((found.d[(0, i)] + x1).abs() < 1e-9, "d = -x1 at t = {t}: {}", found.d[(0, i)]);
    }
    let off = off_the_law(&design, &found, &[0]);
    assert!(off < 1e-8, "the error obeys its law: off by {off:.1e}");
    for wanted in ["the equations leave 1 free", "d is corrected by up to 7.0000e0"] {
        assert!(found.remarks.iter().any(|remark| remark.contains(wanted)), "{wanted}: {:?}", found.remarks);
    }

    // a singular pencil: x1' = -x1 + x3, 0 = x1 - x2, 0 = 2 x1 - 2 x2
    let singular = plain(
        DMatrix::from_diagonal(&dvector![1.0, 0.0, 0.0]),
        dmatrix![-1.0, 0.0, 1.0; 1.0, -1.0, 0.0; 2.0, -2.0, 0.0],
        DMatrix::zeros(3, 0),
    );
    let found = run(&singular, &scenario(1.0, 11, dvector![1.0, 0.0, 0.0]), &following(&["2"]), &[]).unwrap();
    let last = found.x.column(10).into_owned();
    let x1 = 2.0 - (-1.0_f64).exp();
    assert!((last - dvector![x1, x1, 2.0]).amax() < 1e-9, "x1 goes from 1 to 2, x2 = x1: {}", found.x);
}

#[test]
fn square_plants_that_no_completion_helps_keep_their_message() {
    // x1' = x2, 0 = x1: impulses
    let plant = plain(
        DMatrix::from_diagonal(&dvector![1.0, 0.0]),
        dmatrix![0.0, 1.0; 1.0, 0.0],
        DMatrix::zeros(2, 0),
    );
    let error =
        run(&plant, &scenario(1.0, 11, dvector![1.0, 0.0]), &FreeVariables::default(), &[]).unwrap_err();
    assert!(matches!(error, SimulationError::NotIndexOne { algebraic: 1, .. }), "{error}");
}

/// The plant of the general form alone: x1' = -x1, 0 = x1 - x2, 0 = 2 x1 - 2 x2 + share x1.
fn repeated(share: f64) -> DescriptorSystem {
    plain(
        dmatrix![1.0, 0.0; 0.0, 0.0; 0.0, 0.0],
        dmatrix![-1.0, 0.0; 1.0, -1.0; 2.0 + share, -2.0],
        DMatrix::zeros(3, 0),
    )
}

#[test]
fn equations_that_repeat_others_are_left_out_with_what_is_left_of_them() {
    let system = DescriptorSystem { C: dmatrix![1.0, 0.0], F: DMatrix::zeros(1, 0), ..repeated(0.0) };
    let design = designed(&system, &choice(Order::General, &[-3.0])).unwrap();
    verified(&design);
    let all = scenario(1.0, 11, dvector![1.0, 5.0]);
    let found = run(&system, &all, &FreeVariables::default(), &[&design]).unwrap();
    for (i, t) in found.t.iter().enumerate() {
        let x = (-t).exp();
        assert!((found.x.column(i) - dvector![x, x]).amax() < 1e-9, "t = {t}: {}", found.x.column(i));
    }
    let off = off_the_law(&design, &found, &[0]);
    assert!(off < 1e-8, "the error obeys its law: off by {off:.1e}");
    let remark = found.remarks.iter().find(|r| r.contains("equation 3 follows from the others")).unwrap();
    let left: f64 = remark.rsplit(' ').next().unwrap().parse().unwrap();
    assert!(left < 1e-12, "what is left of it: {remark}");
    assert!(found.remarks.len() == 1, "nothing is free or corrected: {:?}", found.remarks);
    // random plants for which (A1) fails because an equation is there twice, whatever its combination
    for seed in 0..5 {
        let system = random::twice(seed);
        let design = designed(&system, &choice(Order::General, &[-1.0, -2.0, -3.0])).unwrap();
        let mut all = scenario(0.3, 4, DVector::from_element(system.n_states(), 1.0));
        all.u = signals(&["cos(3*t)"]);
        all.d = signals(&["sin(7*t)"]);
        let found = run(&system, &all, &following(&["sin(t)"]), &[&design]).unwrap();
        let scale = 1.0 + found.x.amax();
        let remark = found.remarks.iter().find(|r| r.contains("follows from the others")).unwrap();
        let left: f64 = remark.rsplit(' ').next().unwrap().parse().unwrap();
        assert!(left < 1e-9 * scale, "{remark}");
    }
}

#[test]
fn equations_that_almost_repeat_others_are_decided_by_rank() {
    let ran = |share: f64| {
        run(&repeated(share), &scenario(1.0, 11, dvector![1.0, 0.0]), &FreeVariables::default(), &[])
    };
    assert!(ran(1e-15).is_ok(), "rounding");
    for share in [1e-8, 1.0] {
        let error = ran(share).unwrap_err();
        let SimulationError::Overdetermined { combinations: 1, algebraic: 2, residual } = error else {
            panic!("{share:e}: {error}")
        };
        let expected = share / 5.0_f64.sqrt();
        assert!((residual - expected).abs() < 1e-3 * expected, "{share:e} x1 is left: {residual:e}");
    }
}

#[test]
fn uncertain_repeats_are_refused_with_the_entry() {
    let mut all = scenario(1.0, 11, dvector![1.0, 0.0]);
    let mut amplitude = DMatrix::zeros(3, 2);
    amplitude[(0, 0)] = 0.1;
    let uncertainty = |amplitude: &DMatrix<f64>| {
        Some(Uncertainty { amplitude: amplitude.clone(), frequency: amplitude * 10.0, scale: 1.0 })
    };
    all.uncertainty = uncertainty(&amplitude);
    let found = run(&repeated(0.0), &all, &FreeVariables::default(), &[]);
    assert!(found.is_ok(), "the differential equation may vary: {found:?}");
    amplitude[(1, 1)] = 0.1;
    all.uncertainty = uncertainty(&amplitude);
    let error = run(&repeated(0.0), &all, &FreeVariables::default(), &[]).unwrap_err();
    assert!(error.to_string().contains("the uncertainty of A[2, 2] makes equation 3 contradict"), "{error}");
}

#[test]
fn errors_of_discrete_designs_follow_the_powers_of_h() {
    let system = DescriptorSystem { time: TimeDomain::Discrete, ..example() };
    for order in [Order::Full, Order::General] {
        let design = designed(&system, &choice(order, &[0.5, -0.25])).unwrap();
        let mut all = scenario(12.0, 2, dvector![1.0, -1.0, 0.0, 0.0]);
        all.u = signals(&["sin(t)", "0.5*cos(2*t)"]);
        all.d = signals(&["1.5*sin(3*t) + square(t)"]);
        let found = run(&system, &all, &following(&["0.5*sin(1.7*t)"]), &[&design]).unwrap();
        let [H, K, G] = ["H", "K", "G"].map(|name| design.matrix(name).unwrap());
        let mut e = -found.x.column(0).rows(0, 2).into_owned();
        let observer = &found.observers[0];
        for k in 0..found.t.len() {
            let scale = 1.0 + found.x.column(k).amax();
            let off = (observer.e.column(k) + K * &e).amax().max((observer.e_d.column(k) + G * &e).amax());
            assert!(off < 1e-10 * scale, "{order:?}, step {k}: off by {off:.1e}");
            e = H * e;
        }
        assert!(found.t.len() == 13 && e.amax() < 1e-2, "thirteen steps, and the error is nearly gone: {e}");
    }
}

#[test]
fn errors_start_from_wherever_the_observer_starts() {
    // a square plant of index 1, so that it runs alone: n = m
    let square = DescriptorSystem {
        time: TimeDomain::Continuous,
        E: DMatrix::from_diagonal(&dvector![1.0, 1.0, 0.0]),
        A: dmatrix![0.0, 1.0, 0.0; -2.0, -1.0, 1.0; 1.0, 0.0, 1.0],
        B: dmatrix![0.0; 1.0; 0.0],
        C: dmatrix![1.0, 0.0, 0.0; 0.0, 0.0, 1.0; 0.0, 1.0, 0.0],
        D: dmatrix![0.0; 1.0; 0.0],
        F: dmatrix![0.0; 1.0; 0.5],
    };
    let design = designed(&square, &choice(Order::Full, &[-1.0, -2.0])).unwrap();
    verified(&design);
    let plant = Plant::new(&square, None, &Tolerance::default()).unwrap();
    let inputs = Inputs {
        known: &|t: f64, out: &mut [f64]| out[0] = t.cos(),
        unknown: &|t: f64, out: &mut [f64]| out[0] = (3.0 * t).sin(),
        noise: &|_t: f64, out: &mut [f64]| out.fill(0.0),
        jumps: &[],
        kinks: &[],
    };
    for z0 in [[0.0, 0.0], [3.0, -4.0]] {
        let span = Span { horizon: 2.0, samples: 21 };
        let observers = [(&design.observer, &z0[..])];
        let found = simulate(&plant, &observers, &[1.0, -1.0, 0.0], &inputs, span).unwrap();
        assert_eq!(found.observers[0].z.column(0).as_slice(), z0, "it starts there");
        let off = off_the_law(&design, &found, &[0, 1]);
        assert!(off < 1e-8, "z(0) = {z0:?}: off by {off:.1e}");
    }
}
