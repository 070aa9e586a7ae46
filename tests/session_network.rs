//! A network, edited by commands as a person edits it.
#![cfg(not(target_arch = "wasm32"))]
#![expect(clippy::unwrap_used, clippy::panic, reason = "helpers of tests fail by panicking")]

use descry::document::{
    Coupling, Document, Matrix, NetworkData, NetworkMatrix, PlantData, read_document, write_document,
};
use descry::numerics::{Complex64, Watch};
use descry::observer::Method;
use descry::session::{
    Command, CouplingForm, Edit, Field, LmiEdit, Measure, NetworkCell, NetworkEdit, NetworkSize, Session,
    analyse, coupling_forms, update,
};
use nalgebra::dmatrix;
use proptest::prelude::*;

const PAPER: &str = include_str!("documents/003-network.json");

fn opened(text: &str) -> Session {
    Session::new(read_document(text).unwrap())
}

/// Whether a document reads back, and its network fits together.
fn sound(document: &Document) -> Result<(), String> {
    let again = read_document(&write_document(document)).map_err(|error| error.to_string())?;
    if again != *document {
        return Err("the document reads back as another one".to_owned());
    }
    match &document.plant {
        PlantData::Network(data) => data.network().map(drop).map_err(|error| error.to_string()),
        PlantData::Descriptor(data) => data.system().map(drop).map_err(|error| error.to_string()),
    }
}

fn edit(session: &mut Session, edit: NetworkEdit) {
    update(session, Command::Edit(Edit::Network(edit)));
    sound(session.document()).unwrap_or_else(|error| panic!("{error}"));
}

fn data(session: &Session) -> &NetworkData {
    match &session.document().plant {
        PlantData::Network(data) => data,
        PlantData::Descriptor(_) => panic!("the documents of these tests hold networks"),
    }
}

fn cell(matrix: NetworkMatrix, row: usize, column: usize) -> NetworkCell {
    NetworkCell { matrix, row, column }
}

fn typed(matrix: NetworkMatrix, row: usize, column: usize, text: &str) -> NetworkEdit {
    NetworkEdit::Cell { cell: cell(matrix, row, column), text: text.to_owned() }
}

fn pasted(matrix: NetworkMatrix, row: usize, column: usize, text: &str) -> NetworkEdit {
    NetworkEdit::Paste { cell: cell(matrix, row, column), text: text.to_owned() }
}

fn size(of: NetworkSize, grow: bool) -> NetworkEdit {
    NetworkEdit::Size { of, grow }
}

fn template(form: CouplingForm) -> NetworkEdit {
    NetworkEdit::Template { form, weight: 1.0 }
}

fn plug(subsystem: usize, plugged: bool) -> NetworkEdit {
    NetworkEdit::Plug { subsystem: Some(subsystem), plugged }
}

fn measured(subsystem: usize, measured: bool) -> NetworkEdit {
    NetworkEdit::Local { subsystem: Some(subsystem), measured }
}

fn told(session: &Session) -> (&str, bool) {
    session.message().map_or(("", false), |message| (&message.text, message.error))
}

fn shapes(session: &Session) -> Vec<(usize, usize)> {
    NetworkMatrix::ALL.map(|matrix| data(session).shape(matrix)).into()
}

#[test]
fn a_new_network_has_a_verified_observer() {
    let mut session = opened(PAPER);
    let before = session.document().clone();
    update(&mut session, Command::NewNetwork);
    sound(session.document()).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(session.document().design.method, Method::Hierarchical, "the method for networks");
    let analysis = analyse(session.document(), &Watch::none()).unwrap();
    assert!(analysis.verified(), "its conditions hold and its design is verified: {:?}", analysis.assessment);
    update(&mut session, Command::Undo);
    assert_eq!(*session.document(), before, "what was there comes back");
}

#[test]
fn every_matrix_is_typed_cell_by_cell() {
    let mut session = opened(PAPER);
    for matrix in NetworkMatrix::ALL {
        edit(&mut session, typed(matrix, 0, 0, "1/3"));
        let entry = data(&session).entry(matrix, 0, 0).unwrap();
        assert_eq!(entry.text.as_deref(), Some("1/3"), "{}: the expression", matrix.letter());
        edit(&mut session, typed(matrix, 0, 0, "1/"));
        let draft = session.draft(&Field::Network(cell(matrix, 0, 0))).unwrap();
        assert_eq!(draft.text, "1/", "{}: kept as it was typed", matrix.letter());
        assert_eq!(data(&session).entry(matrix, 0, 0).unwrap().value, 1.0 / 3.0, "the last good value");
        edit(&mut session, typed(matrix, 0, 0, "2"));
        assert_eq!(session.n_drafts(), 0, "{}: understood", matrix.letter());
    }
    for _ in 0..14 {
        update(&mut session, Command::Undo);
    }
    assert_eq!(*session.document(), read_document(PAPER).unwrap(), "each is one step");
}

