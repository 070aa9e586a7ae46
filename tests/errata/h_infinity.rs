//! Numbers against paper 002.

use super::{Computation, Proof, compute, document, off, rank_of, tolerance};
use descry::document::PlantData;
use descry::numerics::{Watch, eigenvalues, null_space, pseudo_inverse, stack};
use descry::observer::{Design, DesignChoice, GivenObserver, LmiChoice, LmiResult, assess};
use nalgebra::{DMatrix, dmatrix};

const PROOFS: [(&str, Computation); 14] = [
    ("(5)", arguments),
    ("(12)", letters_of_12),
    ("(13)", symmetry),
    ("(14), (22) and Remark 7", lipschitz_constant),
    ("(18), (25)", vector),
    ("(27)", counted_twice),
    ("(36)", letters_of_36),
    ("before (38)", tilde_of_t),
    ("definition of Omega", tilde_of_omega),
    ("(45) and (46)", order_of_rows),
    ("(51), Delta_TD", delta_td),
    ("Theorem 10, gamma", gamma_and_its_square),
    ("(53), block (1,4)", block_14),
    ("section 4", printed_gamma),
];

#[test]
fn numbers_of_paper_002_are_computed() {
    compute("002", &PROOFS);
}

/// The example, in the paper's letters.
struct Example {
    E: DMatrix<f64>,
    A: DMatrix<f64>,
    D: DMatrix<f64>,
    D1: DMatrix<f64>,
    C: DMatrix<f64>,
    D2: DMatrix<f64>,
    F_L: DMatrix<f64>,
    Phi: DMatrix<f64>,
    R: DMatrix<f64>,
}

fn example() -> Example {
    let document = document("h-infinity-lipschitz");
    let system = document.system().unwrap();
    let PlantData::Descriptor(data) = &document.plant else { panic!("a descriptor system") };
    let term = data.lipschitz.as_ref().unwrap();
    Example {
        E: system.E,
        A: system.A,
        D: term.G.values(),
        D1: system.D,
        C: system.C,
        D2: system.F,
        F_L: term.F_L.values(),
        Phi: dmatrix![0.0, 0.0, 1.0],
        R: dmatrix![0.0, 1.0, 0.0; 0.0, 0.0, 1.0],
    }
}

impl Example {
    fn q(&self) -> usize {
        self.R.nrows()
    }

    fn n(&self) -> usize {
        self.E.ncols()
    }

    /// `T~` of (46).
    fn T_tilde(&self) -> DMatrix<f64> {
        let joint = stack(&[&self.E, &(&self.Phi * &self.A), &self.C]);
        (&self.R * pseudo_inverse(&joint, &tolerance()).unwrap()).columns(0, 3).into_owned()
    }

    /// `Omega = [T~ E; Phi A; C]`.
    fn Omega(&self) -> DMatrix<f64> {
        stack(&[&(self.T_tilde() * &self.E), &(&self.Phi * &self.A), &self.C])
    }

    fn Omega_pinv(&self) -> DMatrix<f64> {
        pseudo_inverse(&self.Omega(), &tolerance()).unwrap()
    }

    /// `phi1 = J D2 - T D1` and `phi2 = Q Phi D1 + F D2`, one above the other.
    fn phi(&self) -> DMatrix<f64> {
        let pinv = self.Omega_pinv();
        let (Q, F) = (pinv.columns(2, 1).into_owned(), pinv.columns(3, 1).into_owned());
        stack(&[&(J() * &self.D2 - T(self) * &self.D1), &(Q * &self.Phi * &self.D1 + F * &self.D2)])
    }
}

/// The printed gains.
fn N() -> DMatrix<f64> {
    dmatrix![0.0, -1.996; 0.666, -2.121]
}

fn J() -> DMatrix<f64> {
    dmatrix![-0.331; -1.414]
}

/// `T = T~ - Psi Phi` of the printed N: `N = [0 a; 2/3 b]` belongs to `Psi = -(2/3) [a; b]`.
fn T(example: &Example) -> DMatrix<f64> {
    let Psi = N().columns(1, 1) * (-2.0 / 3.0);
    example.T_tilde() - Psi * &example.Phi
}

