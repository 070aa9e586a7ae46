//! Decentralized observers beyond the paper's example: degenerate subsystems, random ones, bad input, executors.

#![cfg(not(target_arch = "wasm32"))]
#![expect(clippy::unwrap_used, clippy::panic, reason = "helpers of tests fail by panicking")]
#![expect(non_snake_case, reason = "matrix letters of the paper")]

use descry::lmi::Outcome;
use descry::numerics::{Complex64, Random, Tolerance, Watch};
use descry::observer::decentralized::{
    Local, LocalProblem, assumption_1, conditions, design, design_local, design_subsystems, local_conditions,
    local_problems, strong_detectability,
};
use descry::observer::{Design, DesignChoice, DesignError, LmiChoice, Method, Order, Verdict};
use descry::system::{DescriptorSystem, Model, Subsystem, TimeDomain};
use nalgebra::{DMatrix, dmatrix};

fn tolerance() -> Tolerance {
    Tolerance::default()
}

fn choice(order: Order, lmi: LmiChoice) -> DesignChoice {
    DesignChoice { method: Method::Decentralized, order, lmi, ..DesignChoice::default() }
}

/// Nothing is decoupled exactly in the one subsystem.
fn attenuate_all() -> LmiChoice {
    LmiChoice { decoupled: Some(vec![Vec::new()]), ..LmiChoice::default() }
}

fn local(problem: &LocalProblem, choice: &DesignChoice) -> Outcome<Local> {
    design_local(problem, 0, choice, &tolerance(), &Watch::none()).unwrap()
}

fn verified(outcome: Outcome<Local>) -> Local {
    match outcome {
        Outcome::Verified(local) => {
            let failed: Vec<_> = local.checks.iter().filter(|check| !check.passed()).collect();
            assert!(failed.is_empty(), "{failed:#?}");
            local
        }
        other => panic!("expected a verified design, found {other:#?}"),
    }
}

/// `E x' = A x + D v, z = H x` with as many couplings as `D` has columns.
fn problem(E: DMatrix<f64>, A: DMatrix<f64>, H: DMatrix<f64>, D: DMatrix<f64>) -> LocalProblem {
    let n = E.ncols();
    LocalProblem {
        name: "one".to_owned(),
        time: TimeDomain::Continuous,
        B: DMatrix::from_element(E.nrows(), 1, 1.0),
        sources: (n..n + D.ncols()).collect(),
        states_of_plant: n + D.ncols(),
        first_state: 0,
        E,
        A,
        H,
        D,
    }
}

fn unit(n: usize) -> DMatrix<f64> {
    DMatrix::identity(n, n)
}

#[test]
fn without_couplings_gamma_is_zero_and_only_the_decay_is_designed() {
    let A = dmatrix![0.0, 1.0; 2.0, 0.0];
    let alone = problem(unit(2), A, dmatrix![1.0, 0.0], DMatrix::zeros(2, 0));
    for time in [TimeDomain::Continuous, TimeDomain::Discrete] {
        for order in [Order::Full, Order::Reduced, Order::Minimal] {
            let decay = Some(if time == TimeDomain::Discrete { 0.6 } else { 1.5 });
            // the paper's reduced orders have the fixed mode 0 here
            let alternative = order != Order::Full;
            let lmi = LmiChoice { decay, alternative, ..attenuate_all() };
            let found = verified(local(&LocalProblem { time, ..alone.clone() }, &choice(order, lmi)));
            assert_eq!(found.result.gamma, Some(0.0), "{time:?} {order:?}");
            assert!(found.result.certificate.proved, "the Lyapunov inequality is proved");
            assert!(found.setup.decoupled.Phi.nrows() == 0, "E is nonsingular: Phi is empty");
        }
    }
}

#[test]
fn couplings_within_the_range_of_the_decoupled_ones_have_no_effect() {
    // both couplings act along (1, 0); the first is decoupled, the second then does nothing
    let A = dmatrix![0.0, 1.0; -2.0, -3.0];
    let twice = problem(unit(2), A, dmatrix![1.0, 0.0], dmatrix![1.0, 0.5; 0.0, 0.0]);
    let lmi = LmiChoice { decoupled: Some(vec![vec![2]]), ..LmiChoice::default() };
    let found = verified(local(&twice, &choice(Order::Full, lmi)));
    assert_eq!(found.result.gamma, Some(0.0), "Pi D2 = 0 and Phi D2 = 0");
    assert!((&found.matrices.T * &twice.D).norm() < 1e-12, "T annihilates both");
    // greedy finds the same
    let found = verified(local(&twice, &choice(Order::Full, LmiChoice::default())));
    assert_eq!(found.setup.exact, [0], "the second column depends on the first");
}

