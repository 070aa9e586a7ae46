//! Existence conditions (8)-(13), (22), (23) of paper 004, with their evidence.
#![expect(non_snake_case, reason = "matrix letters follow Koenig and Mammar 2002")]

use nalgebra::DMatrix;

use super::{
    Alternative, Equivalent, choose_alternative, compressed, full_order, hold, reduced_order, restricted,
};
use crate::numerics::Block::{Of, Zero};
use crate::numerics::{
    PbhMode, RankDecision, StabilityRegion, Tolerance, block_matrix, pbh_modes, rank, side_by_side, stack,
};
use crate::observer::{Condition, Evidence, Formula, Order, PointEvidence, Verdict, Witness};
use crate::system::properties::{ModeCondition, PropertyError, impulse_observability, r_detectability};
use crate::system::{DescriptorSystem, TimeDomain};

const PAPER: &str = "Koenig and Mammar 2002";

/// Existence conditions of the proportional-integral observer; `needed` marks those of the chosen order.
///
/// # Errors
/// When a decomposition fails its check.
///
/// # Source
/// Koenig and Mammar 2002, Theorems 1-5. Every condition "for all s" is decided at exact finite zeros.
pub fn conditions(
    system: &DescriptorSystem,
    order: Order,
    tolerance: &Tolerance,
) -> Result<Vec<Condition>, PropertyError> {
    let ask = Ask { system, tolerance };
    let paper_form = order != Order::General;
    let eight = ask.condition_8(paper_form)?;
    let exists = eight.verdict.holds();
    let mut result = vec![eight, ask.no_feedthrough(paper_form), ask.condition_9()?, ask.condition_10()?];
    if order == Order::General {
        return Ok(result);
    }
    if !exists {
        for (label, name) in [("(11)", "left inverse"), ("(13)", "observability of the design pair")] {
            result.push(undecided(
                label,
                name,
                "it is asked of the equivalent system (4), which (8) does not give",
            ));
        }
        return Ok(result);
    }
    let equivalent = restricted(system, tolerance)?;
    result.push(ask.condition_11(&equivalent)?);
    match order {
        Order::Full => result.push(ask.condition_13(&equivalent)?),
        Order::Reduced => result.extend(ask.conditions_22_23(&equivalent)?),
        Order::General => {}
    }
    Ok(result)
}

/// Existence conditions of an observer that estimates states alone: (9) and R-detectability.
///
/// # Errors
/// When a decomposition fails its check.
///
/// # Source
/// Darouach and Boutayeb 1995, Theorem 1; Koenig and Mammar 2002, Definitions 1 and 3.
pub fn ordinary_conditions(
    system: &DescriptorSystem,
    order: Order,
    tolerance: &Tolerance,
) -> Result<Vec<Condition>, PropertyError> {
    let ask = Ask { system, tolerance };
    let nine = ask.condition_9()?;
    let usable = nine.verdict.holds();
    let found = r_detectability(system, tolerance)?;
    let mut detectable = ask.detectability(&found);
    if !detectable.verdict.holds() {
        detectable.remedies = ask.sensors(|extended| Ok(r_detectability(extended, tolerance)?.holds()))?;
    }
    let mut result = vec![nine, detectable];
    if usable {
        let equivalent = compressed(system, tolerance)?;
        result.push(ask.condition_11(&equivalent)?);
        if order == Order::Reduced {
            result.extend(ask.conditions_22_23(&equivalent)?);
        }
    }
    Ok(result)
}

/// The system and the thresholds that all conditions ask about.
struct Ask<'a> {
    system: &'a DescriptorSystem,
    tolerance: &'a Tolerance,
}

/// The equation number without its brackets, as it stands in an identifier.
fn id(label: &str) -> String {
    format!("004-{}", label.trim_matches(['(', ')']))
}

fn condition(label: &str, name: &str, formula: &str) -> Condition {
    Condition {
        id: id(label),
        label: label.to_owned(),
        name: name.to_owned(),
        formula: Formula::parse(formula),
        source: format!("{PAPER}, equation {label}"),
        verdict: Verdict::Undecided,
        summary: String::new(),
        evidence: Vec::new(),
        witness: None,
        remedies: Vec::new(),
        needed: true,
    }
}

