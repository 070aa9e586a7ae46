//! Interval arithmetic encloses, and Rump's test proves nothing that exact arithmetic denies.

#[path = "exact/definite.rs"]
mod definite;

use definite::{Exact, exact, positive_definite, rational};
use descry::lmi::certificate::{Interval, IntervalMatrix, lower_bound, proved_positive_definite};
use descry::numerics::Random;
use nalgebra::{DMatrix, DVector, dmatrix};

fn gaussian(random: &mut Random, rows: usize, columns: usize) -> DMatrix<f64> {
    DMatrix::from_fn(rows, columns, |_, _| random.normal())
}

fn product(a: &Exact, b: &Exact) -> Exact {
    let entry =
        |row: &[num_rational::BigRational], j: usize| row.iter().zip(b).map(|(x, other)| x * &other[j]).sum();
    a.iter().map(|row| (0..b[0].len()).map(|j| entry(row, j)).collect()).collect()
}

fn encloses(interval: Interval, value: &num_rational::BigRational) -> bool {
    &rational(interval.low()) <= value && value <= &rational(interval.high())
}

#[test]
fn expressions_enclose_their_exact_value() {
    let mut random = Random::new(1);
    for trial in 0..200 {
        let n = 1 + trial % 5;
        let scale = 10.0_f64.powi([0, 8, -9, 150][trial % 4]);
        let (a, b, c) = (
            gaussian(&mut random, n, 3) * scale,
            gaussian(&mut random, 3, n) / scale,
            gaussian(&mut random, n, n),
        );
        let found =
            (&(&IntervalMatrix::from(&a) * &IntervalMatrix::from(&b)) - &IntervalMatrix::from(&c)).he();
        let exact_product = product(&exact(&a), &exact(&b));
        let c = exact(&c);
        for i in 0..n {
            for j in 0..n {
                let value = &exact_product[i][j] - &c[i][j] + &exact_product[j][i] - &c[j][i];
                let interval = found.at(i, j);
                assert!(encloses(interval, &value), "trial {trial}, entry {i} {j}: {interval:?}");
                assert!(interval.high() - interval.low() < 1e-13, "trial {trial}: tight, {interval:?}");
            }
        }
    }
}

#[test]
fn products_that_underflow_are_enclosed() {
    let (tiny, small) = (Interval::point(1e-200), Interval::point(-1e-200));
    let product = tiny * small;
    assert!(product.low() < 0.0 && product.high() > 0.0, "-1e-400 is not zero: {product:?}");
    assert_eq!((tiny * Interval::ZERO).high(), 0.0, "zero is exact");
}

#[test]
fn what_is_not_a_number_becomes_the_whole_line() {
    for x in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        assert_eq!(Interval::point(x), Interval::ENTIRE, "{x} stands for anything");
    }
    let overflow = Interval::point(1e300) * Interval::point(1e300);
    assert_eq!(overflow.high(), f64::INFINITY, "beyond the largest number");
    assert_eq!(overflow - overflow, Interval::ENTIRE, "infinity minus infinity is unknown");
}

#[test]
fn near_singular_matrices_are_never_proved_falsely() {
    let mut random = Random::new(2);
    let (mut proved, mut definite, mut missed) = (0, 0, 0);
    for trial in 0..400 {
        let n = 2 + trial % 5;
        let factor = gaussian(&mut random, n, n - 1);
        let mut matrix = &factor * factor.transpose();
        // a few roundings above or below singular
        let push = (random.uniform() - 0.4) * 40.0 * f64::EPSILON * matrix.norm();
        for i in 0..n {
            matrix[(i, i)] += push;
        }
        if trial % 3 == 0 {
            // the same verdict in other units
            let units =
                DMatrix::from_diagonal(&DVector::from_fn(n, |i, _| 2.0_f64.powi(20 * (i as i32 - 2))));
            matrix = &units * matrix * &units;
        }
        let matrix = DMatrix::from_fn(n, n, |i, j| matrix[(i.min(j), i.max(j))]);
        let truth = positive_definite(&exact(&matrix));
        let found = proved_positive_definite(&IntervalMatrix::from(&matrix));
        assert!(truth || !found, "trial {trial}: a false proof for {matrix}");
        proved += usize::from(found);
        definite += usize::from(truth);
        missed += usize::from(truth && !found);
    }
    assert!(proved > 80, "{proved} proved of {definite} definite ones: the test is not blind");
    assert!(missed < definite / 2, "{missed} of {definite} are within a few roundings of singular");
}

