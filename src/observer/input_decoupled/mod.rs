//! Input-decoupled observer of state and unknown input for non-square descriptor systems (paper 001).
//!
//! | paper | program | shape | meaning |
//! |---|---|---|---|
//! | E, A, B, C, D, F | the same of [`crate::system::DescriptorSystem`] | m x n, m x n, m x k, q x n, m x p, q x p | the system |
//! | m, n, k, q, p | e, n, k, p, q | | equations, states, known inputs, outputs, unknown inputs |
//! | x, u, y, d | x, u, y, d | n, k, q, p | state, known input, output, unknown input |
//! | N, x1, x2 | [`Coordinates`] | n x n, r, n - r | coordinates in which `E` is `diag(I_r, 0)`, `x = N [x1; x2]` |
//! | `A~1`, `B~1`, `W1 W2+`, R1, R2, R3 | `A`, `B`, `Y`, `R1`, `R2`, `R3` of [`Reduction`] | | reduced system (6) |
//! | `C~1`, `B~2` | `Z C`, `-Z U_out` with `Z = Y_out'` of [`Reduction`] | q x r, q x k | output of (6), with its redundant rows |
//! | L | [`NamedMatrix`] `L` | r x q | gain; only `L (I - W2 W2+)` has an effect |
//! | z, H, J2, J1, K, T2, T1, G, Q2, Q1 | z, `N`, `L`, `H`, `P`, `V`, `W`, `Q`, `R`, `S` of [`super::LinearObserver`] | | observer of Theorem 2 |
//!
//! The unknown input is estimated algebraically, without an integrator: errors are `K e^(H t) e0` and `G e^(H t) e0`
//! whatever `d(t)` and the free states of a wide plant do. In discrete time the same matrices serve with `H^k` in place
//! of `e^(H t)`, since nothing in the reduction is differentiated.
//!
//! [`Order::Full`] is the paper's observer of order rank E. [`Order::General`] has the same order and does not need
//! (A1); it is not in the paper.
//!
//! Source: paper 001, "Input-decoupled observer design for linear descriptor systems with unknown inputs".
#![expect(non_snake_case, reason = "matrix letters follow paper 001")]

mod conditions;
mod coordinates;
mod decoupling;
mod noise;
mod realize;
mod reduction;

use super::design::needed;
use nalgebra::DMatrix;

pub use conditions::conditions;
pub use coordinates::{Coordinates, coordinates};
pub use decoupling::verify_decoupled;
pub use reduction::{Reduction, general_reduction, paper_reduction};

use super::proportional_integral::{PoleRequest, notes as notes_on_placement};
use super::{Condition, Design, DesignChoice, DesignError, NamedMatrix, Order, Synthesis};
use crate::numerics::{Complex64, Placement, Tolerance, side_by_side, stack};
use crate::system::{Model, TimeDomain};
use realize::{Theorem2, claim};

/// Designs the input-decoupled observer of order rank E.
///
/// The poles are placed on the compressed pair `(A~1, Z' C_bar1)`; with the paper's gain `L = Lc Z'` the error obeys
/// `e' = (A~1 - L C~1) e`.
///
/// # Errors
/// The first needed condition that fails, poles that do not fit, data that the method cannot use, or a decomposition
/// that fails its check.
///
/// # Source
/// Paper 001, Theorems 1 and 2; [`Order::General`] is the generalisation described at [`general_reduction`].
pub fn design(
    model: &Model,
    choice: &DesignChoice,
    conditions: &[Condition],
    tolerance: &Tolerance,
) -> Result<Design, DesignError> {
    let system = &model.system;
    let general = is_general(choice.order)?;
    if model.lipschitz.is_some() {
        return Err(DesignError::Unsuitable(
            "the input-decoupled observer does not take a Lipschitz term: choose the H-infinity observer, or remove the \
             term to design for the linear part"
                .to_owned(),
        ));
    }
    needed(conditions)?;
    let at = coordinates(system, tolerance)?;
    let reduction =
        if general { general_reduction(&at, tolerance)? } else { paper_reduction(&at, tolerance)? };
    let request = PoleRequest { choice, discrete: system.time == TimeDomain::Discrete, tolerance };
    let (output, unit) = reduction.output_in_unit_of_state();
    let mut placement = request.place(&reduction.A, &output)?;
    placement.gain *= unit;
    let theorem = Theorem2::new(&at, &reduction, &placement.gain);
    let observer = theorem.observer();
    let claim = claim(&at, &reduction, &placement.gain);
    let expected: Vec<Complex64> =
        placement.requested.iter().chain(&placement.fixed_modes).copied().collect();
    let verification = verify_decoupled(system, &observer, &claim, &expected, tolerance)?;
    let mut notes = notes_on_placement(choice, &placement, system.time);
    notes.extend(notes_on_shape(&at, &reduction, &placement, general));
    let form = if general { "general form" } else { "order rank E" };
    Ok(Design {
        title: format!("input-decoupled observer, {form} ({})", observer.order()),
        matrices: named(system.time, &at, reduction, theorem, &placement, general),
        observer,
        injection: None,
        hierarchical: None,
        claim: Some(claim),
        synthesis: Synthesis::Poles(Box::new(placement)),
        verification,
        notes,
    })
}

