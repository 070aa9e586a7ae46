//! The matrix inequalities of the design, block by block as they stand in the paper.
#![expect(non_snake_case, reason = "matrix letters follow paper 002")]

use nalgebra::DMatrix;

use super::parameterisation::Parameterisation;
use super::plant::Plant;
use crate::lmi::{Expr, Problem};

/// What is asked besides stability.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Demands {
    /// `Re s < -decay` by the common Lyapunov matrix.
    pub decay: Option<f64>,
    /// Bound on the norm of the free gain.
    pub gain: Option<f64>,
    /// Bound on the condition of the Lyapunov matrix; infinite for none.
    pub conditioning: f64,
    /// The attenuation; `None` when it is an unknown.
    pub gamma: Option<f64>,
    /// The paper's (52) with its slack matrices.
    pub alternative: bool,
}

/// The inequalities and their unknowns.
#[derive(Clone, Debug)]
pub struct Posed {
    /// The inequalities.
    pub problem: Problem,
    /// The Lyapunov matrix, the paper's X1.
    pub X: Expr,
    /// `X Z`, the transpose of the paper's `Omega_X1`.
    pub W: Expr,
    /// The multiplier of the Lipschitz bound.
    pub mu: Expr,
    /// The attenuation squared; `None` when there is no disturbance or it is given.
    pub gamma2: Option<Expr>,
}

const FORM: &str = "paper 002, Lemma 8 and (52) without slack";

/// Writes down the inequalities for a family of observers.
///
/// ```text
/// [ He(X N)  X T G   X phi1     ]
/// [   .      -mu I   0          ] + Pi' Pi + mu lambda^2 (F_L Pi)' F_L Pi < 0,    Pi = [P  -Q Phi G  phi2]
/// [   .        .     -gamma^2 I ]
/// He(X N) + 2 alpha X < 0,    t I <= X <= kappa t I,    [rho^2 t I  W'; W  X] >= 0   (hence |Z| <= rho),   W = X Z
/// ```
pub fn pose(plant: &Plant, family: &Parameterisation, demands: &Demands) -> Posed {
    let (q, l) = (family.order(), family.free_columns());
    let mut problem = Problem::new();
    let X = problem.symmetric("X", q);
    let W = problem.matrix("W", q, l);
    let mu = problem.scalar("mu");
    let n_disturbances = family.phi2.ncols();
    let (gamma2, gamma2_I) = attenuation(&mut problem, n_disturbances, demands.gamma);
    let unknowns = Unknowns { X: &X, W: &W, mu: &mu, gamma2_I: &gamma2_I };
    if demands.alternative {
        let lemma = with_slack(plant, family, &unknowns, &mut problem);
        problem.strict("attenuation", "paper 002, (52)", -lemma);
    } else {
        problem.strict("attenuation", FORM, -slack_free(plant, family, &unknowns));
    }
    problem.strict("X > 0", "paper 002, Theorem 10", X.clone());
    problem.strict("mu > 0", "paper 002, Theorem 10", mu.clone());
    if q > 0 {
        well_posed(&mut problem, &unknowns, family, demands);
    }
    Posed { problem, X, W, mu, gamma2 }
}

/// `gamma^2` as an unknown where there is something to attenuate, and `gamma^2 I` of the disturbances' size.
fn attenuation(problem: &mut Problem, size: usize, gamma: Option<f64>) -> (Option<Expr>, Expr) {
    let unit = DMatrix::identity(size, size);
    match gamma {
        Some(gamma) => (None, Expr::constant(&(unit * (gamma * gamma)))),
        None if size == 0 => (None, Expr::zeros(0, 0)),
        None => {
            let gamma2 = problem.scalar("gamma^2");
            let block = gamma2.times(&unit);
            (Some(gamma2), block)
        }
    }
}

struct Unknowns<'a> {
    X: &'a Expr,
    W: &'a Expr,
    mu: &'a Expr,
    gamma2_I: &'a Expr,
}

/// `lambda^2 F_L' F_L`.
fn lipschitz_bound(plant: &Plant) -> DMatrix<f64> {
    plant.F_L.tr_mul(&plant.F_L) * (plant.lambda * plant.lambda)
}

