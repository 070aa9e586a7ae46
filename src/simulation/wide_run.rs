//! Runs a plant of any shape through its completion.

use nalgebra::{DMatrix, DVector};

use super::joint::check;
use super::run::check_vector;
use super::{
    FreeVariables, InitialState, Observed, ObserverTrajectory, Plant, Scenario, SimulationError, Trajectory,
    WidePlant,
};
use crate::numerics::{Tolerance, Watch, stack};
use crate::observer::{Injection, LinearObserver};
use crate::system::Model;

/// Simulates a scenario of a plant that does not run as it is.
pub(super) fn run(
    scenario: &Scenario,
    model: &Model,
    wide: &WidePlant,
    observers: &[Observed<'_>],
    tolerance: &Tolerance,
    watch: &Watch,
) -> Result<Trajectory, SimulationError> {
    let system = &model.system;
    let (n, q) = (system.n_states(), system.n_unknown_inputs());
    check_vector("the initial state x0", scenario.x0.as_slice(), n)?;
    for (i, observed) in observers.iter().enumerate() {
        check(i, observed.observer, system)?;
    }
    if let Some(uncertainty) = &scenario.uncertainty {
        wide.repeats.check(uncertainty, &system.A)?;
    }
    let completed = wide.completed(model, &scenario.free)?;
    let extended: Vec<(LinearObserver, Option<Injection>)> =
        observers.iter().map(|observed| estimating_both(observed, q)).collect();
    let extended: Vec<Observed<'_>> = extended
        .iter()
        .map(|(observer, injection)| Observed { observer, injection: injection.as_ref() })
        .collect();
    let square = Scenario {
        x0: DVector::from_iterator(
            scenario.x0.len() + q,
            scenario.x0.iter().copied().chain(std::iter::repeat_n(0.0, q)),
        ),
        uncertainty: scenario.uncertainty.as_ref().map(|given| wide.uncertain(given)),
        ..scenario.clone()
    };
    let found = square.run_with(&completed, &extended, (q, &scenario.free.signals), tolerance, watch);
    let found = match found {
        Err(refused @ SimulationError::NotIndexOne { .. }) if scenario.free.feedback.is_some() => {
            // does the feedback spoil what is of index 1 without it?
            let without = wide.completed(model, &FreeVariables::default())?;
            let spoilt = Plant::of(&without, None, tolerance).is_ok();
            return Err(if spoilt { SimulationError::FreeFeedback } else { refused });
        }
        other => other?,
    };
    let corrected = (found.x.rows(n, q) - found.d.rows(0, q)).iter().fold(0.0, |l: f64, x| l.max(x.abs()));
    let mut trajectory = separated(found, observers, n);
    trajectory.remarks.extend(remarks(wide, &scenario.free, corrected));
    trajectory.remarks.extend(wide.repeats.remark(system, &trajectory));
    Ok(trajectory)
}

/// The observer as an estimator of `[x; d]`; zeros where it does not estimate `d`.
fn estimating_both(observed: &Observed<'_>, q: usize) -> (LinearObserver, Option<Injection>) {
    let o = observed.observer;
    let none = |m: &DMatrix<f64>| DMatrix::zeros(0, m.ncols());
    let below = |top: &DMatrix<f64>, bottom: &DMatrix<f64>| {
        let zeros = DMatrix::zeros(q, top.ncols());
        stack(&[top, if bottom.nrows() == q { bottom } else { &zeros }])
    };
    let observer = LinearObserver {
        P: below(&o.P, &o.Q),
        V: below(&o.V, &o.R),
        W: below(&o.W, &o.S),
        Q: none(&o.Q),
        R: none(&o.R),
        S: none(&o.S),
        ..o.clone()
    };
    let injection = observed.injection.map(|injection| Injection {
        state: injection.state.clone(),
        estimate: stack(&[&injection.estimate, &DMatrix::zeros(q, injection.estimate.ncols())]),
    });
    (observer, injection)
}

/// What a person should know: the free variables, and unknown inputs that are not as given.
fn remarks(wide: &WidePlant, free: &FreeVariables, corrected: f64) -> Vec<String> {
    let mut remarks: Vec<String> = wide.remark().into_iter().collect();
    let rows = free.feedback.as_ref().map_or(0, DMatrix::nrows);
    remarks.extend(waiting(free.signals.len(), ["signal", "signals"], wide.n_free()));
    remarks.extend(waiting(rows, ["row of the feedback", "rows of the feedback"], wide.n_free()));
    if wide.constrained > 0 {
        remarks.push(format!(
            "the algebraic equations determine {} of the unknown inputs (as combinations): d is corrected by up to \
             {corrected:.4e} so that they hold",
            wide.constrained
        ));
    }
    remarks
}

/// That of `given` signals or rows for `free` variables some wait; `None` when all count.
fn waiting(given: usize, [one, many]: [&str; 2], free: usize) -> Option<String> {
    if given <= free {
        return None;
    }
    let (what, wait) = if given == 1 { (one, "waits") } else { (many, "wait") };
    if free == 0 {
        return Some(format!("{given} {what} for free variables {wait}: the equations leave none free"));
    }
    let first = if free == 1 { "the first counts".to_owned() } else { format!("the first {free} count") };
    let others = if given - free == 1 { "the other waits" } else { "the others wait" };
    Some(format!("of {given} {what} for free variables {first}, {others}"))
}

/// The trajectory of `x` and `d` from that of the completed plant's state `[x; d]`.
fn separated(found: Trajectory, observers: &[Observed<'_>], n: usize) -> Trajectory {
    let q = found.x.nrows() - n;
    let (x, d) = (found.x.rows(0, n).into_owned(), found.x.rows(n, q).into_owned());
    let own = |(trajectory, observed): (ObserverTrajectory, &Observed<'_>)| {
        let estimated = observed.observer.n_estimated_inputs();
        let d_hat = trajectory.x_hat.rows(n, estimated).into_owned();
        let x_hat = trajectory.x_hat.rows(0, n).into_owned();
        let e_d = if estimated == q { &d - &d_hat } else { d_hat.clone() };
        ObserverTrajectory { e: &x - &x_hat, x_hat, e_d, d_hat, ..trajectory }
    };
    let InitialState { given, consistent, .. } = found.initial_state;
    let (given, consistent) = (given[..n].to_vec(), consistent[..n].to_vec());
    let change = given.iter().zip(&consistent).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    Trajectory {
        observers: found.observers.into_iter().zip(observers).map(own).collect(),
        initial_state: InitialState { given, consistent, change },
        x,
        d,
        ..found
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_waits_is_counted_in_words() {
        let signals = |given, free| waiting(given, ["signal", "signals"], free);
        assert_eq!(signals(1, 1), None, "all count");
        let said = |given, free| signals(given, free).unwrap();
        assert_eq!(said(1, 0), "1 signal for free variables waits: the equations leave none free");
        assert_eq!(said(2, 1), "of 2 signals for free variables the first counts, the other waits");
        assert_eq!(said(4, 2), "of 4 signals for free variables the first 2 count, the others wait");
    }
}
