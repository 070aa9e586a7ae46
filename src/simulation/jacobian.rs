//! The derivative of all equations with respect to the joint state.

use nalgebra::DMatrix;

use super::Observed;
use super::evaluator::Evaluator;

impl Evaluator<'_> {
    /// Writes `dF/dw` at an instant; false where it does not exist.
    ///
    /// ```text
    /// A_x  = A + G df/dx,   X = dx/dxi = V1 - (U2' A_x V2)^-1 U2' A_x V1,   dxi'/dxi = S^-1 U1' A_x X
    /// x_hat = c + M f(x_hat),   K = df/dx at x_hat:   df(x_hat)/dw = (I - K M)^-1 K dc/dw,   dc/dw = [V C X, P]
    /// ```
    pub(super) fn jacobian(&mut self, t: f64, w: &[f64], out: &mut DMatrix<f64>) -> bool {
        if !self.evaluate(t, w) {
            return false;
        }
        let joint = self.joint;
        let (plant, system) = (joint.plant, joint.plant.system());
        let mut a_x = self.a().clone();
        if let Some(nonlinear) = &plant.nonlinear {
            a_x += &nonlinear.term.G * self.slopes(t, None);
        }
        let mut x = plant.differential_columns().clone();
        if plant.algebraic_rows.nrows() > 0 {
            let rows = &plant.algebraic_rows * &a_x;
            let Some(eta) = (&rows * &plant.algebraic_columns).lu().solve(&(rows * &x)) else { return false };
            x -= &plant.algebraic_columns * eta;
        }
        let r = plant.order();
        out.fill(0.0);
        out.view_mut((0, 0), (r, r)).copy_from(&(plant.differential_rows() * a_x * &x));
        let y = &system.C * x;
        let mut top = r;
        for (i, Observed { observer, injection }) in joint.observers.iter().enumerate() {
            let order = observer.order();
            let mut from_x = &observer.L * &y;
            let mut from_z = observer.N.clone();
            if let Some(injection) = injection {
                let k = self.slopes(t, Some(i));
                let mut factor = DMatrix::identity(k.nrows(), k.nrows());
                factor -= &k * &injection.estimate;
                let Some(k) = factor.lu().solve(&k) else { return false };
                let into = &injection.state * k;
                from_x += &into * (&observer.V * &y);
                from_z += into * &observer.P;
            }
            out.view_mut((top, 0), (order, r)).copy_from(&from_x);
            out.view_mut((top, top), (order, order)).copy_from(&from_z);
            top += order;
        }
        out.iter().all(|x| x.is_finite())
    }

    /// The largest factor by which the fixed point iteration of an observer's output equation stretches a difference,
    /// the spectral norm of `df/dx M` at the last estimate; none when the equation is explicit.
    pub(super) fn contraction(&mut self, t: f64, i: usize) -> Option<f64> {
        if !self.estimates[i].implicit {
            return None;
        }
        let injection = self.joint.observers[i].injection?;
        let stretch = self.slopes(t, Some(i)) * &injection.estimate;
        let singular_values = crate::numerics::svd(&stretch).ok()?.s;
        singular_values.first().copied()
    }
}
