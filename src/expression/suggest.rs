//! What a misspelt name was meant to be.

use super::function::FUNCTIONS;

/// Names of other programs and languages.
const FOREIGN: [(&str, &str); 20] = [
    ("e", "write exp(1)"),
    ("arcsin", "did you mean `asin`?"),
    ("arccos", "did you mean `acos`?"),
    ("arctan", "did you mean `atan`?"),
    ("arctan2", "did you mean `atan2`?"),
    ("tg", "did you mean `tan`?"),
    ("lg", "did you mean `log10`?"),
    ("log2", "write log(x)/log(2)"),
    ("sgn", "did you mean `sign`?"),
    ("heaviside", "did you mean `step`?"),
    ("fabs", "did you mean `abs`?"),
    ("rem", "did you mean `mod`?"),
    ("fix", "did you mean `floor`?"),
    ("rand", "did you mean `noise(x, seed)`?"),
    ("randn", "did you mean `noise(x, seed)`?"),
    ("inf", "only finite numbers are possible"),
    ("nan", "only finite numbers are possible"),
    ("i", "only real numbers are possible"),
    ("j", "only real numbers are possible"),
    ("infinity", "only finite numbers are possible"),
];

/// "did you mean ...?", or the names that are known.
pub(super) fn suggestion(name: &str, variables: &[&str]) -> String {
    let lower = name.to_lowercase();
    if let Some((_, hint)) = FOREIGN.iter().find(|(foreign, _)| *foreign == lower) {
        return (*hint).to_owned();
    }
    let known = variables.iter().copied().chain(FUNCTIONS.iter().map(|function| function.name));
    let near = known
        .map(|candidate| (distance(&lower, &candidate.to_lowercase()), candidate))
        .filter(|(changes, candidate)| changes * 3 <= candidate.chars().count())
        .min_by_key(|(changes, _)| *changes);
    if let Some((_, candidate)) = near {
        return format!("did you mean `{candidate}`?");
    }
    if variables.is_empty() {
        return "write a number, such as -1/3 or sqrt(2)".to_owned();
    }
    let (shown, rest) = variables.split_at(variables.len().min(8));
    let more = if rest.is_empty() { "" } else { ", ..." };
    format!("the variables are {}{more}", shown.join(", "))
}

/// Levenshtein's distance, swapped neighbours counting once; a large number for long names.
fn distance(a: &str, b: &str) -> usize {
    let (a, b): (Vec<char>, Vec<char>) = (a.chars().collect(), b.chars().collect());
    if a.len().abs_diff(b.len()) > 4 {
        return usize::MAX / 4;
    }
    let mut rows = vec![(0..=b.len()).collect::<Vec<usize>>()];
    for i in 1..=a.len() {
        let mut row = vec![i; b.len() + 1];
        for j in 1..=b.len() {
            let above = &rows[i - 1];
            let replaced = above[j - 1] + usize::from(a[i - 1] != b[j - 1]);
            row[j] = replaced.min(above[j] + 1).min(row[j - 1] + 1);
            if i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1] {
                row[j] = row[j].min(rows[i - 2][j - 2] + 1);
            }
        }
        rows.push(row);
    }
    rows.last().and_then(|row| row.last()).copied().unwrap_or(0)
}
