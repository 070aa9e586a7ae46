//! Networks as a person reaches them: nodes, edges, cells, sizes, chips, poles.
#![cfg(all(not(target_arch = "wasm32"), feature = "gui"))]
#![expect(clippy::unwrap_used, clippy::panic, reason = "helpers of tests may fail a test")]

use descry::document::{NetworkData, PlantData};
use descry::gui::App;
use descry::observer::Method;
use descry::platform::SynchronousRunner;
use descry::session::{
    Command, CouplingForm, Edit, Field, Light, NetworkEdit, Place, Session, Show, ThemeChoice, coupling_forms,
};
use egui::accesskit::Role;
use egui_kittest::{Harness, kittest::Queryable as _};

/// Four oscillators on a chain, of which the first and the last are measured locally.
fn harness(size: [f32; 2]) -> Harness<'static, App> {
    let mut harness = Harness::builder().with_size(size).build_ui_state(
        |ui, app: &mut App| app.show(ui),
        App::new(
            &egui::Context::default(),
            Session::with_first_example().unwrap(),
            Box::new(SynchronousRunner::default()),
        ),
    );
    harness.state_mut().command(Command::NewNetwork);
    settle(&mut harness);
    harness
}

fn tall() -> Harness<'static, App> {
    harness([1400.0, 2600.0])
}

fn settle(harness: &mut Harness<'_, App>) {
    harness.run_steps(5);
    assert!(harness.state().derived().running().is_none(), "the runner of this test computes at once");
}

fn click(harness: &mut Harness<'_, App>, label: &str) {
    harness.get_by_label(label).click();
    settle(harness);
}

fn type_into(harness: &mut Harness<'_, App>, label: &str, text: &str) {
    harness.get_by_role_and_label(Role::TextInput, label).click();
    harness.run_steps(2);
    harness.key_combination_modifiers(egui::Modifiers::COMMAND, &[egui::Key::A]);
    harness.run_steps(1);
    harness.event(egui::Event::Text(text.to_owned()));
    harness.run_steps(1);
    harness.key_press(egui::Key::Enter);
    settle(harness);
}

/// Drags from one place to another, in steps.
fn drag(harness: &mut Harness<'_, App>, from: egui::Pos2, to: egui::Pos2) {
    harness.hover_at(from);
    harness.run_steps(1);
    harness.drag_at(from);
    harness.run_steps(1);
    for k in 1..=5_u8 {
        harness.hover_at(from + (to - from) * (f32::from(k) / 5.0));
        harness.run_steps(1);
    }
    harness.drop_at(to);
    settle(harness);
}

fn data<'a>(harness: &'a Harness<'_, App>) -> &'a NetworkData {
    match &harness.state().session().document().plant {
        PlantData::Network(data) => data,
        PlantData::Descriptor(_) => panic!("the documents of these tests hold networks"),
    }
}

fn plugged(harness: &Harness<'_, App>) -> Option<Vec<usize>> {
    harness.state().session().document().design.plugged.clone()
}

fn verified(harness: &Harness<'_, App>) -> bool {
    let derived = harness.state().derived();
    let current = derived.is_current(harness.state().session().revision());
    current && derived.analysis().is_some_and(descry::session::Analysis::verified)
}

fn light(harness: &Harness<'_, App>) -> Light {
    let methods = &harness.state().derived().analysis().unwrap().methods;
    methods.iter().find(|light| light.method == Method::Hierarchical).unwrap().light
}

/// How many local observers the newest design has.
fn n_local(harness: &Harness<'_, App>) -> usize {
    let assessment = harness.state().derived().analysis().unwrap().assessment.as_ref().unwrap();
    assessment.outcome.as_ref().unwrap().hierarchical.as_ref().unwrap().locals().count()
}

fn node(harness: &Harness<'_, App>, words: &str) -> egui::Pos2 {
    harness.get_by_role_and_label(Role::Switch, words).rect().center()
}

#[test]
fn a_node_plugs_its_local_observer_in_and_out() {
    let mut harness = tall();
    assert!(verified(&harness) && light(&harness) == Light::Exists, "a new network has an observer");
    assert_eq!(n_local(&harness), 2, "subsystems 1 and 4 have local ones");
    click(&mut harness, "Subsystem 4: local observer plugged in");
    assert_eq!((plugged(&harness), n_local(&harness)), (Some(vec![0]), 1), "out");
    assert!(verified(&harness), "nothing else changes");
    click(&mut harness, "Subsystem 4: measured locally, local observer out");
    assert_eq!((plugged(&harness), n_local(&harness)), (None, 2), "in again");
    click(&mut harness, "Subsystem 2: not measured locally");
    let message = harness.state().session().message().unwrap();
    assert!(message.error && message.text.contains("subsystem 2"), "it needs sensors first: {message:?}");
    harness.get_by_role_and_label(Role::CheckBox, "measured locally").click();
    settle(&mut harness);
    assert_eq!(data(&harness).local, [1, 2, 4], "the node was chosen, its sensors switched on");
    assert_eq!(n_local(&harness), 3, "with the same gain as the others");
}

