//! Demands, subsystems and nonlinearity as a person reaches them: by clicks, drags and typing.
#![cfg(all(not(target_arch = "wasm32"), feature = "gui"))]
#![expect(clippy::unwrap_used, clippy::panic, reason = "helpers of tests may fail a test")]

use descry::document::{DescriptorData, PlantData};
use descry::gui::App;
use descry::observer::{LmiChoice, Method};
use descry::platform::SynchronousRunner;
use descry::session::{Command, Field, Place, Session, Show};
use egui::accesskit::Role;
use egui_kittest::{Harness, kittest::Queryable as _};

const PARTITIONED: &str = include_str!("documents/000-partition.json");
const LIPSCHITZ: &str = include_str!("documents/002-lipschitz.json");

fn harness(text: &str, size: [f32; 2]) -> Harness<'static, App> {
    let mut harness = Harness::builder().with_size(size).build_ui_state(
        |ui, app: &mut App| app.show(ui),
        App::new(
            &egui::Context::default(),
            Session::with_first_example().unwrap(),
            Box::new(SynchronousRunner::default()),
        ),
    );
    harness.state_mut().command(Command::Open { text: text.to_owned() });
    settle(&mut harness);
    harness
}

fn tall(text: &str) -> Harness<'static, App> {
    harness(text, [1400.0, 2600.0])
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

/// Drags from the middle of a widget by a distance, in steps.
fn drag(harness: &mut Harness<'_, App>, at: egui::Pos2, by: egui::Vec2) {
    harness.hover_at(at);
    harness.run_steps(1);
    harness.drag_at(at);
    harness.run_steps(1);
    for k in 1..=5_u8 {
        harness.hover_at(at + by * (f32::from(k) / 5.0));
        harness.run_steps(1);
    }
    harness.drop_at(at + by);
    settle(harness);
}

fn lmi<'a>(harness: &'a Harness<'_, App>) -> &'a LmiChoice {
    &harness.state().session().document().design.lmi
}

fn data<'a>(harness: &'a Harness<'_, App>) -> &'a DescriptorData {
    match &harness.state().session().document().plant {
        PlantData::Descriptor(data) => data,
        PlantData::Network(_) => panic!("the documents of these tests hold matrices"),
    }
}

fn undo(harness: &mut Harness<'_, App>) {
    harness.state_mut().command(Command::Undo);
    settle(harness);
}

#[test]
fn a_tile_chooses_the_method_and_its_first_demands() {
    let mut harness = tall(LIPSCHITZ);
    click(&mut harness, "H-infinity");
    let design = &harness.state().session().document().design;
    assert_eq!((design.method, design.lmi.decay), (Method::HInfinity, Some(0.5)), "chosen, with a demand");
    click(&mut harness, "Decentralized");
    let told = harness.get_all_by_label_contains("do not take a Lipschitz term").count();
    assert!(told > 0, "the missing data are named");
    click(&mut harness, "Minimal");
    click(&mut harness, "Proportional");
    let design = &harness.state().session().document().design;
    assert!(
        design.method.orders().contains(&design.order),
        "an order that the method has: {:?}",
        design.order
    );
}

#[test]
fn a_slid_demand_is_one_step() {
    let mut harness = tall(LIPSCHITZ);
    click(&mut harness, "H-infinity");
    let before = lmi(&harness).clone();
    let rail = harness.get_by_role_and_label(Role::Slider, "Decay rate").rect();
    drag(&mut harness, rail.center(), egui::vec2(0.25 * rail.width(), 0.0));
    let slid = lmi(&harness).decay.unwrap();
    assert!(slid > 3.0 && slid < 60.0, "three quarters of the way from 0.01 to 100: {slid}");
    undo(&mut harness);
    assert_eq!(*lmi(&harness), before, "one step back");
    harness.get_by_role_and_label(Role::CheckBox, "Decay rate").click();
    settle(&mut harness);
    assert_eq!(lmi(&harness).decay, None, "the box takes the demand away");
    harness.get_by_role_and_label(Role::CheckBox, "Gain bound").click();
    settle(&mut harness);
    assert_eq!(lmi(&harness).gain, None, "unbounded");
}

#[test]
fn gamma_and_the_other_demands_are_within_reach() {
    let mut harness = tall(LIPSCHITZ);
    click(&mut harness, "H-infinity");
    let given: Vec<_> = harness.get_all_by_label("Given").map(|node| node.rect()).collect();
    let first = given.iter().min_by(|a, b| a.top().total_cmp(&b.top())).unwrap().center();
    harness.hover_at(first);
    harness.drag_at(first);
    harness.drop_at(first);
    settle(&mut harness);
    assert!(lmi(&harness).gamma.is_some(), "an attenuation is given");
    click(&mut harness, "Least");
    assert_eq!(lmi(&harness).gamma, None, "the least again");
    click(&mut harness, "More demands");
    click(&mut harness, "Inequality (52) as printed, with slack matrices");
    assert!(lmi(&harness).alternative, "the other form");
    let rail = harness.get_by_role_and_label(Role::Slider, "Back-off").rect();
    drag(&mut harness, rail.center(), egui::vec2(0.2 * rail.width(), 0.0));
    assert!(lmi(&harness).back_off > 0.012, "one per cent was the start: {}", lmi(&harness).back_off);
}

