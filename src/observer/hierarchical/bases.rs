//! Orthonormal bases of the row spaces of `Gamma` and of the observability matrix, unique and without expansion.
#![expect(non_snake_case, reason = "matrix letters follow paper 003")]

use nalgebra::{DMatrix, DVector};

use crate::numerics::{
    NumericsError, Random, RankDecision, Tolerance, observable_quotient, singular_values, subspaces, svd,
};
use crate::system::{CouplingMatrix, Network};

/// Up to this many subsystems the singular values of the whole `Gamma` are computed.
const DENSE: usize = 64;

/// Columns of the first sketch of a larger `Gamma`; they are doubled until the remainder is rounding.
const FIRST_SKETCH: usize = 16;

/// Rows of `Gamma` that are unfolded at a time.
const STRIP: usize = 64;

/// A row adds a vector to the basis when at least this share of it is new; what is less would be known too badly.
const NEW_SHARE: f64 = 1e-3;

/// The row space of `Gamma`.
#[derive(Clone, Debug)]
pub(super) struct RowSpace {
    /// The rank; of a sketched matrix the singular values of the sketch and, last, a bound of all that it leaves out.
    pub(super) rank: RankDecision,
    /// Orthonormal, N x nu; `None` when the rank exceeds what was allowed, and is a lower bound only.
    pub(super) basis: Option<DMatrix<f64>>,
}

/// Rank and canonical row space of a coupling, up to a rank of `most`.
///
/// A large matrix is multiplied by seeded random vectors. With `Q` an orthonormal basis of `Gamma' Omega`:
///
/// ```text
/// sigma_i(Gamma Q) <= sigma_i(Gamma) <= sigma_i(Gamma Q) + norm_F(Gamma - Gamma Q Q')
/// ```
///
/// so that neither a rank that is found nor one that is exceeded depends on luck: the remainder is computed from all
/// entries, and the sketch grows until it is below the threshold.
///
/// # Errors
/// As [`svd`].
///
/// # Source
/// Halko, Martinsson and Tropp, "Finding structure with randomness", 2011, for the sketch.
pub(super) fn row_space(
    Gamma: &CouplingMatrix,
    most: usize,
    tolerance: &Tolerance,
) -> Result<RowSpace, NumericsError> {
    let (rank, vectors) = if Gamma.nrows() <= DENSE {
        from_entries(Gamma, tolerance)?
    } else {
        sketched(Gamma, most, tolerance)?
    };
    if rank.rank > most {
        return Ok(RowSpace { rank, basis: None });
    }
    let in_order = rows_in_order(Gamma, rank.rank);
    let reliable = in_order.ncols() == rank.rank && remainder(Gamma, &in_order) <= rank.threshold;
    let basis = if reliable { in_order } else { with_canonical_signs(vectors) };
    Ok(RowSpace { rank, basis: Some(basis) })
}

fn from_entries(
    Gamma: &CouplingMatrix,
    tolerance: &Tolerance,
) -> Result<(RankDecision, DMatrix<f64>), NumericsError> {
    let found = subspaces(&Gamma.dense(), 0.0, tolerance)?;
    Ok((found.rank, found.row_space))
}

fn sketched(
    Gamma: &CouplingMatrix,
    most: usize,
    tolerance: &Tolerance,
) -> Result<(RankDecision, DMatrix<f64>), NumericsError> {
    const SEED: u64 = 3;
    let size = Gamma.nrows();
    let mut random = Random::new(SEED);
    let mut k = FIRST_SKETCH.min(size);
    loop {
        let omega = DMatrix::from_fn(size, k, |_, _| random.normal());
        let Q = Gamma.transposed_times(&omega).qr().q();
        let found = svd(&Gamma.times(&Q).qr().r())?;
        let remainder = remainder(Gamma, &Q);
        let within = RankDecision::from_singular_values((size, size), found.s.clone(), 0.0, tolerance);
        if remainder <= within.threshold || within.rank > most || k == size {
            let mut values = found.s;
            values.push(remainder);
            values.sort_by(|a, b| b.total_cmp(a));
            let complete = remainder <= within.threshold || k == size;
            let rank = if complete {
                RankDecision::from_singular_values((size, size), values, 0.0, tolerance)
            } else {
                within
            };
            let vectors = Q * found.v.columns(0, rank.rank.min(k));
            return Ok((rank, vectors));
        }
        k = (2 * k).min(size);
    }
}

