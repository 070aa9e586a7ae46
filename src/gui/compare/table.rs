//! The table: names of quantities stay in place, the designs scroll beside them where they do not fit.

use egui::{
    Align, CursorIcon, Id, Label, Layout, Rect, RichText, ScrollArea, Sense, Ui, UiBuilder, pos2, vec2,
};

use super::super::{Output, Widgets, theme};
use super::head;
use super::spectrum::{Window, picture};
use crate::document::comparison::{ComparisonTable, Group, LineKind, TableCell, TableLine};
use crate::document::{CHOSEN, PlantData};
use crate::paper::design_colour;
use crate::session::Session;
use crate::simulation::comparison::{ComparedDesign, Comparison};
use crate::system::TimeDomain;

/// Height of a line.
const LINE: f32 = 22.0;
/// Height of a line that is written in several lines.
const TALL: f32 = 56.0;
/// Height of the spectra.
const PICTURE: f32 = 70.0;

/// A row of the table.
enum Row<'a> {
    Heading(Group, String),
    Line(&'a TableLine),
}

impl Row<'_> {
    fn height(&self) -> f32 {
        match self {
            Self::Heading(..) => LINE + 4.0,
            Self::Line(line) => match line.kind {
                LineKind::Method => TALL,
                LineKind::Spectrum => PICTURE,
                LineKind::Value | LineKind::Status => LINE,
            },
        }
    }
}

/// Everything that a cell is drawn from.
struct Table<'a> {
    comparison: &'a Comparison,
    window: Window,
    /// For each column the row of the comparison that belongs to it; `None` for a design that is not compared yet.
    columns: Vec<Option<usize>>,
    width: f32,
}

/// Draws the table.
pub(super) fn show(
    ui: &mut Ui,
    session: &Session,
    table: &ComparisonTable,
    comparison: &Comparison,
    widgets: &mut Widgets,
    out: &mut Output,
) {
    let columns = columns(session, &table.designs);
    let label = if theme::is_narrow(ui) { 104.0 } else { 132.0 };
    let room = (ui.available_width() - label - 8.0) / columns.len().max(1) as f32;
    let window = Window::around(comparison, is_discrete(session));
    let drawn = Table { comparison, window, columns, width: room.clamp(112.0, 190.0) };
    let mut rows = Vec::new();
    for group in Group::ALL {
        let lines = || table.lines.iter().filter(|line| line.group == group);
        if lines().next().is_none() {
            continue;
        }
        if group != Group::Design {
            rows.push(Row::Heading(group, table.heading(group)));
        }
        if is_open(ui, group) {
            rows.extend(lines().map(Row::Line));
        }
    }
    ui.horizontal_top(|ui| {
        ui.spacing_mut().item_spacing = vec2(0.0, 0.0);
        ui.vertical(|ui| {
            ui.allocate_exact_size(vec2(label, head::HEIGHT), Sense::hover());
            for (k, row) in rows.iter().enumerate() {
                name(ui, row, vec2(label, row.height()), k);
            }
        });
        ScrollArea::horizontal().id_salt("designs").auto_shrink([true, true]).show(ui, |ui| {
            ui.vertical(|ui| {
                drawn.heads(ui, session, widgets, out);
                for (k, row) in rows.iter().enumerate() {
                    drawn.row(ui, row, k);
                }
            });
        });
    });
}

/// The rows of a comparison in the order of the document: the chosen design, then those that are kept.
fn columns(session: &Session, designs: &[String]) -> Vec<Option<usize>> {
    let chosen = designs.first().filter(|name| *name == CHOSEN).map(|_| 0);
    let kept = session.document().kept.iter().map(|kept| {
        let place = designs.iter().skip(1).position(|name| *name == kept.name);
        place.map(|k| k + 1)
    });
    std::iter::once(chosen).chain(kept).collect()
}

fn is_discrete(session: &Session) -> bool {
    match &session.document().plant {
        PlantData::Descriptor(data) => data.time == TimeDomain::Discrete,
        PlantData::Network(_) => false,
    }
}

fn open_id(group: Group) -> Id {
    Id::unique(("comparison group", group.title()))
}

/// Whether a part of the table is unfolded; errors one by one are not at first.
fn is_open(ui: &Ui, group: Group) -> bool {
    ui.data(|data| data.get_temp(open_id(group))).unwrap_or(group != Group::Each)
}

/// A part of the screen with a cursor of its own, centred vertically.
pub(super) fn child(ui: &mut Ui, rect: Rect) -> Ui {
    ui.new_child(UiBuilder::new().max_rect(rect).layout(Layout::top_down(Align::Min)))
}

fn striped(ui: &Ui, rect: Rect, k: usize) {
    if k.is_multiple_of(2) {
        ui.painter().rect_filled(rect, 0.0, ui.visuals().faint_bg_color);
    }
}

/// The name of a quantity, or the heading of a part.
fn name(ui: &mut Ui, row: &Row<'_>, size: egui::Vec2, k: usize) {
    let (rect, _) = ui.allocate_exact_size(size, Sense::hover());
    match row {
        Row::Line(line) => {
            striped(ui, rect, k);
            let mut ui = child(ui, rect.shrink2(vec2(4.0, 3.0)));
            ui.add(Label::new(&line.label).truncate()).on_hover_text(&line.meaning);
        }
        Row::Heading(group, title) => heading(ui, *group, title, rect),
    }
}

