//! Lipschitz term of a descriptor system (paper 002).
#![expect(non_snake_case, reason = "matrix letters follow paper 002")]

use nalgebra::DMatrix;

use crate::expression::{Expression, ExpressionError};

/// A nonlinearity `G f(F_L x)` added to the right-hand side, with Lipschitz constant `constant`.
///
/// ```text
/// E x' = A x + B u + G f(x) + D d,   |f(x1) - f(x2)| <= constant * |F_L (x1 - x2)|
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

/// Reads a component of the nonlinearity: an expression in `x1 ... xn` and `t`.
///
/// # Errors
/// What is not understood, with its position.
pub fn nonlinearity(text: &str, n_states: usize) -> Result<Expression, ExpressionError> {
    let names: Vec<String> = (1..=n_states).map(|i| format!("x{i}")).chain(["t".to_owned()]).collect();
    let names: Vec<&str> = names.iter().map(String::as_str).collect();
    Expression::parse(text, &names)
}
