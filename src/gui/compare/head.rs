//! The heads of the columns: colour, name and what can be done with a design.

use egui::{Id, Rect, RichText, Sense, Ui, vec2};

use super::super::text_field::text_field;
use super::super::{Output, Widgets, theme};
use super::table::child;
use crate::document::CHOSEN;
use crate::paper::design_colour;
use crate::session::{CompareEdit, Edit, Field, Session};

/// Height of the heads.
pub(super) const HEIGHT: f32 = 62.0;

/// Draws the head of a column: the chosen design first, then those that are kept.
pub(super) fn show(
    ui: &mut Ui,
    rect: Rect,
    column: usize,
    session: &Session,
    widgets: &mut Widgets,
    out: &mut Output,
) {
    let mut ui = child(ui, rect.shrink2(vec2(5.0, 3.0)));
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = 5.0;
        let (_, swatch) = ui.allocate_space(vec2(10.0, 20.0));
        let swatch = swatch.shrink2(vec2(0.0, 4.0));
        ui.painter().rect_filled(swatch, 2.0, theme::series(ui, design_colour(column)));
        match column.checked_sub(1).and_then(|k| Some((k, session.document().kept.get(k)?))) {
            None => {
                ui.label(RichText::new(CHOSEN).strong());
            }
            Some((k, kept)) => {
                let field = Field::KeptName(k);
                let id = Id::unique(("kept name", k));
                let label = format!("name of kept design {}", k + 1);
                let width = ui.available_width() - 2.0;
                let draft = session.draft(&field);
                if let Some(name) = text_field(ui, widgets, (id, &label), &kept.name, draft, width) {
                    out.edit(Edit::Compare(CompareEdit::Rename { kept: k, name }));
                }
            }
        }
    });
    let Some((k, kept)) = column.checked_sub(1).and_then(|k| Some((k, session.document().kept.get(k)?)))
    else {
        let (_, line) = ui.allocate_space(vec2(10.0, 20.0));
        let hint = "The design in the observer's place, which poles and demands change.";
        ui.interact(line, Id::unique("chosen design"), Sense::hover()).on_hover_text(hint);
        return;
    };
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = 5.0;
        let mut button = |text: &str, hint: &str| {
            let response = ui.small_button(text).on_hover_text(hint);
            let label = format!("{text} {}", kept.name);
            response.ctx.accesskit_node_builder(response.id, |node| node.set_label(label));
            response.clicked()
        };
        if button("Use", "Makes this the chosen design, and keeps the chosen one in its place.") {
            out.edit(Edit::Compare(CompareEdit::Choose(k)));
        }
        if button("Discard", "Forgets this design; Undo brings it back.") {
            out.edit(Edit::Compare(CompareEdit::Discard(k)));
        }
    });
    if let Some(draft) = session.draft(&Field::KeptName(k)) {
        ui.label(RichText::new(&draft.error).small().color(theme::bad(&ui)));
    }
}
