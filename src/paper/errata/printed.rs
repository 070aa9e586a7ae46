//! Matrices that papers print otherwise than the program computes them, to be shown beside ours.

use nalgebra::DMatrix;

use super::ErratumKind;

/// A matrix as printed, and as it is computed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PrintedMatrix {
    /// Key of the paper.
    pub paper: &'static str,
    /// Name of the matrix in designs.
    pub name: &'static str,
    /// What is the matter with the print.
    pub kind: ErratumKind,
    /// As printed, row by row.
    pub printed: &'static [&'static [f64]],
    /// As computed, to the printed digits.
    pub correct: &'static [&'static [f64]],
    /// Half a unit of the last printed digit.
    rounding: f64,
}

/// What a paper prints in the place of a matrix of its example; `None` where it prints the same, or where the design is
/// another one.
///
/// That the plant is the paper's example is for the caller to know.
pub fn printed(paper: &str, name: &str, value: &DMatrix<f64>) -> Option<&'static PrintedMatrix> {
    ALL.iter().find(|known| known.paper == paper && known.name == name && known.is(value))
}

impl PrintedMatrix {
    /// Whether a matrix is the computed one.
    fn is(&self, value: &DMatrix<f64>) -> bool {
        let rows = self.correct.len();
        let close = |(i, row): (usize, &&[f64])| {
            row.len() == value.ncols()
                && row.iter().zip(value.row(i).iter()).all(|(a, b)| (a - b).abs() <= self.rounding)
        };
        rows == value.nrows() && self.correct.iter().enumerate().all(close)
    }

    /// Whether an entry, from zero, is printed wrongly; no entry of a matrix that is right as printed.
    pub fn is_wrong(&self, row: usize, column: usize) -> bool {
        self.kind != ErratumKind::NotUnique && self.differs(row, column)
    }

    /// Whether an entry, from zero, is printed otherwise than it is computed.
    fn differs(&self, row: usize, column: usize) -> bool {
        let entry = |rows: &[&[f64]]| rows.get(row).and_then(|row| row.get(column)).copied();
        match (entry(self.printed), entry(self.correct)) {
            (Some(printed), Some(correct)) => (printed - correct).abs() > self.rounding,
            (printed, correct) => printed.is_some() != correct.is_some(),
        }
    }
}

/// Exact fractions need no allowance but for rounding in double precision.
const EXACT: f64 = 1e-6;
/// Two digits behind the point.
const TWO_DIGITS: f64 = 0.0051;

const ALL: [PrintedMatrix; 5] = [
    PrintedMatrix {
        paper: "001",
        name: "G",
        kind: ErratumKind::Misprint,
        printed: &[&[5.0 / 3.0, 4.0 / 3.0]],
        correct: &[&[5.0 / 3.0, -4.0 / 3.0]],
        rounding: EXACT,
    },
    PrintedMatrix {
        paper: "001",
        name: "L",
        kind: ErratumKind::NotUnique,
        printed: &[&[0.0, 6.0, 1.0], &[6.0, 2.0, 0.0]],
        correct: &[&[-5.0 / 3.0, 5.0 / 3.0, -5.0 / 3.0], &[4.0 / 3.0, -4.0 / 3.0, 4.0 / 3.0]],
        rounding: EXACT,
    },
    PrintedMatrix {
        paper: "003",
        name: "N",
        kind: ErratumKind::Misprint,
        printed: &[&[-0.71, -0.41, -0.29], &[0.71, 0.41, -0.29], &[0.0, 0.82, -0.29], &[0.0, 0.0, 0.87]],
        correct: &[&[-0.71, -0.41, -0.29], &[0.71, -0.41, -0.29], &[0.0, 0.82, -0.29], &[0.0, 0.0, 0.87]],
        rounding: TWO_DIGITS,
    },
    PrintedMatrix {
        paper: "003",
        name: "M",
        kind: ErratumKind::Misprint,
        printed: &[&[1.0, 0.0], &[0.0, 0.5], &[0.0, 0.5], &[0.0, 0.5], &[0.0, 0.5], &[0.0, 0.5]],
        correct: &[&[1.0, 0.0], &[0.0, 0.5], &[0.0, 0.5], &[0.0, 0.5], &[0.0, 0.5]],
        rounding: TWO_DIGITS,
    },
    PrintedMatrix {
        paper: "003",
        name: "Gamma_nu",
        kind: ErratumKind::Misprint,
        printed: &[&[-4.0, 1.73, 0.0], &[0.58, -3.33, 1.89], &[-0.2, 0.83, -1.67]],
        correct: &[&[-4.0, 1.73, 0.0], &[0.58, -3.33, 1.89], &[-0.2, 0.82, -1.67]],
        rounding: TWO_DIGITS,
    },
];

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::dmatrix;

    #[test]
    fn only_the_matrix_of_the_example_has_a_printed_one() {
        let ours = dmatrix![5.0 / 3.0, -4.0 / 3.0];
        let found = printed("001", "G", &ours).unwrap();
        assert!(found.is_wrong(0, 1) && !found.is_wrong(0, 0), "the sign of the second entry");
        assert_eq!(printed("001", "G", &dmatrix![5.0 / 3.0, -1.3]), None, "another plant");
        assert_eq!(printed("001", "G", &dmatrix![1.0; 2.0]), None, "another shape");
        assert_eq!(printed("001", "K", &ours), None, "another matrix");
        assert_eq!(printed("002", "G", &ours), None, "another paper");
    }

    #[test]
    fn every_printed_matrix_differs_from_the_computed_one() {
        for known in &ALL {
            let rows = known.printed.len().max(known.correct.len());
            let columns = known.printed[0].len();
            let differing = (0..rows).flat_map(|i| (0..columns).map(move |j| (i, j)));
            let count = differing.filter(|(i, j)| known.differs(*i, *j)).count();
            assert!(count > 0, "{} of paper {}", known.name, known.paper);
            let concerned = super::super::errata(known.paper).find(|erratum| erratum.concerns == known.name);
            let kind = concerned.map(|erratum| erratum.kind);
            assert_eq!(
                kind,
                Some(known.kind),
                "{} of paper {} is listed as what it is",
                known.name,
                known.paper
            );
        }
    }
}
