//! The commands as a person runs them: answers, exit codes, files.
#![cfg(not(target_arch = "wasm32"))]
#![expect(clippy::unwrap_used, clippy::panic, reason = "helpers of tests fail by panicking")]

use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use serde_json::Value;

/// What a command said and how it ended.
struct Ran {
    code: i32,
    out: String,
    err: String,
}

impl Ran {
    fn json(&self) -> Value {
        let value: Value =
            serde_json::from_str(&self.out).unwrap_or_else(|error| panic!("{error}: {}", self.out));
        assert_eq!(value["descry_report"], 1, "every report carries its version");
        value
    }
}

fn with_input(arguments: &[&str], input: &[u8]) -> Ran {
    let mut child = Command::new(env!("CARGO_BIN_EXE_descry"))
        .args(arguments)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let mut stdin = child.stdin.take().unwrap();
    let input = input.to_vec();
    // a command that does not read its input closes it
    let writer = std::thread::spawn(move || drop(stdin.write_all(&input)));
    let output = child.wait_with_output().unwrap();
    writer.join().unwrap();
    Ran {
        code: output.status.code().unwrap_or(-1),
        out: String::from_utf8(output.stdout).unwrap(),
        err: String::from_utf8(output.stderr).unwrap(),
    }
}

fn run(arguments: &[&str]) -> Ran {
    with_input(arguments, b"")
}

/// A fresh folder for the files of one test.
fn folder(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    if folder.exists() {
        std::fs::remove_dir_all(&folder).unwrap();
    }
    folder
}

fn matrix(value: &Value) -> Vec<Vec<f64>> {
    serde_json::from_value(value.clone()).unwrap()
}

fn condition<'a>(report: &'a Value, id: &str) -> &'a Value {
    let conditions = report["conditions"].as_array().unwrap();
    conditions.iter().find(|c| c["id"] == id).unwrap_or_else(|| panic!("no condition {id}"))
}

const EXAMPLE: &str = "example:proportional-integral";

#[test]
fn check_reports_conditions_and_properties_of_the_example() {
    let ran = run(&["check", EXAMPLE]);
    assert_eq!((ran.code, ran.err.as_str()), (0, ""), "all needed conditions hold");
    let report = ran.json();
    assert_eq!(report["command"], "check");
    for id in ["004-8", "004-9", "004-10", "004-11", "004-22", "004-23"] {
        assert_eq!(condition(&report, id)["verdict"], "holds", "{id}");
    }
    let nine = condition(&report, "004-9");
    assert_eq!(nine["statement"], "rank [E* A*; 0 E*; 0 C*] = n + rank E*");
    let printed = &nine["evidence"][1];
    assert_eq!((&printed["rank"], &printed["required"]), (&Value::from(6), &Value::from(6)));
    let smallest = nine["evidence"][0]["singular_values"][1].as_f64().unwrap();
    assert!((smallest - 0.618_033_988_749_894_8).abs() < 1e-12, "compressed sigma_min {smallest}");
    let properties = report["properties"].as_array().unwrap();
    let property = |id: &str| properties.iter().find(|p| p["id"] == id).unwrap();
    assert_eq!(property("index")["value"], 1);
    assert_eq!(property("impulse-observable")["verdict"], "holds");
    assert_eq!(property("rank-E")["value"], 2);
}

#[test]
fn check_needs_no_poles() {
    let text = r#"{"descry":1,"system":{"E":[[1]],"A":[[0]],"C":[[1]],"D":[[1]]}}"#;
    let ran = with_input(&["check", "-"], text.as_bytes());
    assert_eq!(ran.code, 0, "{}", ran.err);
    let ran = with_input(&["design", "-"], text.as_bytes());
    assert_eq!(ran.code, 2, "the design does: {}", ran.out);
    assert!(ran.err.contains("0 poles are given, but this design places 2"), "{}", ran.err);
    assert_eq!(ran.json()["designs"][0]["verdict"], "bad input");
}

