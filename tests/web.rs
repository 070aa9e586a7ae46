//! The same numbers in a browser as natively: each of these tests runs in both.
#![expect(clippy::unwrap_used, clippy::panic, reason = "helpers of tests fail by panicking")]

use descry::document::{Document, read_document};
use descry::numerics::{Complex64, Watch, spectral_distance};
use descry::observer::{DesignChoice, Order, assess};
use descry::paper::example;
use descry::platform::message::{FromWorker, decode, encode};
use descry::platform::{Runner, runner};
use descry::session::{JobReply, JobRequest, Outcome, Task, perform};
use descry::system::Signal;
use nalgebra::{DMatrix, DVector};
use serde_json::Value;

#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test;

#[cfg(target_arch = "wasm32")]
wasm_bindgen_test::wasm_bindgen_test_configure!(run_in_browser);

fn reference() -> Value {
    serde_json::from_str(include_str!("reference/ex004.json")).unwrap()
}

fn matrix(value: &Value) -> DMatrix<f64> {
    let rows: Vec<Vec<f64>> = serde_json::from_value(value.clone()).unwrap();
    DMatrix::from_row_iterator(rows.len(), rows[0].len(), rows.into_iter().flatten())
}

fn vector(value: &Value) -> DVector<f64> {
    DVector::from_vec(serde_json::from_value(value.clone()).unwrap())
}

fn poles(value: &Value) -> Vec<Complex64> {
    let pairs: Vec<[f64; 2]> = serde_json::from_value(value.clone()).unwrap();
    pairs.into_iter().map(|[re, im]| Complex64::new(re, im)).collect()
}

fn text() -> &'static str {
    example("proportional-integral").unwrap().text
}

fn document() -> Document {
    read_document(text()).unwrap()
}

fn request() -> JobRequest {
    JobRequest { id: 1, revision: 1, document: text().to_owned(), task: Task::Analyse }
}

fn assessed(order: Order) -> descry::observer::Assessment {
    let document = document();
    let choice = DesignChoice { order, ..document.design.clone() };
    assess(&document.system().unwrap().into(), &choice, &document.tolerance, &Watch::none()).unwrap()
}

#[cfg_attr(target_arch = "wasm32", wasm_bindgen_test)]
#[cfg_attr(not(target_arch = "wasm32"), test)]
fn reduced_order_has_the_unique_gains_of_the_reference() {
    let reference = &reference()["reduced"]["reference"];
    let found = assessed(Order::Reduced);
    assert!(found.verified(), "verified: {:?}", found.outcome);
    let design = found.outcome.unwrap();
    for name in ["Ar", "F", "L1", "L2", "L3", "J", "M1", "T2"] {
        let (found, expected) = (design.matrix(name).unwrap(), matrix(&reference[name]));
        let error = (found - &expected).norm() / expected.norm().max(1.0);
        assert!(error <= 1e-9, "{name}: relative difference {error:.2e}");
    }
}

#[cfg_attr(target_arch = "wasm32", wasm_bindgen_test)]
#[cfg_attr(not(target_arch = "wasm32"), test)]
fn full_order_has_the_spectrum_of_the_reference() {
    let found = assessed(Order::Full);
    assert!(found.verified(), "verified: {:?}", found.outcome);
    let expected = poles(&reference()["full"]["unique"]["eig_Aobs"]);
    let distance = spectral_distance(&found.outcome.unwrap().verification.spectrum, &expected);
    assert!(distance < 1e-7 * 33.0, "spectrum off by {distance:.2e}");
}

#[cfg_attr(target_arch = "wasm32", wasm_bindgen_test)]
#[cfg_attr(not(target_arch = "wasm32"), test)]
fn the_simulated_example_is_the_one_of_the_reference() {
    let mut document = document();
    document.scenario.uncertainty = None;
    let system = document.system().unwrap();
    let design = assessed(Order::Reduced).outcome.unwrap();
    let run =
        document.scenario(&system).run_linear(&system, &[&design.observer], &document.tolerance).unwrap();
    let rows = reference()["simulation"]["reduced_nominal"].clone();
    for row in rows.as_array().unwrap() {
        let t = row["t"].as_f64().unwrap();
        let at = run.t.iter().position(|s| (s - t).abs() < 1e-9).unwrap();
        for (what, found, expected) in [
            ("x", run.x.column(at), vector(&row["x"])),
            ("x_hat", run.observers[0].x_hat.column(at), vector(&row["xhat"])),
            ("d_hat", run.observers[0].d_hat.column(at), vector(&row["fhat"])),
        ] {
            let error = (found - expected).amax();
            assert!(error < 1e-6, "{what} at {t}: off by {error:.1e}");
        }
    }
}

