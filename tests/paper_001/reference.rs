//! Every entry of the reference file is compared, within the tolerances that the file gives.

#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

use super::*;
use descry::numerics::Watch;
use descry::paper::{ErratumKind, errata, printed};
use descry::simulation::{FreeVariables, Scenario, WidePlant};
use descry::system::Signal;

/// A tolerance of the file.
pub(crate) fn allowed(name: &str) -> f64 {
    reference()["tolerances"][name].as_f64().unwrap()
}

fn number(value: &Value) -> usize {
    usize::try_from(value.as_u64().unwrap()).unwrap()
}

#[test]
fn the_file_holds_nothing_that_no_test_compares() {
    let reference = reference();
    let keys = |value: &Value| value.as_object().unwrap().keys().cloned().collect::<Vec<_>>().join(" ");
    for (name, expected) in [
        (
            "",
            "P_printed W2p_note conditions description design_exists id inputs nonunique_note paper poles printed \
             printed_misprint reference simulation tolerances unbiasedness_test unique variant",
        ),
        ("inputs", "A B C D E F"),
        ("conditions", "A1 A2 A3 m n p q r"),
        ("tolerances", "eig_rel_multi_output eig_rel_single_output matrix_rel rank sim_abs tf_rel"),
        (
            "unique",
            "eig_Atilde1_not_unique_note eig_H fixed_unobservable_modes n_compressed_outputs tf_dhat_from_u_y_at_1_3j tf_unique \
             tf_xhat_from_u_y_at_1_3j",
        ),
        ("reference", "At B2t Bt Ct G H J1 J2 K L Mt N P Q1 Q2 R1 R2 R3 T1 T2 W1 W1W2p W2 W2p"),
        ("unbiasedness_test", "how residual_d residual_x tol"),
        ("printed", "A3 At B2 Bt Ct G H J1 J2 K L Q1 Q2 T1 T2 W1W2p W2p"),
        ("printed_misprint", "G"),
        ("simulation", "d exact_error free rows u x1_0 z0"),
    ] {
        let value = if name.is_empty() { &reference } else { &reference[name] };
        let mut found: Vec<String> = keys(value).split(' ').map(str::to_owned).collect();
        found.sort_unstable();
        assert_eq!(found.join(" "), expected, "entries of {name:?}");
    }
    assert_eq!(reference["tolerances"]["rank"], "exact", "ranks are compared without tolerance");
    assert_eq!((&reference["paper"], &reference["variant"]), (&"001".into(), &"full (order r)".into()));
}

#[test]
fn sizes_gaps_and_verdicts_of_the_conditions_are_those_of_the_reference() {
    let reference = reference();
    let expected = &reference["conditions"];
    let (system, tolerance) = (example(), Tolerance::default());
    let at = coordinates(&system, &tolerance).unwrap();
    let sizes = [system.E.nrows(), system.E.ncols(), system.D.ncols(), system.C.nrows(), at.r()];
    assert_eq!(sizes, ["m", "n", "p", "q", "r"].map(|name| number(&expected[name])), "m, n, p, q, r");
    let conditions = asked(&system, Order::Full);
    for key in ["A1", "A2", "A3"] {
        let condition = found(&conditions, &format!("({key})"));
        let holds = expected[key]["holds"].as_bool().unwrap();
        assert_eq!(condition.verdict.holds(), holds, "{key}: {}", condition.summary);
        for (decision, _) in ranks(condition) {
            // the smaller value is rounding or nothing: of the gap only the order of magnitude is data
            let gap = expected[key]["gap"].as_f64().unwrap_or(f64::INFINITY);
            assert!(decision.gap >= 1e-3 * gap.min(1e15), "{key}: gap {:e}, {gap:e} expected", decision.gap);
            assert!(!decision.fragile, "{key}: far from the threshold");
        }
    }
    assert_eq!(expected["A3"]["status"], "full", "full rank for every s");
    assert_eq!(zeros(found(&conditions, "(A3)")), [], "no point loses rank");
    let exists = designed(&system, &choice(Order::Full, &[-1.0, -2.0])).is_ok();
    assert_eq!(Some(exists), reference["design_exists"].as_bool(), "the design exists");
}

#[test]
fn the_basis_of_the_reference_gives_the_same_reduction() {
    let reference = &reference()["reference"];
    let of = |name: &str| matrix(&reference[name]);
    let limit = allowed("matrix_rel");
    let at = coordinates(&example(), &Tolerance::default()).unwrap();
    let P = of("P");
    close(&(at.algebraic() * &P), &dmatrix![1.0, 0.0, 0.0], limit, "[A4 D2] P = [I 0]");
    let Pb = P.columns(1, 2);
    close(&(at.differential() * Pb), &of("W1"), limit, "W1 = [A2 D1] Pb");
    close(&(at.measured() * Pb), &of("W2"), limit, "W2 = [C2 F] Pb");
    close(&pseudo_inverse(&of("W2"), &Tolerance::default()).unwrap(), &of("W2p"), limit, "W2+");
    close(&(of("W1") * of("W2p")), &of("W1W2p"), limit, "W1 W2+");
    let design = paper_design(Order::Full);
    close(design.matrix("W1W2_pinv").unwrap(), &of("W1W2p"), limit, "ours does not depend on P");
}

