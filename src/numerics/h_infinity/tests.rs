//! The norm against closed forms, dense grids of frequencies and another program.

use super::*;
use crate::numerics::Random;
use nalgebra::{DVector, dmatrix};
use std::f64::consts::PI;

const HALF_PLANE: StabilityRegion = StabilityRegion::LeftHalfPlane;
const DISK: StabilityRegion = StabilityRegion::UnitDisk;

type Matrices = (DMatrix<f64>, DMatrix<f64>, DMatrix<f64>, DMatrix<f64>);

fn norm_of((a, b, c, d): &Matrices, region: StabilityRegion) -> Result<HInfinityNorm, HInfinityError> {
    h_infinity_norm(a, b, c, d, region, &Tolerance::default())
}

fn close(found: f64, expected: f64, limit: f64, what: &str) {
    assert!((found - expected).abs() <= limit * expected.abs(), "{what}: {found} where {expected} is true");
}

fn gaussian(random: &mut Random, rows: usize, columns: usize) -> DMatrix<f64> {
    DMatrix::from_fn(rows, columns, |_, _| random.normal())
}

/// A random stable system whose slowest mode is at `-distance`, or at radius `1 - distance`.
fn stable(
    random: &mut Random,
    shape: (usize, usize, usize),
    region: StabilityRegion,
    distance: f64,
) -> Matrices {
    let (n, m, p) = shape;
    let a = gaussian(random, n, n);
    let worst = eigenvalues(&a).unwrap().iter().map(|z| region.excess(*z)).fold(f64::NEG_INFINITY, f64::max);
    let a = match region {
        StabilityRegion::LeftHalfPlane => a - DMatrix::identity(n, n) * (worst + distance),
        StabilityRegion::UnitDisk => a * ((1.0 - distance) / (worst + 1.0)),
    };
    (a, gaussian(random, n, m), gaussian(random, p, n), gaussian(random, p, m))
}

/// The largest gain on a grid of frequencies, by a Neumann-free direct solve.
fn grid(system: &Matrices, region: StabilityRegion, points: usize) -> f64 {
    let frequency = |part: f64| match region {
        StabilityRegion::LeftHalfPlane => 10.0_f64.powf(7.0 * part - 4.0),
        StabilityRegion::UnitDisk => PI * part,
    };
    (0..=points).map(|k| gain_at(system, region, frequency(k as f64 / points as f64))).fold(0.0, f64::max)
}

/// The largest singular value of `C (s I - A)^-1 B + D` by an explicit inverse, which the norm itself never forms.
fn gain_at((a, b, c, d): &Matrices, region: StabilityRegion, frequency: f64) -> f64 {
    let s = match region {
        StabilityRegion::LeftHalfPlane => Complex64::new(0.0, frequency),
        StabilityRegion::UnitDisk => Complex64::from_polar(1.0, frequency),
    };
    let unit = DMatrix::<Complex64>::identity(a.nrows(), a.nrows());
    let inverse = (&unit * s - a.map(Complex64::from)).try_inverse().unwrap();
    let value = c.map(Complex64::from) * inverse * b.map(Complex64::from) + d.map(Complex64::from);
    crate::numerics::complex_svd(&value).unwrap().s[0]
}

#[test]
fn first_order_lag_has_its_gain_at_rest() {
    let found = norm_of(&(dmatrix![-4.0], dmatrix![2.0], dmatrix![3.0], dmatrix![0.0]), HALF_PLANE).unwrap();
    close(found.norm, 1.5, 1e-12, "6 / (s + 4)");
    assert_eq!(found.frequency, 0.0, "a lag is largest at rest");
    assert!(found.lower <= found.norm && found.norm <= found.upper, "bracket {found:?}");
    assert!(found.upper - found.lower <= 2e-10 * found.norm, "narrow bracket {found:?}");
}

#[test]
fn high_pass_has_its_gain_at_infinity() {
    // s / (s + 1) = 1 - 1 / (s + 1)
    let found = norm_of(&(dmatrix![-1.0], dmatrix![1.0], dmatrix![-1.0], dmatrix![1.0]), HALF_PLANE).unwrap();
    close(found.norm, 1.0, 1e-9, "supremum at infinity");
    assert_eq!(found.frequency, f64::INFINITY, "reached in the limit only");
}

