//! Existence conditions of paper 002, with their evidence.

use nalgebra::{DMatrix, DVector};

use super::parameterisation::Parameterisation;
use super::plant::Plant;
use super::rows::Rows;
use crate::numerics::{
    Complex64, NumericsError, PbhMode, StabilityRegion, Tolerance, observable_quotient, rank, stack,
    subspaces,
};
use crate::observer::{Condition, DesignChoice, Evidence, PointEvidence, Verdict, Witness, show};
use crate::system::properties::PropertyError;
use crate::system::{Model, SampleRegion, SampledConstant};

const PAPER: &str = "Zerrougui et al. 2011";

/// Existence conditions of the H-infinity observer; what only the inequalities can decide is not among them.
///
/// # Errors
/// When the matrices do not fit or a decomposition fails its check.
///
/// # Source
/// Paper 002, Assumption 1, (46)-(51).
pub fn conditions(
    model: &Model,
    choice: &DesignChoice,
    tolerance: &Tolerance,
) -> Result<Vec<Condition>, PropertyError> {
    let plant = Plant::new(model, tolerance)?;
    let mut result = vec![assumption_1(&plant, tolerance)?];
    let rows = Rows::of(&plant, choice, tolerance)?;
    result.push(rows_condition(&plant, &rows));
    let usable = result.iter().all(|condition| condition.verdict.holds());
    let examined = choice.lmi.given.is_some();
    let family = match rows {
        Ok(rows) if usable => Some(Parameterisation::new(&plant, &rows.R, tolerance)?),
        Ok(_) | Err(_) => None,
    };
    result.push(match &family {
        Some(family) => stabilisability(family, choice.lmi.decay, tolerance)?,
        None => Condition {
            summary: "it is asked of the observers of R, which the conditions above do not give".to_owned(),
            ..stabilisability_asked(None)
        },
    });
    if let Some(last) = result.last_mut() {
        last.needed = !examined;
    }
    result.extend(lipschitz(model, tolerance)?);
    Ok(result)
}

fn condition(id: &str, label: &str, name: &str, formula: &str) -> Condition {
    Condition::asked((format!("002-{id}"), label), name, formula, format!("{PAPER}, {label}"))
}

/// Assumption 1: differential equations, algebraic equations and outputs determine the state.
fn assumption_1(plant: &Plant, tolerance: &Tolerance) -> Result<Condition, NumericsError> {
    let n = plant.n();
    let of_e = rank(&plant.system.E, 0.0, tolerance)?;
    let found = subspaces(&plant.Theta(), 0.0, tolerance)?;
    let holds = found.rank.rank == n;
    let mut result =
        condition("assumption-1", "Assumption 1", "impulse observability", "rank [E; Phi A; C] = n");
    result.verdict = Verdict::of(holds, found.rank.fragile || of_e.fragile);
    result.summary = format!(
        "rank {} of {n} needed, smallest singular value {:.3e}; {} algebraic equations",
        found.rank.rank,
        found.rank.smallest(),
        plant.Phi.nrows()
    );
    result.evidence = vec![
        Evidence::rank("[E; Phi A; C]", found.rank.clone(), n),
        Evidence::rank("E", of_e.clone(), of_e.rank),
    ];
    if !holds {
        let null: Vec<f64> = found.null.column(0).iter().copied().collect();
        result.witness = Some(state_witness(plant, &null));
        result.remedies = sensors(plant, tolerance)?;
    }
    Ok(result)
}

/// A direction of states, scaled so that its largest entry is 1.
fn state_witness(plant: &Plant, direction: &[f64]) -> Witness {
    let largest = direction.iter().fold(0.0, |most: f64, x| if x.abs() > most.abs() { *x } else { most });
    Witness {
        s: None,
        direction: direction.iter().map(|x| Complex64::from(x / largest)).collect(),
        coordinates: (1..=plant.n()).map(|i| format!("x{i}")).collect(),
    }
}

