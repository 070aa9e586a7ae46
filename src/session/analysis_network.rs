//! What follows from a network: its structure and what it shows as a whole; of a large one without ever expanding it.

use super::analysis::{Analysis, Property, Simulation};
use crate::document::Document;
use crate::numerics::{Complex64, RankDecision, Tolerance, Watch, eigenvalues, null_space};
use crate::observer::hierarchical::{Hierarchy, HierarchyError, conditions_for};
use crate::observer::{Assessment, Condition, Method, Verdict, assess_hierarchy, network_lights};
use crate::paper::{Motion, Quantity, standard_network};
use crate::simulation::simulate_network;
use crate::system::Network;

/// Computes everything that follows from a network that is too large to be written as one system.
pub(super) fn analyse(document: &Document, network: &Network, watch: &Watch) -> Option<Analysis> {
    let tolerance = &document.tolerance;
    if !watch.go_on(0.0, "properties") {
        return None;
    }
    let mut properties = vec![sizes(network)];
    let hierarchy = Hierarchy::of(network, tolerance);
    properties.extend(structure(network, &hierarchy));
    let known = hierarchy.as_ref().ok();
    let plant_eigenvalues = known.and_then(|known| modes(network, known, tolerance)).unwrap_or_default();
    if !watch.go_on(0.2, "conditions and design") {
        return None;
    }
    let assessment =
        assess_hierarchy(network, hierarchy, &document.design, tolerance).map_err(|error| error.to_string());
    let chosen = document.design.method == Method::Hierarchical;
    let known = assessment.as_ref().ok().filter(|_| chosen).map(|found| found.conditions.clone());
    let found = match known {
        Some(found) => Ok(found),
        None => conditions_for(network, &document.design, tolerance).map_err(|error| error.to_string()),
    };
    properties.extend(found.iter().flatten().filter_map(pair));
    let outcome = assessment.as_ref().ok().filter(|_| chosen).map(|found| &found.outcome);
    let methods = network_lights(network, found.as_deref().map_err(String::as_str), outcome);
    if !watch.go_on(0.6, "simulation") {
        return None;
    }
    let simulation = simulation(document, network, assessment.as_ref());
    Some(Analysis { properties, plant_eigenvalues, methods, assessment, simulation, bode: None, free: None })
}

fn property(name: &str, value: String, detail: String) -> Property {
    Property { name: name.to_owned(), value, detail, verdict: None }
}

fn sizes(network: &Network) -> Property {
    let (n, size) = (network.a.nrows(), network.n_subsystems());
    let detail = format!("{size} subsystems of {n} states, never written as one system, continuous time");
    property("Size", format!("{} states", n * size), detail)
}

/// The sizes that decide about the hierarchical observer.
pub(super) fn structure(network: &Network, hierarchy: &Result<Hierarchy, HierarchyError>) -> Vec<Property> {
    let (n, size) = (network.a.nrows(), network.n_subsystems());
    let global = network.Psi.nrows() * network.c_G.nrows();
    let outputs = format!(
        "{global} global outputs, {} local outputs at each of {} subsystems",
        network.c_L.nrows(),
        network.local.len()
    );
    let mut result = vec![property("Network", format!("N = {size}, n = {n}"), outputs)];
    match hierarchy {
        Ok(hierarchy) => {
            let (nu, mu) = (hierarchy.N.ncols(), hierarchy.M.ncols());
            let rank = |value: usize, most: usize, decision: &RankDecision| {
                let detail = format!("smallest counted singular value {:.3e}", decision.smallest_counted());
                (format!("{value} of {most}"), detail)
            };
            let (value, detail) = rank(nu, size, &hierarchy.nu);
            result.push(property("nu = rank Gamma", value, detail));
            let (value, detail) = rank(mu, n, &hierarchy.mu);
            result.push(property("mu = rank O_n(a_I, b_I c_I)", value, detail));
            let detail = format!("nu mu = {nu} * {mu} states of z = sigma_z x, instead of {}", n * size);
            result.push(property("Order of the whole", hierarchy.order().to_string(), detail));
        }
        Err(error) => result.push(Property {
            verdict: Some(Verdict::Undecided),
            ..property("Order of the whole", "could not be decided".to_owned(), error.to_string())
        }),
    }
    result
}

