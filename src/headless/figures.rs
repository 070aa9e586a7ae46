//! `figures`: every figure of a document as SVG and CSV.

use std::path::Path;

use super::commands::simulated;
use super::compare::compared;
use super::load::{Problem, load};
use super::{Answer, DONE, Files, REFUSED, Refusal, Source};
use crate::document::report::{FigureFiles, WrittenFigure, figures_report};
use crate::document::{Document, figure_to_csv, figure_to_svg, nearest};
use crate::numerics::Watch;
use crate::paper::{self, FigureSpec, compute_figure, standard};

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
    let Problem { document, model } = problem;
    let system = &model.system;
    if let Some(figures) = of_comparison(problem, chosen)? {
        return Ok(figures);
    }
    if document.figures.is_empty() {
        return standard_figures(problem, chosen);
    }
    let scenario = document.scenario(system);
    let problem = paper::Problem {
        model,
        design: &document.design,
        scenario: &scenario,
        tolerance: &document.tolerance,
    };
    let recipes = document.figures.iter().filter(|recipe| chosen(&recipe.id));
    let figure = |recipe: &paper::FigureRecipe| compute_figure(&problem, recipe, &Watch::none());
    Ok(recipes.map(|recipe| (recipe.id.clone(), recipe.title.clone(), figure(recipe))).collect())
}

/// The chosen figures of the comparison; `None` when none of these is chosen by its id.
fn of_comparison(problem: &Problem, chosen: &dyn Fn(&str) -> bool) -> Result<Option<Vec<Computed>>, Refusal> {
    // without a choice the document's own figures are meant
    if chosen("") || !COMPARISON.iter().any(|id| chosen(id)) {
        return Ok(None);
    }
    let figures = paper::comparison(&compared(problem)?, &problem.model.system);
    let computed = figures.all().filter(|figure| chosen(&figure.id));
    Ok(Some(computed.map(|figure| (figure.id.clone(), figure.title.clone(), Ok(figure.clone()))).collect()))
}

/// Ids of the figures that show all designs.
const COMPARISON: [&str; 4] =
    ["comparison-states", "comparison-errors", "comparison-unknown-input", "comparison-gains"];

fn standard_figures(problem: &Problem, chosen: &dyn Fn(&str) -> bool) -> Result<Vec<Computed>, Refusal> {
    let (design, trajectory) = simulated(problem)?;
    let (time, partition) = (problem.model.system.time, problem.model.partition.as_slice());
    let mut figures = vec![
        standard::states(&trajectory, time, partition),
        standard::errors(&trajectory, time, partition),
        standard::unknown_inputs(&trajectory, time),
    ];
    figures.extend(standard::bode(&problem.model.system, &design));
    figures.retain(|figure| chosen(&figure.id));
    Ok(figures.into_iter().map(|figure| (figure.id.clone(), figure.title.clone(), Ok(figure))).collect())
}

fn unknown(only: &str, document: &Document) -> Refusal {
    let mut ids: Vec<&str> = document.figures.iter().map(|recipe| recipe.id.as_str()).collect();
    if ids.is_empty() {
        ids = vec!["states", "errors", "unknown-input", "bode"];
    }
    ids.extend(COMPARISON);
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
