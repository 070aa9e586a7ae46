//! Exact arithmetic on binary floating-point numbers: every finite `f64` is an integer over a power of two.

#![expect(clippy::unwrap_used, reason = "a judge that meets a doubtful number must stop")]

use descry::numerics::Complex64;
use nalgebra::DMatrix;
use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{One as _, Signed as _, ToPrimitive as _, Zero as _};

/// Multiplicity of a pole in the wished list.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Root {
    Simple,
    Double,
}

/// Entries are taken as integers over `2^BITS`.
const BITS: usize = 220;

/// `|p / p'|` of `p(s) = det(s I - (A - L C))` at a wished pole (`sqrt |2 p / p''|` for a double one), without rounding.
pub(crate) fn pole_error(
    a: &DMatrix<f64>,
    gain: &DMatrix<f64>,
    c: &DMatrix<f64>,
    pole: Complex64,
    root: Root,
) -> f64 {
    let coefficients = characteristic_polynomial(&closed_loop(a, gain, c));
    let scale = 2 * BITS;
    let at = (integer(pole.re) << BITS, integer(pole.im) << BITS);
    let value = evaluate(&coefficients, &at);
    let first = derivative(&coefficients);
    match root {
        Root::Simple => ratio(&value, &evaluate(&first, &at), scale),
        Root::Double => (2.0 * ratio(&value, &evaluate(&derivative(&first), &at), 2 * scale)).sqrt(),
    }
}

type Gaussian = (BigInt, BigInt);

/// `x 2^BITS`.
fn integer(x: f64) -> BigInt {
    let bits = x.to_bits();
    let biased = i64::try_from((bits >> 52) & 0x7ff).unwrap();
    let fraction = bits & ((1 << 52) - 1);
    let mantissa = if biased == 0 { fraction } else { fraction | (1 << 52) };
    let shift = biased.max(1) - 1075 + i64::try_from(BITS).unwrap();
    let magnitude = BigInt::from(mantissa);
    let scaled = if shift >= 0 {
        magnitude << usize::try_from(shift).unwrap()
    } else {
        let down = usize::try_from(-shift).unwrap();
        assert!((&magnitude >> down) << down == magnitude, "{x:e} has digits below 2^-{BITS}");
        magnitude >> down
    };
    if x.is_sign_negative() { -scaled } else { scaled }
}

/// `(A - L C) 2^(2 BITS)`.
fn closed_loop(a: &DMatrix<f64>, gain: &DMatrix<f64>, c: &DMatrix<f64>) -> Vec<Vec<BigInt>> {
    let n = a.nrows();
    let entry = |i: usize, j: usize| {
        let correction: BigInt = (0..c.nrows()).map(|k| integer(gain[(i, k)]) * integer(c[(k, j)])).sum();
        (integer(a[(i, j)]) << BITS) - correction
    };
    (0..n).map(|i| (0..n).map(|j| entry(i, j)).collect()).collect()
}

/// Coefficients of `det(s I - M)`, leading one first, by the Faddeev-Leverrier recursion: all divisions are exact.
fn characteristic_polynomial(m: &[Vec<BigInt>]) -> Vec<BigInt> {
    let n = m.len();
    let mut coefficients = vec![BigInt::one()];
    let mut product = vec![vec![BigInt::zero(); n]; n];
    for k in 1..=n {
        // N_k = M N_(k-1) + c_(k-1) I,  c_k = -tr(M N_k) / k
        for (i, row) in product.iter_mut().enumerate() {
            row[i] += &coefficients[k - 1];
        }
        let next: Vec<Vec<BigInt>> = m
            .iter()
            .map(|row| {
                (0..n).map(|j| row.iter().zip(&product).map(|(x, other)| x * &other[j]).sum()).collect()
            })
            .collect();
        let trace: BigInt = (0..n).map(|i| &next[i][i]).sum();
        coefficients.push(-trace / BigInt::from(k));
        product = next;
    }
    coefficients
}

fn derivative(coefficients: &[BigInt]) -> Vec<BigInt> {
    let degree = coefficients.len() - 1;
    coefficients[..degree].iter().enumerate().map(|(i, c)| c * BigInt::from(degree - i)).collect()
}

fn evaluate(coefficients: &[BigInt], at: &Gaussian) -> Gaussian {
    coefficients.iter().fold((BigInt::zero(), BigInt::zero()), |(re, im), c| {
        (&re * &at.0 - &im * &at.1 + c, &re * &at.1 + &im * &at.0)
    })
}

/// `|numerator| / |denominator| / 2^scale`.
fn ratio(numerator: &Gaussian, denominator: &Gaussian, scale: usize) -> f64 {
    let square = |z: &Gaussian| &z.0 * &z.0 + &z.1 * &z.1;
    let divisor = square(denominator) << (2 * scale);
    assert!(divisor.is_positive(), "the derivative vanishes at the pole");
    BigRational::new(square(numerator), divisor).to_f64().unwrap().sqrt()
}
