//! Where the project lies, and its cargo.

use std::{env, path::PathBuf, process::Command};

use crate::failure::{Failure, Outcome};

/// The name of the program, of its library and of the files of the page.
pub(crate) const PROGRAM: &str = "descry";
/// The target of the page.
pub(crate) const WASM: &str = "wasm32-unknown-unknown";

/// The folders of this checkout.
#[derive(Debug)]
pub(crate) struct Workspace {
    root: PathBuf,
    target: PathBuf,
}

impl Workspace {
    /// Finds the checkout from what `cargo run` says at run time. What was true at compile time may be another checkout.
    ///
    /// # Errors
    /// When the program was not started by cargo.
    pub(crate) fn find() -> Outcome<Self> {
        let outside =
            || Failure::new("the project's folder is unknown").advice("Start this as `cargo xtask ...`.");
        let manifest = env::var_os("CARGO_MANIFEST_DIR").map(PathBuf::from).ok_or_else(outside)?;
        let root = manifest.parent().ok_or_else(outside)?.to_path_buf();
        // This program lies in <target>/tools/xtask: right for every way to move the target folder.
        let program =
            env::current_exe().map_err(|reason| Failure::because("finding this program", reason))?;
        let target = program.ancestors().nth(2).ok_or_else(outside)?.to_path_buf();
        Ok(Self { root, target })
    }

    /// The finished page.
    pub(crate) fn dist(&self) -> PathBuf {
        self.root.join("dist")
    }

    /// The sources of the page around the program.
    pub(crate) fn web(&self) -> PathBuf {
        self.root.join("web")
    }

    /// The tests of the finished page.
    pub(crate) fn e2e(&self) -> PathBuf {
        self.root.join("e2e")
    }

    /// Where cargo puts what it builds for the page; `folder` is `release` or `debug`.
    pub(crate) fn wasm(&self, folder: &str) -> PathBuf {
        self.target.join(WASM).join(folder).join(format!("{PROGRAM}.wasm"))
    }

    /// A command in the root folder, without the traces of the cargo that started this program: some build scripts
    /// watch these variables and would run again at every switch between `cargo` and `cargo xtask`.
    pub(crate) fn command(&self, program: &str) -> Command {
        let mut command = Command::new(program);
        command.current_dir(&self.root);
        for (name, _) in env::vars_os() {
            let text = name.to_string_lossy();
            if text.starts_with("CARGO_PKG_") || text.starts_with("CARGO_MANIFEST_") {
                command.env_remove(&name);
            }
        }
        command
    }

    /// The cargo that started this program.
    pub(crate) fn cargo(&self) -> Command {
        self.command(&env::var("CARGO").unwrap_or_else(|_| "cargo".to_owned()))
    }
}
