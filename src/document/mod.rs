//! L3: the versioned file format, links, pasted matrices, exports.

mod import;
mod import_cells;
mod import_latex;
mod matrix_text;

pub use import::{ImportError, PastedMatrix, matrix_from_text};
pub use matrix_text::{MatrixSyntax, matrix_to_text};
