//! Paper 004 (Koenig and Mammar): conditions, designs and figures against the reference numbers.
#![expect(clippy::unwrap_used, clippy::panic, reason = "helpers of tests fail by panicking")]
#![expect(non_snake_case, reason = "matrix letters of the paper")]

use descry::document::{Document, read_document, write_document};
use descry::numerics::{Complex64, RankDecision, Tolerance, Watch, eigenvalues, spectral_distance};
use descry::observer::{
    Assessment, Condition, DesignChoice, DesignError, Evidence, Method, Order, Verdict, assess, conditions,
    unknown_input_response,
};
use descry::paper::{EXAMPLES, FigureSpec, Problem, compute_figure, example};
use descry::simulation::Trajectory;
use descry::system::{DescriptorSystem, Signal, TimeDomain};
use nalgebra::{DMatrix, dmatrix};
use serde_json::Value;

fn reference() -> Value {
    serde_json::from_str(include_str!("reference/ex004.json")).unwrap()
}

fn matrix(value: &Value) -> DMatrix<f64> {
    let rows: Vec<Vec<f64>> = serde_json::from_value(value.clone()).unwrap();
    DMatrix::from_row_iterator(rows.len(), rows[0].len(), rows.into_iter().flatten())
}

fn poles(value: &Value) -> Vec<Complex64> {
    let pairs: Vec<[f64; 2]> = serde_json::from_value(value.clone()).unwrap();
    pairs.into_iter().map(|[re, im]| Complex64::new(re, im)).collect()
}

fn document() -> Document {
    read_document(example("proportional-integral").unwrap().text).unwrap()
}

fn system() -> DescriptorSystem {
    document().system().unwrap()
}

fn choice(method: Method, order: Order) -> DesignChoice {
    DesignChoice { method, order, ..document().design }
}

fn assessed(method: Method, order: Order) -> Assessment {
    assess(&system().into(), &choice(method, order), &Tolerance::default(), &Watch::none()).unwrap()
}

fn close(found: &DMatrix<f64>, expected: &DMatrix<f64>, limit: f64, what: &str) {
    assert_eq!(found.shape(), expected.shape(), "{what}: shape");
    let error = (found - expected).norm() / expected.norm().max(1.0);
    assert!(error <= limit, "{what}: relative difference {error:.2e}\nfound {found}expected {expected}");
}

#[test]
fn the_example_document_holds_the_paper_s_matrices() {
    let inputs = &reference()["inputs"];
    let system = system();
    for (name, found) in
        [("Es", &system.E), ("As", &system.A), ("Bs", &system.B), ("Ns", &system.D), ("Cs", &system.C)]
    {
        assert_eq!(*found, matrix(&inputs[name]), "{name}");
    }
}

#[test]
fn every_example_reads_back_exactly() {
    for example in EXAMPLES {
        let document = read_document(example.text).unwrap_or_else(|error| panic!("{}: {error}", example.key));
        let again = read_document(&write_document(&document)).unwrap();
        assert_eq!(again, document, "{}: write, then read", example.key);
    }
}

#[test]
fn all_conditions_of_the_example_hold() {
    for order in Order::ALL {
        let found = assessed(Method::ProportionalIntegral, order);
        for condition in &found.conditions {
            assert_eq!(
                condition.verdict,
                Verdict::Holds,
                "{order:?} {}: {}",
                condition.label,
                condition.summary
            );
        }
    }
}

#[test]
fn reduced_order_has_the_unique_gains_of_the_reference() {
    let reference = &reference()["reduced"];
    let found = assessed(Method::ProportionalIntegral, Order::Reduced);
    let design = found.outcome.as_ref().unwrap();
    assert!(found.verified(), "{:#?}", design.verification.checks);
    for name in ["Ar", "F", "L1", "J", "M1", "T2"] {
        close(design.matrix(name).unwrap(), &matrix(&reference["reference"][name]), 1e-9, name);
    }
    // the sign of the single row P3 is free: Cr, Lb2 and Lb3 change sign together, L2 = Lb2 P3 does not
    for name in ["L2", "L3"] {
        close(design.matrix(name).unwrap(), &matrix(&reference["reference"][name]), 1e-9, name);
    }
    let expected = poles(&reference["unique"]["eig_Aobs"]);
    let distance = spectral_distance(&design.verification.spectrum, &expected);
    assert!(distance < 1e-8 * 26.0, "spectrum off by {distance:.2e}");
    assert_eq!(design.observer.order(), 3, "r + nf = 2 + 1");
}

