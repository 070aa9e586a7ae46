//! A text field that commits when a person is done: on Enter or when it loses the focus.

use egui::{Id, Key, TextEdit, Ui};

use super::{Widgets, theme};
use crate::session::Draft;

/// Draws a field and returns its text when it is committed.
///
/// Enter and the loss of the focus commit a changed text, Escape brings back the last good one. What is being typed
/// lives in `widgets`, so that a field which disappears while it is typed into commits when it returns.
/// `shown` is the value in force; a `draft`, which is not understood, is shown in its place and outlined.
/// `label` is the accessible name.
pub fn text_field(
    ui: &mut Ui,
    widgets: &mut Widgets,
    (id, label): (Id, &str),
    shown: &str,
    draft: Option<&Draft>,
    width: f32,
) -> Option<String> {
    let base = draft.map_or(shown, |draft| draft.text.as_str());
    let typed = widgets.typing.as_ref().filter(|(of, _)| *of == id).map(|(_, text)| text.clone());
    let was_typing = typed.is_some();
    let mut text = typed.unwrap_or_else(|| base.to_owned());
    let response = ui.add(TextEdit::singleline(&mut text).id(id).desired_width(width));
    ui.ctx().accesskit_node_builder(id, |node| {
        node.set_label(label);
        if let Some(draft) = draft {
            node.set_description(draft.error.as_str());
        }
    });
    let rounding = ui.visuals().widgets.inactive.corner_radius;
    let outline = if draft.is_some() {
        theme::error_stroke(ui)
    } else {
        egui::Stroke::new(1.0, theme::faint(ui).gamma_multiply(0.4))
    };
    if draft.is_some() || !response.has_focus() {
        ui.painter().rect_stroke(response.rect, rounding, outline, egui::StrokeKind::Inside);
    }
    if response.has_focus() {
        if response.changed() {
            widgets.typing = Some((id, text));
        }
        return None;
    }
    if response.lost_focus() && ui.input(|input| input.key_pressed(Key::Escape)) {
        forget(widgets, id);
        return draft.map(|_| shown.to_owned());
    }
    // a text that is still remembered without the focus was left behind: the field had disappeared
    if !was_typing && !response.changed() {
        return None;
    }
    forget(widgets, id);
    (text != base).then_some(text)
}

fn forget(widgets: &mut Widgets, id: Id) {
    if widgets.typing.as_ref().is_some_and(|(of, _)| *of == id) {
        widgets.typing = None;
    }
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use egui_kittest::{Harness, kittest::Queryable as _};

    use super::*;

    #[derive(Default)]
    struct State {
        widgets: Widgets,
        values: [String; 2],
        committed: Vec<(usize, String)>,
        draft: Option<Draft>,
        hidden: bool,
    }

    fn harness() -> Harness<'static, State> {
        let mut harness = Harness::new_ui_state(
            |ui, state: &mut State| {
                for k in [0, 1] {
                    if state.hidden && k == 0 {
                        continue;
                    }
                    let draft = if k == 0 { state.draft.clone() } else { None };
                    let names = ["first", "second"];
                    let found = text_field(
                        ui,
                        &mut state.widgets,
                        (Id::unique(names[k]), names[k]),
                        &state.values[k].clone(),
                        draft.as_ref(),
                        80.0,
                    );
                    if let Some(text) = found {
                        state.committed.push((k, text.clone()));
                        state.values[k] = text;
                    }
                }
            },
            State { values: ["1".to_owned(), "2".to_owned()], ..State::default() },
        );
        harness.run();
        harness
    }

    fn type_into(harness: &mut Harness<'_, State>, label: &str, text: &str) {
        harness.get_by_label(label).click();
        harness.run();
        harness.key_press_modifiers(egui::Modifiers::COMMAND, Key::A);
        harness.event(egui::Event::Text(text.to_owned()));
        harness.run();
    }

    #[test]
    fn enter_commits_once() {
        let mut harness = harness();
        type_into(&mut harness, "first", "-1/3");
        assert!(harness.state().committed.is_empty(), "nothing is committed while typing");
        harness.key_press(Key::Enter);
        harness.run();
        harness.run();
        assert_eq!(harness.state().committed, [(0, "-1/3".to_owned())], "once, on Enter");
    }

    #[test]
    fn losing_the_focus_commits_in_both_directions() {
        let mut harness = harness();
        type_into(&mut harness, "first", "7");
        harness.get_by_label("second").click();
        harness.run();
        type_into(&mut harness, "second", "8");
        harness.get_by_label("first").click();
        harness.run();
        assert_eq!(harness.state().committed, [(0, "7".to_owned()), (1, "8".to_owned())], "down and up");
    }

    #[test]
    fn shift_tab_to_an_earlier_field_loses_nothing() {
        let mut harness = harness();
        type_into(&mut harness, "second", "8");
        harness.key_press_modifiers(egui::Modifiers::SHIFT, Key::Tab);
        harness.run();
        assert_eq!(harness.state().committed, [(1, "8".to_owned())], "committed on leaving");
    }

    #[test]
    fn escape_restores() {
        let mut harness = harness();
        type_into(&mut harness, "first", "99");
        harness.key_press(Key::Escape);
        harness.run();
        assert!(harness.state().committed.is_empty(), "nothing is committed");
        assert_eq!(harness.get_by_label("first").value().as_deref(), Some("1"), "the old value is back");
    }

    #[test]
    fn a_draft_is_shown_and_escape_brings_back_the_good_value() {
        let mut harness = harness();
        harness.state_mut().draft = Some(Draft { text: "2*".to_owned(), error: "ends too early".to_owned() });
        harness.run();
        assert_eq!(harness.get_by_label("first").value().as_deref(), Some("2*"), "keeps what was typed");
        harness.get_by_label("first").click();
        harness.run();
        harness.key_press(Key::Escape);
        harness.run();
        assert_eq!(harness.state().committed, [(0, "1".to_owned())], "the good value is committed again");
    }

    #[test]
    fn a_field_that_disappears_commits_when_it_returns() {
        let mut harness = harness();
        type_into(&mut harness, "first", "5");
        harness.state_mut().hidden = true;
        harness.run();
        harness.state_mut().hidden = false;
        harness.run();
        assert_eq!(harness.state().committed, [(0, "5".to_owned())], "nothing typed is lost");
    }
}
