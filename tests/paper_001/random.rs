//! Random rectangular descriptor systems of known structure.

use descry::numerics::{Random, Tolerance, pseudo_inverse, side_by_side, stack};
use descry::system::{DescriptorSystem, TimeDomain};
use nalgebra::DMatrix;

/// Shape of a system: equations, states, rank of `E`, known inputs, unknown inputs, outputs.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Size {
    pub(crate) e: usize,
    pub(crate) n: usize,
    pub(crate) r: usize,
    pub(crate) k: usize,
    pub(crate) q: usize,
    pub(crate) p: usize,
}

/// Wide, square and tall; with and without known and unknown inputs; (A1) and (A2) hold for random entries:
/// e - r <= n - r + q and p >= n - e + q. At least one output is free of the unknown input.
pub(crate) const SIZES: [Size; 8] = [
    Size { e: 3, n: 4, r: 2, k: 2, q: 1, p: 3 },
    Size { e: 4, n: 6, r: 3, k: 1, q: 1, p: 5 },
    Size { e: 5, n: 5, r: 3, k: 1, q: 2, p: 3 },
    Size { e: 5, n: 7, r: 5, k: 0, q: 1, p: 4 },
    Size { e: 6, n: 8, r: 4, k: 2, q: 2, p: 6 },
    Size { e: 4, n: 3, r: 2, k: 1, q: 2, p: 2 },
    Size { e: 5, n: 6, r: 3, k: 1, q: 0, p: 2 },
    Size { e: 4, n: 4, r: 4, k: 1, q: 1, p: 3 },
];

fn normal(random: &mut Random, rows: usize, columns: usize) -> DMatrix<f64> {
    DMatrix::from_fn(rows, columns, |_, _| random.normal())
}

/// A random matrix near the identity, so that it is well conditioned.
fn mixing(random: &mut Random, n: usize) -> DMatrix<f64> {
    DMatrix::identity(n, n) + normal(random, n, n) * (0.4 / (n as f64).sqrt())
}

/// Blocks `[A B D; C 0 F]` in the coordinates where `E = diag(I, 0)`, mixed by equations and states.
struct Blocks {
    size: Size,
    a: DMatrix<f64>,
    b: DMatrix<f64>,
    c: DMatrix<f64>,
    d: DMatrix<f64>,
    f: DMatrix<f64>,
}

impl Blocks {
    fn random(size: Size, random: &mut Random) -> Self {
        let Size { e, n, k, q, p, .. } = size;
        Self {
            size,
            a: normal(random, e, n),
            b: normal(random, e, k),
            c: normal(random, p, n),
            d: normal(random, e, q),
            f: normal(random, p, q),
        }
    }

    fn mixed(self, random: &mut Random) -> DescriptorSystem {
        let Size { e, n, r, .. } = self.size;
        let (rows, columns) = (mixing(random, e), mixing(random, n));
        let mut unit = DMatrix::zeros(e, n);
        unit.view_mut((0, 0), (r, r)).fill_with_identity();
        DescriptorSystem {
            time: TimeDomain::Continuous,
            E: &rows * unit * &columns,
            A: &rows * self.a * &columns,
            B: &rows * self.b,
            C: self.c * &columns,
            D: &rows * self.d,
            F: self.f,
        }
        .checked()
        .unwrap()
    }
}

/// A random system with these invariant zeros.
///
/// In the coordinates of `E = diag(I, 0)`, random `V` (r x z) and `W` are made to satisfy
/// `A1 V + X W = V Lambda`, `A3 V + S W = 0`, `C1 V + Y W = 0` by correcting the columns of `x1`.
pub(crate) fn planted(size: &Size, zeros: &[f64], seed: u64) -> DescriptorSystem {
    let mut random = Random::new(seed);
    let mut blocks = Blocks::random(*size, &mut random);
    let Size { e, n, r, q, p, .. } = *size;
    if !zeros.is_empty() {
        let v = normal(&mut random, r, zeros.len());
        let w = normal(&mut random, n - r + q, zeros.len());
        let lambda = DMatrix::from_diagonal(&nalgebra::DVector::from_column_slice(zeros));
        let rest = stack(&[
            &side_by_side(&[&blocks.a.columns(r, n - r).into_owned(), &blocks.d]),
            &side_by_side(&[&blocks.c.columns(r, n - r).into_owned(), &blocks.f]),
        ]);
        let first = stack(&[&blocks.a.columns(0, r).into_owned(), &blocks.c.columns(0, r).into_owned()]);
        let wanted = stack(&[&(&v * lambda), &DMatrix::zeros(e - r + p, zeros.len())]);
        let off = wanted - &first * &v - rest * w;
        let corrected = first + off * pseudo_inverse(&v, &Tolerance::default()).unwrap();
        blocks.a.columns_mut(0, r).copy_from(&corrected.rows(0, e));
        blocks.c.columns_mut(0, r).copy_from(&corrected.rows(e, p));
    }
    blocks.mixed(&mut random)
}

/// A random system for which (A1) alone fails: one algebraic equation has the algebraic part of another.
pub(crate) fn without_a1(seed: u64) -> DescriptorSystem {
    let mut random = Random::new(1000 + seed);
    let size = Size { e: 6, n: 6, r: 3, k: 1, q: 1, p: 3 };
    let mut blocks = Blocks::random(size, &mut random);
    for j in size.r..size.n {
        blocks.a[(5, j)] = 2.0 * blocks.a[(4, j)];
    }
    blocks.d[(5, 0)] = 2.0 * blocks.d[(4, 0)];
    blocks.mixed(&mut random)
}

/// A random plant with an equation that follows from two others, so that (A1) fails.
pub(crate) fn twice(seed: u64) -> DescriptorSystem {
    let mut random = Random::new(2000 + seed);
    let size = Size { e: 6, n: 6, r: 3, k: 1, q: 1, p: 3 };
    let mut blocks = Blocks::random(size, &mut random);
    for matrix in [&mut blocks.a, &mut blocks.b, &mut blocks.d] {
        let combination = 2.0 * matrix.row(3) - 0.5 * matrix.row(4);
        matrix.row_mut(5).copy_from(&combination);
    }
    blocks.mixed(&mut random)
}
