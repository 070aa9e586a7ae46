//! Demands, subsystems and nonlinearity, edited by commands as a person edits them.
#![cfg(not(target_arch = "wasm32"))]
#![expect(clippy::unwrap_used, clippy::panic, reason = "helpers of tests fail by panicking")]

use descry::document::{DescriptorData, Matrix, PlantData, read_document, write_document};
use descry::observer::{GivenObserver, LmiChoice, Method, Order};
use descry::session::{
    Cell, Command, Edit, Field, Fill, GivenPart, LipschitzEdit, LipschitzMatrix, LmiEdit, PartitionEdit,
    Session, Share, Size, update,
};
use descry::system::TimeDomain;
use nalgebra::{DMatrix, dmatrix};

const PARTITIONED: &str = include_str!("documents/000-partition.json");
const LIPSCHITZ: &str = include_str!("documents/002-lipschitz.json");

fn opened(text: &str) -> Session {
    Session::new(read_document(text).unwrap())
}

fn edit(session: &mut Session, edit: Edit) {
    update(session, Command::Edit(edit));
    let document = session.document();
    let again = read_document(&write_document(document)).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(again, *document, "every edited document reads back");
}

fn lmi(session: &Session) -> &LmiChoice {
    &session.document().design.lmi
}

fn data(session: &Session) -> &DescriptorData {
    match &session.document().plant {
        PlantData::Descriptor(data) => data,
        PlantData::Network(_) => panic!("the documents of these tests hold matrices"),
    }
}

/// States, equations and outputs of each subsystem.
fn sizes(session: &Session) -> Vec<[usize; 3]> {
    data(session).partition.iter().map(|s| [s.states, s.equations, s.outputs]).collect()
}

fn told(session: &Session) -> (&str, bool) {
    session.message().map_or(("", false), |message| (&message.text, message.error))
}

fn undo(session: &mut Session) {
    update(session, Command::Undo);
}

#[test]
fn the_first_choice_of_a_method_brings_demands_to_begin_with() {
    let mut session = opened(LIPSCHITZ);
    edit(&mut session, Edit::Method(Method::HInfinity));
    assert_eq!(
        (lmi(&session).decay, session.document().design.order),
        (Some(0.5), Order::Reduced),
        "H-infinity"
    );
    edit(&mut session, Edit::Time(TimeDomain::Discrete));
    assert_eq!(lmi(&session).decay, None, "a rate is no radius");
    let mut session = opened(PARTITIONED);
    edit(&mut session, Edit::Method(Method::Decentralized));
    let design = &session.document().design;
    assert_eq!(
        (lmi(&session).decay, lmi(&session).gain),
        (Some(0.95), Some(10.0)),
        "decentralized, discrete"
    );
    assert_eq!(design.order, Order::Full, "full order");
    edit(&mut session, Edit::Time(TimeDomain::Continuous));
    assert_eq!((lmi(&session).decay, lmi(&session).gain), (None, Some(10.0)), "continuous: stability alone");
    edit(&mut session, Edit::Method(Method::HInfinity));
    assert_eq!(lmi(&session).decay, Some(0.5), "nobody touched the demands in between");
}

#[test]
fn touched_demands_stay() {
    let mut session = opened(PARTITIONED);
    edit(&mut session, Edit::Method(Method::Decentralized));
    edit(&mut session, Edit::Lmi(LmiEdit::Decay { decay: Some(0.8), done: true }));
    edit(&mut session, Edit::Method(Method::Proportional));
    assert_eq!(session.document().design.order, Order::Full, "an order that both have stays");
    edit(&mut session, Edit::Method(Method::Decentralized));
    assert_eq!(lmi(&session).decay, Some(0.8), "made by hand");
    edit(&mut session, Edit::Time(TimeDomain::Continuous));
    assert_eq!(lmi(&session).decay, None, "a radius is no rate");
    assert!(told(&session).0.contains("decay"), "and that is said: {:?}", told(&session));
}

#[test]
fn an_order_that_a_method_lacks_is_never_chosen() {
    let mut session = opened(LIPSCHITZ);
    edit(&mut session, Edit::Method(Method::HInfinity));
    edit(&mut session, Edit::Order(Order::Minimal));
    edit(&mut session, Edit::Method(Method::ProportionalIntegral));
    assert_eq!(session.document().design.order, Order::Reduced, "the method's first order");
    edit(&mut session, Edit::Order(Order::Minimal));
    assert_eq!(session.document().design.order, Order::Reduced, "refused");
    assert!(told(&session).1, "with a reason");
}