#[cfg_attr(target_arch = "wasm32", wasm_bindgen_test)]
#[cfg_attr(not(target_arch = "wasm32"), test)]
fn signals_have_the_pinned_values() {
    // bits where only sums and products are made, a relative error where the machine's sine comes in
    for (text, t, expected, exact) in [
        ("1/3 + t*t - 2*t", 0.7, -0.576_666_666_666_666_7, true),
        ("step(t-1)*t + max(t, 2)^3", 1.5, 9.5, true),
        ("5+2*sin(4*t)", 5.0, 6.825_890_501_455_255, false),
        ("exp(-t)*cos(2*pi*t)", 0.3, -0.228_925_419_933_260_9, false),
        ("noise(t, 1)", 12.345, NOISE[0], true),
        ("0.02*noise(t/0.02, 2)", 3.21, NOISE[1], true),
    ] {
        let value = Signal::parse(text).unwrap().value(t);
        let error = (value - expected).abs();
        let limit = if exact { 0.0 } else { 1e-14 * expected.abs().max(1e-3) };
        assert!(error <= limit, "{text} at {t}: {value:?} instead of {expected:?}");
    }
}

const NOISE: [f64; 2] = [1.384_991_694_751_739_6, -0.023_116_324_549_388_122];

#[cfg_attr(target_arch = "wasm32", wasm_bindgen_test)]
#[cfg_attr(not(target_arch = "wasm32"), test)]
fn an_analysis_passes_through_the_messages() {
    let reply = perform(&request(), &Watch::none()).unwrap();
    let bytes = encode(&FromWorker::Reply { reply, elapsed_ms: Some(1.0) }).unwrap();
    let back: FromWorker = decode(&bytes).unwrap();
    assert_eq!(encode(&back).unwrap(), bytes, "the same bytes again");
}

fn is_verified(reply: JobReply) -> bool {
    match reply.outcome {
        Outcome::Analysis(analysis) => analysis.verified() && analysis.simulation.is_ok(),
        other => panic!("no analysis: {other:?}"),
    }
}

fn last(runner: &mut dyn Runner) -> Option<JobReply> {
    std::iter::from_fn(|| runner.poll()).find(|reply| !matches!(reply.outcome, Outcome::Progress { .. }))
}

#[cfg(not(target_arch = "wasm32"))]
#[test]
fn the_runner_of_the_platform_gives_a_verified_analysis() {
    let mut runner = runner(|| {});
    runner.start(request());
    for _ in 0..3000 {
        if let Some(reply) = last(runner.as_mut()) {
            assert!(is_verified(reply), "it is verified");
            return;
        }
        std::thread::sleep(std::time::Duration::from_millis(10));
    }
    panic!("no reply");
}

/// The page of these tests has no file for a worker: the runner computes on the page, after it has tried.
#[cfg(target_arch = "wasm32")]
#[wasm_bindgen_test]
async fn the_runner_of_the_platform_gives_a_verified_analysis() {
    let mut runner = runner(|| {});
    runner.start(request());
    for _ in 0..300 {
        if let Some(reply) = last(runner.as_mut()) {
            assert!(is_verified(reply), "it is verified");
            assert!(runner.elapsed_ms().is_some_and(|ms| ms > 0.0), "its duration is known");
            let note = runner.note().unwrap();
            assert!(note.contains("no worker"), "it says why the page stands still: {note}");
            return;
        }
        pause(50).await;
    }
    panic!("no reply");
}

#[cfg(target_arch = "wasm32")]
async fn pause(milliseconds: i32) {
    let promise = js_sys::Promise::new(&mut |resolve, _| {
        let window = web_sys::window().unwrap();
        window.set_timeout_with_callback_and_timeout_and_arguments_0(&resolve, milliseconds).unwrap();
    });
    wasm_bindgen_futures::JsFuture::from(promise).await.unwrap();
}

#[cfg_attr(
    not(target_arch = "wasm32"),
    expect(
        clippy::disallowed_methods,
        reason = "natively web_time's clock is the one of the standard library"
    )
)]
fn now() -> web_time::Instant {
    web_time::Instant::now()
}

/// Median time of an analysis of the example in milliseconds.
fn median_ms(uncertainty: f64) -> f64 {
    let mut document = document();
    if let Some(data) = &mut document.scenario.uncertainty {
        data.scale = uncertainty;
    }
    let request = JobRequest { document: descry::document::write_document_compact(&document), ..request() };
    let mut times: Vec<f64> = (0..20)
        .map(|_| {
            let start = now();
            assert!(perform(&request, &Watch::none()).is_some(), "it comes to its end");
            start.elapsed().as_secs_f64() * 1e3
        })
        .collect();
    times.sort_by(f64::total_cmp);
    times[times.len() / 2]
}

#[cfg_attr(target_arch = "wasm32", wasm_bindgen_test)]
#[cfg_attr(not(target_arch = "wasm32"), test)]
fn an_analysis_takes_no_longer_than_a_person_notices() {
    let (nominal, uncertain) = (median_ms(0.0), median_ms(1.0));
    let text = format!(
        "conditions, design and 6 s of simulation: {nominal:.1} ms, with uncertainty {uncertain:.1} ms (median of 20)"
    );
    #[cfg(target_arch = "wasm32")]
    wasm_bindgen_test::console_log!("{text}");
    #[cfg(not(target_arch = "wasm32"))]
    println!("{text}");
    // a generous bound, for debug builds on busy machines; release builds are measured by hand
    assert!(nominal < 2000.0 && uncertain < 4000.0, "{text}");
}
