//! Verdicts on what is hardly seen, hardly stable, or nothing but rounding.

#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

use super::*;
use descry::system::properties::r_detectability;

/// An ordinary system without unknown inputs.
fn ordinary(A: DMatrix<f64>, C: DMatrix<f64>) -> DescriptorSystem {
    DescriptorSystem::autonomous(DMatrix::identity(A.nrows(), A.nrows()), A, C).unwrap()
}

fn third(system: &DescriptorSystem, order: Order) -> Condition {
    found(&asked(system, order), "(A3)").clone()
}

/// Both forms and the property of the plant give this verdict.
fn all_say(system: &DescriptorSystem, verdict: Verdict, what: &str) {
    for order in [Order::Full, Order::General] {
        let condition = third(system, order);
        assert_eq!(condition.verdict, verdict, "{what}, {order:?}: {}", condition.summary);
    }
    let property = r_detectability(system, &Tolerance::default()).unwrap();
    assert_eq!(Verdict::of(property.holds(), property.fragile()), verdict, "{what}, R-detectable");
}

#[test]
fn an_output_that_the_unknown_input_hides_is_not_seen_through_rounding() {
    // y = (0.1, 0.3)' x + (1, 3)' d: what is free of d contains nothing of x
    for (a, verdict) in [
        (0.0, Verdict::Fails),
        (1e-12, Verdict::Fails),
        (1.0, Verdict::Fails),
        (-1e-12, Verdict::Fails),
        (-1.0, Verdict::Holds),
    ] {
        let system = DescriptorSystem {
            C: dmatrix![0.1; 0.3],
            D: dmatrix![0.0],
            F: dmatrix![1.0; 3.0],
            ..ordinary(dmatrix![a], dmatrix![1.0])
        };
        for order in [Order::Full, Order::General] {
            let condition = third(&system, order);
            assert_eq!(condition.verdict, verdict, "A = {a:e}, {order:?}: {}", condition.summary);
            let shown = zeros(&condition);
            assert!(shown.len() == 1 && (shown[0] - a).norm() < 1e-15, "the zero of A = {a:e}: {shown:?}");
        }
        let design = designed(&system, &choice(Order::Full, &[-1.0]));
        assert_eq!(design.is_ok(), verdict.holds(), "A = {a:e}: no design on rounding");
    }
    // algebraic states hide it as well as unknown inputs do
    let hidden = DescriptorSystem {
        time: TimeDomain::Continuous,
        E: dmatrix![1.0, 0.0],
        A: dmatrix![0.0, 0.0],
        B: DMatrix::zeros(1, 0),
        C: dmatrix![0.1, 1.0; 0.3, 3.0],
        D: DMatrix::zeros(1, 0),
        F: DMatrix::zeros(2, 0),
    };
    for order in [Order::Full, Order::General] {
        assert_eq!(
            third(&hidden, order).verdict,
            Verdict::Fails,
            "{order:?}: x1 is nowhere but in x1 + 10 x2"
        );
    }
}

#[test]
fn dynamics_that_cancel_are_no_dynamics() {
    // x1' = 0.3 x2 + 3 x3, x2' = 0 with 0 = 0.1 x2 + x3: nothing moves, and x2 is not seen
    let system = DescriptorSystem {
        time: TimeDomain::Continuous,
        E: dmatrix![1.0, 0.0, 0.0; 0.0, 1.0, 0.0; 0.0, 0.0, 0.0],
        A: dmatrix![0.0, 0.3, 3.0; 0.0, 0.0, 0.0; 0.0, 0.1, 1.0],
        B: DMatrix::zeros(3, 0),
        C: dmatrix![1.0, 0.0, 0.0],
        D: DMatrix::zeros(3, 0),
        F: DMatrix::zeros(1, 0),
    };
    for order in [Order::Full, Order::General] {
        let condition = third(&system, order);
        assert_eq!(condition.verdict, Verdict::Fails, "{order:?}: {}", condition.summary);
    }
}

