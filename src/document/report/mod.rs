//! Reports of the headless commands as JSON: conditions, designs, properties and trajectories with their evidence.
//!
//! Every report has `"descry_report": 1` and the name of its command. Numbers read back to the last bit; what JSON has
//! no number for is the text `"inf"`, `"-inf"` or `"nan"` (a gap is `"inf"` when nothing is left below it). Complex
//! numbers are `[real, imaginary]`, matrices are lists of rows. Keys keep their order: same document, same bytes.

mod comparison;
mod condition;
mod design;
mod errata;
mod figures;
mod network;
mod properties;
mod trajectory;

use nalgebra::DMatrix;
use serde_json::{Map, Value, json};

use super::entry::number as finite_number;
use super::model::{Document, PlantData};
use super::pretty::pretty;
use super::read::Sizes;
use crate::numerics::Complex64;
use crate::observer::hierarchical::HierarchicalObserver;
use crate::observer::{Assessment, Condition, MethodLight};
use crate::paper::{Erratum, Motion};
use crate::simulation::Trajectory;
use crate::simulation::comparison::Comparison;
use crate::system::{Model, Network, TimeDomain};

pub use figures::{FigureFiles, WrittenFigure};

/// Version of the reports.
pub const REPORT_VERSION: u64 = 1;

/// Report of `descry check`: properties of the system, lights of all methods and conditions of the chosen one.
pub fn check_report(
    document: &Document,
    model: &Model,
    lights: &[MethodLight],
    conditions: &[Condition],
) -> String {
    let mut properties = properties::properties(&model.system, &document.tolerance);
    if let Some(network) = &model.network {
        properties.extend(network::properties(network, &document.tolerance));
    }
    checked(document, (properties, lights), conditions, document.design.method.missing(model))
}

/// Report of `descry check` for a network that is too large to be written as one system.
pub fn network_check_report(
    document: &Document,
    network: &Network,
    lights: &[MethodLight],
    conditions: &[Condition],
) -> String {
    let properties = network::properties(network, &document.tolerance);
    checked(document, (properties, lights), conditions, document.design.method.missing_for(network))
}

fn checked(
    document: &Document,
    (properties, lights): (Vec<Value>, &[MethodLight]),
    conditions: &[Condition],
    unsuitable: Option<String>,
) -> String {
    let mut map = head("check", document);
    map.insert("properties".to_owned(), Value::Array(properties));
    let light = |found: &MethodLight| json!({ "method": found.method.key(), "light": found.light.key(), "why": found.why });
    map.insert("methods".to_owned(), lights.iter().map(light).collect());
    put_conditions(&mut map, conditions);
    let holds = conditions.iter().all(|condition| !condition.needed || condition.verdict.holds());
    let verdict = match (&unsuitable, holds) {
        (Some(_), _) => "the method cannot be used",
        (None, true) => "the needed conditions hold",
        (None, false) => "a needed condition does not hold",
    };
    map.insert("verdict".to_owned(), json!(verdict));
    map.insert("notes".to_owned(), json!(unsuitable.into_iter().collect::<Vec<String>>()));
    pretty(&Value::Object(map))
}

/// Report of `descry design`: conditions, the designs with their matrices, and their verification.
pub fn design_report(document: &Document, assessment: &Assessment) -> String {
    let mut map = head("design", document);
    put_conditions(&mut map, &assessment.conditions);
    map.insert("designs".to_owned(), Value::Array(vec![design::design(assessment)]));
    pretty(&Value::Object(map))
}

/// Report of `descry simulate --format json`, on one line.
pub fn trajectory_report(document: &Document, trajectory: &Trajectory) -> String {
    let mut map = head("simulate", document);
    trajectory::put(&mut map, trajectory);
    format!("{}\n", Value::Object(map))
}

/// The same for a network, whether it was written as one system or not: the whole, and each subsystem.
pub fn network_motion_report(
    document: &Document,
    network: &Network,
    observer: Option<&HierarchicalObserver>,
    motion: &Motion,
) -> String {
    let mut map = head("simulate", document);
    network::put_motion(&mut map, network, observer, motion);
    format!("{}\n", Value::Object(map))
}

