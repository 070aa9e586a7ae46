//! Full singular value decompositions, each checked before it is handed out.

use faer::c64;
use nalgebra::DMatrix;
use num_complex::Complex64;

use super::NumericsError;

/// `A = U diag(s) V^H` with square unitary `U` (rows x rows) and `V` (columns x columns).
///
/// `s` holds the `min(rows, columns)` singular values in descending order.
#[derive(Clone, Debug)]
pub struct Svd<T> {
    /// Left singular vectors, one per column.
    pub u: DMatrix<T>,
    /// Singular values, descending.
    pub s: Vec<f64>,
    /// Right singular vectors, one per column (not transposed).
    pub v: DMatrix<T>,
}

/// Largest relative residual that an accepted decomposition may show.
const RESIDUAL_LIMIT: f64 = 1e-11;

/// Full singular value decomposition of a real matrix.
///
/// # Errors
/// [`NumericsError::NotFinite`] for entries that are not finite; [`NumericsError::Unreliable`] when neither the
/// decomposition of `A` nor that of its transpose passes the check `norm(A - U S V') <= 1e-11 norm(A)`.
pub fn svd(matrix: &DMatrix<f64>) -> Result<Svd<f64>, NumericsError> {
    let (rows, columns) = matrix.shape();
    if rows == 0 || columns == 0 {
        return Ok(Svd {
            u: DMatrix::identity(rows, rows),
            s: Vec::new(),
            v: DMatrix::identity(columns, columns),
        });
    }
    if matrix.iter().any(|x| !x.is_finite()) {
        return Err(NumericsError::NotFinite { rows, columns });
    }
    let (scaled, scale) = scaled(matrix);
    let mut residual = f64::INFINITY;
    for transposed in [false, true] {
        let attempt = if transposed { real_svd(&scaled.transpose()).map(swapped) } else { real_svd(&scaled) };
        let Some(mut found) = attempt else { continue };
        let error = real_residual(&scaled, &found);
        if error <= RESIDUAL_LIMIT {
            found.s.iter_mut().for_each(|s| *s *= scale);
            return Ok(found);
        }
        residual = residual.min(error);
    }
    Err(NumericsError::Unreliable { what: "singular value decomposition", rows, columns, residual })
}

/// Full singular value decomposition of a complex matrix; see [`svd`].
///
/// # Errors
/// As [`svd`].
pub fn complex_svd(matrix: &DMatrix<Complex64>) -> Result<Svd<Complex64>, NumericsError> {
    let (rows, columns) = matrix.shape();
    if rows == 0 || columns == 0 {
        return Ok(Svd {
            u: DMatrix::identity(rows, rows),
            s: Vec::new(),
            v: DMatrix::identity(columns, columns),
        });
    }
    if matrix.iter().any(|z| !z.re.is_finite() || !z.im.is_finite()) {
        return Err(NumericsError::NotFinite { rows, columns });
    }
    let unreliable = |residual| NumericsError::Unreliable {
        what: "singular value decomposition",
        rows,
        columns,
        residual,
    };
    let source = faer::Mat::<c64>::from_fn(rows, columns, |i, j| matrix[(i, j)]);
    let found = source.svd().map_err(|_no_convergence| unreliable(f64::INFINITY))?;
    let result = Svd {
        u: DMatrix::from_fn(rows, rows, |i, j| found.U()[(i, j)]),
        s: (0..rows.min(columns)).map(|i| found.S()[i].re).collect(),
        v: DMatrix::from_fn(columns, columns, |i, j| found.V()[(i, j)]),
    };
    let k = result.s.len();
    let scaled_u = DMatrix::from_fn(rows, k, |i, j| result.u[(i, j)] * result.s[j]);
    let size = matrix.norm().max(f64::MIN_POSITIVE);
    let residual = (matrix - scaled_u * result.v.columns(0, k).adjoint()).norm() / size;
    if residual <= RESIDUAL_LIMIT { Ok(result) } else { Err(unreliable(residual)) }
}

/// The singular values of a real matrix alone, descending.
///
/// A matrix with many more rows than columns, or the other way round, is first reduced to the triangular factor of its
/// QR decomposition, which has the same singular values: no square matrix of its longer side is ever formed.
///
/// # Errors
/// As [`svd`].
pub fn singular_values(matrix: &DMatrix<f64>) -> Result<Vec<f64>, NumericsError> {
    /// Up to this many rows and columns a full decomposition costs nothing.
    const SMALL: usize = 100;
    let (rows, columns) = matrix.shape();
    if rows.max(columns) <= SMALL || rows.max(columns) < 2 * rows.min(columns) || matrix.is_empty() {
        return Ok(svd(matrix)?.s);
    }
    if matrix.iter().any(|x| !x.is_finite()) {
        return Err(NumericsError::NotFinite { rows, columns });
    }
    let (scaled, scale) = scaled(matrix);
    let tall = if rows > columns { scaled } else { scaled.transpose() };
    Ok(svd(&tall.qr().r())?.s.into_iter().map(|s| s * scale).collect())
}

