//! The proof of the attenuation from the finished observer, in interval arithmetic and without the solver.
#![expect(non_snake_case, reason = "matrix letters follow paper 002")]

use nalgebra::DMatrix;

use super::parameterisation::Matrices;
use super::plant::Plant;
use crate::lmi::certificate::{Interval, IntervalMatrix, lower_bound, proved_positive_definite};
use crate::observer::Certificate;

/// What is to be proved of an observer.
#[derive(Clone, Debug)]
pub(super) struct Candidate {
    /// Lyapunov matrix.
    pub(super) X: DMatrix<f64>,
    /// Multiplier of the Lipschitz bound.
    pub(super) mu: f64,
    /// Attenuation; zero when there is no disturbance.
    pub(super) gamma: f64,
    /// Demand on the decay.
    pub(super) decay: Option<f64>,
}

/// Proves the inequalities of Lemma 8 for a finished observer.
///
/// ```text
/// [ He(X N)  X T G   X phi1     ]
/// [   .      -mu I   0          ] + Pi' Pi + mu lambda^2 (F_L Pi)' F_L Pi < 0,     Pi = [P  -Q Phi G  phi2]
/// [   .        .     -gamma^2 I ]
/// X > 0,   mu > 0,   He(X N) + 2 decay X < 0,     phi1 = J F - T D,   phi2 = Q Phi D + V F
/// ```
///
/// Everything is computed from the matrices of the observer and the plant, not from the parameterisation. That these
/// give the error system is what the identities of the verification check.
///
/// # Source
/// Paper 002, Lemma 8 at `X2 + Q1' = 0`, `Q2 = I + mu lambda^2 F_L' F_L`.
pub(super) fn certify(plant: &Plant, observer: &Matrices, candidate: &Candidate) -> Certificate {
    let enclose = |m: &DMatrix<f64>| IntervalMatrix::from(m);
    let X = enclose(&candidate.X);
    let dynamics = (&X * &enclose(&observer.N)).he();
    let attenuation = -&inequality(plant, observer, candidate, &X, &dynamics);
    let margin = lower_bound(&attenuation);
    let mut missing = Vec::new();
    if margin < 0.0 {
        missing.push("the attenuation");
    }
    if !proved_positive_definite(&X) {
        missing.push("X > 0");
    }
    let acts = plant.acting().ncols() > 0;
    if acts && candidate.mu <= 0.0 {
        missing.push("mu > 0");
    }
    if let Some(alpha) = candidate.decay {
        let speed = &-&dynamics - &X.scaled(Interval::point(2.0 * alpha));
        if !proved_positive_definite(&speed) {
            missing.push("the decay rate");
        }
    }
    let proved = missing.is_empty();
    let note = if proved {
        "Interval evaluation of the inequality from the observer's matrices, and Rump's Cholesky test"
            .to_owned()
    } else {
        format!(
            "Interval arithmetic does not prove {}: the point is too close to the boundary; step back further",
            missing.join(", ")
        )
    };
    let margin = if proved && margin.is_finite() { margin } else { 0.0 };
    Certificate { proved, margin, statement: statement(plant, candidate, acts), note }
}

/// The left-hand side, an enclosure of a matrix that is to be negative definite.
fn inequality(
    plant: &Plant,
    observer: &Matrices,
    candidate: &Candidate,
    X: &IntervalMatrix,
    dynamics: &IntervalMatrix,
) -> IntervalMatrix {
    let enclose = |m: &DMatrix<f64>| IntervalMatrix::from(m);
    let (J, T, P) = (enclose(&observer.J), enclose(&observer.T), enclose(&observer.P));
    let (Q, V, Phi) = (enclose(&observer.Q), enclose(&observer.V), enclose(&plant.Phi));
    let (G, D, F) = (enclose(&plant.acting()), enclose(&plant.system.D), enclose(&plant.system.F));
    let Q_Phi = &Q * &Phi;
    let phi1 = &(&J * &F) - &(&T * &D);
    let phi2 = &(&Q_Phi * &D) + &(&V * &F);
    let (nf, nd) = (G.ncols(), D.ncols());
    let mu = Interval::point(candidate.mu);
    let gamma2 = Interval::point(candidate.gamma) * Interval::point(candidate.gamma);
    let lemma = IntervalMatrix::symmetric(&[
        &[dynamics, &(X * &(&T * &G)), &(X * &phi1)],
        &[&IntervalMatrix::identity(nf).scaled(-mu), &IntervalMatrix::zeros(nf, nd)],
        &[&IntervalMatrix::identity(nd).scaled(-gamma2)],
    ]);
    let Pi = IntervalMatrix::side_by_side(&[&P, &-&(&Q_Phi * &G), &phi2]);
    let seen = &enclose(&plant.F_L) * &Pi;
    let lambda = Interval::point(plant.lambda);
    let bound = (&seen.transpose() * &seen).scaled(mu * lambda * lambda);
    &(&lemma + &(&Pi.transpose() * &Pi)) + &bound
}

fn statement(plant: &Plant, candidate: &Candidate, acts: bool) -> String {
    let Candidate { gamma, decay, .. } = candidate;
    let for_all =
        if acts { format!(" for every f with Lipschitz constant {}", plant.lambda) } else { String::new() };
    let speed = match decay {
        Some(alpha) => format!("; every mode of N is faster than exp(-{alpha} t)"),
        None => String::new(),
    };
    if plant.system.n_unknown_inputs() == 0 {
        return format!("the error decays{for_all}{speed}");
    }
    format!(
        "energy of the error <= {gamma:.6}^2 x energy of the disturbance{for_all}; without disturbance the error decays{speed}"
    )
}
