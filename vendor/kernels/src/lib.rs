//! The dense kernels behind vendor/blas and vendor/lapack. All matrices are column-major slices.
//! Backends for eigenvalues / SVD / Cholesky: own code (default), feature `nalgebra`, feature `faer`.
#![allow(clippy::too_many_arguments, clippy::needless_range_loop)]
use num_traits::Float;

pub trait Real:
    Float + faer::traits::RealField + std::ops::AddAssign + std::ops::SubAssign + std::ops::MulAssign
{
}
impl Real for f32 {}
impl Real for f64 {}

#[inline]
fn z<T: Real>() -> T {
    <T as num_traits::Zero>::zero()
}
#[inline]
fn one<T: Real>() -> T {
    <T as num_traits::One>::one()
}
#[inline]
fn fin<T: Real>(a: &[T]) -> bool {
    a.iter().all(|x| Float::is_finite(*x))
}

/// C = alpha op(A) op(B) + beta C, C is m x n, inner dimension k
pub fn gemm<T: Real>(
    ta: bool,
    tb: bool,
    m: usize,
    n: usize,
    k: usize,
    alpha: T,
    a: &[T],
    lda: usize,
    b: &[T],
    ldb: usize,
    beta: T,
    c: &mut [T],
    ldc: usize,
) {
    let mut tmp = vec![z::<T>(); if ta { m * k } else { 0 }];
    let (a, lda) = if ta {
        // transpose A once so that the inner loop runs down columns
        for i in 0..m {
            for l in 0..k {
                tmp[i + l * m] = a[l + i * lda];
            }
        }
        (&tmp[..], m)
    } else {
        (a, lda)
    };
    for j in 0..n {
        let cj = &mut c[j * ldc..j * ldc + m];
        if beta == z() {
            cj.fill(z())
        } else if beta != one() {
            for x in cj.iter_mut() {
                *x *= beta;
            }
        }
        for l in 0..k {
            let f = alpha * if tb { b[j + l * ldb] } else { b[l + j * ldb] };
            if f == z() {
                continue;
            }
            for (x, y) in cj.iter_mut().zip(&a[l * lda..l * lda + m]) {
                *x += f * *y;
            }
        }
    }
}

/// y = alpha S x + beta y with S given by one triangle
pub fn symv<T: Real>(upper: bool, n: usize, alpha: T, a: &[T], lda: usize, x: &[T], beta: T, y: &mut [T]) {
    for i in 0..n {
        let mut s = z::<T>();
        for j in 0..n {
            let (p, q) = if (i <= j) == upper { (i, j) } else { (j, i) };
            s += a[p + q * lda] * x[j];
        }
        y[i] = alpha * s + if beta == z() { z() } else { beta * y[i] };
    }
}

/// triangle of C = alpha op(A) op(A)' + beta C
pub fn syrk<T: Real>(
    upper: bool,
    t: bool,
    n: usize,
    k: usize,
    alpha: T,
    a: &[T],
    lda: usize,
    beta: T,
    c: &mut [T],
    ldc: usize,
) {
    let two: T = one::<T>() + one::<T>();
    let half: T = alpha / two;
    syr2k(upper, t, n, k, half, a, lda, a, lda, beta, c, ldc)
}

/// triangle of C = alpha (op(A) op(B)' + op(B) op(A)') + beta C
pub fn syr2k<T: Real>(
    upper: bool,
    t: bool,
    n: usize,
    k: usize,
    alpha: T,
    a: &[T],
    lda: usize,
    b: &[T],
    ldb: usize,
    beta: T,
    c: &mut [T],
    ldc: usize,
) {
    let mut full = vec![z::<T>(); n * n];
    gemm(t, !t, n, n, k, alpha, a, lda, b, ldb, z(), &mut full, n);
    for j in 0..n {
        let r = if upper { 0..j + 1 } else { j..n };
        for i in r {
            let old = c[i + j * ldc];
            c[i + j * ldc] = full[i + j * n] + full[j + i * n] + if beta == z() { z() } else { beta * old };
        }
    }
}

/// Cholesky in place; returns 0 or the 1-based index of the first pivot that is not positive
pub fn potrf<T: Real>(upper: bool, n: usize, a: &mut [T], lda: usize) -> usize {
    if upper {
        // mirror, factor the lower triangle, mirror back
        for j in 0..n {
            for i in 0..j {
                a[j + i * lda] = a[i + j * lda];
            }
        }
        let r = potrf(false, n, a, lda);
        for j in 0..n {
            for i in 0..j {
                a[i + j * lda] = a[j + i * lda];
            }
        }
        return r;
    }
    for j in 0..n {
        let (left, right) = a.split_at_mut(j * lda);
        let cj = &mut right[j..n];
        for k in 0..j {
            let ck = &left[k * lda + j..k * lda + n];
            let f = ck[0];
            for (x, y) in cj.iter_mut().zip(ck) {
                *x -= f * *y;
            }
        }
        let d = cj[0];
        if !(d > z()) || !Float::is_finite(d) {
            return j + 1;
        }
        let d = Float::sqrt(d);
        cj[0] = d;
        for x in &mut cj[1..] {
            *x = *x / d;
        }
    }
    0
}

