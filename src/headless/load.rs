//! From a source to a checked document and its system.

use super::{Files, Refusal, Source};
use crate::document::limits::MAX_BYTES;
use crate::document::{Document, Subject, nearest, read_document};
use crate::paper::{EXAMPLES, Example, example};

/// A document and the plant that it describes.
#[derive(Debug)]
pub(super) struct Problem {
    pub(super) document: Document,
    pub(super) subject: Subject,
}

/// Reads a document.
pub(super) fn load(source: &Source, files: &dyn Files) -> Result<Problem, Refusal> {
    let name = name(source);
    let text = match source {
        Source::Example(key) => find_example(key)?.text.to_owned(),
        Source::Stdin => text(&name, files.read_stdin(MAX_BYTES + 1))?,
        Source::File(path) => text(&name, files.read(path, MAX_BYTES + 1))?,
    };
    let at = |error: &dyn std::fmt::Display| Refusal::bad_input(format!("{name}: {error}"));
    let document = read_document(&text).map_err(|error| at(&error))?;
    let subject = document.subject().map_err(|error| at(&error))?;
    Ok(Problem { document, subject })
}

/// The example with that key.
pub(super) fn find_example(key: &str) -> Result<&'static Example, Refusal> {
    example(key).ok_or_else(|| {
        let keys: Vec<&str> = EXAMPLES.iter().map(|example| example.key).collect();
        let hint = nearest(key, &keys).map_or(String::new(), |near| format!("; did you mean \"{near}\"?"));
        Refusal::bad_input(format!("there is no example \"{key}\": the keys are {}{hint}", keys.join(", ")))
    })
}

/// The source as people call it.
fn name(source: &Source) -> String {
    match source {
        Source::Stdin => "standard input".to_owned(),
        Source::Example(key) => format!("example:{key}"),
        Source::File(path) => path.display().to_string(),
    }
}

fn text(name: &str, read: std::io::Result<Vec<u8>>) -> Result<String, Refusal> {
    let bytes = read.map_err(|error| Refusal::bad_input(format!("{name} cannot be read: {error}")))?;
    if bytes.len() > MAX_BYTES {
        return Err(Refusal::bad_input(format!("{name} has more than the {MAX_BYTES} bytes that are read")));
    }
    let text = String::from_utf8(bytes).map_err(|error| {
        let at = error.utf8_error().valid_up_to();
        Refusal::bad_input(format!("{name} is not UTF-8 text (byte {at}); save it as UTF-8"))
    })?;
    Ok(text.strip_prefix('\u{feff}').map_or(text.clone(), str::to_owned))
}
