//! L0: matrices in, matrices and evidence out; knows no control theory.

mod block;
mod eigen;
mod error;
pub mod integrate;
mod rank;
mod spectrum;
mod subspace;
mod svd;
mod tolerance;

pub use block::{Block, block_matrix, side_by_side, stack};
pub use eigen::eigenvalues;
pub use error::NumericsError;
pub use num_complex::Complex64;
pub use rank::{RankDecision, complex_rank, rank};
pub use spectrum::{PoleOrPair, conjugate_pairs, matching, sort_spectrum, spectral_distance};
pub use subspace::{Subspaces, null_space, pseudo_inverse, subspaces};
pub use svd::{Svd, complex_svd, svd};
pub use tolerance::Tolerance;