#[test]
fn a_dragged_demand_is_one_step() {
    let mut session = opened(LIPSCHITZ);
    edit(&mut session, Edit::Method(Method::HInfinity));
    let before = lmi(&session).clone();
    let kinds: [fn(f64, bool) -> LmiEdit; 6] = [
        |x, done| LmiEdit::Decay { decay: Some(x), done },
        |x, done| LmiEdit::Gain { gain: Some(x), done },
        |x, done| LmiEdit::Gamma { gamma: Some(x), done },
        |x, done| LmiEdit::Conditioning { conditioning: 10.0 + x, done },
        |x, done| LmiEdit::BackOff { back_off: 0.1 * x, done },
        |x, done| LmiEdit::Seconds { seconds: 1.0 + x, done },
    ];
    for (k, kind) in kinds.into_iter().enumerate() {
        for step in 1..=8_u8 {
            edit(&mut session, Edit::Lmi(kind(0.1 * f64::from(step), step == 8)));
        }
        assert_ne!(*lmi(&session), before, "demand {k} is in force");
        undo(&mut session);
        assert_eq!(*lmi(&session), before, "demand {k}: one step back");
        update(&mut session, Command::Redo);
        assert_ne!(*lmi(&session), before, "demand {k}: and forward");
        undo(&mut session);
    }
}

#[test]
fn demands_stay_within_what_documents_hold() {
    let mut session = opened(PARTITIONED);
    edit(&mut session, Edit::Method(Method::Decentralized));
    for value in [f64::NAN, f64::INFINITY, -1.0, 0.0, 1e300] {
        for one in [
            LmiEdit::Decay { decay: Some(value), done: true },
            LmiEdit::Gain { gain: Some(value), done: true },
            LmiEdit::Gamma { gamma: Some(value), done: true },
            LmiEdit::Conditioning { conditioning: value, done: true },
            LmiEdit::BackOff { back_off: value, done: true },
            LmiEdit::Seconds { seconds: value, done: true },
        ] {
            edit(&mut session, Edit::Lmi(one));
        }
    }
    assert_eq!(lmi(&session).decay, Some(1.0), "a radius beyond the unit circle is none");
    edit(&mut session, Edit::Lmi(LmiEdit::Gain { gain: None, done: true }));
    assert_eq!(lmi(&session).gain, None, "not bounded");
}

#[test]
fn a_given_r_is_edited_entry_by_entry_and_goes_with_its_order() {
    let mut session = opened(LIPSCHITZ);
    edit(&mut session, Edit::Method(Method::HInfinity));
    let rows = dmatrix![0.0, 1.0, 0.0; 0.0, 0.0, 1.0];
    edit(&mut session, Edit::Lmi(LmiEdit::Rows(vec![rows])));
    let cell =
        |text: &str| Edit::Lmi(LmiEdit::RowsCell { subsystem: 0, row: 0, column: 2, text: text.to_owned() });
    edit(&mut session, cell("1/"));
    let draft = session.draft(&Field::Rows(0, 0, 2)).unwrap();
    assert_eq!((draft.text.as_str(), lmi(&session).rows[0][(0, 2)]), ("1/", 0.0), "kept, not in force");
    edit(&mut session, cell("-3/4"));
    assert_eq!((session.n_drafts(), lmi(&session).rows[0][(0, 2)]), (0, -0.75), "understood");
    let paste = |text: &str| Edit::Lmi(LmiEdit::RowsPaste { subsystem: 0, text: text.to_owned() });
    edit(&mut session, paste("[0 1 0 0]"));
    assert!(told(&session).1, "four columns for three states: {:?}", told(&session));
    edit(&mut session, paste("[0 1 1.5]"));
    assert_eq!(lmi(&session).rows[0], dmatrix![0.0, 1.0, 1.5], "a whole R is pasted");
    edit(&mut session, Edit::Order(Order::Full));
    assert!(lmi(&session).rows.is_empty(), "another order needs another R");
    assert!(told(&session).0.contains('R') && !told(&session).1, "and that is said: {:?}", told(&session));
    undo(&mut session);
    assert_eq!(lmi(&session).rows.len(), 1, "nothing is lost");
    edit(&mut session, Edit::Lmi(LmiEdit::Rows(Vec::new())));
    assert!(lmi(&session).rows.is_empty(), "chosen by the order again");
    edit(&mut session, Edit::Lmi(LmiEdit::Rows(vec![DMatrix::zeros(0, 3)])));
    assert!(told(&session).1 && lmi(&session).rows.is_empty(), "an R without rows is refused");
}

