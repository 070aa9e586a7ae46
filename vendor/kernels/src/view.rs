//! Matrices as BLAS hands them over: columns in a slice, each `leading` entries after the one before.

use faer::{MatMut, MatRef};

/// Which half of a symmetric matrix is given; the other half is neither read nor written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Triangle {
    /// On and below the diagonal.
    Lower,
    /// On and above the diagonal.
    Upper,
}

impl Triangle {
    /// From the argument `uplo` of BLAS and LAPACK: `U` or `u` is the upper half.
    pub fn from_code(uplo: u8) -> Self {
        if uplo.eq_ignore_ascii_case(&b'U') { Self::Upper } else { Self::Lower }
    }
}

/// A size as BLAS and LAPACK pass it; what is negative counts as zero.
pub fn size(count: i32) -> usize {
    usize::try_from(count).unwrap_or_default()
}

/// A matrix in a slice.
///
/// # Panics
/// When the slice is too short: a mistake of the caller.
pub fn matrix<T>(data: &[T], rows: usize, columns: usize, leading: usize) -> MatRef<'_, T> {
    if rows == 0 || columns == 0 {
        return MatRef::from_column_major_slice(&data[..0], rows, columns);
    }
    MatRef::from_column_major_slice_with_stride(data, rows, columns, leading)
}

/// A matrix in a slice, to be written.
///
/// # Panics
/// As [`matrix`].
pub fn matrix_mut<T>(data: &mut [T], rows: usize, columns: usize, leading: usize) -> MatMut<'_, T> {
    if rows == 0 || columns == 0 {
        return MatMut::from_column_major_slice_mut(&mut data[..0], rows, columns);
    }
    MatMut::from_column_major_slice_with_stride_mut(data, rows, columns, leading)
}
