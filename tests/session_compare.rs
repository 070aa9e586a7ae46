//! Keeping designs, exchanging them, and comparing them, as a session does it.
#![cfg(not(target_arch = "wasm32"))]
#![expect(clippy::unwrap_used, reason = "helpers of tests fail by panicking")]

use descry::document::limits::MAX_KEPT;
use descry::document::{Document, PlantData, read_document};
use descry::numerics::{Complex64, Watch};
use descry::observer::{Method, Order};
use descry::session::{
    Command, CompareEdit, ComparedFigure, Derived, Edit, Field, NetworkEdit, NetworkSize, Session, Show,
    Size, Tab, Task, perform, update,
};

fn session(key: &str) -> Session {
    let mut session = Session::with_first_example().unwrap();
    update(&mut session, Command::OpenExample { key: key.to_owned() });
    session
}

fn edit(session: &mut Session, edit: Edit) {
    update(session, Command::Edit(edit));
}

fn compare(session: &mut Session, change: CompareEdit) {
    edit(session, Edit::Compare(change));
}

fn names(session: &Session) -> Vec<String> {
    session.document().kept.iter().map(|kept| kept.name.clone()).collect()
}

fn refusal(session: &Session) -> String {
    let message = session.message().unwrap();
    assert!(message.error, "{message:?}");
    message.text.clone()
}

#[test]
fn a_kept_design_has_a_name_that_says_what_it_is() {
    let mut session = session("proportional-integral");
    compare(&mut session, CompareEdit::Keep);
    edit(&mut session, Edit::Order(Order::Full));
    compare(&mut session, CompareEdit::Keep);
    edit(&mut session, Edit::Scale { scale: 2.0, done: true });
    compare(&mut session, CompareEdit::Keep);
    edit(&mut session, Edit::Method(Method::Proportional));
    compare(&mut session, CompareEdit::Keep);
    edit(&mut session, Edit::Method(Method::HInfinity));
    compare(&mut session, CompareEdit::Keep);
    let expected = ["PI, reduced, 3 poles", "PI, full, 5 poles", "PI, full, 5 poles, times 2"];
    assert_eq!(names(&session)[..3], expected, "method, order, poles and scale");
    assert_eq!(names(&session)[3], "Proportional, full, 4 poles, times 2", "no integral");
    assert_eq!(names(&session)[4], "H-infinity, reduced, decay 0.5", "the demand that it begins with");
    assert_eq!(session.document().kept[1].design.scale, 1.0, "kept as it was");
}

#[test]
fn the_same_design_is_kept_once_and_names_differ() {
    let mut session = session("proportional-integral");
    compare(&mut session, CompareEdit::Keep);
    compare(&mut session, CompareEdit::Keep);
    assert_eq!(names(&session).len(), 1, "once");
    assert!(
        refusal(&session).contains("kept already, as \"PI, reduced, 3 poles\""),
        "{:?}",
        session.message()
    );
    edit(&mut session, Edit::Poles("-5, -6, -7".to_owned()));
    compare(&mut session, CompareEdit::Keep);
    assert_eq!(names(&session)[1], "PI, reduced, 3 poles (2)", "other poles, the same words");
    update(&mut session, Command::Undo);
    assert_eq!(names(&session).len(), 1, "one step of the history");
    update(&mut session, Command::Redo);
    assert_eq!(names(&session).len(), 2, "and back");
}

#[test]
fn no_more_than_the_limit_is_kept() {
    let mut session = session("proportional-integral");
    for k in 0..=MAX_KEPT {
        edit(&mut session, Edit::Poles(format!("-5, -6, -{}", 7 + k)));
        compare(&mut session, CompareEdit::Keep);
    }
    assert_eq!(names(&session).len(), MAX_KEPT, "bounded");
    assert!(refusal(&session).contains("discard one of them first"), "says what to do");
    let text = session.document_text();
    assert_eq!(&read_document(&text).unwrap(), session.document(), "the document reads back");
}