#[test]
fn an_observer_is_examined_from_pasted_matrices() {
    let mut session = opened(LIPSCHITZ);
    edit(&mut session, Edit::Method(Method::HInfinity));
    let given = GivenObserver { N: -DMatrix::identity(3, 3), J: DMatrix::zeros(3, 1), gamma: None };
    edit(&mut session, Edit::Lmi(LmiEdit::Examine(Some(given))));
    let part = |part, text: &str| Edit::Lmi(LmiEdit::Given { part, text: text.to_owned() });
    edit(&mut session, part(GivenPart::J, "[-0.331; -1.414]"));
    assert!(session.draft(&Field::Given(GivenPart::J)).is_some(), "two rows wait for an N of order two");
    edit(&mut session, part(GivenPart::N, "[0 -1.996 1; 0.667 -2.121 2]"));
    assert!(session.draft(&Field::Given(GivenPart::N)).is_some(), "N must be square");
    edit(&mut session, part(GivenPart::N, "[0 -1.996; 0.667 -2.121]"));
    let given = lmi(&session).given.clone().unwrap();
    assert_eq!(given.J, dmatrix![-0.331; -1.414], "the waiting J fits now");
    assert_eq!(session.n_drafts(), 0, "nothing waits");
    edit(&mut session, part(GivenPart::Gamma, "sqrt(9.762)"));
    assert_eq!(lmi(&session).given.as_ref().unwrap().gamma, Some(9.762_f64.sqrt()), "claimed");
    edit(&mut session, part(GivenPart::Gamma, "-1"));
    assert!(session.draft(&Field::Given(GivenPart::Gamma)).is_some(), "an attenuation is positive");
    edit(&mut session, part(GivenPart::Gamma, " "));
    assert_eq!(lmi(&session).given.as_ref().unwrap().gamma, None, "nothing is claimed");
    edit(&mut session, Edit::Size { of: Size::Outputs, grow: true });
    assert_eq!(lmi(&session).given.as_ref().unwrap().J.shape(), (2, 2), "a column for the new output");
    edit(&mut session, Edit::Lmi(LmiEdit::Examine(None)));
    assert!(lmi(&session).given.is_none(), "removed");
}

#[test]
fn a_partition_is_made_moved_joined_and_removed() {
    let mut session = opened(PARTITIONED);
    let whole = |session: &mut Session| edit(session, Edit::Partition(PartitionEdit::Clear));
    whole(&mut session);
    assert!(sizes(&session).is_empty(), "removed");
    edit(&mut session, Edit::Partition(PartitionEdit::Split { subsystem: 0 }));
    assert_eq!(sizes(&session), [[3, 3, 2], [3, 3, 2]], "divided where E and C allow it");
    let to = |to, done| Edit::Partition(PartitionEdit::Move { border: 0, share: Share::States, to, done });
    for (k, done) in [(4, false), (5, false), (4, true)] {
        edit(&mut session, to(k, done));
    }
    assert_eq!(sizes(&session), [[3, 3, 2], [3, 3, 2]], "C couples x4 and x6: the border stays");
    assert!(told(&session).1 && told(&session).0.contains("C["), "the entry is named: {:?}", told(&session));
    edit(&mut session, to(0, true));
    assert!(told(&session).1, "no subsystem without states");
    edit(&mut session, Edit::Partition(PartitionEdit::Name { subsystem: 0, name: "left".to_owned() }));
    edit(&mut session, Edit::Partition(PartitionEdit::Join { subsystem: 1 }));
    assert!(sizes(&session).is_empty(), "two that are joined are the whole system");
    undo(&mut session);
    assert_eq!(data(&session).partition[0].name, "left", "and back");
}

