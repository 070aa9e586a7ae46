//! Lipschitz term of a descriptor system (paper 002).
#![expect(non_snake_case, reason = "matrix letters follow paper 002")]

use nalgebra::{DMatrix, DVector};

use super::DescriptorSystem;
use crate::expression::{Expression, ExpressionError};

/// A nonlinearity `G f(t, x)` added to the right-hand side, with Lipschitz constant `constant`.
///
/// ```text
/// E x' = A x + B u + G f(t, x) + D d,   |f(t, x1) - f(t, x2)| <= constant * |F_L (x1 - x2)|
/// ```
///
/// # Shapes
/// `G`: e x nf; `F_L`: l x n; `f`: nf expressions in `x1 ... xn` and `t`.
#[derive(Clone, Debug, PartialEq)]
pub struct LipschitzTerm {
    /// Distribution of the nonlinearity (the paper's D), e x nf.
    pub G: DMatrix<f64>,
    /// The states that it depends on, l x n.
    pub F_L: DMatrix<f64>,
    /// Its components.
    pub f: Vec<Expression>,
    /// The Lipschitz constant (the paper's lambda).
    pub constant: f64,
}

/// A Lipschitz term that does not fit its system, or has numbers that cannot be.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum LipschitzError {
    /// Wrong shape.
    #[error("{matrix} is {} x {}, but {} x {} is needed: {reason}", found.0, found.1, needed.0, needed.1)]
    Shape {
        /// Letter of the matrix.
        matrix: &'static str,
        /// Its shape.
        found: (usize, usize),
        /// The shape that fits.
        needed: (usize, usize),
        /// Why that shape is needed.
        reason: &'static str,
    },
    /// An infinite entry, or one that is not a number.
    #[error("{matrix}[{}, {}] is not a finite number", row + 1, column + 1)]
    NotFinite {
        /// Letter of the matrix.
        matrix: &'static str,
        /// Row, from zero.
        row: usize,
        /// Column, from zero.
        column: usize,
    },
    /// A constant that is negative or not finite.
    #[error("the Lipschitz constant is {found}, but a finite number from 0 is needed")]
    Constant {
        /// What was given.
        found: f64,
    },
    /// An expression in other variables than the states and the time.
    #[error("f[{}] = `{text}` is an expression in {found}, but one in x1 ... x{states} and t is needed", index + 1)]
    Variables {
        /// Which component, from zero.
        index: usize,
        /// The component as typed.
        text: String,
        /// Its variables.
        found: String,
        /// Number of states.
        states: usize,
    },
}

impl LipschitzTerm {
    /// Number of components nf.
    pub fn n_components(&self) -> usize {
        self.f.len()
    }

    /// Checks shapes, variables and numbers against a system, and returns the term when all fit.
    ///
    /// # Errors
    /// The first part that does not fit, with what was found and what is needed.
    pub fn checked(self, system: &DescriptorSystem) -> Result<Self, LipschitzError> {
        let (e, n) = system.E.shape();
        let (nf, l) = (self.f.len(), self.F_L.nrows());
        let needed = [
            (
                "G",
                &self.G,
                (e, nf),
                "G has a row for each equation, as E, and a column for each component of f",
            ),
            ("F_L", &self.F_L, (l, n), "F_L has a column for each state, as E"),
        ];
        for (matrix, given, needed, reason) in needed {
            if given.shape() != needed {
                return Err(LipschitzError::Shape { matrix, found: given.shape(), needed, reason });
            }
            if let Some(at) = given.iter().position(|x| !x.is_finite()) {
                let (row, column) = (at % given.nrows(), at / given.nrows());
                return Err(LipschitzError::NotFinite { matrix, row, column });
            }
        }
        let names = variables(n);
        if let Some(index) = self.f.iter().position(|f| f.variables() != names.as_slice()) {
            let (text, found) = (self.f[index].text().to_owned(), self.f[index].variables().join(", "));
            return Err(LipschitzError::Variables { index, text, found, states: n });
        }
        if !(self.constant.is_finite() && self.constant >= 0.0) {
            return Err(LipschitzError::Constant { found: self.constant });
        }
        Ok(self)
    }

    /// The value `f(t, x)`, nf components; not a number outside the domain of an expression.
    pub fn value(&self, t: f64, x: &DVector<f64>) -> DVector<f64> {
        let point = point(t, x);
        DVector::from_iterator(self.f.len(), self.f.iter().map(|f| f.value(&point)))
    }

    /// The derivative of `f` along `direction`, nf components: `df/dx * direction`.
    pub fn directional(&self, t: f64, x: &DVector<f64>, direction: &DVector<f64>) -> DVector<f64> {
        let point = point(t, x);
        let slopes = self.f.iter().map(|f| f.dual(&point, direction.as_slice()).1);
        DVector::from_iterator(self.f.len(), slopes)
    }