#[test]
fn full_order_places_five_poles_and_has_the_reference_left_inverse() {
    let reference = &reference()["full"];
    let found = assessed(Method::ProportionalIntegral, Order::Full);
    let design = found.outcome.as_ref().unwrap();
    assert!(found.verified(), "{:#?}", design.verification.checks);
    for name in ["T1", "T2", "J", "M1"] {
        close(design.matrix(name).unwrap(), &matrix(&reference["reference"][name]), 1e-9, name);
    }
    let expected = poles(&reference["unique"]["eig_Aobs"]);
    let distance = spectral_distance(&design.verification.spectrum, &expected);
    assert!(distance < 1e-7 * 33.0, "spectrum off by {distance:.2e}");
}

#[test]
fn general_form_is_verified_on_the_example() {
    let found = assessed(Method::ProportionalIntegral, Order::General);
    assert!(found.verified(), "{:#?}", found.outcome);
}

#[test]
fn proportional_observer_of_both_orders_is_verified() {
    for order in [Order::Full, Order::Reduced] {
        let found = assessed(Method::Proportional, order);
        assert!(found.verified(), "{order:?}: {:#?}", found.outcome);
    }
}

#[test]
fn all_figures_can_be_computed() {
    let document = document();
    let model = document.model().unwrap();
    let scenario = document.scenario(&model.system);
    let problem = Problem {
        model: &model,
        design: &document.design,
        scenario: &scenario,
        tolerance: &document.tolerance,
    };
    for recipe in &document.figures {
        let figure = compute_figure(&problem, recipe, &Watch::none())
            .unwrap_or_else(|error| panic!("{}: {error}", recipe.id));
        assert!(!figure.panels.is_empty(), "{}: no panel", recipe.id);
        for panel in &figure.panels {
            assert!(
                panel.series.iter().all(|s| s.points.len() > 100),
                "{}: {} has too few points",
                recipe.id,
                panel.title
            );
        }
        assert!(figure.notes.is_empty(), "{}: {:?}", recipe.id, figure.notes);
    }
}

/// The condition with that identifier.
fn found<'a>(conditions: &'a [Condition], id: &str) -> &'a Condition {
    conditions.iter().find(|c| c.id == id).unwrap_or_else(|| panic!("no condition {id}"))
}

/// The conditions of the proportional-integral observer of one order.
fn asked(system: &DescriptorSystem, order: Order) -> Vec<Condition> {
    let choice = choice(Method::ProportionalIntegral, order);
    conditions(&system.clone().into(), &choice, &Tolerance::default()).unwrap()
}

fn verdict(system: &DescriptorSystem, order: Order, id: &str) -> Verdict {
    found(&asked(system, order), id).verdict
}

/// The rank evidence of a condition.
fn ranks(condition: &Condition) -> Vec<(&RankDecision, usize)> {
    let rank = |e| match e {
        &Evidence::Rank { ref decision, required, .. } => Some((decision, required)),
        Evidence::Points { .. } | Evidence::Sets { .. } => None,
    };
    condition.evidence.iter().filter_map(rank).collect()
}

fn plain(e: DMatrix<f64>, a: DMatrix<f64>, n: DMatrix<f64>, c: DMatrix<f64>) -> DescriptorSystem {
    let (rows, outputs, unknown) = (e.nrows(), c.nrows(), n.ncols());
    DescriptorSystem {
        time: TimeDomain::Continuous,
        E: e,
        A: a,
        B: DMatrix::zeros(rows, 0),
        C: c,
        D: n,
        F: DMatrix::zeros(outputs, unknown),
    }
    .checked()
    .unwrap()
}

