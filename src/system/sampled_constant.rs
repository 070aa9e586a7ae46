//! Whether a Lipschitz constant holds, looked for by samples: a counterexample is a proof, its absence is none.
#![expect(non_snake_case, reason = "matrix letters follow paper 002")]

use nalgebra::{DMatrix, DVector};

use super::LipschitzTerm;
use crate::numerics::{NumericsError, Random, Tolerance, null_space, pseudo_inverse, svd};

/// Relative rounding that a ratio may show beyond the given constant.
const ROUNDING: f64 = 1e-9;
/// A slope in a direction that `F_L` does not see counts beyond this part of all slopes.
const UNSEEN: f64 = 1e-9;
/// A constant is needlessly large when the largest ratio stays below this part of it.
const LOOSE: f64 = 0.8;
/// Halvings of the step with which the largest slope is approached.
const HALVINGS: usize = 40;

/// Where the nonlinearity is looked at.
#[derive(Clone, Debug, PartialEq)]
pub enum SampleRegion {
    /// All states between two bounds, at instants between two others.
    Box {
        /// Lower bounds, n.
        lower: DVector<f64>,
        /// Upper bounds, n.
        upper: DVector<f64>,
        /// First and last instant.
        time: (f64, f64),
    },
    /// Given instants and states, those of a trajectory, say.
    Points(Vec<(f64, DVector<f64>)>),
}

/// Where the largest ratio was found.
#[derive(Clone, Debug, PartialEq)]
pub struct LargestRatio {
    /// Instant.
    pub t: f64,
    /// State.
    pub x: DVector<f64>,
    /// The other state of a pair; none for a slope, the limit of near pairs.
    pub other: Option<DVector<f64>>,
    /// Direction from the state in which the ratio occurs.
    pub direction: DVector<f64>,
}

/// The largest ratio `|f(t, x1) - f(t, x2)| / |F_L (x1 - x2)|` that was found.
#[derive(Clone, Debug, PartialEq)]
pub struct SampledConstant {
    /// The constant that was given.
    pub given: f64,
    /// Largest ratio: a lower bound of every valid constant; infinite when `f` depends on what `F_L` does not see.
    pub largest: f64,
    /// Where it was found; none when `f` is constant, or was looked at nowhere.
    pub at: Option<LargestRatio>,
    /// Whether the given constant is too small.
    pub exceeded: bool,
    /// Whether a clearly smaller constant passes all samples. Other places may need the given one.
    pub needlessly_large: bool,
    /// First instant and state at which `f` has no finite value or slope.
    pub undefined: Option<(f64, DVector<f64>)>,
    /// Number of pairs.
    pub pairs: usize,
    /// Number of Jacobians.
    pub slopes: usize,
}

impl SampledConstant {
    /// The finding in words.
    pub fn statement(&self) -> String {
        let list = |x: &DVector<f64>| x.iter().map(|x| format!("{x:.4}")).collect::<Vec<_>>().join(", ");
        let looked = format!("{} pairs and {} slopes", self.pairs, self.slopes);
        if let Some((t, x)) = &self.undefined {
            return format!("f has no finite value or slope at t = {t:.4}, x = ({})", list(x));
        }
        let place = self.at.as_ref().map_or(String::new(), |at| match &at.other {
            Some(other) => format!(" between x = ({}) and ({}) at t = {:.4}", list(&at.x), list(other), at.t),
            None => format!(" at x = ({}), t = {:.4}", list(&at.x), at.t),
        });
        let direction = self.at.as_ref().map_or(String::new(), |at| list(&at.direction));
        let (given, largest) = (self.given, self.largest);
        if largest.is_infinite() {
            format!(
                "f changes in the direction ({direction}), which F_L does not see{place}: no constant suffices"
            )
        } else if self.exceeded {
            format!("the Lipschitz constant {given} is exceeded: the ratio is {largest:.6}{place}")
        } else if self.needlessly_large {
            format!(
                "the Lipschitz constant {given} may be needlessly large: the largest of {looked} is {largest:.6}"
            )
        } else {
            format!("{looked} keep to the Lipschitz constant {given}; the largest is {largest:.6}")
        }
    }

    /// Takes a ratio into account.
    fn meet(&mut self, ratio: f64, at: impl FnOnce() -> LargestRatio) {
        if ratio > self.largest {
            self.largest = ratio;
            self.at = Some(at());
        }
    }
}

/// What the slopes at a point are measured with.
struct Gauge<'a> {
    term: &'a LipschitzTerm,
    /// `F_L^+`, n x l.
    inverse: DMatrix<f64>,
    /// Directions that `F_L` does not see, n x (n - rank).
    unseen: DMatrix<f64>,
}

/// The largest `|df/dx v| / |F_L v|` at a point, with its direction.
enum Slope {
    Undefined,
    Found(f64, DVector<f64>),
}

