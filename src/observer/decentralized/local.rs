//! The design of one subsystem: phases, recovery of the gains, proof.
#![expect(non_snake_case, reason = "matrix letters follow paper 000")]

use nalgebra::DMatrix;

use super::certificate::{self, Judged};
use super::inequality::{Demands, Inequality};
use super::nearest::{Cancelled, nearest};
use super::{LocalMatrices, LocalProblem, Setup, SetupError};
use crate::lmi::{self, Infeasible, Outcome, Settings, Stop};
use crate::numerics::{NumericsError, Tolerance, Watch, svd};
use crate::observer::{Check, DesignChoice, DesignError, LmiResult};

/// The observer of one subsystem with its proof.
#[derive(Clone, Debug)]
pub struct Local {
    /// What was decided before the inequality.
    pub setup: Setup,
    /// The observer under the paper's names.
    pub matrices: LocalMatrices,
    /// The Lyapunov matrix of the proof.
    pub X: DMatrix<f64>,
    /// Attenuation, certificate, gains and modes.
    pub result: LmiResult,
    /// The re-check of this observer against its own subsystem; every name ends with the subsystem's.
    pub checks: Vec<Check>,
    /// Eigenvalues of `N`.
    pub spectrum: Vec<crate::numerics::Complex64>,
    /// Checks that could not be made, and why.
    pub skipped: Vec<String>,
}

/// Designs the observer of the subsystem with the given number, from zero.
///
/// The least gamma is sought under the demands of the choice, the design backs off from it, and is proved apart from the
/// solver. When the couplings have no effect, only stability and decay are designed and gamma is zero.
///
/// # Errors
/// Columns or a matrix `R` that do not fit; demands that are no numbers to design with.
pub fn design_local(
    problem: &LocalProblem,
    number: usize,
    choice: &DesignChoice,
    tolerance: &Tolerance,
    watch: &Watch,
) -> Result<Outcome<Local>, DesignError> {
    let demands = demands(problem, choice)?;
    let setup = Setup::new(problem, number, choice, tolerance)?;
    if !setup.stabilisable(tolerance) {
        let modes: Vec<String> = setup.fixed_modes.iter().map(|mode| crate::observer::show(*mode)).collect();
        return Ok(Outcome::Infeasible(Infeasible {
            block: format!("fixed modes {} ({})", modes.join(", "), problem.name),
            source: "paper 000, (27)".to_owned(),
            margin: 0.0,
            nearest: Vec::new(),
        }));
    }
    let settings = Settings {
        back_off: choice.lmi.back_off,
        seconds: choice.lmi.seconds,
        watch: watch.clone(),
        ..Settings::default()
    };
    Ok(match solve(&setup, &demands, &settings) {
        Ok(solved) => finish(setup, &demands, &solved, tolerance)?,
        Err(Stop::Cancelled) => Outcome::Cancelled,
        Err(Stop::GaveUp(why)) => Outcome::GaveUp(format!("subsystem {}: {why}", problem.name)),
        Err(Stop::Infeasible { block, source, margin }) => match nearest(&setup, &demands, &settings) {
            Ok(nearest) => {
                let block = format!("{block} ({})", problem.name);
                Outcome::Infeasible(Infeasible { block, source, margin, nearest })
            }
            Err(Cancelled) => Outcome::Cancelled,
        },
    })
}

impl From<SetupError> for DesignError {
    fn from(error: SetupError) -> Self {
        match &error {
            SetupError::Property(error) => Self::Numerics(error.to_string()),
            SetupError::Columns(_) | SetupError::Order(_) | SetupError::Count { .. } => {
                Self::Demand(error.to_string())
            }
        }
    }
}

/// The demands of a choice, after a look at whether they make sense.
fn demands(problem: &LocalProblem, choice: &DesignChoice) -> Result<Demands, DesignError> {
    let lmi = &choice.lmi;
    lmi.check(problem.is_discrete())?;
    Ok(Demands { decay: lmi.decay, gain: lmi.gain, conditioning: lmi.conditioning, gamma: lmi.gamma })
}

