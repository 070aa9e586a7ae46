//! What keeps a text from being an expression, said to the person who typed it.

use super::{MAX_CHARACTERS, MAX_DEPTH, MAX_OPERATIONS};

/// A text that is not an expression: where, and why.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{}{problem}", place(*position, problem))]
pub struct ExpressionError {
    /// Characters (not bytes) before the offending one.
    pub position: usize,
    /// What was found there and what is needed.
    pub problem: ExpressionProblem,
}

/// The reason of an [`ExpressionError`].
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum ExpressionProblem {
    /// Nothing but spaces.
    #[error("there is nothing here; write a number or an expression, such as 0 or 2*sin(t)")]
    Empty,
    /// More characters than are read.
    #[error("the text has {characters} characters; at most {MAX_CHARACTERS} are read")]
    TooLong {
        /// How many there are.
        characters: usize,
    },
    /// Too many parentheses or signs inside each other.
    #[error(
        "more than {MAX_DEPTH} parentheses, signs or operators inside each other; simplify the expression"
    )]
    TooDeep,
    /// Too many operators and calls.
    #[error("more than {MAX_OPERATIONS} operations; simplify the expression")]
    TooManyOperations,
    /// A character that begins nothing.
    #[error("unexpected `{found}`{hint}")]
    Character {
        /// The character, or the characters that belong together.
        found: String,
        /// What to write instead, with its own punctuation; may be empty.
        hint: &'static str,
    },
    /// Digits that are no number.
    #[error("`{text}` is {reason}")]
    Number {
        /// The digits.
        text: String,
        /// What is wrong with them.
        reason: &'static str,
    },
    /// Something in the wrong place.
    #[error("found {found}, but {needed} is needed")]
    Unexpected {
        /// What was found.
        found: String,
        /// What is needed.
        needed: &'static str,
    },
    /// Two operands beside each other.
    #[error("there is no operator between `{left}` and `{right}`; for the product write {left}*{right}")]
    ImplicitProduct {
        /// The end of the left operand.
        left: String,
        /// The beginning of the right operand.
        right: String,
    },
    /// A comma outside the arguments of a function.
    #[error("unexpected comma{hint}")]
    Comma {
        /// What to write instead; may be empty.
        hint: String,
    },
    /// A name that is neither a variable nor a function.
    #[error("unknown name `{name}`; {hint}")]
    UnknownName {
        /// The name.
        name: String,
        /// A name like it, or those that are known.
        hint: String,
    },
    /// A function without its parentheses.
    #[error("`{name}` is a function and needs parentheses: {usage}")]
    NoArguments {
        /// The function.
        name: &'static str,
        /// How it is called.
        usage: &'static str,
    },
    /// The wrong number of arguments.
    #[error("`{name}` takes {needed} argument{}, {found} found: {usage}", if *needed == 1 { "" } else { "s" })]
    ArgumentCount {
        /// The function.
        name: &'static str,
        /// How many it takes.
        needed: usize,
        /// How many were given.
        found: usize,
        /// How it is called.
        usage: &'static str,
    },
    /// A constant without a finite value.
    #[error("{text} is {what}; a finite number is needed")]
    NotFinite {
        /// The expression.
        text: String,
        /// `infinite` or `not a number`.
        what: &'static str,
    },
}

/// "At character 3: ", for problems that have a place.
fn place(position: usize, problem: &ExpressionProblem) -> String {
    use ExpressionProblem::{Empty, NotFinite, TooLong};
    match problem {
        Empty | TooLong { .. } | NotFinite { .. } => String::new(),
        _ => format!("at character {}: ", position + 1),
    }
}
