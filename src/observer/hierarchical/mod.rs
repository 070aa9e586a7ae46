//! Hierarchical decentralized observer of a network of identical subsystems (paper 003).
//!
//! A global observer estimates what the network shows as a whole; local observers, plugged in where a subsystem has
//! measurements of its own, take the global estimate as their input and never act back.
//!
//! | paper | program | shape | meaning |
//! |---|---|---|---|
//! | `a_I`, `b_I`, `c_I` | `a`, `b`, `c` of [`Network`](crate::system::Network) | n x n, n x m, m x n | one subsystem |
//! | `Gamma` | `Gamma` | N x N | coupling, `u = (Gamma kron I) w` |
//! | `Psi`, `c_G` | `Psi`, `c_G` | P x N, p x n | global output `y_G = (Psi kron c_G) x` |
//! | `c_L`, `I` | `c_L`, `local` | q x n | local outputs of the subsystems in the set `I` (from one in the paper) |
//! | `nu`, `mu` | `nu`, `mu` of [`Hierarchy`] | | `rank Gamma`, `rank O_n(a_I, b_I c_I)` |
//! | `N`, `M` | `N`, `M` | N x nu, n x mu | orthonormal bases of the row spaces of `Gamma` and `O_n(a_I, b_I c_I)` |
//! | `Gamma_nu`, `a_z`, `b_z`, `c_z` | of the same name | | `N' Gamma N`, `M' a M`, `M' b`, `c M` |
//! | `alpha_z`, `beta_z`, `gamma_z`, `sigma_z` | functions of [`Hierarchy`] | | state space of `z = sigma_z x` |
//! | `H`, `h_i` | gains of [`GlobalObserver`] and [`LocalObserver`] | nu mu x P p, n x q | observer (8) |
//!
//! What is never formed: `A` and `C` of the whole network, and `sigma_z`. What costs: `Gamma` is multiplied by thin
//! matrices and gone through strip by strip, some N^2 nu operations; the design itself does not depend on N.
//!
//! Source: T. Ishizaki, Y. Sakai, K. Kashima and J. Imura, "Hierarchical decentralized observer design for linearly
//! coupled network systems" (paper 003). N and M are unique up to orthogonal factors from the right.

mod bases;
mod blocks;
mod composite;
mod conditions;
mod design;
mod estimated;
mod pairs;
mod representation;
mod theorem;
mod verify;

pub use bases::proposed_order;
pub use composite::{LARGEST_COMPOSITE, composite};
pub(super) use conditions::conditions_of;
pub use conditions::{conditions, conditions_for};
pub(super) use design::design_of;
pub use design::{
    GlobalObserver, HierarchicalDesign, HierarchicalObserver, LocalObserver, design, design_global,
    design_local,
};
pub use representation::{Hierarchy, HierarchyError, MOST_GLOBAL_STATES};
pub use verify::verify_network;
