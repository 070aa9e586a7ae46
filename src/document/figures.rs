//! Figure recipes in documents: reading and writing.

use serde_json::{Map, Value, json};

use super::DocumentError;
use super::cursor::{Cursor, Object};
use super::entry::number;
use super::limits::MAX_FIGURES;
use super::lmi::{lmi_value, read_lmi};
use super::model::FreeData;
use super::read::{Sizes, method_words, order_words, read_free, read_plugged, read_poles, read_signals};
use super::write::{free_value, plugged_value, poles_value, signals_value};
use crate::paper::{
    DesignPatch, FigureRecipe, PanelRecipe, Quantity, RunRecipe, ScenarioPatch, SeriesRecipe, Transfer,
};

pub(super) fn read_figures(cursor: &Cursor<'_>, sizes: &Sizes) -> Result<Vec<FigureRecipe>, DocumentError> {
    let mut figures: Vec<FigureRecipe> = Vec::new();
    for item in cursor.list(MAX_FIGURES, "figures")? {
        let figure = figure(&item, sizes)?;
        if figures.iter().any(|other| other.id == figure.id) {
            return Err(
                item.error(format!("the id \"{}\" is taken by an earlier figure; ids differ", figure.id))
            );
        }
        figures.push(figure);
    }
    Ok(figures)
}

fn figure(cursor: &Cursor<'_>, sizes: &Sizes) -> Result<FigureRecipe, DocumentError> {
    let object = cursor.object(&["id", "title", "caption", "see", "columns", "runs", "panels"])?;
    let text = |key| object.get(key).map_or(Ok(String::new()), |c| c.text().map(str::to_owned));
    let id = object.need("id", "an id is needed, for example \"fig1\"")?;
    let plain = |text: &str| {
        !text.is_empty()
            && text.len() <= 40
            && text.bytes().all(|b| b.is_ascii_alphanumeric() || b == b'-' || b == b'_')
    };
    if !plain(id.text()?) {
        return Err(id.error("an id has 1 to 40 letters, digits, `-` or `_`: it names files"));
    }
    let mut runs = Vec::new();
    for item in object
        .need("runs", "the simulated designs are needed; [{}] is the document's own")?
        .list(MAX_FIGURES, "runs")?
    {
        runs.push(run(&item, sizes)?);
    }
    let mut panels = Vec::new();
    for item in object.need("panels", "the panels are needed")?.list(MAX_FIGURES, "panels")? {
        panels.push(panel(&item, sizes, &runs)?);
    }
    let columns = object.get("columns").map_or(Ok(1), |c| c.whole_in(1, 6))?;
    Ok(FigureRecipe {
        id: id.text()?.to_owned(),
        title: text("title")?,
        caption: text("caption")?,
        see: text("see")?,
        runs,
        panels,
        columns: usize::try_from(columns).unwrap_or(1),
    })
}

fn run(cursor: &Cursor<'_>, sizes: &Sizes) -> Result<RunRecipe, DocumentError> {
    let object = cursor.object(&["name", "design", "scenario"])?;
    Ok(RunRecipe {
        name: object.get("name").map_or(Ok(String::new()), |c| c.text().map(str::to_owned))?,
        design: object.get("design").map_or(Ok(DesignPatch::default()), |c| design_patch(&c, sizes))?,
        scenario: object
            .get("scenario")
            .map_or(Ok(ScenarioPatch::default()), |c| scenario_patch(&c, sizes))?,
    })
}

fn design_patch(cursor: &Cursor<'_>, sizes: &Sizes) -> Result<DesignPatch, DocumentError> {
    let object = cursor.object(&["method", "order", "poles", "scale", "local poles", "plugged", "lmi"])?;
    Ok(DesignPatch {
        method: object.get("method").map(|c| c.word(&method_words())).transpose()?,
        order: object.get("order").map(|c| c.word(&order_words())).transpose()?,
        poles: object.get("poles").map(|c| read_poles(&c)).transpose()?,
        scale: object.get("scale").map(|c| c.number_in(1e-3, 1e3)).transpose()?,
        local_poles: object.get("local poles").map(|c| read_poles(&c)).transpose()?,
        plugged: object.get("plugged").map(|c| read_plugged(&c, sizes)).transpose()?,
        lmi: object.get("lmi").map(|c| read_lmi(&c, sizes)).transpose()?,
    })
}

