//! What a design returns, whatever its method.
#![expect(non_snake_case, reason = "matrix letters of the verification claim")]

use nalgebra::DMatrix;
use serde::{Deserialize, Serialize};

use super::hierarchical::HierarchicalObserver;
use super::{Condition, Injection, LinearObserver, Synthesis, Verdict, Verification};
use crate::lmi::Infeasible;
use crate::numerics::{Complex64, NumericsError, PlacementError};

/// A matrix under the name that the paper gives it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct NamedMatrix {
    /// The paper's letter, in ASCII.
    pub name: String,
    /// What it is, in words.
    pub meaning: String,
    /// Its entries.
    pub value: DMatrix<f64>,
}

/// The relations between plant and observer that a design claims and `verify` re-checks in the plant's own matrices.
///
/// With `Ea = [E 0; 0 I]`, `Aa = [A D; 0 s I]`, `Ba = [B; 0]`, `Ca = [C F]` (s = 0 in continuous, 1 in discrete time;
/// without unknown-input estimate the second block row and column are absent):
/// ```text
/// N T Ea - T Aa + L Ca = 0          z - T Ea [x; d] obeys  eps' = N eps
///             H - T Ba = 0
/// [P; Q] T Ea + G [A D] + [V; R] Ca = I,   [W; S] + G B = 0,   G E = 0
/// ```
///
/// # Shapes
/// `T`: o x (e + q); `G`: (n + q) x e.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Claim {
    /// What the observer's state tracks: `z -> T Ea [x; d]`.
    pub T: DMatrix<f64>,
    /// How the algebraic equations enter the estimates.
    pub G: DMatrix<f64>,
}

/// A designed observer with everything needed to show, check, run and export it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Design {
    /// Method and order in words, for example `proportional-integral observer of reduced order`.
    pub title: String,
    /// The matrices under the paper's names.
    pub matrices: Vec<NamedMatrix>,
    /// The runnable form.
    pub observer: LinearObserver,
    /// How the plant's nonlinearity enters it, where there is one.
    pub injection: Option<Injection>,
    /// The global and the local observers of a network; `observer` is the same as one, or of a network that is too large
    /// to be written as one the global observer alone, whose estimate is `z`.
    pub hierarchical: Option<Box<HierarchicalObserver>>,
    /// What it claims of itself; a composite of local observers claims nothing beyond what each of them does.
    pub claim: Option<Claim>,
    /// How the gains were found.
    pub synthesis: Synthesis,
    /// The re-check, made by other arithmetic.
    pub verification: Verification,
    /// What a user should know: unused poles, ill-conditioned gains, split multiple poles.
    pub notes: Vec<String>,
}

impl Design {
    /// The matrix with that name.
    pub fn matrix(&self, name: &str) -> Option<&DMatrix<f64>> {
        self.matrices.iter().find(|m| m.name == name).map(|m| &m.value)
    }

    /// The states of a plant with `n` states whose estimate tends to the truth, from zero, in ascending order: all, but of
    /// a network those that [`HierarchicalObserver::estimated_states`] names.
    pub fn estimated_states(&self, n: usize) -> Vec<usize> {
        match &self.hierarchical {
            Some(observer) => observer.estimated_states().into_iter().filter(|k| *k < n).collect(),
            None => (0..n).collect(),
        }
    }
}

/// Why there is no design.
#[derive(Clone, Debug, PartialEq, thiserror::Error, Serialize, Deserialize)]
pub enum DesignError {
    /// A condition that the design needs does not hold.
    #[error("condition {label} does not hold: {summary}")]
    Condition {
        /// Identifier of the condition.
        id: String,
        /// Its printed number.
        label: String,
        /// Why it fails.
        summary: String,
    },
    /// The method cannot use the data.
    #[error("{0}")]
    Unsuitable(String),
    /// Too few poles.
    #[error("{given} poles are given, but this design places {needed}: add {}", needed - given)]
    TooFewPoles {
        /// How many there are.
        given: usize,
        /// How many the design places.
        needed: usize,
    },
    /// A demand, a matrix `R` or a list of decoupled states that makes no sense or does not fit.
    #[error("{0}")]
    Demand(String),
    /// A pole without its conjugate, or one that is not finite.
    #[error("{0}")]
    Poles(String),
    /// The matrix inequalities have no solution.
    #[error("{0}")]
    Infeasible(Infeasible),
    /// The computation was cancelled.
    #[error("the design was cancelled")]
    Cancelled,
    /// The solver gave up.
    #[error("the matrix inequalities could not be decided: {0}")]
    GaveUp(String),
    /// A computation failed.
    #[error("{0}")]
    Numerics(String),
}

impl From<NumericsError> for DesignError {
    fn from(error: NumericsError) -> Self {
        match error {
            NumericsError::NotConjugate { .. } => Self::Poles(error.to_string()),
            NumericsError::PoleCount { found, needed } => Self::TooFewPoles { given: found, needed },
            NumericsError::NotFinite { .. }
            | NumericsError::Unreliable { .. }
            | NumericsError::Shape { .. }
            | NumericsError::Singular { .. } => Self::Numerics(error.to_string()),
        }
    }
}