#[test]
fn order_zero_is_a_static_estimate() {
    // x1 is measured, x2 follows from the algebraic equation 0 = x1 + 2 x2 + u + v
    let E = dmatrix![1.0, 0.0; 0.0, 0.0];
    let A = dmatrix![-1.0, 1.0; 1.0, 2.0];
    let disturbed = problem(E.clone(), A.clone(), dmatrix![1.0, 0.0], dmatrix![0.0; 1.0]);
    let found = verified(local(&disturbed, &choice(Order::Minimal, attenuate_all())));
    assert_eq!(found.setup.family.order(), 0, "everything is known");
    let best = found.result.gamma_best.unwrap();
    assert!((best - 0.5).abs() < 1e-6, "x2_hat - x2 = v / 2: {best}");
    let undisturbed = problem(E, A, dmatrix![1.0, 0.0], DMatrix::zeros(2, 0));
    let found = verified(local(&undisturbed, &choice(Order::Minimal, attenuate_all())));
    assert_eq!((found.setup.family.order(), found.result.gamma), (0, Some(0.0)), "static and exact");
    // all states measured: the reduced order is zero, too
    let measured = problem(unit(2), dmatrix![1.0, 0.0; 0.0, 1.0], unit(2), dmatrix![1.0; 1.0]);
    let found = verified(local(&measured, &choice(Order::Reduced, attenuate_all())));
    assert!(found.setup.family.order() == 0 && found.result.gamma == Some(0.0), "y = x");
}

#[test]
fn a_given_r_is_used_and_a_wrong_one_is_named() {
    let A = dmatrix![0.0, 1.0; -2.0, -3.0];
    let plain = problem(unit(2), A, dmatrix![1.0, 0.0], dmatrix![0.0; 1.0]);
    let with = |R: DMatrix<f64>| choice(Order::Full, LmiChoice { rows: vec![R], ..attenuate_all() });
    let found = verified(local(&plain, &with(dmatrix![1.0, 1.0])));
    assert_eq!(found.setup.family.order(), 1, "one row");
    let refusals = [
        (dmatrix![1.0, 1.0; 2.0, 2.0], "R of subsystem one has rank 1, but its 2 rows must be independent"),
        (dmatrix![1.0, 0.0], "[R; Phi A; H] of subsystem one has rank 1, but 2 is needed"),
        (dmatrix![1.0], "R of subsystem one has 1 columns, but 2 are needed"),
        (dmatrix![f64::NAN, 1.0], "R of subsystem one has an entry that is not a finite number"),
    ];
    for (R, message) in refusals {
        let error = design_local(&plain, 0, &with(R.clone()), &tolerance(), &Watch::none()).unwrap_err();
        assert!(error.to_string().starts_with(message), "{error}");
        let asked = local_conditions(&plain, 0, &with(R), &tolerance()).unwrap();
        let failed = asked.iter().find(|condition| condition.verdict == Verdict::Fails).unwrap();
        assert!(failed.summary.starts_with(message) && !failed.remedies.is_empty(), "{}", failed.summary);
    }
}

#[test]
fn demands_that_are_no_numbers_to_design_with_are_named() {
    let plain = problem(unit(1), dmatrix![-1.0], dmatrix![1.0], dmatrix![1.0]);
    let refused = |lmi: LmiChoice, what: &str| {
        let error =
            design_local(&plain, 0, &choice(Order::Full, lmi), &tolerance(), &Watch::none()).unwrap_err();
        assert!(error.to_string().contains(what), "{error}");
    };
    refused(LmiChoice { decay: Some(f64::NAN), ..attenuate_all() }, "decay rate is NaN");
    refused(LmiChoice { decay: Some(-1.0), ..attenuate_all() }, "decay rate is -1");
    refused(LmiChoice { gain: Some(0.0), ..attenuate_all() }, "gain bound is 0");
    refused(LmiChoice { gamma: Some(f64::INFINITY), ..attenuate_all() }, "gamma is inf");
    refused(LmiChoice { conditioning: 0.5, ..attenuate_all() }, "condition of X is 0.5");
    refused(LmiChoice { back_off: f64::NAN, ..attenuate_all() }, "back-off is NaN");
    refused(LmiChoice { decoupled: Some(vec![vec![0]]), ..LmiChoice::default() }, "one of its own states");
    refused(LmiChoice { decoupled: Some(vec![vec![7]]), ..LmiChoice::default() }, "no such state");
}

