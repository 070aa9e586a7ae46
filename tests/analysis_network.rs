//! What a session shows of networks, small ones and one that is never written as one system.
#![cfg(not(target_arch = "wasm32"))]
#![expect(clippy::unwrap_used, clippy::panic, reason = "helpers of tests fail by panicking")]

use descry::document::{Document, Entry, InitialFormula, PlantData, read_document, write_document};
use descry::numerics::{Complex64, Watch, eigenvalues};
use descry::observer::{Method, Verdict};
use descry::paper::{Panel, Role, example};
use descry::session::{Analysis, Command, Edit, Field, Light, Session, Simulation, analyse, update};

fn document(key: &str) -> Document {
    read_document(example(key).unwrap().text).unwrap()
}

fn analysed(document: &Document) -> Analysis {
    analyse(document, &Watch::none()).unwrap()
}

fn simulated(document: &Document) -> Simulation {
    analysed(document).simulation.unwrap()
}

fn titles(panels: &[Panel]) -> Vec<&str> {
    panels.iter().map(|panel| panel.title.as_str()).collect()
}

fn panel<'a>(panels: &'a [Panel], title: &str) -> &'a Panel {
    panels
        .iter()
        .find(|panel| panel.title == title)
        .unwrap_or_else(|| panic!("no {title}: {:?}", titles(panels)))
}

/// A chain of `size` subsystems of order one, each pulled to the next: the rank of its coupling is `size`.
fn chain(size: usize) -> Document {
    let mut entries: Vec<String> = (1..=size).map(|i| format!("[{i}, {i}, -1]")).collect();
    entries.extend((1..size).map(|i| format!("[{i}, {}, 1]", i + 1)));
    let text = format!(
        r#"{{"descry": 1, "system": {{"network": {{"a": [[-0.1]], "b": [[1]], "c": [[1]], "c_G": [[1]], "c_L": [[1]],
        "Gamma": {{"rows": {size}, "columns": {size}, "entries": [{}]}},
        "Psi": {{"rows": 1, "columns": {size}, "entries": [[1, {size}, 1]]}}, "local": [1, 2]}}}},
        "design": {{"method": "hierarchical", "order": "full", "local poles": [-3], "poles": []}}}}"#,
        entries.join(", ")
    );
    read_document(&text).unwrap()
}

#[test]
fn the_chain_of_the_paper_offers_every_method_that_has_its_data() {
    let found = analysed(&document("hierarchical"));
    assert!(found.verified(), "the example's design");
    for light in &found.methods {
        let expected = match light.method {
            Method::ProportionalIntegral | Method::Decentralized => Light::Missing,
            Method::Proportional | Method::InputDecoupled | Method::HInfinity | Method::Hierarchical => {
                Light::Exists
            }
        };
        assert_eq!(light.light, expected, "{:?}: {}", light.method, light.why);
    }
    let value = |name: &str| found.properties.iter().find(|p| p.name == name).unwrap().value.clone();
    assert_eq!(value("Network"), "N = 4, n = 5");
    assert_eq!(value("nu = rank Gamma"), "3 of 4");
    assert_eq!(value("mu = rank O_n(a_I, b_I c_I)"), "2 of 5");
    assert_eq!(value("Order of the whole"), "6");
    assert_eq!(found.plant_eigenvalues.len(), 20, "a small network is one system, too");
}

#[test]
fn nothing_is_claimed_of_subsystems_without_a_local_observer() {
    let found = simulated(&document("hierarchical"));
    assert_eq!(found.estimated, [15, 16, 17, 18, 19], "subsystem 4 alone");
    assert_eq!(found.rms.len(), 5, "one for each of these");
    assert!(found.rms.iter().all(|rms| *rms < 0.2), "they converge: {:?}", found.rms);
    assert!(found.rms_whole.is_some_and(|rms| rms < 0.5), "so does the whole: {:?}", found.rms_whole);
    let expected =
        ["z - z_hat, z1 to z2", "z - z_hat, z3 to z4", "z - z_hat, z5 to z6", "e = x - x_hat of subsystem 4"];
    assert_eq!(titles(&found.errors.panels), expected, "errors of what is estimated");
    let others = panel(&found.states.panels, "subsystem 2, not estimated");
    assert!(others.series.iter().all(|series| series.role == Role::Truth), "no estimate is drawn");
    assert!(
        found.states.notes.iter().any(|note| note.contains("subsystems 1, 2, 3")),
        "{:?}",
        found.states.notes
    );
    let own = panel(&found.states.panels, "x3 of subsystem 4 (x18)");
    let names: Vec<&str> = own.series.iter().map(|series| series.name.as_str()).collect();
    assert_eq!(names, ["x18", "x18_hat"], "its state beside its estimate");
}

