//! The phases of `lmi` against norms from frequency responses, spectra and closed forms.
#![cfg(not(target_arch = "wasm32"))]
#![expect(clippy::unwrap_used, reason = "helpers of tests, which clippy takes for library code")]

use std::sync::{Arc, Mutex};

use descry::lmi::{Expr, Problem, Settings, Stop, feasible, minimise, optimum};
use descry::numerics::Block::Of;
use descry::numerics::{Complex64, Random, Watch, block_matrix, complex_svd, eigenvalues};
use nalgebra::{DMatrix, DVector};

/// A plant `(A, B, C)`.
struct Plant {
    a: DMatrix<f64>,
    b: DMatrix<f64>,
    c: DMatrix<f64>,
}

fn random_matrix(random: &mut Random, rows: usize, columns: usize) -> DMatrix<f64> {
    DMatrix::from_fn(rows, columns, |_, _| random.normal())
}

fn abscissa(a: &DMatrix<f64>) -> f64 {
    eigenvalues(a).unwrap().iter().map(|z| z.re).fold(f64::NEG_INFINITY, f64::max)
}

fn radius(a: &DMatrix<f64>) -> f64 {
    eigenvalues(a).unwrap().iter().map(|z| z.norm()).fold(0.0, f64::max)
}

/// Random with spectral abscissa `-margin`.
fn plant(seed: u64, n: usize, margin: f64) -> Plant {
    let mut random = Random::new(seed);
    let a = random_matrix(&mut random, n, n);
    let shift = abscissa(&a) + margin;
    Plant {
        a: a - DMatrix::identity(n, n) * shift,
        b: random_matrix(&mut random, n, 2),
        c: random_matrix(&mut random, 2, n),
    }
}

/// Random with spectral radius `radius`.
fn discrete_plant(seed: u64, n: usize, wanted: f64) -> Plant {
    let mut plant = plant(seed, n, 0.5);
    let factor = wanted / radius(&plant.a);
    plant.a *= factor;
    plant
}

impl Plant {
    /// The same plant in the states `T x`.
    fn in_units(&self, t: &DVector<f64>) -> Self {
        let (scale, back) = (DMatrix::from_diagonal(t), DMatrix::from_diagonal(&t.map(|x| 1.0 / x)));
        Self { a: &scale * &self.a * &back, b: &scale * &self.b, c: &self.c * &back }
    }

    /// Largest singular value of `C (point I - A)^-1 B`.
    fn gain(&self, point: Complex64) -> f64 {
        let n = self.a.nrows();
        let complex = |m: &DMatrix<f64>| m.map(Complex64::from);
        let resolvent = DMatrix::from_diagonal_element(n, n, point) - complex(&self.a);
        let response = complex(&self.c) * resolvent.lu().solve(&complex(&self.b)).unwrap();
        complex_svd(&response).unwrap().s[0]
    }

    /// Largest gain along a path, by a fine grid and golden sections around its best points.
    fn peak(&self, path: impl Fn(f64) -> Complex64, from: f64, to: f64) -> f64 {
        const GRID: usize = 1000;
        let step = (to - from) / GRID as f64;
        let gains: Vec<f64> = (0..=GRID).map(|k| self.gain(path(from + step * k as f64))).collect();
        let best = gains.iter().copied().fold(0.0, f64::max);
        let near = (0..=GRID).filter(|k| gains[*k] > 0.98 * best);
        let refine = |k: usize| {
            let (mut low, mut high) = (from + step * (k as f64 - 1.0), from + step * (k as f64 + 1.0));
            for _ in 0..40 {
                let (p, q) = (high - 0.618 * (high - low), low + 0.618 * (high - low));
                if self.gain(path(p)) > self.gain(path(q)) { high = q } else { low = p }
            }
            self.gain(path(0.5 * (low + high)))
        };
        near.map(refine).fold(best, f64::max)
    }

    fn norm(&self) -> f64 {
        let at_zero = self.gain(Complex64::from(0.0));
        at_zero.max(self.peak(|log| Complex64::new(0.0, 10.0_f64.powf(log)), -3.0, 3.0))
    }

    fn discrete_norm(&self) -> f64 {
        self.peak(|angle| Complex64::from_polar(1.0, angle), 0.0, std::f64::consts::PI)
    }