#[test]
fn the_keyboard_reaches_every_node() {
    let mut harness = tall();
    harness.get_by_role_and_label(Role::Switch, "Subsystem 4: local observer plugged in").focus();
    harness.run_steps(2);
    harness.key_press(egui::Key::Space);
    settle(&mut harness);
    assert_eq!(plugged(&harness), Some(vec![0]), "Space pulls it out");
    harness.key_press(egui::Key::Enter);
    settle(&mut harness);
    assert_eq!(plugged(&harness), None, "Enter plugs it in");
}

#[test]
fn an_edge_is_drawn_weighted_and_removed() {
    let mut harness = tall();
    let first = node(&harness, "Subsystem 1: local observer plugged in");
    let third = node(&harness, "Subsystem 3: not measured locally");
    drag(&mut harness, first, third);
    let gamma = data(&harness).Gamma.values();
    assert_eq!((gamma[(2, 0)], gamma[(2, 2)]), (1.0, -3.0), "3 listens to 1, the sum of its row stays");
    type_into(&mut harness, "Edge weight", "1/2");
    assert_eq!(data(&harness).Gamma.value(2, 0), 0.5, "the edge was chosen");
    type_into(&mut harness, "Edge weight", "1/");
    assert_eq!(harness.state().session().n_drafts(), 1, "kept as it was typed");
    type_into(&mut harness, "Edge weight", "1");
    click(&mut harness, "Remove");
    assert_eq!(data(&harness).Gamma.value(2, 0), 0.0, "removed");
    harness.state_mut().command(Command::Undo);
    settle(&mut harness);
    assert_eq!(data(&harness).Gamma.value(2, 0), 1.0, "one step back");
}

#[test]
fn cells_are_typed_and_pasted() {
    let mut harness = tall();
    type_into(&mut harness, "Gamma[1, 2]", "5/2");
    assert_eq!(data(&harness).Gamma.value(0, 1), 2.5, "the expression's value");
    assert!(verified(&harness), "the changed network has a verified observer");
    type_into(&mut harness, "a[1, 1]", "-0.5");
    assert_eq!(data(&harness).a.values()[(0, 0)], -0.5, "a number");
    type_into(&mut harness, "c_L[1, 2]", "two");
    assert_eq!(harness.state().session().n_drafts(), 1, "kept as it was typed");
    harness.get_by_role_and_label(Role::TextInput, "Gamma[2, 1]").click();
    harness.run_steps(2);
    harness.event(egui::Event::Paste("7 8; 9 10".to_owned()));
    settle(&mut harness);
    let gamma = data(&harness).Gamma.values();
    assert_eq!((gamma[(1, 0)], gamma[(2, 1)], gamma.shape()), (7.0, 10.0, (4, 4)), "from the active cell on");
}

#[test]
fn the_number_of_subsystems_is_stepped_and_typed() {
    let mut harness = tall();
    click(&mut harness, "More subsystems");
    assert_eq!(data(&harness).n_subsystems(), 5, "one more");
    assert!(coupling_forms(&data(&harness).Gamma).contains(&(CouplingForm::Chain, 1.0)), "still a chain");
    assert!(light(&harness) == Light::Exists, "whose observer exists");
    harness.get_by_role_and_label(Role::Switch, "Subsystem 5: not measured locally");
    type_into(&mut harness, "Subsystems", "6");
    assert_eq!(data(&harness).n_subsystems(), 6, "typed");
    type_into(&mut harness, "Subsystems", "six");
    assert!(harness.state().session().draft(&Field::Subsystems).is_some(), "kept as it was typed");
    click(&mut harness, "More rows of c_L");
    assert_eq!(data(&harness).c_L.shape(), (2, 2), "one more local output");
}

