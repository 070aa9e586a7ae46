//! The place of the figures as a person uses it.
#![cfg(all(not(target_arch = "wasm32"), feature = "gui"))]
#![expect(clippy::unwrap_used, reason = "a test fails by panicking")]

use descry::gui::App;
use descry::numerics::Watch;
use descry::paper::EXAMPLES;
use descry::platform::Runner;
use descry::session::{
    Command, Field, JobReply, JobRequest, Place, Session, Show, SignalList, Tab, perform, update,
};
use egui_kittest::Harness;
use egui_kittest::kittest::{NodeT as _, Queryable as _};

/// Performs each computation at once.
#[derive(Default)]
struct AtOnce(Vec<JobReply>);

impl Runner for AtOnce {
    fn start(&mut self, request: JobRequest) {
        self.0.extend(perform(&request, &Watch::none()));
    }

    fn cancel(&mut self) {
        self.0.clear();
    }

    fn poll(&mut self) -> Option<JobReply> {
        self.0.pop()
    }
}

fn open(size: [f32; 2], commands: &[Command]) -> Harness<'static, Option<App>> {
    let mut session = Session::with_first_example().unwrap();
    for command in commands {
        update(&mut session, command.clone());
    }
    let mut session = Some(session);
    let mut harness = Harness::builder().with_size(egui::Vec2::from(size)).build_ui_state(
        move |ui, app: &mut Option<App>| {
            if app.is_none() {
                let session = session.take().unwrap();
                *app = Some(App::new(ui.ctx(), session, Box::new(AtOnce::default())));
            }
            if let Some(app) = app {
                app.show(ui);
            }
        },
        None,
    );
    harness.run();
    harness
}

fn app<'a>(harness: &'a Harness<'_, Option<App>>) -> &'a App {
    harness.state().as_ref().unwrap()
}

fn tab(tab: Tab) -> Command {
    Command::Show(Show::Tab(tab))
}

#[test]
fn every_tab_draws_for_every_example_on_wide_and_narrow_screens() {
    for example in EXAMPLES {
        for size in [[1400.0, 900.0], [400.0, 800.0]] {
            let mut harness = open(size, &[Command::OpenExample { key: example.key.to_owned() }]);
            for each in Tab::ALL {
                let app = harness.state_mut().as_mut().unwrap();
                app.command(tab(each));
                app.command(Command::Show(Show::Place(Place::Figures)));
                harness.run();
            }
            assert!(app(&harness).derived().analysis().is_some(), "{}: analysed", example.key);
        }
    }
}

#[test]
fn a_dragged_pole_is_one_step_of_the_history() {
    let mut harness = open([1400.0, 900.0], &[tab(Tab::Poles)]);
    let before = app(&harness).session().document().design.poles.clone();
    let at = harness.get_by_label("pole 1").rect().center();
    harness.hover_at(at);
    harness.run();
    harness.drag_at(at);
    harness.run();
    for k in 1..6_u8 {
        harness.hover_at(at - egui::vec2(10.0 * f32::from(k), 0.0));
        harness.run();
    }
    harness.drop_at(at - egui::vec2(60.0, 0.0));
    harness.run();
    let after = app(&harness).session().document().design.poles.clone();
    assert!(after[0].re < before[0].re - 0.5, "moved to the left: {} to {}", before[0], after[0]);
    assert_eq!(before[1..], after[1..], "the other poles stay");
    harness.state_mut().as_mut().unwrap().command(Command::Undo);
    harness.run();
    assert_eq!(app(&harness).session().document().design.poles, before, "one undo takes the drag back");
    assert!(!app(&harness).session().can_undo(), "there was one step");
}

#[test]
fn a_focused_pole_moves_by_arrow_keys() {
    let mut harness = open([1400.0, 900.0], &[tab(Tab::Poles)]);
    let before = app(&harness).session().document().design.poles.clone();
    harness.get_by_label("pole 2").focus();
    harness.run();
    for _ in 0..3 {
        harness.key_press(egui::Key::ArrowLeft);
        harness.run();
    }
    let after = app(&harness).session().document().design.poles.clone();
    assert!(after[1].re < before[1].re, "to the left: {} to {}", before[1], after[1]);
    assert_eq!(after[1].im, 0.0, "on the axis");
    harness.key_press(egui::Key::ArrowUp);
    harness.run();
    assert!(app(&harness).session().document().design.poles[1].im > 0.0, "Up leaves the real axis");
}

#[test]
fn an_expression_that_is_not_understood_says_why_and_changes_nothing() {
    let mut harness = open([1400.0, 900.0], &[]);
    let signal = |harness: &Harness<'_, Option<App>>| {
        app(harness).session().document().scenario.d[0].text().to_owned()
    };
    let before = signal(&harness);
    harness.get_by_role_and_label(egui::Role::TextInput, "d1").click();
    harness.run();
    harness.key_press_modifiers(egui::Modifiers::COMMAND, egui::Key::A);
    harness.event(egui::Event::Text("5+2*sin(".to_owned()));
    harness.run();
    harness.key_press(egui::Key::Enter);
    harness.run();
    assert_eq!(signal(&harness), before, "the last good signal stays in force");
    assert_eq!(
        harness.get_by_role_and_label(egui::Role::TextInput, "d1").value().as_deref(),
        Some("5+2*sin("),
        "the text is kept"
    );
    let field = Field::Signal(SignalList::Unknown, 0);
    let why = app(&harness).session().draft(&field).unwrap().error.clone();
    harness.get_by_label(&format!("d1: {why}"));

    harness.get_by_role_and_label(egui::Role::TextInput, "d1").click();
    harness.run();
    harness.event(egui::Event::Text("3*t)".to_owned()));
    harness.key_press(egui::Key::Enter);
    harness.run();
    assert_eq!(signal(&harness), "5+2*sin(3*t)", "mended");
    assert_eq!(app(&harness).session().n_drafts(), 0, "nothing is left");
}

#[test]
fn a_chosen_figure_shows_its_caption() {
    let mut harness = open([1400.0, 900.0], &[tab(Tab::Figures)]);
    harness.get_by_label("Figure").click();
    harness.run();
    harness.get_by_label_contains("Fig. 6").click();
    harness.run();
    assert_eq!(app(&harness).session().view().figure.as_deref(), Some("fig6"), "chosen");
    harness.get_by_label_contains("The estimate contains f");
    harness.get_by_label("Next").click();
    harness.run();
    assert_eq!(app(&harness).session().view().figure.as_deref(), Some("fig7"), "the next one");
}

#[test]
fn a_curve_is_hidden_by_its_legend_entry() {
    let mut harness = open([1400.0, 900.0], &[tab(Tab::States)]);
    let shown = |harness: &Harness<'_, Option<App>>| {
        harness.get_by_label("x1_hat").accesskit_node().toggled() == Some(egui::accesskit::Toggled::True)
    };
    assert!(shown(&harness), "shown at first");
    harness.get_by_label("x1_hat").click();
    harness.run();
    assert!(!shown(&harness), "hidden");
}
