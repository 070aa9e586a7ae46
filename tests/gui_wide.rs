//! Plants with free states and the errata of the papers, used as a person uses them, without a window.
#![cfg(all(not(target_arch = "wasm32"), feature = "gui"))]
#![expect(clippy::unwrap_used, reason = "helpers of tests may fail a test")]

use descry::document::EntryMatrix;
use descry::gui::App;
use descry::observer::{Method, Order};
use descry::paper::{errata, paper_examples};
use descry::platform::SynchronousRunner;
use descry::session::{Analysis, Command, Edit, FreeEdit, FreeReport, Session, Show, Tab};
use egui_kittest::{Harness, kittest::Queryable as _};
use nalgebra::DMatrix;

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

fn click(harness: &mut Harness<'_, App>, label: &str) {
    harness.get_by_label(label).click();
    settle(harness);
}

fn feedback(harness: &Harness<'_, App>) -> Option<DMatrix<f64>> {
    harness.state().session().document().scenario.free.feedback.as_ref().map(EntryMatrix::values)
}

fn analysis<'a>(harness: &'a Harness<'_, App>) -> &'a Analysis {
    harness.state().derived().analysis().unwrap()
}

fn report<'a>(harness: &'a Harness<'_, App>) -> &'a FreeReport {
    analysis(harness).free.as_ref().unwrap()
}

#[test]
fn a_free_state_is_driven_and_fed_back() {
    let mut harness = harness("input-decoupled", [1500.0, 1200.0]);
    harness.get_by_label("One state is free:");
    harness.get_by_label("v1 = 0.7071 x3 - 0.7071 x4");
    type_into(&mut harness, "v1", "cos(t)");
    let signals = &harness.state().session().document().scenario.free.signals;
    assert_eq!(signals[0].text(), "cos(t)", "typed");
    type_into(&mut harness, "v1", "cos(");
    harness.get_by_label_contains("v1: ");
    type_into(&mut harness, "v1", "0");

    click(&mut harness, "State feedback");
    assert_eq!(feedback(&harness), None, "off");
    harness.get_by_label_contains("The plant may grow");
    click(&mut harness, "Keep the plant bounded");
    let found = feedback(&harness).unwrap();
    let half = 0.5_f64.sqrt();
    assert!((found[(0, 0)] - 5.0 * half).abs() < 1e-9, "{found}");
    assert!(report(&harness).unstable.is_empty(), "bounded");
    harness.get_by_label_contains("The plant stays bounded");
    type_into(&mut harness, "feedback[1, 3]", "1/2");
    assert_eq!(feedback(&harness).unwrap()[(0, 2)], 0.5, "a cell is typed");
    click(&mut harness, "Undo");
    assert_eq!(feedback(&harness).unwrap()[(0, 2)], found[(0, 2)], "and taken back");
}

#[test]
fn nothing_is_said_of_free_states_twice() {
    let mut harness = harness("input-decoupled", [1500.0, 1200.0]);
    for tab in Tab::ALL {
        harness.state_mut().command(Command::Show(Show::Tab(tab)));
        settle(&mut harness);
        let count = harness.query_all_by_label_contains("0.7071 x3 - 0.7071 x4").count();
        assert_eq!(count, 1, "{tab:?}: in the scenario's place alone");
    }
}

#[test]
fn a_square_system_becomes_wide_by_a_click() {
    let mut harness = harness("proportional-integral", [1500.0, 1200.0]);
    assert!(analysis(&harness).free.is_none(), "square");
    click(&mut harness, "Fewer equations");
    assert_eq!(report(&harness).n_free, 1, "three equations for four states");
    harness.get_by_label("One state is free:");
    click(&mut harness, "More equations");
    assert_eq!(report(&harness).n_free, 1, "square again, but 0 = 0 determines nothing");
    type_into(&mut harness, "A[4, 4]", "1");
    assert!(analysis(&harness).free.is_none(), "0 = x4 does");
    click(&mut harness, "More states");
    let system = harness.state().session().document().system().unwrap();
    assert_eq!((system.n_states(), system.n_equations()), (5, 5), "and linked");
}

