//! What a plant's equations leave free, and what they determine of the unknown inputs.

use nalgebra::DVector;
use serde::{Deserialize, Serialize};

use crate::document::Document;
use crate::numerics::{Complex64, StabilityRegion};
use crate::simulation::{BoundingFeedback, FeedbackError, WidePlant};
use crate::system::{Model, TimeDomain};

/// The free states of a plant that does not run as it is.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct FreeReport {
    /// How many variables are free.
    pub n_free: usize,
    /// Their directions in words: `v1 = 0.7071 x3 - 0.7071 x4`.
    pub directions: Vec<String>,
    /// How many combinations of the unknown inputs the equations determine.
    pub constrained: usize,
    /// Modes of the plant with the feedback in force, or why it has none.
    pub modes: Result<Vec<Complex64>, String>,
    /// Those of them that are not stable.
    pub unstable: Vec<Complex64>,
    /// Whether there is more to the plant than what has these modes: a nonlinearity or uncertain entries.
    pub linear_part: bool,
    /// A feedback that keeps the plant bounded, or why there is none or no need for one.
    pub bounding: Result<BoundingFeedback, String>,
    /// What simulations remark of the free states: the same in a sentence.
    remark: Option<String>,
}

impl FreeReport {
    /// Reports on the plant of a document; `None` for one that runs as it is, which has no free states, and for equations
    /// that contradict each other, of which the simulation says more.
    pub(super) fn new(document: &Document, model: &Model) -> Option<Self> {
        let system = &model.system;
        let tolerance = &document.tolerance;
        let x0 = DVector::zeros(system.n_states());
        let wide = WidePlant::needed(model, &x0, &DVector::zeros(system.n_inputs()), tolerance).ok()??;
        let uncertainty = document.scenario.uncertainty.as_ref();
        let uncertain = uncertainty
            .is_some_and(|data| data.scale != 0.0 && data.amplitude.values().iter().any(|x| *x != 0.0));
        let in_words = |error: FeedbackError| match error {
            FeedbackError::BoundedAlready { modes, linear_part } => {
                FeedbackError::BoundedAlready { modes, linear_part: linear_part || uncertain }.to_string()
            }
            other => other.to_string(),
        };
        let modes = wide
            .motion(model, &document.scenario.free.values(), tolerance)
            .and_then(|motion| {
                let discrete = system.time == TimeDomain::Discrete;
                let region = StabilityRegion::of(discrete);
                let margin = region.margin(motion.A.norm().max(1.0), tolerance);
                let modes = motion.modes()?;
                let unstable = modes.iter().copied().filter(|z| !region.contains(*z, margin)).collect();
                Ok((modes, unstable))
            })
            .map_err(|error| error.to_string());
        let unstable =
            modes.as_ref().map_or_else(|_| Vec::new(), |(_, unstable): &(_, Vec<_>)| unstable.clone());
        Some(Self {
            n_free: wide.n_free(),
            directions: wide.named_directions(),
            constrained: wide.constrained,
            modes: modes.map(|(modes, _)| modes),
            unstable,
            linear_part: model.lipschitz.is_some() || uncertain,
            bounding: wide.bounding_feedback(model, tolerance).map_err(in_words),
            remark: wide.remark(),
        })
    }

    /// The remarks of a simulation without what stands in the scenario's place already.
    pub(super) fn without_own(report: Option<&Self>, mut remarks: Vec<String>) -> Vec<String> {
        let own = report.and_then(|report| report.remark.as_ref());
        remarks.retain(|remark| Some(remark) != own);
        remarks
    }
}
