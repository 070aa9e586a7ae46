//! The errors of one observer over a scenario.

use nalgebra::DMatrix;
use serde::{Deserialize, Serialize};

use super::runs::Motion;
use crate::observer::Design;
use crate::simulation::rms;

/// How large an error is.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct ErrorSize {
    /// Root mean square over the whole horizon.
    pub rms: f64,
    /// Largest absolute value over the whole horizon.
    pub largest: f64,
    /// Root mean square over the second half.
    pub late_rms: f64,
    /// Largest absolute value over the second half.
    pub late_largest: f64,
}

/// Errors of a scenario.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct ScenarioErrors {
    /// One for each state; `None` for a state that the observer does not estimate.
    pub states: Vec<Option<ErrorSize>>,
    /// One for each unknown input that the observer estimates.
    pub unknown: Vec<ErrorSize>,
    /// All estimated states together: the root of the sum of mean squares, and the largest of the largest; none when the
    /// observer estimates none.
    pub all_states: Option<ErrorSize>,
    /// All estimated unknown inputs together; none when the observer estimates none.
    pub all_unknown: Option<ErrorSize>,
}

/// The errors of a design's motion.
pub(super) fn of(motion: &Motion, design: &Design) -> ScenarioErrors {
    let (t, own) = (&motion.trajectory.t, motion.own());
    let (states, unknown) = (sizes(t, &own.e), sizes(t, &own.e_d));
    let estimated = design.estimated_states(states.len());
    ScenarioErrors {
        all_states: together(estimated.iter().filter_map(|k| states.get(*k))),
        all_unknown: together(unknown.iter()),
        states: states
            .into_iter()
            .enumerate()
            .map(|(k, size)| Some(size).filter(|_| estimated.contains(&k)))
            .collect(),
        unknown,
    }
}

/// The sizes of each row of an error.
pub(super) fn sizes(t: &[f64], e: &DMatrix<f64>) -> Vec<ErrorSize> {
    let half = t.last().copied().unwrap_or(0.0) / 2.0;
    let from = t.partition_point(|t| *t < half).min(e.ncols());
    let late = e.columns(from, e.ncols() - from);
    let largest = |row: nalgebra::RowDVector<f64>| row.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
    let all = rms(t, e, f64::NEG_INFINITY);
    let second = rms(t, e, half);
    let row = |k: usize| ErrorSize {
        rms: all[k],
        largest: largest(e.row(k).into_owned()),
        late_rms: second[k],
        late_largest: largest(late.row(k).into_owned()),
    };
    (0..e.nrows()).map(row).collect()
}

/// All of them as one; `None` of none, since nothing estimated is not the same as no error.
pub(super) fn together<'a>(sizes: impl Iterator<Item = &'a ErrorSize>) -> Option<ErrorSize> {
    sizes.copied().reduce(|sum, size| ErrorSize {
        rms: sum.rms.hypot(size.rms),
        largest: sum.largest.max(size.largest),
        late_rms: sum.late_rms.hypot(size.late_rms),
        late_largest: sum.late_largest.max(size.late_largest),
    })
}
