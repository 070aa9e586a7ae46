//! Constant coefficients multiplied out once, so that an evaluation is a few small products.

use nalgebra::DMatrix;

use super::Observed;
use super::evaluator::{Evaluator, Trouble};
use super::joint::Joint;
use crate::numerics::{side_by_side, stack};

/// Products for a plant with constant coefficients whose algebraic equations are linear in the algebraic states.
///
/// ```text
/// [x; y; xi'] = plant * [xi; u; d; f],   f = f(t, seen * [xi; u; d; 0])
/// [x_hat; z'] = linear * [z; y; u] + injection * f(t, x_hat)     for each observer
/// ```
#[derive(Clone, Debug)]
pub(super) struct Direct {
    seen: DMatrix<f64>,
    plant: DMatrix<f64>,
    observers: Vec<DMatrix<f64>>,
    right: Vec<f64>,
    left: Vec<f64>,
}

impl Direct {
    /// Multiplies out; none where coefficients vary or the algebraic equations are implicit.
    pub(super) fn new(joint: &Joint<'_>) -> Option<Self> {
        let (plant, system) = (joint.plant, joint.plant.system());
        if plant.varies() || plant.is_implicit() {
            return None;
        }
        let (n, r) = (system.n_states(), plant.order());
        let weights = plant.nonlinear.as_ref().map(|nonlinear| &nonlinear.term.G);
        let none = DMatrix::zeros(n, 0);
        // forcing Q [xi; u; d; f]
        let q = side_by_side(&[&DMatrix::zeros(n, r), &system.B, &system.D, weights.unwrap_or(&none)]);
        let columns = q.ncols();
        let mut x = DMatrix::zeros(n, columns);
        x.columns_mut(0, r).copy_from(plant.differential_columns());
        let before = x.clone();
        if plant.algebraic_rows.nrows() > 0 {
            // V2 eta = -V2 A22^-1 U2' (A V1 xi + Q ...)
            let rows = &plant.algebraic_rows * (&system.A * &x + &q);
            let a22 = &plant.algebraic_rows * &system.A * &plant.algebraic_columns;
            x -= &plant.algebraic_columns * a22.lu().solve(&rows)?;
        }
        let mut y = &system.C * &x;
        let from_d = r + system.n_inputs();
        let mut part = y.columns_mut(from_d, system.n_unknown_inputs());
        part += &system.F;
        let rate = plant.differential_rows() * (&system.A * &x + q);
        let enters = plant.nonlinear.as_ref().is_some_and(|nonlinear| nonlinear.enters);
        let observers = joint.observers.iter().map(|Observed { observer, .. }| {
            let upper = side_by_side(&[&observer.P, &observer.V, &observer.W]);
            stack(&[&upper, &side_by_side(&[&observer.N, &observer.L, &observer.H])])
        });
        Some(Self {
            // where f enters the algebraic equations it uses no algebraic state
            seen: if enters { before } else { x.clone() },
            plant: stack(&[&x, &y, &rate]),
            observers: observers.collect(),
            right: Vec::with_capacity(columns),
            left: Vec::new(),
        })
    }
}

impl Evaluator<'_> {
    /// As [`Self::evaluate_given`], by the products.
    pub(super) fn evaluate_directly(
        &mut self,
        direct: &mut Direct,
        t: f64,
        w: &[f64],
    ) -> Result<(), Trouble> {
        let joint = self.joint;
        let (r, n, p) = (joint.plant.order(), self.x.len(), self.y.len());
        let Direct { seen, plant, observers, right, left } = direct;
        right.clear();
        right.extend_from_slice(&w[..r]);
        right.extend(self.values.u.iter().chain(self.values.d.iter()));
        if let Some(nonlinear) = &joint.plant.nonlinear {
            multiply(seen, right, self.x.as_mut_slice());
            self.value(t, nonlinear)?;
            right.extend(self.f.iter());
        }
        left.resize(plant.nrows(), 0.0);
        multiply(plant, right, left);
        self.x.copy_from_slice(&left[..n]);
        self.y.copy_from_slice(&left[n..n + p]);
        self.y += &self.values.v;
        self.derivative.as_mut_slice()[..r].copy_from_slice(&left[n + p..]);
        let mut top = r;
        for (i, linear) in observers.iter().enumerate() {
            let Observed { observer, injection } = joint.observers[i];
            let order = observer.order();
            right.clear();
            right.extend_from_slice(&w[top..top + order]);
            right.extend(self.y.iter().chain(self.values.u.iter()));
            left.resize(linear.nrows(), 0.0);
            multiply(linear, right, left);
            self.estimates[i].open.copy_from_slice(&left[..n]);
            self.solve_estimate(t, i)?;
            let own = &mut self.derivative.as_mut_slice()[top..top + order];
            own.copy_from_slice(&left[n..]);
            if let Some(injection) = injection {
                for (column, f) in injection.state.column_iter().zip(self.estimates[i].f.iter()) {
                    own.iter_mut().zip(column.iter()).for_each(|(own, weight)| *own += weight * f);
                }
            }
            top += order;
        }
        Ok(())
    }
}

/// `out = matrix * right`, where `right` may be shorter than the matrix is wide: the rest counts as zero.
fn multiply(matrix: &DMatrix<f64>, right: &[f64], out: &mut [f64]) {
    out.fill(0.0);
    let rows = out.len();
    if rows == 0 {
        return;
    }
    for (column, factor) in matrix.as_slice().chunks_exact(rows).zip(right) {
        for (out, x) in out.iter_mut().zip(column) {
            *out += factor * x;
        }
    }
}
