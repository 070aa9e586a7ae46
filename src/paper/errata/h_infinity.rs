//! Misprints of paper 002.

use super::Erratum;

/// In the order of its pages.
pub(super) const ERRATA: [Erratum; 12] = [
    Erratum {
        paper: "002",
        place: "before (38)",
        concerns: "T",
        printed: "T = T + Psi Phi",
        correct: "T~ = T + Psi Phi",
        proof: "(38) gives T~ from R; only T = T~ - Psi Phi makes N T E - T A + J C = 0",
    },
    Erratum {
        paper: "002",
        place: "definition of Omega",
        concerns: "",
        printed: "Omega = [T E; Phi A; C]",
        correct: "Omega = [T~ E; Phi A; C]",
        proof: "(47) uses T~ A Omega^+, and the printed P, Q and F follow from T~: (1/17) [0 -6; 17 0; 0 12] \
                and so on",
    },
    Erratum {
        paper: "002",
        place: "(53), block (1,4)",
        concerns: "",
        printed: "Q1' Lambda_phi1",
        correct: "Q1' Lambda_phi2",
        proof: "Q1' is q x n and Lambda_phi1 is q x nw: the product has no meaning; (23) itself has phi2",
    },
    Erratum {
        paper: "002",
        place: "after (53)",
        concerns: "",
        printed: "Delta_TD = -Delta_Psi Lambda Phi D",
        correct: "Delta_TD = -Delta_Psi Phi D",
        proof: "Lambda belongs to the next symbol, Lambda_phi2",
    },
    Erratum {
        paper: "002",
        place: "(13)",
        concerns: "",
        printed: "E' Y = Y', E >= 0",
        correct: "E' Y = Y' E >= 0",
        proof: "the condition of the bounded real lemma for singular systems",
    },
    Erratum {
        paper: "002",
        place: "(12)",
        concerns: "",
        printed: "B = [T D; -Q Phi D], D = [phi1; phi2] with one letter D for two matrices",
        correct: "the second is the disturbance matrix of the error system, in double-struck letters",
        proof: "the dimensions are those of phi1 and phi2",
    },
    Erratum {
        paper: "002",
        place: "(14), (22) and Remark 7",
        concerns: "",
        printed: "lambda_1^2",
        correct: "lambda^2",
        proof: "there is one Lipschitz constant; Remark 7 moreover needs P' F_L' F_L P",
    },
    Erratum {
        paper: "002",
        place: "(18), (25)",
        concerns: "",
        printed: "eps as the vector of the error system",
        correct: "xi",
        proof: "the vector holds eps and e",
    },
    Erratum {
        paper: "002",
        place: "(29), (35)",
        concerns: "",
        printed: "rho = blkdiag(0, I + lambda^2 F_L' F_L)",
        correct: "rho = blkdiag(0, I + mu lambda^2 F_L' F_L)",
        proof: "the multiplier mu of the Lipschitz bound is missing; (27) counts lambda twice",
    },
    Erratum {
        paper: "002",
        place: "(36)",
        concerns: "",
        printed: "Y = X E + E_perp Q",
        correct: "Y = X E + E_perp' Q",
        proof: "dimensions",
    },
    Erratum {
        paper: "002",
        place: "(5)",
        concerns: "",
        printed: "f(t, F_L, x_hat, u)",
        correct: "f(t, F_L x_hat, u)",
        proof: "f depends on F_L x alone",
    },
    Erratum {
        paper: "002",
        place: "section 4",
        concerns: "gamma",
        printed: "gamma^2 = 9.762",
        correct: "gamma = 9.762",
        proof: "with the printed gains and lambda = 1 the least provable gamma^2 is 17.62, and the slope +1 of \
                the sine alone gives the norm 4.198 > 3.124",
    },
];
