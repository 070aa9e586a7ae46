//! The directions in which the states of a plant are free: one basis whatever a decomposition gives, and its words.

use nalgebra::{DMatrix, DVector};

/// A linear combination of states in words: `0.7071 x3 - 0.7071 x4`, `-x2`.
pub(super) fn combination(coefficients: impl Iterator<Item = f64>) -> String {
    const NOTHING: f64 = 1e-9;
    let mut text = String::new();
    for (j, x) in coefficients.enumerate().filter(|(_, x)| x.abs() > NOTHING) {
        text.push_str(match (text.is_empty(), x < 0.0) {
            (true, false) => "",
            (true, true) => "-",
            (false, false) => " + ",
            (false, true) => " - ",
        });
        let size = format!("{:.4}", x.abs());
        if size != "1.0000" {
            text.extend([size.as_str(), " "]);
        }
        text.extend(["x", &(j + 1).to_string()]);
    }
    text
}

/// Two diagonal entries of a projector closer than this count as equal, so that rounding does not choose between them.
const TIE: f64 = 1e-9;

/// The orthonormal basis of the same space that does not depend on the one that is given.
///
/// The projection of the coordinate that lies closest to the space (the first of equals) is one, with a positive entry
/// there; then the same with what is left. They are sorted by these coordinates, so that a new state behind the others
/// adds its direction behind theirs.
pub(super) fn canonical(basis: &DMatrix<f64>) -> DMatrix<f64> {
    let mut projector = basis * basis.transpose();
    let mut found = Vec::new();
    for _ in 0..basis.ncols() {
        let largest = projector.diagonal().iter().fold(0.0, |l: f64, x| l.max(*x));
        let Some(pivot) = projector.diagonal().iter().position(|x| *x >= largest - TIE) else { break };
        let direction = projector.column(pivot) / largest.sqrt().max(f64::MIN_POSITIVE);
        let direction = direction.normalize();
        projector -= &direction * direction.transpose();
        found.push((pivot, direction));
    }
    found.sort_by_key(|(pivot, _)| *pivot);
    let columns: Vec<DVector<f64>> = found.into_iter().map(|(_, direction)| direction).collect();
    if columns.is_empty() { DMatrix::zeros(basis.nrows(), 0) } else { DMatrix::from_columns(&columns) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{dmatrix, dvector};

    #[test]
    fn free_directions_do_not_depend_on_the_basis() {
        let basis = dmatrix![0.0, 0.0; 0.6, 0.0; 0.0, 1.0; -0.8, 0.0];
        let (s, c) = (0.7_f64.sin(), 0.7_f64.cos());
        let turned = &basis * dmatrix![c, s; s, -c];
        let (one, other) = (canonical(&basis), canonical(&turned));
        assert!((&one - &other).norm() < 1e-15, "{one}{other}");
        assert_eq!(one.column(0).into_owned(), dvector![0.0, 0.0, 1.0, 0.0], "x3 itself is free");
        assert!(one[(3, 1)] > 0.0, "the largest entry is positive: {one}");
    }

    #[test]
    fn combinations_read_as_they_are_written() {
        let words = |x: &[f64]| combination(x.iter().copied());
        assert_eq!(
            words(&[0.0, 0.0, 0.5_f64.sqrt(), -0.5_f64.sqrt()]),
            "0.7071 x3 - 0.7071 x4",
            "a difference"
        );
        assert_eq!(words(&[0.0, 1.0]), "x2", "a state itself");
        assert_eq!(words(&[-1.0, 0.25, 1e-12]), "-x1 + 0.2500 x2", "rounding is not shown");
    }
}