/// `norm_F(Gamma - Gamma Q Q')`, entry by entry.
pub(super) fn remainder(Gamma: &CouplingMatrix, Q: &DMatrix<f64>) -> f64 {
    let image = Gamma.times(Q);
    strips(Gamma)
        .map(|(first, strip)| {
            let rows = strip.ncols();
            (strip - Q * image.rows(first, rows).transpose()).norm_squared()
        })
        .sum::<f64>()
        .sqrt()
}

/// `Gamma'` in strips of columns, each with the number of its first column.
fn strips(Gamma: &CouplingMatrix) -> impl Iterator<Item = (usize, DMatrix<f64>)> + '_ {
    let size = Gamma.nrows();
    (0..size).step_by(STRIP).map(move |first| (first, Gamma.strip(first, STRIP.min(size - first))))
}

/// Gram-Schmidt on the rows of `Gamma` in their order, which is how the paper's own `N` came about.
fn rows_in_order(Gamma: &CouplingMatrix, rank: usize) -> DMatrix<f64> {
    columns(Gamma.nrows(), &first_rows(Gamma, rank, NEW_SHARE))
}

/// The first rows of `Gamma` that are new by a share of themselves, orthonormalised; `most` at most.
fn first_rows(Gamma: &CouplingMatrix, most: usize, share: f64) -> Vec<DVector<f64>> {
    let mut basis = Vec::new();
    for (_, strip) in strips(Gamma) {
        for row in strip.column_iter() {
            if basis.len() == most {
                return basis;
            }
            extend(&mut basis, row.into_owned(), share);
        }
    }
    basis
}

/// The order of the global observer as orthogonalising proposes it, without a decomposition; `None` beyond `most`.
///
/// It decides nothing: a list of poles is provided by it while somebody types.
pub fn proposed_order(network: &Network, most: usize) -> Option<usize> {
    // more than rounding leaves of a dependent row, less than what the data of a network leave of an independent one
    const SHARE: f64 = 1e-6;
    let mu = krylov(&network.a, &(&network.b * &network.c), SHARE).len();
    let nu = first_rows(&network.Gamma, most / mu.max(1) + 1, SHARE).len();
    Some(nu * mu).filter(|order| *order <= most)
}

/// The rows of `bc` and their images under `a`, orthonormalised in order.
fn krylov(a: &DMatrix<f64>, bc: &DMatrix<f64>, share: f64) -> Vec<DVector<f64>> {
    let mut basis = Vec::new();
    for row in bc.row_iter() {
        extend(&mut basis, row.transpose(), share);
    }
    let mut next = 0;
    while let Some(vector) = basis.get(next) {
        let image = a.tr_mul(vector);
        extend(&mut basis, image, share);
        next += 1;
    }
    basis
}

/// Adds what is new of a vector, orthogonalised twice, when its share is large enough.
fn extend(basis: &mut Vec<DVector<f64>>, vector: DVector<f64>, share: f64) {
    let size = vector.norm();
    if size == 0.0 || !size.is_finite() || basis.len() == vector.len() {
        return;
    }
    let mut rest = vector;
    for _ in 0..2 {
        for known in basis.iter() {
            let along = known.dot(&rest);
            rest.axpy(-along, known, 1.0);
        }
    }
    let new = rest.norm();
    if new > share * size {
        basis.push(rest / new);
    }
}

fn columns(rows: usize, basis: &[DVector<f64>]) -> DMatrix<f64> {
    if basis.is_empty() { DMatrix::zeros(rows, 0) } else { DMatrix::from_columns(basis) }
}

