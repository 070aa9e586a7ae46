//! The application without a screen, driven by commands as a person drives it.
#![cfg(not(target_arch = "wasm32"))]
#![expect(clippy::unwrap_used, clippy::panic, reason = "helpers of tests fail by panicking")]

use std::collections::BTreeSet;

use descry::document::{Document, EntryMatrix, Matrix, PlantData, Subject, read_document, write_document};
use descry::numerics::{Complex64, Watch};
use descry::observer::{GivenObserver, Method, Order, Verdict, assess, assess_network};
use descry::paper::EXAMPLES;
use descry::session::{
    Analysis, Cell, Command, CompareEdit, Derived, Edit, Field, Fill, FreeEdit, GivenPart, JobReply,
    JobRequest, LipschitzEdit, LipschitzMatrix, LmiEdit, Outcome, PartitionEdit, Session, Share, Show,
    SignalList, Size, Tab, Task, perform, update,
};
use descry::system::TimeDomain;
use proptest::prelude::*;

/// Documents of every kind: partitioned, rectangular, with a Lipschitz term, a network.
const DOCUMENTS: [&str; 4] = [
    include_str!("documents/000-partition.json"),
    include_str!("documents/001-wide.json"),
    include_str!("documents/002-lipschitz.json"),
    include_str!("documents/003-network.json"),
];

fn session() -> Session {
    Session::with_first_example().unwrap()
}

fn opened(key: &str) -> Session {
    let mut session = session();
    update(&mut session, Command::OpenExample { key: key.to_owned() });
    session
}

fn edit(session: &mut Session, edit: Edit) {
    update(session, Command::Edit(edit));
}

fn cell(matrix: Matrix, row: usize, column: usize) -> Cell {
    Cell { matrix, row, column }
}

fn type_into(session: &mut Session, cell: Cell, text: &str) {
    edit(session, Edit::Cell { cell, text: text.to_owned() });
}

fn matrix(document: &Document, matrix: Matrix) -> &EntryMatrix {
    match &document.plant {
        PlantData::Descriptor(data) => data.matrix(matrix),
        PlantData::Network(_) => panic!("the examples are given by matrices"),
    }
}

fn value(session: &Session, at: Cell) -> f64 {
    matrix(session.document(), at.matrix).entry(at.row, at.column).unwrap().value
}

/// What holds after every command: matrices that fit, and a document that reads back as it was written.
fn check(session: &Session, after: &str) {
    let document = session.document();
    match document.subject().unwrap_or_else(|error| panic!("after {after}: {error}")) {
        Subject::Model(model) => {
            assert_eq!(model.system.A.shape(), model.system.E.shape(), "after {after}: A is as large as E");
        }
        Subject::Network(network) => assert!(network.checked().is_ok(), "after {after}: the matrices fit"),
    }
    let text = write_document(document);
    let again = read_document(&text).unwrap_or_else(|error| panic!("after {after}: {error}\n{text}"));
    assert_eq!(again, *document, "after {after}: write, then read");
}

fn analysis(session: &Session) -> Analysis {
    let mut derived = Derived::default();
    let request = derived.next_request(session).unwrap();
    match perform(&request, &Watch::none()).unwrap().outcome {
        Outcome::Analysis(analysis) => *analysis,
        other => panic!("no analysis: {other:?}"),
    }
}

#[test]
fn a_cell_takes_numbers_and_expressions() {
    let mut session = session();
    let at = cell(Matrix::A, 0, 0);
    type_into(&mut session, at, "-2.5");
    assert_eq!(value(&session, at), -2.5, "a number");
    type_into(&mut session, at, "-1/3");
    assert_eq!(value(&session, at), -1.0 / 3.0, "an expression");
    assert_eq!(matrix(session.document(), Matrix::A).entry(0, 0).unwrap().shown(), "-1/3", "as it was typed");
    check(&session, "an expression");
}

