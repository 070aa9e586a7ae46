//! Theorem 2 and Corollary 1: why the whole is observable, or why not.
#![expect(non_snake_case, reason = "matrix letters follow paper 003")]

use nalgebra::DMatrix;

use super::Hierarchy;
use super::blocks::{BlockMode, Eigenspaces, block_modes, block_test};
use super::conditions::condition;
use super::pairs::{pair, points_of};
use crate::numerics::{NumericsError, PbhMode, RankDecision, StabilityRegion, Tolerance, rank, subspaces};
use crate::observer::{Condition, Evidence, PointEvidence, SetEvidence, Verdict, show};
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
    /// The modes with their sets `Theta_pi`, hidden ones first; none when `Gamma_nu` is not diagonalisable.
    modes: Vec<BlockMode>,
}

impl<'a> Theorem<'a> {
    /// `whole` is the PBH test of `(alpha_z, gamma_z)`.
    ///
    /// # Errors
    /// When a decomposition fails its check.
    pub(super) fn of(
        network: &'a Network,
        hierarchy: &'a Hierarchy,
        whole: &[PbhMode],
        tolerance: &'a Tolerance,
    ) -> Result<Self, NumericsError> {
        let spaces = Eigenspaces::of(&hierarchy.Gamma_nu)?;
        let modes = if spaces.diagonalisable() {
            block_modes(hierarchy, &spaces, whole, tolerance)?
        } else {
            Vec::new()
        };
        let rank_Psi_N = rank(&hierarchy.Psi_N, network.Psi.norm(), tolerance)?;
        Ok(Self { network, hierarchy, tolerance, spaces, rank_Psi_N, modes })
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
        let first = self.condition_i()?;
        let corollary = self.corollary(&first)?;
        let mut result = vec![first, self.condition_ii()?, self.condition_iii()];
        result.extend(corollary);
        for condition in &mut result {
            condition.needed = false;
        }
        Ok(result)
    }

    fn condition_i(&self) -> Result<Condition, NumericsError> {
        let mut result = condition(
            ("003-T2-i", "Theorem 2 (i)"),
            "observability of the coupling",
            "(Gamma_nu, Psi N) observable",
        );
        let of = "(Gamma_nu, Psi N), whose modes s are the eigenvalues lambda of Gamma_nu";
        let tested = (&self.hierarchy.Gamma_nu, &self.hierarchy.thin_Psi_N());
        pair(&mut result, tested, ("coupling direction ", of), true, self.tolerance)?;
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
        let (mut bad, mut near, mut closest) = (None, false, f64::INFINITY);
        for space in &self.spaces.spaces {
            let modes = block_test(self.hierarchy, space.lambda, self.tolerance)?;
            let points = points_of(&modes, &self.hierarchy.a_z, self.tolerance);
            for point in points.iter().map(|mode| &mode.point) {
                closest = closest.min(point.distance);
                if point.loses_rank {
                    bad = bad.or(Some((space.lambda, point.s)));
                } else {
                    near |= point.distance <= self.tolerance.mode * self.tolerance.gap;
                }
            }
            result.evidence.push(Evidence::Points {
                of: format!("(a_z + lambda b_z c_z, c_G M) at lambda = {}", show(space.lambda)),
                points: points.into_iter().map(|mode| mode.point).collect(),
            });
        }
        let same = self.same_outputs()?;
        result.verdict = Verdict::of(same || bad.is_none(), !same && near);
        result.summary = match bad {
            _ if same => "c_G and c_I have the same row space".to_owned(),
            Some((lambda, pi)) => format!(
                "at lambda = {} the mode {} of the subsystem is invisible to c_G",
                show(lambda),
                show(pi)
            ),
            None => format!("{} values of lambda, closest distance {closest:.2e}", self.spaces.spaces.len()),
        };
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
        let of_vectors = format!("eigenvectors of Gamma_nu have condition {condition_number:.2e}");
        if self.sees_every_direction() {
            result.verdict = Verdict::Holds;
            result.summary = format!("not needed, since rank Psi N = nu; {of_vectors}");
        } else if !self.spaces.diagonalisable() {
            result.summary = format!(
                "Gamma_nu is not diagonalisable (condition of its eigenvectors {condition_number:.1e}), which Theorem 2 \
                 assumes; the PBH test of the whole pair decides"
            );
        } else {
            self.decide_iii(&mut result);
            result.summary = format!("{}; {of_vectors}", result.summary);
        }
        if self.spaces.diagonalisable() {
            result.evidence.extend(self.shared_modes());
        }
        result
    }

