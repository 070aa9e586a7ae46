//! Numbers against paper 000.

use super::{Computation, Proof, compute, designed, document, off, rank_of, tolerance};
use descry::numerics::{
    StabilityRegion, eigenvalues, h_infinity_norm, pseudo_inverse, side_by_side, stack, subspaces,
};
use descry::system::properties::finite_eigenvalues;
use descry::system::{DescriptorSystem, TimeDomain};
use nalgebra::{DMatrix, dmatrix};

const PROOFS: [(&str, Computation); 20] = [
    ("section III", row_of_states),
    ("Remark 1", decoupled_columns),
    ("Remark 2", empty_phi),
    ("Proposition 1, ii and v", own_block),
    ("Proposition 1", fixed_modes),
    ("before (23)", rank_of_sigma),
    ("definition of Omega_i", size_of_omega),
    ("definition of Delta_Psi", index_of_omega),
    ("(34)", label_of_a_block),
    ("Definition of gamma", initial_error),
    ("Theorem 2", variables),
    ("section IV, orders", orders),
    ("section V, Y_1", widths),
    ("section V, last entry of Y_1", last_entry),
    ("section V, Z_i", arbitrary_entry),
    ("section V, Q_1 Phi_1 B_1", factor_of_q),
    ("section V, F_1", lost_row),
    ("section V, gamma", gamma),
    ("section V, time domain and inputs", time_domain),
    ("Figures 2 and 4", sign_of_the_error),
];

#[test]
fn numbers_of_paper_000_are_computed() {
    compute("000", &PROOFS);
}

fn system() -> DescriptorSystem {
    document("decentralized").system().unwrap()
}

/// A subsystem of the example, with the paper's choice of the decoupled column.
struct Local {
    E: DMatrix<f64>,
    A: DMatrix<f64>,
    H: DMatrix<f64>,
    D: DMatrix<f64>,
    /// Factor on Phi = [0 0 1].
    phi: f64,
}

fn local(number: usize) -> Local {
    let system = system();
    let (own, other) = if number == 1 { (0, 3) } else { (3, 0) };
    Local {
        E: system.E.view((own, own), (3, 3)).into_owned(),
        A: system.A.view((own, own), (3, 3)).into_owned(),
        H: system.C.view((2 * own / 3, own), (2, 3)).into_owned(),
        D: system.A.view((own, other), (3, 3)).into_owned(),
        phi: 1.0,
    }
}

/// The paper's choice for both subsystems.
fn R() -> DMatrix<f64> {
    dmatrix![0.0, 1.0, 0.0]
}

impl Local {
    /// Scales Phi so that `Phi A = [0 0 1]`.
    fn scaled(self) -> Self {
        Self { phi: 1.0 / self.A[(2, 2)], ..self }
    }

    fn Phi(&self) -> DMatrix<f64> {
        dmatrix![0.0, 0.0, self.phi]
    }

    fn D2(&self) -> DMatrix<f64> {
        self.D.columns(1, 2).into_owned()
    }

    /// `T_bar` and `Omega = [T_bar E_bar; Phi A; H]`.
    fn parameterisation(&self) -> (DMatrix<f64>, DMatrix<f64>) {
        let D1 = self.D.columns(0, 1).into_owned();
        let projector = DMatrix::identity(3, 3) - &D1 * pseudo_inverse(&D1, &tolerance()).unwrap();
        let (E_bar, PhiA) = (&projector * &self.E, self.Phi() * &self.A);
        let Theta = stack(&[&E_bar, &PhiA, &self.H]);
        let T_bar = (R() * pseudo_inverse(&Theta, &tolerance()).unwrap()).columns(0, 3).into_owned();
        let Omega = stack(&[&(&T_bar * &E_bar), &PhiA, &self.H]);
        (&T_bar * projector, Omega)
    }

    fn Omega(&self) -> DMatrix<f64> {
        self.parameterisation().1
    }

    fn Omega_pinv(&self) -> DMatrix<f64> {
        pseudo_inverse(&self.Omega(), &tolerance()).unwrap()
    }

