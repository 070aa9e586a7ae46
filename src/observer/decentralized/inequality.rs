//! The inequalities of Theorems 1 and 2 in the form in which the paper writes them.
#![expect(non_snake_case, reason = "matrix letters follow paper 000")]

use nalgebra::DMatrix;

use super::Setup;
use crate::lmi::{Expr, Point, Problem};

/// What is demanded of one subsystem, in its own units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Demands {
    /// `Re s < -decay`, in discrete time `|z| < decay`.
    pub(super) decay: Option<f64>,
    /// Bound of the norms of `Y` and `Z`.
    pub(super) gain: Option<f64>,
    /// `t I <= X <= conditioning t I`.
    pub(super) conditioning: f64,
    /// A given attenuation; `None` leaves it free.
    pub(super) gamma: Option<f64>,
}

/// The unknowns and constraints of one subsystem.
#[derive(Clone, Debug)]
pub(super) struct Inequality {
    /// The problem.
    pub(super) problem: Problem,
    /// Lyapunov matrix in scaled units, beta x beta.
    pub(super) X: Expr,
    /// `W = X Y`, beta x l.
    pub(super) W: Expr,
    /// Free gain of the estimate, n x k.
    pub(super) Z: Expr,
    /// The attenuation, 1 x 1.
    pub(super) gamma: Expr,
    /// Scale of `X`, 1 x 1.
    t: Expr,
    units: Units,
}

/// Units in which the numbers of an inequality are near one; gamma is counted in `1 / source`.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Units {
    /// Rate by which `N` and `T D2` are divided; 1 in discrete time. Gamma does not depend on it.
    time: f64,
    /// Factor of the couplings.
    source: f64,
}

impl Units {
    /// Powers of two, so that no digit changes.
    fn of(setup: &Setup) -> Self {
        let Setup { family, decoupled, .. } = setup;
        let power_of_two = |x: f64| if x > 0.0 && x.is_finite() { x.log2().round().exp2() } else { 1.0 };
        let time = if setup.problem.is_discrete() {
            1.0
        } else {
            power_of_two(family.Lambda_N.norm().max(decoupled.A_bar.norm()))
        };
        let drive = family.Lambda_T.norm().max(decoupled.D2_bar.norm()).max(decoupled.Phi_D2.norm());
        Self { time, source: time / power_of_two(drive) }
    }
}

/// Where the inequality of an attenuation stands.
pub(super) fn source(setup: &Setup) -> &'static str {
    match (setup.family.order(), setup.problem.is_discrete()) {
        (0, _) => "paper 000, (18) without dynamics",
        (_, false) => "paper 000, Theorem 1, (34)",
        (_, true) => "paper 000, Theorem 2, (37)",
    }
}

/// Name of the block that an attenuation stands in.
pub(super) const ATTENUATION: &str = "attenuation";

impl Inequality {
    /// The Lyapunov matrix of the subsystem's own units, in which the proof is made.
    pub(super) fn lyapunov(&self, point: &Point) -> DMatrix<f64> {
        point.value(&self.X) * (self.units.source / self.units.time)
    }

    /// The attenuation in the subsystem's own units.
    pub(super) fn attenuation_at(&self, scaled: f64) -> f64 {
        scaled / self.units.source
    }

    /// The well-posed problem of one subsystem: the paper's inequality, the demand on the decay, bounds on the gains and
    /// on the condition of `X`.
    ///
    /// Without the bounds the least gamma is often not attained: gains grow without limit.
    pub(super) fn new(setup: &Setup, demands: &Demands) -> Self {
        let (beta, l) = (setup.family.order(), setup.family.L_N.nrows());
        let (n, k) = (setup.decoupled.n_states(), setup.family.M_P.nrows());
        let mut problem = Problem::new();
        let X = problem.symmetric("X", beta);
        let W = problem.matrix("W", beta, l);
        // without effect of the couplings the estimate's gain is of no use
        let driven = setup.is_driven();
        let units = Units::of(setup);
        let Z = if driven { problem.matrix("Z", n, k) } else { Expr::zeros(n, k) };
        let gamma = match demands.gamma {
            None if driven => problem.scalar("gamma"),
            given => Expr::constant(&DMatrix::from_element(1, 1, units.source * given.unwrap_or(0.0))),
        };
        let t = problem.scalar("t");
        let mut result = Self { problem, X, W, Z, gamma, t, units };
        if driven {
            let block = result.attenuation(setup);
            result.problem.strict(ATTENUATION, source(setup), block);
        }
        if beta > 0 {
            result.demand_decay(setup, demands);
            result.bound_condition(demands);
        }
        if let Some(gain) = demands.gain {
            result.bound_gains(gain);
        }
        result
    }

    /// `X N = X Lambda_N - W L_N`, per unit of time.
    ///
    /// # Source
    /// Paper 000, before (34).
    // ERRATUM(000, Theorem 2): the variables are X, Omega_Y = X Y and Z; the print leaves Z out and has "Omega_Yii".
    fn XN(&self, setup: &Setup) -> Expr {
        let Self { X, W, .. } = self;
        (X * &setup.family.Lambda_N - W * &setup.family.L_N).scaled(1.0 / self.units.time)
    }

