//! Proportional-integral observer for descriptor systems with unknown inputs (paper 004).
//!
//! | paper | program | shape | meaning |
//! |---|---|---|---|
//! | E*, A*, B*, C* | `E`, `A`, `B`, `C` of [`DescriptorSystem`] | e x n, e x n, e x k, p x n | the system as given |
//! | N* | `D` | e x nf | distribution of the unknown input |
//! | f | d | nf | unknown input |
//! | y* | y | p | measured output |
//! | E, A, B, N, C, y | [`Equivalent`] | r x n ... q x n | restricted system equivalent (4) |
//! | `z`, `f_hat` | z of [`LinearObserver`] | n + nf or r + nf | observer state, the estimate of f behind z |
//! | F, L1, L2, L3, J, M1, T1, T2 | [`NamedMatrix`] of the same name | | observer (5) |
//!
//! The paper is in continuous time with `f' = 0` for the design; in discrete time `f[k+1] = f[k]` takes its place
//! (`hold` = 1 instead of 0 in the integral row).
//!
//! Source: D. Koenig and S. Mammar, "Design of proportional-integral observer for unknown input descriptor systems",
//! IEEE Transactions on Automatic Control 47 (2002) 2057-2062.
#![expect(non_snake_case, reason = "matrix letters follow Koenig and Mammar 2002")]

mod conditions;
mod equivalent;
mod full_order;
mod general;
mod realize;
mod reduced_order;

use super::design::needed;
use nalgebra::DMatrix;

pub(super) use conditions::{advise_units, single_sensors};
pub use conditions::{conditions, ordinary_conditions};
pub use equivalent::{Alternative, Equivalent, choose_alternative, compressed, unchanged};
pub use full_order::left_inverse;
pub use general::{Augmented, augment};
pub use reduced_order::{Reduction, reduce};

use super::design::chosen_poles;
use super::{
    Claim, Condition, Design, DesignChoice, DesignError, LinearObserver, NamedMatrix, Order, Synthesis,
    verify,
};
use crate::numerics::Block::{Of, Zero};
use crate::numerics::{
    Complex64, NumericsError, Placement, PlacementOptions, Tolerance, block_matrix, observable_quotient,
    place_observer,
};
use crate::system::{DescriptorSystem, TimeDomain};

/// Why a plant without unknown inputs has no proportional-integral observer, and what to do.
pub(super) const NO_UNKNOWN_INPUT: &str = "the proportional-integral observer estimates an unknown input, but D has no \
                                           columns: add one, or choose the proportional observer";

/// Value of the integral row's diagonal: 0 for `f' = 0`, 1 for `f[k+1] = f[k]`.
fn hold(time: TimeDomain) -> f64 {
    match time {
        TimeDomain::Continuous => 0.0,
        TimeDomain::Discrete => 1.0,
    }
}

/// `([A N; 0 hold], [C 0])`.
fn augmented(
    A: &DMatrix<f64>,
    N: &DMatrix<f64>,
    C: &DMatrix<f64>,
    hold: f64,
) -> (DMatrix<f64>, DMatrix<f64>) {
    let nf = N.ncols();
    let corner = DMatrix::identity(nf, nf) * hold;
    let Aa = block_matrix(&[&[Of(A), Of(N)], &[Zero, Of(&corner)]]);
    let Ca = crate::numerics::side_by_side(&[C, &DMatrix::zeros(C.nrows(), nf)]);
    (Aa, Ca)
}

/// What a person asks of the spectrum.
pub(super) struct PoleRequest<'a> {
    /// The design that was chosen, with its poles.
    pub(super) choice: &'a DesignChoice,
    /// Whether the poles are those of difference equations.
    pub(super) discrete: bool,
    /// Thresholds of the fixed modes.
    pub(super) tolerance: &'a Tolerance,
}

impl PoleRequest<'_> {
    /// Places the first poles of the list on the observable part of the pair.
    pub(super) fn place(&self, A: &DMatrix<f64>, C: &DMatrix<f64>) -> Result<Placement, DesignError> {
        let free = observable_quotient(A, C, self.tolerance)?.basis.ncols();
        let poles = chosen_poles(&self.choice.poles, self.choice.scale, self.discrete, free)?;
        let options = PlacementOptions { seed: self.choice.seed, ..PlacementOptions::default() };
        Ok(place_observer(A, C, &poles, &options, self.tolerance)?)
    }
}

/// A designed observer before its verification.
struct Realized {
    matrices: Vec<NamedMatrix>,
    observer: LinearObserver,
    claim: Claim,
    placement: Placement,
}

