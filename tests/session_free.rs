//! Plants whose equations are not as many as their states, in the session.
#![cfg(not(target_arch = "wasm32"))]
#![expect(clippy::unwrap_used, clippy::panic, reason = "helpers of tests fail by panicking")]

use descry::document::{
    EntryMatrix, FreeData, Matrix, PlantData, UncertaintyData, read_document, write_document,
};
use descry::numerics::{Complex64, Watch, spectral_distance};
use descry::observer::{Method, Order};
use descry::session::{
    Analysis, Cell, Command, Derived, Edit, Field, FreeEdit, FreeReport, Outcome, Session, Show, Size, Tab,
    analyse, perform, update,
};
use nalgebra::{DMatrix, dmatrix};

fn opened(key: &str) -> Session {
    let mut session = Session::with_first_example().unwrap();
    update(&mut session, Command::OpenExample { key: key.to_owned() });
    session
}

fn wide() -> Session {
    opened("input-decoupled")
}

fn edit(session: &mut Session, edit: Edit) {
    update(session, Command::Edit(edit));
    let document = session.document();
    let again = read_document(&write_document(document)).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(again, *document, "write, then read");
}

fn free(session: &mut Session, change: FreeEdit) {
    edit(session, Edit::Free(change));
}

fn data(session: &Session) -> &FreeData {
    &session.document().scenario.free
}

fn feedback(session: &Session) -> DMatrix<f64> {
    data(session).feedback.as_ref().map(EntryMatrix::values).unwrap()
}

fn analysis(session: &Session) -> Analysis {
    analyse(session.document(), &Watch::none()).unwrap()
}

fn report(session: &Session) -> FreeReport {
    analysis(session).free.unwrap()
}

fn text(text: &str) -> String {
    text.to_owned()
}

#[test]
fn the_analysis_names_what_is_free_and_proposes_the_feedback_of_the_example() {
    let mut session = wide();
    let given = report(&session);
    assert_eq!(given.n_free, 1, "four states, three equations");
    assert_eq!(given.directions, ["v1 = 0.7071 x3 - 0.7071 x4"], "in words");
    assert_eq!(given.constrained, 0, "the unknown input follows its signal");
    let wished = [Complex64::new(-1.0, 1.0), Complex64::new(-1.0, -1.0)];
    assert!(spectral_distance(&given.modes.unwrap(), &wished) < 1e-12, "with the feedback of the document");
    assert!(given.unstable.is_empty(), "bounded");
    let before = feedback(&session);

    free(&mut session, FreeEdit::Feedback(None));
    assert!(data(&session).feedback.is_none(), "off");
    let open = report(&session);
    assert!(spectral_distance(&open.modes.unwrap(), &[1.0, 0.0].map(Complex64::from)) < 1e-12, "x ~ e^t");
    assert_eq!(open.unstable.len(), 2, "the mode at the origin is not stable either");
    let proposed = open.bounding.unwrap();
    assert!(spectral_distance(&proposed.modes, &wished) < 1e-12, "{:?}", proposed.modes);
    free(&mut session, FreeEdit::Feedback(Some(proposed.feedback)));
    let off = (feedback(&session) - before).norm();
    assert!(off < 1e-12, "the gain for these modes is unique: off by {off:.1e}");
    assert!(report(&session).unstable.is_empty(), "bounded again");
}

#[test]
fn signals_and_feedback_are_typed() {
    let mut session = wide();
    free(&mut session, FreeEdit::Signal { index: 0, text: text("cos(t)") });
    assert_eq!(data(&session).signals[0].text(), "cos(t)", "understood");
    free(&mut session, FreeEdit::Signal { index: 0, text: text("cos(") });
    assert_eq!(data(&session).signals[0].text(), "cos(t)", "the last good signal stays in force");
    assert_eq!(session.draft(&Field::FreeSignal(0)).unwrap().text, "cos(", "the text is kept");
    free(&mut session, FreeEdit::Signal { index: 0, text: text("0") });
    assert_eq!(session.n_drafts(), 0, "mended");
    free(&mut session, FreeEdit::Signal { index: 200, text: text("1") });
    assert_eq!(data(&session).signals.len(), 1, "a place that no plant has");

    free(&mut session, FreeEdit::Cell { row: 0, column: 1, text: text("-1/3") });
    assert_eq!(feedback(&session)[(0, 1)], -1.0 / 3.0, "an expression");
    free(&mut session, FreeEdit::Cell { row: 0, column: 0, text: text("1/") });
    assert!(session.draft(&Field::FreeFeedback(0, 0)).is_some(), "not understood");
    let before = feedback(&session);
    free(&mut session, FreeEdit::Feedback(Some(dmatrix![1.0, 2.0])));
    assert!(session.message().unwrap().text.contains("4 columns"), "{:?}", session.message());
    free(&mut session, FreeEdit::Paste(text("1 2 3; 4 5 6")));
    assert!(session.message().unwrap().error, "three columns for four states");
    assert_eq!(feedback(&session), before, "what does not fit changes nothing");
    free(&mut session, FreeEdit::Paste(text("1\t2\t0\t0")));
    assert_eq!(feedback(&session), dmatrix![1.0, 2.0, 0.0, 0.0], "a whole row");
    assert_eq!(session.n_drafts(), 0, "the drafts of its cells are gone");
    update(&mut session, Command::Undo);
    assert_eq!(feedback(&session), before, "one step back");
}

