//! One light and one sentence for every method on every example.
#![cfg(not(target_arch = "wasm32"))]
#![expect(clippy::unwrap_used, clippy::panic, reason = "helpers of tests fail by panicking")]

use descry::document::{Subject, read_document};
use descry::numerics::Watch;
use descry::observer::{DesignChoice, DesignError, Method, assess, assess_network};
use descry::paper::EXAMPLES;
use descry::session::{
    Analysis, Command, Derived, Edit, Light, LmiEdit, MethodLight, Outcome, Session, perform, update,
};

fn opened(key: &str) -> Session {
    let mut session = Session::with_first_example().unwrap();
    update(&mut session, Command::OpenExample { key: key.to_owned() });
    session
}

fn analysed(session: &Session) -> Analysis {
    let request = Derived::default().next_request(session).unwrap();
    match perform(&request, &Watch::none()).unwrap().outcome {
        Outcome::Analysis(analysis) => *analysis,
        other => panic!("no analysis: {other:?}"),
    }
}

fn light(analysis: &Analysis, method: Method) -> &MethodLight {
    analysis.methods.iter().find(|light| light.method == method).unwrap()
}

/// What an attempt to design says: missing data, a failing condition, or neither.
fn attempted(session: &Session, method: Method) -> Light {
    let document = session.document();
    let orders = method.orders();
    let asked = document.design.order;
    let order = if orders.contains(&asked) { asked } else { orders[0] };
    let choice = DesignChoice { method, order, ..document.design.clone() };
    let found = match document.subject().unwrap() {
        Subject::Model(model) => {
            if method.missing(&model).is_some() {
                return Light::Missing;
            }
            assess(&model, &choice, &document.tolerance, &Watch::none()).unwrap()
        }
        Subject::Network(network) => {
            if method != Method::Hierarchical {
                return Light::Missing;
            }
            assess_network(&network, &choice, &document.tolerance).unwrap()
        }
    };
    match found.outcome {
        Err(DesignError::Condition { .. }) => Light::Fails,
        _ => Light::Exists,
    }
}

#[test]
fn every_light_of_every_example_is_what_an_attempt_finds() {
    for example in EXAMPLES {
        let session = opened(example.key);
        let analysis = analysed(&session);
        assert_eq!(analysis.methods.len(), Method::ALL.len(), "{}: a light for each method", example.key);
        for found in &analysis.methods {
            let expected = attempted(&session, found.method);
            let shown = if found.light == Light::Near { Light::Exists } else { found.light };
            assert_eq!(shown, expected, "{}, {:?}: {}", example.key, found.method, found.why);
        }
    }
}

#[test]
fn every_sentence_says_what_is_missing_or_which_condition_fails() {
    for example in EXAMPLES {
        let analysis = analysed(&opened(example.key));
        for MethodLight { method, light, why } in &analysis.methods {
            let what = format!("{}, {method:?}: {why}", example.key);
            assert!(why.len() > 15 && !why.ends_with('.'), "a sentence that the screen ends: {what}");
            match light {
                Light::Exists => assert!(why.starts_with("all conditions hold"), "{what}"),
                Light::Near => assert!(why.contains("holds narrowly"), "{what}"),
                Light::Fails => assert!(why.contains(" fails: ") && !why.contains("condition A"), "{what}"),
                Light::Missing => {
                    let advice =
                        ["choose", "add", "partition", "remove", "open or make", "time", "large", "network"];
                    assert!(advice.iter().any(|word| why.contains(word)), "says what is needed: {what}");
                }
            }
        }
    }
}

#[test]
fn the_lights_of_the_comparison_name_the_order_that_exists() {
    let mut session = opened("comparison");
    let lights = analysed(&session);
    for method in [Method::ProportionalIntegral, Method::Proportional, Method::InputDecoupled] {
        assert_eq!(light(&lights, method).light, Light::Exists, "{method:?}");
    }
    let attenuating = light(&lights, Method::HInfinity);
    assert_eq!(
        attenuating.why, "all conditions hold; whether the demands can be met is seen when it is chosen",
        "the inequalities of a method that is not chosen are not solved"
    );
    assert_eq!(light(&lights, Method::Decentralized).light, Light::Missing, "there are no subsystems");
    assert_eq!(light(&lights, Method::Hierarchical).light, Light::Missing, "it is no network");
    update(&mut session, Command::Edit(Edit::Method(Method::ProportionalIntegral)));
    update(&mut session, Command::Edit(Edit::Order(descry::observer::Order::Reduced)));
    let lights = analysed(&session);
    let reduced = light(&lights, Method::ProportionalIntegral);
    assert_eq!(reduced.light, Light::Fails, "{}", reduced.why);
    assert!(
        reduced.why.contains("condition (23) fails")
            && reduced
                .why
                .contains("(asked of reduced order); it exists of full order and in the general form"),
        "{}",
        reduced.why
    );
}

#[test]
fn of_the_chosen_method_the_light_knows_whether_the_demands_are_met() {
    let mut session = opened("h-infinity-lipschitz");
    let found = analysed(&session);
    let chosen = light(&found, Method::HInfinity);
    assert_eq!(chosen.why, "all conditions hold, and the matrix inequalities are feasible");
    update(&mut session, Command::Edit(Edit::Lmi(LmiEdit::Gamma { gamma: Some(0.01), done: true })));
    let found = analysed(&session);
    let chosen = light(&found, Method::HInfinity);
    assert_eq!(chosen.light, Light::Fails, "{}", chosen.why);
    assert!(chosen.why.starts_with("the conditions hold, but the demands cannot be met"), "{}", chosen.why);
    let other = light(&found, Method::Proportional);
    assert!(other.light == Light::Missing && other.why.contains("Lipschitz"), "{}", other.why);
}

#[test]
fn a_plant_that_no_method_suits_has_six_reasons() {
    let text = r#"{"descry":1,"system":{"E":[[0]],"A":[[0]],"C":[[0]]},"design":{"method":"proportional"}}"#;
    let session = Session::new(read_document(text).unwrap());
    for found in analysed(&session).methods {
        assert!(matches!(found.light, Light::Fails | Light::Missing), "{:?}: {}", found.method, found.why);
    }
}
