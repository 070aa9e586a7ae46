//! Products, in plain loops down the columns.
//!
//! Not faer's: after its kernels the solver's own factorisation took more than twice as long, and these matrices are
//! too small to win that back.

use faer::{Mat, MatMut, MatRef};

use crate::{Real, Triangle};

/// `C = alpha A B + beta C`; with `beta = 0` what stands in `C` does not matter.
///
/// # Panics
/// When the shapes do not fit: a mistake of the caller.
pub fn multiply<T: Real>(c: MatMut<'_, T>, a: MatRef<'_, T>, b: MatRef<'_, T>, alpha: T, beta: T) {
    let rows = c.nrows();
    accumulate(c, (&a.to_owned(), b), alpha, beta, |_| (0, rows));
}

/// One half of `C = alpha A B + beta C` for a square `C`; see [`multiply`].
///
/// # Panics
/// As [`multiply`].
pub fn multiply_triangle<T: Real>(
    half: Triangle,
    c: MatMut<'_, T>,
    (a, b): (MatRef<'_, T>, MatRef<'_, T>),
    alpha: T,
    beta: T,
) {
    let rows = c.nrows();
    accumulate(c, (&a.to_owned(), b), alpha, beta, |j| match half {
        Triangle::Lower => (j, rows),
        Triangle::Upper => (0, j + 1),
    });
}

/// `C = alpha S B + beta C` for a symmetric `S` of which one half is given; see [`multiply`].
///
/// # Panics
/// As [`multiply`].
pub fn multiply_symmetric<T: Real>(
    half: Triangle,
    c: MatMut<'_, T>,
    (s, b): (MatRef<'_, T>, MatRef<'_, T>),
    alpha: T,
    beta: T,
) {
    let rows = c.nrows();
    let full = Mat::from_fn(s.nrows(), s.ncols(), |i, j| {
        let (low, high) = (i.max(j), i.min(j));
        if half == Triangle::Lower { s[(low, high)] } else { s[(high, low)] }
    });
    accumulate(c, (&full, b), alpha, beta, |_| (0, rows));
}

/// `C = alpha A B + beta C` in the rows from and to `range(j)` of each column `j`.
fn accumulate<T: Real>(
    mut c: MatMut<'_, T>,
    (a, b): (&Mat<T>, MatRef<'_, T>),
    alpha: T,
    beta: T,
    range: impl Fn(usize) -> (usize, usize),
) {
    let inner = a.ncols();
    assert!(
        (c.nrows(), c.ncols(), inner) == (a.nrows(), b.ncols(), b.nrows()),
        "a {} x {inner} matrix times a {} x {} one into {} x {}",
        a.nrows(),
        b.nrows(),
        b.ncols(),
        c.nrows(),
        c.ncols()
    );
    let zero = <T as num_traits::Zero>::zero();
    let mut sum = vec![zero; a.nrows()];
    for j in 0..c.ncols() {
        let (from, to) = range(j);
        let sum = &mut sum[from..to];
        sum.fill(zero);
        for k in 0..inner {
            let factor = alpha * b[(k, j)];
            let column = &a.col_as_slice(k)[from..to];
            for (total, entry) in sum.iter_mut().zip(column) {
                *total += factor * *entry;
            }
        }
        for (i, total) in (from..to).zip(&*sum) {
            c[(i, j)] = if beta == zero { *total } else { *total + beta * c[(i, j)] };
        }
    }
}
