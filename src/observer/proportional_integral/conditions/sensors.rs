//! What would mend a condition: one more sensor; and the system augmented by its unknown input.
#![expect(non_snake_case, reason = "matrix letters follow Koenig and Mammar 2002")]

use nalgebra::DMatrix;

use super::Ask;
use crate::numerics::Block::{Of, Zero};
use crate::numerics::{block_matrix, side_by_side, stack};
use crate::observer::proportional_integral::hold;
use crate::system::DescriptorSystem;
use crate::system::properties::PropertyError;

impl Ask<'_> {
    /// As [`single_sensors`] for the system that is asked about.
    pub(super) fn sensors(
        &self,
        holds: impl Fn(&DescriptorSystem) -> Result<bool, PropertyError>,
    ) -> Result<Vec<String>, PropertyError> {
        single_sensors(self.system, holds)
    }
}

/// States whose measurement alone would make a condition hold, as sentences.
pub(in crate::observer) fn single_sensors(
    system: &DescriptorSystem,
    holds: impl Fn(&DescriptorSystem) -> Result<bool, PropertyError>,
) -> Result<Vec<String>, PropertyError> {
    const LARGEST: usize = 16;
    let n = system.n_states();
    if n > LARGEST {
        return Ok(Vec::new());
    }
    let mut remedies = Vec::new();
    for i in 0..n {
        if holds(&with_sensor(system, i))? {
            remedies.push(format!("measure x{0}: add the row with a 1 in column {0} to C", i + 1));
        }
    }
    if remedies.is_empty() {
        remedies.push("no single additional sensor of one state restores it".to_owned());
    }
    Ok(remedies)
}

/// The system with a further output that measures one state.
fn with_sensor(system: &DescriptorSystem, state: usize) -> DescriptorSystem {
    let mut row = DMatrix::zeros(1, system.n_states());
    row[(0, state)] = 1.0;
    let F = stack(&[&system.F, &DMatrix::zeros(1, system.n_unknown_inputs())]);
    DescriptorSystem { C: stack(&[&system.C, &row]), F, ..system.clone() }
}

/// The system (3): the unknown input as a further state that holds its value.
pub(super) fn augmented_system(system: &DescriptorSystem) -> DescriptorSystem {
    let DescriptorSystem { time, E, A, C, D, F, .. } = system;
    let q = system.n_unknown_inputs();
    let unit = DMatrix::identity(q, q);
    let rows = E.nrows() + q;
    DescriptorSystem {
        time: *time,
        E: block_matrix(&[&[Of(E), Zero], &[Zero, Of(&unit)]]),
        A: block_matrix(&[&[Of(A), Of(D)], &[Zero, Of(&(&unit * hold(*time)))]]),
        B: DMatrix::zeros(rows, 0),
        C: side_by_side(&[C, F]),
        D: DMatrix::zeros(rows, 0),
        F: DMatrix::zeros(C.nrows(), 0),
    }
}
