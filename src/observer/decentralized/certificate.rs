//! What is known of a finished local observer apart from the solver that found it.
#![expect(non_snake_case, reason = "matrix letters follow paper 000")]

use nalgebra::DMatrix;

use super::inequality::{Demands, source};
use super::{LocalMatrices, Setup};
use crate::lmi::certificate::{Interval, IntervalMatrix, lower_bound};
use crate::numerics::{
    Complex64, HInfinityError, HInfinityNorm, NumericsError, Tolerance, eigenvalues, h_infinity_norm,
};
use crate::observer::{Certificate, Check, Claim, LinearObserver, Verification, verify};

/// The judgement of a local observer.
#[derive(Clone, Debug)]
pub(super) struct Judged {
    /// The proof of the inequality.
    pub(super) certificate: Certificate,
    /// The norm from the attenuated couplings to the error; `None` when `N` is not stable or there are none.
    pub(super) h_infinity: Option<HInfinityNorm>,
    /// Design equations, spectrum, proof and norm as checks.
    pub(super) verification: Verification,
}

/// Judges a finished observer: design equations, spectrum, proof of its inequality, independent norm.
///
/// # Errors
/// When a decomposition fails its check.
pub(super) fn judge(
    setup: &Setup,
    matrices: &LocalMatrices,
    X: &DMatrix<f64>,
    gamma: f64,
    demands: &Demands,
    tolerance: &Tolerance,
) -> Result<Judged, NumericsError> {
    let certificate = certify(setup, matrices, X, gamma);
    let h_infinity = norm(setup, matrices, tolerance)?;
    let mut verification = equations(setup, matrices, tolerance)?;
    let spectrum = &verification.spectrum;
    let mut checks = vec![decay(setup, spectrum, demands), fixed_modes(setup, spectrum)];
    checks.push(Check {
        name: "inequality".to_owned(),
        statement: certificate.statement.clone(),
        value: if certificate.proved { -certificate.margin } else { f64::MIN_POSITIVE },
        limit: 0.0,
    });
    if setup.is_driven() {
        checks.push(Check {
            name: "H-infinity norm".to_owned(),
            statement: "norm of P (s I - N)^-1 (-T D2) + Q Phi D2 over gamma, at most 1".to_owned(),
            value: h_infinity.map_or(f64::INFINITY, |found| found.lower / gamma),
            limit: 1.0 + NORM_ROUNDING,
        });
    }
    verification.checks.extend(checks);
    for check in &mut verification.checks {
        check.name = format!("{} ({})", check.name, setup.problem.name);
    }
    Ok(Judged { certificate, h_infinity, verification })
}

/// Relative rounding that a norm next to its bound may show.
const NORM_ROUNDING: f64 = 1e-9;

/// Proves the inequality of given matrices in interval arithmetic: those of a finished design, or printed ones.
///
/// ```text
/// T D2 and Q Phi D2 are evaluated as intervals from T, Q, Phi and D2 as they are
/// continuous: X > 0 and (34)       discrete: (37)       nothing to attenuate: X > 0 and the Lyapunov inequality
/// ```
///
/// # Source
/// Paper 000, Theorem 1 (34), Theorem 2 (37).
pub fn certify(setup: &Setup, matrices: &LocalMatrices, X: &DMatrix<f64>, gamma: f64) -> Certificate {
    let blocks = Blocks::new(setup, matrices, X, gamma);
    let driven = setup.is_driven();
    let inequality = match (driven, setup.problem.is_discrete()) {
        (_, _) if matrices.N.is_empty() && !driven => IntervalMatrix::zeros(0, 0),
        (_, _) if matrices.N.is_empty() => blocks.without_dynamics(),
        (true, false) => blocks.theorem_1(),
        (true, true) => blocks.theorem_2(),
        (false, false) => -&blocks.XN.he(),
        (false, true) => IntervalMatrix::symmetric(&[&[&blocks.X, &blocks.XN], &[&blocks.X]]),
    };
    let margin = lower_bound(&inequality).min(lower_bound(&blocks.X));
    // an empty inequality holds with any margin
    let proved = margin >= 0.0;
    let margin = if margin.is_finite() { margin } else { 0.0 };
    let statement = match (driven, matrices.N.is_empty()) {
        (true, _) => {
            format!("|x_hat - x| <= {gamma:.6e} |v2| in energy, from zero initial error ({})", source(setup))
        }
        (false, false) => "the error decays; the other subsystems have no effect on it".to_owned(),
        (false, true) => "the estimate is exact: order 0 and no effect of the other subsystems".to_owned(),
    };
    let note = if proved {
        "interval arithmetic and Rump's test of the inequality with the finished matrices".to_owned()
    } else {
        format!(
            "the inequality with the finished matrices could not be proved positive definite (bound {margin:.1e}): \
             raise the back-off, or bound the gain"
        )
    };
    Certificate { proved, margin: if proved { margin } else { 0.0 }, statement, note }
}