/// States whose measurement alone would restore Assumption 1, as sentences.
fn sensors(plant: &Plant, tolerance: &Tolerance) -> Result<Vec<String>, NumericsError> {
    const LARGEST: usize = 16;
    let n = plant.n();
    if n > LARGEST {
        return Ok(Vec::new());
    }
    let mut remedies = Vec::new();
    for i in 0..n {
        let sensor = DMatrix::from_fn(1, n, |_, j| if i == j { 1.0 } else { 0.0 });
        if rank(&stack(&[&plant.Theta(), &sensor]), 0.0, tolerance)?.rank == n {
            remedies.push(format!("measure x{0}: add the row with a 1 in column {0} to C", i + 1));
        }
    }
    if remedies.is_empty() {
        remedies.push("no single additional sensor of one state restores it".to_owned());
    }
    Ok(remedies)
}

/// The rows of `R` are independent and complete what is known.
fn rows_condition(plant: &Plant, rows: &Result<Rows, String>) -> Condition {
    let n = plant.n();
    let mut result = condition("R", "(46)", "rows of R", "rank R = q and rank [R; Phi A; C] = n");
    result.source = format!("{PAPER}, before (46)");
    let rows = match rows {
        Ok(rows) => rows,
        Err(why) => {
            result.verdict = Verdict::Fails;
            result.summary.clone_from(why);
            return result;
        }
    };
    let q = rows.R.nrows();
    let refusal = rows.refusal(n);
    let origin = if rows.given { "given" } else { "chosen by the order" };
    result.verdict = Verdict::of(refusal.is_none(), rows.own.fragile || rows.sigma.fragile);
    result.summary = refusal.unwrap_or_else(|| {
        format!(
            "R has {q} independent rows ({origin}), and rank [R; Phi A; C] = {n}: the observer has order {q}"
        )
    });
    result.evidence = vec![
        Evidence::rank("R", rows.own.clone(), q),
        Evidence::rank("[R; Phi A; C]", rows.sigma.clone(), n),
    ];
    if result.verdict == Verdict::Fails {
        result.remedies.push("leave R to the program, or take R = I (full order)".to_owned());
    }
    result
}

fn stabilisability_asked(decay: Option<f64>) -> Condition {
    let formula = match decay {
        Some(alpha) => format!("rank [sI-Lambda_N; L_N] = q for all Re s >= {}", -alpha),
        None => "rank [sI-Lambda_N; L_N] = q for all Re s >= 0".to_owned(),
    };
    let mut result = condition("fixed-modes", "(47)", "modes that no gain can move", &formula);
    result.source = format!("{PAPER}, (47): N = Lambda_N - Z L_N");
    result
}

