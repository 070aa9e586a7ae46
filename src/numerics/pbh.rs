//! Smallest singular values of `[lambda I - A; C]` at the eigenvalues of `A`.

use nalgebra::DMatrix;
use num_complex::Complex64;

use super::fixed_modes::PbhMode;
use super::{NumericsError, Tolerance, complex_svd, eigenvalues, svd};

/// Eigenvalues closer than this, relative to the larger of their size and the norm of `A` per state, form a cluster.
const CLUSTER_TOLERANCE: f64 = 1e-4;

/// How far a computed eigenvalue may be from the true one, relative to the norm of `A` per state: Jordan blocks of five
/// are known to a thousandth only. Within this an unobservable point is looked for.
const EIGENVALUE_DOUBT: f64 = 1e-2;

/// Unobservable points closer than this, relative to the norm of the pair, are one mode.
const SAME_MODE: f64 = 1e-6;

/// A tested cluster; conjugate clusters appear once, by their upper member.
pub(super) struct Test {
    pub(super) mode: PbhMode,
    /// Columns that span `ker [value I - A; C]`.
    pub(super) null: DMatrix<Complex64>,
}

/// Tests every cluster of eigenvalues of a pair; `scale` is the norm of the pair it was computed from.
///
/// # Errors
/// As [`eigenvalues`] and [`svd`].
pub(super) fn tests(
    a: &DMatrix<f64>,
    c: &DMatrix<f64>,
    scale: f64,
    tolerance: &Tolerance,
) -> Result<Vec<Test>, NumericsError> {
    let n = a.nrows();
    let mut result: Vec<Test> = Vec::new();
    for cluster in clusters(scattered_spectrum(a)?) {
        let limit = tolerance.mode * scale;
        let Some((mut best, mut multiplicity)) = least_seen_of(a, c, &cluster, scale, limit)? else {
            continue;
        };
        if best.smallest() > limit
            && let Some(hidden) = hidden_nearby(a, c, &best, scale, limit)?
        {
            if best.at.im != 0.0 && hidden.at.im == 0.0 {
                multiplicity *= 2; // the mirror image came to the same point
            }
            best = hidden;
        }
        let same = |test: &&mut Test| {
            test.mode.unobservable && (test.mode.value - best.at).norm() <= SAME_MODE * scale
        };
        if best.smallest() <= limit
            && let Some(known) = result.iter_mut().find(same)
        {
            known.mode.multiplicity += multiplicity;
            continue;
        }
        let nullity = best.singular_values.iter().filter(|s| **s <= limit).count();
        let mode = PbhMode {
            value: best.at,
            multiplicity,
            distance: best.smallest() / scale.max(f64::MIN_POSITIVE),
            nullity,
            unobservable: nullity > 0,
            direction: normalised(best.v.column(n - 1).iter().copied()),
        };
        result.push(Test { mode, null: best.v.columns(n - nullity, nullity).into_owned() });
    }
    Ok(result)
}

/// The point of a cluster where `[lambda I - A; C]` is closest to losing rank, and how many eigenvalues it stands for;
/// `None` for a cluster in the lower half plane, which its mirror image represents.
fn least_seen_of(
    a: &DMatrix<f64>,
    c: &DMatrix<f64>,
    cluster: &[Complex64],
    scale: f64,
    limit: f64,
) -> Result<Option<(LeastSeen, usize)>, NumericsError> {
    let mean = cluster.iter().sum::<Complex64>() / cluster.len() as f64;
    let spread = cluster.iter().map(|z| (z - mean).norm()).fold(0.0, f64::max);
    // a cluster that meets the real axis is closed under conjugation: its mean is real
    let real = mean.im.abs() <= spread + f64::EPSILON * scale;
    if !real && mean.im < 0.0 {
        return Ok(None);
    }
    let mean = if real { Complex64::from(mean.re) } else { mean };
    let mut best = least_seen(a, c, mean)?;
    // a simple eigenvalue is where it was computed; those of a cluster are known to fewer digits
    if cluster.len() == 1 {
        return Ok(Some((best, 1)));
    }
    for &member in cluster.iter().filter(|z| !real || z.im == 0.0) {
        best = best.better(least_seen(a, c, member)?);
    }
    best = refined(a, c, best, mean, 10.0 * spread + 1e-8 * scale)?;
    if real && best.smallest() > limit {
        // nothing on the axis itself: a hidden pair close to it?
        for &member in cluster.iter().filter(|z| z.im > 0.0) {
            let pair = least_seen(a, c, member)?;
            if pair.smallest() <= limit {
                return Ok(Some((pair, cluster.len() / 2)));
            }
        }
    }
    Ok(Some((best, cluster.len())))
}

/// An unobservable point within the doubt about an eigenvalue; `None` when there is none.
///
/// The smallest singular value changes by no more than the point moves, so that most modes need no search.
fn hidden_nearby(
    a: &DMatrix<f64>,
    c: &DMatrix<f64>,
    start: &LeastSeen,
    scale: f64,
    limit: f64,
) -> Result<Option<LeastSeen>, NumericsError> {
    let doubt = EIGENVALUE_DOUBT * a.norm() / (a.nrows().max(1) as f64).sqrt();
    if start.smallest() > doubt {
        return Ok(None);
    }
    let found = refined(a, c, start.clone(), start.at, doubt)?;
    if found.smallest() > limit {
        return Ok(None);
    }
    if found.at.im != 0.0 && found.at.im.abs() <= SAME_MODE * scale {
        let projected = least_seen(a, c, Complex64::from(found.at.re))?;
        if projected.smallest() <= limit {
            return Ok(Some(projected));
        }
    }
    Ok(Some(found))
}

