//! Designs that were made before: what did not change is not designed again.

use std::sync::Arc;

use super::comparison::{ComparedDesign, judged};
use crate::numerics::{NumericsError, Tolerance, Watch};
use crate::observer::{
    Assessment, Condition, DesignChoice, DesignError, ErrorStateSpace, assess_knowing, conditions,
};
use crate::system::Model;
use crate::system::properties::PropertyError;

/// Designs that are remembered: those of two full tables.
const MOST: usize = 20;

/// What was designed for one plant under one tolerance. It changes no result, only how long it takes.
///
/// The key of a design is everything that it depends on: plant, tolerance and choice. Anything else of a document, its
/// scenario, titles or names, may change. What was cancelled or given up is not remembered.
#[derive(Debug, Default)]
pub struct Memo {
    of: Option<(Model, Tolerance)>,
    entries: Vec<Entry>,
}

#[derive(Debug)]
struct Entry {
    assessment: Arc<Assessment>,
    /// The row of a comparison, once one asked for it.
    judged: Option<(ComparedDesign, Option<ErrorStateSpace>)>,
}

impl Memo {
    /// Nothing is known yet.
    pub const fn new() -> Self {
        Self { of: None, entries: Vec::new() }
    }

    /// Conditions and design of a choice, as [`assess`](crate::observer::assess).
    ///
    /// # Errors
    /// Those of `assess`.
    pub fn assess(
        &mut self,
        model: &Model,
        choice: &DesignChoice,
        tolerance: &Tolerance,
        watch: &Watch,
    ) -> Result<Arc<Assessment>, PropertyError> {
        if !self.of.as_ref().is_some_and(|(of, under)| of == model && under == tolerance) {
            self.entries.clear();
            self.of = Some((model.clone(), *tolerance));
        }
        if let Some(place) = self.entries.iter().position(|entry| entry.assessment.choice == *choice) {
            // what was asked for last is forgotten last
            let entry = self.entries.remove(place);
            let found = Arc::clone(&entry.assessment);
            self.entries.push(entry);
            return Ok(found);
        }
        let conditions = match self.asked(choice) {
            Some(conditions) => conditions,
            None => conditions(model, choice, tolerance)?,
        };
        let found = Arc::new(assess_knowing(model, choice, conditions, tolerance, watch));
        if !matches!(found.outcome, Err(DesignError::Cancelled | DesignError::GaveUp(_))) {
            if self.entries.len() >= MOST {
                self.entries.remove(0);
            }
            self.entries.push(Entry { assessment: Arc::clone(&found), judged: None });
        }
        Ok(found)
    }

    /// The conditions of another choice that are those of this one, too: where poles are placed, method and order decide.
    fn asked(&self, choice: &DesignChoice) -> Option<Vec<Condition>> {
        let same = |entry: &&Entry| {
            let other = &entry.assessment.choice;
            !choice.method.uses_lmi() && other.method == choice.method && other.order == choice.order
        };
        self.entries.iter().find(same).map(|entry| entry.assessment.conditions.clone())
    }

    /// The row of a design that [`Self::assess`] returned, with its error system where it has one; `None` when there is no
    /// design.
    ///
    /// # Errors
    /// When a decomposition fails its check.
    pub(super) fn judged(
        &mut self,
        model: &Model,
        assessment: &Arc<Assessment>,
        tolerance: &Tolerance,
    ) -> Result<Option<(ComparedDesign, Option<ErrorStateSpace>)>, NumericsError> {
        let Ok(design) = &assessment.outcome else { return Ok(None) };
        let entry = self.entries.iter_mut().find(|entry| Arc::ptr_eq(&entry.assessment, assessment));
        if let Some(known) = entry.as_ref().and_then(|entry| entry.judged.as_ref()) {
            return Ok(Some(known.clone()));
        }
        let found = judged(&model.system, design, tolerance)?;
        if let Some(entry) = entry {
            entry.judged = Some(found.clone());
        }
        Ok(Some(found))
    }
}
