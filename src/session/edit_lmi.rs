//! Edits of the demands on designs by linear matrix inequalities.

use nalgebra::DMatrix;

use super::model_edits::{GivenPart, LmiEdit};
use super::state::{Draft, Field};
use super::update::Edited;
use crate::document::limits::MAX_SIDE;
use crate::document::{Document, Entry, PlantData, Sizes, matrix_from_text};
use crate::observer::{GivenObserver, LmiChoice, Method, Order};
use crate::system::TimeDomain;

/// Bounds of demands that are sizes, as documents have them.
const SIZE: [f64; 2] = [1e-9, 1e9];

/// Changes the demands of a document.
pub(super) fn change(document: &mut Document, edit: LmiEdit) -> Edited {
    let discrete = time(document) == TimeDomain::Discrete;
    let sizes = Sizes::of(&document.plant);
    let lmi = &mut document.design.lmi;
    match edit {
        LmiEdit::Decay { decay, .. } => {
            let most = if discrete { 1.0 } else { SIZE[1] };
            optional(&mut lmi.decay, decay, [SIZE[0], most]);
        }
        LmiEdit::Gain { gain, .. } => optional(&mut lmi.gain, gain, SIZE),
        LmiEdit::Gamma { gamma, .. } => optional(&mut lmi.gamma, gamma, SIZE),
        LmiEdit::Conditioning { conditioning, .. } => {
            within(&mut lmi.conditioning, conditioning, [1.0, 1e12]);
        }
        LmiEdit::BackOff { back_off, .. } => within(&mut lmi.back_off, back_off, [1e-6, 1.0]),
        LmiEdit::Seconds { seconds, .. } => within(&mut lmi.seconds, seconds, [0.01, 600.0]),
        LmiEdit::Alternative(alternative) => lmi.alternative = alternative,
        LmiEdit::Rows(rows) => {
            if let Some(bad) = rows.iter().find(|rows| !storable(rows)) {
                let (rows, columns) = bad.shape();
                return Edited::Refused(format!("R cannot be {rows} x {columns}, or an entry is not finite"));
            }
            lmi.rows = rows;
        }
        LmiEdit::RowsCell { subsystem, row, column, text } => {
            return rows_cell(lmi, (subsystem, row, column), text);
        }
        LmiEdit::RowsPaste { subsystem, text } => return rows_paste(lmi, subsystem, &text),
        LmiEdit::Decoupled(decoupled) => lmi.decoupled = decoupled,
        LmiEdit::Decouple { subsystem, state, exactly } => {
            return decouple(document, subsystem, state, exactly);
        }
        LmiEdit::Examine(given) => {
            if given.as_ref().is_some_and(|given| !storable(&given.N)) {
                return Edited::Refused(
                    "there is no dynamic observer to examine: its order is zero".to_owned(),
                );
            }
            lmi.given = given;
            fit_given(lmi, sizes.outputs);
        }
        LmiEdit::Given { part, text } => {
            let Some(given) = &mut lmi.given else { return Edited::Done };
            let understood = match part {
                GivenPart::N | GivenPart::J => given_matrix(given, part, &text),
                GivenPart::Gamma => claimed(&text).map(|gamma| given.gamma = gamma),
            };
            if let Err(error) = understood {
                return Edited::Draft(Field::Given(part), Draft { text, error });
            }
            fit_given(lmi, sizes.outputs);
        }
    }
    Edited::Done
}

/// The time domain of a document's system.
pub(super) fn time(document: &Document) -> TimeDomain {
    match &document.plant {
        PlantData::Descriptor(data) => data.time,
        PlantData::Network(_) => TimeDomain::Continuous,
    }
}

/// Order and demands to begin with; `None` for methods without matrix inequalities.
///
/// The exact optimum leaves modes that the disturbance does not excite where they are: a demand on the decay is what
/// makes a first design usable.
fn beginning(method: Method, time: TimeDomain) -> Option<(Order, LmiChoice)> {
    let discrete = time == TimeDomain::Discrete;
    let plain = LmiChoice::default();
    match method {
        Method::HInfinity => Some((Order::Reduced, LmiChoice { decay: (!discrete).then_some(0.5), ..plain })),
        Method::Decentralized => {
            let decay = discrete.then_some(0.95);
            Some((Order::Full, LmiChoice { decay, gain: Some(10.0), ..plain }))
        }
        Method::Proportional
        | Method::ProportionalIntegral
        | Method::InputDecoupled
        | Method::Hierarchical => None,
    }
}

/// Whether nobody has touched the demands yet.
fn untouched(lmi: &LmiChoice) -> bool {
    let begun = |method| {
        let times = [TimeDomain::Continuous, TimeDomain::Discrete];
        times.into_iter().any(|time| beginning(method, time).is_some_and(|(_, begun)| begun == *lmi))
    };
    *lmi == LmiChoice::default() || Method::ALL.into_iter().any(begun)
}

/// Chooses a method: an order that it has, and demands to begin with where nobody has made any.
pub(super) fn choose_method(document: &mut Document, method: Method) {
    let time = time(document);
    let design = &mut document.design;
    let changed = design.method != method;
    design.method = method;
    if let Some((order, lmi)) = beginning(method, time).filter(|_| changed && untouched(&design.lmi)) {
        (design.order, design.lmi) = (order, lmi);
    }
    if !method.orders().contains(&design.order)
        && let Some(first) = method.orders().first()
    {
        design.order = *first;
    }
}