#[test]
fn a_decay_beyond_the_fixed_mode_is_answered_with_the_nearest_one() {
    // x2 is neither measured nor coupled to x1: -2 is a mode of every observer
    let A = dmatrix![-1.0, 0.0; 0.0, -2.0];
    let hidden = problem(unit(2), A, dmatrix![1.0, 0.0], dmatrix![1.0; 1.0]);
    let lmi = LmiChoice { decay: Some(3.0), ..attenuate_all() };
    let Outcome::Infeasible(why) = local(&hidden, &choice(Order::Full, lmi)) else {
        panic!("-2 does not decay with rate 3")
    };
    assert!(why.block.contains("decay rate"), "{why:?}");
    let near = why.nearest.iter().find(|near| near.quantity == "decay rate").unwrap();
    assert!(near.asked == 3.0 && near.feasible < 2.0 && near.feasible > 1.98, "{why:?}");
    let lmi = LmiChoice { decay: Some(near.feasible), ..attenuate_all() };
    verified(local(&hidden, &choice(Order::Full, lmi)));
}

#[test]
fn a_gain_bound_that_is_too_tight_is_answered_with_one_that_suffices() {
    let unstable = problem(unit(1), dmatrix![5.0], dmatrix![1.0], dmatrix![1.0]);
    let with = |gain: f64| choice(Order::Full, LmiChoice { gain: Some(gain), ..attenuate_all() });
    let Outcome::Infeasible(why) = local(&unstable, &with(1.0)) else { panic!("a gain of 1 is too small") };
    let near = why.nearest.iter().find(|near| near.quantity == "gain bound").unwrap();
    assert!(near.asked == 1.0 && near.feasible > 1.0, "{why:?}");
    let found = verified(local(&unstable, &with(near.feasible)));
    assert!(found.result.gain <= near.feasible * (1.0 + 1e-6), "within its bound: {}", found.result.gain);
}

/// A random subsystem with a singular `E`.
fn random_problem(random: &mut Random, time: TimeDomain) -> LocalProblem {
    let pick =
        |random: &mut Random, from: usize, to: usize| from + (random.bits() as usize) % (to - from + 1);
    let (n, m, couplings) = (3, pick(random, 1, 2), pick(random, 1, 2));
    let mut middle = unit(n);
    for i in pick(random, 1, n - 1)..n {
        middle[(i, i)] = 0.0;
    }
    let mut fill = |rows, columns| DMatrix::from_fn(rows, columns, |_, _| random.normal());
    let E = fill(n, n) * middle * fill(n, n);
    let (A, H, D) = (fill(n, n), fill(m, n), fill(n, couplings) * 0.3);
    LocalProblem { time, ..problem(E, A, H, D) }
}

/// The largest gain of `P (s I - N)^-1 (-T D2) + Q Phi D2` on a grid of frequencies, by complex arithmetic.
fn gain_on_a_grid(found: &Local) -> f64 {
    let complex = |m: &DMatrix<f64>| m.map(Complex64::from);
    let (matrices, decoupled) = (&found.matrices, &found.setup.decoupled);
    let beta = matrices.N.nrows();
    let into = complex(&-(&matrices.T * &decoupled.D2));
    let direct = complex(&(&matrices.Q * &decoupled.Phi * &decoupled.D2));
    let gain = |s: Complex64| {
        let pencil = DMatrix::identity(beta, beta) * s - complex(&matrices.N);
        let response = complex(&matrices.P) * pencil.lu().solve(&into).unwrap() + &direct;
        // |G|^2 <= trace G*G; the largest column norm is a lower bound of the largest singular value
        response.column_iter().map(|column| column.norm()).fold(0.0, f64::max)
    };
    let points = (0..400).map(|k| f64::from(k) / 400.0);
    match found.setup.problem.time {
        TimeDomain::Continuous => points
            .map(|x| gain(Complex64::new(0.0, 10_f64.powf(8.0 * x - 4.0))))
            .fold(gain(Complex64::ZERO), f64::max),
        TimeDomain::Discrete => points
            .map(|x| gain(Complex64::from_polar(1.0, std::f64::consts::PI * x)))
            .fold(gain(Complex64::from(-1.0)), f64::max),
    }
}

