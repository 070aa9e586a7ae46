//! What is wrong with a document, and where.

use serde::{Deserialize, Serialize};

/// A document that cannot be read, in words for the person who wrote it.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error, Serialize, Deserialize)]
pub enum DocumentError {
    /// The text is not JSON.
    #[error("the text is not JSON: {message} (line {line}, column {column})")]
    NotJson {
        /// What the JSON reader says.
        message: String,
        /// Line, from one.
        line: usize,
        /// Column, from one.
        column: usize,
    },
    /// The text is larger than the limit.
    #[error("the document has {found} bytes; at most {limit} are read")]
    TooLarge {
        /// Its size.
        found: usize,
        /// The limit.
        limit: usize,
    },
    /// A place in the document is not what is needed there.
    #[error("{place}: found {found}, but {needed}")]
    Place {
        /// Path such as `system.A[2, 3]`, rows and columns from one.
        place: String,
        /// What stands there.
        found: String,
        /// What is needed, as a sentence.
        needed: String,
    },
}

impl DocumentError {
    /// An error at a place.
    pub fn at(place: &str, found: impl Into<String>, needed: impl Into<String>) -> Self {
        Self::Place { place: place.to_owned(), found: found.into(), needed: needed.into() }
    }
}
