//! The re-check of a hierarchical observer in the network's own matrices, subsystem by subsystem.
#![expect(non_snake_case, reason = "matrix letters follow paper 003")]

use nalgebra::DMatrix;

use super::{HierarchicalObserver, Hierarchy};
use crate::numerics::{
    Complex64, NumericsError, Placement, Random, StabilityRegion, Tolerance, eigenvalues, spectral_distance,
};
use crate::observer::{Check, Verification};
use crate::system::Network;

/// Largest relative distance between requested and achieved poles that still counts as placed.
const SPECTRUM_LIMIT: f64 = 1e-3;

/// Random states of the network on which identities of operators are tested.
const PROBES: usize = 3;

/// Re-checks an observer against the network, which is never expanded.
///
/// Identities of small matrices are evaluated as they stand. Identities of operators on the whole network, such as
/// `sigma_z A = alpha_z sigma_z`, are applied to a few seeded random states, whose columns are the subsystems' states:
/// `A x` is `a X + b c X Gamma'`, `sigma_z x` is `M' X N`. A wrong identity fails on all random states but a set of
/// measure zero; residuals are relative to the absolute values of their terms.
///
/// The spectrum is that of the block-triangular error dynamics, `eig(alpha_z - H gamma_z)` and `eig(a - h c_L)`, the
/// latter once for each gain that differs.
///
/// # Errors
/// When a decomposition fails its own check.
///
/// # Source
/// Paper 003, (8), (11), (12), Theorem 1, Proposition 1.
pub fn verify_network(
    network: &Network,
    observer: &HierarchicalObserver,
    tolerance: &Tolerance,
) -> Result<Verification, NumericsError> {
    let mut result =
        Verification { checks: factors(network, &observer.hierarchy), ..Verification::default() };
    result.checks.extend(operators(network, observer));
    for check in &mut result.checks {
        check.limit = tolerance.residual;
    }
    let global =
        eigenvalues(&(observer.hierarchy.alpha_z() - &observer.global.H * observer.hierarchy.gamma_z()))?;
    result.checks.push(spectrum("global", &global, &observer.global.placement));
    result.spectrum.extend(global);
    for (local, _) in observer.distinct_locals() {
        let found = eigenvalues(&(&network.a - &local.h * &network.c_L))?;
        result.checks.push(spectrum("local", &found, &local.placement));
        result.spectrum.extend(found);
    }
    let region = StabilityRegion::LeftHalfPlane;
    let worst = result.spectrum.iter().map(|z| region.excess(*z)).fold(f64::NEG_INFINITY, f64::max);
    result.checks.push(Check {
        name: "stability".to_owned(),
        statement: region.statement().to_owned(),
        value: if result.spectrum.is_empty() { -1.0 } else { worst },
        limit: -tolerance.margin,
    });
    Ok(result)
}

fn spectrum(which: &str, found: &[Complex64], placement: &Placement) -> Check {
    let expected: Vec<Complex64> =
        placement.requested.iter().chain(&placement.fixed_modes).copied().collect();
    let size = expected.iter().map(|z| z.norm()).fold(0.0, f64::max);
    let size = if size > 0.0 { size } else { 1.0 };
    Check {
        name: format!("spectrum of the {which} observer"),
        statement: format!(
            "eigenvalues of {} = requested poles and fixed modes",
            if which == "global" { "alpha_z - H gamma_z" } else { "a_I - h c_L" }
        ),
        value: spectral_distance(found, &expected) / size,
        limit: SPECTRUM_LIMIT,
    }
}

fn check(name: &str, statement: &str, residual: &DMatrix<f64>, size: &DMatrix<f64>) -> Check {
    let value = relative(residual, size);
    Check { name: name.to_owned(), statement: statement.to_owned(), value, limit: 0.0 }
}

/// The largest residual, relative to the largest sum of the absolute values of its terms.
fn relative(residual: &DMatrix<f64>, size: &DMatrix<f64>) -> f64 {
    let (found, size) = (largest(residual), largest(size));
    if size == 0.0 { found } else { found / size }
}

/// The largest absolute value; zero for an empty matrix, and infinite instead of what is not a number.
fn largest(matrix: &DMatrix<f64>) -> f64 {
    matrix.iter().fold(0.0, |largest: f64, x| if x.is_nan() { f64::INFINITY } else { largest.max(x.abs()) })
}

