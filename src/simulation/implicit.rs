//! Equations of the evaluator that are solved by iteration.

use nalgebra::DMatrix;

use super::Observed;
use super::evaluator::{Evaluator, Trouble, place};
use super::newton::newton;
use super::plant::Nonlinear;

impl Evaluator<'_> {
    /// `U2' (A x + forcing + G f(t, x)) = 0` for `x = V1 xi + V2 eta`.
    pub(super) fn solve_implicit(&mut self, t: f64, nonlinear: &Nonlinear) -> Result<(), Trouble> {
        let (plant, term) = (self.joint.plant, &nonlinear.term);
        let rest = self.x.clone();
        let (mut x, mut all) = (rest.clone(), self.forcing.clone());
        let mut f = self.f.clone();
        let mut slopes = DMatrix::zeros(f.len(), x.len());
        let mut direction = vec![0.0; x.len()];
        let a22 = &plant.algebraic_rows * self.frozen.a() * &plant.algebraic_columns;
        let (point, forcing, frozen) = (&mut self.point, &self.forcing, &self.frozen);
        let mut eta = self.anchor.clone();
        let size = rest.amax().max(eta.amax());
        let sign = newton(&mut eta, size, &mut |eta, residual, jacobian| {
            x.copy_from(&rest);
            x.gemv(1.0, &plant.algebraic_columns, eta, 1.0);
            place(point, &x, t);
            term.value_into(point, f.as_mut_slice());
            term.jacobian_into(point, &mut direction, &mut slopes);
            all.copy_from(forcing);
            all.gemv(1.0, frozen.a(), &x, 1.0);
            residual.gemv(1.0, &plant.algebraic_rows, &all, 0.0);
            residual.gemv(1.0, &nonlinear.weights, &f, 1.0);
            jacobian.copy_from(&a22);
            *jacobian += &nonlinear.weights * (&slopes * &plant.algebraic_columns);
            residual.iter().chain(jacobian.iter()).all(|x| x.is_finite())
        });
        let sign = sign.filter(|sign| self.accepted_sign.is_none_or(|accepted| accepted == *sign));
        self.sign = Some(sign.ok_or(Trouble::Algebraic { t })?);
        self.x.copy_from(&rest);
        self.x.gemv(1.0, &plant.algebraic_columns, &eta, 1.0);
        self.eta = eta;
        Ok(())
    }

    /// The estimate from what does not depend on it.
    pub(super) fn solve_estimate(&mut self, t: f64, i: usize) -> Result<(), Trouble> {
        let Observed { injection, .. } = self.joint.observers[i];
        let own = &mut self.estimates[i];
        own.x_hat.copy_from(&own.open);
        let (Some(injection), Some(nonlinear)) = (injection, &self.joint.plant.nonlinear) else {
            return Ok(());
        };
        let (term, point) = (&nonlinear.term, &mut self.point);
        place(point, &own.open, t);
        term.value_into(point, own.f.as_mut_slice());
        if own.implicit {
            let mut slopes = DMatrix::zeros(own.f.len(), own.open.len());
            let mut direction = vec![0.0; own.open.len()];
            let mut f = own.anchor.clone().unwrap_or_else(|| own.f.clone());
            let size = f.amax().max(f64::MIN_POSITIVE);
            let (open, x_hat, value) = (&own.open, &mut own.x_hat, &mut own.f);
            // f - f(t, open + M f) = 0
            let solved = newton(&mut f, size, &mut |f, residual, jacobian| {
                x_hat.copy_from(open);
                x_hat.gemv(1.0, &injection.estimate, f, 1.0);
                place(point, x_hat, t);
                term.value_into(point, value.as_mut_slice());
                term.jacobian_into(point, &mut direction, &mut slopes);
                residual.copy_from(f);
                *residual -= &*value;
                jacobian.fill_with_identity();
                jacobian.gemm(-1.0, &slopes, &injection.estimate, 1.0);
                residual.iter().chain(jacobian.iter()).all(|x| x.is_finite())
            });
            solved.ok_or(Trouble::Estimate { t, observer: i })?;
            own.f = f;
            own.x_hat.copy_from(&own.open);
        }
        own.x_hat.gemv(1.0, &injection.estimate, &own.f, 1.0);
        if own.f.iter().any(|f| !f.is_finite()) {
            return Err(Trouble::Nonlinearity { t, x: own.x_hat.iter().copied().collect() });
        }
        Ok(())
    }
}
