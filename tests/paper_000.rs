//! Paper 000 (decentralized observers): conditions, designs and trajectories against the reference numbers.
#![expect(clippy::unwrap_used, clippy::panic, reason = "helpers of tests fail by panicking")]
#![expect(non_snake_case, reason = "matrix letters of the paper")]

use descry::document::read_document;
use descry::lmi::Outcome;
use descry::numerics::{Complex64, Tolerance, Watch, rank};
use descry::observer::decentralized::{
    Decoupled, Local, LocalMatrices, LocalProblem, Parameterisation, Setup, assumption_1, certify, chosen,
    conditions, design, design_local, greedy, local_problems, strong_detectability,
};
use descry::observer::{
    Condition, Design, DesignChoice, DesignError, LinearObserver, LmiChoice, Method, Order, Verdict,
};
use descry::simulation::Trajectory;
use descry::system::{Model, TimeDomain};
use nalgebra::{DMatrix, dmatrix};
use serde_json::Value;

const ORDERS: [(&str, Order); 3] =
    [("full", Order::Full), ("reduced", Order::Reduced), ("minimal", Order::Minimal)];

fn tolerance() -> Tolerance {
    Tolerance::default()
}

fn reference(time: TimeDomain) -> Value {
    let text = match time {
        TimeDomain::Continuous => include_str!("reference/ex000_continuous.json"),
        TimeDomain::Discrete => include_str!("reference/ex000_discrete.json"),
    };
    serde_json::from_str(text).unwrap()
}

const TIMES: [TimeDomain; 2] = [TimeDomain::Continuous, TimeDomain::Discrete];

fn matrix(value: &Value) -> DMatrix<f64> {
    let rows: Vec<Vec<f64>> = serde_json::from_value(value.clone()).unwrap();
    let columns = rows.first().map_or(0, Vec::len);
    DMatrix::from_row_iterator(rows.len(), columns, rows.into_iter().flatten())
}

/// The composite plant of section V, from the document.
fn model(time: TimeDomain) -> Model {
    let document = read_document(include_str!("documents/000-partition.json")).unwrap();
    let mut model = document.model().unwrap();
    model.system.time = time;
    model
}

fn problems(time: TimeDomain) -> Vec<LocalProblem> {
    local_problems(&model(time)).unwrap()
}

/// The well-posed problem with the demands of the reference.
fn demands(reference: &Value) -> LmiChoice {
    let posed = &reference["well_posed_problem"];
    LmiChoice {
        decay: posed["decay"].as_f64(),
        gain: posed["gain"].as_f64(),
        conditioning: posed["kappa"].as_f64().unwrap(),
        // the paper's choice: x4 is decoupled from subsystem 1, x1 from subsystem 2
        decoupled: Some(vec![vec![3], vec![0]]),
        ..LmiChoice::default()
    }
}

fn choice(order: Order, lmi: LmiChoice) -> DesignChoice {
    DesignChoice { method: Method::Decentralized, order, lmi, ..DesignChoice::default() }
}

fn local(problem: &LocalProblem, number: usize, choice: &DesignChoice) -> Outcome<Local> {
    design_local(problem, number, choice, &tolerance(), &Watch::none()).unwrap()
}

fn verified(outcome: Outcome<Local>) -> Local {
    match outcome {
        Outcome::Verified(local) => local,
        other => panic!("expected a verified design, found {other:#?}"),
    }
}

fn close(found: &DMatrix<f64>, expected: &DMatrix<f64>, limit: f64, what: &str) {
    assert_eq!(found.shape(), expected.shape(), "{what}: shape");
    let error = (found - expected).norm() / expected.norm().max(1.0);
    assert!(error <= limit, "{what}: difference {error:.2e}\nfound {found}expected {expected}");
}

#[test]
fn the_document_holds_the_reference_s_subsystems() {
    for time in TIMES {
        let reference = reference(time);
        for (number, problem) in problems(time).iter().enumerate() {
            let expected = &reference["subsystems"][number];
            for (name, found) in [("E", &problem.E), ("A", &problem.A), ("B", &problem.B), ("H", &problem.H)]
            {
                assert_eq!(*found, matrix(&expected[name]), "{name} of {}", problem.name);
            }
            let decoupled = Decoupled::new(problem, &[0], &tolerance()).unwrap();
            assert_eq!(decoupled.D1, matrix(&expected["D1"]), "D1 of {}", problem.name);
            assert_eq!(decoupled.D2, matrix(&expected["D2"]), "D2 of {}", problem.name);
            assert_eq!(decoupled.Phi, matrix(&expected["Phi"]), "Phi of {}", problem.name);
        }
    }
}

