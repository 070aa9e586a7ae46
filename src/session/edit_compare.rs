//! Keeping designs beside the chosen one, and exchanging them.

use super::history::History;
use super::poles;
use super::state::{Draft, Field};
use super::update::Edited;
use crate::document::limits::{MAX_KEPT, MAX_NAME};
use crate::document::{CHOSEN, Document, KeptDesign};
use crate::observer::{DesignChoice, Method};

/// A change of the designs that are kept to be compared.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum CompareEdit {
    /// Keeps the chosen design under a name that says what it is.
    Keep,
    /// Another name for a kept design, as typed.
    Rename {
        /// Which, from zero.
        kept: usize,
        /// What was typed.
        name: String,
    },
    /// Forgets a kept design.
    Discard(usize),
    /// Makes a kept design the chosen one and keeps the chosen one in its place, unless it has a place of its own.
    Choose(usize),
}

/// Changes the kept designs of a document; a design that was kept before gets its name back.
pub(super) fn change(document: &mut Document, edit: CompareEdit, history: &History) -> Edited {
    match edit {
        CompareEdit::Keep => return keep(document, history),
        CompareEdit::Rename { kept, name } => return rename(document, kept, &name),
        CompareEdit::Discard(kept) => {
            if kept < document.kept.len() {
                document.kept.remove(kept);
            }
        }
        CompareEdit::Choose(kept) => choose(document, kept, history),
    }
    Edited::Done
}

/// Whether designs or their places change, so that what was typed into them means something else.
pub(super) fn exchanges(edit: &CompareEdit) -> bool {
    matches!(edit, CompareEdit::Choose(_) | CompareEdit::Discard(_))
}

/// Whether a field belongs to a design and not to the plant or the scenario.
pub(super) fn belongs_to_a_design(field: &Field) -> bool {
    matches!(field, Field::Poles | Field::Rows(..) | Field::Given(_) | Field::KeptName(_))
}

/// Why the chosen design cannot be kept beside the others, as a sentence without its full stop.
pub fn why_not_kept(document: &Document) -> Option<String> {
    if let Some(same) = document.kept.iter().find(|kept| kept.design == document.design) {
        return Some(format!("the chosen design is kept already, as \"{}\": change it first", same.name));
    }
    (document.kept.len() >= MAX_KEPT)
        .then(|| format!("{MAX_KEPT} designs are kept, and no more can be: discard one of them first"))
}

fn keep(document: &mut Document, history: &History) -> Edited {
    if let Some(why) = why_not_kept(document) {
        return Edited::Refused(why);
    }
    let name = unique(document, &name_of(document, history), None);
    document.kept.push(KeptDesign { name, design: document.design.clone() });
    Edited::Done
}

/// Exchanges the chosen design with a kept one; of two equal designs one is enough.
fn choose(document: &mut Document, kept: usize, history: &History) {
    let Some(wanted) = document.kept.get(kept) else { return };
    if wanted.design == document.design {
        return;
    }
    if document.kept.iter().any(|other| other.design == document.design) {
        document.design = document.kept.remove(kept).design;
    } else {
        let name = unique(document, &name_of(document, history), Some(kept));
        let place = &mut document.kept[kept];
        std::mem::swap(&mut place.design, &mut document.design);
        place.name = name;
    }
    poles::provide(document);
}

fn rename(document: &mut Document, index: usize, text: &str) -> Edited {
    let name = clipped(text, 0);
    let draft = |error: &str| {
        Edited::Draft(Field::KeptName(index), Draft { text: text.to_owned(), error: error.to_owned() })
    };
    if index >= document.kept.len() {
        return Edited::Done;
    }
    if let Some(why) = KeptDesign::refused_name(&name) {
        return draft(&why);
    }
    if document.kept.iter().enumerate().any(|(k, kept)| k != index && kept.name == name) {
        return draft("another kept design has this name: take another");
    }
    document.kept[index].name = name;
    Edited::Done
}

/// A name of the chosen design: the one that it was kept under before, or method, order, and how many poles it takes or
/// what is demanded.
fn name_of(document: &Document, history: &History) -> String {
    let design = &document.design;
    if let Some(before) = history.kept_name(&document.plant, design) {
        return before.to_owned();
    }
    let mut parts = vec![method_name(design.method).to_owned()];
    if design.method.orders().len() > 1 {
        parts.push(design.order.key().to_owned());
    }
    parts.extend(particulars(document, design));
    parts.join(", ")
}

fn method_name(method: Method) -> &'static str {
    match method {
        Method::ProportionalIntegral => "PI",
        other => other.title(),
    }
}

/// What tells a design from another one of the same method and order.
fn particulars(document: &Document, design: &DesignChoice) -> Vec<String> {
    let mut parts = Vec::new();
    if design.method.uses_lmi() {
        parts.extend(design.lmi.decay.map(|decay| format!("decay {decay}")));
        parts.extend(design.lmi.gamma.map(|gamma| format!("gamma {gamma}")));
        return parts;
    }
    if let Some(needed) = poles::used(document) {
        parts.push(format!("{needed} {}", if needed == 1 { "pole" } else { "poles" }));
    }
    if design.scale != 1.0 {
        parts.push(format!("times {}", design.scale));
    }
    parts
}

/// The name itself, or with a number behind it when another design has it.
fn unique(document: &Document, name: &str, except: Option<usize>) -> String {
    let others = document.kept.iter().enumerate().filter(|(k, _)| Some(*k) != except);
    let taken: Vec<&str> = others.map(|(_, kept)| kept.name.as_str()).chain([CHOSEN]).collect();
    // a number finds room at the end
    let numbered = (2..).map(|k| format!("{} ({k})", clipped(name, 5)));
    std::iter::once(clipped(name, 0))
        .chain(numbered)
        .find(|candidate| !taken.contains(&candidate.as_str()))
        .unwrap_or_else(|| clipped(name, 0))
}

/// A name without spaces around it that leaves room for some characters more.
fn clipped(name: &str, room: usize) -> String {
    let short: String = name.trim().chars().take(MAX_NAME - room).collect();
    short.trim_end().to_owned()
}
