//! Factorisations and the solutions they give.

use faer::linalg::triangular_solve::{
    solve_lower_triangular_in_place, solve_unit_lower_triangular_in_place, solve_upper_triangular_in_place,
};
use faer::{Mat, MatMut, MatRef, Par, Side};
use num_traits::Float;

use crate::{Real, Triangle};

/// Cholesky factor of a symmetric matrix, in place of the half that is given: `A = L L'` or `A = U' U`.
///
/// # Errors
/// The number of the first pivot, counted from one, that is not positive or not finite; `A` is then unchanged.
pub fn cholesky<T: Real>(half: Triangle, mut a: MatMut<'_, T>) -> Result<(), usize> {
    let n = a.nrows();
    if let Some((i, _)) = places(half, n).find(|(i, j)| !Float::is_finite(a[(*i, *j)])) {
        return Err(i + 1);
    }
    let factor = match a.as_ref().llt(side(half)) {
        Ok(found) => found.L().to_owned(),
        Err(faer::linalg::cholesky::llt::factor::LltError::NonPositivePivot { index }) => {
            return Err(index + 1);
        }
    };
    if let Some(k) = (0..n).find(|k| !Float::is_finite(factor[(*k, *k)])) {
        return Err(k + 1);
    }
    for (i, j) in places(half, n) {
        a[(i, j)] = factor[(i.max(j), i.min(j))];
    }
    Ok(())
}

/// Solves `A X = B` in place of `B` from a factor that [`cholesky`] found.
pub fn cholesky_solve<T: Real>(half: Triangle, factor: MatRef<'_, T>, mut b: MatMut<'_, T>) {
    let lower = match half {
        Triangle::Lower => factor,
        Triangle::Upper => factor.transpose(),
    };
    solve_lower_triangular_in_place(lower, b.as_mut(), Par::Seq);
    solve_upper_triangular_in_place(lower.transpose(), b, Par::Seq);
}

/// Solves `A X = B` in place of `B` by elimination with row exchanges.
///
/// `A` becomes `L` (unit diagonal, not stored) and `U`; `exchanges[k]` is the row, counted from one, that was
/// exchanged with row `k`.
///
/// # Errors
/// The number of the first pivot, counted from one, that is exactly zero; `B` is then unchanged.
pub fn lu_solve<T: Real>(
    mut a: MatMut<'_, T>,
    exchanges: &mut [i32],
    mut b: MatMut<'_, T>,
) -> Result<(), usize> {
    let n = a.nrows();
    let found = a.as_ref().partial_piv_lu();
    let (l, u) = (found.L(), found.U());
    for (i, j) in (0..n).flat_map(|j| (0..n).map(move |i| (i, j))) {
        a[(i, j)] = if i > j { l[(i, j)] } else { u[(i, j)] };
    }
    let (forward, _) = found.P().arrays();
    // which original row stands in each place, as the exchanges are made one after the other
    let mut standing: Vec<usize> = (0..n).collect();
    for (k, (exchange, wanted)) in exchanges.iter_mut().zip(forward).enumerate() {
        let place = standing.iter().position(|row| row == wanted).unwrap_or(k);
        standing.swap(k, place);
        *exchange = i32::try_from(place + 1).unwrap_or(i32::MAX);
    }
    if let Some(k) = (0..n).find(|k| u[(*k, *k)] == <T as num_traits::Zero>::zero()) {
        return Err(k + 1);
    }
    let original = b.as_ref().to_owned();
    for (i, j) in (0..b.ncols()).flat_map(|j| (0..n).map(move |i| (i, j))) {
        b[(i, j)] = original[(forward[i], j)];
    }
    solve_unit_lower_triangular_in_place(l, b.as_mut(), Par::Seq);
    solve_upper_triangular_in_place(u, b, Par::Seq);
    Ok(())
}

