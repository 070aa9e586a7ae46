//! Observability and detectability of a pair, with evidence and witness.
#![expect(non_snake_case, reason = "matrix letters follow paper 003")]

use nalgebra::DMatrix;

use crate::numerics::{
    Complex64, NumericsError, PbhMode, StabilityRegion, Tolerance, observable_quotient, pbh_modes,
};
use crate::observer::{Condition, Evidence, PointEvidence, Verdict, Witness, show};

/// A tested mode and the direction that is seen least.
pub(super) struct Mode {
    pub(super) point: PointEvidence,
    direction: Vec<Complex64>,
}

impl Mode {
    pub(super) fn harmless(&self) -> bool {
        !self.point.loses_rank || self.point.stable
    }
}

pub(super) fn points_of(modes: &[PbhMode], A: &DMatrix<f64>, tolerance: &Tolerance) -> Vec<Mode> {
    let region = StabilityRegion::LeftHalfPlane;
    let margin = region.margin(A.norm().max(1.0), tolerance);
    modes
        .iter()
        .map(|mode| Mode {
            point: PointEvidence {
                s: mode.value,
                multiplicity: mode.multiplicity,
                distance: mode.distance,
                loses_rank: mode.unobservable,
                stable: region.contains(mode.value, margin),
            },
            direction: mode.direction.clone(),
        })
        .collect()
}

/// Asks whether a pair is detectable, or with `observable` whether it is observable, and fills in verdict, summary,
/// evidence and witness.
///
/// # Errors
/// As [`pbh_modes`].
pub(super) fn pair(
    result: &mut Condition,
    tested: (&DMatrix<f64>, &DMatrix<f64>),
    (coordinate, of): (&str, &str),
    observable: bool,
    tolerance: &Tolerance,
) -> Result<(), NumericsError> {
    let modes = pbh_modes(tested.0, tested.1, tolerance)?;
    judge(result, (&modes, tested), (coordinate, of), observable, tolerance)
}

/// The same with modes that have been tested.
///
/// # Errors
/// As [`pbh_modes`].
pub(super) fn judge(
    result: &mut Condition,
    (modes, (A, C)): (&[PbhMode], (&DMatrix<f64>, &DMatrix<f64>)),
    (coordinate, of): (&str, &str),
    observable: bool,
    tolerance: &Tolerance,
) -> Result<(), NumericsError> {
    let modes = points_of(modes, A, tolerance);
    let hidden = modes.iter().any(|mode| mode.point.loses_rank);
    let matters = |mode: &&Mode| observable || !mode.point.stable;
    let bad = modes.iter().filter(|mode| mode.point.loses_rank).find(matters);
    let narrow = tolerance.mode * tolerance.gap;
    let near = |mode: &Mode| !mode.point.loses_rank && mode.point.distance < narrow && matters(&mode);
    result.verdict = Verdict::of(bad.is_none(), modes.iter().any(near));
    result.summary = match bad {
        Some(mode) if observable => format!("the mode {} is not observable", show(mode.point.s)),
        Some(mode) => format!("the mode {} is not observable and not stable", show(mode.point.s)),
        None if hidden => {
            // a mode may be hidden in part: what counts is the dimension of all that is hidden
            let fixed = observable_quotient(A, C, tolerance)?.unobservable.ncols();
            let (modes, all) = if fixed == 1 { ("mode", "which is") } else { ("modes", "all") };
            format!("{fixed} fixed {modes}, {all} stable")
        }
        None => {
            let closest = modes.iter().map(|mode| mode.point.distance).fold(f64::INFINITY, f64::min);
            format!("all {} modes are observable (closest distance {closest:.2e})", A.nrows())
        }
    };
    result.witness = bad.map(|mode| Witness {
        s: Some(mode.point.s),
        direction: mode.direction.clone(),
        coordinates: (1..=A.nrows()).map(|i| format!("{coordinate}{i}")).collect(),
    });
    let points = modes.into_iter().map(|mode| mode.point).collect();
    result.evidence.push(Evidence::Points { of: of.to_owned(), points });
    Ok(())
}