/// Identities of the small matrices.
fn factors(network: &Network, hierarchy: &Hierarchy) -> Vec<Check> {
    let Network { a, b, c, Psi, c_G, .. } = network;
    let Hierarchy { N, M, a_z, .. } = hierarchy;
    let abs = DMatrix::<f64>::abs;
    let unit = |n| DMatrix::<f64>::identity(n, n);
    // where a subsystem shows nothing, the whole is empty whatever the coupling is
    let shown = f64::from(u8::from(M.ncols() > 0));
    let (projector, bc) = (M * M.transpose(), b * c);
    let absolute = abs(M) * abs(M).transpose();
    vec![
        check("orthonormal N", "N' N = I", &(N.tr_mul(N) - unit(N.ncols())), &unit(N.ncols())),
        check("orthonormal M", "M' M = I", &(M.tr_mul(M) - unit(M.ncols())), &unit(M.ncols())),
        check(
            "invariant part of a subsystem",
            "M' a_I = a_z M'",
            &(M.tr_mul(a) - a_z * M.transpose()),
            &(abs(M).tr_mul(&abs(a)) + abs(a_z) * abs(M).transpose()),
        ),
        check(
            "coupling output within it",
            "b_I c_I M M' = b_I c_I",
            &(&bc * &projector - &bc),
            &(abs(&bc) + abs(&bc) * &absolute),
        ),
        check(
            "global rows within the coupling",
            "Psi N N' = Psi",
            &(scaled_rows(Psi, &(Psi - Psi * N * N.transpose())) * shown),
            &scaled_rows(Psi, &(abs(Psi) + abs(Psi) * abs(N) * abs(N).transpose())),
        ),
        check(
            "global output within the shown part",
            "c_G M M' = c_G",
            &scaled_rows(c_G, &(c_G - c_G * &projector)),
            &scaled_rows(c_G, &(abs(c_G) + abs(c_G) * &absolute)),
        ),
    ]
}

/// Each row divided by the largest entry of the same row of `by`, so that no large row excuses a small one.
fn scaled_rows(by: &DMatrix<f64>, rows: &DMatrix<f64>) -> DMatrix<f64> {
    let mut result = rows.clone();
    for (mut row, own) in result.row_iter_mut().zip(by.row_iter()) {
        let size = own.amax();
        if size > 0.0 {
            row /= size;
        }
    }
    result
}

/// An identity on all probes: its largest residual, relative to the terms of the same probe.
#[derive(Default)]
struct Probed(f64);

impl Probed {
    fn add(&mut self, residual: &DMatrix<f64>, size: &DMatrix<f64>) {
        self.0 = self.0.max(relative(residual, size));
    }

    fn check(&self, name: &str, statement: &str) -> Check {
        Check { name: name.to_owned(), statement: statement.to_owned(), value: self.0, limit: 0.0 }
    }
}

/// Identities of operators on the whole network, applied to random states.
fn operators(network: &Network, observer: &HierarchicalObserver) -> Vec<Check> {
    const SEED: u64 = 11;
    let mut random = Random::new(SEED);
    let (n, size) = (network.a.nrows(), network.n_subsystems());
    let [mut coupling, mut dynamics, mut output, mut drive, mut global, mut local] =
        [(); 6].map(|()| Probed::default());
    for _ in 0..PROBES {
        let X = DMatrix::from_fn(n, size, |_, _| random.normal());
        let probe = Probe::new(network, observer, X);
        probe.coupling(&mut coupling);
        probe.dynamics(&mut dynamics);
        probe.output(&mut output);
        probe.drive(&mut drive);
        probe.global_error(&mut global);
        probe.local_errors(&mut local);
    }
    vec![
        coupling.check("row space of the coupling", "Gamma N N' = Gamma"),
        dynamics.check("dynamics of the whole", "sigma_z A = alpha_z sigma_z"),
        output.check("global output", "gamma_z sigma_z = Psi kron c_G"),
        drive.check(
            "drive of every subsystem",
            "(e_i' kron I) A = beta_i sigma_z + (I kron a_I)(e_i' kron I)",
        ),
        global.check("global error dynamics", "sigma_z A = (alpha_z - H gamma_z) sigma_z + H (Psi kron c_G)"),
        local.check(
            "local error dynamics",
            "(e_i' kron I) A = (a_I - h_i c_L)(e_i' kron I) + beta_i sigma_z + h_i (e_i' kron c_L)",
        ),
    ]
}

/// One random state of the network, with what the network makes of it.
struct Probe<'a> {
    network: &'a Network,
    observer: &'a HierarchicalObserver,
    X: DMatrix<f64>,
    /// `b c X Gamma'`, n x N, and the same of absolute values.
    coupled: DMatrix<f64>,
    coupled_size: DMatrix<f64>,
    /// `z = vec(M' X N)` as a column, and the same of absolute values.
    z: DMatrix<f64>,
    z_size: DMatrix<f64>,
    /// `y_G = vec(c_G X Psi')` as a column, and the same of absolute values.
    y: DMatrix<f64>,
    y_size: DMatrix<f64>,
}

