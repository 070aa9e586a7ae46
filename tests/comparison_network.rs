//! Designs side by side for networks: observers of the whole and of subsystems, without ever expanding the network.
#![cfg(not(target_arch = "wasm32"))]
#![expect(clippy::unwrap_used, clippy::panic, reason = "helpers of tests fail by panicking")]

use descry::document::comparison::{Group, comparison_table};
use descry::document::{Document, Subject, read_document};
use descry::numerics::Watch;
use descry::observer::{ErrorGain, assess, assess_network, network_error_system};
use descry::paper::network_comparison;
use descry::simulation::comparison::{Compared, compare};
use descry::simulation::simulate_network;
use descry::system::Network;

/// A ring with more states than are ever expanded.
const RING: &str = r#"{"descry":1,"system":{"network":{
"a":[[-1,1],[0,-2]],"b":[[0],[1]],"c":[[1,0]],
"Gamma":{"rows":200,"columns":200,"entries":[[1,2,1],[2,1,1]]},
"Psi":{"rows":2,"columns":200,"entries":[[1,1,1],[1,2,2],[2,1,1]]},"c_G":[[1,0]],"c_L":[[1,0]],"local":[1,7]}},
"scenario":{"horizon":3,"samples":100,"x0":"sin(i)"},
"design":{"method":"hierarchical","order":"full","poles":[-3,-4,-5,-6],"local poles":[-7,-8]},
"compare":[{"name":"slower","design":{"method":"hierarchical","order":"full","poles":[-2,-2.5,-3,-3.5],"local poles":[-4,-5],"plugged":[7]}},
{"name":"PI","design":{"method":"proportional-integral","poles":[-1,-2]}}]}"#;

#[test]
fn of_a_large_network_hierarchical_designs_are_compared_and_others_refused() {
    let (_, _, Compared { comparison: found, .. }) = ring(RING);
    let orders: Vec<Option<usize>> =
        found.rows.iter().map(|row| row.outcome.as_ref().ok().map(|design| design.order)).collect();
    assert_eq!(orders, [Some(8), Some(6), None], "global order 4 and two states for each local observer");
    let error = found.rows[2].outcome.as_ref().unwrap_err().to_string();
    assert!(error.contains("400 states") && error.contains("only the hierarchical"), "{error}");
    let first = found.rows[0].outcome.as_ref().unwrap();
    assert!(first.verified && first.margin.is_some_and(|margin| (margin - 3.0).abs() < 1e-6), "{first:?}");
}

fn ring(text: &str) -> (Document, Network, Compared) {
    let document = read_document(text).unwrap();
    let Subject::Network(network) = document.subject().unwrap() else {
        panic!("400 states are not expanded")
    };
    let found = document.compare_network(&network, &Watch::none()).unwrap();
    (document, *network, found)
}

