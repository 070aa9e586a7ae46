//! The example document and its figures.

#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

use super::*;
use descry::document::{Document, read_document};
use descry::numerics::Watch;
use descry::observer::assess;
use descry::paper::{FigureRecipe, FigureSpec, Problem, Role, compute_figure};
use descry::simulation::{FreeVariables, Scenario, WidePlant};
use descry::system::Signal;
use nalgebra::dvector;

fn document() -> Document {
    read_document(descry::paper::example("input-decoupled").unwrap().text).unwrap()
}

/// A figure of the document after a change of its scenario and of the recipe.
fn changed(id: &str, change: impl Fn(&mut Scenario, &mut FigureRecipe)) -> FigureSpec {
    let document = document();
    let model = document.model().unwrap();
    let mut scenario = document.scenario(&model.system);
    let mut recipe = document.figures.iter().find(|recipe| recipe.id == id).unwrap().clone();
    change(&mut scenario, &mut recipe);
    let problem = Problem {
        model: &model,
        design: &document.design,
        scenario: &scenario,
        tolerance: &document.tolerance,
    };
    compute_figure(&problem, &recipe, &Watch::none()).unwrap()
}

fn figure(id: &str) -> FigureSpec {
    changed(id, |_, _| {})
}

/// The points of a curve of a figure.
fn curve<'a>(figure: &'a FigureSpec, panel: &str, name: &str) -> &'a [[f64; 2]] {
    let panel = figure.panels.iter().find(|p| p.title == panel).unwrap_or_else(|| panic!("no panel {panel}"));
    let series = panel.series.iter().find(|s| s.name == name).unwrap_or_else(|| panic!("no curve {name}"));
    &series.points
}

/// The value of a curve at the instant that lies nearest.
fn at(points: &[[f64; 2]], t: f64) -> f64 {
    let nearest = points.iter().min_by(|a, b| (a[0] - t).abs().total_cmp(&(b[0] - t).abs())).unwrap();
    nearest[1]
}

fn largest(points: &[[f64; 2]]) -> f64 {
    points.iter().fold(0.0, |largest: f64, [_, value]| largest.max(value.abs()))
}

/// The difference of two curves at the same instants.
fn apart(one: &[[f64; 2]], other: &[[f64; 2]]) -> f64 {
    assert_eq!(one.len(), other.len(), "the same instants");
    one.iter().zip(other).fold(0.0, |largest: f64, (a, b)| largest.max((a[1] - b[1]).abs()))
}

#[test]
fn the_example_document_holds_the_paper_s_matrices_and_poles() {
    let document = document();
    assert_eq!(document.system().unwrap(), example(), "system (1) of section III");
    assert_eq!(document.design.poles, [-1.0, -2.0].map(Complex64::from), "the poles of section III");
    let model = document.model().unwrap();
    let found = assess(&model, &document.design, &document.tolerance, &Watch::none()).unwrap();
    assert!(found.verified(), "{:#?}", found.outcome);
}

#[test]
fn the_example_starts_consistently_and_its_feedback_bounds_the_plant() {
    let document = document();
    let free = document.scenario.free.values();
    let feedback = free.feedback.clone().unwrap();
    // v = W' x = v0 - feedback x at the start, and the algebraic equation
    let x0 = DVector::from_iterator(4, document.scenario.x0.iter().map(|entry| entry.value));
    let (system, u0, d0) = (example(), dvector![0.0, 0.5], dvector![1.0]);
    let wide = WidePlant::new(&system.clone().into(), &x0, &u0, &Tolerance::default()).unwrap();
    let follows = (wide.directions.transpose() + &feedback) * &x0;
    assert!(follows.norm() < 1e-14, "v0(0) = 0: off by {follows}");
    let algebraic = system.A.row(2) * &x0 + system.B.row(2) * u0 + system.D.row(2) * d0;
    assert!(algebraic.norm() < 1e-14, "the third equation at the start: {algebraic}");
    // the completed plant: [A; W' + feedback] on diag(1, 1, 0, 0)
    let at = coordinates(&system, &Tolerance::default()).unwrap();
    let below = wide.directions.transpose() + feedback;
    let (rest, kept) = (stack(&[&at.A4, &(&below * &at.N2)]), stack(&[&at.A3, &(&below * &at.N1)]));
    let closed = &at.A1 - &at.A2 * rest.lu().solve(&kept).unwrap();
    let wished = [Complex64::new(-1.0, 1.0), Complex64::new(-1.0, -1.0)];
    let off = spectral_distance(&eigenvalues(&closed).unwrap(), &wished);
    assert!(off < 1e-14, "the plant's modes are -1 +- i: off by {off:.1e}");
}

