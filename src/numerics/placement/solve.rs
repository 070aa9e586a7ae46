//! From an observable pair to a gain.

use nalgebra::{DMatrix, DVector};
use num_complex::Complex64;

use super::single_output::Chain;
use super::{
    LARGEST_CONDITION, ObservablePart, PlacementError, PlacementMethod, PlacementOptions, PlacementWarning,
    accuracy, null_space, request,
};
use crate::numerics::{NumericsError, PoleOrPair, RankDecision, Tolerance, svd};

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
pub(super) struct Solution {
    /// `n_o` x p.
    pub(super) gain: DMatrix<f64>,
    pub(super) condition: f64,
    /// Largest absolute pole movement by rounding of the gain.
    pub(super) rounding: f64,
    pub(super) method: PlacementMethod,
    /// The poles that were assigned in place of repeated ones.
    pub(super) split: Option<PlacementWarning>,
}

/// Chooses the algorithm by the number of independent outputs.
///
/// # Errors
/// As [`super::place_observer`].
pub(super) fn solve(
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
pub(super) fn pole_scale(poles: &[Complex64], a: &DMatrix<f64>) -> f64 {
    let largest = poles.iter().map(|z| z.norm()).fold(0.0, f64::max);
    let scale = if largest > 0.0 { largest } else { a.norm() };
    if scale > 0.0 { scale } else { 1.0 }
}
