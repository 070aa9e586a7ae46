//! The re-check that no unknown input reaches the errors, by arithmetic that no design shares.
#![expect(non_snake_case, reason = "matrix letters of the canonical forms")]

use nalgebra::DMatrix;

use crate::numerics::{
    Complex64, NumericsError, RankDecision, StabilityRegion, Tolerance, complex_svd, side_by_side,
};
use crate::observer::{Check, Claim, LinearObserver, Verification, verify};
use crate::system::{DescriptorSystem, TimeDomain};

/// Points at which trajectories `x(t) = x e^(s t)` are tried, as multiples of the observer's mean pole distance.
const POINTS: [Complex64; 3] =
    [Complex64::new(0.83, 1.27), Complex64::new(1.9, -0.6), Complex64::new(0.31, 3.9)];

/// Relative size below which an error counts as zero; the joint solve loses a few digits.
const LIMIT: f64 = 1e-7;

/// Re-checks an input-decoupled observer: everything of [`verify()`], and that no unknown input reaches the errors.
///
/// Two further statements are checked, both in the plant's own matrices. The unknown input has no share in what `z`
/// tracks: with `T [0; I] = 0` the identities make `z - T E x` obey `eps' = H eps` for *every* `d(t)`, not only for
/// constant ones. And every trajectory `x e^(s t)` of the plant, of any shape, its free states and unknown inputs included,
/// is reproduced by the observer:
/// ```text
/// [A - s E, B, D] [x; u; d] = 0,  y = C x + F d,  (s I - N) z = L y + H u     =>     x_hat = x,  d_hat = d
/// ```
///
/// # Errors
/// When a decomposition fails its own check.
pub fn verify_decoupled(
    system: &DescriptorSystem,
    observer: &LinearObserver,
    claim: &Claim,
    expected_spectrum: &[Complex64],
    tolerance: &Tolerance,
) -> Result<Verification, NumericsError> {
    let mut result = verify(system, observer, claim, expected_spectrum, tolerance)?;
    let share = claim.T.columns(system.n_equations(), system.n_unknown_inputs());
    let largest = |values: &mut dyn Iterator<Item = f64>| values.fold(0.0_f64, |l, x| l.max(x.abs()));
    let whole = largest(&mut claim.T.iter().copied()).max(f64::MIN_POSITIVE);
    result.checks.push(Check {
        name: "unknown input not tracked".to_owned(),
        statement: "T [0; I] = 0: the errors obey e' = H e for every d(t)".to_owned(),
        value: largest(&mut share.iter().copied()) / whole,
        limit: tolerance.residual,
    });
    match reproduced(system, observer, tolerance)? {
        Some(value) => {
            result.checks.push(Check {
                name: "unknown input decoupled".to_owned(),
                statement: "x_hat = x and d_hat = d on every trajectory x e^(s t) of the plant, for all u, d and free states"
                    .to_owned(),
                value,
                limit: LIMIT,
            });
        }
        None => result
            .skipped
            .push("trajectories x e^(s t): the plant has none at the points that were tried".to_owned()),
    }
    Ok(result)
}

/// The largest relative error over all trajectories at the sample points; `None` when there is no such trajectory.
fn reproduced(
    system: &DescriptorSystem,
    observer: &LinearObserver,
    tolerance: &Tolerance,
) -> Result<Option<f64>, NumericsError> {
    let DescriptorSystem { E, A, B, C, D, F, time } = system;
    let LinearObserver { N, L, H, P, V, W, Q, R, S } = observer;
    let (n, k, q, order) = (E.ncols(), B.ncols(), D.ncols(), N.nrows());
    let size = 1.0 + N.norm() / (order.max(1) as f64).sqrt();
    let region = StabilityRegion::of(*time == TimeDomain::Discrete);
    let (ABD, E00) = (side_by_side(&[A, B, D]), side_by_side(&[E, &DMatrix::zeros(E.nrows(), k + q)]));
    let mut worst: Option<f64> = None;
    for point in POINTS {
        let s = match region {
            StabilityRegion::UnitDisk => point + 1.0,
            StabilityRegion::LeftHalfPlane => point * size,
        };
        let pencil = ABD.zip_map(&E00, |a, e| Complex64::from(a) - s * e);
        let found = complex_svd(&pencil)?;
        let rank = RankDecision::from_singular_values(pencil.shape(), found.s, 0.0, tolerance).rank;
        let paths = found.v.columns(rank, n + k + q - rank).into_owned();
        if paths.ncols() == 0 {
            continue;
        }
        let (x, u, d) = (paths.rows(0, n), paths.rows(n, k), paths.rows(n + k, q));
        let y = complex(C) * x + complex(F) * d;
        let drive = complex(L) * &y + complex(H) * u;
        let Some(z) = solve(s, N, &drive) else { continue };
        let (from_state, from_output) = (complex(P) * &z, complex(V) * &y);
        let (d_from_state, d_from_output) = (complex(Q) * &z, complex(R) * &y);
        let terms = from_state.norm() + from_output.norm() + d_from_state.norm() + d_from_output.norm();
        let x_off = from_state + from_output + complex(W) * u - x;
        let d_off = d_from_state + d_from_output + complex(S) * u - d;
        let off = x_off.norm().hypot(d_off.norm()) / (1.0 + terms);
        worst = Some(worst.map_or(off, |w| w.max(off)));
    }
    Ok(worst)
}

/// `(s I - N)^-1 right`; `None` where `s` is an eigenvalue.
fn solve(s: Complex64, N: &DMatrix<f64>, right: &DMatrix<Complex64>) -> Option<DMatrix<Complex64>> {
    if N.is_empty() {
        return Some(DMatrix::zeros(0, right.ncols()));
    }
    let unit = DMatrix::<f64>::identity(N.nrows(), N.nrows());
    unit.zip_map(N, |e, a| s * e - a).lu().solve(right)
}

fn complex(matrix: &DMatrix<f64>) -> DMatrix<Complex64> {
    matrix.map(Complex64::from)
}
