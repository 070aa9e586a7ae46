//! The lines of a comparison's table.

use super::best::{Better, mark};
use super::{ComparisonTable, Group, LineKind, TableCell, TableLine};
use crate::numerics::Complex64;
use crate::observer::{DesignError, ErrorGain, ErrorGains, show};
use crate::simulation::comparison::{ComparedDesign, Comparison, ComparisonRow, ErrorSize, ScenarioErrors};

/// States and unknown inputs that have a line of their own at most.
const MOST_EACH: usize = 40;

/// The table of a comparison.
pub fn comparison_table(comparison: &Comparison) -> ComparisonTable {
    let rows = &comparison.rows;
    let mut lines = vec![status(rows)];
    lines.extend(design_lines(rows));
    lines.extend(estimates(rows));
    lines.extend(gain_lines(rows));
    lines.extend(norm_lines(rows));
    lines.extend(scenario_lines(rows));
    lines.extend(each_lines(rows));
    let designs = rows.iter().map(|row| row.name.clone()).collect();
    ComparisonTable { designs, lines, linear_part: comparison.linear_part }
}

/// A number with three significant digits.
pub(super) fn digits(value: f64) -> String {
    let rounded: f64 = format!("{value:.2e}").parse().unwrap_or(value);
    if value != 0.0 && !(1e-3..1e5).contains(&value.abs()) {
        format!("{value:.2e}")
    } else {
        format!("{rounded}")
    }
}

fn number(value: f64) -> TableCell {
    TableCell { text: digits(value), value: Some(value), ..TableCell::default() }
}

fn words(text: impl Into<String>) -> TableCell {
    TableCell { text: text.into(), ..TableCell::default() }
}

/// A line with a cell for each design that exists.
fn line(
    (label, meaning, group): (&str, &str, Group),
    rows: &[ComparisonRow],
    better: Better,
    cell: impl Fn(&ComparedDesign) -> TableCell,
) -> TableLine {
    let cells = rows.iter().map(|row| row.outcome.as_ref().map_or_else(|_| words("-"), &cell));
    let mut cells: Vec<TableCell> = cells.collect();
    mark(&mut cells, rows, better);
    TableLine { label: label.to_owned(), meaning: meaning.to_owned(), group, kind: LineKind::Value, cells }
}

/// Whether each design exists and is verified; the reason in the hint.
fn status(rows: &[ComparisonRow]) -> TableLine {
    let cell = |row: &ComparisonRow| match &row.outcome {
        Ok(design) if design.verified => words("verified"),
        Ok(_) => words("not verified"),
        Err(error) => {
            let word = match error {
                DesignError::TooFewPoles { .. } | DesignError::Poles(_) => "poles needed",
                DesignError::Demand(_) => "demand does not fit",
                DesignError::Condition { .. } => "does not exist",
                DesignError::Unsuitable(_) => "not for this system",
                DesignError::Infeasible(_) => "infeasible",
                DesignError::Cancelled => "cancelled",
                DesignError::GaveUp(_) | DesignError::Numerics(_) => "not decided",
            };
            TableCell { text: word.to_owned(), hint: error.to_string(), ..TableCell::default() }
        }
    };
    TableLine {
        label: "Status".to_owned(),
        meaning: "Whether the design exists and every check of it was passed".to_owned(),
        group: Group::Design,
        kind: LineKind::Status,
        cells: rows.iter().map(cell).collect(),
    }
}

