//! Writing a document: canonical order of keys, matrices row by row.

use serde_json::{Map, Value, json};

use super::entry::number;
use super::figures::figure_value;
use super::lmi::lmi_value;
use super::model::{
    DescriptorData, Document, FreeData, KeptDesign, LipschitzData, Matrix, PlantData, ScenarioData,
};
use super::network::network_value;
use super::pretty::pretty;
use super::{EntryMatrix, VERSION};
use crate::numerics::{Complex64, Tolerance};
use crate::observer::DesignChoice;
use crate::system::{Signal, Subsystem, TimeDomain};

/// Writes a document; reading the text gives the same document.
pub fn write_document(document: &Document) -> String {
    pretty(&document_value(document))
}

/// Writes a document on one line, for links.
pub fn write_document_compact(document: &Document) -> String {
    document_value(document).to_string()
}

fn document_value(document: &Document) -> Value {
    let Document { title, notes, paper, plant, design, scenario, tolerance, kept, figures } = document;
    let mut map = Map::new();
    let mut put = |key: &str, value: Value| map.insert(key.to_owned(), value);
    put("descry", json!(VERSION));
    for (key, text) in [("title", title), ("notes", notes), ("paper", paper)] {
        if !text.is_empty() {
            put(key, json!(text));
        }
    }
    put("system", plant_value(plant));
    put("design", design_value(design));
    put("scenario", scenario_value(scenario));
    if *tolerance != Tolerance::default() {
        put("tolerance", tolerance_value(tolerance));
    }
    if !kept.is_empty() {
        let value = |kept: &KeptDesign| json!({ "name": kept.name, "design": design_value(&kept.design) });
        put("compare", kept.iter().map(value).collect());
    }
    if !figures.is_empty() {
        put("figures", figures.iter().map(figure_value).collect());
    }
    Value::Object(map)
}

fn plant_value(plant: &PlantData) -> Value {
    match plant {
        PlantData::Descriptor(data) => descriptor_value(data),
        PlantData::Network(data) => json!({ "network": network_value(data) }),
    }
}

fn descriptor_value(data: &DescriptorData) -> Value {
    let mut map = Map::new();
    if data.time == TimeDomain::Discrete {
        map.insert("time".to_owned(), json!("discrete"));
    }
    for matrix in Matrix::ALL {
        let value = data.matrix(matrix);
        let all_zero = value.values().iter().all(|x| *x == 0.0);
        let left_out = value.shape().1 == 0 || value.shape().0 == 0 || (matrix == Matrix::F && all_zero);
        if !left_out {
            map.insert(matrix.letter().to_owned(), value.write());
        }
    }
    if !data.partition.is_empty() {
        map.insert("partition".to_owned(), data.partition.iter().map(subsystem_value).collect());
    }
    if let Some(lipschitz) = &data.lipschitz {
        map.insert("lipschitz".to_owned(), lipschitz_value(lipschitz));
    }
    Value::Object(map)
}

fn subsystem_value(subsystem: &Subsystem) -> Value {
    let Subsystem { name, states, equations, outputs } = subsystem;
    json!({ "name": name, "states": states, "equations": equations, "outputs": outputs })
}

fn lipschitz_value(data: &LipschitzData) -> Value {
    json!({ "G": data.G.write(), "F_L": data.F_L.write(), "f": data.f, "constant": number(data.constant) })
}

fn design_value(design: &DesignChoice) -> Value {
    let DesignChoice { method, order, poles, scale, seed, local_poles, plugged, lmi } = design;
    let mut value = json!({
        "method": method.key(), "order": order.key(), "poles": poles_value(poles), "scale": number(*scale), "seed": seed,
    });
    if !local_poles.is_empty() {
        value["local poles"] = poles_value(local_poles);
    }
    if let Some(plugged) = plugged {
        value["plugged"] = plugged_value(plugged);
    }
    if let Some(lmi) = lmi_value(lmi) {
        value["lmi"] = lmi;
    }
    value
}

/// Numbers of subsystems, from one.
pub(super) fn plugged_value(plugged: &[usize]) -> Value {
    plugged.iter().map(|i| json!(i + 1)).collect()
}

/// Poles as numbers or `[real, imaginary]`.
pub(super) fn poles_value(poles: &[Complex64]) -> Value {
    let pole = |z: &Complex64| if z.im == 0.0 { number(z.re) } else { json!([number(z.re), number(z.im)]) };
    poles.iter().map(pole).collect()
}

/// Signals as texts.
pub(super) fn signals_value(signals: &[Signal]) -> Value {
    signals.iter().map(|signal| json!(signal.text())).collect()
}

fn scenario_value(data: &ScenarioData) -> Value {
    let ScenarioData { horizon, samples, x0, x0_formula, u, d, noise, uncertainty, free } = data;
    let mut map = Map::new();
    map.insert("horizon".to_owned(), number(*horizon));
    map.insert("samples".to_owned(), json!(samples));
    if !x0.is_empty() {
        let row = EntryMatrix::from_entries(1, x0.len(), x0.clone()).write();
        map.insert("x0".to_owned(), row[0].clone());
    } else if let Some(formula) = x0_formula {
        map.insert("x0".to_owned(), json!(formula.text()));
    }
    for (key, signals) in [("u", u), ("d", d), ("noise", noise)] {
        if !signals.is_empty() {
            map.insert(key.to_owned(), signals_value(signals));
        }
    }
    if let Some(data) = uncertainty {
        let value = json!({
            "amplitude": data.amplitude.write(), "frequency": data.frequency.write(), "scale": number(data.scale),
        });
        map.insert("uncertainty".to_owned(), value);
    }
    if *free != FreeData::default() {
        map.insert("free".to_owned(), free_value(free));
    }
    Value::Object(map)
}

/// What drives the free states.
pub(super) fn free_value(free: &FreeData) -> Value {
    let mut map = Map::new();
    if !free.signals.is_empty() {
        map.insert("signals".to_owned(), signals_value(&free.signals));
    }
    if let Some(feedback) = &free.feedback {
        map.insert("feedback".to_owned(), feedback.write());
    }
    Value::Object(map)
}

fn tolerance_value(tolerance: &Tolerance) -> Value {
    let Tolerance { rank, pencil, mode, margin, gap, residual } = tolerance;
    json!({ "rank": rank, "pencil": pencil, "mode": mode, "margin": margin, "gap": gap, "residual": residual })
}
