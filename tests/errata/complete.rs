//! That no misprint which is known is left out, and that each says a number.

use descry::paper::{errata, papers_with_errata};

/// What became of an item of the list below.
enum Item {
    /// It is shown at these places.
    At(&'static [&'static str]),
    /// It turned out to be no misprint, because of this.
    None(&'static str),
}

use Item::{At, None};

/// Everything that was found wrong, missing or doubtful while the papers were worked through: paper, item, where it is.
const FOUND: [(&str, &str, Item); 62] = [
    ("000", "A_i in the conditions of the observer", At(&["Proposition 1, ii and v"])),
    ("000", "v_i as a row", At(&["section III"])),
    ("000", "rank Sigma_i = n_ii", At(&["before (23)"])),
    ("000", "size of Omega_i", At(&["definition of Omega_i"])),
    ("000", "index of Omega in Delta_Psi", At(&["definition of Delta_Psi"])),
    ("000", "variables of Theorem 2", At(&["Theorem 2"])),
    ("000", "label of a block of (34)", At(&["(34)"])),
    ("000", "existence without detectability", At(&["Proposition 1"])),
    ("000", "gamma with an initial error", At(&["Definition of gamma"])),
    ("000", "sign of the error in the figures", At(&["Figures 2 and 4"])),
    ("000", "which columns are decoupled", At(&["Remark 1"])),
    ("000", "Phi_i = 0", At(&["Remark 2"])),
    ("000", "orders without full row rank", At(&["section IV, orders"])),
    ("000", "widths of Y_1 and Z_i", At(&["section V, Y_1"])),
    ("000", "the entry \"0- 0.27\"", At(&["section V, last entry of Y_1"])),
    ("000", "factor of Q_1 Phi_1 B_1", At(&["section V, Q_1 Phi_1 B_1"])),
    ("000", "row of F_1, which is of another run than Z_1", At(&["section V, F_1"])),
    ("000", "-222.04", At(&["section V, Z_i"])),
    ("000", "gamma of the example", At(&["section V, gamma"])),
    ("000", "time domain of the figures", At(&["section V, time domain and inputs"])),
    ("001", "sign in G", At(&["section III, d_hat"])),
    ("001", "matrices without a definition", At(&["(4)", "Theorem 2"])),
    ("001", "W2+ without its P", At(&["section III, W2+"])),
    ("001", "dots and hats that stand apart", None("the scanned text alone has them")),
    ("001", "(A2) implies q > p when m < n", None("it is right: n - m + p <= q")),
    ("001", "L, one of many", At(&["section III, L"])),
    ("002", "T = T + Psi Phi", At(&["before (38)"])),
    ("002", "Omega with T E", At(&["definition of Omega"])),
    ("002", "block (1,4) of (53)", At(&["(53), block (1,4)"])),
    ("002", "Delta_TD", At(&["(51), Delta_TD"])),
    ("002", "(13)", At(&["(13)"])),
    ("002", "letters of (12)", At(&["(12)"])),
    ("002", "lambda_1 and its square", At(&["(14), (22) and Remark 7"])),
    ("002", "vector of the error system", At(&["(18), (25)"])),
    ("002", "rho, with lambda counted twice", At(&["(27)"])),
    ("002", "letters of (36)", At(&["(36)"])),
    ("002", "gamma and its square", At(&["Theorem 10, gamma"])),
    ("002", "order of the rows in (45) and (46)", At(&["(45) and (46)"])),
    ("002", "arguments of f", At(&["(5)"])),
    ("002", "gamma^2 = 9.762", At(&["section 4"])),
    ("003", "N(2,2)", At(&["section III, N"])),
    ("003", "rows of M", At(&["section III, M"])),
    ("003", "Theorem 2 (iii)", At(&["Theorem 2 (iii)"])),
    ("003", "size of sigma_z", At(&["(12)"])),
    ("003", "X(0)", At(&["Theorem 1, last line of the proof"])),
    ("003", "alpha_I", At(&["Proposition 1"])),
    ("003", "zeros of (14) and (15)", At(&["(14) and (15)"])),
    ("003", "d = n", At(&["Corollary 1, proof"])),
    ("003", "caption of Fig. 6", At(&["Fig. 6, caption"])),
    ("003", "Gamma_nu(3,2)", At(&["section III, Gamma_nu"])),
    ("003", "observable by (13)", At(&["Theorem 2, proof of (a)"])),
    ("003", "what a centralized observer can do", At(&["section III, rank of the observability matrix"])),
    ("004", "L2 y_hat", At(&["equation (5)"])),
    ("004", "size of y, and the check of (8)", At(&["after equation (4)", "section IV, check of (8)"])),
    ("004", "E1^+", At(&["equation (19)"])),
    ("004", "s I_n", At(&["equations (22), (23) and appendix"])),
    ("004", "A P2, and [E^+]", At(&["Algorithm 2", "Algorithm 1"])),
    ("004", "input observable", At(&["before equation (16)"])),
    ("004", "what Theorem 4 needs", At(&["Theorem 4"])),
    ("004", "proofs of the appendix", At(&["appendix, proof of (12)", "appendix, left factor of (13)"])),
    ("004", "Definition 4, the inverse is not true", None("it is right, in other words")),
    (
        "004",
        "uncertainty and bandwidth of the example",
        At(&["section IV, case 1", "section IV, bounds of the uncertainty", "section IV, bandwidth"]),
    ),
];

#[test]
fn every_known_misprint_is_listed_and_nothing_else_is() {
    for (paper, item, became) in &FOUND {
        match became {
            At(places) => {
                for place in *places {
                    let listed = errata(paper).any(|erratum| erratum.place == *place);
                    assert!(listed, "{item}: no entry at {place} of paper {paper}");
                }
            }
            None(why) => assert!(!why.is_empty(), "{item}: why it is no misprint"),
        }
    }
    for paper in papers_with_errata() {
        for erratum in errata(paper) {
            let known = FOUND.iter().any(|(of, _, became)| {
                *of == paper && matches!(became, At(places) if places.contains(&erratum.place))
            });
            assert!(known, "{} of paper {paper} stands in the list of what was found", erratum.place);
        }
    }
}

/// Whether a word is a number, perhaps in brackets or with a fraction; references such as `(38)` are none.
fn is_number(word: &str) -> bool {
    if word.starts_with('(') && word.trim_end_matches([',', ';', ':', '.']).ends_with(')') {
        return false;
    }
    let inner = word.trim_matches(|c: char| "[](){},;:|".contains(c)).trim_end_matches('.');
    !inner.is_empty() && inner.split('/').all(|part| part.parse::<f64>().is_ok())
}

#[test]
fn every_proof_says_a_number() {
    for erratum in papers_with_errata().into_iter().flat_map(errata) {
        let found = erratum.proof.split_whitespace().any(is_number);
        assert!(found, "{} of paper {}: {}", erratum.place, erratum.paper, erratum.proof);
    }
    assert!(!is_number("(38)") && !is_number("x_1") && !is_number("Q1"), "no numbers");
    assert!(is_number("[0") && is_number("16/3]") && is_number("-4.0361,"), "numbers");
}

#[test]
fn places_are_not_listed_twice() {
    for paper in papers_with_errata() {
        let mut places: Vec<&str> = errata(paper).map(|erratum| erratum.place).collect();
        places.sort_unstable();
        let count = places.len();
        places.dedup();
        assert_eq!(places.len(), count, "paper {paper}: {places:?}");
    }
}
