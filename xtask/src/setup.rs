//! Installing what the other commands need, where it is missing and can be installed; else saying what to install.

use std::{
    env,
    path::{Path, PathBuf},
    process::Command,
};

use crate::{
    failure::{Failure, Outcome},
    process,
    workspace::{WASM, Workspace},
};

/// Names of Chromium and its relatives, as in `e2e/harness.mjs`.
const BROWSERS: [&str; 5] =
    ["chromium", "chromium-browser", "google-chrome", "google-chrome-stable", "chrome"];
/// Where Chrome lies on macOS, where no program in `PATH` starts it.
const MAC_BROWSER: &str = "/Applications/Google Chrome.app/Contents/MacOS/Google Chrome";
/// The oldest Node.js that runs the tests of the page.
const OLDEST_NODE: u32 = 20;

const BROWSER_ADVICE: &str = "\
Install Chromium (or Chrome) and the ChromeDriver of the same version:
  Debian   sudo apt-get install chromium chromium-driver
  Ubuntu   sudo apt-get install chromium-browser chromium-chromedriver
  Fedora   sudo dnf install chromium chromedriver
  macOS    brew install --cask google-chrome chromedriver
Programs outside PATH are found through the variables CHROME and CHROMEDRIVER.";

const NODE_ADVICE: &str = "\
Install Node.js 20 or newer with npm:
  Debian 13, Ubuntu 25.04 or newer   sudo apt-get install nodejs npm
  Fedora                             sudo dnf install nodejs npm
  macOS                              brew install node
  elsewhere                          https://nodejs.org/en/download
Or leave out the test of the page: `cargo xtask test --fast`.";

const TARGET_ADVICE: &str = "\
rustup adds it: `rustup target add wasm32-unknown-unknown`. Without rustup, install your system's package of it
(Debian: libstd-rust-dev-wasm32, Fedora: rust-std-static-wasm32-unknown-unknown), or get rustup: https://rustup.rs";

/// Adds the target of the page to the toolchain.
///
/// # Errors
/// When rustup is absent or cannot add it.
pub(crate) fn wasm_target() -> Outcome {
    let mut rustc = Command::new("rustc");
    rustc.args(["--print", "target-libdir", "--target", WASM]);
    if process::output(&mut rustc).is_some_and(|folder| Path::new(&folder).is_dir()) {
        return Ok(());
    }
    let missing = || Failure::new(format!("the Rust toolchain has no target {WASM}")).advice(TARGET_ADVICE);
    if process::find(&["rustup"]).is_none() {
        return Err(missing());
    }
    println!("Adding the target {WASM} to the toolchain ...");
    process::run(Command::new("rustup").args(["target", "add", WASM])).map_err(|_| missing())
}

/// Finds Chromium and its driver, or installs them, and returns the browser.
///
/// # Errors
/// When they are missing and this system's way to install them is unknown or fails.
pub(crate) fn browser() -> Outcome<PathBuf> {
    if let (Some(browser), true) = (find_browser(), has_driver()) {
        return Ok(browser);
    }
    install("Chromium and ChromeDriver", &["chromium", "chromium-driver"], BROWSER_ADVICE)?;
    match (find_browser(), has_driver()) {
        (Some(browser), true) => Ok(browser),
        (None, _) => Err(Failure::new("Chromium is missing").advice(BROWSER_ADVICE)),
        (Some(_), false) => Err(Failure::new("ChromeDriver is missing").advice(BROWSER_ADVICE)),
    }
}

fn find_browser() -> Option<PathBuf> {
    let chosen = env::var_os("CHROME").map(PathBuf::from);
    let mac = Path::new(MAC_BROWSER);
    chosen.or_else(|| process::find(&BROWSERS)).or_else(|| mac.is_file().then(|| mac.to_path_buf()))
}

fn has_driver() -> bool {
    let chosen = ["CHROMEDRIVER", "CHROMEDRIVER_REMOTE"].iter().any(|name| env::var_os(name).is_some());
    chosen || process::find(&["chromedriver"]).is_some()
}

