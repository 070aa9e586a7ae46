//! Bounds on what a document may hold; everything from outside is checked against them.

/// Bytes of a document's text, after unpacking.
pub const MAX_BYTES: usize = 2 << 20;
/// Bytes of one text in a document.
pub const MAX_TEXT: usize = 20_000;
/// Rows and columns of a dense matrix.
pub const MAX_SIDE: usize = 100;
/// Subsystems of a network or partition.
pub const MAX_SUBSYSTEMS: usize = 2_000;
/// States of a network that is expanded to one descriptor system.
pub const MAX_EXPANDED: usize = crate::observer::hierarchical::LARGEST_COMPOSITE;
/// Entries of a sparse matrix.
pub const MAX_SPARSE_ENTRIES: usize = 100_000;
/// Poles in a list.
pub const MAX_POLES: usize = 300;
/// Designs that are kept beside the chosen one.
pub const MAX_KEPT: usize = 8;
/// Characters of a kept design's name; more would not fit above a column.
pub const MAX_NAME: usize = 48;
/// Figures of a document, panels of a figure, series of a panel, runs of a figure.
pub const MAX_FIGURES: usize = 60;
/// Output samples of a simulation.
pub const MAX_SAMPLES: u64 = 20_000;
/// Longest horizon, in seconds or steps.
pub const MAX_HORIZON: f64 = 1e6;
