//! Assembly of block matrices.

use nalgebra::DMatrix;

/// One block of a block matrix.
#[derive(Clone, Copy, Debug)]
pub enum Block<'a> {
    /// A matrix as it is.
    Of(&'a DMatrix<f64>),
    /// The negative of a matrix.
    Minus(&'a DMatrix<f64>),
    /// Zeros; the shape follows from the neighbours.
    Zero,
    /// The identity of the block's (square) shape.
    Identity,
}

/// Assembles a block matrix from block rows.
///
/// Heights come from the first sized block of each row, widths from the first sized block of each column; a row or
/// column of nothing but [`Block::Zero`] and [`Block::Identity`] takes the size that `row_heights` or
/// `column_widths` implies through the identity, else zero.
///
/// # Panics
/// When two blocks that share a row or column disagree in size: a mistake of the caller, never of user data.
///
/// # Examples
/// ```
/// use descry::numerics::{block_matrix, Block::{Of, Zero}};
/// let e = nalgebra::dmatrix![1.0, 0.0; 0.0, 0.0];
/// let a = nalgebra::dmatrix![0.0, 1.0; 1.0, 0.0];
/// let c = nalgebra::dmatrix![1.0, 0.0];
/// // [E A; 0 E; 0 C]
/// let m = block_matrix(&[&[Of(&e), Of(&a)], &[Zero, Of(&e)], &[Zero, Of(&c)]]);
/// assert_eq!(m.shape(), (5, 4));
/// ```
pub fn block_matrix(rows: &[&[Block<'_>]]) -> DMatrix<f64> {
    let n_columns = rows.first().map_or(0, |row| row.len());
    let sized = |block: &Block<'_>| match block {
        Block::Of(m) | Block::Minus(m) => Some(m.shape()),
        Block::Zero | Block::Identity => None,
    };
    let mut heights: Vec<Option<usize>> =
        rows.iter().map(|row| row.iter().find_map(|b| sized(b).map(|s| s.0))).collect();
    let mut widths: Vec<Option<usize>> =
        (0..n_columns).map(|j| rows.iter().find_map(|row| sized(&row[j]).map(|s| s.1))).collect();
    // an identity is square: it hands a known height to its column and the other way round
    for (i, row) in rows.iter().enumerate() {
        for (j, block) in row.iter().enumerate() {
            if matches!(block, Block::Identity) {
                let side = heights[i].or(widths[j]);
                heights[i] = side;
                widths[j] = side;
            }
        }
    }
    let heights: Vec<usize> = heights.into_iter().map(|h| h.unwrap_or(0)).collect();
    let widths: Vec<usize> = widths.into_iter().map(|w| w.unwrap_or(0)).collect();
    let mut result = DMatrix::zeros(heights.iter().sum(), widths.iter().sum());
    let mut top = 0;
    for (row, height) in rows.iter().zip(&heights) {
        assert_eq!(row.len(), n_columns, "block rows of different length");
        let mut left = 0;
        for (block, width) in row.iter().zip(&widths) {
            let mut view = result.view_mut((top, left), (*height, *width));
            match block {
                Block::Of(m) => view.copy_from(m),
                Block::Minus(m) => view.copy_from(&-*m),
                Block::Zero => {}
                Block::Identity => view.fill_with_identity(),
            }
            left += width;
        }
        top += height;
    }
    result
}

/// Stacks matrices on top of each other: `[top; bottom]`.
///
/// # Panics
/// When the numbers of columns differ.
pub fn stack(matrices: &[&DMatrix<f64>]) -> DMatrix<f64> {
    let rows: Vec<[Block<'_>; 1]> = matrices.iter().map(|m| [Block::Of(m)]).collect();
    let rows: Vec<&[Block<'_>]> = rows.iter().map(<[_; 1]>::as_slice).collect();
    block_matrix(&rows)
}

/// Puts matrices side by side: `[left right]`.
///
/// # Panics
/// When the numbers of rows differ.
pub fn side_by_side(matrices: &[&DMatrix<f64>]) -> DMatrix<f64> {
    let row: Vec<Block<'_>> = matrices.iter().map(|m| Block::Of(m)).collect();
    block_matrix(&[&row])
}

#[cfg(test)]
mod tests {
    use super::*;
    use Block::{Identity, Minus, Of, Zero};
    use nalgebra::dmatrix;

    #[test]
    fn identity_takes_its_size_from_its_neighbours() {
        let a = dmatrix![2.0, 3.0];
        let m = block_matrix(&[&[Identity, Zero], &[Of(&a), Minus(&dmatrix![1.0])]]);
        assert_eq!(m, dmatrix![1.0, 0.0, 0.0; 0.0, 1.0, 0.0; 2.0, 3.0, -1.0], "[I 0; A -1]");
    }

    #[test]
    fn empty_blocks_keep_the_shape() {
        let m = side_by_side(&[&DMatrix::zeros(2, 0), &DMatrix::identity(2, 2)]);
        assert_eq!(m, DMatrix::identity(2, 2), "a block without columns adds nothing");
    }
}
