//! The table of a comparison as cells of text, and as Markdown and CSV.

mod best;
mod lines;
mod text;

pub use lines::comparison_table;
pub use text::{comparison_to_csv, comparison_to_markdown};

/// A comparison, one column for each design, one line for each quantity.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ComparisonTable {
    /// Names of the designs.
    pub designs: Vec<String>,
    /// The quantities.
    pub lines: Vec<TableLine>,
    /// Whether the plant has a nonlinearity that the norms of the error leave out.
    pub linear_part: bool,
}

impl ComparisonTable {
    /// The heading of a part.
    pub fn heading(&self, group: Group) -> String {
        if self.linear_part && group == Group::Norms {
            format!("{}, linear part alone", group.title())
        } else {
            group.title().to_owned()
        }
    }
}

/// One quantity of all designs.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct TableLine {
    /// Its name.
    pub label: String,
    /// What it is, one sentence.
    pub meaning: String,
    /// To which part of the table it belongs.
    pub group: Group,
    /// How its cells are to be read.
    pub kind: LineKind,
    /// A cell for each design.
    pub cells: Vec<TableCell>,
}

/// How the cells of a line are to be read.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum LineKind {
    /// A number or a few words.
    #[default]
    Value,
    /// Whether the design exists and is verified.
    Status,
    /// A sentence.
    Method,
    /// Eigenvalues, which a picture says better.
    Spectrum,
}

/// Parts of the table.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Group {
    /// What the design is.
    #[default]
    Design,
    /// Norms of its gains.
    Gains,
    /// H-infinity norms of its error.
    Norms,
    /// Errors of the scenario.
    Scenario,
    /// Errors of each state and unknown input.
    Each,
}

impl Group {
    /// All, in the order of the table.
    pub const ALL: [Self; 5] = [Self::Design, Self::Gains, Self::Norms, Self::Scenario, Self::Each];

    /// The heading.
    pub fn title(self) -> &'static str {
        match self {
            Self::Design => "Design",
            Self::Gains => "Norms of gains",
            Self::Norms => "H-infinity norms of the error",
            Self::Scenario => "Errors in the scenario",
            Self::Each => "Root mean square errors one by one, second half",
        }
    }
}

/// What a design has of a quantity.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct TableCell {
    /// The value with three significant digits, or words.
    pub text: String,
    /// The value itself, where it is a number.
    pub value: Option<f64>,
    /// What else is to be said: where a peak lies, why there is no value.
    pub hint: String,
    /// Whether no other verified design does better.
    pub best: bool,
}
