//! From arguments to a request.

use std::ffi::OsString;
use std::path::PathBuf;

use lexopt::Arg::{Long, Short, Value};
use lexopt::{Parser, ValueExt as _};

use crate::document::nearest;
use crate::headless::{Format, Request, Source, TableFormat};

const COMMANDS: [&str; 8] =
    ["check", "design", "simulate", "compare", "figures", "examples", "errata", "help"];

/// What stands on the command line, before it is put together.
#[derive(Default)]
struct Given {
    values: Vec<OsString>,
    format: Option<String>,
    out: Option<PathBuf>,
    only: Option<String>,
    help: bool,
    version: bool,
}

/// The document that the window is to open: the only argument, when it names a file and no command.
///
/// A file is meant by a name with a folder or ending in `.json`; any other word is left to [`parse`], which knows the
/// commands and proposes one for a mistyped word.
pub fn document_to_open(arguments: &[OsString]) -> Option<PathBuf> {
    let [only] = arguments else { return None };
    let path = PathBuf::from(only);
    let option = only.to_str().is_some_and(|text| text.starts_with('-') || text.starts_with("example:"));
    let json = path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("json"));
    (!option && (json || path.components().count() > 1)).then_some(path)
}

/// Understands the arguments behind the program's name.
///
/// # Errors
/// A sentence: what was found and what is needed.
pub fn parse(arguments: impl IntoIterator<Item = OsString>) -> Result<Request, String> {
    let given = given(Parser::from_args(arguments)).map_err(|error| error.to_string())?;
    if given.help {
        return Ok(Request::Help);
    }
    if given.version {
        return Ok(Request::Version);
    }
    let mut values = given.values.into_iter();
    let command = values.next().ok_or("a command is needed")?.to_string_lossy().into_owned();
    let argument = values.next();
    if let Some(extra) = values.next() {
        return Err(format!("unexpected argument \"{}\" behind the file", extra.to_string_lossy()));
    }
    let takes: &[&str] = match command.as_str() {
        "simulate" | "compare" => &["format"],
        "figures" => &["out", "only"],
        "examples" => &["out"],
        _ => &[],
    };
    let used =
        [("format", given.format.is_some()), ("out", given.out.is_some()), ("only", given.only.is_some())];
    if let Some((option, _)) = used.iter().find(|(option, used)| *used && !takes.contains(option)) {
        return Err(format!("the command `{command}` has no option --{option}"));
    }
    let file = || argument.clone().map(source).ok_or(format!("the command `{command}` needs a FILE"));
    match command.as_str() {
        "check" => Ok(Request::Check(file()?)),
        "design" => Ok(Request::Design(file()?)),
        "simulate" => Ok(Request::Simulate(file()?, format(given.format.as_deref())?)),
        "compare" => Ok(Request::Compare(file()?, table_format(given.format.as_deref())?)),
        "figures" => {
            let out = given.out.ok_or("the command `figures` needs a folder to write to: --out DIR")?;
            Ok(Request::Figures { source: file()?, out, only: given.only })
        }
        "examples" => {
            if argument.is_none() && given.out.is_some() {
                return Err("--out needs the key of an example: `descry examples KEY --out FILE`".to_owned());
            }
            let key = argument.map(|key| key.to_string_lossy().into_owned());
            Ok(Request::Examples { key, out: given.out })
        }
        "errata" => Ok(Request::Errata(argument.map(|paper| paper.to_string_lossy().into_owned()))),
        "help" => Ok(Request::Help),
        other => {
            let hint =
                nearest(other, &COMMANDS).map_or(String::new(), |near| format!("; did you mean `{near}`?"));
            Err(format!("there is no command `{other}`{hint}"))
        }
    }
}

fn given(mut parser: Parser) -> Result<Given, lexopt::Error> {
    let mut given = Given::default();
    while let Some(argument) = parser.next()? {
        match argument {
            Long("help") | Short('h') => given.help = true,
            Long("version") | Short('V') => given.version = true,
            Long("format") => given.format = Some(parser.value()?.string()?),
            Long("out") | Short('o') => given.out = Some(parser.value()?.into()),
            Long("only") => given.only = Some(parser.value()?.string()?),
            Value(value) => given.values.push(value),
            Long(_) | Short(_) => return Err(argument.unexpected()),
        }
    }
    Ok(given)
}

