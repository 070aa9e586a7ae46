//! Regions of the complex plane in which modes decay.

use num_complex::Complex64;
use serde::{Deserialize, Serialize};

use super::Tolerance;

/// The open region in which a mode must lie to decay.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum StabilityRegion {
    /// `Re s < 0`: differential equations.
    LeftHalfPlane,
    /// `|z| < 1`: difference equations.
    UnitDisk,
}

/// Where a mode lies relative to a [`StabilityRegion`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum ModePosition {
    /// Inside by more than the margin, with all members of its cluster.
    Stable,
    /// Within the margin of the boundary: counts as not stable.
    OnBoundary,
    /// Outside.
    Unstable,
}

impl ModePosition {
    /// Whether a verdict on modes hangs on the boundary: none lies clearly outside, and at least one close to it.
    ///
    /// `positions` are those for a margin that counts as close, not for the margin of the verdict itself.
    pub fn hang_on_the_boundary(positions: impl IntoIterator<Item = Self>) -> bool {
        let mut close = false;
        for position in positions {
            match position {
                Self::Unstable => return false,
                Self::OnBoundary => close = true,
                Self::Stable => {}
            }
        }
        close
    }
}

impl StabilityRegion {
    /// The region of difference equations, or of differential ones.
    pub fn of(discrete: bool) -> Self {
        if discrete { Self::UnitDisk } else { Self::LeftHalfPlane }
    }

    /// How far `z` lies outside: `Re z`, or `|z| - 1`; negative inside.
    pub fn excess(self, z: Complex64) -> f64 {
        match self {
            Self::LeftHalfPlane => z.re,
            Self::UnitDisk => z.norm() - 1.0,
        }
    }

    /// The region as a statement on eigenvalues.
    pub fn statement(self) -> &'static str {
        match self {
            Self::LeftHalfPlane => "Re s < 0 for every eigenvalue of the error dynamics",
            Self::UnitDisk => "|z| < 1 for every eigenvalue of the error dynamics",
        }
    }

    /// Whether `z` lies inside by more than `margin`: `Re z < -margin`, or `|z| < 1 - margin`.
    pub fn contains(self, z: Complex64, margin: f64) -> bool {
        match self {
            Self::LeftHalfPlane => z.re < -margin,
            Self::UnitDisk => z.norm() < 1.0 - margin,
        }
    }

    /// The margin in units of `z`: `tolerance.margin * scale` for the half plane, `tolerance.margin` for the disk.
    ///
    /// `scale` is the size of the data in units of `s`, `norm A / norm E`.
    pub fn margin(self, scale: f64, tolerance: &Tolerance) -> f64 {
        match self {
            Self::LeftHalfPlane => tolerance.margin * scale,
            Self::UnitDisk => tolerance.margin,
        }
    }

    /// Where a cluster of modes lies: stable only when its centre and every member are.
    pub fn position(self, centre: Complex64, members: &[Complex64], margin: f64) -> ModePosition {
        if self.contains(centre, margin) && members.iter().all(|&z| self.contains(z, margin)) {
            ModePosition::Stable
        } else if self.contains(centre, -margin) {
            ModePosition::OnBoundary
        } else {
            ModePosition::Unstable
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_boundary_does_not_belong_to_the_region() {
        let on_axis = Complex64::new(0.0, 3.0);
        let half_plane = StabilityRegion::LeftHalfPlane;
        assert!(!half_plane.contains(on_axis, 0.0), "Re s = 0 does not decay");
        assert_eq!(half_plane.position(on_axis, &[on_axis], 1e-9), ModePosition::OnBoundary);
        let on_circle = Complex64::new(0.6, 0.8);
        assert_eq!(
            StabilityRegion::UnitDisk.position(on_circle, &[on_circle], 1e-9),
            ModePosition::OnBoundary
        );
    }

    #[test]
    fn one_member_outside_spoils_a_cluster() {
        let members = [Complex64::from(-2e-8), Complex64::from(1e-8)];
        let position = StabilityRegion::LeftHalfPlane.position(Complex64::from(-5e-9), &members, 1e-9);
        assert_ne!(position, ModePosition::Stable, "a member has a positive real part");
    }

    #[test]
    fn a_mode_that_is_clearly_outside_leaves_nothing_to_hang_on() {
        use ModePosition::{OnBoundary, Stable, Unstable};
        assert!(ModePosition::hang_on_the_boundary([Stable, OnBoundary]), "one is close");
        assert!(!ModePosition::hang_on_the_boundary([Stable, Stable]), "all are clearly inside");
        assert!(!ModePosition::hang_on_the_boundary([OnBoundary, Unstable]), "one decides");
    }

    #[test]
    fn the_disk_is_for_difference_equations() {
        let z = Complex64::from(-0.5);
        let outside = Complex64::from(-1.5);
        assert_eq!(StabilityRegion::UnitDisk.position(z, &[z], 1e-9), ModePosition::Stable);
        assert_eq!(StabilityRegion::UnitDisk.position(outside, &[outside], 1e-9), ModePosition::Unstable);
    }
}