fn designed(system: &DescriptorSystem, order: Order, poles: &[f64]) -> Assessment {
    let poles = poles.iter().copied().map(Complex64::from).collect();
    let choice = DesignChoice { order, poles, ..DesignChoice::default() };
    assess(&system.clone().into(), &choice, &Tolerance::default(), &Watch::none()).unwrap()
}

fn figure(id: &str) -> FigureSpec {
    let document = document();
    let model = document.model().unwrap();
    let scenario = document.scenario(&model.system);
    let problem = Problem {
        model: &model,
        design: &document.design,
        scenario: &scenario,
        tolerance: &document.tolerance,
    };
    let recipe = document.figures.iter().find(|recipe| recipe.id == id).unwrap();
    compute_figure(&problem, recipe, &Watch::none()).unwrap()
}

#[test]
fn the_conditions_carry_the_reference_numbers() {
    let reference = &reference()["conditions"];
    let conditions = asked(&system(), Order::Reduced);
    let number = |condition: &str, key: &str| reference[condition][key].as_f64().unwrap();
    let eight = ranks(found(&conditions, "004-8")).iter().map(|(d, _)| d.rank as f64).collect::<Vec<_>>();
    assert_eq!(eight, [number("c8", "rankEN"), number("c8", "rankE"), number("c8", "rankEC")], "(8)");
    let nine = ranks(found(&conditions, "004-9"));
    assert_eq!(nine[1].0.rank as f64, number("c9", "rank"), "(9), the printed matrix");
    assert_eq!(nine[1].1 as f64, number("c9", "required"), "(9), n + rank E*");
    assert!((nine[0].0.smallest() - number("c9", "compressed_smin")).abs() < 1e-12, "(9), compressed");
    let ten = ranks(found(&conditions, "004-10"));
    assert_eq!(
        (ten[0].0.rank as f64, ten[0].1 as f64),
        (number("c10", "rank_at_0"), number("c10", "required")),
        "(10)"
    );
    assert!((ten[0].0.smallest() - number("c10", "smin_at_0")).abs() < 1e-12, "(10) at s = 0");
}

#[test]
fn the_estimate_follows_the_unknown_input_as_the_reference_says() {
    let reference = &reference()["reduced_fhat_over_f_at_4_abs_deg"];
    let s = Complex64::new(0.0, 4.0);
    for scale in [0.1, 1.0, 2.0, 10.0, 100.0] {
        let [size, degrees]: [f64; 2] = serde_json::from_value(reference[scale.to_string()].clone()).unwrap();
        let expected = Complex64::from_polar(size, degrees.to_radians());
        let choice = DesignChoice { scale, ..choice(Method::ProportionalIntegral, Order::Reduced) };
        let assessment = assess(&system().into(), &choice, &Tolerance::default(), &Watch::none()).unwrap();
        assert!(assessment.verified(), "{scale} Lambda");
        let observer = &assessment.outcome.as_ref().unwrap().observer;
        let joint = unknown_input_response(s, &system(), observer).unwrap().d_hat[(0, 0)];
        assert!((joint - expected).norm() < 1e-6, "{scale} Lambda, joint: {joint} instead of {expected}");
        // f_hat/f = I - s [0 I] (s I - A_obs)^-1 [0; I]
        let pencil = DMatrix::<Complex64>::identity(3, 3) * s - observer.N.map(Complex64::from);
        let formula = Complex64::ONE - s * pencil.try_inverse().unwrap()[(2, 2)];
        assert!(
            (formula - expected).norm() < 1e-6,
            "{scale} Lambda, formula: {formula} instead of {expected}"
        );
    }
}

#[test]
fn figure_8_of_the_reduced_order_is_the_reference_s() {
    let reference = &reference()["reduced_bode_xhat1_over_fhat_w_dB_deg"];
    let figure = figure("fig8-reduced");
    for scale in ["1", "10", "100"] {
        let rows: Vec<[f64; 3]> = serde_json::from_value(reference[scale].clone()).unwrap();
        for [omega, decibels, degrees] in rows {
            for (panel, expected, limit) in [(0, decibels, 0.02), (1, degrees, 0.2)] {
                let name = format!("{scale} Lambda");
                let series = figure.panels[panel].series.iter().find(|s| s.name == name).unwrap();
                let after = series.points.partition_point(|p| p[0] < omega).clamp(1, series.points.len() - 1);
                let [[a, low], [b, high]] = [series.points[after - 1], series.points[after]];
                let value = low + (high - low) * (omega / a).ln() / (b / a).ln();
                assert!((value - expected).abs() < limit, "{name} at {omega}: {value} instead of {expected}");
            }
        }
    }
}

