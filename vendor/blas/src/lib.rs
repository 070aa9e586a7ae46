//! The routines of the crate `blas` 0.22 that clarabel's semidefinite cones call, in safe Rust.
//!
//! Names, arguments and layout are those of BLAS (column-major, `N` or `T`, `U` or `L`), because this crate takes the
//! place of that one; what is computed is in `dense-kernels`. Vectors must be contiguous: clarabel has no others.
//!
//! All routines panic when a slice is shorter than its shape says: a mistake of the caller, never of numbers.

#![expect(clippy::too_many_arguments, reason = "the signatures are those of BLAS")]

use dense_kernels::{Triangle, matrix, matrix_mut, multiply, multiply_symmetric, multiply_triangle, size};

fn transposed(code: u8) -> bool {
    !code.eq_ignore_ascii_case(&b'N')
}

macro_rules! products {
    ($real:ty, $gemm:ident, $gemv:ident, $symv:ident, $syrk:ident, $syr2k:ident) => {
        /// `C = alpha op(A) op(B) + beta C`; `C` is `m x n`, the inner dimension `k`.
        pub fn $gemm(
            transa: u8,
            transb: u8,
            m: i32,
            n: i32,
            k: i32,
            alpha: $real,
            a: &[$real],
            lda: i32,
            b: &[$real],
            ldb: i32,
            beta: $real,
            c: &mut [$real],
            ldc: i32,
        ) {
            let (m, n, k) = (size(m), size(n), size(k));
            let a = if transposed(transa) {
                matrix(a, k, m, size(lda)).transpose()
            } else {
                matrix(a, m, k, size(lda))
            };
            let b = if transposed(transb) {
                matrix(b, n, k, size(ldb)).transpose()
            } else {
                matrix(b, k, n, size(ldb))
            };
            multiply(matrix_mut(c, m, n, size(ldc)), a, b, alpha, beta);
        }

        /// `y = alpha op(A) x + beta y`; `A` is `m x n`.
        pub fn $gemv(
            trans: u8,
            m: i32,
            n: i32,
            alpha: $real,
            a: &[$real],
            lda: i32,
            x: &[$real],
            incx: i32,
            beta: $real,
            y: &mut [$real],
            incy: i32,
        ) {
            assert!(incx == 1 && incy == 1, "vectors must be contiguous, not in steps of {incx} and {incy}");
            let a = matrix(a, size(m), size(n), size(lda));
            let a = if transposed(trans) { a.transpose() } else { a };
            let (rows, inner) = (a.nrows(), a.ncols());
            multiply(matrix_mut(y, rows, 1, rows), a, matrix(x, inner, 1, inner), alpha, beta);
        }

        /// `y = alpha A x + beta y` for a symmetric `A` of which one half is given.
        pub fn $symv(
            uplo: u8,
            n: i32,
            alpha: $real,
            a: &[$real],
            lda: i32,
            x: &[$real],
            incx: i32,
            beta: $real,
            y: &mut [$real],
            incy: i32,
        ) {
            assert!(incx == 1 && incy == 1, "vectors must be contiguous, not in steps of {incx} and {incy}");
            let n = size(n);
            let factors = (matrix(a, n, n, size(lda)), matrix(x, n, 1, n));
            multiply_symmetric(Triangle::from_code(uplo), matrix_mut(y, n, 1, n), factors, alpha, beta);
        }

        /// One half of `C = alpha op(A) op(A)' + beta C`; `C` is `n x n`, the inner dimension `k`.
        pub fn $syrk(
            uplo: u8,
            trans: u8,
            n: i32,
            k: i32,
            alpha: $real,
            a: &[$real],
            lda: i32,
            beta: $real,
            c: &mut [$real],
            ldc: i32,
        ) {
            let (n, k) = (size(n), size(k));
            let a = if transposed(trans) {
                matrix(a, k, n, size(lda)).transpose()
            } else {
                matrix(a, n, k, size(lda))
            };
            let half = Triangle::from_code(uplo);
            multiply_triangle(half, matrix_mut(c, n, n, size(ldc)), (a, a.transpose()), alpha, beta);
        }

        /// One half of `C = alpha (op(A) op(B)' + op(B) op(A)') + beta C`; `C` is `n x n`, the inner dimension `k`.
        pub fn $syr2k(
            uplo: u8,
            trans: u8,
            n: i32,
            k: i32,
            alpha: $real,
            a: &[$real],
            lda: i32,
            b: &[$real],
            ldb: i32,
            beta: $real,
            c: &mut [$real],
            ldc: i32,
        ) {
            let (n, k) = (size(n), size(k));
            let (a, b) = if transposed(trans) {
                (matrix(a, k, n, size(lda)).transpose(), matrix(b, k, n, size(ldb)).transpose())
            } else {
                (matrix(a, n, k, size(lda)), matrix(b, n, k, size(ldb)))
            };
            let half = Triangle::from_code(uplo);
            multiply_triangle(half, matrix_mut(c, n, n, size(ldc)), (a, b.transpose()), alpha, beta);
            multiply_triangle(half, matrix_mut(c, n, n, size(ldc)), (b, a.transpose()), alpha, 1.0);
        }
    };
}

products!(f32, sgemm, sgemv, ssymv, ssyrk, ssyr2k);
products!(f64, dgemm, dgemv, dsymv, dsyrk, dsyr2k);