#[test]
fn a_bad_cell_keeps_its_text_and_the_value() {
    let mut session = session();
    let (at, before, revision) = (cell(Matrix::A, 0, 2), 1.0, session.revision());
    type_into(&mut session, at, "1/");
    assert_eq!(value(&session, at), before, "the last good value stays in force");
    assert_eq!(session.draft(&Field::Cell(at)).unwrap().text, "1/", "the text is kept");
    assert!(!session.draft(&Field::Cell(at)).unwrap().error.is_empty(), "it says what is wrong");
    assert_eq!((session.revision(), session.can_undo()), (revision, false), "nothing changed");
    type_into(&mut session, at, "1/0");
    assert_eq!(session.n_drafts(), 1, "infinity is no entry");
    type_into(&mut session, at, "1/2");
    assert_eq!((session.n_drafts(), value(&session, at)), (0, 0.5), "the next good text clears it");
}

#[test]
fn every_size_grows_and_shrinks_with_all_matrices() {
    for of in [Size::States, Size::Equations, Size::Inputs, Size::Outputs, Size::UnknownInputs] {
        let mut session = session();
        for step in 0..3 {
            edit(&mut session, Edit::Size { of, grow: true });
            check(&session, &format!("{of:?} grew {step}"));
        }
        let mut refused = false;
        for step in 0..12 {
            let before = session.revision();
            edit(&mut session, Edit::Size { of, grow: false });
            check(&session, &format!("{of:?} shrank {step}"));
            refused |= session.revision() == before && session.message().is_some_and(|m| m.error);
        }
        assert!(refused, "{of:?}: at the end it says that there is none left");
    }
}

#[test]
fn grown_and_shrunk_again_is_the_same_system() {
    for of in [Size::States, Size::Inputs, Size::Outputs, Size::UnknownInputs] {
        let mut session = session();
        let before = session.document().plant.clone();
        edit(&mut session, Edit::Size { of, grow: true });
        edit(&mut session, Edit::Size { of, grow: false });
        assert_eq!(session.document().plant, before, "{of:?}");
    }
}

#[test]
fn every_method_and_order_gets_enough_poles() {
    for example in EXAMPLES {
        for method in Method::ALL {
            for order in Order::ALL {
                let mut session = opened(example.key);
                edit(&mut session, Edit::Poles("-3".to_owned()));
                edit(&mut session, Edit::Method(method));
                edit(&mut session, Edit::Order(order));
                check(&session, &format!("{method:?}, {order:?}"));
                if method.uses_lmi() {
                    continue;
                }
                let Document { design: choice, tolerance, .. } = session.document();
                let found = match session.document().subject().unwrap() {
                    Subject::Model(model) => assess(&model, choice, tolerance, &Watch::none()),
                    Subject::Network(network) => assess_network(&network, choice, tolerance),
                };
                let Ok(assessment) = found else { continue };
                if let Err(error) = assessment.outcome {
                    let poles = error.is_bad_input();
                    assert!(!poles, "{}: {method:?} {order:?}: {error}", example.key);
                }
            }
        }
    }
}

#[test]
fn a_drag_is_one_step_back() {
    let mut session = session();
    let before = session.document().clone();
    for k in 1..=20 {
        let to = Complex64::new(-22.0 - f64::from(k), 0.0);
        edit(&mut session, Edit::MovePole { index: 0, to, done: k == 20 });
    }
    assert_eq!(session.document().design.poles[0].re, -42.0, "it arrived");
    let dragged = session.document().clone();
    edit(&mut session, Edit::MovePole { index: 0, to: Complex64::from(-50.0), done: true });
    update(&mut session, Command::Undo);
    assert_eq!(*session.document(), dragged, "the second drag is a step of its own");
    update(&mut session, Command::Undo);
    assert_eq!((*session.document() == before, session.can_undo()), (true, false), "the first was one step");
    update(&mut session, Command::Redo);
    assert_eq!(*session.document(), dragged, "and one step forward");
}

#[test]
fn a_bad_document_changes_nothing() {
    let mut session = session();
    let before = session.document().clone();
    for text in
        ["", "{", "{}", "[1]", "{\"descry\":99}", "{\"descry\":1,\"system\":{\"E\":[[1]],\"A\":[[1,2]]}}"]
    {
        update(&mut session, Command::Open { text: text.to_owned() });
        let message = session.message().unwrap();
        assert!(message.error && !message.text.is_empty(), "{text}: the reason is told");
        assert_eq!(
            (*session.document() == before, session.can_undo()),
            (true, false),
            "{text}: nothing changed"
        );
    }
    update(&mut session, Command::OpenExample { key: "none".to_owned() });
    assert!(session.message().unwrap().error, "an unknown example");
}

