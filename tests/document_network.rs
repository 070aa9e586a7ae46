//! Documents that hold networks: what is read, written and refused.
#![expect(clippy::unwrap_used, reason = "helpers of tests fail by panicking")]
#![cfg_attr(not(target_arch = "wasm32"), expect(non_snake_case, reason = "matrix letters of paper 003"))]

use descry::document::{
    Coupling, Document, InitialFormula, PlantData, Subject, limits, read_document, to_link_fragment,
    write_document, write_document_compact,
};
use descry::paper::{PanelRecipe, Quantity, example};
use serde_json::{Value, json};

fn value(key: &str) -> Value {
    serde_json::from_str(example(key).unwrap().text).unwrap()
}

fn changed(key: &str, at: &str, to: Value) -> String {
    let mut value = value(key);
    *value.pointer_mut(at).unwrap() = to;
    value.to_string()
}

fn read(key: &str) -> Document {
    read_document(example(key).unwrap().text).unwrap()
}

fn refused(text: &str) -> String {
    read_document(text).map(drop).unwrap_err().to_string()
}

#[test]
fn networks_read_back_as_they_were_written() {
    for key in ["hierarchical", "network-ring"] {
        let document = read(key);
        for text in [write_document(&document), write_document_compact(&document)] {
            assert_eq!(read_document(&text).as_ref(), Ok(&document), "{key}");
        }
        assert!(to_link_fragment(&document).len() < 20_000, "{key} fits into a link");
    }
}

#[test]
fn what_belongs_to_a_hierarchical_observer_is_read() {
    let ring = read("network-ring");
    assert_eq!(ring.design.local_poles.len(), 5, "local poles");
    assert_eq!(ring.design.plugged, Some(vec![99, 499, 999]), "from zero in the program");
    assert_eq!(ring.scenario.x0_formula, InitialFormula::parse("5*sin(i)").ok(), "one expression");
    assert!(ring.scenario.x0.is_empty(), "and no entries");
    let text = write_document(&ring);
    for part in
        ["\"plugged\": [100, 500, 1000]", "\"x0\": \"5*sin(i)\"", "\"local poles\": [-4, -4.5, -5, -5.5, -6]"]
    {
        assert!(text.contains(part), "{part} is written");
    }
    assert!(matches!(ring.subject(), Ok(Subject::Network(_))), "never expanded");
    assert!(matches!(read("hierarchical").subject(), Ok(Subject::Model(_))), "small enough");
    let PanelRecipe::Time { series, .. } = &ring.figures[0].panels[1] else { unreachable!("over time") };
    assert_eq!((series[2].quantity, series[2].index), (Quantity::WholeError, 2), "ez3");
}

#[test]
fn the_limit_of_expansion_is_the_same_everywhere() {
    let mut ring = read("network-ring");
    let most = limits::MAX_EXPANDED / 5;
    for size in [most, most + 1] {
        let PlantData::Network(data) = &mut ring.plant else { unreachable!("a network") };
        let entries = vec![(1, 1, -1.0)];
        data.Gamma = Coupling::Sparse { rows: size, columns: size, entries: entries.clone() };
        data.Psi = Coupling::Sparse { rows: 1, columns: size, entries };
        data.local = vec![1];
        assert_eq!(ring.model().is_ok(), size == most, "{size} subsystems of five states");
        assert_eq!(matches!(ring.subject(), Ok(Subject::Model(_))), size == most, "{size} subsystems");
    }
}

#[test]
fn initial_states_are_entries_or_one_expression() {
    let formula = |text: &str| changed("hierarchical", "/scenario/x0", json!(text));
    assert!(read_document(&formula("if(i == 3, 1, 0)")).is_ok(), "an expression in i");
    for (text, need) in [
        (formula("sin(t)"), "an expression in i, the number of the state from 1 to 20"),
        (formula("1/(i - 4)"), "the value for i = 4 is not finite"),
        (formula("i +"), "an expression in i"),
        (changed("hierarchical", "/scenario/x0", json!([1, 2])), "one number for each of the 20 states"),
        (changed("hierarchical", "/scenario/x0", json!(5)), "or an expression in i such as \"sin(i)\""),
        (changed("hierarchical", "/scenario/x0", json!("i+".repeat(2000))), "an expression in i"),
    ] {
        let error = refused(&text);
        assert!(
            error.starts_with("scenario.x0: ") && error.contains(need),
            "`{need}` is missing in: {error}"
        );
    }
    let document = read_document(&formula("i")).unwrap();
    assert_eq!(document.initial_state(), (1..=20).map(f64::from).collect::<Vec<_>>(), "1, 2, ...");
    let system = document.system().unwrap();
    assert_eq!(
        document.scenario(&system).x0.as_slice(),
        document.initial_state(),
        "the scenario has the same"
    );
}

#[test]
fn an_expression_works_for_a_system_of_matrices_too() {
    let text = r#"{"descry": 1, "system": {"E": [[1, 0], [0, 1]], "A": [[-1, 0], [0, -2]]}, "scenario": {"x0": "10^i"}}"#;
    assert_eq!(read_document(text).unwrap().initial_state(), [10.0, 100.0], "two states");
}

