//! Existence conditions: what is asked, what was found, and why it holds or fails.

use serde::{Deserialize, Serialize};

use super::show;
use crate::numerics::{Complex64, RankDecision};
use crate::system::properties::{ModeCondition, UnobservableMode};

/// Part of a formula: running text, or a block matrix drawn with brackets.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum FormulaPart {
    /// Running text such as `rank` or `= n + rank E`.
    Text(String),
    /// A block matrix, row by row.
    Matrix(Vec<Vec<String>>),
}

/// A formula as the paper writes it, in parts that a screen can draw and [`Self::plain`] can print.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Formula(pub Vec<FormulaPart>);

impl Formula {
    /// Reads `rank [E A; 0 E; 0 C] = n + rank E`: brackets hold blocks, `;` ends a row, spaces part columns.
    pub fn parse(text: &str) -> Self {
        let mut parts = Vec::new();
        let mut rest = text;
        while let Some(open) = rest.find('[') {
            let close = rest[open..].find(']').map_or(rest.len(), |length| open + length);
            push_text(&mut parts, &rest[..open]);
            let rows = rest[open + 1..close].split(';');
            parts.push(FormulaPart::Matrix(
                rows.map(|row| row.split_whitespace().map(str::to_owned).collect()).collect(),
            ));
            rest = rest.get(close + 1..).unwrap_or("");
        }
        push_text(&mut parts, rest);
        Self(parts)
    }

    /// One line of plain text, the inverse of [`Self::parse`].
    pub fn plain(&self) -> String {
        let part = |part: &FormulaPart| match part {
            FormulaPart::Text(text) => text.clone(),
            FormulaPart::Matrix(rows) => {
                format!("[{}]", rows.iter().map(|row| row.join(" ")).collect::<Vec<_>>().join("; "))
            }
        };
        self.0.iter().map(part).collect::<Vec<_>>().join(" ")
    }
}

fn push_text(parts: &mut Vec<FormulaPart>, text: &str) {
    let text = text.trim();
    if !text.is_empty() {
        parts.push(FormulaPart::Text(text.to_owned()));
    }
}

/// How a condition came out.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Verdict {
    /// It holds, with a clear margin.
    Holds,
    /// It holds, but a singular value lies near the threshold: a small change of the data could tip it.
    Fragile,
    /// It does not hold.
    Fails,
    /// It cannot be asked, because something it builds on fails; the summary says what.
    Undecided,
}

impl Verdict {
    /// The verdict of a test that came out as `holds`, on evidence that is fragile or not.
    pub fn of(holds: bool, fragile: bool) -> Self {
        match (holds, fragile) {
            (true, false) => Self::Holds,
            (true, true) => Self::Fragile,
            (false, _) => Self::Fails,
        }
    }

    /// Holds, clearly or narrowly.
    pub fn holds(self) -> bool {
        matches!(self, Self::Holds | Self::Fragile)
    }
}

/// One piece of evidence for a verdict.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum Evidence {
    /// A rank that was found beside the rank that is required.
    Rank {
        /// The matrix in words or letters.
        of: String,
        /// The decision with its singular values.
        decision: RankDecision,
        /// The required rank.
        required: usize,
    },
    /// The finite points at which a pencil loses rank, or the unobservable modes of a pair.
    Points {
        /// The pencil or pair in letters.
        of: String,
        /// The points, each with its relative distance `sigma_min` and whether it is in the stable region.
        points: Vec<PointEvidence>,
    },
    /// Elements, each with the set that belongs to it.
    Sets {
        /// What the sets are, in words.
        of: String,
        /// Letters of the element, of its set, and of the space that belongs to it.
        names: [String; 3],
        /// The elements with their sets.
        sets: Vec<SetEvidence>,
    },
}

impl Evidence {
    /// A rank beside the one that is required.
    pub(super) fn rank(of: &str, decision: RankDecision, required: usize) -> Self {
        Self::Rank { of: of.to_owned(), decision, required }
    }
}

/// One finite point of a pencil or mode of a pair.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PointEvidence {
    /// The point s.
    pub s: Complex64,
    /// How often it occurs.
    pub multiplicity: usize,
    /// Smallest singular value there, relative to the data.
    pub distance: f64,
    /// Whether rank is lost there.
    pub loses_rank: bool,
    /// Whether it lies inside the stability region.
    pub stable: bool,
}

/// An element with the set that belongs to it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SetEvidence {
    /// The element.
    pub element: Complex64,
    /// The members of its set.
    pub members: Vec<Complex64>,
    /// Dimension of the space that belongs to it.
    pub dimension: usize,
}