/// Report of `descry figures`: the files that were written, and what could not be made.
pub fn figures_report(document: &Document, figures: &[WrittenFigure]) -> String {
    let mut map = Map::new();
    put_command(&mut map, "figures", document);
    map.insert("figures".to_owned(), figures.iter().map(figures::figure).collect());
    pretty(&Value::Object(map))
}

/// Report of `descry compare`: the chosen design and those that are kept beside it.
pub fn comparison_report(document: &Document, comparison: &Comparison) -> String {
    let mut map = Map::new();
    put_command(&mut map, "compare", document);
    comparison::put(&mut map, comparison);
    pretty(&Value::Object(map))
}

/// Report of `descry errata`: misprints, omissions and mistakes with what proves them.
pub fn errata_report(found: &[&Erratum]) -> String {
    let listed: Vec<Value> = found.iter().map(|erratum| errata::erratum(erratum)).collect();
    pretty(&json!({ "descry_report": REPORT_VERSION, "command": "errata", "errata": listed }))
}

fn put_command(map: &mut Map<String, Value>, command: &str, document: &Document) {
    map.insert("descry_report".to_owned(), json!(REPORT_VERSION));
    map.insert("command".to_owned(), json!(command));
    map.insert("title".to_owned(), json!(document.title));
}

/// What every report begins with.
fn head(command: &str, document: &Document) -> Map<String, Value> {
    let mut map = Map::new();
    put_command(&mut map, command, document);
    let discrete =
        matches!(&document.plant, PlantData::Descriptor(data) if data.time == TimeDomain::Discrete);
    let sizes = Sizes::of(&document.plant);
    let mut system = json!({
        "time": if discrete { "discrete" } else { "continuous" },
        "states": sizes.states,
        "equations": sizes.equations,
        "known_inputs": sizes.inputs,
        "unknown_inputs": sizes.unknown,
        "outputs": sizes.outputs,
    });
    if let PlantData::Network(data) = &document.plant
        && let Ok(network) = data.network()
    {
        system["network"] = network::sizes(&network);
    }
    map.insert("system".to_owned(), system);
    map.insert("method".to_owned(), json!(document.design.method.key()));
    map.insert("order".to_owned(), json!(document.design.order.key()));
    map
}

fn put_conditions(map: &mut Map<String, Value>, conditions: &[Condition]) {
    map.insert("conditions".to_owned(), conditions.iter().map(condition::condition).collect());
}

/// A number that reads back exactly, or the text of what JSON has no number for.
fn number(x: f64) -> Value {
    if x.is_finite() {
        return finite_number(x);
    }
    json!(if x.is_nan() {
        "nan"
    } else if x > 0.0 {
        "inf"
    } else {
        "-inf"
    })
}

fn numbers<'a>(values: impl IntoIterator<Item = &'a f64>) -> Value {
    values.into_iter().map(|x| number(*x)).collect()
}

fn complex(z: Complex64) -> Value {
    json!([number(z.re), number(z.im)])
}

fn complexes<'a>(values: impl IntoIterator<Item = &'a Complex64>) -> Value {
    values.into_iter().map(|z| complex(*z)).collect()
}

/// A matrix as a list of rows.
fn matrix(matrix: &DMatrix<f64>) -> Value {
    matrix.row_iter().map(|row| row.iter().map(|x| number(*x)).collect::<Value>()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_not_finite_is_a_text() {
        assert_eq!(numbers(&[f64::INFINITY, f64::NEG_INFINITY, f64::NAN]), json!(["inf", "-inf", "nan"]));
    }

    #[test]
    fn numbers_read_back_to_the_last_bit() {
        for x in [1.0 / 3.0, -0.0, 1e-310, f64::MAX, 9.007_199_254_740_993e15, -17.0] {
            let text = number(x).to_string();
            let read: f64 = serde_json::from_str(&text).unwrap();
            assert_eq!(read.to_bits(), x.to_bits(), "{text}");
        }
    }
}
