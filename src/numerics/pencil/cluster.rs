//! From computed zeros to points: clusters of nearly equal ones, their centre, rank evidence there.

use nalgebra::{DMatrix, DVector};
use num_complex::Complex64;

use super::{RankDropPoint, normalised};
use crate::numerics::{NumericsError, complex_svd, svd};

/// Relative distance within which zeros may be one multiple zero: a triple one splits by about `eps^(1/3)`.
pub(super) const CLUSTER_WIDTH: f64 = 1e-4;
/// Below this relative distance zeros that are not one point are listed separately.
const SMALLEST_WIDTH: f64 = 1e-12;

/// The pencil with both matrices of norm one, in `s_unit = s / scale`.
pub(super) struct UnitPencil {
    a: DMatrix<f64>,
    e: DMatrix<f64>,
    /// `norm A / norm E`.
    scale: f64,
}

/// Smallest singular value of `A - s E`, relative, with its right and left vectors.
struct Smallest {
    sigma: f64,
    right: DVector<Complex64>,
    left: DVector<Complex64>,
}

impl UnitPencil {
    pub(super) fn new(a: &DMatrix<f64>, e: &DMatrix<f64>) -> Self {
        let ((a, norm_a), (e, norm_e)) = (normalised(a), normalised(e));
        Self { a, e, scale: norm_a / norm_e }
    }

    /// Smallest singular value and vectors of `A - s E`, n the number of columns, which is at most that of rows.
    fn smallest(&self, s: Complex64) -> Result<Smallest, NumericsError> {
        let s = s / self.scale;
        let last = self.a.ncols() - 1;
        let size = self.a.norm() + s.norm() * self.e.norm();
        let (sigma, left, right) = if s.im == 0.0 {
            let found = svd(&(&self.a - &self.e * s.re))?;
            let complex = |m: &DMatrix<f64>| m.column(last).map(Complex64::from);
            (found.s[last], complex(&found.u), complex(&found.v))
        } else {
            let matrix = self.a.zip_map(&self.e, |a, e| Complex64::from(a) - s * e);
            let found = complex_svd(&matrix)?;
            (found.s[last], found.u.column(last).into_owned(), found.v.column(last).into_owned())
        };
        Ok(Smallest { sigma: if size > 0.0 { sigma / size } else { 0.0 }, right, left })
    }

    /// Groups zeros into points; what is not one point at this width is tried again at a tenth of it.
    pub(super) fn clusters(
        &self,
        zeros: &[Complex64],
        width: f64,
        limit: f64,
    ) -> Result<Vec<Vec<Complex64>>, NumericsError> {
        let near =
            |a: Complex64, b: Complex64| (a - b).norm() <= width * a.norm().max(b.norm()).max(self.scale);
        let mut result = Vec::new();
        for group in linked(zeros, near) {
            if group.len() == 1 || self.is_one_point(&group, limit)? {
                result.push(group);
            } else if width > SMALLEST_WIDTH {
                result.extend(self.clusters(&group, width / 10.0, limit)?);
            } else {
                result.extend(group.into_iter().map(|zero| vec![zero]));
            }
        }
        Ok(result)
    }

    /// Whether the rank drops numerically in the whole disk that the zeros span, not only at each of them.
    fn is_one_point(&self, zeros: &[Complex64], limit: f64) -> Result<bool, NumericsError> {
        let centre = mean(zeros);
        let radius = zeros.iter().map(|z| (z - centre).norm()).fold(0.0, f64::max);
        let half = Complex64::new(0.5, 0.5) * (radius * std::f64::consts::FRAC_1_SQRT_2);
        for offset in [Complex64::ZERO, half, half.conj(), -half, -half.conj()] {
            if self.smallest(centre + offset)?.sigma > limit {
                return Ok(false);
            }
        }
        Ok(true)
    }

    /// The point that stands for a cluster: its mean, refined while that lowers the singular value.
    pub(super) fn point(&self, members: Vec<Complex64>) -> Result<RankDropPoint, NumericsError> {
        let mut s = mean(&members);
        let mut found = self.smallest(s)?;
        let rounding = 10.0 * self.a.nrows() as f64 * f64::EPSILON;
        const ITERATIONS: usize = 4;
        for _ in 0..ITERATIONS {
            if found.sigma <= rounding {
                break;
            }
            let Some(next) = self.newton(s, &found) else { break };
            let refined = self.smallest(next)?;
            if refined.sigma >= 0.5 * found.sigma {
                break;
            }
            (s, found) = (next, refined);
        }
        let largest = found.right[found.right.icamax()];
        Ok(RankDropPoint {
            s,
            multiplicity: members.len(),
            members,
            sigma: found.sigma,
            direction: found.right / largest,
        })
    }

    /// `s + u'(A - s E)v / (u' E v)`, unless that leaves the neighbourhood.
    fn newton(&self, s: Complex64, at: &Smallest) -> Option<Complex64> {
        let (size, e) = (1.0 + (s / self.scale).norm(), self.e.map(Complex64::from));
        let slope = at.left.dotc(&(e * &at.right));
        let step = Complex64::from(at.sigma * size) / slope * self.scale;
        let inside = step.norm() <= CLUSTER_WIDTH * s.norm().max(self.scale);
        inside.then_some(if s.im == 0.0 { Complex64::from(s.re + step.re) } else { s + step })
    }
}

/// Mean of a cluster; exactly real when the cluster is its own mirror image.
fn mean(zeros: &[Complex64]) -> Complex64 {
    let sum: Complex64 = zeros.iter().sum();
    let size: f64 = zeros.iter().map(|z| z.im.abs()).sum();
    let im = if sum.im.abs() <= 1e-12 * size { 0.0 } else { sum.im };
    Complex64::new(sum.re, im) / zeros.len() as f64
}

/// Groups of values that are linked by chains of near neighbours, in the order of first appearance.
fn linked(values: &[Complex64], near: impl Fn(Complex64, Complex64) -> bool) -> Vec<Vec<Complex64>> {
    let mut groups: Vec<Vec<Complex64>> = Vec::new();
    for &value in values {
        let (mut touching, apart): (Vec<_>, Vec<_>) =
            groups.into_iter().partition(|group| group.iter().any(|&member| near(member, value)));
        groups = apart;
        touching.push(vec![value]);
        groups.push(touching.concat());
    }
    groups
}