/// Whether the general form is asked for.
fn is_general(order: Order) -> Result<bool, DesignError> {
    match order {
        Order::Full => Ok(false),
        Order::General => Ok(true),
        Order::Reduced | Order::Minimal => Err(DesignError::Unsuitable(format!(
            "the input-decoupled observer has one order, rank E, and no {} order: choose full (the paper's observer) or \
             general (which does not need (A1))",
            order.key()
        ))),
    }
}

/// What is free in this design, and where it leaves the paper's assumptions.
fn notes_on_shape(
    at: &Coordinates,
    reduction: &Reduction,
    placement: &Placement,
    general: bool,
) -> Vec<String> {
    let (e, n, r) = (at.M1.ncols(), at.N1.nrows(), at.r());
    let mut notes = Vec::new();
    if r == 0 {
        notes.push("rank E = 0: every equation is algebraic, the estimate has no dynamics".to_owned());
    } else if r == e.min(n) {
        notes.push(format!(
            "rank E = {r}: the paper assumes 0 < rank E < min(m, n) = {}; its formulas hold here, too",
            e.min(n)
        ));
    }
    if placement.requested.is_empty() {
        return notes;
    }
    let gain = if general { "Lc" } else { "L" };
    let fixed = !placement.fixed_modes.is_empty();
    let outputs = match reduction.C.nrows() {
        1 => "one output is free of the unknown input".to_owned(),
        free => format!("{free} outputs are free of the unknown input"),
    };
    notes.push(if is_unique(reduction, placement) {
        let of_the_gain =
            if general { "" } else { "; of L only L (I - W2 W2+) has an effect, and that is determined" };
        format!("{outputs}: H, J1 and J2 are unique for these poles{of_the_gain}")
    } else if reduction.rank.rank == 1 && !fixed {
        format!(
            "{outputs}, all of them multiples of one: H is unique for these poles; {gain}, J1 and J2 are not; K, T1, T2, G, \
             Q1 and Q2 do not depend on the gain"
        )
    } else {
        let why = if reduction.rank.rank == 1 { ", but the fixed modes leave a choice" } else { "" };
        format!(
            "{outputs}{why}: {gain} is one of many gains with these poles; K, T1, T2, G, Q1 and Q2 do not depend on it"
        )
    });
    notes
}

/// Whether the poles determine `L (I - W2 W2+)`, and with it the observer: one output, and every mode follows it.
fn is_unique(reduction: &Reduction, placement: &Placement) -> bool {
    reduction.C.nrows() == 1 && reduction.rank.rank == 1 && placement.fixed_modes.is_empty()
}

/// The matrices under the paper's names.
fn named(
    time: TimeDomain,
    at: &Coordinates,
    reduction: Reduction,
    theorem: Theorem2,
    placement: &Placement,
    general: bool,
) -> Vec<NamedMatrix> {
    let Theorem2 { H, J1, J2, K, T1, T2, G, Q1, Q2 } = theorem;
    let Lc = &placement.gain;
    let [of_h, of_k, of_g] = match time {
        TimeDomain::Continuous => [
            "error dynamics, z' = H z + J1 u + J2 y",
            "z to the state estimate; the error is K e^(H t) e0",
            "z to the unknown-input estimate; the error is G e^(H t) e0",
        ],
        TimeDomain::Discrete => [
            "error dynamics, z[k+1] = H z + J1 u + J2 y",
            "z to the state estimate; the error is K H^k e0",
            "z to the unknown-input estimate; the error is G H^k e0",
        ],
    };
    let of_l = if is_unique(&reduction, placement) {
        "gain; only L (I - W2 W2+) is determined"
    } else {
        "gain; only L (I - W2 W2+) has an effect"
    };
    let mut all = vec![
        ("H", of_h, H),
        ("J1", "known input to z", J1),
        ("J2", "output to z", J2),
        ("K", of_k, K),
        ("T1", "known input to the state estimate", T1),
        ("T2", "output to the state estimate", T2),
        ("G", of_g, G),
        ("Q1", "known input to the unknown-input estimate", Q1),
        ("Q2", "output to the unknown-input estimate", Q2),
    ];
    if general {
        all.push(("Lc", "gain on the outputs that are free of the unknown input", Lc.clone()));
        all.push(("A_general", "state matrix of the pair whose poles are placed", reduction.A));
        all.push(("C_general", "output matrix of that pair", reduction.C));
    } else {
        let Z = reduction.Y_out.transpose();
        all.push(("L", of_l, Lc * &reduction.Y_out));
        all.push(("A_tilde", "state matrix of (6)", reduction.A));
        all.push(("B_tilde", "known input of (6)", reduction.B));
        all.push(("C_tilde", "output matrix of (6), (I - W2 W2+) C_bar1", &Z * reduction.C));
        all.push(("B2_tilde", "known input in the output of (6)", -(&Z * reduction.U_out)));
        all.push(("W1W2_pinv", "output injection of (6)", reduction.Y));
    }
    all.push(("M", "coordinates: M E N = diag(I, 0)", stack(&[&at.M1, &at.M2])));
    all.push(("N", "coordinates: x = N [x1; x2]", side_by_side(&[&at.N1, &at.N2])));
    let named = |(name, meaning, value): (&str, &str, DMatrix<f64>)| NamedMatrix {
        name: name.to_owned(),
        meaning: meaning.to_owned(),
        value,
    };
    all.into_iter().filter(|(_, _, value)| !value.is_empty()).map(named).collect()
}
