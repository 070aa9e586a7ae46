//! Initial states: one entry for each state, or one expression for all.

use super::cursor::Cursor;
use super::entry::Entry;
use super::limits::MAX_SIDE;
use super::read::Sizes;
use super::{Document, DocumentError, ScenarioData};
use crate::expression::{Expression, ExpressionError};

/// The initial values of all states at once: an expression in `i`, the number of the state from one.
///
/// # Examples
/// ```
/// use descry::document::InitialFormula;
/// let formula = InitialFormula::parse("if(i <= 2, 10*i, 0)")?;
/// assert_eq!(formula.values(3), [10.0, 20.0, 0.0]);
/// # Ok::<(), descry::expression::ExpressionError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct InitialFormula(Expression);

impl InitialFormula {
    /// Reads an expression in `i`.
    ///
    /// # Errors
    /// What is not understood, with its position.
    pub fn parse(text: &str) -> Result<Self, ExpressionError> {
        Ok(Self(Expression::parse(text.trim(), &["i"])?))
    }

    /// Reads an expression whose values are finite for `n` states.
    ///
    /// # Errors
    /// The sentence of the expression reader, or which state has no finite value.
    pub fn checked(text: &str, n: usize) -> Result<Self, String> {
        let found = Self::parse(text).map_err(|error| error.to_string())?;
        match found.values(n).iter().position(|value| !value.is_finite()) {
            Some(k) => Err(format!("the value for i = {} is not finite", k + 1)),
            None => Ok(found),
        }
    }

    /// The expression as typed.
    pub fn text(&self) -> &str {
        self.0.text()
    }

    /// The value of one state, from zero.
    pub fn value(&self, state: usize) -> f64 {
        self.0.value(&[(state + 1) as f64])
    }

    /// The values of `n` states.
    pub fn values(&self, n: usize) -> Vec<f64> {
        (0..n).map(|state| self.value(state)).collect()
    }
}

impl ScenarioData {
    /// Initial values of `n` states: the entries, where there are any, else those of the expression, else zeros.
    pub fn initial_values(&self, n: usize) -> Vec<f64> {
        match &self.x0_formula {
            Some(formula) if self.x0.is_empty() => formula.values(n),
            _ => {
                let mut values: Vec<f64> = self.x0.iter().map(|entry| entry.value).collect();
                values.resize(n, 0.0);
                values
            }
        }
    }
}

impl Document {
    /// The initial state, a value for each state; of a network those of the subsystems below each other.
    pub fn initial_state(&self) -> Vec<f64> {
        self.scenario.initial_values(Sizes::of(&self.plant).states)
    }
}

/// Reads a list of entries, or a text that holds an expression in `i`.
pub(super) fn read_initial(
    cursor: &Cursor<'_>,
    n: usize,
) -> Result<(Vec<Entry>, Option<InitialFormula>), DocumentError> {
    if cursor.is_text() {
        let found = InitialFormula::checked(cursor.text()?, n);
        let needed = |error| {
            cursor.error(format!("an expression in i, the number of the state from 1 to {n}: {error}"))
        };
        return Ok((Vec::new(), Some(found.map_err(needed)?)));
    }
    if !cursor.is_list() {
        return Err(
            cursor.error("a list of numbers, or an expression in i such as \"sin(i)\", is needed here")
        );
    }
    let items = cursor.list(MAX_SIDE.max(n), "numbers")?;
    if items.len() != n {
        return Err(cursor.error(format!(
            "one number for each of the {n} states is needed, or an expression in i for all of them"
        )));
    }
    Ok((items.iter().map(Entry::read).collect::<Result<_, _>>()?, None))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn entries_stand_before_the_expression() {
        let formula = InitialFormula::parse("i^2").ok();
        let scenario = ScenarioData { x0_formula: formula, ..ScenarioData::empty() };
        assert_eq!(scenario.initial_values(3), [1.0, 4.0, 9.0], "the expression alone");
        let scenario = ScenarioData { x0: vec![Entry::number(7.0)], ..scenario };
        assert_eq!(scenario.initial_values(3), [7.0, 0.0, 0.0], "an entry was typed");
        assert_eq!(ScenarioData::empty().initial_values(2), [0.0, 0.0], "nothing was given");
    }

    #[test]
    fn values_that_are_not_finite_are_named() {
        assert_eq!(
            InitialFormula::checked("1/(i - 3)", 5),
            Err("the value for i = 3 is not finite".to_owned())
        );
        assert!(InitialFormula::checked("1/(i - 3)", 2).is_ok(), "the third state does not exist");
        assert!(InitialFormula::checked("sin(t)", 2).unwrap_err().contains('t'), "another variable");
    }
}