/// Lets the demand on the decay follow a change between differential and difference equations; says when it went.
pub(super) fn follow_time(document: &mut Document, before: TimeDomain) -> Option<String> {
    let now = time(document);
    let (method, lmi) = (document.design.method, &mut document.design.lmi);
    if now == before || lmi.decay.is_none() && !untouched(lmi) {
        return None;
    }
    if untouched(lmi) {
        lmi.decay = beginning(method, now).and_then(|(_, begun)| begun.decay);
        return None;
    }
    lmi.decay = None;
    Some("the demand on the decay was made for the other kind of time: it is gone".to_owned())
}

fn optional(to: &mut Option<f64>, value: Option<f64>, [low, high]: [f64; 2]) {
    if value.is_none_or(f64::is_finite) {
        *to = value.map(|value| value.clamp(low, high));
    }
}

fn within(to: &mut f64, value: f64, [low, high]: [f64; 2]) {
    if value.is_finite() {
        *to = value.clamp(low, high);
    }
}

/// Whether a document can hold a matrix: not empty, not too large, all entries finite.
fn storable(matrix: &DMatrix<f64>) -> bool {
    let (rows, columns) = matrix.shape();
    rows > 0 && rows.max(columns) <= MAX_SIDE && matrix.iter().all(|value| value.is_finite())
}

fn rows_cell(lmi: &mut LmiChoice, (subsystem, row, column): (usize, usize, usize), text: String) -> Edited {
    let place = lmi.rows.get_mut(subsystem).and_then(|rows| rows.get_mut((row, column)));
    match (Entry::typed(&text), place) {
        (Ok(entry), Some(place)) => {
            *place = entry.value;
            Edited::Done
        }
        (Ok(_), None) => Edited::Done,
        (Err(error), _) => Edited::Draft(Field::Rows(subsystem, row, column), Draft { text, error }),
    }
}

fn rows_paste(lmi: &mut LmiChoice, subsystem: usize, text: &str) -> Edited {
    let Some(rows) = lmi.rows.get_mut(subsystem) else { return Edited::Done };
    let pasted = match matrix_of(text) {
        Ok(pasted) => pasted,
        Err(error) => return Edited::Refused(format!("what was pasted is not a matrix: {error}")),
    };
    if pasted.ncols() != rows.ncols() {
        return Edited::Refused(format!(
            "the pasted R has {} columns, but it needs one for each of the {} states",
            pasted.ncols(),
            rows.ncols()
        ));
    }
    *rows = pasted;
    Edited::Done
}

/// Reads a matrix in any notation, or a single number.
fn matrix_of(text: &str) -> Result<DMatrix<f64>, String> {
    let matrix = if let Ok(entry) = Entry::typed(text) {
        DMatrix::from_element(1, 1, entry.value)
    } else {
        let found = matrix_from_text(text).map_err(|error| error.to_string())?;
        let values = found.entries.iter().map(|(_, value)| *value);
        DMatrix::from_row_iterator(found.rows, found.columns, values)
    };
    if storable(&matrix) {
        return Ok(matrix);
    }
    Err(format!(
        "a matrix of 1 to {MAX_SIDE} rows and at most {MAX_SIDE} columns with finite entries is needed"
    ))
}

fn given_matrix(given: &mut GivenObserver, part: GivenPart, text: &str) -> Result<(), String> {
    let matrix = matrix_of(text)?;
    let (rows, columns) = matrix.shape();
    let order = given.N.nrows();
    match part {
        GivenPart::N if rows != columns => {
            return Err(format!("N is {rows} x {columns}, but it must be square"));
        }
        GivenPart::N => given.N = matrix,
        _ if (rows, columns) != (order, given.J.ncols()) => {
            let needed = given.J.ncols();
            return Err(format!(
                "J is {rows} x {columns}, but {order} x {needed} is needed: a row for each row of N, a column for each output"
            ));
        }
        _ => given.J = matrix,
    }
    Ok(())
}

fn claimed(text: &str) -> Result<Option<f64>, String> {
    if text.trim().is_empty() {
        return Ok(None);
    }
    let value = Entry::typed(text)?.value;
    if (SIZE[0]..=SIZE[1]).contains(&value) {
        return Ok(Some(value));
    }
    Err(format!("an attenuation is a positive number up to {:e}", SIZE[1]))
}

/// Gives the examined observer's `J` a row for each row of its `N` and a column for each output.
pub(super) fn fit_given(lmi: &mut LmiChoice, outputs: usize) {
    // a network can have more outputs than a document writes into one matrix
    lmi.given.take_if(|_| outputs > MAX_SIDE);
    if let Some(given) = &mut lmi.given {
        let shape = (given.N.nrows(), outputs);
        if given.J.shape() != shape {
            given.J.resize_mut(shape.0, shape.1, 0.0);
        }
    }
}

fn decouple(document: &mut Document, subsystem: usize, state: usize, exactly: bool) -> Edited {
    let PlantData::Descriptor(data) = &document.plant else { return Edited::Done };
    let count = data.partition.len();
    let first: usize = data.partition.iter().take(subsystem).map(|s| s.states).sum();
    let own = data.partition.get(subsystem).map_or(0, |s| s.states);
    let states: usize = data.partition.iter().map(|s| s.states).sum();
    if subsystem >= count || state >= states || (first..first + own).contains(&state) {
        return Edited::Refused(format!(
            "x{} is not a state of another subsystem: only those can be decoupled",
            state + 1
        ));
    }
    let lists = document.design.lmi.decoupled.get_or_insert_with(Vec::new);
    lists.resize(count, Vec::new());
    if let Some(list) = lists.get_mut(subsystem) {
        list.retain(|other| *other != state);
        if exactly {
            list.push(state);
        }
        list.sort_unstable();
    }
    Edited::Done
}
