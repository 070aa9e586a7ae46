//! Matrices as text for other programs, every number with the fewest digits that read back to it.

use nalgebra::DMatrix;

/// A notation for matrices.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MatrixSyntax {
    /// `A = [1 2; 3 4];`, also for Octave.
    Matlab,
    /// `A = np.array([[1.0, 2.0], [3.0, 4.0]])`.
    NumPy,
    /// `A = [1.0 2.0; 3.0 4.0]`.
    Julia,
    /// `let A = nalgebra::dmatrix![1.0, 2.0; 3.0, 4.0];`.
    Rust,
    /// `A = \begin{bmatrix} 1 & 2 \\ 3 & 4 \end{bmatrix}`.
    Latex,
    /// `1,2` and `3,4` on lines of their own.
    Csv,
    /// `[[1,2],[3,4]]`; an entry that is not finite is `null`.
    Json,
}

impl MatrixSyntax {
    /// All notations, in the order of menus.
    pub const ALL: [Self; 7] =
        [Self::Matlab, Self::NumPy, Self::Julia, Self::Rust, Self::Latex, Self::Csv, Self::Json];

    /// The name that people know it by.
    pub fn name(self) -> &'static str {
        match self {
            Self::Matlab => "MATLAB",
            Self::NumPy => "NumPy",
            Self::Julia => "Julia",
            Self::Rust => "Rust (nalgebra)",
            Self::Latex => "LaTeX",
            Self::Csv => "CSV",
            Self::Json => "JSON",
        }
    }
}

/// Writes a matrix, assigned to `name` unless that is empty; CSV and JSON have no place for a name.
///
/// Matrices without rows or columns keep their shape where the notation can say it (not in LaTeX and CSV; in JSON the
/// number of rows).
///
/// # Examples
/// ```
/// use descry::document::{matrix_to_text, MatrixSyntax};
/// let matrix = nalgebra::dmatrix![1.0, 0.5; 0.0, -1.0];
/// assert_eq!(matrix_to_text(&matrix, MatrixSyntax::Matlab, "A"), "A = [1 0.5; 0 -1];");
/// assert_eq!(matrix_to_text(&matrix, MatrixSyntax::Json, "A"), "[[1,0.5],[0,-1]]");
/// ```
pub fn matrix_to_text(matrix: &DMatrix<f64>, syntax: MatrixSyntax, name: &str) -> String {
    let (rows, columns) = matrix.shape();
    let empty = matrix.is_empty();
    let join = |between: &str, row: &str| joined(matrix, syntax, between, row);
    let assigned = |right: String| if name.is_empty() { right } else { format!("{name} = {right}") };
    match syntax {
        MatrixSyntax::Matlab if empty => assigned(format!("zeros({rows}, {columns});")),
        MatrixSyntax::Matlab => assigned(format!("[{}];", join(" ", "; "))),
        MatrixSyntax::NumPy if empty => assigned(format!("np.zeros(({rows}, {columns}))")),
        MatrixSyntax::NumPy => assigned(format!("np.array([[{}]])", join(", ", "], ["))),
        MatrixSyntax::Julia if empty => assigned(format!("zeros({rows}, {columns})")),
        MatrixSyntax::Julia => assigned(format!("[{}]", join(" ", "; "))),
        MatrixSyntax::Rust => {
            let right = if empty {
                format!("nalgebra::DMatrix::<f64>::zeros({rows}, {columns})")
            } else {
                format!("nalgebra::dmatrix![{}]", join(", ", "; "))
            };
            if name.is_empty() { right } else { format!("let {name} = {right};") }
        }
        MatrixSyntax::Latex => {
            assigned(format!("\\begin{{bmatrix}} {} \\end{{bmatrix}}", join(" & ", " \\\\ ")))
        }
        MatrixSyntax::Csv if empty => String::new(),
        MatrixSyntax::Csv => format!("{}\n", join(",", "\n")),
        MatrixSyntax::Json if rows == 0 => "[]".to_owned(),
        MatrixSyntax::Json => format!("[[{}]]", join(",", "],[")),
    }
}

/// All entries, row by row.
fn joined(matrix: &DMatrix<f64>, syntax: MatrixSyntax, between: &str, row: &str) -> String {
    let line = |i: usize| matrix.row(i).iter().map(|x| number(*x, syntax)).collect::<Vec<_>>().join(between);
    (0..matrix.nrows()).map(line).collect::<Vec<_>>().join(row)
}

/// A number in comma-separated values.
pub(super) fn csv_number(x: f64) -> String {
    number(x, MatrixSyntax::Csv)
}