#[test]
fn a_square_plant_with_a_free_state_offers_to_drive_it() {
    let mut harness = harness("proportional-integral", [1500.0, 1200.0]);
    assert!(analysis(&harness).free.is_none(), "of index 1");
    // the third equation repeats the fourth
    for (cell, text) in [("A[3, 1]", "0"), ("A[3, 2]", "2"), ("A[3, 3]", "2"), ("A[3, 4]", "2")] {
        type_into(&mut harness, cell, text);
    }
    for column in 1..=4 {
        type_into(&mut harness, &format!("A[4, {column}]"), if column == 1 { "0" } else { "1" });
    }
    type_into(&mut harness, "B[3, 1]", "0");
    type_into(&mut harness, "B[4, 1]", "0");
    assert_eq!(report(&harness).n_free, 1, "{:?}", analysis(&harness).simulation);
    harness.get_by_label("One state is free:");
    type_into(&mut harness, "v1", "cos(t)");
    let signals = &harness.state().session().document().scenario.free.signals;
    assert_eq!(signals[0].text(), "cos(t)", "driven");
}

#[test]
fn free_signals_wait_while_a_system_is_square() {
    let mut harness = harness("proportional-integral", [1500.0, 1200.0]);
    assert!(harness.query_by_label_contains("Signals and feedback of free states wait").is_none(), "none");
    let edit = FreeEdit::Signal { index: 0, text: "sin(t)".to_owned() };
    harness.state_mut().command(Command::Edit(Edit::Free(edit)));
    settle(&mut harness);
    harness.get_by_label_contains("Signals and feedback of free states wait");
}

#[test]
fn equations_that_contradict_each_other_say_what_to_do() {
    let mut harness = harness("proportional-integral", [1500.0, 1200.0]);
    click(&mut harness, "More equations");
    type_into(&mut harness, "A[5, 1]", "1");
    type_into(&mut harness, "A[5, 2]", "1");
    harness.get_by_label_contains("Nothing to simulate");
    assert!(analysis(&harness).simulation.is_err(), "five equations for four states");
}

#[test]
fn errata_stand_beside_what_they_concern_and_in_a_list() {
    let mut harness = harness("input-decoupled", [1500.0, 5000.0]);
    harness.get_by_label_contains("printed \"G = [5/3 4/3]\"");
    harness.get_by_label_contains("Misprint, section III, d_hat: ");
    harness
        .get_by_label_contains("Not unique, section III, L: printed \"L = [0 6 1; 6 2 0]\", right as well");
    harness.get_by_label("Errata beside N");
    let pairs = |harness: &Harness<'_, App>| {
        ["printed", "printed, right as well"].map(|word| harness.query_all_by_label(word).count())
    };
    assert_eq!(pairs(&harness), [1, 1], "G and L as they are printed, beside ours");
    assert_eq!(harness.query_all_by_label("ours").count(), 2, "ours");
    let heights = [
        harness.get_by_label_contains("printed \"G = ").rect().min.y,
        harness.get_by_label("Q1").rect().min.y,
    ];
    assert!(heights[1] - heights[0] < 100.0, "the pair takes no more room than it needs: {heights:?}");
    // another plant, whose L happens to stay
    type_into(&mut harness, "A[3, 2]", "3");
    assert_eq!(pairs(&harness), [0, 0], "what is printed does not belong to this one");
    assert!(harness.query_by_label_contains("printed \"G = ").is_none(), "nor what is said of it");
    harness.get_by_label("Errata beside N");
    click(&mut harness, "Undo");
    assert!(harness.query_by_label("section III, d_hat").is_none(), "the list is folded");
    click(&mut harness, "Errata of paper 001 (5)");
    harness.get_by_label("section III, d_hat");
    harness.get_all_by_label_contains("its coefficient of z is [0 0] with -4/3").next().unwrap();
}

#[test]
fn the_list_is_that_of_the_chosen_method() {
    let mut harness = harness("proportional-integral", [1500.0, 3000.0]);
    harness.get_by_label("Errata of paper 004 (14)");
    click(&mut harness, "Input-decoupled");
    assert_eq!(harness.state().session().document().design.method, Method::InputDecoupled, "the tile");
    harness.get_by_label("Errata of paper 001 (5)");
    click(&mut harness, "General");
    assert_eq!(harness.state().session().document().design.order, Order::General, "its second order");
}

