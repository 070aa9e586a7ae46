//! The plant in one piece: the system, its Lipschitz term (empty when there is none), and `Phi`.
#![expect(non_snake_case, reason = "matrix letters follow paper 002")]

use nalgebra::DMatrix;

use super::basis::orthonormal_rows;
use crate::expression::Expression;
use crate::numerics::{NumericsError, Tolerance, stack, subspaces};
use crate::system::properties::PropertyError;
use crate::system::{DescriptorSystem, Model, SystemError};

/// What the method needs of a plant.
///
/// ```text
/// E x' = A x + B u + G f(x) + D d,   y = C x + F d,   Phi E = 0
/// ```
///
/// # Shapes
/// `G`: e x nf; `F_L`: l x n; `Phi`: r x e with orthonormal rows, r = e - rank E.
#[derive(Clone, Debug, PartialEq)]
pub struct Plant {
    /// The matrices.
    pub system: DescriptorSystem,
    /// Distribution of the nonlinearity (the paper's D); no columns without one.
    pub G: DMatrix<f64>,
    /// What the nonlinearity depends on.
    pub F_L: DMatrix<f64>,
    /// The Lipschitz constant (the paper's lambda).
    pub lambda: f64,
    /// The components of the nonlinearity.
    pub f: Vec<Expression>,
    /// The algebraic equations: an orthonormal basis of the left null space of `E`.
    pub Phi: DMatrix<f64>,
}

impl Plant {
    /// Reads a model; a nonlinearity with Lipschitz constant zero cannot disturb the error and is left out of `G`.
    ///
    /// # Errors
    /// A matrix that does not fit or is not finite.
    pub fn new(model: &Model, tolerance: &Tolerance) -> Result<Self, PropertyError> {
        let system = model.system.clone().checked()?;
        let (e, n) = system.E.shape();
        let (G, F_L, lambda, f) = match &model.lipschitz {
            None => (DMatrix::zeros(e, 0), DMatrix::zeros(0, n), 0.0, Vec::new()),
            Some(term) => (term.G.clone(), term.F_L.clone(), term.constant, term.f.clone()),
        };
        let columns = if model.lipschitz.is_some() { f.len() } else { 0 };
        fits("G", &G, (e, columns), "G has a row for each equation and a column for each component of f")?;
        fits("F_L", &F_L, (F_L.nrows(), n), "F_L has a column for each state, as E")?;
        fits("the Lipschitz constant", &DMatrix::from_element(1, 1, lambda), (1, 1), "one number")?;
        let Phi = annihilator(&system.E, tolerance)?;
        Ok(Self { system, G, F_L, lambda, f, Phi })
    }

    /// Number of states.
    pub fn n(&self) -> usize {
        self.system.n_states()
    }

    /// `Phi A`.
    pub fn Phi_A(&self) -> DMatrix<f64> {
        &self.Phi * &self.system.A
    }

    /// `[Phi A; C]`: what algebraic equations and outputs tell of the state.
    pub fn known(&self) -> DMatrix<f64> {
        stack(&[&self.Phi_A(), &self.system.C])
    }

    /// `[E; Phi A; C]`.
    pub fn Theta(&self) -> DMatrix<f64> {
        stack(&[&self.system.E, &self.Phi_A(), &self.system.C])
    }

    /// The plant with another Lipschitz constant.
    pub fn with_constant(&self, lambda: f64) -> Self {
        Self { lambda, ..self.clone() }
    }

    /// Columns of the nonlinearity that count: none when it is constant.
    pub fn acting(&self) -> DMatrix<f64> {
        let columns = if self.lambda == 0.0 || self.F_L.nrows() == 0 { 0 } else { self.G.ncols() };
        self.G.columns(0, columns).into_owned()
    }
}

/// `Phi`: an orthonormal basis of `{phi : phi E = 0}` that depends on nothing but this space.
fn annihilator(E: &DMatrix<f64>, tolerance: &Tolerance) -> Result<DMatrix<f64>, NumericsError> {
    Ok(orthonormal_rows(&subspaces(E, 0.0, tolerance)?.left_null.transpose()))
}

fn fits(
    matrix: &'static str,
    given: &DMatrix<f64>,
    needed: (usize, usize),
    reason: &'static str,
) -> Result<(), SystemError> {
    if given.shape() != needed {
        return Err(SystemError::Shape { matrix, found: given.shape(), needed, reason });
    }
    match given.iter().position(|x| !x.is_finite()) {
        Some(at) => {
            Err(SystemError::NotFinite { matrix, row: at % given.nrows(), column: at / given.nrows() })
        }
        None => Ok(()),
    }
}