#[test]
fn a_name_is_typed_and_one_that_cannot_be_stays_as_a_draft() {
    let mut session = session("comparison");
    let rename = |session: &mut Session, name: &str| {
        compare(session, CompareEdit::Rename { kept: 1, name: name.to_owned() });
    };
    rename(&mut session, "  slow integral ");
    assert_eq!(names(&session)[1], "slow integral", "without the spaces around it");
    for (name, why) in
        [("", "is needed"), ("proportional", "another kept design"), ("chosen", "the chosen design")]
    {
        rename(&mut session, name);
        let draft = session.draft(&Field::KeptName(1)).unwrap();
        assert!(draft.text == name && draft.error.contains(why), "{draft:?}");
        assert_eq!(names(&session)[1], "slow integral", "the last good name stays");
    }
    rename(&mut session, &"x".repeat(10_000));
    assert_eq!(names(&session)[1].len(), 48, "bounded");
    assert!(session.draft(&Field::KeptName(1)).is_none(), "understood");
    rename(&mut session, &format!("{} tail", "x".repeat(47)));
    assert_eq!(names(&session)[1], "x".repeat(47), "no space is left where it is cut");
    assert_eq!(&read_document(&session.document_text()).unwrap(), session.document(), "it reads back");
    compare(&mut session, CompareEdit::Rename { kept: 99, name: "nobody".to_owned() });
    assert_eq!(names(&session).len(), 4, "no such design, no change");
}

#[test]
fn discarding_and_undoing() {
    let mut session = session("comparison");
    let before = names(&session);
    compare(&mut session, CompareEdit::Discard(1));
    assert_eq!(names(&session), [before[0].as_str(), &before[2], &before[3]], "one less");
    compare(&mut session, CompareEdit::Discard(17));
    assert_eq!(names(&session).len(), 3, "no such design");
    update(&mut session, Command::Undo);
    assert_eq!(names(&session), before, "and back");
}

#[test]
fn using_a_kept_design_exchanges_it_with_the_chosen_one() {
    let mut session = session("comparison");
    let (chosen, kept) = (session.document().design.clone(), session.document().kept[2].design.clone());
    edit(&mut session, Edit::Poles("-1, fast".to_owned()));
    assert_eq!(session.n_drafts(), 1, "a list of poles that is not understood");
    compare(&mut session, CompareEdit::Choose(2));
    assert_eq!(session.n_drafts(), 0, "it belonged to the other design");
    assert_eq!(
        (&session.document().design, &session.document().kept[2].design),
        (&kept, &chosen),
        "exchanged"
    );
    assert_eq!(names(&session)[2], "Input-decoupled, full, 2 poles", "under a name of its own");
    compare(&mut session, CompareEdit::Choose(2));
    assert_eq!(
        (&session.document().design, &session.document().kept[2].design),
        (&chosen, &kept),
        "and back"
    );
    update(&mut session, Command::Undo);
    update(&mut session, Command::Undo);
    assert_eq!(names(&session)[2], "PI, general", "as it was");
    compare(&mut session, CompareEdit::Choose(2));
    compare(&mut session, CompareEdit::Choose(2));
    assert_eq!(names(&session)[2], "PI, general", "a name that a person gave comes back with its design");
    compare(&mut session, CompareEdit::Choose(99));
    assert_eq!(session.document().design, chosen, "no such design, no change");
}

#[test]
fn of_two_equal_designs_one_is_enough() {
    let mut session = session("comparison");
    let kept = session.document().kept[1].clone();
    // the chosen design has a place of its own: nothing is lost, and nothing stands there twice
    compare(&mut session, CompareEdit::Keep);
    assert_eq!(names(&session).len(), 5, "kept as the fifth");
    compare(&mut session, CompareEdit::Choose(1));
    assert_eq!(session.document().design, kept.design, "chosen");
    assert_eq!(
        names(&session),
        ["proportional", "PI, general", "H-infinity", "Input-decoupled, full, 2 poles"],
        "the one that was chosen stays where it is"
    );
    // the chosen design itself is kept: using it changes nothing, not even its name
    compare(&mut session, CompareEdit::Keep);
    let last = names(&session).len() - 1;
    assert_eq!(names(&session)[last], "PI, full", "kept under its name");
    let before = session.document().clone();
    compare(&mut session, CompareEdit::Choose(last));
    assert_eq!(session.document(), &before, "nothing to exchange");
}

#[test]
fn a_name_of_the_greatest_length_still_finds_room_for_a_number() {
    let mut session = session("comparison");
    compare(&mut session, CompareEdit::Rename { kept: 1, name: "x".repeat(48) });
    compare(&mut session, CompareEdit::Choose(1));
    let other = session.document().kept[0].clone();
    compare(&mut session, CompareEdit::Rename { kept: 0, name: "x".repeat(48) });
    compare(&mut session, CompareEdit::Keep);
    let name = names(&session)[4].clone();
    assert!(name.ends_with("x (2)") && name.chars().count() <= 48, "{name}");
    assert_eq!(
        session.document().kept[0].design,
        other.design,
        "the other one has the name without a number"
    );
    assert!(read_document(&session.document_text()).is_ok(), "and the document reads back");
}

