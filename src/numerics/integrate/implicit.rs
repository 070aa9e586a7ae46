//! One linearly implicit step of order 5 (`Rodas5P`), for stiff equations.

use nalgebra::{DMatrix, DVector, Dyn, LU};

use super::Flow;
use super::dense::Dense;
use super::explicit::add;

const GAMMA: f64 = 0.211_937_563_194_290_14;
/// Stage times.
const ALPHA: [f64; 8] = [
    0.0,
    0.635_812_689_582_870_4,
    0.409_579_839_339_753_5,
    0.976_930_672_506_071_6,
    0.428_840_360_955_866_4,
    1.0,
    1.0,
    1.0,
];
/// Weights of the partial derivative in time.
const TIME: [f64; 8] = [
    GAMMA,
    -0.423_875_126_388_580_27,
    -0.338_462_712_623_592_4,
    1.804_645_287_288_273_4,
    2.325_825_639_765_069,
    0.0,
    0.0,
    0.0,
];
/// Sixth row of the stage weights; each later one has a further one.
const LAST: [f64; 5] = [
    -7.502_846_399_306_121,
    2.561_846_144_803_919,
    -11.627_539_656_261_098,
    -0.182_687_676_599_422_56,
    0.030_198_172_008_377_946,
];
/// Stage weights.
const A: [&[f64]; 8] = [
    &[],
    &[3.0],
    &[2.849_394_379_747_939, 0.458_422_422_044_639_23],
    &[-6.954_028_509_809_101, 2.489_845_061_869_568, -10.358_996_098_473_584],
    &[2.802_998_627_562_896_4, 0.507_246_473_622_820_6, -0.398_831_254_177_052_4, -0.047_211_872_304_046_41],
    &LAST,
    &[LAST[0], LAST[1], LAST[2], LAST[3], LAST[4], 1.0],
    &[LAST[0], LAST[1], LAST[2], LAST[3], LAST[4], 1.0, 1.0],
];
/// Weights of the earlier stages on the right-hand side, divided by the step.
const C: [&[f64]; 8] = [
    &[],
    &[-14.155_112_264_123_755],
    &[-17.972_960_358_859_52, -2.859_693_295_451_294],
    &[147.121_502_757_117_16, -1.412_214_027_182_13, 71.689_402_513_023_58],
    &[165.435_170_248_716_76, -0.459_282_345_649_112_6, 42.909_383_369_586_03, -5.961_986_721_573_306],
    &[
        24.854_864_614_690_072,
        -3.000_922_700_283_218_6,
        47.493_111_002_076_8,
        5.581_419_782_155_812_5,
        -0.661_069_182_524_947_1,
    ],
    &[
        30.912_732_140_285_99,
        -3.120_824_334_993_797_4,
        77.799_546_460_708_92,
        34.286_460_282_947_83,
        -19.097_331_116_725_623,
        -28.087_943_162_872_662,
    ],
    &[
        37.802_771_233_905_63,
        -3.257_196_902_907_227_6,
        112.269_188_494_963_27,
        66.934_723_124_404_7,
        -40.066_189_370_910_02,
        -54.667_802_628_779_68,
        -9.488_616_523_096_27,
    ],
];
/// Dense output.
const DENSE: [[f64; 8]; 3] = [
    [
        25.948_786_856_663_858,
        -2.557_972_484_584_623_5,
        10.433_815_404_888_879,
        -2.367_925_102_268_520_4,
        0.524_948_541_321_073,
        1.124_108_831_045_040_4,
        0.427_287_619_443_187_4,
        -0.172_022_210_701_554_93,
    ],
    [
        -9.915_688_506_951_71,
        -0.968_994_459_411_515_4,
        3.043_803_724_297_845_3,
        -24.495_224_566_215_796,
        20.176_138_334_709_044,
        15.980_663_614_246_51,
        -6.789_040_303_419_874,
        -6.710_236_069_923_372,
    ],
    [
        11.419_903_575_922_262,
        2.887_964_514_613_699_4,
        72.921_379_959_960_29,
        80.125_118_346_226_43,
        -52.072_871_366_152_654,
        -59.789_936_252_667_29,
        -0.155_826_842_827_519_13,
        4.883_087_185_713_722,
    ],
];
/// The derivative in time is a difference over this part of the step, five points from its start.
const NEAR: f64 = 0.02;
/// Weights of the five points.
const FORWARD: [f64; 5] = [-25.0 / 12.0, 4.0, -3.0, 4.0 / 3.0, -0.25];

