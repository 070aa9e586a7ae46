//! L3: the papers as data.