#[test]
fn kept_designs_have_poles_enough_for_a_network_that_grows() {
    let mut session = session("hierarchical");
    compare(&mut session, CompareEdit::Keep);
    edit(&mut session, Edit::Method(Method::Proportional));
    edit(&mut session, Edit::Order(Order::Full));
    compare(&mut session, CompareEdit::Keep);
    edit(&mut session, Edit::Network(NetworkEdit::Size { of: NetworkSize::States, grow: true }));
    let PlantData::Network(data) = &session.document().plant else { panic!("it is a network") };
    let (n, states) = (data.a.shape().0, data.states());
    let kept = &session.document().kept;
    assert!(kept[0].design.local_poles.len() >= n, "a pole for each state of a subsystem: {:?}", kept[0]);
    assert!(kept[1].design.poles.len() >= states, "a pole for each state: {:?}", kept[1]);
}

#[test]
fn another_tolerance_that_changes_a_rank_provides_poles_for_all_designs() {
    let text = r#"{"descry":1,"system":{"E":[[1,0],[0,1e-9]],"A":[[-1,0],[0,-1]],"C":[[1,0],[0,1]],"D":[[1],[0]]},
        "design":{"method":"proportional","poles":[-2]},"tolerance":{"rank":1e9},
        "compare":[{"name":"kept","design":{"method":"proportional","poles":[-3]}}]}"#;
    let mut session = Session::new(read_document(text).unwrap());
    edit(&mut session, Edit::RankTolerance(8.0));
    assert_eq!(session.document().design.poles.len(), 2, "E has rank 2 now");
    assert_eq!(session.document().kept[0].design.poles.len(), 2, "for the kept design, too");
}

#[test]
fn a_document_with_a_name_that_cannot_be_is_refused_with_a_reason() {
    let document = |name: &str| {
        let text = format!(
            r#"{{"descry":1,"system":{{"E":[[1]],"A":[[-1]],"C":[[1]]}},
            "compare":[{{"name":"{name}","design":{{"method":"proportional","poles":[-2]}}}}]}}"#
        );
        read_document(&text)
    };
    for (name, why) in [
        ("", "a name is needed"),
        ("   ", "a name is needed"),
        ("chosen", "the name of the chosen design"),
        (&"x".repeat(20_000), "20000 characters, and at most 48"),
    ] {
        let error = document(name).unwrap_err().to_string();
        assert!(error.contains(why) && error.contains("compare[1].name"), "{error}");
    }
    assert_eq!(document("  slow ").unwrap().kept[0].name, "slow", "without the spaces around it");
}

#[test]
fn kept_designs_follow_a_plant_that_grows() {
    let mut session = session("proportional-integral");
    compare(&mut session, CompareEdit::Keep);
    edit(&mut session, Edit::Method(Method::Proportional));
    edit(&mut session, Edit::Order(Order::Full));
    let before = session.document().kept[0].design.poles.len();
    assert_eq!(before, 5, "five poles are given");
    for _ in 0..4 {
        edit(&mut session, Edit::Size { of: Size::UnknownInputs, grow: true });
    }
    let poles = &session.document().kept[0].design.poles;
    assert!(poles.len() >= 6, "rank E + 4 of them, and one more: {}", poles.len());
    assert_eq!(poles[..2], [-22.0, -18.0].map(Complex64::from), "those that were there stay");
}

#[test]
fn lists_of_states_of_kept_designs_follow_a_plant_that_shrinks() {
    let mut session = session("decentralized");
    compare(&mut session, CompareEdit::Keep);
    edit(&mut session, Edit::Method(Method::Proportional));
    assert_eq!(
        session.document().kept[0].design.lmi.decoupled,
        Some(vec![vec![3], vec![0]]),
        "as in the paper"
    );
    for _ in 0..3 {
        edit(&mut session, Edit::Size { of: Size::States, grow: false });
    }
    let text = session.document_text();
    let read: Document = read_document(&text).unwrap_or_else(|error| panic!("{error}: {text}"));
    let lists = read.kept[0].design.lmi.decoupled.clone();
    assert_eq!(lists, Some(vec![vec![], vec![0]]), "x4 is gone, x1 is there");
}

/// Performs everything that is asked for; what was asked.
fn settle(session: &Session, derived: &mut Derived) -> Vec<Task> {
    let mut asked = Vec::new();
    while let Some(request) = derived.next_request(session) {
        asked.push(request.task.clone());
        derived.receive(perform(&request, &Watch::none()).unwrap());
    }
    asked
}

