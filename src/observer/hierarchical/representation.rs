//! The hierarchical state-space representation of a network (paper 003, section II).
#![expect(non_snake_case, reason = "matrix letters follow paper 003")]

use nalgebra::{DMatrix, DVector};
use serde::{Deserialize, Serialize};

use super::bases::{row_space, shown_part};
use crate::numerics::{NumericsError, RankDecision, Tolerance};
use crate::observer::DesignError;
use crate::system::properties::PropertyError;
use crate::system::{Network, SystemError};

/// Most states `nu mu` of a global observer.
///
/// Pole placement and the PBH test work on the whole `alpha_z`; with a few outputs no gain of a larger one can be
/// trusted in double precision anyway.
pub const MOST_GLOBAL_STATES: usize = 48;

/// Why a network has no hierarchical representation here.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum HierarchyError {
    /// The matrices do not fit together.
    #[error(transparent)]
    System(#[from] SystemError),
    /// A computation failed.
    #[error(transparent)]
    Numerics(#[from] NumericsError),
    /// The global observer would be too large.
    #[error(
        "the global observer would have {} nu mu = {nu} * {mu} = {} states (nu = rank Gamma, mu = states of a subsystem \
         that its coupling output shows); at most {allowed} are possible: couple the subsystems by a Gamma of lower rank",
        if *exact { "exactly" } else { "at least" }, nu * mu
    )]
    TooLarge {
        /// Rank of `Gamma`, or a lower bound of it.
        nu: usize,
        /// Dimension of the part of a subsystem that is shown.
        mu: usize,
        /// Whether `nu` is the rank itself.
        exact: bool,
        /// The limit [`MOST_GLOBAL_STATES`].
        allowed: usize,
    },
}

impl From<HierarchyError> for DesignError {
    fn from(error: HierarchyError) -> Self {
        match error {
            HierarchyError::Numerics(error) => error.into(),
            HierarchyError::System(_) | HierarchyError::TooLarge { .. } => {
                Self::Unsuitable(error.to_string())
            }
        }
    }
}

impl From<PropertyError> for HierarchyError {
    fn from(error: PropertyError) -> Self {
        match error {
            PropertyError::System(error) => Self::System(error),
            PropertyError::Numerics(error) => Self::Numerics(error),
        }
    }
}

/// What a network shows of itself as a whole: `z = sigma_z x` obeys an equation of its own.
///
/// ```text
/// sigma_z = N' kron M',   alpha_z = I kron a_z + Gamma_nu kron b_z c_z,   gamma_z = Psi N kron c_G M
///       z' = alpha_z z,   y_G = gamma_z z                                                   under (11)
///     x_i' = a x_i + beta_i z,   beta_i = (Gamma N)_i kron b c_z
/// ```
///
/// `N` and `M` are orthonormal bases of the row spaces of `Gamma` and of the observability matrix of `(a, b c)`. Where
/// nothing of a subsystem is shown (mu = 0) the whole is empty, and `N` may be, too.
///
/// # Source
/// Paper 003, equations (7)-(12), Theorem 1 (which does not need a diagonalisable `Gamma`).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Hierarchy {
    /// Basis of the row space of `Gamma`, N x nu.
    pub N: DMatrix<f64>,
    /// Basis of the part of a subsystem that its coupling output shows, n x mu.
    pub M: DMatrix<f64>,
    /// `N' Gamma N`, nu x nu.
    pub Gamma_nu: DMatrix<f64>,
    /// `Gamma N`, N x nu: how each subsystem listens to the whole.
    pub Gamma_N: DMatrix<f64>,
    /// `M' a M`, mu x mu.
    pub a_z: DMatrix<f64>,
    /// `M' b`, mu x m.
    pub b_z: DMatrix<f64>,
    /// `c M`, m x mu.
    pub c_z: DMatrix<f64>,
    /// `b c_z`, n x mu: how the whole drives a subsystem.
    pub bc_z: DMatrix<f64>,
    /// `Psi N`, P x nu.
    pub Psi_N: DMatrix<f64>,
    /// `c_G M`, p x mu.
    pub c_GM: DMatrix<f64>,
    /// The decision on nu.
    pub nu: RankDecision,
    /// The printed observability matrix of `(a, b c)` beside mu; fragile also when its rank is not mu.
    pub mu: RankDecision,
}

impl Hierarchy {
    /// The representation of a network, without expanding it.
    ///
    /// # Errors
    /// Matrices that do not fit, a decomposition that fails its check, or more than [`MOST_GLOBAL_STATES`] states.
    ///
    /// # Examples
    /// ```
    /// use descry::numerics::Tolerance;
    /// use descry::observer::hierarchical::Hierarchy;
    /// use descry::system::Network;
    /// use nalgebra::dmatrix;
    /// // two integrators that pull each other together: what they show as a whole is their difference
    /// let network = Network {
    ///     a: dmatrix![0.0],
    ///     b: dmatrix![1.0],
    ///     c: dmatrix![1.0],
    ///     Gamma: dmatrix![-1.0, 1.0; 1.0, -1.0].into(),
    ///     Psi: dmatrix![1.0, -1.0],
    ///     c_G: dmatrix![1.0],
    ///     c_L: dmatrix![1.0],
    ///     local: vec![0],
    /// };
    /// let hierarchy = Hierarchy::of(&network, &Tolerance::default())?;
    /// assert_eq!(hierarchy.order(), 1);
    /// assert!((hierarchy.alpha_z()[(0, 0)] + 2.0).abs() < 1e-15);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn of(network: &Network, tolerance: &Tolerance) -> Result<Self, HierarchyError> {
        let Network { a, b, c, Gamma, Psi, c_G, .. } = &network.clone().checked()?;
        let shown = shown_part(a, &(b * c), tolerance)?;
        let (M, mut mu) = (shown.M, shown.printed);
        mu.fragile |= mu.rank != M.ncols();

