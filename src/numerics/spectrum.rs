//! Sets of complex numbers: sorting, pairing, matching.

use num_complex::Complex64;

use super::NumericsError;

/// Sorts by real part, then by absolute imaginary part, with the upper member of a conjugate pair first.
///
/// Real parts that are equal but for rounding form one run, which is sorted by the imaginary parts.
pub fn sort_spectrum(values: &mut [Complex64]) {
    values.sort_by(|a, b| a.re.total_cmp(&b.re));
    let mut rest = values;
    while let Some(first) = rest.first().copied() {
        let close = |z: &Complex64| (z.re - first.re).abs() <= 1e-9 * (z.norm() + first.norm());
        let run = rest.iter().take_while(|z| close(z)).count().max(1);
        let (head, tail) = rest.split_at_mut(run);
        head.sort_by(|a, b| a.im.abs().total_cmp(&b.im.abs()).then(b.im.total_cmp(&a.im)));
        rest = tail;
    }
}

/// One pole, or a conjugate pair given by its upper member.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum PoleOrPair {
    /// A real pole.
    Real(f64),
    /// `z` and its conjugate, with positive imaginary part.
    Pair(Complex64),
}

/// Relative distance within which two poles count as conjugate to each other, or one as real.
const CONJUGATE_TOLERANCE: f64 = 1e-9;

/// Groups a list of poles into real ones and conjugate pairs, in the order of first appearance.
///
/// # Errors
/// [`NumericsError::NotConjugate`] with the first pole whose partner is missing.
pub fn conjugate_pairs(poles: &[Complex64]) -> Result<Vec<PoleOrPair>, NumericsError> {
    let mut used = vec![false; poles.len()];
    let mut result = Vec::with_capacity(poles.len());
    for (i, &pole) in poles.iter().enumerate() {
        if std::mem::replace(&mut used[i], true) {
            continue;
        }
        let limit = CONJUGATE_TOLERANCE * pole.norm().max(f64::MIN_POSITIVE);
        if pole.im.abs() <= limit {
            result.push(PoleOrPair::Real(pole.re));
            continue;
        }
        let partner = (0..poles.len()).find(|&k| !used[k] && (poles[k] - pole.conj()).norm() <= limit);
        let Some(partner) = partner else { return Err(NumericsError::NotConjugate { pole }) };
        used[partner] = true;
        result.push(PoleOrPair::Pair(Complex64::new(pole.re, pole.im.abs())));
    }
    Ok(result)
}

/// Largest distance between two sets of complex numbers of equal size under the best pairing found.
///
/// Greedy by smallest distance, then improved by swaps until no swap lowers the largest distance; infinite when the
/// sizes differ.
pub fn spectral_distance(a: &[Complex64], b: &[Complex64]) -> f64 {
    matching(a, b)
        .map_or(f64::INFINITY, |pairs| pairs.iter().map(|&(i, j)| (a[i] - b[j]).norm()).fold(0.0, f64::max))
}

/// Pairs of indices `(i, j)` that match the members of `a` with those of `b`; `None` when the sizes differ.
pub fn matching(a: &[Complex64], b: &[Complex64]) -> Option<Vec<(usize, usize)>> {
    if a.len() != b.len() {
        return None;
    }
    let distance = |i: usize, j: usize| (a[i] - b[j]).norm();
    let mut candidates: Vec<(usize, usize)> =
        (0..a.len()).flat_map(|i| (0..b.len()).map(move |j| (i, j))).collect();
    candidates.sort_by(|&(i, j), &(k, l)| distance(i, j).total_cmp(&distance(k, l)));
    let mut partner = vec![usize::MAX; a.len()];
    let mut taken = vec![false; b.len()];
    for (i, j) in candidates {
        if partner[i] == usize::MAX && !taken[j] {
            partner[i] = j;
            taken[j] = true;
        }
    }
    loop {
        let mut improved = false;
        for i in 0..a.len() {
            for k in 0..i {
                let now = distance(i, partner[i]).max(distance(k, partner[k]));
                let swapped = distance(i, partner[k]).max(distance(k, partner[i]));
                if swapped < now * (1.0 - 1e-12) {
                    partner.swap(i, k);
                    improved = true;
                }
            }
        }
        if !improved {
            return Some(partner.into_iter().enumerate().collect());
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn c(re: f64, im: f64) -> Complex64 {
        Complex64::new(re, im)
    }

    #[test]
    fn many_nearly_equal_real_parts_are_sorted_without_a_cycle() {
        let mut values: Vec<Complex64> =
            (0..60).map(|k| c(-1.0 + 1.5e-9 * f64::from(k % 7), f64::from(60 - k))).collect();
        sort_spectrum(&mut values);
        assert_eq!(values.len(), 60, "nothing is lost");
        assert!(values.windows(2).all(|w| w[1].re - w[0].re > -1e-8), "real parts ascend but for rounding");
    }

    #[test]
    fn a_pair_is_grouped_once() {
        let groups = conjugate_pairs(&[c(-1.0, -2.0), c(-3.0, 0.0), c(-1.0, 2.0)]).unwrap();
        assert_eq!(
            groups,
            [PoleOrPair::Pair(c(-1.0, 2.0)), PoleOrPair::Real(-3.0)],
            "pair, then the real pole"
        );
    }

    #[test]
    fn a_lone_complex_pole_is_named() {
        let error = conjugate_pairs(&[c(-1.0, 2.0)]).unwrap_err();
        assert_eq!(error, NumericsError::NotConjugate { pole: c(-1.0, 2.0) }, "its conjugate is missing");
    }

    #[test]
    fn distance_ignores_the_order() {
        let a = [c(-1.0, 1.0), c(-1.0, -1.0), c(-2.0, 0.0)];
        let b = [c(-2.0, 0.0), c(-1.0, -1.0), c(-1.0, 1.1)];
        assert!((spectral_distance(&a, &b) - 0.1).abs() < 1e-12, "only one member moved, by 0.1");
    }
}
