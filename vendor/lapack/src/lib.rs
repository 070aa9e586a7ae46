//! Same signatures as lapack 0.19 for the six routines clarabel's `sdp` feature uses, f32 and f64.
#![allow(clippy::too_many_arguments)]
macro_rules! lapack {
    ($t:ty, $syevr:ident, $potrf:ident, $potrs:ident, $gesdd:ident, $gesvd:ident, $gesv:ident) => {
        pub fn $syevr(
            jobz: u8,
            range: u8,
            uplo: u8,
            n: i32,
            a: &mut [$t],
            lda: i32,
            _vl: $t,
            _vu: $t,
            _il: i32,
            _iu: i32,
            _abstol: $t,
            m: &mut i32,
            w: &mut [$t],
            z: &mut [$t],
            ldz: i32,
            _isuppz: &mut [i32],
            work: &mut [$t],
            lwork: i32,
            iwork: &mut [i32],
            liwork: i32,
            info: &mut i32,
        ) {
            assert!(range == b'A' && lda == n && (jobz == b'N' || ldz == n));
            (*info, *m) = (0, n);
            if lwork == -1 || liwork == -1 {
                work[0] = 1.0;
                iwork[0] = 1;
                return;
            } // no workspace needed
            dense_kernels::syev(uplo == b'U', n as usize, a, w, (jobz == b'V').then_some(z))
        }
        pub fn $potrf(uplo: u8, n: i32, a: &mut [$t], lda: i32, info: &mut i32) {
            *info = dense_kernels::potrf(uplo == b'U', n as usize, a, lda as usize) as i32
        }
        pub fn $potrs(
            uplo: u8,
            n: i32,
            nrhs: i32,
            a: &[$t],
            lda: i32,
            b: &mut [$t],
            ldb: i32,
            info: &mut i32,
        ) {
            *info = 0;
            dense_kernels::potrs(uplo == b'U', n as usize, nrhs as usize, a, lda as usize, b, ldb as usize)
        }
        pub fn $gesdd(
            job: u8,
            m: i32,
            n: i32,
            a: &mut [$t],
            lda: i32,
            s: &mut [$t],
            u: &mut [$t],
            ldu: i32,
            vt: &mut [$t],
            ldvt: i32,
            work: &mut [$t],
            lwork: i32,
            _iwork: &mut [i32],
            info: &mut i32,
        ) {
            assert!(job == b'S' && lda == m && ldu == m && ldvt == m.min(n));
            *info = 0;
            if lwork == -1 {
                work[0] = 1.0;
                return;
            }
            dense_kernels::gesvd(m as usize, n as usize, a, s, u, vt)
        }
        pub fn $gesvd(
            jobu: u8,
            jobvt: u8,
            m: i32,
            n: i32,
            a: &mut [$t],
            lda: i32,
            s: &mut [$t],
            u: &mut [$t],
            ldu: i32,
            vt: &mut [$t],
            ldvt: i32,
            work: &mut [$t],
            lwork: i32,
            info: &mut i32,
        ) {
            assert!(jobu == jobvt);
            $gesdd(jobu, m, n, a, lda, s, u, ldu, vt, ldvt, work, lwork, &mut [], info)
        }
        pub fn $gesv(
            n: i32,
            nrhs: i32,
            a: &mut [$t],
            lda: i32,
            ipiv: &mut [i32],
            b: &mut [$t],
            ldb: i32,
            info: &mut i32,
        ) {
            *info =
                dense_kernels::gesv(n as usize, nrhs as usize, a, lda as usize, ipiv, b, ldb as usize) as i32
        }
    };
}
lapack!(f32, ssyevr, spotrf, spotrs, sgesdd, sgesvd, sgesv);
lapack!(f64, dsyevr, dpotrf, dpotrs, dgesdd, dgesvd, dgesv);
