//! What of the papers does not read as it should: misprints, omissions, mistakes, and prints that are right but not the only
//! ones; each with the number that proves it.

mod decentralized;
mod h_infinity;
mod hierarchical;
mod input_decoupled;
mod printed;
mod proportional_integral;
mod shown;

pub use printed::{PrintedMatrix, printed};
pub use shown::{GUARANTEE, OBSERVER, Shown, UNCERTAINTY};

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
    /// What it concerns on screen, see [`Shown`]: the identifier of a condition, the letter of a matrix, that of one
    /// subsystem (`Q of subsystem 1`), the identifier of a figure, `observer`, `guarantee` or `uncertainty`; several
    /// stand between semicolons.
    pub concerns: &'static str,
    /// As printed.
    pub printed: &'static str,
    /// As it should read; what is right as well for a print that is not unique.
    pub correct: &'static str,
    /// Why: the argument and the number, which `tests/errata` computes.
    pub proof: &'static str,
}

/// The papers' examples: the section that holds them, and the key of the document.
const EXAMPLES: [(&str, &str, &str); 5] = [
    ("000", "section V", "decentralized"),
    ("001", "section III", "input-decoupled"),
    ("002", "section 4", "h-infinity-lipschitz"),
    ("003", "section III", "hierarchical"),
    ("004", "section IV", "proportional-integral"),
];

/// The papers and the keys of the documents that hold their examples.
pub fn paper_examples() -> impl Iterator<Item = (&'static str, &'static str)> {
    EXAMPLES.into_iter().map(|(paper, _, key)| (paper, key))
}

impl Erratum {
    /// Whether it concerns the numbers of the paper's example, and nothing beside them.
    pub fn of_example(&self) -> bool {
        let first = self.place.split(',').next();
        let section = EXAMPLES.iter().find(|(paper, ..)| *paper == self.paper);
        section.is_some_and(|(_, section, _)| first == Some(section)) || self.place.starts_with("Fig")
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
            assert!(!erratum.concerns.is_empty(), "{}: it concerns nothing on screen", erratum.place);
        }
        let of_examples = |paper| errata(paper).filter(|erratum| erratum.of_example()).count();
        assert_eq!(
            ["000", "001", "002", "003", "004"].map(of_examples),
            [8, 3, 1, 5, 4],
            "the sections of the examples are known"
        );
        for (paper, own) in papers_with_errata().into_iter().zip(ALL) {
            assert!(own.iter().all(|erratum| erratum.paper == paper), "{paper}: a stranger among its errata");
            assert_eq!(errata(paper).count(), own.len(), "{paper}: all of them are found");
        }
    }
}
