//! Speed of a simulation: the example of paper 004, 6 s in 600 samples, with its reduced PI observer.

use descry::numerics::Tolerance;
use descry::observer::LinearObserver;
use descry::simulation::{Inputs, Plant, Silence, Span, Uncertainty, simulate};
use descry::system::{DescriptorSystem, TimeDomain};
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
