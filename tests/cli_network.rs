//! The commands on networks: one that is written as one system, and one that never is.
#![cfg(not(target_arch = "wasm32"))]
#![expect(clippy::unwrap_used, clippy::panic, reason = "helpers of tests fail by panicking")]

use std::io::Write as _;
use std::path::Path;
use std::process::{Command, Stdio};

use descry::paper::example;
use serde_json::{Value, json};

/// What a command said and how it ended.
struct Ran {
    code: i32,
    out: String,
    err: String,
}

impl Ran {
    fn json(&self) -> Value {
        serde_json::from_str(&self.out).unwrap_or_else(|error| panic!("{error}: {}", self.out))
    }
}

fn with_input(arguments: &[&str], input: &str) -> Ran {
    let mut child = Command::new(env!("CARGO_BIN_EXE_descry"))
        .args(arguments)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let mut stdin = child.stdin.take().unwrap();
    let input = input.to_owned();
    // a command that does not read its input closes it
    let writer = std::thread::spawn(move || drop(stdin.write_all(input.as_bytes())));
    let output = child.wait_with_output().unwrap();
    writer.join().unwrap();
    Ran {
        code: output.status.code().unwrap_or(-1),
        out: String::from_utf8(output.stdout).unwrap(),
        err: String::from_utf8(output.stderr).unwrap(),
    }
}

fn run(arguments: &[&str]) -> Ran {
    with_input(arguments, "")
}

/// An example with a change.
fn changed(key: &str, change: impl FnOnce(&mut Value)) -> String {
    let mut value = serde_json::from_str(example(key).unwrap().text).unwrap();
    change(&mut value);
    value.to_string()
}

const CHAIN: &str = "example:hierarchical";
const RING: &str = "example:network-ring";

fn property<'a>(report: &'a Value, id: &str) -> &'a Value {
    let all = report["properties"].as_array().unwrap();
    all.iter().find(|p| p["id"] == id).unwrap_or_else(|| panic!("no property {id}"))
}

fn columns(csv: &str) -> Vec<&str> {
    csv.lines().next().unwrap().split(',').collect()
}

#[test]
fn check_reports_the_structure_of_both_kinds_of_networks() {
    for (source, nu, subsystems) in [(CHAIN, 3, 4), (RING, 3, 1000)] {
        let ran = run(&["check", source]);
        assert_eq!((ran.code, ran.err.as_str()), (0, ""), "{source}: all needed conditions hold");
        let report = ran.json();
        assert_eq!(report["system"]["network"]["subsystems"], subsystems, "{source}");
        assert_eq!(report["system"]["states"], 5 * subsystems, "{source}: states together");
        assert_eq!(property(&report, "nu")["value"], nu, "{source}: rank Gamma");
        assert_eq!(property(&report, "mu")["value"], 2, "{source}");
        assert_eq!(property(&report, "order-of-the-whole")["value"], 6, "{source}: nu mu");
        let ids: Vec<&str> =
            report["conditions"].as_array().unwrap().iter().map(|c| c["id"].as_str().unwrap()).collect();
        assert!(ids.contains(&"003-P1-global") && ids.contains(&"003-11-Psi"), "{source}: {ids:?}");
        let whole = report["properties"].as_array().unwrap().iter().any(|p| p["id"] == "index");
        assert_eq!(whole, source == CHAIN, "{source}: only the small one is asked as one system");
    }
}

