//! Misprints of paper 003.

use super::{Erratum, ErratumKind};

/// In the order of its pages.
pub(super) const ERRATA: [Erratum; 12] = [
    Erratum {
        paper: "003",
        kind: ErratumKind::Misprint,
        place: "Proposition 1",
        concerns: "003-P1-local",
        printed: "(alpha_I - h_i c_L) is Hurwitz",
        correct: "(a_I - h_i c_L) is Hurwitz",
        proof: "there is no alpha_I; in the example h_4 c_L is 5 x 5 as a_I is, and alpha_z is 6 x 6; the \
                error (9) has the blocks a_I - h_i c_L on its diagonal",
    },
    Erratum {
        paper: "003",
        kind: ErratumKind::Misprint,
        place: "(12)",
        concerns: "alpha_z",
        printed: "sigma_z in R^(N n x nu mu)",
        correct: "sigma_z in R^(nu mu x N n)",
        proof: "z = sigma_z x: in the example N' kron M' is 6 x 20, and x has 20 entries",
    },
    Erratum {
        paper: "003",
        kind: ErratumKind::Misprint,
        place: "(14) and (15)",
        concerns: "gamma_z",
        printed: "output matrices [Psi kron c_G; e_I' kron c_L] and [Psi N kron c_G M; I kron c_L]",
        correct: "diag(Psi kron c_G, e_I' kron c_L) and diag(Psi N kron c_G M, I kron c_L)",
        proof: "in the example the printed matrix of (14) has 20 columns, and [x_G; x_L] has 40 entries: \
                zeros are lost",
    },
    Erratum {
        paper: "003",
        kind: ErratumKind::Misprint,
        place: "Theorem 1, last line of the proof",
        concerns: "observer",
        printed: "X(0) := L [x_G(0)', x_L(0)']'",
        correct: "X(0) := L' [x_G(0)', x_L(0)']'",
        proof: "in the example L is 40 x 11, and X has 11 entries",
    },
    Erratum {
        paper: "003",
        kind: ErratumKind::Misprint,
        place: "Theorem 2 (iii)",
        concerns: "003-T2-iii",
        printed: "|Theta_pi| > 2",
        correct: "|Theta_pi| >= 2",
        proof: "Gamma = diag(1, 2), a_I = diag(-1, 1/2), b_I = [1; 0], c_I = c_G = [1 1], Psi = [1 1]: (i) \
                and (ii) hold, |Theta_pi| = 2 at pi = 0.5 and is never larger, but this mode of (alpha_z, \
                gamma_z) is not observable",
    },
    Erratum {
        paper: "003",
        kind: ErratumKind::Mistake,
        place: "Theorem 2, proof of (a)",
        concerns: "003-T2-ii",
        printed: "(a_z, c_z) is observable by the definition in (13)",
        correct: "because ker O_n(a_I, b_I c_I) contains ker O_n(a_I, c_I)",
        proof: "what c_I does not show, b_I c_I does not show either, and the columns of M leave just that \
                out: in the example each of the two matrices has rank 2, both together have rank 2, and so \
                has O_2(a_z, c_z)",
    },
    Erratum {
        paper: "003",
        kind: ErratumKind::Omission,
        place: "Corollary 1, proof",
        concerns: "003-C1-iii",
        printed: "there is a pi with d(pi) = n(pi)",
        correct: "d(pi) = n(pi) = 0",
        proof: "d = n holds at every mode of a_z + b_z c_z: in the example at 0.4361 and -4.0361, where n = 1",
    },
    Erratum {
        paper: "003",
        kind: ErratumKind::Misprint,
        place: "section III, N",
        concerns: "N",
        printed: "N(2,2) = 0.41",
        correct: "N(2,2) = -0.41",
        proof: "N' N = I: the printed N has 0.58 outside the diagonal, with -0.41 nothing is left",
    },
    Erratum {
        paper: "003",
        kind: ErratumKind::Misprint,
        place: "section III, M",
        concerns: "M",
        printed: "M has the row [0 0.5] five times",
        correct: "four times",
        proof: "x_i has 5 entries, and the second column has the norm 1.118 with five, 1 with four",
    },
    Erratum {
        paper: "003",
        kind: ErratumKind::Misprint,
        place: "section III, Gamma_nu",
        concerns: "Gamma_nu",
        printed: "Gamma_nu(3,2) = 0.83",
        correct: "Gamma_nu(3,2) = 0.82",
        proof: "N' Gamma N has 0.82496 there",
    },
    Erratum {
        paper: "003",
        kind: ErratumKind::Mistake,
        place: "section III, rank of the observability matrix",
        concerns: "003-P1-global",
        printed: "we cannot determine whether the state on the fourth subsystem is estimated with usual \
                centralized observers",
        correct: "it is: x_4 lies in the part of the state that (A, C) shows, and (A, C) is detectable",
        proof: "of 20 modes 11 are observable and their space holds x_4; the other 9, -3.8 three times and \
                -1.8 +- 2i three times, decay",
    },
    Erratum {
        paper: "003",
        kind: ErratumKind::Misprint,
        place: "Fig. 6, caption",
        concerns: "fig6",
        printed: "states x_1 and x_hat_4",
        correct: "states x and x_hat_4",
        proof: "x_1 has 5 entries; the text describes solid lines for x in R^20",
    },
];
