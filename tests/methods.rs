//! One light and one sentence for every method on every example.
#![cfg(not(target_arch = "wasm32"))]
#![expect(clippy::unwrap_used, clippy::panic, reason = "helpers of tests fail by panicking")]

use std::collections::BTreeSet;

use descry::document::{Subject, read_document};
use descry::numerics::Watch;
use descry::observer::{DesignChoice, DesignError, Known, Method, assess, assess_network, conditions};
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

/// A document of these parts and its lights.
fn lights(system: &str, design: &str) -> Analysis {
    let text = format!(r#"{{"descry":1,"system":{system},"design":{design}}}"#);
    analysed(&Session::new(read_document(&text).unwrap_or_else(|error| panic!("{error}: {text}"))))
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
                Light::Near => {
                    let reasons = ["holds narrowly", "there is no design", "is not verified"];
                    assert!(reasons.iter().any(|reason| why.contains(reason)), "{what}");
                }
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
        attenuating.why, "all conditions hold; whether the demands can be met is seen when it is designed",
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
    let analysis = analysed(&session);
    let methods: Vec<Method> = analysis.methods.iter().map(|found| found.method).collect();
    assert_eq!(methods, Method::ALL, "six methods, each once");
    for found in &analysis.methods {
        assert!(matches!(found.light, Light::Fails | Light::Missing), "{:?}: {}", found.method, found.why);
    }
    let reasons: BTreeSet<&str> = analysis.methods.iter().map(|found| found.why.as_str()).collect();
    assert!(reasons.len() >= 5, "nearly each has a reason of its own: {reasons:?}");
}

/// Plants that are made to fail one known condition of one method.
#[test]
fn a_planted_defect_turns_the_light_red_by_its_condition() {
    // x2 is unstable, and no output sees it
    let unseen = r#"{"E":[[1,0],[0,1]],"A":[[-1,0],[0,2]],"C":[[1,0]],"D":[[1],[0]]}"#;
    // the same where the unknown input stands in the output, without an integrator between
    let unseen_at_once = r#"{"E":[[1,0],[0,1]],"A":[[-1,0],[0,2]],"C":[[1,0]],"D":[[1],[0]],"F":[[1]]}"#;
    let unseen_parts = r#"{"E":[[1,0],[0,1]],"A":[[2,0],[0,-1]],"C":[[0,0],[0,1]],"D":[[1],[0]],
        "partition":[{"states":1,"equations":1,"outputs":1},{"states":1,"equations":1,"outputs":1}]}"#;
    let hidden_whole = r#"{"network":{"a":[[1]],"b":[[1]],"c":[[1]],"Gamma":[[0,1],[1,0]],"Psi":[[0,0]],
        "c_G":[[1]],"c_L":[[1]],"local":[1,2]}}"#;
    let cases = [
        (Method::Proportional, "full", unseen, "2"),
        (Method::ProportionalIntegral, "full", unseen, "2"),
        (Method::InputDecoupled, "full", unseen_at_once, "2"),
        (Method::HInfinity, "full", unseen, "2"),
        (Method::Decentralized, "full", unseen_parts, "2"),
        (Method::Hierarchical, "full", hidden_whole, ""),
    ];
    for (method, order, system, mode) in cases {
        for healthy in [false, true] {
            // the same plant with the hidden part shown
            let system = if healthy {
                system
                    .replace(r#""C":[[1,0]]"#, r#""C":[[1,0],[0,1]]"#)
                    .replace(r#""F":[[1]]"#, r#""F":[[1],[0]]"#)
                    .replace(r#""C":[[0,0]"#, r#""C":[[1,0]"#)
                    .replace(r#""Psi":[[0,0]]"#, r#""Psi":[[1,0],[0,1]]"#)
            } else {
                system.to_owned()
            };
            let design = format!(
                r#"{{"method":"{}","order":"{order}","poles":[-3,-4,-5,-6],"local poles":[-5]}}"#,
                method.key()
            );
            let analysis = lights(&system, &design);
            let found = light(&analysis, method);
            let wanted = if healthy { Light::Exists } else { Light::Fails };
            assert_eq!(found.light, wanted, "{method:?}, healthy: {healthy}: {}", found.why);
            assert!(healthy || found.why.contains(mode), "{method:?} names the mode: {}", found.why);
        }
    }
}

#[test]
fn conditions_that_hold_are_not_enough_when_the_chosen_design_is_not_there() {
    let plant = r#"{"E":[[1,0],[0,1]],"A":[[-1,1],[0,2]],"C":[[1,0],[0,1]],"D":[[1],[0]],"F":[[1],[0]]}"#;
    for (design, why) in [
        (r#"{"method":"input-decoupled","poles":[-3,-4]}"#, "no reduced order; choose full or general"),
        (
            r#"{"method":"proportional","order":"full","poles":[-3]}"#,
            "1 poles are given, but this design places 2",
        ),
        (r#"{"method":"proportional","order":"full","poles":[3,4]}"#, "is not verified"),
    ] {
        let analysis = lights(plant, design);
        let chosen = analysis.assessment.as_ref().unwrap().choice.method;
        let found = light(&analysis, chosen);
        assert_eq!(found.light, Light::Near, "{design}: {}", found.why);
        assert!(found.why.starts_with("all conditions hold") && found.why.contains(why), "{}", found.why);
    }
}

#[test]
fn the_solver_that_gives_up_leaves_no_green_light() {
    let session = opened("h-infinity-lipschitz");
    let document = session.document();
    let model = document.model().unwrap();
    let conditions = conditions(&model, &document.design, &document.tolerance).unwrap();
    for (error, light) in [
        (DesignError::GaveUp("after 200 iterations".to_owned()), Light::Near),
        (DesignError::Numerics("not reliable".to_owned()), Light::Near),
        (DesignError::Demand("a demand does not fit".to_owned()), Light::Near),
        (DesignError::Unsuitable("not for this plant".to_owned()), Light::Near),
    ] {
        let outcome = Err(error.clone());
        let known = Known { conditions: &conditions, outcome: Some(&outcome) };
        let found = descry::observer::lights(&model, &document.design, &document.tolerance, Some(known));
        let found = found.iter().find(|found| found.method == Method::HInfinity).unwrap();
        assert_eq!(found.light, light, "{}", found.why);
        assert!(found.why.contains(&error.to_string()), "the reason is told: {}", found.why);
    }
}
