//! Matrix exponential, and exact steps of linear equations with constant coefficients.

use nalgebra::{DMatrix, DVector};

use crate::numerics::NumericsError;

/// `exp(A)` by balancing, scaling, the diagonal Pade approximant of order 13 and squaring.
///
/// ```text
/// A = D A_b D^-1 (D powers of two),   exp(A) = D (r13(A_b / 2^s))^(2^s) D^-1,   norm_1(A_b / 2^s) <= 5.37
/// ```
///
/// Balancing comes first because fast observers have gains of the order of the product of their poles: scaling by
/// the raw norm would square away the slow part.
///
/// # Errors
/// [`NumericsError::NotFinite`] for entries that are not finite, and when the result overflows.
///
/// # Source
/// N. J. Higham, The scaling and squaring method for the matrix exponential revisited, 2005, table 2.3.
pub fn exponential(matrix: &DMatrix<f64>) -> Result<DMatrix<f64>, NumericsError> {
    /// Largest norm for which the approximant of order 13 is accurate to rounding.
    const THETA: f64 = 5.371_920_351_148_152;
    let n = matrix.nrows();
    let not_finite = NumericsError::NotFinite { rows: n, columns: matrix.ncols() };
    if !matrix.is_square() {
        return Err(NumericsError::Shape {
            what: "matrix exponential",
            found: format!("{} x {}", n, matrix.ncols()),
            needed: "a square matrix".to_owned(),
        });
    }
    if matrix.iter().any(|x| !x.is_finite()) {
        return Err(not_finite);
    }
    let (mut balanced, scale) = balance(matrix);
    let norm = balanced.column_iter().map(|c| c.iter().map(|x| x.abs()).sum::<f64>()).fold(0.0, f64::max);
    let mut squarings = 0;
    if norm > THETA {
        let exponent = (norm / THETA).log2().ceil();
        balanced /= exponent.exp2();
        while f64::from(squarings) < exponent {
            squarings += 1;
        }
    }
    let mut result = pade_13(&balanced).ok_or_else(|| not_finite.clone())?;
    for _ in 0..squarings {
        result = &result * &result;
    }
    let result = DMatrix::from_fn(n, n, |i, j| result[(i, j)] * scale[i] / scale[j]);
    if result.iter().all(|x| x.is_finite()) { Ok(result) } else { Err(not_finite) }
}

/// The diagonal approximant `(V - U)^-1 (V + U)` of order 13.
fn pade_13(a: &DMatrix<f64>) -> Option<DMatrix<f64>> {
    const B: [f64; 14] = [
        64_764_752_532_480_000.0,
        32_382_376_266_240_000.0,
        7_771_770_303_897_600.0,
        1_187_353_796_428_800.0,
        129_060_195_264_000.0,
        10_559_470_521_600.0,
        670_442_572_800.0,
        33_522_128_640.0,
        1_323_241_920.0,
        40_840_800.0,
        960_960.0,
        16_380.0,
        182.0,
        1.0,
    ];
    let identity = DMatrix::identity(a.nrows(), a.nrows());
    let a2 = a * a;
    let a4 = &a2 * &a2;
    let a6 = &a4 * &a2;
    let upper = &a6 * (&a6 * B[13] + &a4 * B[11] + &a2 * B[9]);
    let u = a * (upper + &a6 * B[7] + &a4 * B[5] + &a2 * B[3] + &identity * B[1]);
    let upper = &a6 * (&a6 * B[12] + &a4 * B[10] + &a2 * B[8]);
    let v = upper + &a6 * B[6] + &a4 * B[4] + &a2 * B[2] + &identity * B[0];
    (&v - &u).lu().solve(&(v + u))
}

/// Equalises row and column norms by a diagonal similarity of powers of two: `A_b = D^-1 A D`.
fn balance(matrix: &DMatrix<f64>) -> (DMatrix<f64>, Vec<f64>) {
    const SWEEPS: usize = 30;
    /// A block that feeds another without return can be scaled down for ever; there is nothing to gain beyond this.
    const LARGEST: f64 = 1e60;
    let n = matrix.nrows();
    let (mut a, mut scale) = (matrix.clone(), vec![1.0; n]);
    for _ in 0..SWEEPS {
        let mut changed = false;
        for (i, own) in scale.iter_mut().enumerate() {
            // the diagonal counts in both: a state that feeds nothing back is scaled down to its own rate, not further
            let column: f64 = a.column(i).iter().map(|x| x.abs()).sum();
            let row: f64 = a.row(i).iter().map(|x| x.abs()).sum();
            if column == 0.0 || row == 0.0 {
                continue;
            }
            let factor = (row / column).sqrt().log2().round().exp2();
            let smaller = column * factor + row / factor < 0.95 * (column + row);
            let scaled = *own * factor;
            if smaller && (LARGEST.recip()..LARGEST).contains(&scaled) {
                *own = scaled;
                a.column_mut(i).scale_mut(factor);
                a.row_mut(i).scale_mut(factor.recip());
                changed = true;
            }
        }
        if !changed {
            break;
        }
    }
    (a, scale)
}

/// Points of a step at which its inputs are needed (Gauss-Lobatto), as fractions of the step.
///
/// Both ends belong to them, so that states which follow their input at once are exact at the ends.
pub const NODES: [f64; 4] = [0.0, 0.276_393_202_250_021_06, 0.723_606_797_749_979, 1.0];

