//! Random pencils and systems of planted structure.
#![cfg(not(target_arch = "wasm32"))]
#![expect(clippy::unwrap_used, reason = "helpers of tests, which clippy takes for library code")]

use descry::numerics::{
    Complex64, ModePosition, RankDrop, Tolerance, pencil_structure, rank_drop_points, spectral_distance,
};
use descry::system::properties::{
    finite_eigenvalues, impulse_observability, index, r_detectability, r_observability, regularity,
};
use descry::system::{DescriptorSystem, TimeDomain};
use nalgebra::{DMatrix, DVector};
use proptest::collection::vec;
use proptest::prelude::*;
use proptest::test_runner::RngSeed;

fn config() -> ProptestConfig {
    ProptestConfig {
        cases: 64,
        rng_seed: RngSeed::Fixed(4),
        failure_persistence: None,
        ..ProptestConfig::default()
    }
}

/// Uniform numbers from a seed (splitmix64).
struct Random(u64);

impl Random {
    fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }

    fn matrix(&mut self, rows: usize, columns: usize) -> DMatrix<f64> {
        DMatrix::from_fn(rows, columns, |_, _| self.between(-1.0, 1.0))
    }

    /// `Q1 diag Q2` with entries of the diagonal between 1/2 and 2: dense, and safely nonsingular.
    fn transformation(&mut self, n: usize) -> DMatrix<f64> {
        let diagonal = DVector::from_fn(n, |_, _| self.between(0.5, 2.0));
        self.matrix(n, n).qr().q() * DMatrix::from_diagonal(&diagonal) * self.matrix(n, n).qr().q()
    }

    /// Real block-diagonal matrix of simple eigenvalues and conjugate pairs, of size n, and its eigenvalues.
    fn finite_part(&mut self, n: usize) -> (DMatrix<f64>, Vec<Complex64>) {
        let (mut matrix, mut values) = (DMatrix::zeros(n, n), Vec::new());
        while values.len() < n {
            let (i, re) = (values.len(), self.between(-4.0, 2.0));
            matrix[(i, i)] = re;
            if i + 1 < n && self.unit() < 0.5 {
                let im = self.between(0.2, 5.0);
                matrix[(i + 1, i + 1)] = re;
                (matrix[(i, i + 1)], matrix[(i + 1, i)]) = (im, -im);
                values.extend([Complex64::new(re, im), Complex64::new(re, -im)]);
            } else {
                values.push(Complex64::from(re));
            }
        }
        (matrix, values)
    }
}

/// Ones on the k-th superdiagonal.
fn shifted(rows: usize, columns: usize, k: usize) -> DMatrix<f64> {
    DMatrix::from_fn(rows, columns, |i, j| f64::from(u8::from(j == i + k)))
}

fn block_diagonal(blocks: &[DMatrix<f64>]) -> DMatrix<f64> {
    let rows = blocks.iter().map(DMatrix::nrows).sum();
    let mut result = DMatrix::zeros(rows, blocks.iter().map(DMatrix::ncols).sum());
    let (mut top, mut left) = (0, 0);
    for block in blocks {
        result.view_mut((top, left), block.shape()).copy_from(block);
        (top, left) = (top + block.nrows(), left + block.ncols());
    }
    result
}

/// The canonical form of a pencil, before transformation.
#[derive(Clone, Debug)]
struct Plan {
    n_finite: usize,
    infinite: Vec<usize>,
    right: Vec<usize>,
    left: Vec<usize>,
    seed: u64,
}

/// A pencil `A - s E` in canonical form and its finite eigenvalues; the finite part comes first.
fn canonical(plan: &Plan, random: &mut Random) -> (DMatrix<f64>, DMatrix<f64>, Vec<Complex64>) {
    let (finite, values) = random.finite_part(plan.n_finite);
    let (mut a, mut e) = (vec![finite], vec![DMatrix::identity(plan.n_finite, plan.n_finite)]);
    for &k in &plan.infinite {
        a.push(DMatrix::identity(k, k));
        e.push(shifted(k, k, 1));
    }
    for &k in &plan.right {
        a.push(shifted(k, k + 1, 0));
        e.push(shifted(k, k + 1, 1));
    }
    for &k in &plan.left {
        a.push(shifted(k, k + 1, 0).transpose());
        e.push(shifted(k, k + 1, 1).transpose());
    }
    (block_diagonal(&a), block_diagonal(&e), values)
}

/// The same pencil in dense coordinates.
fn planted(plan: &Plan) -> (DMatrix<f64>, DMatrix<f64>, Vec<Complex64>) {
    let mut random = Random(plan.seed);
    let (a, e, values) = canonical(plan, &mut random);
    let (p, q) = (random.transformation(a.nrows()), random.transformation(a.ncols()));
    (&p * a * &q, &p * e * &q, values)
}