#[test]
fn design_reports_the_reference_gains() {
    let reference: Value = serde_json::from_str(include_str!("reference/ex004.json")).unwrap();
    let ran = run(&["design", EXAMPLE]);
    assert_eq!(ran.code, 0, "{}", ran.err);
    let report = ran.json();
    let design = &report["designs"][0];
    assert_eq!(design["verdict"], "verified");
    assert_eq!(design["order_number"], 3, "r + nf");
    for name in ["F", "L2", "L3", "M1", "T2"] {
        let (found, expected) =
            (matrix(&design["matrices"][name]), matrix(&reference["reduced"]["reference"][name]));
        let size = expected.iter().flatten().fold(1.0_f64, |size, x| size.max(x.abs()));
        for (found, expected) in found.iter().flatten().zip(expected.iter().flatten()) {
            assert!((found - expected).abs() < 1e-9 * size, "{name}: {found} instead of {expected}");
        }
    }
    for name in ["N", "L", "H", "P", "V", "W", "Q", "R", "S"] {
        assert!(design["observer"][name].is_array(), "{name} of the common form");
    }
    assert_eq!(matrix(&design["observer"]["N"]).len(), 3, "N is square of the observer's order");
    let checks = design["verification"]["checks"].as_array().unwrap();
    assert!(checks.len() >= 7 && checks.iter().all(|check| check["passed"] == true), "{checks:#?}");
    let spectrum = matrix(&design["spectrum"]);
    assert!(spectrum.iter().any(|z| (z[0] + 26.0).abs() < 1e-6), "{spectrum:?}");
}

#[test]
fn an_unseen_impulse_is_refused_with_the_state_and_the_sensor() {
    let ran = run(&["check", "example:unseen-impulse"]);
    assert_eq!(ran.code, 1, "condition (9) fails");
    let report = ran.json();
    let nine = condition(&report, "004-9");
    assert_eq!(nine["verdict"], "fails");
    assert_eq!(nine["witness"]["main"], serde_json::json!(["x3"]), "the witness names the state");
    assert!(nine["witness"]["s"].is_null(), "an impulse belongs to no finite s");
    let remedies = nine["remedies"].to_string();
    assert!(remedies.contains("measure x3"), "{remedies}");
    assert!(ran.err.contains("condition (9) does not hold"), "{}", ran.err);
    for command in ["design", "simulate"] {
        assert_eq!(run(&[command, "example:unseen-impulse"]).code, 1, "{command}");
    }
}

#[test]
fn the_proposed_sensor_mends_the_unseen_impulse() {
    let text = run(&["examples", "unseen-impulse"]).out;
    let mended = text.replace("\"C\":[[0,1,0]]", "\"C\":[[0,1,0],[0,0,1]]");
    assert_ne!(mended, text, "the example's output matrix was found");
    let ran = with_input(&["design", "-"], mended.as_bytes());
    assert_eq!((ran.code, ran.err.as_str()), (0, ""), "with a sensor of x3 the general form is verified");
}

#[test]
fn an_input_in_an_algebraic_equation_needs_the_general_form() {
    assert_eq!(run(&["design", "example:input-in-constraint"]).code, 0, "the general form is verified");
    let text = run(&["examples", "input-in-constraint"]).out;
    let reduced = text.replace("\"order\":\"general\"", "\"order\":\"reduced\"");
    assert_ne!(reduced, text, "the example's order was found");
    let ran = with_input(&["check", "-"], reduced.as_bytes());
    assert_eq!(ran.code, 1);
    assert_eq!(condition(&ran.json(), "004-8")["verdict"], "fails");
}

