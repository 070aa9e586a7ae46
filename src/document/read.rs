//! Reading a document: every key known, every shape checked, every error with its place.
#![expect(non_snake_case, reason = "keys are matrix letters")]

use super::cursor::{Cursor, Object, parse};
use super::entry::EntryMatrix;
use super::initial::read_initial;
use super::limits::{MAX_HORIZON, MAX_KEPT, MAX_POLES, MAX_SAMPLES, MAX_SIDE, MAX_SUBSYSTEMS};
use super::lmi::read_lmi;
use super::model::{
    DescriptorData, Document, FreeData, KeptDesign, LipschitzData, PlantData, ScenarioData, UncertaintyData,
};
use super::network::read_network;
use super::{DocumentError, VERSION, read_figures};
use crate::numerics::{Complex64, Tolerance};
use crate::observer::{DesignChoice, Method, Order};
use crate::system::{
    DescriptorSystem, Signal, Subsystem, SystemError, TimeDomain, check_partition, nonlinearity,
};

/// Reads a document of format version 1.
///
/// # Errors
/// What stands where, and what is needed there; see [`DocumentError`].
pub fn read_document(text: &str) -> Result<Document, DocumentError> {
    let value = parse(text)?;
    let root = Cursor::root(&value).object(&[
        "descry",
        "title",
        "notes",
        "paper",
        "system",
        "design",
        "scenario",
        "tolerance",
        "compare",
        "figures",
    ])?;
    let version = root.need("descry", "the version of the format is needed: \"descry\": 1")?;
    if version.whole_in(0, u64::MAX).is_ok_and(|found| found > VERSION) {
        return Err(version.error(format!("this program reads version {VERSION}; a newer one is needed")));
    }
    version.whole_in(VERSION, VERSION)?;
    let text = |key| root.get(key).map_or(Ok(String::new()), |cursor| cursor.text().map(str::to_owned));
    let plant = plant(&root.need("system", "the matrices of the system are needed")?)?;
    let sizes = Sizes::of(&plant);
    let design =
        root.get("design").map_or(Ok(DesignChoice::default()), |cursor| read_design(&cursor, &sizes))?;
    let scenario = match root.get("scenario") {
        Some(cursor) => scenario(&cursor, &sizes)?,
        None => ScenarioData::empty(),
    };
    let document = Document {
        title: text("title")?,
        notes: text("notes")?,
        paper: text("paper")?,
        plant,
        design,
        scenario,
        tolerance: root.get("tolerance").map_or(Ok(Tolerance::default()), |cursor| tolerance(&cursor))?,
        kept: root.get("compare").map_or(Ok(Vec::new()), |cursor| kept(&cursor, &sizes))?,
        figures: root.get("figures").map_or(Ok(Vec::new()), |cursor| read_figures(&cursor, &sizes))?,
    };
    Ok(document)
}

impl ScenarioData {
    /// Ten seconds of nothing.
    pub fn empty() -> Self {
        Self {
            horizon: 10.0,
            samples: 501,
            x0: Vec::new(),
            x0_formula: None,
            u: Vec::new(),
            d: Vec::new(),
            noise: Vec::new(),
            uncertainty: None,
            free: FreeData::default(),
        }
    }
}

/// Sizes that signals and initial states must match.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Sizes {
    /// States.
    pub states: usize,
    /// Equations.
    pub equations: usize,
    /// Known inputs.
    pub inputs: usize,
    /// Unknown inputs.
    pub unknown: usize,
    /// Outputs.
    pub outputs: usize,
    /// Subsystems of a network; none where the plant is given as one system.
    pub subsystems: usize,
}

