//! Carrying out an edit: the change, what follows from it, drafts, and the step of the history.

use super::command::Edit;
use super::edit_compare::CompareEdit;
use super::edit_free::FreeEdit;
use super::follow::follow;
use super::model_edits::{GivenPart, LipschitzEdit, LmiEdit, PartitionEdit};
use super::network_edits::{NetworkCell, NetworkEdit};
use super::state::{Draft, Field, Message, Session};
use super::update::{Edited, replace};
use super::{
    edit_compare, edit_free, edit_lipschitz, edit_lmi, edit_network, edit_partition, edit_plant,
    edit_scenario, poles,
};
use crate::document::{Document, Entry, EntryMatrix, Matrix, NetworkMatrix, PlantData, limits};

/// Carries out an edit as one step, or as a part of the drag that it belongs to.
pub(super) fn apply(session: &mut Session, edit: Edit) {
    let drag = drag_key(&edit);
    let ends = drag.as_ref().is_none_or(|(_, done)| *done);
    let field = typed_field(&edit);
    let overwritten = overwritten(&edit);
    let fed_back = matches!(edit, Edit::Free(FreeEdit::Feedback(_) | FreeEdit::Paste(_)));
    let exchanged = matches!(&edit, Edit::Compare(edit) if edit_compare::exchanges(edit));
    let waiting = if ends { waiting_fields(&edit) } else { None };
    let mut document = (*session.document).clone();
    let (edited, told) = changed(&mut document, session, edit);
    match edited {
        Edited::Done => {
            if let Some(field) = field {
                session.drafts.remove(&field);
            }
            let resized = sizes(&session.document) != sizes(&document);
            session.drafts.retain(|field, _| keeps_meaning(field, &document, resized));
            if exchanged {
                session.drafts.retain(|field, _| !edit_compare::belongs_to_a_design(field));
            }
            if fed_back {
                session.drafts.retain(|field, _| !matches!(field, Field::FreeFeedback(..)));
            }
            session.drafts.retain(|field, _| !overwritten.covers(field));
            replace(session, document, drag.map(|(key, _)| key));
            if !told.is_empty() {
                session.message = Some(Message { text: told.join("; "), error: false });
            }
        }
        Edited::Draft(field, draft) => {
            session.drafts.insert(field, draft);
        }
        Edited::Refused(why) => session.message = Some(Message { text: why, error: true }),
    }
    if ends {
        session.history.drag_ended();
    }
    if let Some(waiting) = waiting {
        try_again(session, waiting);
    }
}

/// The matrix that an edit writes anew as a whole: what was typed into its cells before is gone.
enum Overwritten {
    Nothing,
    Matrix(Matrix),
    Network(NetworkMatrix),
}

impl Overwritten {
    fn covers(&self, field: &Field) -> bool {
        match (self, field) {
            (Self::Matrix(matrix), Field::Cell(cell)) => cell.matrix == *matrix,
            (Self::Network(matrix), Field::Network(cell)) => cell.matrix == *matrix,
            _ => false,
        }
    }
}

fn overwritten(edit: &Edit) -> Overwritten {
    match edit {
        Edit::Paste { cell, .. } => Overwritten::Matrix(cell.matrix),
        Edit::Fill { matrix, .. } => Overwritten::Matrix(*matrix),
        Edit::Network(NetworkEdit::Paste { cell, .. }) => Overwritten::Network(cell.matrix),
        Edit::Network(NetworkEdit::Template { .. }) => Overwritten::Network(NetworkMatrix::Gamma),
        _ => Overwritten::Nothing,
    }
}

/// The edit and what follows from it. An entry that the partition does not allow is a draft: its text stays.
fn changed(document: &mut Document, session: &Session, edit: Edit) -> (Edited, Vec<String>) {
    let typed = match &edit {
        Edit::Cell { cell, text } => Some((Field::Cell(*cell), text.clone())),
        _ => None,
    };
    let edited = match edit {
        Edit::Compare(edit) => edit_compare::change(document, edit, &session.history),
        edit => change(document, edit),
    };
    if !matches!(edited, Edited::Done) {
        return (edited, Vec::new());
    }
    match (follow(document, &session.document), typed) {
        (Ok(told), _) => (Edited::Done, told),
        (Err(error), Some((field, text))) => (Edited::Draft(field, Draft { text, error }), Vec::new()),
        (Err(error), None) => (Edited::Refused(error), Vec::new()),
    }
}

/// Which waiting drafts an edit may have made possible.
fn waiting_fields(edit: &Edit) -> Option<fn(&Field) -> bool> {
    match edit {
        Edit::Partition(PartitionEdit::Name { .. }) => None,
        Edit::Partition(_) => Some(|field| matches!(field, Field::Cell(_))),
        Edit::Lmi(LmiEdit::Given { part: GivenPart::N, .. }) => {
            Some(|field| matches!(field, Field::Given(GivenPart::J)))
        }
        _ => None,
    }
}