#[test]
fn a_cell_of_r_is_typed() {
    let mut harness = tall(LIPSCHITZ);
    click(&mut harness, "H-infinity");
    let given: Vec<_> = harness.get_all_by_label("Given").map(|node| node.rect()).collect();
    let last = given.iter().max_by(|a, b| a.top().total_cmp(&b.top())).unwrap().center();
    harness.hover_at(last);
    harness.drag_at(last);
    harness.drop_at(last);
    settle(&mut harness);
    assert_eq!(lmi(&harness).rows.len(), 1, "R is given");
    type_into(&mut harness, "R[1, 2]", "3/4");
    assert_eq!(lmi(&harness).rows[0][(0, 1)], 0.75, "the expression's value");
    type_into(&mut harness, "R[1, 3]", "3/");
    assert!(harness.state().session().draft(&Field::Rows(0, 0, 2)).is_some(), "kept as it was typed");
    click(&mut harness, "Chosen by the order");
    assert!(lmi(&harness).rows.is_empty(), "reset");
}

#[test]
fn an_observer_to_examine_is_typed() {
    let mut harness = tall(LIPSCHITZ);
    click(&mut harness, "H-infinity");
    click(&mut harness, "Examine a given observer");
    click(&mut harness, "Examine instead of designing");
    type_into(&mut harness, "given N", "[0 -1.996; 0.667 -2.121]");
    type_into(&mut harness, "given J", "[-0.331; -1.414]");
    type_into(&mut harness, "Claimed gamma", "sqrt(9.762)");
    let given = lmi(&harness).given.clone().unwrap();
    assert_eq!((given.N[(1, 0)], given.J[(1, 0)]), (0.667, -1.414), "as it was typed");
    assert_eq!(given.gamma, Some(9.762_f64.sqrt()), "the claim");
    click(&mut harness, "Design again");
    assert!(lmi(&harness).given.is_none(), "removed");
}

#[test]
fn subsystems_are_made_sized_and_removed_by_clicks() {
    let mut harness = tall(PARTITIONED);
    assert_eq!(data(&harness).partition.len(), 2, "two at first");
    click(&mut harness, "Remove the partition");
    assert!(data(&harness).partition.is_empty(), "removed");
    click(&mut harness, "Divide into subsystems");
    assert_eq!(data(&harness).partition.len(), 2, "made again");
    click(&mut harness, "More states of subsystem 1");
    assert_eq!(data(&harness).partition[0].states, 3, "C does not allow it");
    let message = harness.state().session().message().unwrap();
    assert!(message.error && message.text.contains("C["), "the entry is named: {message:?}");
    type_into(&mut harness, "C[4, 4]", "0");
    click(&mut harness, "More states of subsystem 1");
    assert_eq!(data(&harness).partition[0].states, 4, "now it does");
    type_into(&mut harness, "E[1, 6]", "1");
    assert_eq!(harness.state().session().n_drafts(), 1, "a coupling entry waits");
    click(&mut harness, "Join subsystem 1");
    assert_eq!(harness.state().session().n_drafts(), 0, "and is in force when nothing stands in its way");
}

#[test]
fn a_separator_is_dragged_in_the_matrix() {
    let mut harness = tall(PARTITIONED);
    type_into(&mut harness, "C[4, 4]", "0");
    let grip = harness.get_by_label("separator 1 of E").rect();
    let cell = harness.get_by_role_and_label(Role::TextInput, "E[1, 4]").rect();
    drag(&mut harness, grip.center(), egui::vec2(cell.width() + 3.0, 0.0));
    assert_eq!(data(&harness).partition[0].states, 4, "one state further");
    undo(&mut harness);
    assert_eq!(data(&harness).partition[0].states, 3, "one step back");
}

#[test]
fn decoupled_states_are_chosen_by_clicks() {
    let mut harness = tall(PARTITIONED);
    click(&mut harness, "Chosen");
    click(&mut harness, "subsystem 1 decouples x4");
    click(&mut harness, "subsystem 2 decouples x1");
    assert_eq!(lmi(&harness).decoupled, Some(vec![vec![3], vec![0]]), "one each");
    click(&mut harness, "subsystem 1 decouples x4");
    assert_eq!(lmi(&harness).decoupled, Some(vec![vec![], vec![0]]), "and off again");
    click(&mut harness, "As many as possible");
    assert_eq!(lmi(&harness).decoupled, None, "the program's choice");
}

#[test]
fn a_nonlinearity_is_typed_added_and_removed() {
    let mut harness = tall(LIPSCHITZ);
    type_into(&mut harness, "f1", "sin(x2");
    assert_eq!(data(&harness).lipschitz.as_ref().unwrap().f, ["sin(x2)"], "the good one stays");
    harness.get_by_label_contains("f1: ");
    type_into(&mut harness, "f1", "tanh(x2)");
    assert_eq!(data(&harness).lipschitz.as_ref().unwrap().f, ["tanh(x2)"], "in force");
    type_into(&mut harness, "G[2, 1]", "1/2");
    type_into(&mut harness, "F_L[1, 1]", "-2");
    type_into(&mut harness, "Lipschitz constant", "0.9");
    let lipschitz = data(&harness).lipschitz.clone().unwrap();
    let found = (lipschitz.G.values()[(1, 0)], lipschitz.F_L.values()[(0, 0)], lipschitz.constant);
    assert_eq!(found, (0.5, -2.0, 0.9), "all typed");
    click(&mut harness, "Remove the nonlinearity");
    assert!(data(&harness).lipschitz.is_none(), "removed");
    click(&mut harness, "Add a nonlinearity");
    assert!(data(&harness).lipschitz.is_some(), "added");
}

#[test]
fn a_phone_shows_every_place() {
    for text in [LIPSCHITZ, PARTITIONED] {
        let mut harness = harness(text, [390.0, 844.0]);
        for method in Method::ALL {
            harness.state_mut().command(Command::Edit(descry::session::Edit::Method(method)));
            for place in [Place::System, Place::Observer, Place::Figures] {
                harness.state_mut().command(Command::Show(Show::Place(place)));
                settle(&mut harness);
            }
        }
    }
}