fn source(argument: OsString) -> Source {
    match argument.to_str() {
        Some("-") => Source::Stdin,
        Some(text) => match text.strip_prefix("example:") {
            Some(key) => Source::Example(key.to_owned()),
            None => Source::File(argument.into()),
        },
        None => Source::File(argument.into()),
    }
}

fn format(word: Option<&str>) -> Result<Format, String> {
    match word {
        None | Some("csv") => Ok(Format::Csv),
        Some("json") => Ok(Format::Json),
        Some(other) => Err(format!("--format is csv or json, not \"{other}\"")),
    }
}

fn table_format(word: Option<&str>) -> Result<TableFormat, String> {
    match word {
        None | Some("json") => Ok(TableFormat::Json),
        Some("markdown" | "md") => Ok(TableFormat::Markdown),
        Some("csv") => Ok(TableFormat::Csv),
        Some(other) => Err(format!("--format is json, markdown or csv, not \"{other}\"")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parsed(line: &str) -> Result<Request, String> {
        parse(line.split_whitespace().map(OsString::from))
    }

    #[test]
    fn every_command_is_understood() {
        let file = || Source::File("a.json".into());
        let figures = |only| Request::Figures { source: Source::Example("x".into()), out: "d".into(), only };
        for (line, request) in [
            ("check a.json", Request::Check(file())),
            ("design -", Request::Design(Source::Stdin)),
            ("simulate a.json", Request::Simulate(file(), Format::Csv)),
            ("simulate --format=json a.json", Request::Simulate(file(), Format::Json)),
            ("compare a.json", Request::Compare(file(), TableFormat::Json)),
            ("compare --format markdown a.json", Request::Compare(file(), TableFormat::Markdown)),
            ("compare a.json --format=csv", Request::Compare(file(), TableFormat::Csv)),
            ("figures example:x --out d", figures(None)),
            ("figures --only f1 -o d example:x", figures(Some("f1".into()))),
            ("examples", Request::Examples { key: None, out: None }),
            ("examples k --out f", Request::Examples { key: Some("k".into()), out: Some("f".into()) }),
            ("errata", Request::Errata(None)),
            ("errata 004", Request::Errata(Some("004".into()))),
            ("help", Request::Help),
            ("check --help", Request::Help),
            ("--version", Request::Version),
        ] {
            assert_eq!(parsed(line), Ok(request), "{line}");
        }
    }

    #[test]
    fn a_document_alone_is_for_the_window() {
        let opened = |line: &str| {
            let arguments: Vec<OsString> = line.split_whitespace().map(OsString::from).collect();
            document_to_open(&arguments).map(|path| path.to_string_lossy().into_owned())
        };
        for line in ["a.json", "A.JSON", "../a", "folder/document", "/a/b.txt"] {
            assert_eq!(opened(line).as_deref(), Some(line), "{line} is a file");
        }
        for line in ["", "check", "chek", "-", "--help", "example:x", "check a.json", "a.json b.json"] {
            assert_eq!(opened(line), None, "{line} is for the commands");
        }
    }

    #[test]
    fn what_is_not_understood_is_said() {
        for (line, part) in [
            ("chek a", "did you mean `check`?"),
            ("check", "needs a FILE"),
            ("check a b", "unexpected argument \"b\""),
            ("check a --format json", "has no option --format"),
            ("simulate a --format xml", "csv or json"),
            ("compare a --format xml", "json, markdown or csv"),
            ("compare", "needs a FILE"),
            ("simulate a --format", "missing argument"),
            ("figures a", "--out DIR"),
            ("figures --out d", "needs a FILE"),
            ("examples --out f", "needs the key"),
            ("--fast", "--fast"),
        ] {
            let error = parsed(line).unwrap_err();
            assert!(error.contains(part), "{line}: {error}");
        }
    }
}