fn design_lines(rows: &[ComparisonRow]) -> Vec<TableLine> {
    let of = |label, meaning, better, cell: &dyn Fn(&ComparedDesign) -> TableCell| {
        line((label, meaning, Group::Design), rows, better, cell)
    };
    let modes = |modes: &[Complex64]| {
        let shown: Vec<String> = modes.iter().map(|mode| show(*mode)).collect();
        words(if shown.is_empty() { "none".to_owned() } else { shown.join(", ") })
    };
    let method = of("Method", "Method and order in words", Better::Neither, &|d| words(&d.title));
    let spectrum =
        of("Spectrum", "Eigenvalues of the error dynamics", Better::Neither, &|d| modes(&d.spectrum));
    let rows = [
        TableLine { kind: LineKind::Method, ..method },
        of("Order", "Number of the observer's own states", Better::Smaller, &|d| number(d.order as f64)),
        of(
            "Slowest mode",
            "The eigenvalue of the error nearest to the boundary of stability",
            Better::Neither,
            &|d| d.slowest.map_or_else(|| words("none"), |mode| words(show(mode))),
        ),
        of(
            "Decay",
            "Distance of the slowest mode from the boundary of stability: -Re s, or 1 - |z| in discrete time",
            Better::Larger,
            &|d| d.margin.map_or_else(|| words("at once"), number),
        ),
        TableLine { kind: LineKind::Spectrum, ..spectrum },
        of("Fixed modes", "Modes that no gain can move", Better::Neither, &|d| modes(&d.fixed_modes)),
    ];
    rows.into()
}

/// How many states each design estimates, when not every design estimates all.
fn estimates(rows: &[ComparisonRow]) -> Option<TableLine> {
    let designs = || rows.iter().filter_map(|row| row.outcome.as_ref().ok());
    let partial = designs().any(|design| design.estimated.len() < design.states);
    let meaning = "The plant's states whose estimate tends to the truth; errors are those of these states, and \
                   designs that estimate different ones are not ranked by them";
    partial.then(|| {
        line(("Estimates", meaning, Group::Design), rows, Better::Neither, |design| {
            let (found, of) = (design.estimated.len(), design.states);
            words(match found {
                0 => format!("none of {of} states"),
                _ if found == of => "all states".to_owned(),
                _ => format!("{found} of {of} states"),
            })
        })
    })
}

/// Norms of gains. Of these only `|V|` is the same in any coordinates of the observer's states, and the same thing for
/// every method: the others are not ranked.
fn gain_lines(rows: &[ComparisonRow]) -> [TableLine; 3] {
    let of = |label, meaning, better, cell: &dyn Fn(&ComparedDesign) -> TableCell| {
        line((label, meaning, Group::Gains), rows, better, cell)
    };
    [
        of(
            "|L|",
            "Largest gain from the outputs into the observer's states, in the coordinates that the design has",
            Better::Neither,
            &|d| number(d.output_gain),
        ),
        of("|V|", "Largest gain from the outputs to the estimate at once", Better::Smaller, &|d| {
            number(d.direct_gain)
        }),
        of(
            "Chosen gain",
            "Norm of what the placement or the matrix inequalities chose, which is another matrix for each method",
            Better::Neither,
            &|d| number(d.chosen_gain),
        ),
    ]
}

fn norm_lines(rows: &[ComparisonRow]) -> Vec<TableLine> {
    let of = |label, meaning, better, gain: fn(&ErrorGains) -> &ErrorGain| {
        line((label, meaning, Group::Norms), rows, better, |d| gain_cell(gain(&d.gains)))
    };
    let (states, input) = (Better::SmallerOfSameStates, Better::Smaller);
    let mut lines = vec![
        of("d to e", "Largest gain from the unknown input to the error of the states", states, |g| &g.d_to_e),
        of("d to e_d", "Largest gain from the unknown input to the error of its own estimate", input, |g| {
            &g.d_to_e_d
        }),
        of("noise to e", "Largest gain from measurement noise to the error of the states", states, |g| {
            &g.w_to_e
        }),
        of(
            "noise to e_d",
            "Largest gain from measurement noise to the error of the unknown input",
            input,
            |g| &g.w_to_e_d,
        ),
    ];
    let any = rows.iter().any(|row| row.outcome.as_ref().is_ok_and(|design| design.guaranteed.is_some()));
    if any {
        let meaning =
            "Proved bound of the gain from d (or from what is attenuated) to e, nonlinearity included";
        let better = Better::SmallerOfSameMethod;
        lines.push(line(("Guaranteed gamma", meaning, Group::Norms), rows, better, |d| {
            d.guaranteed.map_or_else(|| words("no guarantee"), number)
        }));
    }
    lines
}