#[test]
fn ranks_and_zeros_are_those_of_the_reference() {
    for time in TIMES {
        let reference = reference(time);
        for (number, problem) in problems(time).iter().enumerate() {
            let expected = &reference["subsystems"][number];
            let ranks = &expected["assumption1"];
            let found = assumption_1(problem, &[0], &tolerance()).unwrap();
            assert!(found.holds() && !found.fragile(), "{found:?}");
            assert_eq!(Some(found.decision.rank as u64), ranks["rank_big"].as_u64(), "rank");
            assert_eq!(Some(found.needed as u64), ranks["need"].as_u64(), "n + rank D1");
            assert_eq!(Some(found.of_columns.rank as u64), ranks["rank_D1"].as_u64(), "rank D1");
            let decoupled = Decoupled::new(problem, &[0], &tolerance()).unwrap();
            let theta = rank(&decoupled.theta(), 0.0, &tolerance()).unwrap();
            assert_eq!(Some(theta.rank as u64), ranks["rank_theta"].as_u64(), "Lemma 1");
            let smallest = ranks["sv_theta_min"].as_f64().unwrap();
            assert!((theta.smallest() - smallest).abs() < 1e-12, "singular value of Theta");
            let zeros = strong_detectability(problem, &[0], &tolerance()).unwrap();
            assert_eq!(Some(zeros.holds()), expected["strongly_detectable"].as_bool(), "{zeros:?}");
            let expected: Vec<[f64; 2]> = serde_json::from_value(expected["finite_zeros"].clone()).unwrap();
            assert_eq!(zeros.modes.len(), expected.len(), "number of zeros");
            for (mode, [re, im]) in zeros.modes.iter().zip(expected) {
                assert!((mode.s - Complex64::new(re, im)).norm() < 1e-12, "{}", mode.s);
            }
        }
    }
}

#[test]
fn the_parameterisation_is_the_reference_s() {
    for time in TIMES {
        let reference = reference(time);
        for (number, problem) in problems(time).iter().enumerate() {
            let decoupled = Decoupled::new(problem, &[0], &tolerance()).unwrap();
            for (key, order) in ORDERS {
                let expected = &reference["subsystems"][number]["orders"][key];
                let what = |name: &str| format!("{name} of {} ({key})", problem.name);
                let R = chosen(&decoupled, order, &tolerance()).unwrap();
                assert_eq!(R, matrix(&expected["R"]), "{}", what("R"));
                let family = Parameterisation::paper(&decoupled, &R, &tolerance()).unwrap();
                let count = |name: &str| usize::try_from(expected[name].as_u64().unwrap()).unwrap();
                let omega = family.omega();
                assert_eq!(family.order(), count("beta"), "{}", what("beta"));
                assert_eq!(omega.nrows(), count("Omega_rows"), "{}", what("rows of Omega"));
                assert_eq!(rank(omega, 0.0, &tolerance()).unwrap().rank, count("rank_Omega"), "rank Omega");
                let L = family.left_null_of_omega();
                assert_eq!(L.nrows(), count("free_columns"), "{}", what("free columns"));
                close(
                    &(L.transpose() * L),
                    &matrix(&expected["projector_I_minus_OmOmp"]),
                    1e-12,
                    &what("L'L"),
                );
                let (J, F) = family.lambda_output(&decoupled);
                let compared = [
                    ("Tbar", family.t_bar()),
                    ("LambdaN", &family.Lambda_N),
                    ("LambdaPsi", &family.Lambda_Psi),
                    ("LambdaJ", &J),
                    ("LambdaP", &family.Lambda_P),
                    ("LambdaQ", &family.Lambda_Q),
                    ("LambdaF", &F),
                ];
                for (name, found) in compared {
                    close(found, &matrix(&expected[name]), 1e-12, &what(name));
                }
                close(&(family.t_bar() * &decoupled.Pi), &matrix(&expected["T_prime"]), 1e-12, &what("T'"));
            }
        }
    }
}