#[test]
fn resonance_has_the_closed_form_for_every_damping() {
    for zeta in [0.7, 0.5, 0.1, 1e-2, 1e-4, 1e-6] {
        for omega in [1.0, 1e-3, 1e5] {
            let system: Matrices = (
                dmatrix![0.0, 1.0; -omega * omega, -2.0 * zeta * omega],
                dmatrix![0.0; omega * omega],
                dmatrix![1.0, 0.0],
                dmatrix![0.0],
            );
            let found = norm_of(&system, HALF_PLANE).unwrap();
            let root = (1.0_f64 - zeta * zeta).sqrt();
            close(found.norm, 1.0 / (2.0 * zeta * root), 1e-9, &format!("zeta {zeta}, omega {omega}"));
            let peak = omega * (1.0 - 2.0 * zeta * zeta).sqrt();
            close(found.frequency, peak, 1e-3, &format!("peak frequency, zeta {zeta}, omega {omega}"));
        }
    }
}

#[test]
fn overdamped_second_order_has_its_gain_at_rest() {
    let system: Matrices =
        (dmatrix![0.0, 1.0; -1.0, -1.8], dmatrix![0.0; 1.0], dmatrix![5.0, 0.0], dmatrix![0.0]);
    let found = norm_of(&system, HALF_PLANE).unwrap();
    close(found.norm, 5.0, 1e-12, "zeta = 0.9");
}

#[test]
fn discrete_first_order_has_its_gain_where_its_pole_points() {
    // the pole 0 is at equal distance from 1 and -1: a pure delay
    for (pole, frequency) in [(0.9, 0.0), (-0.9, PI), (0.0, 0.0), (-1.0 + 1e-6, PI)] {
        let found = norm_of(&(dmatrix![pole], dmatrix![1.0], dmatrix![2.0], dmatrix![0.0]), DISK).unwrap();
        close(found.norm, 2.0 / (1.0 - f64::abs(pole)), 1e-9, &format!("2 / (z - {pole})"));
        assert!(pole == 0.0 || (found.frequency - frequency).abs() < 2e-3, "{pole}: {found:?}");
    }
}

#[test]
fn discrete_system_with_modes_at_both_real_ends_is_solved() {
    let a = DMatrix::from_diagonal(&DVector::from_vec(vec![1.0 - 1e-5, -1.0 + 1e-5]));
    let found = norm_of(&(a, dmatrix![1.0; 1.0], dmatrix![1.0, 3.0], dmatrix![0.0]), DISK).unwrap();
    close(found.norm, 3e5 + 1.0 / (2.0 - 1e-5), 1e-5, "the larger of two narrow peaks");
    assert!((found.frequency - PI).abs() < 1e-6, "at z = -1: {found:?}");
}

#[test]
fn discrete_norm_is_that_of_the_system_behind_the_bilinear_map() {
    let mut random = Random::new(5);
    for trial in 0..20 {
        let (a, b, c, d) = stable(&mut random, (1 + trial % 5, 2, 2), HALF_PLANE, 0.2);
        let expected = norm_of(&(a.clone(), b.clone(), c.clone(), d.clone()), HALF_PLANE).unwrap().norm;
        // s = (z - 1) / (z + 1): A_z = (I - A)^-1 (I + A)
        let n = a.nrows();
        let unit = DMatrix::<f64>::identity(n, n);
        let inverse = (&unit - &a).try_inverse().unwrap();
        let root = 2.0_f64.sqrt();
        let discrete: Matrices =
            (&inverse * (&unit + &a), &inverse * &b * root, &c * &inverse * root, &d + &c * &inverse * &b);
        close(norm_of(&discrete, DISK).unwrap().norm, expected, 1e-8, &format!("trial {trial}"));
    }
}

#[test]
fn random_systems_are_never_below_a_dense_grid() {
    let mut random = Random::new(11);
    for trial in 0..36 {
        let region = if trial % 2 == 0 { HALF_PLANE } else { DISK };
        let shape = (1 + trial % 7, 1 + trial % 3, 1 + (trial / 2) % 3);
        let mut system = stable(&mut random, shape, region, [0.5, 0.1, 0.01][trial % 3]);
        if trial % 4 < 2 {
            system.3.fill(0.0);
        }
        let found = norm_of(&system, region).unwrap();
        let seen = grid(&system, region, 1500);
        assert!(found.norm >= seen * (1.0 - 1e-9), "trial {trial}: {found:?}, but the grid shows {seen}");
        // a sharp peak may lie between two points of the grid: its gain is evaluated apart
        let near = if found.frequency.is_finite() {
            gain_at(&system, region, found.frequency)
        } else {
            system.3.norm()
        };
        assert!(
            found.norm <= seen.max(near) * (1.0 + 1e-6),
            "trial {trial}: {found:?} is above every gain that is seen: {seen}, {near}"
        );
    }
}

