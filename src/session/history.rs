//! Undo and redo of whole documents; a drag is one step.

use std::sync::Arc;

use crate::document::{Document, PlantData};
use crate::observer::DesignChoice;

/// Past and future documents.
#[derive(Clone, Debug, Default)]
pub struct History {
    past: Vec<Arc<Document>>,
    future: Vec<Arc<Document>>,
    /// Key of the drag that the newest step of the past belongs to.
    dragging: Option<String>,
}

/// Steps that are remembered.
const DEPTH: usize = 500;

impl History {
    /// Remembers a document that is about to change.
    ///
    /// Steps with the same `drag` key follow each other as one step until [`Self::drag_ended`].
    pub fn remember(&mut self, before: Arc<Document>, drag: Option<String>) {
        self.future.clear();
        if drag.is_some() && drag == self.dragging {
            return;
        }
        self.dragging = drag;
        self.past.push(before);
        if self.past.len() > DEPTH {
            self.past.remove(0);
        }
    }

    /// The next change is a step of its own.
    pub fn drag_ended(&mut self) {
        self.dragging = None;
    }

    /// The document before the last step.
    pub fn undo(&mut self, now: Arc<Document>) -> Option<Arc<Document>> {
        let before = self.past.pop()?;
        self.future.push(now);
        self.dragging = None;
        Some(before)
    }

    /// The document after the last step that was undone.
    pub fn redo(&mut self, now: Arc<Document>) -> Option<Arc<Document>> {
        let after = self.future.pop()?;
        self.past.push(now);
        self.dragging = None;
        Some(after)
    }

    /// The name that a design of this plant was kept under before, the newest one.
    pub fn kept_name(&self, plant: &PlantData, design: &DesignChoice) -> Option<&str> {
        let documents = self.past.iter().rev().filter(|document| document.plant == *plant);
        let mut kept = documents.flat_map(|document| &document.kept);
        kept.find(|kept| kept.design == *design).map(|kept| kept.name.as_str())
    }

    /// Whether there is something to undo.
    pub fn can_undo(&self) -> bool {
        !self.past.is_empty()
    }

    /// Whether there is something to redo.
    pub fn can_redo(&self) -> bool {
        !self.future.is_empty()
    }
}
