//! Speed of a simulation: the example of paper 004, 6 s in 600 samples, with its reduced PI observer; the example of
//! paper 002, 40 s with 400 kinks of noise, with its printed observer; and forty uncertain states, 20 s with 800 kinks.

use descry::numerics::{Tolerance, Watch};
use descry::observer::{Injection, LinearObserver};
use descry::simulation::{
    FreeVariables, Inputs, Observed, Plant, Scenario, Silence, Span, Uncertainty, simulate,
};
use descry::system::{DescriptorSystem, LipschitzTerm, Model, Signal, TimeDomain, nonlinearity};
use nalgebra::{DMatrix, dmatrix};

fn main() {
    divan::main();
}

fn system() -> DescriptorSystem {
    DescriptorSystem {
        time: TimeDomain::Continuous,
        E: dmatrix![1.0, 0.0, 0.0, 0.0; 0.0, 1.0, 0.0, 0.0; 0.0, 0.0, 0.0, 0.0; 0.0, 0.0, 0.0, 0.0],
        A: dmatrix![0.0, 0.0, 1.0, 0.0; 1.0, 0.0, 0.0, 0.0; -1.0, 0.0, 0.0, 1.0; 0.0, 1.0, 1.0, 1.0],
        B: dmatrix![0.0; 0.0; 0.0; -1.0],
        C: dmatrix![0.0, 1.0, 0.0, 0.0],
        D: dmatrix![1.0; 0.0; 0.0; 0.0],
        F: dmatrix![0.0],
    }
}

/// The reduced PI observer with poles -22, -18, -26.
fn observer() -> LinearObserver {
    LinearObserver {
        N: dmatrix![-1.0, -1371.0, 1.0; 1.0, -65.0, 0.0; 0.0, -10296.0, 0.0],
        L: dmatrix![1370.0; 65.0; 10296.0],
        H: dmatrix![1.0; 0.0; 0.0],
        P: dmatrix![1.0, 0.0, 0.0; 0.0, 1.0, 0.0; -1.0, -1.0, 0.0; 1.0, 0.0, 0.0],
        V: DMatrix::zeros(4, 1),
        W: dmatrix![0.0; 0.0; 1.0; 0.0],
        Q: dmatrix![0.0, 0.0, 1.0],
        R: dmatrix![0.0],
        S: dmatrix![0.0],
    }
}

fn uncertainty() -> Uncertainty {
    let mut frequency = DMatrix::from_element(4, 4, 0.25);
    frequency[(0, 2)] = 0.1;
    let mut amplitude = DMatrix::from_element(4, 4, 0.002);
    amplitude[(0, 2)] = 0.09;
    Uncertainty { amplitude, frequency, scale: 1.0 }
}

fn known(t: f64, out: &mut [f64]) {
    out[0] = 5.0 * (2.0 * t).sin();
}

fn unknown(t: f64, out: &mut [f64]) {
    out[0] = 5.0 + 2.0 * (4.0 * t).sin();
}

#[divan::bench(args = ["nominal", "uncertain", "uncertain_with_240_kinks"])]
fn paper_004(bencher: divan::Bencher<'_, '_>, case: &str) {
    let uncertainty = uncertainty();
    let varying = (case != "nominal").then_some(&uncertainty);
    let Ok(plant) = Plant::new(&system(), varying, &Tolerance::default()) else { return };
    let observer = observer();
    let noisy = |t: f64, out: &mut [f64]| out[0] = 0.01 * ((t / 0.05).fract() - 0.5).abs();
    let kinks: Vec<f64> = (1..240).map(|k| f64::from(k) * 0.025).collect();
    let mut inputs = Inputs { known: &known, unknown: &unknown, noise: &Silence, jumps: &[], kinks: &[] };
    if case == "uncertain_with_240_kinks" {
        inputs = Inputs { noise: &noisy, kinks: &kinks, ..inputs };
    }
    let span = Span { horizon: 6.0, samples: 600 };
    bencher.bench_local(|| simulate(&plant, &[(&observer, &[0.0; 3])], &[0.5, 0.0, 0.0, 0.0], &inputs, span));
}