/// Turns each column so that the first of its largest entries is positive.
fn with_canonical_signs(mut basis: DMatrix<f64>) -> DMatrix<f64> {
    const ALMOST: f64 = 1.0 - 1e-9;
    for mut column in basis.column_iter_mut() {
        let largest = column.amax();
        if column.iter().find(|x| x.abs() >= ALMOST * largest).is_some_and(|x| *x < 0.0) {
            column.neg_mut();
        }
    }
    basis
}

/// The row space of `O_n(a, b c)`, the part of a subsystem that the coupling ever shows.
#[derive(Clone, Debug)]
pub(super) struct ShownPart {
    /// Orthonormal, n x mu.
    pub(super) M: DMatrix<f64>,
    /// Rank of the observability matrix as it is printed, of `a` divided by its norm; evidence, it does not decide.
    pub(super) printed: RankDecision,
}

/// Canonical basis of the row space of `O_n(a, b c)`; its dimension is decided by the PBH test.
///
/// The rows of `b c` and their images under `a` are orthonormalised in order, which needs no powers of `a`; where that
/// does not give an invariant space of the right dimension, the complement of the unobservable subspace takes its place.
///
/// # Errors
/// As [`observable_quotient`].
pub(super) fn shown_part(
    a: &DMatrix<f64>,
    bc: &DMatrix<f64>,
    tolerance: &Tolerance,
) -> Result<ShownPart, NumericsError> {
    const INVARIANT: f64 = 1e-12;
    let n = a.nrows();
    let independent = row_factor(bc, tolerance)?;
    let quotient = observable_quotient(a, &independent, tolerance)?;
    let mu = quotient.basis.ncols();
    let krylov = columns(n, &krylov(a, bc, NEW_SHARE));
    let outside = |rows: &DMatrix<f64>| (rows - rows * &krylov * krylov.transpose()).norm();
    let invariant =
        outside(&krylov.tr_mul(a)) <= INVARIANT * a.norm() && outside(bc) <= INVARIANT * bc.norm();
    let M = if krylov.ncols() == mu && invariant { krylov } else { with_canonical_signs(quotient.basis) };
    Ok(ShownPart { M, printed: printed_rank(a, &independent, tolerance)? })
}

/// As many rows as `bc` has independent ones, with the same singular values: `S V'` of `b c = U S V'`.
fn row_factor(bc: &DMatrix<f64>, tolerance: &Tolerance) -> Result<DMatrix<f64>, NumericsError> {
    let found = svd(bc)?;
    let rank = RankDecision::from_singular_values(bc.shape(), found.s.clone(), 0.0, tolerance).rank;
    Ok(DMatrix::from_fn(rank, bc.ncols(), |i, j| found.s[i] * found.v[(j, i)]))
}

/// The rank of `O_n(a, b c)`, whose singular values are those of `O_n(a, S V')`.
fn printed_rank(
    a: &DMatrix<f64>,
    independent: &DMatrix<f64>,
    tolerance: &Tolerance,
) -> Result<RankDecision, NumericsError> {
    let n = a.nrows();
    let values = singular_values(&observability_matrix(a, independent))?;
    Ok(RankDecision::from_singular_values((n * n, n), values, 0.0, tolerance))
}