#[test]
fn no_random_design_is_certified_falsely() {
    let mut random = Random::new(11);
    let (mut designed, mut refused, mut unproved) = (0, 0, 0);
    for number in 0..64 {
        let time = if number % 2 == 0 { TimeDomain::Continuous } else { TimeDomain::Discrete };
        let problem = random_problem(&mut random, time);
        let order = if number % 4 < 2 { Order::Reduced } else { Order::Full };
        let lmi = if number % 3 == 0 { LmiChoice::default() } else { attenuate_all() };
        let choice = choice(order, lmi);
        let asked = local_conditions(&problem, 0, &choice, &tolerance()).unwrap();
        let holds = asked.iter().all(|condition| condition.verdict.holds());
        let outcome = local(&problem, &choice);
        match outcome {
            Outcome::Verified(found) => {
                assert!(holds, "{number}: a condition fails, yet there is a design");
                let gamma = found.result.gamma.unwrap();
                let seen = gain_on_a_grid(&found);
                assert!(seen <= gamma * (1.0 + 1e-9), "{number}: gain {seen} above gamma {gamma}");
                let failed: Vec<_> = found.checks.iter().filter(|check| !check.passed()).collect();
                assert!(failed.is_empty(), "{number}: {failed:#?}");
                assert!(found.result.gain <= 100.1 * 1.5, "{number}: gain {}", found.result.gain);
                designed += 1;
            }
            Outcome::NotCertified { .. } | Outcome::GaveUp(_) => unproved += 1,
            Outcome::Infeasible(_) => refused += 1,
            Outcome::Cancelled => panic!("nobody cancels"),
        }
    }
    println!("designed {designed}, refused {refused}, unproved {unproved}");
    assert!(
        designed >= 40,
        "most random subsystems have an observer: {designed} designed, {refused} refused"
    );
    assert!(unproved <= 3, "{unproved} of 64 are without decision");
}

#[test]
fn undetectable_subsystems_are_refused() {
    let mut random = Random::new(23);
    for number in 0..8 {
        let time = if number % 2 == 0 { TimeDomain::Continuous } else { TimeDomain::Discrete };
        // an unstable mode beside a random subsystem, seen by no output, then hidden by a change of coordinates
        let part = random_problem(&mut random, time);
        let grow = |m: &DMatrix<f64>, corner: f64| {
            let mut result = DMatrix::zeros(m.nrows() + 1, m.ncols() + 1);
            result.view_mut((0, 0), m.shape()).copy_from(m);
            result[(m.nrows(), m.ncols())] = corner;
            result
        };
        let mut fill = |rows, columns| DMatrix::from_fn(rows, columns, |_, _| random.normal());
        let (left, right) = (fill(4, 4), fill(4, 4));
        let H = grow(&part.H, 0.0).rows(0, part.H.nrows()).into_owned() * &right;
        let E = &left * grow(&part.E, 1.0) * &right;
        let A = &left * grow(&part.A, 1.3) * &right;
        let hidden = LocalProblem { time, ..problem(E, A, H, fill(4, 1)) };
        let choice = choice(Order::Full, attenuate_all());
        let asked = local_conditions(&hidden, 0, &choice, &tolerance()).unwrap();
        let failed = asked.iter().find(|condition| condition.id.starts_with("000-detectable")).unwrap();
        assert_eq!(failed.verdict, Verdict::Fails, "{number}: {}", failed.summary);
        assert!(!failed.remedies.is_empty() && failed.witness.is_some(), "{number}: says what to do");
        if assumption_1(&hidden, &[], &tolerance()).unwrap().holds() {
            let outcome = local(&hidden, &choice);
            assert!(matches!(outcome, Outcome::Infeasible(_)), "{number}: {outcome:#?}");
        }
    }
}

/// A strongly detectable subsystem whose reduced order has an unstable fixed mode in the paper's parameterisation, once
/// its first coupling is decoupled.
fn unlucky() -> (LocalProblem, LmiChoice) {
    const SEED: u64 = 34;
    let problem = random_problem(&mut Random::new(SEED), TimeDomain::Continuous);
    let lmi = LmiChoice { decoupled: Some(vec![vec![problem.sources[0]]]), ..LmiChoice::default() };
    (problem, lmi)
}