#[test]
fn the_true_whole_is_that_of_the_reference() {
    let reference: serde_json::Value = serde_json::from_str(include_str!("reference/ex003.json")).unwrap();
    let found = simulated(&document("hierarchical"));
    let start: Vec<f64> = serde_json::from_value(reference["simulation"]["rows"][0]["z"].clone()).unwrap();
    for (k, expected) in start.iter().enumerate() {
        let series = found.states.panels.iter().flat_map(|panel| &panel.series);
        let z = series.clone().find(|series| series.name == format!("z{}", k + 1)).unwrap();
        assert!((z.points[0][1] - expected).abs() < 1e-12, "z{}(0) = {}", k + 1, z.points[0][1]);
    }
}

#[test]
fn without_any_local_observer_the_whole_is_still_estimated() {
    let mut document = document("hierarchical");
    let before = simulated(&document);
    document.design.plugged = Some(Vec::new());
    let found = simulated(&document);
    assert!(found.estimated.is_empty() && found.rms.is_empty(), "no state is claimed");
    assert_eq!(titles(&found.errors.panels).len(), 3, "the whole in three blocks");
    for k in 0..3 {
        assert_eq!(found.errors.panels[k], before.errors.panels[k], "z_hat is the same to the last bit");
    }
}

#[test]
fn another_method_on_a_small_network_estimates_every_state() {
    let mut document = document("hierarchical");
    document.design.method = Method::Proportional;
    document.design.poles = (0..20).map(|k| Complex64::from(-2.0 - 0.2 * f64::from(k))).collect();
    document.scenario.horizon = 1.0;
    document.scenario.samples = 11;
    let found = analysed(&document);
    let design = found.assessment.unwrap().outcome.unwrap();
    let simulation = found.simulation.unwrap();
    assert_eq!(design.estimated_states(20).len(), 20, "a centralized observer");
    assert_eq!((simulation.estimated.len(), simulation.rms_whole), (20, None), "and no whole");
    assert_eq!(simulation.states.panels.len(), 20, "a panel for each state");
}

#[test]
fn a_ring_of_a_thousand_subsystems_is_analysed_without_being_expanded() {
    let document = document("network-ring");
    assert!(document.system().is_err(), "it is never one system");
    let found = analysed(&document);
    assert!(found.verified(), "{:?}", found.assessment);
    for light in &found.methods {
        let expected = if light.method == Method::Hierarchical { Light::Exists } else { Light::Missing };
        assert_eq!(light.light, expected, "{:?}: {}", light.method, light.why);
    }
    assert!(found.methods[0].why.contains("1000 * 5 = 5000 states"), "{}", found.methods[0].why);
    let property = |name: &str| found.properties.iter().find(|p| p.name == name).unwrap();
    assert_eq!(property("Size").value, "5000 states");
    assert_eq!(property("nu = rank Gamma").value, "3 of 1000");
    assert_eq!(property("(alpha_z, gamma_z) detectable").verdict, Some(Verdict::Holds));
    let PlantData::Network(data) = &document.plant else { panic!("a network") };
    for mode in eigenvalues(&data.a.values()).unwrap() {
        let near = found.plant_eigenvalues.iter().map(|z| (z - mode).norm()).fold(f64::INFINITY, f64::min);
        assert!(near < 1e-9, "{mode} is a mode of the ring");
    }
    assert_eq!(found.plant_eigenvalues.len(), 6 + 5, "those of the whole, and those of a subsystem alone");

    let simulation = found.simulation.unwrap();
    // hubs show their first state in the whole, with or without a local observer
    let plugged = [100, 500, 1000].map(|i| 5 * (i - 1));
    let local = plugged.iter().flat_map(|first| *first..first + 5);
    let mut expected: Vec<usize> = [0, 5 * 333, 5 * 667].into_iter().chain(local).collect();
    expected.sort_unstable();
    assert_eq!(simulation.estimated, expected, "what is estimated of 5000 states");
    assert!(simulation.rms.iter().all(|rms| *rms < 0.5), "{:?}", simulation.rms);
    let first = titles(&simulation.states.panels)[..4].to_vec();
    assert_eq!(first[3], "x1 of subsystem 100 (x496)", "subsystems with local observers come first");
    assert!(simulation.states.panels.len() < 40, "no thousand panels: {}", simulation.states.panels.len());
}

