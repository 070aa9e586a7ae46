//! The re-check of a designed observer, by arithmetic that no design shares.
#![expect(non_snake_case, reason = "matrix letters of the canonical forms")]

use nalgebra::{DMatrix, DVector};
use serde::{Deserialize, Serialize};

use super::{Claim, LinearObserver};
use crate::numerics::Block::{Of, Zero};
use crate::numerics::{
    Complex64, NumericsError, StabilityRegion, Tolerance, block_matrix, eigenvalues, side_by_side,
    spectral_distance, stack,
};
use crate::system::{DescriptorSystem, TimeDomain};

/// One statement that was re-checked.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Check {
    /// What is checked, in words.
    pub name: String,
    /// The statement.
    pub statement: String,
    /// What was found: a relative residual, a distance, or the largest real part.
    pub value: f64,
    /// The value must not exceed this.
    pub limit: f64,
}

impl Check {
    /// Whether the statement was confirmed.
    pub fn passed(&self) -> bool {
        self.value <= self.limit
    }
}

/// All checks of one design.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Verification {
    /// The checks, in the order of the argument: identities, spectrum, stability, transfer.
    pub checks: Vec<Check>,
    /// Eigenvalues of the error dynamics, computed from the finished observer.
    pub spectrum: Vec<Complex64>,
    /// Checks that could not be made, and why.
    pub skipped: Vec<String>,
}

impl Verification {
    /// Whether every check passed.
    pub fn verified(&self) -> bool {
        !self.checks.is_empty() && self.checks.iter().all(Check::passed)
    }

    /// The checks that failed.
    pub fn failures(&self) -> impl Iterator<Item = &Check> {
        self.checks.iter().filter(|check| !check.passed())
    }
}

/// Largest relative distance between requested and achieved poles that still counts as placed.
const SPECTRUM_LIMIT: f64 = 1e-3;

/// Re-checks an observer against the plant's own matrices.
///
/// Identities of the [`Claim`], the spectrum of `N` against the requested poles and the fixed modes, stability, and
/// the joint transfer functions of plant and observer at points off the axes: nothing of the design's own arithmetic
/// is used.
///
/// # Errors
/// When a decomposition fails its own check.
///
/// # Source
/// Identities: Koenig and Mammar 2002, (6), (7); transfer `f_hat/f = I - s [0 I] (s I - A_obs)^-1 [0; I]`.
pub fn verify(
    system: &DescriptorSystem,
    observer: &LinearObserver,
    claim: &Claim,
    expected_spectrum: &[Complex64],
    tolerance: &Tolerance,
) -> Result<Verification, NumericsError> {
    let mut result =
        Verification { checks: identities(system, observer, claim, tolerance), ..Verification::default() };
    result.spectrum = eigenvalues(&observer.N)?;
    let region = StabilityRegion::of(system.time == TimeDomain::Discrete);
    let size = spectrum_size(expected_spectrum, observer, region);
    result.checks.push(Check {
        name: "spectrum".to_owned(),
        statement: "eigenvalues of the error dynamics = requested poles and fixed modes".to_owned(),
        value: spectral_distance(&result.spectrum, expected_spectrum) / size,
        limit: SPECTRUM_LIMIT,
    });
    let worst = result.spectrum.iter().map(|z| region.excess(*z)).fold(f64::NEG_INFINITY, f64::max);
    result.checks.push(Check {
        name: "stability".to_owned(),
        statement: region.statement().to_owned(),
        value: if result.spectrum.is_empty() { -1.0 } else { worst },
        limit: -tolerance.margin,
    });
    match transfer(system, observer) {
        Some(checks) => {
            if observer.n_estimated_inputs() > 0 && !checks.iter().any(|check| check.name == STEADY) {
                result
                    .skipped
                    .push("constant unknown input: the plant has a pole at zero frequency".to_owned());
            }
            result.checks.extend(checks);
        }
        None => result.skipped.push(
            "transfer functions: s E - A is not square and regular, so the plant has no transfer function"
                .to_owned(),
        ),
    }
    Ok(result)
}

/// What a distance between spectra is relative to: the largest expected eigenvalue, but no less than the unit disk in
/// discrete time, where deadbeat poles are zero; the size of `N` when all are zero in continuous time.
fn spectrum_size(expected: &[Complex64], observer: &LinearObserver, region: StabilityRegion) -> f64 {
    let largest = expected.iter().map(|z| z.norm()).fold(0.0, f64::max);
    match region {
        StabilityRegion::UnitDisk => largest.max(1.0),
        StabilityRegion::LeftHalfPlane if largest == 0.0 => observer.N.norm().max(f64::MIN_POSITIVE),
        StabilityRegion::LeftHalfPlane => largest,
    }
}