    /// `[A'X + XA + C'C, XB; B'X, -g I] < 0`, `X > 0`; gives the problem and `g`, the square of the norm.
    fn bounded_real(&self) -> (Problem, Expr, Expr) {
        let mut problem = Problem::new();
        let x = problem.symmetric("X", self.a.nrows());
        let g = problem.scalar("gamma^2");
        let lemma = Expr::symmetric(vec![
            vec![(&x * &self.a).he() + Expr::constant(&self.c.tr_mul(&self.c)), &x * &self.b],
            vec![-g.times(&DMatrix::identity(self.b.ncols(), self.b.ncols()))],
        ]);
        problem.strict("bounded real lemma", "test", -lemma);
        problem.strict("X > 0", "test", x.clone());
        (problem, g, x)
    }

    /// The same in discrete time: `[X, 0, XA, XB; ., I, C, 0; ., ., X, 0; ., ., ., g I] > 0`.
    fn discrete_bounded_real(&self) -> (Problem, Expr) {
        let (n, inputs, outputs) = (self.a.nrows(), self.b.ncols(), self.c.nrows());
        let mut problem = Problem::new();
        let x = problem.symmetric("X", n);
        let g = problem.scalar("gamma^2");
        let lemma = Expr::symmetric(vec![
            vec![x.clone(), Expr::zeros(n, outputs), &x * &self.a, &x * &self.b],
            vec![Expr::identity(outputs), Expr::constant(&self.c), Expr::zeros(outputs, inputs)],
            vec![x.clone(), Expr::zeros(n, inputs)],
            vec![g.times(&DMatrix::identity(inputs, inputs))],
        ]);
        problem.strict("bounded real lemma", "test", lemma);
        (problem, g)
    }
}

fn settings() -> Settings {
    Settings { most_rows: 400, ..Settings::default() }
}

/// Smallest eigenvalue of a symmetric matrix.
fn smallest(matrix: &DMatrix<f64>) -> f64 {
    eigenvalues(matrix).unwrap().iter().map(|z| z.re).fold(f64::INFINITY, f64::min)
}

/// `-(A'P + PA) > 0`, `P > 0`.
fn lyapunov(a: &DMatrix<f64>) -> (Problem, Expr) {
    let mut problem = Problem::new();
    let p = problem.symmetric("P", a.nrows());
    problem.strict("Lyapunov", "test", -(&p * a).he());
    problem.strict("P > 0", "test", p.clone());
    (problem, p)
}

fn relative(found: f64, truth: f64) -> f64 {
    (found / truth - 1.0).abs()
}

#[test]
fn lyapunov_inequality_decides_stability_on_both_sides_of_the_boundary() {
    for (n, margin) in [(2, 1.0), (4, 1e-2), (4, 1e-5), (6, 1e-5)] {
        let a = plant(n as u64, n, margin).a;
        let (problem, p) = lyapunov(&a);
        let found = feasible(&problem, &settings()).unwrap();
        let p = found.point.value(&p);
        let decay = -(&p * &a + a.tr_mul(&p));
        assert!(found.margin > 0.0, "n = {n}, abscissa -{margin}: margin {}", found.margin);
        assert!(
            smallest(&p) > 0.0 && smallest(&decay) > 0.0,
            "n = {n}, abscissa -{margin}: the point does not hold"
        );

        let unstable = plant(n as u64, n, -margin).a;
        let stop = feasible(&lyapunov(&unstable).0, &settings()).unwrap_err();
        assert!(matches!(stop, Stop::Infeasible { .. }), "n = {n}, abscissa +{margin}: {stop}");
    }
}

#[test]
fn least_trace_solution_is_that_of_the_lyapunov_equation() {
    // A'P + PA + I <= 0 with the least trace of P holds with equality: 2 a p + 1 = 0 for each mode of a diagonal A
    let modes = [0.5, 1.0, 4.0];
    let a = DMatrix::from_diagonal(&DVector::from_iterator(3, modes.iter().map(|x| -x)));
    let mut problem = Problem::new();
    let p = problem.symmetric("P", 3);
    problem.strict("Lyapunov", "test", -(&p * &a).he() - Expr::identity(3));
    let found = optimum(&problem, &p.trace(), &settings()).unwrap();
    let truth: f64 = modes.iter().map(|x| 0.5 / x).sum();
    assert!(relative(found.optimum.unwrap(), truth) < 1e-7, "trace {:?}, truth {truth}", found.optimum);
    let p = found.point.value(&p);
    for (i, mode) in modes.iter().enumerate() {
        assert!((p[(i, i)] - 0.5 / mode).abs() < 1e-5, "P is diag(1 / 2a), found {p}");
    }
}