#[test]
fn opening_can_be_undone() {
    let mut session = session();
    let before = session.document().clone();
    update(&mut session, Command::OpenExample { key: EXAMPLES[1].key.to_owned() });
    assert_ne!(*session.document(), before, "another document");
    update(&mut session, Command::Undo);
    assert_eq!(*session.document(), before, "and back");
    let known = |id: &String| before.figures.iter().any(|figure| figure.id == *id);
    assert!(session.view().figure.as_ref().is_some_and(known), "a figure of this document is chosen");
}

#[test]
fn blocks_from_other_programs_are_pasted() {
    for (from, text) in [
        ("MATLAB", "[1 2; 3 4]"),
        ("MATLAB with commas", "A = [1, 2;\n3, 4];"),
        ("Excel", "1\t2\n3\t4\n"),
        ("Excel on Windows", "1\t2\r\n3\t4\r\n"),
        ("NumPy", "array([[1., 2.], [3., 4.]])"),
    ] {
        let mut session = session();
        let at = cell(Matrix::A, 1, 1);
        edit(&mut session, Edit::Paste { cell: at, text: text.to_owned() });
        let found = [(1, 1), (1, 2), (2, 1), (2, 2)].map(|(i, j)| value(&session, cell(Matrix::A, i, j)));
        assert_eq!(found, [1.0, 2.0, 3.0, 4.0], "{from}: from the active cell on");
        check(&session, from);
    }
}

#[test]
fn a_larger_block_replaces_the_matrix_and_resizes_the_system() {
    for at in Matrix::ALL {
        let mut session = session();
        let rows: Vec<String> = (0..6).map(|i| format!("{i} 1 2 3 4 5 6")).collect();
        edit(&mut session, Edit::Paste { cell: cell(at, 0, 0), text: rows.join("\n") });
        assert_eq!(matrix(session.document(), at).shape(), (6, 7), "{}", at.letter());
        check(&session, at.letter());
    }
    let mut session = session();
    let before = session.document().clone();
    let text = vec!["1"; 101].join(" ");
    edit(&mut session, Edit::Paste { cell: cell(Matrix::A, 0, 0), text });
    assert_eq!(*session.document(), before, "more columns than are possible");
    assert!(session.message().unwrap().error, "it is told");
    edit(&mut session, Edit::Paste { cell: cell(Matrix::A, 0, 0), text: "no matrix, just words".to_owned() });
    assert_eq!(*session.document(), before, "words are no matrix");
}

#[test]
fn one_more_sensor_mends_the_unseen_impulse() {
    let mut session = opened("unseen-impulse");
    let failing = analysis(&session).assessment.unwrap();
    let fails = failing.conditions.iter().any(|c| c.needed && c.verdict == Verdict::Fails);
    assert!(fails && failing.outcome.is_err(), "a condition fails before");
    edit(&mut session, Edit::AddSensor { state: 2 });
    check(&session, "the sensor");
    let mended = analysis(&session);
    assert!(mended.verified(), "with the sensor: {:?}", mended.assessment.map(|a| a.outcome.err()));
}

#[test]
fn a_network_keeps_its_matrices_and_takes_the_rest() {
    let mut session = session();
    update(&mut session, Command::Open { text: DOCUMENTS[3].to_owned() });
    let plant = session.document().plant.clone();
    assert!(matches!(plant, PlantData::Network(_)), "a network is open");
    type_into(&mut session, cell(Matrix::A, 0, 0), "1");
    assert!(session.message().unwrap().error, "it says why nothing changed");
    for one in [
        Edit::Size { of: Size::States, grow: true },
        Edit::Initial { state: 0, text: "1".to_owned() },
        Edit::Signal { list: SignalList::Unknown, index: 0, text: "sin(t)".to_owned() },
        Edit::UncertaintyScale { scale: 2.0, done: true },
        Edit::UncertaintyCell { row: 0, column: 0, frequency: true, text: "1".to_owned() },
        Edit::NoiseLevel { deviation: 0.1, done: true },
    ] {
        let name = format!("{one:?}");
        edit(&mut session, one);
        check(&session, &name);
    }
    assert_eq!(session.document().plant, plant, "the network is as it was");
    let _found = analysis(&session);
}