/// A direction that shows why a condition fails.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Witness {
    /// The s at which the direction goes unseen; `None` for an impulsive direction.
    pub s: Option<Complex64>,
    /// The direction in the coordinates named by `coordinates`, largest entry 1.
    pub direction: Vec<Complex64>,
    /// Names of the coordinates: `x1, x2, ...` and, behind the states, `d1, ...`.
    pub coordinates: Vec<String>,
}

impl Witness {
    /// Coordinates with an entry of at least a tenth of the largest, largest first.
    pub fn main_coordinates(&self) -> Vec<&str> {
        let mut order: Vec<usize> = (0..self.direction.len()).collect();
        order.sort_by(|&i, &j| self.direction[j].norm().total_cmp(&self.direction[i].norm()));
        let main = order.into_iter().filter(|&i| self.direction[i].norm() >= 0.1);
        main.filter_map(|i| self.coordinates.get(i).map(String::as_str)).collect()
    }
}

/// An existence condition with its evidence.
///
/// # Source
/// `source` names the paper and the equation; `formula` is in the paper's letters.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Condition {
    /// Stable identifier, `paper-equation`, for example `004-9`.
    pub id: String,
    /// The number as the paper prints it, for example `(9)`.
    pub label: String,
    /// What the condition is called.
    pub name: String,
    /// The statement as the paper writes it.
    pub formula: Formula,
    /// Paper and equation.
    pub source: String,
    /// How it came out.
    pub verdict: Verdict,
    /// One sentence with the numbers.
    pub summary: String,
    /// What it was decided on.
    pub evidence: Vec<Evidence>,
    /// Why it fails.
    pub witness: Option<Witness>,
    /// What would restore it, one sentence each.
    pub remedies: Vec<String>,
    /// Whether the chosen design needs it.
    pub needed: bool,
}

impl Condition {
    /// A condition that is asked and not decided yet; the design needs it.
    pub(super) fn asked((id, label): (String, &str), name: &str, formula: &str, source: String) -> Self {
        Self {
            id,
            label: label.to_owned(),
            name: name.to_owned(),
            formula: Formula::parse(formula),
            source,
            verdict: Verdict::Undecided,
            summary: String::new(),
            evidence: Vec::new(),
            witness: None,
            remedies: Vec::new(),
            needed: true,
        }
    }

    /// Decides on the points at which the pencil `of` loses rank; `harmless` says what it means that all of them decay.
    pub(super) fn decide_on_modes(
        &mut self,
        found: &ModeCondition,
        of: &str,
        coordinates: Vec<String>,
        harmless: impl FnOnce(&[UnobservableMode]) -> String,
    ) {
        self.verdict = Verdict::of(found.holds(), found.fragile());
        let violation = found.violations().next();
        self.summary = match (&found.free_direction, violation) {
            (Some(_), _) => format!("rank {} < {} for every s", found.normal_rank, found.needed),
            (None, Some(mode)) => format!("rank is lost at s = {}, which is not stable", show(mode.s)),
            (None, None) => harmless(&found.modes),
        };
        let direction = match (&found.free_direction, violation) {
            (Some(free), _) => Some((None, free.iter().map(|x| Complex64::from(*x)).collect())),
            (None, Some(mode)) => Some((Some(mode.s), mode.direction.clone())),
            (None, None) => None,
        };
        self.witness = direction.map(|(s, direction)| Witness { s, direction, coordinates });
        let points = found.modes.iter().map(|mode| PointEvidence {
            s: mode.s,
            multiplicity: mode.multiplicity,
            distance: mode.sigma,
            loses_rank: true,
            stable: found.region.contains(mode.s, found.margin),
        });
        self.evidence.push(Evidence::Points { of: of.to_owned(), points: points.collect() });
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_formula_reads_back_as_it_was_written() {
        let text = "rank [E* A*; 0 E*; 0 C*] = n + rank E*";
        let formula = Formula::parse(text);
        assert_eq!(formula.0.len(), 3, "text, matrix, text");
        assert_eq!(formula.plain(), text, "plain is the inverse of parse");
    }

    #[test]
    fn an_open_bracket_does_not_panic() {
        assert_eq!(Formula::parse("rank [E").plain(), "rank [E]", "the missing bracket is closed");
    }

    #[test]
    fn fragile_still_holds() {
        assert!(Verdict::of(true, true).holds(), "fragile is a warning, not a refusal");
        assert_eq!(Verdict::of(false, true), Verdict::Fails, "a failure is a failure");
    }
}
