//! Restricted system equivalent: algebraic equations become outputs (paper 004, equation (4)).
#![expect(non_snake_case, reason = "matrix letters follow Koenig and Mammar 2002")]

use nalgebra::DMatrix;

use crate::numerics::{NumericsError, Tolerance, rank, stack, subspaces};
use crate::system::DescriptorSystem;

/// How the equations are split; the paper's condition (8) has three alternatives.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Alternative {
    /// rank E* = e: there is no algebraic equation, nothing is removed.
    FullRowRank,
    /// rank [E* N*] = rank E*: the unknown input does not act on the algebraic equations, which become outputs.
    UnknownInputInRange,
    /// rank [E*; C*] = n: nothing is removed. The weak alternative: `T1` may lack full column rank.
    FullColumnRank,
}

impl Alternative {
    /// The alternative as the paper writes it.
    pub fn formula(self) -> &'static str {
        match self {
            Self::FullRowRank => "rank E* = e",
            Self::UnknownInputInRange => "rank [E* N*] = rank E*",
            Self::FullColumnRank => "rank [E*; C*] = n",
        }
    }
}

/// The system (4) with `E` of full row rank (alternative 3: as given) and the extended output `y = [-B1 u; y*]`.
///
/// ```text
/// P* [E* N*] = [E N; 0 0],   P* A* = [A; A1],   P* B* = [B; B1],   C = [A1; C*]
/// y = y_u u + y_y y*
/// ```
///
/// # Shapes
/// `E`, `A`: r x n; `B`: r x k; `N`: r x nf; `C`: q x n with q = p + e - r; `y_u`: q x k; `y_y`: q x p;
/// `top`: r x e and `bottom`: (e - r) x e, the rows of `P*`.
#[derive(Clone, Debug)]
pub struct Equivalent {
    /// Rows of `P*` that keep differential equations.
    pub top: DMatrix<f64>,
    /// Rows of `P*` that extract algebraic equations; `bottom E* = 0`.
    pub bottom: DMatrix<f64>,
    /// Matrix of the derivatives.
    pub E: DMatrix<f64>,
    /// State matrix.
    pub A: DMatrix<f64>,
    /// Known input.
    pub B: DMatrix<f64>,
    /// Unknown input in the differential equations.
    pub N: DMatrix<f64>,
    /// Unknown input in the extended output: `[bottom N*; F*]`; zero under condition (8).
    pub N_output: DMatrix<f64>,
    /// Extended output matrix `[A1; C*]`.
    pub C: DMatrix<f64>,
    /// Known input in the extended output, `[-B1; 0]`.
    pub y_u: DMatrix<f64>,
    /// Measured output in the extended output, `[0; I]`.
    pub y_y: DMatrix<f64>,
}

/// Chooses the alternative of (8) in the order 2, 1, 3 of the print, which is from strong to weak.
///
/// `None` when (8) fails.
///
/// # Errors
/// When a singular value decomposition fails its check.
pub fn choose_alternative(
    system: &DescriptorSystem,
    tolerance: &Tolerance,
) -> Result<Option<Alternative>, NumericsError> {
    let DescriptorSystem { E, C, D, .. } = system;
    let r = rank(E, 0.0, tolerance)?.rank;
    if r == E.nrows() {
        return Ok(Some(Alternative::FullRowRank));
    }
    if rank(&crate::numerics::side_by_side(&[E, D]), 0.0, tolerance)?.rank == r {
        return Ok(Some(Alternative::UnknownInputInRange));
    }
    let full = rank(&stack(&[E, C]), 0.0, tolerance)?.rank == E.ncols();
    Ok(full.then_some(Alternative::FullColumnRank))
}

/// The system as it stands: no equation is moved to the outputs (alternatives 2 and 3 of (8)).
pub fn unchanged(system: &DescriptorSystem) -> Equivalent {
    let e = system.n_equations();
    split(system, DMatrix::identity(e, e), DMatrix::zeros(0, e))
}

/// Row-compresses `E*`: every algebraic equation becomes an output.
///
/// Rows that are already zero are moved by a permutation, so that gains stay comparable with hand calculation;
/// otherwise `P* = [range, left null space]'` of `E*`, orthonormal.
///
/// # Errors
/// When the singular value decomposition of `E*` fails its check.
pub fn compressed(system: &DescriptorSystem, tolerance: &Tolerance) -> Result<Equivalent, NumericsError> {
    let E = &system.E;
    let spaces = subspaces(E, 0.0, tolerance)?;
    let r = spaces.rank.rank;
    let is_zero = |i: &usize| E.row(*i).iter().all(|x| *x == 0.0);
    let (zero, nonzero): (Vec<usize>, Vec<usize>) = (0..E.nrows()).partition(is_zero);
    let (top, bottom) = if nonzero.len() == r {
        let unit = DMatrix::<f64>::identity(E.nrows(), E.nrows());
        (unit.select_rows(&nonzero), unit.select_rows(&zero))
    } else {
        (spaces.range.transpose(), spaces.left_null.transpose())
    };
    Ok(split(system, top, bottom))
}

fn split(system: &DescriptorSystem, top: DMatrix<f64>, bottom: DMatrix<f64>) -> Equivalent {
    let DescriptorSystem { E, A, B, C, D, F, .. } = system;
    let (p, k, b) = (C.nrows(), B.ncols(), bottom.nrows());
    Equivalent {
        E: &top * E,
        A: &top * A,
        B: &top * B,
        N: &top * D,
        N_output: stack(&[&(&bottom * D), F]),
        C: stack(&[&(&bottom * A), C]),
        y_u: stack(&[&-(&bottom * B), &DMatrix::zeros(p, k)]),
        y_y: stack(&[&DMatrix::zeros(b, p), &DMatrix::identity(p, p)]),
        top,
        bottom,
    }
}
