//! Starting other programs.

use std::{
    env,
    ffi::OsStr,
    path::{Path, PathBuf},
    process::{Command, Stdio},
    time::Instant,
};

use crate::failure::{Failure, Outcome};

/// The clock of progress lines.
#[expect(clippy::disallowed_methods, reason = "this program never runs in WebAssembly")]
pub(crate) fn now() -> Instant {
    Instant::now()
}

/// Runs a command with its output on the terminal.
///
/// # Errors
/// When it cannot be started or does not succeed.
pub(crate) fn run(command: &mut Command) -> Outcome {
    let line = line(command);
    let status = command.status().map_err(|reason| Failure::because(format!("starting `{line}`"), reason))?;
    if status.success() { Ok(()) } else { Err(Failure::because(format!("`{line}` failed"), status)) }
}

/// Runs a command silently and returns what it printed, or `None` when it does not exist or does not succeed.
pub(crate) fn output(command: &mut Command) -> Option<String> {
    let output = command.stdin(Stdio::null()).stderr(Stdio::null()).output().ok()?;
    output.status.success().then(|| String::from_utf8_lossy(&output.stdout).trim().to_owned())
}

/// The command as a person would type it.
pub(crate) fn line(command: &Command) -> String {
    let program = Path::new(command.get_program()).file_stem().unwrap_or_default();
    let words = std::iter::once(program).chain(command.get_args());
    words.map(OsStr::to_string_lossy).collect::<Vec<_>>().join(" ")
}

/// The first of these programs that can be found in `PATH`.
pub(crate) fn find(names: &[&str]) -> Option<PathBuf> {
    let folders: Vec<PathBuf> = env::split_paths(&env::var_os("PATH")?).collect();
    find_in(names, &folders)
}

fn find_in(names: &[&str], folders: &[PathBuf]) -> Option<PathBuf> {
    let files = names.iter().flat_map(|name| folders.iter().map(move |folder| folder.join(name)));
    let with_suffix = |file: PathBuf| {
        let name = format!("{}{}", file.display(), env::consts::EXE_SUFFIX);
        [file, PathBuf::from(name)].into_iter().find(|candidate| candidate.is_file())
    };
    files.into_iter().find_map(with_suffix)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_name_wins_over_the_first_folder() {
        let here = Path::new(env!("CARGO_MANIFEST_DIR")).to_path_buf();
        let folders = [here.join("src"), here.clone()];
        let found = find_in(&["missing", "Cargo.toml", "main.rs"], &folders);
        assert_eq!(found, Some(here.join("Cargo.toml")), "names are asked in order");
        assert_eq!(find_in(&["missing"], &folders), None, "what does not exist is not found");
        assert_eq!(find_in(&["src"], &folders), None, "a folder is no program");
    }

    #[test]
    fn a_command_prints_as_it_is_typed() {
        let mut command = Command::new("/some/where/cargo");
        command.args(["test", "--locked"]);
        assert_eq!(line(&command), "cargo test --locked", "the folder is left out");
    }
}
