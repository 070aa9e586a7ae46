//! Operators of matrix expressions, on values and on references.

use std::ops::{Add, Mul, Neg, Sub};

use nalgebra::DMatrix;

use super::affine::Affine;
use super::expression::Expr;

/// `left * a + right * b` for two factors.
fn combined(left: &Expr, a: f64, right: &Expr, b: f64) -> Expr {
    let shape = (left.nrows(), left.ncols());
    assert!(
        shape == (right.nrows(), right.ncols()),
        "a {} x {} expression added to a {} x {} one",
        right.nrows(),
        right.ncols(),
        left.nrows(),
        left.ncols()
    );
    Expr::from_fn(shape.0, shape.1, |i, j| {
        Affine::combination([(a, left.entry(i, j)), (b, right.entry(i, j))].into_iter())
    })
}

fn sum(left: &Expr, right: &Expr) -> Expr {
    combined(left, 1.0, right, 1.0)
}

fn difference(left: &Expr, right: &Expr) -> Expr {
    combined(left, 1.0, right, -1.0)
}

fn times_constant(left: &Expr, right: &DMatrix<f64>) -> Expr {
    let inner = left.ncols();
    assert!(
        inner == right.nrows(),
        "a {} x {inner} expression times a {} x {} matrix",
        left.nrows(),
        right.nrows(),
        right.ncols()
    );
    Expr::from_fn(left.nrows(), right.ncols(), |i, j| {
        Affine::combination((0..inner).map(|k| (right[(k, j)], left.entry(i, k))))
    })
}

fn constant_times(left: &DMatrix<f64>, right: &Expr) -> Expr {
    let inner = left.ncols();
    assert!(
        inner == right.nrows(),
        "a {} x {inner} matrix times a {} x {} expression",
        left.nrows(),
        right.nrows(),
        right.ncols()
    );
    Expr::from_fn(left.nrows(), right.ncols(), |i, j| {
        Affine::combination((0..inner).map(|k| (left[(i, k)], right.entry(k, j))))
    })
}

macro_rules! on_values_and_references {
    ($operator:ident, $method:ident, $left:ty, $right:ty, $rule:path) => {
        impl $operator<&$right> for &$left {
            type Output = Expr;
            fn $method(self, right: &$right) -> Expr {
                $rule(self, right)
            }
        }
        impl $operator<$right> for &$left {
            type Output = Expr;
            fn $method(self, right: $right) -> Expr {
                $rule(self, &right)
            }
        }
        impl $operator<&$right> for $left {
            type Output = Expr;
            fn $method(self, right: &$right) -> Expr {
                $rule(&self, right)
            }
        }
        impl $operator<$right> for $left {
            type Output = Expr;
            fn $method(self, right: $right) -> Expr {
                $rule(&self, &right)
            }
        }
    };
}

on_values_and_references!(Add, add, Expr, Expr, sum);
on_values_and_references!(Sub, sub, Expr, Expr, difference);
on_values_and_references!(Mul, mul, Expr, DMatrix<f64>, times_constant);
on_values_and_references!(Mul, mul, DMatrix<f64>, Expr, constant_times);

impl Neg for &Expr {
    type Output = Expr;
    fn neg(self) -> Expr {
        self.scaled(-1.0)
    }
}

impl Neg for Expr {
    type Output = Self;
    fn neg(self) -> Self {
        self.scaled(-1.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lmi::Problem;
    use nalgebra::dmatrix;

    const POINT: [f64; 3] = [1.0, 2.0, 3.0];

    fn x() -> Expr {
        Problem::new().symmetric("X", 2)
    }

    #[test]
    fn products_agree_with_those_of_the_values() {
        let (x, m) = (x(), dmatrix![1.0, -1.0, 0.0; 2.0, 0.5, 4.0]);
        let value = x.value(&POINT);
        assert_eq!((&x * &m).value(&POINT), &value * &m, "X M");
        assert_eq!((m.transpose() * &x).value(&POINT), m.transpose() * &value, "M' X");
        assert_eq!((m.transpose() * x * m.clone()).value(&POINT), m.transpose() * value * m, "M' X M");
    }

    #[test]
    fn sums_agree_with_those_of_the_values() {
        let (x, m) = (x(), dmatrix![1.0, 2.0; 5.0, 6.0]);
        let value = x.value(&POINT);
        let found = -(&x + Expr::constant(&m)) - &x;
        assert_eq!(found.value(&POINT), -&value - &m - &value, "-(X + M) - X");
        assert_eq!((&x - &x).value(&[]), DMatrix::zeros(2, 2), "X - X has no variables left");
    }

    #[test]
    fn empty_inner_dimension_gives_zeros() {
        let nothing = Expr::zeros(2, 0) * DMatrix::zeros(0, 3);
        assert_eq!(nothing, Expr::zeros(2, 3), "2 x 0 times 0 x 3");
    }

    #[test]
    #[should_panic(expected = "a 2 x 2 expression times a 3 x 1 matrix")]
    fn wrong_inner_dimension_is_named() {
        let _ = x() * DMatrix::zeros(3, 1);
    }
}