#[test]
fn deadbeat_learns_the_load_in_three_steps() {
    let ran = run(&["examples", "discrete"]);
    let deadbeat = ran.out.replacen("\"poles\":[0.2,0.25,0.3,0.35]", "\"poles\":[0,0,0,0]", 1);
    assert_ne!(deadbeat, ran.out, "the example's poles were found");
    let ran = with_input(&["simulate", "-"], deadbeat.as_bytes());
    assert_eq!((ran.code, ran.err.as_str()), (0, ""), "verified and simulated");
    let rows = table(&ran.out);
    let column = rows.0.iter().position(|name| name == "d1_hat").unwrap();
    for row in &rows.1 {
        let expected = if row[0] >= 23.0 {
            Some(0.3)
        } else if row[0] <= 20.0 {
            Some(0.0)
        } else {
            None
        };
        if let Some(expected) = expected {
            assert!((row[column] - expected).abs() < 1e-9, "k = {}: {}", row[0], row[column]);
        }
    }
}

/// Names and numbers of comma-separated values.
fn table(csv: &str) -> (Vec<String>, Vec<Vec<f64>>) {
    let mut lines = csv.lines();
    let names: Vec<String> = lines.next().unwrap().split(',').map(str::to_owned).collect();
    let row = |line: &str| line.split(',').map(|x| x.parse().unwrap()).collect::<Vec<f64>>();
    let rows: Vec<Vec<f64>> = lines.map(row).collect();
    assert!(rows.iter().all(|row| row.len() == names.len()), "every line has a field for each column");
    (names, rows)
}

#[test]
fn simulate_writes_the_columns_in_order() {
    let ran = run(&["simulate", EXAMPLE]);
    assert_eq!((ran.code, ran.err.as_str()), (0, ""));
    let (names, rows) = table(&ran.out);
    assert_eq!(
        names.join(","),
        "t,u1,d1,y1,x1,x2,x3,x4,x1_hat,x2_hat,x3_hat,x4_hat,d1_hat,e1,e2,e3,e4",
        "signals, states, estimates, errors"
    );
    assert_eq!(rows.len(), 601);
    assert!((rows[600][0] - 6.0).abs() < 1e-12 && rows[0][4] == 0.5, "from x1 = 0.5 to t = 6");
}

#[test]
fn json_and_csv_hold_the_same_trajectory() {
    let csv = table(&run(&["simulate", EXAMPLE, "--format", "csv"]).out);
    let report = run(&["simulate", EXAMPLE, "--format", "json"]).json();
    let d_hat = matrix(&report["observers"][0]["d_hat"]);
    for (row, value) in csv.1.iter().zip(&d_hat[0]) {
        assert_eq!(row[12].to_bits(), value.to_bits(), "t = {}", row[0]);
    }
}

#[test]
fn the_same_document_gives_the_same_bytes() {
    for arguments in [["check", EXAMPLE], ["design", EXAMPLE], ["simulate", EXAMPLE]] {
        assert_eq!(run(&arguments).out, run(&arguments).out, "{arguments:?}");
    }
}

#[test]
fn figures_are_written_as_svg_and_csv() {
    let out = folder("figures");
    let ran = run(&["figures", EXAMPLE, "--out", out.to_str().unwrap()]);
    assert_eq!((ran.code, ran.err.as_str()), (0, ""));
    let report = ran.json();
    let figures = report["figures"].as_array().unwrap();
    for id in ["fig1", "fig5", "fig8", "fig8-reduced", "fig9"] {
        assert!(figures.iter().any(|figure| figure["id"] == id), "{id} is missing");
    }
    for figure in figures {
        let id = figure["id"].as_str().unwrap();
        let svg = std::fs::read_to_string(figure["svg"].as_str().unwrap()).unwrap();
        assert_well_formed(&svg, id);
        assert!(svg.contains("<path") && !svg.contains("NaN") && !svg.contains("inf"), "{id}");
        let csv = std::fs::read_to_string(figure["csv"].as_str().unwrap()).unwrap();
        assert!(csv.lines().count() > 100, "{id}: {} lines", csv.lines().count());
    }
    let bode = table(&std::fs::read_to_string(out.join("fig8-reduced.csv")).unwrap());
    assert_eq!(bode.0[..3], ["frequency (rad/s)", "magnitude (dB): 1 Lambda", "magnitude (dB): 10 Lambda"]);
    assert!((bode.1[0][1] + 26.885).abs() < 0.01, "magnitude at low frequency: {}", bode.1[0][1]);
}