#[test]
fn a_large_network_tells_a_method_why_it_cannot_be_used() {
    let mut document = document("network-ring");
    document.design.method = Method::Proportional;
    let found = analysed(&document);
    let assessment = found.assessment.unwrap();
    let error = assessment.outcome.unwrap_err().to_string();
    assert!(error.contains("5000 states") && error.contains("hierarchical"), "{error}");
    assert!(assessment.conditions.is_empty(), "nothing is asked that cannot be used");
    assert!(found.simulation.unwrap_err().contains(&error), "and nothing simulated");
}

#[test]
fn one_coupling_more_is_one_rank_more() {
    let mut document = document("network-ring");
    let PlantData::Network(data) = &mut document.plant else { panic!("a network") };
    let descry::document::Coupling::Sparse { entries, .. } = &mut data.Gamma else { panic!("sparse") };
    entries.push((50, 51, 1.0));
    let found = analysed(&document);
    let order = found.properties.iter().find(|p| p.name == "Order of the whole").unwrap();
    assert_eq!(order.value, "8", "as the notes of the example say");
}

#[test]
fn noise_in_a_large_network_is_said_not_to_be_simulated() {
    let mut document = document("network-ring");
    document.scenario.noise = vec![descry::system::Signal::parse("0.1*noise(t/0.1, 1)").unwrap()];
    let notes = simulated(&document).notes;
    assert!(notes.iter().any(|note| note.contains("noise")), "{notes:?}");
}

#[test]
fn a_coupling_of_full_rank_makes_the_whole_an_estimate_of_everything() {
    let mut document = chain(32);
    document.design.poles = (0..32).map(|k| Complex64::from(-1.0 - 0.05 * f64::from(k))).collect();
    let found = analysed(&document);
    let order = found.properties.iter().find(|p| p.name == "Order of the whole").unwrap();
    assert_eq!(order.value, "32");
    assert_eq!(found.plant_eigenvalues.len(), 32, "no mode is left outside the whole");
    if let Ok(design) = found.assessment.unwrap().outcome {
        assert_eq!(design.estimated_states(32).len(), 32, "z is x in other axes");
    }
}

#[test]
fn initial_states_follow_one_expression_until_one_is_typed() {
    let mut session = Session::with_first_example().unwrap();
    update(&mut session, Command::OpenExample { key: "hierarchical".to_owned() });
    assert!((session.document().initial_state()[3] - 5.0 * 4.0_f64.sin()).abs() < 1e-15, "5 sin(i)");
    update(&mut session, Command::Edit(Edit::InitialFormula("i^".to_owned())));
    assert_eq!(session.draft(&Field::InitialFormula).unwrap().text, "i^", "what is not understood stays");
    update(&mut session, Command::Edit(Edit::InitialFormula("1/(i - 7)".to_owned())));
    assert!(session.draft(&Field::InitialFormula).unwrap().error.contains("i = 7"), "x7(0) is not finite");
    update(&mut session, Command::Edit(Edit::InitialFormula("i".to_owned())));
    assert!(session.draft(&Field::InitialFormula).is_none(), "now it is");
    assert_eq!(session.document().initial_state()[19], 20.0, "the last state");
    update(&mut session, Command::Edit(Edit::Initial { state: 1, text: "1/4".to_owned() }));
    let scenario = &session.document().scenario;
    assert_eq!((scenario.x0.len(), scenario.x0_formula.as_ref()), (20, None), "entries from now on");
    assert_eq!(session.document().initial_state()[..3], [1.0, 0.25, 3.0], "the others keep their values");
    let again = read_document(&write_document(session.document())).unwrap();
    assert_eq!(again, *session.document(), "and all of it is written");
    update(&mut session, Command::Edit(Edit::InitialFormula(" ".to_owned())));
    assert_eq!(session.document().initial_state(), [0.0; 20], "nothing typed, nothing set");
    update(&mut session, Command::Undo);
    assert_eq!(session.document().scenario.x0[1], Entry::typed("1/4").unwrap(), "undone");
}

#[test]
fn single_states_of_a_large_network_are_not_typed() {
    let mut session = Session::with_first_example().unwrap();
    update(&mut session, Command::OpenExample { key: "network-ring".to_owned() });
    let before = session.document().clone();
    update(&mut session, Command::Edit(Edit::Initial { state: 0, text: "1".to_owned() }));
    assert!(session.message().unwrap().error, "the reason is told");
    assert_eq!(*session.document(), before, "and nothing changed");
    update(&mut session, Command::Edit(Edit::InitialFormula("if(i == 1, 1, 0)".to_owned())));
    let formula = InitialFormula::parse("if(i == 1, 1, 0)").ok();
    assert_eq!(session.document().scenario.x0_formula, formula, "one expression does the same");
}
