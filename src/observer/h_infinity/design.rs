//! The design: pose the inequalities, solve them, and hand what they give to the judges.
#![expect(non_snake_case, reason = "matrix letters follow paper 002")]

use crate::observer::design::needed;
use nalgebra::DMatrix;

use super::audit::audit;
use super::finish::{Solved, finish};
use super::inequality::{Demands, Posed, pose};
use super::nearest::nearest;
use super::parameterisation::Parameterisation;
use super::plant::Plant;
use super::rows::Rows;
use crate::lmi::{Found, Infeasible, Settings, Stop, feasible, minimise};
use crate::numerics::{Tolerance, Watch};
use crate::observer::{Condition, Design, DesignChoice, DesignError};
use crate::system::Model;
use crate::system::properties::PropertyError;

/// Part of the work after which a design that has no solution is searched for its nearest feasible demands.
const SHARE_OF_DESIGN: f32 = 0.4;

/// Designs the H-infinity observer of the chosen order, or examines a given one.
///
/// # Errors
/// The first needed condition that fails; demands that make no sense; [`DesignError::Infeasible`] with the nearest
/// feasible demands; [`DesignError::Cancelled`]; [`DesignError::GaveUp`].
///
/// # Source
/// Paper 002, Theorem 10 and the procedure behind it.
pub fn design(
    model: &Model,
    choice: &DesignChoice,
    conditions: &[Condition],
    tolerance: &Tolerance,
    watch: &Watch,
) -> Result<Design, DesignError> {
    needed(conditions)?;
    let demands = demands(choice)?;
    let plant = Plant::new(model, tolerance).map_err(refused)?;
    if plant.lambda < 0.0 {
        return Err(DesignError::Unsuitable(format!(
            "the Lipschitz constant is {}: it bounds a size and cannot be negative",
            plant.lambda
        )));
    }
    let rows = Rows::of(&plant, choice, tolerance)?.map_err(DesignError::Demand)?;
    if let Some(why) = rows.refusal(plant.n()) {
        return Err(DesignError::Demand(why));
    }
    let family = Parameterisation::new(&plant, &rows.R, tolerance)?;
    if let Some(given) = &choice.lmi.given {
        return audit(&plant, &family, choice, given, tolerance, watch);
    }
    let family = family.without_idle_directions(tolerance)?;
    let settings = settings(choice, choice.lmi.back_off, &watch.part(0.0, SHARE_OF_DESIGN));
    let solved = match solve(&plant, &family, &demands, &settings) {
        Ok(solved) => solved,
        Err(Stop::Infeasible { block, source, margin }) => {
            let settings = Settings { watch: watch.part(SHARE_OF_DESIGN, 1.0), ..settings };
            let nearest = nearest(&plant, &family, &demands, &settings).map_err(stopped)?;
            return Err(DesignError::Infeasible(Infeasible { block, source, margin, nearest }));
        }
        Err(stop) => return Err(stopped(stop)),
    };
    finish(&plant, &family, choice, &solved, tolerance)
}

/// The demands of a choice, after a look at whether they make sense.
pub(super) fn demands(choice: &DesignChoice) -> Result<Demands, DesignError> {
    let lmi = &choice.lmi;
    lmi.check(false)?;
    Ok(Demands {
        decay: lmi.decay,
        gain: lmi.gain,
        conditioning: lmi.conditioning,
        gamma: lmi.gamma,
        alternative: lmi.alternative,
    })
}

/// Settings of one solution; the back-off is given for gamma, the objective is its square.
pub(super) fn settings(choice: &DesignChoice, back_off: f64, watch: &Watch) -> Settings {
    let of_square = (1.0 + back_off) * (1.0 + back_off) - 1.0;
    Settings { back_off: of_square, seconds: choice.lmi.seconds, watch: watch.clone(), ..Settings::default() }
}

/// Solves the inequalities of a family: the least attenuation and a step back, or the one that is asked for.
pub(super) fn solve(
    plant: &Plant,
    family: &Parameterisation,
    demands: &Demands,
    settings: &Settings,
) -> Result<Solved, Stop> {
    let posed = pose(plant, family, demands);
    let found = match &posed.gamma2 {
        Some(gamma2) => minimise(&posed.problem, gamma2, settings)?,
        None => feasible(&posed.problem, settings)?,
    };
    recovered(&posed, &found, demands)
}

/// `Z = X^-1 W`.
fn recovered(posed: &Posed, found: &Found, demands: &Demands) -> Result<Solved, Stop> {
    let (X, W) = (found.point.value(&posed.X), found.point.value(&posed.W));
    let Z = if X.is_empty() { Some(DMatrix::zeros(0, W.ncols())) } else { X.clone().lu().solve(&W) };
    let Some(Z) = Z.filter(|Z| Z.iter().all(|x| x.is_finite())) else {
        return Err(Stop::GaveUp(
            "the Lyapunov matrix X is singular: lower the bound on its condition".to_owned(),
        ));
    };
    let gamma = posed.gamma2.as_ref().map(|gamma2| found.point.scalar(gamma2).max(0.0).sqrt());
    Ok(Solved {
        X,
        Z,
        mu: found.point.scalar(&posed.mu),
        gamma: gamma.or(demands.gamma),
        gamma_best: found.optimum.map(|optimum| optimum.max(0.0).sqrt()),
        decay: demands.decay,
        iterations: found.iterations,
    })
}

/// What a stop without a solution means for a design.
pub(super) fn stopped(stop: Stop) -> DesignError {
    match stop {
        Stop::Infeasible { block, source, margin } => {
            DesignError::Infeasible(Infeasible { block, source, margin, nearest: Vec::new() })
        }
        Stop::Cancelled => DesignError::Cancelled,
        Stop::GaveUp(why) => DesignError::GaveUp(why),
    }
}

fn refused(error: PropertyError) -> DesignError {
    match error {
        PropertyError::System(error) => DesignError::Unsuitable(error.to_string()),
        PropertyError::Numerics(error) => error.into(),
    }
}
