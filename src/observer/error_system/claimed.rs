//! Error systems that do not contain the plant: of designs with a claim, and of hierarchical observers.
#![expect(non_snake_case, reason = "matrix letters of the common observer form and of the claim")]

use nalgebra::DMatrix;

use super::{ErrorStateSpace, Terms, region};
use crate::numerics::stack;
use crate::observer::{Claim, Design, LinearObserver};
use crate::system::DescriptorSystem;

/// The error system of an observer with a claim.
///
/// ```text
/// z' - T1 E x' = N z + L (C x + F d + w) + H u - T1 (A x + B u + D d)
///              = N (z - T1 E x) + (N T1 E - T1 A + L C) x + (H - T1 B) u + (L F - T1 D) d + L w
/// [P; Q] z + [V; R] y + [W; S] u - [x; d]
///              = [P; Q] (z - T1 E x) - G (A x + B u) + [V; R] (F d + w) - [0; d],     G (A x + B u + D d) = G E x' = 0
/// ```
pub(super) fn claimed(
    system: &DescriptorSystem,
    observer: &LinearObserver,
    claim: &Claim,
) -> ErrorStateSpace {
    let DescriptorSystem { E, D, F, .. } = system;
    let LinearObserver { N, L, P, V, Q, R, .. } = observer;
    let (n, q) = (E.ncols(), observer.n_estimated_inputs());
    let T1 = claim.T.columns(0, E.nrows()).into_owned();
    let G = &claim.G;
    let (PQ, VR) = (stack(&[P, Q]), stack(&[V, R]));
    let mut own = DMatrix::zeros(n + q, D.ncols());
    own.view_mut((n, 0), (q, q.min(D.ncols()))).fill_with_identity();
    let abs = DMatrix::<f64>::abs;
    let terms = Terms {
        b_d: abs(L) * abs(F) + abs(&T1) * abs(D),
        c: abs(&PQ),
        d_d: abs(&VR) * abs(F) + abs(G) * abs(D) + &own,
    };
    ErrorStateSpace {
        a: N.clone(),
        b_d: L * F - &T1 * D,
        b_w: L.clone(),
        c: PQ,
        d_d: &VR * F + G * D - own,
        d_w: VR,
        states: (0..n).collect(),
        region: region(system),
        with_plant: false,
        terms,
    }
}

/// The error system of the composite observer of a network: with `z -> [sigma_z x; x_i for i plugged in]` the error is
/// that of a claim with `E = I`, `G = 0`, for the states that have a local observer; the others are not estimated.
///
/// `None` when the observer is not the composite one of this system, or an unknown input acts on it.
pub(super) fn of_network(system: &DescriptorSystem, design: &Design) -> Option<ErrorStateSpace> {
    let LinearObserver { N, L, P, V, .. } = &design.observer;
    let n = system.n_states();
    if P.nrows() != n || system.n_unknown_inputs() > 0 {
        return None;
    }
    let states = design.estimated_states(n);
    let (c, d_w) = (P.select_rows(&states), V.select_rows(&states));
    let none = |rows| DMatrix::zeros(rows, 0);
    let terms = Terms { b_d: none(N.nrows()), c: c.abs(), d_d: none(states.len()) };
    Some(ErrorStateSpace {
        a: N.clone(),
        b_d: none(N.nrows()),
        b_w: L.clone(),
        d_d: none(states.len()),
        c,
        d_w,
        states,
        region: region(system),
        with_plant: false,
        terms,
    })
}