/// The pairs that have to be detectable, as properties.
fn pair(condition: &Condition) -> Option<Property> {
    let name = match condition.id.as_str() {
        "003-P1-global" => "(alpha_z, gamma_z) detectable",
        "003-P1-local" => "(a_I, c_L) detectable",
        _ => return None,
    };
    let value = match condition.verdict {
        Verdict::Holds | Verdict::Fragile => "yes",
        Verdict::Fails => "no",
        Verdict::Undecided => "could not be decided",
    };
    Some(Property {
        verdict: Some(condition.verdict),
        ..property(name, value.to_owned(), condition.summary.clone())
    })
}

/// The modes of a network, each as often as it differs: those of the whole, and those of a subsystem alone, which
/// `N - nu` subsystems share.
///
/// ```text
/// eig A = eig alpha_z, N - nu times eig a_z, N times the rest of eig a_I
/// ```
fn modes(network: &Network, hierarchy: &Hierarchy, tolerance: &Tolerance) -> Option<Vec<Complex64>> {
    let mut modes = eigenvalues(&hierarchy.alpha_z()).ok()?;
    if hierarchy.N.ncols() < network.n_subsystems() {
        modes.extend(eigenvalues(&network.a).ok()?);
    } else {
        // every subsystem takes part in the whole: what is left of each is the part that M does not show
        let hidden = null_space(&hierarchy.M.transpose(), 0.0, tolerance).ok()?;
        modes.extend(eigenvalues(&hidden.tr_mul(&(&network.a * &hidden))).ok()?);
    }
    Some(modes)
}

fn simulation(
    document: &Document,
    network: &Network,
    assessment: Result<&Assessment, &String>,
) -> Result<Simulation, String> {
    let assessment = assessment.map_err(Clone::clone)?;
    let design =
        assessment.outcome.as_ref().map_err(|error| format!("there is no observer to simulate: {error}"))?;
    let observer = design.hierarchical.as_deref().ok_or("the design is not one for a network")?;
    let shown = standard_network::Shown::of(network, &observer.estimated_states());
    let (x0, span) = (document.initial_state(), document.span());
    let found =
        simulate_network(network, observer, &x0, span, &shown.all()).map_err(|error| error.to_string())?;
    let motion = Motion::of_network(found, network, observer);
    let mut notes = motion.notes().to_vec();
    if document.scenario.noise.iter().any(|signal| !signal.is_zero()) {
        notes.push("measurement noise is not simulated in a network of this size".to_owned());
    }
    Ok(views(network, &motion, notes))
}

/// The standard views of a network's motion.
pub(super) fn views(network: &Network, motion: &Motion, notes: Vec<String>) -> Simulation {
    let shown = standard_network::Shown::of(network, motion.estimated());
    let half = motion.t().last().copied().unwrap_or(0.0) / 2.0;
    let error = |k: &usize| motion.rms(Quantity::Error, *k, half).map(|rms| (*k, rms));
    let (estimated, rms) = motion.estimated().iter().filter_map(error).unzip();
    let whole = (0..motion.order_of_whole()).filter_map(|k| motion.rms(Quantity::WholeError, k, half));
    let whole: Vec<f64> = whole.collect();
    Simulation {
        estimated,
        rms,
        rms_whole: (!whole.is_empty()).then(|| whole.iter().map(|rms| rms * rms).sum::<f64>().sqrt()),
        rms_unknown: Vec::new(),
        states: standard_network::states(network, motion, &shown),
        errors: standard_network::errors(network, motion, &shown),
        unknown_input: standard_network::outputs(network, motion, &shown),
        notes,
    }
}