#[test]
fn a_border_takes_equations_and_outputs_along() {
    let mut session = opened(PARTITIONED);
    edit(&mut session, Edit::Partition(PartitionEdit::Clear));
    edit(&mut session, Edit::Fill { matrix: Matrix::C, fill: Fill::Identity });
    edit(&mut session, Edit::Partition(PartitionEdit::Split { subsystem: 0 }));
    assert_eq!(sizes(&session), [[3, 3, 3], [3, 3, 1]], "an output each for x1 to x4");
    let before = session.document().clone();
    let to = |to, done| Edit::Partition(PartitionEdit::Move { border: 0, share: Share::States, to, done });
    for (k, done) in [(2, false), (1, false), (1, true)] {
        edit(&mut session, to(k, done));
    }
    assert_eq!(sizes(&session), [[1, 1, 1], [5, 5, 3]], "all borders follow");
    undo(&mut session);
    assert_eq!(*session.document(), before, "a drag is one step");
    let outputs =
        Edit::Partition(PartitionEdit::Move { border: 0, share: Share::Outputs, to: 2, done: true });
    edit(&mut session, outputs);
    assert_eq!(sizes(&session), [[2, 2, 2], [4, 4, 2]], "the output of x3 takes its state along");
    edit(&mut session, Edit::Partition(PartitionEdit::Split { subsystem: 1 }));
    assert_eq!(sizes(&session).len(), 3, "three subsystems");
    let names: std::collections::BTreeSet<String> =
        data(&session).partition.iter().map(|s| s.name.clone()).collect();
    assert_eq!(names.len(), 3, "each with a name of its own: {names:?}");
}

#[test]
fn an_entry_that_couples_subsystems_is_kept_as_a_draft() {
    let mut session = opened(PARTITIONED);
    let cell = Cell { matrix: Matrix::E, row: 0, column: 3 };
    edit(&mut session, Edit::Cell { cell, text: "1/2".to_owned() });
    let error = session.draft(&Field::Cell(cell)).unwrap().error.clone();
    assert!(error.contains("E[1, 4]"), "the entry is named: {error}");
    assert_eq!(sizes(&session).len(), 2, "the partition stays");
    edit(&mut session, Edit::Fill { matrix: Matrix::E, fill: Fill::Random { seed: 1 } });
    assert!(told(&session).1 && sizes(&session).len() == 2, "a full E is refused: {:?}", told(&session));
    edit(&mut session, Edit::Partition(PartitionEdit::Clear));
    assert_eq!(session.n_drafts(), 0, "the entry is possible now");
    assert_eq!(data(&session).matrix(Matrix::E).entry(0, 3).unwrap().value, 0.5, "and in force");
}

#[test]
fn a_partition_follows_the_sizes() {
    let mut session = opened(PARTITIONED);
    for (of, grown) in [(Size::States, [4, 4, 2]), (Size::Equations, [4, 5, 2]), (Size::Outputs, [4, 5, 3])] {
        edit(&mut session, Edit::Size { of, grow: true });
        assert_eq!(sizes(&session), [[3, 3, 2], grown], "{of:?}: the last subsystem takes it");
    }
    edit(&mut session, Edit::Size { of: Size::Equations, grow: false });
    for _ in 0..3 {
        edit(&mut session, Edit::Size { of: Size::States, grow: false });
    }
    assert_eq!(sizes(&session)[1][0], 1, "one state is left");
    edit(&mut session, Edit::Size { of: Size::States, grow: false });
    assert!(sizes(&session).is_empty(), "the last state took its subsystem along");
    assert!(told(&session).0.contains("second"), "and that is said: {:?}", told(&session));
}

#[test]
fn a_new_sensor_belongs_to_the_subsystem_that_it_measures() {
    let mut session = opened(PARTITIONED);
    edit(&mut session, Edit::NoiseLevel { deviation: 0.1, done: true });
    let noise = session.document().scenario.noise.clone();
    edit(&mut session, Edit::AddSensor { state: 1 });
    assert_eq!(sizes(&session), [[3, 3, 3], [3, 3, 2]], "the first subsystem");
    let c = data(&session).matrix(Matrix::C).values();
    assert_eq!((c[(2, 1)], c[(3, 3)]), (1.0, 1.0), "behind its outputs, before the others: {c}");
    let after = &session.document().scenario.noise;
    assert_eq!((&after[..2], &after[3..]), (&noise[..2], &noise[2..]), "the noise stays with its outputs");
}