#[test]
fn a_comparison_is_computed_only_while_it_is_shown() {
    let mut session = session("comparison");
    let mut derived = Derived::default();
    assert_eq!(settle(&session, &mut derived), [Task::Analyse], "nobody looks at the comparison");
    update(&mut session, Command::Show(Show::Tab(Tab::Compare)));
    assert_eq!(settle(&session, &mut derived), [Task::Compare], "now somebody does");
    assert!(derived.is_compared(session.revision()), "up to date");
    let view = derived.comparison().unwrap().unwrap();
    assert_eq!(view.comparison.rows.len(), 5, "the chosen design and four more");
    for figure in ComparedFigure::ALL {
        assert!(figure.of(&view.figures).is_some(), "{figure:?}");
    }
    compare(&mut session, CompareEdit::Discard(0));
    assert!(!derived.is_compared(session.revision()), "out of date");
    assert_eq!(settle(&session, &mut derived), [Task::Analyse, Task::Compare], "after the analysis");
    assert_eq!(derived.comparison().unwrap().unwrap().comparison.rows.len(), 4, "one less");
}

#[test]
fn a_comparison_that_was_stopped_is_not_started_by_itself() {
    let mut session = session("comparison");
    let mut derived = Derived::default();
    settle(&session, &mut derived);
    update(&mut session, Command::Show(Show::Tab(Tab::Compare)));
    let request = derived.next_request(&session).unwrap();
    let watch = Watch::new(|fraction, _| fraction < 0.2);
    assert!(perform(&request, &watch).is_none(), "stopped on the way");
    derived.cancelled();
    assert_eq!(derived.comparison(), Some(Err("cancelled")), "says so");
    assert!(derived.next_request(&session).is_none(), "and waits");
    derived.again();
    assert_eq!(settle(&session, &mut derived), [Task::Compare], "until somebody asks again");
}

#[test]
fn a_comparison_that_is_stopped_leaves_the_last_table() {
    let mut session = session("comparison");
    update(&mut session, Command::Show(Show::Tab(Tab::Compare)));
    let mut derived = Derived::default();
    settle(&session, &mut derived);
    let rows = derived.comparison().unwrap().unwrap().comparison.rows.len();
    compare(&mut session, CompareEdit::Discard(0));
    let request = derived.next_request(&session).unwrap();
    derived.receive(perform(&request, &Watch::none()).unwrap());
    assert_eq!(derived.next_request(&session).unwrap().task, Task::Compare, "the analysis is there");
    derived.cancelled();
    let view = derived.comparison().unwrap().unwrap();
    assert_eq!(view.comparison.rows.len(), rows, "the last results stay");
    assert!(!derived.is_compared(session.revision()), "though they belong to an earlier document");
    assert!(
        derived.was_cancelled() && derived.next_request(&session).is_none(),
        "and nothing starts by itself"
    );
    derived.again();
    assert_eq!(settle(&session, &mut derived), [Task::Compare], "until somebody asks again");
    assert_eq!(derived.comparison().unwrap().unwrap().comparison.rows.len(), rows - 1, "the new table");
}

#[test]
fn nothing_else_starts_where_the_analysis_was_stopped() {
    for tab in [Tab::Compare, Tab::TradeOff, Tab::Figures, Tab::States] {
        let mut session = session("comparison");
        update(&mut session, Command::Show(Show::Tab(tab)));
        let mut derived = Derived::default();
        assert_eq!(
            derived.next_request(&session).unwrap().task,
            Task::Analyse,
            "{tab:?}: the analysis first"
        );
        derived.cancelled();
        assert_eq!(derived.next_request(&session), None, "{tab:?}: the same design would be made again");
        derived.again();
        assert_eq!(settle(&session, &mut derived)[0], Task::Analyse, "{tab:?}: until somebody asks again");
    }
}

#[test]
fn of_a_plant_that_is_none_the_comparison_says_why() {
    let mut session = session("unseen-impulse");
    compare(&mut session, CompareEdit::Keep);
    update(&mut session, Command::Show(Show::Tab(Tab::Compare)));
    let mut derived = Derived::default();
    settle(&session, &mut derived);
    let view = derived.comparison().unwrap().unwrap();
    assert!(view.comparison.rows.iter().all(|row| row.outcome.is_err()), "condition (9) fails for both");
    assert_eq!(view.figures.all().count(), 0, "nothing to draw");
}
