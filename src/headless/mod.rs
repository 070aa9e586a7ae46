//! L4: the commands that need no screen. They see files through [`Files`] and write to the writers they are given.

mod commands;
mod compare;
mod errata;
mod examples;
mod figures;
mod help;
mod load;
mod network;

use std::io::{self, Write};
use std::path::{Path, PathBuf};

pub use help::{HELP, VERSION};

/// The design exists and is verified; for `check`: the needed conditions hold.
pub const DONE: u8 = 0;
/// The design does not exist or is not verified; a figure or a simulation could not be made.
pub const REFUSED: u8 = 1;
/// The file, the document or the arguments are at fault.
pub const BAD_INPUT: u8 = 2;

/// Where a document comes from.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Source {
    /// `-`
    Stdin,
    /// `example:KEY`
    Example(String),
    /// A file.
    File(PathBuf),
}

/// The format of a trajectory.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Format {
    /// A header and a line for each instant.
    #[default]
    Csv,
    /// A report.
    Json,
}

/// The format of a comparison.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum TableFormat {
    /// A report.
    #[default]
    Json,
    /// A table with a column for each design.
    Markdown,
    /// The same table with all digits.
    Csv,
}

/// What a person asks for on the command line.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Request {
    /// Properties and conditions.
    Check(Source),
    /// Conditions, design and verification.
    Design(Source),
    /// The trajectory of plant and observer.
    Simulate(Source, Format),
    /// The chosen design beside those that are kept.
    Compare(Source, TableFormat),
    /// Figures as SVG and CSV files.
    Figures {
        /// The document.
        source: Source,
        /// Folder to write to.
        out: PathBuf,
        /// Only the figure with this key.
        only: Option<String>,
    },
    /// The examples, or one of them.
    Examples {
        /// Key of the example to write out; all are listed without.
        key: Option<String>,
        /// File to write to; standard output without.
        out: Option<PathBuf>,
    },
    /// The errata of the paper with this key; of all papers without.
    Errata(Option<String>),
    /// How to use the commands.
    Help,
    /// The version of the program.
    Version,
}

/// Access to files, so that commands do no input or output of their own.
pub trait Files {
    /// The first bytes of a file, at most `limit`.
    ///
    /// # Errors
    /// Those of the file system.
    fn read(&self, path: &Path, limit: usize) -> io::Result<Vec<u8>>;
    /// The first bytes of standard input, at most `limit`.
    ///
    /// # Errors
    /// Those of the stream.
    fn read_stdin(&self, limit: usize) -> io::Result<Vec<u8>>;
    /// Writes a file, replacing one that exists.
    ///
    /// # Errors
    /// Those of the file system.
    fn write(&self, path: &Path, bytes: &[u8]) -> io::Result<()>;
    /// Creates a folder and those above it, unless it exists.
    ///
    /// # Errors
    /// Those of the file system.
    fn create_folder(&self, path: &Path) -> io::Result<()>;
}

/// Why a command ends early: a sentence and the exit code.
#[derive(Clone, Debug, PartialEq, Eq)]
struct Refusal {
    message: String,
    code: u8,
}

impl Refusal {
    fn bad_input(message: impl Into<String>) -> Self {
        Self { message: message.into(), code: BAD_INPUT }
    }

    fn refused(message: impl Into<String>) -> Self {
        Self { message: message.into(), code: REFUSED }
    }
}

/// What a command has to say.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
struct Answer {
    /// For standard output.
    text: String,
    /// Sentences for standard error.
    remarks: Vec<String>,
    code: u8,
}

/// Runs a command: the answer goes to `out`, sentences about what went wrong to `err`; returns the exit code.
///
/// [`DONE`], [`REFUSED`] or [`BAD_INPUT`]. The same document gives the same bytes.
pub fn run(request: &Request, files: &dyn Files, out: &mut dyn Write, err: &mut dyn Write) -> u8 {
    let answer = match request {
        Request::Check(source) => commands::check(source, files),
        Request::Design(source) => commands::design(source, files),
        Request::Simulate(source, format) => commands::simulate(source, *format, files),
        Request::Compare(source, format) => compare::compare(source, *format, files),
        Request::Figures { source, out, only } => figures::figures(source, out, only.as_deref(), files),
        Request::Examples { key, out } => examples::examples(key.as_deref(), out.as_deref(), files),
        Request::Errata(paper) => errata::list(paper.as_deref()),
        Request::Help => Ok(Answer { text: HELP.to_owned(), ..Answer::default() }),
        Request::Version => Ok(Answer { text: format!("descry {VERSION}\n"), ..Answer::default() }),
    };
    let answer = answer.unwrap_or_else(|Refusal { message, code }| Answer {
        text: String::new(),
        remarks: vec![message],
        code,
    });
    let written = out.write_all(answer.text.as_bytes()).and_then(|()| out.flush());
    let said = answer.remarks.iter().try_for_each(|remark| writeln!(err, "descry: {remark}"));
    match (written, said) {
        // a reader that has seen enough, such as `head`, is no failure of the command
        (Err(error), _) if error.kind() != io::ErrorKind::BrokenPipe => {
            say(err, &format!("the answer could not be written: {error}"), BAD_INPUT)
        }
        _ => answer.code,
    }
}

/// Refuses arguments that were not understood; returns the exit code.
pub fn refuse_arguments(message: &str, err: &mut dyn Write) -> u8 {
    say(err, &format!("{message}; `descry help` shows the commands"), BAD_INPUT)
}

/// Says a sentence where somebody may read it; whether anybody can does not change the exit code.
fn say(err: &mut dyn Write, message: &str, code: u8) -> u8 {
    writeln!(err, "descry: {message}").map_or(code, |()| code)
}