/// Every tag is closed by its own, and there is nothing but text and tags.
fn assert_well_formed(svg: &str, id: &str) {
    let mut open: Vec<&str> = Vec::new();
    let mut rest = svg;
    while let Some(start) = rest.find('<') {
        assert!(!rest[..start].contains('>'), "{id}: stray `>`");
        let end = start + rest[start..].find('>').unwrap_or_else(|| panic!("{id}: tag without end"));
        let tag = &rest[start + 1..end];
        assert!(tag.matches('"').count().is_multiple_of(2), "{id}: quotes of <{tag}>");
        if let Some(name) = tag.strip_prefix('/') {
            assert_eq!(open.pop(), Some(name), "{id}: </{name}>");
        } else if !tag.ends_with('/') {
            open.push(tag.split_whitespace().next().unwrap());
        }
        rest = &rest[end + 1..];
    }
    assert!(open.is_empty(), "{id}: not closed: {open:?}");
}

#[test]
fn a_single_figure_can_be_chosen_and_a_wrong_id_is_named() {
    let out = folder("single");
    let ran = run(&["figures", EXAMPLE, "--out", out.to_str().unwrap(), "--only", "fig6"]);
    assert_eq!(ran.code, 0, "{}", ran.err);
    let mut names: Vec<String> =
        std::fs::read_dir(&out).unwrap().map(|f| f.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    assert_eq!(names, ["fig6.csv", "fig6.svg"]);
    let ran = run(&["figures", EXAMPLE, "--out", out.to_str().unwrap(), "--only", "fgi6"]);
    assert_eq!(ran.code, 2);
    assert!(ran.err.contains("there is no figure \"fgi6\""), "{}", ran.err);
}

#[test]
fn a_document_without_figures_has_the_standard_ones() {
    let out = folder("standard");
    let text = r#"{"descry":1,"system":{"E":[[1]],"A":[[-1]],"C":[[1]],"D":[[1]]},
        "design":{"poles":[-3,-4]},"scenario":{"d":["step(t-1)"]}}"#;
    let ran = with_input(&["figures", "-", "--out", out.to_str().unwrap()], text.as_bytes());
    assert_eq!((ran.code, ran.err.as_str()), (0, ""));
    let ids: Vec<Value> = ran.json()["figures"].as_array().unwrap().iter().map(|f| f["id"].clone()).collect();
    assert_eq!(ids, ["states", "errors", "unknown-input", "bode"]);
}

#[test]
fn a_figure_that_cannot_be_made_is_listed_with_its_reason() {
    let out = folder("refused");
    let text =
        run(&["examples", "input-in-constraint"]).out.replace("\"order\":\"general\"", "\"order\":\"full\"");
    let ran = with_input(&["figures", "-", "--out", out.to_str().unwrap()], text.as_bytes());
    assert_eq!(ran.code, 1);
    let error = ran.json()["figures"][0]["error"].to_string();
    assert!(error.contains("condition (8) does not hold"), "{error}");
}

#[test]
fn every_example_behaves_as_its_title_says() {
    let out = folder("examples");
    for (key, code) in
        [("proportional-integral", 0), ("unseen-impulse", 1), ("input-in-constraint", 0), ("discrete", 0)]
    {
        let file = format!("example:{key}");
        for command in ["check", "design", "simulate"] {
            assert_eq!(run(&[command, &file]).code, code, "{command} {key}");
        }
        let folder = out.join(key);
        let ran = run(&["figures", &file, "--out", folder.to_str().unwrap()]);
        assert_eq!(ran.code, code, "figures {key}");
        if code == 0 {
            let report = ran.json();
            let figures = report["figures"].as_array().unwrap();
            assert!(
                figures.iter().all(|figure| figure["notes"] == serde_json::json!([])),
                "{key}: {figures:#?}"
            );
        }
    }
}

