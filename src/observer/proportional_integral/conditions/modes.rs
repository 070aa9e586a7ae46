//! Conditions for all s on the system as given: (10) and R-detectability, decided at exact finite zeros.
#![expect(non_snake_case, reason = "matrix letters follow Koenig and Mammar 2002")]

use super::sensors::augmented_system;
use super::{Ask, PAPER, condition};
use crate::numerics::Block::Of;
use crate::numerics::{RankDecision, block_matrix, rank};
use crate::observer::proportional_integral::hold;
use crate::observer::{Condition, Evidence};
use crate::system::properties::{ModeCondition, PropertyError, r_detectability};
use crate::system::{DescriptorSystem, TimeDomain};

impl Ask<'_> {
    /// (10): R-detectability of the system augmented by its unknown input.
    // ERRATUM(004, appendix): the proof splits (12) into Re s > 0 and s = 0; the rest of the imaginary axis is missing.
    pub(super) fn condition_10(&self) -> Result<Condition, PropertyError> {
        let n = self.system.n_states() + self.system.n_unknown_inputs();
        let found = r_detectability(&augmented_system(self.system), self.tolerance)?;
        let at_integrator = self.rank_at_integrator(self.system)?;
        let discrete = self.system.time == TimeDomain::Discrete;
        let formula = if discrete {
            "rank [zE*-A* -N*; 0 (z-1)I; C* 0] = n + nf for all |z| >= 1"
        } else {
            "rank [sE*-A* -N*; 0 sI; C* 0] = n + nf for all Re s >= 0"
        };
        let mut result = condition("(10)", "detectability with the unknown input", formula);
        self.fill_modes(&mut result, &found, "[sE*-A* -N*; 0 sI; C* 0]");
        result.summary = format!(
            "{}; at {} rank {} of {n}, smallest singular value {:.3e}",
            result.summary,
            if discrete { "z = 1" } else { "s = 0" },
            at_integrator.rank,
            at_integrator.smallest()
        );
        result.evidence.insert(
            0,
            Evidence::rank(
                if discrete { "[A*-E* N*; C* 0] at z = 1" } else { "[A* N*; C* 0] at s = 0" },
                at_integrator,
                n,
            ),
        );
        if !found.holds() {
            result.remedies = self.sensors(|extended| {
                Ok(r_detectability(&augmented_system(extended), self.tolerance)?.holds())
            })?;
        }
        Ok(result)
    }

    /// Rank of the pencil of (10) at the integrator's own mode, s = 0 or z = 1, without the integrator's rows.
    fn rank_at_integrator(&self, system: &DescriptorSystem) -> Result<RankDecision, PropertyError> {
        let DescriptorSystem { E, A, C, D, F, .. } = system;
        let A = A - E * hold(system.time);
        Ok(rank(&block_matrix(&[&[Of(&A), Of(D)], &[Of(C), Of(F)]]), 0.0, self.tolerance)?)
    }

    /// R-detectability of the system itself, for observers without unknown-input estimate.
    pub(super) fn detectability(&self, found: &ModeCondition) -> Condition {
        let formula = match self.system.time {
            TimeDomain::Continuous => "rank [sE-A; C] = n for all Re s >= 0",
            TimeDomain::Discrete => "rank [zE-A; C] = n for all |z| >= 1",
        };
        let mut result = condition("Def. 1", "R-detectability", formula);
        "004-R-detectable".clone_into(&mut result.id);
        result.source = format!("{PAPER}, Definition 1; Darouach and Boutayeb 1995");
        self.fill_modes(&mut result, found, "[sE-A; C]");
        result
    }

    fn fill_modes(&self, result: &mut Condition, found: &ModeCondition, of: &str) {
        result.decide_on_modes(found, of, self.coordinates(), |modes| match modes.len() {
            0 => "no finite s at which rank is lost".to_owned(),
            count => format!("rank is lost at {count} finite s, all of them stable"),
        });
    }
}
