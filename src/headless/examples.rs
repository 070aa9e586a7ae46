//! `examples`: the list, or one of them.

use std::path::Path;

use super::load::find_example;
use super::{Answer, Files, Refusal};
use crate::paper::EXAMPLES;

/// Lists the examples, or writes one out.
pub(super) fn examples(key: Option<&str>, out: Option<&Path>, files: &dyn Files) -> Result<Answer, Refusal> {
    let Some(key) = key else { return Ok(Answer { text: table(), ..Answer::default() }) };
    let example = find_example(key)?;
    let Some(path) = out else { return Ok(Answer { text: example.text.to_owned(), ..Answer::default() }) };
    files
        .write(path, example.text.as_bytes())
        .map_err(|error| Refusal::bad_input(format!("{} cannot be written: {error}", path.display())))?;
    Ok(Answer::default())
}

fn table() -> String {
    let wide = EXAMPLES.iter().map(|example| example.key.len()).max().unwrap_or(0);
    let line = |example: &crate::paper::Example| {
        format!("{:wide$}  {}\n{:wide$}  {}\n", example.key, example.title, "", example.teaches)
    };
    EXAMPLES.iter().map(line).collect()
}