/// Errors of an observer in the document's scenario, with another unknown input if wanted.
fn errors(method: Method, order: Order, unknown: Option<&str>) -> (Trajectory, Vec<f64>) {
    let document = document();
    let system = system();
    let mut scenario = document.scenario(&system);
    if let Some(text) = unknown {
        scenario.d = vec![Signal::parse(text).unwrap()];
    }
    let design = assessed(method, order).outcome.unwrap();
    let trajectory = scenario.run_linear(&system, &[&design.observer], &document.tolerance).unwrap();
    let rms = trajectory.rms(&trajectory.observers[0].e, 1.0);
    (trajectory, rms)
}

#[test]
fn the_integral_loop_makes_the_errors_several_times_smaller() {
    for (unknown, least) in [(Some("0"), 2.5), (None, 7.0)] {
        let (_, proportional) = errors(Method::Proportional, Order::Full, unknown);
        for order in [Order::Full, Order::Reduced] {
            let (_, integral) = errors(Method::ProportionalIntegral, order, unknown);
            for i in [0, 2, 3] {
                assert!(
                    proportional[i] > least * integral[i],
                    "x{} ({order:?}, f = {unknown:?}): P {:.4}, PI {:.4}",
                    i + 1,
                    proportional[i],
                    integral[i]
                );
            }
        }
    }
    let (_, proportional) = errors(Method::Proportional, Order::Full, None);
    assert!((0.3..0.6).contains(&proportional[0]), "case 2, P: {proportional:?}");
}

#[test]
fn a_slow_observer_estimates_the_mean_of_the_unknown_input() {
    let figure = figure("fig9");
    let estimate = figure.panels[0].series.last().unwrap();
    let late: Vec<f64> = estimate.points.iter().filter(|p| p[0] >= 8.0).map(|p| p[1]).collect();
    let mean = late.iter().sum::<f64>() / late.len() as f64;
    assert!((mean - 5.1).abs() < 0.2, "f = 5 + 2 sin 4t has the mean 5, found {mean}");
    let swing = late.iter().map(|x| (x - mean).abs()).fold(0.0, f64::max);
    assert!(swing < 1.5, "the oscillation of 2 is suppressed to {swing}");
}

#[test]
fn the_printed_observer_with_l2_y_hat_is_unstable() {
    // z' = T1 A z + T1 N f_hat + ..., f_hat' = -L3 C z: what is left when L2 multiplies y_hat
    let system = system();
    let equations = |m: &DMatrix<f64>| m.rows(0, 2).into_owned();
    let outputs = DMatrix::from_fn(3, 4, |i, j| if i < 2 { system.A[(i + 2, j)] } else { system.C[(0, j)] });
    let full = assessed(Method::ProportionalIntegral, Order::Full).outcome.unwrap();
    let (t1, l3) = (full.matrix("T1").unwrap(), full.matrix("L3").unwrap());
    let mut printed = DMatrix::zeros(5, 5);
    printed.view_mut((0, 0), (4, 4)).copy_from(&(t1 * equations(&system.A)));
    printed.view_mut((0, 4), (4, 1)).copy_from(&(t1 * equations(&system.D)));
    printed.view_mut((4, 0), (1, 4)).copy_from(&-(l3 * outputs));
    let worst = eigenvalues(&printed).unwrap().iter().map(|z| z.re).fold(f64::MIN, f64::max);
    assert!(worst > 1.0, "full order: largest real part {worst}");

    let reduced = assessed(Method::ProportionalIntegral, Order::Reduced).outcome.unwrap();
    let (ar, lb3, cr) =
        (reduced.matrix("Ar").unwrap(), reduced.matrix("Lb3").unwrap(), reduced.matrix("Cr").unwrap());
    let mut printed = DMatrix::zeros(3, 3);
    printed.view_mut((0, 0), (2, 2)).copy_from(ar);
    printed[(0, 2)] = 1.0;
    printed.view_mut((2, 0), (1, 2)).copy_from(&-(lb3 * cr));
    let expected = [Complex64::from(-22.1), Complex64::new(10.5, 18.8), Complex64::new(10.5, -18.8)];
    let distance = spectral_distance(&eigenvalues(&printed).unwrap(), &expected);
    assert!(distance < 0.1, "reduced order: -22.1, 10.5 +- 18.8i as in the errata, off by {distance}");
}

