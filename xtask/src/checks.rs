//! Every check that CI runs, in the order in which failures are cheapest to find.

use std::{process::Command, time::Duration};

use crate::{
    failure::{Failure, Outcome},
    options::{Profile, TestOptions},
    page, process, setup,
    workspace::{WASM, Workspace},
};

/// One numbered step.
struct Check {
    name: &'static str,
    /// Left out by `--fast`.
    slow: bool,
    work: Work,
}

/// What a step does.
enum Work {
    /// Commands in a row.
    Commands(Vec<Command>),
    /// The release build of the page.
    Page,
}

/// How a step went, and how long it took.
struct Record {
    name: &'static str,
    seconds: f64,
    passed: bool,
}

/// Installs what is missing and runs the checks up to the first that fails.
///
/// # Errors
/// When something cannot be installed, or a check fails; the message names it.
pub(crate) fn run(workspace: &Workspace, options: &TestOptions) -> Outcome {
    let mut records = Vec::new();
    let result = run_all(workspace, options, &mut records);
    print!("{}", summary(&records));
    result
}

fn run_all(workspace: &Workspace, options: &TestOptions, records: &mut Vec<Record>) -> Outcome {
    let mut browser = String::new();
    timed(records, "what the checks need", || {
        setup::wasm_target()?;
        browser = setup::browser()?.to_string_lossy().into_owned();
        if options.fast { Ok(()) } else { setup::page_tests(workspace) }
    })?;
    let checks: Vec<Check> =
        checks(workspace, &browser).into_iter().filter(|check| !(check.slow && options.fast)).collect();
    let count = checks.len();
    for (index, check) in checks.into_iter().enumerate() {
        println!("\n== {}/{count} {}", index + 1, check.name);
        timed(records, check.name, || work(workspace, check.work)).map_err(|failure| {
            Failure::new(format!("step {} of {count}, {}", index + 1, check.name)).advice(failure.to_string())
        })?;
    }
    Ok(())
}

fn work(workspace: &Workspace, work: Work) -> Outcome {
    match work {
        Work::Page => {
            page::build(workspace, Profile::Release)?;
            page::print_sizes(&workspace.dist())
        }
        Work::Commands(commands) => commands.into_iter().try_for_each(|mut command| {
            println!("   {}", process::line(&command));
            process::run(&mut command)
        }),
    }
}

fn timed(records: &mut Vec<Record>, name: &'static str, work: impl FnOnce() -> Outcome) -> Outcome {
    let start = process::now();
    let result = work();
    records.push(Record { name, seconds: start.elapsed().as_secs_f64(), passed: result.is_ok() });
    result
}

/// The list. `-D warnings` goes to clippy only: in RUSTFLAGS it would build every dependency anew.
fn checks(workspace: &Workspace, browser: &str) -> Vec<Check> {
    let cargo = |line: &str| {
        let mut cargo = workspace.cargo();
        cargo.args(line.split(' '));
        cargo
    };
    let quick = |name, lines: &[&str]| Check {
        name,
        slow: false,
        work: Work::Commands(lines.iter().map(|line| cargo(line)).collect()),
    };
    let mut documentation = cargo("doc --locked --no-deps");
    documentation.env("RUSTDOCFLAGS", "-D warnings");
    let mut page_test = workspace.command("node");
    page_test.args(["e2e/run.mjs", "dist"]).env("CHROME", browser);
    vec![
        quick("format", &["fmt --all --check"]),
        quick("lints", &["clippy --locked --workspace --all-targets -- -D warnings"]),
        quick(
            "lints of the page",
            &[&format!("clippy --locked --target {WASM} --lib --bins -- -D warnings")],
        ),
        // clippy checks what `cargo check` does: this step is also the proof that the core knows no screen.
        quick(
            "lints of the core without a screen",
            &["clippy --locked --no-default-features --lib --bins -- -D warnings"],
        ),
        // xtask in the profile in which it is already built: else all of wasm-bindgen is compiled a second time.
        quick(
            "tests",
            &["test --locked --workspace --exclude xtask", "test --locked --profile tools -p xtask"],
        ),
        Check { name: "documentation", slow: true, work: Work::Commands(vec![documentation]) },
        quick(
            "tests in a browser",
            &[&format!(
                "test --locked --target {WASM} --test web --test paper_000 --test paper_001 --test paper_002 --test paper_003"
            )],
        ),
        Check { name: "build of the page", slow: true, work: Work::Page },
        Check { name: "the page in a browser", slow: true, work: Work::Commands(vec![page_test]) },
    ]
}

/// The last lines: every step and its time.
fn summary(records: &[Record]) -> String {
    let width = records.iter().map(|record| record.name.len()).max().unwrap_or(0);
    let total: f64 = records.iter().map(|record| record.seconds).sum();
    let row =
        |mark: &str, name: &str, seconds: f64| format!("  {mark:<4}  {name:<width$}  {}\n", time(seconds));
    let rows = records
        .iter()
        .map(|record| row(if record.passed { "ok" } else { "FAIL" }, record.name, record.seconds));
    format!("\n{}{}", rows.collect::<String>(), row("", "together", total))
}

fn time(seconds: f64) -> String {
    let minutes = Duration::from_secs_f64(seconds.max(0.0)).as_secs() / 60;
    if minutes == 0 { format!("{seconds:7.1} s") } else { format!("{seconds:7.1} s  ({minutes} min)") }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_summary_names_every_step() {
        let records = [
            Record { name: "format", seconds: 1.25, passed: true },
            Record { name: "lints", seconds: 130.0, passed: false },
        ];
        let expected = "\n  ok    format      1.2 s\n  FAIL  lints     130.0 s  (2 min)\n        together    131.2 s  (2 min)\n";
        assert_eq!(
            summary(&records).replace(' ', ""),
            expected.replace(' ', ""),
            "one row for each and their sum"
        );
    }
}
