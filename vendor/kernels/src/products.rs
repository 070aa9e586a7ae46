//! Products.

use faer::linalg::matmul::triangular::BlockStructure;
use faer::linalg::matmul::{matmul, triangular};
use faer::{Accum, MatMut, MatRef, Par};

use crate::{Real, Triangle};

/// `C = alpha A B + beta C`; with `beta = 0` what stands in `C` does not matter.
///
/// # Panics
/// When the shapes do not fit: a mistake of the caller.
pub fn multiply<T: Real>(mut c: MatMut<'_, T>, a: MatRef<'_, T>, b: MatRef<'_, T>, alpha: T, beta: T) {
    let accumulate = prepare(c.as_mut(), beta, |_, _| true);
    matmul(c, accumulate, a, b, alpha, Par::Seq);
}

/// One half of `C = alpha A B + beta C` for a square `C`; see [`multiply`].
///
/// # Panics
/// As [`multiply`].
pub fn multiply_triangle<T: Real>(
    half: Triangle,
    mut c: MatMut<'_, T>,
    (a, b): (MatRef<'_, T>, MatRef<'_, T>),
    alpha: T,
    beta: T,
) {
    let accumulate = prepare(c.as_mut(), beta, |i, j| match half {
        Triangle::Lower => i >= j,
        Triangle::Upper => i <= j,
    });
    let full = BlockStructure::Rectangular;
    triangular::matmul(c, structure(half), accumulate, a, full, b, full, alpha, Par::Seq);
}

/// `C = alpha S B + beta C` for a symmetric `S` of which one half is given; see [`multiply`].
///
/// # Panics
/// As [`multiply`].
pub fn multiply_symmetric<T: Real>(
    half: Triangle,
    mut c: MatMut<'_, T>,
    (s, b): (MatRef<'_, T>, MatRef<'_, T>),
    alpha: T,
    beta: T,
) {
    let accumulate = prepare(c.as_mut(), beta, |_, _| true);
    let full = BlockStructure::Rectangular;
    let other = match half {
        Triangle::Lower => BlockStructure::StrictTriangularUpper,
        Triangle::Upper => BlockStructure::StrictTriangularLower,
    };
    triangular::matmul(c.as_mut(), full, accumulate, s, structure(half), b, full, alpha, Par::Seq);
    triangular::matmul(c, full, Accum::Add, s.transpose(), other, b, full, alpha, Par::Seq);
}

fn structure(half: Triangle) -> BlockStructure {
    match half {
        Triangle::Lower => BlockStructure::TriangularLower,
        Triangle::Upper => BlockStructure::TriangularUpper,
    }
}

/// Scales the part of `C` that is written by `beta`, and says whether the product replaces it.
fn prepare<T: Real>(mut c: MatMut<'_, T>, beta: T, written: impl Fn(usize, usize) -> bool) -> Accum {
    if beta == <T as num_traits::Zero>::zero() {
        return Accum::Replace;
    }
    for j in 0..c.ncols() {
        for i in (0..c.nrows()).filter(|i| written(*i, j)) {
            c[(i, j)] = beta * c[(i, j)];
        }
    }
    Accum::Add
}
