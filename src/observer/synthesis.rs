//! Where the gains of a design come from, and what is known of their quality.

use serde::{Deserialize, Serialize};

use crate::numerics::{Complex64, HInfinityNorm, Placement};

/// How the gains of a design were found.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum Synthesis {
    /// By pole placement.
    Poles(Box<Placement>),
    /// By linear matrix inequalities, one result for each subsystem.
    Lmi(Vec<LmiResult>),
}

impl Synthesis {
    /// The placement, where there is one.
    pub fn placement(&self) -> Option<&Placement> {
        match self {
            Self::Poles(placement) => Some(placement),
            Self::Lmi(_) => None,
        }
    }

    /// The results by linear matrix inequalities; none for a placement.
    pub fn lmi(&self) -> &[LmiResult] {
        match self {
            Self::Poles(_) => &[],
            Self::Lmi(results) => results,
        }
    }

    /// Modes that no gain can move.
    pub fn fixed_modes(&self) -> Vec<Complex64> {
        match self {
            Self::Poles(placement) => placement.fixed_modes.clone(),
            Self::Lmi(results) => {
                results.iter().flat_map(|result| result.fixed_modes.iter().copied()).collect()
            }
        }
    }
}

/// What linear matrix inequalities gave for one system or subsystem.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct LmiResult {
    /// Name of the subsystem; empty for a system that is not partitioned.
    pub name: String,
    /// The least attenuation that the solver found for the demands; not proven.
    pub gamma_best: Option<f64>,
    /// The attenuation that the design guarantees when its certificate is proved.
    pub gamma: Option<f64>,
    /// The proof of the guarantee.
    pub certificate: Certificate,
    /// The H-infinity norm of the linear error system, found without inequalities.
    pub h_infinity: Option<HInfinityNorm>,
    /// Lower bounds of the attenuation by independent means, each with a name: the guarantee cannot be below them.
    pub bounds: Vec<(String, f64)>,
    /// Contraction factor of the implicit output equation, where there is one.
    pub contraction: Option<f64>,
    /// Norm of the free gain.
    pub gain: f64,
    /// Modes that no gain can move.
    pub fixed_modes: Vec<Complex64>,
    /// The limit that the fixed modes set to the decay demand.
    pub fastest_decay: Option<f64>,
    /// Iterations of the solver in all phases.
    pub iterations: u32,
}

/// A proof, made apart from the solver, that an inequality holds for the finished observer.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Certificate {
    /// Whether the inequality is proved in interval arithmetic.
    pub proved: bool,
    /// A proved lower bound of the smallest eigenvalue of the inequality; zero when nothing is proved.
    pub margin: f64,
    /// What is proved, as a sentence.
    pub statement: String,
    /// How, or why not.
    pub note: String,
}