#[test]
fn every_order_has_the_invariant_zero_as_its_fixed_mode() {
    for time in TIMES {
        for (number, problem) in problems(time).iter().enumerate() {
            for (key, order) in ORDERS {
                let expected = &reference(time)["subsystems"][number]["orders"][key];
                let choice = choice(order, demands(expected));
                let setup = Setup::new(problem, number, &choice, &tolerance()).unwrap();
                let modes: Vec<[f64; 2]> = serde_json::from_value(expected["fixed_modes"].clone()).unwrap();
                assert_eq!(setup.fixed_modes.len(), modes.len(), "{key}: {:?}", setup.fixed_modes);
                for (found, [re, im]) in setup.fixed_modes.iter().zip(modes) {
                    assert!((found - Complex64::new(re, im)).norm() < 1e-12, "{key}: {found}");
                    let limit = if time == TimeDomain::Discrete { re.abs() } else { -re };
                    assert!((setup.fastest_decay().unwrap() - limit).abs() < 1e-12, "{key}: decay limit");
                }
            }
        }
    }
}

#[test]
fn gamma_is_the_reference_s_in_both_time_domains_and_all_orders() {
    for time in TIMES {
        let reference = reference(time);
        for (number, problem) in problems(time).iter().enumerate() {
            let subsystem = &reference["subsystems"][number];
            let exact = subsystem["gamma_infimum_all_orders_exact"].as_f64().unwrap();
            for (key, order) in ORDERS {
                let expected = &subsystem["orders"][key];
                let found = verified(local(problem, number, &choice(order, demands(expected))));
                let best = found.result.gamma_best.unwrap();
                let gamma = expected["well_posed_problem"]["gamma"].as_f64().unwrap();
                let what = format!("{time:?}, {}, {key}: {best}", problem.name);
                assert!((best / gamma - 1.0).abs() < 1e-5, "{what} and reference {gamma}");
                assert!((best / exact - 1.0).abs() < 1e-5, "{what} and exact infimum {exact}");
                let certified = found.result.gamma.unwrap();
                assert!(certified > exact && certified < 1.011 * exact, "{what}: backed off to {certified}");
                assert!(found.result.certificate.proved, "{what}");
                let failed: Vec<_> = found.checks.iter().filter(|check| !check.passed()).collect();
                assert!(failed.is_empty(), "{what}: {failed:#?}");
            }
        }
    }
}

#[test]
fn slightly_above_the_least_gamma_is_feasible_and_slightly_below_is_not() {
    for time in TIMES {
        let reference = reference(time);
        for (number, problem) in problems(time).iter().enumerate() {
            for (key, order) in ORDERS {
                let expected = &reference["subsystems"][number]["orders"][key];
                let gamma = expected["well_posed_problem"]["gamma"].as_f64().unwrap();
                let at = |factor: f64| {
                    let lmi = LmiChoice { gamma: Some(factor * gamma), ..demands(expected) };
                    local(problem, number, &choice(order, lmi))
                };
                let found = verified(at(1.001));
                assert_eq!(found.result.gamma, Some(1.001 * gamma), "{key}: exactly what was asked");
                let Outcome::Infeasible(why) = at(0.999) else { panic!("{key}: 0.999 gamma is infeasible") };
                let nearest = why.nearest.iter().find(|near| near.quantity == "gamma").unwrap();
                assert!((nearest.feasible / gamma - 1.0).abs() < 2e-3, "{key}: {why:?}");
            }
        }
    }
}

fn designed(model: &Model, choice: &DesignChoice) -> Result<Design, DesignError> {
    let asked: Vec<Condition> = conditions(model, choice, &tolerance()).unwrap();
    design(model, choice, &asked, &tolerance(), &Watch::none())
}

#[test]
fn the_composite_observer_is_verified() {
    for time in TIMES {
        let model = model(time);
        for (_, order) in ORDERS {
            let choice = choice(order, LmiChoice::default());
            for condition in conditions(&model, &choice, &tolerance()).unwrap() {
                assert_eq!(condition.verdict, Verdict::Holds, "{}: {}", condition.name, condition.summary);
            }
            let design = designed(&model, &choice).unwrap();
            let failed: Vec<_> = design.verification.failures().collect();
            assert!(design.verification.verified(), "{order:?}: {failed:#?}");
            assert_eq!(design.observer.P.nrows(), 6, "estimates of all states");
            assert!(design.matrix("N (first)").is_some() && design.matrix("F (second)").is_some(), "named");
        }
    }
}

