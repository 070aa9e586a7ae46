//! Dense products and factorisations over faer, for `f32` and `f64`.
//!
//! clarabel's semidefinite cones call the crates `blas` and `lapack`, which bind to system libraries that WebAssembly
//! does not have. The stand-ins in `vendor/blas` and `vendor/lapack` keep those signatures and translate them to this
//! crate: safe Rust, the same code natively and in the browser.
//!
//! Nothing here panics on numbers: eigenvalues and singular values of a matrix that is not finite are NaN, because
//! clarabel takes an error code from them for a broken library and stops the program.

mod factorisations;
mod products;
mod view;

pub use factorisations::{cholesky, cholesky_solve, lu_solve, symmetric_eigen, thin_svd};
pub use products::{multiply, multiply_symmetric, multiply_triangle};
pub use view::{Triangle, matrix, matrix_mut, size};

/// `f32` or `f64`.
pub trait Real: faer::traits::RealField + num_traits::Float {}

impl Real for f32 {}
impl Real for f64 {}