#[test]
fn the_third_alternative_of_8_may_leave_unstable_modes_that_the_general_form_moves() {
    let system = plain(
        dmatrix![1.0, 0.0; 0.0, 0.0],
        dmatrix![1.0, 0.0; 1.0, 1.0],
        dmatrix![0.0; 1.0],
        dmatrix![0.0, 1.0],
    );
    let conditions = asked(&system, Order::Full);
    for id in ["004-8", "004-9", "004-10"] {
        assert!(found(&conditions, id).verdict.holds(), "{id}: {}", found(&conditions, id).summary);
    }
    let thirteen = found(&conditions, "004-13");
    assert_eq!(thirteen.verdict, Verdict::Fails, "{}", thirteen.summary);
    let Some(Evidence::Points { points, .. }) = thirteen.evidence.first() else { panic!("{thirteen:?}") };
    let hidden: Vec<Complex64> = points.iter().filter(|p| p.loses_rank).map(|p| p.s).collect();
    assert!(spectral_distance(&hidden, &[1.0, 0.0].map(Complex64::from)) < 1e-9, "1 and 0: {hidden:?}");
    let refused = designed(&system, Order::Full, &[-2.0, -3.0, -4.0]);
    assert!(
        matches!(&refused.outcome, Err(DesignError::Condition { id, .. }) if id == "004-13"),
        "{:?}",
        refused.outcome
    );
    let general = designed(&system, Order::General, &[-2.0, -3.0, -4.0]);
    assert!(general.verified(), "{:#?}", general.outcome);
}

#[test]
fn condition_12_without_11_is_not_enough() {
    let system = plain(
        dmatrix![1.0, 0.0, 0.0; 0.0, 1.0, 0.0],
        dmatrix![0.0, 0.0, 1.0; 0.0, 0.0, 0.0],
        dmatrix![0.0; 1.0],
        dmatrix![1.0, 0.0, 0.0; 0.0, 1.0, 0.0],
    );
    let conditions = asked(&system, Order::Reduced);
    assert_eq!(
        found(&conditions, "004-10").verdict,
        Verdict::Holds,
        "{}",
        found(&conditions, "004-10").summary
    );
    for id in ["004-9", "004-11", "004-22"] {
        assert_eq!(found(&conditions, id).verdict, Verdict::Fails, "{id}");
    }
    let (decision, required) = ranks(found(&conditions, "004-11"))[0];
    assert_eq!((decision.rank, required), (2, 3), "rank [E; C] = 2 < 3");
    assert!(designed(&system, Order::Reduced, &[-1.0, -2.0, -3.0]).outcome.is_err(), "no observer");
}

#[test]
fn condition_8_fails_and_the_general_form_works() {
    let document = read_document(example("input-in-constraint").unwrap().text).unwrap();
    let system = document.system().unwrap();
    for order in [Order::Full, Order::Reduced] {
        let refused = assess(
            &system.clone().into(),
            &DesignChoice { order, ..document.design.clone() },
            &document.tolerance,
            &Watch::none(),
        )
        .unwrap();
        assert!(
            matches!(&refused.outcome, Err(DesignError::Condition { id, .. }) if id == "004-8"),
            "{order:?}: {:?}",
            refused.outcome
        );
    }
    let general =
        assess(&system.clone().into(), &document.design, &document.tolerance, &Watch::none()).unwrap();
    assert!(general.verified(), "{:#?}", general.outcome);
}

