//! The method on the examples of the other papers: what it says, and whether that helps.

#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

use super::*;
use descry::document::read_document;
use descry::numerics::Watch;
use descry::observer::{Assessment, Method, assess};

fn assessed(key: &str, order: Order, change: impl Fn(&mut DescriptorSystem)) -> Assessment {
    let document = read_document(descry::paper::example(key).unwrap().text).unwrap();
    let mut model = document.model().unwrap();
    change(&mut model.system);
    let inside = model.system.time == TimeDomain::Discrete;
    let poles = (1..5).map(|k| Complex64::from(if inside { 0.1 } else { -1.0 } * f64::from(k))).collect();
    let choice = DesignChoice { method: Method::InputDecoupled, order, poles, ..DesignChoice::default() };
    assess(&model, &choice, &document.tolerance, &Watch::none()).unwrap()
}

#[test]
fn an_input_of_differential_equations_alone_needs_an_integrator_or_a_sensor_of_its_own() {
    for key in ["proportional-integral", "discrete", "unseen-impulse"] {
        let found = assessed(key, Order::General, |_| {});
        let second = super::found(&found.conditions, "(A2)");
        assert_eq!(second.verdict, Verdict::Fails, "{key}");
        assert!(
            second.summary.contains("d1 stands nowhere but in differential equations"),
            "{}",
            second.summary
        );
        assert!(
            second.remedies[0].contains("choose the proportional-integral observer"),
            "{:?}",
            second.remedies
        );
        assert!(
            second.remedies.iter().all(|r| !r.contains("single additional sensor")),
            "{:?}",
            second.remedies
        );
    }
    // a row of F, as the remedy says
    let measured = |system: &mut DescriptorSystem| {
        system.C = stack(&[&system.C, &DMatrix::zeros(1, system.n_states())]);
        system.F = stack(&[&system.F, &dmatrix![1.0]]);
    };
    for order in [Order::Full, Order::General] {
        let found = assessed("proportional-integral", order, measured);
        assert!(found.verified(), "{order:?}: {:?}", found.outcome.err());
    }
}

#[test]
fn an_input_in_a_constraint_is_found_with_the_sensor_that_is_proposed() {
    let found = assessed("input-in-constraint", Order::Full, |_| {});
    let second = super::found(&found.conditions, "(A2)");
    assert_eq!(second.verdict, Verdict::Fails, "{}", second.summary);
    assert!(second.remedies[0].starts_with("measure x3"), "{:?}", second.remedies);
    let sensor = |system: &mut DescriptorSystem| {
        let n = system.n_states();
        system.C = stack(&[&system.C, &DMatrix::from_fn(1, n, |_, j| if j == 2 { 1.0 } else { 0.0 })]);
        system.F = stack(&[&system.F, &dmatrix![0.0]]);
    };
    let mended = assessed("input-in-constraint", Order::Full, sensor);
    assert!(mended.verified(), "{:?}", mended.outcome.err());
}

#[test]
fn a_partitioned_system_in_discrete_time_is_observed_as_a_whole() {
    for order in [Order::Full, Order::General] {
        let found = assessed("decentralized", order, |_| {});
        assert!(found.verified(), "{order:?}: {:?}", found.outcome.err());
    }
}

#[test]
fn a_nonlinearity_is_refused_with_what_to_do() {
    let document = read_document(descry::paper::example("h-infinity-lipschitz").unwrap().text).unwrap();
    let model = document.model().unwrap();
    let why = Method::InputDecoupled.missing(&model).unwrap();
    assert!(why.contains("choose the H-infinity observer"), "{why}");
}