/// Eigenvalues of a symmetric matrix of which one half is given, ascending, and its eigenvectors on request.
///
/// All are NaN when an entry is not finite.
pub fn symmetric_eigen<T: Real>(
    half: Triangle,
    a: MatRef<'_, T>,
    values: &mut [T],
    vectors: Option<MatMut<'_, T>>,
) {
    let n = a.nrows();
    if n == 0 {
        return; // faer panics
    }
    let scale = scale(places(half, n).map(|(i, j)| a[(i, j)]));
    let lower = Mat::from_fn(n, n, |i, j| match half {
        Triangle::Lower if i >= j => a[(i, j)] / scale,
        Triangle::Upper if i >= j => a[(j, i)] / scale,
        _ => <T as num_traits::Zero>::zero(),
    });
    let (mut found, mut basis): (Option<Vec<T>>, _) = (None, None);
    if Float::is_finite(scale) {
        if vectors.is_some() {
            basis = lower.self_adjoint_eigen(Side::Lower).ok();
            found = basis.as_ref().map(|basis| (0..n).map(|k| basis.S()[k]).collect());
        } else {
            found = lower.self_adjoint_eigenvalues(Side::Lower).ok();
        }
    }
    for (k, value) in values.iter_mut().take(n).enumerate() {
        *value = found.as_ref().map_or_else(T::nan, |found| found[k] * scale);
    }
    if let Some(mut vectors) = vectors {
        for (i, k) in (0..n).flat_map(|k| (0..n).map(move |i| (i, k))) {
            vectors[(i, k)] = basis.as_ref().map_or_else(T::nan, |basis| basis.U()[(i, k)]);
        }
    }
}

/// `A = U diag(values) V'` with `min(rows, columns)` singular values, descending.
///
/// All are NaN when an entry is not finite.
pub fn thin_svd<T: Real>(a: MatRef<'_, T>, values: &mut [T], mut u: MatMut<'_, T>, mut vt: MatMut<'_, T>) {
    let (rows, columns) = (a.nrows(), a.ncols());
    let count = rows.min(columns);
    let all = || (0..columns).flat_map(|j| (0..rows).map(move |i| (i, j)));
    let scale = scale(all().map(|(i, j)| a[(i, j)]));
    let scaled = Mat::from_fn(rows, columns, |i, j| a[(i, j)] / scale);
    let found = if Float::is_finite(scale) { scaled.thin_svd().ok() } else { None };
    for k in 0..count {
        values[k] = found.as_ref().map_or_else(T::nan, |found| found.S()[k] * scale);
        for i in 0..rows {
            u[(i, k)] = found.as_ref().map_or_else(T::nan, |found| found.U()[(i, k)]);
        }
        for j in 0..columns {
            vt[(k, j)] = found.as_ref().map_or_else(T::nan, |found| found.V()[(j, k)]);
        }
    }
}

fn side(half: Triangle) -> Side {
    match half {
        Triangle::Lower => Side::Lower,
        Triangle::Upper => Side::Upper,
    }
}

/// The places of one half.
fn places(half: Triangle, n: usize) -> impl Iterator<Item = (usize, usize)> {
    (0..n).flat_map(move |j| (j..n).map(move |i| if half == Triangle::Lower { (i, j) } else { (j, i) }))
}

/// A power of two by which to divide so that squares neither overflow nor vanish; NaN for entries that are not finite.
fn scale<T: Real>(entries: impl Iterator<Item = T>) -> T {
    let one = <T as num_traits::One>::one();
    let worse = |most: T, entry: T| {
        let size = Float::abs(entry);
        // not Float::max, which drops NaN
        if Float::is_nan(most) || size <= most { most } else { size }
    };
    let largest = entries.fold(<T as num_traits::Zero>::zero(), worse);
    if !Float::is_finite(largest) {
        return T::nan();
    }
    let exponent = Float::log2(largest);
    let quarter = Float::log2(<T as Float>::max_value()) / (one + one + one + one);
    if !Float::is_finite(exponent) || Float::abs(exponent) < quarter {
        one
    } else {
        Float::exp2(Float::floor(exponent))
    }
}
