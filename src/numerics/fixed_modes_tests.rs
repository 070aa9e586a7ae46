//! Planted unobservable modes are found, and nothing else is.

use super::*;
use crate::numerics::{Random, matching, spectral_distance};
use nalgebra::dmatrix;

fn gaussian(random: &mut Random, rows: usize, columns: usize) -> DMatrix<f64> {
    DMatrix::from_fn(rows, columns, |_, _| random.normal())
}

fn orthogonal(random: &mut Random, n: usize) -> DMatrix<f64> {
    gaussian(random, n, n).qr().q()
}

/// `[A11 A12; 0 A22]`, `[0 C2]` in a random orthonormal basis: `A11` is never seen.
fn planted(
    random: &mut Random,
    hidden: &DMatrix<f64>,
    seen: usize,
    outputs: usize,
) -> (DMatrix<f64>, DMatrix<f64>) {
    let k = hidden.nrows();
    let n = k + seen;
    let mut a = gaussian(random, n, n);
    a.view_mut((0, 0), (k, k)).copy_from(hidden);
    a.view_mut((k, 0), (seen, k)).fill(0.0);
    let mut c = gaussian(random, outputs, n);
    c.columns_mut(0, k).fill(0.0);
    let q = orthogonal(random, n);
    (&q * a * q.transpose(), c * q.transpose())
}

#[test]
fn planted_modes_are_found_with_their_subspace() {
    let mut random = Random::new(1);
    for trial in 0..60 {
        let hidden = gaussian(&mut random, trial % 4, trial % 4);
        let (seen, outputs) = (1 + trial % 6, 1 + trial % 3);
        let (a, c) = planted(&mut random, &hidden, seen, outputs);
        let found = observable_quotient(&a, &c, &Tolerance::default()).unwrap();
        assert_eq!(found.unobservable.ncols(), hidden.nrows(), "trial {trial}: {:?}", found.modes);
        assert!((&c * &found.unobservable).norm() < 1e-8, "trial {trial}: C Nu = 0");
        let image = &a * &found.unobservable;
        let outside = &image - &found.unobservable * found.unobservable.tr_mul(&image);
        assert!(outside.norm() < 1e-8, "trial {trial}: A Nu stays within Nu");
        let expected = eigenvalues(&hidden).unwrap();
        assert!(spectral_distance(&found.fixed_modes, &expected) < 1e-8, "trial {trial}: fixed modes");
        assert!(
            found.basis.tr_mul(&found.unobservable).norm() < 1e-12,
            "trial {trial}: orthogonal complement"
        );
    }
}

#[test]
fn planted_jordan_blocks_are_deflated_chain_by_chain() {
    let mut random = Random::new(2);
    for trial in 0..30 {
        let k = 2 + trial % 2;
        let jordan = DMatrix::from_fn(k, k, |i, j| match j.wrapping_sub(i) {
            0 => -1.5,
            1 => 1.0,
            _ => 0.0,
        });
        let (a, c) = planted(&mut random, &jordan, 2 + trial % 4, 1 + trial % 2);
        let found = observable_quotient(&a, &c, &Tolerance::default()).unwrap();
        assert_eq!(found.unobservable.ncols(), k, "trial {trial}: {:?}", found.modes);
        let expected = vec![Complex64::from(-1.5); k];
        let error = spectral_distance(&found.fixed_modes, &expected);
        assert!(error < 1e-3, "trial {trial}: a block of {k} is known to 1/{k} of the digits: {error:e}");
    }
}

/// The chain `A v2 = lambda v2 + v1` with `v1` unseen and `v2` seen: one dimension is lost, not two.
#[test]
fn half_of_a_jordan_block_can_be_observable() {
    let mut random = Random::new(3);
    for trial in 0..20 {
        let q = orthogonal(&mut random, 3);
        let a = &q * dmatrix![-1.0, 1.0, 0.0; 0.0, -1.0, 0.3; 0.0, 0.0, 2.0] * q.transpose();
        let c = dmatrix![0.0, 1.0, 1.0] * q.transpose();
        let found = observable_quotient(&a, &c, &Tolerance::default()).unwrap();
        assert_eq!(found.unobservable.ncols(), 1, "trial {trial}: {:?}", found.modes);
        assert!((found.fixed_modes[0] + 1.0).norm() < 1e-7, "trial {trial}: {:?}", found.fixed_modes);
    }
}

#[test]
fn hidden_pair_close_to_the_real_axis_is_found() {
    let mut random = Random::new(8);
    for frequency in [1e-3, 1e-5, 1e-7, 0.0] {
        let hidden = dmatrix![-1.0, frequency; -frequency, -1.0];
        let (a, c) = planted(&mut random, &hidden, 3, 2);
        let found = observable_quotient(&a, &c, &Tolerance::default()).unwrap();
        assert_eq!(found.unobservable.ncols(), 2, "frequency {frequency:e}: {:?}", found.modes);
        let total: usize = found.modes.iter().map(|m| m.multiplicity).sum();
        assert_eq!(total, 5, "frequency {frequency:e}: every state counts once: {:?}", found.modes);
    }
}

