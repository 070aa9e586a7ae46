//! Networks on the command line: those that are never written as one system, and the motion of all.

use super::commands::{code_of, unverified};
use super::{Answer, DONE, Format, REFUSED, Refusal};
use crate::document::report::{design_report, network_check_report, network_motion_report};
use crate::document::{Document, Sizes, motion_to_csv};
use crate::observer::{Assessment, Design, Verdict, assess_network, hierarchical, network_lights};
use crate::paper::{FigureSpec, Motion, standard_network};
use crate::simulation::simulate_network;
use crate::system::Network;

/// Most states of subsystems that a trajectory of a large network holds.
const MOST_STATES: usize = 500;

/// Structure, the lights of all methods, and conditions.
pub(super) fn check(document: &Document, network: &Network) -> Result<Answer, Refusal> {
    let unsuitable = document.design.method.missing_for(network);
    let found = hierarchical::conditions_for(network, &document.design, &document.tolerance)
        .map_err(|error| error.to_string());
    let lights = network_lights(network, found.as_deref().map_err(String::as_str), None);
    let conditions = match unsuitable {
        Some(_) => Vec::new(),
        None => {
            found.map_err(|error| Refusal::refused(format!("the conditions cannot be decided: {error}")))?
        }
    };
    let mut remarks: Vec<String> = unsuitable.into_iter().collect();
    for condition in conditions.iter().filter(|c| c.needed && !c.verdict.holds()) {
        let what = if condition.verdict == Verdict::Fails { "does not hold" } else { "is not decided" };
        remarks.push(format!("condition {} {what}: {}", condition.label, condition.summary));
    }
    let code = if remarks.is_empty() { DONE } else { REFUSED };
    Ok(Answer { text: network_check_report(document, network, &lights, &conditions), remarks, code })
}

/// Conditions and design of the document's choice.
pub(super) fn assessed(document: &Document, network: &Network) -> Result<Assessment, Refusal> {
    assess_network(network, &document.design, &document.tolerance)
        .map_err(|error| Refusal::refused(format!("the conditions cannot be decided: {error}")))
}

/// Design and verification.
pub(super) fn design(document: &Document, network: &Network) -> Result<Answer, Refusal> {
    let assessment = assessed(document, network)?;
    Ok(designed(document, &assessment))
}

/// The answer of `design`, whatever the plant is.
pub(super) fn designed(document: &Document, assessment: &Assessment) -> Answer {
    let (remarks, code) = match &assessment.outcome {
        Ok(design) => {
            let mut remarks = unverified(design);
            let left_out = design.hierarchical.as_ref().map_or(&[][..], |observer| &observer.left_out);
            remarks.extend(left_out.iter().cloned());
            let complete = assessment.verified() && left_out.is_empty();
            (remarks, if complete { DONE } else { REFUSED })
        }
        Err(error) => (vec![error.to_string()], code_of(error)),
    };
    Answer { text: design_report(document, assessment), remarks, code }
}

/// The trajectory of the whole and of the subsystems that are estimated.
pub(super) fn simulate(document: &Document, network: &Network, format: Format) -> Result<Answer, Refusal> {
    let (design, motion, left_out) = simulated(document, network, (MOST_STATES, 0))?;
    let mut answer = written(document, network, (&design, &motion), format);
    answer.remarks.extend(left_out);
    Ok(answer)
}

/// The answer of `simulate` for the motion of a network.
pub(super) fn written(
    document: &Document,
    network: &Network,
    (design, motion): (&Design, &Motion),
    format: Format,
) -> Answer {
    let text = match format {
        Format::Csv => motion_to_csv(motion, &Sizes::of(&document.plant)),
        Format::Json => network_motion_report(document, network, design.hierarchical.as_deref(), motion),
    };
    let mut remarks = unverified(design);
    let code = if remarks.is_empty() && motion.t().len() > 1 { DONE } else { REFUSED };
    remarks.extend(motion.notes().iter().cloned());
    Answer { text, remarks, code }
}

/// The standard figures of a network that is never written as one system.
pub(super) fn standard_figures(document: &Document, network: &Network) -> Result<Vec<FigureSpec>, Refusal> {
    let (_, motion, _) = simulated(document, network, standard_network::Shown::LIMITS)?;
    Ok(figures(network, &motion))
}

/// States, errors and outputs of a network.
pub(super) fn figures(network: &Network, motion: &Motion) -> Vec<FigureSpec> {
    let shown = standard_network::Shown::of(network, motion.estimated());
    vec![
        standard_network::states(network, motion, &shown),
        standard_network::errors(network, motion, &shown),
        standard_network::outputs(network, motion, &shown),
    ]
}

/// Design and motion, and what is left out of it.
fn simulated(
    document: &Document,
    network: &Network,
    limits: (usize, usize),
) -> Result<(Design, Motion, Vec<String>), Refusal> {
    let design = assessed(document, network)?.outcome.map_err(|error| Refusal {
        message: format!("there is no observer to simulate: {error}"),
        code: code_of(&error),
    })?;
    let observer = design
        .hierarchical
        .as_deref()
        .ok_or_else(|| Refusal::refused("there is no observer of the network to simulate"))?;
    let shown = standard_network::Shown::at_most(network, &observer.estimated_states(), limits);
    let found = simulate_network(network, observer, &document.initial_state(), document.span(), &shown.all())
        .map_err(|error| Refusal::refused(format!("the simulation was refused: {error}")))?;
    let motion = Motion::of_network(found, network, observer);
    let mut left_out = shown.notes().to_vec();
    if document.scenario.noise.iter().any(|signal| !signal.is_zero()) {
        left_out.push("measurement noise is not simulated in a network of this size".to_owned());
    }
    Ok((design, motion, left_out))
}