fn reply(request: &JobRequest) -> JobReply {
    perform(request, &Watch::none()).unwrap()
}

#[test]
fn replies_that_nobody_waits_for_are_dropped() {
    let mut session = session();
    let mut derived = Derived::default();
    let first = derived.next_request(&session).unwrap();
    assert!(derived.next_request(&session).is_none(), "one at a time");
    derived.cancelled();
    derived.receive(reply(&first));
    assert!(derived.analysis().is_none(), "a cancelled one is not heard");
    assert!(derived.next_request(&session).is_none(), "nor started again by itself");
    type_into(&mut session, cell(Matrix::A, 0, 0), "-1");
    let second = derived.next_request(&session).unwrap();
    derived.receive(reply(&first));
    assert!(derived.analysis().is_none(), "the number of the request counts");
    type_into(&mut session, cell(Matrix::A, 0, 0), "-2");
    derived.receive_timed(reply(&second), Some(12.0));
    assert!(derived.analysis().is_some(), "an older revision is better than none");
    assert_eq!(derived.elapsed_ms(), Some(12.0), "its duration is kept");
    assert!(!derived.is_current(session.revision()), "but it is not called current");
    let third = derived.next_request(&session).unwrap();
    derived.receive(reply(&third));
    assert!(derived.is_current(session.revision()), "the newest revision");
    assert!(derived.next_request(&session).is_none(), "all is up to date");
}

#[test]
fn the_chosen_figure_is_computed_when_it_is_on_screen() {
    let mut session = session();
    let mut derived = Derived::default();
    let first = derived.next_request(&session).unwrap();
    derived.receive(reply(&first));
    assert!(derived.next_request(&session).is_none(), "no figure is on screen");
    update(&mut session, Command::Show(Show::Tab(Tab::Figures)));
    let request = derived.next_request(&session).unwrap();
    assert!(matches!(request.task, Task::Figure { .. }), "now it is");
    derived.receive(reply(&request));
    let id = session.view().figure.clone().unwrap();
    assert!(derived.figure(&id).unwrap().is_ok(), "it is there");
}

#[test]
fn the_sweep_is_computed_when_it_is_on_screen() {
    let (mut session, mut derived) = (session(), Derived::default());
    let first = derived.next_request(&session).unwrap();
    derived.receive(perform(&first, &Watch::none()).unwrap());
    update(&mut session, Command::Show(Show::Tab(Tab::TradeOff)));
    assert!(derived.trade_off().is_none(), "not asked yet");
    let request = derived.next_request(&session).unwrap();
    derived.receive(perform(&request, &Watch::none()).unwrap());
    let figure = derived.trade_off().unwrap().as_ref().unwrap();
    assert_eq!(figure.panels.len(), 3, "gained, cost, one against the other");
    assert!(derived.next_request(&session).is_none(), "once for each revision");
}

#[test]
fn progress_can_stop_a_computation() {
    let session = session();
    let request = Derived::default().next_request(&session).unwrap();
    assert!(perform(&request, &Watch::new(|_, _| false)).is_none(), "stopped at the first report");
}

#[test]
fn a_damaged_request_fails_with_a_reason() {
    let request = JobRequest {
        id: 1,
        revision: 1,
        document: "{".to_owned(),
        task: Task::Figure { id: "x".to_owned() },
    };
    assert!(
        matches!(reply(&request).outcome, Outcome::Failed(why) if !why.is_empty()),
        "unreadable document"
    );
}

// ---- Random hands --------------------------------------------------------------------------------------------------

/// What people type, good and bad.
fn typed() -> impl Strategy<Value = String> {
    prop_oneof![
        4 => (-50_i32..50).prop_map(|n| n.to_string()),
        2 => (-5.0..5.0_f64).prop_map(|x| x.to_string()),
        1 => Just("-1/3".to_owned()),
        1 => Just("1e-300".to_owned()),
        1 => Just("-0".to_owned()),
        1 => Just("1e300".to_owned()),
        1 => Just("2*pi".to_owned()),
        1 => Just("5+2*sin(4*t)".to_owned()),
        1 => Just("step(t-1)*noise(t, 3)".to_owned()),
        1 => Just("1/0".to_owned()),
        1 => Just(String::new()),
        1 => ".{0,12}",
    ]
}

