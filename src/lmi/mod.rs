//! L0: linear matrix inequalities as data, their solution and their proof.

pub mod certificate;
mod outcome;

pub use outcome::{Infeasible, Nearest, Outcome};
