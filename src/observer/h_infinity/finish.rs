//! From a solution of the inequalities to a design: matrices, runnable form, proof, verification.
#![expect(non_snake_case, reason = "matrix letters follow paper 002")]

use nalgebra::DMatrix;

use super::bounds::{ErrorSystem, frozen_slopes};
use super::certificate::{Candidate, certify};
use super::output::contraction;
use super::parameterisation::{Matrices, Parameterisation};
use super::plant::Plant;
use crate::numerics::{
    Complex64, HInfinityError, HInfinityNorm, NumericsError, Tolerance, eigenvalues, observable_quotient, svd,
};
use crate::observer::{
    Certificate, Check, Claim, Design, DesignChoice, DesignError, Injection, LinearObserver, LmiResult,
    NamedMatrix, Order, Synthesis, Verification, verify,
};

/// A solution of the inequalities.
#[derive(Clone, Debug)]
pub(super) struct Solved {
    pub(super) X: DMatrix<f64>,
    pub(super) Z: DMatrix<f64>,
    pub(super) mu: f64,
    /// The attenuation at this point; `None` without a disturbance.
    pub(super) gamma: Option<f64>,
    /// The least attenuation that the solver found.
    pub(super) gamma_best: Option<f64>,
    pub(super) decay: Option<f64>,
    pub(super) iterations: u32,
}

/// Assembles, proves and verifies the observer of a solution.
///
/// # Errors
/// When a decomposition fails its check.
pub(super) fn finish(
    plant: &Plant,
    family: &Parameterisation,
    choice: &DesignChoice,
    solved: &Solved,
    tolerance: &Tolerance,
) -> Result<Design, DesignError> {
    let matrices = family.recover(plant, &solved.Z);
    let certificate = certify(plant, &matrices, &candidate(solved));
    let result = judged(plant, family, &matrices, solved, certificate, tolerance)?;
    let (observer, injection, claim) = realize(plant, &matrices);
    let spectrum = eigenvalues(&matrices.N)?;
    let mut verification = verify(&plant.system, &observer, &claim, &spectrum, tolerance)?;
    add_checks(&mut verification, &result, solved);
    let mut notes = Vec::new();
    if !result.certificate.proved {
        notes.push(result.certificate.note.clone());
    }
    if observer.order() == 0 {
        notes.push(
            "the observer has no states of its own: the estimate follows from y and u at once".to_owned(),
        );
    }
    let q = matrices.N.nrows();
    Ok(Design {
        title: format!("H-infinity observer, {} ({q})", order_in_words(choice)),
        matrices: named(plant, family, &matrices, &solved.X),
        observer,
        injection: (!plant.f.is_empty()).then_some(injection),
        hierarchical: None,
        claim: Some(claim),
        synthesis: Synthesis::Lmi(vec![result]),
        verification,
        notes,
    })
}

fn order_in_words(choice: &DesignChoice) -> &'static str {
    if !choice.lmi.rows.is_empty() {
        return "given R";
    }
    match choice.order {
        Order::Full | Order::General => "full order",
        Order::Reduced => "reduced order",
        Order::Minimal => "minimal order",
    }
}

/// What is to be proved of a solution.
fn candidate(solved: &Solved) -> Candidate {
    let gamma = solved.gamma.unwrap_or(0.0);
    Candidate { X: solved.X.clone(), mu: solved.mu, gamma, decay: solved.decay }
}

/// Everything that is known of the attenuation.
fn judged(
    plant: &Plant,
    family: &Parameterisation,
    matrices: &Matrices,
    solved: &Solved,
    certificate: Certificate,
    tolerance: &Tolerance,
) -> Result<LmiResult, DesignError> {
    let errors = ErrorSystem::new(plant, matrices);
    let linear = norm_or_none(errors.linear(tolerance))?;
    let mut bounds =
        vec![("linear part, f = 0".to_owned(), linear.map_or(f64::INFINITY, |found| found.norm))];
    bounds.extend(frozen_slopes(plant, &errors, tolerance)?);
    let fixed_modes = observable_quotient(&family.Lambda_N, &family.L_N, tolerance)?.fixed_modes;
    let slowest = fixed_modes.iter().map(|z| z.re).fold(f64::NEG_INFINITY, f64::max);
    Ok(LmiResult {
        name: String::new(),
        gamma_best: solved.gamma_best,
        gamma: solved.gamma,
        certificate,
        h_infinity: linear,
        bounds: if solved.gamma.is_some() { bounds } else { Vec::new() },
        contraction: contraction(plant, &errors.Q_Phi_G)?,
        gain: svd(&solved.Z)?.s.first().copied().unwrap_or(0.0),
        fastest_decay: slowest.is_finite().then_some(-slowest),
        fixed_modes,
        iterations: solved.iterations,
    })
}

