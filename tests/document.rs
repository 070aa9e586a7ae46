//! Documents: what is refused, with place and need; what is read back exactly; the systems of all papers.
#![expect(clippy::unwrap_used, clippy::panic, reason = "helpers of tests fail by panicking")]

use descry::document::{
    Document, DocumentError, PlantData, read_document, write_document, write_document_compact,
};
use descry::system::TimeDomain;
use nalgebra::DMatrix;
use serde_json::Value;

/// A small document with everything, as JSON to break one thing at a time.
const WHOLE: &str = r#"{
  "descry": 1, "title": "t", "notes": "n", "paper": "004",
  "system": {"time": "continuous", "E": [[1, 0], [0, 0]], "A": [[-1, "1/3"], [0, 1]], "B": [[1], [0]],
             "C": [[1, 0]], "D": [[1], [0]], "F": [[0]]},
  "design": {"method": "proportional-integral", "order": "reduced", "poles": [-1, [-2, 1], [-2, -1]], "scale": 2, "seed": 3},
  "scenario": {"horizon": 5, "samples": 101, "x0": [1, "1/2"], "u": ["sin(t)"], "d": [0.5], "noise": ["0.1*noise(t, 1)"],
               "uncertainty": {"amplitude": [[0, 0.1], [0, 0]], "frequency": [[0, 1], [0, 0]], "scale": 1}},
  "tolerance": {"rank": 16},
  "figures": [{"id": "f", "title": "F", "columns": 2, "runs": [{}, {"name": "b", "design": {"scale": 2}}],
               "panels": [{"kind": "time", "range": [-1, 1], "series": [{"show": "x1"}, {"show": "x1_hat", "run": "b"}]},
                          {"kind": "bode", "transfer": "d to d_hat", "from": 1, "to": 1, "range": [0.1, 10]}]}]
}"#;

const NETWORK: &str = r#"{"descry": 1, "system": {"network": {"a": [[-1]], "b": [[1]], "c": [[1]], "c_G": [[1]], "c_L": [[1]],
  "Gamma": {"rows": 3, "columns": 3, "entries": [[1, 2, 1], [3, 1, 0.5]]}, "Psi": [[1, 0, 0]], "local": [2]}}}"#;

const LIPSCHITZ: &str = r#"{"descry": 1, "system": {"E": [[1, 0], [0, 0]], "A": [[-1, 0], [0, 1]], "C": [[1, 0]],
  "lipschitz": {"G": [[1], [0]], "F_L": [[0, 1]], "f": ["sin(x2)"], "constant": 1}}}"#;

const PARTITION: &str = r#"{"descry": 1, "system": {"E": [[1, 0], [0, 1]], "A": [[-1, 1], [0, 1]], "C": [[1, 0], [0, 1]],
  "partition": [{"states": 1, "outputs": 1}, {"states": 1, "outputs": 1}]}}"#;

/// Puts `value` (JSON) at a path such as `/system/E/0/1`.
fn changed(text: &str, at: &str, value: &str) -> String {
    let mut root: Value = serde_json::from_str(text).unwrap();
    let (parent, key) = at.rsplit_once('/').unwrap();
    let value: Value = serde_json::from_str(value).unwrap();
    match root.pointer_mut(parent).unwrap_or_else(|| panic!("no place {parent}")) {
        Value::Object(map) => {
            map.insert(key.to_owned(), value);
        }
        Value::Array(items) => items[key.parse::<usize>().unwrap()] = value,
        other => panic!("{at}: {other}"),
    }
    root.to_string()
}

fn removed(text: &str, at: &str) -> String {
    let mut root: Value = serde_json::from_str(text).unwrap();
    let (parent, key) = at.rsplit_once('/').unwrap();
    root.pointer_mut(parent).unwrap().as_object_mut().unwrap().remove(key).unwrap();
    root.to_string()
}

fn refused(text: &str) -> DocumentError {
    match read_document(text) {
        Ok(_) => panic!("accepted: {}", &text[..text.len().min(300)]),
        Err(error) => error,
    }
}

/// The place that an error names and the whole sentence.
fn place(error: &DocumentError) -> (String, String) {
    match error {
        DocumentError::Place { place, .. } => (place.clone(), error.to_string()),
        other => (String::new(), other.to_string()),
    }
}

