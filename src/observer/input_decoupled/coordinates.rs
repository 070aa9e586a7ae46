//! The coordinates in which `E` is `diag(I, 0)` (paper 001, system (2)).
#![expect(non_snake_case, reason = "matrix letters follow paper 001")]

use nalgebra::DMatrix;

use crate::numerics::{NumericsError, RankDecision, Tolerance, side_by_side, stack, svd};
use crate::system::DescriptorSystem;

/// A descriptor system split into differential and algebraic equations and states.
///
/// ```text
/// M E N = diag(I_r, 0),   x = N [x1; x2]
/// x1' = A1 x1 + A2 x2 + B1 u + D1 d
///  0  = A3 x1 + A4 x2 + B2 u + D2 d
///  y  = C1 x1 + C2 x2 + F d
/// ```
///
/// # Shapes
/// `M1`: r x e; `M2`: (e - r) x e; `N1`: n x r; `N2`: n x (n - r); the blocks accordingly.
///
/// # Source
/// Paper 001, (2); `M` and `N` are used there without a definition.
#[derive(Clone, Debug)]
pub struct Coordinates {
    /// Rank of `E`, which splits the coordinates.
    pub rank: RankDecision,
    /// Rows of `M` that give the differential equations: `M1 E = [I 0] N^-1`.
    pub M1: DMatrix<f64>,
    /// Rows of `M` that give the algebraic equations: `M2 E = 0`.
    pub M2: DMatrix<f64>,
    /// Columns of `N` that belong to the differential states.
    pub N1: DMatrix<f64>,
    /// Columns of `N` that belong to the algebraic states: `E N2 = 0`.
    pub N2: DMatrix<f64>,
    /// Differential states in the differential equations.
    pub A1: DMatrix<f64>,
    /// Algebraic states in the differential equations.
    pub A2: DMatrix<f64>,
    /// Differential states in the algebraic equations.
    pub A3: DMatrix<f64>,
    /// Algebraic states in the algebraic equations.
    pub A4: DMatrix<f64>,
    /// Known input in the differential equations.
    pub B1: DMatrix<f64>,
    /// Known input in the algebraic equations.
    pub B2: DMatrix<f64>,
    /// Unknown input in the differential equations.
    pub D1: DMatrix<f64>,
    /// Unknown input in the algebraic equations.
    pub D2: DMatrix<f64>,
    /// Differential states in the outputs.
    pub C1: DMatrix<f64>,
    /// Algebraic states in the outputs.
    pub C2: DMatrix<f64>,
    /// Feedthrough of the unknown input.
    pub F: DMatrix<f64>,
    /// Norm of `[A D; C F]`, against which ranks of these blocks are judged.
    pub scale: f64,
}

impl Coordinates {
    /// Rank r of `E`.
    pub fn r(&self) -> usize {
        self.N1.ncols()
    }

    /// Unknown inputs and algebraic states in the algebraic equations: `[A4 D2]`, (e - r) x (n - r + q).
    pub fn algebraic(&self) -> DMatrix<f64> {
        side_by_side(&[&self.A4, &self.D2])
    }

    /// The same in the differential equations: `X = [A2 D1]`.
    pub fn differential(&self) -> DMatrix<f64> {
        side_by_side(&[&self.A2, &self.D1])
    }

    /// The same in the outputs: `Y = [C2 F]`.
    pub fn measured(&self) -> DMatrix<f64> {
        side_by_side(&[&self.C2, &self.F])
    }
}