#[test]
fn a_chip_plugs_in_and_out() {
    let mut harness = tall();
    click(&mut harness, "Measure all locally");
    assert_eq!(n_local(&harness), 4, "all plugged in");
    click(&mut harness, "3: plugged in");
    assert_eq!(plugged(&harness), Some(vec![0, 1, 3]), "the third is out");
    click(&mut harness, "3: out");
    assert_eq!(plugged(&harness), None, "and in again");
    click(&mut harness, "Pull out all local observers");
    assert_eq!(n_local(&harness), 0, "the global observer alone");
    assert!(verified(&harness), "verified all the same");
}

#[test]
fn both_lists_of_poles_are_typed_and_dragged() {
    let mut harness = tall();
    type_into(&mut harness, "Local poles", "-7+2i, -7-2i");
    type_into(&mut harness, "Global poles", "-2.5, -3, -3.5, -4, -4.5, -5");
    assert!(verified(&harness), "both in force");
    let at = harness.get_by_label("local pole 1").rect().center();
    drag(&mut harness, at, at + egui::vec2(-12.0, -8.0));
    let design = &harness.state().session().document().design;
    let (pole, partner) = (design.local_poles[0], design.local_poles[1]);
    assert!(pole.re < -7.05 && pole.im > 2.05 && partner == pole.conj(), "dragged with its partner: {pole}");
    assert_eq!(design.poles[5].re, -5.0, "the global ones stay");
    assert!(verified(&harness), "designed again");
    let before = design.local_poles.clone();
    let at = harness.get_by_label("global pole 1").rect().center();
    drag(&mut harness, at, at + egui::vec2(-5.0, 0.0));
    let design = &harness.state().session().document().design;
    assert!(design.poles[0].re < -2.5 && design.local_poles == before, "the global ones alone");
}

#[test]
fn a_failing_condition_offers_what_mends_it() {
    let mut harness = tall();
    type_into(&mut harness, "Psi[1, 4]", "1");
    assert!(!verified(&harness) && light(&harness) == Light::Fails, "Psi is not within the coupling");
    click(&mut harness, "Use row 1 of Gamma");
    assert!(verified(&harness), "mended by one click");
}

#[test]
fn a_network_begins_in_the_menu_and_ends_as_matrices() {
    let mut harness = tall();
    click(&mut harness, "More states each");
    click(&mut harness, "File");
    click(&mut harness, "New network");
    assert_eq!((data(&harness).n_subsystems(), data(&harness).a.shape()), (4, (2, 2)), "a small one");
    assert!(verified(&harness), "with an observer");
    click(&mut harness, "Expand to matrices");
    assert_eq!(harness.state().session().document().system().unwrap().n_states(), 8, "one system");
    harness.get_by_role_and_label(Role::TextInput, "A[8, 8]");
    harness.state_mut().command(Command::Undo);
    settle(&mut harness);
    assert_eq!(data(&harness).n_subsystems(), 4, "and back");
}

#[test]
fn a_large_network_is_drawn_without_grids() {
    let mut harness = tall();
    for edit in [
        NetworkEdit::Template { form: CouplingForm::Leaders { leaders: 3 }, weight: 1.0 },
        NetworkEdit::Subsystems("2000".to_owned()),
    ] {
        harness.state_mut().command(Command::Edit(Edit::Network(edit)));
    }
    // the analysis of so many is not what is tested here
    harness.run_steps(3);
    harness.get_by_label("graph of 2000 subsystems, 2000 edges");
    assert!(harness.query_by_label("Gamma[1, 2]").is_none(), "no grid of four million cells");
    harness.get_by_label_contains("edges are drawn");
    let shown = harness.get_by_role_and_label(Role::TextInput, "Gamma[1, 1]").value();
    assert_eq!(shown.as_deref(), Some("0"), "the row of the chosen subsystem");
    type_into(&mut harness, "Gamma[1, 1]", "-1/4");
    assert_eq!(data(&harness).Gamma.value(0, 0), -0.25, "typed");
}

#[test]
fn a_network_draws_in_both_themes_wide_and_narrow() {
    for size in [[1400.0, 900.0], [390.0, 844.0]] {
        let mut harness = harness(size);
        for count in ["1", "2", "13", "1000"] {
            let edit = NetworkEdit::Subsystems(count.to_owned());
            harness.state_mut().command(Command::Edit(Edit::Network(edit)));
            for theme in [ThemeChoice::Light, ThemeChoice::Dark] {
                harness.state_mut().command(Command::Show(Show::Theme(theme)));
                for place in [Place::System, Place::Observer] {
                    harness.state_mut().command(Command::Show(Show::Place(place)));
                    harness.run_steps(2);
                }
            }
        }
    }
}
