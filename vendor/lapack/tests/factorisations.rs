//! Every factorisation against what defines it: reconstruction, orthogonality, known spectra; both precisions.

#![expect(clippy::unwrap_used, reason = "helpers of tests, which clippy takes for library code")]

use lapack::{dgesdd, dgesv, dgesvd, dpotrf, dpotrs, dsyevr, sgesdd, sgesv, sgesvd, spotrf, spotrs, ssyevr};

/// Reproducible numbers between -1 and 1 (a linear congruence).
struct Numbers(u64);

impl Numbers {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }
}

/// What stands where nothing may be read or written.
const UNTOUCHED: f64 = 77.0;

fn int(count: usize) -> i32 {
    i32::try_from(count).unwrap()
}

/// A matrix in double precision, the reference: columns in a vector.
#[derive(Clone)]
struct Dense {
    rows: usize,
    columns: usize,
    data: Vec<f64>,
}

impl Dense {
    fn new(rows: usize, columns: usize, mut entry: impl FnMut(usize, usize) -> f64) -> Self {
        let mut data = Vec::new();
        for j in 0..columns {
            for i in 0..rows {
                data.push(entry(i, j));
            }
        }
        Self { rows, columns, data }
    }

    fn at(&self, i: usize, j: usize) -> f64 {
        self.data[i + j * self.rows]
    }

    fn transpose(&self) -> Self {
        Self::new(self.columns, self.rows, |i, j| self.at(j, i))
    }

    fn times(&self, other: &Self) -> Self {
        assert_eq!(self.columns, other.rows, "shapes of a product");
        Self::new(self.rows, other.columns, |i, j| {
            (0..self.columns).map(|k| self.at(i, k) * other.at(k, j)).sum()
        })
    }

    fn distance(&self, other: &Self) -> f64 {
        assert_eq!((self.rows, self.columns), (other.rows, other.columns), "shapes of a difference");
        self.data.iter().zip(&other.data).map(|(x, y)| (x - y).abs()).fold(0.0, f64::max)
    }

    fn identity(n: usize) -> Self {
        Self::diagonal(&vec![1.0; n])
    }

    fn diagonal(values: &[f64]) -> Self {
        Self::new(values.len(), values.len(), |i, j| if i == j { values[i] } else { 0.0 })
    }

    fn random(numbers: &mut Numbers, rows: usize, columns: usize) -> Self {
        Self::new(rows, columns, |_, _| numbers.next())
    }

    /// Orthogonal: a product of reflections.
    fn orthogonal(numbers: &mut Numbers, n: usize) -> Self {
        let mut q = Self::identity(n);
        for _ in 0..n {
            let v: Vec<f64> = (0..n).map(|_| numbers.next()).collect();
            let square: f64 = v.iter().map(|x| x * x).sum();
            let identity = |i: usize, j: usize| if i == j { 1.0 } else { 0.0 };
            q = q.times(&Self::new(n, n, |i, j| identity(i, j) - 2.0 * v[i] * v[j] / square));
        }
        q
    }

    fn with_spectrum(numbers: &mut Numbers, values: &[f64]) -> Self {
        let q = Self::orthogonal(numbers, values.len());
        let full = q.times(&Self::diagonal(values)).times(&q.transpose());
        Self::new(full.rows, full.columns, |i, j| 0.5 * (full.at(i, j) + full.at(j, i)))
    }
}

#[expect(clippy::cast_possible_truncation, reason = "rounds")]
fn to_f32(x: f64) -> f32 {
    x as f32
}

