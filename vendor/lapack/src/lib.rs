//! The routines of the crate `lapack` 0.19 that clarabel's semidefinite cones call, in safe Rust.
//!
//! Names, arguments and layout are those of LAPACK, because this crate takes the place of that one; what is computed is
//! in `dense-kernels`. No routine needs workspace: a query (`lwork = -1`) asks for one entry. Only what clarabel asks
//! for is there: all eigenvalues, economy singular vectors.
//!
//! Eigenvalues and singular values of a matrix that is not finite are NaN with `info = 0`: clarabel stops the program
//! when these routines report an error. All routines panic when a slice is shorter than its shape says or when they
//! are asked for another job: mistakes of the caller, never of numbers.

#![expect(clippy::too_many_arguments, reason = "the signatures are those of LAPACK")]

use dense_kernels::{
    Triangle, cholesky, cholesky_solve, lu_solve, matrix, matrix_mut, size, symmetric_eigen, thin_svd,
};

/// The argument `info`: zero, or the number of the pivot that failed.
fn info_of(result: Result<(), usize>) -> i32 {
    result.map_or_else(|pivot| i32::try_from(pivot).unwrap_or(i32::MAX), |()| 0)
}

macro_rules! factorisations {
    ($real:ty, $syevr:ident, $potrf:ident, $potrs:ident, $gesdd:ident, $gesvd:ident, $gesv:ident) => {
        /// Eigenvalues of a symmetric matrix, ascending, and with `jobz = V` its eigenvectors.
        pub fn $syevr(
            jobz: u8,
            range: u8,
            uplo: u8,
            n: i32,
            a: &mut [$real],
            lda: i32,
            _vl: $real,
            _vu: $real,
            _il: i32,
            _iu: i32,
            _abstol: $real,
            m: &mut i32,
            w: &mut [$real],
            z: &mut [$real],
            ldz: i32,
            _isuppz: &mut [i32],
            work: &mut [$real],
            lwork: i32,
            iwork: &mut [i32],
            liwork: i32,
            info: &mut i32,
        ) {
            assert!(range.eq_ignore_ascii_case(&b'A'), "only all eigenvalues are computed");
            (*info, *m) = (0, n);
            if lwork == -1 || liwork == -1 {
                (work[0], iwork[0]) = (1.0, 1);
                return;
            }
            let n = size(n);
            let vectors = jobz.eq_ignore_ascii_case(&b'V').then(|| matrix_mut(z, n, n, size(ldz)));
            symmetric_eigen(Triangle::from_code(uplo), matrix(a, n, n, size(lda)), w, vectors);
        }

        /// Cholesky factor in place of the half that is given.
        pub fn $potrf(uplo: u8, n: i32, a: &mut [$real], lda: i32, info: &mut i32) {
            let n = size(n);
            *info = info_of(cholesky(Triangle::from_code(uplo), matrix_mut(a, n, n, size(lda))));
        }

        /// Solves `A X = B` in place of `B` from the factor that the routine before this one found.
        pub fn $potrs(
            uplo: u8,
            n: i32,
            nrhs: i32,
            a: &[$real],
            lda: i32,
            b: &mut [$real],
            ldb: i32,
            info: &mut i32,
        ) {
            let n = size(n);
            let factor = matrix(a, n, n, size(lda));
            cholesky_solve(Triangle::from_code(uplo), factor, matrix_mut(b, n, size(nrhs), size(ldb)));
            *info = 0;
        }

        /// Economy singular value decomposition (`jobz = S`); `vt` holds the right vectors as rows.
        pub fn $gesdd(
            jobz: u8,
            m: i32,
            n: i32,
            a: &mut [$real],
            lda: i32,
            s: &mut [$real],
            u: &mut [$real],
            ldu: i32,
            vt: &mut [$real],
            ldvt: i32,
            work: &mut [$real],
            lwork: i32,
            _iwork: &mut [i32],
            info: &mut i32,
        ) {
            assert!(jobz.eq_ignore_ascii_case(&b'S'), "only the economy decomposition is computed");
            *info = 0;
            if lwork == -1 {
                work[0] = 1.0;
                return;
            }
            let (m, n) = (size(m), size(n));
            let count = m.min(n);
            let u = matrix_mut(u, m, count, size(ldu));
            let vt = matrix_mut(vt, count, n, size(ldvt));
            thin_svd(matrix(a, m, n, size(lda)), s, u, vt);
        }

        /// As the routine before this one, under LAPACK's name for another algorithm (`jobu = jobvt = S`).
        pub fn $gesvd(
            jobu: u8,
            jobvt: u8,
            m: i32,
            n: i32,
            a: &mut [$real],
            lda: i32,
            s: &mut [$real],
            u: &mut [$real],
            ldu: i32,
            vt: &mut [$real],
            ldvt: i32,
            work: &mut [$real],
            lwork: i32,
            info: &mut i32,
        ) {
            assert!(jobu == jobvt, "only the economy decomposition is computed");
            $gesdd(jobu, m, n, a, lda, s, u, ldu, vt, ldvt, work, lwork, &mut [], info);
        }

        /// Solves `A X = B` in place of `B` by elimination with row exchanges; `A` becomes its factors.
        pub fn $gesv(
            n: i32,
            nrhs: i32,
            a: &mut [$real],
            lda: i32,
            ipiv: &mut [i32],
            b: &mut [$real],
            ldb: i32,
            info: &mut i32,
        ) {
            let n = size(n);
            let (a, b) = (matrix_mut(a, n, n, size(lda)), matrix_mut(b, n, size(nrhs), size(ldb)));
            *info = info_of(lu_solve(a, ipiv, b));
        }
    };
}

factorisations!(f32, ssyevr, spotrf, spotrs, sgesdd, sgesvd, sgesv);
factorisations!(f64, dsyevr, dpotrf, dpotrs, dgesdd, dgesvd, dgesv);
