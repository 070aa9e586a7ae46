//! Entry points: the window or the page without arguments or with a document, a headless command with others.

#[cfg(not(target_arch = "wasm32"))]
fn main() -> std::process::ExitCode {
    use descry::platform::native::{document_to_open, run_command};
    let arguments: Vec<std::ffi::OsString> = std::env::args_os().skip(1).collect();
    let code = match document_to_open(&arguments) {
        Some(path) => open_window(Some(&path)),
        None if arguments.is_empty() => open_window(None),
        None => run_command(arguments),
    };
    std::process::ExitCode::from(code)
}

/// Opens the window, with a document; returns the exit code.
#[cfg(all(feature = "gui", not(target_arch = "wasm32")))]
fn open_window(document: Option<&std::path::Path>) -> u8 {
    use descry::platform::files::{Arrival, read_file};
    let refuse = |why: &str| descry::headless::refuse_arguments(why, &mut std::io::stderr());
    let opened = document.map(read_file);
    if let Some(Arrival::Problem(why)) = &opened {
        return refuse(why);
    }
    match descry::gui::open_window(opened) {
        Ok(()) => 0,
        Err(error) => refuse(&format!("the window cannot be opened: {error}")),
    }
}

/// Says that this build has no window; returns the exit code.
#[cfg(all(not(feature = "gui"), not(target_arch = "wasm32")))]
fn open_window(_document: Option<&std::path::Path>) -> u8 {
    descry::headless::refuse_arguments(
        "this build has no window (feature `gui`), so a command is needed",
        &mut std::io::stderr(),
    )
}

#[cfg(all(feature = "gui", target_arch = "wasm32"))]
fn main() {
    descry::gui::start_page();
}

/// Without its screen there is nothing to start in a browser.
#[cfg(all(not(feature = "gui"), target_arch = "wasm32"))]
fn main() {}
