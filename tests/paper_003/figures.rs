//! The example documents, and figures 5 and 6.

#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

use super::*;
use descry::document::{Document, PlantData, read_document};
use descry::numerics::Watch;
use descry::paper::{FigureSpec, Role, example};

fn document(key: &str) -> Document {
    read_document(example(key).unwrap().text).unwrap()
}

fn drawn(document: &Document, id: &str) -> FigureSpec {
    let recipe = document.figures.iter().find(|recipe| recipe.id == id).unwrap();
    document.draw(recipe, &Watch::none()).unwrap()
}

/// The value of a curve at an instant.
fn value(figure: &FigureSpec, name: &str, time: f64) -> f64 {
    let series = figure.panels.iter().flat_map(|panel| &panel.series).find(|series| series.name == name);
    series.unwrap().points.iter().find(|[t, _]| (t - time).abs() < 1e-9).unwrap()[1]
}

#[test]
fn figures_5_and_6_have_the_reference_trajectories() {
    let (reference, network) = (reference(), network());
    let mut observer = designed(&network).observer;
    // h is not unique: the reference's own gain makes the trajectories comparable
    let placement = observer.pull_out(3).unwrap().placement;
    let h = matrix(&reference["design"]["reference"]["h_local"]);
    observer.plug_in(&network, 3, LocalObserver { h, placement }).unwrap();
    let span = Span { horizon: 8.0, samples: 81 };
    let found = simulate_network(&network, &observer, &x0(20), span, &[3, 0]).unwrap();
    assert_eq!((found.t.len(), found.note.as_deref()), (81, None), "nothing ends early");
    let lift = observer.hierarchy.N.kronecker(&observer.hierarchy.M);
    for row in reference["simulation"]["rows"].as_array().unwrap() {
        let time = row["t"].as_f64().unwrap();
        let k = found.t.iter().position(|t| (t - time).abs() < 1e-9).unwrap();
        let part = &found.subsystems[0];
        for (name, value, expected) in [
            ("z", found.z.column(k).into_owned(), vector(&row["z"])),
            ("z_hat", found.z_hat.column(k).into_owned(), vector(&row["zhat"])),
            ("(N kron M) z_hat", &lift * found.z_hat.column(k), vector(&row["zhat_gauge_invariant"])),
            ("x_4", part.x.column(k).into_owned(), vector(&row["x4"])),
            ("x_4_hat", part.x_hat.column(k).into_owned(), vector(&row["x4hat"])),
        ] {
            let error = (&value - &expected).amax();
            assert!(error < 1e-6, "{name} at t = {}: {error:.1e}", found.t[k]);
        }
    }
    assert!(
        found.subsystems[0].local && !found.subsystems[1].local,
        "subsystem 1 has no observer of its own"
    );
    let from_whole = observer.hierarchy.state_of(&found.z_hat.column(80).into_owned());
    assert_eq!(found.subsystems[1].x_hat.column(80), from_whole.column(0), "read from the whole");
    // (z, x_4) at t = 0, 1, 2, 4, 8, printed to two digits
    let norms = [(0, 8.5, 7.8), (10, 20.8, 2.4), (20, 4.4, 1.0), (40, 0.28, 0.064), (80, 1.7e-4, 4.7e-5)];
    for (k, of_z, of_x) in norms {
        let e_z = (found.z.column(k) - found.z_hat.column(k)).norm();
        let e_x = (found.subsystems[0].x.column(k) - found.subsystems[0].x_hat.column(k)).norm();
        assert!(
            (e_z / of_z - 1.0).abs() < 0.03 && (e_x / of_x - 1.0).abs() < 0.06,
            "t = {}: {e_z} {e_x}",
            found.t[k]
        );
    }
}

