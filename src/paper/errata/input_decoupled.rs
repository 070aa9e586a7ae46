//! Misprints of paper 001, and what it leaves open.

use super::{Erratum, ErratumKind};

/// In the order of its pages.
pub(super) const ERRATA: [Erratum; 5] = [
    Erratum {
        paper: "001",
        kind: ErratumKind::Omission,
        place: "(4)",
        concerns: "A_tilde",
        printed: "A_bar21, A_bar22, D_bar1, C_bar21, C_bar22 and F_bar are used without a definition",
        correct: "[A_bar21 A_bar22 D_bar1] = [A2 D1] P, [C_bar21 C_bar22 F_bar] = [C2 F] P",
        proof: "with these the printed A~1, B~1, C~1 and W1 W2+ of the example come out to 1e-14",
    },
    Erratum {
        paper: "001",
        kind: ErratumKind::Omission,
        place: "Theorem 2",
        concerns: "N",
        printed: "N is used without a definition",
        correct: "x = N [x1; x2], where M E N = diag(I_r, 0)",
        proof: "E of the example is diag(I_2, 0) already: with M = I and N = I the printed K, T1 and T2 come out to 1e-14",
    },
    Erratum {
        paper: "001",
        kind: ErratumKind::Omission,
        place: "section III, W2+",
        concerns: "W1W2_pinv",
        printed: "W2+ = [-2/3 -1/3 1/3; 1 1 0], without the P that it belongs to",
        correct: "it belongs to P = [1 0 1; 0 2 1; 0 -1 -1]; other P give another W2+ and the same W1 W2+",
        proof: "[A4 D2] P = [1 0 0], det P = -1, and the pseudo-inverse of its W2 is the printed one to 1e-14",
    },
    Erratum {
        paper: "001",
        kind: ErratumKind::NotUnique,
        place: "section III, L",
        concerns: "L",
        printed: "L = [0 6 1; 6 2 0]",
        correct: "any L with L [1; -1; 1] / 3 = [-5/3; 4/3], for example [-5/3 5/3 -5/3; 4/3 -4/3 4/3]",
        proof: "only L (I - W2 W2+) acts, and I - W2 W2+ = [1; -1; 1] [1 -1 1] / 3 has rank 1: both L give the same H",
    },
    Erratum {
        paper: "001",
        kind: ErratumKind::Misprint,
        place: "section III, d_hat",
        concerns: "G",
        printed: "G = [5/3 4/3]",
        correct: "G = [5/3 -4/3]",
        proof: "A3 x1 + A4 x2 + B2 u + D2 d must vanish: its coefficient of z is [0 0] with -4/3 and [0 16/3] with +4/3",
    },
];
