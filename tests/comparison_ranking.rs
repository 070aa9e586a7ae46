//! Which numbers of a comparison are ranked, and what is said where there is none.
#![cfg(not(target_arch = "wasm32"))]
#![expect(clippy::unwrap_used, clippy::panic, reason = "helpers of tests fail by panicking")]

use descry::document::comparison::{ComparisonTable, comparison_table, comparison_to_markdown};
use descry::document::report::comparison_report;
use descry::document::{Document, read_document};
use descry::numerics::{Complex64, Watch};
use descry::observer::{Design, Method, assess};
use descry::paper::example;
use descry::simulation::comparison::{Compared, ComparedDesign, Contender, compare};
use descry::system::Model;
use serde_json::Value;

fn document() -> Document {
    read_document(example("comparison").unwrap().text).unwrap()
}

fn compared(document: &Document) -> Compared {
    let model = document.model().unwrap();
    let scenario = document.scenario(&model.system);
    compare(&model, &scenario, &document.contenders(), &document.tolerance, &Watch::none()).unwrap()
}

fn row<'a>(found: &'a Compared, name: &str) -> &'a ComparedDesign {
    let row = found.comparison.rows.iter().find(|row| row.name == name).unwrap();
    row.outcome.as_ref().unwrap_or_else(|error| panic!("{name}: {error}"))
}

fn design(document: &Document, contender: &Contender<'_>) -> Design {
    let model: Model = document.model().unwrap();
    assess(&model, contender.choice, &document.tolerance, &Watch::none()).unwrap().outcome.unwrap()
}

/// A network of which nothing is estimated, beside the same with a local observer.
const UNPLUGGED: &str = r#"{"descry":1,"system":{"network":{"a":[[-1,1],[0,-2]],"b":[[0],[1]],"c":[[1,0]],
"Gamma":[[-1,1],[1,-1]],"Psi":[[-1,1]],"c_G":[[1,0]],"c_L":[[1,0]],"local":[1,2]}},
"design":{"method":"hierarchical","order":"full","poles":[-3,-4],"local poles":[-5,-6],"plugged":[]},
"scenario":{"horizon":5,"samples":200,"x0":[1,0,0,-1]},
"compare":[{"name":"one","design":{"method":"hierarchical","order":"full","poles":[-3,-4],"local poles":[-5,-6],"plugged":[2]}},
{"name":"both","design":{"method":"hierarchical","order":"full","poles":[-3,-4],"local poles":[-5,-6]}},
{"name":"both, faster","design":{"method":"hierarchical","order":"full","poles":[-6,-8],"local poles":[-10,-12]}}]}"#;

#[test]
fn who_estimates_nothing_does_not_win_by_an_error_of_zero() {
    let mut document = read_document(UNPLUGGED).unwrap();
    let found = compared(&document);
    let first = row(&found, "chosen");
    assert_eq!(first.estimated, Vec::<usize>::new(), "nothing is plugged in");
    assert_eq!(first.scenario.as_ref().unwrap().all_states, None, "no error is not an error of zero");
    let table = comparison_table(&found.comparison);
    let line = |label: &str| table.lines.iter().find(|line| line.label == label).unwrap();
    assert_eq!(line("rms e").cells[0].text, "not estimated", "and says so");
    let estimates: Vec<&str> = line("Estimates").cells.iter().map(|cell| cell.text.as_str()).collect();
    assert_eq!(estimates, ["none of 4 states", "2 of 4 states", "all states", "all states"], "how many");
    for label in ["rms e", "largest e", "rms e, whole", "largest e, whole", "noise to e"] {
        let best = line(label).cells.iter().filter(|cell| cell.best).count();
        assert_eq!(best, 0, "{label}: errors of different states are not ranked");
    }
    let report: Value = serde_json::from_str(&comparison_report(&document, &found.comparison)).unwrap();
    let json = &report["designs"][0];
    assert!(json["scenario"]["rms"]["all_states"].is_null(), "null, not 0: {json}");
    assert_eq!(report["designs"][1]["estimated_states"], serde_json::json!([3, 4]), "from one");
    // designs that estimate the same states are ranked
    document.kept.remove(0);
    document.design = document.kept.remove(0).design;
    let table = comparison_table(&compared(&document).comparison);
    assert!(table.lines.iter().all(|line| line.label != "Estimates"), "both estimate everything");
    let line = table.lines.iter().find(|line| line.label == "noise to e").unwrap();
    assert_eq!(line.cells.iter().filter(|cell| cell.best).count(), 1, "{line:?}");
}