#[test]
fn bounded_real_lemma_finds_the_norm() {
    for (n, seed, margin) in [(2, 0, 0.3), (4, 2, 0.3), (4, 3, 0.01), (6, 4, 0.3)] {
        let plant = plant(seed, n, margin);
        let (truth, (problem, g, x)) = (plant.norm(), plant.bounded_real());
        let found = minimise(&problem, &g, &settings()).unwrap();
        let (best, gamma) = (found.optimum.unwrap().sqrt(), found.objective.unwrap());
        assert!(relative(best, truth) < 1e-6, "n = {n}, margin {margin}: {best}, truth {truth}");
        let stepped = gamma / found.optimum.unwrap();
        assert!(
            (1.0..1.0101).contains(&stepped),
            "n = {n}: one per cent back from the optimum, not {stepped}"
        );
        assert!(found.margin > 1e-5, "n = {n}: margin {} behind the optimum", found.margin);
        let x = found.point.value(&x);
        let lemma = block_matrix(&[
            &[Of(&(&x * &plant.a + plant.a.tr_mul(&x) + plant.c.tr_mul(&plant.c))), Of(&(&x * &plant.b))],
            &[Of(&plant.b.tr_mul(&x)), Of(&(DMatrix::identity(2, 2) * -gamma))],
        ]);
        assert!(smallest(&-lemma) > 0.0 && smallest(&x) > 0.0, "n = {n}: the point does not hold");
    }
}

#[test]
fn discrete_bounded_real_lemma_finds_the_norm() {
    for (n, seed) in [(2, 0), (3, 1), (4, 2)] {
        let plant = discrete_plant(seed, n, 0.9);
        let (truth, (problem, g)) = (plant.discrete_norm(), plant.discrete_bounded_real());
        let best = optimum(&problem, &g, &settings()).unwrap().optimum.unwrap().sqrt();
        assert!(relative(best, truth) < 1e-6, "n = {n}: {best}, truth {truth}");
    }
}

/// Unbalanced, the solver is useless from a spread of 1e4 on.
#[test]
fn units_of_the_states_do_not_matter() {
    let plant = plant(2, 4, 0.3);
    let truth = plant.norm();
    for decades in [4.0, 10.0] {
        let units = DVector::from_fn(4, |i, _| 10.0_f64.powf(decades * i as f64 / 3.0));
        let (problem, g, _) = plant.in_units(&units).bounded_real();
        let found = minimise(&problem, &g, &settings()).unwrap();
        let best = found.optimum.unwrap().sqrt();
        assert!(relative(best, truth) < 1e-6, "spread 1e{decades}: {best}, truth {truth}");
        assert!(found.margin > 1e-5, "spread 1e{decades}: margin {}", found.margin);
    }
}

/// Unbalanced, gamma comes out 17 times too large: the solver's gap is absolute.
#[test]
fn units_of_inputs_and_outputs_do_not_matter() {
    let plant = plant(4, 4, 0.3);
    let truth = plant.norm();
    for (input, output) in [(1e-4, 1e-3), (1e6, 1e5), (1e-12, 1.0)] {
        let other = Plant { a: plant.a.clone(), b: &plant.b * input, c: &plant.c * output };
        let (problem, g, _) = other.bounded_real();
        let best = optimum(&problem, &g, &settings()).unwrap().optimum.unwrap().sqrt();
        let truth = truth * input * output;
        assert!(relative(best, truth) < 1e-6, "B * {input}, C * {output}: {best}, truth {truth}");
    }
}

#[test]
fn a_norm_is_decided_next_to_the_boundary() {
    const OFF: f64 = 1e-5;
    for (n, seed) in [(2, 0), (4, 2), (4, 4), (6, 4)] {
        let plant = plant(seed, n, 0.3);
        let truth = plant.norm();
        for (factor, holds) in [(1.0 - OFF, false), (1.0 + OFF, true), (0.9, false), (1.1, true)] {
            let (mut problem, g, _) = plant.bounded_real();
            let level = (factor * truth).powi(2);
            problem.bound("gamma given", "test", Expr::constant(&DMatrix::from_element(1, 1, level)) - g);
            match feasible(&problem, &settings()) {
                Ok(found) => assert!(holds, "n = {n}: {factor} of the norm with margin {}", found.margin),
                Err(Stop::Infeasible { block, margin, .. }) => {
                    assert!(!holds, "n = {n}: {factor} of the norm is feasible, margin {margin}");
                    assert_eq!(block, "bounded real lemma", "n = {n}: the block that stops it");
                }
                Err(stop) => panic!("n = {n}, factor {factor}: {stop}"),
            }
        }
    }
}