/// The columns of a matrix below each other.
fn vec(matrix: &DMatrix<f64>) -> DMatrix<f64> {
    DMatrix::from_column_slice(matrix.len(), 1, matrix.as_slice())
}

impl<'a> Probe<'a> {
    fn new(network: &'a Network, observer: &'a HierarchicalObserver, X: DMatrix<f64>) -> Self {
        let Network { b, c, Gamma, Psi, c_G, .. } = network;
        let Hierarchy { N, M, .. } = &observer.hierarchy;
        let bc = b * c;
        let abs = DMatrix::<f64>::abs;
        let size = abs(&X);
        Self {
            coupled: &bc * Gamma.times(&X.transpose()).transpose(),
            coupled_size: abs(&bc) * Gamma.abs().times(&size.transpose()).transpose(),
            z: vec(&(M.tr_mul(&X) * N)),
            z_size: vec(&(abs(M).tr_mul(&size) * abs(N))),
            y: vec(&(c_G * &X * Psi.transpose())),
            y_size: vec(&(abs(c_G) * &size * abs(Psi).transpose())),
            network,
            observer,
            X,
        }
    }

    /// `sigma_z (A x)` for `A x = a X + b c X Gamma'`.
    fn shown(&self) -> (DMatrix<f64>, DMatrix<f64>) {
        let Hierarchy { N, M, .. } = &self.observer.hierarchy;
        let a = &self.network.a;
        let derivative = a * &self.X + &self.coupled;
        let size = a.abs() * self.X.abs() + &self.coupled_size;
        (vec(&(M.tr_mul(&derivative) * N)), vec(&(M.abs().tr_mul(&size) * N.abs())))
    }

    fn coupling(&self, probed: &mut Probed) {
        if self.observer.hierarchy.M.ncols() == 0 {
            return; // the whole is empty whatever the coupling is
        }
        let (Gamma, N) = (&self.network.Gamma, &self.observer.hierarchy.N);
        let W = self.X.transpose();
        let size = Gamma.abs().times(&W.abs());
        probed.add(&(Gamma.times(&(N * N.tr_mul(&W))) - Gamma.times(&W)), &size);
    }

    fn dynamics(&self, probed: &mut Probed) {
        let alpha = self.observer.hierarchy.alpha_z();
        let (shown, size) = self.shown();
        probed.add(&(shown - &alpha * &self.z), &(size + alpha.abs() * &self.z_size));
    }

    fn output(&self, probed: &mut Probed) {
        let gamma = self.observer.hierarchy.gamma_z();
        probed.add(&(&gamma * &self.z - &self.y), &(gamma.abs() * &self.z_size + &self.y_size));
    }

    /// `b c_z Z (Gamma N)'`: what `beta_z` says that the subsystems receive, n x N.
    fn received(&self) -> DMatrix<f64> {
        let Hierarchy { Gamma_N, bc_z, N, M, .. } = &self.observer.hierarchy;
        bc_z * (M.tr_mul(&self.X) * N) * Gamma_N.transpose()
    }

    fn drive(&self, probed: &mut Probed) {
        probed.add(&(self.received() - &self.coupled), &self.coupled_size);
    }

    /// The global observer started at the truth, `z_hat = z`, moves as the network does.
    fn global_error(&self, probed: &mut Probed) {
        let HierarchicalObserver { hierarchy, global, .. } = self.observer;
        let own = hierarchy.alpha_z() - &global.H * hierarchy.gamma_z();
        let (shown, size) = self.shown();
        let size = size + own.abs() * &self.z_size + global.H.abs() * &self.y_size;
        probed.add(&(shown - own * &self.z - &global.H * &self.y), &size);
    }

    /// So does every local observer, from `z_hat = z` and `x_hat_i = x_i`.
    fn local_errors(&self, probed: &mut Probed) {
        let Network { a, c_L, .. } = self.network;
        let hierarchy = &self.observer.hierarchy;
        for (i, local) in self.observer.locals() {
            let x = self.X.columns(i, 1);
            let truth = a * x + self.coupled.columns(i, 1);
            let y = c_L * x;
            let moved = (a - &local.h * c_L) * x + hierarchy.beta(i) * &self.z + &local.h * &y;
            let size =
                a.abs() * x.abs() + self.coupled_size.columns(i, 1) + local.h.abs() * (c_L.abs() * x.abs());
            probed.add(&(truth - moved), &size);
        }
    }
}