/// The example's couplings come from three states of the other subsystem, counted from one here.
#[test]
fn the_allowed_sets_of_decoupled_columns_are_those_of_the_spec() {
    let allowed: [&[usize]; 4] = [&[], &[1], &[3], &[1, 3]];
    let forbidden: [&[usize]; 4] = [&[2], &[1, 2], &[2, 3], &[1, 2, 3]];
    for problem in problems(TimeDomain::Continuous) {
        let holds = |set: &[usize]| {
            let columns: Vec<usize> = set.iter().map(|j| j - 1).collect();
            assumption_1(&problem, &columns, &tolerance()).unwrap().holds()
        };
        for set in allowed {
            assert!(holds(set), "{}: {set:?} is allowed", problem.name);
        }
        for set in forbidden {
            assert!(!holds(set), "{}: {set:?} is not allowed", problem.name);
        }
        // Remark 1 read literally decouples everything: rank 5 instead of 6
        let literal = assumption_1(&problem, &[0, 1, 2], &tolerance()).unwrap();
        assert_eq!((literal.decision.rank, literal.needed), (5, 6), "{}", problem.name);
        assert_eq!(greedy(&problem, &tolerance()).unwrap(), [0, 2], "{}: the maximal set", problem.name);
        let decoupled = Decoupled::new(&problem, &[0, 2], &tolerance()).unwrap();
        assert_eq!(decoupled.Phi.nrows(), 0, "with it Phi is empty");
    }
}

/// The observers of the closed form with `Q = 0`, which the printed M, J, P and F2 agree with.
fn closed_form(number: usize) -> LocalMatrices {
    let N = if number == 0 { -0.002 } else { -0.0004 };
    LocalMatrices {
        N: dmatrix![N],
        M: if number == 0 { dmatrix![0.0, 0.0, 1.0] } else { dmatrix![0.0, 0.0, 0.0] },
        J: dmatrix![0.0, 0.0],
        P: dmatrix![0.0; 1.0; 0.0],
        Q: DMatrix::zeros(3, 1),
        F: dmatrix![1.0, 0.0; 0.0, 0.0; -1.0, 1.0],
        T: dmatrix![0.0, 1.0, 0.0],
        Psi: dmatrix![0.0],
    }
}

/// The subsystem with the paper's D_i1, reduced order.
fn setup(number: usize, time: TimeDomain) -> Setup {
    let lmi = LmiChoice { decoupled: Some(vec![vec![3], vec![0]]), ..LmiChoice::default() };
    Setup::new(&problems(time)[number], number, &choice(Order::Reduced, lmi), &tolerance()).unwrap()
}

#[test]
fn the_printed_lyapunov_matrices_prove_only_large_gammas() {
    // |Q Phi D2| = 0.003 |(1000/9, -2000/9)| of the printed F1; 1/X1 and 1/X2 with Q = 0
    let printed = LocalMatrices {
        Q: dmatrix![1000.0 / 9.0; 0.0; -2000.0 / 9.0],
        F: dmatrix![2.0 / 3.0, 1.0 / 3.0; 0.0, 0.0; -1.0 / 3.0, 1.0 / 3.0],
        ..closed_form(0)
    };
    for (number, X, matrices, least, what) in [
        (0, 1.3705, printed, 0.74535, "X1 with the printed F1"),
        (0, 1.3705, closed_form(0), 0.72966, "X1 with Q = 0"),
        (1, 2.3705, closed_form(1), 0.42185, "X2 with Q = 0"),
    ] {
        let setup = setup(number, TimeDomain::Discrete);
        let proved = |gamma: f64| certify(&setup, &matrices, &dmatrix![X], gamma).proved;
        assert!(proved(least + 1e-5), "{what}: gamma = {least} + 1e-5 holds");
        assert!(!proved(least - 1e-5), "{what}: gamma = {least} - 1e-5 does not");
    }
    // the closed form reaches the infimum, as does no printed X
    for (number, X, least) in [(0, 500.0, 2.004_008_016_032_064e-3), (1, 1250.0, 8.003_201_280_512_205e-4)] {
        let setup = setup(number, TimeDomain::Discrete);
        let proved = |gamma: f64| certify(&setup, &closed_form(number), &dmatrix![X], gamma).proved;
        assert!(proved(least * 1.0001) && !proved(least * 0.9999), "optimum of subsystem {}", number + 1);
    }
}