#[test]
fn a_proof_holds_for_every_matrix_within_the_intervals() {
    let mut random = Random::new(3);
    let mut proved = 0;
    for trial in 0..200 {
        let n = 2 + trial % 4;
        let factor = gaussian(&mut random, n, n);
        let centre = &factor * factor.transpose();
        let radius = 10.0_f64.powi(-(trial as i32 % 6)) * 0.3;
        let wide = IntervalMatrix::from_fn(n, n, |i, j| {
            let x = centre[(i.min(j), i.max(j))];
            Interval::point(x - radius).hull(Interval::point(x + radius))
        });
        if !proved_positive_definite(&wide) {
            continue;
        }
        proved += 1;
        for _ in 0..3 {
            let mut member = DMatrix::zeros(n, n);
            for i in 0..n {
                for j in i..n {
                    let corner =
                        if random.uniform() < 0.5 { wide.at(i, j).low() } else { wide.at(i, j).high() };
                    member[(i, j)] = corner;
                    member[(j, i)] = corner;
                }
            }
            assert!(positive_definite(&exact(&member)), "trial {trial}: the corner {member} is not definite");
        }
    }
    assert!(proved > 60, "only {proved} proofs");
}

#[test]
fn the_lower_bound_is_proved_and_close() {
    let mut random = Random::new(4);
    for trial in 0..60 {
        let n = 1 + trial % 6;
        let q = gaussian(&mut random, n, n).qr().q();
        let smallest = [0.3, 1e-6, -0.7, 50.0][trial % 4];
        let values = DVector::from_fn(n, |i, _| smallest + 2.0 * i as f64);
        let matrix = &q * DMatrix::from_diagonal(&values) * q.transpose();
        let matrix = DMatrix::from_fn(n, n, |i, j| matrix[(i.min(j), i.max(j))]);
        let found = lower_bound(&IntervalMatrix::from(&matrix));
        assert!((found - smallest).abs() < 1e-5 * smallest.abs(), "trial {trial}: {found} for {smallest}");
        let shifted = matrix - DMatrix::identity(n, n) * found;
        let nudged = shifted + DMatrix::identity(n, n) * (1e-15 * smallest.abs().max(1.0) * n as f64);
        assert!(positive_definite(&exact(&nudged)), "trial {trial}: {found} is a lower bound");
        assert_eq!(
            found >= 0.0,
            proved_positive_definite(&IntervalMatrix::from(&(nudged + DMatrix::identity(n, n) * found))),
            "sign"
        );
    }
}

#[test]
fn blocks_of_very_different_size_do_not_hide_each_other() {
    let matrix = dmatrix![1e-200, 0.5; 0.5, 1e200];
    assert!(proved_positive_definite(&IntervalMatrix::from(&matrix)), "determinant 3/4");
    let matrix = dmatrix![1e-200, 1.5; 1.5, 1e200];
    assert!(!proved_positive_definite(&IntervalMatrix::from(&matrix)), "determinant -5/4");
}

#[test]
fn bad_and_empty_matrices_have_an_answer() {
    let none = IntervalMatrix::zeros(0, 0);
    assert!(proved_positive_definite(&none), "no direction denies it");
    assert_eq!(lower_bound(&none), f64::INFINITY, "no eigenvalue at all");
    for bad in [f64::NAN, f64::INFINITY] {
        let matrix = IntervalMatrix::from(&dmatrix![1.0, bad; bad, 1.0]);
        assert!(!proved_positive_definite(&matrix), "{bad} proves nothing");
        assert_eq!(lower_bound(&matrix), f64::NEG_INFINITY, "{bad} bounds nothing");
        assert!(!proved_positive_definite(&IntervalMatrix::from(&dmatrix![bad])), "{bad} on the diagonal");
    }
    assert!(!proved_positive_definite(&IntervalMatrix::zeros(2, 2)), "zero is only semidefinite");
    assert!(!proved_positive_definite(&IntervalMatrix::zeros(2, 3)), "not square");
    let huge = IntervalMatrix::from(&dmatrix![1e308, 0.0; 0.0, 1e-308]);
    assert!(proved_positive_definite(&huge), "at the ends of the range");
}

#[test]
fn symmetric_blocks_stand_where_they_are_written() {
    let block = |m: DMatrix<f64>| IntervalMatrix::from(&m);
    let (a, b, d) = (block(dmatrix![1.0, 2.0; 2.0, 3.0]), block(dmatrix![4.0; 5.0]), block(dmatrix![6.0]));
    let whole = IntervalMatrix::symmetric(&[&[&a, &b], &[&d]]);
    let expected = dmatrix![1.0, 2.0, 4.0; 2.0, 3.0, 5.0; 4.0, 5.0, 6.0];
    assert_eq!(whole, IntervalMatrix::from(&expected), "[a b; b' d]");
}
