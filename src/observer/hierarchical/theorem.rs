//! Theorem 2 and Corollary 1: why the whole is observable, or why not.
#![expect(non_snake_case, reason = "matrix letters follow paper 003")]

use nalgebra::DMatrix;

use super::Hierarchy;
use super::blocks::{
    BlockMode, Eigenspaces, block, block_eigenvalues, block_modes, complex, shifted, smallest,
};
use super::conditions::{condition, pair, points_of};
use crate::numerics::{
    Complex64, NumericsError, RankDecision, StabilityRegion, Tolerance, pbh_modes, rank, subspaces,
};
use crate::observer::{Condition, Evidence, PointEvidence, Verdict, show};
use crate::system::Network;

/// The numbers that Theorem 2 speaks of; they explain, the PBH test decides.
///
/// # Source
/// Paper 003, Theorem 2 and Corollary 1.
pub(super) struct Theorem<'a> {
    network: &'a Network,
    hierarchy: &'a Hierarchy,
    tolerance: &'a Tolerance,
    spaces: Eigenspaces,
    rank_Psi_N: RankDecision,
    /// The modes with their sets `Theta_pi`; none when `Gamma_nu` is not diagonalisable.
    modes: Vec<BlockMode>,
}

impl<'a> Theorem<'a> {
    /// # Errors
    /// When a decomposition fails its check.
    pub(super) fn of(
        network: &'a Network,
        hierarchy: &'a Hierarchy,
        tolerance: &'a Tolerance,
    ) -> Result<Self, NumericsError> {
        let spaces = Eigenspaces::of(&hierarchy.Gamma_nu)?;
        let modes = if spaces.diagonalisable() { block_modes(hierarchy, &spaces)? } else { Vec::new() };
        let rank_Psi_N = rank(&hierarchy.Psi_N, network.Psi.norm(), tolerance)?;
        Ok(Self { network, hierarchy, tolerance, spaces, rank_Psi_N, modes })
    }

    /// The modes of the whole, block by block; `None` when `Gamma_nu` has no basis of eigenvectors.
    pub(super) fn block_modes(&self) -> Option<&[BlockMode]> {
        self.spaces.diagonalisable().then_some(self.modes.as_slice())
    }

    /// Whether the global output has a row for each direction of the coupling, which leaves (ii) alone.
    fn sees_every_direction(&self) -> bool {
        self.rank_Psi_N.rank == self.hierarchy.N.ncols()
    }

    /// All conditions of the theorem and the corollary.
    ///
    /// # Errors
    /// When a decomposition fails its check.
    pub(super) fn conditions(&self) -> Result<Vec<Condition>, NumericsError> {
        let mut result = vec![self.condition_i()?, self.condition_ii()?, self.condition_iii()];
        result.extend(self.corollary()?);
        for condition in &mut result {
            condition.needed = false;
        }
        Ok(result)
    }

    fn condition_i(&self) -> Result<Condition, NumericsError> {
        let Hierarchy { Gamma_nu, Psi_N, .. } = self.hierarchy;
        let mut result = condition(
            ("003-T2-i", "Theorem 2 (i)"),
            "observability of the coupling",
            "(Gamma_nu, Psi N) observable",
        );
        let modes = pbh_modes(Gamma_nu, Psi_N, self.tolerance)?;
        pair(
            &mut result,
            Gamma_nu,
            &points_of(&modes, Gamma_nu, self.tolerance),
            "(Gamma_nu, Psi N)",
            true,
            self.tolerance,
        );
        result.evidence.push(Evidence::Rank {
            of: "Psi N".to_owned(),
            decision: self.rank_Psi_N.clone(),
            required: self.hierarchy.N.ncols(),
        });
        if self.sees_every_direction() {
            result.summary =
                format!("rank Psi N = nu = {}: nothing of the coupling is hidden", self.rank_Psi_N.rank);
        }
        Ok(result)
    }

    /// The blocks `(a_z + lambda b_z c_z, c_G M)`.
    ///
    /// By output injection they are observable for every lambda when `c_G` and `c_I` have the same row space:
    /// `(a_z, c_z)` is observable since the kernel of `O(a_I, b_I c_I)` contains that of `O(a_I, c_I)`.
    // ERRATUM(003, proof of Theorem 2): "observable by definition (13)" is true for this reason, not by (13) itself.
    fn condition_ii(&self) -> Result<Condition, NumericsError> {
        let mut result = condition(
            ("003-T2-ii", "Theorem 2 (ii)"),
            "observability of the subsystem under every coupling strength",
            "R(c_G') = R(c_I') or (a_z + lambda b_z c_z, c_G M) observable for all lambda in eig Gamma_nu",
        );
        let mut points = Vec::new();
        let c = complex(&self.hierarchy.c_GM);
        for space in &self.spaces.spaces {
            let A = block(self.hierarchy, space.lambda);
            let size = A.norm().hypot(c.norm()).max(f64::MIN_POSITIVE);
            let mut least = f64::INFINITY;
            for pi in block_eigenvalues(self.hierarchy, space.lambda)? {
                least = least.min(smallest(&stacked(&shifted(pi, &A), &c))? / size);
            }
            points.push(PointEvidence {
                s: space.lambda,
                multiplicity: space.vectors.ncols(),
                distance: least,
                loses_rank: least <= self.tolerance.mode,
                stable: false,
            });
        }
        let bad = points.iter().find(|point| point.loses_rank);
        let near = |point: &PointEvidence| {
            !point.loses_rank && point.distance <= self.tolerance.mode * self.tolerance.gap
        };
        let same = self.same_outputs()?;
        result.verdict = Verdict::of(same || bad.is_none(), !same && points.iter().any(near));
        let closest = points.iter().map(|point| point.distance).fold(f64::INFINITY, f64::min);
        result.summary = match bad {
            _ if same => "c_G and c_I have the same row space".to_owned(),
            Some(point) => {
                format!("at lambda = {} a part of the subsystem is invisible to c_G", show(point.s))
            }
            None => format!("{} values of lambda, closest distance {closest:.2e}", points.len()),
        };
        let of = "(a_z + lambda b_z c_z, c_G M) at the eigenvalues of Gamma_nu".to_owned();
        result.evidence.push(Evidence::Points { of, points });
        Ok(result)
    }