#[test]
fn a_cell_of_a_feedback_that_is_not_there_makes_one() {
    let mut session = wide();
    free(&mut session, FreeEdit::Feedback(None));
    free(&mut session, FreeEdit::Cell { row: 1, column: 2, text: text("7") });
    assert_eq!(feedback(&session), dmatrix![0.0, 0.0, 0.0, 0.0; 0.0, 0.0, 7.0, 0.0], "zeros above it");
    free(&mut session, FreeEdit::Cell { row: 0, column: 9, text: text("7") });
    assert_eq!(feedback(&session)[(1, 2)], 7.0, "a column that no state has is ignored");
}

#[test]
fn the_feedback_follows_the_states_and_signals_wait() {
    let mut session = wide();
    edit(&mut session, Edit::Size { of: Size::States, grow: true });
    assert_eq!(feedback(&session).shape(), (1, 5), "a column for the new state");
    assert_eq!(session.document().system().unwrap().n_equations(), 3, "a wide system keeps its equations");
    let grown = report(&session);
    assert_eq!(grown.n_free, 2, "x5 stands in no equation");
    assert_eq!(grown.directions, ["v1 = 0.7071 x3 - 0.7071 x4", "v2 = x5"], "the new one comes last");
    edit(&mut session, Edit::AddSensor { state: 4 });
    free(&mut session, FreeEdit::Signal { index: 1, text: text("sin(t)") });
    assert!(analysis(&session).simulation.is_ok(), "two free states, one row of feedback: the other is zero");

    edit(&mut session, Edit::Size { of: Size::States, grow: false });
    assert_eq!(feedback(&session).shape(), (1, 4), "and back");
    assert_eq!(data(&session).signals.len(), 2, "the second signal waits");
    let notes = analysis(&session).simulation.unwrap().notes;
    assert!(notes.iter().any(|note| note.contains("the other waits")), "it is told: {notes:?}");
    // a square system has no free states; what drove them waits
    edit(&mut session, Edit::Size { of: Size::States, grow: false });
    let squared = analysis(&session);
    assert!(squared.free.is_none(), "as many equations as states");
    assert_eq!(data(&session).signals.len(), 2, "still there");
}

#[test]
fn what_the_scenario_s_place_shows_is_not_remarked_again() {
    let mut session = wide();
    let found = analysis(&session);
    let notes = found.simulation.unwrap().notes;
    assert!(notes.is_empty(), "nothing else to say: {notes:?}");
    update(&mut session, Command::Show(Show::Tab(Tab::Figures)));
    let mut derived = Derived::default();
    let request = derived.next_request(&session).unwrap();
    derived.receive(perform(&request, &Watch::none()).unwrap());
    let request = derived.next_request(&session).unwrap();
    match perform(&request, &Watch::none()).unwrap().outcome {
        Outcome::Figure { figure: Ok(figure), .. } => {
            assert!(figure.notes.is_empty(), "{:?}", figure.notes);
        }
        other => panic!("no figure: {other:?}"),
    }
}

#[test]
fn a_square_system_becomes_rectangular_by_its_equations() {
    let mut session = opened("proportional-integral");
    edit(&mut session, Edit::Size { of: Size::Equations, grow: false });
    let system = session.document().system().unwrap();
    assert_eq!((system.n_states(), system.n_equations()), (4, 3), "wide");
    let found = analysis(&session);
    assert_eq!(found.free.unwrap().n_free, 1, "the last equation determined one state");
    edit(&mut session, Edit::Size { of: Size::States, grow: true });
    assert_eq!(session.document().system().unwrap().n_equations(), 3, "no longer linked");
    edit(&mut session, Edit::Size { of: Size::Equations, grow: true });
    edit(&mut session, Edit::Size { of: Size::Equations, grow: true });
    edit(&mut session, Edit::Size { of: Size::States, grow: true });
    assert_eq!(session.document().system().unwrap().E.shape(), (6, 6), "square and linked again");
}

