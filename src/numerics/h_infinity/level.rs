//! Frequencies at which a gain takes a given value: imaginary eigenvalues of a Hamiltonian matrix.

use nalgebra::DMatrix;
use num_complex::Complex64;

use super::StateSpace;
use crate::numerics::Block::{Minus, Of};
use crate::numerics::{NumericsError, StabilityRegion, block_matrix, eigenvalues, svd};

/// An eigenvalue further from the axis than this part of its size is no crossing, whatever rounding did to it.
const WIDTH: f64 = 0.1;

/// An eigenvalue below this part of the largest one is known too badly to be left out.
const ROUNDING: f64 = 1e-6;

/// A system in continuous time whose level crossings can be asked, with the way back to its own frequencies.
#[derive(Debug)]
pub(super) struct Level {
    system: StateSpace,
    map: Map,
    /// Gains at infinite frequency of the half plane, all of them.
    at_infinity: Vec<f64>,
}

/// Relative distance from a gain at infinity within which `R` and `S` are nearly singular.
const NEAR: f64 = 1e-2;

/// From the frequencies of the half plane to those of the system.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Map {
    /// The same ones.
    Same,
    /// `z = (1 + s) / (1 - s)`: infinity stands for z = -1.
    AtMinusOne,
    /// `z = -(1 + s) / (1 - s)`: infinity stands for z = 1.
    AtOne,
}

impl Level {
    /// # Errors
    /// When `A + I` (or `A - I`) is singular, which a stable `A` excludes but for rounding.
    pub(super) fn new(
        system: &StateSpace,
        region: StabilityRegion,
        modes: &[Complex64],
    ) -> Result<Self, NumericsError> {
        if region == StabilityRegion::LeftHalfPlane {
            return Self::of(system.clone(), Map::Same);
        }
        let distance = |from: f64| modes.iter().map(|z| (z - from).norm()).fold(f64::INFINITY, f64::min);
        let map = if distance(-1.0) >= distance(1.0) { Map::AtMinusOne } else { Map::AtOne };
        let sign = if map == Map::AtOne { -1.0 } else { 1.0 };
        Self::of(bilinear(system, sign)?, map)
    }

    fn of(system: StateSpace, map: Map) -> Result<Self, NumericsError> {
        let at_infinity = svd(&system.d)?.s;
        Ok(Self { system, map, at_infinity })
    }

    /// Whether a level is nearly one of the gains at infinity.
    pub(super) fn is_near_infinity(&self, level: f64) -> bool {
        self.at_infinity.iter().any(|gain| (gain - level).abs() <= NEAR * level)
    }

    /// Frequencies that may have gain `level`: a superset of the crossings, always with both ends.
    ///
    /// ```text
    /// M(g) = [ A - B R^-1 D' C      -g B R^-1 B'          ]     R = D' D - g^2 I
    ///        [ g C' S^-1 C          -(A - B R^-1 D' C)'   ]     S = D D' - g^2 I
    /// ```
    pub(super) fn crossings(&self, level: f64) -> Result<Vec<f64>, NumericsError> {
        let StateSpace { a, b, c, d } = &self.system;
        let (p, m) = d.shape();
        // divided by g^2, so that neither overflows
        let scaled = d / level;
        let r = scaled.tr_mul(&scaled) - DMatrix::identity(m, m);
        let s = &scaled * scaled.transpose() - DMatrix::identity(p, p);
        let r_b = solve(&r, &(b.transpose() / level))?;
        let s_c = solve(&s, &(c / level))?;
        let corner = a - b * solve(&r, &(scaled.tr_mul(c) / level))?;
        let top = b * r_b;
        let bottom = c.tr_mul(&s_c);
        let back = corner.transpose();
        let found = eigenvalues(&block_matrix(&[&[Of(&corner), Minus(&top)], &[Of(&bottom), Minus(&back)]]))?;
        let largest = found.iter().map(|z| z.norm()).fold(0.0, f64::max);
        let possible = found.iter().filter(|z| z.re.abs() <= WIDTH * z.norm() + ROUNDING * largest);
        let ends: &[f64] = if self.map == Map::Same { &[0.0] } else { &[0.0, std::f64::consts::PI] };
        Ok(possible.map(|z| self.map.back(z.im.abs())).chain(ends.iter().copied()).collect())
    }
}

impl Map {
    fn back(self, frequency: f64) -> f64 {
        match self {
            Self::Same => frequency,
            Self::AtMinusOne => 2.0 * frequency.atan(),
            Self::AtOne => std::f64::consts::PI - 2.0 * frequency.atan(),
        }
    }
}

/// The system in the half plane under `z = sign (1 + s) / (1 - s)`.
///
/// ```text
/// A_c = (A + I)^-1 (A - I),   B_c = sqrt 2 (A + I)^-1 B,   C_c = sqrt 2 C (A + I)^-1,   D_c = D - C (A + I)^-1 B
/// ```
/// with `-A`, `-B` in the place of `A`, `B` for `sign = -1`.
fn bilinear(system: &StateSpace, sign: f64) -> Result<StateSpace, NumericsError> {
    let (a, b) = (&system.a * sign, &system.b * sign);
    let n = a.nrows();
    let unit = DMatrix::identity(n, n);
    let shifted = &a + &unit;
    let inverse = solve(&shifted, &unit)?;
    let root = std::f64::consts::SQRT_2;
    Ok(StateSpace {
        a: &inverse * (&a - &unit),
        b: &inverse * &b * root,
        c: &system.c * &inverse * root,
        d: &system.d - &system.c * &inverse * &b,
    })
}

fn solve(matrix: &DMatrix<f64>, right: &DMatrix<f64>) -> Result<DMatrix<f64>, NumericsError> {
    let found = matrix.clone().lu().solve(right).filter(|x| x.iter().all(|x| x.is_finite()));
    found.ok_or(NumericsError::Singular { what: "a matrix of the level test", smallest: 0.0 })
}
