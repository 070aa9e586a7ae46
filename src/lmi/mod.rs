//! L0: linear matrix inequalities as data, their solution and their proof.

mod outcome;

pub use outcome::{Infeasible, Nearest, Outcome};
