//! What became of the figures as JSON.

use serde_json::{Value, json};

/// A figure that was written to files, or that could not be made.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct WrittenFigure {
    /// Its key.
    pub id: String,
    /// Its title.
    pub title: String,
    /// The files, or why there are none.
    pub outcome: Result<FigureFiles, String>,
}

/// The files of a figure.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FigureFiles {
    /// The drawing.
    pub svg: String,
    /// The numbers.
    pub csv: String,
    /// Remarks of the computation.
    pub notes: Vec<String>,
}

pub(super) fn figure(figure: &WrittenFigure) -> Value {
    let WrittenFigure { id, title, outcome } = figure;
    match outcome {
        Ok(FigureFiles { svg, csv, notes }) => {
            json!({ "id": id, "title": title, "svg": svg, "csv": csv, "notes": notes })
        }
        Err(error) => json!({ "id": id, "title": title, "error": error }),
    }
}