fn assert_refused(text: &str, expected: &str, need: &str) {
    let (place, sentence) = place(&refused(text));
    assert_eq!(place, expected, "place of: {sentence}");
    assert!(sentence.contains(need), "`{need}` is missing in: {sentence}");
}

#[test]
fn the_whole_document_is_read() {
    for text in [WHOLE, NETWORK, LIPSCHITZ, PARTITION] {
        read_document(text).unwrap_or_else(|error| panic!("{error}"));
    }
}

#[test]
fn unknown_keys_are_named_with_the_nearest_known_one() {
    for (at, place, hint) in [
        ("/tittle", "the document", "did you mean \"title\"?"),
        ("/system/e", "system", "did you mean \"E\"?"),
        ("/system/partitoin", "system", "did you mean \"partition\"?"),
        ("/design/pole", "design", "did you mean \"poles\"?"),
        ("/scenario/sample", "scenario", "did you mean \"samples\"?"),
        ("/scenario/uncertainty/frequencies", "scenario.uncertainty", "did you mean \"frequency\"?"),
        ("/tolerance/ranks", "tolerance", "did you mean \"rank\"?"),
        ("/figures/0/panel", "figures[1]", "did you mean \"panels\"?"),
        ("/figures/0/panels/0/serie", "figures[1].panels[1]", "did you mean \"series\"?"),
        ("/figures/0/runs/1/design/pols", "figures[1].runs[2].design", "did you mean \"poles\"?"),
    ] {
        assert_refused(&changed(WHOLE, at, "1"), place, hint);
    }
    assert_refused(&changed(WHOLE, "/zzzzzzzz", "1"), "the document", "the keys here are descry");
}

#[test]
fn entries_that_are_no_finite_numbers_are_refused() {
    for (value, need) in [
        ("\"1/0\"", "an entry must be a constant"),
        ("\"nan\"", "only finite numbers are possible"),
        ("\"inf\"", "only finite numbers are possible"),
        ("\"x1\"", "an entry must be a constant"),
        ("\"2*(1\"", "an entry must be a constant"),
        ("\"1e400\"", "an entry must be a constant"),
        ("\"\"", "an entry must be a constant"),
        ("null", "a number or an expression"),
        ("true", "a number or an expression"),
        ("[1]", "a number or an expression"),
        ("{}", "a number or an expression"),
    ] {
        assert_refused(&changed(WHOLE, "/system/A/0/1", value), "system.A[1, 2]", need);
    }
    for text in ["NaN", "Infinity", "-Infinity", "1e400", "01", "+1", ".5"] {
        let broken = WHOLE.replacen("[[1, 0], [0, 0]]", &format!("[[{text}, 0], [0, 0]]"), 1);
        let error = refused(&broken);
        assert!(matches!(error, DocumentError::NotJson { line: 3, .. }), "{text}: {error}");
    }
}

#[test]
fn ragged_rows_and_wrong_shapes_are_named_matrix_by_matrix() {
    assert_refused(&changed(WHOLE, "/system/E/1", "[1]"), "system.E, row 2", "the first row has 2");
    assert_refused(&changed(WHOLE, "/system/E", "[1, 2]"), "system.E[1]", "a list of entries");
    assert_refused(&changed(WHOLE, "/system/E", "3"), "system.E", "a list of rows");
    assert_refused(&changed(WHOLE, "/system/E", "[[], []]"), "system", "at least one state");
    for (matrix, value, need) in [
        ("A", "[[1, 2]]", "2 x 2 is needed: A has the shape of E"),
        ("B", "[[1]]", "2 x 1 is needed: B has a row for each equation"),
        ("C", "[[1, 0, 0]]", "1 x 2 is needed: C has a column for each state"),
        ("D", "[[1], [0], [0]]", "2 x 1 is needed: D has a row for each equation"),
        ("F", "[[0, 0]]", "1 x 1 is needed: F has a row for each output"),
    ] {
        assert_refused(
            &changed(WHOLE, &format!("/system/{matrix}"), value),
            &format!("system.{matrix}"),
            need,
        );
    }
}