impl Sizes {
    /// The sizes of a system; those of a network as a whole.
    pub fn of(plant: &PlantData) -> Self {
        match plant {
            PlantData::Descriptor(data) => {
                let [e, _, b, c, d, _] = data.matrices.each_ref().map(EntryMatrix::shape);
                Self { states: e.1, equations: e.0, inputs: b.1, unknown: d.1, outputs: c.0, subsystems: 0 }
            }
            PlantData::Network(data) => {
                let states = data.states();
                let outputs = data.Psi.shape().0 * data.c_G.shape().0 + data.local.len() * data.c_L.shape().0;
                let subsystems = data.Gamma.shape().0;
                Self { states, equations: states, inputs: 0, unknown: 0, outputs, subsystems }
            }
        }
    }
}

fn plant(cursor: &Cursor<'_>) -> Result<PlantData, DocumentError> {
    let object =
        cursor.object(&["time", "E", "A", "B", "C", "D", "F", "partition", "lipschitz", "network"])?;
    if let Some(network) = object.get("network") {
        for key in ["time", "E", "A", "B", "C", "D", "F", "partition", "lipschitz"] {
            if let Some(other) = object.get(key) {
                return Err(other.error("a system is either a network or matrices: remove one of them"));
            }
        }
        return Ok(PlantData::Network(read_network(&network)?));
    }
    descriptor(&object).map(PlantData::Descriptor)
}

fn descriptor(object: &Object<'_>) -> Result<DescriptorData, DocumentError> {
    let time = object.get("time").map_or(Ok(TimeDomain::Continuous), |cursor| {
        cursor.word(&[("continuous", TimeDomain::Continuous), ("discrete", TimeDomain::Discrete)])
    })?;
    let E = EntryMatrix::read(
        &object.need("E", "the matrix E is needed, a list of rows such as [[1, 0], [0, 0]]")?,
    )?;
    let A = EntryMatrix::read(&object.need("A", "the matrix A is needed, with the shape of E")?)?;
    let (e, n) = E.shape();
    let optional = |key, rows: usize, columns: usize| match object.get(key) {
        // a matrix without rows cannot show its columns
        Some(cursor) => EntryMatrix::read(&cursor)
            .map(|m| if m.shape().0 == 0 { EntryMatrix::zeros(rows.min(m.shape().0), columns) } else { m }),
        None => Ok(EntryMatrix::zeros(rows, columns)),
    };
    let C = optional("C", 0, n)?;
    let (B, D) = (optional("B", e, 0)?, optional("D", e, 0)?);
    let F = optional("F", C.shape().0, D.shape().1)?;
    let mut data =
        DescriptorData { time, matrices: [E, A, B, C, D, F], partition: Vec::new(), lipschitz: None };
    let system = data.system().map_err(|error| at_matrix("system", &error))?;
    if let Some(cursor) = object.get("partition") {
        data.partition = partition(&cursor, &system)?;
    }
    data.lipschitz = object.get("lipschitz").map(|cursor| lipschitz(&cursor, &system)).transpose()?;
    Ok(data)
}

/// A system error as an error at the matrix's place.
pub(super) fn at_matrix(place: &str, error: &SystemError) -> DocumentError {
    match error {
        SystemError::Shape { matrix, found, needed, reason } => DocumentError::at(
            &format!("{place}.{matrix}"),
            format!("a {} x {} matrix", found.0, found.1),
            format!("{} x {} is needed: {reason}", needed.0, needed.1),
        ),
        SystemError::NotFinite { matrix, row, column } => DocumentError::at(
            &format!("{place}.{matrix}[{}, {}]", row + 1, column + 1),
            "a value that is not finite",
            "a finite number is needed",
        ),
        SystemError::NoStates => DocumentError::at(place, "no states", error.to_string()),
        SystemError::TooLarge { found, .. } => {
            DocumentError::at(place, format!("{found} states"), error.to_string())
        }
        SystemError::GlobalOutputs { found, .. } => {
            DocumentError::at(place, format!("{found} global outputs"), error.to_string())
        }
    }
}

