//! Affine forms in the variables of a problem: the entries of every matrix expression.

/// `constant + sum coefficient * variable`, terms sorted by variable, without zero coefficients.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Affine {
    pub(super) constant: f64,
    pub(super) terms: Vec<(usize, f64)>,
}

impl Affine {
    pub(super) fn constant(constant: f64) -> Self {
        Self { constant, terms: Vec::new() }
    }

    pub(super) fn variable(index: usize) -> Self {
        Self { constant: 0.0, terms: vec![(index, 1.0)] }
    }

    /// `sum factor * form`; a factor of exactly zero drops its form.
    pub(super) fn combination<'a>(parts: impl Iterator<Item = (f64, &'a Self)>) -> Self {
        let mut constant = 0.0;
        let mut gathered: Vec<(usize, f64)> = Vec::new();
        for (factor, form) in parts.filter(|(factor, _)| *factor != 0.0) {
            constant += factor * form.constant;
            gathered.extend(form.terms.iter().map(|(index, coefficient)| (*index, factor * coefficient)));
        }
        gathered.sort_by_key(|(index, _)| *index);
        let mut terms: Vec<(usize, f64)> = Vec::with_capacity(gathered.len());
        for (index, coefficient) in gathered {
            match terms.last_mut() {
                Some((last, sum)) if *last == index => *sum += coefficient,
                _ => terms.push((index, coefficient)),
            }
        }
        terms.retain(|(_, coefficient)| *coefficient != 0.0);
        Self { constant, terms }
    }

    /// The value at a point; NaN when the point lacks a variable.
    pub(super) fn value(&self, point: &[f64]) -> f64 {
        let term = |(index, coefficient): &(usize, f64)| {
            coefficient * point.get(*index).copied().unwrap_or(f64::NAN)
        };
        self.constant + self.terms.iter().map(term).sum::<f64>()
    }

    pub(super) fn is_finite(&self) -> bool {
        self.constant.is_finite() && self.terms.iter().all(|(_, coefficient)| coefficient.is_finite())
    }

    pub(super) fn largest_coefficient(&self) -> f64 {
        self.terms.iter().fold(0.0, |most, (_, coefficient)| most.max(coefficient.abs()))
    }

    /// The number of variables that a point needs to have for this form.
    pub(super) fn reach(&self) -> usize {
        self.terms.last().map_or(0, |(index, _)| index + 1)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equal_variables_are_gathered_and_cancelled_ones_dropped() {
        let (x, y) = (Affine::variable(4), Affine::variable(1));
        let three = Affine::constant(3.0);
        let sum = Affine::combination([(2.0, &x), (5.0, &y), (1.0, &three), (-2.0, &x)].into_iter());
        assert_eq!(sum, Affine { constant: 3.0, terms: vec![(1, 5.0)] }, "2x + 5y + 3 - 2x");
        assert_eq!(sum.value(&[0.0, 7.0]), 38.0, "5 * 7 + 3");
        assert_eq!(sum.reach(), 2, "variable 1 is the second");
    }

    #[test]
    fn a_missing_variable_is_no_number() {
        assert!(Affine::variable(2).value(&[1.0, 1.0]).is_nan(), "the point has two variables only");
    }
}
