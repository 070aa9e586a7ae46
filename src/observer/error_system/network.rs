//! The error system of a hierarchical observer, of a size that does not depend on the number of subsystems.
#![expect(non_snake_case, reason = "matrix letters follow paper 003")]

use nalgebra::DMatrix;

use super::{ErrorStateSpace, ErrorSystemError, Terms};
use crate::numerics::{StabilityRegion, stack};
use crate::observer::hierarchical::HierarchicalObserver;
use crate::system::Network;

/// Most states of the rotated error system; its norm takes eigenvalues of twice as many at every step.
const LARGEST: usize = 120;

/// From measurement noise to the errors of all states that the observer estimates, in rotated coordinates.
///
/// ```text
/// e_z' = (alpha_z - H gamma_z) e_z + H w_G
/// e_i' = (a - h c_L) e_i + ((Gamma N)_i kron b c_z) e_z + h w_i             i plugged in
/// ```
///
/// The rows `(Gamma N)_i` of all subsystems with one gain `h` are `Q R` with orthonormal columns of `Q`, at most `nu` of
/// them. Rotating errors and noises of these subsystems by `[Q, Q_perp]` changes no norm: `R` takes the place of `Gamma N`,
/// and all the others are copies of `e' = (a - h c_L) e + h w`. What passes through these passes through a row of `R` as
/// well, so that none of them is needed unless nothing is coupled and `R` has no row.
///
/// # Shapes
/// Rows of `c`: the rotated errors of the subsystems with local observers, then the states that the whole determines. They
/// are as many as the largest gain needs, not one for each state.
///
/// # Errors
/// [`ErrorSystemError::TooLarge`], when what the whole shows is too large.
///
/// # Source
/// Paper 003, (8), (12).
pub fn network_error_system(
    network: &Network,
    observer: &HierarchicalObserver,
) -> Result<ErrorStateSpace, ErrorSystemError> {
    let HierarchicalObserver { hierarchy, global, .. } = observer;
    let (n, own, p) = (network.a.nrows(), hierarchy.order(), network.c_L.nrows());
    let locals = observer.distinct_locals();
    let blocks: Vec<(&DMatrix<f64>, DMatrix<f64>)> =
        locals.iter().map(|(local, users)| (&local.h, rotated(&hierarchy.Gamma_N, users))).collect();
    let count: usize = blocks.iter().map(|(_, R)| R.nrows()).sum();
    let (order, outputs) = (own + n * count, global.H.ncols());
    if order > LARGEST {
        return Err(ErrorSystemError::TooLarge { found: order, most: LARGEST });
    }
    let mut a = DMatrix::zeros(order, order);
    let mut b_w = DMatrix::zeros(order, outputs + p * count);
    let closed = hierarchy.alpha_z() - &global.H * hierarchy.gamma_z();
    a.view_mut((0, 0), (own, own)).copy_from(&closed);
    b_w.view_mut((0, 0), (own, outputs)).copy_from(&global.H);
    let mut k = 0;
    for (h, R) in &blocks {
        for row in R.row_iter() {
            let at = own + n * k;
            a.view_mut((at, 0), (n, own)).copy_from(&row.kronecker(&hierarchy.bc_z));
            a.view_mut((at, at), (n, n)).copy_from(&(&network.a - *h * &network.c_L));
            b_w.view_mut((at, outputs + p * k), (n, p)).copy_from(*h);
            k += 1;
        }
    }
    let mut of_locals = DMatrix::zeros(n * count, order);
    of_locals.columns_mut(own, n * count).fill_with_identity();
    let of_whole = determined(network, observer, order);
    let c = stack(&[&of_locals, &of_whole]);
    let rows = c.nrows();
    let terms = Terms { b_d: DMatrix::zeros(order, 0), c: c.abs(), d_d: DMatrix::zeros(rows, 0) };
    Ok(ErrorStateSpace {
        b_d: DMatrix::zeros(order, 0),
        d_d: DMatrix::zeros(rows, 0),
        d_w: DMatrix::zeros(rows, b_w.ncols()),
        states: (0..rows).collect(),
        region: StabilityRegion::LeftHalfPlane,
        with_plant: false,
        a,
        b_w,
        c,
        terms,
    })
}

/// `R` of the rows of some subsystems; a row of zeros where nothing is coupled.
fn rotated(Gamma_N: &DMatrix<f64>, users: &[usize]) -> DMatrix<f64> {
    let R = Gamma_N.select_rows(users).qr().r();
    let rows = R.nrows().max(1);
    R.resize_vertically(rows, 0.0)
}

/// The rows of `N kron M` that belong to estimated states without a local observer.
fn determined(network: &Network, observer: &HierarchicalObserver, order: usize) -> DMatrix<f64> {
    let (n, hierarchy) = (network.a.nrows(), &observer.hierarchy);
    let states: Vec<usize> =
        observer.estimated_states().into_iter().filter(|k| observer.local(k / n).is_none()).collect();
    let mut rows = DMatrix::zeros(states.len(), order);
    for (mut row, k) in rows.row_iter_mut().zip(states) {
        let of_z = hierarchy.N.row(k / n).kronecker(&hierarchy.M.row(k % n));
        row.columns_mut(0, of_z.ncols()).copy_from(&of_z);
    }
    rows
}