#[test]
fn the_misprint_of_the_reference_is_the_one_that_is_listed() {
    let reference = reference();
    let erratum = errata("001").find(|erratum| erratum.concerns == "G").unwrap();
    assert_eq!(erratum.kind, ErratumKind::Misprint, "a sign");
    let said = format!("printed {}; correct {}", &erratum.printed[4..], &erratum.correct[4..]);
    assert_eq!(reference["printed_misprint"]["G"], said.as_str(), "G = [...]");
    let design = paper_design(Order::Full);
    for name in ["G", "L"] {
        let known = printed("001", name, design.matrix(name).unwrap()).unwrap();
        let columns = known.printed[0].len();
        let shown = DMatrix::from_fn(known.printed.len(), columns, |i, j| known.printed[i][j]);
        close(&shown, &matrix(&reference["printed"][name]), allowed("matrix_rel"), name);
    }
}

#[test]
fn estimates_of_the_reference_are_as_unbiased_as_it_says() {
    let reference = &reference()["unbiasedness_test"];
    let value = |name: &str| reference[name].as_f64().unwrap();
    assert!(reference["how"].as_str().unwrap().contains("w=1.3"), "at s = 1.3 i");
    let (x, d) = bias(&example(), &paper_design(Order::Full).observer, Complex64::new(0.0, 1.3));
    for (what, ours, theirs) in [("x", x, value("residual_x")), ("d", d, value("residual_d"))] {
        assert!(theirs < value("tol") && ours < value("tol"), "{what}: {ours:.1e} and {theirs:.1e}");
        assert!(
            ours < 100.0 * theirs.max(f64::EPSILON),
            "{what}: rounding alone, {ours:.1e} and {theirs:.1e}"
        );
    }
}

/// `0.5 cos 2t` of the file as an expression: `0.5*cos(2*t)`.
fn signal(text: &str) -> Signal {
    let compact: String = text.chars().filter(|c| !c.is_whitespace() && !"()".contains(*c)).collect();
    let name = ["sin", "cos"].into_iter().find(|name| compact.contains(name)).unwrap();
    let (size, argument) = compact.split_once(name).unwrap();
    let rate = argument.strip_suffix('t').unwrap();
    let or_one = |factor: &str| if factor.is_empty() { "1".to_owned() } else { factor.to_owned() };
    Signal::parse(&format!("{}*{name}({}*t)", or_one(size), or_one(rate))).unwrap()
}

#[test]
fn the_simulation_of_the_reference_is_repeated_from_its_own_words() {
    let reference = reference();
    let data = &reference["simulation"];
    let numbers = |value: &Value| -> Vec<f64> { serde_json::from_value(value.clone()).unwrap() };
    let text = |name: &str| data[name].as_str().unwrap();
    // z(0) = 0 is where every observer starts
    assert_eq!(numbers(&data["z0"]), [0.0, 0.0], "z(0)");
    let at = coordinates(&example(), &Tolerance::default()).unwrap();
    let x0 = &at.N1 * DVector::from_vec(numbers(&data["x1_0"]));
    let (law, free) = text("free").split_once("+ [1,-1]/sqrt2 * ").unwrap();
    assert!(law.starts_with("x2 = pinv(A4)(-A3 x1 - B2 u - D2 d)"), "{law}");
    let rows = data["rows"].as_array().unwrap();
    let horizon = rows.last().unwrap()["t"].as_f64().unwrap();
    let scenario = Scenario {
        horizon,
        samples: 7,
        x0: x0.clone(),
        u: text("u").trim_matches(['[', ']']).split(',').map(signal).collect(),
        d: vec![signal(text("d"))],
        noise: Vec::new(),
        uncertainty: None,
        free: FreeVariables { signals: vec![signal(free)], feedback: None },
    };
    let wide = WidePlant::new(&example().into(), &x0, &DVector::zeros(2), &Tolerance::default()).unwrap();
    let direction = dmatrix![0.0; 0.0; 1.0; -1.0] / 2.0_f64.sqrt();
    close(&wide.directions, &direction, allowed("matrix_rel"), "[1, -1] / sqrt 2 in x2");
    let design = paper_design(Order::Full);
    let observed = [(&design).into()];
    let model: Model = example().into();
    let found = scenario.run(&model, &observed, &Tolerance::default(), &Watch::none()).unwrap();
    for row in rows {
        let t = row["t"].as_f64().unwrap();
        let at = found.t.iter().position(|s| (s - t).abs() < 1e-12).unwrap();
        let observer = &found.observers[0];
        let names = ["x", "y", "d", "xhat", "dhat"];
        let values = [&found.x, &found.y, &found.d, &observer.x_hat, &observer.d_hat];
        let expected = row.as_object().unwrap();
        assert_eq!(expected.len(), names.len() + usize::from(expected.contains_key("t")), "at t = {t}");
        for (name, values) in names.into_iter().zip(values) {
            let off = (values.column(at) - DVector::from_vec(numbers(&row[name]))).amax();
            assert!(off < allowed("sim_abs"), "{name} at t = {t}: off by {off:.1e}");
        }
    }
    // the law of the errors, from z0 and x1(0) as the file writes it
    assert_eq!(
        text("exact_error"),
        "xhat-x = K exp(Ht) (z0-x1(0)), dhat-d = G exp(Ht)(z0-x1(0))",
        "as simulation::off_the_law computes it"
    );
    let off = super::simulation::off_the_law(&design, &found, &[0, 1]);
    assert!(off < allowed("sim_abs"), "errors off their law by {off:.1e}");
}
