//! The plant cut into the local problems of its subsystems.
#![expect(non_snake_case, reason = "matrix letters follow paper 000")]

use nalgebra::DMatrix;

use crate::system::{DescriptorSystem, Model, PartitionError, TimeDomain, check_partition};

/// One subsystem as its own observer sees it: what the others do enters as an unknown input.
///
/// ```text
/// E_i s.x_i = A_ii x_i + B_i u + D_i v_i,   z_i = H_i x_i
/// D_i = [A_i1 .. A_i,i-1  A_i,i+1 .. A_iN],   v_i = col(x_j, j /= i)
/// ```
///
/// Columns of `D_i` that are zero are left out, so that the size of a local problem depends on its neighbours alone. An
/// unknown input of the plant is one more column.
///
/// # Shapes
/// `E`, `A`: e x n; `B`: e x k; `H`: m x n; `D`: e x (length of `sources`).
///
/// # Source
/// Paper 000, (7)-(10).
// ERRATUM(000, section III): v_i is printed as a row of the x_j; it is their column.
#[derive(Clone, Debug, PartialEq)]
pub struct LocalProblem {
    /// Name of the subsystem.
    pub name: String,
    /// Differential or difference equations.
    pub time: TimeDomain,
    /// Matrix of the derivatives.
    pub E: DMatrix<f64>,
    /// The subsystem's own block of the state matrix.
    pub A: DMatrix<f64>,
    /// Distribution of all known inputs of the plant.
    pub B: DMatrix<f64>,
    /// Output matrix.
    pub H: DMatrix<f64>,
    /// Distribution of what comes from outside.
    pub D: DMatrix<f64>,
    /// For each column of `D` the state of the whole plant that it multiplies, from zero; numbers from the number of
    /// states on are the plant's unknown inputs.
    pub sources: Vec<usize>,
    /// Number of states of the whole plant.
    pub states_of_plant: usize,
    /// The first of its states in the whole plant, from zero.
    pub first_state: usize,
}

/// A plant that cannot be cut into subsystems.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum CutError {
    /// There is no partition.
    #[error("the plant has no partition: say how many states, equations and outputs each subsystem has")]
    NoPartition,
    /// The partition does not fit.
    #[error(transparent)]
    Partition(#[from] PartitionError),
    /// A subsystem without states or equations.
    #[error(
        "subsystem {number} ({name}) has no {what}: give it at least one, or remove it from the partition"
    )]
    Empty {
        /// Number of the subsystem, from one.
        number: usize,
        /// Its name.
        name: String,
        /// States or equations.
        what: &'static str,
    },
    /// The plant's unknown input acts on an output.
    #[error(
        "F[{}, {}] is not zero: the outputs of paper 000 are z_i = H_i x_i, without unknown input; set F to zero",
        row + 1,
        column + 1
    )]
    Feedthrough {
        /// Row of the entry, from zero.
        row: usize,
        /// Column of the entry, from zero.
        column: usize,
    },
}

/// Cuts a plant into its subsystems.
///
/// # Errors
/// [`CutError`]: a partition that is missing, does not fit or has an empty subsystem, or a feedthrough of an unknown
/// input.
///
/// # Source
/// Paper 000, section III.
pub fn local_problems(model: &Model) -> Result<Vec<LocalProblem>, CutError> {
    let Model { system, partition, .. } = model;
    if partition.is_empty() {
        return Err(CutError::NoPartition);
    }
    check_partition(system, partition)?;
    for (index, part) in partition.iter().enumerate() {
        for (what, count) in [("states", part.states), ("equations", part.equations)] {
            if count == 0 {
                return Err(CutError::Empty { number: index + 1, name: part.name.clone(), what });
            }
        }
    }
    if let Some(at) = system.F.iter().position(|x| *x != 0.0) {
        let rows = system.F.nrows();
        return Err(CutError::Feedthrough { row: at % rows, column: at / rows });
    }
    let (mut row, mut state, mut output) = (0, 0, 0);
    let mut result = Vec::with_capacity(partition.len());
    for part in partition {
        let place = Place {
            name: &part.name,
            rows: (row, part.equations),
            states: (state, part.states),
            outputs: (output, part.outputs),
        };
        result.push(cut(system, &place));
        row += part.equations;
        state += part.states;
        output += part.outputs;
    }
    Ok(result)
}

/// First index and number of a subsystem's equations, states and outputs.
struct Place<'a> {
    name: &'a str,
    rows: (usize, usize),
    states: (usize, usize),
    outputs: (usize, usize),
}