#[test]
fn examples_are_listed_and_written_out() {
    let ran = run(&["examples"]);
    assert_eq!(ran.code, 0);
    for key in ["proportional-integral", "unseen-impulse", "input-in-constraint", "discrete"] {
        assert!(ran.out.lines().any(|line| line.starts_with(key)), "{key}: {}", ran.out);
    }
    let out = folder("written");
    std::fs::create_dir_all(&out).unwrap();
    let file = out.join("mine.json");
    let ran = run(&["examples", "discrete", "--out", file.to_str().unwrap()]);
    assert_eq!((ran.code, ran.out.as_str()), (0, ""));
    assert_eq!(run(&["design", file.to_str().unwrap()]).code, 0, "what was written can be read");
}

#[test]
fn errata_are_listed_with_their_kinds_and_proofs() {
    let ran = run(&["errata", "001"]);
    assert_eq!((ran.code, ran.err.as_str()), (0, ""), "a list is an answer");
    let report = ran.json();
    let found = report["errata"].as_array().unwrap();
    let misprint = found.iter().find(|e| e["concerns"] == "G").unwrap();
    assert_eq!((&misprint["kind"], &misprint["printed"]), (&"misprint".into(), &"G = [5/3 4/3]".into()));
    let gain = found.iter().find(|e| e["concerns"] == "L").unwrap();
    assert_eq!(gain["kind"], "not unique", "right as printed");
    assert!(misprint["proof"].as_str().unwrap().contains("16/3"), "{misprint}");
    assert!(found.iter().all(|e| e["paper"] == "001"), "no other paper's");
    let all = run(&["errata"]).json()["errata"].as_array().unwrap().len();
    let each: usize = ["000", "001", "002", "003", "004"]
        .iter()
        .map(|paper| run(&["errata", paper]).json()["errata"].as_array().unwrap().len())
        .sum();
    assert_eq!(all, each, "all of them without a paper");
}

#[test]
fn help_and_version_are_answers() {
    for arguments in [["help"], ["--help"], ["-h"]] {
        let ran = run(&arguments);
        assert_eq!(ran.code, 0);
        assert!(ran.out.contains("descry figures FILE --out DIR") && ran.err.is_empty());
    }
    assert_eq!(run(&["--version"]).out, format!("descry {}\n", env!("CARGO_PKG_VERSION")));
}

#[test]
fn bad_input_is_said_on_standard_error_with_exit_code_two() {
    let cases: [(&[&str], &str, &str); 10] = [
        (&["check", "/nowhere/at/all.json"], "", "/nowhere/at/all.json cannot be read"),
        (&["check", "example:unseen"], "", "there is no example \"unseen\""),
        (&["check", "-"], "{", "standard input: the text is not JSON"),
        (
            &["check", "-"],
            r#"{"descry":1,"system":{"E":[[1]],"A":[[1,2]]}}"#,
            "system.A: found a 1 x 2 matrix",
        ),
        (&["desing", "-"], "", "did you mean `design`?"),
        (&["simulate", EXAMPLE, "--format", "xml"], "", "csv or json"),
        (&["figures", EXAMPLE], "", "--out DIR"),
        (&["errata", "005"], "", "there is no paper \"005\": the keys are 000, 001, 002, 003, 004"),
        (&["examples", "nothing"], "", "there is no example \"nothing\""),
        (&["figures", EXAMPLE, "--only", "fig6", "--out", "/dev/null/x"], "", "cannot be made"),
    ];
    for (arguments, input, part) in cases {
        let ran = with_input(arguments, input.as_bytes());
        assert_eq!(ran.code, 2, "{arguments:?}: {}", ran.err);
        assert!(ran.out.is_empty(), "{arguments:?}: nothing on standard output, but {}", ran.out);
        assert!(ran.err.starts_with("descry: ") && ran.err.contains(part), "{arguments:?}: {}", ran.err);
    }
    assert_eq!(with_input(&["check", "-"], b"\xff\xfe{").code, 2, "not UTF-8");
    assert_eq!(with_input(&["check", "-"], &vec![b' '; (2 << 20) + 1]).code, 2, "too large");
}

