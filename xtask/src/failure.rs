//! What went wrong, and what a person can do about it.

use std::fmt;

/// The result of every step.
pub(crate) type Outcome<T = ()> = Result<T, Failure>;

/// A message for a person: what was found, and (where there is something to do) what to do.
#[derive(Debug)]
pub(crate) struct Failure {
    what: String,
    advice: Option<String>,
}

impl Failure {
    /// States what went wrong.
    pub(crate) fn new(what: impl Into<String>) -> Self {
        Self { what: what.into(), advice: None }
    }

    /// States what went wrong with `subject`, with the reason that the system or a library gave.
    pub(crate) fn because(subject: impl fmt::Display, reason: impl fmt::Display) -> Self {
        Self::new(format!("{subject}: {reason}"))
    }

    /// Adds what to do.
    pub(crate) fn advice(mut self, advice: impl Into<String>) -> Self {
        self.advice = Some(advice.into());
        self
    }
}

impl fmt::Display for Failure {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "error: {}", self.what)?;
        match &self.advice {
            Some(advice) => write!(formatter, "\n{advice}"),
            None => Ok(()),
        }
    }
}