fn a_matrix() -> impl Strategy<Value = Matrix> {
    prop::sample::select(Matrix::ALL.to_vec())
}

fn a_cell() -> impl Strategy<Value = Cell> {
    (a_matrix(), 0..7_usize, 0..7_usize).prop_map(|(matrix, row, column)| Cell { matrix, row, column })
}

fn number() -> impl Strategy<Value = f64> {
    prop_oneof![
        -100.0..100.0_f64,
        Just(0.0),
        Just(-0.0),
        Just(f64::NAN),
        Just(f64::INFINITY),
        Just(1e300),
        Just(1e-300)
    ]
}

fn a_size() -> impl Strategy<Value = Edit> {
    let sizes = vec![Size::States, Size::Equations, Size::Inputs, Size::Outputs, Size::UnknownInputs];
    (prop::sample::select(sizes), any::<bool>()).prop_map(|(of, grow)| Edit::Size { of, grow })
}

fn a_plant_edit() -> impl Strategy<Value = Edit> {
    let fill = prop_oneof![
        Just(Fill::Zero),
        Just(Fill::Identity),
        any::<u64>().prop_map(|seed| Fill::Random { seed }),
        number().prop_map(Fill::Scaled)
    ];
    prop_oneof![
        4 => (a_cell(), typed()).prop_map(|(cell, text)| Edit::Cell { cell, text }),
        4 => a_size(),
        1 => (a_cell(), prop::collection::vec(prop::collection::vec(-9..9_i32, 1..7), 1..7)).prop_map(|(cell, rows)| {
            let row = |row: &Vec<i32>| row.iter().map(ToString::to_string).collect::<Vec<_>>().join("\t");
            Edit::Paste { cell, text: rows.iter().map(row).collect::<Vec<_>>().join("\n") }
        }),
        1 => (a_cell(), typed()).prop_map(|(cell, text)| Edit::Paste { cell, text }),
        1 => (a_matrix(), fill).prop_map(|(matrix, fill)| Edit::Fill { matrix, fill }),
        1 => (0..9_usize).prop_map(|state| Edit::AddSensor { state }),
        1 => any::<bool>().prop_map(|d| Edit::Time(if d { TimeDomain::Discrete } else { TimeDomain::Continuous })),
    ]
}

fn a_design_edit() -> impl Strategy<Value = Edit> {
    let poles = prop_oneof![
        Just("-1+2i, -1-2i".to_owned()),
        Just("-1, -2, -3, -4, -5".to_owned()),
        Just("0 0 0".to_owned()),
        Just("1e300".to_owned()),
        typed()
    ];
    prop_oneof![
        prop::sample::select(Method::ALL.to_vec()).prop_map(Edit::Method),
        prop::sample::select(Order::ALL.to_vec()).prop_map(Edit::Order),
        poles.prop_map(Edit::Poles),
        (0..9_usize, number(), number(), any::<bool>()).prop_map(|(index, re, im, done)| Edit::MovePole {
            index,
            to: Complex64::new(re, im),
            done
        }),
        (number(), any::<bool>()).prop_map(|(scale, done)| Edit::Scale { scale, done }),
        number().prop_map(Edit::RankTolerance),
        ".{0,20}".prop_map(Edit::Title),
        ".{0,20}".prop_map(Edit::Notes),
    ]
}

