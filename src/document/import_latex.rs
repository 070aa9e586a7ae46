//! Matrices in LaTeX.

use super::import::ImportError;
use super::import_cells::Rows;

/// Commands that are only layout.
const LAYOUT: [&str; 14] = [
    "\\hline",
    "\\left",
    "\\right",
    "\\displaystyle",
    "\\quad",
    "\\,",
    "\\;",
    "\\!",
    "\\:",
    "\\ ",
    "\\big",
    "\\Big",
    "~",
    "$",
];

/// The rows of the first `bmatrix`, `pmatrix`, `array` ... in the text.
pub(super) fn latex_rows(text: &str) -> Result<Rows, ImportError> {
    let text = text.lines().map(uncommented).collect::<Vec<_>>().join("\n");
    let body = match text.split_once("\\begin{") {
        None => text.as_str(),
        Some((_, rest)) => {
            let (environment, rest) = rest.split_once('}').ok_or(ImportError::Bracket { missing: "}" })?;
            let closing = format!("\\end{{{environment}}}");
            let (body, _) = rest.split_once(&closing).ok_or(ImportError::Bracket { missing: "\\end" })?;
            let format = body.trim_start().strip_prefix('{').filter(|_| environment.contains("array"));
            format.and_then(|rest| rest.split_once('}')).map_or(body, |(_, body)| body)
        }
    };
    let mut rows = Rows::new();
    for line in body.split("\\\\") {
        // The extra space of `\\[4pt]`.
        let spaced = line.strip_prefix('[').and_then(|rest| rest.split_once(']'));
        let line = spaced.map_or(line, |(_, line)| line);
        let line = LAYOUT.iter().fold(line.to_owned(), |line, layout| line.replace(layout, " "));
        if !line.trim().is_empty() {
            rows.push(line.split('&').map(expression).collect());
        }
    }
    Ok(rows)
}

/// The line before its comment; `\%` is no comment.
fn uncommented(line: &str) -> &str {
    let mut escaped = false;
    for (place, c) in line.char_indices() {
        if c == '%' && !escaped {
            return &line[..place];
        }
        escaped = c == '\\' && !escaped;
    }
    line
}

/// A cell in the notation of [`crate::expression`].
fn expression(cell: &str) -> String {
    let mut text = cell.split_whitespace().collect::<Vec<_>>().join(" ");
    for product in ["\\cdot", "\\times"] {
        for gap in [" 10^{", "10^{"] {
            text = powers_of_ten(&text, &format!("{product}{gap}"));
        }
        text = text.replace(product, "*");
    }
    for fraction in ["\\frac", "\\dfrac", "\\tfrac"] {
        text = text.replace(&format!("{fraction} "), fraction).replace(fraction, "\\frac");
    }
    text = fractions(text);
    for (theirs, ours) in [("\\sqrt", "sqrt"), ("\\pi", "pi"), ("{", "("), ("}", ")"), ("\\", "")] {
        text = text.replace(theirs, ours);
    }
    text.trim().to_owned()
}

/// `2.5 \cdot 10^{-7}` as `2.5e-7`, which is the same number to the last bit.
fn powers_of_ten(text: &str, marker: &str) -> String {
    let mut rest = text;
    let mut result = String::new();
    while let Some((before, after)) = rest.split_once(marker) {
        let Some((exponent, behind)) = after.split_once('}') else { break };
        let number = before.trim_end().ends_with(|c: char| c.is_ascii_digit());
        if number && exponent.parse::<i32>().is_ok() {
            result.push_str(before.trim_end());
            result.push('e');
            result.push_str(exponent);
        } else {
            result.push_str(before);
            result.push_str(marker);
            result.push_str(exponent);
            result.push('}');
        }
        rest = behind;
    }
    result + rest
}

/// `\frac{a}{b}` as `((a)/(b))`; also `\frac12`.
fn fractions(mut text: String) -> String {
    // From the right, so that inner fractions come first; every pass removes one.
    while let Some(start) = text.rfind("\\frac") {
        let rest = text[start + "\\frac".len()..].to_owned();
        let (numerator, after) = argument(&rest);
        let (denominator, after) = argument(after);
        let simple = |part: &str| part.chars().all(|c| c.is_ascii_digit() || c == '.');
        let alone = matches!(text[..start].trim(), "" | "-") && after.trim().is_empty();
        let bare = alone && simple(numerator) && simple(denominator);
        let quotient = if bare {
            format!("{numerator}/{denominator}")
        } else {
            format!("(({numerator})/({denominator}))")
        };
        text = format!("{}{quotient}{after}", &text[..start]);
        if text.len() > 4_000 {
            break;
        }
    }
    text
}

/// The group in braces, or the single character, that begins the text; and the rest.
fn argument(text: &str) -> (&str, &str) {
    let text = text.trim_start();
    if !text.starts_with('{') {
        let end = text.chars().next().map_or(0, char::len_utf8);
        return text.split_at(end);
    }
    let mut depth = 0_usize;
    for (place, c) in text.char_indices() {
        match c {
            '{' => depth += 1,
            '}' => depth -= 1,
            _ => {}
        }
        if depth == 0 {
            return (&text[1..place], &text[place + 1..]);
        }
    }
    ("", text)
}