#[test]
fn design_reports_global_and_local_poles_and_what_is_plugged_in() {
    for (source, plugged) in [(CHAIN, json!([4])), (RING, json!([100, 500, 1000]))] {
        let ran = run(&["design", source]);
        assert_eq!(ran.code, 0, "{source}: {}", ran.err);
        let report = ran.json();
        let design = &report["designs"][0];
        assert_eq!(design["verdict"], "verified", "{source}");
        let found = &design["hierarchical"];
        assert_eq!(
            (&found["nu"], &found["mu"], &found["order_of_the_whole"]),
            (&json!(3), &json!(2), &json!(6))
        );
        assert_eq!(found["plugged"], plugged, "{source}: from one");
        let poles = |value: &Value| -> Vec<f64> {
            let pairs: Vec<[f64; 2]> =
                serde_json::from_value(value["placement"]["achieved"].clone()).unwrap();
            let mut real: Vec<f64> = pairs.into_iter().map(|[re, _]| re).collect();
            real.sort_by(|a, b| b.total_cmp(a));
            real
        };
        for (value, expected) in [
            (&found["global"], &[-2.0, -2.5, -3.0, -3.5, -4.0, -4.5][..]),
            (&found["local"][0], &[-4.0, -4.5, -5.0, -5.5, -6.0]),
        ] {
            let achieved = poles(value);
            assert_eq!(achieved.len(), expected.len(), "{source}");
            for (found, expected) in achieved.iter().zip(expected) {
                assert!((found - expected).abs() < 1e-6, "{source}: {found} instead of {expected}");
            }
        }
    }
    let report = run(&["design", RING]).json();
    let hubs = &report["designs"][0]["hierarchical"]["other_states_determined_by_the_whole"];
    assert_eq!(*hubs, json!([1, 1666, 3336]), "the first state of each hub");
}

#[test]
fn a_trajectory_holds_estimates_of_what_is_estimated_only() {
    let ran = run(&["simulate", CHAIN]);
    assert_eq!((ran.code, ran.err.as_str()), (0, ""), "nothing to say");
    let names = columns(&ran.out);
    assert_eq!(ran.out.lines().count(), 302, "a header and 301 instants");
    for name in ["t", "y3", "z6", "z6_hat", "ez6", "x1", "x20", "x16_hat", "e20"] {
        assert!(names.contains(&name), "{name} is in {names:?}");
    }
    for name in ["x1_hat", "e15", "z7", "y4"] {
        assert!(!names.contains(&name), "{name} is not in {names:?}");
    }
    let last: Vec<f64> = ran.out.lines().last().unwrap().split(',').map(|x| x.parse().unwrap()).collect();
    let value = |name: &str| last[names.iter().position(|other| *other == name).unwrap()];
    assert!((value("x16") - value("x16_hat") - value("e16")).abs() < 1e-12, "e = x - x_hat");
    assert!(value("ez1").abs() < 1e-2 && value("e16").abs() < 1e-2, "both converge");

    let ran = run(&["simulate", CHAIN, "--format", "json"]);
    let report = ran.json();
    let four = &report["subsystems"][3];
    assert_eq!((&four["subsystem"], &four["local_observer"]), (&json!(4), &json!(true)));
    assert_eq!(four["x_hat"][0].as_array().unwrap().len(), 301, "subsystem 4 is estimated");
    assert_eq!(report["subsystems"][0]["x_hat"], json!([null, null, null, null, null]), "subsystem 1 is not");
    assert_eq!(report["z_hat"].as_array().unwrap().len(), 6, "the whole");
}

#[test]
fn the_trajectory_of_a_large_network_holds_the_whole_and_what_is_plugged_in() {
    let ran = run(&["simulate", RING]);
    assert_eq!(ran.code, 0, "{}", ran.err);
    assert!(ran.err.contains("not estimated") && ran.err.contains("others"), "{}", ran.err);
    let names = columns(&ran.out);
    for name in ["y1", "y2", "z6_hat", "x496", "x500_hat", "e5000", "x1_hat"] {
        assert!(names.contains(&name), "{name} is in {names:?}");
    }
    assert!(!names.contains(&"x6") && !names.contains(&"x2_hat"), "{names:?}");
    let report = run(&["simulate", RING, "--format", "json"]).json();
    let numbers: Vec<u64> =
        report["subsystems"].as_array().unwrap().iter().map(|s| s["subsystem"].as_u64().unwrap()).collect();
    assert_eq!(numbers, [1, 100, 334, 500, 668, 1000], "plugged in, or seen in the whole");
}

