//! Statements about pasted matrices, each with a text as other programs print it.

use super::*;

fn read(text: &str) -> (usize, usize, Vec<f64>) {
    let matrix = matrix_from_text(text).unwrap_or_else(|error| panic!("{text:?}: {error}"));
    (matrix.rows, matrix.columns, matrix.entries.iter().map(|(_, value)| *value).collect())
}

fn message(text: &str) -> String {
    matrix_from_text(text).map_or_else(|error| error.to_string(), |matrix| format!("{matrix:?}"))
}

#[test]
fn every_notation_of_one_matrix_is_read() {
    for text in [
        "[1 -2; 3 4]",
        "[1, -2; 3, 4]",
        "A = [1 -2\n 3 4];",
        "A = [ 1 , -2 ;\r\n 3 , 4 ; ]",
        "1 -2; 3 4",
        "1 -2\n3 4",
        "[1 ... one\n -2; % two\n 3 4] # end",
        "[[1, -2], [3, 4]]",
        "[[ 1. -2.]\n [ 3.  4.]]",
        "{{1, -2}, {3, 4}}",
        "A = np.array([[1, -2],\n              [3, 4]])",
        "array([[ 1., -2.], [ 3., 4.]], dtype=float32)",
        "Matrix([[1, -2], [3, 4]])",
        "numpy.asarray([[1,-2],[3,4]])",
        "let a: DMatrix<f64> = nalgebra::dmatrix![1.0, -2.0; 3.0, 4.0];",
        "1,-2\n3,4\n",
        "1;-2\r\n3;4\r\n",
        "1\t-2\n3\t4",
        "1,0;-2,0\n3,0;4,0",
        "1,0\t-2,0\n3,0\t4,0",
        "\"1\",\"-2\"\n\"3\",\"4\"",
        "1, -2; 3, 4",
        "1,-2,\n3,4,",
        "\u{feff}1;-2;\n3;4;",
        "1 -2;\n3 4;",
        "[1 \u{2212}2; 3 4]",
        "a_1 = {{1, -2}, {3, 4}};",
        "[[1,-2],[3,4]]",
        "\\begin{bmatrix} 1 & -2 \\\\ 3 & 4 \\end{bmatrix}",
        "$$A = \\begin{pmatrix}1&-2\\\\[2pt] 3&4\\\\\\end{pmatrix}$$",
        "\\left[\\begin{array}{cc} 1 & -2 \\\\ \\hline 3 & 4 \\end{array}\\right]",
    ] {
        assert_eq!(read(text), (2, 2, vec![1.0, -2.0, 3.0, 4.0]), "{text:?}");
    }
}

#[test]
fn spaces_around_signs_decide_as_in_matlab() {
    assert_eq!(read("[1 -2]"), (1, 2, vec![1.0, -2.0]), "two entries");
    assert_eq!(read("[1 - 2]"), (1, 1, vec![-1.0]), "a difference");
    assert_eq!(read("[1 -2 + 3]"), (1, 2, vec![1.0, 1.0]), "an entry and a sum");
    assert_eq!(read("[2 * 3 -(1 + 1)]"), (1, 2, vec![6.0, -2.0]), "a product and a sign");
    assert_eq!(read("[1; 2; 3]"), (3, 1, vec![1.0, 2.0, 3.0]), "a column");
    assert_eq!(read("[1, 2, 3]"), (1, 3, vec![1.0, 2.0, 3.0]), "a row");
}

#[test]
fn entries_keep_their_text() {
    let matrix = matrix_from_text("[-1/3, sqrt(2); 2*pi, 1e-3]").unwrap();
    let texts: Vec<&str> = matrix.entries.iter().map(|(text, _)| text.as_str()).collect();
    assert_eq!(texts, ["-1/3", "sqrt(2)", "2*pi", "1e-3"], "as typed");
    assert_eq!(matrix.values()[(1, 0)], 2.0 * std::f64::consts::PI, "second row, first column");
    let latex = matrix_from_text(
        "\\begin{bmatrix} -\\frac{1}{3} & \\sqrt{2} & \\dfrac{\\sqrt{3}}{2} & 2.5 \\cdot 10^{-7} & 2\\cdot\\pi & \\frac12 \\end{bmatrix}",
    );
    let texts: Vec<String> = latex.unwrap().entries.into_iter().map(|(text, _)| text).collect();
    assert_eq!(texts, ["-1/3", "sqrt(2)", "((sqrt(3))/(2))", "2.5e-7", "2*pi", "1/2"], "from LaTeX");
    assert_eq!(read("[[np.sqrt(2)**2, np.pi]]").2[1], std::f64::consts::PI, "from Python");
    assert_eq!(read("{{Sqrt[2], Pi, 1.5*^-3}}").2[2], 1.5e-3, "from Mathematica");
    assert_eq!(read("[1//4 2]").2[0], 0.25, "from Julia");
}

