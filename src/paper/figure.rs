//! Computed figures as data: panels, axes, curves. Nothing here draws.

use serde::{Deserialize, Serialize};

/// A computed figure, ready to be drawn by a screen or written as SVG or CSV.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct FigureSpec {
    /// Key, used for file names.
    pub id: String,
    /// Title.
    pub title: String,
    /// What is shown.
    pub caption: String,
    /// What to look for.
    pub see: String,
    /// Panels side by side.
    pub columns: usize,
    /// The panels, row by row.
    pub panels: Vec<Panel>,
    /// Remarks of the computation, for example a trajectory that was cut off.
    pub notes: Vec<String>,
}

/// One pair of axes.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Panel {
    /// Title.
    pub title: String,
    /// Horizontal axis.
    pub x: Axis,
    /// Vertical axis.
    pub y: Axis,
    /// The curves.
    pub series: Vec<Series>,
}

/// An axis.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Axis {
    /// Label with unit, for example `t (s)`.
    pub label: String,
    /// Logarithmic; the points hold the plain values.
    pub logarithmic: bool,
    /// Fixed limits; `None` for limits that fit the curves.
    pub range: Option<[f64; 2]>,
}

/// What a curve stands for; screens give each role its own stroke.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Role {
    /// True value: solid.
    #[default]
    Truth,
    /// Estimate: dashed.
    Estimate,
    /// Second estimate beside another: dotted.
    Other,
    /// Error: thin and solid.
    Error,
    /// A curve over frequency: solid.
    Response,
}

/// A curve.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Series {
    /// Name in the legend.
    pub name: String,
    /// What it stands for.
    pub role: Role,
    /// Number of its colour: the same quantity has the same number in every plot.
    pub colour: usize,
    /// Points.
    pub points: Vec<[f64; 2]>,
}

impl Panel {
    /// Smallest and largest finite coordinates of all curves: `[x_low, x_high, y_low, y_high]`.
    pub fn bounds(&self) -> Option<[f64; 4]> {
        let points = self.series.iter().flat_map(|series| &series.points);
        let finite = points.filter(|[x, y]| x.is_finite() && y.is_finite());
        finite.fold(None, |bounds, &[x, y]| {
            let [a, b, c, d] = bounds.unwrap_or([x, x, y, y]);
            Some([a.min(x), b.max(x), c.min(y), d.max(y)])
        })
    }
}