    /// The bounded real inequality of `s.eps = N eps - T D2 v2, e = P eps + Q Phi D2 v2`.
    ///
    /// ```text
    /// X T D2 = X T_bar D2_bar - (X Lambda_Psi - W L_Psi) Phi D2
    /// P = Lambda_P - Z M_P,   Q = Lambda_Q - Z M_Q
    /// ```
    ///
    /// # Source
    /// Paper 000, (17), (18), Theorem 1 (34), Theorem 2 (37).
    fn attenuation(&self, setup: &Setup) -> Expr {
        let Self { X, W, Z, gamma, .. } = self;
        let family = &setup.family;
        let Phi_D2 = &setup.decoupled.Phi_D2;
        let (beta, n, q2) = (family.order(), setup.decoupled.n_states(), Phi_D2.ncols());

        let XN = self.XN(setup);
        let XTD2 =
            X * &family.Lambda_T - W * &family.L_T - (X * &family.Lambda_Psi - W * &family.L_Psi) * Phi_D2;
        let P = Expr::constant(&family.Lambda_P) - Z * &family.M_P;
        let QPhiD2 = (Expr::constant(&family.Lambda_Q) - Z * &family.M_Q) * Phi_D2;
        let XTD2 = XTD2.scaled(self.units.source / self.units.time);
        let QPhiD2 = QPhiD2.scaled(self.units.source);
        let gamma_I = |size| gamma.times(&DMatrix::identity(size, size));

        if beta == 0 {
            return Expr::symmetric(vec![vec![gamma_I(q2), QPhiD2.transpose()], vec![gamma_I(n)]]);
        }
        if setup.problem.is_discrete() {
            let zeros = Expr::zeros;
            // (37)
            return Expr::symmetric(vec![
                vec![X.clone(), zeros(beta, n), XN, -XTD2],
                vec![gamma_I(n), P, QPhiD2],
                vec![X.clone(), zeros(beta, q2)],
                vec![gamma_I(q2)],
            ]);
        }
        // ERRATUM(000, eq. 34): the block printed as "(2,4)" is (3,2).
        // (34)
        Expr::symmetric(vec![
            vec![-XN.he(), -XTD2, P.transpose()],
            vec![gamma_I(q2), -QPhiD2.transpose()],
            vec![gamma_I(n)],
        ])
    }

    /// Decay of the error; alone it is stability.
    ///
    /// ```text
    /// continuous: -(X N) - (X N)' - 2 alpha X > 0        discrete: [alpha X, X N; (X N)', alpha X] > 0
    /// ```
    fn demand_decay(&mut self, setup: &Setup, demands: &Demands) {
        if demands.decay.is_none() && setup.is_driven() {
            return; // (34) and (37) imply stability
        }
        let XN = self.XN(setup);
        let (name, source) = match demands.decay {
            Some(_) => ("decay rate", "Lyapunov inequality with decay rate"),
            None => ("stability", "Lyapunov inequality"),
        };
        let block = if setup.problem.is_discrete() {
            let radius = self.X.scaled(demands.decay.unwrap_or(1.0));
            Expr::symmetric(vec![vec![radius.clone(), XN], vec![radius]])
        } else {
            -XN.he() - self.X.scaled(2.0 * demands.decay.unwrap_or(0.0) / self.units.time)
        };
        self.problem.strict(name, source, block);
    }

    /// `X > 0`, `t I <= X <= kappa t I`.
    fn bound_condition(&mut self, demands: &Demands) {
        let beta = self.X.nrows();
        self.problem.strict("Lyapunov matrix", "X > 0", self.X.clone());
        let t_I = self.t.times(&DMatrix::identity(beta, beta));
        self.problem.bound("condition of X", "t I <= X", &self.X - &t_I);
        let kappa_t_I = t_I.scaled(demands.conditioning);
        self.problem.bound("condition of X", "X <= kappa t I", kappa_t_I - &self.X);
    }

    /// The norm bounds `|Y| <= rho`, free of the scale of `X`, and `|Z| <= rho`.
    ///
    /// ```text
    /// [rho^2 t I, W'; W, X] >= 0 with X >= t I  =>  |X^-1 W| <= rho,        [rho I, Z; Z', rho I] >= 0
    /// ```
    fn bound_gains(&mut self, rho: f64) {
        let (l, n, k) = (self.W.ncols(), self.Z.nrows(), self.Z.ncols());
        if self.X.nrows() > 0 && l > 0 {
            let bound = self.t.times(&(DMatrix::identity(l, l) * (rho * rho)));
            let block = Expr::symmetric(vec![vec![bound, self.W.transpose()], vec![self.X.clone()]]);
            self.problem.bound("gain bound", "|Y| <= rho", block);
        }
        if n > 0 && k > 0 {
            let rho_I = |size| Expr::constant(&(DMatrix::identity(size, size) * rho));
            let block = Expr::symmetric(vec![vec![rho_I(n), self.Z.clone()], vec![rho_I(k)]]);
            self.problem.bound("gain bound", "|Z| <= rho", block);
        }
    }
}
