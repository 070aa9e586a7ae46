//! R-observability and R-detectability: finite modes that the outputs do not show.

use nalgebra::DMatrix;
use num_complex::Complex64;
use serde::{Deserialize, Serialize};

use super::{PropertyError, check};
use crate::numerics::{
    ModePosition, RankDrop, RankDropPoint, StabilityRegion, Tolerance, normalised, rank_drop_points, stack,
};
use crate::system::{DescriptorSystem, TimeDomain};

/// Which finite modes the outputs have to show.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum ModeCriterion {
    /// All of them: R-observability.
    All,
    /// Those that are not stable: R-detectability.
    NotStable,
}

/// A finite mode `x = v e^(s t)` with `C v = 0`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct UnobservableMode {
    /// The point where `[s E - A; C]` loses rank.
    pub s: Complex64,
    /// Algebraic multiplicity.
    pub multiplicity: usize,
    /// The computed zeros that were taken as this one point.
    pub members: Vec<Complex64>,
    /// Smallest singular value there, relative to the norms of the pencil.
    pub sigma: f64,
    /// `v` with `(s E - A) v = 0` and `C v = 0`; its largest entry is one.
    pub direction: Vec<Complex64>,
    /// Where the mode lies.
    pub position: ModePosition,
}

/// Whether `rank [s E - A; C] = n` for all finite `s`, or for those that are not stable.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ModeCondition {
    /// Which modes count.
    pub criterion: ModeCriterion,
    /// Rank of `[s E - A; C]` for almost all `s`.
    pub normal_rank: usize,
    /// Number of states n, the rank that is needed.
    pub needed: usize,
    /// When the normal rank is below n: a state `v` with `[s E - A; C] v = 0`, for every `s` if there is such a one,
    /// else for `s = 0`; its largest entry is one.
    pub free_direction: Option<Vec<f64>>,
    /// All finite points with a lower rank, also those that the criterion permits.
    pub modes: Vec<UnobservableMode>,
    /// Region in which modes decay.
    pub region: StabilityRegion,
    /// Distance from the boundary of the region within which a mode counts as not stable, in units of `s`.
    pub margin: f64,
    /// Smallest factor between a singular value of the staircase and its threshold.
    pub gap: f64,
    /// The verdict could tip under a small change of the data.
    pub fragile: bool,
}

impl ModeCondition {
    /// No mode violates the condition, and the normal rank is n.
    pub fn holds(&self) -> bool {
        self.free_direction.is_none() && self.violations().next().is_none()
    }

    /// The verdict could tip under a small change of the data.
    pub fn fragile(&self) -> bool {
        self.fragile
    }

    /// The modes that violate the condition.
    pub fn violations(&self) -> impl Iterator<Item = &UnobservableMode> {
        let criterion = self.criterion;
        self.modes.iter().filter(move |mode| match criterion {
            ModeCriterion::All => true,
            ModeCriterion::NotStable => mode.position != ModePosition::Stable,
        })
    }
}

/// Decides R-observability: `rank [s E - A; C] = n` for all finite `s`.
///
/// # Tolerance
/// The points come from the staircase of the whole pencil ([`rank_drop_points`]), never from sampled `s`. `C` is scaled
/// to the norm of `A` first, which changes no rank.
///
/// # Errors
/// [`PropertyError`] when the matrices do not fit or a decomposition fails.
///
/// # Examples
/// ```
/// use descry::numerics::Tolerance;
/// use descry::system::{DescriptorSystem, properties::{r_detectability, r_observability}};
/// use nalgebra::{DMatrix, dmatrix};
/// let a = dmatrix![-1.0, 0.0; 0.0, 2.0];
/// let system = DescriptorSystem::autonomous(DMatrix::identity(2, 2), a, dmatrix![0.0, 1.0])?;
/// let found = r_observability(&system, &Tolerance::default())?;
/// assert!(!found.holds() && (found.modes[0].s.re + 1.0).abs() < 1e-14);
/// assert!(r_detectability(&system, &Tolerance::default())?.holds());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn r_observability(
    system: &DescriptorSystem,
    tolerance: &Tolerance,
) -> Result<ModeCondition, PropertyError> {
    mode_condition(system, ModeCriterion::All, tolerance)
}

/// Decides R-detectability: `rank [s E - A; C] = n` for all `Re s >= 0` (discrete: all `|s| >= 1`).
///
/// # Tolerance
/// As [`r_observability`]; a mode closer to the boundary than `tolerance.margin` (in continuous time times
/// `norm A / norm E`) counts as not stable, and so does one of which a member of its cluster is.
///
/// # Errors
/// As [`r_observability`].
pub fn r_detectability(
    system: &DescriptorSystem,
    tolerance: &Tolerance,
) -> Result<ModeCondition, PropertyError> {
    mode_condition(system, ModeCriterion::NotStable, tolerance)
}