fn cut(system: &DescriptorSystem, place: &Place<'_>) -> LocalProblem {
    let DescriptorSystem { time, E, A, B, C, D, .. } = system;
    let (rows, states, n) = (place.rows, place.states, system.n_states());
    let own = states.0..states.0 + states.1;
    let coupling = |j: usize| if j < n { A.column(j) } else { D.column(j - n) };
    let acts = |j: &usize| coupling(*j).rows(rows.0, rows.1).iter().any(|x| *x != 0.0);
    let sources: Vec<usize> =
        (0..n + system.n_unknown_inputs()).filter(|j| !own.contains(j)).filter(acts).collect();
    let D_i = DMatrix::from_fn(rows.1, sources.len(), |i, j| coupling(sources[j])[rows.0 + i]);
    let block = |matrix: &DMatrix<f64>, rows: (usize, usize), columns: (usize, usize)| {
        matrix.view((rows.0, columns.0), (rows.1, columns.1)).into_owned()
    };
    LocalProblem {
        name: place.name.to_owned(),
        time: *time,
        E: block(E, rows, states),
        A: block(A, rows, states),
        B: B.rows(rows.0, rows.1).into_owned(),
        H: block(C, place.outputs, states),
        D: D_i,
        sources,
        states_of_plant: n,
        first_state: states.0,
    }
}

impl LocalProblem {
    /// Number of its states.
    pub fn n_states(&self) -> usize {
        self.E.ncols()
    }

    /// Whether it is a difference equation.
    pub fn is_discrete(&self) -> bool {
        self.time == TimeDomain::Discrete
    }

    /// The name of a source: `x4` for a state of the plant, `d1` for an unknown input.
    pub fn source_name(&self, source: usize) -> String {
        match source.checked_sub(self.states_of_plant) {
            None => format!("x{}", source + 1),
            Some(input) => format!("d{}", input + 1),
        }
    }

    /// The subsystem alone, without what comes from outside.
    pub fn uncoupled(&self) -> DescriptorSystem {
        let Self { time, E, A, B, H, .. } = self;
        DescriptorSystem {
            time: *time,
            E: E.clone(),
            A: A.clone(),
            B: B.clone(),
            C: H.clone(),
            D: DMatrix::zeros(E.nrows(), 0),
            F: DMatrix::zeros(H.nrows(), 0),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::system::Subsystem;
    use nalgebra::dmatrix;

    fn part(name: &str, states: usize, outputs: usize) -> Subsystem {
        Subsystem { name: name.to_owned(), states, equations: states, outputs }
    }

    /// Three states; the second subsystem sees x1 but not x2.
    fn model() -> Model {
        let A = dmatrix![-1.0, 0.0, 7.0; 0.0, -2.0, 0.0; 5.0, 0.0, -3.0];
        let C = dmatrix![1.0, 0.0, 0.0; 0.0, 0.0, 1.0];
        let system = DescriptorSystem::autonomous(DMatrix::identity(3, 3), A, C).unwrap();
        Model { partition: vec![part("a", 2, 1), part("b", 1, 1)], ..Model::from(system) }
    }

    #[test]
    fn couplings_become_unknown_inputs_and_zero_columns_are_left_out() {
        let found = local_problems(&model()).unwrap();
        assert_eq!(found[0].D, dmatrix![7.0; 0.0], "x3 acts on the first equation of a");
        assert_eq!((&found[0].sources, &found[1].sources), (&vec![2], &vec![0]), "x2 does not act on b");
        assert_eq!(found[1].A, dmatrix![-3.0], "own block");
        assert_eq!((found[1].H.shape(), found[1].first_state), ((1, 1), 2), "own output and place");
    }

    #[test]
    fn an_unknown_input_is_one_more_column() {
        let mut model = model();
        model.system.D = dmatrix![0.0; 0.0; 9.0];
        model.system.F = DMatrix::zeros(2, 1);
        let found = local_problems(&model).unwrap();
        assert_eq!(found[1].sources, [0, 3], "x1 and d1");
        assert_eq!(found[1].source_name(3), "d1", "named as an input");
        assert!(found[0].sources == [2], "d1 does not act on a");
        model.system.F[(1, 0)] = 1.0;
        let error = local_problems(&model).unwrap_err();
        assert!(error.to_string().starts_with("F[2, 1] is not zero"), "{error}");
    }

    #[test]
    fn partitions_that_do_not_fit_are_named() {
        let mut model = model();
        model.partition[1].name = "b".to_owned();
        model.partition.push(part("c", 0, 0));
        let error = local_problems(&model).unwrap_err();
        assert!(error.to_string().starts_with("subsystem 3 (c) has no states"), "{error}");
        model.partition.clear();
        assert_eq!(local_problems(&model), Err(CutError::NoPartition), "nothing to cut");
        model.partition = vec![part("a", 2, 1), part("b", 1, 2)];
        assert!(
            matches!(local_problems(&model), Err(CutError::Partition(_))),
            "three outputs are asked, two there"
        );
    }
}
