//! Misprints of paper 002; where the text of its web edition, copied, says other than its formulas may show, the entry says so.

use super::{Erratum, ErratumKind};

/// In the order of its pages.
pub(super) const ERRATA: [Erratum; 14] = [
    Erratum {
        paper: "002",
        kind: ErratumKind::Misprint,
        place: "(5)",
        concerns: "observer",
        printed: "f(t, F_L, x_hat, u), in the copied text",
        correct: "f(t, F_L x_hat, u)",
        proof: "(1) gives f 3 arguments, the copied text 4; in the example F_L x_hat is 1 x 1, F_L is 1 x 3 \
                and x_hat 3 x 1",
    },
    Erratum {
        paper: "002",
        kind: ErratumKind::Misprint,
        place: "(12)",
        concerns: "guarantee",
        printed: "D = [phi1; phi2], in the italic letter of system (1)",
        correct: "double-struck D, as (12) itself has it",
        proof: "in the example D of (1) is 3 x 1, and [phi1; phi2] is 5 x 2",
    },
    Erratum {
        paper: "002",
        kind: ErratumKind::Misprint,
        place: "(13)",
        concerns: "guarantee",
        printed: "E' Y = Y', E >= 0, in the copied text",
        correct: "E' Y = Y' E >= 0, as after (15)",
        proof: "of the 25 entries of Y in the example the copied equation leaves 3 free and makes the others \
                0, so that Q2 = 0 and block (2,2) of (20), which must be negative, has the eigenvalue mu \
                lambda^2 = 1 for mu = lambda = 1",
    },
    Erratum {
        paper: "002",
        kind: ErratumKind::Misprint,
        place: "(14), (22) and Remark 7",
        concerns: "002-lipschitz",
        printed: "lambda_1^2; in the result of Remark 7 mu lambda_1 F_L' F_L, without the square",
        correct: "lambda^2; in the result of Remark 7 mu lambda^2 P' F_L' F_L P",
        proof: "there is one Lipschitz constant: for lambda = 2 the square is 4, the result of Remark 7 \
                counts 2; in the example F_L' F_L is 3 x 3 and N' X1, to which it is added, is 2 x 2",
    },
    Erratum {
        paper: "002",
        kind: ErratumKind::Misprint,
        place: "(18), (25)",
        concerns: "guarantee",
        printed: "eps as the vector of the error system",
        correct: "xi = [eps; e]",
        proof: "in the example Y is 5 x 5; eps has 2 entries, xi has 5",
    },
    Erratum {
        paper: "002",
        kind: ErratumKind::Misprint,
        place: "(27)",
        concerns: "guarantee",
        printed: "mu lambda^2 xi' rho xi, where rho = blkdiag(0, lambda^2 F_L' F_L)",
        correct: "mu xi' rho xi",
        proof: "lambda is counted twice: for lambda = 2, mu = 1 and F_L e = 1 the term is 16, the bound of \
                (26) gives 4",
    },
    Erratum {
        paper: "002",
        kind: ErratumKind::Misprint,
        place: "(36)",
        concerns: "guarantee",
        printed: "Y = X E + E_perp' Q, with the italic E of system (1)",
        correct: "Y = X E + E_perp' Q, with the double-struck E of (12)",
        proof: "in the example X is 5 x 5, the italic E is 3 x 3 and the double-struck E is 5 x 5",
    },
    Erratum {
        paper: "002",
        kind: ErratumKind::Misprint,
        place: "before (38)",
        concerns: "T",
        printed: "T = T + Psi Phi, in the copied text, which loses the tilde",
        correct: "T~ = T + Psi Phi",
        proof: "with T~ in the place of T the residual of (8) is 1.414 for the printed N and J; with T = T~ \
                - Psi Phi it is 0.0007, the rounding of the printed digits",
    },
    Erratum {
        paper: "002",
        kind: ErratumKind::Misprint,
        place: "definition of Omega",
        concerns: "P",
        printed: "Omega = [T E; Phi A; C], in the copied text, which loses the tilde",
        correct: "Omega = [T~ E; Phi A; C]",
        proof: "Phi E = 0, so T E and T~ E differ by 0, and both give the printed P, (1/17) [0 -6; 17 0; 0 \
                12]; but T is known only with Psi, which (47) takes from Omega",
    },
    Erratum {
        paper: "002",
        kind: ErratumKind::Misprint,
        place: "(45) and (46)",
        concerns: "002-R",
        printed: "the rows in the order E, C, Phi A, in the copied text",
        correct: "[E; Phi A; C]",
        proof: "Omega^+ of [T~ E; Phi A; C] has Q = 0.2353 and F = 0.7647 in its first row, printed 0.235 \
                and 0.764; with C before Phi A the two change places",
    },
    Erratum {
        paper: "002",
        kind: ErratumKind::Misprint,
        place: "(51), Delta_TD",
        concerns: "observer",
        printed: "Delta_TD = -Delta_Psi Lambda Phi D, in the copied text",
        correct: "Delta_TD = -Delta_Psi Phi D, Lambda_phi2 = Lambda_Q Phi D1 + Lambda_F D2",
        proof: "Lambda belongs to the next symbol: without it the printed Omega_X1 and X1 give T D = \
                [-0.337; -0.749], printed is [-0.331; -0.747]",
    },
    Erratum {
        paper: "002",
        kind: ErratumKind::Misprint,
        place: "Theorem 10, gamma",
        concerns: "guarantee",
        printed: "scalars mu and gamma such that (52) holds",
        correct: "mu and gamma^2: (52) is linear in gamma^2, and the guarantee is ||e|| < gamma ||w||",
        proof: "the least gamma^2 of the example is 4.616, which guarantees 2.148; taken for gamma it would \
                be more than twice as much. The block -gamma^2 I has -1, -4 and -9 for gamma = 1, 2, 3",
    },
    Erratum {
        paper: "002",
        kind: ErratumKind::Misprint,
        place: "(53), block (1,4)",
        concerns: "guarantee",
        printed: "Q1' Lambda_phi1",
        correct: "Q1' Lambda_phi2",
        proof: "in the example Q1' is 2 x 3 and Lambda_phi1 is 2 x 2: (2 x 3)(2 x 2) has no meaning, \
                Lambda_phi2 is 3 x 2; (23) itself has phi2",
    },
    Erratum {
        paper: "002",
        kind: ErratumKind::Misprint,
        place: "section 4",
        concerns: "guarantee",
        printed: "gamma^2 = 9.762",
        correct: "gamma = 9.762",
        proof: "with the printed gains and lambda = 1 the least provable gamma^2 is 17.62, and the slope +1 \
                of the sine alone gives the norm 4.198 > 3.124",
    },
];