/// Residuals of the claimed identities, each relative to what the absolute values of its terms allow.
fn identities(
    system: &DescriptorSystem,
    observer: &LinearObserver,
    claim: &Claim,
    tolerance: &Tolerance,
) -> Vec<Check> {
    let DescriptorSystem { E, A, B, C, D, F, time } = system;
    let LinearObserver { N, L, H, P, V, W, Q, R, S } = observer;
    let Claim { T, G } = claim;
    let q = observer.n_estimated_inputs();
    let estimated = |m: &DMatrix<f64>| m.columns(0, q).into_owned();
    let (D, F) = (estimated(D), estimated(F));
    let hold = DMatrix::identity(q, q) * if *time == TimeDomain::Discrete { 1.0 } else { 0.0 };
    let Ea = block_matrix(&[&[Of(E), Zero], &[Zero, Of(&DMatrix::identity(q, q))]]);
    let Aa = block_matrix(&[&[Of(A), Of(&D)], &[Zero, Of(&hold)]]);
    let Ba = stack(&[B, &DMatrix::zeros(q, B.ncols())]);
    let Ca = side_by_side(&[C, &F]);
    let AD = side_by_side(&[A, &D]);
    let (PQ, VR, WS) = (stack(&[P, Q]), stack(&[V, R]), stack(&[W, S]));
    let unit = DMatrix::identity(E.ncols() + q, E.ncols() + q);
    let residual = |name: &str, statement: &str, sum: DMatrix<f64>, size: DMatrix<f64>| {
        let (found, size) = (largest(&sum), largest(&size));
        let value = if size == 0.0 { 0.0 } else { found / size };
        Check { name: name.to_owned(), statement: statement.to_owned(), value, limit: tolerance.residual }
    };
    // |N| |T| |Ea| bounds what rounding can leave; the product of norms would let large gains hide an error
    let abs = DMatrix::<f64>::abs;
    let track = abs(T) * abs(&Ea);
    vec![
        residual(
            "error dynamics",
            "N T Ea - T Aa + L Ca = 0",
            N * T * &Ea - T * &Aa + L * &Ca,
            abs(N) * &track + abs(T) * abs(&Aa) + abs(L) * abs(&Ca),
        ),
        residual("known input", "H - T Ba = 0", H - T * &Ba, abs(H) + abs(T) * abs(&Ba)),
        residual(
            "unbiased estimate",
            "[P; Q] T Ea + G [A D] + [V; R] Ca = I",
            &PQ * T * &Ea + G * &AD + &VR * &Ca - &unit,
            abs(&PQ) * &track + abs(G) * abs(&AD) + abs(&VR) * abs(&Ca) + &unit,
        ),
        residual("input in the estimate", "[W; S] + G B = 0", &WS + G * B, abs(&WS) + abs(G) * abs(B)),
        residual("algebraic rows", "G E = 0", G * E, abs(G) * abs(E)),
    ]
}

/// The largest entry in absolute value; zero for an empty matrix.
fn largest(matrix: &DMatrix<f64>) -> f64 {
    matrix.iter().fold(0.0, |largest: f64, x| largest.max(x.abs()))
}

/// Points at which the joint transfer functions are compared, as multiples of the observer's mean pole distance.
const SAMPLE_POINTS: [Complex64; 3] =
    [Complex64::new(0.83, 1.27), Complex64::new(2.1, -0.4), Complex64::new(0.31, 3.9)];

/// Points off the axes, at the pace of an observer.
pub(super) fn sample_points(system: &DescriptorSystem, observer: &LinearObserver) -> [Complex64; 3] {
    let size = 1.0 + observer.N.norm() / (observer.order().max(1) as f64).sqrt();
    let discrete = system.time == TimeDomain::Discrete;
    SAMPLE_POINTS.map(|point| if discrete { point + 1.0 } else { point * size })
}

/// Joint transfer functions of plant and observer at a few points (identities of rational functions).
///
/// `u -> x - x_hat` and `u -> d_hat` vanish; `d -> d_hat` equals `I - s [0 I](sI - N)^-1 [0; I]` in the error
/// coordinates, which for a constant `d` means `d_hat -> d`; `None` when the plant has no transfer function.
fn transfer(system: &DescriptorSystem, observer: &LinearObserver) -> Option<Vec<Check>> {
    let mut worst = 0.0_f64;
    for s in sample_points(system, observer) {
        let response = Response::at(s, system, observer, &complex(&system.B), &identity(system.n_inputs()))?;
        let scale = 1.0 + response.x.norm() + response.x_hat.norm() + response.terms;
        worst = worst.max((&response.x - &response.x_hat).norm() / scale).max(response.d_hat.norm() / scale);
    }
    let known = Check {
        name: "known input decoupled".to_owned(),
        statement: "transfer u -> x - x_hat and u -> d_hat vanishes, joint with the plant".to_owned(),
        value: worst,
        limit: TRANSFER_LIMIT,
    };
    let steady = steady_state(system, observer);
    Some(std::iter::once(known).chain(steady).collect())
}