    /// Whether `R(c_G') = R(c_I')`.
    fn same_outputs(&self) -> Result<bool, NumericsError> {
        let Network { c, c_G, .. } = self.network;
        let (first, second) = (row_space(c, self.tolerance)?, row_space(c_G, self.tolerance)?);
        Ok(first.ncols() == second.ncols()
            && relative_outside(c, &second) <= self.tolerance.residual
            && relative_outside(c_G, &first) <= self.tolerance.residual)
    }

    /// Modes that several eigenvalues of the coupling share.
    // ERRATUM(003, Theorem 2 (iii)): the print asks |Theta_pi| > 2; the proof excludes |Theta_pi| = 1 only, and with
    // nu = 2 there are networks with |Theta_pi| = 2 that fulfil (i), (ii) and are not observable.
    fn condition_iii(&self) -> Condition {
        let mut result = condition(
            ("003-T2-iii", "Theorem 2 (iii)"),
            "modes that several coupling strengths share",
            "ker (Psi N kron c_G M) meets span V_pi only in 0 for all pi with |Theta_pi| >= 2",
        );
        let condition_number = self.spaces.condition;
        if !self.spaces.diagonalisable() {
            result.summary = format!(
                "Gamma_nu is not diagonalisable (condition of its eigenvectors {condition_number:.1e}), which Theorem 2 \
                 assumes; the PBH test of the whole pair decides"
            );
            return result;
        }
        let shared: Vec<&BlockMode> = self.modes.iter().filter(|mode| mode.theta.len() >= 2).collect();
        let hidden = shared.iter().find(|mode| mode.distance <= self.tolerance.mode);
        let limit = self.tolerance.mode * self.tolerance.gap;
        let near = shared.iter().any(|mode| mode.distance <= limit && mode.distance > self.tolerance.mode);
        result.verdict = Verdict::of(self.sees_every_direction() || hidden.is_none(), near);
        result.summary = match hidden {
            _ if self.sees_every_direction() => "not asked, since rank Psi N = nu".to_owned(),
            Some(mode) => format!(
                "the mode {} is shared by {} eigenvalues of Gamma_nu, and a combination is invisible",
                show(mode.pi),
                mode.theta.len()
            ),
            None if shared.is_empty() => "every |Theta_pi| is 1: no mode is shared".to_owned(),
            None => format!("{} shared modes, all visible", shared.len()),
        };
        result.summary =
            format!("{}; eigenvectors of Gamma_nu have condition {condition_number:.2e}", result.summary);
        let region = StabilityRegion::LeftHalfPlane;
        let points = self.modes.iter().map(|mode| PointEvidence {
            s: mode.pi,
            multiplicity: mode.theta.len(),
            distance: mode.distance,
            loses_rank: mode.distance <= self.tolerance.mode,
            stable: region.contains(mode.pi, self.tolerance.margin),
        });
        let of = "pi, with |Theta_pi| as multiplicity, and gamma_z on span V_pi".to_owned();
        result.evidence.push(Evidence::Points { of, points: points.collect() });
        result
    }

    /// Corollary 1: with one coupling channel and one output row, (iii) is controllability of `(a_z, b_z)`.
    // ERRATUM(003, proof of Corollary 1): the print has d(pi) = n(pi); a shared mode needs d(pi) = n(pi) = 0.
    fn corollary(&self) -> Result<Option<Condition>, NumericsError> {
        let Hierarchy { a_z, b_z, c_GM, .. } = self.hierarchy;
        if b_z.ncols() != 1 || c_GM.nrows() != 1 || self.hierarchy.order() == 0 {
            return Ok(None);
        }
        let mut result = condition(
            ("003-C1-iii", "Corollary 1 (iii*)"),
            "controllability of the subsystem's shown part",
            "(a_z, b_z) controllable",
        );
        let dual = a_z.transpose();
        let modes = pbh_modes(&dual, &b_z.transpose(), self.tolerance)?;
        pair(
            &mut result,
            &dual,
            &points_of(&modes, &dual, self.tolerance),
            "(a_z', b_z')",
            true,
            self.tolerance,
        );
        result.summary = result.summary.replace("observable", "controllable");
        Ok(Some(result))
    }
}

fn stacked(top: &DMatrix<Complex64>, bottom: &DMatrix<Complex64>) -> DMatrix<Complex64> {
    let t = top.nrows();
    DMatrix::from_fn(
        t + bottom.nrows(),
        top.ncols(),
        |i, j| {
            if i < t { top[(i, j)] } else { bottom[(i - t, j)] }
        },
    )
}

/// Orthonormal basis of the row space, as columns.
fn row_space(matrix: &DMatrix<f64>, tolerance: &Tolerance) -> Result<DMatrix<f64>, NumericsError> {
    Ok(subspaces(matrix, 0.0, tolerance)?.row_space)
}

/// The part of the rows that lies outside a space with orthonormal basis `Q`, relative to the rows; zero for no rows.
pub(super) fn relative_outside(rows: &DMatrix<f64>, Q: &DMatrix<f64>) -> f64 {
    (rows - rows * Q * Q.transpose()).norm() / rows.norm().max(f64::MIN_POSITIVE)
}