#[test]
fn pasted_blocks_resize_what_they_reach_beyond() {
    let mut session = opened(PAPER);
    edit(&mut session, pasted(NetworkMatrix::State, 1, 1, "7 8; 9 10"));
    let a = data(&session).a.values();
    assert_eq!((a[(1, 1)], a[(2, 2)], a.shape()), (7.0, 10.0, (5, 5)), "a block within");
    edit(&mut session, pasted(NetworkMatrix::LocalOutput, 0, 0, "1 0 0 0 0 0; 0 1 0 0 0 0; 0 0 0 0 0 1"));
    assert_eq!(
        shapes(&session),
        [(6, 6), (6, 1), (1, 6), (1, 6), (3, 6), (4, 4), (1, 4)],
        "one state and one local output more"
    );
    edit(
        &mut session,
        pasted(NetworkMatrix::Gamma, 0, 0, "1 2 3 4 5; 6 7 8 9 10; 0 0 0 0 0; 0 0 0 0 0; 0 0 0 0 1"),
    );
    assert_eq!(
        (data(&session).n_subsystems(), data(&session).Psi.shape()),
        (5, (1, 5)),
        "one subsystem more"
    );
    let before = session.document().clone();
    edit(
        &mut session,
        pasted(
            NetworkMatrix::Gamma,
            0,
            0,
            "1 2 3 4 5 6; 6 7 8 9 10 11; 0 0 0 0 0 0; 0 0 0 0 0 0; 0 0 0 0 1 0",
        ),
    );
    assert!(told(&session).1 && told(&session).0.contains("5 x 6"), "Gamma is square: {:?}", told(&session));
    edit(&mut session, pasted(NetworkMatrix::Psi, 0, 0, "one two"));
    assert!(told(&session).1, "no matrix: {:?}", told(&session));
    assert_eq!(*session.document(), before, "what is refused changes nothing");
}

#[test]
fn initial_states_stay_with_their_subsystems() {
    let mut session = opened(PAPER);
    let x0 = |session: &Session| -> Vec<f64> {
        session.document().scenario.x0.iter().map(|entry| entry.value).collect()
    };
    let first = x0(&session);
    edit(&mut session, size(NetworkSize::States, true));
    let grown = x0(&session);
    assert_eq!(
        (grown[5], grown[6], grown[7]),
        (0.0, first[5], first[6]),
        "a sixth state behind the first five"
    );
    edit(&mut session, size(NetworkSize::Subsystems, true));
    assert_eq!((x0(&session).len(), x0(&session)[24]), (30, 0.0), "a fifth subsystem at rest");
    for of in [NetworkSize::Subsystems, NetworkSize::States] {
        edit(&mut session, size(of, false));
    }
    assert_eq!(x0(&session), first, "there and back");
    edit(&mut session, size(NetworkSize::States, false));
    assert_eq!(&x0(&session)[4..8], &first[5..9], "without the fifth state");
}

#[test]
fn initial_states_by_an_expression_follow_the_sizes() {
    let mut session = opened(PAPER);
    update(&mut session, Command::Edit(Edit::InitialFormula("1/(21-i)".to_owned())));
    edit(&mut session, size(NetworkSize::Subsystems, false));
    assert!(session.document().scenario.x0_formula.is_some(), "fifteen states have values");
    update(&mut session, Command::Undo);
    edit(&mut session, size(NetworkSize::Subsystems, true));
    let values = session.document().initial_state();
    assert_eq!((values[19], values[20], values[21]), (1.0, 0.0, -1.0), "listed, with a zero for i = 21");
    assert!(told(&session).0.contains("i = 21"), "and that is said: {:?}", told(&session));
}

