//! Keyboard shortcuts as commands.

use egui::{Context, Key, KeyboardShortcut, Modifiers};

use super::Output;
use crate::session::Command;

const UNDO: KeyboardShortcut = KeyboardShortcut::new(Modifiers::COMMAND, Key::Z);
const REDO: KeyboardShortcut = KeyboardShortcut::new(Modifiers::COMMAND.plus(Modifiers::SHIFT), Key::Z);
const REDO_AGAIN: KeyboardShortcut = KeyboardShortcut::new(Modifiers::COMMAND, Key::Y);

/// Turns pressed shortcuts into commands. While a text is being typed, undo belongs to that text.
pub(super) fn take(ctx: &Context, out: &mut Output) {
    if ctx.text_edit_focused() {
        return;
    }
    ctx.input_mut(|input| {
        // the longer shortcut first: its shorter part would match, too
        if input.consume_shortcut(&REDO) || input.consume_shortcut(&REDO_AGAIN) {
            out.commands.push(Command::Redo);
        } else if input.consume_shortcut(&UNDO) {
            out.commands.push(Command::Undo);
        }
    });
}
