//! Condition (A3): the invariant zeros are stable, decided at exact finite points.

use nalgebra::{DMatrix, DVector};

use super::{Ask, condition};
use crate::numerics::{
    Complex64, ModePosition, PbhMode, StabilityRegion, Tolerance, observable_quotient, side_by_side,
};
use crate::observer::input_decoupled::{Coordinates, Reduction, general_reduction, paper_reduction};
use crate::observer::proportional_integral::single_sensors;
use crate::observer::{Condition, Evidence, PointEvidence, Verdict, Witness, show};
use crate::system::properties::{ModeCondition, PropertyError, r_detectability};
use crate::system::{DescriptorSystem, TimeDomain};

impl Ask<'_> {
    /// (A3), on the paper's pair, on the general pair, or without (A2) on the rectangular pencil itself.
    ///
    /// ```text
    /// rank [A - s E, D; C, F] = (n - r + q) + rank [s I - A~1; Z' C_bar1]          given (A1), (A2)
    /// ```
    pub(super) fn condition_a3(
        &self,
        paper_pair: bool,
        second_holds: bool,
    ) -> Result<Condition, PropertyError> {
        let formula = match self.system.time {
            TimeDomain::Continuous => "rank [A-sE D; C F] = n + p for all Re s >= 0",
            TimeDomain::Discrete => "rank [A-zE D; C F] = n + p for all |z| >= 1",
        };
        let mut result = condition("(A3)", "stable invariant zeros", formula);
        if second_holds {
            let (reduction, of) = if paper_pair {
                (paper_reduction(&self.at, self.tolerance)?, "(A~1, Z'C_bar1)")
            } else {
                (general_reduction(&self.at, self.tolerance)?, "(A, C) of the general form")
            };
            self.fill_pair(&mut result, &reduction, of)?;
        } else {
            let found = r_detectability(&with_inputs_as_states(self.system), self.tolerance)?;
            self.fill_pencil(&mut result, &found);
        }
        if !result.verdict.holds() {
            result.remedies = single_sensors(self.system, |extended| stable_zeros(extended, self.tolerance))?;
        }
        Ok(result)
    }

    fn fill_pair(&self, result: &mut Condition, pair: &Reduction, of: &str) -> Result<(), PropertyError> {
        let zeros = Zeros::of(self.system.time, pair, self.tolerance)?;
        let bad = zeros.bad();
        result.verdict = Verdict::of(bad.is_none(), zeros.near());
        let hidden: Vec<&PbhMode> = zeros.modes.iter().filter(|m| m.unobservable).collect();
        result.summary = match (bad, hidden.len()) {
            (Some((_, worst)), _) => {
                let place = if zeros.region.contains(worst, -zeros.margin) {
                    "on the boundary of stability, which counts as not stable"
                } else {
                    "not stable"
                };
                format!("the invariant zero {} is {place}", show(worst))
            }
            (None, 0) => {
                let closest = zeros.modes.iter().map(|m| m.distance).fold(f64::INFINITY, f64::min);
                if zeros.modes.is_empty() {
                    "no invariant zeros: there are no dynamics".to_owned()
                } else {
                    format!("no invariant zeros: every pole can be placed (closest distance {closest:.2e})")
                }
            }
            (None, _) => {
                let listed: Vec<String> = hidden.iter().map(|m| show(m.value)).collect();
                format!("invariant zeros {}, all stable: they stay in the error dynamics", listed.join(", "))
            }
        };
        let points = zeros.modes.iter().map(|m| PointEvidence {
            s: m.value,
            multiplicity: m.multiplicity,
            distance: m.distance,
            loses_rank: m.unobservable,
            stable: zeros.position(m, zeros.margin) == ModePosition::Stable,
        });
        result.evidence.push(Evidence::Points { of: of.to_owned(), points: points.collect() });
        result.witness = bad.map(|(zero, _)| Witness {
            s: Some(zero.value),
            direction: lifted(&self.at, pair, &zero.direction),
            coordinates: self.coordinate_names(),
        });
        Ok(())
    }

    /// Where (A2) fails there is no pair; the pencil still has exact finite points.
    fn fill_pencil(&self, result: &mut Condition, found: &ModeCondition) {
        result.decide_on_modes(found, "[A-sE D; C F]", self.coordinate_names(), |_| {
            "every invariant zero is stable".to_owned()
        });
    }
}

/// The modes of a pair, of which the unobservable ones are the invariant zeros of the system.
struct Zeros {
    modes: Vec<PbhMode>,
    /// The eigenvalues on the unobservable subspace, one by one: the members of the unobservable modes.
    hidden: Vec<Complex64>,
    region: StabilityRegion,
    margin: f64,
    limit: f64,
    gap: f64,
    /// What of the output counts could be rounding, or the other way round.
    faint: bool,
}

