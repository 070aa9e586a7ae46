//! Seeded random numbers that are equal bit for bit on every platform.

/// A small generator of pseudo-random numbers (`SplitMix64`): the same seed gives the same numbers everywhere.
///
/// Only integer operations, the four basic operations and the square root are used, all of which IEEE 754 fixes to
/// the last bit; the logarithm of a platform's mathematics library is not.
///
/// # Source
/// Steele, Lea and Flood, "Fast splittable pseudorandom number generators", 2014; normal numbers by Marsaglia's
/// polar method, 1964.
///
/// # Examples
/// ```
/// use descry::numerics::Random;
/// let (mut a, mut b) = (Random::new(7), Random::new(7));
/// assert_eq!(a.normal(), b.normal());
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Random {
    state: u64,
    /// The second number of the last normal pair.
    spare: Option<f64>,
}

impl Random {
    /// A generator that is fully determined by its seed.
    pub fn new(seed: u64) -> Self {
        Self { state: seed, spare: None }
    }

    /// 64 uniform bits.
    pub fn bits(&mut self) -> u64 {
        self.state = self.state.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.state;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^ (z >> 31)
    }

    /// Uniform in `[0, 1)`, a multiple of `2^-53`.
    pub fn uniform(&mut self) -> f64 {
        (self.bits() >> 11) as f64 * (0.5 * f64::EPSILON)
    }

    /// Normal with mean 0 and variance 1.
    pub fn normal(&mut self) -> f64 {
        if let Some(spare) = self.spare.take() {
            return spare;
        }
        loop {
            let (u, v) = (2.0 * self.uniform() - 1.0, 2.0 * self.uniform() - 1.0);
            let s = u * u + v * v;
            if s > 0.0 && s < 1.0 {
                let factor = (-2.0 * logarithm(s) / s).sqrt();
                self.spare = Some(v * factor);
                return u * factor;
            }
        }
    }
}

/// Natural logarithm of a positive normal number, by basic operations only.
///
/// ```text
/// x = m 2^k,  m in [1/sqrt 2, sqrt 2],   ln x = k ln 2 + 2 (z + z^3/3 + z^5/5 + ...),   z = (m - 1) / (m + 1)
/// ```
fn logarithm(x: f64) -> f64 {
    const MANTISSA: u64 = (1 << 52) - 1;
    const BIAS: i32 = 1023;
    let bits = x.to_bits();
    let mut mantissa = f64::from_bits((bits & MANTISSA) | (1023 << 52));
    let mut exponent = i32::try_from(bits >> 52).unwrap_or(BIAS) - BIAS;
    if mantissa > std::f64::consts::SQRT_2 {
        mantissa *= 0.5;
        exponent += 1;
    }
    let z = (mantissa - 1.0) / (mantissa + 1.0);
    // |z| <= 0.172: the first neglected term is below 1e-18
    const TERMS: i32 = 11;
    let series = (0..TERMS).rev().fold(0.0, |sum, k| sum * z * z + 1.0 / f64::from(2 * k + 1));
    f64::from(exponent) * std::f64::consts::LN_2 + 2.0 * z * series
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn first_numbers_of_a_seed_never_change() {
        let mut random = Random::new(0);
        let published = [0xE220_A839_7B1D_CDAF, 0x6E78_9E6A_A1B9_65F4, 0x06C4_5D18_8009_454F];
        assert_eq!([random.bits(), random.bits(), random.bits()], published, "SplitMix64 from seed 0");
    }

    #[test]
    fn logarithm_agrees_with_the_platform() {
        for x in [1e-300, 1e-9, 0.3, 0.7, 0.71, 0.999_999, 1.0, 1.5, 3e200] {
            let (own, platform) = (logarithm(x), f64::ln(x));
            assert!(
                (own - platform).abs() <= 4e-16 * platform.abs().max(0.1),
                "ln {x}: {own} and {platform}"
            );
        }
    }

    #[test]
    fn normal_numbers_have_the_moments_of_a_normal_law() {
        let mut random = Random::new(42);
        let n = 100_000;
        let sample: Vec<f64> = (0..n).map(|_| random.normal()).collect();
        let moment = |k: i32| sample.iter().map(|x| x.powi(k)).sum::<f64>() / f64::from(n);
        assert!(moment(1).abs() < 0.01, "mean {}", moment(1));
        assert!((moment(2) - 1.0).abs() < 0.02, "variance {}", moment(2));
        assert!((moment(4) - 3.0).abs() < 0.1, "fourth moment {}", moment(4));
    }

    #[test]
    fn uniform_numbers_fill_the_unit_interval() {
        let mut random = Random::new(3);
        let sample: Vec<f64> = (0..10_000).map(|_| random.uniform()).collect();
        assert!(sample.iter().all(|x| (0.0..1.0).contains(x)), "within [0, 1)");
        let mean = sample.iter().sum::<f64>() / 10_000.0;
        assert!((mean - 0.5).abs() < 0.01, "mean {mean}");
    }
}
