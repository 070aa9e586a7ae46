//! A small hierarchical observer as one linear observer of the expanded network.
#![expect(non_snake_case, reason = "matrix letters of the common observer form")]

use nalgebra::DMatrix;

use super::HierarchicalObserver;
use crate::observer::{DesignError, LinearObserver};
use crate::system::Network;

/// Most states of a network that is written as one system, and whose observer is written as one.
///
/// Every edit asks all methods for their conditions, which take pencils and PBH tests of the whole: on networks of five
/// states each and in a build that is hardly optimised half a second with 20 states, 3 with 30, 7 with 40, and 24 with
/// 60; the hierarchical observer itself needs 0.05 in any case.
pub const LARGEST_COMPOSITE: usize = 30;

/// The global observer and all local observers that are plugged in, stacked, beside [`Network::expanded`].
///
/// ```text
/// N = [alpha_z - H gamma_z, 0; beta_i, a - h_i c_L],   L = [H, 0; 0, h_i],   y = [y_G; y_i for i in local]
/// ```
///
/// A subsystem with a local observer is estimated by it. Of any other subsystem only its part in the whole is known:
/// its rows of `x_hat` are those of `sigma_z^+ z_hat = (N kron M) z_hat`, the smallest state that shows `z_hat`, which
/// does not tend to `x_i`.
///
/// # Errors
/// [`DesignError::Unsuitable`] for more than [`LARGEST_COMPOSITE`] states, and for an observer of another network.
///
/// # Source
/// Paper 003, (8).
pub fn composite(network: &Network, observer: &HierarchicalObserver) -> Result<LinearObserver, DesignError> {
    let (n, size) = (network.a.nrows(), network.n_subsystems());
    if n * size > LARGEST_COMPOSITE {
        return Err(DesignError::Unsuitable(format!(
            "the network has {} states together; as one observer at most {LARGEST_COMPOSITE} are written out",
            n * size
        )));
    }
    let hierarchy = &observer.hierarchy;
    let (own, global_outputs) = (hierarchy.order(), network.Psi.nrows() * network.c_G.nrows());
    let p = network.c_L.nrows();
    if (hierarchy.N.nrows(), hierarchy.M.nrows()) != (size, n)
        || observer.global.H.shape() != (own, global_outputs)
    {
        return Err(DesignError::Unsuitable("this observer belongs to another network".to_owned()));
    }
    let order = own + n * observer.locals().count();
    let outputs = global_outputs + p * network.local.len();
    let mut N = DMatrix::zeros(order, order);
    let mut L = DMatrix::zeros(order, outputs);
    let mut P = DMatrix::zeros(n * size, order);
    let H = &observer.global.H;
    N.view_mut((0, 0), (own, own)).copy_from(&(hierarchy.alpha_z() - H * hierarchy.gamma_z()));
    L.view_mut((0, 0), (own, global_outputs)).copy_from(H);
    P.columns_mut(0, own).copy_from(&hierarchy.sigma_z().transpose());
    for (k, (i, local)) in observer.locals().enumerate() {
        let Some(place) = network.local.iter().position(|other| *other == i) else { continue };
        let at = own + n * k;
        N.view_mut((at, 0), (n, own)).copy_from(&hierarchy.beta(i));
        N.view_mut((at, at), (n, n)).copy_from(&(&network.a - &local.h * &network.c_L));
        L.view_mut((at, global_outputs + p * place), (n, p)).copy_from(&local.h);
        P.view_mut((n * i, 0), (n, own)).fill(0.0);
        P.view_mut((n * i, at), (n, n)).fill_with_identity();
    }
    let none = |rows, columns| DMatrix::zeros(rows, columns);
    Ok(LinearObserver {
        H: none(order, 0),
        V: none(n * size, outputs),
        W: none(n * size, 0),
        Q: none(0, order),
        R: none(0, outputs),
        S: none(0, 0),
        N,
        L,
        P,
    })
}

/// The global observer alone, of a network too large to be written as one; its estimate is `z`.
///
/// ```text
/// z_hat' = (alpha_z - H gamma_z) z_hat + H y_G
/// ```
pub(super) fn global_alone(observer: &HierarchicalObserver) -> LinearObserver {
    let HierarchicalObserver { hierarchy, global, .. } = observer;
    let (order, outputs) = global.H.shape();
    let none = |rows, columns| DMatrix::zeros(rows, columns);
    LinearObserver {
        N: hierarchy.alpha_z() - &global.H * hierarchy.gamma_z(),
        L: global.H.clone(),
        H: none(order, 0),
        P: DMatrix::identity(order, order),
        V: none(order, outputs),
        W: none(order, 0),
        Q: none(0, order),
        R: none(0, outputs),
        S: none(0, 0),
    }
}