#[test]
fn what_does_not_belong_to_a_network_is_named() {
    for (text, place, need) in [
        (changed("network-ring", "/design/plugged/0", json!(1001)), "design.plugged[1]", "from 1 to 1000"),
        (changed("network-ring", "/design/plugged/0", json!(0)), "design.plugged[1]", "from 1 to 1000"),
        (
            changed("hierarchical", "/figures/0/panels/0/series/0/show", json!("z21")),
            "figures[1].panels[1].series[1].show",
            "only 20 of these",
        ),
        (
            changed("hierarchical", "/figures/2/runs/1/design/local poles/0", json!([-1, 2])),
            "figures[3].runs[2].design.local poles",
            "conjugate",
        ),
        (
            changed("network-ring", "/system/network/Gamma/entries/0", json!([1001, 1, 2])),
            "system.network.Gamma.entries[1][1]",
            "from 1 to 1000",
        ),
    ] {
        let error = refused(&text);
        assert!(error.starts_with(place) && error.contains(need), "{place}, `{need}`: {error}");
    }
}

#[cfg(not(target_arch = "wasm32"))]
mod random {
    use super::*;
    use descry::document::{EntryMatrix, NetworkData, ScenarioData};
    use descry::numerics::{Complex64, Tolerance};
    use descry::observer::{DesignChoice, Method, Order};
    use proptest::prelude::*;

    fn matrix(rows: usize, columns: usize) -> impl Strategy<Value = EntryMatrix> {
        prop::collection::vec(-9.0..9.0, rows * columns).prop_map(move |values| {
            EntryMatrix::from_matrix(&nalgebra::DMatrix::from_vec(rows, columns, values))
        })
    }

    fn coupling(rows: usize, columns: usize) -> impl Strategy<Value = Coupling> {
        let entry = (1..=rows, 1..=columns, -9.0..9.0);
        prop_oneof![
            matrix(rows, columns).prop_map(Coupling::Dense),
            prop::collection::vec(entry, 0..6).prop_map(move |entries| Coupling::Sparse {
                rows,
                columns,
                entries
            }),
        ]
    }

    fn network() -> impl Strategy<Value = NetworkData> {
        let sizes = (1..5_usize, 1..4_usize, 1..3_usize, 1..3_usize);
        sizes.prop_flat_map(|(size, n, m, p)| {
            let own = (matrix(n, n), matrix(n, m), matrix(m, n), matrix(1, n), matrix(p, n));
            let local = prop::sample::subsequence((1..=size).collect::<Vec<_>>(), 0..=size);
            (own, coupling(size, size), coupling(p, size), local).prop_map(
                |((a, b, c, c_G, c_L), Gamma, Psi, local)| NetworkData {
                    a,
                    b,
                    c,
                    c_G,
                    c_L,
                    Gamma,
                    Psi,
                    local,
                },
            )
        })
    }

    fn poles() -> impl Strategy<Value = Vec<Complex64>> {
        prop::collection::vec((-50.0..-0.1).prop_map(Complex64::from), 0..4)
    }

    fn document() -> impl Strategy<Value = Document> {
        let formulas = prop::sample::select(vec!["5*sin(i)", "if(i > 2, 1, -i)", "i^2/10", "-0"]);
        let formula = prop::option::of(formulas.prop_map(|text| InitialFormula::parse(text).unwrap()));
        let plugged = prop::option::of(any::<prop::sample::Index>());
        (network(), poles(), poles(), formula, plugged).prop_map(
            |(network, poles, local_poles, x0_formula, plugged)| {
                let size = network.Gamma.shape().0;
                let design = DesignChoice {
                    method: Method::Hierarchical,
                    order: Order::Full,
                    poles,
                    local_poles,
                    plugged: plugged.map(|at| (0..=at.index(size)).collect()),
                    ..DesignChoice::default()
                };
                Document {
                    title: String::new(),
                    notes: String::new(),
                    paper: "003".to_owned(),
                    plant: PlantData::Network(network),
                    design,
                    scenario: ScenarioData { x0_formula, ..ScenarioData::empty() },
                    tolerance: Tolerance::default(),
                    kept: Vec::new(),
                    figures: Vec::new(),
                }
            },
        )
    }

    proptest! {
        #[test]
        fn any_network_reads_back_exactly(document in document()) {
            for text in [write_document(&document), write_document_compact(&document)] {
                let read = read_document(&text);
                prop_assert_eq!(read.as_ref(), Ok(&document), "{}", text);
            }
        }

        #[test]
        fn a_damaged_network_never_panics(
            at in 0..example("hierarchical").unwrap().text.len(), byte in 0x20..0x7f_u8, cut in any::<bool>()
        ) {
            let mut bytes = example("hierarchical").unwrap().text.as_bytes().to_vec();
            bytes[at] = byte;
            if cut {
                bytes.truncate(at);
            }
            if let Ok(document) = read_document(&String::from_utf8_lossy(&bytes)) {
                prop_assert!(document.subject().is_ok(), "what was read fits together");
            }
        }
    }
}