    fn decide_iii(&self, result: &mut Condition) {
        let shared: Vec<&BlockMode> = self.modes.iter().filter(|mode| mode.theta.len() >= 2).collect();
        let hidden = shared.iter().find(|mode| mode.hidden);
        let limit = self.tolerance.mode * self.tolerance.gap;
        let near = shared.iter().any(|mode| mode.distance <= limit && !mode.hidden);
        result.verdict = Verdict::of(hidden.is_none(), near);
        result.summary = match hidden {
            Some(mode) => format!(
                "the mode {} is shared by {} eigenvalues of Gamma_nu, and a combination is invisible",
                show(mode.pi),
                mode.theta.len()
            ),
            None if shared.is_empty() => "every |Theta_pi| is 1: no mode is shared".to_owned(),
            None => format!("{} shared modes, all visible", shared.len()),
        };
    }

    /// The modes, and the eigenvalues of `Gamma_nu` that have each of them.
    fn shared_modes(&self) -> [Evidence; 2] {
        let region = StabilityRegion::LeftHalfPlane;
        let points = self.modes.iter().map(|mode| PointEvidence {
            s: mode.pi,
            multiplicity: mode.theta.len(),
            distance: mode.distance,
            loses_rank: mode.hidden,
            stable: region.contains(mode.pi, self.tolerance.margin),
        });
        let lambda = |k: &usize| self.spaces.spaces.get(*k).map(|space| space.lambda);
        let sets = self.modes.iter().map(|mode| SetEvidence {
            element: mode.pi,
            members: mode.theta.iter().filter_map(lambda).collect(),
            dimension: mode.dimension,
        });
        [
            Evidence::Points {
                of: "gamma_z on span V_pi, with |Theta_pi| as multiplicity".to_owned(),
                points: points.collect(),
            },
            Evidence::Sets {
                of: "Theta_pi, the lambda in eig Gamma_nu for which a_z + lambda b_z c_z has the mode pi"
                    .to_owned(),
                names: ["pi", "Theta_pi", "V_pi"].map(str::to_owned),
                sets: sets.collect(),
            },
        ]
    }

    /// Corollary 1: with one coupling channel and one output row, (iii) is controllability of `(a_z, b_z)`.
    // ERRATUM(003, proof of Corollary 1): the print has d(pi) = n(pi); a shared mode needs d(pi) = n(pi) = 0.
    ///
    /// It is asked where Theorem 2 asks (iii), and speaks of networks that fulfil (i): only then have several eigenvalues
    /// of `Gamma_nu` to be told apart by one output.
    fn corollary(&self, first: &Condition) -> Result<Option<Condition>, NumericsError> {
        let Hierarchy { a_z, b_z, c_GM, .. } = self.hierarchy;
        if b_z.ncols() != 1 || c_GM.nrows() != 1 || self.hierarchy.order() == 0 {
            return Ok(None);
        }
        let mut result = condition(
            ("003-C1-iii", "Corollary 1 (iii*)"),
            "controllability of the subsystem's shown part",
            "(a_z, b_z) controllable",
        );
        if self.sees_every_direction() {
            "not asked, since rank Psi N = nu".clone_into(&mut result.summary);
            return Ok(Some(result));
        }
        if !first.verdict.holds() {
            "not asked: it speaks of networks that fulfil (i)".clone_into(&mut result.summary);
            return Ok(Some(result));
        }
        let tested = (&a_z.transpose(), &b_z.transpose());
        pair(&mut result, tested, ("shown state ", "(a_z', b_z')"), true, self.tolerance)?;
        result.summary = result.summary.replace("observable", "controllable");
        Ok(Some(result))
    }
}

/// Orthonormal basis of the row space, as columns.
fn row_space(matrix: &DMatrix<f64>, tolerance: &Tolerance) -> Result<DMatrix<f64>, NumericsError> {
    Ok(subspaces(matrix, 0.0, tolerance)?.row_space)
}

/// The largest part of a row that lies outside a space with orthonormal basis `Q`, relative to that row; zero for no rows.
pub(super) fn relative_outside(rows: &DMatrix<f64>, Q: &DMatrix<f64>) -> f64 {
    let outside = rows - rows * Q * Q.transpose();
    let each = outside.row_iter().zip(rows.row_iter());
    each.map(|(out, row)| out.norm() / row.norm().max(f64::MIN_POSITIVE)).fold(0.0, f64::max)
}
