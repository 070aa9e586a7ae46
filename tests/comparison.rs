//! Designs side by side: every number of the table by a second way.
#![cfg(not(target_arch = "wasm32"))]
#![expect(clippy::unwrap_used, clippy::panic, reason = "helpers of tests fail by panicking")]

use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};

use descry::document::comparison::{comparison_table, comparison_to_csv, comparison_to_markdown};
use descry::document::{Document, read_document};
use descry::numerics::{Complex64, Watch, complex_svd};
use descry::observer::{Design, DesignError, ErrorGain, Method, assess, unknown_input_response};
use descry::paper::{Role, comparison as figures, example};
use descry::simulation::Memo;
use descry::simulation::comparison::{Compared, ComparedDesign, Contender, compare, compare_with};
use descry::system::Model;
use nalgebra::DMatrix;
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

fn largest(matrix: &DMatrix<Complex64>) -> f64 {
    complex_svd(matrix).unwrap().s.first().copied().unwrap_or(0.0)
}

fn reference() -> Value {
    serde_json::from_str(include_str!("reference/comparison.json")).unwrap()
}

/// The four norms of a row by the names of the reference.
fn norms(row: &ComparedDesign) -> [(&'static str, &ErrorGain); 4] {
    let gains = &row.gains;
    [
        ("d to e", &gains.d_to_e),
        ("d to e_d", &gains.d_to_e_d),
        ("noise to e", &gains.w_to_e),
        ("noise to e_d", &gains.w_to_e_d),
    ]
}

#[test]
fn every_design_of_the_example_exists_and_is_verified() {
    let found = compared(&document());
    let names: Vec<&str> = found.comparison.rows.iter().map(|row| row.name.as_str()).collect();
    assert_eq!(names, ["chosen", "proportional", "PI, full", "PI, general", "H-infinity"]);
    for row in &found.comparison.rows {
        let design = row.outcome.as_ref().unwrap();
        assert!(design.verified && design.scenario.is_ok(), "{}: {design:?}", row.name);
    }
    assert_eq!(found.runs.len(), 5, "all of them run");
    let first = &found.runs[0].motion.as_ref().unwrap().trajectory;
    let shared =
        found.runs.iter().all(|run| std::sync::Arc::ptr_eq(first, &run.motion.as_ref().unwrap().trajectory));
    assert!(shared, "beside one and the same plant");
    assert_eq!(found.comparison.notes, Vec::<String>::new(), "nothing to remark");
}

/// Norms against SLICOT's AB13DD, which was given the joint system of plant and observer.
fn against_slicot(found: &Compared, reference: &Value) {
    for compared in &found.comparison.rows {
        for (name, gain) in norms(row(found, &compared.name)) {
            let expected = &reference[&compared.name][name];
            let title = format!("{}, {name}", compared.name);
            let norm = match gain {
                ErrorGain::Norm(norm) => norm,
                ErrorGain::Decoupled => {
                    assert!(
                        expected[0].as_f64().unwrap() < 1e-13,
                        "{title}: decoupled instead of {expected}"
                    );
                    continue;
                }
                other => {
                    // the reference leaves out what a design does not estimate, and nothing else
                    assert_eq!(other, &ErrorGain::NotEstimated, "{title}: no norm instead of {expected}");
                    assert!(expected.is_null() && name.ends_with("e_d"), "{title}: {expected} is missing");
                    continue;
                }
            };
            let expected_norm = expected[0].as_f64().unwrap();
            // matrix inequalities have many solutions; poles of several outputs are placed to eight digits
            let limit = if compared.method.uses_lmi() { 1e-3 } else { 1e-7 };
            let off = (norm.norm - expected_norm).abs() / expected_norm;
            assert!(off < limit, "{title}: {} instead of {expected_norm}", norm.norm);
            match expected[1].as_f64() {
                Some(at) => assert!((norm.frequency - at).abs() < 1e-3 * (1.0 + at), "{title}: at {at}"),
                // an error that does not roll off: its peak may be seen at any high frequency
                None => assert!(norm.frequency > 1e3 || off < 1e-9, "{title}: at infinity"),
            }
        }
    }
}

#[test]
fn norms_are_those_of_slicot_in_continuous_time() {
    against_slicot(&compared(&document()), &reference()["continuous"]);
}

#[test]
fn norms_are_those_of_slicot_in_discrete_time() {
    let reference = reference();
    let document = read_document(&reference["discrete"]["document"].to_string()).unwrap();
    against_slicot(&compared(&document), &reference["discrete"]["norms"]);
}

#[test]
fn no_frequency_of_a_dense_grid_exceeds_a_norm_and_one_reaches_it() {
    let document = document();
    let system = document.system().unwrap();
    let found = compared(&document);
    for contender in document.contenders() {
        let design = design(&document, &contender);
        let row = row(&found, contender.name);
        let (mut of_e, mut of_d) = (0.0_f64, 0.0_f64);
        for k in 0..=4000 {
            let s = Complex64::new(0.0, 10_f64.powf(-4.0 + 9.0 * f64::from(k) / 4000.0));
            let joint = unknown_input_response(s, &system, &design.observer).unwrap();
            of_e = of_e.max(largest(&(&joint.x_hat - &joint.x)));
            if joint.d_hat.nrows() > 0 {
                of_d = of_d.max(largest(&(&joint.d_hat - DMatrix::identity(1, 1))));
            }
        }
        for (grid, gain) in [(of_e, &row.gains.d_to_e), (of_d, &row.gains.d_to_e_d)] {
            match gain {
                ErrorGain::Norm(norm) => {
                    assert!(
                        grid <= norm.norm * (1.0 + 1e-9),
                        "{}: {grid} above {}",
                        contender.name,
                        norm.norm
                    );
                    assert!(
                        grid >= norm.norm * (1.0 - 1e-4),
                        "{}: {grid} below {}",
                        contender.name,
                        norm.norm
                    );
                }
                ErrorGain::Decoupled => assert!(grid < 1e-12, "{}: {grid} is not zero", contender.name),
                other => assert_eq!((other, grid), (&ErrorGain::NotEstimated, 0.0), "{}", contender.name),
            }
        }
    }
}

#[test]
fn errors_of_the_scenario_are_those_of_each_design_alone() {
    let document = document();
    let model = document.model().unwrap();
    let scenario = document.scenario(&model.system);
    let found = compared(&document);
    for contender in document.contenders() {
        let design = design(&document, &contender);
        let alone = scenario.run(&model, &[(&design).into()], &document.tolerance, &Watch::none()).unwrap();
        let errors = row(&found, contender.name).scenario.as_ref().unwrap();
        let e = &alone.observers[0].e;
        let count = e.ncols();
        let late = (0..count).filter(|k| alone.t[*k] >= 10.0);
        let of_late = late.clone().map(|k| e.column(k).norm_squared()).sum::<f64>();
        let expected = (of_late / late.clone().count() as f64).sqrt();
        let close = |found: f64, expected: f64| (found - expected).abs() <= 1e-9 * expected.max(1e-9);
        let all = errors.all_states.unwrap();
        assert!(close(all.late_rms, expected), "{}: {errors:?}", contender.name);
        let largest = late.map(|k| e.column(k).amax()).fold(0.0, f64::max);
        assert!(close(all.late_largest, largest), "{}: {largest}", contender.name);
        let whole = (e.norm_squared() / count as f64).sqrt();
        assert!(close(all.rms, whole), "{}: {whole}", contender.name);
        assert!(close(all.largest, e.amax()), "{}", contender.name);
        assert_eq!(errors.unknown.len(), alone.observers[0].d_hat.nrows(), "{}", contender.name);
        assert_eq!(errors.all_unknown.is_some(), !errors.unknown.is_empty(), "{}", contender.name);
    }
}

#[test]
fn the_example_teaches_what_it_says() {
    let found = compared(&document());
    let errors = |name: &str| row(&found, name).scenario.clone().unwrap();
    let [proportional, full, general, decoupled, attenuating] =
        ["proportional", "PI, full", "PI, general", "chosen", "H-infinity"].map(|name| row(&found, name));
    assert!(errors("proportional").all_states.unwrap().late_rms > 0.3, "an offset stays");
    assert!(errors("PI, general").all_states.unwrap().late_rms < 0.1, "the integral takes it away");
    assert!(
        errors("PI, full").all_states.unwrap().late_rms > errors("PI, general").all_states.unwrap().late_rms,
        "general: nearer"
    );
    assert_eq!(decoupled.gains.d_to_e, ErrorGain::Decoupled, "nothing of d in the error");
    let noise = |design: &ComparedDesign| design.gains.w_to_e.value().unwrap();
    for other in [proportional, full, general, decoupled] {
        assert!(noise(attenuating) < noise(other), "the H-infinity observer hears the least noise");
    }
    let noise_in_d = |design: &ComparedDesign| design.gains.w_to_e_d.value().unwrap();
    assert!(noise_in_d(decoupled) > noise_in_d(full), "decoupling is paid for with noise");
    let gamma = attenuating.guaranteed.unwrap();
    assert!(attenuating.gains.d_to_e.value().unwrap() <= gamma, "the guarantee holds");
    // why the paper's reduced order is missing
    let mut document = document();
    document.design.method = Method::ProportionalIntegral;
    document.design.order = descry::observer::Order::Reduced;
    let model = document.model().unwrap();
    let assessed = assess(&model, &document.design, &document.tolerance, &Watch::none()).unwrap();
    let error = assessed.outcome.unwrap_err();
    assert!(matches!(&error, DesignError::Condition { label, .. } if label == "(23)"), "{error}");
}

#[test]
fn a_design_that_does_not_exist_does_not_stop_the_others() {
    let mut document = document();
    document.kept[0].design.poles.clear();
    document.kept[1].design.order = descry::observer::Order::Reduced;
    document.kept[2].design.method = Method::Decentralized;
    let found = compared(&document);
    let errors: Vec<String> = found
        .comparison
        .rows
        .iter()
        .filter_map(|row| Some(row.outcome.as_ref().err()?.to_string()))
        .collect();
    assert_eq!(errors.len(), 3, "{errors:?}");
    assert!(errors[0].contains("0 poles are given, but this design places 2"), "{}", errors[0]);
    assert!(errors[1].contains("condition (23)"), "{}", errors[1]);
    assert!(errors[2].contains("partition the system"), "{}", errors[2]);
    assert!(row(&found, "chosen").verified && row(&found, "H-infinity").verified, "the others are there");
    let markdown = comparison_to_markdown(&found.comparison);
    assert!(markdown.contains("poles needed") && markdown.contains("not for this system"), "{markdown}");
    assert!(markdown.contains("\n- proportional: 0 poles are given"), "the reason stands below: {markdown}");
}

#[test]
fn an_observer_that_runs_away_spoils_only_itself() {
    let expected = compared(&document());
    let mut document = document();
    document.kept[0].design.poles = [9.0, 8.0].map(Complex64::from).into();
    let found = compared(&document);
    let (wild, tame) = (row(&found, "proportional"), row(&found, "PI, general"));
    assert!(!wild.verified, "poles in the right half plane");
    assert_eq!(wild.margin, Some(-9.0), "it does not decay");
    let notes = &found.comparison.notes;
    assert!(notes.len() == 1 && notes[0].starts_with("proportional: stopped before t = "), "{notes:?}");
    assert!(matches!(wild.gains.d_to_e, ErrorGain::NotFinite(_)), "no finite gain: {:?}", wild.gains);
    let of = |row: &ComparedDesign| row.scenario.as_ref().unwrap().all_states.unwrap().late_rms;
    let before = of(row(&expected, "PI, general"));
    assert!((of(tame) - before).abs() < 1e-9 * before, "the same errors as without it");
    let table = comparison_table(&found.comparison);
    let decay = table.lines.iter().find(|line| line.label == "Decay").unwrap();
    assert!(!decay.cells[1].best && decay.cells[0].best, "no prize for an unstable observer: {decay:?}");
}

#[test]
fn stopping_the_watch_ends_the_comparison() {
    let document = document();
    let model = document.model().unwrap();
    let scenario = document.scenario(&model.system);
    for stop in [0.0, 0.3, 0.85] {
        let watch = Watch::new(move |fraction, _| fraction < stop);
        let found = compare(&model, &scenario, &document.contenders(), &document.tolerance, &watch);
        assert!(found.is_none(), "stopped at {stop}");
    }
}

#[test]
fn the_figures_show_every_design_in_its_own_colour() {
    let document = document();
    let found = compared(&document);
    let figures = figures(&found, &document.system().unwrap());
    let states = figures.states.unwrap();
    assert_eq!(states.panels.len(), 3, "a panel for each state");
    let series = &states.panels[0].series;
    assert_eq!((series.len(), series[0].role), (6, Role::Truth), "the truth and five estimates");
    let mut colours: Vec<usize> = series.iter().map(|series| series.colour).collect();
    colours.sort_unstable();
    colours.dedup();
    assert_eq!(colours.len(), 6, "six colours");
    let unknown = figures.unknown_input.unwrap();
    let names: Vec<&str> = unknown.panels[0].series.iter().map(|series| series.name.as_str()).collect();
    assert_eq!(names, ["d1", "chosen", "PI, full", "PI, general"], "only those that estimate it");
    assert_eq!(figures.errors.unwrap().panels.len(), 4, "three states and the unknown input");
    let gains = figures.gains.unwrap();
    assert!(
        gains.caption.contains("Zero, hence not drawn: chosen: unknown input to error of x"),
        "{}",
        gains.caption
    );
    let peaks: Vec<f64> = gains.panels[0]
        .series
        .iter()
        .map(|series| series.points.iter().map(|[_, y]| *y).fold(f64::NEG_INFINITY, f64::max))
        .collect();
    let rows = ["proportional", "PI, full", "PI, general", "H-infinity"];
    for (peak, name) in peaks.iter().zip(rows) {
        let norm = 20.0 * row(&found, name).gains.d_to_e.value().unwrap().log10();
        assert!((peak - norm).abs() < 0.05, "{name}: the peak {peak} dB is the norm {norm} dB");
    }
}

#[test]
fn the_table_marks_the_best_and_keeps_three_digits() {
    let found = compared(&document());
    let table = comparison_table(&found.comparison);
    let line = |label: &str| table.lines.iter().find(|line| line.label == label).unwrap();
    let best = |label: &str| line(label).cells.iter().map(|cell| cell.best).collect::<Vec<_>>();
    assert_eq!(best("d to e"), [true, false, false, false, false], "decoupled");
    assert_eq!(best("noise to e"), [false, false, false, false, true], "H-infinity");
    assert_eq!(best("Slowest mode"), [false; 5], "no mode is better by itself");
    assert_eq!(line("d to e").cells[1].text, "0.827", "three digits");
    assert_eq!(line("d to e").cells[1].hint, "largest at frequency 0", "and where");
    assert_eq!(line("Status").cells[0].text, "verified");
    let csv = comparison_to_csv(&found.comparison);
    assert!(
        csv.starts_with("quantity,chosen,proportional,\"PI, full\",\"PI, general\",H-infinity\n"),
        "{csv}"
    );
    assert!(csv.contains("\nd to e,0,0.8268"), "numbers to the last digit: {csv}");
}

#[test]
fn the_figure_of_gains_shows_the_peaks_of_fast_and_unbalanced_designs() {
    let mut document = read_document(example("proportional-integral").unwrap().text).unwrap();
    document.design.scale = 10.0;
    let found = compared(&document);
    let row = row(&found, "chosen");
    let figures = figures(&found, &document.system().unwrap());
    let gains = figures.gains.unwrap();
    for (panel, (name, gain)) in gains.panels.iter().zip(norms(row)) {
        let ErrorGain::Norm(norm) = gain else { panic!("{name}: {gain:?}") };
        let [low, high] = panel.x.range.unwrap();
        let inside =
            norm.frequency == 0.0 || !norm.frequency.is_finite() || (low..=high).contains(&norm.frequency);
        assert!(inside, "{name}: the peak at {} is not within {low} and {high}", norm.frequency);
        let peak = panel.series[0].points.iter().map(|[_, y]| *y).fold(f64::NEG_INFINITY, f64::max);
        let expected = 20.0 * norm.norm.log10();
        assert!((peak - expected).abs() < 0.01, "{name}: {peak} dB instead of {expected} dB");
    }
}

#[test]
fn what_was_designed_before_is_designed_no_more_and_gives_the_same_table() {
    let document = document();
    let model = document.model().unwrap();
    let scenario = document.scenario(&model.system);
    let mut memo = Memo::new();
    let table = |memo: &mut Memo, document: &Document| {
        let designing = Arc::new(AtomicUsize::new(0));
        let counted = Arc::clone(&designing);
        // the solver of matrix inequalities reports what it does, and nobody else in between
        let watch = Watch::new(move |_, what| {
            counted.fetch_add(
                usize::from(!what.starts_with("designing") && !what.starts_with("gains")),
                Relaxed,
            );
            true
        });
        let contenders = document.contenders();
        let found =
            compare_with(memo, (&model, &scenario), &contenders, &document.tolerance, &watch).unwrap();
        (found.comparison, designing.load(Relaxed))
    };
    let (first, solving) = table(&mut memo, &document);
    let (again, solving_again) = table(&mut memo, &document);
    assert_eq!(first, again, "the same table");
    assert_eq!(first, table(&mut Memo::new(), &document).0, "as without a memory");
    assert!(solving_again < solving, "{solving_again} steps instead of {solving}");
    let mut changed = document.clone();
    changed.kept[3].design.lmi.decay = Some(0.31);
    let (other, solving_other) = table(&mut memo, &changed);
    assert_eq!(other.rows[..4], first.rows[..4], "the other designs are as before");
    assert!(
        other.rows[4] != first.rows[4] && solving_other > solving_again,
        "another demand, another design"
    );
    changed.tolerance.rank *= 2.0;
    assert_eq!(table(&mut memo, &changed).0, table(&mut Memo::new(), &changed).0, "another tolerance");
}