/// The example with one entry changed.
fn with(change: impl Fn(&mut DescriptorSystem)) -> DescriptorSystem {
    let mut system = system();
    change(&mut system);
    system
}

#[test]
fn condition_8_by_the_size_of_the_input_in_an_algebraic_equation() {
    for (size, expected) in
        [(1e-17, Verdict::Holds), (5e-15, Verdict::Fragile), (1e-12, Verdict::Fails), (0.5, Verdict::Fails)]
    {
        let system = with(|s| s.D[(3, 0)] = size);
        assert_eq!(verdict(&system, Order::Reduced, "004-8"), expected, "entry {size}");
    }
}

#[test]
fn condition_9_by_the_size_of_the_entry_that_shows_x3() {
    for (size, expected) in
        [(1.0, Verdict::Holds), (1e-6, Verdict::Holds), (1e-12, Verdict::Fragile), (0.0, Verdict::Fails)]
    {
        let conditions = asked(&with(|s| s.A[(3, 2)] = size), Order::Reduced);
        let nine = found(&conditions, "004-9");
        assert_eq!(nine.verdict, expected, "entry {size}: {}", nine.summary);
        if expected == Verdict::Fails {
            assert_eq!(nine.witness.as_ref().unwrap().main_coordinates(), ["x3"], "nobody sees x3");
            assert!(
                nine.remedies.iter().any(|remedy| remedy.starts_with("measure x3")),
                "{:?}",
                nine.remedies
            );
        }
    }
}

#[test]
fn condition_10_by_the_size_of_the_unknown_input() {
    for (size, expected) in
        [(1.0, Verdict::Holds), (1e-4, Verdict::Holds), (1e-7, Verdict::Fragile), (0.0, Verdict::Fails)]
    {
        let conditions = asked(&with(|s| s.D[(0, 0)] = size), Order::Reduced);
        let ten = found(&conditions, "004-10");
        assert_eq!(ten.verdict, expected, "entry {size}: {}", ten.summary);
        if expected == Verdict::Fails {
            let witness = ten.witness.as_ref().unwrap();
            assert_eq!(witness.main_coordinates(), ["d1"], "an input without effect");
            assert!(witness.s.unwrap().norm() < 1e-9, "a constant one");
        }
    }
}

#[test]
fn condition_11_by_the_size_of_the_entry_that_shows_x3() {
    for (size, expected) in [(1.0, Verdict::Holds), (1e-12, Verdict::Fragile), (0.0, Verdict::Fails)] {
        let system = plain(
            dmatrix![1.0, 0.0, 0.0; 0.0, 1.0, 0.0],
            dmatrix![0.0, 0.0, 1.0; 0.0, 0.0, 0.0],
            dmatrix![0.0; 1.0],
            dmatrix![1.0, 0.0, 0.0; 0.0, 1.0, size],
        );
        for id in ["004-11", "004-22"] {
            assert_eq!(verdict(&system, Order::Reduced, id), expected, "{id}, entry {size}");
        }
    }
}

/// `x1' = -x1 + f` is measured, `x2' = rate x2` only by the share `seen`.
fn hidden(rate: f64, seen: f64) -> DescriptorSystem {
    plain(
        DMatrix::identity(2, 2),
        dmatrix![-1.0, 0.0; 0.0, rate],
        dmatrix![1.0; 0.0],
        dmatrix![1.0, 0.0; 0.0, seen],
    )
}

#[test]
fn conditions_13_and_23_by_a_hidden_mode() {
    for (rate, seen, expected) in [
        (1.0, 1.0, Verdict::Holds),
        (1.0, 1e-7, Verdict::Fragile),
        (1.0, 0.0, Verdict::Fails),
        (0.5e-9, 0.0, Verdict::Fails),
        (-0.5e-9, 0.0, Verdict::Fails),
        (-5.0, 0.0, Verdict::Holds),
    ] {
        for (order, id) in [(Order::Full, "004-13"), (Order::Reduced, "004-23")] {
            assert_eq!(verdict(&hidden(rate, seen), order, id), expected, "{id}, rate {rate}, seen {seen}");
        }
    }
}

