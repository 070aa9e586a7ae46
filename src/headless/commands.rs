//! `check`, `design` and `simulate`.

use super::load::{Problem, load};
use super::{Answer, BAD_INPUT, DONE, Files, Format, REFUSED, Refusal, Source, network};
use crate::document::report::{check_report, trajectory_report};
use crate::document::{Document, Subject, trajectory_to_csv};
use crate::numerics::Watch;
use crate::observer::{Assessment, Design, DesignError, Known, assess, conditions, lights};
use crate::paper::Motion;
use crate::simulation::Trajectory;
use crate::system::Model;

/// Properties, the lights of all methods, and conditions.
pub(super) fn check(source: &Source, files: &dyn Files) -> Result<Answer, Refusal> {
    let Problem { document, subject } = load(source, files)?;
    let model = match subject {
        Subject::Model(model) => model,
        Subject::Network(network) => return network::check(&document, &network),
    };
    let conditions = conditions(&model, &document.design, &document.tolerance)
        .map_err(|error| Refusal::refused(format!("the conditions cannot be decided: {error}")))?;
    let mut remarks: Vec<String> = document.design.method.missing(&model).into_iter().collect();
    for condition in conditions.iter().filter(|c| c.needed && !c.verdict.holds()) {
        remarks.push(format!("condition {} does not hold: {}", condition.label, condition.summary));
    }
    let code = if remarks.is_empty() { DONE } else { REFUSED };
    let known = Known { conditions: &conditions, outcome: None };
    let lights = lights(&model, &document.design, &document.tolerance, Some(known));
    Ok(Answer { text: check_report(&document, &model, &lights, &conditions), remarks, code })
}

/// Conditions, design and verification.
pub(super) fn design(source: &Source, files: &dyn Files) -> Result<Answer, Refusal> {
    let Problem { document, subject } = load(source, files)?;
    match subject {
        Subject::Model(model) => Ok(network::designed(&document, &assessed(&document, &model)?)),
        Subject::Network(network) => network::design(&document, &network),
    }
}

/// The trajectory of plant and observer.
pub(super) fn simulate(source: &Source, format: Format, files: &dyn Files) -> Result<Answer, Refusal> {
    let Problem { document, subject } = load(source, files)?;
    let model = match subject {
        Subject::Model(model) => model,
        Subject::Network(network) => return network::simulate(&document, &network, format),
    };
    let (design, trajectory) = simulated(&document, &model)?;
    if let Some(network) = &model.network {
        let motion = Motion::of_system(trajectory, &design);
        return Ok(network::written(&document, network, (&design, &motion), format));
    }
    let text = match format {
        Format::Csv => trajectory_to_csv(&trajectory),
        Format::Json => trajectory_report(&document, &trajectory),
    };
    let mut remarks = unverified(&design);
    // one instant alone is no motion
    let code = if remarks.is_empty() && trajectory.t.len() > 1 { DONE } else { REFUSED };
    remarks.extend(trajectory.note.into_iter().chain(trajectory.remarks));
    Ok(Answer { text, remarks, code })
}

/// Conditions and design of the document's choice.
fn assessed(document: &Document, model: &Model) -> Result<Assessment, Refusal> {
    assess(model, &document.design, &document.tolerance, &Watch::none())
        .map_err(|error| Refusal::refused(format!("the conditions cannot be decided: {error}")))
}

/// The document's design and its trajectory in the document's scenario.
pub(super) fn simulated(document: &Document, model: &Model) -> Result<(Design, Trajectory), Refusal> {
    let design = assessed(document, model)?.outcome.map_err(|error| Refusal {
        message: format!("there is no observer to simulate: {error}"),
        code: code_of(&error),
    })?;
    let trajectory = document
        .scenario(&model.system)
        .run(model, &[(&design).into()], &document.tolerance, &Watch::none())
        .map_err(|error| Refusal::refused(format!("the simulation was refused: {error}")))?;
    Ok((design, trajectory))
}

pub(super) fn code_of(error: &DesignError) -> u8 {
    if error.is_bad_input() { BAD_INPUT } else { REFUSED }
}

/// The checks that a design failed, as sentences.
pub(super) fn unverified(design: &Design) -> Vec<String> {
    let failed = design.verification.failures().map(|check| {
        format!(
            "the design is not verified: {} ({}): {:.2e}, at most {:.2e} is allowed",
            check.name, check.statement, check.value, check.limit
        )
    });
    failed.collect()
}
