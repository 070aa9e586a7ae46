//! The solution inside a step.

/// A polynomial of degree 4 in the part `s` of a step, for each state:
///
/// ```text
/// w = w_0 + s (c_1 + (1 - s) (c_2 + s (c_3 + (1 - s) c_4)))
/// ```
#[derive(Clone, Debug)]
pub(super) struct Dense {
    start: Vec<f64>,
    coefficients: Vec<[f64; 4]>,
}

impl Dense {
    pub(super) fn new(order: usize) -> Self {
        Self { start: vec![0.0; order], coefficients: vec![[0.0; 4]; order] }
    }

    /// Sets the polynomial of a state.
    pub(super) fn set(&mut self, index: usize, start: f64, coefficients: [f64; 4]) {
        self.start[index] = start;
        self.coefficients[index] = coefficients;
    }

    /// Writes the states at the part `s` of the step, from zero to one.
    pub(super) fn at(&self, s: f64, out: &mut [f64]) {
        let rest = 1.0 - s;
        for ((out, start), c) in out.iter_mut().zip(&self.start).zip(&self.coefficients) {
            *out = start + s * (c[0] + rest * (c[1] + s * (c[2] + rest * c[3])));
        }
    }

    /// Writes the states in the middle of the step, and their derivatives by `s`.
    pub(super) fn middle(&self, out: &mut [f64], slope: &mut [f64]) {
        self.at(0.5, out);
        for (slope, c) in slope.iter_mut().zip(&self.coefficients) {
            let inner = c[2] + 0.5 * c[3];
            let (second, second_slope) = (c[1] + 0.5 * inner, inner - 0.5 * c[3]);
            let (first, first_slope) = (c[0] + 0.5 * second, 0.5 * second_slope - second);
            *slope = first + 0.5 * first_slope;
        }
    }
}