fn scenario_patch(cursor: &Cursor<'_>, sizes: &Sizes) -> Result<ScenarioPatch, DocumentError> {
    let object = cursor.object(&["u", "d", "noise", "horizon", "uncertainty scale", "free"])?;
    let signals = |key, count, of| object.get(key).map(|c| read_signals(&c, count, of)).transpose();
    Ok(ScenarioPatch {
        u: signals("u", sizes.inputs, "known inputs (columns of B)")?,
        d: signals("d", sizes.unknown, "unknown inputs (columns of D)")?,
        noise: signals("noise", sizes.outputs, "outputs (rows of C)")?,
        horizon: object.get("horizon").map(|c| c.number_in(1e-6, super::limits::MAX_HORIZON)).transpose()?,
        uncertainty_scale: object.get("uncertainty scale").map(|c| c.number_in(0.0, 1e3)).transpose()?,
        free: object.get("free").map(|c| read_free(&c, sizes).map(|free| free.values())).transpose()?,
    })
}

fn range(object: &Object<'_>, key: &'static str) -> Result<Option<[f64; 2]>, DocumentError> {
    let Some(cursor) = object.get(key) else { return Ok(None) };
    let items = cursor.list(2, "numbers")?;
    let [low, high] = items.as_slice() else {
        return Err(cursor.error("two numbers are needed: [low, high]"));
    };
    let (low, high) = (low.number()?, high.number()?);
    if low < high {
        Ok(Some([low, high]))
    } else {
        Err(cursor.error("the first number must be below the second"))
    }
}

fn panel(cursor: &Cursor<'_>, sizes: &Sizes, runs: &[RunRecipe]) -> Result<PanelRecipe, DocumentError> {
    let object = cursor.object(&["kind", "title", "range", "series", "transfer", "from", "to"])?;
    let title = object.get("title").map_or(Ok(String::new()), |c| c.text().map(str::to_owned))?;
    let kind = object.need("kind", "the kind of panel is needed: \"time\" or \"bode\"")?;
    if kind.word(&[("time", true), ("bode", false)])? {
        let list = object.need("series", "the curves are needed")?;
        let series = list.list(MAX_FIGURES, "curves")?;
        let series = series.iter().map(|item| read_series(item, sizes, runs)).collect::<Result<_, _>>()?;
        return Ok(PanelRecipe::Time { title, range: range(&object, "range")?, series });
    }
    let transfer = object.need("transfer", "the transfer function is needed")?.word(&Transfer::WORDS)?;
    let index = |key, limit: usize| -> Result<usize, DocumentError> {
        let cursor = object.get(key);
        let number = cursor.map_or(Ok(1), |c| c.whole_in(1, limit as u64))?;
        Ok(usize::try_from(number).unwrap_or(1) - 1)
    };
    let to = if transfer == Transfer::UnknownInput { sizes.unknown } else { sizes.states };
    let frequencies = range(&object, "range")?.unwrap_or([1e-2, 1e4]);
    if frequencies[0] <= 0.0 {
        return Err(cursor.error("frequencies on a logarithmic axis must be positive"));
    }
    Ok(PanelRecipe::Bode {
        title,
        transfer,
        from: index("from", sizes.unknown)?,
        to: index("to", to)?,
        range: frequencies,
    })
}

fn read_series(
    cursor: &Cursor<'_>,
    sizes: &Sizes,
    runs: &[RunRecipe],
) -> Result<SeriesRecipe, DocumentError> {
    let object = cursor.object(&["show", "run", "name"])?;
    let show = object.need("show", "what is shown is needed, for example \"x1_hat\"")?;
    let (quantity, index) = Quantity::parse(show.text()?).ok_or_else(|| {
        show.error(
            "one of x1, x1_hat, e1, d1, d1_hat, ed1, u1, y1, of a network also z1, z1_hat, ez1 (with any number) is needed \
             here",
        )
    })?;
    let limit = match quantity {
        Quantity::Whole | Quantity::WholeEstimate | Quantity::WholeError if sizes.subsystems == 0 => {
            return Err(show.error("z is the state of a network as a whole; this system is no network"));
        }
        // how many components the whole has follows from ranks, so that the figure judges their numbers
        Quantity::State
        | Quantity::Estimate
        | Quantity::Error
        | Quantity::Whole
        | Quantity::WholeEstimate
        | Quantity::WholeError => sizes.states,
        Quantity::UnknownInput | Quantity::UnknownInputEstimate | Quantity::UnknownInputError => {
            sizes.unknown
        }
        Quantity::Input => sizes.inputs,
        Quantity::Output => sizes.outputs,
    };
    if index >= limit {
        return Err(show.error(format!("the system has only {limit} of these")));
    }
    let run = match object.get("run") {
        Some(cursor) => {
            let name = cursor.text()?;
            runs.iter().position(|run| run.name == name).ok_or_else(|| {
                let names: Vec<&str> = runs.iter().map(|run| run.name.as_str()).collect();
                cursor.error(format!("the name of one of the runs is needed: {}", names.join(", ")))
            })?
        }
        None if runs.is_empty() => return Err(cursor.error("the figure needs at least one run")),
        None => 0,
    };
    let name = object.get("name").map_or(Ok(String::new()), |c| c.text().map(str::to_owned))?;
    Ok(SeriesRecipe { run, quantity, index, name })
}

