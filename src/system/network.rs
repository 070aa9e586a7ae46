//! Network of identical subsystems coupled by a matrix (paper 003).
#![expect(non_snake_case, reason = "matrix letters follow paper 003")]

use nalgebra::DMatrix;

use super::{CouplingMatrix, DescriptorSystem, SystemError, TimeDomain};

/// `N` identical subsystems, their coupling and their measurements.
///
/// ```text
/// x_i' = a x_i + b u_i,   w_i = c x_i,   u = (Gamma kron I) w
/// y_G = (Psi kron c_G) x,   y_i = c_L x_i for i in local
/// ```
///
/// # Shapes
/// `a`: n x n; `b`: n x m; `c`: m x n; `Gamma`: N x N; `Psi`: P x N; `c_G` and `c_L`: any number of rows, n columns.
#[derive(Clone, Debug, PartialEq)]
pub struct Network {
    /// State matrix of one subsystem (the paper's `a_I`).
    pub a: DMatrix<f64>,
    /// Its coupling input (`b_I`).
    pub b: DMatrix<f64>,
    /// Its coupling output (`c_I`).
    pub c: DMatrix<f64>,
    /// Coupling between subsystems; large networks give it by its entries.
    pub Gamma: CouplingMatrix,
    /// Which combinations of subsystems are measured globally.
    pub Psi: DMatrix<f64>,
    /// What is measured of them.
    pub c_G: DMatrix<f64>,
    /// What is measured locally.
    pub c_L: DMatrix<f64>,
    /// The subsystems with local measurements, from zero (the paper's set I, from one).
    pub local: Vec<usize>,
}

/// Most rows of `Psi kron c_G`. No more than `nu mu` of them, at most 48, can show anything new, and every test of the
/// global output works on all.
pub const MOST_GLOBAL_OUTPUTS: usize = 200;

impl Network {
    /// Number of subsystems N.
    pub fn n_subsystems(&self) -> usize {
        self.Gamma.nrows()
    }

    /// Checks shapes, entries and the indices of local measurements.
    ///
    /// # Errors
    /// The first matrix that does not fit.
    pub fn checked(self) -> Result<Self, SystemError> {
        let (n, m, big) = (self.a.nrows(), self.b.ncols(), self.Gamma.nrows());
        if n == 0 {
            return Err(SystemError::NoStates);
        }
        if self.Gamma.shape() != (big, big) {
            let found = self.Gamma.shape();
            return Err(SystemError::Shape {
                matrix: "Gamma",
                found,
                needed: (big, big),
                reason: "Gamma is square",
            });
        }
        if big == 0 {
            let reason = "a network has at least one subsystem";
            return Err(SystemError::Shape { matrix: "Gamma", found: (0, 0), needed: (1, 1), reason });
        }
        let reach = self.Gamma.reach();
        if reach.0.max(reach.1) > big {
            let reason = "it has a row and a column for each entry that is listed";
            return Err(SystemError::Shape { matrix: "Gamma", found: (big, big), needed: reach, reason });
        }
        if let Some((row, column)) = self.Gamma.not_finite() {
            return Err(SystemError::NotFinite { matrix: "Gamma", row, column });
        }
        let needed = [
            ("a", &self.a, (n, n), "a is square"),
            ("b", &self.b, (n, m), "b has a row for each state of a subsystem"),
            ("c", &self.c, (m, n), "c has a row for each column of b and a column for each state"),
            ("Psi", &self.Psi, (self.Psi.nrows(), big), "Psi has a column for each subsystem"),
            ("c_G", &self.c_G, (self.c_G.nrows(), n), "c_G has a column for each state of a subsystem"),
            ("c_L", &self.c_L, (self.c_L.nrows(), n), "c_L has a column for each state of a subsystem"),
        ];
        for (matrix, given, shape, reason) in needed {
            if given.shape() != shape {
                return Err(SystemError::Shape { matrix, found: given.shape(), needed: shape, reason });
            }
            if let Some(at) = given.iter().position(|x| !x.is_finite()) {
                return Err(SystemError::NotFinite {
                    matrix,
                    row: at % given.nrows(),
                    column: at / given.nrows(),
                });
            }
        }
        let global = self.Psi.nrows() * self.c_G.nrows();
        if global > MOST_GLOBAL_OUTPUTS {
            return Err(SystemError::GlobalOutputs { found: global, limit: MOST_GLOBAL_OUTPUTS });
        }
        let last = self.local.iter().max().map_or(0, |i| i + 1);
        if last > big {
            return Err(SystemError::Shape {
                matrix: "e_I",
                found: (last, self.local.len()),
                needed: (big, self.local.len()),
                reason: "a subsystem with local measurements is one of the N subsystems",
            });
        }
        Ok(self)
    }

