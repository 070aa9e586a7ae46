//! What `descry help` says.

/// Version of the program.
pub const VERSION: &str = env!("CARGO_PKG_VERSION");

/// The commands.
pub const HELP: &str = "\
descry: an interactive observatory for descriptor systems

usage:
  descry                                   opens the window
  descry FILE.json                         opens the window with a document
  descry check FILE                        properties of the system, a light with its reason for every method
                                           (exists, near, fails, missing) and conditions of the chosen one, as JSON
  descry design FILE                       conditions, design and its verification, as JSON
  descry simulate FILE [--format csv|json] plant and observer over time
  descry compare FILE [--format json|markdown|csv]
                                           the chosen design beside those that are kept: orders, spectra, gains,
                                           H-infinity norms of the error, errors of the scenario
  descry figures FILE --out DIR [--only ID]
                                           writes ID.svg and ID.csv for each figure, lists them as JSON
  descry examples                          lists the examples
  descry examples KEY [--out FILE]         writes an example out, to start from
  descry errata [PAPER]                    lists misprints, omissions and mistakes of the papers (000 to 004) with proofs, as JSON
  descry help, --help, --version

FILE is a document; `-` reads standard input, `example:KEY` takes an example.
A document without figures has the standard ones: states, errors, unknown-input, bode.
A network of more than 30 states is never written as one system: `simulate` then holds its whole and the subsystems
that are estimated. Estimates and errors of other subsystems are left out, whatever the size.
`figures --only comparison-states` (-errors, -unknown-input, -gains) draws all designs of `compare` together;
`figures --only trade-off` draws designs along a sweep of the bandwidth factor, or of the demanded decay.

exit codes:
  0  the design exists and is verified (check: all needed conditions hold; compare: all designs are)
  1  it does not exist or is not verified, or a simulation or figure could not be made
  2  bad input: file, document, arguments, or a list of poles that does not fit

Reports have \"descry_report\": 1. Numbers read back exactly; \"inf\", \"-inf\" and \"nan\" stand for what JSON has no
number for (a gap is \"inf\" when nothing is left below it); complex numbers are [real, imaginary].
";

#[cfg(test)]
mod tests {
    use super::HELP;
    use crate::document::limits::MAX_EXPANDED;

    #[test]
    fn the_limit_of_networks_is_the_one_in_force() {
        assert!(HELP.contains(&format!("more than {MAX_EXPANDED} states")), "{HELP}");
    }
}
