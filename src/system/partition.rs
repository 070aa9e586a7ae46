//! Partition of a descriptor system into interconnected subsystems (paper 000).

use serde::{Deserialize, Serialize};

use super::DescriptorSystem;

/// The sizes of one subsystem; subsystems take consecutive states, equations, inputs and outputs.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Subsystem {
    /// Name for legends.
    pub name: String,
    /// Number of its states.
    pub states: usize,
    /// Number of its equations.
    pub equations: usize,
    /// Number of its outputs.
    pub outputs: usize,
}

/// A partition that does not fit its system.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum PartitionError {
    /// The sizes do not add up.
    #[error("the subsystems have {found} {what} together, but the system has {needed}")]
    Sum {
        /// States, equations or outputs.
        what: &'static str,
        /// Their sum.
        found: usize,
        /// The system's number.
        needed: usize,
    },
    /// `E` or `C` couples two subsystems.
    #[error("{matrix}[{}, {}] = {value} couples subsystem {first} with subsystem {second}: {matrix} must be block diagonal", row + 1, column + 1)]
    Coupled {
        /// Letter of the matrix.
        matrix: &'static str,
        /// Row of the entry, from zero.
        row: usize,
        /// Column of the entry, from zero.
        column: usize,
        /// The entry, as text.
        value: String,
        /// Subsystem of the row, from one.
        first: usize,
        /// Subsystem of the column, from one.
        second: usize,
    },
}

/// Checks that the sizes add up and that `E` and `C` are block diagonal.
///
/// # Errors
/// The first size or entry that does not fit.
///
/// # Source
/// Paper 000, section 2: `E = blkdiag(E_i)`, `H = blkdiag(H_i)`.
pub fn check_partition(system: &DescriptorSystem, subsystems: &[Subsystem]) -> Result<(), PartitionError> {
    let DescriptorSystem { E, C, .. } = system;
    let states: Vec<usize> = subsystems.iter().map(|s| s.states).collect();
    let equations: Vec<usize> = subsystems.iter().map(|s| s.equations).collect();
    let outputs: Vec<usize> = subsystems.iter().map(|s| s.outputs).collect();
    let sums = [
        ("states", &states, E.ncols()),
        ("equations", &equations, E.nrows()),
        ("outputs", &outputs, C.nrows()),
    ];
    for (what, sizes, needed) in sums {
        let found = sizes.iter().sum();
        if found != needed {
            return Err(PartitionError::Sum { what, found, needed });
        }
    }
    let (columns, rows_e, rows_c) = (owners(&states), owners(&equations), owners(&outputs));
    for (matrix, value, rows) in [("E", E, rows_e), ("C", C, rows_c)] {
        for (row, &first) in rows.iter().enumerate() {
            for (column, &second) in columns.iter().enumerate() {
                if first != second && value[(row, column)] != 0.0 {
                    let value = value[(row, column)].to_string();
                    return Err(PartitionError::Coupled { matrix, row, column, value, first, second });
                }
            }
        }
    }
    Ok(())
}

/// For each index the number of the subsystem that owns it, from one.
fn owners(sizes: &[usize]) -> Vec<usize> {
    sizes.iter().enumerate().flat_map(|(i, &size)| std::iter::repeat_n(i + 1, size)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{DMatrix, dmatrix};

    fn halves() -> [Subsystem; 2] {
        let one = |name: &str| Subsystem { name: name.to_owned(), states: 1, equations: 1, outputs: 1 };
        [one("a"), one("b")]
    }

    #[test]
    fn block_diagonal_e_and_c_are_accepted() {
        let unit = DMatrix::identity(2, 2);
        let system =
            DescriptorSystem::autonomous(unit.clone(), DMatrix::from_element(2, 2, 1.0), unit).unwrap();
        assert_eq!(check_partition(&system, &halves()), Ok(()), "A may couple, E and C do not");
    }

    #[test]
    fn a_coupling_entry_is_named() {
        let unit = DMatrix::identity(2, 2);
        let system = DescriptorSystem::autonomous(dmatrix![1.0, 0.5; 0.0, 1.0], unit.clone(), unit).unwrap();
        let error = check_partition(&system, &halves()).unwrap_err();
        assert_eq!(
            error.to_string(),
            "E[1, 2] = 0.5 couples subsystem 1 with subsystem 2: E must be block diagonal",
            "matrix, place and both subsystems"
        );
    }

    #[test]
    fn sizes_must_add_up() {
        let unit = DMatrix::identity(2, 2);
        let system = DescriptorSystem::autonomous(unit.clone(), unit.clone(), unit).unwrap();
        let error = check_partition(&system, &halves()[..1]).unwrap_err();
        assert_eq!(
            error,
            PartitionError::Sum { what: "states", found: 1, needed: 2 },
            "one state is left over"
        );
    }
}
