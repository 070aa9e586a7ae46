//! From a source to a checked document and its system.

use super::{Files, Refusal, Source};
use crate::document::limits::MAX_BYTES;
use crate::document::{Document, nearest, read_document};
use crate::paper::{EXAMPLES, Example, example};
use crate::system::Model;

/// A document and the plant that it describes.
#[derive(Debug)]
pub(super) struct Problem {
    pub(super) document: Document,
    pub(super) model: Model,
}

/// Reads a document with the plant as one system.
pub(super) fn load(source: &Source, files: &dyn Files) -> Result<Problem, Refusal> {
    let document = document(source, files)?;
    let model = document.model().map_err(|error| Refusal::bad_input(format!("{}: {error}", name(source))))?;
    Ok(Problem { document, model })
}

/// Reads a document, of a network of any size.
pub(super) fn document(source: &Source, files: &dyn Files) -> Result<Document, Refusal> {
    let name = name(source);
    let text = match source {
        Source::Example(key) => find_example(key)?.text.to_owned(),
        Source::Stdin => text(&name, files.read_stdin(MAX_BYTES + 1))?,
        Source::File(path) => text(&name, files.read(path, MAX_BYTES + 1))?,
    };
    read_document(&text).map_err(|error| Refusal::bad_input(format!("{name}: {error}")))
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