#[test]
fn the_blocking_block_is_the_one_that_cannot_hold() {
    let mut problem = Problem::new();
    let x = problem.scalar("x");
    problem.strict("easy", "equation 1", x.clone() + Expr::constant(&DMatrix::from_element(1, 1, 1e3)));
    problem.strict("at least two", "equation 2", x.clone() - Expr::identity(1).scaled(2.0));
    problem.bound("at most one", "equation 3", Expr::identity(1) - x);
    let Err(Stop::Infeasible { block, source, margin }) = feasible(&problem, &settings()) else {
        panic!("x >= 2 and x <= 1");
    };
    assert_eq!((block.as_str(), source.as_str()), ("at least two", "equation 2"), "the block that stops it");
    assert!(margin < -0.1, "margin {margin}");
}

#[test]
fn contradicting_bounds_are_named() {
    let mut problem = Problem::new();
    let x = problem.symmetric("X", 2);
    problem.bound("X >= 2 I", "lower", &x - Expr::identity(2).scaled(2.0));
    problem.bound("X <= I", "upper", Expr::identity(2) - &x);
    problem.strict("X > 0", "sign", x);
    let Err(Stop::Infeasible { source, margin, .. }) = feasible(&problem, &settings()) else {
        panic!("no X is above 2 I and below I");
    };
    assert!(source == "lower" || source == "upper", "{source} is not one of the two that contradict");
    assert!(margin < 0.0, "margin {margin}");
}

#[test]
fn an_objective_without_lower_bound_is_said_to_have_none() {
    let a = plant(1, 3, 0.5).a;
    let (problem, p) = lyapunov(&a);
    let Err(Stop::GaveUp(why)) = minimise(&problem, &-p.trace(), &settings()) else {
        panic!("the trace has no upper bound");
    };
    assert!(why.contains("no lower bound"), "{why}");
}

#[test]
fn an_objective_that_is_not_positive_is_backed_off_upwards() {
    let mut problem = Problem::new();
    let x = problem.scalar("x");
    problem.strict("x > -5", "test", x.clone() + Expr::identity(1).scaled(5.0));
    let found = minimise(&problem, &x, &settings()).unwrap();
    assert!((found.optimum.unwrap() + 5.0).abs() < 1e-6, "least value {:?}", found.optimum);
    let objective = found.objective.unwrap();
    assert!((-5.0..=-4.949).contains(&objective) && found.margin > 0.0, "backed off to {objective}");

    let mut problem = Problem::new();
    let x = problem.scalar("x");
    problem.strict("x > 0", "test", x.clone());
    let found = minimise(&problem, &x, &settings()).unwrap();
    assert!(found.optimum.unwrap().abs() < 1e-6, "least value {:?}", found.optimum);
    assert!(found.objective.unwrap() > 0.0 && found.margin > 0.0, "backed off to {:?}", found.objective);
}

#[test]
fn numbers_that_are_not_finite_are_named() {
    for bad in [f64::NAN, f64::INFINITY] {
        let mut problem = Problem::new();
        let x = problem.symmetric("X", 2);
        problem.strict("fine", "equation 1", x.clone());
        problem.strict("spoiled", "equation 2", (&x * DMatrix::from_element(2, 2, bad)).he());
        let Err(Stop::GaveUp(why)) = feasible(&problem, &settings()) else { panic!("{bad} was accepted") };
        assert!(why.contains("spoiled (equation 2)") && why.contains("not finite"), "{why}");
    }
}

#[test]
fn extreme_but_finite_numbers_do_no_harm() {
    for size in [1e150, 1e300, 1e-300] {
        let a = plant(3, 3, 0.5).a;
        let (problem, _) = lyapunov(&(a * size));
        let ended = feasible(&problem, &settings());
        assert!(ended.is_ok(), "stable in any unit of time, A * {size}: {ended:?}");
    }
    let mut a = plant(3, 3, 0.5).a;
    a[(0, 0)] = -1e300;
    let Err(Stop::GaveUp(why)) = feasible(&lyapunov(&a).0, &settings()) else { panic!("1e300 among ones") };
    assert!(why.contains("far larger"), "{why}");
}

#[test]
fn a_problem_beyond_the_limit_is_refused_with_both_numbers() {
    let (problem, _) = lyapunov(&DMatrix::from_diagonal_element(8, 8, -1.0));
    let few = Settings { most_rows: 71, ..settings() };
    let Err(Stop::GaveUp(why)) = feasible(&problem, &few) else { panic!("72 rows with a limit of 71") };
    assert!(why.contains("72 rows") && why.contains("limit is 71"), "{why}");
    assert!(
        feasible(&problem, &Settings { most_rows: 72, ..settings() }).is_ok(),
        "72 rows with a limit of 72"
    );
}