fn arguments(proof: &Proof) {
    let example = example();
    let printed = proof.erratum.printed;
    let inside = printed.split_once('(').and_then(|(_, rest)| rest.split_once(')')).unwrap().0;
    proof.counts("4", inside.split(',').count());
    let correct = proof.erratum.correct.matches(',').count() + 1;
    proof.counts("3", correct);
    proof.size("1 x 3", &example.F_L);
    proof.size("1 x 1", &(&example.F_L * DMatrix::zeros(3, 1)));
}

fn letters_of_12(proof: &Proof) {
    proof.size("3 x 1", &example().D);
    proof.size("5 x 2", &example().phi());
}

fn symmetry(proof: &Proof) {
    let example = example();
    let size = example.q() + example.n();
    // the linear map Y -> E' Y - Y' on the entries of Y, column by column
    let mut E = DMatrix::zeros(size, size);
    E.view_mut((0, 0), (example.q(), example.q())).fill_with_identity();
    let mut map = DMatrix::zeros(size * size, size * size);
    for k in 0..size * size {
        let mut unit = DMatrix::zeros(size, size);
        unit[k] = 1.0;
        let image = E.tr_mul(&unit) - unit.transpose();
        map.column_mut(k).copy_from_slice(image.as_slice());
    }
    proof.counts("25", map.ncols());
    let free = null_space(&map, 0.0, &tolerance()).unwrap();
    proof.counts("3", free.ncols());
    // Q2 stands in the lower right of Y
    for j in example.q()..size {
        let below = free.rows(j * size + example.q(), example.n());
        assert!(below.amax() < 1e-14, "Q2 = 0: column {j}");
    }
    let block = example.F_L.tr_mul(&example.F_L);
    let largest = eigenvalues(&block).unwrap().iter().map(|z| z.re).fold(0.0, f64::max);
    proof.says("1", largest);
}

fn lipschitz_constant(proof: &Proof) {
    let (example, lambda) = (example(), 2.0_f64);
    proof.says("4", lambda.powi(2));
    proof.says("2", lambda);
    proof.size("3 x 3", &example.F_L.tr_mul(&example.F_L));
    proof.size("2 x 2", &N());
    let P = example.Omega_pinv().columns(0, 2).into_owned();
    assert_eq!((&example.F_L * &P).tr_mul(&(&example.F_L * &P)).shape(), (2, 2), "P' F_L' F_L P fits");
}

fn vector(proof: &Proof) {
    let example = example();
    let size = example.q() + example.n();
    proof.size("5 x 5", &DMatrix::zeros(size, size));
    proof.counts("2", example.q());
    proof.counts("5", size);
}

fn counted_twice(proof: &Proof) {
    let (example, lambda, mu) = (example(), 2.0_f64, 1.0);
    let e = dmatrix![0.0; 1.0; 0.0];
    let bound = lambda.powi(2) * (&example.F_L * &e).norm_squared();
    let rho = example.F_L.tr_mul(&example.F_L) * lambda.powi(2);
    proof.says("4", mu * bound);
    proof.says("16", mu * lambda.powi(2) * (e.transpose() * rho * &e)[(0, 0)]);
}

fn letters_of_36(proof: &Proof) {
    let example = example();
    proof.size("3 x 3", &example.E);
    let size = example.q() + example.n();
    proof.size("5 x 5", &DMatrix::zeros(size, size));
}

fn tilde_of_t(proof: &Proof) {
    let example = example();
    let residual = |T: &DMatrix<f64>| (N() * T * &example.E - T * &example.A + J() * &example.C).amax();
    proof.says("1.414", residual(&example.T_tilde()));
    proof.says("0.0007", residual(&T(&example)));
}