#[test]
fn fixed_modes_are_reported_and_need_no_pole() {
    for &order in Method::ProportionalIntegral.orders() {
        let found = designed(&hidden(-5.0, 0.0), order, &[-2.0, -3.0]);
        let design = found.outcome.as_ref().unwrap_or_else(|error| panic!("{order:?}: {error}"));
        assert!(found.verified(), "{order:?}: {:#?}", design.verification.checks);
        let fixed = &design.synthesis.placement().unwrap().fixed_modes;
        assert!(fixed.iter().any(|z| (z + 5.0).norm() < 1e-9), "{order:?}: {fixed:?}");
        assert!(design.notes.iter().any(|note| note.contains("-5")), "{order:?}: {:?}", design.notes);
    }
}

#[test]
fn pole_lists_that_do_not_fit_are_bad_input() {
    let short = designed(&system(), Order::Reduced, &[-1.0, -2.0]);
    assert_eq!(short.outcome, Err(DesignError::TooFewPoles { given: 2, needed: 3 }), "one is missing");
    assert!(short.outcome.unwrap_err().is_bad_input(), "the list is at fault, not the mathematics");
    let long = designed(&system(), Order::Reduced, &[-1.0, -2.0, -3.0, -4.0]);
    let notes = &long.outcome.as_ref().unwrap().notes;
    assert!(notes.iter().any(|note| note.contains("the first 3 of 4 poles")), "{notes:?}");
    let poles = vec![
        Complex64::from(-1.0),
        Complex64::from(-2.0),
        Complex64::new(-3.0, 1.0),
        Complex64::new(-3.0, -1.0),
    ];
    let cut = DesignChoice { poles, ..DesignChoice::default() };
    let cut =
        assess(&system().into(), &cut, &Tolerance::default(), &Watch::none()).unwrap().outcome.unwrap_err();
    assert!(matches!(cut, DesignError::Poles(_)) && cut.is_bad_input(), "half a pair: {cut}");
}

#[test]
fn an_unstable_plant_is_observed() {
    let system = with(|s| s.A[(0, 0)] = 3.0);
    for (order, count) in [(Order::Reduced, 3), (Order::Full, 5), (Order::General, 5)] {
        let poles: Vec<f64> = (0..count).map(|k| -4.0 - f64::from(k)).collect();
        let found = designed(&system, order, &poles);
        assert!(found.verified(), "{order:?}: {:#?}", found.outcome);
    }
}

#[test]
fn every_order_is_verified_in_discrete_time() {
    let document = read_document(example("discrete").unwrap().text).unwrap();
    let system = document.system().unwrap();
    for &order in Method::ProportionalIntegral.orders() {
        let choice = DesignChoice { order, ..document.design.clone() };
        let found = assess(&system.clone().into(), &choice, &document.tolerance, &Watch::none()).unwrap();
        assert!(found.verified(), "{order:?}: {:#?}", found.outcome);
    }
    let unstable = DescriptorSystem { A: &system.A * 1.5, ..system };
    let found =
        assess(&unstable.clone().into(), &document.design, &document.tolerance, &Watch::none()).unwrap();
    assert!(found.verified(), "unstable: {:#?}", found.outcome);
}

/// (13) and (23) speak of matrices that (11) and (22) must give first.
#[test]
fn what_builds_on_a_failing_condition_is_undecided() {
    let blind = with(|s| s.C = DMatrix::zeros(1, 4));
    let system = DescriptorSystem { A: DMatrix::zeros(4, 4), ..blind };
    for (order, first, second) in [(Order::Full, "004-11", "004-13"), (Order::Reduced, "004-22", "004-23")] {
        assert_eq!(verdict(&system, order, first), Verdict::Fails, "{first}: nothing is measured");
        assert_eq!(verdict(&system, order, second), Verdict::Undecided, "{second} builds on {first}");
    }
}

