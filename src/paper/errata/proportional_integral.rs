//! Misprints of paper 004.

use super::Erratum;

/// In the order of its pages.
pub(super) const ERRATA: [Erratum; 13] = [
    Erratum {
        paper: "004",
        place: "after equation (4)",
        concerns: "",
        printed: "y in R^(q+m+e-r)",
        correct: "y in R^q with q = m + e - r",
        proof: "y = [-B1 u; y*] has e - r rows of the algebraic equations and m outputs",
    },
    Erratum {
        paper: "004",
        place: "equation (5)",
        concerns: "L2",
        printed: "z' = F z + L1 y + L2 y_hat + J u + T1 N f_hat",
        correct: "z' = F z + (L1 + L2) y + J u + T1 N f_hat",
        proof: "with L2 y_hat the error matrix of the example, in reduced order, has the eigenvalues -22.1 and 10.5 +- 18.8i: \
                unstable",
    },
    Erratum {
        paper: "004",
        place: "Algorithm 1",
        concerns: "T1",
        printed: "[T1 T2] = [E^+]",
        correct: "[T1 T2] = [E; C]^+",
        proof: "T1 E + T2 C = I; in the example [T1 T2] is 4 x 5, and E^+ is 4 x 2",
    },
    Erratum {
        paper: "004",
        place: "before equation (16)",
        concerns: "",
        printed: "input observable",
        correct: "impulse observable",
        proof: "the property that is used is Definition 3",
    },
    Erratum {
        paper: "004",
        place: "equation (19)",
        concerns: "M1",
        printed: "x_hat = E1^+ x1_hat + P1 x2_hat",
        correct: "x_hat = E^+ x1_hat + P1 x2_hat",
        proof: "P = [E^+ P1] with inverse [E; P1']",
    },
    Erratum {
        paper: "004",
        place: "Theorem 4",
        concerns: "004-22",
        printed: "(12) and rank E = r",
        correct: "(12), (11) and rank E = r",
        proof: "E = [1 0 0; 0 1 0], A = [0 0 1; 0 0 0], N = [0; 1], C = [1 0 0; 0 1 0] satisfies (12) for every s, \
                but rank [E; C] = 2 < 3, so C2^+ does not exist",
    },
    Erratum {
        paper: "004",
        place: "equations (22), (23) and appendix",
        concerns: "004-23",
        printed: "s I_n in the reduced test",
        correct: "s I_r",
        proof: "the pencil has r + nf columns",
    },
    Erratum {
        paper: "004",
        place: "Algorithm 2",
        concerns: "",
        printed: "[A1 A2] = A P2",
        correct: "[A1 A2] = A P",
        proof: "P2 is not defined; P = [E^+ P1]",
    },
    Erratum {
        paper: "004",
        place: "section IV, case 1",
        concerns: "",
        printed: "A~* = A* (I + Delta A)",
        correct: "a~_ij = a_ij (1 + Delta a_ij), entry by entry",
        proof: "the matrix product mixes columns and contradicts the entries printed below it",
    },
    Erratum {
        paper: "004",
        place: "section IV, bounds of the uncertainty",
        concerns: "",
        printed: "|delta_ij| < 10",
        correct: "in percent: |delta_ij| < 0.1",
        proof: "as a number, delta_34 may pass -1, where det A22 = -(1 + delta_34) (1 + delta_43) is 0 and the plant loses index 1",
    },
    Erratum {
        paper: "004",
        place: "section IV, check of (8)",
        concerns: "004-8",
        printed: "rank [E* N*; C* 0] = rank E*",
        correct: "rank [E* N*] = rank E*",
        proof: "both matrices of (8) have rank 2 in the example, the printed one has rank 2 as well and proves nothing",
    },
    Erratum {
        paper: "004",
        place: "appendix, proof of (12)",
        concerns: "004-10",
        printed: "Re s > 0 and s = 0",
        correct: "Re s >= 0 with s /= 0, and s = 0",
        proof: "the imaginary axis without the origin is left out",
    },
    Erratum {
        paper: "004",
        place: "appendix, left factor of (13)",
        concerns: "004-13",
        printed: "(8) and (9) suffice for (12) <=> (13)",
        correct: "T1 must have full column rank, which the third alternative of (8) does not give",
        proof: "E* = diag(1, 0), A* = [1 0; 1 1], N* = [0; 1], C* = [0 1] satisfies (8), (9) and (10), but the T1 of the \
                pseudo-inverse leaves the modes 1 and 0 unobservable",
    },
];