fn named(m: realize::Matrices) -> Vec<NamedMatrix> {
    let realize::Matrices { F, L1, L2, L3, J, M1, T1, T2 } = m;
    let all = [
        ("F", "observer state matrix", F),
        ("L1", "output injection", L1),
        ("L2", "proportional gain, multiplies y", L2),
        ("L3", "integral gain", L3),
        ("J", "known input", J),
        ("M1", "observer state to state estimate", M1),
        ("T1", "what z tracks: T1 E x", T1),
        ("T2", "output to state estimate", T2),
    ];
    let named = |(name, meaning, value): (&str, &str, DMatrix<f64>)| NamedMatrix {
        name: name.to_owned(),
        meaning: meaning.to_owned(),
        value,
    };
    all.into_iter().filter(|(_, _, value)| value.nrows() > 0).map(named).collect()
}

/// Designs the proportional-integral observer of the chosen order.
///
/// # Errors
/// The first needed condition that fails, poles that do not fit, data that the method cannot use, or a decomposition
/// that fails its check.
///
/// # Source
/// Koenig and Mammar 2002, Algorithms 1 and 2; order `general` is the extension described at [`augment`].
pub fn design(
    system: &DescriptorSystem,
    choice: &DesignChoice,
    conditions: &[Condition],
    tolerance: &Tolerance,
) -> Result<Design, DesignError> {
    if system.n_unknown_inputs() == 0 {
        return Err(DesignError::Unsuitable(NO_UNKNOWN_INPUT.to_owned()));
    }
    let equivalent = match choice.order {
        Order::General => compressed(system, tolerance)?,
        Order::Full | Order::Reduced | Order::Minimal => restricted(system, tolerance)?,
    };
    finish("proportional-integral observer", system, &equivalent, choice, conditions, tolerance)
}

/// The equivalent (4) by the first alternative of (8) that holds.
fn restricted(system: &DescriptorSystem, tolerance: &Tolerance) -> Result<Equivalent, NumericsError> {
    match choose_alternative(system, tolerance)? {
        Some(Alternative::FullRowRank | Alternative::FullColumnRank) => Ok(unchanged(system)),
        Some(Alternative::UnknownInputInRange) | None => compressed(system, tolerance),
    }
}

/// Checks the needed conditions, designs on an equivalent and verifies; shared with the proportional observer.
pub(super) fn finish(
    method: &str,
    system: &DescriptorSystem,
    equivalent: &Equivalent,
    choice: &DesignChoice,
    conditions: &[Condition],
    tolerance: &Tolerance,
) -> Result<Design, DesignError> {
    needed(conditions)?;
    let hold = hold(system.time);
    let request = PoleRequest { choice, discrete: system.time == TimeDomain::Discrete, tolerance };
    let (order, realized) = match choice.order {
        Order::Full => ("full order", full_order::design(equivalent, hold, &request)?),
        Order::Reduced => ("reduced order", reduced_order::design(equivalent, hold, &request)?),
        Order::General => ("general form", general::design(equivalent, hold, &request)?),
        Order::Minimal => {
            return Err(DesignError::Unsuitable(format!(
                "the {method} has no minimal order: choose reduced or full"
            )));
        }
    };
    let Realized { matrices, observer, claim, placement } = realized;
    let expected: Vec<Complex64> =
        placement.requested.iter().chain(&placement.fixed_modes).copied().collect();
    let verification = verify(system, &observer, &claim, &expected, tolerance)?;
    let notes = notes(choice, &placement, system.time);
    let title = format!("{method}, {order} ({})", observer.order());
    let synthesis = Synthesis::Poles(Box::new(placement));
    Ok(Design {
        title,
        matrices,
        observer,
        injection: None,
        hierarchical: None,
        claim: Some(claim),
        synthesis,
        verification,
        notes,
    })
}

/// What a user should know of a placement.
pub(super) fn notes(choice: &DesignChoice, placement: &Placement, time: TimeDomain) -> Vec<String> {
    let mut notes: Vec<String> = placement.warnings.iter().map(ToString::to_string).collect();
    let (given, used) = (choice.poles.len(), placement.requested.len());
    if given > used {
        notes.push(format!("the first {used} of {given} poles are used by this order"));
    }
    if !placement.fixed_modes.is_empty() {
        let modes: Vec<String> = placement.fixed_modes.iter().map(|z| super::show(*z)).collect();
        notes.push(format!("fixed modes that no gain can move: {}", modes.join(", ")));
    }
    let region = crate::numerics::StabilityRegion::of(time == TimeDomain::Discrete);
    for pole in placement.requested.iter().filter(|z| region.excess(**z) >= 0.0 && z.im >= 0.0) {
        notes.push(format!(
            "the requested pole {} is not stable: the estimate will not converge",
            super::show(*pole)
        ));
    }
    notes
}