fn partition(cursor: &Cursor<'_>, system: &DescriptorSystem) -> Result<Vec<Subsystem>, DocumentError> {
    let mut subsystems = Vec::new();
    for item in cursor.list(MAX_SUBSYSTEMS, "subsystems")? {
        let object = item.object(&["name", "states", "equations", "outputs"])?;
        let count = |key, or: Option<usize>| match (object.get(key), or) {
            (Some(cursor), _) => {
                cursor.whole_in(0, MAX_SIDE as u64).map(|n| usize::try_from(n).unwrap_or(usize::MAX))
            }
            (None, Some(or)) => Ok(or),
            (None, None) => Err(item.error(format!("the number of {key} of this subsystem is needed"))),
        };
        let states = count("states", None)?;
        let name = object.get("name").map_or(Ok(String::new()), |c| c.text().map(str::to_owned))?;
        subsystems.push(Subsystem {
            name,
            states,
            equations: count("equations", Some(states))?,
            outputs: count("outputs", None)?,
        });
    }
    check_partition(system, &subsystems).map_err(|error| {
        DocumentError::at(cursor.path(), format!("{} subsystems", subsystems.len()), error.to_string())
    })?;
    Ok(subsystems)
}

fn lipschitz(cursor: &Cursor<'_>, system: &DescriptorSystem) -> Result<LipschitzData, DocumentError> {
    let object = cursor.object(&["G", "F_L", "f", "constant"])?;
    let (e, n) = (system.n_equations(), system.n_states());
    let G = EntryMatrix::read(&object.need("G", "the distribution G of the nonlinearity is needed")?)?;
    let F_L = EntryMatrix::read(&object.need("F_L", "the matrix F_L is needed: which states f depends on")?)?;
    let components = object.need("f", "the nonlinearity f is needed, a list such as [\"sin(x2)\"]")?;
    let components = components.list(MAX_SIDE, "expressions")?;
    let mut f = Vec::new();
    for component in &components {
        let text = component.text()?;
        nonlinearity(text, n)
            .map_err(|error| component.error(format!("an expression in x1 ... x{n} and t: {error}")))?;
        f.push(text.to_owned());
    }
    let checks = [
        ("G", G.shape(), (e, f.len()), "a row for each equation and a column for each component of f"),
        ("F_L", F_L.shape(), (F_L.shape().0, n), "a column for each state"),
    ];
    for (name, found, needed, reason) in checks {
        if found != needed {
            return Err(DocumentError::at(
                &format!("{}.{name}", cursor.path()),
                format!("a {} x {} matrix", found.0, found.1),
                format!("{} x {} is needed: {reason}", needed.0, needed.1),
            ));
        }
    }
    let constant = object.need("constant", "the Lipschitz constant is needed")?.number_in(0.0, 1e6)?;
    Ok(LipschitzData { G, F_L, f, constant })
}

/// Words of the design methods.
pub(super) fn method_words() -> Vec<(&'static str, Method)> {
    Method::ALL.iter().map(|m| (m.key(), *m)).collect()
}

/// Words of the orders.
pub(super) fn order_words() -> Vec<(&'static str, Order)> {
    Order::ALL.iter().map(|o| (o.key(), *o)).collect()
}

fn read_design(cursor: &Cursor<'_>, sizes: &Sizes) -> Result<DesignChoice, DocumentError> {
    let object =
        cursor.object(&["method", "order", "poles", "scale", "seed", "local poles", "plugged", "lmi"])?;
    let default = DesignChoice::default();
    Ok(DesignChoice {
        method: object.get("method").map_or(Ok(default.method), |c| c.word(&method_words()))?,
        order: object.get("order").map_or(Ok(default.order), |c| c.word(&order_words()))?,
        poles: object.get("poles").map_or(Ok(Vec::new()), |c| read_poles(&c))?,
        scale: object.get("scale").map_or(Ok(default.scale), |c| c.number_in(1e-3, 1e3))?,
        seed: object.get("seed").map_or(Ok(default.seed), |c| c.whole_in(0, u64::from(u32::MAX)))?,
        local_poles: object.get("local poles").map_or(Ok(Vec::new()), |c| read_poles(&c))?,
        plugged: object.get("plugged").map(|c| read_plugged(&c, sizes)).transpose()?,
        lmi: object.get("lmi").map_or(Ok(default.lmi), |c| read_lmi(&c, sizes))?,
    })
}

