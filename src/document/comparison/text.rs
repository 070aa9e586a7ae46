//! A comparison's table as Markdown and CSV.

use super::{ComparisonTable, Group, TableCell, TableLine, comparison_table};
use crate::document::export_csv::quoted;
use crate::simulation::comparison::Comparison;

/// The table as Markdown: a column for each design, the best value of a line in bold.
pub fn comparison_to_markdown(comparison: &Comparison) -> String {
    let table = comparison_table(comparison);
    let mut text = markdown_row(std::iter::once("").chain(table.designs.iter().map(String::as_str)));
    text.extend(["|", &" --- |".repeat(table.designs.len() + 1), "\n"]);
    for group in Group::ALL {
        let lines: Vec<&TableLine> = table.lines.iter().filter(|line| line.group == group).collect();
        if lines.is_empty() {
            continue;
        }
        let heading = format!("**{}**", table.heading(group));
        text.push_str(&markdown_row(
            std::iter::once(heading.as_str()).chain(table.designs.iter().map(|_| "")),
        ));
        for line in lines {
            let cells: Vec<String> = line.cells.iter().map(markdown_cell).collect();
            let row = std::iter::once(line.label.as_str()).chain(cells.iter().map(String::as_str));
            text.push_str(&markdown_row(row));
        }
    }
    let notes = reasons(&table).into_iter().chain(comparison.notes.iter().cloned());
    for note in notes {
        text.extend(["\n- ", &note.replace('\n', " "), "\n"]);
    }
    text
}

/// Why designs do not exist, or have no value, each reason once.
fn reasons(table: &ComparisonTable) -> Vec<String> {
    let mut reasons: Vec<String> = Vec::new();
    for line in &table.lines {
        for (design, cell) in table.designs.iter().zip(&line.cells) {
            let reason = format!("{design}: {}", cell.hint);
            if cell.value.is_none() && !cell.hint.is_empty() && !reasons.contains(&reason) {
                reasons.push(reason);
            }
        }
    }
    reasons
}

fn markdown_cell(cell: &TableCell) -> String {
    if cell.best { format!("**{}**", cell.text) } else { cell.text.clone() }
}

/// A row; a bar within a cell would end it.
fn markdown_row<'a>(cells: impl Iterator<Item = &'a str>) -> String {
    let cells: Vec<String> =
        cells.map(|cell| cell.replace('\\', "\\\\").replace('|', "\\|").replace('\n', " ")).collect();
    format!("| {} |\n", cells.join(" | "))
}

/// The table as CSV (RFC 4180): a column for each design, numbers to the last digit.
pub fn comparison_to_csv(comparison: &Comparison) -> String {
    let table = comparison_table(comparison);
    let mut rows: Vec<Vec<String>> =
        vec![std::iter::once("quantity".to_owned()).chain(table.designs.iter().cloned()).collect()];
    for line in &table.lines {
        let cell = |cell: &TableCell| match cell.value {
            Some(value) => value.to_string(),
            None if cell.hint.is_empty() => cell.text.clone(),
            None => format!("{}: {}", cell.text, cell.hint),
        };
        rows.push(std::iter::once(line.label.clone()).chain(line.cells.iter().map(cell)).collect());
    }
    let row = |row: &Vec<String>| {
        let fields: Vec<String> = row.iter().map(|field| quoted(field)).collect();
        format!("{}\n", fields.join(","))
    };
    rows.iter().map(row).collect()
}