#[test]
fn every_size_has_its_bounds() {
    let all = [
        NetworkSize::Subsystems,
        NetworkSize::States,
        NetworkSize::Channels,
        NetworkSize::GlobalOutputs,
        NetworkSize::LocalOutputs,
        NetworkSize::Combinations,
    ];
    let mut session = opened(PAPER);
    for of in all {
        edit(&mut session, size(of, true));
    }
    assert_eq!(
        shapes(&session),
        [(6, 6), (6, 2), (2, 6), (2, 6), (3, 6), (5, 5), (2, 5)],
        "one more of each"
    );
    for of in all {
        let before = shapes(&session);
        while !told(&session).1 {
            edit(&mut session, size(of, false));
        }
        assert!(told(&session).0.contains("at least one"), "{of:?}: {:?}", told(&session));
        assert_ne!(shapes(&session), before, "{of:?} went down to one");
        update(&mut session, Command::Edit(Edit::Title(format!("{of:?}"))));
    }
    let ones = [(1, 1); 7];
    assert_eq!(shapes(&session), ones, "the smallest network");
    edit(&mut session, NetworkEdit::Subsystems("2001".to_owned()));
    assert!(session.draft(&Field::Subsystems).unwrap().error.contains("2000"), "too many");
    edit(&mut session, NetworkEdit::Subsystems(" 12 ".to_owned()));
    assert_eq!((data(&session).n_subsystems(), session.n_drafts()), (12, 0), "as typed");
}

#[test]
fn thousands_of_subsystems_are_listed_and_never_written_out() {
    let mut session = opened(PAPER);
    edit(&mut session, template(CouplingForm::Chain));
    edit(&mut session, NetworkEdit::Subsystems("2000".to_owned()));
    let Coupling::Sparse { entries, .. } = &data(&session).Gamma else { panic!("a list of entries") };
    assert_eq!(entries.len(), 3 * 2000 - 2, "the chain goes on");
    assert!(matches!(data(&session).Psi, Coupling::Sparse { .. }), "Psi, too");
    edit(&mut session, typed(NetworkMatrix::Gamma, 1999, 0, "1/2"));
    assert_eq!(data(&session).Gamma.value(1999, 0), 0.5, "the expression's value");
    assert!(matches!(data(&session).Gamma, Coupling::Sparse { .. }), "still a list");
    let before = session.document().clone();
    edit(&mut session, template(CouplingForm::Complete));
    assert!(told(&session).1 && told(&session).0.contains("4000000"), "too many: {:?}", told(&session));
    edit(&mut session, NetworkEdit::Expand);
    assert!(told(&session).1 && told(&session).0.contains("10000 states"), "{:?}", told(&session));
    assert_eq!(*session.document(), before, "refused");
    edit(&mut session, NetworkEdit::Local { subsystem: None, measured: true });
    assert_eq!(data(&session).local.len(), 2000, "all measured");
    edit(&mut session, template(CouplingForm::Leaders { leaders: 3 }));
    assert_eq!(data(&session).Gamma.n_entries(), 2000, "everybody listens to one other");
}

#[test]
fn a_network_beyond_a_document_is_refused() {
    let mut session = opened(PAPER);
    edit(&mut session, NetworkEdit::Subsystems("300".to_owned()));
    // seventeen digits for each of ninety thousand entries
    edit(&mut session, NetworkEdit::Template { form: CouplingForm::Complete, weight: 1.0 / 3.0 });
    assert!(told(&session).1 && told(&session).0.contains("MB"), "{:?}", told(&session));
    assert!(data(&session).Gamma.n_entries() < 90_000, "as before");
}

#[test]
fn usual_couplings_keep_their_form() {
    let mut session = opened(PAPER);
    for form in
        [CouplingForm::Ring, CouplingForm::Star, CouplingForm::Complete, CouplingForm::Leaders { leaders: 2 }]
    {
        edit(&mut session, template(form));
        edit(&mut session, size(NetworkSize::Subsystems, true));
        assert!(coupling_forms(&data(&session).Gamma).contains(&(form, 1.0)), "{form:?} goes on");
        edit(&mut session, size(NetworkSize::Subsystems, false));
    }
    edit(&mut session, template(CouplingForm::Random { seed: 5 }));
    let gamma = data(&session).Gamma.values();
    update(&mut session, Command::Undo);
    edit(&mut session, template(CouplingForm::Random { seed: 5 }));
    assert_eq!(data(&session).Gamma.values(), gamma, "reproducible");
    edit(&mut session, template(CouplingForm::Leaders { leaders: 9 }));
    assert!(told(&session).1, "more leaders than subsystems: {:?}", told(&session));
}