/// Rows of E mixed by an invertible matrix: no zero row is left, the system is the same.
#[test]
fn mixed_rows_change_no_verdict() {
    let mix = nalgebra::dmatrix![
        1.0, 0.3, -0.7, 0.2;
        -0.4, 1.1, 0.6, 0.9;
        0.8, -0.5, 1.3, -0.2;
        0.1, 0.7, -0.6, 0.9;
    ];
    let DescriptorSystem { E, A, B, C, D, F, time } = system();
    let mixed = DescriptorSystem { E: &mix * E, A: &mix * A, B: &mix * B, C, D: &mix * D, F, time };
    for method in [Method::Proportional, Method::ProportionalIntegral] {
        for &order in method.orders() {
            let found =
                assess(&mixed.clone().into(), &choice(method, order), &Tolerance::default(), &Watch::none())
                    .unwrap();
            assert!(found.verified(), "{method:?} {order:?}: {:#?}", found.outcome);
        }
    }
}

/// A circuit in farad and ohm: where rounding decides, the report says what to do.
#[test]
fn entries_of_many_decades_are_met_with_advice() {
    let (c, r) = (1e-9, 1e4);
    let E = DMatrix::from_diagonal(&nalgebra::dvector![c, c, 0.0]);
    let A = nalgebra::dmatrix![0.0, 0.0, -1.0; 0.0, -1.0 / r, 1.0; 1.0, -1.0, -r];
    let mut circuit = DescriptorSystem::autonomous(E, A, nalgebra::dmatrix![0.0, 1.0, 0.0]).unwrap();
    circuit.D = nalgebra::dmatrix![1.0; 0.0; 0.0];
    circuit.F = DMatrix::zeros(1, 1);
    let found = descry::observer::conditions(
        &circuit.clone().into(),
        &choice(Method::ProportionalIntegral, Order::Full),
        &Tolerance::default(),
    )
    .unwrap();
    let doubtful: Vec<_> = found.iter().filter(|c| c.verdict != Verdict::Holds).collect();
    assert!(!doubtful.is_empty(), "nano and kilo in one matrix are not decided without a word");
    for condition in doubtful {
        assert!(
            condition.remedies.iter().any(|r| r.contains("units")),
            "{}: {:?}",
            condition.label,
            condition.remedies
        );
    }
}

/// A check that cannot fail proves nothing: every matrix of a design, changed a little, must be found out.
#[test]
fn verification_finds_a_small_change_of_any_matrix() {
    let system = system();
    let found = assessed(Method::ProportionalIntegral, Order::Full);
    let design = found.outcome.unwrap();
    let expected: Vec<Complex64> = design.synthesis.placement().unwrap().requested.clone();
    let own = design.claim.clone().unwrap();
    let verdict = |observer: &descry::observer::LinearObserver, claim: &descry::observer::Claim| {
        descry::observer::verify(&system, observer, claim, &expected, &Tolerance::default())
            .unwrap()
            .verified()
    };
    assert!(verdict(&design.observer, &own), "the design itself is verified");
    let spoilt = |matrix: &DMatrix<f64>| {
        let mut spoilt = matrix.clone();
        spoilt[(0, 0)] += 1e-3 * (1.0 + matrix.amax());
        spoilt
    };
    let o = &design.observer;
    type Change = fn(&mut descry::observer::LinearObserver) -> &mut DMatrix<f64>;
    let changes: [(&str, Change); 9] = [
        ("N", |o| &mut o.N),
        ("L", |o| &mut o.L),
        ("H", |o| &mut o.H),
        ("P", |o| &mut o.P),
        ("V", |o| &mut o.V),
        ("W", |o| &mut o.W),
        ("Q", |o| &mut o.Q),
        ("R", |o| &mut o.R),
        ("S", |o| &mut o.S),
    ];
    for (name, change) in changes {
        let mut observer = o.clone();
        let matrix = change(&mut observer);
        *matrix = spoilt(matrix);
        assert!(!verdict(&observer, &own), "a wrong {name} goes unnoticed");
    }
    for (name, part) in [("T", &own.T), ("G", &own.G)] {
        let mut claim = own.clone();
        let wrong = spoilt(part);
        if name == "T" {
            claim.T = wrong;
        } else {
            claim.G = wrong;
        }
        assert!(!verdict(o, &claim), "a wrong {name} goes unnoticed");
    }
}
