//! Feedbacks that keep plants bounded, against the modes of the plants themselves.

use super::*;
use crate::numerics::spectral_distance;
use crate::system::DescriptorSystem;
use nalgebra::{DVector, dmatrix};

fn model(time: TimeDomain, E: DMatrix<f64>, A: DMatrix<f64>, D: DMatrix<f64>) -> Model {
    let (e, n, q) = (E.nrows(), E.ncols(), D.ncols());
    let system = DescriptorSystem {
        time,
        E,
        A,
        B: DMatrix::zeros(e, 0),
        C: DMatrix::identity(n, n),
        D,
        F: DMatrix::zeros(n, q),
    };
    system.checked().unwrap().into()
}

fn wide(model: &Model) -> WidePlant {
    let x0 = DVector::zeros(model.system.n_states());
    WidePlant::new(model, &x0, &DVector::zeros(0), &Tolerance::default()).unwrap()
}

fn bounded(model: &Model) -> Result<BoundingFeedback, FeedbackError> {
    wide(model).bounding_feedback(model, &Tolerance::default())
}

/// The modes of the plant with a feedback.
fn modes(model: &Model, feedback: DMatrix<f64>) -> Vec<Complex64> {
    let free = FreeVariables { signals: Vec::new(), feedback: Some(feedback) };
    wide(model).motion(model, &free, &Tolerance::default()).unwrap().modes().unwrap()
}

/// Random plants; the modes are those of the plant with its feedback, found without the formulas above.
#[test]
fn a_bounding_feedback_gives_the_modes_that_it_names() {
    let mut random = crate::numerics::Random::new(5);
    for time in [TimeDomain::Continuous, TimeDomain::Discrete] {
        for (e, n, q) in [(3, 4, 1), (2, 5, 0), (4, 6, 2), (1, 3, 0), (5, 6, 0)] {
            let mut fill = |rows, columns| DMatrix::from_fn(rows, columns, |_, _| random.normal());
            let mut E = fill(e, n);
            if e > 2 {
                E.row_mut(e - 1).fill(0.0);
            }
            let plant = model(time, E, 3.0 * fill(e, n), fill(e, q));
            let found = match bounded(&plant) {
                Ok(found) => found,
                Err(FeedbackError::BoundedAlready { .. }) => continue,
                Err(error) => panic!("{e} x {n}: {error}"),
            };
            let region = StabilityRegion::of(time == TimeDomain::Discrete);
            assert!(found.modes.iter().all(|z| region.contains(*z, 0.0)), "stable: {:?}", found.modes);
            let off = spectral_distance(&modes(&plant, found.feedback.clone()), &found.modes);
            assert!(off < 1e-6, "{time:?} {e} x {n}: modes off by {off:.1e}, {}", found.feedback);
        }
    }
}

#[test]
fn stable_modes_stay_and_are_not_made_fast() {
    // x1' = -100 x1 + x3, x2' = 2 x2 + x3, x3 free
    let plant = model(
        TimeDomain::Continuous,
        dmatrix![1.0, 0.0, 0.0; 0.0, 1.0, 0.0],
        dmatrix![-100.0, 0.0, 1.0; 0.0, 2.0, 1.0],
        DMatrix::zeros(2, 0),
    );
    let found = bounded(&plant).unwrap();
    let off = spectral_distance(&found.modes, &[-100.0, -2.0].map(Complex64::from));
    assert!(off < 1e-9, "{:?}", found.modes);
    assert!(found.feedback[(0, 0)].abs() < 1e-9, "what is stable is not fed back: {}", found.feedback);
}

#[test]
fn modes_out_of_reach_are_named() {
    // x1' = x1 whatever x2 does
    let plant = |pole: f64| {
        let E = dmatrix![1.0, 0.0, 0.0; 0.0, 1.0, 0.0];
        model(TimeDomain::Continuous, E, dmatrix![pole, 0.0, 0.0; 0.0, 3.0, 1.0], DMatrix::zeros(2, 0))
    };
    let error = bounded(&plant(1.0)).unwrap_err();
    assert_eq!(
        error.to_string(),
        "the free variables do not reach the mode 1 of the plant, which is not stable: no feedback of them keeps it \
         bounded"
    );
    let found = bounded(&plant(-1.0)).unwrap();
    assert!(found.modes.contains(&Complex64::from(-1.0)), "a stable one may stay: {:?}", found.modes);
}

#[test]
fn what_needs_no_feedback_says_so() {
    let plant = model(TimeDomain::Continuous, dmatrix![1.0, 0.0], dmatrix![-2.0, 1.0], DMatrix::zeros(1, 0));
    let error = bounded(&plant).unwrap_err();
    assert_eq!(error.to_string(), "the plant is bounded without feedback: its modes are -2");
    let square = model(TimeDomain::Continuous, dmatrix![1.0], dmatrix![2.0], DMatrix::zeros(1, 0));
    assert_eq!(bounded(&square).unwrap_err(), FeedbackError::NothingFree, "x' = 2 x");
}

