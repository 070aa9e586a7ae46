//! Misprints of paper 000.

use super::{Erratum, ErratumKind};

/// In the order of its pages.
pub(super) const ERRATA: [Erratum; 20] = [
    Erratum {
        paper: "000",
        kind: ErratumKind::Misprint,
        place: "section III",
        concerns: "000-partition",
        printed: "v_i as a row",
        correct: "v_i = col(x_j, j /= i)",
        proof: "with three subsystems of 3 states D_1 = [A_12 A_13] has 6 columns, and the printed row [x_2 \
                x_3] has 3 rows",
    },
    Erratum {
        paper: "000",
        kind: ErratumKind::Mistake,
        place: "Remark 1",
        concerns: "000-A1",
        printed: "D_i1: the part of D_i with full column rank",
        correct: "columns chosen so that Assumption 1 holds",
        proof: "all of D has rank 3, and then the rank in Assumption 1 is 5 < 6; allowed are none, {1}, {3} \
                and {1, 3}",
    },
    Erratum {
        paper: "000",
        kind: ErratumKind::Misprint,
        place: "Remark 2",
        concerns: "000-A1",
        printed: "Phi_i = 0",
        correct: "Phi_i without rows",
        proof: "for E_i = I_3 the rows with Phi_i [E_i D_i1] = 0 form a basis of 0 vectors; a row of zeros \
                has rank 0, and Phi_i has full row rank",
    },
    Erratum {
        paper: "000",
        kind: ErratumKind::Misprint,
        place: "Proposition 1, ii and v",
        concerns: "observer",
        printed: "A_i",
        correct: "A_ii",
        proof: "T_i A_i is subtracted from N_i T_i E_i, which has 3 columns in the example: A_11 has 3, the \
                row [A_11 A_12] has 6",
    },
    Erratum {
        paper: "000",
        kind: ErratumKind::Omission,
        place: "Proposition 1",
        concerns: "000-detectable",
        printed: "the title says existence",
        correct: "detectability of (Lambda_N, L_N) is needed as well",
        proof: "the fixed modes of the example, -0.002 and -0.0004, are moved by no gain; with A_11(2,2) = 2 \
                Assumption 1 holds as before, 4 = 3 + 1, and the fixed mode is 2",
    },
    Erratum {
        paper: "000",
        kind: ErratumKind::Misprint,
        place: "before (23)",
        concerns: "R; 000-R",
        printed: "rank Sigma_i = n_ii",
        correct: "rank Sigma_i = n_i, where Sigma_i = [R_i; Phi_i A_ii; H_i]",
        proof: "n_ii has no definition; in the example Sigma_1 is 4 x 3 and has the rank 3, which is n_1",
    },
    Erratum {
        paper: "000",
        kind: ErratumKind::Misprint,
        place: "definition of Omega_i",
        concerns: "P",
        printed: "Omega_i in R^((n_i + r_phi_i + m_i) x n_i)",
        correct: "R^((beta_i + r_phi_i + m_i) x n_i)",
        proof: "in the example beta = 1, and Omega_1 = [T_bar E_bar; Phi A; H] has 4 rows; n + r_phi + m is 6",
    },
    Erratum {
        paper: "000",
        kind: ErratumKind::Misprint,
        place: "definition of Delta_Psi",
        concerns: "T",
        printed: "Omega Omega^+",
        correct: "Omega_i Omega_i^+",
        proof: "in the example Omega_1 and Omega_2 have 4 rows each, together 8: without the index Y_i, \
                which has 4 columns, could not multiply it",
    },
    Erratum {
        paper: "000",
        kind: ErratumKind::Misprint,
        place: "(34)",
        concerns: "guarantee",
        printed: "(2,4)",
        correct: "(3,2)",
        proof: "the matrix has 3 block columns; the block is n x q2, 3 x 2 in the example, and stands in row \
                3 below gamma I of 2 columns",
    },
    Erratum {
        paper: "000",
        kind: ErratumKind::Omission,
        place: "Definition of gamma",
        concerns: "guarantee",
        printed: "||e|| < gamma ||v2||",
        correct: "for eps(0) = 0",
        proof: "an initial error adds to e: with eps(0) = 0.1 and one pulse of size 1 in v2 the error of \
                subsystem 1 has the norm 0.1000, and the least gamma allows 0.0020",
    },
    Erratum {
        paper: "000",
        kind: ErratumKind::Misprint,
        place: "Theorem 2",
        concerns: "guarantee",
        printed: "there exist X_di > 0 and Omega_Yi, without Z_i; block (1,4) has Omega_Yii",
        correct: "variables X_i, Omega_Yi and Z_i; Omega_Yi in block (1,4) as everywhere else",
        proof: "Z_i stands in the blocks (2,3) and (2,4): with Z_1 = 0 and Phi_1 A_11 = [0 0 1], as for the \
                printed F_1, no gamma below 0.745 is possible; with Z_1 free 0.002004 is",
    },
    Erratum {
        paper: "000",
        kind: ErratumKind::Mistake,
        place: "section IV, orders",
        concerns: "R; 000-R",
        printed: "reduced order n_i - m_i, minimal order n_i - r_phi_i - m_i",
        correct: "n_i - rank H_i and n_i - rank [Phi_i A_ii; H_i]",
        proof: "the example has n = 3, m = 2, r_phi = 1: printed is the minimal order 0, but rank [Phi A; H] \
                = 2 leaves 1",
    },
    Erratum {
        paper: "000",
        kind: ErratumKind::Misprint,
        place: "section V, Y_1",
        concerns: "P",
        printed: "Y_1 is 1 x 5, Z_i is 3 x 5",
        correct: "1 x 4 and 3 x 4",
        proof: "I - Omega_i Omega_i^+ has beta + r_phi + m = 1 + 1 + 2 = 4 rows; the fifth column has no place",
    },
    Erratum {
        paper: "000",
        kind: ErratumKind::Misprint,
        place: "section V, last entry of Y_1",
        concerns: "N of subsystem 1",
        printed: "0- 0.27",
        correct: "-0.27",
        proof: "Y_1 is N_1 times the second row of Z_1 in every entry: -0.0020 * 135.97 = -0.27",
    },
    Erratum {
        paper: "000",
        kind: ErratumKind::NotUnique,
        place: "section V, Z_i",
        concerns: "P",
        printed: "-222.04",
        correct: "arbitrary",
        proof: "the column of I - Omega_i Omega_i^+ that it multiplies has the norm 0",
    },
    Erratum {
        paper: "000",
        kind: ErratumKind::Misprint,
        place: "section V, Q_1 Phi_1 B_1",
        concerns: "Q of subsystem 1",
        printed: "10^-12 [111 111 0; -5 -5 0; -222 -222 0]",
        correct: "[111.1 111.1 0; 0 0 0; -222.2 -222.2 0]",
        proof: "with the printed F_1, row 1 of the unbiasedness asks F12 - 0.003 Q1 = 0, so Q1 = 111.1, and \
                row 3 asks F32 - 0.003 Q3 = 1, so Q3 = -222.2: the factor belongs to the middle row alone",
    },
    Erratum {
        paper: "000",
        kind: ErratumKind::Misprint,
        place: "section V, F_1",
        concerns: "F of subsystem 1",
        printed: "[0.66 0.33; -0.33 0.33], 2 x 2",
        correct: "[2/3 1/3; 0 0; -1/3 1/3]",
        proof: "F_1 is n_1 x m_1 = 3 x 2: the middle row of zeros is lost; the printed Z_1 belongs to \
                another run, which gives [1 0; 0 0; -1 1]",
    },
    Erratum {
        paper: "000",
        kind: ErratumKind::Omission,
        place: "section V, gamma",
        concerns: "guarantee",
        printed: "X_1 = 1.3705 and X_2 = 2.3705 without the gamma that they belong to",
        correct: "the least ones are 0.002004 and 0.0008003",
        proof: "with the printed X_1 and X_2 and Q = 0 the inequality of Theorem 2 holds for gamma above \
                0.7297 = 1/X_1 and 0.4219 = 1/X_2",
    },
    Erratum {
        paper: "000",
        kind: ErratumKind::Omission,
        place: "section V, time domain and inputs",
        concerns: "fig1; fig2; fig3; fig4",
        printed: "neither the time domain nor the inputs and initial states of the figures",
        correct: "discrete time: both subsystems use Theorem 2; inputs and initial states are chosen here",
        proof: "in continuous time the interconnected plant has the eigenvalue +2.97e-4 and the observers \
                the time constant 500 s; in discrete time the largest modulus of all is 0.0027",
    },
    Erratum {
        paper: "000",
        kind: ErratumKind::Misprint,
        place: "Figures 2 and 4",
        concerns: "fig2; fig4",
        printed: "the text has e = x_hat - x",
        correct: "the legend has x - x_hat, as here",
        proof: "from x_hat(0) = 0 the second state, which starts at 0.1, has the error 0.1 by the legend and \
                -0.1 by the text",
    },
];