#[test]
fn an_edge_keeps_the_sum_of_its_row() {
    let mut session = opened(PAPER);
    let edge =
        |to, from, text: &str, balanced| NetworkEdit::Edge { to, from, text: text.to_owned(), balanced };
    edit(&mut session, edge(0, 3, "1/2", true));
    let gamma = data(&session).Gamma.values();
    assert_eq!((gamma[(0, 3)], gamma[(0, 0)], gamma.row(0).sum()), (0.5, -2.5, 0.0), "balanced");
    edit(&mut session, edge(0, 3, "0", true));
    assert_eq!(data(&session).Gamma.value(0, 0), -2.0, "removed");
    edit(&mut session, edge(0, 3, "1", false));
    assert_eq!(data(&session).Gamma.value(0, 0), -2.0, "alone");
    edit(&mut session, edge(0, 3, "x", false));
    assert!(session.draft(&Field::Network(cell(NetworkMatrix::Gamma, 0, 3))).is_some(), "kept as typed");
    edit(&mut session, edge(0, 4, "1", false));
    assert!(told(&session).1, "there are four: {:?}", told(&session));
}

#[test]
fn local_observers_are_plugged_in_where_something_is_measured() {
    let mut session = opened(PAPER);
    edit(&mut session, plug(1, true));
    assert!(
        told(&session).1 && told(&session).0.contains("subsystem 2"),
        "not measured: {:?}",
        told(&session)
    );
    edit(&mut session, measured(1, true));
    assert_eq!(
        (data(&session).local.clone(), session.document().design.plugged.clone()),
        (vec![2, 4], None),
        "all are plugged in"
    );
    edit(&mut session, plug(3, false));
    assert_eq!(session.document().design.plugged, Some(vec![1]), "the fourth is out");
    assert!(data(&session).is_plugged(1, session.document().design.plugged.as_deref()), "the second is in");
    edit(&mut session, measured(0, true));
    assert_eq!(session.document().design.plugged, Some(vec![1]), "a new one waits");
    edit(&mut session, measured(1, false));
    assert_eq!(session.document().design.plugged, Some(Vec::new()), "no sensor, no observer");
    edit(&mut session, NetworkEdit::Plug { subsystem: None, plugged: true });
    assert_eq!(session.document().design.plugged, None, "all");
    edit(&mut session, plug(0, false));
    edit(&mut session, plug(0, true));
    assert_eq!(session.document().design.plugged, None, "out and in again");
    edit(&mut session, plug(9, true));
    assert!(told(&session).1, "there are four");
}

#[test]
fn noise_and_figures_stay_with_their_outputs() {
    let figure = r#""figures": [{"id": "f", "runs": [{"design": {"plugged": [4]}}], "panels": [
        {"kind": "time", "series": [{"show": "x16"}, {"show": "y2"}]}]}]"#;
    let noise = r#""noise": ["0.1*sin(t)", "0.2*sin(t)", "0.3*sin(t)"], "horizon""#;
    let text = PAPER.trim_end().trim_end_matches('}').replace("\"horizon\"", noise);
    let mut session = opened(&format!("{text}, {figure}}}"));
    let shown = |session: &Session| -> Vec<String> {
        session.document().scenario.noise.iter().map(|signal| signal.text().to_owned()).collect()
    };
    edit(&mut session, measured(0, true));
    assert_eq!(
        shown(&session),
        ["0.1*sin(t)", "0", "0", "0.2*sin(t)", "0.3*sin(t)"],
        "the first subsystem's outputs come before the fourth's"
    );
    edit(&mut session, size(NetworkSize::States, true));
    let text = write_document(session.document());
    assert!(
        text.contains("x19") && text.contains("y4"),
        "the first state of subsystem 4 and its output: {text}"
    );
    edit(&mut session, size(NetworkSize::Subsystems, false));
    assert!(session.document().figures.is_empty(), "it shows a subsystem that is gone");
    assert!(told(&session).0.contains("figure"), "and that is said: {:?}", told(&session));
    assert_eq!(shown(&session), ["0.1*sin(t)", "0", "0"], "its noise went, too");
}

