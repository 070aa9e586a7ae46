//! Entry points: the window or the page without arguments, a headless command with them.

#[cfg(not(target_arch = "wasm32"))]
fn main() -> std::process::ExitCode {
    let mut arguments = std::env::args_os().skip(1).peekable();
    let code = if arguments.peek().is_some() {
        descry::platform::native::run_command(arguments)
    } else {
        open_window()
    };
    std::process::ExitCode::from(code)
}

/// Opens the window; returns the exit code.
#[cfg(all(feature = "gui", not(target_arch = "wasm32")))]
fn open_window() -> u8 {
    match descry::gui::open_window() {
        Ok(()) => 0,
        Err(error) => descry::headless::refuse_arguments(
            &format!("the window cannot be opened: {error}"),
            &mut std::io::stderr(),
        ),
    }
}

/// Says that this build has no window; returns the exit code.
#[cfg(all(not(feature = "gui"), not(target_arch = "wasm32")))]
fn open_window() -> u8 {
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