/// Relative size below which a transfer function value counts as zero; the joint solve loses a few digits.
pub(super) const TRANSFER_LIMIT: f64 = 1e-7;

const STEADY: &str = "constant unknown input";

/// A constant unknown input is estimated without offset: `d_hat(d) -> I` at `s = 0` (`z = 1`), and `x_hat -> x`.
fn steady_state(system: &DescriptorSystem, observer: &LinearObserver) -> Option<Check> {
    let q = observer.n_estimated_inputs();
    if q == 0 {
        return None;
    }
    let s = Complex64::from(if system.time == TimeDomain::Discrete { 1.0 } else { 0.0 });
    let response = unknown_input_response(s, system, observer)?;
    let scale = 1.0 + response.terms;
    let value = ((response.d_hat - identity(q)).norm()).max((response.x - response.x_hat).norm()) / scale;
    Some(Check {
        name: STEADY.to_owned(),
        statement: "d_hat = d and x_hat = x at zero frequency, joint with the plant".to_owned(),
        value,
        limit: TRANSFER_LIMIT,
    })
}

/// Response of plant and observer to one column of inputs at one complex frequency.
#[derive(Clone, Debug)]
pub struct Response {
    /// State of the plant.
    pub x: DMatrix<Complex64>,
    /// Its estimate.
    pub x_hat: DMatrix<Complex64>,
    /// Estimate of the unknown input.
    pub d_hat: DMatrix<Complex64>,
    /// Size of the terms that were added up, for judging residuals.
    terms: f64,
}

/// Joint response to the unknown inputs at `s`; `None` where `s E - A` or `s I - N` is singular or not square.
///
/// ```text
/// (s E - A) x = D d,   (s I - N) z = L (C x + F d),   d_hat = Q z + R (C x + F d)
/// ```
pub fn unknown_input_response(
    s: Complex64,
    system: &DescriptorSystem,
    observer: &LinearObserver,
) -> Option<Response> {
    let q = system.n_unknown_inputs();
    let mut response =
        Response::at(s, system, observer, &complex(&system.D), &DMatrix::zeros(system.n_inputs(), q))?;
    let direct = complex(&system.F);
    let states = pencil(s, &DMatrix::identity(observer.order(), observer.order()), &observer.N);
    let z = solve(&states, &(complex(&observer.L) * &direct))?;
    response.x_hat += complex(&observer.P) * &z + complex(&observer.V) * &direct;
    response.d_hat += complex(&observer.Q) * &z + complex(&observer.R) * &direct;
    Some(response)
}

impl Response {
    /// Response to plant input columns `forcing` (in the equations) with known input columns `u`.
    fn at(
        s: Complex64,
        system: &DescriptorSystem,
        observer: &LinearObserver,
        forcing: &DMatrix<Complex64>,
        u: &DMatrix<Complex64>,
    ) -> Option<Self> {
        let DescriptorSystem { E, A, C, .. } = system;
        let LinearObserver { N, L, H, P, V, W, Q, R, S } = observer;
        if !E.is_square() {
            return None;
        }
        let x = solve(&pencil(s, E, A), forcing)?;
        let y = complex(C) * &x;
        let drive = complex(L) * &y + complex(H) * u;
        let z = solve(&pencil(s, &DMatrix::identity(N.nrows(), N.nrows()), N), &drive)?;
        let x_hat = complex(P) * &z + complex(V) * &y + complex(W) * u;
        let d_hat = complex(Q) * &z + complex(R) * &y + complex(S) * u;
        let terms = (complex(P) * &z).norm() + (complex(V) * &y).norm() + (complex(Q) * &z).norm() + x.norm();
        Some(Self { x, x_hat, d_hat, terms })
    }
}

/// Reciprocal condition below which a pencil value counts as singular.
const SINGULAR_LIMIT: f64 = 1e-13;