#[test]
fn both_kinds_of_networks_have_the_figures_of_their_document_and_the_standard_ones() {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("network-figures");
    for key in ["hierarchical", "network-ring"] {
        let out = folder.join(key);
        let out = out.to_str().unwrap();
        let ran = run(&["figures", &format!("example:{key}"), "--out", out]);
        assert_eq!(ran.code, 0, "{key}: {}", ran.err);
        let without = changed(key, |value| drop(value.as_object_mut().unwrap().remove("figures")));
        let ran = with_input(&["figures", "-", "--out", out], &without);
        assert_eq!(ran.code, 0, "{key}: {}", ran.err);
        let report = ran.json();
        let figures = report["figures"].as_array().unwrap();
        let ids: Vec<&str> = figures.iter().map(|f| f["id"].as_str().unwrap()).collect();
        assert_eq!(ids, ["states", "errors", "unknown-input"], "{key}: no unknown input, so no Bode diagram");
        assert!(figures[0]["notes"][0].as_str().unwrap().contains("not estimated"), "{key}: {}", figures[0]);
    }
    let five = std::fs::read_to_string(folder.join("hierarchical/fig5.csv")).unwrap();
    assert_eq!(columns(&five)[..3], ["t (s)", "z1", "z1_hat"], "Fig. 5");
}

#[test]
fn exit_codes_tell_what_is_wrong() {
    let other = changed("network-ring", |value| value["design"]["method"] = json!("proportional"));
    for command in ["check", "design", "simulate"] {
        let ran = with_input(&[command, "-"], &other);
        assert_eq!(ran.code, 1, "{command}: the method cannot be used: {}", ran.err);
        assert!(ran.err.contains("5000 states"), "{command}: {}", ran.err);
    }
    let few = changed("network-ring", |value| value["design"]["poles"] = json!([-1]));
    let ran = with_input(&["design", "-"], &few);
    assert_eq!(ran.code, 2, "too few poles are bad input: {}", ran.err);
    assert!(ran.err.contains("global observer"), "which list: {}", ran.err);
    let undetectable = changed("hierarchical", |value| {
        value["system"]["network"]["c_L"] = json!([[0, 1, 0, 0, 0]]);
        value["system"]["network"]["Psi"] = json!([[1, 1, 0, 0]]);
    });
    let ran = with_input(&["check", "-"], &undetectable);
    assert_eq!(ran.code, 1, "Psi is outside the coupling");
    assert!(ran.err.contains("(11)"), "{}", ran.err);
}

#[test]
fn a_simulation_that_ends_at_once_is_refused() {
    let huge = changed("hierarchical", |value| value["scenario"]["x0"] = json!("1e30"));
    let ran = with_input(&["simulate", "-"], &huge);
    assert_eq!(ran.code, 1, "one system: {}", ran.err);
    let huge = changed("network-ring", |value| value["scenario"]["x0"] = json!("1e30"));
    let ran = with_input(&["simulate", "-"], &huge);
    assert_eq!(ran.code, 1, "never expanded: {}", ran.err);
    assert!(ran.err.contains("the trajectory ends at t = 0"), "{}", ran.err);
    let text = r#"{"descry":1,"system":{"E":[[1]],"A":[[-1]],"C":[[1]]},"design":{"method":"proportional","poles":[-2]},
        "scenario":{"x0":[1e30]}}"#;
    assert_eq!(with_input(&["simulate", "-"], text).code, 1, "and no network at all");
}

#[test]
fn compare_lists_the_designs_of_a_large_network() {
    let kept = changed("network-ring", |value| {
        value["compare"] = json!([{ "name": "faster", "design": { "method": "hierarchical", "order": "full",
            "poles": [-4, -5, -6, -7, -8, -9], "local poles": [-4, -4.5, -5, -5.5, -6] } }]);
    });
    let ran = with_input(&["compare", "-"], &kept);
    assert_eq!(ran.code, 0, "{}", ran.err);
    assert!(ran.out.contains("faster"), "{}", ran.out);
}