#[test]
fn units_of_the_states_do_not_matter() {
    let mut random = Random::new(3);
    for region in [HALF_PLANE, DISK] {
        let (a, b, c, d) = stable(&mut random, (6, 2, 2), region, 0.1);
        let expected = norm_of(&(a.clone(), b.clone(), c.clone(), d.clone()), region).unwrap().norm;
        let units = DMatrix::from_diagonal(&DVector::from_fn(6, |i, _| 10.0_f64.powf(4.0 * i as f64 - 10.0)));
        let back = units.clone().try_inverse().unwrap();
        let scaled: Matrices = (&units * a * &back, &units * b, c * back, d);
        close(norm_of(&scaled, region).unwrap().norm, expected, 1e-8, "states scaled by 1e-10 ... 1e10");
    }
}

#[test]
fn units_of_inputs_and_outputs_scale_the_norm() {
    let (a, b, c, d) = stable(&mut Random::new(4), (4, 2, 2), HALF_PLANE, 0.1);
    let expected = norm_of(&(a.clone(), b.clone(), c.clone(), d.clone()), HALF_PLANE).unwrap().norm;
    for unit in [1e-12, 1e12] {
        let scaled: Matrices = (a.clone(), &b * unit, c.clone(), &d * unit);
        close(norm_of(&scaled, HALF_PLANE).unwrap().norm, expected * unit, 1e-9, "one unit");
    }
}

#[test]
fn time_scale_does_not_matter() {
    let (a, b, c, d) = stable(&mut Random::new(6), (5, 1, 2), HALF_PLANE, 0.1);
    let expected = norm_of(&(a.clone(), b.clone(), c.clone(), d.clone()), HALF_PLANE).unwrap();
    for factor in [1e-6, 1e6] {
        let found = norm_of(&(&a * factor, &b * factor, c.clone(), d.clone()), HALF_PLANE).unwrap();
        close(found.norm, expected.norm, 1e-9, "seconds or microseconds");
        close(found.frequency, expected.frequency * factor, 1e-4, "frequency of the peak");
    }
}

#[test]
fn empty_dimensions_have_the_gain_of_what_is_left() {
    let none = |rows, columns| DMatrix::<f64>::zeros(rows, columns);
    let d = dmatrix![3.0, 0.0; 0.0, -4.0];
    let found = norm_of(&(none(0, 0), none(0, 2), none(2, 0), d), HALF_PLANE).unwrap();
    close(found.norm, 4.0, 1e-14, "no states: the feedthrough alone");
    for region in [HALF_PLANE, DISK] {
        let a = DMatrix::identity(2, 2) * -0.5;
        let no_input = norm_of(&(a.clone(), none(2, 0), none(3, 2), none(3, 0)), region).unwrap();
        let no_output = norm_of(&(a, none(2, 3), none(0, 2), none(0, 3)), region).unwrap();
        assert_eq!((no_input.norm, no_output.norm), (0.0, 0.0), "nothing goes in or comes out");
    }
}

#[test]
fn a_transfer_that_vanishes_has_norm_zero_but_for_rounding() {
    // the input drives a state that no output sees
    let system: Matrices =
        (dmatrix![-1.0, 0.0; 0.3, -2.0], dmatrix![0.0; 1.0], dmatrix![1.0, 0.0], dmatrix![0.0]);
    let found = norm_of(&system, HALF_PLANE).unwrap();
    assert!(found.upper <= 1e-14, "{found:?}");
}

#[test]
fn an_unstable_system_has_no_norm_and_the_mode_is_named() {
    let error =
        norm_of(&(dmatrix![0.5], dmatrix![1.0], dmatrix![1.0], dmatrix![0.0]), HALF_PLANE).unwrap_err();
    assert!(
        matches!(error, HInfinityError::Unstable { mode, .. } if (mode.re - 0.5).abs() < 1e-12),
        "{error}"
    );
    assert!(error.to_string().starts_with("the norm is infinite: the mode 0.5"), "{error}");
    let integrator = norm_of(&(dmatrix![0.0], dmatrix![1.0], dmatrix![1.0], dmatrix![0.0]), HALF_PLANE);
    assert!(matches!(integrator, Err(HInfinityError::Unstable { .. })), "an integrator is not stable");
    let circle = norm_of(&(dmatrix![-1.0], dmatrix![1.0], dmatrix![1.0], dmatrix![0.0]), DISK);
    assert!(matches!(circle, Err(HInfinityError::Unstable { .. })), "z = -1 is on the boundary");
}

#[test]
fn matrices_that_do_not_fit_are_refused() {
    let wrong = norm_of(&(dmatrix![-1.0], dmatrix![1.0], dmatrix![1.0], dmatrix![0.0, 0.0]), HALF_PLANE);
    assert!(matches!(wrong, Err(HInfinityError::Numerics(NumericsError::Shape { .. }))), "{wrong:?}");
    let nan = norm_of(&(dmatrix![f64::NAN], dmatrix![1.0], dmatrix![1.0], dmatrix![0.0]), HALF_PLANE);
    assert!(matches!(nan, Err(HInfinityError::Numerics(NumericsError::NotFinite { .. }))), "{nan:?}");
}