    /// The network as one descriptor system with `E = I`; for small networks only, the theory never needs it.
    ///
    /// ```text
    /// A = I kron a + Gamma kron b c,   C = [Psi kron c_G; e_i' kron c_L]
    /// ```
    ///
    /// # Source
    /// Paper 003, equations (4)-(6).
    pub fn expanded(&self) -> DescriptorSystem {
        let (n, big) = (self.a.nrows(), self.n_subsystems());
        let unit = DMatrix::<f64>::identity(big, big);
        let total = n * big;
        let A = unit.kronecker(&self.a) + self.Gamma.dense().kronecker(&(&self.b * &self.c));
        let local = unit.select_rows(&self.local).kronecker(&self.c_L);
        let C = crate::numerics::stack(&[&self.Psi.kronecker(&self.c_G), &local]);
        let none = |rows| DMatrix::zeros(rows, 0);
        let F = none(C.nrows());
        DescriptorSystem {
            time: TimeDomain::Continuous,
            E: DMatrix::identity(total, total),
            A,
            B: none(total),
            C,
            D: none(total),
            F,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::dmatrix;

    fn pair() -> Network {
        Network {
            a: dmatrix![-1.0],
            b: dmatrix![1.0],
            c: dmatrix![1.0],
            Gamma: dmatrix![-1.0, 1.0; 1.0, -1.0].into(),
            Psi: dmatrix![1.0, -1.0],
            c_G: dmatrix![1.0],
            c_L: dmatrix![2.0],
            local: vec![1],
        }
    }

    #[test]
    fn a_pair_expands_to_the_coupled_system() {
        let system = pair().checked().unwrap().expanded();
        assert_eq!(system.A, dmatrix![-2.0, 1.0; 1.0, -2.0], "a on the diagonal plus the coupling");
        assert_eq!(system.C, dmatrix![1.0, -1.0; 0.0, 2.0], "global row, then the local one");
    }

    #[test]
    fn more_global_outputs_than_can_be_tested_are_refused() {
        let many = |rows| DMatrix::from_element(rows, 2, 1.0);
        let network = |rows| Network { Psi: many(rows), c_G: dmatrix![1.0; 2.0], ..pair() };
        assert!(network(MOST_GLOBAL_OUTPUTS / 2).checked().is_ok(), "as many as are possible");
        let found = network(MOST_GLOBAL_OUTPUTS / 2 + 1).checked();
        assert!(
            matches!(found, Err(SystemError::GlobalOutputs { found: 202, limit: MOST_GLOBAL_OUTPUTS })),
            "{found:?}"
        );
    }

    #[test]
    fn a_coupling_of_the_wrong_shape_is_named() {
        let network = Network { Gamma: dmatrix![0.0, 1.0].into(), ..pair() };
        assert!(
            matches!(network.checked(), Err(SystemError::Shape { matrix: "Gamma", .. })),
            "Gamma is not square"
        );
    }

    #[test]
    fn a_network_without_subsystems_is_refused() {
        let network = Network { Gamma: DMatrix::zeros(0, 0).into(), Psi: DMatrix::zeros(0, 0), ..pair() };
        let found = network.checked();
        assert!(matches!(found, Err(SystemError::Shape { matrix: "Gamma", found: (0, 0), .. })), "{found:?}");
    }

    #[test]
    fn a_sparse_coupling_expands_to_the_same_system() {
        let entries = vec![(0, 0, -1.0), (0, 1, 1.0), (1, 0, 1.0), (1, 1, -1.0)];
        let sparse = Network { Gamma: CouplingMatrix::Sparse { rows: 2, columns: 2, entries }, ..pair() };
        assert_eq!(sparse.checked().unwrap().expanded(), pair().expanded(), "the same entries");
    }

    #[test]
    fn entries_and_subsystems_outside_the_network_are_refused() {
        let entries = vec![(0, 2, 1.0)];
        let network = Network { Gamma: CouplingMatrix::Sparse { rows: 2, columns: 2, entries }, ..pair() };
        assert!(
            matches!(network.checked(), Err(SystemError::Shape { matrix: "Gamma", needed: (1, 3), .. })),
            "column 3 of 2"
        );
        let network = Network { local: vec![2], ..pair() };
        assert!(
            matches!(network.checked(), Err(SystemError::Shape { matrix: "e_I", found: (3, 1), .. })),
            "subsystem 3 of 2"
        );
    }
}