/// Tries drafts again that may be possible now; what was not even understood stays as it is.
fn try_again(session: &mut Session, waiting: fn(&Field) -> bool) {
    let drafts: Vec<(Field, String)> = session
        .drafts
        .iter()
        .filter(|(field, _)| waiting(field))
        .map(|(field, draft)| (field.clone(), draft.text.clone()))
        .collect();
    let told = session.message.take();
    for (field, text) in drafts {
        match field {
            Field::Cell(cell) if Entry::typed(&text).is_ok() => apply(session, Edit::Cell { cell, text }),
            Field::Given(part) => apply(session, Edit::Lmi(LmiEdit::Given { part, text })),
            _ => {}
        }
    }
    session.message = session.message.take().or(told);
}

/// Whether a draft's field still exists and means the same.
fn keeps_meaning(field: &Field, document: &Document, resized: bool) -> bool {
    let nonlinearity = match &document.plant {
        PlantData::Descriptor(data) => data.lipschitz.as_ref(),
        PlantData::Network(_) => None,
    };
    let lmi = &document.design.lmi;
    match field {
        Field::Poles | Field::LocalPoles | Field::InitialFormula => true,
        Field::Network(_) => !resized && is_network(document),
        Field::Subsystems => is_network(document),
        Field::Cell(_)
        | Field::Initial(_)
        | Field::Signal(..)
        | Field::Uncertainty(..)
        | Field::FreeSignal(_) => !resized,
        Field::Rows(subsystem, row, column) => {
            let there = |rows: &nalgebra::DMatrix<f64>| *row < rows.nrows() && *column < rows.ncols();
            !resized && lmi.rows.get(*subsystem).is_some_and(there)
        }
        Field::Given(_) => lmi.given.is_some(),
        Field::Lipschitz(..) => !resized && nonlinearity.is_some(),
        Field::Component(index) => nonlinearity.is_some_and(|lipschitz| *index < lipschitz.f.len()),
        Field::LipschitzConstant => nonlinearity.is_some(),
        Field::FreeFeedback(..) => !resized && document.scenario.free.feedback.is_some(),
        Field::KeptName(index) => *index < document.kept.len(),
    }
}

fn is_network(document: &Document) -> bool {
    matches!(document.plant, PlantData::Network(_))
}

/// Shapes of everything that is typed into cell by cell.
fn sizes(document: &Document) -> Vec<(usize, usize)> {
    let data = match &document.plant {
        PlantData::Descriptor(data) => data,
        PlantData::Network(data) => return NetworkMatrix::ALL.map(|matrix| data.shape(matrix)).into(),
    };
    let lipschitz = data.lipschitz.iter().flat_map(|lipschitz| [&lipschitz.G, &lipschitz.F_L]);
    data.matrices.iter().chain(lipschitz).map(EntryMatrix::shape).collect()
}

/// Key of a drag and whether it ends with this edit; `None` for an edit that is a step of its own.
fn drag_key(edit: &Edit) -> Option<(String, bool)> {
    match edit {
        Edit::MovePole { index, done, .. } => Some((format!("pole {index}"), *done)),
        Edit::Scale { done, .. } => Some(("scale".to_owned(), *done)),
        Edit::UncertaintyScale { done, .. } => Some(("uncertainty".to_owned(), *done)),
        Edit::NoiseLevel { done, .. } => Some(("noise".to_owned(), *done)),
        Edit::Lmi(edit) => demand_key(edit).map(|(key, done)| (key.to_owned(), done)),
        Edit::Partition(PartitionEdit::Move { border, done, .. }) => {
            Some((format!("border {border}"), *done))
        }
        Edit::Partition(PartitionEdit::Name { subsystem, .. }) => Some((format!("name {subsystem}"), false)),
        Edit::Title(_) => Some(("title".to_owned(), false)),
        Edit::Notes(_) => Some(("notes".to_owned(), false)),
        Edit::Horizon(_) => Some(("horizon".to_owned(), false)),
        Edit::Network(NetworkEdit::MoveLocalPole { index, done, .. }) => {
            Some((format!("local pole {index}"), *done))
        }
        _ => None,
    }
}

fn demand_key(edit: &LmiEdit) -> Option<(&'static str, bool)> {
    match edit {
        LmiEdit::Decay { done, .. } => Some(("decay", *done)),
        LmiEdit::Gain { done, .. } => Some(("gain", *done)),
        LmiEdit::Conditioning { done, .. } => Some(("conditioning", *done)),
        LmiEdit::Gamma { done, .. } => Some(("gamma", *done)),
        LmiEdit::BackOff { done, .. } => Some(("back off", *done)),
        LmiEdit::Seconds { done, .. } => Some(("seconds", *done)),
        _ => None,
    }
}