    /// The Jacobian `df/dx`, nf x n.
    pub fn jacobian(&self, t: f64, x: &DVector<f64>) -> DMatrix<f64> {
        let mut jacobian = DMatrix::zeros(self.f.len(), x.len());
        let mut direction = vec![0.0; x.len()];
        self.jacobian_into(&point(t, x), &mut direction, &mut jacobian);
        jacobian
    }

    /// Writes `f` at a point `[x; t]`.
    pub(crate) fn value_into(&self, point: &[f64], out: &mut [f64]) {
        for (out, f) in out.iter_mut().zip(&self.f) {
            *out = f.value(point);
        }
    }

    /// Writes `df/dx` at a point `[x; t]`; `direction` is room for n numbers, all zero.
    pub(crate) fn jacobian_into(&self, point: &[f64], direction: &mut [f64], out: &mut DMatrix<f64>) {
        for j in 0..direction.len() {
            direction[j] = 1.0;
            for (i, f) in self.f.iter().enumerate() {
                out[(i, j)] = f.dual(point, direction).1;
            }
            direction[j] = 0.0;
        }
    }

    /// For each state, whether it occurs in a component of `f`.
    pub(crate) fn states_seen(&self) -> Vec<bool> {
        (1..=self.F_L.ncols()).map(|i| self.f.iter().any(|f| f.uses(&format!("x{i}")))).collect()
    }
}

/// `[x; t]`, the values of the variables of an expression.
fn point(t: f64, x: &DVector<f64>) -> Vec<f64> {
    x.iter().copied().chain([t]).collect()
}

/// `x1 ... xn, t`.
fn variables(n_states: usize) -> Vec<String> {
    (1..=n_states).map(|i| format!("x{i}")).chain(["t".to_owned()]).collect()
}

/// Reads a component of the nonlinearity: an expression in `x1 ... xn` and `t`.
///
/// # Errors
/// What is not understood, with its position.
pub fn nonlinearity(text: &str, n_states: usize) -> Result<Expression, ExpressionError> {
    let names = variables(n_states);
    let names: Vec<&str> = names.iter().map(String::as_str).collect();
    Expression::parse(text, &names)
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{dmatrix, dvector};

    fn system() -> DescriptorSystem {
        DescriptorSystem::autonomous(DMatrix::identity(2, 2), DMatrix::zeros(2, 2), dmatrix![1.0, 0.0])
            .unwrap()
    }

    fn term() -> LipschitzTerm {
        LipschitzTerm {
            G: dmatrix![1.0, 0.0; 0.0, 1.0],
            F_L: DMatrix::identity(2, 2),
            f: vec![nonlinearity("sin(x1) * x2", 2).unwrap(), nonlinearity("t * x2^2", 2).unwrap()],
            constant: 1.0,
        }
    }

    #[test]
    fn value_and_slopes_are_those_of_the_expressions() {
        let (term, x) = (term().checked(&system()).unwrap(), dvector![0.3, 2.0]);
        assert_eq!(term.value(5.0, &x), dvector![0.3_f64.sin() * 2.0, 20.0], "f(5, x)");
        let jacobian = dmatrix![0.3_f64.cos() * 2.0, 0.3_f64.sin(); 0.0, 20.0];
        assert!((term.jacobian(5.0, &x) - &jacobian).amax() < 1e-15, "df/dx by hand");
        let v = dvector![0.7, -1.1];
        assert!((term.directional(5.0, &x, &v) - jacobian * v).amax() < 1e-14, "along a direction");
        assert_eq!(term.states_seen(), [true, true], "both states occur");
    }

    #[test]
    fn what_does_not_fit_is_named() {
        let says = |term: LipschitzTerm| term.checked(&system()).unwrap_err().to_string();
        let wrong = says(LipschitzTerm { G: dmatrix![1.0; 1.0], ..term() });
        assert!(wrong.starts_with("G is 2 x 1, but 2 x 2 is needed"), "{wrong}");
        let wrong = says(LipschitzTerm { F_L: dmatrix![1.0], ..term() });
        assert!(wrong.starts_with("F_L is 1 x 1, but 1 x 2 is needed"), "{wrong}");
        let wrong = says(LipschitzTerm { F_L: dmatrix![1.0, f64::NAN], ..term() });
        assert_eq!(wrong, "F_L[1, 2] is not a finite number");
        for constant in [-1.0, f64::NAN, f64::INFINITY] {
            let wrong = says(LipschitzTerm { constant, ..term() });
            assert!(wrong.contains("finite number from 0"), "{wrong}");
        }
        let other = vec![nonlinearity("x1", 2).unwrap(), nonlinearity("x3", 3).unwrap()];
        let wrong = says(LipschitzTerm { f: other, ..term() });
        assert!(wrong.contains("f[2] = `x3`") && wrong.contains("x1 ... x2 and t"), "{wrong}");
    }
}