#[test]
fn of_a_large_network_errors_are_those_of_the_simulation_and_norms_bound_them() {
    let (document, network, found) = ring(RING);
    let figures = network_comparison(&found, &network);
    for (run, estimated) in found.runs.iter().zip([vec![0, 1, 2, 3, 12, 13], vec![0, 1, 2, 3, 12, 13]]) {
        let row = found.comparison.rows[run.row].outcome.as_ref().unwrap();
        // of subsystems 1 and 2 the whole determines every state, 7 has a local observer
        assert_eq!(row.estimated, estimated, "{}", row.title);
        let errors = row.scenario.as_ref().unwrap();
        let assessed =
            assess_network(&network, document.contenders()[run.row].choice, &document.tolerance).unwrap();
        let observer = assessed.outcome.unwrap().hierarchical.unwrap();
        let span = document.span();
        let motion =
            simulate_network(&network, &observer, &document.initial_state(), span, &[0, 1, 6]).unwrap();
        let mut sum = 0.0;
        for part in &motion.subsystems {
            sum += (&part.x - &part.x_hat).norm_squared() / motion.t.len() as f64;
        }
        let all = errors.all_states.unwrap();
        assert!(sum > 0.0 && (all.rms - sum.sqrt()).abs() < 1e-9 * all.rms, "{}: {all:?}", row.title);
        assert_eq!(errors.states.iter().flatten().count(), 6, "one for each estimated state");
        assert_eq!(row.gains.d_to_e, ErrorGain::NoInput, "networks have no unknown input");
        let norm = row.gains.w_to_e.value().unwrap();
        assert!(norm > 0.0 && norm.is_finite(), "{:?}", row.gains);
    }
    let table = comparison_table(&found.comparison);
    let each: Vec<&str> =
        table.lines.iter().filter(|line| line.group == Group::Each).map(|line| line.label.as_str()).collect();
    let expected = ["rms e1", "rms e2", "rms e3", "rms e4", "rms e13", "rms e14"];
    assert_eq!(each, expected, "a line for each state that somebody estimates");
    let states = figures.states.unwrap();
    let titles: Vec<&str> = states.panels.iter().map(|panel| panel.title.as_str()).collect();
    assert_eq!(titles[..2], ["z1 of the whole", "z2 of the whole"], "the whole comes first");
    assert!(titles.contains(&"x1 of subsystem 7 (x13)"), "{titles:?}");
    assert!(states.panels.iter().all(|panel| panel.series.len() == 3), "the truth and two designs");
    assert!(figures.errors.is_some() && figures.gains.is_some(), "errors and gains, too");
}

/// Where every state of a network is never simulated, the noise norm comes from a rotated error system of small order.
#[test]
fn the_noise_norm_of_a_network_is_the_same_with_and_without_expanding_it() {
    let (coupled, loose) = ("[1,2,1],[2,1,1],[3,1,2],[5,2,0.5],[6,1,1]", "");
    let (seen, unseen) = ("[1,0,0,0,0,0],[1,-1,0,0,0,0]", "[0,0,0,0,0,0]");
    for (plugged, local, entries, psi) in [
        ("", "[1,2,3,4,5,6]", coupled, seen),
        (r#","plugged":[3,5]"#, "[3,5]", coupled, seen),
        (r#","plugged":[]"#, "[1]", coupled, seen),
        // nothing is coupled: there is no whole, and all local observers are alike
        ("", "[1,2,3,4,5,6]", loose, unseen),
    ] {
        let text = format!(
            r#"{{"descry":1,"system":{{"network":{{"a":[[-1,1],[0,-2]],"b":[[0],[1]],"c":[[1,0]],
            "Gamma":{{"rows":6,"columns":6,"entries":[{entries}]}},
            "Psi":[{psi}],"c_G":[[1,0]],"c_L":[[1,0]],"local":{local}}}}},
            "design":{{"method":"hierarchical","order":"full","poles":[-3,-4,-5,-6],"local poles":[-7,-8]{plugged}}}}}"#
        );
        let document = read_document(&text).unwrap();
        let model = document.model().unwrap();
        let (tolerance, scenario) = (&document.tolerance, document.scenario(&model.system));
        let found = compare(&model, &scenario, &document.contenders(), tolerance, &Watch::none()).unwrap();
        let chosen = found.comparison.rows[0].outcome.as_ref().unwrap();
        let design = assess(&model, &document.design, tolerance, &Watch::none()).unwrap().outcome.unwrap();
        let network = model.network.as_ref().unwrap();
        let rotated = network_error_system(network, design.hierarchical.as_deref().unwrap()).unwrap();
        let gains = rotated.gains(&document.tolerance).unwrap();
        let (expanded, rotated) = (&chosen.gains.w_to_e, &gains.w_to_e);
        match (expanded.value(), rotated.value()) {
            (Some(a), Some(b)) => assert!((a - b).abs() < 1e-7 * a, "{local}{plugged}: {a} and {b}"),
            _ => assert_eq!(expanded, rotated, "{local}{plugged}: nothing is estimated"),
        }
    }
}
