//! Misprints of the papers, each with the number that proves it.

mod decentralized;
mod h_infinity;
mod proportional_integral;

/// A misprint.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Erratum {
    /// Key of the paper.
    pub paper: &'static str,
    /// Where it is.
    pub place: &'static str,
    /// Identifier of the condition or name of the matrix that it concerns; empty for the text.
    pub concerns: &'static str,
    /// As printed.
    pub printed: &'static str,
    /// As it should read.
    pub correct: &'static str,
    /// Why: the number or the argument.
    pub proof: &'static str,
}

/// All misprints of a paper.
pub fn errata(paper: &str) -> impl Iterator<Item = &'static Erratum> {
    ALL.iter().copied().flatten().filter(move |erratum| erratum.paper == paper)
}

/// The misprints of every paper that the program implements.
const ALL: [&[Erratum]; 3] = [&decentralized::ERRATA, &h_infinity::ERRATA, &proportional_integral::ERRATA];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_erratum_says_what_is_wrong_and_why() {
        for erratum in ALL.iter().copied().flatten() {
            assert_ne!(erratum.printed, erratum.correct, "{}: nothing is corrected", erratum.place);
            assert!(!erratum.proof.is_empty(), "{}: no proof", erratum.place);
        }
        for (paper, own) in [("000", ALL[0]), ("002", ALL[1]), ("004", ALL[2])] {
            assert!(
                own.iter().all(|erratum| erratum.paper == paper),
                "{paper}: a stranger among its misprints"
            );
            assert_eq!(errata(paper).count(), own.len(), "{paper}: all of them are found");
        }
    }
}