#[test]
fn both_lists_of_poles_are_typed_and_dragged() {
    let mut session = opened(PAPER);
    update(&mut session, Command::Edit(Edit::Method(Method::Hierarchical)));
    let counts = |session: &Session| {
        (session.document().design.poles.len(), session.document().design.local_poles.len())
    };
    assert_eq!(counts(&session), (6, 5), "nu mu and n");
    edit(&mut session, NetworkEdit::LocalPoles("-4, -5, -6+i, -6-i, -7".to_owned()));
    assert_eq!(session.document().design.local_poles[2], Complex64::new(-6.0, 1.0), "typed");
    edit(&mut session, NetworkEdit::LocalPoles("-4, -6+i".to_owned()));
    assert!(session.draft(&Field::LocalPoles).unwrap().error.contains("conjugate"), "half a pair");
    let before = session.document().clone();
    for (to, done) in [(1.5, false), (2.0, false), (2.0, true)] {
        let to = Complex64::new(-6.0, to);
        edit(&mut session, NetworkEdit::MoveLocalPole { index: 2, to, done });
    }
    let poles = &session.document().design.local_poles;
    assert_eq!((poles[2].im, poles[3].im), (2.0, -2.0), "the pair moves together");
    assert_eq!(session.document().design.poles, before.design.poles, "the global ones stay");
    update(&mut session, Command::Undo);
    assert_eq!(*session.document(), before, "a drag is one step");
    edit(&mut session, size(NetworkSize::States, true));
    assert_eq!(counts(&session).1, 6, "one more state asks for one more pole");
}

#[test]
fn what_a_condition_asks_for_is_measured() {
    let verdict = |session: &Session, id: &str| {
        let analysis = analyse(session.document(), &Watch::none()).unwrap();
        let found = analysis.assessment.unwrap().conditions.into_iter().find(|c| c.id == id);
        found.is_some_and(|condition| condition.verdict.holds())
    };
    let mut session = opened(PAPER);
    update(&mut session, Command::Edit(Edit::Method(Method::Hierarchical)));
    edit(&mut session, typed(NetworkMatrix::Psi, 0, 3, "1"));
    assert!(!verdict(&session, "003-11-Psi"), "the fourth subsystem alone is not what the coupling shows");
    edit(&mut session, NetworkEdit::Measure(Measure::ReceivedOnly { subsystem: 1 }));
    assert_eq!(data(&session).Psi.values(), dmatrix![1.0, -3.0, 2.0, 0.0], "the second row of Gamma");
    assert!(verdict(&session, "003-11-Psi"), "mended");
    edit(&mut session, NetworkEdit::Measure(Measure::Received { subsystem: 0 }));
    assert_eq!(data(&session).Psi.values().row(1), dmatrix![-2.0, 2.0, 0.0, 0.0].row(0), "a further row");
    edit(&mut session, typed(NetworkMatrix::GlobalOutput, 0, 1, "1"));
    assert!(!verdict(&session, "003-11-cG"), "the second state alone is not shown");
    edit(&mut session, NetworkEdit::Measure(Measure::CouplingOutputOnly));
    assert!(verdict(&session, "003-11-cG"), "mended");
    edit(&mut session, NetworkEdit::Measure(Measure::CouplingOutput));
    assert_eq!(data(&session).c_G.shape(), (2, 5), "the rows of c besides");
    edit(&mut session, NetworkEdit::Measure(Measure::LocalState { state: 4 }));
    assert_eq!(data(&session).c_L.values()[(2, 4)], 1.0, "a further local sensor");
    edit(&mut session, NetworkEdit::Measure(Measure::LocalState { state: 5 }));
    assert!(told(&session).1, "there is no sixth state");
}

#[test]
fn a_small_network_is_expanded_to_matrices() {
    let mut session = opened(PAPER);
    update(&mut session, Command::Edit(Edit::Method(Method::Hierarchical)));
    edit(&mut session, plug(3, false));
    let (before, system) = (session.document().clone(), session.document().system().unwrap());
    edit(&mut session, NetworkEdit::Expand);
    assert_eq!(session.document().system().unwrap(), system, "the same system");
    let design = &session.document().design;
    assert_eq!((design.method, design.plugged.clone()), (Method::Proportional, None), "without its network");
    assert!(design.poles.len() >= 20, "a pole for each state");
    edit(&mut session, NetworkEdit::Expand);
    assert!(told(&session).1, "only once");
    edit(&mut session, size(NetworkSize::States, true));
    assert!(told(&session).1, "it is no network any more");
    let cell = descry::session::Cell { matrix: Matrix::A, row: 0, column: 0 };
    update(&mut session, Command::Edit(Edit::Cell { cell, text: "-3.7".to_owned() }));
    for _ in 0..2 {
        update(&mut session, Command::Undo);
    }
    assert_eq!(*session.document(), before, "and back");
}

