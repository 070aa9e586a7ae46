//! What of the papers does not read as it should: misprints, omissions, mistakes, and prints that are right but not the only
//! ones; each with the number that proves it.

mod decentralized;
mod h_infinity;
mod hierarchical;
mod input_decoupled;
mod printed;
mod proportional_integral;

pub use printed::{PrintedMatrix, printed};

/// What is the matter with a print.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ErratumKind {
    /// A symbol, number or picture that is not what was meant.
    Misprint,
    /// Something that is used or needed, and not said.
    Omission,
    /// A statement that does not hold.
    Mistake,
    /// Right as printed, but others are right as well.
    NotUnique,
}

impl ErratumKind {
    /// The word for it, as on the screen and in reports.
    pub fn word(self) -> &'static str {
        match self {
            Self::Misprint => "misprint",
            Self::Omission => "omission",
            Self::Mistake => "mistake",
            Self::NotUnique => "not unique",
        }
    }

    /// What stands beside the print.
    pub fn beside(self) -> &'static str {
        match self {
            Self::Misprint | Self::Mistake => "correct",
            Self::Omission => "meant",
            Self::NotUnique => "right as well",
        }
    }
}

/// A place of a paper that does not read as it should.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Erratum {
    /// Key of the paper.
    pub paper: &'static str,
    /// What is the matter.
    pub kind: ErratumKind,
    /// Where it is.
    pub place: &'static str,
    /// Identifier of the condition or name of the matrix that it concerns; empty for the text.
    pub concerns: &'static str,
    /// As printed.
    pub printed: &'static str,
    /// As it should read; what is right as well for a print that is not unique.
    pub correct: &'static str,
    /// Why: the number or the argument.
    pub proof: &'static str,
}

/// The sections of the papers that hold their examples.
const EXAMPLES: [(&str, &str); 5] = [
    ("000", "section V"),
    ("001", "section III"),
    ("002", "section 4"),
    ("003", "section III"),
    ("004", "section IV"),
];

impl Erratum {
    /// Whether it concerns the numbers of the paper's example, and nothing beside them.
    pub fn of_example(&self) -> bool {
        let section = EXAMPLES.iter().find(|(paper, _)| *paper == self.paper);
        section.is_some_and(|(_, section)| self.place.split(',').next() == Some(section))
    }
}

/// All errata of a paper.
pub fn errata(paper: &str) -> impl Iterator<Item = &'static Erratum> {
    ALL.iter().copied().flatten().filter(move |erratum| erratum.paper == paper)
}

/// Keys of the papers in which errata were found.
pub fn papers_with_errata() -> Vec<&'static str> {
    ALL.iter().filter_map(|errata| errata.first()).map(|erratum| erratum.paper).collect()
}

/// The errata of every paper that the program implements.
const ALL: [&[Erratum]; 5] = [
    &decentralized::ERRATA,
    &input_decoupled::ERRATA,
    &h_infinity::ERRATA,
    &hierarchical::ERRATA,
    &proportional_integral::ERRATA,
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_print_that_is_right_is_called_no_misprint() {
        let kind = |paper, place: &str| errata(paper).find(|e| e.place == place).map(|e| e.kind);
        assert_eq!(kind("001", "section III, L"), Some(ErratumKind::NotUnique), "one gain of many");
        assert_eq!(kind("001", "section III, d_hat"), Some(ErratumKind::Misprint), "a sign");
        assert_eq!(kind("001", "Theorem 2"), Some(ErratumKind::Omission), "N is not defined");
        assert_eq!(kind("004", "Theorem 4"), Some(ErratumKind::Omission), "(11) is needed, too");
        for erratum in ALL.iter().copied().flatten() {
            let is_right = erratum.kind == ErratumKind::NotUnique;
            let says_so = erratum.correct.starts_with("any") || erratum.correct == "arbitrary";
            assert_eq!(is_right, says_so, "{} {}", erratum.paper, erratum.place);
        }
    }

    #[test]
    fn every_erratum_says_what_is_wrong_and_why() {
        for erratum in ALL.iter().copied().flatten() {
            assert_ne!(erratum.printed, erratum.correct, "{}: nothing is corrected", erratum.place);
            assert!(!erratum.proof.is_empty(), "{}: no proof", erratum.place);
        }
        let of_examples = |paper| errata(paper).filter(|erratum| erratum.of_example()).count();
        assert_eq!(
            ["001", "002", "004"].map(of_examples),
            [3, 1, 3],
            "the sections of the examples are known"
        );
        for (paper, own) in papers_with_errata().into_iter().zip(ALL) {
            assert!(own.iter().all(|erratum| erratum.paper == paper), "{paper}: a stranger among its errata");
            assert_eq!(errata(paper).count(), own.len(), "{paper}: all of them are found");
        }
    }
}