#[test]
fn missing_keys_and_wrong_versions_are_named() {
    assert_refused(&removed(WHOLE, "/descry"), "the document", "\"descry\": 1");
    assert_refused(&removed(WHOLE, "/system"), "the document", "the matrices of the system");
    assert_refused(&removed(WHOLE, "/system/E"), "system", "the matrix E is needed");
    assert_refused(&removed(WHOLE, "/system/A"), "system", "the matrix A is needed");
    assert_refused(&changed(WHOLE, "/descry", "2"), "descry", "this program reads version 1");
    assert_refused(&changed(WHOLE, "/descry", "0"), "descry", "a whole number from 1 to 1");
    assert_refused(&changed(WHOLE, "/descry", "\"1\""), "descry", "a whole number from 1 to 1");
    assert_refused(&changed(WHOLE, "/descry", "1.5"), "descry", "a whole number");
    assert_refused(&removed(WHOLE, "/scenario/uncertainty/amplitude"), "scenario.uncertainty", "amplitude");
    assert_refused(&removed(WHOLE, "/figures/0/id"), "figures[1]", "an id is needed");
    assert_refused("[]", "the document", "an object is needed");
    assert_refused("null", "the document", "an object is needed");
}

#[test]
fn design_choices_are_checked() {
    for (at, value, place, need) in [
        ("/design/method", "\"kalman\"", "design.method", "\"proportional\""),
        ("/design/order", "\"least\"", "design.order", "\"reduced\""),
        ("/design/order", "3", "design.order", "\"reduced\""),
        ("/design/poles", "-1", "design.poles", "a list of poles"),
        ("/design/poles", "[\"-1\"]", "design.poles[1]", "a number or [real, imaginary]"),
        ("/design/poles", "[[-1, 1]]", "design.poles", "no conjugate partner"),
        ("/design/poles", "[[-1, 1, 2]]", "design.poles[1]", "at most 2"),
        ("/design/poles", "[[-1]]", "design.poles[1]", "a number or [real, imaginary]"),
        ("/design/scale", "0", "design.scale", "a number from 0.001 to 1000"),
        ("/design/scale", "\"2\"", "design.scale", "a finite number"),
        ("/design/seed", "-1", "design.seed", "a whole number"),
        ("/design/seed", "1.5", "design.seed", "a whole number"),
        ("/design", "[]", "design", "an object is needed"),
        ("/design/lmi", "7", "design.lmi", "an object is needed"),
        ("/design/lmi", "{\"decay rate\": 1}", "design.lmi", "the keys here are decay"),
        ("/design/lmi", "{\"decay\": -1}", "design.lmi.decay", "a number from"),
        ("/design/lmi", "{\"gain\": \"much\"}", "design.lmi.gain", "\"unbounded\""),
        ("/design/lmi", "{\"gamma\": 0}", "design.lmi.gamma", "a number from"),
        ("/design/lmi", "{\"alternative\": 1}", "design.lmi.alternative", "true or false"),
        ("/design/lmi", "{\"R\": [[1, 2]]}", "design.lmi.R[1][1]", "a list of"),
        ("/design/lmi", "{\"decoupled\": [[99]]}", "design.lmi.decoupled[1][1]", "a whole number from 1"),
        ("/design/lmi", "{\"given\": {\"N\": [[1]]}}", "design.lmi.given", "no key \"J\""),
        ("/design/lmi", "{\"given\": {\"N\": [[1, 2]], \"J\": [[1]]}}", "design.lmi.given", "N is square"),
        ("/design/lmi", "{\"seconds\": 1e9}", "design.lmi.seconds", "a number from"),
    ] {
        assert_refused(&changed(WHOLE, at, value), place, need);
    }
}