#[test]
fn what_means_something_else_for_each_design_is_not_ranked() {
    let mut found = compared(&document());
    let table = comparison_table(&found.comparison);
    let best = |table: &ComparisonTable, label: &str| {
        let line = table.lines.iter().find(|line| line.label == label).unwrap();
        line.cells.iter().filter(|cell| cell.best).count()
    };
    assert_eq!(best(&table, "|L|"), 0, "it depends on the coordinates of the observer's states");
    assert_eq!(best(&table, "Chosen gain"), 0, "it is another matrix for each method");
    assert_eq!(best(&table, "|V|"), 1, "it is the same in any coordinates");
    for (row, gamma) in found.comparison.rows.iter_mut().zip([None, None, None, Some(0.1), Some(2.0)]) {
        row.outcome.as_mut().unwrap().guaranteed = gamma;
    }
    let label = "Guaranteed gamma";
    assert_eq!(best(&comparison_table(&found.comparison), label), 0, "guarantees of two methods");
    found.comparison.rows[3].method = Method::HInfinity;
    assert_eq!(best(&comparison_table(&found.comparison), label), 1, "guarantees of one method");
}

#[test]
fn of_a_lipschitz_plant_the_norms_are_said_to_be_those_of_the_linear_part() {
    let document = read_document(example("h-infinity-lipschitz").unwrap().text).unwrap();
    let found = compared(&document);
    let markdown = comparison_to_markdown(&found.comparison);
    assert!(markdown.contains("**H-infinity norms of the error, linear part alone**"), "{markdown}");
    assert!(markdown.contains("\n- the plant has a Lipschitz term"), "{markdown}");
    let report: Value = serde_json::from_str(&comparison_report(&document, &found.comparison)).unwrap();
    assert_eq!(report["norms_of_linear_part"], true, "the report says so");
    assert!(report["notes"].to_string().contains("f = 0"), "{}", report["notes"]);
    let linear = comparison_to_markdown(&compared(&self::document()).comparison);
    assert!(!linear.contains("linear part"), "nothing to say of a linear plant: {linear}");
}

#[test]
fn a_plant_without_outputs_has_no_noise() {
    let text = r#"{"descry":1,"system":{"E":[[1]],"A":[[-1]],"D":[[1]]},
        "design":{"method":"proportional","order":"full","poles":[-2]}}"#;
    let document = read_document(text).unwrap();
    let found = compared(&document);
    let report: Value = serde_json::from_str(&comparison_report(&document, &found.comparison)).unwrap();
    let norms = &report["designs"][0]["h_infinity_norms"];
    assert_eq!(norms["noise to e"]["why"], "the plant has no output, hence no noise", "{report}");
    assert!(norms["d to e"]["norm"].is_number(), "the unknown input is there: {norms}");
}

#[test]
fn fixed_modes_and_gains_of_local_observers_are_in_the_table() {
    // the second state does not show the first one: -1 stays whatever the local gain
    let text = UNPLUGGED.replace(r#""c_L":[[1,0]]"#, r#""c_L":[[0,1]]"#);
    let document = read_document(&text).unwrap();
    let found = compared(&document);
    let (none, all) = (row(&found, "chosen"), row(&found, "both"));
    assert_eq!(none.fixed_modes, Vec::<Complex64>::new(), "the whole is seen completely");
    assert!(
        all.fixed_modes.len() == 1 && (all.fixed_modes[0] + 1.0).norm() < 1e-9,
        "the first state of a subsystem is not seen by its second: {:?}",
        all.fixed_modes
    );
    let design = design(&document, &document.contenders()[3]);
    let observer = design.hierarchical.unwrap();
    let largest_of_h = observer.locals().map(|(_, local)| local.h.norm()).fold(0.0, f64::max);
    let faster = row(&found, "both, faster");
    assert!(faster.chosen_gain >= largest_of_h * (1.0 - 1e-12), "{} and {largest_of_h}", faster.chosen_gain);
}