fn sorted(indices: &[usize]) -> Vec<usize> {
    let mut result = indices.to_vec();
    result.sort_unstable();
    result
}

fn plans(right: usize, left: usize) -> impl Strategy<Value = Plan> {
    let parts = (0_usize..9, vec(1_usize..4, 0..4), vec(0_usize..4, 0..=right), vec(0_usize..4, 0..=left));
    (parts, any::<u64>()).prop_map(|((n_finite, infinite, right, left), seed)| Plan {
        n_finite,
        infinite,
        right,
        left,
        seed,
    })
}

/// A regular system with `hidden` finite states first, which no output shows, and all other states shown.
fn partly_hidden(plan: &Plan, hidden: usize) -> (DescriptorSystem, Vec<Complex64>) {
    let mut random = Random(plan.seed);
    let plan = Plan { n_finite: plan.n_finite + 1, ..plan.clone() }; // at least one state
    let (a, e, _) = canonical(&plan, &mut random);
    let (hidden_a, values) = random.finite_part(hidden);
    let (a, e) = (block_diagonal(&[hidden_a, a]), block_diagonal(&[DMatrix::identity(hidden, hidden), e]));
    let n = a.ncols();
    let mut c = random.matrix(plan.infinite.len() + 2, n);
    c.columns_mut(0, hidden).fill(0.0);
    let (p, q) = (random.transformation(n), random.transformation(n));
    (DescriptorSystem::autonomous(&p * e * &q, &p * a * &q, c * q).unwrap(), values)
}

/// Distance of a value from the boundary of stability in this time domain.
fn margin(time: TimeDomain, s: &Complex64) -> f64 {
    match time {
        TimeDomain::Continuous => -s.re,
        TimeDomain::Discrete => 1.0 - s.norm(),
    }
}