/// The bounded real lemma of the error, with the Lipschitz bound by its multiplier.
fn slack_free(plant: &Plant, family: &Parameterisation, unknowns: &Unknowns<'_>) -> Expr {
    let Parameterisation { Lambda_N, L_N, Lambda_TG, L_TG, Lambda_phi1, L_phi1, .. } = family;
    let Unknowns { X, W, mu, gamma2_I } = unknowns;
    let (nf, nd) = (Lambda_TG.ncols(), Lambda_phi1.ncols());
    let Pi = crate::numerics::side_by_side(&[&family.P, &-&family.Q_Phi_G, &family.phi2]);
    let lemma = Expr::symmetric(vec![
        vec![(*X * Lambda_N - *W * L_N).he(), *X * Lambda_TG - *W * L_TG, *X * Lambda_phi1 - *W * L_phi1],
        vec![-mu.times(&DMatrix::identity(nf, nf)), Expr::zeros(nf, nd)],
        vec![-*gamma2_I],
    ]);
    lemma + Expr::constant(&Pi.tr_mul(&Pi)) + mu.times(&(Pi.tr_mul(&lipschitz_bound(plant)) * &Pi))
}

/// The paper's (52) with the slack matrices X2, Q1 and Q2; its blocks are those of (53).
///
/// It has the same solutions: at `X2 + Q1' = 0`, `Q2 = I + mu lambda^2 F_L' F_L` it is [`slack_free`], and other slacks
/// only lose.
// ERRATUM(002, eq. 53): block (1,4) has Lambda_phi1 in the place of Lambda_phi2: Q1' Lambda_phi1 has no meaning
fn with_slack(
    plant: &Plant,
    family: &Parameterisation,
    unknowns: &Unknowns<'_>,
    problem: &mut Problem,
) -> Expr {
    let Parameterisation { Lambda_N, L_N, Lambda_TG, L_TG, Lambda_phi1, L_phi1, .. } = family;
    let Parameterisation { P: Lambda_P, Q_Phi_G, phi2: Lambda_phi2, .. } = family;
    let Unknowns { X, W, mu, gamma2_I } = unknowns;
    let (n, q, nf, nd) = (plant.n(), family.order(), Lambda_TG.ncols(), Lambda_phi1.ncols());
    let X2 = problem.matrix("X2", q, n);
    let Q1 = problem.matrix("Q1", n, q);
    let Q2 = problem.matrix("Q2", n, n);
    let slack = &X2 + Q1.transpose();
    let bound = Expr::identity(n) + mu.times(&lipschitz_bound(plant));
    Expr::symmetric(vec![
        vec![
            // (1,1)
            (*X * Lambda_N - *W * L_N + &slack * Lambda_P).he(),
            // (1,2)
            -&slack + Lambda_P.transpose() * &Q2,
            // (1,3)
            *X * Lambda_TG - *W * L_TG - &slack * Q_Phi_G,
            // (1,4)
            *X * Lambda_phi1 - *W * L_phi1 + &slack * Lambda_phi2,
        ],
        vec![
            // (2,2)
            -Q2.he() + bound,
            // (2,3)
            -(Q2.transpose() * Q_Phi_G),
            // (2,4)
            Q2.transpose() * Lambda_phi2,
        ],
        // (3,3), (3,4)
        vec![-mu.times(&DMatrix::identity(nf, nf)), Expr::zeros(nf, nd)],
        // (4,4)
        vec![-*gamma2_I],
    ])
}

/// Decay, conditioning and gain: what makes the infimum a minimum.
fn well_posed(problem: &mut Problem, unknowns: &Unknowns<'_>, family: &Parameterisation, demands: &Demands) {
    let Parameterisation { Lambda_N, L_N, .. } = family;
    let Unknowns { X, W, .. } = unknowns;
    let (q, l) = (family.order(), family.free_columns());
    if let Some(alpha) = demands.decay {
        let speed = -(*X * Lambda_N - *W * L_N).he() - X.scaled(2.0 * alpha);
        problem.strict("decay rate", "He(X N) + 2 alpha X < 0", speed);
    }
    let bounded_gain = demands.gain.filter(|_| l > 0);
    if !demands.conditioning.is_finite() && bounded_gain.is_none() {
        return;
    }
    let t = problem.scalar("t");
    let unit = DMatrix::identity(q, q);
    problem.bound("conditioning", "t I <= X", *X - t.times(&unit));
    if demands.conditioning.is_finite() {
        problem.bound("conditioning", "X <= kappa t I", t.times(&unit).scaled(demands.conditioning) - *X);
    }
    if let Some(rho) = bounded_gain {
        let corner = t.times(&(DMatrix::identity(l, l) * (rho * rho)));
        let gain = Expr::symmetric(vec![vec![corner, W.transpose()], vec![(*X).clone()]]);
        problem.bound("gain bound", "[rho^2 t I, W'; W, X] >= 0", gain);
    }
}
