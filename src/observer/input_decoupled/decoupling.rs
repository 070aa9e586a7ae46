//! The re-check that no unknown input reaches the errors, by arithmetic that no design shares.
#![expect(non_snake_case, reason = "matrix letters of the canonical forms")]

use nalgebra::DMatrix;

use crate::numerics::{Complex64, NumericsError, RankDecision, Tolerance, complex_svd, side_by_side};
use crate::observer::verify::{TRANSFER_LIMIT, complex, pencil, sample_points, solve};
use crate::observer::{Check, Claim, LinearObserver, Verification, verify};
use crate::system::{DescriptorSystem, TimeDomain};

/// Re-checks an input-decoupled observer: everything of [`verify()`], and that no unknown input reaches the errors.
///
/// Two further statements are checked, both in the plant's own matrices. The unknown input has no share in what `z`
/// tracks: with `T [0; I] = 0` the identities make `z - T E x` obey `eps' = H eps` for *every* `d(t)`, not only for
/// constant ones (discrete: `eps[k+1] = H eps`). And every trajectory `x e^(s t)` (`x s^k`) of the plant, of any shape, its free states and unknown inputs included,
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
        statement: match system.time {
            TimeDomain::Continuous => "T [0; I] = 0: the errors obey e' = H e for every d(t)".to_owned(),
            TimeDomain::Discrete => "T [0; I] = 0: the errors obey e[k+1] = H e[k] for every d[k]".to_owned(),
        },
        value: largest(&mut share.iter().copied()) / whole,
        limit: tolerance.residual,
    });
    let motion = match system.time {
        TimeDomain::Continuous => "x e^(s t)",
        TimeDomain::Discrete => "x s^k",
    };
    match reproduced(system, observer, tolerance)? {
        Some(value) => {
            result.checks.push(Check {
                name: "unknown input decoupled".to_owned(),
                statement: format!(
                    "x_hat = x and d_hat = d on every trajectory {motion} of the plant, for all u, d and free states"
                ),
                value,
                limit: TRANSFER_LIMIT,
            });
        }
        None => result
            .skipped
            .push(format!("trajectories {motion}: the plant has none at the points that were tried")),
    }
    Ok(result)
}

/// The largest relative error over all trajectories at the sample points; `None` when there is no such trajectory.
fn reproduced(
    system: &DescriptorSystem,
    observer: &LinearObserver,
    tolerance: &Tolerance,
) -> Result<Option<f64>, NumericsError> {
    let DescriptorSystem { E, A, B, C, D, F, .. } = system;
    let LinearObserver { N, L, H, P, V, W, Q, R, S } = observer;
    let (n, k, q) = (E.ncols(), B.ncols(), D.ncols());
    let (ABD, E00) = (side_by_side(&[A, B, D]), side_by_side(&[E, &DMatrix::zeros(E.nrows(), k + q)]));
    let mut worst: Option<f64> = None;
    for s in sample_points(system, observer) {
        let plant = pencil(s, &E00, &ABD);
        let found = complex_svd(&plant)?;
        let rank = RankDecision::from_singular_values(plant.shape(), found.s, 0.0, tolerance).rank;
        let paths = found.v.columns(rank, n + k + q - rank).into_owned();
        if paths.ncols() == 0 {
            continue;
        }
        let (x, u, d) = (paths.rows(0, n), paths.rows(n, k), paths.rows(n + k, q));
        let y = complex(C) * x + complex(F) * d;
        let drive = complex(L) * &y + complex(H) * u;
        let Some(z) = solve(&pencil(s, &DMatrix::identity(N.nrows(), N.nrows()), N), &drive) else {
            continue;
        };
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
