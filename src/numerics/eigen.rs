//! Eigenvalues of square matrices, checked by traces.

use nalgebra::DMatrix;
use num_complex::Complex64;

use super::NumericsError;

/// Eigenvalues of a real square matrix in the order of [`super::sort_spectrum`].
///
/// The result is checked by `sum lambda = tr A` and `sum lambda^2 = tr A^2`.
///
/// # Errors
/// [`NumericsError::Shape`] for a matrix that is not square, [`NumericsError::NotFinite`] for entries that are not
/// finite, [`NumericsError::Unreliable`] when there is no convergence or the check fails.
pub fn eigenvalues(matrix: &DMatrix<f64>) -> Result<Vec<Complex64>, NumericsError> {
    let n = matrix.nrows();
    if !matrix.is_square() {
        return Err(NumericsError::Shape {
            what: "eigenvalues",
            found: format!("{} x {}", n, matrix.ncols()),
            needed: "a square matrix".to_owned(),
        });
    }
    if n == 0 {
        return Ok(Vec::new());
    }
    if matrix.iter().any(|x| !x.is_finite()) {
        return Err(NumericsError::NotFinite { rows: n, columns: n });
    }
    let unreliable = |residual| NumericsError::Unreliable {
        what: "eigenvalue decomposition",
        rows: n,
        columns: n,
        residual,
    };
    let balanced = balanced(matrix);
    let source = faer::Mat::<f64>::from_fn(n, n, |i, j| balanced[(i, j)]);
    let mut found = source.eigenvalues().map_err(|_no_convergence| unreliable(f64::INFINITY))?;
    let residual = trace_residual(&balanced.map(Complex64::from), &found);
    if residual > TRACE_LIMIT {
        return Err(unreliable(residual));
    }
    super::sort_spectrum(&mut found);
    Ok(found)
}

/// Eigenvalues of a complex square matrix in the order of [`super::sort_spectrum`], checked as those of [`eigenvalues`].
///
/// # Errors
/// As [`eigenvalues`].
pub fn complex_eigenvalues(matrix: &DMatrix<Complex64>) -> Result<Vec<Complex64>, NumericsError> {
    let n = matrix.nrows();
    if !matrix.is_square() {
        return Err(NumericsError::Shape {
            what: "eigenvalues",
            found: format!("{} x {}", n, matrix.ncols()),
            needed: "a square matrix".to_owned(),
        });
    }
    if n == 0 {
        return Ok(Vec::new());
    }
    if matrix.iter().any(|z| !z.re.is_finite() || !z.im.is_finite()) {
        return Err(NumericsError::NotFinite { rows: n, columns: n });
    }
    let unreliable = |residual| NumericsError::Unreliable {
        what: "eigenvalue decomposition",
        rows: n,
        columns: n,
        residual,
    };
    let source = faer::Mat::<faer::c64>::from_fn(n, n, |i, j| matrix[(i, j)]);
    let mut found = source.eigenvalues().map_err(|_no_convergence| unreliable(f64::INFINITY))?;
    let residual = trace_residual(matrix, &found);
    if residual > TRACE_LIMIT {
        return Err(unreliable(residual));
    }
    super::sort_spectrum(&mut found);
    Ok(found)
}

/// Largest relative trace defect that accepted eigenvalues may show.
const TRACE_LIMIT: f64 = 1e-10;

fn trace_residual(matrix: &DMatrix<Complex64>, eigenvalues: &[Complex64]) -> f64 {
    let size = matrix.norm().max(f64::MIN_POSITIVE);
    let n = matrix.nrows() as f64;
    let sum: Complex64 = eigenvalues.iter().sum();
    let squares: Complex64 = eigenvalues.iter().map(|z| (z / size) * (z / size)).sum();
    let normalised = matrix.map(|z| z / size);
    let first = (sum - matrix.trace()).norm() / (size * n);
    let second = (squares - (&normalised * &normalised).trace()).norm() / n;
    let worst = first.max(second);
    if worst.is_finite() { worst } else { f64::INFINITY }
}

/// Balances by a diagonal similarity with powers of two (exact): `D^-1 A D` with rows and columns of like norm.
///
/// # Source
/// Parlett and Reinsch, "Balancing a matrix for calculation of eigenvalues and eigenvectors", 1969.
fn balanced(matrix: &DMatrix<f64>) -> DMatrix<f64> {
    let n = matrix.nrows();
    let mut a = matrix.clone();
    const SWEEPS: usize = 20;
    for _ in 0..SWEEPS {
        let mut changed = false;
        for i in 0..n {
            let off = |sum: f64, j: usize, x: f64| if j == i { sum } else { sum + x.abs() };
            let column = (0..n).fold(0.0, |sum, j| off(sum, j, a[(j, i)]));
            let row = (0..n).fold(0.0, |sum, j| off(sum, j, a[(i, j)]));
            if column == 0.0 || row == 0.0 || !(column / row).is_finite() {
                continue;
            }
            // f = 2^k with column * f close to row / f
            let f = (0.5 * (row / column).log2()).round().exp2();
            if f.is_finite() && column * f + row / f < 0.95 * (column + row) {
                a.column_mut(i).iter_mut().for_each(|x| *x *= f);
                a.row_mut(i).iter_mut().for_each(|x| *x /= f);
                changed = true;
            }
        }
        if !changed {
            break;
        }
    }
    a
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::dmatrix;

    #[test]
    fn rotation_has_imaginary_eigenvalues() {
        let found = eigenvalues(&dmatrix![0.0, 2.0; -2.0, 0.0]).unwrap();
        assert!(found.iter().all(|z| z.re.abs() < 1e-15 && (z.im.abs() - 2.0).abs() < 1e-14), "{found:?}");
    }

    /// The cyclic matrix on which unshifted QR iterations never end.
    #[test]
    fn cyclic_permutation_converges() {
        let found =
            eigenvalues(&DMatrix::from_fn(7, 7, |i, j| f64::from(u8::from(j == (i + 1) % 7)))).unwrap();
        assert!(found.iter().all(|z| (z.norm() - 1.0).abs() < 1e-12), "roots of unity expected: {found:?}");
    }

    #[test]
    fn badly_scaled_matrix_is_balanced_first() {
        let found = eigenvalues(&dmatrix![1.0, 1e12; 1e-12, 2.0]).unwrap();
        let expected = (3.0 - 5.0_f64.sqrt()) / 2.0;
        assert!((found[0].re.min(found[1].re) - expected).abs() < 1e-13, "{found:?}");
    }

    #[test]
    fn a_complex_matrix_has_its_own_eigenvalues_and_not_their_conjugates() {
        let i = Complex64::i();
        let found =
            complex_eigenvalues(&dmatrix![2.0 + i, Complex64::from(5.0); Complex64::ZERO, -3.0 * i]).unwrap();
        for expected in [2.0 + i, -3.0 * i] {
            assert!(found.iter().any(|z| (z - expected).norm() < 1e-14), "{expected} in {found:?}");
        }
        let wrong = DMatrix::<Complex64>::zeros(2, 3);
        assert!(
            matches!(complex_eigenvalues(&wrong), Err(NumericsError::Shape { .. })),
            "2 x 3 is not square"
        );
    }

    #[test]
    fn rectangular_matrix_is_refused() {
        assert!(
            matches!(eigenvalues(&DMatrix::zeros(2, 3)), Err(NumericsError::Shape { .. })),
            "2 x 3 is not square"
        );
    }
}