#[test]
fn single_numbers_are_matrices() {
    for (text, value) in
        [("5", 5.0), ("-1/4", -0.25), (" 1e-3\n", 1e-3), ("[7]", 7.0), ("k = 2;", 2.0), ("2 - 1", 1.0)]
    {
        assert_eq!(read(text), (1, 1, vec![value]), "{text}");
    }
}

#[test]
fn errors_name_row_and_column() {
    for (text, part) in [
        ("[1 2; 3]", "row 2 has 1 entry, but the first row has 2 entries"),
        ("{{1, 2}, {3, 4, 5}}", "row 2 has 3 entries"),
        ("[1 2; 3 x]", "row 2, column 2: `x`: at character 1: unknown name `x`"),
        ("[1,,2]", "row 1, column 2: ``: there is nothing here"),
        ("1\t\t2\n3\t4\t5", "row 1, column 2"),
        ("[1/0]", "1/0 is infinite"),
        ("", "no entry"),
        ("[]", "no entry"),
        ("% only a comment", "no entry"),
        ("[1 2", "`]` is missing"),
        ("{{1, 2}", "`}` is missing"),
        ("[1 2; 3 4]'", "`'` beside the matrix"),
        ("2*[1 2]", "`2*` beside the matrix"),
        ("inv([1 2; 3 4])", "`inv(` beside the matrix"),
        ("np.array([[1, 2]]).T", "beside the matrix"),
        ("[1 2] + [3 4]", "beside the matrix"),
        ("\\begin{bmatrix} 1 & 2", "`\\end` is missing"),
        (&"1 ".repeat(201), "at most 200 x 200"),
        (&"1\n".repeat(201), "at most 200 x 200"),
        (&"1".repeat(1_000_001), "1000001 bytes"),
        (&"[".repeat(5000), "`]` is missing"),
    ] {
        assert!(message(text).contains(part), "{}: {}", shortened(text), message(text));
    }
}

#[test]
fn long_texts_take_no_longer_than_they_are_long() {
    for piece in [
        " ", "\t", "[", "{", "(", ",", ";", "\n", "\\frac", "\\frac{", "\\\\", "&", "\"", "1 ", "=", "...",
        "- ",
    ] {
        for frame in ["1@- 2", "[1@]", "[[1@]]", "\\begin{x}1@\\end{x}", "1;2@3"] {
            let text = frame.replace('@', &piece.repeat(150_000 / piece.len()));
            let entries = matrix_from_text(&text).map_or(0, |matrix| matrix.entries.len());
            assert!(entries <= 2, "{frame}: {piece:?} read as {entries} entries");
        }
    }
    assert_eq!(read(&format!("[1{}- 2]", " ".repeat(900_000))), (1, 1, vec![-1.0]), "spaces do not matter");
}

#[cfg(not(target_arch = "wasm32"))]
mod random {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn no_text_panics(text in "\\PC{0,60}") {
            drop(matrix_from_text(&text));
        }

        #[test]
        fn no_text_of_pieces_panics(pieces in prop::collection::vec(prop::sample::select(vec![
            "[", "]", "{", "}", "(", ")", ",", ";", "\n", " ", "\t", "1", "-2", ".5", "\\frac", "\\sqrt", "\\\\", "&",
            "\\begin{bmatrix}", "\\end{bmatrix}", "\\cdot 10^{", "\"", "'", "=", "A", "np.array(", "...", "%", "\u{e9}",
            "1,5", "$", "\\",
        ]), 0..30)) {
            drop(matrix_from_text(&pieces.concat()));
        }
    }
}