/// Stages of `Rodas5P`: order 5 with an error estimate of order 4, L-stable, without iteration.
///
/// ```text
/// (I / (h gamma) - J) k_i = F(t + alpha_i h, w + sum_j a_ij k_j) + sum_j c_ij k_j / h + h gamma_i dF/dt
/// w(t + h) = w + sum_j a_8j k_j + k_8,   J = dF/dw at the start
/// ```
///
/// Stages six to eight lie at the end of the step, so that states which follow their input at once do so here.
///
/// # Source
/// G. Steinebach, Construction of Rosenbrock-Wanner method `Rodas5P` and numerical benchmarks within the Julia
/// Differential Equations package, BIT Numerical Mathematics 63, 2023.
#[derive(Clone, Debug)]
pub(super) struct Implicit {
    k: Vec<DVector<f64>>,
    jacobian: DMatrix<f64>,
    in_time: Vec<f64>,
    stage: Vec<f64>,
    /// The step from `t` of which Jacobian and derivative in time are kept: a repeated attempt needs no other.
    kept: Option<f64>,
    factors: Option<LU<f64, Dyn, Dyn>>,
    residual: DVector<f64>,
}

impl Implicit {
    pub(super) fn new(order: usize) -> Self {
        Self {
            k: vec![DVector::zeros(order); 8],
            jacobian: DMatrix::zeros(order, order),
            in_time: vec![0.0; order],
            stage: vec![0.0; order],
            kept: None,
            factors: None,
            residual: DVector::zeros(order),
        }
    }

    /// Forgets the Jacobian of an earlier stretch of time.
    pub(super) fn forget(&mut self) {
        self.kept = None;
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
        if self.kept != Some(t) && !flow.jacobian(t, start, &mut self.jacobian) {
            return false;
        }
        self.kept = Some(t);
        if !self.derivative_in_time(flow, (t, h), start, first) {
            return false;
        }
        let mut matrix = -&self.jacobian;
        for i in 0..start.len() {
            matrix[(i, i)] += (h * GAMMA).recip();
        }
        if matrix.iter().any(|x| !x.is_finite()) {
            return false;
        }
        let factors = matrix.lu();
        for i in 0..8 {
            self.stage.copy_from_slice(start);
            let (before, rest) = self.k.split_at_mut(i);
            let Some(own) = rest.first_mut() else { return false };
            for (weight, k) in A[i].iter().zip(before.iter()) {
                add(&mut self.stage, *weight, k.as_slice());
            }
            let out = own.as_mut_slice();
            if i == 0 {
                out.copy_from_slice(first);
            } else if !flow.derivative(t + ALPHA[i] * h, &self.stage, out) {
                return false;
            }
            for (weight, k) in C[i].iter().zip(before.iter()) {
                add(out, weight / h, k.as_slice());
            }
            add(out, h * TIME[i], &self.in_time);
            if !factors.solve_mut(own) {
                return false;
            }
        }
        self.factors = Some(factors);
        for (i, x) in end.iter_mut().enumerate() {
            error[i] = self.k[7][i];
            *x = self.stage[i] + error[i];
        }
        true
    }

    /// `dF/dt` at the start, of order four in the length of the step.
    fn derivative_in_time(
        &mut self,
        flow: &mut dyn Flow,
        (t, h): (f64, f64),
        start: &[f64],
        first: &[f64],
    ) -> bool {
        let near = NEAR * h;
        self.in_time.fill(0.0);
        add(&mut self.in_time, FORWARD[0] / near, first);
        for (i, weight) in FORWARD.iter().enumerate().skip(1) {
            if !flow.derivative(t + near * i as f64, start, &mut self.stage) {
                return false;
            }
            add(&mut self.in_time, weight / near, &self.stage);
        }
        true
    }

    /// Writes the error of the dense output in the middle of the last attempt, from its residual; false where that has
    /// no value. States that follow their input at once are less accurate there than at the end of the step.
    pub(super) fn dense_error(
        &mut self,
        flow: &mut dyn Flow,
        (t, h): (f64, f64),
        dense: &Dense,
        error: &mut [f64],
    ) -> bool {
        dense.middle(&mut self.stage, error);
        let residual = self.residual.as_mut_slice();
        if !flow.derivative(t + 0.5 * h, &self.stage, residual) {
            return false;
        }
        add(residual, -h.recip(), error);
        let solved = self.factors.as_ref().is_some_and(|factors| factors.solve_mut(&mut self.residual));
        error.copy_from_slice(self.residual.as_slice());
        solved
    }

    /// The dense output of the last attempt.
    pub(super) fn dense(&self, start: &[f64], end: &[f64], dense: &mut Dense) {
        for i in 0..start.len() {
            let [a, b, c]: [f64; 3] =
                DENSE.map(|row| row.iter().zip(&self.k).map(|(weight, k)| weight * k[i]).sum());
            dense.set(i, start[i], [end[i] - start[i], a, b + c, -c]);
        }
    }
}