/// A block of four scatters its eigenvalues by more than a cluster is wide; only its first vector is hidden.
#[test]
fn eigenvector_of_a_scattered_jordan_block_is_found() {
    let a = dmatrix![
        0.0, 0.0, 1.0, 0.0, 0.0; 1.0, 1.0, 0.0, 0.0, 0.0; 0.0, 0.0, 1.0, 0.0, 0.0; -1.0, 1.0, -1.0, 1.0, 0.0;
        -1.0, -1.0, 1.0, -1.0, 1.0
    ];
    let c = dmatrix![0.0, -1.0, 0.0, -1.0, 0.0];
    let found = observable_quotient(&a, &c, &Tolerance::default()).unwrap();
    assert_eq!(found.basis.ncols(), 4, "the fifth state is not seen: {:?}", found.modes);
    let fixed: Vec<_> = found.modes.iter().filter(|m| m.unobservable).map(|m| m.value.re).collect();
    assert!(
        fixed.len() == 1 && (fixed[0] - 1.0).abs() < 1e-9,
        "one mode, not one per scattered member: {fixed:?}"
    );
    let total: usize = found.modes.iter().map(|m| m.multiplicity).sum();
    assert_eq!(total, 5, "every state counts once: {:?}", found.modes);
}

#[test]
fn without_outputs_every_mode_is_fixed() {
    let a = dmatrix![0.0, 1.0; -1.0, 0.0];
    for c in [DMatrix::zeros(0, 2), DMatrix::zeros(1, 2)] {
        let found = observable_quotient(&a, &c, &Tolerance::default()).unwrap();
        assert_eq!(found.basis.shape(), (2, 0), "nothing can be observed");
        assert_eq!(found.fixed_modes.len(), 2, "both modes stay");
        assert_eq!(found.modes.len(), 2, "a pair is two modes: {:?}", found.modes);
        assert_eq!(found.modes[0].value, found.modes[1].value.conj(), "conjugate to each other");
    }
}

#[test]
fn empty_pair_has_no_modes() {
    let found =
        observable_quotient(&DMatrix::zeros(0, 0), &DMatrix::zeros(2, 0), &Tolerance::default()).unwrap();
    assert_eq!((found.basis.shape(), found.modes.len()), ((0, 0), 0), "no states");
}

#[test]
fn the_threshold_decides_nearly_unseen_modes() {
    let pair = |epsilon: f64| (dmatrix![1.0, 0.0; 0.0, 2.0], dmatrix![epsilon, 1.0]);
    for (epsilon, unobservable) in [(1e-7, false), (1e-11, true)] {
        let (a, c) = pair(epsilon);
        let modes = pbh_modes(&a, &c, &Tolerance::default()).unwrap();
        let slow = modes.iter().find(|m| (m.value - 1.0).norm() < 0.1).unwrap();
        assert_eq!(slow.unobservable, unobservable, "seen by {epsilon:e}: {slow:?}");
        assert!(
            (slow.distance * 12.0_f64.sqrt() / epsilon - 1.0).abs() < 1e-3,
            "distance {:e}",
            slow.distance
        );
        assert!((slow.direction[0] - 1.0).norm() < 1e-12 && slow.direction[1].norm() < 1e-6, "{slow:?}");
    }
}

#[test]
fn repeated_eigenvalue_with_one_output_loses_one_dimension() {
    let a = DMatrix::from_diagonal_element(3, 3, -2.0);
    let c = dmatrix![1.0, 2.0, 3.0; 0.0, 1.0, 1.0];
    let found = observable_quotient(&a, &c, &Tolerance::default()).unwrap();
    assert_eq!(found.modes.len(), 1, "one cluster");
    assert_eq!((found.modes[0].multiplicity, found.modes[0].nullity), (3, 1), "two outputs see two of three");
    assert_eq!(found.basis.ncols(), 2, "two dimensions are left");
}

#[test]
fn unit_of_the_output_does_not_decide() {
    let a = dmatrix![0.0, 1.0; -2.0, -3.0];
    let modes = pbh_modes(&a, &dmatrix![1e14, 0.0], &Tolerance::default()).unwrap();
    assert!(modes.iter().all(|m| !m.unobservable), "an output in femtometres is still an output: {modes:?}");
}

#[test]
fn modes_are_as_many_as_states() {
    let mut random = Random::new(4);
    for n in 1..9 {
        let (a, c) = (gaussian(&mut random, n, n), gaussian(&mut random, 1, n));
        let modes = pbh_modes(&a, &c, &Tolerance::default()).unwrap();
        assert_eq!(modes.iter().map(|m| m.multiplicity).sum::<usize>(), n, "{modes:?}");
        let values: Vec<_> = modes.iter().map(|m| m.value).collect();
        assert!(
            matching(&values, &eigenvalues(&a).unwrap()).is_some(),
            "n = {n}: simple eigenvalues, one mode each"
        );
    }
}

#[test]
fn shapes_that_do_not_fit_are_refused() {
    let error =
        pbh_modes(&DMatrix::identity(2, 2), &DMatrix::zeros(1, 3), &Tolerance::default()).unwrap_err();
    assert!(matches!(error, NumericsError::Shape { .. }), "{error}");
}
