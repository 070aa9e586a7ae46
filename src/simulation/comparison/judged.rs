//! What is known of a design without running it.

use nalgebra::DMatrix;

use super::{ComparedDesign, ErrorGains, ErrorStateSpace};
use crate::numerics::{Complex64, NumericsError, StabilityRegion, Tolerance, svd};
use crate::observer::{Design, Synthesis, error_system};
use crate::system::{DescriptorSystem, TimeDomain};

/// The row of a design, with its error system where it has one.
///
/// # Errors
/// When a decomposition fails its check.
pub(in crate::simulation) fn judged(
    system: &DescriptorSystem,
    design: &Design,
    tolerance: &Tolerance,
) -> Result<(ComparedDesign, Option<ErrorStateSpace>), NumericsError> {
    let errors = error_system(system, design, tolerance);
    let gains = match &errors {
        Ok(errors) => errors.gains(tolerance).unwrap_or_else(|error| ErrorGains::none(&error.to_string())),
        Err(error) => ErrorGains::none(&error.to_string()),
    };
    let region = StabilityRegion::of(system.time == TimeDomain::Discrete);
    Ok((judged_by_itself(design, region, gains)?, errors.ok()))
}

/// What a design tells of itself, beside the gains of its error; nothing of a scenario yet.
///
/// # Errors
/// When a decomposition fails its check.
pub(super) fn judged_by_itself(
    design: &Design,
    region: StabilityRegion,
    gains: ErrorGains,
) -> Result<ComparedDesign, NumericsError> {
    let spectrum = design.verification.spectrum.clone();
    let slowest = slowest(&spectrum, region);
    let Parts { order, states, local_gain, local_modes } = Parts::of(design)?;
    let chosen_gain = match &design.synthesis {
        Synthesis::Poles(placement) => largest_gain(&placement.gain)?,
        Synthesis::Lmi(results) => results.iter().map(|result| result.gain).fold(0.0, f64::max),
    };
    Ok(ComparedDesign {
        title: design.title.clone(),
        order,
        states,
        estimated: design.estimated_states(states),
        verified: design.verification.verified(),
        slowest,
        margin: slowest.map(|mode| -region.excess(mode)),
        spectrum,
        fixed_modes: design.synthesis.fixed_modes().into_iter().chain(local_modes).collect(),
        output_gain: largest_gain(&design.observer.L)?.max(local_gain),
        direct_gain: largest_gain(&design.observer.V)?,
        chosen_gain: chosen_gain.max(local_gain),
        guaranteed: guaranteed(&design.synthesis),
        gains,
        scenario: Err("it has not run in a scenario".to_owned()),
    })
}

/// What the common form does not say of a hierarchical observer: its local observers.
struct Parts {
    /// Own states, those of all local observers included.
    order: usize,
    /// States of the plant.
    states: usize,
    /// The largest gain of a local observer.
    local_gain: f64,
    /// Modes that no gain of a local observer can move, once for each different one.
    local_modes: Vec<Complex64>,
}

impl Parts {
    fn of(design: &Design) -> Result<Self, NumericsError> {
        let Some(observer) = &design.hierarchical else {
            let (order, states) = (design.observer.order(), design.observer.P.nrows());
            return Ok(Self { order, states, local_gain: 0.0, local_modes: Vec::new() });
        };
        let (n, size) = (observer.hierarchy.M.nrows(), observer.hierarchy.N.nrows());
        let order = observer.hierarchy.order() + n * observer.locals().count();
        let mut parts = Self { order, states: n * size, local_gain: 0.0, local_modes: Vec::new() };
        for (local, _) in observer.distinct_locals() {
            parts.local_gain = parts.local_gain.max(largest_gain(&local.h)?);
            parts.local_modes.extend(&local.placement.fixed_modes);
        }
        Ok(parts)
    }
}

/// The largest singular value of a matrix; zero for an empty one.
fn largest_gain(matrix: &DMatrix<f64>) -> Result<f64, NumericsError> {
    Ok(svd(matrix)?.s.first().copied().unwrap_or(0.0))
}

/// The eigenvalue nearest to the boundary of stability, or furthest beyond it; of a pair the upper one.
fn slowest(spectrum: &[Complex64], region: StabilityRegion) -> Option<Complex64> {
    let order = |a: &&Complex64, b: &&Complex64| {
        region.excess(**a).total_cmp(&region.excess(**b)).then(a.im.total_cmp(&b.im))
    };
    spectrum.iter().max_by(order).copied()
}

/// The proved attenuation, when that of every subsystem is.
fn guaranteed(synthesis: &Synthesis) -> Option<f64> {
    let of = |result: &crate::observer::LmiResult| result.gamma.filter(|_| result.certificate.proved);
    let gammas: Option<Vec<f64>> = synthesis.lmi().iter().map(of).collect();
    gammas?.into_iter().reduce(f64::max)
}
