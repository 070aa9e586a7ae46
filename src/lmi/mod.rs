//! L0: linear matrix inequalities.

pub mod certificate;