/// Scales by a power of two so that squares neither overflow nor vanish.
fn scaled(matrix: &DMatrix<f64>) -> (DMatrix<f64>, f64) {
    let largest = matrix.amax();
    if largest == 0.0 || (1e-100..1e100).contains(&largest) {
        return (matrix.clone(), 1.0);
    }
    let scale = largest.log2().floor().exp2();
    (matrix / scale, scale)
}

fn real_svd(matrix: &DMatrix<f64>) -> Option<Svd<f64>> {
    let (rows, columns) = matrix.shape();
    let source = faer::Mat::<f64>::from_fn(rows, columns, |i, j| matrix[(i, j)]);
    let found = source.svd().ok()?;
    Some(Svd {
        u: DMatrix::from_fn(rows, rows, |i, j| found.U()[(i, j)]),
        s: (0..rows.min(columns)).map(|i| found.S()[i]).collect(),
        v: DMatrix::from_fn(columns, columns, |i, j| found.V()[(i, j)]),
    })
}

fn swapped(svd: Svd<f64>) -> Svd<f64> {
    Svd { u: svd.v, s: svd.s, v: svd.u }
}

/// The larger of the relative reconstruction error and the loss of orthogonality.
fn real_residual(matrix: &DMatrix<f64>, svd: &Svd<f64>) -> f64 {
    let k = svd.s.len();
    let scaled_u = DMatrix::from_fn(svd.u.nrows(), k, |i, j| svd.u[(i, j)] * svd.s[j]);
    let size = matrix.norm().max(f64::MIN_POSITIVE);
    let reconstruction = (matrix - scaled_u * svd.v.columns(0, k).transpose()).norm() / size;
    let orthogonality = |q: &DMatrix<f64>| (q.tr_mul(q) - DMatrix::identity(q.ncols(), q.ncols())).norm();
    let worst = reconstruction.max(orthogonality(&svd.u)).max(orthogonality(&svd.v));
    if worst.is_finite() { worst } else { f64::INFINITY }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::dmatrix;

    /// nalgebra 0.35 says `sigma_1 = 4.54` here; the truth is `sqrt(15)`.
    #[test]
    fn constant_matrix_has_the_exact_singular_value() {
        let found = svd(&DMatrix::from_element(3, 5, 1.0)).unwrap();
        assert!((found.s[0] - 15.0_f64.sqrt()).abs() < 1e-13, "sigma_1 = {}", found.s[0]);
        assert!(found.s[1] < 1e-14, "rank one matrix with sigma_2 = {}", found.s[1]);
        assert_eq!(
            (found.u.shape(), found.v.shape()),
            ((3, 3), (5, 5)),
            "the decomposition is full, not thin"
        );
    }

    #[test]
    fn extreme_scales_neither_overflow_nor_vanish() {
        for scale in [1e-200, 1e200] {
            let found = svd(&(dmatrix![3.0, 0.0; 0.0, 4.0] * scale)).unwrap();
            assert!((found.s[0] / scale - 4.0).abs() < 1e-14, "scale {scale}: {:?}", found.s);
        }
    }

    #[test]
    fn long_matrices_have_the_singular_values_of_their_triangular_factor() {
        let tall = DMatrix::from_fn(300, 3, |i, j| ((i + 1) as f64 * (j + 1) as f64).sin());
        let (all, alone) = (svd(&tall).unwrap().s, singular_values(&tall).unwrap());
        for (other, found) in
            [(&tall, &alone), (&tall.transpose(), &singular_values(&tall.transpose()).unwrap())]
        {
            let apart = all.iter().zip(found).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            assert!(found.len() == 3 && apart < 1e-13, "{:?}: {apart:.1e} apart", other.shape());
        }
    }

    #[test]
    fn a_matrix_with_nan_is_refused() {
        let error = svd(&dmatrix![1.0, f64::NAN]).unwrap_err();
        assert_eq!(error, NumericsError::NotFinite { rows: 1, columns: 2 });
    }

    #[test]
    fn complex_null_vector_is_found() {
        let i = Complex64::i();
        let matrix = dmatrix![Complex64::from(1.0), i; -i, Complex64::from(1.0)];
        let found = complex_svd(&matrix).unwrap();
        assert!(found.s[1] < 1e-15, "singular matrix with sigma_2 = {}", found.s[1]);
        assert!((&matrix * found.v.column(1)).norm() < 1e-15, "last right vector spans the kernel");
    }
}