/// Splits a system.
///
/// Where the rows and columns of `E` that are not zero form a regular square block, `M` and `N` only sort (and scale by
/// that block), so that `x1` are states by name and numbers agree with calculation by hand; otherwise
/// `E = U diag(S, 0) V'`, `M = diag(S^-1, I) U'`, `N = V`.
///
/// # Errors
/// When the singular value decomposition of `E` fails its check.
pub fn coordinates(system: &DescriptorSystem, tolerance: &Tolerance) -> Result<Coordinates, NumericsError> {
    let DescriptorSystem { E, A, B, C, D, F, .. } = system;
    let found = svd(E)?;
    let rank = RankDecision::from_singular_values(E.shape(), found.s.clone(), 0.0, tolerance);
    let (e, n, r) = (E.nrows(), E.ncols(), rank.rank);
    let [M1, M2, N1, N2] = sorted(E, r).unwrap_or_else(|| {
        let mut M1 = found.u.columns(0, r).transpose();
        for (mut row, s) in M1.row_iter_mut().zip(&found.s) {
            row /= *s;
        }
        let M2 = found.u.columns(r, e - r).transpose();
        [M1, M2, found.v.columns(0, r).into_owned(), found.v.columns(r, n - r).into_owned()]
    });
    let scale = stack(&[&side_by_side(&[A, D]), &side_by_side(&[C, F])]).norm();
    Ok(Coordinates {
        A1: &M1 * A * &N1,
        A2: &M1 * A * &N2,
        A3: &M2 * A * &N1,
        A4: &M2 * A * &N2,
        B1: &M1 * B,
        B2: &M2 * B,
        D1: &M1 * D,
        D2: &M2 * D,
        C1: C * &N1,
        C2: C * &N2,
        F: F.clone(),
        rank,
        scale,
        M1,
        M2,
        N1,
        N2,
    })
}

/// `M1, M2, N1, N2` by sorting, when the rows and columns of `E` that are not zero are as many as its rank.
fn sorted(E: &DMatrix<f64>, r: usize) -> Option<[DMatrix<f64>; 4]> {
    let zero_row = |i: &usize| E.row(*i).iter().all(|x| *x == 0.0);
    let zero_column = |j: &usize| E.column(*j).iter().all(|x| *x == 0.0);
    let (no_rows, rows): (Vec<usize>, Vec<usize>) = (0..E.nrows()).partition(zero_row);
    let (no_columns, columns): (Vec<usize>, Vec<usize>) = (0..E.ncols()).partition(zero_column);
    if rows.len() != r || columns.len() != r {
        return None;
    }
    let block = E.select_rows(&rows).select_columns(&columns);
    let sort_rows = DMatrix::<f64>::identity(E.nrows(), E.nrows());
    let sort_columns = DMatrix::<f64>::identity(E.ncols(), E.ncols());
    // nalgebra does not factorise empty matrices
    let top = if r == 0 {
        DMatrix::zeros(0, E.nrows())
    } else {
        block.lu().solve(&sort_rows.select_rows(&rows))?
    };
    Some([
        top,
        sort_rows.select_rows(&no_rows),
        sort_columns.select_columns(&columns),
        sort_columns.select_columns(&no_columns),
    ])
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::dmatrix;

    fn split(E: DMatrix<f64>) -> Coordinates {
        let (A, C) = (DMatrix::from_element(E.nrows(), E.ncols(), 1.0), DMatrix::zeros(0, E.ncols()));
        coordinates(&DescriptorSystem::autonomous(E, A, C).unwrap(), &Tolerance::default()).unwrap()
    }

    /// `M E N = diag(I, 0)`.
    fn check(E: &DMatrix<f64>) -> Coordinates {
        let found = split(E.clone());
        let (M, N) = (stack(&[&found.M1, &found.M2]), side_by_side(&[&found.N1, &found.N2]));
        let mut wanted = DMatrix::zeros(E.nrows(), E.ncols());
        wanted.view_mut((0, 0), (found.r(), found.r())).fill_with_identity();
        let off = (M * E * N - wanted).norm();
        assert!(off < 1e-14, "M E N = diag(I, 0) for {E}: off by {off:.1e}");
        found
    }

    #[test]
    fn states_keep_their_names_where_sorting_is_enough() {
        let found = check(&dmatrix![0.0, 0.0, 0.0; 0.0, 0.0, 2.0; 1.0, 0.0, 1.0]);
        assert_eq!(found.N1, dmatrix![1.0, 0.0; 0.0, 0.0; 0.0, 1.0], "x1 = (x1, x3)");
        assert_eq!(found.N2, dmatrix![0.0; 1.0; 0.0], "x2 is the algebraic state");
    }

    #[test]
    fn dependent_rows_are_split_by_singular_values() {
        assert_eq!(check(&dmatrix![1.0, 2.0, 0.0; 2.0, 4.0, 0.0]).r(), 1, "two proportional rows");
    }

    #[test]
    fn no_derivatives_and_nothing_but_derivatives() {
        assert_eq!(check(&DMatrix::zeros(2, 3)).r(), 0, "all equations are algebraic");
        assert_eq!(check(&dmatrix![0.0, 3.0; 1.0, 1.0]).r(), 2, "none is");
    }
}