fn gain_cell(gain: &ErrorGain) -> TableCell {
    match gain {
        ErrorGain::Norm(found) => {
            let at = match found.frequency {
                0.0 => "largest at frequency 0".to_owned(),
                f if f.is_finite() => format!("largest at {} rad/s (discrete time: rad/step)", digits(f)),
                _ => "largest at infinite frequency".to_owned(),
            };
            TableCell { hint: at, ..number(found.norm) }
        }
        ErrorGain::Decoupled => TableCell {
            value: Some(0.0),
            hint: "zero but for the rounding of the design".to_owned(),
            ..words("0, decoupled")
        },
        ErrorGain::NotEstimated => words("not estimated"),
        ErrorGain::NoInput => words("no input"),
        ErrorGain::NotFinite(why) => TableCell { hint: why.clone(), ..words("not finite") },
        ErrorGain::NotComputed(why) => TableCell { hint: why.clone(), ..words("not known") },
    }
}

fn scenario_lines(rows: &[ComparisonRow]) -> Vec<TableLine> {
    type Of = fn(&ErrorSize) -> f64;
    let sizes: [(&str, &str, Of); 4] = [
        ("rms of", "Root mean square over the second half of the horizon", |size| size.late_rms),
        ("largest of", "Largest absolute value over the second half of the horizon", |size| {
            size.late_largest
        }),
        ("rms of, whole", "Root mean square over the whole horizon", |size| size.rms),
        ("largest of, whole", "Largest absolute value over the whole horizon", |size| size.largest),
    ];
    let mut lines = Vec::new();
    for (letter, unknown, better) in
        [("e", false, Better::SmallerOfSameStates), ("e_d", true, Better::Smaller)]
    {
        for (label, meaning, of) in sizes {
            let label = label.replacen("of", letter, 1);
            let cell = |errors: &ScenarioErrors| {
                let size = if unknown { errors.all_unknown } else { errors.all_states };
                size.map_or_else(|| words("not estimated"), |size| number(of(&size)))
            };
            lines.push(line((&label, meaning, Group::Scenario), rows, better, |d| simulated(d, cell)));
        }
    }
    lines
}

/// One line for each state that some design estimates, and for each unknown input.
fn each_lines(rows: &[ComparisonRow]) -> Vec<TableLine> {
    let errors = || rows.iter().filter_map(|row| row.outcome.as_ref().ok()?.scenario.as_ref().ok());
    let most = errors().map(|errors| errors.states.len()).max().unwrap_or(0);
    let estimated = |i: &usize| errors().any(|errors| errors.states.get(*i).is_some_and(Option::is_some));
    let states = (0..most).filter(estimated).take(MOST_EACH);
    let unknown = errors().map(|errors| errors.unknown.len()).max().unwrap_or(0).min(MOST_EACH);
    let meaning = "Root mean square over the second half of the horizon";
    let state = |i: usize| {
        let cell = |errors: &ScenarioErrors| {
            let size = errors.states.get(i).copied().flatten();
            size.map_or_else(|| words("not estimated"), |size| number(size.late_rms))
        };
        let label = format!("rms e{}", i + 1);
        line((&label, meaning, Group::Each), rows, Better::Smaller, |d| simulated(d, cell))
    };
    let input = |i: usize| {
        let cell = |errors: &ScenarioErrors| {
            errors.unknown.get(i).map_or_else(|| words("not estimated"), |size| number(size.late_rms))
        };
        let label = format!("rms e_d{}", i + 1);
        line((&label, meaning, Group::Each), rows, Better::Smaller, |d| simulated(d, cell))
    };
    states.map(state).chain((0..unknown).map(input)).collect()
}

fn simulated(design: &ComparedDesign, cell: impl Fn(&ScenarioErrors) -> TableCell) -> TableCell {
    match &design.scenario {
        Ok(errors) => cell(errors),
        Err(why) => TableCell { hint: why.clone(), ..words("none") },
    }
}