/// h is not unique, so that `x_4_hat` is not that of the reference: it converges to the same state.
#[test]
fn figures_5_and_6_of_the_example_have_the_reference_values() {
    let (reference, document) = (reference(), document("hierarchical"));
    let (five, six) = (drawn(&document, "fig5"), drawn(&document, "fig6"));
    assert!(five.notes.is_empty() && six.notes.is_empty(), "{:?} {:?}", five.notes, six.notes);
    for row in reference["simulation"]["rows"].as_array().unwrap() {
        let time = row["t"].as_f64().unwrap();
        let (z, z_hat, x4) = (vector(&row["z"]), vector(&row["zhat"]), vector(&row["x4"]));
        for k in 0..6 {
            for (name, expected) in [
                (format!("z{}", k + 1), z[k]),
                (format!("z{}_hat", k + 1), z_hat[k]),
                (format!("ez{}", k + 1), z[k] - z_hat[k]),
            ] {
                let found = value(&five, &name, time);
                assert!(
                    (found - expected).abs() < 1e-6,
                    "{name} at t = {time}: {found}, expected {expected}"
                );
            }
        }
        for k in 0..5 {
            let found = value(&six, &format!("x{}", 16 + k), time);
            assert!((found - x4[k]).abs() < 1e-6, "x{} at t = {time}: {found}, expected {}", 16 + k, x4[k]);
        }
    }
    let error = |time: f64| {
        let one = |k: usize| value(&six, &format!("x{k}"), time) - value(&six, &format!("x{k}_hat"), time);
        (16..21).map(|k| one(k).powi(2)).sum::<f64>().sqrt()
    };
    assert!(error(0.0) > 7.0 && error(6.0) < 0.01, "from {} to {}", error(0.0), error(6.0));
    let peak = five.panels[0].series.iter().filter(|series| series.role != Role::Truth);
    let peak = peak.flat_map(|series| &series.points).map(|[_, value]| value.abs()).fold(0.0, f64::max);
    assert!((peak - 19.0).abs() < 0.5, "z_hat swings to 19, as the caption says: {peak}");
}

#[test]
fn figures_draw_no_estimate_of_what_is_not_estimated() {
    let mut document = document("hierarchical");
    document.design.plugged = Some(Vec::new());
    let six = drawn(&document, "fig6");
    let estimates = six.panels.iter().flat_map(|panel| &panel.series).filter(|s| s.role != Role::Truth);
    assert!(estimates.clone().count() == 5 && estimates.clone().all(|s| s.points.is_empty()), "left out");
    assert!(six.notes.iter().any(|note| note.contains("x16_hat")), "and said: {:?}", six.notes);
    let five = drawn(&document, "fig5");
    assert_eq!(
        five.panels,
        drawn(&self::document("hierarchical"), "fig5").panels,
        "the whole does not notice"
    );
}

#[test]
fn slower_local_poles_leave_a_larger_error() {
    let figure = drawn(&document("hierarchical"), "local-poles");
    let late = |k: usize| figure.panels[0].series[k].points[200][1].abs();
    assert!(late(1) > 10.0 * late(0) && late(0) > 2.0 * late(2), "{} {} {}", late(0), late(1), late(2));
    // both end at the speed of z_hat, exp(-2 t), whatever the local poles
    let rate = |k: usize| {
        (figure.panels[0].series[k].points[250][1] / figure.panels[0].series[k].points[300][1]).ln()
    };
    assert!((rate(0) - rate(2)).abs() < 0.1, "{} and {} per second", rate(0), rate(2));
}

#[test]
fn a_ring_of_a_thousand_draws_only_what_its_figures_show() {
    let document = document("network-ring");
    let figure = drawn(&document, "subsystem-500");
    let last = document.span().horizon;
    for k in 2496..=2500 {
        let error = value(&figure, &format!("x{k}"), last) - value(&figure, &format!("x{k}_hat"), last);
        assert!(error.abs() < 0.01, "x{k} - x{k}_hat = {error}");
    }
    let start = value(&figure, "x2496", 0.0);
    assert!((start - 5.0 * 2496.0_f64.sin()).abs() < 1e-12, "5 sin(i): {start}");
    let whole = drawn(&document, "whole");
    assert!(value(&whole, "ez1", last).abs() < 0.01, "the whole converges");
}