impl Gauge<'_> {
    /// With `K = df/dx`: infinite when `K N /= 0` for a basis `N` of the null space of `F_L`, else the largest
    /// singular value of `K F_L^+`.
    fn slope(&self, t: f64, x: &DVector<f64>) -> Result<Slope, NumericsError> {
        let K = self.term.jacobian(t, x);
        if K.iter().any(|x| !x.is_finite()) {
            return Ok(Slope::Undefined);
        }
        let through = &K * &self.unseen;
        let largest = through.column_iter().enumerate().max_by(|a, b| a.1.norm().total_cmp(&b.1.norm()));
        if let Some((column, slope)) = largest
            && slope.norm() > UNSEEN * K.norm()
        {
            return Ok(Slope::Found(f64::INFINITY, self.unseen.column(column).into_owned()));
        }
        let found = svd(&(K * &self.inverse))?;
        let ratio = found.s.first().copied().unwrap_or(0.0);
        let seen = if found.v.ncols() > 0 { found.v.column(0).into_owned() } else { DVector::zeros(0) };
        Ok(Slope::Found(ratio, &self.inverse * seen))
    }

    /// The ratio of a pair; none when `F_L` sees no difference and there is none.
    fn pair(&self, t: f64, x: &DVector<f64>, other: &DVector<f64>) -> Option<f64> {
        let change = (self.term.value(t, x) - self.term.value(t, other)).norm();
        let seen = (&self.term.F_L * (x - other)).norm();
        // near pairs are dominated by rounding; slopes take their place
        let far = seen > 1e-6 * (x.norm() + other.norm());
        (far && change.is_finite()).then(|| change / seen)
    }
}

impl LipschitzTerm {
    /// Looks for the largest ratio `|f(t, x1) - f(t, x2)| / |F_L (x1 - x2)|` among samples.
    ///
    /// At each sample the largest directional derivative relative to what `F_L` sees is computed exactly, and each is
    /// paired with another at the same instant. Within a box the steepest place is then approached step by step.
    ///
    /// # Shapes
    /// States of the region: n. The term fits its system ([`Self::checked`]).
    ///
    /// # Tolerance
    /// The rank of `F_L`.
    ///
    /// # Errors
    /// [`NumericsError`] when a decomposition fails.
    pub fn sampled_constant(
        &self,
        region: &SampleRegion,
        samples: usize,
        seed: u64,
        tolerance: &Tolerance,
    ) -> Result<SampledConstant, NumericsError> {
        let gauge = Gauge {
            term: self,
            inverse: pseudo_inverse(&self.F_L, tolerance)?,
            unseen: null_space(&self.F_L, 0.0, tolerance)?,
        };
        let mut random = Random::new(seed);
        let points = points(region, samples, &mut random);
        let mut found = SampledConstant {
            given: self.constant,
            largest: 0.0,
            at: None,
            exceeded: false,
            needlessly_large: false,
            undefined: None,
            pairs: 0,
            slopes: 0,
        };
        let mut steepest = None;
        for (k, (t, x)) in points.iter().enumerate() {
            found.slopes += 1;
            match gauge.slope(*t, x)? {
                Slope::Undefined => {
                    found.undefined.get_or_insert_with(|| (*t, x.clone()));
                }
                Slope::Found(ratio, direction) => {
                    if ratio > steepest.map_or(0.0, |(_, best)| best) {
                        steepest = Some((k, ratio));
                    }
                    found.meet(ratio, || LargestRatio { t: *t, x: x.clone(), other: None, direction });
                }
            }
            let other = &points[usize::try_from(random.bits() % points.len() as u64).unwrap_or(k)].1;
            if let Some(ratio) = gauge.pair(*t, x, other) {
                found.pairs += 1;
                let direction = other - x;
                let pair = || LargestRatio { t: *t, x: x.clone(), other: Some(other.clone()), direction };
                found.meet(ratio, pair);
            }
        }
        if let (SampleRegion::Box { lower, upper, .. }, Some((k, _))) = (region, steepest) {
            climb(&gauge, (lower, upper), &points[k], &mut found)?;
        }
        found.exceeded = found.largest > self.constant * (1.0 + ROUNDING);
        found.needlessly_large = found.slopes > 0 && found.largest < LOOSE * self.constant;
        Ok(found)
    }
}

/// The places to look at: random ones and the middle of a box, or an even choice of the given ones.
fn points(region: &SampleRegion, samples: usize, random: &mut Random) -> Vec<(f64, DVector<f64>)> {
    match region {
        SampleRegion::Points(all) => {
            let stride = all.len().div_ceil(samples.max(1)).max(1);
            all.iter().step_by(stride).cloned().collect()
        }
        SampleRegion::Box { lower, upper, time } => {
            let mut draw = |from: f64, to: f64| from + (to - from) * random.uniform();
            let mut all = vec![(0.5 * (time.0 + time.1), (lower + upper) * 0.5)];
            all.extend((1..samples).map(|_| (draw(time.0, time.1), lower.zip_map(upper, &mut draw))));
            all
        }
    }
}