/// Finds Node.js and npm, or installs them, and installs what the tests of the page use.
///
/// # Errors
/// When they are missing or too old and this system's way to install them is unknown or fails.
pub(crate) fn page_tests(workspace: &Workspace) -> Outcome {
    if process::find(&["node"]).is_none() || process::find(&["npm"]).is_none() {
        install("Node.js and npm", &["nodejs", "npm"], NODE_ADVICE)?;
    }
    let version = process::output(Command::new("node").arg("--version")).unwrap_or_default();
    if major(&version).is_none_or(|major| major < OLDEST_NODE) {
        let found = if version.is_empty() { "Node.js does not start" } else { &version };
        return Err(Failure::new(format!(
            "the test of the page needs Node.js {OLDEST_NODE} and finds {found}"
        ))
        .advice(NODE_ADVICE));
    }
    if is_installed(&workspace.e2e()) {
        return Ok(());
    }
    println!("Installing what e2e/package-lock.json lists ...");
    let mut npm = workspace.command(if cfg!(windows) { "npm.cmd" } else { "npm" });
    npm.args(["ci", "--no-audit", "--no-fund", "--loglevel=error"]).current_dir(workspace.e2e());
    process::run(&mut npm).map_err(|failure| failure.advice("npm needs a network the first time."))
}

/// The number before the first dot of `v20.20.2`.
fn major(version: &str) -> Option<u32> {
    version.strip_prefix('v')?.split('.').next()?.parse().ok()
}

/// npm leaves a list of what it installed; it is younger than the list of what should be.
fn is_installed(e2e: &Path) -> bool {
    let time = |file: &str| e2e.join(file).metadata().and_then(|data| data.modified()).ok();
    match (time("package-lock.json"), time("node_modules/.package-lock.json")) {
        (Some(wanted), Some(installed)) => installed >= wanted,
        _ => false,
    }
}

/// Installs packages by apt, as root or through a sudo that asks nothing.
fn install(what: &str, packages: &[&str], advice: &str) -> Outcome {
    let missing = |reason: &str| Failure::new(format!("{what}: missing, and {reason}")).advice(advice);
    if process::find(&["apt-get"]).is_none() {
        return Err(missing("this system has no apt-get to install it by"));
    }
    let rights = rights().ok_or_else(|| missing("installing needs root, or sudo without a password"))?;
    println!("Installing {what} by apt-get (once, about a minute) ...");
    process::run(&mut apt(rights, &["update", "-qq"])).map_err(|_| missing("`apt-get update` failed"))?;
    let words: Vec<&str> =
        ["install", "-y", "-qq", "--no-install-recommends"].iter().chain(packages).copied().collect();
    process::run(&mut apt(rights, &words)).map_err(|_| missing("apt-get could not install it"))
}

/// What stands before `apt-get` so that it may install.
fn rights() -> Option<&'static [&'static str]> {
    if process::output(Command::new("id").arg("-u")).as_deref() == Some("0") {
        return Some(&["env"]);
    }
    process::output(Command::new("sudo").args(["-n", "true"])).map(|_| ["sudo", "-n", "env"].as_slice())
}

fn apt(rights: &[&str], words: &[&str]) -> Command {
    let mut line = rights.iter().chain(&["DEBIAN_FRONTEND=noninteractive", "apt-get"]).chain(words);
    let mut command = Command::new(line.next().copied().unwrap_or("env"));
    command.args(line);
    command
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn node_states_its_version() {
        assert_eq!(major("v20.20.2"), Some(20), "a release");
        assert_eq!(major("v9.0.0"), Some(9), "one digit");
        assert_eq!(major(""), None, "no Node.js");
    }

    #[test]
    fn apt_asks_nothing() {
        let line = process::line(&apt(&["sudo", "-n", "env"], &["update"]));
        assert_eq!(line, "sudo -n env DEBIAN_FRONTEND=noninteractive apt-get update", "a user with sudo");
        let line = process::line(&apt(&["env"], &["update"]));
        assert_eq!(line, "env DEBIAN_FRONTEND=noninteractive apt-get update", "root");
    }
}
