//! The examination of an observer that was designed elsewhere: what it really guarantees.
#![expect(non_snake_case, reason = "matrix letters follow paper 002")]

use nalgebra::DMatrix;

use super::design::{demands, settings, solve, stopped};
use super::finish::{Solved, finish};
use super::inequality::Demands;
use super::parameterisation::{Matrices, Parameterisation};
use super::plant::Plant;
use crate::lmi::Stop;
use crate::numerics::{Tolerance, Watch, eigenvalues};
use crate::observer::{Design, DesignChoice, DesignError, GivenObserver, LmiResult, Synthesis, show};

/// How far printed matrices may be from a member of the family, relative: two digits.
const FURTHEST: f64 = 0.05;
/// Step back from the least attenuation: enough for the proof, too little to blur the answer.
const BACK_OFF: f64 = 1e-4;

/// Examines an observer: the nearest member of the family, the least attenuation that can be proved for it, and what
/// that says of the claimed one.
///
/// # Errors
/// [`DesignError::Unsuitable`] when `N` and `J` do not fit `R` or are no observer of its family;
/// [`DesignError::Infeasible`] when nothing can be guaranteed for it.
pub(super) fn audit(
    plant: &Plant,
    family: &Parameterisation,
    choice: &DesignChoice,
    given: &GivenObserver,
    tolerance: &Tolerance,
    watch: &Watch,
) -> Result<Design, DesignError> {
    let Z = member(plant, family, given, tolerance)?;
    let observer = family.recover(plant, &Z);
    let distance = distance(&observer, given);
    if distance > FURTHEST {
        return Err(DesignError::Unsuitable(format!(
            "the given N and J are no observer of this R: the nearest one differs by {distance:.2e} (relative); check \
             the order, R and the digits"
        )));
    }
    let fixed = family.fixed_at(&Z);
    let demands =
        Demands { decay: None, gain: None, conditioning: f64::INFINITY, gamma: None, ..demands(choice)? };
    let back_off = BACK_OFF.min(choice.lmi.back_off);
    let solved = solve(plant, &fixed, &demands, &settings(choice, back_off, watch))
        .map_err(|stop| not_guaranteed(&observer, stop))?;
    let mut design = finish(plant, family, choice, &Solved { Z, ..solved }, tolerance)?;
    design.title = format!("examined observer ({})", observer.N.nrows());
    let mut notes = vec![format!(
        "the given N and J are a relative distance {distance:.1e} from an observer that satisfies the design equations; \
         that observer is examined"
    )];
    if let (Some(claimed), Synthesis::Lmi(results)) = (given.gamma, &design.synthesis) {
        notes.extend(results.first().map(|result| verdict(claimed, result)));
    }
    notes.append(&mut design.notes);
    design.notes = notes;
    Ok(design)
}

/// The free matrix of the nearest member.
fn member(
    plant: &Plant,
    family: &Parameterisation,
    given: &GivenObserver,
    tolerance: &Tolerance,
) -> Result<DMatrix<f64>, DesignError> {
    let GivenObserver { N, J, .. } = given;
    let (q, p) = (family.order(), plant.system.n_outputs());
    if N.shape() != (q, q) || J.shape() != (q, p) {
        let shape = |m: &DMatrix<f64>| format!("{} x {}", m.nrows(), m.ncols());
        return Err(DesignError::Unsuitable(format!(
            "the given N is {} and J is {}, but R has {q} rows and there are {p} outputs: {q} x {q} and {q} x {p} are \
             needed",
            shape(N),
            shape(J)
        )));
    }
    if N.iter().chain(J.iter()).any(|x| !x.is_finite()) {
        return Err(DesignError::Unsuitable("the given N and J have an entry that is not finite".to_owned()));
    }
    Ok(family.nearest(N, J, tolerance)?)
}

/// Difference between given and nearest `[N J]`, relative to its size.
fn distance(observer: &Matrices, given: &GivenObserver) -> f64 {
    let difference = (&observer.N - &given.N).norm().hypot((&observer.J - &given.J).norm());
    let size = given.N.norm().hypot(given.J.norm());
    if size == 0.0 { difference } else { difference / size }
}

/// Why nothing is guaranteed: an unstable observer is said to be so.
fn not_guaranteed(observer: &Matrices, stop: Stop) -> DesignError {
    let worst = eigenvalues(&observer.N)
        .ok()
        .and_then(|modes| modes.into_iter().max_by(|a, b| a.re.total_cmp(&b.re)))
        .filter(|mode| mode.re >= 0.0);
    match (stop, worst) {
        (Stop::Infeasible { .. }, Some(mode)) => DesignError::Unsuitable(format!(
            "the given observer is not stable: its N has the eigenvalue {}",
            show(mode)
        )),
        (stop, _) => stopped(stop),
    }
}

/// What the examination says of a claimed attenuation.
fn verdict(claimed: f64, result: &LmiResult) -> String {
    let least = result.gamma_best.unwrap_or(f64::INFINITY);
    let (name, lower) = result
        .bounds
        .iter()
        .max_by(|a, b| a.1.total_cmp(&b.1))
        .map_or(("no bound", 0.0), |(name, norm)| (name.as_str(), *norm));
    let proved = result.gamma.filter(|_| result.certificate.proved);
    let squares = |gamma: f64| format!("gamma = {gamma:.4} (gamma^2 = {:.4})", gamma * gamma);
    match proved {
        _ if lower > claimed => format!(
            "the claimed {} is refuted: {name} alone has the norm {lower:.4}; the least {} can be proved",
            squares(claimed),
            squares(least)
        ),
        Some(gamma) if gamma <= claimed => format!(
            "the claimed {} holds: {} is proved, and {name} has the norm {lower:.4}",
            squares(claimed),
            squares(gamma)
        ),
        _ => format!(
            "the claimed {} is neither proved nor refuted: the inequality gives no less than {}, while {name} has the \
             norm {lower:.4}",
            squares(claimed),
            squares(least)
        ),
    }
}