/// A point of the inequality.
struct Solved {
    X: DMatrix<f64>,
    Y: DMatrix<f64>,
    Z: DMatrix<f64>,
    gamma: f64,
    optimum: Option<f64>,
    iterations: u32,
}

/// All phases; phase 1 alone when gamma is given or the couplings have no effect.
fn solve(setup: &Setup, demands: &Demands, settings: &Settings) -> Result<Solved, Stop> {
    let driven = setup.is_driven();
    if setup.family.order() == 0 && !driven {
        // order zero and nothing to attenuate: there is no inequality
        let (n, k) = (setup.decoupled.n_states(), setup.family.M_P.nrows());
        let (X, Y) = (DMatrix::zeros(0, 0), DMatrix::zeros(0, setup.family.L_N.nrows()));
        return Ok(Solved { X, Y, Z: DMatrix::zeros(n, k), gamma: 0.0, optimum: Some(0.0), iterations: 0 });
    }
    let inequality = Inequality::new(setup, demands);
    let found = if demands.gamma.is_some() || !driven {
        lmi::feasible(&inequality.problem, settings)?
    } else {
        lmi::minimise(&inequality.problem, &inequality.gamma, settings)?
    };
    // Y = X^-1 W is free of the units of X
    let scaled = found.point.value(&inequality.X);
    let Some(Y) = gain(&scaled, &found.point.value(&inequality.W)) else {
        let what = "the Lyapunov matrix of the solver is singular: bound the gain or the condition of X";
        return Err(Stop::GaveUp(what.to_owned()));
    };
    let gamma = inequality.attenuation_at(found.point.scalar(&inequality.gamma));
    Ok(Solved {
        X: inequality.lyapunov(&found.point),
        Y,
        Z: found.point.value(&inequality.Z),
        gamma: if driven { gamma } else { 0.0 },
        optimum: if driven { found.optimum.map(|best| inequality.attenuation_at(best)) } else { Some(0.0) },
        iterations: found.iterations,
    })
}

/// From the solver's point to an observer that is proved and checked.
fn finish(
    setup: Setup,
    demands: &Demands,
    solved: &Solved,
    tolerance: &Tolerance,
) -> Result<Outcome<Local>, DesignError> {
    let Solved { X, Y, Z, gamma, .. } = solved;
    let matrices = setup.family.recover(&setup.decoupled, Y, Z);
    let Judged { certificate, h_infinity, verification } =
        certificate::judge(&setup, &matrices, X, *gamma, demands, tolerance)?;
    let result = LmiResult {
        name: setup.problem.name.clone(),
        gamma_best: solved.optimum,
        gamma: Some(*gamma),
        h_infinity,
        bounds: Vec::new(),
        contraction: None,
        gain: norm(Y)?.max(norm(Z)?),
        fixed_modes: setup.fixed_modes.clone(),
        fastest_decay: setup.fastest_decay(),
        iterations: solved.iterations,
        certificate,
    };
    let failed = verification.failures().next();
    let why = match failed {
        _ if !result.certificate.proved => Some(result.certificate.note.clone()),
        Some(check) => Some(format!("the check of {} fails: {}", check.name, check.statement)),
        None => None,
    };
    let local = Local {
        setup,
        matrices,
        X: X.clone(),
        result,
        checks: verification.checks,
        spectrum: verification.spectrum,
        skipped: verification.skipped,
    };
    Ok(match why {
        None => Outcome::Verified(local),
        Some(why) => Outcome::NotCertified { design: local, why },
    })
}

fn gain(X: &DMatrix<f64>, W: &DMatrix<f64>) -> Option<DMatrix<f64>> {
    if W.is_empty() {
        return Some(W.clone());
    }
    X.clone().cholesky().map(|factor| factor.solve(W)).filter(|Y| Y.iter().all(|y| y.is_finite()))
}

/// The largest singular value.
fn norm(matrix: &DMatrix<f64>) -> Result<f64, NumericsError> {
    Ok(svd(matrix)?.s.first().copied().unwrap_or(0.0))
}