/// Paper 002 with `f = sin(x2)`.
fn lipschitz_model() -> Option<Model> {
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
    let f = vec![nonlinearity("sin(x2)", 3).ok()?];
    let term = LipschitzTerm { G: ones, F_L: dmatrix![0.0, 1.0, 0.0], f, constant: 1.0 };
    Some(Model { lipschitz: Some(term), ..Model::from(system) })
}

/// The printed observer of paper 002 with `N = [0 a; 2/3 b]`.
fn lipschitz_observer() -> (LinearObserver, Injection) {
    let (a, b) = (-1.996, -2.121);
    let q = dmatrix![4.0; 0.0; 9.0] / 17.0;
    let into = dmatrix![1.0 + 2.0 * a / 3.0; 2.0 / 3.0 * (1.0 + b)];
    let linear = LinearObserver {
        N: dmatrix![0.0, a; 2.0 / 3.0, b],
        L: dmatrix![1.0 + 2.0 * a / 3.0; 2.0 * b / 3.0],
        H: into.clone(),
        P: dmatrix![0.0, -6.0; 17.0, 0.0; 0.0, 12.0] / 17.0,
        V: dmatrix![13.0; 0.0; -9.0] / 17.0,
        W: -&q,
        Q: DMatrix::zeros(0, 2),
        R: DMatrix::zeros(0, 1),
        S: DMatrix::zeros(0, 1),
    };
    (linear, Injection { state: into, estimate: -q })
}

#[divan::bench]
fn paper_002_with_400_kinks(bencher: divan::Bencher<'_, '_>) {
    let texts = ["0.2*noise(t/0.05, 1)*(t < 20)", "0.2*noise(t/0.05, 2)*(t < 20)"];
    let d = texts.iter().filter_map(|text| Signal::parse(text).ok()).collect();
    let (Some(model), Ok(u)) = (lipschitz_model(), Signal::parse("sin(2*t)")) else { return };
    let (observer, injection) = lipschitz_observer();
    let scenario = Scenario {
        horizon: 40.0,
        samples: 801,
        x0: nalgebra::dvector![0.0, 0.5, 0.5],
        u: vec![u],
        d,
        noise: Vec::new(),
        uncertainty: None,
        free: FreeVariables::default(),
    };
    let observed = [Observed { observer: &observer, injection: Some(&injection) }];
    let (tolerance, watch) = (Tolerance::default(), Watch::none());
    bencher.bench_local(|| scenario.run(&model, &observed, &tolerance, &watch));
}

#[divan::bench]
fn forty_uncertain_states_with_800_kinks(bencher: divan::Bencher<'_, '_>) {
    // a chain of damped masses, its last state algebraic
    let n = 40;
    let mut system = DescriptorSystem {
        time: TimeDomain::Continuous,
        E: DMatrix::identity(n, n),
        A: DMatrix::from_fn(n, n, |i, j| match i.abs_diff(j) {
            0 => -1.0,
            1 => 0.5 * (j as f64 - i as f64),
            _ => 0.0,
        }),
        B: DMatrix::from_fn(n, 1, |i, _| f64::from(u8::from(i == 0))),
        C: DMatrix::from_fn(1, n, |_, j| f64::from(u8::from(j == 0))),
        D: DMatrix::zeros(n, 1),
        F: dmatrix![0.0],
    };
    system.E[(n - 1, n - 1)] = 0.0;
    let uncertainty = Uncertainty {
        amplitude: DMatrix::from_element(n, n, 0.1),
        frequency: DMatrix::from_element(n, n, 0.25),
        scale: 1.0,
    };
    let Ok(plant) = Plant::new(&system, Some(&uncertainty), &Tolerance::default()) else { return };
    let rough = |t: f64, out: &mut [f64]| out[0] = ((t / 0.05).fract() - 0.5).abs();
    let kinks: Vec<f64> = (1..800).map(|k| f64::from(k) * 0.025).collect();
    let inputs = Inputs { known: &rough, unknown: &Silence, noise: &Silence, jumps: &[], kinks: &kinks };
    let span = Span { horizon: 20.0, samples: 600 };
    let start = vec![0.0; n];
    bencher.bench_local(|| simulate(&plant, &[], &start, &inputs, span));
}