impl From<PlacementError> for DesignError {
    fn from(error: PlacementError) -> Self {
        match error {
            PlacementError::Numerics(error) => error.into(),
            other => Self::Numerics(other.to_string()),
        }
    }
}

impl DesignError {
    /// Whether the document is at fault (a pole list, a demand) rather than the mathematics.
    pub fn is_bad_input(&self) -> bool {
        matches!(self, Self::TooFewPoles { .. } | Self::Poles(_) | Self::Demand(_))
    }
}

/// Asks that every needed condition holds.
///
/// # Errors
/// [`DesignError::Condition`] with the first that fails, else [`DesignError::Unsuitable`] with one that is not decided.
pub(super) fn needed(conditions: &[Condition]) -> Result<(), DesignError> {
    let missing = || conditions.iter().filter(|c| c.needed && !c.verdict.holds());
    let failed = missing().find(|c| c.verdict == Verdict::Fails);
    match failed.or_else(|| missing().next()) {
        Some(open) if failed.is_none() => {
            Err(DesignError::Unsuitable(format!("{} is not decided: {}", open.label, open.summary)))
        }
        Some(failed) => Err(DesignError::Condition {
            id: failed.id.clone(),
            label: failed.label.clone(),
            summary: failed.summary.clone(),
        }),
        None => Ok(()),
    }
}

/// A pole with the bandwidth factor applied: times `scale`, or in discrete time to the power `scale`.
///
/// A real pole of a difference equation keeps its sign: only its modulus, which is its speed, takes the power.
pub fn scaled_pole(pole: Complex64, scale: f64, discrete: bool) -> Complex64 {
    if !discrete || pole.norm() == 0.0 {
        return if discrete { pole } else { pole * scale };
    }
    let modulus = pole.norm().powf(scale);
    if pole.im == 0.0 {
        return Complex64::from(modulus.copysign(pole.re));
    }
    Complex64::from_polar(modulus, pole.arg() * scale)
}

/// The first `needed` poles of a list, scaled; a conjugate pair is never cut.
///
/// Scaling multiplies poles in continuous time and takes the power `scale` in discrete time (`z = exp(s T)`), so that
/// it stretches the bandwidth by the same factor in both.
///
/// # Errors
/// [`DesignError::TooFewPoles`], or [`DesignError::Poles`] when the first `needed` would cut a pair.
pub fn chosen_poles(
    poles: &[Complex64],
    scale: f64,
    discrete: bool,
    needed: usize,
) -> Result<Vec<Complex64>, DesignError> {
    if poles.len() < needed {
        return Err(DesignError::TooFewPoles { given: poles.len(), needed });
    }
    if discrete
        && poles[..needed].iter().any(|z| z.im != 0.0 && (z.arg() * scale).abs() > std::f64::consts::PI)
    {
        return Err(DesignError::Poles(format!(
            "the scale {scale} turns a complex pole beyond the negative real axis, where it stands for another \
             frequency: choose a smaller scale"
        )));
    }
    let scaled = |z: &Complex64| scaled_pole(*z, scale, discrete);
    let chosen: Vec<Complex64> = poles[..needed].iter().map(scaled).collect();
    if let Some(bad) = chosen.iter().find(|z| !z.re.is_finite() || !z.im.is_finite()) {
        return Err(DesignError::Poles(format!("the pole {bad} is not finite")));
    }
    crate::numerics::conjugate_pairs(&chosen).map_err(|error| {
        let cut = if poles.len() > needed {
            format!(" among the first {needed} poles, which this design uses")
        } else {
            String::new()
        };
        DesignError::Poles(format!("{error}{cut}"))
    })?;
    Ok(chosen)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn extra_poles_wait_and_missing_ones_are_counted() {
        let poles: Vec<Complex64> = [-1.0, -2.0, -3.0].map(Complex64::from).into();
        assert_eq!(
            chosen_poles(&poles, 2.0, false, 2).unwrap(),
            [-2.0, -4.0].map(Complex64::from),
            "scaled by 2"
        );
        let error = chosen_poles(&poles, 1.0, false, 5).unwrap_err();
        assert_eq!(
            error.to_string(),
            "3 poles are given, but this design places 5: add 2",
            "says what to do"
        );
    }

    #[test]
    fn a_cut_pair_is_refused() {
        let poles = [Complex64::from(-1.0), Complex64::new(-2.0, 1.0), Complex64::new(-2.0, -1.0)];
        assert!(matches!(chosen_poles(&poles, 1.0, false, 2), Err(DesignError::Poles(_))), "half a pair");
    }

    #[test]
    fn discrete_scaling_stretches_the_bandwidth() {
        let chosen = chosen_poles(&[Complex64::from(0.5), Complex64::from(0.0)], 2.0, true, 2).unwrap();
        assert!(
            (chosen[0] - 0.25).norm() < 1e-15 && chosen[1].norm() == 0.0,
            "0.5^2 and deadbeat: {chosen:?}"
        );
    }
}