/// The misprints that stand open beside what they concern.
fn open_misprints(harness: &Harness<'_, App>, paper: &str) -> Vec<&'static str> {
    let shown = |place: &&'static str| {
        harness.query_all_by_label_contains(&format!(", {place}: printed ")).next().is_some()
    };
    errata(paper).map(|erratum| erratum.place).filter(shown).collect()
}

/// The misprints that stand beside what they concern, open or folded.
fn misprints(harness: &mut Harness<'_, App>, paper: &str) -> Vec<&'static str> {
    let mut found = open_misprints(harness, paper);
    for fold in harness.query_all_by_label_contains("Errata beside ") {
        fold.click_accesskit();
    }
    settle(harness);
    found.extend(open_misprints(harness, paper));
    found
}

fn every_misprint_stands_beside_what_it_concerns(paper: &str) {
    let key = paper_examples().find(|(of, _)| *of == paper).unwrap().1;
    let mut harness = harness(key, [1500.0, 7000.0]);
    let mut seen = Vec::new();
    let document = harness.state().session().document();
    let (method, figures) = (document.design.method, document.figures.clone());
    for order in method.orders() {
        harness.state_mut().command(Command::Edit(Edit::Order(*order)));
        settle(&mut harness);
        seen.extend(misprints(&mut harness, paper));
    }
    let of_figures =
        |id: &str| errata(paper).any(|erratum| erratum.concerns.split("; ").any(|one| one == id));
    for figure in figures.into_iter().filter(|figure| of_figures(&figure.id)) {
        harness.state_mut().command(Command::Show(Show::Tab(Tab::Figures)));
        harness.state_mut().command(Command::Show(Show::Figure(figure.id)));
        settle(&mut harness);
        seen.extend(misprints(&mut harness, paper));
    }
    for erratum in errata(paper) {
        assert!(seen.contains(&erratum.place), "{} of paper {paper} stands beside nothing", erratum.place);
    }
}

#[test]
fn every_misprint_of_paper_000_stands_beside_what_it_concerns() {
    every_misprint_stands_beside_what_it_concerns("000");
}

#[test]
fn every_misprint_of_paper_001_stands_beside_what_it_concerns() {
    every_misprint_stands_beside_what_it_concerns("001");
}

#[test]
fn every_misprint_of_paper_002_stands_beside_what_it_concerns() {
    every_misprint_stands_beside_what_it_concerns("002");
}

#[test]
fn every_misprint_of_paper_003_stands_beside_what_it_concerns() {
    every_misprint_stands_beside_what_it_concerns("003");
}

#[test]
fn every_misprint_of_paper_004_stands_beside_what_it_concerns() {
    every_misprint_stands_beside_what_it_concerns("004");
}

#[test]
fn misprints_of_an_example_leave_with_its_plant_and_those_of_an_order_with_the_order() {
    let mut harness = harness("proportional-integral", [1500.0, 7000.0]);
    let reduced = misprints(&mut harness, "004");
    assert!(reduced.contains(&"equation (19)") && !reduced.contains(&"Algorithm 1"), "{reduced:?}");
    assert!(reduced.contains(&"section IV, check of (8)"), "the example's: {reduced:?}");
    type_into(&mut harness, "A[3, 1]", "-2");
    let edited = misprints(&mut harness, "004");
    assert!(edited.contains(&"equation (19)"), "of the formulas, whatever the plant: {edited:?}");
    assert!(!edited.iter().any(|place| place.starts_with("section IV")), "of the example: {edited:?}");
    click(&mut harness, "Proportional");
    assert!(misprints(&mut harness, "004").is_empty(), "the proportional observer is another paper's");
}

#[test]
fn the_ring_is_no_example_of_the_paper_whose_method_it_uses() {
    let mut harness = harness("network-ring", [1500.0, 3000.0]);
    let found = misprints(&mut harness, "003");
    assert!(found.contains(&"(12)"), "of the formulas: {found:?}");
    assert!(!found.iter().any(|place| place.starts_with("section III")), "of the example: {found:?}");
}