        let most = MOST_GLOBAL_STATES / M.ncols().max(1);
        let space = row_space(Gamma, most, tolerance)?;
        let N = match space.basis {
            Some(N) => N,
            // nothing of a subsystem is shown: whatever Gamma is, there is no whole
            None if M.ncols() == 0 => DMatrix::zeros(Gamma.nrows(), 0),
            None => {
                return Err(HierarchyError::TooLarge {
                    nu: space.rank.rank,
                    mu: M.ncols(),
                    exact: space.rank.singular_values.len() >= Gamma.nrows(),
                    allowed: MOST_GLOBAL_STATES,
                });
            }
        };
        let Gamma_N = Gamma.times(&N);
        let c_z = c * &M;
        Ok(Self {
            Gamma_nu: N.tr_mul(&Gamma_N),
            a_z: M.tr_mul(&(a * &M)),
            b_z: M.tr_mul(b),
            bc_z: b * &c_z,
            c_z,
            Psi_N: Psi * &N,
            c_GM: c_G * &M,
            Gamma_N,
            N,
            M,
            nu: space.rank,
            mu,
        })
    }

    /// Number of states of the whole, `nu mu`.
    pub fn order(&self) -> usize {
        self.N.ncols() * self.M.ncols()
    }

    /// `I_nu kron a_z + Gamma_nu kron b_z c_z`.
    pub fn alpha_z(&self) -> DMatrix<f64> {
        let nu = self.N.ncols();
        DMatrix::<f64>::identity(nu, nu).kronecker(&self.a_z)
            + self.Gamma_nu.kronecker(&(&self.b_z * &self.c_z))
    }

    /// `Psi N kron c_G M`.
    pub fn gamma_z(&self) -> DMatrix<f64> {
        self.Psi_N.kronecker(&self.c_GM)
    }

    /// `gamma_z` reduced to at most as many rows as it has columns: what it sees is the same.
    pub(super) fn thin_gamma_z(&self) -> DMatrix<f64> {
        thin(&self.Psi_N).1.kronecker(&self.thin_c_GM())
    }

    /// `c_G M` reduced to at most mu rows.
    pub(super) fn thin_c_GM(&self) -> DMatrix<f64> {
        thin(&self.c_GM).1
    }

    /// `Psi N` reduced to at most nu rows.
    pub(super) fn thin_Psi_N(&self) -> DMatrix<f64> {
        thin(&self.Psi_N).1
    }

    /// The gain of [`Self::gamma_z`] that feeds back what a gain of [`Self::thin_gamma_z`] does.
    ///
    /// ```text
    /// Psi N = Q_1 R_1,   c_G M = Q_2 R_2:   H gamma_z = H_thin (Q_1 kron Q_2)' (Q_1 kron Q_2) (R_1 kron R_2)
    /// ```
    pub(super) fn full_gain(&self, of_thin: DMatrix<f64>) -> DMatrix<f64> {
        match (thin(&self.Psi_N).0, thin(&self.c_GM).0) {
            (None, None) => of_thin,
            (first, second) => {
                let unit = |matrix: &DMatrix<f64>| DMatrix::identity(matrix.nrows(), matrix.nrows());
                let first = first.unwrap_or_else(|| unit(&self.Psi_N));
                let second = second.unwrap_or_else(|| unit(&self.c_GM));
                of_thin * first.kronecker(&second).transpose()
            }
        }
    }

    /// The rows of `beta_z` that belong to one subsystem: `(Gamma N)_i kron b c_z`, n x nu mu.
    ///
    /// # Panics
    /// When there is no such subsystem.
    pub fn beta(&self, subsystem: usize) -> DMatrix<f64> {
        self.Gamma_N.rows(subsystem, 1).into_owned().kronecker(&self.bc_z)
    }

    /// `sigma_z = N' kron M'`, nu mu x N n; for small networks only, nothing else needs it.
    pub fn sigma_z(&self) -> DMatrix<f64> {
        self.N.transpose().kronecker(&self.M.transpose())
    }

    /// `z = sigma_z x` for a state whose columns are the subsystems' states: `vec(M' X N)`.
    ///
    /// # Shapes
    /// `X`: n x N.
    ///
    /// # Panics
    /// When `X` has another shape.
    pub fn z(&self, X: &DMatrix<f64>) -> DVector<f64> {
        let Z = self.M.tr_mul(&(X * &self.N));
        DVector::from_column_slice(Z.as_slice())
    }

    /// The state with the smallest norm that shows `z`, one column for each subsystem: `sigma_z^+ z = vec(M Z N')`.
    ///
    /// # Panics
    /// When `z` has not [`Self::order`] entries.
    pub fn state_of(&self, z: &DVector<f64>) -> DMatrix<f64> {
        let Z = DMatrix::from_column_slice(self.M.ncols(), self.N.ncols(), z.as_slice());
        &self.M * Z * self.N.transpose()
    }
}

/// A matrix as `Q R` with no more rows in `R` than there are columns; one that has no more anyway is its own `R`.
fn thin(matrix: &DMatrix<f64>) -> (Option<DMatrix<f64>>, DMatrix<f64>) {
    if matrix.nrows() <= matrix.ncols() {
        return (None, matrix.clone());
    }
    if matrix.ncols() == 0 {
        return (Some(matrix.clone()), DMatrix::zeros(0, 0));
    }
    let (Q, R) = matrix.clone().qr().unpack();
    (Some(Q), R)
}
