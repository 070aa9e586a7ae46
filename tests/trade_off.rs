//! Sweeps of the bandwidth factor and of the demanded decay, against single designs and the joint transfer function.
#![expect(clippy::unwrap_used, reason = "helpers of tests fail by panicking")]

use descry::document::{Document, read_document};
use descry::numerics::{Complex64, Tolerance, Watch};
use descry::observer::{
    Design, DesignChoice, ErrorGain, LmiChoice, Method, Order, assess, unknown_input_response,
};
use descry::paper::{example, trade_off_figure};
use descry::simulation::{Sweep, TradeOff, TradeOffPoint, trade_off};
use descry::system::TimeDomain;

fn document(key: &str) -> Document {
    read_document(example(key).unwrap().text).unwrap()
}

fn swept(document: &Document, choice: &DesignChoice) -> TradeOff {
    let model = document.model().unwrap();
    trade_off(&model, choice, &Tolerance::default(), &Watch::none()).unwrap().unwrap()
}

fn designed(document: &Document, choice: &DesignChoice) -> Design {
    let model = document.model().unwrap();
    assess(&model, choice, &Tolerance::default(), &Watch::none()).unwrap().outcome.unwrap()
}

fn norm(gain: &ErrorGain) -> f64 {
    gain.value().unwrap()
}

fn grows(points: &[TradeOffPoint], what: &str, value: impl Fn(&TradeOffPoint) -> f64) {
    for pair in points.windows(2) {
        let (before, after) = (value(&pair[0]), value(&pair[1]));
        assert!(after > before * (1.0 - 1e-9), "{what} at {}: {before} then {after}", pair[1].at);
    }
}

#[test]
fn more_bandwidth_tracks_further_and_passes_more_noise() {
    let document = document("proportional-integral");
    let choice = DesignChoice { order: Order::Reduced, ..document.design.clone() };
    let found = swept(&document, &choice);
    assert_eq!(found.sweep, Sweep::Scale, "poles are scaled");
    assert!(found.points.len() >= 31 && found.notes.is_empty(), "{:?}", found.notes);
    grows(&found.points, "bandwidth", |point| point.bandwidth.unwrap());
    grows(&found.points, "slowest mode", |point| point.design.margin.unwrap());
    // below the plant's own speed the noise gain has a floor; above it grows without end
    let fast: Vec<TradeOffPoint> = found.points.iter().filter(|point| point.at >= 1.0).cloned().collect();
    grows(&fast, "noise to e", |point| norm(&point.design.gains.w_to_e));
    grows(&fast, "noise to e_d", |point| norm(&point.design.gains.w_to_e_d));
}

#[test]
fn a_point_of_the_sweep_is_the_design_of_its_factor() {
    let document = document("proportional-integral");
    let choice = DesignChoice { order: Order::Reduced, ..document.design.clone() };
    let found = swept(&document, &choice);
    let system = document.system().unwrap();
    for point in found.points.iter().step_by(7) {
        let alone = designed(&document, &DesignChoice { scale: point.at, ..choice.clone() });
        assert_eq!(point.design.spectrum, alone.verification.spectrum, "factor {}", point.at);
        // the edge of tracking, seen from outside: plant and observer together
        let omega = Complex64::new(0.0, point.bandwidth.unwrap());
        let response = unknown_input_response(omega, &system, &alone.observer).unwrap();
        let gain = (response.d_hat[(0, 0)] - 1.0).norm();
        assert!((gain - std::f64::consts::FRAC_1_SQRT_2).abs() < 1e-6, "-3 dB at {omega}: {gain}");
    }
}

#[test]
fn more_decay_costs_attenuation_until_nothing_is_feasible() {
    let document = document("h-infinity-lipschitz");
    let choice = DesignChoice { method: Method::HInfinity, order: Order::Reduced, ..document.design.clone() };
    let found = swept(&document, &choice);
    assert_eq!(found.sweep, Sweep::Decay, "the decay is demanded");
    assert!(found.points.len() >= 4, "several decays are feasible: {}", found.points.len());
    grows(&found.points, "guaranteed gamma", |point| point.design.guaranteed.unwrap());
    let [linear, note] = found.notes.as_slice() else { panic!("two notes: {:?}", found.notes) };
    assert!(linear.contains("norms are those of the error of the linear part"), "{linear}");
    assert!(note.contains("there is no design"), "the sweep says why it ends: {note}");
    let last = found.points.last().unwrap().at;
    let lmi = LmiChoice { decay: Some(last), ..choice.lmi.clone() };
    let alone = designed(&document, &DesignChoice { lmi, ..choice });
    let gamma = alone.synthesis.lmi()[0].gamma;
    assert_eq!(found.points.last().unwrap().design.guaranteed, gamma, "as designed alone");
}

#[test]
fn an_exactly_decoupled_input_costs_noise_alone() {
    let document = document("input-decoupled");
    let found = swept(&document, &document.design);
    assert!(
        found.points.iter().all(|point| point.design.gains.d_to_e_d == ErrorGain::Decoupled),
        "the unknown input never reaches the error"
    );
    assert!(
        found.points.iter().all(|point| point.bandwidth.is_none()),
        "it is tracked everywhere: there is no edge"
    );
    let figure = trade_off_figure(&found, TimeDomain::Continuous);
    let names: Vec<&str> = figure.panels[1].series.iter().map(|series| series.name.as_str()).collect();
    assert!(names.contains(&"noise to e") && !names.contains(&"d to e"), "no curve for a zero: {names:?}");
}

#[test]
fn the_picture_marks_the_chosen_design() {
    let document = document("proportional-integral");
    let figure = trade_off_figure(&swept(&document, &document.design), TimeDomain::Continuous);
    assert_eq!(figure.panels.len(), 3, "gained, cost, one against the other");
    for panel in &figure.panels[..2] {
        let mark = panel.series.iter().find(|series| series.name == "chosen").unwrap();
        assert!(
            mark.points.iter().all(|[x, _]| *x == document.design.scale),
            "at the factor: {:?}",
            mark.points
        );
        assert!(
            panel.series.iter().flat_map(|series| &series.points).all(|[_, y]| *y > 0.0),
            "on a logarithmic axis"
        );
    }
}

#[test]
fn a_sweep_without_any_design_says_why_and_one_can_be_stopped() {
    let failing = document("unseen-impulse");
    let model = failing.model().unwrap();
    let found = trade_off(&model, &failing.design, &Tolerance::default(), &Watch::none()).unwrap();
    assert!(found.unwrap_err().contains("does not hold"), "the failing condition");
    let stopped = Watch::new(|_, _| false);
    assert!(trade_off(&model, &failing.design, &Tolerance::default(), &stopped).is_none(), "stopped at once");
}