/// The designs that are kept beside the chosen one.
fn kept(cursor: &Cursor<'_>, sizes: &Sizes) -> Result<Vec<KeptDesign>, DocumentError> {
    let mut all: Vec<KeptDesign> = Vec::new();
    for item in cursor.list(MAX_KEPT, "kept designs")? {
        let object = item.object(&["name", "design"])?;
        let name = object.need("name", "a name is needed, for example \"proportional\"")?;
        let text = name.text()?.trim();
        if let Some(why) = KeptDesign::refused_name(text) {
            return Err(name.error(why));
        }
        if all.iter().any(|other| other.name == text) {
            return Err(name.error("an earlier design has this name; names differ"));
        }
        let design =
            object.need("design", "the design is needed, for example { \"method\": \"proportional\" }")?;
        all.push(KeptDesign { name: text.to_owned(), design: read_design(&design, sizes)? });
    }
    Ok(all)
}

/// Numbers of subsystems with local measurements, from one in the document and from zero in the program.
pub(super) fn read_plugged(cursor: &Cursor<'_>, sizes: &Sizes) -> Result<Vec<usize>, DocumentError> {
    let mut plugged = Vec::new();
    for item in cursor.list(MAX_SUBSYSTEMS, "subsystem numbers")? {
        let number = usize::try_from(item.whole_in(1, sizes.subsystems.max(1) as u64)?).unwrap_or(usize::MAX);
        plugged.push(number - 1);
    }
    Ok(plugged)
}

/// A list of poles: numbers, or `[real, imaginary]`.
pub(super) fn read_poles(cursor: &Cursor<'_>) -> Result<Vec<Complex64>, DocumentError> {
    let mut poles = Vec::new();
    for item in cursor.list(MAX_POLES, "poles")? {
        if item.is_number() {
            poles.push(Complex64::from(item.number()?));
            continue;
        }
        let parts = if item.is_list() { item.list(2, "numbers")? } else { Vec::new() };
        let [re, im] = parts.as_slice() else {
            return Err(item.error("a pole is a number or [real, imaginary]"));
        };
        poles.push(Complex64::new(re.number()?, im.number()?));
    }
    crate::numerics::conjugate_pairs(&poles).map_err(|error| cursor.error(error.to_string()))?;
    Ok(poles)
}

fn scenario(cursor: &Cursor<'_>, sizes: &Sizes) -> Result<ScenarioData, DocumentError> {
    let object = cursor.object(&["horizon", "samples", "x0", "u", "d", "noise", "uncertainty", "free"])?;
    let empty = ScenarioData::empty();
    let horizon = object.get("horizon").map_or(Ok(empty.horizon), |c| c.number_in(1e-6, MAX_HORIZON))?;
    let samples = object.get("samples").map_or(Ok(empty.samples as u64), |c| c.whole_in(2, MAX_SAMPLES))?;
    let (x0, x0_formula) =
        object.get("x0").map_or(Ok((Vec::new(), None)), |c| read_initial(&c, sizes.states))?;
    let signals = |key, count, of| object.get(key).map_or(Ok(Vec::new()), |c| read_signals(&c, count, of));
    Ok(ScenarioData {
        horizon,
        samples: usize::try_from(samples).unwrap_or(usize::MAX),
        x0,
        x0_formula,
        u: signals("u", sizes.inputs, "known inputs (columns of B)")?,
        d: signals("d", sizes.unknown, "unknown inputs (columns of D)")?,
        noise: signals("noise", sizes.outputs, "outputs (rows of C)")?,
        uncertainty: object.get("uncertainty").map(|c| uncertainty(&c, sizes)).transpose()?,
        free: object.get("free").map_or(Ok(FreeData::default()), |c| read_free(&c, sizes))?,
    })
}