fn mode_condition(
    system: &DescriptorSystem,
    criterion: ModeCriterion,
    tolerance: &Tolerance,
) -> Result<ModeCondition, PropertyError> {
    check(system)?;
    let DescriptorSystem { E: e, A: a, C: c, .. } = system;
    let region = match system.time {
        TimeDomain::Continuous => StabilityRegion::LeftHalfPlane,
        TimeDomain::Discrete => StabilityRegion::UnitDisk,
    };
    let (norm_a, norm_e) = (normalised(a).1, normalised(e).1);
    let scaled_c = normalised(c).0 * norm_a;
    let margin = region.margin(norm_a / norm_e, tolerance);

    // [A; C] - s [E; 0]
    let derivatives = stack(&[e, &DMatrix::zeros(c.nrows(), c.ncols())]);
    let found = rank_drop_points(&stack(&[a, &scaled_c]), &derivatives, tolerance)?;

    let modes: Vec<UnobservableMode> =
        found.points().iter().map(|point| unobservable(point, region, margin)).collect();
    let free_direction = match found.drop {
        RankDrop::Everywhere { direction } => Some(direction.iter().copied().collect()),
        RankDrop::Nowhere | RankDrop::Points(_) => None,
    };
    let hangs_on_the_margin =
        criterion == ModeCriterion::NotStable && hangs_on_the_margin(&modes, region, margin * tolerance.gap);
    Ok(ModeCondition {
        criterion,
        normal_rank: found.structure.normal_rank,
        needed: system.n_states(),
        free_direction,
        modes,
        region,
        margin,
        gap: found.structure.gap,
        fragile: found.fragile || hangs_on_the_margin,
    })
}

fn unobservable(point: &RankDropPoint, region: StabilityRegion, margin: f64) -> UnobservableMode {
    UnobservableMode {
        s: point.s,
        multiplicity: point.multiplicity,
        members: point.members.clone(),
        sigma: point.sigma,
        direction: point.direction.iter().copied().collect(),
        position: region.position(point.s, &point.members, margin),
    }
}

/// No mode is clearly outside, and at least one is close to the boundary.
fn hangs_on_the_margin(modes: &[UnobservableMode], region: StabilityRegion, close: f64) -> bool {
    let positions = modes.iter().map(|mode| region.position(mode.s, &mode.members, close));
    ModePosition::hang_on_the_boundary(positions)
}

#[cfg(test)]
mod tests {
    use super::super::autonomous;
    use super::*;
    use nalgebra::{dmatrix, dvector};

    /// `x1' = s x1` unobserved beside an observed mode.
    fn hidden(s: f64) -> DescriptorSystem {
        let a = DMatrix::from_diagonal(&dvector![s, -3.0]);
        autonomous(DMatrix::identity(2, 2), a, dmatrix![0.0, 1.0])
    }

    fn detectability(system: &DescriptorSystem) -> ModeCondition {
        r_detectability(system, &Tolerance::default()).unwrap()
    }

    #[test]
    fn a_hidden_stable_mode_is_permitted() {
        let found = detectability(&hidden(-1.0));
        assert!(found.holds() && !found.fragile(), "it decays by itself: {found:?}");
        assert_eq!(found.modes.len(), 1, "and is reported all the same");
        assert!(!r_observability(&hidden(-1.0), &Tolerance::default()).unwrap().holds(), "not observable");
    }

    #[test]
    fn a_hidden_unstable_mode_is_named() {
        let found = detectability(&hidden(0.5));
        let violation = found.violations().next().unwrap();
        assert!((violation.s - 0.5).norm() < 1e-14, "{found:?}");
        assert_eq!(violation.position, ModePosition::Unstable);
        assert!(!found.fragile(), "clearly outside");
    }

    #[test]
    fn a_hidden_integrator_fails_on_the_boundary() {
        let found = detectability(&hidden(0.0));
        assert!(!found.holds() && found.fragile(), "it never decays, but by a hair: {found:?}");
        assert_eq!(found.modes[0].position, ModePosition::OnBoundary);
        let found = detectability(&hidden(-1e-7));
        assert!(found.holds() && found.fragile(), "stable, but close to the margin: {found:?}");
    }

    #[test]
    fn discrete_modes_are_judged_by_their_modulus() {
        let mut system = hidden(-0.5);
        system.time = TimeDomain::Discrete;
        assert!(detectability(&system).holds(), "|-0.5| < 1");
        let mut system = hidden(-1.5);
        system.time = TimeDomain::Discrete;
        assert!(!detectability(&system).holds(), "|-1.5| > 1 although its real part is negative");
    }

    #[test]
    fn a_free_state_is_undetectable_unless_measured() {
        let (e, a) = (dmatrix![1.0, 0.0], dmatrix![-1.0, 0.0]);
        let found = detectability(&autonomous(e.clone(), a.clone(), dmatrix![1.0, 0.0]));
        assert_eq!((found.holds(), found.normal_rank), (false, 1), "{found:?}");
        assert_eq!(found.free_direction, Some(vec![0.0, 1.0]), "x2 is in no equation");
        assert!(detectability(&autonomous(e, a, dmatrix![0.0, 1.0])).holds(), "x2 measured, x1 decays");
    }

    #[test]
    fn an_output_share_near_the_threshold_is_fragile() {
        let observability = |share: f64| {
            let mut system = hidden(-1.0);
            system.C = dmatrix![share, 1.0];
            r_observability(&system, &Tolerance::default()).unwrap()
        };
        let found = observability(1e-3);
        assert!(found.holds() && !found.fragile(), "a thousandth is data: {found:?}");
        assert!(observability(1e-8).fragile() && observability(1e-10).fragile(), "close to 1e-9");
        let found = observability(1e-15);
        assert!(!found.holds() && !found.fragile(), "that is noise: {found:?}");
    }

    #[test]
    fn a_faint_output_still_counts() {
        let mut system = hidden(2.0);
        for gain in [1e-200, 1e-12, 1e12, 1e200] {
            system.C = dmatrix![gain, gain];
            assert!(detectability(&system).holds(), "the unit of y is no property of the system: {gain:e}");
        }
    }
}
