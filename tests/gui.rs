//! The places of system and observer, used as a person uses them, without a window.

#![cfg(all(not(target_arch = "wasm32"), feature = "gui"))]
#![expect(clippy::unwrap_used, clippy::panic, reason = "helpers of tests may fail a test")]

use descry::document::Matrix;
use descry::gui::App;
use descry::observer::{Method, Order};
use descry::paper::EXAMPLES;
use descry::platform::SynchronousRunner;
use descry::session::{Command, Session, Show, ThemeChoice};
use egui_kittest::{Harness, kittest::Queryable as _};

fn harness(key: &str, size: [f32; 2]) -> Harness<'static, App> {
    let mut harness = Harness::builder().with_size(size).build_ui_state(
        |ui, app: &mut App| app.show(ui),
        App::new(
            &egui::Context::default(),
            Session::with_first_example().unwrap(),
            Box::new(SynchronousRunner::default()),
        ),
    );
    harness.state_mut().command(Command::OpenExample { key: key.to_owned() });
    settle(&mut harness);
    harness
}

/// Draws until the computations that a change started have arrived.
fn settle(harness: &mut Harness<'_, App>) {
    harness.run_steps(6);
    assert!(harness.state().derived().running().is_none(), "the runner of this test computes at once");
}

fn type_into(harness: &mut Harness<'_, App>, label: &str, text: &str) {
    harness.get_by_role_and_label(egui::accesskit::Role::TextInput, label).click();
    harness.run_steps(2);
    harness.key_combination_modifiers(egui::Modifiers::COMMAND, &[egui::Key::A]);
    harness.run_steps(1);
    harness.event(egui::Event::Text(text.to_owned()));
    harness.run_steps(1);
    harness.key_press(egui::Key::Enter);
    settle(harness);
}

fn value(harness: &Harness<'_, App>, matrix: Matrix, row: usize, column: usize) -> f64 {
    let descry::document::PlantData::Descriptor(data) = &harness.state().session().document().plant else {
        panic!("the examples are descriptor systems")
    };
    data.matrix(matrix).entry(row, column).unwrap().value
}

fn verified(harness: &Harness<'_, App>) -> bool {
    harness.state().derived().analysis().is_some_and(descry::session::Analysis::verified)
}

#[test]
fn typing_into_a_cell_changes_the_design() {
    let mut harness = harness("proportional-integral", [1400.0, 900.0]);
    assert!(verified(&harness), "the example is designed and verified at start");
    type_into(&mut harness, "A[2, 1]", "4/3");
    assert_eq!(value(&harness, Matrix::A, 1, 0), 4.0 / 3.0, "the expression's value");
    assert!(verified(&harness), "the changed system has a verified design");
    let revision = harness.state().session().revision();
    assert!(harness.state().derived().is_current(revision), "what is shown belongs to what was typed");
}

#[test]
fn what_is_not_understood_stays_in_the_cell_and_the_value_in_force() {
    let mut harness = harness("proportional-integral", [1400.0, 900.0]);
    type_into(&mut harness, "A[1, 3]", "1+");
    assert_eq!(value(&harness, Matrix::A, 0, 2), 1.0, "the last good value");
    assert_eq!(harness.state().session().n_drafts(), 1, "the text is kept");
    type_into(&mut harness, "A[1, 3]", "1+1");
    assert_eq!(value(&harness, Matrix::A, 0, 2), 2.0, "completed");
    assert_eq!(harness.state().session().n_drafts(), 0, "nothing is left to mend");
}

#[test]
fn order_and_method_are_one_click() {
    let mut harness = harness("proportional-integral", [1400.0, 900.0]);
    harness.get_by_label("Full").click();
    settle(&mut harness);
    assert_eq!(harness.state().session().document().design.order, Order::Full, "full order chosen");
    assert!(verified(&harness), "five poles are at hand");
    harness.get_by_label("Proportional").click();
    settle(&mut harness);
    assert_eq!(harness.state().session().document().design.method, Method::Proportional, "the other tile");
    assert!(verified(&harness), "the proportional observer exists as well");
}

#[test]
fn poles_can_be_typed() {
    let mut harness = harness("proportional-integral", [1400.0, 900.0]);
    type_into(&mut harness, "Poles", "-5, -3+2i, -3-2i");
    let poles = &harness.state().session().document().design.poles;
    assert_eq!((poles.len(), poles[1].im), (3, 2.0), "{poles:?}");
    assert!(verified(&harness), "three poles are enough for the reduced order");
    type_into(&mut harness, "Poles", "-5, -3+2i");
    assert_eq!(harness.state().session().document().design.poles.len(), 3, "half a pair is refused");
    assert_eq!(harness.state().session().n_drafts(), 1, "and stays to be completed");
}

#[test]
fn one_more_state_keeps_everything_consistent() {
    let mut harness = harness("proportional-integral", [1400.0, 900.0]);
    harness.get_by_label("More states").click();
    settle(&mut harness);
    let system = harness.state().session().document().system().unwrap();
    assert_eq!((system.n_states(), system.n_equations()), (5, 5), "the system stays square");
    harness.get_by_label("Undo").click();
    settle(&mut harness);
    assert_eq!(harness.state().session().document().system().unwrap().n_states(), 4, "and back");
}

#[test]
fn a_failing_condition_offers_the_sensor_that_mends_it() {
    let mut harness = harness("unseen-impulse", [1400.0, 1600.0]);
    assert!(!verified(&harness), "condition (9) fails");
    let outputs = harness.state().session().document().system().unwrap().n_outputs();
    let node = harness.get_all_by_label_contains("Add a sensor of x").next().expect("a remedy is offered");
    node.click();
    settle(&mut harness);
    let system = harness.state().session().document().system().unwrap();
    assert_eq!(system.n_outputs(), outputs + 1, "one more row in C");
    assert!(verified(&harness), "now the observer exists");
}

#[test]
fn every_example_draws_in_both_themes_wide_and_narrow() {
    for example in EXAMPLES {
        for size in [[1400.0, 900.0], [390.0, 844.0]] {
            let mut harness = harness(example.key, size);
            for theme in [ThemeChoice::Light, ThemeChoice::Dark] {
                harness.state_mut().command(Command::Show(Show::Theme(theme)));
                settle(&mut harness);
            }
            for place in ["System", "Observer", "Figures"] {
                if size[0] < 800.0 {
                    harness.get_by_label(place).click();
                    settle(&mut harness);
                }
            }
        }
    }
}