/// Collects keys that are not left at their defaults.
#[derive(Default)]
struct Writer(Map<String, Value>);

impl Writer {
    fn put(&mut self, key: &str, value: Option<Value>) {
        if let Some(value) = value {
            self.0.insert(key.to_owned(), value);
        }
    }

    fn text(&mut self, key: &str, text: &str) {
        self.put(key, (!text.is_empty()).then(|| json!(text)));
    }

    fn nested(&mut self, key: &str, other: Self) {
        self.put(key, (!other.0.is_empty()).then_some(Value::Object(other.0)));
    }
}

pub(super) fn figure_value(figure: &FigureRecipe) -> Value {
    let mut writer = Writer::default();
    writer.text("id", &figure.id);
    writer.text("title", &figure.title);
    writer.text("caption", &figure.caption);
    writer.text("see", &figure.see);
    writer.put("columns", (figure.columns > 1).then(|| json!(figure.columns)));
    writer.put("runs", Some(figure.runs.iter().map(run_value).collect()));
    writer.put("panels", Some(figure.panels.iter().map(|panel| panel_value(panel, &figure.runs)).collect()));
    Value::Object(writer.0)
}

fn run_value(run: &RunRecipe) -> Value {
    let mut design = Writer::default();
    design.put("method", run.design.method.map(|m| json!(m.key())));
    design.put("order", run.design.order.map(|o| json!(o.key())));
    design.put("poles", run.design.poles.as_deref().map(poles_value));
    design.put("scale", run.design.scale.map(number));
    design.put("local poles", run.design.local_poles.as_deref().map(poles_value));
    design.put("plugged", run.design.plugged.as_deref().map(plugged_value));
    design.put("lmi", run.design.lmi.as_ref().map(|lmi| lmi_value(lmi).unwrap_or_else(|| json!({}))));
    let mut scenario = Writer::default();
    scenario.put("u", run.scenario.u.as_deref().map(signals_value));
    scenario.put("d", run.scenario.d.as_deref().map(signals_value));
    scenario.put("noise", run.scenario.noise.as_deref().map(signals_value));
    scenario.put("horizon", run.scenario.horizon.map(number));
    scenario.put("uncertainty scale", run.scenario.uncertainty_scale.map(number));
    scenario.put("free", run.scenario.free.as_ref().map(|free| free_value(&FreeData::of(free))));
    let mut writer = Writer::default();
    writer.text("name", &run.name);
    writer.nested("design", design);
    writer.nested("scenario", scenario);
    Value::Object(writer.0)
}

fn panel_value(panel: &PanelRecipe, runs: &[RunRecipe]) -> Value {
    let mut writer = Writer::default();
    let pair = |[low, high]: [f64; 2]| json!([number(low), number(high)]);
    match panel {
        PanelRecipe::Time { title, range, series } => {
            writer.text("kind", "time");
            writer.text("title", title);
            writer.put("range", range.map(pair));
            writer.put("series", Some(series.iter().map(|series| series_value(series, runs)).collect()));
        }
        PanelRecipe::Bode { title, transfer, from, to, range } => {
            writer.text("kind", "bode");
            writer.text("title", title);
            writer.text("transfer", transfer.key());
            writer.put("from", Some(json!(from + 1)));
            writer.put("to", Some(json!(to + 1)));
            writer.put("range", Some(pair(*range)));
        }
    }
    Value::Object(writer.0)
}

fn series_value(series: &SeriesRecipe, runs: &[RunRecipe]) -> Value {
    let mut writer = Writer::default();
    writer.put("show", Some(json!(series.quantity.name(series.index))));
    if series.run > 0 {
        writer.put("run", runs.get(series.run).map(|run| json!(run.name)));
    }
    writer.text("name", &series.name);
    Value::Object(writer.0)
}