/// `((7 i + 3 j + 5 i j + k) mod 11 - 5) / 4`: the same matrix in any language.
fn pattern(rows: usize, columns: usize, k: usize) -> DMatrix<f64> {
    DMatrix::from_fn(rows, columns, |i, j| ((7 * i + 3 * j + 5 * i * j + k) % 11) as f64 / 4.0 - 1.25)
}

/// Numbers of `control.linfnorm(system, 1e-12)`, python-control 0.10.2 with slycot 0.7.1 (SLICOT AB13DD).
#[test]
fn slicot_finds_the_same_norms_and_peaks() {
    type Peak = (f64, f64);
    type Case = ([usize; 4], (f64, f64), Peak, Peak);
    let reference: [Case; 3] = [
        (
            [3, 2, 2, 4],
            (1.25, 4.0),
            (2.526_983_388_965_926, 0.731_250_761_226_297_4),
            (4.136_169_008_746_465, PI),
        ),
        (
            [5, 2, 3, 7],
            (1.25, 2.0),
            (2.993_695_558_023_009_4, 0.307_679_778_307_331_06),
            (6.134_431_614_666_306, 1.866_245_495_915_247_2),
        ),
        (
            [8, 3, 2, 2],
            (1.25, 4.0),
            (27.847_472_786_532_76, 0.685_559_436_512_212_6),
            (7.906_943_242_178_684, 0.806_543_917_630_912_6),
        ),
    ];
    for ([n, m, p, k], (shift, divisor), continuous, discrete) in reference {
        let a = pattern(n, n, k);
        let (b, c, d) = (pattern(n, m, k + 1), pattern(p, n, k + 2), pattern(p, m, k + 3));
        for (region, a, (norm, frequency)) in
            [(HALF_PLANE, &a - DMatrix::identity(n, n) * shift, continuous), (DISK, &a / divisor, discrete)]
        {
            let found = norm_of(&(a, b.clone(), c.clone(), d.clone()), region).unwrap();
            close(found.norm, norm, 1e-10, &format!("n = {n}, {region:?}"));
            close(found.frequency, frequency, 1e-4, &format!("peak, n = {n}, {region:?}"));
        }
    }
}

#[test]
fn a_peak_hardly_above_the_gain_at_infinity_is_found() {
    // 1 + h 2 zeta omega s / (s^2 + 2 zeta omega s + omega^2): 1 at infinity and at rest, 1 + h at omega
    for h in [0.5, 1e-2, 1e-3, 1e-5, 1e-7] {
        for (zeta, omega) in [(0.5, 1.0), (0.1, 30.0), (2.0, 1e-2)] {
            let damping = 2.0 * zeta * omega;
            let system: Matrices = (
                dmatrix![0.0, 1.0; -omega * omega, -damping],
                dmatrix![0.0; 1.0],
                dmatrix![0.0, h * damping],
                dmatrix![1.0],
            );
            let found = norm_of(&system, HALF_PLANE).unwrap();
            close(found.norm, 1.0 + h, 1e-9, &format!("h = {h}, zeta = {zeta}, omega = {omega}"));
        }
    }
}

#[test]
fn a_discrete_peak_hardly_above_the_gain_at_the_far_end_is_found() {
    // an observer whose gain at z = -1 is 21.825 288; SLICOT (AB13DD) finds 21.842 720 93 at 2.610 229
    let system: Matrices = (
        dmatrix![0.9, -26.992_305_333_374_915, -84.200_841_931_891, -0.1;
                 0.05, -1.063_806_563_506_732_6, -3.154_259_378_884_890_3, 0.0;
                 0.0, -0.000_467_974_486_852_700_4, 0.263_806_563_506_279_96, 0.0;
                 0.0, 74.370_763_568_774_25, 323.239_857_268_230_2, 1.0],
        dmatrix![13.496_152_666_687_458; 1.006_903_281_753_366_3; 0.000_233_987_243_426_350_2; -37.185_381_784_387_125],
        dmatrix![1.0, 0.0, 0.0, 0.0; 0.0, 1.0, 0.0, 0.0; 0.0, 0.0, 1.0, 0.0],
        dmatrix![0.0; 0.5; 0.0],
    );
    let found = norm_of(&system, DISK).unwrap();
    close(found.norm, 21.842_720_930_007_32, 1e-8, "the peak");
    close(found.frequency, 2.610_229_377_207_603_7, 1e-4, "its frequency");
}
