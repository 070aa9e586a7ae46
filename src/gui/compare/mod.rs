//! Designs of one plant side by side: the table, the common figures, keeping and exchanging designs.

mod head;
mod keep;
mod spectrum;
mod table;

use egui::{RichText, ScrollArea, Ui, vec2};

pub(super) use keep::keep;

use super::plot::{notes_ui, panels_ui};
use super::{Output, Widgets, theme};
use crate::document::comparison::{comparison_table, comparison_to_csv, comparison_to_markdown};
use crate::document::report::comparison_report;
use crate::paper::{FigureSpec, Panel};
use crate::platform::files::{FileRequest, SavedFile, file_name};
use crate::session::{CompareEdit, ComparedFigure, ComparisonView, Derived, Edit, Session, Show};
use crate::simulation::comparison::Comparison;

/// Height of a row of panels.
const PANEL_HEIGHT: f32 = 230.0;

/// The chosen figure of the comparison, as far as it is there.
pub(super) fn figure<'a>(session: &Session, derived: &'a Derived) -> Option<&'a FigureSpec> {
    let view = derived.comparison()?.ok()?;
    session.view().compared.of(&view.figures)
}

/// Narrower panels are drawn below each other.
const NARROW_PANEL: f32 = 280.0;

/// Draws the comparison.
pub(super) fn show(
    ui: &mut Ui,
    session: &Session,
    derived: &Derived,
    widgets: &mut Widgets,
    out: &mut Output,
) {
    let fresh = derived.is_compared(session.revision());
    let found = derived.comparison();
    ScrollArea::vertical().id_salt("comparison").auto_shrink([false, false]).show(ui, |ui| {
        introduction(ui, session, out);
        let view = match found {
            Some(Ok(view)) => Some(view),
            Some(Err(why)) => {
                ui.colored_label(theme::bad(ui), why);
                None
            }
            None => None,
        };
        // what is shown of an earlier document is dimmed, but stays in its place
        ui.scope(|ui| {
            if !fresh {
                ui.multiply_opacity(0.55);
            }
            let empty = Comparison::default();
            let comparison = view.map_or(&empty, |view| &view.comparison);
            table::show(ui, session, &comparison_table(comparison), comparison, widgets, out);
            if let Some(view) = view {
                below(ui, session, view, out);
            }
        });
    });
}

/// What this is for, and the button that keeps the chosen design.
fn introduction(ui: &mut Ui, session: &Session, out: &mut Output) {
    ui.horizontal_wrapped(|ui| {
        let (possible, hint) = keep::possible(session);
        let button = ui.add_enabled(possible, egui::Button::new("Keep this design"));
        if button.on_hover_text(&hint).on_disabled_hover_text(&hint).clicked() {
            out.edit(Edit::Compare(CompareEdit::Keep));
        }
        let text = if session.document().kept.is_empty() {
            "Keep the chosen design, then change its method, order or poles: both stand side by side here."
        } else {
            "All designs see the same plant, inputs and noise. The best value of a line is marked."
        };
        ui.colored_label(theme::faint(ui), text);
    });
}

/// Remarks, exports and the common figures.
fn below(ui: &mut Ui, session: &Session, view: &ComparisonView, out: &mut Output) {
    ui.add_space(theme::ITEM_GAP);
    notes_ui(ui, &view.comparison.notes);
    exports(ui, session, &view.comparison, out);
    let offered = || ComparedFigure::ALL.into_iter().filter(|which| which.of(&view.figures).is_some());
    if offered().next().is_none() {
        return;
    }
    ui.add_space(theme::BLOCK_GAP);
    let chosen = session.view().compared;
    ui.horizontal_wrapped(|ui| {
        for which in offered() {
            if ui.selectable_label(which == chosen, which.title()).clicked() {
                out.show(Show::Compared(which));
            }
        }
    });
    let Some(figure) = chosen.of(&view.figures) else {
        ui.colored_label(theme::faint(ui), "Choose a figure.");
        return;
    };
    ui.label(RichText::new(&figure.caption).small());
    let panels: Vec<&Panel> = figure.panels.iter().collect();
    // legends with the names of all designs need width
    let columns = if ui.available_width() < 2.0 * NARROW_PANEL { 1 } else { figure.columns.max(1) };
    let rows = panels.len().div_ceil(columns);
    let size = vec2(ui.available_width(), rows as f32 * PANEL_HEIGHT);
    ui.allocate_ui(size, |ui| panels_ui(ui, &panels, columns, &figure.id));
}

/// Buttons that save the table.
fn exports(ui: &mut Ui, session: &Session, comparison: &Comparison, out: &mut Output) {
    ui.horizontal_wrapped(|ui| {
        ui.colored_label(theme::faint(ui), "Save the table as");
        let mut button = |name: &str, extension: &str, mime: &'static str, text: &dyn Fn() -> String| {
            let response = ui.small_button(name);
            response
                .ctx
                .accesskit_node_builder(response.id, |node| node.set_label(format!("table as {name}")));
            if response.clicked() {
                let title = format!("{} comparison", session.document().title);
                out.files.push(FileRequest::Save(SavedFile {
                    name: file_name(&title, extension),
                    mime,
                    bytes: text().into_bytes(),
                }));
            }
        };
        button("CSV", "csv", "text/csv", &|| comparison_to_csv(comparison));
        button("Markdown", "md", "text/markdown", &|| comparison_to_markdown(comparison));
        button("JSON", "json", "application/json", &|| comparison_report(session.document(), comparison));
    });
}