fn trajectory(observer: &LinearObserver) -> Trajectory {
    let document = read_document(include_str!("documents/000-partition.json")).unwrap();
    let model = model(TimeDomain::Discrete);
    let scenario = document.scenario(&model.system);
    scenario.run(&model, &[observer.into()], &tolerance(), &Watch::none()).unwrap()
}

fn vector(value: &Value) -> Vec<f64> {
    serde_json::from_value(value.clone()).unwrap()
}

/// Block-diagonal by hand, so that the composite of the program has something to be compared with.
fn closed_form_composite() -> LinearObserver {
    let (first, second) = (closed_form(0), closed_form(1));
    let diagonal = |a: &DMatrix<f64>, b: &DMatrix<f64>| {
        let mut result = DMatrix::zeros(a.nrows() + b.nrows(), a.ncols() + b.ncols());
        result.view_mut((0, 0), a.shape()).copy_from(a);
        result.view_mut(a.shape(), b.shape()).copy_from(b);
        result
    };
    LinearObserver {
        N: diagonal(&first.N, &second.N),
        L: diagonal(&first.J, &second.J),
        H: DMatrix::from_rows(&[first.M.row(0).into_owned(), second.M.row(0).into_owned()]),
        P: diagonal(&first.P, &second.P),
        V: diagonal(&first.F, &second.F),
        W: DMatrix::zeros(6, 3),
        Q: DMatrix::zeros(0, 2),
        R: DMatrix::zeros(0, 4),
        S: DMatrix::zeros(0, 3),
    }
}

#[test]
fn the_trajectory_of_the_reference_is_reproduced() {
    let expected: Value =
        serde_json::from_str(include_str!("reference/ex000_trajectory_discrete.json")).unwrap();
    let found = trajectory(&closed_form_composite());
    for step in ["0", "1", "2", "10", "100"] {
        let k: usize = step.parse().unwrap();
        for (i, x) in vector(&expected["x"][step]).into_iter().enumerate() {
            assert!(
                (found.x[(i, k)] - x).abs() < 1e-12,
                "x{} at step {k}: {} and {x}",
                i + 1,
                found.x[(i, k)]
            );
        }
        for (i, x) in vector(&expected["xhat"][step]).into_iter().enumerate() {
            let estimate = found.observers[0].x_hat[(i, k)];
            assert!((estimate - x).abs() < 1e-12, "x_hat{} at step {k}: {estimate} and {x}", i + 1);
        }
    }
}

#[test]
fn the_designed_observers_converge_to_what_the_couplings_leave() {
    let lmi = LmiChoice { decoupled: Some(vec![vec![3], vec![0]]), decay: Some(0.5), ..LmiChoice::default() };
    let design = designed(&model(TimeDomain::Discrete), &choice(Order::Reduced, lmi)).unwrap();
    assert!(design.verification.verified(), "{:#?}", design.verification.checks);
    let found = trajectory(&design.observer);
    let errors = |k: usize| -> Vec<f64> {
        (0..6).map(|i| found.observers[0].x_hat[(i, k)] - found.x[(i, k)]).collect()
    };
    for k in 2..=100 {
        let e = errors(k);
        // e_i2 is driven by the other x_j2; e_i1, e_i3 by x_j3 through a small Q only
        assert!(e[1].abs() < 1e-7 && e[4].abs() < 5e-5, "step {k}: {e:?}");
        assert!([0, 2, 3, 5].iter().all(|i| e[*i].abs() < 1e-3 * 0.0623), "step {k}: {e:?}");
    }
    assert!(
        (errors(0)[1] + 0.1).abs() < 1e-12 && (errors(0)[4] - 0.1).abs() < 1e-12,
        "start: {:?}",
        errors(0)
    );
}