#[test]
fn a_lipschitz_term_is_not_silently_left_out() {
    for command in ["check", "design", "simulate"] {
        let ran = run(&[command, "tests/documents/002-lipschitz.json"]);
        assert_eq!(ran.code, 1, "{command}");
        assert!(ran.err.contains("Lipschitz term"), "{command}: {}", ran.err);
    }
}

#[test]
fn check_tells_the_light_of_every_method() {
    let lights = |example: &str| -> Vec<(String, String)> {
        let report = run(&["check", example]).json();
        let methods = report["methods"].as_array().unwrap().clone();
        assert!(methods.iter().all(|found| found["why"].as_str().unwrap().len() > 15), "{methods:?}");
        let text = |value: &serde_json::Value| value.as_str().unwrap().to_owned();
        methods.iter().map(|found| (text(&found["method"]), text(&found["light"]))).collect()
    };
    let with = |[integral, proportional, decoupled, attenuating, decentralized, hierarchical]: [&str; 6]| {
        [
            ("proportional-integral", integral),
            ("proportional", proportional),
            ("input-decoupled", decoupled),
            ("h-infinity-lipschitz", attenuating),
            ("decentralized", decentralized),
            ("hierarchical", hierarchical),
        ]
        .map(|(method, light)| (method.to_owned(), light.to_owned()))
    };
    let expected = with(["exists", "exists", "exists", "exists", "missing", "missing"]);
    assert_eq!(lights("example:comparison"), expected, "a plant without subsystems");
    let expected = with(["missing", "missing", "missing", "missing", "missing", "exists"]);
    assert_eq!(lights("example:network-ring"), expected, "a network that is never written as one system");
    let expected = with(["missing", "missing", "missing", "exists", "missing", "missing"]);
    assert_eq!(lights("example:h-infinity-lipschitz"), expected, "a plant with a Lipschitz term");
}

#[test]
fn help_names_every_figure_that_is_no_figure_of_the_document() {
    let help = run(&["help"]).out;
    let ran = run(&["figures", "example:comparison", "--out", "/nowhere", "--only", "no-such-figure"]);
    for id in ["comparison-states", "trade-off"] {
        assert!(ran.err.contains(id) && help.contains(id), "{id}: {help}");
    }
}

#[test]
fn compare_reports_every_design_of_the_example() {
    let ran = run(&["compare", "example:comparison"]);
    assert_eq!((ran.code, ran.err.as_str()), (0, ""), "all designs exist and are verified");
    let report = ran.json();
    assert_eq!(report["command"], "compare");
    let designs = report["designs"].as_array().unwrap();
    let names: Vec<&str> = designs.iter().map(|design| design["name"].as_str().unwrap()).collect();
    assert_eq!(names, ["chosen", "proportional", "PI, full", "PI, general", "H-infinity"]);
    for design in designs {
        assert_eq!(design["verdict"], "verified", "{}", design["name"]);
        assert!(
            design["h_infinity_norms"]["noise to e"]["norm"].as_f64().unwrap() > 0.0,
            "{}",
            design["name"]
        );
        assert!(
            design["scenario"]["rms_second_half"]["all_states"].as_f64().unwrap() > 0.0,
            "{}",
            design["name"]
        );
    }
    assert_eq!(designs[0]["h_infinity_norms"]["d to e"]["decoupled"], true, "the input-decoupled one");
    assert_eq!(designs[1]["h_infinity_norms"]["d to e_d"]["why"], "not estimated", "the proportional one");
    assert!(designs[4]["guaranteed_gamma"].as_f64().unwrap() > 0.0, "the H-infinity one");
    assert_eq!(
        run(&["compare", "example:comparison"]).out,
        ran.out,
        "the same document gives the same bytes"
    );
}

