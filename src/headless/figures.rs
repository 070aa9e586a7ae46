//! `figures`: every figure of a document as SVG and CSV.

use std::path::Path;

use super::commands::simulated;
use super::compare::{compared, compared_network};
use super::load::{Problem, load};
use super::{Answer, DONE, Files, REFUSED, Refusal, Source, network};
use crate::document::report::{FigureFiles, WrittenFigure, figures_report};
use crate::document::{Document, Subject, figure_to_csv, figure_to_svg, nearest};
use crate::numerics::Watch;
use crate::paper::{self, FigureSpec, Motion, standard};
use crate::system::Model;

/// A figure before it is written: key, title, and the figure or why there is none.
type Computed = (String, String, Result<FigureSpec, String>);

/// Writes the figures and lists the files.
pub(super) fn figures(
    source: &Source,
    out: &Path,
    only: Option<&str>,
    files: &dyn Files,
) -> Result<Answer, Refusal> {
    let problem = load(source, files)?;
    let chosen = |id: &str| only.is_none_or(|only| only == id);
    let computed = computed(&problem, &chosen)?;
    if let (Some(only), true) = (only, computed.is_empty()) {
        return Err(unknown(only, &problem.document));
    }
    files.create_folder(out).map_err(|error| {
        Refusal::bad_input(format!("the folder {} cannot be made: {error}", out.display()))
    })?;
    let mut written = Vec::new();
    let mut remarks = Vec::new();
    for (id, title, figure) in computed {
        let outcome = match figure {
            Ok(figure) => Ok(write(&figure, out, files)?),
            Err(error) => {
                remarks.push(format!("figure {id} could not be made: {error}"));
                Err(error)
            }
        };
        written.push(WrittenFigure { id, title, outcome });
    }
    let code = if remarks.is_empty() { DONE } else { REFUSED };
    Ok(Answer { text: figures_report(&problem.document, &written), remarks, code })
}

/// The chosen figures of the document, or the standard ones when it has none.
fn computed(problem: &Problem, chosen: &dyn Fn(&str) -> bool) -> Result<Vec<Computed>, Refusal> {
    let document = &problem.document;
    if let Some(figures) = of_comparison(problem, chosen)? {
        return Ok(figures);
    }
    if !chosen("") && chosen(TRADE_OFF) {
        let figure = document.draw_trade_off(&Watch::none());
        return Ok(vec![(TRADE_OFF.to_owned(), "Trade-off".to_owned(), figure)]);
    }
    if document.figures.is_empty() {
        return standard_figures(problem, chosen);
    }
    let recipes = document.figures.iter().filter(|recipe| chosen(&recipe.id));
    let figure = |recipe: &paper::FigureRecipe| document.draw(recipe, &Watch::none());
    Ok(recipes.map(|recipe| (recipe.id.clone(), recipe.title.clone(), figure(recipe))).collect())
}

/// The chosen figures of the comparison; `None` when none of these is chosen by its id.
fn of_comparison(problem: &Problem, chosen: &dyn Fn(&str) -> bool) -> Result<Option<Vec<Computed>>, Refusal> {
    // without a choice the document's own figures are meant
    if chosen("") || !COMPARISON.iter().any(|id| chosen(id)) {
        return Ok(None);
    }
    let figures = match &problem.subject {
        Subject::Model(model) => paper::comparison(&compared(&problem.document, model)?, &model.system),
        Subject::Network(network) => {
            paper::network_comparison(&compared_network(&problem.document, network)?, network)
        }
    };
    let computed = figures.all().filter(|figure| chosen(&figure.id));
    Ok(Some(computed.map(|figure| (figure.id.clone(), figure.title.clone(), Ok(figure.clone()))).collect()))
}

/// Ids of the figures that show all designs.
const COMPARISON: [&str; 4] =
    ["comparison-states", "comparison-errors", "comparison-unknown-input", "comparison-gains"];

/// Id of the figure of designs along a sweep.
const TRADE_OFF: &str = "trade-off";

fn standard_figures(problem: &Problem, chosen: &dyn Fn(&str) -> bool) -> Result<Vec<Computed>, Refusal> {
    let mut figures = match &problem.subject {
        Subject::Model(model) => figures_of_system(&problem.document, model)?,
        Subject::Network(network) => network::standard_figures(&problem.document, network)?,
    };
    figures.retain(|figure| chosen(&figure.id));
    Ok(figures.into_iter().map(|figure| (figure.id.clone(), figure.title.clone(), Ok(figure))).collect())
}

fn figures_of_system(document: &Document, model: &Model) -> Result<Vec<FigureSpec>, Refusal> {
    let (design, trajectory) = simulated(document, model)?;
    if let Some(network) = &model.network {
        return Ok(network::figures(network, &Motion::of_system(trajectory, &design)));
    }
    let (time, partition) = (model.system.time, model.partition.as_slice());
    let mut figures = vec![
        standard::states(&trajectory, time, partition),
        standard::errors(&trajectory, time, partition),
        standard::unknown_inputs(&trajectory, time),
    ];
    figures.extend(standard::bode(&model.system, &design));
    Ok(figures)
}

fn unknown(only: &str, document: &Document) -> Refusal {
    let mut ids: Vec<&str> = document.figures.iter().map(|recipe| recipe.id.as_str()).collect();
    if ids.is_empty() {
        ids = vec!["states", "errors", "unknown-input", "bode"];
    }
    ids.extend(COMPARISON);
    ids.push(TRADE_OFF);
    let hint = nearest(only, &ids).map_or(String::new(), |near| format!("; did you mean \"{near}\"?"));
    Refusal::bad_input(format!("there is no figure \"{only}\": the ids are {}{hint}", ids.join(", ")))
}

fn write(figure: &FigureSpec, out: &Path, files: &dyn Files) -> Result<FigureFiles, Refusal> {
    let save = |extension: &str, text: &str| -> Result<String, Refusal> {
        let path = out.join(format!("{}.{extension}", figure.id));
        files
            .write(&path, text.as_bytes())
            .map_err(|error| Refusal::bad_input(format!("{} cannot be written: {error}", path.display())))?;
        Ok(path.display().to_string())
    };
    Ok(FigureFiles {
        svg: save("svg", &figure_to_svg(figure))?,
        csv: save("csv", &figure_to_csv(figure))?,
        notes: figure.notes.clone(),
    })
}