    /// `I - Omega Omega^+`.
    fn projector(&self) -> DMatrix<f64> {
        DMatrix::identity(4, 4) - self.Omega() * self.Omega_pinv()
    }

    /// `Lambda_N`, which is N where `Delta_N` is zero.
    fn Lambda_N(&self) -> f64 {
        let (T, _) = self.parameterisation();
        (T * &self.A * self.Omega_pinv())[(0, 0)]
    }

    /// `T = T_bar Pi` for `Psi = 0`.
    fn T(&self) -> DMatrix<f64> {
        self.parameterisation().0
    }

    /// Rank and required rank of Assumption 1 when these columns of D are decoupled.
    fn assumption(&self, columns: &[usize]) -> (usize, usize) {
        let D1 = self.D.select_columns(columns);
        let joint = side_by_side(&[&self.E, &D1]);
        let Phi = subspaces(&joint, 0.0, &tolerance()).unwrap().left_null.transpose();
        let PhiA = Phi * &self.A;
        let none = |rows: usize| DMatrix::zeros(rows, columns.len());
        let matrix = stack(&[
            &joint,
            &side_by_side(&[&PhiA, &none(PhiA.nrows())]),
            &side_by_side(&[&self.H, &none(self.H.nrows())]),
        ]);
        let of_columns = if columns.is_empty() { 0 } else { rank_of(&D1) };
        (rank_of(&matrix), 3 + of_columns)
    }
}

fn row_of_states(proof: &Proof) {
    // three subsystems of three states
    let A = DMatrix::<f64>::identity(9, 9);
    proof.counts("6", A.view((0, 3), (3, 6)).ncols());
    let x = DMatrix::<f64>::zeros(3, 1);
    proof.counts("3", side_by_side(&[&x, &x]).nrows());
}

fn decoupled_columns(proof: &Proof) {
    for number in 1..=2 {
        let local = local(number);
        proof.counts("3", rank_of(&local.D));
        let (found, needed) = local.assumption(&[0, 1, 2]);
        proof.counts("5", found);
        proof.counts("6", needed);
        let subsets: [&[usize]; 8] = [&[], &[0], &[1], &[2], &[0, 1], &[0, 2], &[1, 2], &[0, 1, 2]];
        let holds = |columns: &&[usize]| {
            let (found, needed) = local.assumption(columns);
            found == needed
        };
        let allowed: Vec<&[usize]> = subsets.into_iter().filter(holds).collect();
        assert_eq!(allowed, [&[][..], &[0], &[2], &[0, 2]], "none, {{1}}, {{3}} and {{1, 3}}");
    }
    proof.words("none, {1}, {3} and {1, 3}");
}

fn empty_phi(proof: &Proof) {
    let joint = side_by_side(&[&DMatrix::identity(3, 3), &local(1).D.columns(0, 1).into_owned()]);
    proof.counts("0", subspaces(&joint, 0.0, &tolerance()).unwrap().left_null.ncols());
    proof.counts("0", rank_of(&DMatrix::zeros(1, 3)));
}

fn own_block(proof: &Proof) {
    let local = local(1);
    proof.counts("3", (local.T() * &local.E).ncols());
    proof.counts("3", local.A.ncols());
    proof.counts("6", side_by_side(&[&local.A, &local.D]).ncols());
}

fn fixed_modes(proof: &Proof) {
    for (number, said) in [(1, "-0.002"), (2, "-0.0004")] {
        let local = local(number);
        assert!(local.projector().column(0).norm() < 1e-12, "Delta_N = 0: no gain has an effect on N");
        proof.says(said, local.Lambda_N());
    }
    let mut unstable = local(1);
    unstable.A[(1, 1)] = 2.0;
    let (found, needed) = unstable.assumption(&[0]);
    proof.counts("4", found);
    assert_eq!((found, needed, local(1).assumption(&[0])), (4, 4, (4, 4)), "Assumption 1, as before");
    proof.words("4 = 3 + 1");
    assert!(unstable.projector().column(0).norm() < 1e-12, "Delta_N = 0");
    proof.says("2", unstable.Lambda_N());
}