/// `[c; c a; ...; c a^(n-1)]` of `a` divided by its norm, which leaves the row space as it is.
fn observability_matrix(a: &DMatrix<f64>, c: &DMatrix<f64>) -> DMatrix<f64> {
    let unit = a / a.norm().max(f64::MIN_POSITIVE);
    let mut block = c.clone();
    let mut blocks = vec![block.clone()];
    for _ in 1..a.nrows() {
        block = &block * &unit;
        blocks.push(block.clone());
    }
    crate::numerics::stack(&blocks.iter().collect::<Vec<_>>())
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::dmatrix;

    fn tolerance() -> Tolerance {
        Tolerance::default()
    }

    /// A large sparse coupling of rank three: everybody listens to three hubs.
    fn hubs(size: usize) -> CouplingMatrix {
        let entries = (0..size).flat_map(|i| {
            [(i, 5, 1.0 + (i as f64).sin()), (i, 50, (0.3 * i as f64).cos()), (i, 100, 1e-3 * (i % 7) as f64)]
        });
        CouplingMatrix::Sparse { rows: size, columns: size, entries: entries.collect() }
    }

    #[test]
    fn a_sketch_decides_like_all_singular_values() {
        let Gamma = hubs(200);
        let found = row_space(&Gamma, 10, &tolerance()).unwrap();
        let whole = subspaces(&Gamma.dense(), 0.0, &tolerance()).unwrap();
        assert_eq!((found.rank.rank, whole.rank.rank), (3, 3), "three hubs: {:?}", found.rank);
        assert!(!found.rank.fragile, "the remainder is rounding: {:?}", found.rank);
        let N = found.basis.unwrap();
        let apart = (&N * N.transpose() - &whole.row_space * whole.row_space.transpose()).norm();
        assert!(apart < 1e-12, "the same space, {apart:.1e} apart");
        assert!(
            (found.rank.singular_values[2] / whole.rank.singular_values[2] - 1.0).abs() < 1e-9,
            "sigma_3"
        );
    }

    #[test]
    fn a_small_singular_value_is_not_lost_in_the_sketch() {
        let mut entries: Vec<_> = (0..300).map(|i| (i, 0, 1.0)).collect();
        entries.push((7, 9, 1e-9));
        let Gamma = CouplingMatrix::Sparse { rows: 300, columns: 300, entries };
        let found = row_space(&Gamma, 10, &tolerance()).unwrap();
        assert_eq!(found.rank.rank, 2, "1e-9 beside 17 is data: {:?}", found.rank);
    }

    #[test]
    fn a_rank_beyond_the_limit_is_a_lower_bound() {
        let ring = (0..300).flat_map(|i| [(i, i, -1.0), (i, (i + 1) % 300, 1.0)]);
        let ring = CouplingMatrix::Sparse { rows: 300, columns: 300, entries: ring.collect() };
        let found = row_space(&ring, 20, &tolerance()).unwrap();
        assert!(found.basis.is_none() && (21..300).contains(&found.rank.rank), "{}", found.rank.rank);
    }

    #[test]
    fn nothing_is_coupled_by_zeros() {
        for size in [4, 200] {
            let Gamma = CouplingMatrix::Sparse { rows: size, columns: size, entries: Vec::new() };
            let found = row_space(&Gamma, 10, &tolerance()).unwrap();
            assert_eq!((found.rank.rank, found.basis.unwrap().shape()), (0, (size, 0)), "rank zero");
        }
    }

    #[test]
    fn nearly_dependent_rows_fall_back_to_singular_vectors() {
        let Gamma = dmatrix![1.0, 1.0, 0.0; 1.0, 1.0 + 1e-6, 0.0; 0.0, 0.0, 0.0].into();
        let found = row_space(&Gamma, 3, &tolerance()).unwrap();
        let N = found.basis.unwrap();
        assert_eq!(found.rank.rank, 2, "two independent rows");
        assert!(remainder(&Gamma, &N) < 1e-15 && N.row(2).norm() < 1e-15, "the row space is the first plane");
    }

    #[test]
    fn the_part_that_the_coupling_shows_is_found_in_order() {
        let a = dmatrix![-1.0, 2.0, 0.0; 0.0, -2.0, 0.0; 5.0, 0.0, -3.0];
        let found = shown_part(&a, &dmatrix![1.0, 0.0, 0.0], &tolerance()).unwrap();
        assert_eq!(found.M, dmatrix![1.0, 0.0; 0.0, 1.0; 0.0, 0.0], "the third state is never seen");
        assert_eq!(found.printed.rank, 2, "the printed rank agrees");
        let none = shown_part(&a, &DMatrix::zeros(0, 3), &tolerance()).unwrap();
        assert_eq!(none.M.shape(), (3, 0), "no coupling output shows nothing");
    }
}
