//! Pole placement for observers: a gain `L` such that `A - L C` has the wished eigenvalues.
//!
//! Order of work: unobservable modes are split off and reported; the outputs are reduced to independent ones; then
//! one output leads to the unique gain by a product over the poles, several to eigenvectors that are chosen to be as
//! independent as possible. Every gain is measured (`eig(A - L C)`) and comes with the accuracy that its data allow.

mod accuracy;
mod null_space;
mod request;
mod result;
mod single_output;
mod solve;

use nalgebra::DMatrix;
use num_complex::Complex64;

pub use result::{Placement, PlacementError, PlacementMethod, PlacementOptions, PlacementWarning};

use super::{Tolerance, conjugate_pairs, eigenvalues, matching, observable_quotient};
use single_output::Chain;
use solve::{Solution, pole_scale, solve};

/// Computes a gain that gives `A - L C` the wished eigenvalues.
///
/// ```text
/// eig(A - L C) = poles + fixed modes
/// ```
///
/// # Shapes
/// `A` n x n, `C` p x n, as many poles as there are observable modes; `L` n x p.
///
/// # Tolerance
/// [`Tolerance::mode`] decides which modes are fixed, [`Tolerance::rank`] how many outputs are independent. With a
/// single output whose chain needs no arithmetic (companion and bidiagonal matrices) the zero pattern of the data can
/// decide instead: then as many poles as the chain is long are accepted, too.
///
/// # Errors
/// [`PlacementError::PoleCount`] with the number that is needed; [`crate::numerics::NumericsError::NotConjugate`] for a list that is not
/// closed under conjugation; [`PlacementError::PoleNotFinite`]; [`PlacementError::DependentEigenvectors`] and
/// [`PlacementError::Overflow`] when no finite gain was found; [`crate::numerics::NumericsError::Shape`] when `A` and `C` do not fit.
///
/// # Source
/// Kautsky, Nichols and Van Dooren, "Robust pole assignment in linear state feedback", 1985, for several outputs;
/// Ackermann's formula on a Hessenberg form for one.
///
/// # Examples
/// ```
/// use descry::numerics::{Complex64, PlacementOptions, Tolerance, place_observer};
/// let a = nalgebra::dmatrix![0.0, 1.0; 0.0, 0.0];
/// let c = nalgebra::dmatrix![1.0, 0.0];
/// let poles = [Complex64::new(-1.0, 1.0), Complex64::new(-1.0, -1.0)];
/// let found = place_observer(&a, &c, &poles, &PlacementOptions::default(), &Tolerance::default())?;
/// // s^2 + 2 s + 2
/// assert_eq!(found.gain, nalgebra::dmatrix![2.0; 2.0]);
/// # Ok::<(), descry::numerics::PlacementError>(())
/// ```
pub fn place_observer(
    a: &DMatrix<f64>,
    c: &DMatrix<f64>,
    poles: &[Complex64],
    options: &PlacementOptions,
    tolerance: &Tolerance,
) -> Result<Placement, PlacementError> {
    request::check_finite(poles)?;
    let pairs = conjugate_pairs(poles)?;
    let part = observable_part(a, c, poles.len(), tolerance)?;
    let solution = solve(&part, &pairs, options, tolerance)?;
    finish(a, c, poles, part, solution)
}

/// The part of a pair whose poles can be placed.
struct ObservablePart {
    /// n x `n_o`, orthonormal; `None` when it is the whole space, whose coordinates then stay as they are.
    basis: Option<DMatrix<f64>>,
    a: DMatrix<f64>,
    c: DMatrix<f64>,
    fixed_modes: Vec<Complex64>,
}

impl ObservablePart {
    fn new(a: &DMatrix<f64>, c: &DMatrix<f64>, basis: DMatrix<f64>, fixed_modes: Vec<Complex64>) -> Self {
        if basis.is_square() {
            return Self { basis: None, a: a.clone(), c: c.clone(), fixed_modes };
        }
        Self { a: basis.tr_mul(&(a * &basis)), c: c * &basis, basis: Some(basis), fixed_modes }
    }

    fn in_full_coordinates(&self, gain: DMatrix<f64>) -> DMatrix<f64> {
        match &self.basis {
            Some(basis) => basis * gain,
            None => gain,
        }
    }
}

