//! Error systems that contain the plant as far as the error shows it: of composites of decentralized observers.
#![expect(non_snake_case, reason = "matrix letters of the common observer form")]

use nalgebra::DMatrix;

use super::{ErrorStateSpace, ErrorSystemError, Terms, region};
use crate::numerics::Block::{Of, Zero};
use crate::numerics::{
    RankDecision, Tolerance, block_matrix, eigenvalues, observable_quotient, side_by_side, stack, svd,
};
use crate::observer::LinearObserver;
use crate::system::DescriptorSystem;

/// Most states of plant and observer whose error is separated from the plant: each mode costs a decomposition.
const LARGEST_JOINT: usize = 150;

/// A square plant of index 1 in its differential states: `xi' = A xi + B d`, `x = X xi + Y d`.
struct Reduced {
    A: DMatrix<f64>,
    B: DMatrix<f64>,
    X: DMatrix<f64>,
    Y: DMatrix<f64>,
}

/// The error system of plant and observer together, without what the error does not show.
///
/// ```text
/// xi' = Ar xi + Br d,   z' = L C X xi + N z + L (C Y + F) d + L w
/// x_hat - x = P z + (V C - I) (X xi + Y d) + V (F d + w)
/// ```
///
/// A stable joint system is used as it is. Otherwise the modes that the error does not show are split off: when all of the
/// plant's are among them, what is left is autonomous.
///
/// # Errors
/// A plant that is not square or not of index 1, or too large for the splitting.
pub(super) fn joint(
    system: &DescriptorSystem,
    observer: &LinearObserver,
    tolerance: &Tolerance,
) -> Result<ErrorStateSpace, ErrorSystemError> {
    let DescriptorSystem { C, F, .. } = system;
    let LinearObserver { N, L, P, V, Q, R, .. } = observer;
    let plant = reduced(system, tolerance)?;
    let (n, q, p) = (system.n_states(), observer.n_estimated_inputs(), C.nrows());
    let (PQ, VR) = (stack(&[P, Q]), stack(&[V, R]));
    let mut unit = DMatrix::zeros(n + q, n);
    unit.view_mut((0, 0), (n, n)).fill_with_identity();
    let mut own = DMatrix::zeros(n + q, system.n_unknown_inputs());
    own.view_mut((n, 0), (q, q.min(own.ncols()))).fill_with_identity();
    let seen = &VR * C - &unit;
    let abs = DMatrix::<f64>::abs;
    let sizes = abs(&VR) * abs(C) + &unit;
    let drive = C * &plant.Y + F;
    let joint = ErrorStateSpace {
        a: block_matrix(&[&[Of(&plant.A), Zero], &[Of(&(L * C * &plant.X)), Of(N)]]),
        b_d: stack(&[&plant.B, &(L * &drive)]),
        b_w: stack(&[&DMatrix::zeros(plant.A.nrows(), p), L]),
        c: side_by_side(&[&(&seen * &plant.X), &PQ]),
        d_d: &seen * &plant.Y + &VR * F - &own,
        d_w: VR.clone(),
        states: (0..n).collect(),
        region: region(system),
        with_plant: true,
        terms: Terms {
            b_d: stack(&[&abs(&plant.B), &(abs(L) * (abs(C) * abs(&plant.Y) + abs(F)))]),
            c: side_by_side(&[&(&sizes * abs(&plant.X)), &abs(&PQ)]),
            d_d: &sizes * abs(&plant.Y) + abs(&VR) * abs(F) + own,
        },
    };
    let margin = joint.region.margin(joint.a.norm(), tolerance);
    if eigenvalues(&joint.a)?.into_iter().all(|mode| joint.region.contains(mode, margin)) {
        return Ok(joint);
    }
    shown(joint, tolerance)
}

/// What the error shows of a joint system.
fn shown(joint: ErrorStateSpace, tolerance: &Tolerance) -> Result<ErrorStateSpace, ErrorSystemError> {
    let found = joint.a.nrows();
    if found > LARGEST_JOINT {
        return Err(ErrorSystemError::TooLarge { found, most: LARGEST_JOINT });
    }
    let basis = observable_quotient(&joint.a, &joint.c, tolerance)?.basis;
    let size = basis.abs();
    Ok(ErrorStateSpace {
        a: basis.tr_mul(&(&joint.a * &basis)),
        b_d: basis.tr_mul(&joint.b_d),
        b_w: basis.tr_mul(&joint.b_w),
        c: &joint.c * &basis,
        terms: Terms {
            b_d: size.tr_mul(&joint.terms.b_d),
            c: &joint.terms.c * &size,
            d_d: joint.terms.d_d.clone(),
        },
        ..joint
    })
}

/// Eliminates the algebraic states in the singular value coordinates of `E`.
///
/// ```text
/// E = U1 S V1',   x = V1 xi + V2 eta,   eta = -(U2' A V2)^-1 U2' (A V1 xi + D d),   S xi' = U1' (A x + D d)
/// ```
fn reduced(system: &DescriptorSystem, tolerance: &Tolerance) -> Result<Reduced, ErrorSystemError> {
    let DescriptorSystem { E, A, D, .. } = system;
    let (equations, states) = E.shape();
    if equations != states {
        return Err(ErrorSystemError::NotSquare { equations, states });
    }
    let found = svd(E)?;
    let r = RankDecision::from_singular_values((states, states), found.s.clone(), 0.0, tolerance).rank;
    let (V1, V2) = (found.v.columns(0, r).into_owned(), found.v.columns(r, states - r).into_owned());
    let U2 = found.u.columns(r, states - r).transpose();
    let mut rows = found.u.columns(0, r).transpose();
    for (mut row, s) in rows.row_iter_mut().zip(&found.s) {
        row /= *s;
    }
    let A22 = &U2 * A * &V2;
    let index = RankDecision::from_singular_values(A22.shape(), svd(&A22)?.s, A.norm(), tolerance);
    let solve = |right: DMatrix<f64>| match A22.clone().lu().solve(&right) {
        Some(eta) if index.rank == A22.nrows() => Ok(eta),
        _ => Err(ErrorSystemError::NotIndexOne { smallest: index.smallest() }),
    };
    // an empty system of equations has no factorisation
    let solve = |right: DMatrix<f64>| if A22.is_empty() { Ok(right) } else { solve(right) };
    let X = &V1 - &V2 * solve(&U2 * A * &V1)?;
    let Y = -(&V2 * solve(&U2 * D)?);
    Ok(Reduced { A: &rows * A * &X, B: &rows * (A * &Y + D), X, Y })
}
