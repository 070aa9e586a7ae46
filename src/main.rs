//! Entry points only.

use std::process::ExitCode;

fn main() -> ExitCode {
    open_window()
}

#[cfg(all(feature = "gui", not(target_arch = "wasm32")))]
fn open_window() -> ExitCode {
    match descry::gui::open_window() {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => fail(&format!("the window cannot be opened: {error}")),
    }
}

#[cfg(all(feature = "gui", target_arch = "wasm32"))]
fn open_window() -> ExitCode {
    descry::gui::start_page();
    ExitCode::SUCCESS
}

#[cfg(not(feature = "gui"))]
fn open_window() -> ExitCode {
    fail("this program was built without its window: build it with the feature `gui`")
}

#[cfg(not(all(feature = "gui", target_arch = "wasm32")))]
fn fail(why: &str) -> ExitCode {
    use std::io::Write as _;
    // without a terminal there is nobody to tell
    drop(writeln!(std::io::stderr(), "descry: {why}"));
    ExitCode::FAILURE
}
