//! One explicit step of order 5 (Dormand and Prince).

use super::Flow;
use super::dense::Dense;

/// Stage times.
const C: [f64; 7] = [0.0, 0.2, 0.3, 0.8, 8.0 / 9.0, 1.0, 1.0];
/// Stage weights, row by row; the last row is the step itself.
const A: [&[f64]; 7] = [
    &[],
    &[0.2],
    &[3.0 / 40.0, 9.0 / 40.0],
    &[44.0 / 45.0, -56.0 / 15.0, 32.0 / 9.0],
    &[19_372.0 / 6_561.0, -25_360.0 / 2_187.0, 64_448.0 / 6_561.0, -212.0 / 729.0],
    &[9_017.0 / 3_168.0, -355.0 / 33.0, 46_732.0 / 5_247.0, 49.0 / 176.0, -5_103.0 / 18_656.0],
    &[35.0 / 384.0, 0.0, 500.0 / 1_113.0, 125.0 / 192.0, -2_187.0 / 6_784.0, 11.0 / 84.0],
];
/// Difference of the solutions of order 5 and 4.
const ERROR: [f64; 7] = [
    71.0 / 57_600.0,
    0.0,
    -71.0 / 16_695.0,
    71.0 / 1_920.0,
    -17_253.0 / 339_200.0,
    22.0 / 525.0,
    -1.0 / 40.0,
];
/// Last term of the dense output.
const DENSE: [f64; 7] = [
    -12_715_105_075.0 / 11_282_082_432.0,
    0.0,
    87_487_479_700.0 / 32_700_410_799.0,
    -10_690_763_975.0 / 1_880_347_072.0,
    701_980_252_875.0 / 199_316_789_632.0,
    -1_453_857_185.0 / 822_651_844.0,
    69_997_945.0 / 29_380_423.0,
];
/// Beyond this product of step and eigenvalue a step may be limited by a fast mode instead of the solution: stability ends
/// at 3.3, and strict tolerances make smaller steps of a stiff equation before that.
const FAST: f64 = 0.7;

/// Stages of the method of Dormand and Prince, order 5 with an error estimate of order 4.
///
/// ```text
/// k_i = F(t + c_i h, w + h sum_j a_ij k_j),   w(t + h) = w + h sum_j a_7j k_j
/// ```
///
/// The last stage is the derivative at the end, and so the first of the next step.
///
/// # Source
/// J. R. Dormand, P. J. Prince, 1980; dense output and test for stiffness: E. Hairer, S. P. Norsett, G. Wanner, Solving
/// Ordinary Differential Equations I, 1993, sections II.5, II.6 and IV.2.
#[derive(Clone, Debug)]
pub(super) struct Explicit {
    k: Vec<Vec<f64>>,
    stage: Vec<f64>,
    sixth: Vec<f64>,
}

impl Explicit {
    pub(super) fn new(order: usize) -> Self {
        Self { k: vec![vec![0.0; order]; 7], stage: vec![0.0; order], sixth: vec![0.0; order] }
    }

    /// Attempts a step; `first` is the derivative at its start. False when a stage has no value.
    pub(super) fn attempt(
        &mut self,
        flow: &mut dyn Flow,
        (t, h): (f64, f64),
        start: &[f64],
        first: &[f64],
        (end, error): (&mut [f64], &mut [f64]),
    ) -> bool {
        self.k[0].copy_from_slice(first);
        for i in 1..7 {
            self.stage.copy_from_slice(start);
            for (weight, k) in A[i].iter().zip(&self.k) {
                add(&mut self.stage, h * weight, k);
            }
            if i == 5 {
                self.sixth.copy_from_slice(&self.stage);
            }
            if !flow.derivative(t + C[i] * h, &self.stage, &mut self.k[i]) {
                return false;
            }
        }
        end.copy_from_slice(&self.stage);
        error.fill(0.0);
        for (weight, k) in ERROR.iter().zip(&self.k) {
            add(error, h * weight, k);
        }
        true
    }

    /// The derivative at the end of the last attempt.
    pub(super) fn last(&self) -> &[f64] {
        &self.k[6]
    }

    /// Whether a fast mode may limit a step of this length: the two last stages lie at the same instant, and their
    /// difference shows the largest eigenvalue.
    pub(super) fn meets_fast_mode(&self, h: f64, end: &[f64], scale: &[f64]) -> bool {
        let (mut rates, mut states) = (0.0, 0.0);
        for (i, s) in scale.iter().enumerate() {
            rates += ((self.k[6][i] - self.k[5][i]) / s).powi(2);
            states += ((end[i] - self.sixth[i]) / s).powi(2);
        }
        states > 0.0 && h * (rates / states).sqrt() > FAST
    }

    /// The dense output of the last attempt.
    pub(super) fn dense(&self, h: f64, start: &[f64], end: &[f64], dense: &mut Dense) {
        for i in 0..start.len() {
            let difference = end[i] - start[i];
            let bend = h * self.k[0][i] - difference;
            let fifth: f64 = DENSE.iter().zip(&self.k).map(|(weight, k)| weight * k[i]).sum();
            let fourth = difference - h * self.k[6][i] - bend;
            dense.set(i, start[i], [difference, bend, fourth, h * fifth]);
        }
    }
}

/// `to += factor * what`.
pub(super) fn add(to: &mut [f64], factor: f64, what: &[f64]) {
    if factor != 0.0 {
        for (x, y) in to.iter_mut().zip(what) {
            *x += factor * y;
        }
    }
}