#[test]
fn equations_that_are_too_many_give_a_sentence_for_every_method() {
    for key in ["proportional-integral", "discrete", "input-in-constraint"] {
        let (mut refused, mut asked) = (0, 0);
        let mut session = opened(key);
        edit(&mut session, Edit::Size { of: Size::Equations, grow: true });
        let last = session.document().system().unwrap().n_equations() - 1;
        let cell = Cell { matrix: Matrix::A, row: last, column: 0 };
        edit(&mut session, Edit::Cell { cell, text: text("1") });
        for method in Method::ALL {
            for order in Order::ALL {
                edit(&mut session, Edit::Method(method));
                edit(&mut session, Edit::Order(order));
                let found = analysis(&session);
                asked += 1;
                let said = match (&found.assessment, &found.simulation) {
                    (Err(why), _) | (_, Err(why)) => why.clone(),
                    (Ok(_), Ok(_)) => continue,
                };
                refused += 1;
                let panics = ["panicked", "unwrap", "index out of"];
                assert!(
                    said.len() > 20 && !panics.iter().any(|word| said.contains(word)),
                    "{method:?}: {said}"
                );
            }
        }
        assert_eq!(refused, asked, "{key}: one equation is too many, whatever the method");
    }
}

/// x1' = -x1 + x2 + d, 0 = x1 + d, everything measured: square, and x2 is free.
fn square_with_a_free_state() -> Session {
    let mut session = opened("input-in-constraint");
    while session.document().system().unwrap().n_states() > 2 {
        edit(&mut session, Edit::Size { of: Size::States, grow: false });
    }
    let system = session.document().system().unwrap();
    let wanted = [
        (Matrix::E, dmatrix![1.0, 0.0; 0.0, 0.0]),
        (Matrix::A, dmatrix![-1.0, 1.0; 1.0, 0.0]),
        (Matrix::D, dmatrix![1.0; 1.0]),
    ];
    assert_eq!((system.E.shape(), system.D.ncols()), ((2, 2), 1), "two equations, two states");
    for (matrix, values) in wanted {
        for row in 0..2 {
            for column in 0..values.ncols() {
                let cell = Cell { matrix, row, column };
                edit(&mut session, Edit::Cell { cell, text: values[(row, column)].to_string() });
            }
        }
    }
    session
}

#[test]
fn a_square_plant_with_a_free_state_is_driven_like_a_wide_one() {
    let mut session = square_with_a_free_state();
    let found = analysis(&session);
    let report = found.free.unwrap();
    assert_eq!((report.n_free, report.constrained), (1, 1), "{report:?}");
    assert_eq!(report.directions, ["v1 = x2"], "in words");
    assert!(found.simulation.is_ok(), "{:?}", found.simulation.err());
    free(&mut session, FreeEdit::Signal { index: 0, text: text("sin(t)") });
    assert!(analysis(&session).simulation.is_ok(), "driven");
    // 0 = x1 + x2 + d determines x2
    let cell = Cell { matrix: Matrix::A, row: 1, column: 1 };
    edit(&mut session, Edit::Cell { cell, text: text("1") });
    let found = analysis(&session);
    assert!(found.free.is_none() && found.simulation.is_ok(), "of index 1: it runs as it is");
}

#[test]
fn bounded_is_the_linear_part_where_there_is_more() {
    let session = wide();
    assert!(!report(&session).linear_part, "linear and certain");
    let mut document = session.document().clone();
    let mut uncertain = |amplitude: f64| {
        let of = |x: f64| EntryMatrix::from_matrix(&DMatrix::from_element(3, 4, x));
        document.scenario.uncertainty =
            Some(UncertaintyData { amplitude: of(amplitude), frequency: of(1.0), scale: 1.0 });
        analyse(&document, &Watch::none()).unwrap().free.unwrap()
    };
    assert!(!uncertain(0.0).linear_part, "nothing varies");
    assert!(uncertain(0.1).linear_part, "what varies does not belong to the modes");
}

#[test]
fn contradicting_equations_are_refused_with_what_to_do() {
    let mut session = wide();
    for _ in 0..3 {
        edit(&mut session, Edit::Size { of: Size::Equations, grow: true });
    }
    for (row, column) in [(3, 0), (4, 1), (5, 0)] {
        let cell = Cell { matrix: Matrix::A, row, column };
        edit(&mut session, Edit::Cell { cell, text: text("1") });
    }
    edit(&mut session, Edit::Order(Order::General));
    let found = analysis(&session);
    assert!(found.free.is_none(), "nothing is free");
    let why = found.simulation.unwrap_err();
    assert!(why.contains("Remove equations that repeat others"), "{why}");
    let PlantData::Descriptor(data) = &session.document().plant else { panic!("given by matrices") };
    assert_eq!(data.matrix(Matrix::E).shape(), (6, 4), "tall");
}
