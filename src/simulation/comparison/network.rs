//! Hierarchical observers of a network that is too large to be written as one system.

use super::judged::judged_by_itself;
use super::{ComparedDesign, Comparison, ComparisonRow, Contender, undecided};
use crate::numerics::{NumericsError, StabilityRegion, Tolerance, Watch};
use crate::observer::{Design, DesignError, ErrorGains, Method, assess_network};
use crate::system::Network;

/// Designs all contenders for a network of any size, which is never expanded: only hierarchical observers, and what is
/// known of them without running them. `None` when `watch` said stop.
pub fn compare_network(
    network: &Network,
    contenders: &[Contender<'_>],
    tolerance: &Tolerance,
    watch: &Watch,
) -> Option<Comparison> {
    let states = network.a.nrows() * network.n_subsystems();
    let only = format!(
        "the network has {states} states, too many to be written as one system: only the hierarchical observer, which \
         never does that, can be designed"
    );
    let mut comparison = Comparison::default();
    for (k, contender) in contenders.iter().enumerate() {
        let done = k as f32 / contenders.len() as f32;
        if !watch.go_on(done, &format!("designing {}", contender.name)) {
            return None;
        }
        let choice = contender.choice;
        let outcome = if choice.method == Method::Hierarchical {
            assess_network(network, choice, tolerance)
                .map_err(undecided)
                .and_then(|assessment| assessment.outcome)
                .and_then(|design| row(&design).map_err(undecided))
        } else {
            Err(DesignError::Unsuitable(only.clone()))
        };
        let (name, method, order) = (contender.name.to_owned(), choice.method, choice.order);
        comparison.rows.push(ComparisonRow { name, method, order, outcome });
    }
    comparison.notes.push(format!(
        "The network has {states} states and is never expanded: orders, spectra and gains are compared, but not the errors \
         of the whole."
    ));
    Some(comparison)
}

fn row(design: &Design) -> Result<ComparedDesign, NumericsError> {
    const WHY: &str = "the network is too large for the error of the whole";
    let mut row = judged_by_itself(design, StabilityRegion::LeftHalfPlane)?;
    row.gains = ErrorGains::none(WHY);
    row.scenario = Err(WHY.to_owned());
    Ok(row)
}
