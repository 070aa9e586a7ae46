//! Demands on designs by linear matrix inequalities in documents: reading and writing.
#![expect(non_snake_case, reason = "keys are matrix letters")]

use nalgebra::DMatrix;
use serde_json::{Map, Value, json};

use super::DocumentError;
use super::cursor::Cursor;
use super::entry::{EntryMatrix, number};
use super::limits::{MAX_SIDE, MAX_SUBSYSTEMS};
use super::read::Sizes;
use crate::observer::{GivenObserver, LmiChoice};

/// The word that stands for a gain without a bound.
const UNBOUNDED: &str = "unbounded";
/// Bounds of demands that are sizes: far beyond what any plant needs, and far from overflow.
const SIZE: [f64; 2] = [1e-9, 1e9];

pub(super) fn read_lmi(cursor: &Cursor<'_>, sizes: &Sizes) -> Result<LmiChoice, DocumentError> {
    let object = cursor.object(&[
        "decay",
        "gain",
        "conditioning",
        "gamma",
        "back off",
        "alternative",
        "R",
        "decoupled",
        "given",
        "seconds",
    ])?;
    let default = LmiChoice::default();
    let size = |key| object.get(key).map(|c| c.number_in(SIZE[0], SIZE[1])).transpose();
    let gain = match object.get("gain") {
        None => default.gain,
        Some(cursor) if cursor.is_text() => cursor.word(&[(UNBOUNDED, None)])?,
        Some(cursor) => Some(cursor.number_in(SIZE[0], SIZE[1])?),
    };
    let within = |key, low, high, or| object.get(key).map_or(Ok(or), |c| c.number_in(low, high));
    Ok(LmiChoice {
        decay: size("decay")?,
        gain,
        conditioning: within("conditioning", 1.0, 1e12, default.conditioning)?,
        gamma: size("gamma")?,
        back_off: within("back off", 1e-6, 1.0, default.back_off)?,
        alternative: object.get("alternative").map_or(Ok(default.alternative), |c| c.truth())?,
        rows: object.get("R").map_or(Ok(Vec::new()), |c| rows(&c))?,
        decoupled: object.get("decoupled").map(|c| decoupled(&c, sizes.states)).transpose()?,
        given: object.get("given").map(|c| given(&c)).transpose()?,
        seconds: within("seconds", 0.01, 600.0, default.seconds)?,
    })
}

/// `R` for each subsystem; their shapes are judged by the design, which knows the order.
fn rows(cursor: &Cursor<'_>) -> Result<Vec<DMatrix<f64>>, DocumentError> {
    let items = cursor.list(MAX_SUBSYSTEMS, "matrices R, one for each subsystem")?;
    items.iter().map(|item| EntryMatrix::read(item).map(|matrix| matrix.values())).collect()
}

/// For each subsystem the numbers of states, from one in the document and from zero in the program.
fn decoupled(cursor: &Cursor<'_>, states: usize) -> Result<Vec<Vec<usize>>, DocumentError> {
    let mut all = Vec::new();
    for item in cursor.list(MAX_SUBSYSTEMS, "lists of state numbers, one for each subsystem")? {
        let mut own = Vec::new();
        for state in item.list(MAX_SIDE, "state numbers")? {
            let number = usize::try_from(state.whole_in(1, states as u64)?).unwrap_or(usize::MAX);
            own.push(number - 1);
        }
        all.push(own);
    }
    Ok(all)
}

fn given(cursor: &Cursor<'_>) -> Result<GivenObserver, DocumentError> {
    let object = cursor.object(&["N", "J", "gamma"])?;
    let matrix = |key| {
        let cursor = object.need(key, "N and J of the observer that is examined are needed")?;
        EntryMatrix::read(&cursor).map(|matrix| matrix.values())
    };
    let (N, J) = (matrix("N")?, matrix("J")?);
    let gamma = object.get("gamma").map(|c| c.number_in(SIZE[0], SIZE[1])).transpose()?;
    if !N.is_square() || J.nrows() != N.nrows() {
        return Err(DocumentError::at(
            cursor.path(),
            format!("N is {} x {} and J is {} x {}", N.nrows(), N.ncols(), J.nrows(), J.ncols()),
            "N is square and J has as many rows as N",
        ));
    }
    Ok(GivenObserver { N, J, gamma })
}

/// The demands that are not at their defaults; `None` when all are.
pub(super) fn lmi_value(choice: &LmiChoice) -> Option<Value> {
    let default = LmiChoice::default();
    let LmiChoice {
        decay,
        gain,
        conditioning,
        gamma,
        back_off,
        alternative,
        rows,
        decoupled,
        given,
        seconds,
    } = choice;
    let mut map = Map::new();
    let mut put = |key: &str, differs: bool, value: Value| {
        if differs {
            map.insert(key.to_owned(), value);
        }
    };
    let optional = |value: &Option<f64>| value.map_or(Value::Null, number);
    put("decay", decay.is_some(), optional(decay));
    put("gain", *gain != default.gain, gain.map_or(json!(UNBOUNDED), number));
    put("conditioning", *conditioning != default.conditioning, number(*conditioning));
    put("gamma", gamma.is_some(), optional(gamma));
    put("back off", *back_off != default.back_off, number(*back_off));
    put("alternative", *alternative, json!(alternative));
    let matrix = |matrix: &DMatrix<f64>| EntryMatrix::from_matrix(matrix).write();
    put("R", !rows.is_empty(), rows.iter().map(matrix).collect());
    if let Some(decoupled) = decoupled {
        let own = |states: &Vec<usize>| states.iter().map(|state| json!(state + 1)).collect::<Value>();
        put("decoupled", true, decoupled.iter().map(own).collect());
    }
    if let Some(GivenObserver { N, J, gamma }) = given {
        let mut value = json!({ "N": matrix(N), "J": matrix(J) });
        if let Some(gamma) = gamma {
            value["gamma"] = number(*gamma);
        }
        put("given", true, value);
    }
    put("seconds", *seconds != default.seconds, number(*seconds));
    (!map.is_empty()).then_some(Value::Object(map))
}
