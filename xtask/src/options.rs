//! The arguments of the commands.

use crate::failure::{Failure, Outcome};

/// How the program is compiled for the page.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Profile {
    /// What users get.
    Release,
    /// Quick to build, slow to run.
    Debug,
}

/// Arguments of `web` and `serve`.
#[derive(Debug, PartialEq, Eq)]
pub(crate) struct PageOptions {
    pub(crate) profile: Profile,
    /// The one port to serve on; `None`: the first free one.
    pub(crate) port: Option<u16>,
}

impl PageOptions {
    /// Reads the arguments; `--port` belongs to `serve` only.
    pub(crate) fn parse(arguments: &[String], serves: bool) -> Outcome<Self> {
        let mut options = Self { profile: Profile::Release, port: None };
        let mut rest = arguments.iter();
        while let Some(argument) = rest.next() {
            match argument.as_str() {
                "--debug" => options.profile = Profile::Debug,
                // The default, accepted because cargo's own commands have it.
                "--release" => options.profile = Profile::Release,
                "--port" if serves => options.port = Some(port(rest.next().map_or("", String::as_str))?),
                other => match other.strip_prefix("--port=") {
                    Some(value) if serves => options.port = Some(port(value)?),
                    _ => return Err(unknown(other)),
                },
            }
        }
        Ok(options)
    }
}

/// Arguments of `test`.
#[derive(Debug, PartialEq, Eq)]
pub(crate) struct TestOptions {
    /// Leave out what takes longest and breaks least.
    pub(crate) fast: bool,
}

impl TestOptions {
    /// Reads the arguments.
    pub(crate) fn parse(arguments: &[String]) -> Outcome<Self> {
        let mut options = Self { fast: false };
        for argument in arguments {
            match argument.as_str() {
                "--fast" => options.fast = true,
                other => return Err(unknown(other)),
            }
        }
        Ok(options)
    }
}

fn port(text: &str) -> Outcome<u16> {
    text.parse().map_err(|_| {
        Failure::new(format!("`--port` needs a number from 0 to 65535 and got `{text}`"))
            .advice("Try `cargo xtask serve --port 8080`.")
    })
}

fn unknown(argument: &str) -> Failure {
    Failure::new(format!("unknown argument `{argument}`")).advice("`cargo xtask help` lists what there is.")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn words(line: &str) -> Vec<String> {
        line.split_whitespace().map(str::to_owned).collect()
    }

    #[test]
    fn pages_are_release_builds_unless_asked_otherwise() {
        let default = PageOptions { profile: Profile::Release, port: None };
        assert_eq!(PageOptions::parse(&[], true).unwrap(), default, "no arguments");
        let debug = PageOptions { profile: Profile::Debug, port: Some(9000) };
        assert_eq!(PageOptions::parse(&words("--debug --port 9000"), true).unwrap(), debug, "two words");
        assert_eq!(PageOptions::parse(&words("--port=9000 --debug"), true).unwrap(), debug, "one word");
    }

    #[test]
    fn a_wrong_port_is_named() {
        for line in ["--port 70000", "--port eighty", "--port"] {
            let message = PageOptions::parse(&words(line), true).unwrap_err().to_string();
            assert!(message.contains("0 to 65535"), "{line}: {message}");
        }
    }

    #[test]
    fn only_serving_has_a_port() {
        let message = PageOptions::parse(&words("--port 9000"), false).unwrap_err().to_string();
        assert!(message.contains("unknown argument `--port`"), "{message}");
    }

    #[test]
    fn unknown_arguments_are_refused() {
        let message = TestOptions::parse(&words("--fast --quick")).unwrap_err().to_string();
        assert!(message.contains("`--quick`"), "{message}");
        assert!(TestOptions::parse(&words("--fast")).unwrap().fast, "the known one is read");
    }
}