/// The blocks of an inequality as intervals.
struct Blocks {
    X: IntervalMatrix,
    XN: IntervalMatrix,
    XTD2: IntervalMatrix,
    P: IntervalMatrix,
    QPhiD2: IntervalMatrix,
    gamma_q: IntervalMatrix,
    gamma_n: IntervalMatrix,
}

impl Blocks {
    fn new(setup: &Setup, matrices: &LocalMatrices, X: &DMatrix<f64>, gamma: f64) -> Self {
        let exact = IntervalMatrix::from;
        let LocalMatrices { N, T, P, Q, .. } = matrices;
        let D2 = exact(&setup.decoupled.D2);
        let X = exact(X);
        let diagonal = |size| IntervalMatrix::identity(size).scaled(Interval::point(gamma));
        Self {
            XN: &X * &exact(N),
            XTD2: &(&X * &exact(T)) * &D2,
            P: exact(P),
            QPhiD2: &(&exact(Q) * &exact(&setup.decoupled.Phi)) * &D2,
            gamma_q: diagonal(D2.ncols()),
            gamma_n: diagonal(P.nrows()),
            X,
        }
    }

    /// (34)
    fn theorem_1(&self) -> IntervalMatrix {
        let Self { XN, XTD2, P, QPhiD2, gamma_q, gamma_n, .. } = self;
        IntervalMatrix::symmetric(&[
            &[&-&XN.he(), &-XTD2, &P.transpose()],
            &[gamma_q, &-&QPhiD2.transpose()],
            &[gamma_n],
        ])
    }

    /// (37)
    fn theorem_2(&self) -> IntervalMatrix {
        let Self { X, XN, XTD2, P, QPhiD2, gamma_q, gamma_n } = self;
        let zeros = IntervalMatrix::zeros;
        let (beta, n, q2) = (X.nrows(), P.nrows(), gamma_q.nrows());
        IntervalMatrix::symmetric(&[
            &[X, &zeros(beta, n), XN, &-XTD2],
            &[gamma_n, P, QPhiD2],
            &[X, &zeros(beta, q2)],
            &[gamma_q],
        ])
    }

    /// (34) and (37) for order zero.
    fn without_dynamics(&self) -> IntervalMatrix {
        let Self { QPhiD2, gamma_q, gamma_n, .. } = self;
        IntervalMatrix::symmetric(&[&[gamma_q, &QPhiD2.transpose()], &[gamma_n]])
    }
}

/// The norm of `(N, -T D2, P, Q Phi D2)`.
fn norm(
    setup: &Setup,
    matrices: &LocalMatrices,
    tolerance: &Tolerance,
) -> Result<Option<HInfinityNorm>, NumericsError> {
    let LocalMatrices { N, T, P, Q, .. } = matrices;
    let decoupled = &setup.decoupled;
    if !setup.is_driven() {
        return Ok(None);
    }
    let (B, D) = (-(T * &decoupled.D2), Q * &decoupled.Phi_D2);
    match h_infinity_norm(N, &B, P, &D, setup.region(), tolerance) {
        Ok(found) => Ok(Some(found)),
        Err(HInfinityError::Unstable { .. }) => Ok(None),
        Err(HInfinityError::Numerics(error)) => Err(error),
    }
}