#[test]
fn the_unit_of_an_output_is_no_property_of_the_system() {
    for unit in [1e-200, 1e-12, 1e-8, 1.0, 1e12, 1e200] {
        let system = ordinary(dmatrix![1.0], dmatrix![unit]);
        all_say(&system, Verdict::Holds, &format!("y = {unit:e} x"));
    }
    for unit in [1e-12, 1e-8, 1e8] {
        let system = ordinary(dmatrix![0.0, 1.0; 2.0, 1.0], dmatrix![unit, 0.0]);
        let design = designed(&system, &choice(Order::Full, &[-1.0, -2.0])).unwrap();
        verified(&design);
        let expected = [-1.0, -2.0].map(Complex64::from);
        let off = spectral_distance(&design.verification.spectrum, &expected);
        assert!(off < 1e-9, "y = {unit:e} x1: poles off by {off:.1e}");
    }
    // one of two units is that of the other output
    for (share, verdict) in [(1e-4, Verdict::Holds), (1e-8, Verdict::Fragile), (1e-12, Verdict::Fails)] {
        let system = ordinary(DMatrix::identity(2, 2), dmatrix![1.0, 0.0; 0.0, share]);
        all_say(&system, verdict, &format!("y2 = {share:e} x2 beside y1 = x1"));
    }
}

#[test]
fn a_zero_close_to_the_margin_holds_narrowly() {
    for (mode, verdict) in [
        (-1.0, Verdict::Holds),
        (-1e-4, Verdict::Holds),
        (-1e-7, Verdict::Fragile),
        (-1e-10, Verdict::Fails),
        (0.0, Verdict::Fails),
        (1e-7, Verdict::Fails),
    ] {
        let A = DMatrix::from_diagonal(&DVector::from_column_slice(&[mode, -3.0]));
        all_say(&ordinary(A, dmatrix![0.0, 1.0]), verdict, &format!("a hidden zero at {mode:e}"));
        // discrete: the same distance from the unit circle
        let A = DMatrix::from_diagonal(&DVector::from_column_slice(&[1.0 + mode, -0.5]));
        let system = DescriptorSystem { time: TimeDomain::Discrete, ..ordinary(A, dmatrix![0.0, 1.0]) };
        all_say(&system, verdict, &format!("a hidden zero at 1 + {mode:e}"));
    }
}

#[test]
fn a_cluster_of_zeros_is_stable_only_when_every_member_is() {
    let with = |first: f64, second: f64, output: f64| {
        let A = DMatrix::from_diagonal(&DVector::from_column_slice(&[first, second, -3.0]));
        ordinary(A, dmatrix![0.0, output, 1.0])
    };
    for (first, second) in [(-2e-5, 2e-5), (2e-5, -2e-5)] {
        let condition = third(&with(first, second, 0.0), Order::Full);
        assert_eq!(condition.verdict, Verdict::Fails, "{first:e}, {second:e}: {}", condition.summary);
        assert!(condition.summary.contains("zero 2.000e-5 is not stable"), "{}", condition.summary);
    }
    let condition = third(&with(-2e-5, -3e-5, 0.0), Order::Full);
    assert_eq!(condition.verdict, Verdict::Holds, "both decay: {}", condition.summary);
    // a neighbour that the output shows is no member
    let condition = third(&with(-2e-5, 2e-5, 1.0), Order::Full);
    assert_eq!(condition.verdict, Verdict::Holds, "the unstable one is seen: {}", condition.summary);
}

#[test]
fn an_unknown_input_without_effect_is_named_as_such() {
    let mut system = example();
    system.D = side_by_side(&[&system.D, &DMatrix::zeros(3, 1)]);
    system.F = side_by_side(&[&system.F, &DMatrix::zeros(3, 1)]);
    let conditions = asked(&system, Order::Full);
    let second = found(&conditions, "(A2)");
    assert_eq!(second.verdict, Verdict::Fails, "{}", second.summary);
    assert!(second.summary.contains("d2 has no effect at all"), "{}", second.summary);
    assert!(second.remedies[0].contains("remove it"), "{:?}", second.remedies);
    assert_eq!(second.remedies.len(), 1, "no integrator and no sensor finds it: {:?}", second.remedies);
    // the same input twice
    system.D.column_mut(1).copy_from(&example().D.column(0));
    system.F.column_mut(1).copy_from(&example().F.column(0));
    let conditions = asked(&system, Order::Full);
    let second = found(&conditions, "(A2)");
    assert!(
        second.remedies[0].starts_with("a combination of d1, d2 has no effect at all"),
        "{:?}",
        second.remedies
    );
    // beside one that differential equations alone contain
    system.D = dmatrix![1.0, 0.0; 0.0, 0.0; 0.0, 0.0];
    system.F.fill(0.0);
    let conditions = asked(&system, Order::Full);
    let second = found(&conditions, "(A2)");
    assert!(second.summary.contains("d2 has no effect at all"), "{}", second.summary);
    assert!(second.remedies[1].starts_with("d1 stands in no algebraic equation"), "{:?}", second.remedies);
}

