//! The menu of files and links.

use egui::{Context, Key, KeyboardShortcut, Modifiers, Ui};

use super::Output;
use crate::platform::files::{FileRequest, HAS_LINKS};
use crate::session::Command;

const OPEN: KeyboardShortcut = KeyboardShortcut::new(Modifiers::COMMAND, Key::O);
const SAVE: KeyboardShortcut = KeyboardShortcut::new(Modifiers::COMMAND, Key::S);

/// Draws the menu.
pub(super) fn show(ui: &mut Ui, out: &mut Output) {
    ui.menu_button("File", |ui| {
        let hint = "Four coupled subsystems to begin with; undo brings back what was there";
        if ui.button("New network").on_hover_text(hint).clicked() {
            out.commands.push(Command::NewNetwork);
            ui.close();
        }
        let mut item = |title: &str, hint: &str, request: FileRequest| {
            if ui.button(title).on_hover_text(hint).clicked() {
                out.files.push(request);
                ui.close();
            }
        };
        item("Open document", "Ctrl+O, or drop a file onto the window", FileRequest::Open);
        item("Save document", "Ctrl+S", FileRequest::SaveDocument);
        if HAS_LINKS {
            item("Share link", "Put the document into the address and copy it", FileRequest::ShareLink);
        }
        item("Copy document", "Copy the document's text", FileRequest::CopyDocument);
    });
}

/// Turns pressed shortcuts into requests.
pub(super) fn shortcuts(ctx: &Context, out: &mut Output) {
    for (shortcut, request) in [(OPEN, FileRequest::Open), (SAVE, FileRequest::SaveDocument)] {
        if ctx.input_mut(|input| input.consume_shortcut(&shortcut)) {
            out.files.push(request);
        }
    }
}
