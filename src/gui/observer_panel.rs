//! This observer: methods, order, poles, conditions, result.

use egui::{RichText, Ui, vec2};

use super::text_field::text_field;
use super::{Output, Widgets, conditions, pole_plane, result, theme};
use crate::observer::{Method, Order};
use crate::session::{Derived, Edit, Field, Light, Session, Tab, poles_text};

/// Draws the place of the observer.
pub fn show(ui: &mut Ui, session: &Session, derived: &Derived, widgets: &mut Widgets, out: &mut Output) {
    ui.add_space(theme::ITEM_GAP);
    ui.label(RichText::new("Observer").heading());
    methods(ui, session, derived, out);
    orders(ui, session, out);
    match derived.analysis().map(|analysis| &analysis.assessment) {
        Some(Ok(assessment)) => {
            result::badge(ui, assessment);
            poles(ui, session, derived, widgets, out);
            ui.separator();
            ui.label(RichText::new("Conditions").strong());
            conditions::show(ui, &assessment.conditions, widgets, out);
            ui.separator();
            ui.label(RichText::new("Result").strong());
            if let Ok(design) = &assessment.outcome {
                result::show(ui, design);
            }
        }
        Some(Err(why)) => {
            ui.colored_label(theme::bad(ui), why);
            poles(ui, session, derived, widgets, out);
        }
        None => {
            ui.label("computing");
        }
    }
}

fn methods(ui: &mut Ui, session: &Session, derived: &Derived, out: &mut Output) {
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
            let text = RichText::new(format!("     {}", method.title())).strong();
            let button = egui::Button::new(text).stroke(stroke).min_size(vec2(130.0, 34.0));
            let response = ui.add(button);
            let centre = egui::pos2(response.rect.left() + 15.0, response.rect.center().y);
            ui.painter().circle_filled(centre, 5.5, colour);
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

fn word(light: Light) -> &'static str {
    match light {
        Light::Exists => "exists",
        Light::Near => "exists narrowly",
        Light::Fails => "does not exist",
        Light::Missing => "data missing",
    }
}

fn orders(ui: &mut Ui, session: &Session, out: &mut Output) {
    let design = &session.document().design;
    ui.horizontal_wrapped(|ui| {
        ui.label("Order");
        for order in Order::ALL {
            let (name, what) = match order {
                Order::Reduced => {
                    ("Reduced", "What the outputs already tell is not estimated again; best conditioned.")
                }
                Order::Full => ("Full", "Every state is estimated dynamically, as in the paper's figures."),
                Order::General => {
                    ("General", "Not in the paper: needs only (9) and (10), and takes a feedthrough F.")
                }
            };
            if order == Order::General && design.method == Method::Proportional {
                continue;
            }
            let response = ui.selectable_label(design.order == order, name).on_hover_text(what);
            if response.clicked() && design.order != order {
                out.edit(Edit::Order(order));
            }
        }
    });
}

fn poles(ui: &mut Ui, session: &Session, derived: &Derived, widgets: &mut Widgets, out: &mut Output) {
    let design = &session.document().design;
    ui.label(RichText::new("Poles").strong());
    let draft = session.draft(&Field::Poles);
    let shown = poles_text(&design.poles);
    let width = ui.available_width();
    if let Some(text) = text_field(ui, widgets, (egui::Id::unique("poles"), "Poles"), &shown, draft, width) {
        out.edit(Edit::Poles(text));
    }
    if let Some(draft) = draft {
        ui.colored_label(theme::bad(ui), &draft.error);
    }
    scale(ui, session, out);
    // the view of poles has the plane itself, larger
    let elsewhere = !theme::is_narrow(ui) && session.view().tab == Tab::Poles;
    if !elsewhere {
        let size = vec2(ui.available_width(), 190.0);
        ui.allocate_ui(size, |ui| pole_plane::pole_plane_ui(ui, session, derived, size, out));
    }
}

/// The bandwidth slider, the papers' multiple of Lambda.
fn scale(ui: &mut Ui, session: &Session, out: &mut Output) {
    let mut scale = session.document().design.scale;
    ui.horizontal(|ui| {
        ui.label("Lambda x").on_hover_text("All poles times this factor: more bandwidth catches the unknown input faster and passes more noise.");
        ui.spacing_mut().slider_width = (ui.available_width() - 80.0).max(80.0);
        let slider = egui::Slider::new(&mut scale, 0.1..=100.0).logarithmic(true).max_decimals(3).clamping(egui::SliderClamping::Never);
        let response = ui.add(slider);
        response.ctx.accesskit_node_builder(response.id, |node| node.set_label("Lambda scale"));
        if response.changed() || response.drag_stopped() {
            out.edit(Edit::Scale { scale, done: !response.dragged() });
        }
    });
}