#[test]
fn unique_is_said_of_one_output_without_fixed_modes_alone() {
    let meaning = |design: &Design, name: &str| {
        let matrix = design.matrices.iter().find(|matrix| matrix.name == name).unwrap();
        matrix.meaning.clone()
    };
    let says = |design: &Design, text: &str| {
        assert!(design.notes.iter().any(|note| note.contains(text)), "{text}: {:?}", design.notes);
    };
    let design = paper_design(Order::Full);
    says(&design, "H, J1 and J2 are unique for these poles");
    assert_eq!(meaning(&design, "L"), "gain; only L (I - W2 W2+) is determined");
    // a fixed mode leaves a choice: two gains with the same poles
    let fixed = ordinary(dmatrix![-1.0, 1.0; 0.0, 2.0], dmatrix![0.0, 1.0]);
    let design = designed(&fixed, &choice(Order::Full, &[-2.0])).unwrap();
    verified(&design);
    says(
        &design,
        "one output is free of the unknown input, but the fixed modes leave a choice: L is one of many",
    );
    assert_eq!(meaning(&design, "L"), "gain; only L (I - W2 W2+) has an effect");
    let another = &fixed.A - (design.matrix("L").unwrap() + dmatrix![5.0; 0.0]) * &fixed.C;
    let off = spectral_distance(&eigenvalues(&another).unwrap(), &design.verification.spectrum);
    assert!(off < 1e-12, "another H with the same poles: {off:.1e}");
    // twice the same output: H is unique, J2 is not
    let twice = ordinary(dmatrix![0.0, 1.0; 2.0, 1.0], dmatrix![1.0, 0.0; 2.0, 0.0]);
    let design = designed(&twice, &choice(Order::Full, &[-1.0, -2.0])).unwrap();
    says(&design, "2 outputs are free of the unknown input, all of them multiples of one: H is unique");
    let design =
        designed(&random::planted(&random::SIZES[1], &[], 7), &choice(Order::Full, &[-1.0, -2.0, -3.0]));
    let design = design.unwrap();
    says(&design, "outputs are free of the unknown input: L is one of many gains with these poles");
    assert_eq!(meaning(&design, "L"), "gain; only L (I - W2 W2+) has an effect");
}

#[test]
fn texts_speak_of_steps_in_discrete_time() {
    let system = DescriptorSystem { time: TimeDomain::Discrete, ..example() };
    let design = designed(&system, &choice(Order::Full, &[0.5, -0.25])).unwrap();
    let texts: Vec<&str> = design
        .matrices
        .iter()
        .map(|matrix| matrix.meaning.as_str())
        .chain(design.verification.checks.iter().map(|check| check.statement.as_str()))
        .collect();
    for wanted in ["z[k+1] = H z", "K H^k e0", "G H^k e0", "e[k+1] = H e[k] for every d[k]", "x s^k"] {
        assert!(texts.iter().any(|text| text.contains(wanted)), "{wanted}: {texts:?}");
    }
    for wrong in ["z' =", "e' =", "e^("] {
        assert!(!texts.iter().any(|text| text.contains(wrong)), "{wrong}: {texts:?}");
    }
    let design = paper_design(Order::Full);
    assert!(
        design.matrices.iter().any(|matrix| matrix.meaning.contains("K e^(H t) e0")),
        "continuous time as in the paper"
    );
}