macro_rules! tests {
    ($module:ident, $real:ty, $round:expr, $syevr:ident, $potrf:ident, $potrs:ident, $gesdd:ident, $gesvd:ident, $gesv:ident) => {
        mod $module {
            use super::*;

            fn eps() -> f64 {
                f64::from(<$real>::EPSILON)
            }

            /// Stores with rows to spare; `keep` says which entries are given.
            fn stored(a: &Dense, spare: usize, keep: impl Fn(usize, usize) -> bool) -> (Vec<$real>, usize) {
                let leading = (a.rows + spare).max(1);
                let mut data = vec![$round(UNTOUCHED); leading * a.columns];
                for j in 0..a.columns {
                    for i in (0..a.rows).filter(|i| keep(*i, j)) {
                        data[i + j * leading] = $round(a.at(i, j));
                    }
                }
                (data, leading)
            }

            fn dense(data: &[$real], rows: usize, columns: usize, leading: usize) -> Dense {
                Dense::new(rows, columns, |i, j| f64::from(data[i + j * leading]))
            }

            fn half(uplo: u8) -> impl Fn(usize, usize) -> bool {
                move |i, j| if uplo == b'U' { i <= j } else { i >= j }
            }

            /// Eigenvalues and vectors, through the query for workspace.
            fn eigen(jobz: u8, uplo: u8, a: &Dense, spare: usize) -> (Vec<f64>, Dense) {
                let n = a.rows;
                let (mut data, leading) = stored(a, spare, half(uplo));
                let (mut w, mut z) = (vec![0.0; n], vec![0.0; n * n]);
                let (mut work, mut iwork, mut isuppz) = (vec![0.0], vec![0], vec![0; 2 * n]);
                let (mut m, mut info, mut length) = (0, 7, -1);
                for _ in 0..2 {
                    $syevr(
                        jobz,
                        b'A',
                        uplo,
                        int(n),
                        &mut data,
                        int(leading),
                        0.0,
                        0.0,
                        0,
                        0,
                        0.0,
                        &mut m,
                        &mut w,
                        &mut z,
                        int(n.max(1)),
                        &mut isuppz,
                        &mut work,
                        length,
                        &mut iwork,
                        length,
                        &mut info,
                    );
                    assert_eq!((info, m), (0, int(n)), "info and number of eigenvalues");
                    length = 1;
                }
                (w.iter().map(|x| f64::from(*x)).collect(), dense(&z, n, n, n.max(1)))
            }

            #[test]
            fn eigenvalues_of_known_spectra_are_found_from_either_half() {
                let mut numbers = Numbers(1);
                let graded: Vec<f64> = (0..8).map(|k| 10.0_f64.powi(-2 * k)).rev().collect();
                let spectra: [&[f64]; 6] = [
                    &[],
                    &[-3.0],
                    &[-1.0, -1.0, 2.0, 2.0],
                    &[0.0, 0.0, 0.0, 5.0],
                    &graded,
                    &[-4.0, -1.0, 0.5, 3.0, 9.0],
                ];
                for values in spectra {
                    let a = Dense::with_spectrum(&mut numbers, values);
                    let size = values.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
                    for (uplo, spare) in [(b'U', 0), (b'L', 3)] {
                        let (found, z) = eigen(b'V', uplo, &a, spare);
                        let (alone, _) = eigen(b'N', uplo, &a, spare);
                        assert!(
                            found.iter().zip(&alone).all(|(x, y)| (x - y).abs() <= 40.0 * eps() * size),
                            "without vectors {alone:?}, with them {found:?}"
                        );
                        for (x, y) in found.iter().zip(values) {
                            assert!((x - y).abs() <= 40.0 * eps() * size, "{found:?}, not {values:?}");
                        }
                        let (n, left) = (values.len(), a.times(&z));
                        let right = z.times(&Dense::diagonal(&found));
                        assert!(
                            left.distance(&right) <= 40.0 * eps() * size,
                            "A Z = Z W, spectrum {values:?}"
                        );
                        let unit = z.transpose().times(&z).distance(&Dense::identity(n));
                        assert!(unit <= 40.0 * eps(), "Z'Z = I to {unit:.1e}, spectrum {values:?}");
                    }
                }
            }

            #[test]
            fn cholesky_reconstructs_and_solves_from_either_half() {
                let mut numbers = Numbers(2);
                for (n, spare, uplo) in
                    [(1, 0, b'L'), (4, 0, b'L'), (4, 2, b'U'), (9, 1, b'L'), (17, 0, b'U'), (0, 0, b'U')]
                {
                    let b = Dense::random(&mut numbers, n, n);
                    let identity = |i: usize, j: usize| if i == j { 1.0 } else { 0.0 };
                    let product = b.times(&b.transpose());
                    let a = Dense::new(n, n, |i, j| product.at(i, j) + identity(i, j));
                    let (mut data, leading) = stored(&a, spare, half(uplo));
                    let mut info = 7;
                    $potrf(uplo, int(n), &mut data, int(leading), &mut info);
                    assert_eq!(info, 0, "n = {n}: positive definite");
                    let inside = half(uplo);
                    for j in 0..n {
                        for i in (0..leading).filter(|i| *i >= n || !inside(*i, j)) {
                            assert_eq!(
                                f64::from(data[i + j * leading]),
                                UNTOUCHED,
                                "({i}, {j}) is not part of the factor"
                            );
                        }
                    }
                    let factor =
                        Dense::new(
                            n,
                            n,
                            |i, j| if inside(i, j) { f64::from(data[i + j * leading]) } else { 0.0 },
                        );
                    let (l, r) = if uplo == b'U' {
                        (factor.transpose(), factor)
                    } else {
                        (factor.clone(), factor.transpose())
                    };
                    let size = 4.0 + n as f64;
                    assert!(l.times(&r).distance(&a) <= 10.0 * eps() * size * size, "n = {n}: L L' = A");

                    let x = Dense::random(&mut numbers, n, 3);
                    let (mut right, ldb) = stored(&a.times(&x), spare, |_, _| true);
                    $potrs(uplo, int(n), 3, &data, int(leading), &mut right, int(ldb), &mut info);
                    let worst = dense(&right, n, 3, ldb).distance(&x);
                    assert!(
                        info == 0 && worst <= 300.0 * eps() * size * size,
                        "n = {n}: A X = B to {worst:.1e}"
                    );
                }
            }

            #[test]
            fn cholesky_tells_which_pivot_fails() {
                for n in [3, 6] {
                    for bad in 0..n {
                        for value in [0.0, -1.0, f64::NAN, f64::INFINITY] {
                            let a = Dense::new(n, n, |i, j| {
                                if i != j {
                                    0.0
                                } else if i == bad {
                                    value
                                } else {
                                    2.0
                                }
                            });
                            let (mut data, leading) = stored(&a, 0, |_, _| true);
                            let mut info = 0;
                            $potrf(b'L', int(n), &mut data, int(leading), &mut info);
                            assert_eq!(info, int(bad + 1), "n = {n}, pivot {bad} is {value}");
                        }
                    }
                }
            }

            type Decomposition = (Dense, Vec<f64>, Dense);

            /// Both names, through the query for workspace; the results must agree.
            fn svd(a: &Dense, spare: usize) -> Decomposition {
                let (m, n) = (a.rows, a.columns);
                let k = m.min(n);
                let mut results: Vec<Decomposition> = Vec::new();
                for divide in [true, false] {
                    let (mut data, lda) = stored(a, spare, |_, _| true);
                    let (ldu, ldvt) = (m + spare + 1, k + spare + 1);
                    let (mut s, mut u, mut vt) = (vec![0.0; k], vec![0.0; ldu * k], vec![0.0; ldvt * n]);
                    let (mut work, mut iwork) = (vec![0.0], vec![0; 8 * k]);
                    let (mut info, mut length) = (7, -1);
                    for _ in 0..2 {
                        if divide {
                            $gesdd(
                                b'S',
                                int(m),
                                int(n),
                                &mut data,
                                int(lda),
                                &mut s,
                                &mut u,
                                int(ldu),
                                &mut vt,
                                int(ldvt),
                                &mut work,
                                length,
                                &mut iwork,
                                &mut info,
                            );
                        } else {
                            $gesvd(
                                b'S',
                                b'S',
                                int(m),
                                int(n),
                                &mut data,
                                int(lda),
                                &mut s,
                                &mut u,
                                int(ldu),
                                &mut vt,
                                int(ldvt),
                                &mut work,
                                length,
                                &mut info,
                            );
                        }
                        assert_eq!(info, 0, "no error");
                        length = 1;
                    }
                    let s = s.iter().map(|x| f64::from(*x)).collect();
                    results.push((dense(&u, m, k, ldu), s, dense(&vt, k, n, ldvt)));
                }
                let second = results.pop().unwrap();
                let first = results.pop().unwrap();
                assert!(
                    first.1 == second.1 || first.1.iter().all(|x| x.is_nan()),
                    "both names give the same values"
                );
                first
            }

            fn check_svd(what: &str, a: &Dense, known: Option<&[f64]>, spare: usize) {
                let (u, s, vt) = svd(a, spare);
                let size = s.first().copied().unwrap_or(0.0);
                assert!(
                    s.windows(2).all(|pair| pair[0] >= pair[1]) && s.iter().all(|x| *x >= 0.0),
                    "{what}: order of {s:?}"
                );
                let worst = u.times(&Dense::diagonal(&s)).times(&vt).distance(a);
                assert!(worst <= 60.0 * eps() * size, "{what}: U S V' = A to {worst:.1e}");
                for q in [u.transpose().times(&u), vt.times(&vt.transpose())] {
                    let unit = q.distance(&Dense::identity(s.len()));
                    assert!(unit <= 60.0 * eps(), "{what}: orthogonal to {unit:.1e}");
                }
                for (x, y) in s.iter().zip(known.unwrap_or(&[])) {
                    assert!((x - y).abs() <= 60.0 * eps() * size, "{what}: {s:?}, not {known:?}");
                }
            }

            #[test]
            fn singular_values_are_known_ones() {
                let mut numbers = Numbers(3);
                let graded: Vec<f64> = (0..16).map(|k| 10.0_f64.powi(-k)).collect();
                let cases: [&[f64]; 5] =
                    [&graded, &[3.0, 3.0, 3.0, 3.0], &[2.0, 1.0, 0.0, 0.0, 0.0], &[5.0], &[]];
                for values in cases {
                    let n = values.len();
                    let (u, v) = (Dense::orthogonal(&mut numbers, n), Dense::orthogonal(&mut numbers, n));
                    let a = u.times(&Dense::diagonal(values)).times(&v);
                    check_svd(&format!("square {n}"), &a, Some(values), 0);
                }
                for (m, n) in [(1, 1), (4, 6), (6, 4), (1, 5), (5, 1), (12, 12), (3, 0), (0, 3)] {
                    let a = Dense::random(&mut numbers, m, n);
                    check_svd(&format!("{m} x {n}"), &a, None, 2);
                }
            }

            /// On such matrices other libraries have been silently wrong.
            #[test]
            fn rank_one_matrices_of_small_integers_are_exact() {
                let (u, v) = ([1.0, -1.0, -1.0, 1.0, 0.0, -1.0], [1.0, -1.0, -1.0, 0.0]);
                let a = Dense::new(6, 4, |i, j| u[i] * v[j]);
                check_svd("rank one", &a, Some(&[15.0_f64.sqrt(), 0.0, 0.0, 0.0]), 1);
                check_svd("zero", &Dense::new(5, 5, |_, _| 0.0), Some(&[0.0; 5]), 0);
                let mut numbers = Numbers(4);
                for _ in 0..300 {
                    let round = |m: Dense| Dense::new(m.rows, m.columns, |i, j| (2.0 * m.at(i, j)).round());
                    let (p, q) =
                        (round(Dense::random(&mut numbers, 6, 2)), round(Dense::random(&mut numbers, 2, 4)));
                    check_svd("rank two", &p.times(&q), None, 0);
                }
            }

            #[test]
            fn extreme_sizes_neither_overflow_nor_vanish() {
                let large = f64::from(<$real>::MAX) / 1e3;
                for size in [large, f64::from(<$real>::MIN_POSITIVE) * 1e3] {
                    let mut numbers = Numbers(5);
                    let values = [1.0, 0.5, 0.25, 0.125];
                    let unit = Dense::with_spectrum(&mut numbers, &values);
                    let a = Dense::new(4, 4, |i, j| unit.at(i, j) * size);
                    let (_, s, _) = svd(&a, 0);
                    let (w, _) = eigen(b'N', b'L', &a, 0);
                    for k in 0..4 {
                        assert!((s[k] / size - values[k]).abs() < 40.0 * eps(), "size {size:e}: {s:?}");
                        assert!((w[3 - k] / size - values[k]).abs() < 40.0 * eps(), "size {size:e}: {w:?}");
                    }
                }
            }

            #[test]
            fn what_is_not_finite_becomes_nan_without_an_error() {
                for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
                    for n in [1, 4, 6] {
                        let a = Dense::new(n, n, |i, j| if i == j { bad } else { 1.0 });
                        let (u, s, vt) = svd(&a, 0);
                        assert!(
                            s.iter().chain(&u.data).chain(&vt.data).all(|x| x.is_nan()),
                            "{bad}, n = {n}: {s:?}"
                        );
                        let (w, z) = eigen(b'V', b'U', &a, 0);
                        assert!(w.iter().chain(&z.data).all(|x| x.is_nan()), "{bad}, n = {n}: {w:?}");
                    }
                }
            }

            #[test]
            fn elimination_solves_and_hands_back_its_factors() {
                let mut numbers = Numbers(6);
                for (n, spare) in [(1, 0), (4, 0), (5, 2), (12, 1), (0, 0)] {
                    let (a, x) = (Dense::random(&mut numbers, n, n), Dense::random(&mut numbers, n, 2));
                    let (mut data, lda) = stored(&a, spare, |_, _| true);
                    let (mut right, ldb) = stored(&a.times(&x), spare, |_, _| true);
                    let (mut exchanges, mut info) = (vec![0; n], 7);
                    $gesv(int(n), 2, &mut data, int(lda), &mut exchanges, &mut right, int(ldb), &mut info);
                    assert_eq!(info, 0, "n = {n}");
                    let worst = dense(&right, n, 2, ldb).distance(&x);
                    assert!(worst <= 2000.0 * eps(), "n = {n}: A X = B to {worst:.1e}");
                    let packed = dense(&data, n, n, lda);
                    let l = Dense::new(n, n, |i, j| {
                        if i > j {
                            packed.at(i, j)
                        } else if i == j {
                            1.0
                        } else {
                            0.0
                        }
                    });
                    let u = Dense::new(n, n, |i, j| if i <= j { packed.at(i, j) } else { 0.0 });
                    let mut rows: Vec<usize> = (0..n).collect();
                    for (k, exchange) in exchanges.iter().enumerate() {
                        rows.swap(k, usize::try_from(*exchange).unwrap() - 1);
                    }
                    let exchanged = Dense::new(n, n, |i, j| a.at(rows[i], j));
                    assert!(
                        l.times(&u).distance(&exchanged) <= 40.0 * eps() * n as f64,
                        "n = {n}: L U = P A"
                    );
                }
            }

            #[test]
            fn a_singular_matrix_is_told_by_its_pivot() {
                let a = Dense::new(4, 4, |i, j| if i == j && i != 2 { 1.0 } else { 0.0 });
                let (mut data, lda) = stored(&a, 0, |_, _| true);
                let (mut right, mut exchanges, mut info) = (vec![1.0; 4], vec![0; 4], 0);
                $gesv(4, 1, &mut data, int(lda), &mut exchanges, &mut right, 4, &mut info);
                assert_eq!(info, 3, "the third pivot is zero");
                assert_eq!(right, [1.0; 4], "the right side is left alone");
            }
        }
    };
}

tests!(single, f32, to_f32, ssyevr, spotrf, spotrs, sgesdd, sgesvd, sgesv);
tests!(double, f64, f64::from, dsyevr, dpotrf, dpotrs, dgesdd, dgesvd, dgesv);
