//! L0: matrices in, matrices and evidence out; knows no control theory.

mod block;
mod eigen;
mod error;
mod executor;
mod fixed_modes;
mod h_infinity;
pub mod integrate;
mod pbh;
mod pencil;
mod placement;
mod random;
mod rank;
mod spectrum;
mod stability;
mod subspace;
mod svd;
mod tolerance;
mod watch;

pub use block::{Block, block_matrix, side_by_side, stack};
pub use eigen::{complex_eigenvalues, eigenvalues};
pub use error::NumericsError;
pub use executor::{Executor, Sequential};
pub use fixed_modes::{ObservableQuotient, PbhMode, observable_quotient, pbh_modes};
pub use h_infinity::{HInfinityError, HInfinityNorm, h_infinity_norm};
pub use num_complex::Complex64;
pub(crate) use pencil::normalised;
pub use pencil::{
    PencilStructure, RankDrop, RankDropAnalysis, RankDropPoint, pencil_structure, rank_drop_points,
};
pub use placement::{
    Placement, PlacementError, PlacementMethod, PlacementOptions, PlacementWarning, place_observer,
};
pub use random::Random;
pub use rank::{RankDecision, rank};
pub use spectrum::{PoleOrPair, conjugate_pairs, matching, sort_spectrum, spectral_distance};
pub use stability::{ModePosition, StabilityRegion};
pub use subspace::{Subspaces, null_space, pseudo_inverse, subspaces};
pub use svd::{Svd, complex_svd, singular_values, svd};
pub use tolerance::Tolerance;
pub use watch::Watch;