/// The field whose draft an edit clears when it is understood.
fn typed_field(edit: &Edit) -> Option<Field> {
    match edit {
        Edit::Cell { cell, .. } => Some(Field::Cell(*cell)),
        Edit::Poles(_) | Edit::MovePole { .. } => Some(Field::Poles),
        Edit::Initial { state, .. } => Some(Field::Initial(*state)),
        Edit::InitialFormula(_) => Some(Field::InitialFormula),
        Edit::Signal { list, index, .. } => Some(Field::Signal(*list, *index)),
        Edit::UncertaintyCell { row, column, frequency, .. } => {
            Some(Field::Uncertainty(*row, *column, *frequency))
        }
        Edit::Lmi(LmiEdit::RowsCell { subsystem, row, column, .. }) => {
            Some(Field::Rows(*subsystem, *row, *column))
        }
        Edit::Lmi(LmiEdit::Given { part, .. }) => Some(Field::Given(*part)),
        Edit::Lipschitz(LipschitzEdit::Cell { matrix, row, column, .. }) => {
            Some(Field::Lipschitz(*matrix, *row, *column))
        }
        Edit::Lipschitz(LipschitzEdit::Component { index, .. }) => Some(Field::Component(*index)),
        Edit::Lipschitz(LipschitzEdit::Constant(_)) => Some(Field::LipschitzConstant),
        Edit::Free(FreeEdit::Signal { index, .. }) => Some(Field::FreeSignal(*index)),
        Edit::Free(FreeEdit::Cell { row, column, .. }) => Some(Field::FreeFeedback(*row, *column)),
        Edit::Compare(CompareEdit::Rename { kept, .. }) => Some(Field::KeptName(*kept)),
        Edit::Network(edit) => typed_into_network(edit),
        _ => None,
    }
}

fn typed_into_network(edit: &NetworkEdit) -> Option<Field> {
    match edit {
        NetworkEdit::Cell { cell, .. } => Some(Field::Network(*cell)),
        NetworkEdit::Edge { to, from, .. } => {
            Some(Field::Network(NetworkCell { matrix: NetworkMatrix::Gamma, row: *to, column: *from }))
        }
        NetworkEdit::Subsystems(_) => Some(Field::Subsystems),
        NetworkEdit::LocalPoles(_) | NetworkEdit::MoveLocalPole { .. } => Some(Field::LocalPoles),
        _ => None,
    }
}

fn change(document: &mut Document, edit: Edit) -> Edited {
    match edit {
        Edit::Title(title) => document.title = clipped(title),
        Edit::Notes(notes) => document.notes = clipped(notes),
        Edit::Time(_)
        | Edit::Cell { .. }
        | Edit::Paste { .. }
        | Edit::Fill { .. }
        | Edit::Size { .. }
        | Edit::AddSensor { .. } => {
            let edited = edit_plant::change(document, edit);
            poles::provide(document);
            return edited;
        }
        Edit::Method(method) => {
            edit_lmi::choose_method(document, method);
            poles::provide(document);
        }
        Edit::Order(order) => {
            let method = document.design.method;
            if !method.orders().contains(&order) {
                let (method, order) = (method.title(), order.key());
                return Edited::Refused(format!("the {method} observer has no {order} order"));
            }
            document.design.order = order;
            poles::provide(document);
        }
        Edit::Poles(text) => match poles::parse(&text) {
            Ok(found) => document.design.poles = found,
            Err(error) => return Edited::Draft(Field::Poles, Draft { text, error }),
        },
        Edit::MovePole { index, to, .. } => {
            if to.re.is_finite() && to.im.is_finite() {
                poles::drag(document, index, to);
            }
        }
        Edit::Scale { scale, .. } => {
            if scale.is_finite() {
                document.design.scale = scale.clamp(0.01, 1000.0);
            }
        }
        Edit::RankTolerance(rank) => {
            if rank.is_finite() {
                document.tolerance.rank = rank.clamp(1.0, 1e12);
                // another rank of E asks for another number of poles
                poles::provide(document);
            }
        }
        Edit::Lmi(edit) => return edit_lmi::change(document, edit),
        Edit::Partition(PartitionEdit::Name { subsystem, name }) => {
            let name = clipped(name);
            return edit_partition::change(document, PartitionEdit::Name { subsystem, name });
        }
        Edit::Partition(edit) => return edit_partition::change(document, edit),
        Edit::Lipschitz(edit) => return edit_lipschitz::change(document, edit),
        Edit::Free(edit) => return edit_free::change(document, edit),
        // what is kept depends on the history, too
        Edit::Compare(_) => {}
        Edit::Network(edit) => return edit_network::change(document, edit),
        Edit::Initial { .. }
        | Edit::InitialFormula(_)
        | Edit::Signal { .. }
        | Edit::Horizon(_)
        | Edit::Samples(_)
        | Edit::UncertaintyScale { .. }
        | Edit::UncertaintyCell { .. }
        | Edit::NoiseLevel { .. } => return edit_scenario::change(document, edit),
    }
    Edited::Done
}

fn clipped(text: String) -> String {
    if text.len() <= limits::MAX_TEXT { text } else { text.chars().take(limits::MAX_TEXT / 4).collect() }
}
