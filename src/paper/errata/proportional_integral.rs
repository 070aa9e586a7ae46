//! Misprints of paper 004.

use super::{Erratum, ErratumKind};

/// In the order of its pages.
pub(super) const ERRATA: [Erratum; 14] = [
    Erratum {
        paper: "004",
        kind: ErratumKind::Misprint,
        place: "after equation (4)",
        concerns: "observer",
        printed: "y in R^(q+m+e-r)",
        correct: "y in R^q with q = m + e - r",
        proof: "y = [-B1 u; y*] has e - r rows of the algebraic equations and m outputs: 3 in the example, \
                where q + m + e - r is 6",
    },
    Erratum {
        paper: "004",
        kind: ErratumKind::Misprint,
        place: "equation (5)",
        concerns: "L2",
        printed: "z' = F z + L1 y + L2 y_hat + J u + T1 N f_hat",
        correct: "z' = F z + (L1 + L2) y + J u + T1 N f_hat",
        proof: "with L2 y_hat the error matrix of the example, in reduced order, has the eigenvalues -22.1 \
                and 10.5 +- 18.8i: unstable",
    },
    Erratum {
        paper: "004",
        kind: ErratumKind::Omission,
        place: "Theorem 4",
        concerns: "004-22",
        printed: "(12) and rank E = r",
        correct: "(12), (11) and rank E = r",
        proof: "E = [1 0 0; 0 1 0], A = [0 0 1; 0 0 0], N = [0; 1], C = [1 0 0; 0 1 0] satisfies (12) for \
                every s, but rank [E; C] = 2 < 3, so C2^+ does not exist",
    },
    Erratum {
        paper: "004",
        kind: ErratumKind::Misprint,
        place: "Algorithm 1",
        concerns: "T1",
        printed: "[T1 T2] = [E^+]",
        correct: "[T1 T2] = [E; C]^+",
        proof: "T1 E + T2 C = I; in the example [T1 T2] is 4 x 5, and E^+ is 4 x 2",
    },
    Erratum {
        paper: "004",
        kind: ErratumKind::Misprint,
        place: "before equation (16)",
        concerns: "004-22",
        printed: "input observable",
        correct: "impulse observable",
        proof: "with C* = [1 0 0 0] in the example a constant unknown input is not observed, (10) has the \
                rank 4 < 5 at s = 0, and still rank C2 = 2 = n - r; (9), 6 = 4 + 2, is the property that C2 \
                needs, Definition 3",
    },
    Erratum {
        paper: "004",
        kind: ErratumKind::Misprint,
        place: "equation (19)",
        concerns: "M1",
        printed: "x_hat = E1^+ x1_hat + P1 x2_hat",
        correct: "x_hat = E^+ x1_hat + P1 x2_hat",
        proof: "P = [E^+ P1] has the inverse [E; P1'], and the next line has E^+ itself: in the example E^+ \
                is 4 x 2, and with it M1 E + T2 C - I is 0; E1 has no definition",
    },
    Erratum {
        paper: "004",
        kind: ErratumKind::Misprint,
        place: "equations (22), (23) and appendix",
        concerns: "004-23",
        printed: "s I_n in the reduced test",
        correct: "s I_r",
        proof: "the pencil has r + nf columns, 3 in the example; with s I_n it would have 5, and Ar is 2 x 2",
    },
    Erratum {
        paper: "004",
        kind: ErratumKind::Misprint,
        place: "Algorithm 2",
        concerns: "Ar",
        printed: "[A1 A2] = A P2",
        correct: "[A1 A2] = A P",
        proof: "P2 = [P3; C2^+] of (16) is 3 x 3 in the example and A is 2 x 4: (2 x 4)(3 x 3) has no \
                meaning; P = [E^+ P1] is 4 x 4",
    },
    Erratum {
        paper: "004",
        kind: ErratumKind::Mistake,
        place: "section IV, case 1",
        concerns: "uncertainty",
        printed: "A~* = A* (I + Delta A)",
        correct: "a~_ij = a_ij (1 + Delta a_ij), entry by entry",
        proof: "the product mixes columns: Delta a_13 = 0.09 alone leaves a_13 = 1 as it is and makes a_23 = \
                0.09 and a_33 = -0.09, which are to stay 0",
    },
    Erratum {
        paper: "004",
        kind: ErratumKind::Omission,
        place: "section IV, bounds of the uncertainty",
        concerns: "uncertainty",
        printed: "|delta_ij| < 10",
        correct: "in percent: |delta_ij| < 0.1",
        proof: "as a number, delta_34 may pass -1, where det A22 = -(1 + delta_34) (1 + delta_43) is 0 and \
                the plant loses index 1",
    },
    Erratum {
        paper: "004",
        kind: ErratumKind::Misprint,
        place: "section IV, check of (8)",
        concerns: "004-8",
        printed: "rank [E* N*; C* 0] = rank E*",
        correct: "rank [E* N*] = rank E*",
        proof: "both matrices of (8) have rank 2 in the example; the printed one has rank 2 only because C* \
                lies in the rows of E*: with C* = [0 0 1 0] it has rank 3, and (8) holds as before",
    },
    Erratum {
        paper: "004",
        kind: ErratumKind::Mistake,
        place: "section IV, bandwidth",
        concerns: "fig9",
        printed: "the bandwidth of the observer obtained for 0.1 Lambda is less than 3.3 rad/s",
        correct: "3.3 is max |0.1 Lambda|; the bandwidth from f to f_hat is about a third of it",
        proof: "in reduced order |f_hat / f| falls below 1/sqrt(2) at 1.09 rad/s; at the 4 rad/s of f it is \
                0.108, at 3.3 rad/s 0.164",
    },
    Erratum {
        paper: "004",
        kind: ErratumKind::Omission,
        place: "appendix, proof of (12)",
        concerns: "004-10",
        printed: "Re s > 0 and s = 0",
        correct: "Re s >= 0 with s /= 0, and s = 0",
        proof: "the imaginary axis without the origin is left out: E = I, A = [0 1 0; -1 0 0; 0 0 -1], N = \
                [0; 0; 1], C = [0 0 1] has the rank 4 of (12) wherever Re s > 0 and at s = 0, but rank 3 at \
                s = i",
    },
    Erratum {
        paper: "004",
        kind: ErratumKind::Mistake,
        place: "appendix, left factor of (13)",
        concerns: "004-13",
        printed: "(8) and (9) suffice for (12) <=> (13)",
        correct: "T1 must have full column rank, which the third alternative of (8) does not give",
        proof: "E* = diag(1, 0), A* = [1 0; 1 1], N* = [0; 1], C* = [0 1] satisfies (8), (9) and (10), but \
                the T1 of the pseudo-inverse leaves the modes 1 and 0 unobservable",
    },
];