/// Groups eigenvalues that are linked by steps shorter than the reach of either end.
fn clusters(mut spectrum: Vec<(Complex64, f64)>) -> Vec<Vec<Complex64>> {
    let mut result = Vec::new();
    while !spectrum.is_empty() {
        let mut cluster = vec![spectrum.remove(0)];
        let mut next = 0;
        while let Some(&(center, reach)) = cluster.get(next) {
            let (near, far): (Vec<_>, Vec<_>) =
                spectrum.iter().partition(|(z, other)| (z - center).norm() <= reach.max(*other));
            spectrum = far;
            cluster.extend(near);
            next += 1;
        }
        result.push(cluster.into_iter().map(|(z, _)| z).collect());
    }
    result
}

/// The eigenvalues of `A`, each with the distance within which others belong to the same cluster.
///
/// ```text
/// reach = max( 1e-4 |lambda|, 1e-4 norm(A) / sqrt n, 10 eps norm(A) / |u' v| ),   u, v = left and right eigenvector
/// ```
///
/// The last term is the rounding error of the eigenvalue; the members of a scattered Jordan block reach each other by it.
fn scattered_spectrum(a: &DMatrix<f64>) -> Result<Vec<(Complex64, f64)>, NumericsError> {
    const FACTOR: f64 = 10.0;
    let per_state = a.norm() / (a.nrows().max(1) as f64).sqrt();
    let doubt = EIGENVALUE_DOUBT * per_state;
    let no_output = DMatrix::zeros(0, a.ncols());
    let spectrum = eigenvalues(a)?;
    let mut result = Vec::with_capacity(spectrum.len());
    for (i, &z) in spectrum.iter().enumerate() {
        let mut reach = CLUSTER_TOLERANCE * per_state.max(z.norm());
        let has_neighbour = spectrum.iter().enumerate().any(|(j, w)| i != j && (z - w).norm() <= doubt);
        if has_neighbour {
            let cosine = least_seen(a, &no_output, z)?.slope.norm();
            let rounding = FACTOR * f64::EPSILON * a.norm() / cosine.max(f64::MIN_POSITIVE);
            reach = reach.max(rounding.min(doubt));
        }
        result.push((z, reach));
    }
    Ok(result)
}

/// `[at I - A; C]` by its singular values and vectors.
#[derive(Clone)]
struct LeastSeen {
    at: Complex64,
    singular_values: Vec<f64>,
    /// `u' v` over the first n rows for the smallest singular value: its derivative along `at`.
    slope: Complex64,
    v: DMatrix<Complex64>,
}

impl LeastSeen {
    fn smallest(&self) -> f64 {
        self.singular_values.last().copied().unwrap_or(0.0)
    }

    fn better(self, other: Self) -> Self {
        if other.smallest() < self.smallest() { other } else { self }
    }
}

fn least_seen(a: &DMatrix<f64>, c: &DMatrix<f64>, at: Complex64) -> Result<LeastSeen, NumericsError> {
    let n = a.nrows();
    let entry = |i: usize, j: usize| {
        if i >= n {
            return c[(i - n, j)];
        }
        if i == j { at.re - a[(i, j)] } else { -a[(i, j)] }
    };
    let rows = n + c.nrows();
    let (singular_values, u, v) = if at.im == 0.0 {
        let found = svd(&DMatrix::from_fn(rows, n, entry))?;
        (found.s, found.u.map(Complex64::from), found.v.map(Complex64::from))
    } else {
        let imaginary = |i: usize, j: usize| if i == j { at.im } else { 0.0 };
        let found =
            complex_svd(&DMatrix::from_fn(rows, n, |i, j| Complex64::new(entry(i, j), imaginary(i, j))))?;
        (found.s, found.u, found.v)
    };
    let slope = (0..n).map(|i| u[(i, n - 1)].conj() * v[(i, n - 1)]).sum();
    Ok(LeastSeen { at, singular_values, slope, v })
}

/// Newton steps on the smallest singular value, kept while it falls and the point stays near its cluster.
fn refined(
    a: &DMatrix<f64>,
    c: &DMatrix<f64>,
    start: LeastSeen,
    center: Complex64,
    reach: f64,
) -> Result<LeastSeen, NumericsError> {
    const STEPS: usize = 25;
    const FLAT: f64 = 1e-14;
    // a true zero draws near by half or more with each step
    const WORTHWHILE: f64 = 0.9;
    let real = start.at.im == 0.0;
    let mut best = start;
    for _ in 0..STEPS {
        if best.slope.norm() < FLAT || best.smallest() <= f64::EPSILON * (a.norm() + c.norm()) {
            break;
        }
        let step = best.smallest() / best.slope;
        let step = if real { Complex64::from(step.re) } else { step };
        let next = best.at - step;
        if (next - center).norm() > reach || step.norm() <= f64::EPSILON * next.norm() {
            break;
        }
        let next = least_seen(a, c, next)?;
        if next.smallest() >= best.smallest() {
            break;
        }
        let slow = next.smallest() > WORTHWHILE * best.smallest();
        best = next;
        if slow {
            break;
        }
    }
    Ok(best)
}

/// Divides by the entry of largest absolute value.
fn normalised(vector: impl Iterator<Item = Complex64> + Clone) -> Vec<Complex64> {
    // the first of entries that are equal up to rounding, so that rounding does not choose
    const ALMOST: f64 = 1.0 - 1e-9;
    let largest = vector.clone().map(Complex64::norm).fold(0.0, f64::max);
    let pivot = vector.clone().find(|z| z.norm() >= ALMOST * largest && largest > 0.0);
    let pivot = pivot.unwrap_or(Complex64::ONE);
    vector.map(|z| z / pivot).collect()
}
