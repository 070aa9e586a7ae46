//! The misprints of the papers: every one that is known is listed, and the numbers that prove it are computed here.
#![cfg(not(target_arch = "wasm32"))]
#![expect(clippy::unwrap_used, clippy::panic, reason = "helpers of tests fail by panicking")]
#![expect(non_snake_case, reason = "matrix letters of the papers")]

mod complete;
mod decentralized;
mod h_infinity;
mod hierarchical;
mod input_decoupled;
mod proportional_integral;

use std::cell::Cell;

use descry::document::{Document, read_document};
use descry::numerics::{Tolerance, Watch, rank};
use descry::observer::{Design, DesignChoice, assess};
use descry::paper::{Erratum, errata, example};
use nalgebra::DMatrix;
use serde_json::Value;

fn tolerance() -> Tolerance {
    Tolerance::default()
}

/// A misprint while its numbers are computed.
struct Proof {
    erratum: &'static Erratum,
    numbers: Cell<usize>,
}

/// Computes the numbers of a misprint and compares them with what its proof says.
type Computation = fn(&Proof);

/// Computes the numbers of every misprint of a paper, by its place; none may be left out.
fn compute(paper: &str, computations: &[(&str, Computation)]) {
    for (place, computation) in computations {
        let Some(erratum) = errata(paper).find(|erratum| erratum.place == *place) else {
            panic!("no misprint at {place} of paper {paper}")
        };
        let proof = Proof { erratum, numbers: Cell::new(0) };
        computation(&proof);
        assert!(proof.numbers.get() > 0, "{place}: a number is compared with what the proof says");
    }
    for erratum in errata(paper) {
        let count = computations.iter().filter(|(place, _)| *place == erratum.place).count();
        assert_eq!(count, 1, "{} of paper {paper} is proved by one computation", erratum.place);
    }
}

impl Proof {
    fn text(&self) -> String {
        format!("{} {}", self.erratum.proof, self.erratum.correct)
    }

    /// Whether a number stands in the text as such, not as a part of a longer one.
    fn has(&self, number: &str) -> bool {
        let text = self.text();
        text.match_indices(number).any(|(at, _)| {
            let before = text[..at].chars().next_back();
            let mut behind = text[at + number.len()..].chars();
            let continued = match behind.next() {
                Some('.') => behind.next().is_some_and(|c| c.is_ascii_digit()),
                Some(c) => c.is_ascii_digit(),
                None => false,
            };
            !continued && !before.is_some_and(|c| c.is_ascii_alphanumeric() || c == '.' || c == '_')
        })
    }

    fn noted(&self, number: &str) {
        assert!(self.has(number), "{}: {number} is not said: {}", self.erratum.place, self.text());
        self.numbers.set(self.numbers.get() + 1);
    }

    /// That the proof (or the correction) has this number, and that the computed one rounds to it.
    fn says(&self, number: &str, computed: f64) {
        self.noted(number);
        let (mantissa, exponent) = number.split_once('e').unwrap_or((number, "0"));
        let digits = mantissa.split('.').nth(1).map_or(0, str::len);
        let unit = exponent.parse::<i32>().unwrap() - i32::try_from(digits).unwrap();
        let half = 0.5 * 10.0_f64.powi(unit) * (1.0 + 1e-9);
        let off = (computed - number.parse::<f64>().unwrap()).abs();
        assert!(off <= half, "{}: {number} is said, {computed} computed", self.erratum.place);
    }

    /// That the proof has this count, and that it is the one that was found.
    fn counts(&self, number: &str, found: usize) {
        self.noted(number);
        assert_eq!(found.to_string(), number, "{}: found and said", self.erratum.place);
    }

    /// That the proof has this size in the form `2 x 3`.
    fn size(&self, size: &str, matrix: &DMatrix<f64>) {
        self.noted(size);
        let found = format!("{} x {}", matrix.nrows(), matrix.ncols());
        assert_eq!(found, size, "{}: found and said", self.erratum.place);
    }

    /// That the proof says 0, and that nothing but rounding was found.
    fn vanishes(&self, found: f64) {
        self.noted("0");
        assert!(found.abs() < 1e-12, "{}: 0 is said, {found:.1e} computed", self.erratum.place);
    }

    /// That the proof has this bound, and that what was found stays below it.
    fn below(&self, bound: &str, found: f64) {
        self.noted(bound);
        assert!(found < bound.parse().unwrap(), "{}: {bound} is said, {found:.1e}", self.erratum.place);
    }

    /// That the proof (or the correction) has these words.
    fn words(&self, text: &str) {
        assert!(self.text().contains(text), "{}: {text} is not said: {}", self.erratum.place, self.text());
    }
}

fn matrix(value: &Value) -> DMatrix<f64> {
    let rows: Vec<Vec<f64>> = serde_json::from_value(value.clone()).unwrap();
    DMatrix::from_row_iterator(rows.len(), rows[0].len(), rows.into_iter().flatten())
}

fn off(found: &DMatrix<f64>, expected: &DMatrix<f64>) -> f64 {
    assert_eq!(found.shape(), expected.shape(), "shapes of {found} and {expected}");
    (found - expected).amax()
}

fn rank_of(matrix: &DMatrix<f64>) -> usize {
    rank(matrix, 0.0, &tolerance()).unwrap().rank
}

fn document(key: &str) -> Document {
    read_document(example(key).unwrap().text).unwrap()
}

fn designed(document: &Document, choice: &DesignChoice) -> Design {
    let model = document.model().unwrap();
    assess(&model, choice, &document.tolerance, &Watch::none()).unwrap().outcome.unwrap()
}
