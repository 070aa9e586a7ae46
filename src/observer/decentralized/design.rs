//! The designs of all subsystems, independent of each other, and the composite of their observers.

use crate::observer::design::needed;
use std::sync::{Arc, Mutex, OnceLock, PoisonError};

use super::composite::{composite, matrices, notes};
use super::{Local, LocalProblem, SetupError, design_local, local_problems};
use crate::lmi::Outcome;
use crate::numerics::{Tolerance, Watch};
use crate::observer::{Condition, Design, DesignChoice, DesignError, Order, Synthesis, Verification};
use crate::system::Model;

/// Designs the observers of all subsystems of a partitioned plant, one after the other.
///
/// # Errors
/// The first needed condition that fails; a plant or choice that does not fit; demands without a solution, with the
/// block that stops them and the nearest demands that have one.
///
/// # Source
/// Paper 000, Theorems 1 and 2.
pub fn design(
    model: &Model,
    choice: &DesignChoice,
    conditions: &[Condition],
    tolerance: &Tolerance,
    watch: &Watch,
) -> Result<Design, DesignError> {
    needed(conditions)?;
    let problems = local_problems(model).map_err(|error| DesignError::Unsuitable(error.to_string()))?;
    let outcomes = design_subsystems(&problems, choice, tolerance, watch)?;
    let mut locals = Vec::with_capacity(outcomes.len());
    let mut unproved = Vec::new();
    for outcome in outcomes {
        match outcome? {
            Outcome::Verified(local) => locals.push(local),
            Outcome::NotCertified { design, why } => {
                unproved.push(format!("{}: {why}", design.result.name));
                locals.push(design);
            }
            Outcome::Infeasible(why) => return Err(DesignError::Infeasible(why)),
            Outcome::Cancelled => return Err(DesignError::Cancelled),
            Outcome::GaveUp(why) => return Err(DesignError::GaveUp(why)),
        }
    }
    if !watch.go_on(1.0, "composite observer") {
        return Err(DesignError::Cancelled);
    }
    let orders: Vec<String> = locals.iter().map(|local| local.setup.family.order().to_string()).collect();
    let title = format!("decentralized observers, {} ({})", order_name(choice), orders.join(" + "));
    let verification = Verification {
        checks: locals.iter().flat_map(|local| local.checks.iter().cloned()).collect(),
        spectrum: locals.iter().flat_map(|local| local.spectrum.iter().copied()).collect(),
        skipped: locals
            .iter()
            .flat_map(|local| local.skipped.iter().map(|why| format!("{}: {why}", local.result.name)))
            .collect(),
    };
    let ignored = choice.lmi.given.is_some().then(|| {
        "an observer to examine is given, but only the H-infinity observer is examined: this one is designed".to_owned()
    });
    let notes = unproved.into_iter().chain(ignored).chain(notes(&locals)).collect();
    Ok(Design {
        title,
        matrices: matrices(&locals),
        observer: composite(&locals),
        injection: None,
        hierarchical: None,
        claim: None,
        synthesis: Synthesis::Lmi(locals.into_iter().map(|local| local.result).collect()),
        verification,
        notes,
    })
}

fn order_name(choice: &DesignChoice) -> &'static str {
    match choice.order {
        _ if !choice.lmi.rows.is_empty() => "given R",
        Order::Full | Order::General => "full order",
        Order::Reduced => "reduced order",
        Order::Minimal => "minimal order",
    }
}

/// The outcome of each subsystem, in their order.
pub type LocalOutcomes = Vec<Result<Outcome<Local>, DesignError>>;

/// Designs each subsystem for itself, without any matrix of the composite plant: the cost grows with their number.
///
/// They run on the executor of `watch`, which hears the mean progress of all and can stop each of them.
///
/// # Errors
/// Lists in the choice for another number of subsystems; what happens to a subsystem is in its outcome.
pub fn design_subsystems(
    problems: &[LocalProblem],
    choice: &DesignChoice,
    tolerance: &Tolerance,
    watch: &Watch,
) -> Result<LocalOutcomes, SetupError> {
    super::setup::check_counts(choice, problems.len())?;
    let slots: Vec<OnceLock<Result<Outcome<Local>, DesignError>>> =
        problems.iter().map(|_| OnceLock::new()).collect();
    let progress = Arc::new(Mutex::new(vec![0.0_f32; problems.len()]));
    watch.executor().run(problems.len(), &|number| {
        let (Some(problem), Some(slot)) = (problems.get(number), slots.get(number)) else { return };
        let own = share(watch, &progress, number, &problem.name);
        let outcome = if own.go_on(0.0, "conditions") {
            design_local(problem, number, choice, tolerance, &own)
        } else {
            Ok(Outcome::Cancelled)
        };
        // a task that runs twice gives the same outcome
        drop(slot.set(outcome));
    });
    let never_run = || Ok(Outcome::GaveUp("the executor left this subsystem out".to_owned()));
    Ok(slots.into_iter().map(|slot| slot.into_inner().unwrap_or_else(never_run)).collect())
}

/// The watch of one subsystem: its progress enters the mean of all.
fn share(watch: &Watch, progress: &Arc<Mutex<Vec<f32>>>, number: usize, name: &str) -> Watch {
    let (watch, progress, name) = (watch.clone(), Arc::clone(progress), name.to_owned());
    Watch::new(move |fraction, what| {
        let mean = {
            let mut all = progress.lock().unwrap_or_else(PoisonError::into_inner);
            if let Some(own) = all.get_mut(number) {
                *own = own.max(fraction);
            }
            all.iter().sum::<f32>() / all.len().max(1) as f32
        };
        watch.go_on(mean, &format!("{name}: {what}"))
    })
}
