//! The top line: name, examples, files, undo, theme.

use egui::Ui;

use super::{Output, Widgets};
use crate::paper::EXAMPLES;
use crate::session::{Command, Place, Session, Show, ThemeChoice};

/// Draws the top line.
pub(super) fn show(ui: &mut Ui, session: &Session, _widgets: &mut Widgets, out: &mut Output) {
    ui.horizontal_wrapped(|ui| {
        ui.heading("descry");
        ui.menu_button("Examples", |ui| {
            for example in EXAMPLES {
                if ui.button(example.title).on_hover_text(example.teaches).clicked() {
                    out.commands.push(Command::OpenExample { key: example.key.to_owned() });
                    ui.close();
                }
            }
        });
        super::file_menu::show(ui, out);
        if ui.add_enabled(session.can_undo(), egui::Button::new("Undo")).on_hover_text("Ctrl+Z").clicked() {
            out.commands.push(Command::Undo);
        }
        if ui
            .add_enabled(session.can_redo(), egui::Button::new("Redo"))
            .on_hover_text("Ctrl+Shift+Z")
            .clicked()
        {
            out.commands.push(Command::Redo);
        }
        theme_choice(ui, session, out);
    });
}

fn theme_choice(ui: &mut Ui, session: &Session, out: &mut Output) {
    let (next, label) =
        if ui.visuals().dark_mode { (ThemeChoice::Light, "Light") } else { (ThemeChoice::Dark, "Dark") };
    if ui.button(label).on_hover_text("Change between light and dark").clicked() {
        out.show(Show::Theme(next));
    }
    let _ = session;
}

/// Draws the tabs of the three places, for narrow screens.
pub(super) fn places(ui: &mut Ui, session: &Session, out: &mut Output) {
    ui.horizontal(|ui| {
        for (place, title) in
            [(Place::System, "System"), (Place::Observer, "Observer"), (Place::Figures, "Figures")]
        {
            if ui.selectable_label(session.view().place == place, title).clicked() {
                out.show(Show::Place(place));
            }
        }
    });
}