#[test]
fn a_solve_is_cancelled_at_its_second_iteration() {
    let heard = Arc::new(Mutex::new(Vec::new()));
    let ear = Arc::clone(&heard);
    let watch = Watch::new(move |fraction, text| {
        ear.lock().unwrap().push((fraction, text.to_owned()));
        !text.contains("iteration 2")
    });
    let (problem, g, _) = plant(0, 4, 0.3).bounded_real();
    let stop = minimise(&problem, &g, &Settings { watch, ..settings() }).unwrap_err();
    assert_eq!(stop, Stop::Cancelled, "the watch said stop");
    let heard = heard.lock().unwrap();
    assert!(
        heard.len() == 3 && heard[2].1.starts_with("largest margin: iteration 2, gap "),
        "heard {heard:?}"
    );
}

#[test]
fn progress_runs_from_phase_to_phase() {
    let heard = Arc::new(Mutex::new(Vec::new()));
    let ear = Arc::clone(&heard);
    let watch = Watch::new(move |fraction, text| {
        ear.lock().unwrap().push((fraction, text.to_owned()));
        true
    });
    let (problem, g, _) = plant(0, 4, 0.3).bounded_real();
    minimise(&problem, &g, &Settings { watch, ..settings() }).unwrap();
    let heard = heard.lock().unwrap();
    let first = |phase: &str| heard.iter().position(|(_, text)| text.starts_with(phase)).unwrap();
    let order =
        [first("largest margin:"), first("least gamma^2:"), first("largest margin near the optimum:")];
    assert!(order.is_sorted(), "phases begin at {order:?}");
    assert!(heard.iter().all(|(fraction, _)| (0.0..=1.0).contains(fraction)), "fractions within the whole");
    assert!(heard.last().unwrap().0 > 0.9, "the last report is near the end: {:?}", heard.last());
}

#[test]
fn without_time_the_limit_is_named() {
    for seconds in [0.0, -1.0, f64::NAN, 1e-9] {
        let (problem, g, _) = plant(0, 4, 0.3).bounded_real();
        let Err(Stop::GaveUp(why)) = minimise(&problem, &g, &Settings { seconds, ..settings() }) else {
            panic!("solved in {seconds} s");
        };
        assert!(why.contains("time limit"), "{why}");
    }
}

#[test]
fn empty_blocks_and_variables_change_nothing() {
    let plant = plant(0, 2, 0.3);
    let (problem, g, _) = plant.bounded_real();
    let plain = optimum(&problem, &g, &settings()).unwrap();
    let (mut problem, g, x) = plant.bounded_real();
    let gain = problem.matrix("W", 2, 0);
    problem.bound("gain", "test", Expr::symmetric(vec![vec![Expr::zeros(0, 0), gain.transpose()], vec![x]]));
    problem.strict("nothing", "test", Expr::zeros(0, 0));
    let found = optimum(&problem, &g, &settings()).unwrap();
    assert!(relative(found.optimum.unwrap(), plain.optimum.unwrap()) < 1e-6, "{found:?} against {plain:?}");
    assert_eq!(found.point.value(&gain).shape(), (2, 0), "an empty variable has an empty value");
}

#[test]
fn problems_without_variables_are_decided() {
    for (value, holds) in [(1e-3, true), (-1e-3, false)] {
        let mut problem = Problem::new();
        let block = DMatrix::from_diagonal(&DVector::from_vec(vec![1.0, value]));
        problem.strict("constant", "test", Expr::constant(&block));
        let ended = minimise(&problem, &Expr::identity(1), &settings());
        assert_eq!(ended.is_ok(), holds, "diag(1, {value}) > 0: {ended:?}");
    }
    let empty = feasible(&Problem::new(), &settings()).unwrap();
    assert!(empty.margin > 0.0, "nothing is demanded, nothing is violated");
}

/// The equality hidden in `[0, x - 1; x - 1, 1] >= 0` leaves no interior; it must end in words, not in a wrong answer.
#[test]
fn a_problem_without_interior_ends_in_words() {
    let mut problem = Problem::new();
    let x = problem.scalar("x");
    let off = &x - Expr::identity(1);
    problem.strict(
        "hidden equality",
        "test",
        Expr::symmetric(vec![vec![Expr::zeros(1, 1), off], vec![Expr::identity(1)]]),
    );
    match feasible(&problem, &settings()) {
        Err(Stop::Infeasible { block, margin, .. }) => {
            assert!(block == "hidden equality" && margin <= 1e-7, "margin {margin}");
        }
        Err(Stop::GaveUp(_)) => {}
        other => panic!("{other:?}"),
    }
}
