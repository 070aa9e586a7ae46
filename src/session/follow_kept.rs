//! Kept designs keep fitting the system that is edited beside them.

use super::follow::fit_design;
use super::poles;
use crate::document::Document;

/// Adapts every kept design to an edited plant or tolerance as the chosen one is adapted, and says in sentences what had
/// to go.
pub(super) fn follow_kept(document: &mut Document, before: &Document) -> Vec<String> {
    if document.kept.is_empty() || (document.plant == before.plant && document.tolerance == before.tolerance)
    {
        return Vec::new();
    }
    let mut gone = Vec::new();
    for k in 0..document.kept.len() {
        std::mem::swap(&mut document.design, &mut document.kept[k].design);
        let then = Document { design: document.design.clone(), kept: Vec::new(), ..before.clone() };
        let told = fit_design(document, &then);
        poles::provide(document);
        std::mem::swap(&mut document.design, &mut document.kept[k].design);
        gone.extend(told.into_iter().map(|told| format!("{}: {told}", document.kept[k].name)));
    }
    gone
}