/// One step of `w' = M w + G s(t)` over a fixed time, exact for inputs that are cubic in time.
///
/// ```text
/// w(t + h) = exp(M h) w(t) + sum_i W_i s(t + NODES_i h)
/// ```
#[derive(Clone, Debug)]
pub struct Propagator {
    transition: DMatrix<f64>,
    weights: [DMatrix<f64>; 4],
}

impl Propagator {
    /// Prepares steps of length `h`.
    ///
    /// With `theta = (t' - t) / h` and the derivatives `p_0 = s, p_1 = ds / dtheta, ...` of the interpolating cubic as
    /// further states, one exponential holds everything:
    ///
    /// ```text
    ///       [h M  h G  0  0  0]
    /// exp ( [ 0    0   I  0  0] ) = [exp(h M)  Gamma_0  Gamma_1  Gamma_2  Gamma_3; ...]
    ///       [ 0    0   0  I  0]
    ///       [ 0    0   0  0  I]
    ///       [ 0    0   0  0  0]
    /// ```
    ///
    /// # Errors
    /// As [`exponential`].
    pub fn new(m: &DMatrix<f64>, g: &DMatrix<f64>, h: f64) -> Result<Self, NumericsError> {
        let (order, signals) = g.shape();
        let size = order + 4 * signals;
        let mut augmented = DMatrix::zeros(size, size);
        augmented.view_mut((0, 0), (order, order)).copy_from(&(m * h));
        augmented.view_mut((0, order), (order, signals)).copy_from(&(g * h));
        for i in 0..3 {
            let (top, left) = (order + i * signals, order + (i + 1) * signals);
            augmented.view_mut((top, left), (signals, signals)).fill_with_identity();
        }
        let full = exponential(&augmented)?;
        let gamma = |i: usize| full.view((0, order + i * signals), (order, signals));
        let weights = [0, 1, 2, 3].map(|node| {
            let c = lagrange(node);
            // p_i(0) = i! c_i
            gamma(0) * c[0] + gamma(1) * c[1] + gamma(2) * (2.0 * c[2]) + gamma(3) * (6.0 * c[3])
        });
        Ok(Self { transition: full.view((0, 0), (order, order)).into_owned(), weights })
    }

    /// The state one step later; `inputs` are the values at the four [`NODES`].
    pub fn step(&self, state: &DVector<f64>, inputs: &[DVector<f64>; 4]) -> DVector<f64> {
        let mut next = &self.transition * state;
        for (weight, value) in self.weights.iter().zip(inputs) {
            next.gemv(1.0, weight, value, 1.0);
        }
        next
    }
}

/// Coefficients, lowest power first, of the cubic that is one at the given node and zero at the three others.
fn lagrange(node: usize) -> [f64; 4] {
    let mut coefficients = [1.0, 0.0, 0.0, 0.0];
    for (_, c) in NODES.iter().enumerate().filter(|(other, _)| *other != node) {
        let distance = NODES[node] - c;
        for power in (0..4).rev() {
            let lower = if power == 0 { 0.0 } else { coefficients[power - 1] };
            coefficients[power] = (lower - c * coefficients[power]) / distance;
        }
    }
    coefficients
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{dmatrix, dvector};

    #[test]
    fn a_rotation_is_exact() {
        let found = exponential(&dmatrix![0.0, -30.0; 30.0, 0.0]).unwrap();
        let expected = dmatrix![30_f64.cos(), -30_f64.sin(); 30_f64.sin(), 30_f64.cos()];
        assert!((&found - &expected).amax() < 1e-13, "{found} against {expected}");
    }

    #[test]
    fn slow_and_fast_parts_survive_together() {
        // eigenvalues -1 and -1e5 with an off-diagonal entry of 1e10
        let found = exponential(&dmatrix![-1e5, 1e10; 0.0, -1.0]).unwrap();
        let exact = 1e10 * ((-1_f64).exp() - (-1e5_f64).exp()) / (1e5 - 1.0);
        assert!((found[(0, 1)] / exact - 1.0).abs() < 1e-11, "{} against {exact}", found[(0, 1)]);
        assert!((found[(1, 1)] - (-1_f64).exp()).abs() < 1e-12, "slow part {}", found[(1, 1)]);
    }

    #[test]
    fn overflow_and_nan_are_errors() {
        assert!(exponential(&dmatrix![1e4]).is_err(), "exp(10000) is beyond double precision");
        assert!(exponential(&dmatrix![f64::NAN]).is_err(), "not a number");
        assert_eq!(exponential(&DMatrix::zeros(0, 0)).unwrap().shape(), (0, 0), "nothing stays nothing");
    }

    #[test]
    fn cubic_inputs_are_exact_also_for_stiff_states() {
        // w' = -k w + k s, s = t^3: w = t^3 - 3 t^2 / k + 6 t / k^2 - 6 / k^3 (1 - exp(-k t))
        for k in [1.0, 3300.0, 1e5] {
            let h = 0.5;
            let step = Propagator::new(&dmatrix![-k], &dmatrix![k], h).unwrap();
            let inputs = NODES.map(|c| dvector![(c * h).powi(3)]);
            let found = step.step(&dvector![0.0], &inputs)[0];
            let exact = h.powi(3) - 3.0 * h * h / k + 6.0 * h / (k * k) + 6.0 / k.powi(3) * (-k * h).exp_m1();
            assert!((found - exact).abs() < 1e-13, "k = {k}: {found} against {exact}");
        }
    }
}