/// The shortest digits that read back to the same number, as the notation wants them.
fn number(x: f64, syntax: MatrixSyntax) -> String {
    if !x.is_finite() {
        return not_finite(x, syntax);
    }
    let plain = x == 0.0 || (1e-5..1e16).contains(&x.abs());
    match syntax {
        // Floating-point numbers there need a point or an exponent.
        MatrixSyntax::NumPy | MatrixSyntax::Julia | MatrixSyntax::Rust => format!("{x:?}"),
        _ if plain => format!("{x}"),
        MatrixSyntax::Latex => {
            let text = format!("{x:e}");
            let (digits, exponent) = text.split_once('e').unwrap_or((&text, "0"));
            format!("{digits} \\cdot 10^{{{exponent}}}")
        }
        _ => format!("{x:e}"),
    }
}

fn not_finite(x: f64, syntax: MatrixSyntax) -> String {
    let sign = if x < 0.0 { "-" } else { "" };
    let (nan, infinite) = match syntax {
        MatrixSyntax::Matlab | MatrixSyntax::Julia | MatrixSyntax::Csv => ("NaN", "Inf"),
        MatrixSyntax::NumPy => ("np.nan", "np.inf"),
        MatrixSyntax::Rust => ("f64::NAN", "f64::INFINITY"),
        MatrixSyntax::Latex => ("\\text{NaN}", "\\infty"),
        MatrixSyntax::Json => return "null".to_owned(),
    };
    if x.is_nan() { nan.to_owned() } else { format!("{sign}{infinite}") }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::dmatrix;

    #[test]
    fn every_notation_is_what_its_program_reads() {
        let matrix = dmatrix![1.0, -1e-7; 0.1, 2e20];
        for (syntax, text) in [
            (MatrixSyntax::Matlab, "A = [1 -1e-7; 0.1 2e20];"),
            (MatrixSyntax::NumPy, "A = np.array([[1.0, -1e-7], [0.1, 2e20]])"),
            (MatrixSyntax::Julia, "A = [1.0 -1e-7; 0.1 2e20]"),
            (MatrixSyntax::Rust, "let A = nalgebra::dmatrix![1.0, -1e-7; 0.1, 2e20];"),
            (
                MatrixSyntax::Latex,
                "A = \\begin{bmatrix} 1 & -1 \\cdot 10^{-7} \\\\ 0.1 & 2 \\cdot 10^{20} \\end{bmatrix}",
            ),
            (MatrixSyntax::Csv, "1,-1e-7\n0.1,2e20\n"),
            (MatrixSyntax::Json, "[[1,-1e-7],[0.1,2e20]]"),
        ] {
            assert_eq!(matrix_to_text(&matrix, syntax, "A"), text, "{}", syntax.name());
        }
        assert_eq!(matrix_to_text(&matrix, MatrixSyntax::Matlab, ""), "[1 -1e-7; 0.1 2e20];", "no name");
    }

    #[test]
    fn empty_matrices_keep_their_shape() {
        let none = DMatrix::zeros(2, 0);
        assert_eq!(matrix_to_text(&none, MatrixSyntax::Matlab, "B"), "B = zeros(2, 0);", "MATLAB");
        assert_eq!(matrix_to_text(&none, MatrixSyntax::NumPy, "B"), "B = np.zeros((2, 0))", "NumPy");
        assert_eq!(matrix_to_text(&none, MatrixSyntax::Json, "B"), "[[],[]]", "JSON");
    }

    #[cfg(not(target_arch = "wasm32"))]
    mod random {
        use super::*;
        use crate::document::matrix_from_text;
        use proptest::prelude::*;

        fn matrices() -> impl Strategy<Value = DMatrix<f64>> {
            let entry = prop_oneof![
                prop::num::f64::NORMAL | prop::num::f64::SUBNORMAL,
                -9.0..9.0,
                Just(0.0),
                Just(1.0)
            ];
            (1..6_usize, 1..6_usize).prop_flat_map(move |(rows, columns)| {
                prop::collection::vec(entry.clone(), rows * columns)
                    .prop_map(move |entries| DMatrix::from_vec(rows, columns, entries))
            })
        }

        proptest! {
            #[test]
            fn every_notation_reads_back_to_the_last_bit(matrix in matrices()) {
                for syntax in MatrixSyntax::ALL {
                    for name in ["A", ""] {
                        let text = matrix_to_text(&matrix, syntax, name);
                        let read = matrix_from_text(&text).map(|read| read.values());
                        prop_assert_eq!(read.as_ref(), Ok(&matrix), "{}: {}", syntax.name(), text);
                    }
                }
            }
        }
    }
}