/// The same figures by the network itself and by its expansion.
#[test]
fn figures_do_not_depend_on_whether_a_network_is_expanded() {
    let document = document("hierarchical");
    let PlantData::Network(data) = &document.plant else { unreachable!("a network") };
    let (network, x0) = (data.network().unwrap(), document.initial_state());
    let problem = descry::paper::NetworkProblem {
        network: &network,
        design: &document.design,
        x0: &x0,
        span: document.span(),
        tolerance: &document.tolerance,
    };
    for recipe in &document.figures {
        let expanded = document.draw(recipe, &Watch::none()).unwrap();
        let never = descry::paper::compute_network_figure(&problem, recipe, &Watch::none()).unwrap();
        for (one, other) in expanded.panels.iter().zip(&never.panels) {
            assert_eq!(one.title, other.title, "{}", recipe.id);
            for (a, b) in one.series.iter().zip(&other.series) {
                assert_eq!((&a.name, a.points.len()), (&b.name, b.points.len()), "{}", recipe.id);
                let far =
                    a.points.iter().zip(&b.points).map(|(x, y)| (x[1] - y[1]).abs()).fold(0.0, f64::max);
                assert!(far < 1e-8, "{} {}: {far:.1e} apart", recipe.id, a.name);
            }
        }
    }
}

#[test]
fn a_component_that_the_whole_does_not_have_is_left_out_with_a_note() {
    let mut document = document("hierarchical");
    let descry::paper::PanelRecipe::Time { series, .. } = &mut document.figures[0].panels[0] else {
        unreachable!("over time")
    };
    series[0].index = 6;
    let figure = drawn(&document, "fig5");
    assert!(
        figure.notes.iter().any(|note| note.contains("z7") && note.contains("6 states")),
        "{:?}",
        figure.notes
    );
    document.design.method = descry::observer::Method::Proportional;
    document.design.poles = (0..20).map(|k| Complex64::from(-2.0 - 0.2 * f64::from(k))).collect();
    let figure = drawn(&document, "fig5");
    assert!(figure.notes.iter().any(|note| note.contains("hierarchical")), "{:?}", figure.notes);
}

#[test]
fn the_document_of_the_example_holds_the_same_network() {
    let text = include_str!("../documents/003-network.json");
    let document = read_document(text).unwrap();
    let PlantData::Network(data) = &document.plant else { unreachable!("a network") };
    assert_eq!(data.network().unwrap(), network(), "the paper's matrices, Psi given by its entries");
    let sparse = text.replace(
        "\"Gamma\": [\n        [-2, 2, 0, 0],\n        [1, -3, 2, 0],\n        [0, 1, -3, 2],\n        [0, 0, 1, -1]\n      ]",
        "\"Gamma\": {\"rows\": 4, \"columns\": 4, \"entries\": [[1, 1, 7], [1, 1, -2], [1, 2, 2], [2, 1, 1], [2, 2, -3], \
         [2, 3, 2], [3, 2, 1], [3, 3, -3], [3, 4, 2], [4, 3, 1], [4, 4, -1]]}",
    );
    assert_ne!(sparse, text, "the coupling was found in the text");
    let document = read_document(&sparse).unwrap();
    let PlantData::Network(data) = &document.plant else { unreachable!("a network") };
    let found = data.network().unwrap();
    assert!(matches!(found.Gamma, CouplingMatrix::Sparse { .. }), "a list of entries stays one");
    assert_eq!(found.Gamma.dense(), network().Gamma.dense(), "the later of two entries at one place counts");
    assert_eq!(document.system().unwrap(), network().expanded(), "and expands to the same system");
}
