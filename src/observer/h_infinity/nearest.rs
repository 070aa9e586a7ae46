//! Where demands have no solution: the nearest ones that have.

use super::inequality::{Demands, pose};
use super::parameterisation::Parameterisation;
use super::plant::Plant;
use crate::lmi::{Nearest, Settings, Stop, feasible, minimise};

/// Steps of each bisection: the answer is within a thousandth of what was asked.
const STEPS: u16 = 10;
/// How much more gain is tried, in decades.
const DECADES: f64 = 6.0;
/// The smallest part of a Lipschitz constant that is tried.
const LEAST_PART: f64 = 1e-6;

/// Decides feasibility by the largest margin.
struct Search<'a> {
    plant: &'a Plant,
    family: &'a Parameterisation,
    settings: &'a Settings,
}

/// For each demand the nearest value that is feasible while the others stay, where there is one.
///
/// # Errors
/// [`Stop::Cancelled`] alone: where a single question has no answer the bisection goes on as if it were no.
pub(super) fn nearest(
    plant: &Plant,
    family: &Parameterisation,
    demands: &Demands,
    settings: &Settings,
) -> Result<Vec<Nearest>, Stop> {
    let part = |k: u8| {
        let from = f32::from(k) / 4.0;
        Settings { watch: settings.watch.part(from, from + 0.25), ..settings.clone() }
    };
    let mut result = Vec::new();
    let mut add = |quantity: &str, asked: f64, feasible: Option<f64>| {
        result.extend(feasible.map(|feasible| Nearest { quantity: quantity.to_owned(), asked, feasible }));
    };
    if let Some(gamma) = demands.gamma {
        let settings = part(0);
        add("gamma", gamma, Search { plant, family, settings: &settings }.gamma(demands)?);
    }
    if let Some(decay) = demands.decay {
        let settings = part(1);
        add("decay rate", decay, Search { plant, family, settings: &settings }.decay(demands, decay)?);
    }
    if family.Lambda_TG.ncols() > 0 {
        let settings = part(2);
        let found = Search { plant, family, settings: &settings }.constant(demands)?;
        add("Lipschitz constant", plant.lambda, found);
    }
    if let Some(gain) = demands.gain.filter(|_| family.free_columns() > 0) {
        let settings = part(3);
        add("gain bound", gain, Search { plant, family, settings: &settings }.gain(demands, gain)?);
    }
    Ok(result)
}

impl Search<'_> {
    fn holds(&self, plant: &Plant, demands: &Demands, done: f32) -> Result<bool, Stop> {
        let settings = Settings { watch: self.settings.watch.part(done, 1.0), ..self.settings.clone() };
        match feasible(&pose(plant, self.family, demands).problem, &settings) {
            Ok(_) => Ok(true),
            Err(Stop::Cancelled) => Err(Stop::Cancelled),
            Err(Stop::Infeasible { .. } | Stop::GaveUp(_)) => Ok(false),
        }
    }

    /// The least attenuation, a step back from it.
    fn gamma(&self, demands: &Demands) -> Result<Option<f64>, Stop> {
        let posed = pose(self.plant, self.family, &Demands { gamma: None, ..*demands });
        let Some(gamma2) = &posed.gamma2 else { return Ok(None) };
        match minimise(&posed.problem, gamma2, self.settings) {
            Ok(found) => Ok(Some(found.point.scalar(gamma2).max(0.0).sqrt())),
            Err(Stop::Cancelled) => Err(Stop::Cancelled),
            Err(Stop::Infeasible { .. } | Stop::GaveUp(_)) => Ok(None),
        }
    }

    /// The largest decay; `None` when none is possible.
    fn decay(&self, demands: &Demands, asked: f64) -> Result<Option<f64>, Stop> {
        if !self.holds(self.plant, &Demands { decay: None, ..*demands }, 0.0)? {
            return Ok(None);
        }
        let holds = |alpha, done| self.holds(self.plant, &Demands { decay: Some(alpha), ..*demands }, done);
        let found = between(0.0, asked, holds)?;
        Ok((found > 0.0).then_some(found))
    }

    /// The largest Lipschitz constant; `None` when even the linear part is infeasible.
    fn constant(&self, demands: &Demands) -> Result<Option<f64>, Stop> {
        let asked = self.plant.lambda;
        let holds = |constant, done| self.holds(&self.plant.with_constant(constant), demands, done);
        if !holds(LEAST_PART * asked, 0.0)? {
            return Ok(None);
        }
        between(LEAST_PART * asked, asked, holds).map(Some)
    }

    /// The smallest gain bound; `None` when no gain helps.
    fn gain(&self, demands: &Demands, asked: f64) -> Result<Option<f64>, Stop> {
        let largest = asked.log10() + DECADES;
        let holds = |log: f64, done| {
            self.holds(self.plant, &Demands { gain: Some(10.0_f64.powf(log)), ..*demands }, done)
        };
        if !holds(largest, 0.0)? {
            return Ok(None);
        }
        Ok(Some(10.0_f64.powf(between(largest, asked.log10(), holds)?)))
    }
}

/// Bisection between a value that holds and one that does not; `holds` hears how much of it is done.
fn between(good: f64, bad: f64, holds: impl Fn(f64, f32) -> Result<bool, Stop>) -> Result<f64, Stop> {
    let (mut good, mut bad) = (good, bad);
    for step in 0..STEPS {
        let middle = 0.5 * (good + bad);
        if holds(middle, f32::from(step) / f32::from(STEPS))? {
            good = middle;
        } else {
            bad = middle;
        }
    }
    Ok(good)
}