/// Solves a square system; `None` where it is singular, or so close to it that the result would mean nothing.
pub(super) fn solve(matrix: &DMatrix<Complex64>, right: &DMatrix<Complex64>) -> Option<DMatrix<Complex64>> {
    if matrix.is_empty() {
        return Some(DMatrix::zeros(0, right.ncols()));
    }
    let lu = matrix.clone().lu();
    let diagonal: DVector<Complex64> = lu.u().diagonal();
    let sizes = diagonal.iter().map(|z| z.norm());
    let (small, large) =
        sizes.fold((f64::INFINITY, 0.0_f64), |(small, large), z| (small.min(z), large.max(z)));
    if small <= SINGULAR_LIMIT * large {
        return None;
    }
    lu.solve(right)
}

/// `s E - A`.
pub(super) fn pencil(s: Complex64, E: &DMatrix<f64>, A: &DMatrix<f64>) -> DMatrix<Complex64> {
    E.zip_map(A, |e, a| s * e - a)
}

pub(super) fn complex(matrix: &DMatrix<f64>) -> DMatrix<Complex64> {
    matrix.map(Complex64::from)
}

fn identity(n: usize) -> DMatrix<Complex64> {
    DMatrix::identity(n, n)
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::dmatrix;

    /// A plain Luenberger observer of an integrator chain: `E = I`, `z = x_hat`, `T = I`, `G = 0`.
    fn luenberger(gain: [f64; 2]) -> (DescriptorSystem, LinearObserver, Claim) {
        let A = dmatrix![0.0, 1.0; 0.0, 0.0];
        let C = dmatrix![1.0, 0.0];
        let L = DMatrix::from_column_slice(2, 1, &gain);
        let mut system = DescriptorSystem::autonomous(DMatrix::identity(2, 2), A.clone(), C.clone()).unwrap();
        system.B = dmatrix![0.0; 1.0];
        let none = |rows, columns| DMatrix::zeros(rows, columns);
        let observer = LinearObserver {
            N: A - &L * C,
            L,
            H: system.B.clone(),
            P: DMatrix::identity(2, 2),
            V: none(2, 1),
            W: none(2, 1),
            Q: none(0, 2),
            R: none(0, 1),
            S: none(0, 1),
        };
        (system, observer, Claim { T: DMatrix::identity(2, 2), G: none(2, 2) })
    }

    fn poles() -> [Complex64; 2] {
        [-1.0, -2.0].map(Complex64::from)
    }

    #[test]
    fn a_correct_observer_is_verified() {
        let (system, observer, claim) = luenberger([3.0, 2.0]);
        let result = verify(&system, &observer, &claim, &poles(), &Tolerance::default()).unwrap();
        assert!(result.verified(), "all checks pass: {:?}", result.checks);
        assert!(result.skipped.is_empty(), "a regular plant has a transfer function");
    }

    #[test]
    fn deadbeat_poles_are_judged_against_the_unit_disk() {
        // eigenvalues of a defective matrix are good to the square root of the rounding only
        let (mut system, mut observer, claim) = luenberger([0.0, 0.0]);
        system.time = TimeDomain::Discrete;
        system.A = dmatrix![1.0, 1.0; 0.0, 1.0];
        observer.L = dmatrix![2.0; 1.0];
        observer.N = &system.A - &observer.L * &system.C;
        let zeros = [Complex64::ZERO; 2];
        let result = verify(&system, &observer, &claim, &zeros, &Tolerance::default()).unwrap();
        assert!(result.verified(), "both poles at zero: {:?}", result.checks);
    }

    #[test]
    fn a_wrong_gain_fails_the_spectrum_check_alone() {
        let (system, observer, claim) = luenberger([3.0, 2.5]);
        let result = verify(&system, &observer, &claim, &poles(), &Tolerance::default()).unwrap();
        let failed: Vec<&str> = result.failures().map(|check| check.name.as_str()).collect();
        assert_eq!(failed, ["spectrum"], "stable and unbiased, but the poles are not where asked");
    }

    #[test]
    fn a_forgotten_input_is_found_twice() {
        let (system, mut observer, claim) = luenberger([3.0, 2.0]);
        observer.H.fill(0.0);
        let result = verify(&system, &observer, &claim, &poles(), &Tolerance::default()).unwrap();
        let failed: Vec<&str> = result.failures().map(|check| check.name.as_str()).collect();
        assert_eq!(
            failed,
            ["known input", "known input decoupled"],
            "by the identity and by the joint transfer"
        );
    }

    #[test]
    fn an_unstable_observer_is_never_verified() {
        let (system, observer, claim) = luenberger([-3.0, 2.0]);
        let wished = [1.0, 2.0].map(Complex64::from);
        let result = verify(&system, &observer, &claim, &wished, &Tolerance::default()).unwrap();
        assert!(result.failures().any(|check| check.name == "stability"), "{:?}", result.checks);
    }
}
