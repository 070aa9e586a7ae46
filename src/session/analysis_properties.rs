//! Properties of a plant as one system, with their evidence in words.

use super::analysis::Property;
use crate::numerics::Tolerance;
use crate::observer::Verdict;
use crate::system::properties::{
    impulse_observability, index, r_detectability, r_observability, rank_e, rank_e_c, regularity,
};
use crate::system::{DescriptorSystem, TimeDomain};

/// All properties, the sizes first.
pub(super) fn properties(system: &DescriptorSystem, tolerance: &Tolerance) -> Vec<Property> {
    let mut result = vec![sizes(system)];
    let mut add = |name: &str, found: Result<(String, String, Option<Verdict>), String>| {
        let (value, detail, verdict) = found
            .unwrap_or_else(|error| ("could not be decided".to_owned(), error, Some(Verdict::Undecided)));
        result.push(Property { name: name.to_owned(), value, detail, verdict });
    };
    let question = |holds: bool, fragile: bool| Some(Verdict::of(holds, fragile));
    add(
        "Regular",
        text(regularity(system, tolerance)).map(|found| {
            let structure = &found.structure;
            let detail = format!(
                "normal rank {} of the {} x {} pencil",
                structure.normal_rank, structure.rows, structure.columns
            );
            (yes_no(found.holds()), detail, question(found.holds(), found.fragile()))
        }),
    );
    add(
        "Index",
        text(index(system, tolerance)).map(|found| match found.index {
            Some(index) => (index.to_string(), "largest infinite elementary divisor".to_owned(), None),
            None => ("none".to_owned(), "the pencil is singular".to_owned(), None),
        }),
    );
    add(
        "rank E",
        text(rank_e(system, tolerance)).map(|found| {
            let detail = format!("smallest counted singular value {:.3e}", found.smallest_counted());
            (format!("{} of {}", found.rank, system.n_states()), detail, None)
        }),
    );
    add(
        "rank [E; C] = n",
        text(rank_e_c(system, tolerance)).map(|found| {
            (
                format!("{} of {}", found.decision.rank, found.needed),
                "observable at infinity".to_owned(),
                question(found.holds(), found.fragile()),
            )
        }),
    );
    add(
        "Impulse observable",
        text(impulse_observability(system, tolerance)).map(|found| {
            let detail = format!("rank {} of {} needed", found.printed.decision.rank, found.printed.needed);
            (yes_no(found.holds()), detail, question(found.holds(), found.fragile()))
        }),
    );
    for (name, found) in [
        ("R-observable", r_observability(system, tolerance)),
        ("R-detectable", r_detectability(system, tolerance)),
    ] {
        add(
            name,
            text(found).map(|found| {
                let points: Vec<String> =
                    found.modes.iter().map(|mode| crate::observer::show(mode.s)).collect();
                let detail = match (&found.free_direction, points.is_empty()) {
                    (Some(_), _) => "rank is below n for every s".to_owned(),
                    (None, true) => "no unobservable finite mode".to_owned(),
                    (None, false) => format!("unobservable at s = {}", points.join(", ")),
                };
                (yes_no(found.holds()), detail, question(found.holds(), found.fragile()))
            }),
        );
    }
    result
}

fn text<T, E: std::fmt::Display>(found: Result<T, E>) -> Result<T, String> {
    found.map_err(|error| error.to_string())
}

fn yes_no(holds: bool) -> String {
    if holds { "yes" } else { "no" }.to_owned()
}

fn sizes(system: &DescriptorSystem) -> Property {
    let time = match system.time {
        TimeDomain::Continuous => "continuous time",
        TimeDomain::Discrete => "discrete time",
    };
    Property {
        name: "Size".to_owned(),
        value: format!("{} states", system.n_states()),
        detail: format!(
            "{} equations, {} known inputs, {} outputs, {} unknown inputs, {time}",
            system.n_equations(),
            system.n_inputs(),
            system.n_outputs(),
            system.n_unknown_inputs()
        ),
        verdict: None,
    }
}