fn rank_of_sigma(proof: &Proof) {
    let local = local(1);
    let Sigma = stack(&[&R(), &(local.Phi() * &local.A), &local.H]);
    proof.size("4 x 3", &Sigma);
    proof.counts("3", rank_of(&Sigma));
}

fn size_of_omega(proof: &Proof) {
    let local = local(1);
    proof.counts("1", R().nrows());
    proof.counts("4", local.Omega().nrows());
    proof.counts("6", 3 + local.Phi().nrows() + local.H.nrows());
}

fn index_of_omega(proof: &Proof) {
    let rows: usize = (1..=2).map(|number| local(number).Omega().nrows()).sum();
    proof.counts("8", rows);
    proof.counts("4", local(1).projector().nrows());
}

fn label_of_a_block(proof: &Proof) {
    let local = local(1);
    // X in (1,1), gamma I in (2,2) and in (3,3)
    proof.counts("3", ["X", "gamma I", "gamma I"].len());
    let Q = local.Omega_pinv().columns(1, 1).into_owned();
    proof.size("3 x 2", &(Q * local.Phi() * local.D2()));
    proof.counts("2", local.D2().ncols());
}

fn initial_error(proof: &Proof) {
    let local = local(1);
    let (N, drive) = (local.Lambda_N(), -(local.T() * local.D2())[(0, 0)]);
    let (mut eps, mut sum) = (0.1_f64, 0.0);
    for k in 0..50 {
        sum += eps * eps;
        eps = N * eps + if k == 0 { drive } else { 0.0 };
    }
    proof.says("0.1000", f64::sqrt(sum));
    proof.says("0.0020", drive.abs() / (1.0 - N.abs()));
}

fn variables(proof: &Proof) {
    // Q = Omega^+ [0; I; 0] when Z = 0; Q Phi D2 has rank one, so that both norms are the same
    let scaled = local(1).scaled();
    let Q = scaled.Omega_pinv().columns(1, 1).into_owned();
    assert!(off(&(scaled.Phi() * &scaled.A), &dmatrix![0.0, 0.0, 1.0]) < 1e-15, "Phi A = [0 0 1]");
    proof.says("0.745", (Q * scaled.Phi() * scaled.D2()).norm());
    // Q = 0 by Z
    let local = local(1);
    let region = StabilityRegion::of(true);
    let (N, B) = (dmatrix![local.Lambda_N()], -(local.T() * local.D2()));
    let P = dmatrix![0.0; 1.0; 0.0];
    let norm = h_infinity_norm(&N, &B, &P, &DMatrix::zeros(3, 2), region, &tolerance()).unwrap().norm;
    proof.says("0.002004", norm);
}

fn orders(proof: &Proof) {
    let local = local(1);
    let below = stack(&[&(local.Phi() * &local.A), &local.H]);
    proof.counts("2", rank_of(&below));
    proof.counts("1", 3 - rank_of(&below));
    proof.counts("0", 3 - local.Phi().nrows() - local.H.nrows());
    assert_eq!(rank_of(&local.H), 2, "rank H = m: the reduced order is as printed");
}

fn widths(proof: &Proof) {
    let local = local(1);
    proof.counts("4", local.projector().nrows());
    assert_eq!((R().nrows(), local.Phi().nrows(), local.H.nrows()), (1, 1, 2), "1 + 1 + 2");
    proof.words("1 + 1 + 2 = 4");
}

/// The printed `Z_1` without the column that has no place.
fn Z() -> DMatrix<f64> {
    dmatrix![0.0, 0.0, 0.0, 0.0; -222.04, -0.40, -67.98, 67.98; 0.0, -0.002, 0.0, 0.0]
}

fn last_entry(proof: &Proof) {
    let Y = [0.44, 0.0008, 0.13, -0.13];
    for (y, z) in Y.into_iter().zip(Z().row(1).iter()) {
        assert!((-0.002 * z - y).abs() < 0.0061, "{y} from {z}");
    }
    proof.says("-0.27", -0.002 * 135.97);
}