pub fn potrs<T: Real>(upper: bool, n: usize, nrhs: usize, a: &[T], lda: usize, b: &mut [T], ldb: usize) {
    let l = |i: usize, j: usize| if upper { a[j + i * lda] } else { a[i + j * lda] };
    for c in 0..nrhs {
        let x = &mut b[c * ldb..c * ldb + n];
        for i in 0..n {
            let mut s = x[i];
            for k in 0..i {
                s -= l(i, k) * x[k];
            }
            x[i] = s / l(i, i);
        }
        for i in (0..n).rev() {
            let mut s = x[i];
            for k in i + 1..n {
                s -= l(k, i) * x[k];
            }
            x[i] = s / l(i, i);
        }
    }
}

pub fn gesv<T: Real>(
    n: usize,
    nrhs: usize,
    a: &mut [T],
    lda: usize,
    ipiv: &mut [i32],
    b: &mut [T],
    ldb: usize,
) -> usize {
    for k in 0..n {
        let mut p = k;
        for i in k + 1..n {
            if Float::abs(a[i + k * lda]) > Float::abs(a[p + k * lda]) {
                p = i;
            }
        }
        ipiv[k] = p as i32 + 1;
        if a[p + k * lda] == z() {
            return k + 1;
        }
        if p != k {
            for j in 0..n {
                a.swap(k + j * lda, p + j * lda);
            }
            for c in 0..nrhs {
                b.swap(k + c * ldb, p + c * ldb);
            }
        }
        for i in k + 1..n {
            let f = a[i + k * lda] / a[k + k * lda];
            a[i + k * lda] = f;
            for j in k + 1..n {
                let v = a[k + j * lda];
                a[i + j * lda] -= f * v;
            }
            for c in 0..nrhs {
                let v = b[k + c * ldb];
                b[i + c * ldb] -= f * v;
            }
        }
    }
    for c in 0..nrhs {
        for i in (0..n).rev() {
            let mut s = b[i + c * ldb];
            for j in i + 1..n {
                s -= a[i + j * lda] * b[j + c * ldb];
            }
            b[i + c * ldb] = s / a[i + i * lda];
        }
    }
    0
}

/// eigenvalues (ascending) of the symmetric matrix given by one triangle of `a`, eigenvectors in `zv` on request.
/// Non-finite input gives NaN eigenvalues: clarabel would panic on an error code, with NaN it ends with a status.
pub fn syev<T: Real>(upper: bool, n: usize, a: &mut [T], w: &mut [T], zv: Option<&mut [T]>) {
    for j in 0..n {
        for i in 0..j {
            if upper {
                a[j + i * n] = a[i + j * n];
            } else {
                a[i + j * n] = a[j + i * n];
            }
        }
    }
    if !fin(&a[..n * n]) {
        w[..n].fill(Float::nan());
        if let Some(v) = zv {
            v.fill(Float::nan())
        }
        return;
    }
    backend::syev(n, a, w, zv)
}

/// economy SVD A = U diag(s) Vt, s descending, A m x n with ld m
pub fn gesvd<T: Real>(m: usize, n: usize, a: &mut [T], s: &mut [T], u: &mut [T], vt: &mut [T]) {
    if !fin(&a[..m * n]) {
        s.fill(Float::nan());
        u.fill(Float::nan());
        vt.fill(Float::nan());
        return;
    }
    backend::gesvd(m, n, a, s, u, vt)
}

mod backend {
    use super::*;
    use faer::{MatRef, Side};
    pub fn syev<T: Real>(n: usize, a: &mut [T], w: &mut [T], zv: Option<&mut [T]>) {
        let m = MatRef::from_column_major_slice(&a[..n * n], n, n);
        match zv {
            None => w[..n].copy_from_slice(&m.self_adjoint_eigenvalues(Side::Lower).unwrap()),
            Some(v) => {
                let e = m.self_adjoint_eigen(Side::Lower).unwrap();
                for k in 0..n {
                    w[k] = e.S()[k];
                    for i in 0..n {
                        v[i + k * n] = e.U()[(i, k)];
                    }
                }
            }
        }
    }
    pub fn gesvd<T: Real>(m: usize, n: usize, a: &mut [T], s: &mut [T], u: &mut [T], vt: &mut [T]) {
        let r = m.min(n);
        let d = MatRef::from_column_major_slice(&a[..m * n], m, n).thin_svd().unwrap();
        for k in 0..r {
            s[k] = d.S()[k];
            for i in 0..m {
                u[i + k * m] = d.U()[(i, k)];
            }
            for i in 0..n {
                vt[k + i * r] = d.V()[(i, k)];
            }
        }
    }
}