#[test]
fn compare_writes_a_table_as_markdown_and_csv() {
    let ran = run(&["compare", "example:comparison", "--format", "markdown"]);
    assert_eq!(ran.code, 0, "{}", ran.err);
    let first = ran.out.lines().next().unwrap();
    assert_eq!(first, "|  | chosen | proportional | PI, full | PI, general | H-infinity |");
    let columns = |line: &str| line.replace("\\|", "").matches('|').count();
    let table = ran.out.lines().take_while(|line| !line.is_empty());
    assert!(table.clone().count() > 30 && table.clone().all(|line| columns(line) == 7), "{}", ran.out);
    let ran = run(&["compare", "example:comparison", "--format", "csv"]);
    assert!(ran.out.contains("\nOrder,2,2,4,4,3\n"), "{}", ran.out);
    let ran = run(&["compare", "example:comparison", "--format", "html"]);
    assert!(ran.code == 2 && ran.err.contains("json, markdown or csv"), "{}", ran.err);
}

#[test]
fn compare_says_which_design_is_missing() {
    let ran = run(&["compare", "example:unseen-impulse"]);
    assert_eq!(ran.code, 1, "it does not exist");
    assert!(ran.err.contains("chosen: condition (9) does not hold"), "{}", ran.err);
    assert_eq!(ran.json()["designs"][0]["verdict"], "does not exist");
    let text = r#"{"descry":1,"system":{"E":[[1]],"A":[[0]],"C":[[1]],"D":[[1]]},"design":{"poles":[-1,-2]},
        "compare":[{"name":"short","design":{"poles":[-1]}}]}"#;
    let ran = with_input(&["compare", "-"], text.as_bytes());
    assert_eq!(ran.code, 2, "a list of poles that does not fit: {}", ran.err);
    assert_eq!(ran.json()["designs"][0]["verdict"], "verified", "the other one is there");
    assert!(ran.err.contains("short: 1 poles are given"), "{}", ran.err);
}

#[test]
fn compare_takes_a_network_that_is_never_expanded() {
    let ran = run(&["compare", "example:network-ring"]);
    assert_eq!(ran.code, 0, "{}", ran.err);
    let report = ran.json();
    let design = &report["designs"][0];
    assert_eq!(design["verdict"], "verified");
    assert!(design["h_infinity_norms"]["noise to e"]["norm"].as_f64().unwrap() > 0.0, "{design}");
    assert!(design["scenario"]["rms"]["all_states"].as_f64().unwrap() > 0.0, "{design}");
    let out = folder("comparison-network");
    for id in ["comparison-states", "comparison-errors", "comparison-gains"] {
        let ran = run(&["figures", "example:network-ring", "--out", out.to_str().unwrap(), "--only", id]);
        assert_eq!(ran.code, 0, "{id}: {}", ran.err);
    }
}

#[test]
fn figures_of_a_comparison_are_written_by_their_ids() {
    let out = folder("comparison-figures");
    let out_text = out.to_str().unwrap();
    for id in ["comparison-states", "comparison-errors", "comparison-unknown-input", "comparison-gains"] {
        let ran = run(&["figures", "example:comparison", "--out", out_text, "--only", id]);
        assert_eq!(ran.code, 0, "{id}: {}", ran.err);
        let svg = std::fs::read_to_string(out.join(format!("{id}.svg"))).unwrap();
        assert!(svg.contains("PI, general") && svg.contains("chosen"), "{id}: names in the legend");
    }
    let ran = run(&["figures", "example:comparison", "--out", out_text, "--only", "trade-off"]);
    assert_eq!(ran.code, 0, "{}", ran.err);
    let svg = std::fs::read_to_string(out.join("trade-off.svg")).unwrap();
    assert!(svg.contains("What is gained") && svg.contains("noise to e"), "both sides of the trade");
    let ran = run(&["figures", "example:comparison", "--out", out_text]);
    assert!(!ran.out.contains("comparison-states"), "without a choice the document's own: {}", ran.out);
}