fn observable_part(
    a: &DMatrix<f64>,
    c: &DMatrix<f64>,
    poles: usize,
    tolerance: &Tolerance,
) -> Result<ObservablePart, PlacementError> {
    let n = a.nrows();
    if a.is_square() && c.shape() == (1, n) && a.iter().chain(c.iter()).all(|x| x.is_finite()) {
        let chain = Chain::new(a, &c.row(0).transpose());
        let smallest = chain.subdiagonals().map(f64::abs).fold(f64::INFINITY, f64::min);
        let negligible = tolerance.rank * n as f64 * f64::EPSILON * a.norm();
        if chain.exact && chain.order == poles && poles > 0 && smallest > negligible {
            let rest = chain.hessenberg.view((poles, poles), (n - poles, n - poles)).into_owned();
            return Ok(ObservablePart::new(a, c, chain.observable_basis(), eigenvalues(&rest)?));
        }
    }
    let quotient = observable_quotient(a, c, tolerance)?;
    let needed = quotient.basis.ncols();
    if needed != poles {
        let fixed_modes = quotient.fixed_modes;
        return Err(PlacementError::PoleCount { found: poles, needed, states: n, fixed_modes });
    }
    Ok(ObservablePart::new(a, c, quotient.basis, quotient.fixed_modes))
}

/// Above this the closed-loop eigenvectors count as ill-conditioned.
const LARGEST_CONDITION: f64 = 1e8;

/// Above this relative pole error by rounding of the gain a placement counts as ill-conditioned.
const LARGEST_EXPECTED: f64 = 1e-4;

/// The relative pole error that is accepted silently.
fn largest_error(states: usize) -> f64 {
    const SMALL: usize = 6;
    if states <= SMALL { 1e-6 } else { 1e-3 }
}

/// Measures a gain and puts the result together.
fn finish(
    a: &DMatrix<f64>,
    c: &DMatrix<f64>,
    poles: &[Complex64],
    part: ObservablePart,
    solution: Solution,
) -> Result<Placement, PlacementError> {
    let scale = pole_scale(poles, a);
    let expected = solution.rounding / scale;
    let gain = part.in_full_coordinates(solution.gain);
    if gain.iter().any(|l| !l.is_finite()) {
        return Err(PlacementError::Overflow);
    }
    let wanted: Vec<Complex64> = poles.iter().chain(&part.fixed_modes).copied().collect();
    let mut achieved = Vec::new();
    let mut measured = None;
    if let Ok(found) = eigenvalues(&(a - &gain * c))
        && let Some(pairs) = matching(&wanted, &found)
    {
        achieved = pairs.iter().take(poles.len()).map(|&(_, j)| found[j]).collect();
        let error = poles.iter().zip(&achieved).map(|(p, z)| (p - z).norm()).fold(0.0, f64::max);
        measured = Some(error / scale);
    }
    let mut warnings: Vec<PlacementWarning> = solution.split.into_iter().collect();
    // poles that were moved apart miss the request by a few thousandths
    const MOVED: f64 = 1e-2;
    let accepted = if warnings.is_empty() { largest_error(a.nrows()) } else { MOVED };
    let too_large = measured.is_none_or(|error| error > accepted);
    let condition = solution.condition;
    // a repeated pole of one output has dependent eigenvectors by nature: its accuracy tells more
    let conditioned = condition <= LARGEST_CONDITION || condition.is_infinite();
    if too_large || !conditioned || expected.is_nan() || expected > LARGEST_EXPECTED {
        warnings.push(PlacementWarning::IllConditioned { expected, condition, measured });
    }
    // the gain is better than what eigenvalues of the closed loop can show
    const BEYOND: f64 = 100.0;
    if too_large && measured.is_none_or(|error| error > BEYOND * expected) {
        warnings.push(PlacementWarning::Unverifiable { measured, expected });
        achieved.clear();
        measured = None;
    }
    Ok(Placement {
        gain,
        requested: poles.to_vec(),
        achieved,
        fixed_modes: part.fixed_modes,
        relative_error: measured,
        condition,
        expected_accuracy: expected,
        method: solution.method,
        warnings,
    })
}