/// What drives the free states; how many there are follows from ranks, so that the simulation judges the numbers.
pub(super) fn read_free(cursor: &Cursor<'_>, sizes: &Sizes) -> Result<FreeData, DocumentError> {
    let object = cursor.object(&["signals", "feedback"])?;
    let list = object.get("signals").map_or(Ok(Vec::new()), |c| read_signal_list(&c))?;
    let feedback = object.get("feedback").map(|c| EntryMatrix::read(&c).map(|m| (c, m))).transpose()?;
    if let Some((cursor, found)) = &feedback
        && found.shape().1 != sizes.states
    {
        return Err(DocumentError::at(
            cursor.path(),
            format!("a {} x {} matrix", found.shape().0, found.shape().1),
            format!(
                "{} columns are needed: one for each state, and a row for each free variable",
                sizes.states
            ),
        ));
    }
    Ok(FreeData { signals: list, feedback: feedback.map(|(_, matrix)| matrix) })
}

/// A list of signals; a plain number is a constant signal. Empty, or one for each.
pub(super) fn read_signals(
    cursor: &Cursor<'_>,
    count: usize,
    of: &str,
) -> Result<Vec<Signal>, DocumentError> {
    let items = cursor.list(MAX_SIDE, "signals")?;
    if !items.is_empty() && items.len() != count {
        return Err(cursor.error(format!("one signal for each of the {count} {of} is needed")));
    }
    read_signal_list(cursor)
}

/// Any number of signals; a plain number is a constant signal.
fn read_signal_list(cursor: &Cursor<'_>) -> Result<Vec<Signal>, DocumentError> {
    let signal = |item: &Cursor<'_>| {
        let text = if item.is_number() { item.number()?.to_string() } else { item.text()?.to_owned() };
        Signal::parse(&text).map_err(|error| item.error(format!("a signal is an expression in t: {error}")))
    };
    cursor.list(MAX_SIDE, "signals")?.iter().map(signal).collect()
}

fn uncertainty(cursor: &Cursor<'_>, sizes: &Sizes) -> Result<UncertaintyData, DocumentError> {
    let object = cursor.object(&["amplitude", "frequency", "scale"])?;
    let shaped = |key| {
        let cursor = object.need(key, "amplitude and frequency are needed, each with the shape of A")?;
        let matrix = EntryMatrix::read(&cursor)?;
        let needed = (sizes.equations, sizes.states);
        if matrix.shape() == needed {
            return Ok(matrix);
        }
        Err(DocumentError::at(
            cursor.path(),
            format!("a {} x {} matrix", matrix.shape().0, matrix.shape().1),
            format!("{} x {} is needed: the shape of A", needed.0, needed.1),
        ))
    };
    Ok(UncertaintyData {
        amplitude: shaped("amplitude")?,
        frequency: shaped("frequency")?,
        scale: object.get("scale").map_or(Ok(1.0), |c| c.number_in(0.0, 1e3))?,
    })
}

fn tolerance(cursor: &Cursor<'_>) -> Result<Tolerance, DocumentError> {
    let object = cursor.object(&["rank", "pencil", "mode", "margin", "gap", "residual"])?;
    let default = Tolerance::default();
    let value = |key, or| object.get(key).map_or(Ok(or), |c| c.number_in(1e-15, 1e15));
    Ok(Tolerance {
        rank: value("rank", default.rank)?,
        pencil: value("pencil", default.pencil)?,
        mode: value("mode", default.mode)?,
        margin: value("margin", default.margin)?,
        gap: value("gap", default.gap)?,
        residual: value("residual", default.residual)?,
    })
}