#[test]
fn scenarios_are_checked() {
    for (at, value, place, need) in [
        ("/scenario/horizon", "0", "scenario.horizon", "a number from"),
        ("/scenario/horizon", "\"5\"", "scenario.horizon", "a finite number"),
        ("/scenario/horizon", "1e7", "scenario.horizon", "a number from"),
        ("/scenario/samples", "1", "scenario.samples", "a whole number from 2 to 20000"),
        ("/scenario/samples", "20001", "scenario.samples", "a whole number from 2 to 20000"),
        ("/scenario/x0", "[1]", "scenario.x0", "one number for each of the 2 states"),
        ("/scenario/x0", "[1, null]", "scenario.x0[2]", "a number or an expression"),
        ("/scenario/u", "[\"1\", \"2\"]", "scenario.u", "one signal for each of the 1 known inputs"),
        ("/scenario/d", "[\"1\", \"2\"]", "scenario.d", "one signal for each of the 1 unknown inputs"),
        ("/scenario/noise", "[\"1\", \"2\"]", "scenario.noise", "one signal for each of the 1 outputs"),
        ("/scenario/u", "\"sin(t)\"", "scenario.u", "a list of signals"),
        ("/scenario/u", "[\"sin(x)\"]", "scenario.u[1]", "at character 5: unknown name `x`"),
        ("/scenario/u", "[\"sin(t\"]", "scenario.u[1]", "a signal is an expression in t"),
        ("/scenario/u", "[null]", "scenario.u[1]", "a text in quotes"),
        ("/scenario/uncertainty/amplitude", "[[1]]", "scenario.uncertainty.amplitude", "2 x 2 is needed"),
        ("/scenario/uncertainty/frequency", "[[1, 2]]", "scenario.uncertainty.frequency", "2 x 2 is needed"),
        ("/scenario/uncertainty/scale", "-1", "scenario.uncertainty.scale", "a number from 0 to 1000"),
        ("/tolerance/rank", "0", "tolerance.rank", "a number from"),
        ("/tolerance/gap", "\"1\"", "tolerance.gap", "a finite number"),
    ] {
        assert_refused(&changed(WHOLE, at, value), place, need);
    }
}

