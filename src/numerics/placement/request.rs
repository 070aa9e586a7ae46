//! The list of poles as it is asked for, and repeated poles moved apart.

use num_complex::Complex64;

use super::PlacementError;
use crate::numerics::PoleOrPair;

/// Poles closer than this, relative to their size, count as repeated.
const EQUAL: f64 = 1e-8;

/// Repeated poles are moved apart by this, relative to their size.
const SPREAD: f64 = 1e-3;

/// # Errors
/// [`PlacementError::PoleNotFinite`] with the first pole that is not.
pub(super) fn check_finite(poles: &[Complex64]) -> Result<(), PlacementError> {
    match poles.iter().position(|z| !z.is_finite()) {
        Some(index) => Err(PlacementError::PoleNotFinite { index, pole: poles[index] }),
        None => Ok(()),
    }
}

/// The poles one by one, both members of each pair.
pub(super) fn listed(poles: &[PoleOrPair]) -> Vec<Complex64> {
    let members = |pole: &PoleOrPair| match *pole {
        PoleOrPair::Real(p) => vec![Complex64::from(p)],
        PoleOrPair::Pair(z) => vec![z, z.conj()],
    };
    poles.iter().flat_map(members).collect()
}

/// The upper member of a pair, or the real pole.
pub(super) fn upper(pole: PoleOrPair) -> Complex64 {
    match pole {
        PoleOrPair::Real(p) => Complex64::from(p),
        PoleOrPair::Pair(z) => z,
    }
}

/// Moves poles apart that are repeated more than `limit` times; `None` when there are none.
///
/// A group of m equal poles becomes `ceil(m / limit)` different ones, evenly spaced by a thousandth of their size (of
/// `scale` for poles at zero) around the old place.
pub(super) fn split(poles: &[PoleOrPair], limit: usize, scale: f64) -> Option<Vec<PoleOrPair>> {
    let mut result = poles.to_vec();
    let mut grouped = vec![false; poles.len()];
    let mut changed = false;
    for i in 0..poles.len() {
        if grouped[i] {
            continue;
        }
        let members: Vec<usize> =
            (i..poles.len()).filter(|&j| !grouped[j] && equal(poles[i], poles[j])).collect();
        for &j in &members {
            grouped[j] = true;
        }
        if members.len() <= limit {
            continue;
        }
        changed = true;
        let places = members.len().div_ceil(limit);
        for (position, &j) in members.iter().enumerate() {
            let offset = (position % places) as f64 - 0.5 * (places - 1) as f64;
            result[j] = moved(poles[j], SPREAD * offset, scale);
        }
    }
    changed.then_some(result)
}

fn equal(a: PoleOrPair, b: PoleOrPair) -> bool {
    (upper(a) - upper(b)).norm() <= EQUAL * upper(a).norm()
}

fn moved(pole: PoleOrPair, relative: f64, scale: f64) -> PoleOrPair {
    match pole {
        PoleOrPair::Real(0.0) => PoleOrPair::Real(relative * scale),
        PoleOrPair::Real(p) => PoleOrPair::Real(p * (1.0 + relative)),
        PoleOrPair::Pair(z) => PoleOrPair::Pair(z * (1.0 + relative)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use PoleOrPair::{Pair, Real};

    #[test]
    fn only_poles_beyond_the_limit_are_moved() {
        let poles = [Real(-2.0), Real(-1.0), Real(-2.0), Real(-2.0)];
        assert_eq!(split(&poles, 3, 1.0), None, "three outputs take a triple pole");
        let found = split(&poles, 2, 1.0).unwrap();
        assert_eq!(found[1], Real(-1.0), "the simple pole stays");
        let two: Vec<f64> = found.iter().map(|p| upper(*p).re).filter(|p| *p < -1.5).collect();
        assert_eq!(two, [-2.0 * 0.9995, -2.0 * 1.0005, -2.0 * 0.9995], "two places, a thousandth apart");
    }

    #[test]
    fn pairs_and_zeros_are_moved_too() {
        let z = Complex64::new(-1.0, 2.0);
        let found = split(&[Pair(z), Pair(z), Real(0.0), Real(0.0)], 1, 10.0).unwrap();
        assert_eq!(found[0], Pair(z * 0.9995), "along its own ray, so that the damping stays");
        assert_eq!(found[2..], [Real(-0.005), Real(0.005)], "zeros move by a thousandth of the scale");
    }
}
