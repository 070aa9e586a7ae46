//! H-infinity observer for Lipschitz descriptor systems (paper 002).
//!
//! | paper | program | shape | meaning |
//! |---|---|---|---|
//! | E, A, B, C | `E`, `A`, `B`, `C` of [`DescriptorSystem`](crate::system::DescriptorSystem) | e x n, e x n, e x k, p x n | the system |
//! | D, f, `F_L`, lambda | `G`, `f`, `F_L`, `constant` of [`LipschitzTerm`](crate::system::LipschitzTerm) | e x nf, nf, l x n | the nonlinearity |
//! | D1, D2, w | `D`, `F`, d | e x nd, p x nd | the disturbance |
//! | n1, r1 | e, r | | equations, algebraic ones among them |
//! | `e = x_hat - x` | `x - x_hat` | n | the error (only its size counts here) |
//! | zeta, N, J, H, P, Q, T, Psi | z, [`Matrices`] of the same names | q x q, q x p ... | observer (5) |
//! | F | [`Matrices::V`], shown as F | n x p | output to estimate |
//! | X1, `Omega_X1`, Z1 | X, W', Z | q x q, q x l | Lyapunov matrix, `W = X Z`, free gain |
//!
//! ```text
//! z'    = N z + J y + H u + T G f(x_hat)
//! x_hat = P z + F y - Q Phi B u - Q Phi G f(x_hat)
//! ```
//!
//! The paper's free matrix multiplies the projector `I - Omega Omega+`; here it multiplies an orthonormal basis of the
//! same space, which gives the same observers. `Phi` has orthonormal rows: gamma depends on its scale, since `[P Q F] =
//! Omega+` is a least squares solution.
//!
//! Source: M. Zerrougui, M. Darouach, L. Boutat-Baddas and H. Souley Ali, "H-infinity observers design for a class of continuous time nonlinear singular systems",
//! Journal of Control Science and Engineering 2011, article 967571.

mod audit;
mod basis;
mod bounds;
mod certificate;
mod conditions;
mod design;
mod finish;
mod inequality;
mod nearest;
mod output;
mod parameterisation;
mod plant;
mod rows;
mod sampling;

pub use bounds::{ErrorSystem, frozen_slopes};
pub use conditions::conditions;
pub use design::design;
pub use inequality::{Demands, Posed, pose};
pub use output::contraction;
pub use parameterisation::{Matrices, Parameterisation, default_rows};
pub use plant::Plant;
pub use sampling::{SteepestSample, sample_slope};
