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

use nalgebra::{DMatrix, DVector};
use num_complex::Complex64;

pub use result::{Placement, PlacementError, PlacementMethod, PlacementOptions, PlacementWarning};

use super::{
    NumericsError, PoleOrPair, RankDecision, Tolerance, conjugate_pairs, eigenvalues, matching,
    observable_quotient, svd,
};
use single_output::Chain;

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
/// [`PlacementError::PoleCount`] with the number that is needed; [`NumericsError::NotConjugate`] for a list that is not
/// closed under conjugation; [`PlacementError::PoleNotFinite`]; [`PlacementError::DependentEigenvectors`] and
/// [`PlacementError::Overflow`] when no finite gain was found; [`NumericsError::Shape`] when `A` and `C` do not fit.
///
/// # Source
/// See [the list in the module of several outputs](self); Miminis and Paige 1982 for one output.
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

/// `C = mixing * rows` with independent rows, and the left inverse of `mixing`.
struct IndependentOutputs {
    rows: DMatrix<f64>,
    /// p x r.
    mixing: DMatrix<f64>,
    /// r x p: `L C = (L_r unmixing) C` for a gain `L_r` of the rows.
    unmixing: DMatrix<f64>,
}

fn independent_outputs(c: &DMatrix<f64>, tolerance: &Tolerance) -> Result<IndependentOutputs, NumericsError> {
    let found = svd(c)?;
    let rank = RankDecision::from_singular_values(c.shape(), found.s, 0.0, tolerance);
    let r = rank.rank;
    if r == 1 {
        // one of the given rows rather than a rounded combination of all
        let norms: Vec<f64> = c.row_iter().map(|row| row.norm()).collect();
        let largest = (0..norms.len()).max_by(|&i, &j| norms[i].total_cmp(&norms[j])).unwrap_or(0);
        let rows = c.rows(largest, 1).into_owned();
        let mut mixing = c * rows.transpose() / rows.norm_squared();
        mixing[(largest, 0)] = 1.0;
        let unmixing = mixing.transpose() / mixing.norm_squared();
        return Ok(IndependentOutputs { rows, mixing, unmixing });
    }
    let s = &rank.singular_values;
    Ok(IndependentOutputs {
        rows: found.v.columns(0, r).transpose(),
        mixing: DMatrix::from_fn(c.nrows(), r, |i, j| found.u[(i, j)] * s[j]),
        unmixing: DMatrix::from_fn(r, c.nrows(), |i, j| found.u[(j, i)] / s[i]),
    })
}

/// A gain of the observable part.
struct Solution {
    /// `n_o` x p.
    gain: DMatrix<f64>,
    condition: f64,
    /// Largest absolute pole movement by rounding of the gain.
    rounding: f64,
    method: PlacementMethod,
    /// The poles that were assigned in place of repeated ones.
    split: Option<PlacementWarning>,
}

fn solve(
    part: &ObservablePart,
    poles: &[PoleOrPair],
    options: &PlacementOptions,
    tolerance: &Tolerance,
) -> Result<Solution, PlacementError> {
    let n = part.a.nrows();
    if n == 0 {
        let gain = DMatrix::zeros(0, part.c.nrows());
        let method = PlacementMethod::NothingToPlace;
        return Ok(Solution { gain, condition: 1.0, rounding: 0.0, method, split: None });
    }
    let outputs = independent_outputs(&part.c, tolerance)?;
    match outputs.rows.nrows() {
        1 => single_output(part, &outputs, poles),
        r if r == n => Ok(direct(part, &outputs, poles)),
        _ => several_outputs(part, &outputs, poles, options),
    }
}

fn single_output(
    part: &ObservablePart,
    outputs: &IndependentOutputs,
    poles: &[PoleOrPair],
) -> Result<Solution, PlacementError> {
    let chain = Chain::new(&part.a, &outputs.rows.row(0).transpose());
    let n = part.a.nrows();
    if chain.order < n {
        return Err(NumericsError::Singular { what: "the observability matrix", smallest: 0.0 }.into());
    }
    let gain = &chain.basis * chain.gain(poles)? * &outputs.unmixing;
    let all = request::listed(poles);
    // c adj(lambda I - A) = factor * eigenvector
    let factor = chain.subdiagonals().fold(chain.first, |product, h| product * h).abs();
    let mixing = outputs.mixing.column(0).map(Complex64::from);
    let mut rounding = 0.0_f64;
    let mut vectors = DMatrix::zeros(n, n);
    for (i, &pole) in all.iter().enumerate() {
        let vector = chain.basis.map(Complex64::from) * chain.eigenvector(pole);
        let change = factor * accuracy::rounding(&vector, &gain, &mixing);
        rounding = rounding.max(accuracy::root_shift(change, pole, accuracy::others(&all, i)));
        let part = |z: &Complex64| if pole.im < 0.0 { z.im } else { z.re };
        let size = vector.norm() * if pole.im == 0.0 { 1.0 } else { std::f64::consts::FRAC_1_SQRT_2 };
        vectors.set_column(i, &DVector::from_iterator(n, vector.iter().map(|z| part(z) / size)));
    }
    let repeated = (0..n).any(|i| all[..i].contains(&all[i]));
    let condition = if repeated { f64::INFINITY } else { condition_number(&vectors)? };
    Ok(Solution { gain, condition, rounding, method: PlacementMethod::SingleOutput, split: None })
}

