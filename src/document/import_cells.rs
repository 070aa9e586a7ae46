//! From the text of a matrix to the texts of its entries.

use super::import::{ImportError, MAX_SIDE};

/// Texts of the entries, row by row.
pub(super) type Rows = Vec<Vec<String>>;

fn push_row(rows: &mut Rows, row: Vec<String>) -> Result<(), ImportError> {
    if row.len() > MAX_SIDE || rows.len() >= MAX_SIDE {
        return Err(ImportError::TooLarge);
    }
    if !row.is_empty() {
        rows.push(row);
    }
    Ok(())
}

/// Rows between semicolons or line ends, as in `[1 2; 3 4]`; empty rows are left out.
pub(super) fn bracket_rows(inside: &str) -> Result<Rows, ImportError> {
    let mut rows = Rows::new();
    for line in inside.split([';', '\n']) {
        push_row(&mut rows, row_entries(line))?;
    }
    Ok(rows)
}

/// Rows in brackets of their own, as in `[1, 2], [3, 4]`.
pub(super) fn nested_rows(inside: &str) -> Result<Rows, ImportError> {
    let mut rows = Rows::new();
    let (mut depth, mut row) = (0_usize, String::new());
    for c in inside.chars() {
        match c {
            '[' | '{' => {
                depth += 1;
                if depth > 1 {
                    row.push(c);
                }
            }
            ']' | '}' => {
                depth = depth.saturating_sub(1);
                if depth == 0 {
                    let line = std::mem::take(&mut row).replace(['\n', ';'], " ");
                    push_row(&mut rows, row_entries(&line))?;
                } else {
                    row.push(c);
                }
            }
            _ if depth > 0 => row.push(c),
            _ if c.is_whitespace() || matches!(c, ',' | ';') => {}
            _ => return Err(ImportError::Beside { text: c.to_string() }),
        }
    }
    Ok(rows)
}

/// Entries of one row, between commas or spaces: `1 -2` is two entries, `1 - 2` is one.
///
/// Nothing between two commas is an empty entry; nothing after the last comma is none.
fn row_entries(line: &str) -> Vec<String> {
    let characters: Vec<char> = line.chars().collect();
    let mut row = Vec::new();
    let (mut entry, mut depth, mut after_comma) = (String::new(), 0_usize, true);
    for (place, &c) in characters.iter().enumerate() {
        match c {
            '(' | '[' | '{' => depth += 1,
            ')' | ']' | '}' => depth = depth.saturating_sub(1),
            _ => {}
        }
        // Of several spaces the first decides.
        if c.is_whitespace() && place > 0 && characters[place - 1].is_whitespace() {
            continue;
        }
        let comma = depth == 0 && c == ',';
        let space = depth == 0 && c.is_whitespace() && separates(&entry, &characters[place..]);
        if !comma && !space {
            entry.push(c);
            continue;
        }
        if !entry.trim().is_empty() || (comma && after_comma) {
            row.push(entry.trim().to_owned());
        }
        entry.clear();
        after_comma = comma;
    }
    if !entry.trim().is_empty() {
        row.push(entry.trim().to_owned());
    }
    row
}

/// Whether the space that begins `rest` ends the entry before it.
fn separates(entry: &str, rest: &[char]) -> bool {
    let operator = |c: char| "*/^<>=&|\u{b7}\u{d7}\u{22c5}".contains(c);
    let sign = |c: char| matches!(c, '+' | '-' | '\u{2212}');
    let Some(last) = entry.trim_end().chars().last() else { return false };
    if operator(last) || sign(last) {
        return false;
    }
    let mut following = rest.iter().copied().skip_while(|c| c.is_whitespace());
    let (Some(first), second) = (following.next(), following.next()) else { return false };
    if sign(first) {
        return second.is_some_and(|c| !c.is_whitespace());
    }
    !(operator(first) || first == '.' && second.is_some_and(operator))
}

/// Lines of cells without brackets: from a spreadsheet, a CSV file, a terminal.
pub(super) fn delimited_rows(text: &str) -> Result<Rows, ImportError> {
    let lines: Vec<&str> = text.lines().filter(|line| !line.trim().is_empty()).collect();
    let mut rows = Rows::new();
    if text.contains('\t') {
        for line in lines {
            push_row(&mut rows, cells(line, '\t'))?;
        }
    } else if is_semicolon_separated(&lines) {
        for line in lines {
            push_row(&mut rows, cells(line.trim_end().trim_end_matches(';'), ';'))?;
        }
    } else if text.contains('"') {
        for line in lines {
            push_row(&mut rows, cells(line, ','))?;
        }
    } else {
        return bracket_rows(text);
    }
    Ok(rows)
}

/// `1;2` and `1,5;2,5`, but neither `1 2; 3 4` nor lines that end in a semicolon.
fn is_semicolon_separated(lines: &[&str]) -> bool {
    let within = lines.iter().any(|line| line.trim_end().trim_end_matches(';').contains(';'));
    let single = |cell: &str| {
        let cell = cell.trim();
        row_entries(cell).len() <= 1 || decimal_comma(cell).is_some()
    };
    within && lines.iter().all(|line| line.split(';').all(single))
}

/// The cells of a line, without the quotes around them, decimal commas made points unless commas separate.
fn cells(line: &str, separator: char) -> Vec<String> {
    let (mut row, mut cell, mut quoted) = (Vec::new(), String::new(), false);
    for c in line.chars().chain([separator]) {
        if c == '"' {
            quoted = !quoted;
        } else if c == separator && !quoted {
            let text = std::mem::take(&mut cell);
            let text = text.trim();
            row.push(decimal_comma(text).unwrap_or_else(|| text.to_owned()));
        } else {
            cell.push(c);
        }
    }
    if !cell.is_empty() {
        let text = cell.trim_end_matches(separator).trim();
        row.push(decimal_comma(text).unwrap_or_else(|| text.to_owned()));
    }
    row
}

/// `-1,5e3` as `-1.5e3`; `None` for anything else.
fn decimal_comma(cell: &str) -> Option<String> {
    let unsigned = cell.trim_start_matches(['-', '+', '\u{2212}']);
    let (whole, rest) = unsigned.split_once(',')?;
    let digits = |text: &str| !text.is_empty() && text.chars().all(|c| c.is_ascii_digit());
    let (fraction, exponent) = rest.split_once(['e', 'E']).map_or((rest, "0"), |(f, e)| (f, e));
    let exponent = exponent.trim_start_matches(['-', '+']);
    (digits(whole) && digits(fraction) && digits(exponent)).then(|| cell.replacen(',', ".", 1))
}