/// The design equations ii)-v) on the subsystem alone, and `T D1 = 0`.
///
/// # Source
/// Paper 000, Proposition 1.
// ERRATUM(000, Proposition 1 ii, v): A_i is A_ii.
fn equations(
    setup: &Setup,
    matrices: &LocalMatrices,
    tolerance: &Tolerance,
) -> Result<Verification, NumericsError> {
    let LocalMatrices { T, Q, .. } = matrices;
    let spectrum = eigenvalues(&matrices.N)?;
    let claim = Claim { T: T.clone(), G: Q * &setup.decoupled.Phi };
    let system = setup.problem.uncoupled();
    let mut result = verify(&system, &observer(setup, matrices), &claim, &spectrum, tolerance)?;
    // the spectrum was not asked for: it is judged by decay and fixed modes
    result.checks.retain(|check| check.name != "spectrum");
    let D1 = &setup.decoupled.D1;
    let largest = |m: &DMatrix<f64>| m.iter().fold(0.0, |largest: f64, x| largest.max(x.abs()));
    let size = largest(&(T.abs() * D1.abs()));
    result.checks.push(Check {
        name: "decoupling".to_owned(),
        statement: "T D1 = 0".to_owned(),
        value: if size == 0.0 { 0.0 } else { largest(&(T * D1)) / size },
        limit: tolerance.residual,
    });
    Ok(result)
}

/// The observer of the subsystem alone in the common form: `x_hat = P xi + F z - Q Phi B u`.
pub(super) fn observer(setup: &Setup, matrices: &LocalMatrices) -> LinearObserver {
    let LocalMatrices { N, M, J, P, Q, F, .. } = matrices;
    let (beta, m, k) = (N.nrows(), F.ncols(), M.ncols());
    LinearObserver {
        N: N.clone(),
        L: J.clone(),
        H: M.clone(),
        P: P.clone(),
        V: F.clone(),
        W: -(Q * &setup.decoupled.Phi * &setup.decoupled.B),
        Q: DMatrix::zeros(0, beta),
        R: DMatrix::zeros(0, m),
        S: DMatrix::zeros(0, k),
    }
}

/// Every mode decays as fast as asked.
fn decay(setup: &Setup, spectrum: &[Complex64], demands: &Demands) -> Check {
    let discrete = setup.problem.is_discrete();
    let speed = |s: &Complex64| if discrete { s.norm() } else { s.re };
    let slowest = spectrum.iter().map(speed).fold(if discrete { 0.0 } else { f64::NEG_INFINITY }, f64::max);
    let (statement, limit) = match (discrete, demands.decay) {
        (false, Some(decay)) => (format!("Re s < -{decay} for every eigenvalue of N"), -decay),
        (true, Some(decay)) => (format!("|z| < {decay} for every eigenvalue of N"), decay),
        (false, None) => ("Re s < 0 for every eigenvalue of N".to_owned(), 0.0),
        (true, None) => ("|z| < 1 for every eigenvalue of N".to_owned(), 1.0),
    };
    let value = if slowest == f64::NEG_INFINITY { limit.min(-1.0) } else { slowest };
    Check { name: "decay".to_owned(), statement, value, limit }
}

/// Relative distance within which a fixed mode is found again in the spectrum.
const MODE_LIMIT: f64 = 1e-3;

/// The modes that no gain moves are in the spectrum: the pair and the finished observer agree.
fn fixed_modes(setup: &Setup, spectrum: &[Complex64]) -> Check {
    let size = spectrum.iter().chain(&setup.fixed_modes).map(|s| s.norm()).fold(f64::MIN_POSITIVE, f64::max);
    let nearest = |mode: &Complex64| spectrum.iter().map(|s| (s - mode).norm()).fold(f64::INFINITY, f64::min);
    Check {
        name: "fixed modes".to_owned(),
        statement: "modes that no gain moves are eigenvalues of N".to_owned(),
        value: setup.fixed_modes.iter().map(nearest).fold(0.0, f64::max) / size,
        limit: MODE_LIMIT,
    }
}