#[test]
fn figures_are_checked() {
    let series = "/figures/0/panels/0/series/0";
    for (at, value, place, need) in [
        ("/figures/0/id", "\"../f\"", "figures[1].id", "it names files"),
        ("/figures/0/id", "\"\"", "figures[1].id", "1 to 40 letters"),
        ("/figures/0/columns", "9", "figures[1].columns", "a whole number from 1 to 6"),
        ("/figures/0/runs", "{}", "figures[1].runs", "a list of runs"),
        ("/figures/0/panels/0/kind", "\"pie\"", "figures[1].panels[1].kind", "\"time\""),
        ("/figures/0/panels/0/range", "[1, -1]", "figures[1].panels[1].range", "below the second"),
        ("/figures/0/panels/1/range", "[0, 1]", "figures[1].panels[2]", "must be positive"),
        ("/figures/0/panels/1/transfer", "\"u to y\"", "figures[1].panels[2].transfer", "\"d to e\""),
        ("/figures/0/panels/1/from", "2", "figures[1].panels[2].from", "a whole number from 1 to 1"),
        (&format!("{series}/show"), "\"q1\"", "figures[1].panels[1].series[1].show", "x1_hat"),
        (
            &format!("{series}/show"),
            "\"z1\"",
            "figures[1].panels[1].series[1].show",
            "this system is no network",
        ),
        (&format!("{series}/show"), "\"x3\"", "figures[1].panels[1].series[1].show", "only 2 of these"),
        (&format!("{series}/show"), "\"u2\"", "figures[1].panels[1].series[1].show", "only 1 of these"),
        (
            &format!("{series}/run"),
            "\"c\"",
            "figures[1].panels[1].series[1].run",
            "the name of one of the runs",
        ),
    ] {
        assert_refused(&changed(WHOLE, at, value), place, need);
    }
    let twice =
        changed(WHOLE, "/figures", r#"[{"id":"f","runs":[],"panels":[]},{"id":"f","runs":[],"panels":[]}]"#);
    assert_refused(&twice, "figures[2]", "is taken by an earlier figure");
}

#[test]
fn networks_are_checked() {
    let at = |key: &str| format!("/system/network/{key}");
    for (key, value, place, need) in [
        ("a", "[[1, 2]]", "system.network.a", "a is square"),
        ("b", "[[1], [2]]", "system.network.b", "a row for each state"),
        ("c", "[[1, 2]]", "system.network.c", "1 x 1 is needed"),
        ("c_G", "[[1, 2]]", "system.network.c_G", "a column for each state"),
        ("c_L", "[[1, 2]]", "system.network.c_L", "a column for each state"),
        ("Gamma", "[[1, 2], [3, 4], [5, 6]]", "system.network.Gamma", "Gamma is square"),
        ("Psi", "[[1, 2]]", "system.network.Psi", "a column for each subsystem"),
        ("local", "[4]", "system.network.local[1]", "a whole number from 1 to 3"),
        ("local", "[0]", "system.network.local[1]", "a whole number from 1 to 3"),
        ("d", "1", "system.network", "the keys here are"),
    ] {
        assert_refused(&changed(NETWORK, &at(key), value), place, need);
    }
    let gamma = |key: &str| format!("/system/network/Gamma/{key}");
    for (key, value, place, need) in [
        ("entries", "[[4, 1, 1]]", "system.network.Gamma.entries[1][1]", "a whole number from 1 to 3"),
        ("entries", "[[1, 0, 1]]", "system.network.Gamma.entries[1][2]", "a whole number from 1 to 3"),
        ("entries", "[[1, 1, null]]", "system.network.Gamma.entries[1][3]", "a finite number"),
        ("entries", "[[1, 1]]", "system.network.Gamma.entries[1]", "[row, column, value]"),
        ("rows", "6000", "system.network.Gamma.rows", "a whole number from 1 to 2000"),
    ] {
        assert_refused(&changed(NETWORK, &gamma(key), value), place, need);
    }
    assert_refused(&removed(NETWORK, &at("Psi")), "system.network", "this matrix of the network is needed");
    assert_refused(&changed(NETWORK, "/system/E", "[[1]]"), "system.E", "either a network or matrices");
}

#[test]
fn partitions_and_lipschitz_terms_are_checked() {
    for (at, value, place, need) in [
        ("/system/E/0/1", "2", "system.partition", "E[1, 2] = 2 couples subsystem 1 with subsystem 2"),
        ("/system/C/1/0", "2", "system.partition", "C[2, 1] = 2 couples"),
        ("/system/partition/1/states", "2", "system.partition", "3 states together"),
        ("/system/partition/1/outputs", "0", "system.partition", "1 outputs together"),
        ("/system/partition/1/states", "-1", "system.partition[2].states", "a whole number"),
    ] {
        assert_refused(&changed(PARTITION, at, value), place, need);
    }
    assert_refused(
        &removed(PARTITION, "/system/partition/0/outputs"),
        "system.partition[1]",
        "the number of outputs",
    );
    for (at, value, place, need) in [
        ("/system/lipschitz/G", "[[1]]", "system.lipschitz.G", "2 x 1 is needed"),
        ("/system/lipschitz/F_L", "[[1]]", "system.lipschitz.F_L", "1 x 2 is needed"),
        ("/system/lipschitz/f", "[\"sin(x3)\"]", "system.lipschitz.f[1]", "x1 ... x2"),
        ("/system/lipschitz/f", "\"sin(x2)\"", "system.lipschitz.f", "a list of expressions"),
        ("/system/lipschitz/constant", "-1", "system.lipschitz.constant", "a number from 0"),
    ] {
        assert_refused(&changed(LIPSCHITZ, at, value), place, need);
    }
    assert_refused(
        &removed(LIPSCHITZ, "/system/lipschitz/constant"),
        "system.lipschitz",
        "the Lipschitz constant",
    );
}

#[test]
fn sizes_beyond_the_limits_are_refused() {
    let row = format!("[{}]", vec!["0"; 101].join(","));
    assert_refused(&changed(WHOLE, "/system/E", &format!("[{row}]")), "system.E[1]", "at most 100 entries");
    let rows = format!("[{}]", vec!["[0]"; 101].join(","));
    assert_refused(&changed(WHOLE, "/system/E", &rows), "system.E", "at most 100 rows");
    let long = format!("\"{}\"", "a".repeat(20_001));
    assert_refused(&changed(WHOLE, "/title", &long), "title", "at most 20000 are allowed");
    let poles = format!("[{}]", vec!["-1"; 301].join(","));
    assert_refused(&changed(WHOLE, "/design/poles", &poles), "design.poles", "at most 300 poles");
    let error = refused(&" ".repeat((2 << 20) + 1));
    assert!(matches!(error, DocumentError::TooLarge { limit: 2_097_152, .. }), "{error}");
    let deep = format!("{{\"descry\":1,\"system\":{}{}}}", "[".repeat(100_000), "]".repeat(100_000));
    assert!(
        matches!(refused(&deep), DocumentError::NotJson { .. }),
        "deep nesting does not exhaust the stack"
    );
    let nested = format!("\"{}1{}\"", "(".repeat(5_000), ")".repeat(5_000));
    assert_refused(
        &changed(WHOLE, "/system/A/0/0", &nested),
        "system.A[1, 1]",
        "an entry must be a constant",
    );
}

/// Reads a document of a paper and checks that writing it loses nothing.
fn paper(text: &str) -> Document {
    let document = read_document(text).unwrap_or_else(|error| panic!("{error}"));
    for written in [write_document(&document), write_document_compact(&document)] {
        assert_eq!(read_document(&written).as_ref(), Ok(&document), "write, then read");
    }
    document
}

fn reference(text: &str) -> Value {
    serde_json::from_str(text).unwrap()
}

fn matrix(value: &Value) -> DMatrix<f64> {
    let rows: Vec<Vec<f64>> = serde_json::from_value(value.clone()).unwrap();
    DMatrix::from_row_iterator(rows.len(), rows[0].len(), rows.into_iter().flatten())
}

#[test]
fn the_partitioned_system_of_paper_000_is_held() {
    let document = paper(include_str!("documents/000-partition.json"));
    let reference = reference(include_str!("reference/ex000_discrete.json"));
    let system = document.system().unwrap();
    assert_eq!(system.time, TimeDomain::Discrete);
    let PlantData::Descriptor(data) = &document.plant else { panic!("matrices") };
    let sizes: Vec<[usize; 3]> = data.partition.iter().map(|s| [s.states, s.equations, s.outputs]).collect();
    assert_eq!(sizes, [[3, 3, 2], [3, 3, 2]], "equations default to states");
    for (i, subsystem) in reference["subsystems"].as_array().unwrap().iter().enumerate() {
        let block = |m: &DMatrix<f64>, rows: usize| m.view((rows * i, 3 * i), (rows, 3)).into_owned();
        assert_eq!(block(&system.E, 3), matrix(&subsystem["E"]), "E{}", i + 1);
        assert_eq!(block(&system.A, 3), matrix(&subsystem["A"]), "A{0}{0}", i + 1);
        assert_eq!(block(&system.C, 2), matrix(&subsystem["H"]), "H{}", i + 1);
        assert_eq!(system.B.rows(3 * i, 3).into_owned(), matrix(&subsystem["B"]), "B{}", i + 1);
    }
    assert_eq!(system.A.view((0, 3), (3, 3)).into_owned(), matrix(&reference["composite_A12"]), "A12");
    assert_eq!(system.A.view((3, 0), (3, 3)).into_owned(), matrix(&reference["composite_A21"]), "A21");
}

#[test]
fn the_wide_system_of_paper_001_is_held() {
    let document = paper(include_str!("documents/001-wide.json"));
    let inputs = &reference(include_str!("reference/ex001.json"))["inputs"];
    let system = document.system().unwrap();
    assert_eq!(system.E.shape(), (3, 4), "more states than equations");
    for (name, found) in system.matrices() {
        assert_eq!(*found, matrix(&inputs[name]), "{name}");
    }
}

#[test]
fn the_lipschitz_system_of_paper_002_is_held() {
    let document = paper(include_str!("documents/002-lipschitz.json"));
    let inputs = reference(include_str!("reference/ex002.json"));
    let system = document.system().unwrap();
    for (key, found) in [
        ("E", &system.E),
        ("A", &system.A),
        ("B", &system.B),
        ("C", &system.C),
        ("D1", &system.D),
        ("D2", &system.F),
    ] {
        assert_eq!(*found, matrix(&inputs[key]), "{key}");
    }
    let PlantData::Descriptor(data) = &document.plant else { panic!("matrices") };
    let term = data.lipschitz.as_ref().unwrap().term(3).unwrap();
    assert_eq!((term.G, term.F_L), (matrix(&inputs["D"]), matrix(&inputs["FL"])), "G and F_L");
    assert_eq!(Some(term.constant), inputs["lambda"].as_f64());
    assert_eq!(term.f[0].value(&[7.0, 0.5, 7.0, 0.0]), 0.5_f64.sin(), "f = sin(x2)");
}

#[test]
fn the_network_of_paper_003_is_held() {
    let document = paper(include_str!("documents/003-network.json"));
    let inputs = &reference(include_str!("reference/ex003.json"))["inputs"];
    let PlantData::Network(data) = &document.plant else { panic!("a network") };
    let network = data.network().unwrap();
    for (key, found) in [
        ("aI", &network.a),
        ("bI", &network.b),
        ("cI", &network.c),
        ("Gam", &network.Gamma.dense()),
        ("Psi", &network.Psi),
        ("cG", &network.c_G),
        ("cL", &network.c_L),
    ] {
        assert_eq!(*found, matrix(&inputs[key]), "{key}");
    }
    assert_eq!(network.local, [3], "the fourth subsystem");
    let system = document.system().unwrap();
    assert_eq!((system.n_states(), system.n_outputs()), (20, 3), "expanded");
    assert_eq!(document.scenario(&system).x0[19], 5.0 * 20.0_f64.sin(), "x0 as expressions");
}

#[cfg(not(target_arch = "wasm32"))]
mod random {
    use super::*;
    use descry::document::{DescriptorData, Entry, EntryMatrix, FreeData, KeptDesign, ScenarioData};
    use descry::numerics::{Complex64, Tolerance};
    use descry::observer::{DesignChoice, GivenObserver, LmiChoice, Method, Order};
    use descry::system::Signal;
    use proptest::prelude::*;

    fn number() -> impl Strategy<Value = f64> {
        prop_oneof![
            prop::num::f64::NORMAL | prop::num::f64::SUBNORMAL | prop::num::f64::ZERO,
            (-9..10_i32).prop_map(f64::from),
            Just(9_007_199_254_740_994.0),
            Just(1e22),
        ]
    }

    fn entry() -> impl Strategy<Value = Entry> {
        let texts = prop::sample::select(vec!["1/3", "-2*pi", "sqrt(2)", " 1e-3 ", "(1+2)*3", "exp(1)"]);
        prop_oneof![3 => number().prop_map(Entry::number), 1 => texts.prop_map(|t| Entry::typed(t).unwrap())]
    }

    fn matrix(rows: usize, columns: usize) -> impl Strategy<Value = EntryMatrix> {
        prop::collection::vec(entry(), rows * columns)
            .prop_map(move |entries| EntryMatrix::from_entries(rows, columns, entries))
    }

    fn signals(count: usize) -> impl Strategy<Value = Vec<Signal>> {
        let texts =
            prop::sample::select(vec!["5+2*sin(4*t)", "step(t-1)", "square(t)", "0.1*noise(t, 7)", "-0"]);
        prop_oneof![
            Just(Vec::new()),
            prop::collection::vec(texts.prop_map(|t| Signal::parse(t).unwrap()), count)
        ]
    }

    fn design() -> impl Strategy<Value = DesignChoice> {
        let pole = prop_oneof![
            (-50.0..-0.1).prop_map(|x: f64| vec![Complex64::from(x)]),
            (-50.0..-0.1, 0.1..9.0)
                .prop_map(|(x, y): (f64, f64)| vec![Complex64::new(x, y), Complex64::new(x, -y)])
        ];
        let poles = prop::collection::vec(pole, 0..4).prop_map(|poles| poles.concat()).boxed();
        let (methods, orders) =
            (prop::sample::select(&Method::ALL[..]), prop::sample::select(&Order::ALL[..]));
        let seed = 0..=u64::from(u32::MAX);
        (methods, orders, poles.clone(), 0.001..1000.0, seed, poles, demands()).prop_map(
            |(method, order, poles, scale, seed, local_poles, lmi)| DesignChoice {
                method,
                order,
                poles,
                scale,
                seed,
                local_poles,
                plugged: None,
                lmi,
            },
        )
    }

    fn demands() -> impl Strategy<Value = LmiChoice> {
        let size = || prop::option::of(1e-3..1e3);
        let numbers = |rows: usize, columns: usize| {
            prop::collection::vec(-9.0..9.0, rows * columns)
                .prop_map(move |values| nalgebra::DMatrix::from_vec(rows, columns, values))
        };
        let given = (1..3_usize, size()).prop_flat_map(move |(q, gamma)| {
            (numbers(q, q), numbers(q, 1)).prop_map(move |(n, j)| GivenObserver { N: n, J: j, gamma })
        });
        let sizes = (size(), size(), size(), 1.0..1e9, 0.001..0.5, 0.1..60.0);
        let rows = prop::collection::vec(numbers(1, 2), 0..3);
        let decoupled =
            prop::option::of(prop::collection::vec(prop::collection::vec(0..1_usize, 0..2), 0..3));
        (sizes, any::<bool>(), rows, decoupled, prop::option::of(given)).prop_map(
            |((decay, gain, gamma, conditioning, back_off, seconds), alternative, rows, decoupled, given)| {
                LmiChoice {
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
                }
            },
        )
    }

    fn document() -> impl Strategy<Value = Document> {
        let sizes = (1..4_usize, 1..4_usize, 0..3_usize, 0..3_usize, 0..3_usize);
        sizes.prop_flat_map(|(e, n, k, p, q)| {
            let matrices =
                [matrix(e, n), matrix(e, n), matrix(e, k), matrix(p, n), matrix(e, q), matrix(p, q)];
            let scenario = (
                1e-6..1e6,
                2..20_000_usize,
                prop_oneof![Just(Vec::new()), prop::collection::vec(entry(), n)],
                signals(k),
                signals(q),
                signals(p),
            );
            let text = ".{0,12}";
            let free = (signals(2), prop::option::of(matrix(1, n)))
                .prop_map(|(signals, feedback)| FreeData { signals, feedback });
            let kept = prop::collection::vec(design(), 0..3);
            let choices = (design(), kept, free);
            (matrices, any::<bool>(), choices, scenario, [text, text, text]).prop_map(
                |(
                    matrices,
                    discrete,
                    choices,
                    (horizon, samples, x0, u, d, noise),
                    [title, notes, paper],
                )| {
                    let (design, kept, free) = choices;
                    let named = |(k, design)| KeptDesign { name: format!("design {k}"), design };
                    Document {
                        title,
                        notes,
                        paper,
                        plant: PlantData::Descriptor(DescriptorData {
                            time: if discrete { TimeDomain::Discrete } else { TimeDomain::Continuous },
                            matrices,
                            partition: Vec::new(),
                            lipschitz: None,
                        }),
                        design,
                        scenario: ScenarioData {
                            horizon,
                            samples,
                            x0,
                            u,
                            d,
                            noise,
                            uncertainty: None,
                            free,
                            x0_formula: None,
                        },
                        tolerance: Tolerance::default(),
                        kept: kept.into_iter().enumerate().map(named).collect(),
                        figures: Vec::new(),
                    }
                },
            )
        })
    }

    proptest! {
        #[test]
        fn documents_read_back_exactly(document in document()) {
            for text in [write_document(&document), write_document_compact(&document)] {
                let read = read_document(&text);
                prop_assert_eq!(read.as_ref(), Ok(&document), "{}", text);
                let again = read.map(|read| write_document(&read));
                prop_assert_eq!(again, Ok(write_document(&document)), "the same bytes");
            }
        }

        #[test]
        fn arbitrary_text_never_panics(bytes in prop::collection::vec(any::<u8>(), 0..200)) {
            drop(read_document(&String::from_utf8_lossy(&bytes)));
        }

        #[test]
        fn a_damaged_document_never_panics(at in 0..WHOLE.len(), byte in 0x20..0x7f_u8, cut in any::<bool>()) {
            let mut bytes = WHOLE.as_bytes().to_vec();
            bytes[at] = byte;
            if cut {
                bytes.truncate(at);
            }
            drop(read_document(&String::from_utf8_lossy(&bytes)));
        }
    }
}

#[test]
fn a_key_that_stands_twice_is_refused() {
    let text = r#"{"descry": 1, "system": {"E": [[1]], "E": [[2]], "A": [[1]]}}"#;
    let error = read_document(text).unwrap_err().to_string();
    assert!(error.contains("a second key \"E\""), "{error}");
}