#[test]
fn demands_of_other_methods_do_not_break_the_document() {
    let mut session = opened(PAPER);
    update(&mut session, Command::Edit(Edit::Method(Method::HInfinity)));
    update(&mut session, Command::Edit(Edit::Lmi(LmiEdit::Decoupled(Some(vec![vec![19], vec![0]])))));
    edit(&mut session, size(NetworkSize::Subsystems, false));
    assert_eq!(session.document().design.lmi.decoupled, None, "x20 is gone");
}

fn any_matrix() -> impl Strategy<Value = NetworkMatrix> {
    prop::sample::select(&NetworkMatrix::ALL[..])
}

fn any_edit() -> impl Strategy<Value = NetworkEdit> {
    let text = prop::sample::select(vec!["0", "1", "-1/3", "1e-3", "sqrt(2)", "1/", "", "9e99", "1/0"]);
    let block =
        prop::sample::select(vec!["1 2; 3 4", "1 2 3", "1; 2; 3", "[1,2,3,4;5,6,7,8;9,1,2,3;4,5,6,7]", "x"]);
    let place = || (any_matrix(), 0..7_usize, 0..7_usize);
    let sizes = prop::sample::select(vec![
        NetworkSize::Subsystems,
        NetworkSize::States,
        NetworkSize::Channels,
        NetworkSize::GlobalOutputs,
        NetworkSize::LocalOutputs,
        NetworkSize::Combinations,
    ]);
    let form = prop_oneof![
        Just(CouplingForm::Chain),
        Just(CouplingForm::Ring),
        Just(CouplingForm::Star),
        Just(CouplingForm::Complete),
        (0..9_u64).prop_map(|seed| CouplingForm::Random { seed }),
        (0..4_usize).prop_map(|leaders| CouplingForm::Leaders { leaders }),
    ];
    let counts = prop::sample::select(vec!["1", "2", "5", "24", "101", "130", "0", "many"]);
    let measure = prop_oneof![
        (0..6_usize).prop_map(|subsystem| Measure::ReceivedOnly { subsystem }),
        (0..6_usize).prop_map(|subsystem| Measure::Received { subsystem }),
        Just(Measure::CouplingOutputOnly),
        Just(Measure::CouplingOutput),
        (0..6_usize).prop_map(|state| Measure::LocalState { state }),
    ];
    let one = || prop::option::of(0..7_usize);
    prop_oneof![
        (place(), text.clone()).prop_map(|((matrix, row, column), text)| typed(matrix, row, column, text)),
        (place(), block).prop_map(|((matrix, row, column), text)| pasted(matrix, row, column, text)),
        (sizes, any::<bool>()).prop_map(|(of, grow)| size(of, grow)),
        counts.prop_map(|text| NetworkEdit::Subsystems(text.to_owned())),
        (form, -2.0..2.0_f64).prop_map(|(form, weight)| NetworkEdit::Template { form, weight }),
        (0..7_usize, 0..7_usize, text, any::<bool>()).prop_map(|(to, from, text, balanced)| {
            NetworkEdit::Edge { to, from, text: text.to_owned(), balanced }
        }),
        (one(), any::<bool>()).prop_map(|(subsystem, measured)| NetworkEdit::Local { subsystem, measured }),
        (one(), any::<bool>()).prop_map(|(subsystem, plugged)| NetworkEdit::Plug { subsystem, plugged }),
        measure.prop_map(NetworkEdit::Measure),
    ]
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 48, ..ProptestConfig::default() })]

    #[test]
    fn any_sequence_of_edits_keeps_the_document_readable(edits in prop::collection::vec(any_edit(), 1..25)) {
        let mut session = opened(PAPER);
        update(&mut session, Command::NewNetwork);
        let start = session.document().clone();
        for one in &edits {
            update(&mut session, Command::Edit(Edit::Network(one.clone())));
            let sound = sound(session.document());
            prop_assert!(sound.is_ok(), "after {:?}: {:?}", one, sound);
        }
        let end = session.document().clone();
        for _ in 0..edits.len() {
            if *session.document() != start {
                update(&mut session, Command::Undo);
            }
        }
        prop_assert!(*session.document() == start, "undone step by step");
        for _ in 0..edits.len() {
            update(&mut session, Command::Redo);
        }
        prop_assert!(*session.document() == end, "and done again");
    }
}