fn arbitrary_entry(proof: &Proof) {
    for number in 1..=2 {
        proof.vanishes(local(number).projector().column(0).norm());
    }
}

fn factor_of_q(proof: &Proof) {
    // rows 1 and 3 of [P Q F] [T E; Phi A; H] = I, third column, with the printed F_1
    let (F12, F32, entry) = (1.0 / 3.0, 1.0 / 3.0, local(1).A[(2, 2)]);
    proof.says("111.1", -F12 / entry);
    proof.says("-222.2", (1.0 - F32) / entry);
}

fn lost_row(proof: &Proof) {
    let F = local(1).scaled().Omega_pinv().columns(2, 2).into_owned();
    proof.size("3 x 2", &F);
    let third = 1.0 / 3.0;
    let expected = dmatrix![2.0 * third, third; 0.0, 0.0; -third, third];
    assert!(off(&F, &expected) < 1e-12, "[2/3 1/3; 0 0; -1/3 1/3]: {F}");
    let local = local(1);
    let of_z = (local.Omega_pinv() - Z() * local.projector()).columns(2, 2).into_owned();
    let expected = dmatrix![1.0, 0.0; 0.0, 0.0; -1.0, 1.0];
    assert!(off(&of_z, &expected) < 0.01, "[1 0; 0 0; -1 1], to the printed digits: {of_z}");
    proof.words("[1 0; 0 0; -1 1]");
}

/// The least gamma of the inequality of Theorem 2 for a given X, with Q = 0.
fn least(local: &Local, X: f64) -> f64 {
    let (N, drive) = (local.Lambda_N(), -(local.T() * local.D2()) * X);
    let positive = |gamma: f64| {
        let mut block = DMatrix::<f64>::zeros(7, 7);
        (block[(0, 0)], block[(4, 4)]) = (X, X);
        for k in [1, 2, 3, 5, 6] {
            block[(k, k)] = gamma;
        }
        block[(0, 4)] = X * N;
        block[(2, 4)] = 1.0; // P = [0; 1; 0]
        block.view_mut((0, 5), (1, 2)).copy_from(&drive);
        block.fill_lower_triangle_with_upper_triangle();
        eigenvalues(&block).unwrap().iter().all(|z| z.re > 0.0)
    };
    let (mut below, mut above) = (0.0, 10.0);
    for _ in 0..50 {
        let middle = 0.5 * (below + above);
        if positive(middle) {
            above = middle;
        } else {
            below = middle;
        }
    }
    above
}

fn gamma(proof: &Proof) {
    for (number, X, said) in [(1, 1.3705, "0.7297"), (2, 2.3705, "0.4219")] {
        let found = least(&local(number), X);
        proof.says(said, found);
        assert!((found - 1.0 / X).abs() < 1e-4, "1/X_{number}");
    }
    let document = document("decentralized");
    let design = designed(&document, &document.design);
    for (result, said) in design.synthesis.lmi().iter().zip(["0.002004", "0.0008003"]) {
        proof.says(said, result.gamma_best.unwrap());
    }
}

fn time_domain(proof: &Proof) {
    let mut system = system();
    let values = finite_eigenvalues(&system, &tolerance()).unwrap().values;
    proof.says("0.0027", values.iter().map(|z| z.norm()).fold(0.0, f64::max));
    system.time = TimeDomain::Continuous;
    let values = finite_eigenvalues(&system, &tolerance()).unwrap().values;
    proof.says("2.97e-4", values.iter().map(|z| z.re).fold(-1.0, f64::max));
    proof.says("500", 1.0 / local(1).Lambda_N().abs());
}

fn sign_of_the_error(proof: &Proof) {
    let document = document("decentralized");
    let x = document.scenario.initial_values(6)[1];
    proof.says("0.1", x - 0.0);
    proof.says("-0.1", 0.0 - x);
}