/// Approaches the steepest place of a box from a steep one, coordinate by coordinate with ever smaller steps.
fn climb(
    gauge: &Gauge<'_>,
    (lower, upper): (&DVector<f64>, &DVector<f64>),
    (t, start): &(f64, DVector<f64>),
    found: &mut SampledConstant,
) -> Result<(), NumericsError> {
    let (mut x, mut part, mut best) = (start.clone(), 0.25, found.largest);
    if let Slope::Found(ratio, _) = gauge.slope(*t, start)? {
        best = ratio;
    }
    let mut halvings = 0;
    while halvings < HALVINGS && best.is_finite() {
        let mut improved = false;
        for i in 0..x.len() {
            for sign in [-1.0, 1.0] {
                let mut trial = x.clone();
                trial[i] = (x[i] + sign * part * (upper[i] - lower[i])).max(lower[i]).min(upper[i]);
                found.slopes += 1;
                if let Slope::Found(ratio, direction) = gauge.slope(*t, &trial)?
                    && ratio > best
                {
                    (best, improved) = (ratio, true);
                    x.clone_from(&trial);
                    found.meet(ratio, || LargestRatio { t: *t, x: trial, other: None, direction });
                }
            }
        }
        if !improved {
            part *= 0.5;
            halvings += 1;
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::super::nonlinearity;
    use super::*;
    use nalgebra::{dmatrix, dvector};

    fn term(f: &str, F_L: DMatrix<f64>, constant: f64) -> LipschitzTerm {
        let n = F_L.ncols();
        LipschitzTerm {
            G: DMatrix::from_element(n, 1, 1.0),
            F_L,
            f: vec![nonlinearity(f, n).unwrap()],
            constant,
        }
    }

    fn in_box(term: &LipschitzTerm, size: f64) -> SampledConstant {
        let n = term.F_L.ncols();
        let (lower, upper) = (DVector::from_element(n, -size), DVector::from_element(n, size));
        let region = SampleRegion::Box { lower, upper, time: (0.0, 1.0) };
        term.sampled_constant(&region, 200, 1, &Tolerance::default()).unwrap()
    }

    #[test]
    fn the_sine_has_the_constant_one() {
        let found = in_box(&term("sin(x2)", dmatrix![0.0, 1.0], 1.0), 3.0);
        assert!(!found.exceeded && !found.needlessly_large, "{}", found.statement());
        assert!((found.largest - 1.0).abs() < 1e-9, "the slope at zero is found: {}", found.largest);
    }

    #[test]
    fn a_constant_that_is_too_small_is_refuted_with_the_place() {
        // slope 2 x1 on a box to 3: the steepest place is its edge
        let found = in_box(&term("x1^2", dmatrix![1.0], 4.0), 3.0);
        assert!(found.exceeded && (found.largest - 6.0).abs() < 1e-9, "{}", found.statement());
        let at = found.at.clone().unwrap();
        assert!((at.x[0].abs() - 3.0).abs() < 1e-9 && at.other.is_none(), "{at:?}");
        assert!(found.statement().contains("4 is exceeded"), "{}", found.statement());
        let again = in_box(&term("x1^2", dmatrix![1.0], 4.0), 3.0);
        assert_eq!(found, again, "the same seed finds the same");
    }

    #[test]
    fn a_direction_that_f_l_does_not_see_is_reported() {
        let found = in_box(&term("sin(x2) + 0.01*x1", dmatrix![0.0, 1.0], 5.0), 3.0);
        assert!(found.exceeded && found.largest.is_infinite(), "{}", found.statement());
        let direction = found.at.clone().unwrap().direction;
        assert!((direction[0].abs() - 1.0).abs() < 1e-12 && direction[1].abs() < 1e-12, "{direction}");
        assert!(found.statement().contains("which F_L does not see"), "{}", found.statement());
    }

    #[test]
    fn a_needlessly_large_constant_and_an_undefined_value_are_told() {
        let found = in_box(&term("sin(x2)", dmatrix![0.0, 1.0], 3.0), 3.0);
        assert!(found.needlessly_large && !found.exceeded, "{}", found.statement());
        let found = in_box(&term("sqrt(x1)", dmatrix![1.0], 3.0), 1.0);
        assert!(found.undefined.is_some(), "{}", found.statement());
        assert!(found.statement().contains("no finite value"), "{}", found.statement());
    }

    #[test]
    fn points_of_a_trajectory_are_looked_at_instead_of_a_box() {
        let along = (0..50).map(|k| (f64::from(k), dvector![0.1 * f64::from(k)])).collect();
        let term = term("t * x1", dmatrix![1.0], 40.0);
        let found =
            term.sampled_constant(&SampleRegion::Points(along), 50, 3, &Tolerance::default()).unwrap();
        assert!(found.exceeded && (found.largest - 49.0).abs() < 1e-9, "slope t: {}", found.statement());
        assert_eq!(found.at.unwrap().t, 49.0, "at the last instant");
        let none = term.sampled_constant(&SampleRegion::Points(Vec::new()), 50, 3, &Tolerance::default());
        assert!(!none.unwrap().exceeded, "nothing was looked at");
    }
}
