//! wasm-bindgen as a library: `Cargo.lock` pins the tool and the crate to one version, and nothing is downloaded.

use std::{iter, path::Path};

use crate::{
    failure::{Failure, Outcome},
    options::Profile,
};

/// Writes the JavaScript module and the WebAssembly file of the page.
///
/// # Errors
/// When the input is not what rustc makes, or the folder cannot be written.
pub(crate) fn generate(wasm: &Path, folder: &Path, profile: Profile) -> Outcome {
    let small = profile == Profile::Release;
    let mut bindgen = wasm_bindgen_cli_support::Bindgen::new();
    bindgen.input_path(wasm).typescript(false).remove_name_section(small).remove_producers_section(small);
    bindgen.web(true).and_then(|bindgen| bindgen.generate(folder)).map_err(|reason| {
        Failure::because(format!("wasm-bindgen of {}", wasm.display()), format!("{reason:#}"))
    })
}

/// Cargo's runner for tests in the browser, see `.cargo/config.toml`.
///
/// # Errors
/// When a test fails, or no browser can be started.
pub(crate) fn test_runner(arguments: &[String]) -> Outcome {
    let words = iter::once("wasm-bindgen-test-runner").chain(arguments.iter().map(String::as_str));
    wasm_bindgen_cli::wasm_bindgen_test_runner::run_cli_with_args(words).map_err(|reason| {
        Failure::because("browser tests", format!("{reason:#}"))
            .advice("A failed test stands above. `cargo xtask test` installs a browser and its driver where they are missing.")
    })
}

/// The `wasm-bindgen` command; the first word is its own name.
///
/// # Errors
/// What the command itself reports.
pub(crate) fn command(words: &[String]) -> Outcome {
    wasm_bindgen_cli::wasm_bindgen::run_cli_with_args(words)
        .map_err(|reason| Failure::because("wasm-bindgen", format!("{reason:#}")))
}