fn an_lmi_edit() -> impl Strategy<Value = Edit> {
    let maybe = || prop::option::of(number());
    let rows = (1..4_usize, 1..7_usize).prop_map(|(r, c)| nalgebra::DMatrix::identity(r, c));
    let given = (1..4_usize, 0..4_usize).prop_map(|(q, p)| GivenObserver {
        N: nalgebra::DMatrix::identity(q, q),
        J: nalgebra::DMatrix::zeros(q, p),
        gamma: None,
    });
    let texts = prop_oneof![Just("[-1 2; 0 -3]".to_owned()), Just("[1; 2]".to_owned()), typed()];
    let part = prop::sample::select(vec![GivenPart::N, GivenPart::J, GivenPart::Gamma]);
    let lists = prop::option::of(prop::collection::vec(prop::collection::vec(0..6_usize, 0..3), 0..4));
    prop_oneof![
        (maybe(), any::<bool>()).prop_map(|(decay, done)| LmiEdit::Decay { decay, done }),
        (maybe(), any::<bool>()).prop_map(|(gain, done)| LmiEdit::Gain { gain, done }),
        (maybe(), any::<bool>()).prop_map(|(gamma, done)| LmiEdit::Gamma { gamma, done }),
        (number(), any::<bool>())
            .prop_map(|(conditioning, done)| LmiEdit::Conditioning { conditioning, done }),
        (number(), any::<bool>()).prop_map(|(back_off, done)| LmiEdit::BackOff { back_off, done }),
        (number(), any::<bool>()).prop_map(|(seconds, done)| LmiEdit::Seconds { seconds, done }),
        any::<bool>().prop_map(LmiEdit::Alternative),
        prop::collection::vec(rows, 0..3).prop_map(LmiEdit::Rows),
        (0..3_usize, 0..3_usize, 0..6_usize, typed()).prop_map(|(subsystem, row, column, text)| {
            LmiEdit::RowsCell { subsystem, row, column, text }
        }),
        (0..3_usize, texts.clone()).prop_map(|(subsystem, text)| LmiEdit::RowsPaste { subsystem, text }),
        lists.prop_map(LmiEdit::Decoupled),
        (0..3_usize, 0..8_usize, any::<bool>()).prop_map(|(subsystem, state, exactly)| LmiEdit::Decouple {
            subsystem,
            state,
            exactly
        }),
        prop::option::of(given).prop_map(LmiEdit::Examine),
        (part, texts).prop_map(|(part, text)| LmiEdit::Given { part, text }),
    ]
    .prop_map(Edit::Lmi)
}

fn a_partition_edit() -> impl Strategy<Value = Edit> {
    let share = prop::sample::select(vec![Share::States, Share::Equations, Share::Outputs]);
    prop_oneof![
        3 => (0..4_usize).prop_map(|subsystem| PartitionEdit::Split { subsystem }),
        1 => (0..4_usize).prop_map(|subsystem| PartitionEdit::Join { subsystem }),
        1 => Just(PartitionEdit::Clear),
        1 => (0..4_usize, ".{0,9}").prop_map(|(subsystem, name)| PartitionEdit::Name { subsystem, name }),
        4 => (0..3_usize, share, 0..8_usize, any::<bool>()).prop_map(|(border, share, to, done)| {
            PartitionEdit::Move { border, share, to, done }
        }),
    ]
    .prop_map(Edit::Partition)
}

fn a_lipschitz_edit() -> impl Strategy<Value = Edit> {
    let matrix = || prop::sample::select(vec![LipschitzMatrix::G, LipschitzMatrix::Arguments]);
    let f = prop_oneof![Just("sin(x2)+x3".to_owned()), Just("x1*cos(t)".to_owned()), typed()];
    prop_oneof![
        2 => Just(LipschitzEdit::Add),
        1 => Just(LipschitzEdit::Remove),
        2 => (matrix(), 0..4_usize, 0..6_usize, typed()).prop_map(|(matrix, row, column, text)| {
            LipschitzEdit::Cell { matrix, row, column, text }
        }),
        3 => (0..3_usize, f).prop_map(|(index, text)| LipschitzEdit::Component { index, text }),
        1 => typed().prop_map(LipschitzEdit::Constant),
        2 => (matrix(), any::<bool>()).prop_map(|(of, grow)| LipschitzEdit::Size { of, grow }),
    ]
    .prop_map(Edit::Lipschitz)
}

fn a_free_edit() -> impl Strategy<Value = Edit> {
    let whole = (0..3_usize, 1..7_usize, number())
        .prop_map(|(rows, columns, value)| nalgebra::DMatrix::from_element(rows, columns, value));
    let pasted = prop_oneof![Just("1 2 3 4".to_owned()), Just("[1 0 0 0; 0 1 0 -1/3]".to_owned()), typed()];
    prop_oneof![
        2 => (0..4_usize, typed()).prop_map(|(index, text)| FreeEdit::Signal { index, text }),
        2 => (0..3_usize, 0..7_usize, typed()).prop_map(|(row, column, text)| FreeEdit::Cell { row, column, text }),
        1 => prop::option::of(whole).prop_map(FreeEdit::Feedback),
        1 => pasted.prop_map(FreeEdit::Paste),
    ]
    .prop_map(Edit::Free)
}