#[test]
fn the_extended_parameterisation_rescues_what_the_paper_s_makes_unstable() {
    let (problem, lmi) = unlucky();
    assert!(strong_detectability(&problem, &[0], &tolerance()).unwrap().holds(), "the full order exists");
    verified(local(&problem, &choice(Order::Full, lmi.clone())));
    let paper = choice(Order::Reduced, lmi.clone());
    let asked = local_conditions(&problem, 0, &paper, &tolerance()).unwrap();
    let fixed = asked.iter().find(|condition| condition.id.starts_with("000-fixed")).unwrap();
    assert_eq!(fixed.verdict, Verdict::Fails, "{}", fixed.summary);
    assert!(fixed.summary.starts_with("2.704"), "the mode is named: {}", fixed.summary);
    assert!(fixed.remedies.iter().any(|remedy| remedy.contains("extended")), "{:?}", fixed.remedies);
    assert!(matches!(local(&problem, &paper), Outcome::Infeasible(_)), "no gain moves it");
    let extended = choice(Order::Reduced, LmiChoice { alternative: true, ..lmi });
    let found = verified(local(&problem, &extended));
    assert!(found.result.certificate.proved, "{:?}", found.result);
    assert!((&found.matrices.T * &found.setup.decoupled.D1).norm() < 1e-9, "T D1 = 0");
}

#[test]
fn the_extended_parameterisation_is_never_worse() {
    let mut random = Random::new(5);
    let mut better = 0;
    for number in 0..6 {
        let time = if number % 2 == 0 { TimeDomain::Continuous } else { TimeDomain::Discrete };
        let problem = random_problem(&mut random, time);
        let best = |alternative| {
            let lmi = LmiChoice { alternative, gain: Some(20.0), ..attenuate_all() };
            match local(&problem, &choice(Order::Reduced, lmi)) {
                Outcome::Verified(found) => found.result.gamma_best.unwrap(),
                _ => f64::INFINITY,
            }
        };
        let (paper, extended) = (best(false), best(true));
        // an infimum of zero is found to the accuracy of the solver only
        assert!(extended <= paper * (1.0 + 1e-4) + 1e-6, "{number}: extended {extended}, paper {paper}");
        better += usize::from(extended < 0.99 * paper);
    }
    assert!(better > 0, "on some of them it is better");
}

/// A ring of subsystems of the paper's kind, each driven by the next one.
fn ring(count: usize) -> Model {
    let n = 3 * count;
    let mut A = DMatrix::zeros(n, n);
    let mut E = unit(n);
    let mut C = DMatrix::zeros(2 * count, n);
    for part in 0..count {
        let (own, next) = (3 * part, 3 * ((part + 1) % count));
        let speed = 1.0 + part as f64 / count as f64;
        for (k, (a, d)) in [(-1e-3, 1e-3), (-2e-3, -2e-3), (-3e-3, -3e-3)].into_iter().enumerate() {
            A[(own + k, own + k)] = a * speed;
            A[(own + k, next + k)] += d;
        }
        E[(own + 2, own + 2)] = 0.0;
        C[(2 * part, own)] = 1.0;
        C[(2 * part + 1, own)] = 1.0;
        C[(2 * part + 1, own + 2)] = 1.0;
    }
    let mut system = DescriptorSystem::autonomous(E, A, C).unwrap();
    system.time = TimeDomain::Discrete;
    system.B = DMatrix::from_element(n, 1, 1.0);
    let part = |i: usize| Subsystem { name: format!("part {}", i + 1), states: 3, equations: 3, outputs: 2 };
    Model { partition: (0..count).map(part).collect(), ..Model::from(system) }
}

fn designed(model: &Model, choice: &DesignChoice, watch: &Watch) -> Result<Design, DesignError> {
    let asked = conditions(model, choice, &tolerance()).unwrap();
    design(model, choice, &asked, &tolerance(), watch)
}

#[test]
fn any_executor_gives_the_same_design() {
    let model = ring(4);
    let choice = choice(Order::Reduced, LmiChoice::default());
    let sequential = designed(&model, &choice, &Watch::none()).unwrap();
    assert!(sequential.verification.verified(), "{:#?}", sequential.verification.checks);
    assert_eq!(sequential.observer.P.nrows(), 12, "all states are estimated");
    let threads = Watch::none().on(descry::platform::native::Threads);
    assert_eq!(
        designed(&model, &choice, &threads).unwrap(),
        sequential,
        "the same numbers, whoever computed them"
    );
    // each subsystem alone gives the same result: they are independent
    let problems = local_problems(&model).unwrap();
    let all = design_subsystems(&problems, &choice, &tolerance(), &Watch::none()).unwrap();
    for (number, outcome) in all.into_iter().enumerate() {
        let one = design_local(&problems[number], number, &choice, &tolerance(), &Watch::none()).unwrap();
        let (Outcome::Verified(together), Outcome::Verified(alone)) = (outcome.unwrap(), one) else {
            panic!("subsystem {number} is designed")
        };
        assert_eq!(together.matrices, alone.matrices, "subsystem {number}");
    }
}