fn undecided(label: &str, name: &str, why: &str) -> Condition {
    Condition { summary: why.to_owned(), needed: true, ..condition(label, name, "") }
}

fn evidence(of: &str, decision: RankDecision, required: usize) -> Evidence {
    Evidence::Rank { of: of.to_owned(), decision, required }
}

impl Ask<'_> {
    /// Names `x1 ...` of the states, then `d1 ...` of the unknown inputs.
    fn coordinates(&self) -> Vec<String> {
        let states = (1..=self.system.n_states()).map(|i| format!("x{i}"));
        states.chain((1..=self.system.n_unknown_inputs()).map(|i| format!("d{i}"))).collect()
    }

    /// (8): one of three ranks, so that system (4) exists.
    // ERRATUM(004, section IV): "rank [E* N*; C* 0] = rank E*" in the example should read rank [E* N*] = rank E*.
    fn condition_8(&self, needed: bool) -> Result<Condition, PropertyError> {
        let DescriptorSystem { E, C, D, .. } = self.system;
        let (e, n) = E.shape();
        let of_e = rank(E, 0.0, self.tolerance)?;
        let of_ed = rank(&side_by_side(&[E, D]), 0.0, self.tolerance)?;
        let of_ec = rank(&stack(&[E, C]), 0.0, self.tolerance)?;
        let r = of_e.rank;
        let chosen = choose_alternative(self.system, self.tolerance)?;
        let fragile = of_e.fragile
            || match chosen {
                Some(Alternative::FullRowRank) => false,
                Some(Alternative::UnknownInputInRange) => of_ed.fragile,
                Some(Alternative::FullColumnRank) => of_ec.fragile,
                None => of_ed.fragile || of_ec.fragile,
            };
        let numbers = format!(
            "rank [E* N*] = {}, rank E* = {r}, rank [E*; C*] = {} with e = {e}, n = {n}",
            of_ed.rank, of_ec.rank
        );
        let mut result = condition(
            "(8)",
            "equivalent system exists",
            "rank [E* N*] = rank E*  or  rank E* = e  or  rank [E*; C*] = n",
        );
        result.verdict = Verdict::of(chosen.is_some(), fragile);
        result.summary = match chosen {
            Some(Alternative::FullColumnRank) => format!(
                "{numbers}; used: {}, the weak alternative, so (13) decides on the T1 that results",
                Alternative::FullColumnRank.formula()
            ),
            Some(alternative) => format!("{numbers}; used: {}", alternative.formula()),
            None => {
                format!("{numbers}: none of the three holds, the unknown input enters an algebraic equation")
            }
        };
        if chosen.is_none() {
            result.remedies.push("choose the general form, which does not need (8)".to_owned());
        }
        result.evidence = vec![
            evidence("rank [E* N*]", of_ed, r),
            evidence("rank E*", of_e, e),
            evidence("rank [E*; C*]", of_ec, n),
        ];
        result.needed = needed;
        Ok(result)
    }

    /// The paper's outputs have no feedthrough of the unknown input.
    fn no_feedthrough(&self, needed: bool) -> Condition {
        let largest = if self.system.F.is_empty() { 0.0 } else { self.system.F.amax() };
        let mut result = condition("(1)", "no feedthrough", "F = 0");
        result.source = format!("{PAPER}, equation (1): y* = C* x");
        result.verdict = Verdict::of(largest == 0.0, false);
        result.summary = if largest == 0.0 {
            "the unknown input does not act on the outputs".to_owned()
        } else {
            result.remedies.push("choose the general form, which takes a feedthrough".to_owned());
            format!("F has an entry of size {largest}, but system (1) has y* = C* x")
        };
        result.needed = needed;
        result
    }

    /// (9): impulse observability.
    fn condition_9(&self) -> Result<Condition, PropertyError> {
        let found = impulse_observability(self.system, self.tolerance)?;
        let (n, r) = (self.system.n_states(), found.rank_e.rank);
        let mut result = condition("(9)", "impulse observability", "rank [E* A*; 0 E*; 0 C*] = n + rank E*");
        result.verdict = Verdict::of(found.holds(), found.fragile());
        let relation = if found.holds() { "=" } else { "<" };
        result.summary = format!(
            "{} {relation} {n} + {r}; on the algebraic part: rank {} of {} needed, smallest singular value {:.3e}",
            found.printed.decision.rank,
            found.compressed.decision.rank,
            found.compressed.needed,
            found.compressed.decision.smallest()
        );
        if let Some(direction) = &found.witness {
            result.witness = Some(Witness {
                s: None,
                direction: direction.iter().map(|x| (*x).into()).collect(),
                coordinates: self.coordinates(),
            });
        }
        if !found.holds() {
            result.remedies =
                self.sensors(|extended| Ok(impulse_observability(extended, self.tolerance)?.holds()))?;
        }
        result.evidence = vec![
            evidence(
                "[U2'A*V2; C*V2], on the null spaces of E*",
                found.compressed.decision,
                found.compressed.needed,
            ),
            evidence("[E* A*; 0 E*; 0 C*]", found.printed.decision, found.printed.needed),
        ];
        Ok(result)
    }

    /// (10): R-detectability of the system augmented by its unknown input.
    // ERRATUM(004, appendix): the proof splits (12) into Re s > 0 and s = 0; the rest of the imaginary axis is missing.
    fn condition_10(&self) -> Result<Condition, PropertyError> {
        let n = self.system.n_states() + self.system.n_unknown_inputs();
        let found = r_detectability(&augmented_system(self.system), self.tolerance)?;
        let at_integrator = self.rank_at_integrator(self.system)?;
        let discrete = self.system.time == TimeDomain::Discrete;
        let formula = if discrete {
            "rank [zE*-A* -N*; 0 (z-1)I; C* 0] = n + nf for all |z| >= 1"
        } else {
            "rank [sE*-A* -N*; 0 sI; C* 0] = n + nf for all Re s >= 0"
        };
        let mut result = condition("(10)", "detectability with the unknown input", formula);
        self.fill_modes(&mut result, &found, "[sE*-A* -N*; 0 sI; C* 0]");
        result.summary = format!(
            "{}; at {} rank {} of {n}, smallest singular value {:.3e}",
            result.summary,
            if discrete { "z = 1" } else { "s = 0" },
            at_integrator.rank,
            at_integrator.smallest()
        );
        result.evidence.insert(0, evidence("[A* N*; C* 0] at s = 0", at_integrator, n));
        if !found.holds() {
            result.remedies = self.sensors(|extended| {
                Ok(r_detectability(&augmented_system(extended), self.tolerance)?.holds())
            })?;
        }
        Ok(result)
    }

    /// Rank of the pencil of (10) at the integrator's own mode, s = 0 or z = 1, without the integrator's rows.
    fn rank_at_integrator(&self, system: &DescriptorSystem) -> Result<RankDecision, PropertyError> {
        let DescriptorSystem { E, A, C, D, F, .. } = system;
        let A = A - E * hold(system.time);
        Ok(rank(&block_matrix(&[&[Of(&A), Of(D)], &[Of(C), Of(F)]]), 0.0, self.tolerance)?)
    }

    /// R-detectability of the system itself, for observers without unknown-input estimate.
    fn detectability(&self, found: &ModeCondition) -> Condition {
        let formula = match self.system.time {
            TimeDomain::Continuous => "rank [sE-A; C] = n for all Re s >= 0",
            TimeDomain::Discrete => "rank [zE-A; C] = n for all |z| >= 1",
        };
        let mut result = condition("Def. 1", "R-detectability", formula);
        result.id = "004-R-detectable".to_owned();
        result.source = format!("{PAPER}, Definition 1; Darouach and Boutayeb 1995");
        self.fill_modes(&mut result, found, "[sE-A; C]");
        result
    }

    fn fill_modes(&self, result: &mut Condition, found: &ModeCondition, of: &str) {
        result.verdict = Verdict::of(found.holds(), found.fragile());
        let points: Vec<PointEvidence> = found
            .modes
            .iter()
            .map(|mode| PointEvidence {
                s: mode.s,
                multiplicity: mode.multiplicity,
                distance: mode.sigma,
                loses_rank: true,
                stable: found.region.contains(mode.s, found.margin),
            })
            .collect();
        let violation = found.violations().next();
        result.summary = match (&found.free_direction, violation, points.len()) {
            (Some(_), _, _) => format!("rank {} < {} for every s", found.normal_rank, found.needed),
            (None, Some(mode), _) => {
                format!("rank is lost at s = {}, which is not stable", crate::observer::show(mode.s))
            }
            (None, None, 0) => "no finite s at which rank is lost".to_owned(),
            (None, None, count) => format!("rank is lost at {count} finite s, all of them stable"),
        };
        let direction = match (&found.free_direction, violation) {
            (Some(free), _) => Some((None, free.iter().map(|x| (*x).into()).collect())),
            (None, Some(mode)) => Some((Some(mode.s), mode.direction.clone())),
            (None, None) => None,
        };
        result.witness =
            direction.map(|(s, direction)| Witness { s, direction, coordinates: self.coordinates() });
        result.evidence.push(Evidence::Points { of: of.to_owned(), points });
    }

    /// (11): the left inverse `[T1 T2]` exists.
    fn condition_11(&self, equivalent: &Equivalent) -> Result<Condition, PropertyError> {
        let n = self.system.n_states();
        let scale = self.system.E.norm().max(self.system.A.norm()).max(self.system.C.norm());
        let decision = rank(&stack(&[&equivalent.E, &equivalent.C]), scale, self.tolerance)?;
        let mut result = condition("(11)", "left inverse", "rank [E; C] = n");
        result.verdict = Verdict::of(decision.rank == n, decision.fragile);
        result.summary = format!("rank {} of {n} needed, in the equivalent system (4)", decision.rank);
        result.evidence = vec![evidence("[E; C]", decision, n)];
        Ok(result)
    }

    /// (13): every mode that the full-order observer cannot move is stable.
    // ERRATUM(004, appendix): the proof needs T1 of full column rank, which alternative 3 of (8) does not give; hence
    // (13) is asked of the T1 that is used.
    fn condition_13(&self, equivalent: &Equivalent) -> Result<Condition, PropertyError> {
        let (A, C) = full_order::pair(equivalent, hold(self.system.time), self.tolerance)?;
        let mut result = condition(
            "(13)",
            "detectability of the design pair",
            "rank [sI-T1A -T1N; 0 sI; C 0] = n + nf for all Re s >= 0",
        );
        self.fill_pair(&mut result, &A, &C, "([T1A T1N; 0 0], [C 0])")?;
        Ok(result)
    }

    /// (22) and (23): the reduced pair exists and is detectable.
    // ERRATUM(004, eqs. 22, 23): s I_n is s I_r; the pencil has r + nf columns.
    fn conditions_22_23(&self, equivalent: &Equivalent) -> Result<Vec<Condition>, PropertyError> {
        let reduction = reduced_order::reduce(equivalent, self.tolerance)?;
        let needed = reduction.P1.ncols();
        let mut first = condition("(22)", "unmeasured part is determined", "rank C2 = n - r");
        let decision = reduction.C2_rank.clone();
        first.verdict = Verdict::of(decision.rank == needed, decision.fragile);
        first.summary = format!("rank {} of {needed} needed", decision.rank);
        first.evidence = vec![evidence("C2 = C P1", decision, needed)];
        let (A, C) = reduced_order::pair(equivalent, &reduction, hold(self.system.time));
        let mut second = condition(
            "(23)",
            "detectability of the reduced pair",
            "rank [sI-Ar -N; 0 sI; P3C1 0] = r + nf for all Re s >= 0",
        );
        self.fill_pair(&mut second, &A, &C, "([Ar N; 0 0], [P3C1 0])")?;
        Ok(vec![first, second])
    }

    fn fill_pair(
        &self,
        result: &mut Condition,
        A: &DMatrix<f64>,
        C: &DMatrix<f64>,
        of: &str,
    ) -> Result<(), PropertyError> {
        let modes = pbh_modes(A, C, self.tolerance)?;
        let region = StabilityRegion::of(self.system.time == TimeDomain::Discrete);
        let margin = region.margin(A.norm().max(1.0), self.tolerance);
        let bad: Vec<&PbhMode> =
            modes.iter().filter(|m| m.unobservable && !region.contains(m.value, margin)).collect();
        let hidden = modes.iter().filter(|m| m.unobservable).count();
        let near = |m: &PbhMode| {
            let ratio = m.distance / self.tolerance.mode;
            ratio > 1.0 && ratio < self.tolerance.gap && !region.contains(m.value, margin)
        };
        result.verdict = Verdict::of(bad.is_empty(), modes.iter().any(near));
        result.summary = match (bad.first(), hidden) {
            (Some(mode), _) => {
                format!("the mode {} is not observable and not stable", crate::observer::show(mode.value))
            }
            (None, 0) => {
                let closest = modes.iter().map(|m| m.distance).fold(f64::INFINITY, f64::min);
                format!(
                    "all {} modes are observable: every pole can be placed (closest distance {closest:.2e})",
                    A.nrows()
                )
            }
            (None, hidden) => format!("{hidden} fixed modes, all stable"),
        };
        let points = modes.iter().map(|m| PointEvidence {
            s: m.value,
            multiplicity: m.multiplicity,
            distance: m.distance,
            loses_rank: m.unobservable,
            stable: region.contains(m.value, margin),
        });
        result.evidence.push(Evidence::Points { of: of.to_owned(), points: points.collect() });
        result.witness = bad.first().map(|mode| Witness {
            s: Some(mode.value),
            direction: mode.direction.clone(),
            coordinates: (1..=A.nrows()).map(|i| format!("z{i}")).collect(),
        });
        Ok(())
    }

    /// States whose measurement alone would make a condition hold, as sentences.
    fn sensors(
        &self,
        holds: impl Fn(&DescriptorSystem) -> Result<bool, PropertyError>,
    ) -> Result<Vec<String>, PropertyError> {
        const LARGEST: usize = 16;
        let n = self.system.n_states();
        if n > LARGEST {
            return Ok(Vec::new());
        }
        let mut remedies = Vec::new();
        for i in 0..n {
            if holds(&with_sensor(self.system, i))? {
                remedies.push(format!("measure x{0}: add the row with a 1 in column {0} to C", i + 1));
            }
        }
        if remedies.is_empty() {
            remedies.push("no single additional sensor of one state restores it".to_owned());
        }
        Ok(remedies)
    }
}

/// The system with a further output that measures one state.
fn with_sensor(system: &DescriptorSystem, state: usize) -> DescriptorSystem {
    let mut row = DMatrix::zeros(1, system.n_states());
    row[(0, state)] = 1.0;
    let F = stack(&[&system.F, &DMatrix::zeros(1, system.n_unknown_inputs())]);
    DescriptorSystem { C: stack(&[&system.C, &row]), F, ..system.clone() }
}

/// The system (3): the unknown input as a further state that holds its value.
fn augmented_system(system: &DescriptorSystem) -> DescriptorSystem {
    let DescriptorSystem { time, E, A, C, D, F, .. } = system;
    let q = system.n_unknown_inputs();
    let unit = DMatrix::identity(q, q);
    let rows = E.nrows() + q;
    DescriptorSystem {
        time: *time,
        E: block_matrix(&[&[Of(E), Zero], &[Zero, Of(&unit)]]),
        A: block_matrix(&[&[Of(A), Of(D)], &[Zero, Of(&(&unit * hold(*time)))]]),
        B: DMatrix::zeros(rows, 0),
        C: side_by_side(&[C, F]),
        D: DMatrix::zeros(rows, 0),
        F: DMatrix::zeros(C.nrows(), 0),
    }
}
