//! `check`, `design` and `simulate`.

use super::load::{Problem, load};
use super::{Answer, BAD_INPUT, DONE, Files, Format, REFUSED, Refusal, Source};
use crate::document::report::{check_report, design_report, trajectory_report};
use crate::document::trajectory_to_csv;
use crate::numerics::Watch;
use crate::observer::{Assessment, Design, DesignError, assess, conditions};
use crate::simulation::Trajectory;

/// Properties and conditions.
pub(super) fn check(source: &Source, files: &dyn Files) -> Result<Answer, Refusal> {
    let Problem { document, model } = load(source, files)?;
    let conditions = conditions(&model, &document.design, &document.tolerance)
        .map_err(|error| Refusal::refused(format!("the conditions cannot be decided: {error}")))?;
    let mut remarks: Vec<String> = document.design.method.missing(&model).into_iter().collect();
    for condition in conditions.iter().filter(|c| c.needed && !c.verdict.holds()) {
        remarks.push(format!("condition {} does not hold: {}", condition.label, condition.summary));
    }
    let code = if remarks.is_empty() { DONE } else { REFUSED };
    Ok(Answer { text: check_report(&document, &model, &conditions), remarks, code })
}

/// Conditions, design and verification.
pub(super) fn design(source: &Source, files: &dyn Files) -> Result<Answer, Refusal> {
    let problem = load(source, files)?;
    let assessment = assessed(&problem)?;
    let (remarks, code) = match &assessment.outcome {
        Ok(design) => (unverified(design), if assessment.verified() { DONE } else { REFUSED }),
        Err(error) => (vec![error.to_string()], code_of(error)),
    };
    Ok(Answer { text: design_report(&problem.document, &problem.model.system, &assessment), remarks, code })
}

/// The trajectory of plant and observer.
pub(super) fn simulate(source: &Source, format: Format, files: &dyn Files) -> Result<Answer, Refusal> {
    let problem = load(source, files)?;
    let (design, trajectory) = simulated(&problem)?;
    let Problem { document, model } = &problem;
    let text = match format {
        Format::Csv => trajectory_to_csv(&trajectory),
        Format::Json => trajectory_report(document, &model.system, &trajectory),
    };
    let mut remarks = unverified(&design);
    let code = if remarks.is_empty() { DONE } else { REFUSED };
    remarks.extend(trajectory.note.into_iter().chain(trajectory.remarks));
    Ok(Answer { text, remarks, code })
}

/// Conditions and design of the document's choice.
fn assessed(problem: &Problem) -> Result<Assessment, Refusal> {
    let Problem { document, model } = problem;
    assess(model, &document.design, &document.tolerance, &Watch::none())
        .map_err(|error| Refusal::refused(format!("the conditions cannot be decided: {error}")))
}

/// The document's design and its trajectory in the document's scenario.
pub(super) fn simulated(problem: &Problem) -> Result<(Design, Trajectory), Refusal> {
    let Problem { document, model } = problem;
    let system = &model.system;
    let design = assessed(problem)?.outcome.map_err(|error| Refusal {
        message: format!("there is no observer to simulate: {error}"),
        code: code_of(&error),
    })?;
    let trajectory = document
        .scenario(system)
        .run(model, &[(&design).into()], &document.tolerance, &Watch::none())
        .map_err(|error| Refusal::refused(format!("the simulation was refused: {error}")))?;
    Ok((design, trajectory))
}

fn code_of(error: &DesignError) -> u8 {
    if error.is_bad_input() { BAD_INPUT } else { REFUSED }
}

/// The checks that a design failed, as sentences.
fn unverified(design: &Design) -> Vec<String> {
    let failed = design.verification.failures().map(|check| {
        format!(
            "the design is not verified: {} ({}): {:.2e}, at most {:.2e} is allowed",
            check.name, check.statement, check.value, check.limit
        )
    });
    failed.collect()
}