#[test]
fn a_cancelled_design_ends_and_tells_how_far_it_was() {
    let fractions = std::sync::Arc::new(std::sync::Mutex::new(Vec::new()));
    let heard = std::sync::Arc::clone(&fractions);
    let watch = Watch::new(move |fraction, what| {
        heard.lock().unwrap().push((fraction, what.to_owned()));
        fraction < 0.6
    });
    let outcome = designed(&ring(2), &choice(Order::Reduced, LmiChoice::default()), &watch);
    assert_eq!(outcome.unwrap_err(), DesignError::Cancelled, "the watch says stop in the second subsystem");
    let heard = fractions.lock().unwrap();
    assert!(heard.windows(2).all(|pair| pair[0].0 <= pair[1].0), "progress only grows");
    assert!(heard.iter().any(|(_, what)| what.starts_with("part 1: ")), "the subsystem is named");
}

#[test]
fn a_partition_that_does_not_fit_is_a_failed_condition() {
    let good = ring(2);
    let refused = |model: &Model, lmi: LmiChoice, message: &str| {
        let choice = choice(Order::Reduced, lmi);
        let asked = conditions(model, &choice, &tolerance()).unwrap();
        assert_eq!((asked.len(), asked[0].verdict), (1, Verdict::Fails), "{asked:#?}");
        assert!(asked[0].summary.contains(message), "{}", asked[0].summary);
        let error = design(model, &choice, &asked, &tolerance(), &Watch::none()).unwrap_err();
        assert!(matches!(&error, DesignError::Condition { id, .. } if id == "000-partition"), "{error}");
    };
    let mut coupled = good.clone();
    coupled.system.C[(0, 3)] = 1.0;
    refused(&coupled, LmiChoice::default(), "C[1, 4] = 1 couples subsystem 1 with subsystem 2");
    let mut short = good.clone();
    short.partition.pop();
    refused(&short, LmiChoice::default(), "3 states together, but the system has 6");
    let mut empty = good.clone();
    empty.partition.push(Subsystem { name: "nobody".to_owned(), ..Subsystem::default() });
    refused(&empty, LmiChoice::default(), "subsystem 3 (nobody) has no states");
    let whole = LmiChoice { rows: vec![unit(3)], ..LmiChoice::default() };
    refused(&good, whole, "R is given for 1 subsystems, but there are 2");
    let lists = LmiChoice { decoupled: Some(vec![Vec::new(); 3]), ..LmiChoice::default() };
    refused(&good, lists, "the list of decoupled states is given for 3 subsystems, but there are 2");
}

#[test]
fn a_subsystem_without_outputs_is_refused_by_its_conditions() {
    let mut silent = ring(2);
    silent.system.C = silent.system.C.rows(0, 2).into_owned();
    silent.partition[1].outputs = 0;
    let choice =
        choice(Order::Full, LmiChoice { decoupled: Some(vec![vec![3], vec![0]]), ..LmiChoice::default() });
    let asked = conditions(&silent, &choice, &tolerance()).unwrap();
    let failed: Vec<&str> =
        asked.iter().filter(|c| c.verdict == Verdict::Fails).map(|c| c.name.as_str()).collect();
    assert!(failed.contains(&"unknown couplings can be decoupled (part 2)"), "{failed:?}");
    let error = design(&silent, &choice, &asked, &tolerance(), &Watch::none()).unwrap_err();
    assert!(matches!(error, DesignError::Condition { .. }), "{error}");
}

#[test]
fn a_subsystem_that_is_too_large_is_told_so() {
    let n = 40;
    let A = DMatrix::from_fn(n, n, |i, j| if i == j { -1.0 - i as f64 } else { 0.0 });
    let large = problem(unit(n), A, unit(n).rows(0, 1).into_owned(), DMatrix::from_element(n, 1, 1.0));
    let outcome = local(&large, &choice(Order::Full, attenuate_all()));
    let Outcome::GaveUp(why) = outcome else { panic!("it is beyond the limit: {outcome:#?}") };
    assert!(why.contains("the limit is 1500") && why.contains("subsystem one"), "{why}");
}