#[test]
fn integrators_computed_with_rounding_are_integrators() {
    // x1' = 0.3 x1 + 0.1 x2 + x3, 0 = 3 x1 + x2: x1' = x3
    let single = model(
        TimeDomain::Continuous,
        dmatrix![1.0, 0.0, 0.0; 0.0, 0.0, 0.0],
        dmatrix![0.3, 0.1, 1.0; 3.0, 1.0, 0.0],
        DMatrix::zeros(2, 0),
    );
    // [0.3 0.1; -0.9 -0.3] squared is zero: two integrators in a row
    let double = model(
        TimeDomain::Continuous,
        dmatrix![1.0, 0.0, 0.0; 0.0, 1.0, 0.0],
        dmatrix![0.3, 0.1, 0.0; -0.9, -0.3, 1.0],
        DMatrix::zeros(2, 0),
    );
    let pair = [Complex64::new(-1.0, 1.0), Complex64::new(-1.0, -1.0)];
    for (plant, wished) in [(single, &[Complex64::from(-1.0)][..]), (double, &pair)] {
        let found = bounded(&plant).unwrap();
        let off = spectral_distance(&found.modes, wished);
        assert!(off < 1e-9, "{wished:?} are named: {:?}", found.modes);
        let off = spectral_distance(&modes(&plant, found.feedback), wished);
        assert!(off < 1e-9, "{wished:?} are those of the plant: off by {off:.1e}");
        assert_eq!(found.warning, None, "nothing to warn of");
    }
}

/// Unstable modes 1, 2, ... in a chain that the last state alone drives.
fn chain(n: usize) -> Model {
    let entry = |i: usize, j: usize| match j {
        j if i == j => 1.0 + i as f64,
        j if j == i + 1 => 1.0,
        _ => 0.0,
    };
    let (E, A) = (DMatrix::identity(n, n + 1), DMatrix::from_fn(n, n + 1, entry));
    model(TimeDomain::Continuous, E, A, DMatrix::zeros(n, 0))
}

#[test]
fn the_modes_that_are_named_are_those_of_the_rounded_feedback() {
    let plant = chain(6);
    let found = bounded(&plant).unwrap();
    let off = spectral_distance(&modes(&plant, found.feedback), &found.modes);
    assert!(off < 1e-3, "named and found: off by {off:.1e}");
    assert_eq!(found.warning, None, "as asked for");
}

#[test]
fn a_feedback_that_rounding_spoils_is_not_passed_off_as_good() {
    let (asked, found) = ([Complex64::from(-1.0)], [Complex64::from(-1.5)]);
    assert_eq!(missed(&asked, &asked, Some(1e-9)), None, "as asked for");
    let said = "the modes depend strongly on the last digits of this feedback: asked for -1, found -1.5";
    for error in [Some(0.5), None] {
        assert_eq!(missed(&asked, &found, error).as_deref(), Some(said), "error {error:?}");
    }
    // the longest chains are refused before
    for n in [10, 12, 14] {
        match bounded(&chain(n)) {
            Ok(found) => assert!(found.modes.iter().all(|mode| mode.re < 0.0), "{n}: {:?}", found.modes),
            Err(error) => assert!(error.to_string().contains("do not reach"), "{n}: {error}"),
        }
    }
}

#[test]
fn the_unit_of_an_output_moves_no_plant() {
    let mut plant = model(
        TimeDomain::Continuous,
        dmatrix![1.0, 0.0; 0.0, 0.0],
        dmatrix![2.0, 1.0; 1.0, 1e-3],
        DMatrix::zeros(2, 0),
    );
    plant.system.C *= 1e16;
    assert_eq!(wide(&plant).n_free(), 0, "0 = x1 + 0.001 x2 determines x2 in every unit of y");
    let free = FreeVariables::default();
    let motion = wide(&plant).motion(&plant, &free, &Tolerance::default()).unwrap();
    assert!((motion.A[(0, 0)] + 998.0).abs() < 1e-9, "{}", motion.A);
}

#[test]
fn a_nonlinearity_does_not_belong_to_what_is_bounded() {
    let mut plant =
        model(TimeDomain::Continuous, dmatrix![1.0, 0.0], dmatrix![-2.0, 1.0], DMatrix::zeros(1, 0));
    plant.lipschitz = Some(crate::system::LipschitzTerm {
        G: dmatrix![1.0],
        F_L: DMatrix::identity(2, 2),
        f: vec![crate::system::nonlinearity("x1^2", 2).unwrap()],
        constant: 1.0,
    });
    let error = bounded(&plant).unwrap_err();
    assert_eq!(
        error.to_string(),
        "the linear part of the plant is bounded without feedback: its modes are -2"
    );
}

#[test]
fn an_unknown_input_that_the_equations_fix_belongs_to_the_modes() {
    // x1' = 3 x1 + x2 + d, 0 = x1 + d: d = -x1, so that x1' = 2 x1 + x2
    let plant = model(
        TimeDomain::Continuous,
        dmatrix![1.0, 0.0; 0.0, 0.0],
        dmatrix![3.0, 1.0; 1.0, 0.0],
        dmatrix![1.0; 1.0],
    );
    let open = wide(&plant).motion(&plant, &FreeVariables::default(), &Tolerance::default()).unwrap();
    assert!((open.A[(0, 0)].abs() - 2.0).abs() < 1e-14, "{}", open.A);
    let found = bounded(&plant).unwrap();
    assert!((modes(&plant, found.feedback)[0] + 2.0).norm() < 1e-12, "moved to -2");
}