/// A heading, which folds its part; its text may reach under the designs.
fn heading(ui: &mut Ui, group: Group, title: &str, rect: Rect) {
    let open = is_open(ui, group);
    let response = ui.interact(rect, open_id(group).with("heading"), Sense::click());
    response.widget_info(|| egui::WidgetInfo::selected(egui::Role::Button, true, open, title));
    if response.clicked() {
        ui.data_mut(|data| data.insert_temp(open_id(group), !open));
    }
    let colour = if response.hovered() || response.has_focus() {
        theme::accent(ui)
    } else {
        ui.visuals().text_color()
    };
    let font = egui::TextStyle::Body.resolve(ui.style());
    let mark = if open { "-" } else { "+" };
    let at = pos2(rect.left() + 4.0, rect.bottom() - 3.0);
    let clip = Rect::from_min_max(rect.min, pos2(ui.ctx().content_rect().right(), rect.max.y));
    let painter = ui.painter().with_clip_rect(clip);
    painter.text(at, egui::Align2::LEFT_BOTTOM, format!("{mark} {title}"), font, colour);
    response.on_hover_cursor(CursorIcon::PointingHand);
}

impl Table<'_> {
    fn cells(&self, ui: &mut Ui, height: f32) -> (Rect, Vec<Rect>) {
        let width = self.width * self.columns.len() as f32;
        let (row, _) = ui.allocate_exact_size(vec2(width, height), Sense::hover());
        let cell = |k: usize| {
            Rect::from_min_size(pos2(row.left() + self.width * k as f32, row.top()), vec2(self.width, height))
        };
        (row, (0..self.columns.len()).map(cell).collect())
    }

    fn heads(&self, ui: &mut Ui, session: &Session, widgets: &mut Widgets, out: &mut Output) {
        let (_, cells) = self.cells(ui, head::HEIGHT);
        for (column, rect) in cells.into_iter().enumerate() {
            head::show(ui, rect, column, session, widgets, out);
        }
    }

    fn row(&self, ui: &mut Ui, row: &Row<'_>, k: usize) {
        let (rect, cells) = self.cells(ui, row.height());
        let Row::Line(line) = row else { return };
        striped(ui, rect, k);
        for (column, rect) in cells.into_iter().enumerate() {
            let found = self.columns[column];
            let Some((row, cell)) = found.and_then(|row| Some((row, line.cells.get(row)?))) else { continue };
            let design = self.comparison.rows.get(row).and_then(|row| row.outcome.as_ref().ok());
            match design.filter(|_| line.kind == LineKind::Spectrum) {
                Some(design) => self.spectrum(ui, rect, column, design, cell),
                None => value(ui, rect, line, cell, design.is_some_and(|design| design.verified)),
            }
        }
    }

    fn spectrum(&self, ui: &mut Ui, rect: Rect, column: usize, design: &ComparedDesign, cell: &TableCell) {
        let inner = rect.shrink2(vec2(6.0, 4.0));
        let response = ui.interact(inner, Id::unique(("spectrum", column)), Sense::hover());
        response.widget_info(|| {
            egui::WidgetInfo::labeled(egui::Role::Image, true, format!("spectrum: {}", cell.text))
        });
        picture(ui, inner, &self.window, design, theme::series(ui, design_colour(column)));
        response.on_hover_text(&cell.text);
    }
}

/// A value or words; the best value of a line stands out by weight and ground.
fn value(ui: &mut Ui, rect: Rect, line: &TableLine, cell: &TableCell, verified: bool) {
    let inner = rect.shrink2(vec2(6.0, 2.0));
    if cell.best {
        let ground = theme::good(ui).gamma_multiply(0.16);
        ui.painter().rect_filled(rect.shrink2(vec2(2.0, 1.0)), 4.0, ground);
    }
    let text = match line.kind {
        LineKind::Status if verified => RichText::new(&cell.text).color(theme::good(ui)),
        LineKind::Status => RichText::new(&cell.text).color(theme::near(ui)),
        LineKind::Method => RichText::new(&cell.text).small(),
        LineKind::Value | LineKind::Spectrum if cell.value.is_none() && line.group != Group::Design => {
            RichText::new(&cell.text).color(theme::faint(ui))
        }
        LineKind::Value | LineKind::Spectrum => RichText::new(&cell.text),
    };
    let text = if cell.best { text.strong() } else { text };
    let label = Label::new(text);
    let label = if line.kind == LineKind::Method { label.wrap() } else { label.truncate() };
    let mut ui = child(ui, inner);
    let response = ui.add(label);
    let best = if cell.best { ", the best" } else { "" };
    let said = format!("{}{best}", line.label);
    response.ctx.accesskit_node_builder(response.id, |node| node.set_description(said));
    let hint =
        if cell.hint.is_empty() { line.meaning.clone() } else { format!("{}\n{}", line.meaning, cell.hint) };
    response.on_hover_text(hint);
}