#[test]
fn decoupled_states_are_those_of_the_others() {
    let mut session = opened(PARTITIONED);
    let choose = |subsystem, state, exactly| Edit::Lmi(LmiEdit::Decouple { subsystem, state, exactly });
    edit(&mut session, choose(0, 5, true));
    edit(&mut session, choose(0, 3, true));
    edit(&mut session, choose(1, 0, true));
    assert_eq!(lmi(&session).decoupled, Some(vec![vec![3, 5], vec![0]]), "chosen by clicks");
    edit(&mut session, choose(0, 1, true));
    assert!(told(&session).1, "x2 is its own state");
    edit(&mut session, choose(0, 3, false));
    assert_eq!(lmi(&session).decoupled, Some(vec![vec![5], vec![0]]), "attenuated only");
    edit(&mut session, Edit::Size { of: Size::States, grow: false });
    assert_eq!(lmi(&session).decoupled, Some(vec![vec![], vec![0]]), "x6 is gone");
    edit(&mut session, Edit::Lmi(LmiEdit::Decoupled(None)));
    assert_eq!(lmi(&session).decoupled, None, "as many as possible again");
}

#[test]
fn a_nonlinearity_is_typed() {
    let mut session = opened(LIPSCHITZ);
    let f = |index, text: &str| Edit::Lipschitz(LipschitzEdit::Component { index, text: text.to_owned() });
    edit(&mut session, f(0, "sin(x2"));
    assert_eq!(data(&session).lipschitz.as_ref().unwrap().f, ["sin(x2)"], "the last good one is in force");
    assert!(!session.draft(&Field::Component(0)).unwrap().error.is_empty(), "it says what is wrong");
    edit(&mut session, f(0, "sin(x9)"));
    assert_eq!(session.n_drafts(), 1, "there is no x9");
    edit(&mut session, f(0, "tanh(x2)"));
    assert_eq!(
        (session.n_drafts(), data(&session).lipschitz.as_ref().unwrap().f[0].as_str()),
        (0, "tanh(x2)")
    );
    edit(&mut session, Edit::Lipschitz(LipschitzEdit::Size { of: LipschitzMatrix::G, grow: true }));
    edit(&mut session, f(1, "0.1*x3"));
    let at = |matrix, row, column, text: &str| {
        Edit::Lipschitz(LipschitzEdit::Cell { matrix, row, column, text: text.to_owned() })
    };
    edit(&mut session, at(LipschitzMatrix::G, 1, 1, "2"));
    edit(&mut session, Edit::Lipschitz(LipschitzEdit::Size { of: LipschitzMatrix::Arguments, grow: true }));
    edit(&mut session, at(LipschitzMatrix::Arguments, 1, 2, "1/10"));
    edit(&mut session, Edit::Lipschitz(LipschitzEdit::Constant("2^0.5".to_owned())));
    let term = data(&session).lipschitz.as_ref().unwrap().term(3).unwrap();
    assert_eq!((term.G[(1, 1)], term.F_L[(1, 2)], term.constant), (2.0, 0.1, 2.0_f64.sqrt()), "all in force");
    edit(&mut session, Edit::Lipschitz(LipschitzEdit::Constant("-1".to_owned())));
    assert!(session.draft(&Field::LipschitzConstant).is_some(), "no constant is negative");
    edit(&mut session, Edit::Size { of: Size::States, grow: false });
    let left = data(&session).lipschitz.as_ref().unwrap();
    assert_eq!(
        (left.f.as_slice(), left.G.shape(), left.F_L.shape()),
        (&["tanh(x2)".to_owned()][..], (2, 1), (2, 2))
    );
    assert!(told(&session).0.contains("0.1*x3"), "the lost component is named: {:?}", told(&session));
    edit(&mut session, Edit::Size { of: Size::States, grow: false });
    assert!(data(&session).lipschitz.is_none(), "f needs x2");
    assert!(told(&session).0.contains("tanh(x2)"), "and that is said: {:?}", told(&session));
    undo(&mut session);
    assert!(data(&session).lipschitz.is_some(), "nothing is lost");
    edit(&mut session, Edit::Lipschitz(LipschitzEdit::Remove));
    edit(&mut session, Edit::Lipschitz(LipschitzEdit::Add));
    assert_eq!(data(&session).lipschitz.as_ref().unwrap().f, ["sin(x1)"], "one to begin with");
    edit(&mut session, Edit::Lipschitz(LipschitzEdit::Size { of: LipschitzMatrix::G, grow: false }));
    assert!(told(&session).1, "the last component is removed with the whole");
}