fn a_scenario_edit() -> impl Strategy<Value = Edit> {
    let list = prop::sample::select(vec![SignalList::Known, SignalList::Unknown, SignalList::Noise]);
    prop_oneof![
        (0..7_usize, typed()).prop_map(|(state, text)| Edit::Initial { state, text }),
        (list, 0..4_usize, typed()).prop_map(|(list, index, text)| Edit::Signal { list, index, text }),
        number().prop_map(Edit::Horizon),
        prop_oneof![0..1000_usize, Just(usize::MAX)].prop_map(Edit::Samples),
        (number(), any::<bool>()).prop_map(|(scale, done)| Edit::UncertaintyScale { scale, done }),
        (0..7_usize, 0..7_usize, any::<bool>(), typed()).prop_map(|(row, column, frequency, text)| {
            Edit::UncertaintyCell { row, column, frequency, text }
        }),
        (number(), any::<bool>()).prop_map(|(deviation, done)| Edit::NoiseLevel { deviation, done }),
    ]
}

fn a_compare_edit() -> impl Strategy<Value = Edit> {
    prop_oneof![
        4 => Just(CompareEdit::Keep),
        2 => (0..4_usize, ".{0,60}").prop_map(|(kept, name)| CompareEdit::Rename { kept, name }),
        1 => (0..4_usize).prop_map(CompareEdit::Discard),
        2 => (0..4_usize).prop_map(CompareEdit::Choose),
    ]
    .prop_map(Edit::Compare)
}

fn a_command() -> impl Strategy<Value = Command> {
    let keys: Vec<String> = EXAMPLES.iter().map(|example| example.key.to_owned()).collect();
    prop_oneof![
        6 => a_plant_edit().prop_map(Command::Edit),
        4 => a_design_edit().prop_map(Command::Edit),
        3 => an_lmi_edit().prop_map(Command::Edit),
        3 => a_partition_edit().prop_map(Command::Edit),
        3 => a_lipschitz_edit().prop_map(Command::Edit),
        4 => a_scenario_edit().prop_map(Command::Edit),
        3 => a_free_edit().prop_map(Command::Edit),
        3 => a_compare_edit().prop_map(Command::Edit),
        1 => Just(Command::Undo),
        1 => Just(Command::Redo),
        1 => prop::sample::select(keys).prop_map(|key| Command::OpenExample { key }),
        1 => ".{0,30}".prop_map(|text| Command::Open { text }),
        2 => prop::sample::select(DOCUMENTS.to_vec()).prop_map(|text| Command::Open { text: text.to_owned() }),
        1 => prop::sample::select(Tab::ALL.to_vec()).prop_map(|tab| Command::Show(Show::Tab(tab))),
    ]
}

#[test]
fn a_subsystem_that_is_not_there_is_not_divided() {
    let text = r#"{"descry":1,"system":{"E":[[0,0,0,0],[0,0,0,0]],"A":[[1,0,0,0],[0,0,0,1]],"C":[[0,0,0,0]],"partition":[
        {"states":2,"equations":2,"outputs":1},{"states":2,"equations":0,"outputs":0}]},"design":{"method":"decentralized"}}"#;
    let mut session = Session::new(read_document(text).unwrap());
    let before = session.document().clone();
    edit(&mut session, Edit::Partition(PartitionEdit::Split { subsystem: 2 }));
    assert_eq!(session.document(), &before, "two subsystems, and no third one");
    let message = session.message().unwrap();
    assert!(message.error && message.text == "there is no subsystem 3", "{message:?}");
}