/// The pair whose modes the free matrix moves: fixed modes, and the fastest decay that they allow.
fn stabilisability(
    family: &Parameterisation,
    decay: Option<f64>,
    tolerance: &Tolerance,
) -> Result<Condition, NumericsError> {
    let region = StabilityRegion::LeftHalfPlane;
    let split = observable_quotient(&family.Lambda_N, &family.L_N, tolerance)?;
    let margin = region.margin(family.Lambda_N.norm().max(1.0), tolerance);
    let asked = decay.unwrap_or(0.0);
    let too_slow = |z: Complex64| z.re >= -asked - margin;
    let hidden: Vec<&PbhMode> = split.modes.iter().filter(|mode| mode.unobservable).collect();
    let worst = hidden.iter().max_by(|a, b| a.value.re.total_cmp(&b.value.re));
    let near = |mode: &PbhMode| {
        let ratio = mode.distance / tolerance.mode;
        ratio > 1.0 && ratio < tolerance.gap && too_slow(mode.value)
    };
    let mut result = stabilisability_asked(decay);
    let fails = worst.filter(|mode| too_slow(mode.value));
    result.verdict = Verdict::of(fails.is_none(), split.modes.iter().any(near));
    result.summary = match (fails, worst) {
        (Some(mode), _) if mode.value.re >= -margin => {
            result.remedies.push("choose another R, or a higher order: the full order has R = I".to_owned());
            format!("the mode {} is fixed by R and not stable", show(mode.value))
        }
        (Some(mode), _) => {
            let fastest = show(Complex64::from(-mode.value.re));
            result.remedies.push(format!("ask for a decay below {fastest}, or choose another R"));
            format!(
                "the mode {} is fixed by R: the decay {asked} is asked, less than {fastest} is possible",
                show(mode.value)
            )
        }
        (None, Some(mode)) => format!(
            "{} fixed modes, all of them fast enough; the fastest decay that they allow is {}",
            split.fixed_modes.len(),
            show(Complex64::from(-mode.value.re))
        ),
        (None, None) => format!("no fixed modes: all {} modes can be moved", family.order()),
    };
    result.witness = fails.map(|mode| Witness {
        s: Some(mode.value),
        direction: mode.direction.clone(),
        coordinates: (1..=family.order()).map(|i| format!("z{i}")).collect(),
    });
    let points = split.modes.iter().map(|mode| PointEvidence {
        s: mode.value,
        multiplicity: mode.multiplicity,
        distance: mode.distance,
        loses_rank: mode.unobservable,
        stable: region.contains(mode.value, margin),
    });
    result.evidence.push(Evidence::Points { of: "(Lambda_N, L_N)".to_owned(), points: points.collect() });
    Ok(result)
}

/// Half sides of the boxes in which the nonlinearity is sampled, and the last instant.
const REACHES: [f64; 3] = [1.0, 10.0, 100.0];
/// States in each box.
const SAMPLES: usize = 48;
/// Constants beyond this are of no use to a design.
const STEEPEST: f64 = 1e6;
/// Seed of the samples, so that a verdict does not change from one look to the next.
const SEED: u64 = 2;

/// Whether samples of the nonlinearity keep its Lipschitz constant; no design is refused for it.
fn lipschitz(model: &Model, tolerance: &Tolerance) -> Result<Option<Condition>, NumericsError> {
    let Some(term) = model.lipschitz.as_ref().filter(|term| !term.f.is_empty()) else { return Ok(None) };
    let (mut steepest, mut undefined): (Option<SampledConstant>, Option<String>) = (None, None);
    for reach in REACHES {
        let corner = DVector::from_element(model.system.n_states(), reach);
        let region = SampleRegion::Box { lower: -&corner, upper: corner, time: (0.0, reach) };
        let found = term.sampled_constant(&region, SAMPLES, SEED, tolerance)?;
        if undefined.is_none() && found.undefined.is_some() {
            undefined = Some(found.statement());
        }
        if steepest.as_ref().is_none_or(|known| found.largest > known.largest) {
            steepest = Some(SampledConstant { undefined: None, ..found });
        }
    }
    let Some(found) = steepest else { return Ok(None) };
    let mut result =
        condition("lipschitz", "(3)", "Lipschitz constant", "|f(x1) - f(x2)| <= lambda |F_L (x1 - x2)|");
    result.source = format!("{PAPER}, section 2");
    result.needed = false;
    result.summary = format!("{} (samples can refute a constant, not prove it)", found.statement());
    result.verdict = Verdict::of(!found.exceeded, false);
    if let Some(where_not) = undefined {
        result.summary = format!("{where_not}; elsewhere {}", result.summary);
        if result.verdict.holds() {
            result.verdict = Verdict::Undecided;
        }
    }
    if found.largest.is_infinite() {
        result.remedies.push("add the states that f depends on to F_L".to_owned());
    } else if found.largest > STEEPEST {
        result.remedies.push(
            "no usable constant covers the states that were sampled: the guarantee can only hold in a smaller region"
                .to_owned(),
        );
    } else if found.exceeded {
        result.remedies.push(format!(
            "use a constant of at least {:.4}, or keep in mind that the guarantee holds only where f is less steep",
            found.largest
        ));
    }
    Ok(Some(result))
}
