//! How far the poles move when the gain is rounded to double precision.

use nalgebra::{DMatrix, DVector};
use num_complex::Complex64;

/// First-order standard deviation of a linear function of a gain when its entries are rounded to nearest.
///
/// ```text
/// sqrt( sum_ik ( |left_i| ulp(L_ik) / sqrt 12  |right_k| )^2 )
/// ```
///
/// Rounding errors are uniform within half a unit in the last place. The bound `eps * sum_ik |left_i L_ik right_k|`
/// would be some thirty times too large on gains of ten states.
pub(super) fn rounding(left: &DVector<Complex64>, gain: &DMatrix<f64>, right: &DVector<Complex64>) -> f64 {
    let mut size = 0.0_f64;
    for (k, column) in gain.column_iter().enumerate() {
        for (l, x) in column.iter().zip(left.iter()) {
            // hypot keeps squares from overflowing
            size = size.hypot(x.norm() * last_place(*l) * right[k].norm());
        }
    }
    size / 12.0_f64.sqrt()
}

/// The unit in the last place: the distance of two neighbouring numbers; zero for zero.
fn last_place(x: f64) -> f64 {
    let x = x.abs();
    if x == 0.0 { 0.0 } else { x.next_up() - x }
}

/// Movement of a root of a monic polynomial whose value there changes by `change`.
///
/// ```text
/// |shift|^m * prod_(others farther than shift) |lambda - lambda_j| = change,   m - 1 others lie within the shift
/// ```
///
/// For a simple root this is `change / |p'(lambda)|`, for an m-fold one the m-th root of `m! change / |p^(m)(lambda)|`;
/// roots that are merely close count as equal once the shift reaches them.
pub(super) fn root_shift(change: f64, root: Complex64, others: impl Iterator<Item = Complex64>) -> f64 {
    let mut distances: Vec<f64> = others.map(|z| (z - root).norm()).collect();
    distances.sort_by(f64::total_cmp);
    let mut shift = 0.0;
    for within in 0..=distances.len() {
        // divided one by one: the product may overflow
        let m = (within + 1) as f64;
        shift = distances[within..].iter().fold(change, |rest, d| rest / d).powf(1.0 / m);
        if distances.get(within).is_none_or(|next| shift <= *next) {
            break;
        }
    }
    shift
}

/// Poles that differ from a given one by position in the list.
pub(super) fn others(poles: &[Complex64], index: usize) -> impl Iterator<Item = Complex64> + '_ {
    poles.iter().enumerate().filter(move |(j, _)| *j != index).map(|(_, z)| *z)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn shift(change: f64, others: &[f64]) -> f64 {
        root_shift(change, Complex64::ZERO, others.iter().map(|x| Complex64::from(*x)))
    }

    #[test]
    fn rounding_follows_the_last_place() {
        let vector = |x: f64| DVector::from_element(1, Complex64::from(x));
        let of = |l: f64| rounding(&vector(3.0), &DMatrix::from_element(1, 1, l), &vector(2.0));
        assert_eq!(
            of(1.9),
            6.0 * f64::EPSILON / 12.0_f64.sqrt(),
            "one unit in the last place of [1, 2) is eps"
        );
        assert_eq!(
            (of(-4.0), of(0.0)),
            (4.0 * of(1.0), 0.0),
            "units double with the exponent; zero is exact"
        );
    }

    #[test]
    fn simple_root_moves_by_the_derivative() {
        assert!((shift(1e-6, &[2.0, -5.0]) / 1e-7 - 1.0).abs() < 1e-12, "1e-6 / (2 * 5)");
    }

    #[test]
    fn double_root_moves_by_the_square_root() {
        assert!((shift(4e-6, &[0.0, 4.0]) / 1e-3 - 1.0).abs() < 1e-12, "sqrt(4e-6 / 4)");
        assert!((shift(8e-9, &[0.0, 0.0]) / 2e-3 - 1.0).abs() < 1e-12, "cube root of 8e-9");
    }

    #[test]
    fn nearly_double_root_moves_like_a_double_one() {
        let (near, double) = (shift(1e-6, &[1e-9, 1.0]), shift(1e-6, &[0.0, 1.0]));
        assert_eq!(near, double, "1e-9 is far within the shift of 1e-3");
    }
}
