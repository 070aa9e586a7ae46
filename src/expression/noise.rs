//! Seeded noise: the same numbers on every platform.
//!
//! ```text
//! noise(x, s) = (1 - r) z(k, s) + r z(k + 1, s),   k = floor(x), r = x - k
//! ```
//!
//! with independent standard normal `z(k, s)`: unit variance at the whole numbers, linear between them. Band limited
//! noise of sample time h is `noise(t/h, seed)`. The logarithm and the cosine of the Box-Muller transform are made here
//! of additions, products and quotients, which IEEE 754 fixes to the last bit; those of the standard library differ from
//! one platform to the next.

/// The noise and its slope at `x`.
pub(super) fn noise(x: f64, seed: f64) -> (f64, f64) {
    if !x.is_finite() || seed.is_nan() {
        return (f64::NAN, f64::NAN);
    }
    let whole = x.floor();
    let (before, after) = (normal(whole, seed), normal(whole + 1.0, seed));
    let slope = after - before;
    (before + (x - whole) * slope, slope)
}

/// A standard normal sample for a whole number and a seed (Box and Muller).
fn normal(whole: f64, seed: f64) -> f64 {
    // `+ 0.0` makes one zero of both.
    let first = splitmix64(splitmix64((seed + 0.0).to_bits()) ^ (whole + 0.0).to_bits());
    let radius = (-2.0 * ln(1.0 - unit(first))).sqrt();
    radius * cos_turns(unit(splitmix64(first)))
}

/// One step of the generator splitmix64 (Steele, Lea, Flood, 2014).
fn splitmix64(state: u64) -> u64 {
    let mut z = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

/// The upper 53 bits as a number in `[0, 1)`.
fn unit(bits: u64) -> f64 {
    (bits >> 11) as f64 * (1.0 / (1_u64 << 53) as f64)
}

/// `1 / 1, 1 / 3, ..., 1 / 23`.
const ODD: [f64; 12] = [
    1.0,
    1.0 / 3.0,
    1.0 / 5.0,
    1.0 / 7.0,
    1.0 / 9.0,
    1.0 / 11.0,
    1.0 / 13.0,
    1.0 / 15.0,
    1.0 / 17.0,
    1.0 / 19.0,
    1.0 / 21.0,
    1.0 / 23.0,
];

/// `ln x` for normal positive `x`: `k ln 2 + 2 atanh((m - 1) / (m + 1))`, `x = 2^k m`, `m` within a factor `sqrt 2` of 1.
fn ln(x: f64) -> f64 {
    let bits = x.to_bits();
    let mut exponent = (bits >> 52) as f64 - 1023.0;
    let mut mantissa = f64::from_bits((bits & 0x000f_ffff_ffff_ffff) | 0x3ff0_0000_0000_0000);
    if mantissa > std::f64::consts::SQRT_2 {
        mantissa *= 0.5;
        exponent += 1.0;
    }
    let s = (mantissa - 1.0) / (mantissa + 1.0);
    let series = ODD.iter().rev().fold(0.0, |sum, part| sum * (s * s) + part);
    exponent * std::f64::consts::LN_2 + 2.0 * s * series
}

/// `cos(2 pi turns)` for `turns` in `[0, 1)`, by symmetry from the first eighth of a turn.
fn cos_turns(turns: f64) -> f64 {
    let half = if turns > 0.5 { 1.0 - turns } else { turns };
    let (quarter, sign) = if half > 0.25 { (0.5 - half, -1.0) } else { (half, 1.0) };
    let tau = std::f64::consts::TAU;
    sign * if quarter > 0.125 { sin_series(tau * (0.25 - quarter)) } else { cos_series(tau * quarter) }
}

/// `sin x` for `|x| <= pi/4`.
fn sin_series(x: f64) -> f64 {
    x * alternating(x * x, 1)
}

/// `cos x` for `|x| <= pi/4`.
fn cos_series(x: f64) -> f64 {
    alternating(x * x, 0)
}

/// `1 - q / ((o+1)(o+2)) (1 - q / ((o+3)(o+4)) (1 - ...))`.
fn alternating(square: f64, offset: u8) -> f64 {
    (0..9_u8).rev().fold(1.0, |sum, k| {
        let next = f64::from(offset + 2 * k + 1);
        1.0 - square / (next * (next + 1.0)) * sum
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn own_logarithm_and_cosine_agree_with_the_standard_library() {
        for k in 1..4000 {
            let x = f64::from(k) / 4000.0;
            assert!(
                (ln(x) - x.ln()).abs() <= 4e-16 * (1.0 + x.ln().abs()),
                "ln {x}: {} and {}",
                ln(x),
                x.ln()
            );
            let (ours, theirs) = (cos_turns(x), (std::f64::consts::TAU * x).cos());
            assert!((ours - theirs).abs() < 1e-15, "cos of {x} turns: {ours} and {theirs}");
        }
        assert!(
            (ln(2.0_f64.powi(-53)) + 53.0 * std::f64::consts::LN_2).abs() < 1e-14,
            "the smallest argument"
        );
    }

    #[test]
    fn samples_are_standard_normal_and_uncorrelated() {
        let samples: Vec<f64> = (0..40_000).map(|k| noise(f64::from(k), 7.0).0).collect();
        let n = samples.len() as f64;
        let moment = |p: i32| samples.iter().map(|z| z.powi(p)).sum::<f64>() / n;
        assert!(moment(1).abs() < 0.02, "mean {}", moment(1));
        assert!((moment(2) - 1.0).abs() < 0.03, "variance {}", moment(2));
        assert!((moment(4) - 3.0).abs() < 0.2, "fourth moment {}", moment(4));
        let lag = samples.windows(2).map(|w| w[0] * w[1]).sum::<f64>() / n;
        assert!(lag.abs() < 0.02, "neighbours correlate by {lag}");
        let other = (0..40_000).map(|k| noise(f64::from(k), 8.0).0);
        let cross = samples.iter().zip(other).map(|(a, b)| a * b).sum::<f64>() / n;
        assert!(cross.abs() < 0.02, "seeds correlate by {cross}");
    }
}
