//! Networks as JSON: their structure, their hierarchical observers, their motion.

use serde_json::{Map, Value, json};

use super::condition::rank;
use super::{complexes, design, number};
use crate::numerics::{Placement, Tolerance};
use crate::observer::hierarchical::{HierarchicalObserver, Hierarchy};
use crate::paper::{Motion, Quantity};
use crate::system::Network;

/// Sizes of a network; subsystems are numbered from one.
pub(super) fn sizes(network: &Network) -> Value {
    json!({
        "subsystems": network.n_subsystems(),
        "states_of_each": network.a.nrows(),
        "global_outputs": network.Psi.nrows() * network.c_G.nrows(),
        "local_outputs_of_each": network.c_L.nrows(),
        "local": from_one(network.local.iter().copied()),
    })
}

/// What decides about the hierarchical observer: `nu`, `mu` and the order of the whole.
pub(super) fn properties(network: &Network, tolerance: &Tolerance) -> Vec<Value> {
    match Hierarchy::of(network, tolerance) {
        Ok(found) => vec![
            json!({
                "id": "nu", "name": "nu = rank Gamma", "value": found.N.ncols(),
                "evidence": [rank("Gamma", &found.nu, found.N.ncols())],
            }),
            json!({
                "id": "mu", "name": "mu = rank O_n(a_I, b_I c_I)", "value": found.M.ncols(),
                "evidence": [rank("O_n(a_I, b_I c_I)", &found.mu, found.M.ncols())],
            }),
            json!({ "id": "order-of-the-whole", "name": "order of the whole, nu mu", "value": found.order() }),
        ],
        Err(error) => vec![json!({
            "id": "order-of-the-whole", "name": "order of the whole, nu mu", "verdict": "undecided",
            "error": error.to_string(),
        })],
    }
}

/// The global and the local observers of a design.
pub(super) fn observers(observer: &HierarchicalObserver) -> Value {
    let HierarchicalObserver { hierarchy, global, .. } = observer;
    let n = hierarchy.M.nrows();
    let plugged = |k: &usize| observer.local(k / n).is_some();
    let also: Vec<usize> = observer.estimated_states().into_iter().filter(|k| !plugged(k)).collect();
    let locals = observer.distinct_locals();
    let local = locals.iter().map(|(local, users)| {
        let mut value = poles(&local.placement);
        value["subsystems"] = from_one(users.iter().copied());
        value
    });
    json!({
        "nu": hierarchy.N.ncols(),
        "mu": hierarchy.M.ncols(),
        "order_of_the_whole": hierarchy.order(),
        "global": poles(&global.placement),
        "local": local.collect::<Value>(),
        "plugged": from_one(observer.locals().map(|(i, _)| i)),
        "other_states_determined_by_the_whole": from_one(also.into_iter()),
    })
}

/// Requested, fixed and achieved poles with what is known of the gain.
fn poles(placement: &Placement) -> Value {
    json!({
        "requested": complexes(&placement.requested),
        "fixed_modes": complexes(&placement.fixed_modes),
        "placement": design::placement(placement),
    })
}

/// Adds the motion of a network: the whole, and each subsystem that was simulated.
///
/// Rows of `x_hat` are `null` for states that are not estimated.
pub(super) fn put_motion(
    map: &mut Map<String, Value>,
    network: &Network,
    observer: Option<&HierarchicalObserver>,
    motion: &Motion,
) {
    let global = network.Psi.nrows() * network.c_G.nrows();
    let (n, q) = (network.a.nrows(), network.c_L.nrows());
    let rows = |quantity, first: usize, count: usize| -> Value {
        (first..first + count).map(|k| row(motion, quantity, k)).collect()
    };
    let subsystem = |i: usize| {
        if motion.samples(Quantity::State, n * i).is_empty() {
            return None;
        }
        let place = network.local.iter().position(|other| *other == i);
        Some(json!({
            "subsystem": i + 1,
            "local_observer": observer.is_some_and(|observer| observer.local(i).is_some()),
            "x": rows(Quantity::State, n * i, n),
            "x_hat": rows(Quantity::Estimate, n * i, n),
            "y": place.map_or(Value::Array(Vec::new()), |place| rows(Quantity::Output, global + q * place, q)),
        }))
    };
    let order = motion.order_of_whole();
    map.insert("notes".to_owned(), json!(motion.notes()));
    map.insert("t".to_owned(), super::numbers(motion.t()));
    map.insert("y_global".to_owned(), rows(Quantity::Output, 0, global));
    map.insert("z".to_owned(), rows(Quantity::Whole, 0, order));
    map.insert("z_hat".to_owned(), rows(Quantity::WholeEstimate, 0, order));
    map.insert("subsystems".to_owned(), (0..network.n_subsystems()).filter_map(subsystem).collect());
}

fn row(motion: &Motion, quantity: Quantity, index: usize) -> Value {
    let points = motion.samples(quantity, index);
    if points.is_empty() && !motion.t().is_empty() {
        return Value::Null;
    }
    points.iter().map(|[_, value]| number(*value)).collect()
}

/// Numbers as people count.
fn from_one(numbers: impl Iterator<Item = usize>) -> Value {
    numbers.map(|k| json!(k + 1)).collect()
}
