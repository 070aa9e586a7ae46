//! The methods as tiles with lights, and the orders that they offer.

use egui::{RichText, Ui, vec2};

use super::super::{Output, theme};
use crate::observer::{Method, Order};
use crate::session::{Derived, Edit, Light, Session};

/// Draws a tile for each method, with a light.
pub(super) fn tiles(ui: &mut Ui, session: &Session, derived: &Derived, out: &mut Output) {
    let lights = derived.analysis().map(|analysis| analysis.methods.as_slice()).unwrap_or_default();
    ui.horizontal_wrapped(|ui| {
        for method in Method::ALL {
            let found = lights.iter().find(|light| light.method == method);
            let chosen = session.document().design.method == method;
            let colour = found.map_or(theme::faint(ui), |found| theme::light(ui, found.light));
            let stroke = egui::Stroke::new(
                if chosen { 2.0 } else { 1.0 },
                if chosen { theme::accent(ui) } else { theme::faint(ui) },
            );
            let text = RichText::new(format!("      {}", method.title())).strong();
            let button = egui::Button::new(text).stroke(stroke).min_size(vec2(136.0, 34.0));
            let response = ui.add(button);
            let centre = egui::pos2(response.rect.left() + 15.0, response.rect.center().y);
            match found.map(|found| found.light) {
                None | Some(Light::Missing) => {
                    ui.painter().circle_stroke(centre, 5.0, egui::Stroke::new(1.5, colour));
                }
                Some(_) => {
                    ui.painter().circle_filled(centre, 5.5, colour);
                }
            }
            response.ctx.accesskit_node_builder(response.id, |node| {
                node.set_label(method.title());
                node.set_description(found.map_or("not asked yet", |found| word(found.light)));
            });
            let clicked = response.clicked();
            let why = found.map_or("", |found| found.why.as_str());
            response.on_hover_text(format!("{}\n{why}", method.description()));
            if clicked && !chosen {
                out.edit(Edit::Method(method));
            }
        }
    });
}

/// Draws a foldable list of all methods with their lights, in words: hovering is not possible everywhere.
pub(super) fn reasons(ui: &mut Ui, derived: &Derived) {
    let lights = derived.analysis().map(|analysis| analysis.methods.as_slice()).unwrap_or_default();
    if lights.is_empty() {
        return;
    }
    let exist = lights.iter().filter(|light| matches!(light.light, Light::Exists | Light::Near)).count();
    let title = format!("Why: {exist} of {} methods exist", lights.len());
    egui::CollapsingHeader::new(title).id_salt("methods").show_unindented(ui, |ui| {
        for found in lights {
            let colour = theme::light(ui, found.light);
            ui.horizontal_wrapped(|ui| {
                let (_, dot) = ui.allocate_space(vec2(10.0, 12.0));
                if found.light == Light::Missing {
                    ui.painter().circle_stroke(dot.center(), 4.0, egui::Stroke::new(1.5, colour));
                } else {
                    ui.painter().circle_filled(dot.center(), 4.5, colour);
                }
                ui.strong(found.method.title());
                ui.colored_label(colour, word(found.light));
            });
            ui.label(RichText::new(sentence(&found.why)).small());
            ui.add_space(2.0);
        }
    });
}

/// A reason as a sentence of its own.
pub(in crate::gui) fn sentence(why: &str) -> String {
    let mut letters = why.chars();
    let first = letters.next().map(char::to_uppercase).into_iter().flatten();
    first.chain(letters).chain(['.']).collect()
}

fn word(light: Light) -> &'static str {
    match light {
        Light::Exists => "exists",
        Light::Near => "exists narrowly or not as asked",
        Light::Fails => "does not exist",
        Light::Missing => "data missing",
    }
}

/// Draws the orders that the method offers.
pub(super) fn orders(ui: &mut Ui, session: &Session, out: &mut Output) {
    let design = &session.document().design;
    if design.method.orders().len() < 2 {
        return;
    }
    ui.horizontal_wrapped(|ui| {
        ui.label("Order");
        for order in design.method.orders() {
            let (name, what) = order_words(design.method, *order);
            let response = ui.selectable_label(design.order == *order, name).on_hover_text(what);
            if response.clicked() && design.order != *order {
                out.edit(Edit::Order(*order));
            }
        }
    });
}

/// Name and meaning of an order.
fn order_words(method: Method, order: Order) -> (&'static str, &'static str) {
    match (method, order) {
        (Method::InputDecoupled, Order::Full) => {
            return ("Full", "The paper's observer, of order rank E; needs (A1), (A2) and (A3).");
        }
        (Method::InputDecoupled, Order::General) => {
            return ("General", "Not in the paper: of the same order, and does not need (A1).");
        }
        _ => {}
    }
    match (order, method.uses_lmi()) {
        (Order::Reduced, false) => {
            ("Reduced", "What the outputs already tell is not estimated again; best conditioned.")
        }
        (Order::Reduced, true) => ("Reduced", "What the outputs already tell is not estimated again."),
        (Order::Full, false) => ("Full", "Every state is estimated dynamically, as in the paper's figures."),
        (Order::Full, true) => ("Full", "Every state is estimated dynamically: R = I, the most freedom."),
        (Order::General, _) => {
            ("General", "Not in the paper: needs only (9) and (10), and takes a feedthrough F.")
        }
        (Order::Minimal, _) => (
            "Minimal",
            "Neither what the outputs nor what the algebraic equations tell is estimated again; often no freedom is left.",
        ),
    }
}
