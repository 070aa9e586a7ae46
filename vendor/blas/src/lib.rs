//! Same signatures as blas 0.22 for the five routines clarabel's `sdp` feature uses, f32 and f64.
#![allow(clippy::too_many_arguments)]
macro_rules! blas {
    ($t:ty, $gemm:ident, $gemv:ident, $symv:ident, $syrk:ident, $syr2k:ident) => {
        pub fn $gemm(
            ta: u8,
            tb: u8,
            m: i32,
            n: i32,
            k: i32,
            alpha: $t,
            a: &[$t],
            lda: i32,
            b: &[$t],
            ldb: i32,
            beta: $t,
            c: &mut [$t],
            ldc: i32,
        ) {
            dense_kernels::gemm(
                ta == b'T',
                tb == b'T',
                m as usize,
                n as usize,
                k as usize,
                alpha,
                a,
                lda as usize,
                b,
                ldb as usize,
                beta,
                c,
                ldc as usize,
            )
        }
        pub fn $gemv(
            t: u8,
            m: i32,
            n: i32,
            alpha: $t,
            a: &[$t],
            lda: i32,
            x: &[$t],
            incx: i32,
            beta: $t,
            y: &mut [$t],
            incy: i32,
        ) {
            assert!(incx == 1 && incy == 1);
            let (r, k) = if t == b'T' { (n, m) } else { (m, n) };
            dense_kernels::gemm(
                t == b'T',
                false,
                r as usize,
                1,
                k as usize,
                alpha,
                a,
                lda as usize,
                x,
                k as usize,
                beta,
                y,
                r as usize,
            )
        }
        pub fn $symv(
            uplo: u8,
            n: i32,
            alpha: $t,
            a: &[$t],
            lda: i32,
            x: &[$t],
            incx: i32,
            beta: $t,
            y: &mut [$t],
            incy: i32,
        ) {
            assert!(incx == 1 && incy == 1);
            dense_kernels::symv(uplo == b'U', n as usize, alpha, a, lda as usize, x, beta, y)
        }
        pub fn $syrk(
            uplo: u8,
            t: u8,
            n: i32,
            k: i32,
            alpha: $t,
            a: &[$t],
            lda: i32,
            beta: $t,
            c: &mut [$t],
            ldc: i32,
        ) {
            dense_kernels::syrk(
                uplo == b'U',
                t == b'T',
                n as usize,
                k as usize,
                alpha,
                a,
                lda as usize,
                beta,
                c,
                ldc as usize,
            )
        }
        pub fn $syr2k(
            uplo: u8,
            t: u8,
            n: i32,
            k: i32,
            alpha: $t,
            a: &[$t],
            lda: i32,
            b: &[$t],
            ldb: i32,
            beta: $t,
            c: &mut [$t],
            ldc: i32,
        ) {
            dense_kernels::syr2k(
                uplo == b'U',
                t == b'T',
                n as usize,
                k as usize,
                alpha,
                a,
                lda as usize,
                b,
                ldb as usize,
                beta,
                c,
                ldc as usize,
            )
        }
    };
}
blas!(f32, sgemm, sgemv, ssymv, ssyrk, ssyr2k);
blas!(f64, dgemm, dgemv, dsymv, dsyrk, dsyr2k);