fn norm_or_none(
    found: Result<HInfinityNorm, HInfinityError>,
) -> Result<Option<HInfinityNorm>, NumericsError> {
    match found {
        Ok(norm) => Ok(Some(norm)),
        Err(HInfinityError::Unstable { .. }) => Ok(None),
        Err(HInfinityError::Numerics(error)) => Err(error),
    }
}

/// The runnable form, the nonlinearity in it, and what it claims.
fn realize(plant: &Plant, matrices: &Matrices) -> (LinearObserver, Injection, Claim) {
    let Matrices { N, J, H, T, P, Q, V, .. } = matrices;
    let Q_Phi = Q * &plant.Phi;
    let (q, p, k) = (N.nrows(), J.ncols(), H.ncols());
    let observer = LinearObserver {
        N: N.clone(),
        L: J.clone(),
        H: H.clone(),
        P: P.clone(),
        V: V.clone(),
        W: -(&Q_Phi * &plant.system.B),
        Q: DMatrix::zeros(0, q),
        R: DMatrix::zeros(0, p),
        S: DMatrix::zeros(0, k),
    };
    // ERRATUM(002, eq. 5): the copied text has f(t, F_L, x_hat, u); f depends on F_L x_hat
    let injection = Injection { state: T * &plant.G, estimate: -(&Q_Phi * &plant.G) };
    (observer, injection, Claim { T: T.clone(), G: Q_Phi })
}

/// The checks that inequalities add to those of every observer, instead of a comparison with requested poles.
fn add_checks(verification: &mut Verification, result: &LmiResult, solved: &Solved) {
    verification.checks.retain(|check| check.name != "spectrum");
    let mut add = |name: &str, statement: String, value: f64, limit: f64| {
        verification.checks.push(Check { name: name.to_owned(), statement, value, limit });
    };
    let slowest = verification.spectrum.iter().map(|z: &Complex64| z.re).fold(f64::NEG_INFINITY, f64::max);
    if let Some(alpha) = solved.decay.filter(|_| slowest.is_finite()) {
        add("decay rate", format!("Re s < -{alpha} for every eigenvalue of N"), slowest + alpha, 0.0);
    }
    if let Some(factor) = result.contraction {
        let statement = "lambda |F_L Q Phi G| < 1: the output equation has one solution".to_owned();
        add("contraction", statement, factor, 1.0);
    }
    if let Some(gamma) = result.gamma {
        // the norms are known to ten digits
        const DIGITS: f64 = 1e-9;
        let largest = result.bounds.iter().map(|(_, norm)| *norm).fold(0.0, f64::max);
        let statement = "H-infinity norms with frozen nonlinearity <= gamma".to_owned();
        add("independent norm", statement, largest, gamma * (1.0 + DIGITS));
    }
    let missing = if result.certificate.proved { 0.0 } else { 1.0 };
    add("certificate", result.certificate.statement.clone(), missing, 0.0);
}

fn named(
    plant: &Plant,
    family: &Parameterisation,
    matrices: &Matrices,
    X: &DMatrix<f64>,
) -> Vec<NamedMatrix> {
    let Matrices { N, J, H, T, Psi, P, Q, V } = matrices;
    let all = [
        ("N", "observer state matrix", N),
        ("J", "output injection", J),
        ("H", "known input", H),
        ("P", "observer state to estimate", P),
        ("Q", "algebraic equations to estimate, behind Phi", Q),
        ("F", "output to estimate", V),
        ("T", "what z tracks: T E x", T),
        ("Psi", "T = T~ - Psi Phi", Psi),
        ("Phi", "algebraic equations: Phi E = 0, orthonormal rows", &plant.Phi),
        ("R", "the rows that fix the order", &family.R),
        ("X", "Lyapunov matrix of the error", X),
    ];
    let named = |(name, meaning, value): (&str, &str, &DMatrix<f64>)| NamedMatrix {
        name: name.to_owned(),
        meaning: meaning.to_owned(),
        value: value.clone(),
    };
    all.into_iter().filter(|(_, _, value)| !value.is_empty()).map(named).collect()
}
