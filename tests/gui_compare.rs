//! The comparison of designs, used as a person uses it, without a window.

#![cfg(all(not(target_arch = "wasm32"), feature = "gui"))]
#![expect(clippy::unwrap_used, reason = "helpers of tests may fail a test")]

use descry::document::comparison::comparison_table;
use descry::gui::App;
use descry::observer::Method;
use descry::platform::SynchronousRunner;
use descry::session::{Command, ComparedFigure, Field, Session, Show, Tab, ThemeChoice};
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
    harness.run_steps(8);
    assert!(harness.state().derived().running().is_none(), "the runner of this test computes at once");
}

fn click(harness: &mut Harness<'_, App>, label: &str) {
    harness.get_by_label(label).click();
    settle(harness);
}

fn names(harness: &Harness<'_, App>) -> Vec<String> {
    harness.state().session().document().kept.iter().map(|kept| kept.name.clone()).collect()
}

fn show_table(harness: &mut Harness<'_, App>) {
    harness.state_mut().command(Command::Show(Show::Tab(Tab::Compare)));
    settle(harness);
}

#[test]
fn a_design_is_kept_beside_its_badge_and_compared_by_one_click() {
    let mut harness = harness("proportional-integral", [1500.0, 1000.0]);
    click(&mut harness, "Keep to compare");
    assert_eq!(names(&harness), ["PI, reduced, 3 poles"], "under a name that says what it is");
    click(&mut harness, "Full");
    click(&mut harness, "Compare them");
    assert_eq!(harness.state().session().view().tab, Tab::Compare, "the table is shown");
    let rows = &harness.state().derived().comparison().unwrap().unwrap().comparison.rows;
    assert_eq!(rows.len(), 2, "the chosen design and the kept one");
    harness.get_by_label("Use PI, reduced, 3 poles");
    harness.get_by_label("H-infinity norms of the error");
}

#[test]
fn kept_designs_are_used_renamed_and_discarded() {
    let mut harness = harness("comparison", [1500.0, 1000.0]);
    show_table(&mut harness);
    click(&mut harness, "Use PI, general");
    let document = harness.state().session().document();
    assert_eq!(document.design.method, Method::ProportionalIntegral, "now the chosen design");
    assert_eq!(names(&harness)[2], "Input-decoupled, full, 2 poles", "and the other one is kept");
    click(&mut harness, "Discard proportional");
    assert_eq!(names(&harness).len(), 3, "one less");

    let label = "name of kept design 1";
    let field = |harness: &mut Harness<'_, App>, text: &str| {
        harness.get_by_role_and_label(egui::accesskit::Role::TextInput, label).click();
        harness.run_steps(2);
        harness.key_combination_modifiers(egui::Modifiers::COMMAND, &[egui::Key::A]);
        harness.run_steps(1);
        harness.event(egui::Event::Text(text.to_owned()));
        harness.run_steps(1);
        harness.key_press(egui::Key::Enter);
        settle(harness);
    };
    field(&mut harness, "slow");
    assert_eq!(names(&harness)[0], "slow", "typed");
    field(&mut harness, "H-infinity");
    assert_eq!(names(&harness)[0], "slow", "another design has that name");
    let draft = harness.state().session().draft(&Field::KeptName(0)).unwrap().error.clone();
    harness.get_by_label(&draft);
    for _ in 0..3 {
        harness.state_mut().command(Command::Undo);
    }
    settle(&mut harness);
    assert_eq!(names(&harness), ["proportional", "PI, full", "PI, general", "H-infinity"], "as it was");
}

#[test]
fn a_part_of_the_table_folds_and_the_figures_change() {
    let mut harness = harness("comparison", [1500.0, 1800.0]);
    show_table(&mut harness);
    assert!(harness.query_by_label("noise to e_d").is_some(), "unfolded at first");
    click(&mut harness, "H-infinity norms of the error");
    assert!(harness.query_by_label("noise to e_d").is_none(), "folded");
    assert!(harness.query_by_label("rms e_d1").is_none(), "errors one by one are folded at first");
    click(&mut harness, "Root mean square errors one by one, second half");
    harness.get_by_label("rms e_d1");
    for figure in ComparedFigure::ALL {
        click(&mut harness, figure.title());
        assert_eq!(harness.state().session().view().compared, figure, "chosen");
    }
    harness.get_by_label_contains("their peaks are the H-infinity norms");
}

#[test]
fn the_table_is_saved_in_three_formats() {
    let mut harness = harness("comparison", [1500.0, 1800.0]);
    show_table(&mut harness);
    for (label, part) in [
        ("table as CSV", "d to e,0,0.8268"),
        ("table as Markdown", "| d to e | **0, decoupled** |"),
        ("table as JSON", "\"decoupled\": true"),
    ] {
        click(&mut harness, label);
        let requests = harness.state_mut().take_file_requests();
        let [descry::platform::files::FileRequest::Save(file)] = requests.as_slice() else {
            panic!("{label}: {requests:?}")
        };
        let text = String::from_utf8(file.bytes.clone()).unwrap();
        assert!(text.contains(part), "{label}: {text}");
    }
}

#[test]
fn the_reasons_of_all_methods_are_told_without_hovering() {
    let mut harness = harness("comparison", [1500.0, 1400.0]);
    let missing = "Decentralized observers need subsystems";
    assert!(harness.query_by_label_contains(missing).is_none(), "folded at first");
    click(&mut harness, "Why: 4 of 6 methods exist");
    harness.get_by_label_contains(missing);
    harness.get_by_label_contains("is seen when it is designed");
}

#[test]
fn it_draws_wide_and_narrow_light_and_dark_with_one_and_with_many_designs() {
    for size in [[1500.0, 1000.0], [420.0, 900.0]] {
        for key in
            ["comparison", "discrete", "unseen-impulse", "decentralized", "input-decoupled", "hierarchical"]
        {
            let mut harness = harness(key, size);
            show_table(&mut harness);
            for theme in [ThemeChoice::Light, ThemeChoice::Dark] {
                harness.state_mut().command(Command::Show(Show::Theme(theme)));
                settle(&mut harness);
                let what = format!("{key}, {size:?}, {theme:?}");
                let view = harness.state().derived().comparison().unwrap().unwrap();
                let table = comparison_table(&view.comparison);
                assert_eq!(
                    table.designs.len(),
                    view.comparison.rows.len(),
                    "a column for each design: {what}"
                );
                for label in ["Status", "Decay", "Spectrum", "noise to e"] {
                    assert!(
                        harness.query_all_by_label(label).next().is_some(),
                        "the line {label} is drawn: {what}"
                    );
                }
                let status = &table.lines[0].cells[0].text;
                assert!(
                    harness.query_all_by_label(status).next().is_some(),
                    "its value, too: {what}, {status}"
                );
            }
        }
    }
}
