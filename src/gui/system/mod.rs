//! This system: title, time, sizes, matrices, nonlinearity, subsystems, properties.

mod decoupled;
mod lipschitz;
mod partition;

use egui::{RichText, Ui};

use super::entry_grid::pasted_block;
use super::{Output, Widgets, matrix_grid, network, theme};
use crate::document::{DescriptorData, Document, EntryMatrix, Matrix, PlantData};
use crate::session::{Derived, Edit, Session, Size};
use crate::system::TimeDomain;

/// Draws the place of the system.
pub fn show(ui: &mut Ui, session: &Session, derived: &Derived, widgets: &mut Widgets, out: &mut Output) {
    take_pasted_matrix(ui, widgets, out);
    widgets.active_cell = None;
    ui.add_space(theme::ITEM_GAP);
    heading(ui, session.document(), out);
    match &session.document().plant {
        PlantData::Descriptor(data) => {
            ui.add_space(theme::ITEM_GAP);
            equations(ui, data);
            time_and_sizes(ui, data, out);
            ui.add_space(theme::ITEM_GAP);
            for pair in [[Matrix::E, Matrix::A], [Matrix::B, Matrix::D], [Matrix::C, Matrix::F]] {
                matrix_grid::show_pair(ui, session, data, pair, widgets, out);
                ui.add_space(theme::ITEM_GAP);
            }
            lipschitz::show(ui, session, derived, widgets, out);
            partition::show(ui, session, data, out);
        }
        PlantData::Network(data) => network::show(ui, session, data, widgets, out),
    }
    properties(ui, derived);
}

fn heading(ui: &mut Ui, document: &Document, out: &mut Output) {
    let mut title = document.title.clone();
    let field = egui::TextEdit::multiline(&mut title)
        .hint_text("Title")
        .desired_rows(1)
        .return_key(None)
        .font(egui::TextStyle::Heading)
        .desired_width(f32::INFINITY)
        .frame(egui::Frame::NONE);
    let response = ui.add(field);
    response.ctx.accesskit_node_builder(response.id, |node| node.set_label("Title"));
    if response.changed() {
        out.edit(Edit::Title(title));
    }
    let mut notes = document.notes.clone();
    let field = egui::TextEdit::multiline(&mut notes)
        .hint_text("Notes")
        .desired_rows(1)
        .desired_width(f32::INFINITY)
        .frame(egui::Frame::NONE)
        .text_color(theme::faint(ui));
    let response = ui.add(field);
    response.ctx.accesskit_node_builder(response.id, |node| node.set_label("Notes"));
    if response.changed() {
        out.edit(Edit::Notes(notes));
    }
}

fn equations(ui: &mut Ui, data: &DescriptorData) {
    let discrete = data.time == TimeDomain::Discrete;
    let nonlinear = match (&data.lipschitz, discrete) {
        (None, _) => "",
        (Some(_), false) => " + G f(x)",
        (Some(_), true) => " + G f(x[k])",
    };
    let (dynamics, output) = if discrete {
        (format!("E x[k+1] = A x[k] + B u[k]{nonlinear} + D d[k]"), "y[k] = C x[k] + F d[k]")
    } else {
        (format!("E x' = A x + B u{nonlinear} + D d"), "y = C x + F d")
    };
    ui.horizontal_wrapped(|ui| {
        ui.spacing_mut().item_spacing.x = 18.0;
        for line in [dynamics.as_str(), output] {
            ui.add(egui::Label::new(RichText::new(line).monospace()).extend());
        }
    });
}

fn time_and_sizes(ui: &mut Ui, data: &DescriptorData, out: &mut Output) {
    ui.horizontal_wrapped(|ui| {
        for (time, name) in [(TimeDomain::Continuous, "Continuous"), (TimeDomain::Discrete, "Discrete")] {
            if ui.selectable_label(data.time == time, name).clicked() && data.time != time {
                out.edit(Edit::Time(time));
            }
        }
    });
    let [e, _, b, c, d, _] = data.matrices.each_ref().map(EntryMatrix::shape);
    let sizes = [
        (Size::States, "states", e.1),
        (Size::Equations, "equations", e.0),
        (Size::Inputs, "known inputs", b.1),
        (Size::Outputs, "outputs", c.0),
        (Size::UnknownInputs, "unknown inputs", d.1),
    ];
    egui::Grid::new("sizes").num_columns(2).spacing([theme::ITEM_GAP, 4.0]).show(ui, |ui| {
        for (k, (of, name, count)) in sizes.into_iter().enumerate() {
            stepper(ui, of, name, count, out);
            if k % 2 == 1 {
                ui.end_row();
            }
        }
    });
}

/// A number with buttons for one fewer and one more.
fn stepper(ui: &mut Ui, of: Size, name: &str, count: usize, out: &mut Output) {
    if let Some(grow) = steps(ui, name, name, count) {
        out.edit(Edit::Size { of, grow });
    }
}

/// Draws a number with its buttons, called `Fewer` and `More` of `label`; whether one more is wanted.
pub(super) fn steps(ui: &mut Ui, label: &str, shown: &str, count: usize) -> Option<bool> {
    let mut clicked = None;
    egui::Frame::new().fill(ui.visuals().faint_bg_color).corner_radius(4.0).inner_margin(3.0).show(
        ui,
        |ui| {
            ui.horizontal(|ui| {
                for (symbol, grow, word) in [("-", false, "Fewer"), ("+", true, "More")] {
                    if bump(ui, symbol, &format!("{word} {label}")) {
                        clicked = Some(grow);
                    }
                    if !grow {
                        ui.label(RichText::new(count.to_string()).strong());
                    }
                }
                let response = ui.label(RichText::new(shown).small());
                if label == "states" || label == "equations" {
                    response.on_hover_text(
                        "While there are as many equations as states, a new state brings its equation.",
                    );
                }
            });
        },
    );
    clicked
}

/// A small button beside a number; whether it was clicked.
pub(super) fn bump(ui: &mut Ui, symbol: &str, label: &str) -> bool {
    let response = ui.add(egui::Button::new(symbol).min_size(egui::vec2(24.0, 24.0)));
    response.ctx.accesskit_node_builder(response.id, |node| node.set_label(label));
    response.clicked()
}

fn properties(ui: &mut Ui, derived: &Derived) {
    let Some(analysis) = derived.analysis() else { return };
    ui.separator();
    ui.label(RichText::new("Properties").strong());
    egui::Grid::new("properties").num_columns(2).spacing([10.0, 4.0]).show(ui, |ui| {
        for property in &analysis.properties {
            ui.label(&property.name);
            let value = match property.verdict {
                Some(verdict) => RichText::new(&property.value).color(theme::verdict(ui, verdict)).strong(),
                None => RichText::new(&property.value),
            };
            ui.label(value).on_hover_text(&property.detail);
            ui.end_row();
        }
    });
}

/// Takes a pasted block of numbers for the active cell before the cell's own text field sees it.
fn take_pasted_matrix(ui: &Ui, widgets: &mut Widgets, out: &mut Output) {
    let Some(cell) = widgets.active_cell else { return };
    if let Some(text) = pasted_block(ui) {
        widgets.typing = None;
        out.edit(Edit::Paste { cell, text });
    }
}