impl Zeros {
    fn of(time: TimeDomain, pair: &Reduction, tolerance: &Tolerance) -> Result<Self, PropertyError> {
        let region = StabilityRegion::of(time == TimeDomain::Discrete);
        let (output, _) = pair.output_in_unit_of_state();
        let found = observable_quotient(&pair.A, &output, tolerance)?;
        Ok(Self {
            modes: found.modes,
            hidden: found.fixed_modes,
            region,
            margin: region.margin(pair.A.norm().max(1.0), tolerance),
            limit: tolerance.mode,
            gap: tolerance.gap,
            faint: pair.rank.fragile,
        })
    }

    /// The invariant zeros that an unobservable mode stands for: those to which no other one is closer.
    fn members(&self, mode: &PbhMode) -> Vec<Complex64> {
        let unseen = || self.modes.iter().filter(|m| m.unobservable).map(|m| m.value);
        let belongs =
            |zero: &Complex64| unseen().all(|other| (zero - mode.value).norm() <= (zero - other).norm());
        self.hidden.iter().copied().filter(belongs).collect()
    }

    /// Where a mode lies; an unobservable one is stable only when every member is.
    fn position(&self, mode: &PbhMode, margin: f64) -> ModePosition {
        let members = if mode.unobservable { self.members(mode) } else { Vec::new() };
        self.region.position(mode.value, &members, margin)
    }

    /// A zero that is not stable, and its member farthest outside.
    fn bad(&self) -> Option<(&PbhMode, Complex64)> {
        let unstable = |m: &&PbhMode| m.unobservable && self.position(m, self.margin) != ModePosition::Stable;
        let mode = self.modes.iter().find(unstable)?;
        let farther = |worst: Complex64, z: Complex64| {
            if self.region.excess(z) > self.region.excess(worst) { z } else { worst }
        };
        Some((mode, self.members(mode).into_iter().fold(mode.value, farther)))
    }

    /// Whether a small change of the data could tip the verdict: a mode that is not stable is hardly seen, a zero is hardly
    /// stable, or the output is hardly more than rounding.
    fn near(&self) -> bool {
        let hardly_seen = self.modes.iter().any(|m| {
            let ratio = m.distance / self.limit;
            ratio > 1.0 && ratio < self.gap && !self.region.contains(m.value, self.margin)
        });
        let unseen = self.modes.iter().filter(|m| m.unobservable);
        let positions = unseen.map(|m| self.position(m, self.margin * self.gap));
        let seen_by_a_hair = self.faint
            && self.modes.iter().any(|m| !m.unobservable && !self.region.contains(m.value, self.margin));
        hardly_seen || seen_by_a_hair || ModePosition::hang_on_the_boundary(positions)
    }
}

/// Whether (A2) and (A3) hold, for trying further sensors.
fn stable_zeros(system: &DescriptorSystem, tolerance: &Tolerance) -> Result<bool, PropertyError> {
    let ask = Ask::new(system, tolerance)?;
    if ask.joint_rank()?.rank < ask.n_unknown() {
        return Ok(false);
    }
    let pair = general_reduction(&ask.at, tolerance)?;
    Ok(Zeros::of(system.time, &pair, tolerance)?.bad().is_none())
}

/// The direction `(x, d)` of an invariant zero that belongs to a direction of `x1`; its largest entry is one.
///
/// ```text
/// (A - s E) x + D d = 0,   C x + F d = 0:   x = N [I; R1x] x1,   d = R1d x1
/// ```
fn lifted(at: &Coordinates, pair: &Reduction, x1: &[Complex64]) -> Vec<Complex64> {
    let complex = |m: DMatrix<f64>| m.map(Complex64::from);
    let x1 = DVector::from_column_slice(x1);
    let x2 = at.N2.ncols();
    let states = complex(&at.N1 + &at.N2 * pair.R1.rows(0, x2)) * &x1;
    let inputs = complex(pair.R1.rows(x2, pair.R1.nrows() - x2).into_owned()) * &x1;
    let all: Vec<Complex64> = states.iter().chain(inputs.iter()).copied().collect();
    let largest = all.iter().copied().fold(Complex64::ZERO, |l, z| if z.norm() > l.norm() { z } else { l });
    if largest.norm() == 0.0 { all } else { all.into_iter().map(|z| z / largest).collect() }
}

/// The system whose states are `[x; d]`, so that its unobservable modes are the invariant zeros.
fn with_inputs_as_states(system: &DescriptorSystem) -> DescriptorSystem {
    let DescriptorSystem { time, E, A, C, D, F, .. } = system;
    let (e, p, q) = (E.nrows(), C.nrows(), D.ncols());
    DescriptorSystem {
        time: *time,
        E: side_by_side(&[E, &DMatrix::zeros(e, q)]),
        A: side_by_side(&[A, D]),
        B: DMatrix::zeros(e, 0),
        C: side_by_side(&[C, F]),
        D: DMatrix::zeros(e, 0),
        F: DMatrix::zeros(p, 0),
    }
}