fn tilde_of_omega(proof: &Proof) {
    let example = example();
    proof.vanishes((&example.Phi * &example.E).amax());
    proof.vanishes(off(&(T(&example) * &example.E), &(example.T_tilde() * &example.E)));
    let P = example.Omega_pinv().columns(0, 2) * 17.0;
    assert!(off(&P, &dmatrix![0.0, -6.0; 17.0, 0.0; 0.0, 12.0]) < 1e-13, "P");
    proof.words("(1/17) [0 -6; 17 0; 0 12]");
}

fn order_of_rows(proof: &Proof) {
    let example = example();
    let pinv = example.Omega_pinv();
    proof.says("0.2353", pinv[(0, 2)]);
    proof.says("0.7647", pinv[(0, 3)]);
    let exchanged = stack(&[&(example.T_tilde() * &example.E), &example.C, &(&example.Phi * &example.A)]);
    let exchanged = pseudo_inverse(&exchanged, &tolerance()).unwrap();
    for (ours, theirs) in [(2, 3), (3, 2)] {
        let off = off(&pinv.columns(ours, 1).into_owned(), &exchanged.columns(theirs, 1).into_owned());
        assert!(off < 1e-14, "Q and F change places: off by {off:.1e}");
    }
}

fn delta_td(proof: &Proof) {
    let example = example();
    let (pinv, A) = (example.Omega_pinv(), &example.A);
    let projector = DMatrix::identity(4, 4) - example.Omega() * &pinv;
    let Omega_X1 = dmatrix![-4.183, 0.5; -0.331, -0.11; -0.567, 0.276; -0.045, 0.627] * 100.0;
    let X1 = dmatrix![3.919, -2.628; -2.628, 5.139];
    let Z1 = X1.try_inverse().unwrap() * Omega_X1.transpose();
    let PhiD = &example.Phi * &example.D;
    let Lambda = example.T_tilde() * &example.D - example.T_tilde() * A * pinv.columns(2, 1) * &PhiD;
    let Delta = -(projector.columns(2, 1) * &PhiD);
    let found = Lambda - Z1 * Delta;
    proof.says("-0.337", found[0]);
    proof.says("-0.749", found[1]);
    proof.words("printed is [-0.331; -0.747]");
}

fn assessed(lmi: LmiChoice) -> Design {
    let document = document("h-infinity-lipschitz");
    let choice = DesignChoice { lmi, ..document.design.clone() };
    let model = document.model().unwrap();
    assess(&model, &choice, &tolerance(), &Watch::none()).unwrap().outcome.unwrap()
}

fn result(design: &Design) -> &LmiResult {
    &design.synthesis.lmi()[0]
}

fn gamma_and_its_square(proof: &Proof) {
    let design = assessed(LmiChoice { rows: vec![example().R], ..LmiChoice::default() });
    let least = result(&design).gamma_best.unwrap();
    proof.says("4.616", least * least);
    proof.says("2.148", least);
    assert!(least * least > 2.0 * least, "more than twice as much");
    for (gamma, block) in [(1.0_f64, "-1"), (2.0, "-4"), (3.0, "-9")] {
        proof.says(block, -gamma.powi(2));
    }
}

fn block_14(proof: &Proof) {
    let example = example();
    let Q1 = DMatrix::<f64>::zeros(example.n(), example.q());
    proof.size("2 x 3", &Q1.transpose());
    proof.size("2 x 2", &example.phi().rows(0, example.q()).into_owned());
    proof.size("3 x 2", &example.phi().rows(example.q(), example.n()).into_owned());
    assert_eq!(rank_of(&example.R), example.q(), "q = 2");
}

fn printed_gamma(proof: &Proof) {
    let given = GivenObserver { N: N(), J: J(), gamma: Some(9.762_f64.sqrt()) };
    let design = assessed(LmiChoice { given: Some(given), rows: vec![example().R], ..LmiChoice::default() });
    let result = result(&design);
    let least = result.gamma_best.unwrap();
    proof.says("17.62", least * least);
    let slope = result.bounds.iter().find(|(name, _)| name == "frozen slope +1").unwrap().1;
    proof.says("4.198", slope);
    proof.says("3.124", 9.762_f64.sqrt());
}
