//! Every product against its definition: both precisions, both halves, transposes, long leading dimensions.

#![expect(clippy::unwrap_used, reason = "helpers of tests, which clippy takes for library code")]

use blas::{dgemm, dgemv, dsymv, dsyr2k, dsyrk, sgemm, sgemv, ssymv, ssyr2k, ssyrk};

/// Reproducible numbers between -1 and 1 (a linear congruence).
struct Numbers(u64);

impl Numbers {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 40) as f64 / (1_u64 << 23) as f64 - 1.0
    }
}

/// What stands where nothing may be read or written.
const UNTOUCHED: f64 = 77.0;

fn int(count: usize) -> i32 {
    i32::try_from(count).unwrap()
}

#[expect(clippy::cast_possible_truncation, reason = "rounds")]
fn to_f32(x: f64) -> f32 {
    x as f32
}

macro_rules! tests {
    ($module:ident, $real:ty, $round:expr, $rounding:expr, $gemm:ident, $gemv:ident, $symv:ident, $syrk:ident, $syr2k:ident) => {
        mod $module {
            use super::*;

            /// A matrix with rows to spare below each column.
            struct Matrix {
                rows: usize,
                columns: usize,
                leading: usize,
                data: Vec<$real>,
            }

            impl Matrix {
                fn random(numbers: &mut Numbers, rows: usize, columns: usize, spare: usize) -> Self {
                    let leading = (rows + spare).max(1);
                    let mut data = vec![$round(UNTOUCHED); leading * columns];
                    for j in 0..columns {
                        for i in 0..rows {
                            data[i + j * leading] = $round(numbers.next());
                        }
                    }
                    Self { rows, columns, leading, data }
                }

                fn at(&self, i: usize, j: usize) -> f64 {
                    f64::from(self.data[i + j * self.leading])
                }

                /// The matrix or its transpose.
                fn op(&self, transposed: bool, i: usize, j: usize) -> f64 {
                    if transposed { self.at(j, i) } else { self.at(i, j) }
                }

                fn check(&self, what: &str, expected: impl Fn(usize, usize) -> f64) {
                    for j in 0..self.columns {
                        for i in 0..self.leading {
                            let found = f64::from(self.data[i + j * self.leading]);
                            let wanted = if i < self.rows { expected(i, j) } else { UNTOUCHED };
                            assert!(
                                (found - wanted).abs() <= $rounding,
                                "{what} ({i}, {j}): {found}, not {wanted}"
                            );
                        }
                    }
                }
            }

            const SIZES: [(usize, usize, usize); 8] =
                [(1, 1, 1), (2, 3, 4), (5, 1, 3), (7, 7, 7), (12, 9, 20), (0, 3, 2), (3, 0, 2), (4, 3, 0)];

            fn sum(k: usize, term: impl Fn(usize) -> f64) -> f64 {
                (0..k).map(term).sum()
            }

            #[test]
            fn gemm_is_the_definition() {
                let mut numbers = Numbers(1);
                for (m, n, k) in SIZES {
                    for (ta, tb, spare, beta) in [
                        (false, false, 0, 0.0),
                        (true, false, 2, 0.5),
                        (false, true, 1, 1.0),
                        (true, true, 3, -2.0),
                    ] {
                        let shape = |t: bool, r: usize, c: usize| if t { (c, r) } else { (r, c) };
                        let ((ar, ac), (br, bc)) = (shape(ta, m, k), shape(tb, k, n));
                        let a = Matrix::random(&mut numbers, ar, ac, spare);
                        let b = Matrix::random(&mut numbers, br, bc, spare);
                        let mut c = Matrix::random(&mut numbers, m, n, spare);
                        let before = Matrix { data: c.data.clone(), ..c };
                        if beta == 0.0 {
                            // what stands there must not matter
                            (0..n)
                                .for_each(|j| (0..m).for_each(|i| c.data[i + j * c.leading] = <$real>::NAN));
                        }
                        let code = |t: bool| if t { b'T' } else { b'N' };
                        $gemm(
                            code(ta),
                            code(tb),
                            int(m),
                            int(n),
                            int(k),
                            1.5,
                            &a.data,
                            int(a.leading),
                            &b.data,
                            int(b.leading),
                            beta,
                            &mut c.data,
                            int(c.leading),
                        );
                        c.check(&format!("{m} x {k} x {n} {ta} {tb}"), |i, j| {
                            1.5 * sum(k, |l| a.op(ta, i, l) * b.op(tb, l, j))
                                + f64::from(beta) * before.at(i, j)
                        });
                    }
                }
            }

            #[test]
            fn products_with_a_vector_are_the_definition() {
                let mut numbers = Numbers(2);
                for (m, n, _) in SIZES {
                    let a = Matrix::random(&mut numbers, m, n, 2);
                    for transposed in [false, true] {
                        let (rows, inner) = if transposed { (n, m) } else { (m, n) };
                        let x = Matrix::random(&mut numbers, inner, 1, 0);
                        let mut y = Matrix::random(&mut numbers, rows, 1, 0);
                        let before = Matrix { data: y.data.clone(), ..y };
                        $gemv(
                            if transposed { b'T' } else { b'N' },
                            int(m),
                            int(n),
                            -0.5,
                            &a.data,
                            int(a.leading),
                            &x.data,
                            1,
                            2.0,
                            &mut y.data,
                            1,
                        );
                        y.rows = rows;
                        for i in 0..rows {
                            let wanted = -0.5 * sum(inner, |l| a.op(transposed, i, l) * x.at(l, 0))
                                + 2.0 * before.at(i, 0);
                            assert!(
                                (y.at(i, 0) - wanted).abs() <= $rounding,
                                "{m} x {n} {transposed}, row {i}"
                            );
                        }
                    }
                    let s = Matrix::random(&mut numbers, n, n, 1);
                    let x = Matrix::random(&mut numbers, n, 1, 0);
                    for uplo in [b'U', b'L'] {
                        let mut y = Matrix::random(&mut numbers, n, 1, 0);
                        let before = Matrix { data: y.data.clone(), ..y };
                        $symv(uplo, int(n), 1.5, &s.data, int(s.leading), &x.data, 1, -1.0, &mut y.data, 1);
                        for i in 0..n {
                            let entry = |l: usize| {
                                let (low, high) = (i.max(l), i.min(l));
                                if uplo == b'U' { s.at(high, low) } else { s.at(low, high) }
                            };
                            let wanted = 1.5 * sum(n, |l| entry(l) * x.at(l, 0)) - before.at(i, 0);
                            assert!((y.at(i, 0) - wanted).abs() <= $rounding, "symmetric {n}, row {i}");
                        }
                    }
                }
            }

            #[test]
            fn rank_updates_are_the_definition_and_keep_the_other_half() {
                let mut numbers = Numbers(3);
                for (n, _, k) in SIZES {
                    for (uplo, transposed, beta) in
                        [(b'U', false, 0.0), (b'U', true, 1.0), (b'L', false, -0.5), (b'L', true, 0.0)]
                    {
                        let (rows, columns) = if transposed { (k, n) } else { (n, k) };
                        let a = Matrix::random(&mut numbers, rows, columns, 1);
                        let b = Matrix::random(&mut numbers, rows, columns, 2);
                        let mut one = Matrix::random(&mut numbers, n, n, 1);
                        let mut two = Matrix { data: one.data.clone(), ..one };
                        let before = Matrix { data: one.data.clone(), ..one };
                        let trans = if transposed { b'T' } else { b'N' };
                        $syrk(
                            uplo,
                            trans,
                            int(n),
                            int(k),
                            2.0,
                            &a.data,
                            int(a.leading),
                            beta,
                            &mut one.data,
                            int(one.leading),
                        );
                        $syr2k(
                            uplo,
                            trans,
                            int(n),
                            int(k),
                            0.5,
                            &a.data,
                            int(a.leading),
                            &b.data,
                            int(b.leading),
                            beta,
                            &mut two.data,
                            int(two.leading),
                        );
                        let inside = |i: usize, j: usize| if uplo == b'U' { i <= j } else { i >= j };
                        let (ta, tb) = (|i, l| a.op(transposed, i, l), |i, l| b.op(transposed, i, l));
                        one.check(&format!("A A', n = {n}, k = {k}"), |i, j| {
                            let kept = before.at(i, j);
                            let product = 2.0 * sum(k, |l| ta(i, l) * ta(j, l));
                            if inside(i, j) { product + f64::from(beta) * kept } else { kept }
                        });
                        two.check(&format!("A B' + B A', n = {n}, k = {k}"), |i, j| {
                            let kept = before.at(i, j);
                            let product = 0.5 * sum(k, |l| ta(i, l) * tb(j, l) + tb(i, l) * ta(j, l));
                            if inside(i, j) { product + f64::from(beta) * kept } else { kept }
                        });
                    }
                }
            }

            #[test]
            fn a_number_that_is_none_spreads_and_does_not_panic() {
                let a = [1.0, <$real>::NAN, 0.0, 1.0];
                let mut c = [0.0; 4];
                $gemm(b'N', b'N', 2, 2, 2, 1.0, &a, 2, &a, 2, 0.0, &mut c, 2);
                assert!(c[1].is_nan(), "NaN in, NaN out: {c:?}");
            }
        }
    };
}

tests!(single, f32, to_f32, 2e-5, sgemm, sgemv, ssymv, ssyrk, ssyr2k);
tests!(double, f64, f64::from, 1e-13, dgemm, dgemv, dsymv, dsyrk, dsyr2k);