#[test]
fn the_figure_without_feedback_goes_through_the_reference_points() {
    let reference = reference();
    let found = changed("sim-open", |scenario, recipe| {
        (scenario.horizon, scenario.samples) = (3.0, 7);
        scenario.d = vec![Signal::parse("1.5*sin(3*t)").unwrap()];
        let signals = vec![Signal::parse("0.5*sin(1.7*t)").unwrap()];
        recipe.runs[0].scenario.free = Some(FreeVariables { signals, feedback: None });
    });
    for row in reference["simulation"]["rows"].as_array().unwrap() {
        let t = row["t"].as_f64().unwrap();
        let values = |key: &str| -> Vec<f64> { serde_json::from_value(row[key].clone()).unwrap() };
        let check = |panel: &str, name: &str, expected: f64| {
            let found = at(curve(&found, panel, name), t);
            assert!((found - expected).abs() < 1e-6, "{name} at t = {t}: {found} instead of {expected}");
        };
        for i in 0..4 {
            let state = format!("x{}", i + 1);
            let (truth, estimate) = (values("x")[i], values("xhat")[i]);
            check(&state, &state, truth);
            check(&state, &format!("{state}_hat"), estimate);
            check("errors", &format!("e{}", i + 1), truth - estimate);
        }
        check("unknown input", "d1", values("d")[0]);
        check("unknown input", "d1_hat", values("dhat")[0]);
        check("errors", "ed1", values("d")[0] - values("dhat")[0]);
    }
}

#[test]
fn feedback_changes_the_states_and_not_the_errors() {
    let (bounded, open) = (figure("sim-fb"), figure("sim-open"));
    assert!(largest(curve(&bounded, "x1", "x1")) < 2.0, "bounded");
    assert!(largest(curve(&open, "x1", "x1")) > 9000.0, "e^8 and more");
    for name in ["e1", "e2", "e3", "e4", "ed1"] {
        let off = apart(curve(&bounded, "errors", name), curve(&open, "errors", name));
        // of nine thousand, a few units in the twelfth place are left
        assert!(off < 1e-7, "{name}: the figures differ by {off:.1e}");
    }
}

/// Values of the classical method of order 4 with steps of 1 ms on the reduced equations, by another program.
#[test]
fn both_figures_go_through_points_computed_elsewhere() {
    for (id, points) in [
        (
            "sim-fb",
            [
                (1.0, 0.515, -0.449),
                (2.0, 0.399, 1.733),
                (4.7, -0.444, -0.719),
                (7.5, 0.408, 0.951),
                (8.0, 0.210, 2.477),
            ],
        ),
        (
            "sim-open",
            [
                (1.0, 5.688, -2.414),
                (2.0, 20.371, -1.100),
                (4.7, 338.554, -3.389),
                (7.5, 5607.255, -1.714),
                (8.0, 9246.079, -0.151),
            ],
        ),
    ] {
        let found = figure(id);
        for (t, x1, x2) in points {
            for (name, expected) in [("x1", x1), ("x2", x2)] {
                let found = at(curve(&found, name, name), t);
                // the other program meets the jump of d within a step
                let limit = 2e-3 * (1.0 + f64::abs(expected) / 10.0);
                assert!((found - expected).abs() < limit, "{id}: {name} at {t}: {found}, not {expected}");
            }
        }
    }
}

#[test]
fn a_jump_of_the_unknown_input_is_followed_without_lag() {
    let found = figure("sim-fb");
    let (d, estimate) = (curve(&found, "unknown input", "d1"), curve(&found, "unknown input", "d1_hat"));
    let jump = std::f64::consts::PI / 0.8;
    for (name, points) in [("d1", d), ("d1_hat", estimate)] {
        let step = at(points, jump + 0.01) - at(points, jump - 0.02);
        assert!((step + 2.0).abs() < 0.15, "{name} jumps from +1 to -1 at {jump}: by {step}");
    }
    let errors = curve(&found, "errors", "ed1");
    let step = at(errors, jump + 0.01) - at(errors, jump - 0.02);
    assert!(step.abs() < 0.01, "the error does not: {step}");
    // ed = -G e^(H t) e0 with e0 = -(1, -1)
    let design = paper_design(Order::Full);
    let (H, G) = (design.matrix("H").unwrap(), design.matrix("G").unwrap());
    for t in [0.0, 1.0, 4.0, 8.0] {
        let expected = (G * simulation::exponential(&(H * t)) * dvector![1.0, -1.0])[0];
        let found = at(errors, t);
        assert!((found - expected).abs() < 1e-9, "t = {t}: {found} instead of {expected}");
    }
}

#[test]
fn twice_the_unknown_input_leaves_the_errors_as_they_are() {
    let found = figure("twice-d");
    for panel in ["error of the unknown input", "error of x4"] {
        let off = apart(curve(&found, panel, "with d"), curve(&found, panel, "with 2 d"));
        assert!(off < 1e-9, "{panel}: {off:.1e}");
    }
    let other = apart(curve(&found, "x4", "x4 with d"), curve(&found, "x4", "x4 with 2 d"));
    assert!(other > 1.0, "the states differ: {other}");
    assert_eq!(found.notes.len(), 1, "what is free is said once for both runs: {:?}", found.notes);
}

#[test]
fn every_figure_says_what_to_see() {
    let document = document();
    assert_eq!(document.figures.len(), 3, "bounded, open, doubled");
    for recipe in &document.figures {
        let figure = figure(&recipe.id);
        assert!(!figure.see.is_empty() && !figure.caption.is_empty(), "{}", recipe.id);
        for panel in &figure.panels {
            let full = panel.series.iter().all(|s| s.points.len() == 801);
            assert!(full, "{}: {} has a point for every sample", recipe.id, panel.title);
        }
    }
    let estimate = &figure("sim-fb").panels[0].series[1];
    assert_eq!(estimate.role, Role::Estimate, "dashed");
}
