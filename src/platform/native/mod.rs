//! The native side: threads, dialogs; arguments, files and standard streams of the commands.

mod arguments;
#[cfg(feature = "gui")]
pub(super) mod dialogs;
mod files;
mod parallel;
mod threads;

use std::ffi::OsString;
use std::io::{stderr, stdout};

pub use arguments::{document_to_open, parse};
pub use files::NativeFiles;
pub use parallel::Threads;
pub(super) use threads::ThreadRunner;

use crate::headless;

/// Runs a headless command with the arguments behind the program's name; returns the exit code.
pub fn run_command(arguments: impl IntoIterator<Item = OsString>) -> u8 {
    match parse(arguments) {
        Ok(request) => headless::run(&request, &NativeFiles, &mut stdout().lock(), &mut stderr()),
        Err(message) => headless::refuse_arguments(&message, &mut stderr()),
    }
}
