//! The project's helper commands: `cargo xtask serve`, `web`, `test`. See [`HELP`].
#![expect(clippy::print_stdout, clippy::print_stderr, reason = "a command-line helper talks to a terminal")]

mod bindgen;
mod checks;
mod failure;
mod options;
mod page;
mod process;
mod server;
mod setup;
mod site;
mod workspace;

use std::process::ExitCode;

use failure::{Failure, Outcome};
use options::{PageOptions, Profile, TestOptions};
use workspace::Workspace;

const HELP: &str = "\
The project's helper commands.

  cargo xtask serve [--port N] [--debug]   build the page and serve it on this machine
  cargo xtask web [--debug]                build the page into dist/
  cargo xtask test [--fast]                install what is missing, then run every check that CI runs

      --port N   serve on this port only (default: the first free one from 8080)
      --debug    a build without optimisation: quicker to build, slower to run
      --fast     leave out the documentation, the release build of the page and the test of that page

For other programs:

  cargo xtask test-runner FILE             run browser tests (cargo calls it, see .cargo/config.toml)
  cargo xtask wasm-bindgen ARGUMENTS       the wasm-bindgen command in the version that Cargo.lock pins
";

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    match run(&arguments) {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => {
            eprintln!("\n{failure}");
            ExitCode::FAILURE
        }
    }
}

fn run(arguments: &[String]) -> Outcome {
    let Some((command, rest)) = arguments.split_first() else {
        print!("{HELP}");
        return Ok(());
    };
    match command.as_str() {
        "serve" => serve(&PageOptions::parse(rest, true)?),
        "web" => {
            let options = PageOptions::parse(rest, false)?;
            web(&Workspace::find()?, options.profile)
        }
        "test" => checks::run(&Workspace::find()?, &TestOptions::parse(rest)?),
        "test-runner" => bindgen::test_runner(rest),
        "wasm-bindgen" => bindgen::command(arguments),
        "help" | "--help" | "-h" => {
            print!("{HELP}");
            Ok(())
        }
        unknown => Err(Failure::new(format!("there is no command `{unknown}`")).advice(HELP)),
    }
}

fn web(workspace: &Workspace, profile: Profile) -> Outcome {
    setup::wasm_target()?;
    page::build(workspace, profile)?;
    page::print_sizes(&workspace.dist())
}

fn serve(options: &PageOptions) -> Outcome {
    let workspace = Workspace::find()?;
    // The port first: nobody should wait minutes for a build and then learn that the port is taken.
    let listener = server::listen(options.port)?;
    web(&workspace, options.profile)?;
    server::serve(&listener, &workspace.dist())
}
