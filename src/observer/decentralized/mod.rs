//! Decentralized observers of interconnected descriptor systems (paper 000).
//!
//! Each subsystem gets its own observer, which knows the subsystem's matrices, its outputs and the known inputs, but not
//! the states of the other subsystems. What these do is decoupled exactly (`D_i1`) or attenuated (`D_i2`) by the least
//! gamma that a linear matrix inequality finds.
//!
//! | paper | program | shape | meaning |
//! |---|---|---|---|
//! | E, A, B | `E`, `A`, `B` of [`crate::system::DescriptorSystem`] | | the composite plant |
//! | H | `C` | m x n | its outputs |
//! | partition into N subsystems | [`crate::system::Model::partition`] | | sizes of the subsystems |
//! | E_i, A_ii, B_i, H_i | `E`, `A`, `B`, `H` of [`LocalProblem`] | e x n, e x n, e x k, m x n | one subsystem |
//! | D_i = [A_ij], v_i | `D`, `sources` of [`LocalProblem`] | e x (nonzero columns) | the other subsystems' states |
//! | D_i1, D_i2 | `D1`, `D2` of [`Decoupled`] | e x q1, e x q2 | decoupled exactly, attenuated |
//! | Phi_i, E_bar, A_bar, Theta_i | [`Decoupled`] | r x e, ... | what is left after the exact decoupling |
//! | R_i, Omega_i, Lambda, Delta | [`Parameterisation`] | beta x n, ... | all observers of one order |
//! | Y_i, Z_i | variables `W = X Y`, `Z` | beta x l, n x k | free gains, on an orthonormal basis |
//! | X_i, gamma | variables `X`, `gamma` | beta x beta | Lyapunov matrix, attenuation (linear, not squared) |
//! | N_i, M_i, J_i, P_i, Q_i, F_i | [`LocalMatrices`]; `N`, `H`, `L`, `P`, `-W`, `V` of [`super::LinearObserver`] | | the observer |
//! | e_i = x_hat_i - x_i | `-e` | | the error; the program's is `x - x_hat` |

mod certificate;
mod columns;
mod composite;
mod conditions;
mod conditions_modes;
mod decoupled;
mod design;
mod extended;
mod inequality;
mod local;
mod nearest;
mod order;
mod parameterisation;
mod setup;
mod subsystem;

pub use certificate::certify;
pub use columns::{Assumption1, ColumnError, assumption_1, by_hand, greedy, strong_detectability};
pub use composite::composite;
pub use conditions::{conditions, local_conditions};
pub use decoupled::Decoupled;
pub use design::{LocalOutcomes, design, design_subsystems};
pub use extended::extended;
pub use local::{Local, design_local};
pub use order::{OrderError, check, chosen};
pub use parameterisation::{LocalMatrices, Parameterisation};
pub use setup::{Setup, SetupError, exact_columns};
pub use subsystem::{CutError, LocalProblem, local_problems};