proptest! {
    #![proptest_config(config())]

    #[test]
    fn kronecker_structure_is_recovered(plan in plans(2, 2)) {
        let (a, e, values) = planted(&plan);
        let found = pencil_structure(&a, &e, &Tolerance::default()).unwrap();
        prop_assert_eq!(&found.right_indices, &sorted(&plan.right), "right minimal indices");
        prop_assert_eq!(&found.left_indices, &sorted(&plan.left), "left minimal indices");
        prop_assert_eq!(&found.infinite_degrees, &sorted(&plan.infinite), "infinite elementary divisors");
        prop_assert_eq!(found.normal_rank, a.ncols() - plan.right.len(), "normal rank");
        prop_assert!(!found.fragile, "gap {}", found.gap);
        let distance = spectral_distance(&found.finite_eigenvalues().unwrap(), &values);
        prop_assert!(distance < 1e-8, "finite eigenvalues are off by {distance:e}");
    }

    #[test]
    fn planted_zeros_of_tall_pencils_are_recovered(plan in plans(0, 3)) {
        let (a, e, values) = planted(&plan);
        let found = rank_drop_points(&a, &e, &Tolerance::default()).unwrap();
        let points: Vec<Complex64> =
            found.points().iter().flat_map(|p| std::iter::repeat_n(p.s, p.multiplicity)).collect();
        let distance = spectral_distance(&points, &values);
        prop_assert!(distance < 1e-8, "zeros are off by {distance:e}");
        prop_assert_eq!(found.drop == RankDrop::Nowhere, values.is_empty(), "no zeros, no points");
        for point in found.points() {
            let pencil = a.zip_map(&e, |a, e| Complex64::from(a) - point.s * e);
            let residual = (pencil * &point.direction).norm();
            prop_assert!(residual < 1e-10, "(A - s E) v = {residual:e}");
        }
    }

    #[test]
    fn right_blocks_drop_the_rank_everywhere(plan in plans(2, 2), extra in 0_usize..4) {
        let mut plan = plan;
        plan.right.push(extra);
        let (a, e, _) = planted(&plan);
        let found = rank_drop_points(&a, &e, &Tolerance::default()).unwrap();
        let RankDrop::Everywhere { direction } = found.drop else {
            return Err(TestCaseError::fail("a free column direction exists"));
        };
        prop_assert!((&a * &direction).norm() < 1e-10, "A v = 0");
        if plan.right.contains(&0) {
            prop_assert!((&e * &direction).norm() < 1e-10, "E v = 0 as well");
        }
    }

    #[test]
    fn regular_systems_have_their_planted_index(plan in plans(0, 0), extra in 1_usize..4) {
        let mut plan = plan;
        plan.infinite.push(extra);
        let (a, e, values) = planted(&plan);
        let n = a.ncols();
        let system = DescriptorSystem::autonomous(e, a, DMatrix::zeros(0, n)).unwrap();
        prop_assert!(regularity(&system, &Tolerance::default()).unwrap().holds(), "regular by construction");
        let found = index(&system, &Tolerance::default()).unwrap();
        prop_assert_eq!(found.index, plan.infinite.iter().max().copied(), "largest infinite degree");
        let spectrum = finite_eigenvalues(&system, &Tolerance::default()).unwrap();
        prop_assert!(spectral_distance(&spectrum.values, &values) < 1e-8, "{spectrum:?}");
    }

    #[test]
    fn planted_unobservable_modes_are_found(plan in plans(0, 0), hidden in 0_usize..4, discrete in any::<bool>()) {
        let (mut system, values) = partly_hidden(&plan, hidden);
        system.time = if discrete { TimeDomain::Discrete } else { TimeDomain::Continuous };
        let found = r_observability(&system, &Tolerance::default()).unwrap();
        prop_assert_eq!(found.holds(), hidden == 0, "{:?}", found);
        let modes: Vec<Complex64> = found.modes.iter().map(|mode| mode.s).collect();
        prop_assert!(spectral_distance(&modes, &values) < 1e-8, "{modes:?} where {values:?} are planted");
        for mode in &found.modes {
            let v = DVector::from_column_slice(&mode.direction);
            let shown = (system.C.map(Complex64::from) * v).norm();
            prop_assert!(shown < 1e-10, "C v = {shown:e} at {}", mode.s);
            prop_assert_eq!(mode.position == ModePosition::Stable, margin(system.time, &mode.s) > 0.0, "{:?}", mode);
        }
        let found = r_detectability(&system, &Tolerance::default()).unwrap();
        let expected = values.iter().all(|s| margin(system.time, s) > 0.0);
        prop_assert_eq!(found.holds(), expected, "{:?}", found);
    }

    #[test]
    fn a_hidden_jordan_block_is_one_mode(plan in plans(0, 0), size in 2_usize..4, eigenvalue in -2.0..2.0_f64) {
        let mut random = Random(plan.seed);
        let (a, e, _) = canonical(&plan, &mut random);
        let jordan = DMatrix::identity(size, size) * eigenvalue + shifted(size, size, 1);
        let (a, e) = (block_diagonal(&[jordan, a]), block_diagonal(&[DMatrix::identity(size, size), e]));
        let n = a.ncols();
        let mut c = random.matrix(plan.infinite.len() + 2, n);
        c.columns_mut(0, size).fill(0.0);
        let (p, q) = (random.transformation(n), random.transformation(n));
        let system = DescriptorSystem::autonomous(&p * e * &q, &p * a * &q, c * q).unwrap();
        let found = r_detectability(&system, &Tolerance::default()).unwrap();
        prop_assert_eq!(found.modes.len(), 1, "one eigenvalue: {:?}", found);
        prop_assert_eq!(found.modes[0].multiplicity, size, "{:?}", found);
        let error = (found.modes[0].s - eigenvalue).norm();
        prop_assert!(error < 1e-8, "the mean of the cluster is off by {error:e}: {found:?}");
        prop_assert_eq!(found.holds(), eigenvalue < 0.0, "{:?}", found);
    }

    #[test]
    fn hidden_impulses_are_found(plan in plans(0, 0), degree in 2_usize..4, exponent in 0_usize..3) {
        // the first column of an infinite block of degree two or more spans its impulses
        let gain = [1.0, 3e-12, 0.0][exponent];
        let mut random = Random(plan.seed);
        let (a, e, _) = canonical(&plan, &mut random);
        let a = block_diagonal(&[DMatrix::identity(degree, degree), a]);
        let e = block_diagonal(&[shifted(degree, degree, 1), e]);
        let n = a.ncols();
        let mut c = random.matrix(plan.infinite.len() + 2, n);
        c.column_mut(0).scale_mut(gain);
        let (p, q) = (random.transformation(n), random.transformation(n));
        let system = DescriptorSystem::autonomous(&p * e * &q, &p * a * &q, c * q).unwrap();
        let found = impulse_observability(&system, &Tolerance::default()).unwrap();
        if gain == 3e-12 {
            prop_assert!(found.fragile(), "neither seen nor hidden: {:?}", found);
            return Ok(());
        }
        prop_assert_eq!(found.holds(), gain > 0.0, "{:?}", found);
        prop_assert_eq!(found.printed.holds(), found.holds(), "both forms agree: {:?}", found);
        if let Some(witness) = found.witness {
            let w = DVector::from_vec(witness);
            prop_assert!((&system.E * &w).norm() < 1e-10 && (&system.C * &w).norm() < 1e-10, "E w = C w = 0");
        }
    }
}