#[test]
fn a_border_that_cannot_move_says_why_where_equations_are_few() {
    // the second subsystem has no equation left to give
    let text = r#"{"descry":1,"system":{"E":[[1,0,0,0]],"A":[[1,0,0,0]],"C":[[0,1,0,1]],"partition":[
        {"states":1,"equations":1,"outputs":0},{"states":3,"equations":0,"outputs":1}]},"design":{"method":"decentralized"}}"#;
    let mut session = Session::new(read_document(text).unwrap());
    let before = session.document().clone();
    let share = descry::session::Share::States;
    edit(&mut session, Edit::Partition(PartitionEdit::Move { border: 0, share, to: 3, done: true }));
    assert_eq!(session.document(), &before, "the output would lie in both");
    let message = session.message().unwrap();
    assert!(message.error && message.text.contains("cannot lie there"), "{message:?}");
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 64, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn no_sequence_of_commands_breaks_a_session(commands in prop::collection::vec(a_command(), 1..40)) {
        let mut session = session();
        let first = session.document().clone();
        let mut revisions = BTreeSet::from([session.revision()]);
        for command in commands {
            let before = session.document().clone();
            let name = format!("{command:?}");
            update(&mut session, command);
            check(&session, &name);
            let is_new = revisions.insert(session.revision());
            prop_assert!(is_new || *session.document() == before, "after {}: a change has a new revision", name);
        }
        while session.can_redo() {
            update(&mut session, Command::Redo);
        }
        let last = session.document().clone();
        let mut steps = 0;
        while session.can_undo() {
            update(&mut session, Command::Undo);
            steps += 1;
        }
        prop_assert_eq!(session.document(), &first, "undo of all steps gives the first document");
        for _ in 0..steps {
            update(&mut session, Command::Redo);
        }
        prop_assert_eq!(session.document(), &last, "and redo of all steps the last one");
    }

    #[test]
    fn an_edited_system_is_analysed_without_panic(
        edits in prop::collection::vec(prop_oneof![a_plant_edit(), a_design_edit()], 1..8)
    ) {
        let mut session = session();
        edit(&mut session, Edit::Samples(30));
        edit(&mut session, Edit::Horizon(1.0));
        for one in edits {
            edit(&mut session, one);
        }
        let _found = analysis(&session);
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 48, failure_persistence: None, ..ProptestConfig::default() })]

    /// From the wide example on: its figures patch the free variables, too.
    #[test]
    fn an_edited_wide_system_reads_back_and_is_analysed_without_panic(
        edits in prop::collection::vec(
            prop_oneof![2 => a_free_edit(), 2 => a_size(), 1 => a_plant_edit(), 1 => a_design_edit()],
            1..10,
        )
    ) {
        let mut session = opened("input-decoupled");
        edit(&mut session, Edit::Samples(30));
        edit(&mut session, Edit::Horizon(1.0));
        for one in edits {
            let name = format!("{one:?}");
            edit(&mut session, one);
            check(&session, &name);
        }
        let _found = analysis(&session);
    }
}

/// Every pole that the order uses can be pulled off the axis, as a mouse does, and the design stays verified.
#[test]
fn a_used_pole_pulled_off_the_axis_takes_a_used_partner() {
    for (index, order) in [(0, Order::Reduced), (1, Order::Reduced), (2, Order::Reduced), (4, Order::Full)] {
        let mut session = Session::with_first_example().unwrap();
        update(&mut session, Command::Edit(Edit::Order(order)));
        let from = session.document().design.poles[index];
        let to = Complex64::new(from.re, 5.0);
        update(&mut session, Command::Edit(Edit::MovePole { index, to, done: true }));
        let analysis = descry::session::analyse(session.document(), &Watch::none()).unwrap();
        assert!(
            analysis.verified(),
            "pole {index} of {order:?}: {:?}",
            analysis.assessment.map(|a| a.outcome)
        );
    }
}

#[test]
fn a_block_pasted_over_the_edge_grows_the_system() {
    let mut session = Session::with_first_example().unwrap();
    let cell = Cell { matrix: Matrix::A, row: 3, column: 3 };
    update(&mut session, Command::Edit(Edit::Paste { cell, text: "7 8".to_owned() }));
    let system = session.document().system().unwrap();
    assert_eq!((system.n_states(), system.A[(3, 3)], system.A[(3, 4)]), (5, 7.0, 8.0), "one more state");
    assert_eq!(system.A[(2, 0)], -1.0, "nothing is cut");
}
