//! Entry points: the window without arguments, a headless command with them.

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
#[cfg(not(target_arch = "wasm32"))]
fn open_window() -> u8 {
    descry::headless::refuse_arguments(
        "this build has no window (feature `gui`), so a command is needed",
        &mut std::io::stderr(),
    )
}

/// The page is started by its own script.
#[cfg(target_arch = "wasm32")]
fn main() {}