fn direct(part: &ObservablePart, outputs: &IndependentOutputs, poles: &[PoleOrPair]) -> Solution {
    let identity = DMatrix::identity(part.a.nrows(), part.a.nrows());
    let target = null_space::scaled_by_poles(&identity, poles).transpose();
    let gain = (&part.a - target) * outputs.rows.transpose() * &outputs.unmixing;
    let rounding = eigenvector_rounding(&identity, &identity, &gain, &part.c, poles);
    Solution { gain, condition: 1.0, rounding, method: PlacementMethod::Direct, split: None }
}

fn several_outputs(
    part: &ObservablePart,
    outputs: &IndependentOutputs,
    poles: &[PoleOrPair],
    options: &PlacementOptions,
) -> Result<Solution, PlacementError> {
    let r = outputs.rows.nrows();
    let scale = pole_scale(&request::listed(poles), &part.a);
    let attempt = |poles: &[PoleOrPair], split: bool| -> Result<Solution, PlacementError> {
        let found = null_space::place(&part.a, &outputs.rows, poles, options)?;
        let gain = found.gain * &outputs.unmixing;
        let rounding = eigenvector_rounding(&found.x, &found.inverse, &gain, &part.c, poles);
        let assigned =
            || PlacementWarning::SplitRepeatedPoles { assigned: request::listed(poles), outputs: r };
        let split = split.then(assigned);
        let condition = condition_number(&found.x)?;
        Ok(Solution { gain, condition, rounding, method: PlacementMethod::NullSpace, split })
    };
    if let Some(apart) = request::split(poles, r, scale) {
        return attempt(&apart, true);
    }
    let whole = attempt(poles, false);
    if whole.as_ref().is_ok_and(|found| found.condition <= LARGEST_CONDITION) {
        return whole;
    }
    // Rosenbrock: even fewer repetitions than outputs may exclude independent eigenvectors
    let Some(apart) = request::split(poles, 1, scale) else { return whole };
    let apart = attempt(&apart, true)?;
    Ok(match whole {
        Ok(whole) if whole.condition <= apart.condition => whole,
        _ => apart,
    })
}

/// Largest first-order movement of a semi-simple pole by rounding of the gain.
fn eigenvector_rounding(
    x: &DMatrix<f64>,
    inverse: &DMatrix<f64>,
    gain: &DMatrix<f64>,
    c: &DMatrix<f64>,
    poles: &[PoleOrPair],
) -> f64 {
    // right eigenvectors of A - L C are the rows of the inverse
    let seen = c * inverse.transpose();
    let mut column = 0;
    let mut worst = 0.0_f64;
    for &pole in poles {
        let left = null_space::eigenvector(x, column, pole);
        let right = null_space::eigenvector(&seen, column, pole);
        worst = worst.max(accuracy::rounding(&left, gain, &right));
        column += if matches!(pole, PoleOrPair::Pair(_)) { 2 } else { 1 };
    }
    worst
}

fn condition_number(vectors: &DMatrix<f64>) -> Result<f64, NumericsError> {
    let s = svd(vectors)?.s;
    let (largest, smallest) = (s.first().copied().unwrap_or(1.0), s.last().copied().unwrap_or(1.0));
    Ok(largest / smallest)
}

/// What relative pole errors refer to: the largest pole, or the norm of `A` when all poles are zero.
fn pole_scale(poles: &[Complex64], a: &DMatrix<f64>) -> f64 {
    let largest = poles.iter().map(|z| z.norm()).fold(0.0, f64::max);
    let scale = if largest > 0.0 { largest } else { a.norm() };
    if scale > 0.0 { scale } else { 1.0 }
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
    let too_large = measured.is_none_or(|error| error > largest_error(a.nrows()));
    let mut warnings: Vec<PlacementWarning> = solution.split.into_iter().collect();
    let condition = solution.condition;
    // a repeated pole of one output has dependent eigenvectors by nature: its accuracy tells more
    let conditioned = condition <= LARGEST_CONDITION || condition.is_infinite();
    let split = !warnings.is_empty();
    if (too_large && !split) || !conditioned || expected.is_nan() || expected > LARGEST_EXPECTED {
        warnings.push(PlacementWarning::IllConditioned { expected, condition, measured });
    }
    // the gain is better than what eigenvalues of the closed loop can show
    const BEYOND: f64 = 100.0;
    if too_large && !split && measured.is_none_or(|error| error > BEYOND * expected) {
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
