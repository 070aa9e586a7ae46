//! Existence conditions of the hierarchical observer: (11), Proposition 1, and Theorem 2 as explanation.
#![expect(non_snake_case, reason = "matrix letters follow paper 003")]

use nalgebra::DMatrix;

use super::theorem::{Theorem, relative_outside};
use super::{Hierarchy, HierarchyError};
use crate::numerics::{
    Complex64, NumericsError, PbhMode, RankDecision, StabilityRegion, Tolerance, pbh_modes, stack,
};
use crate::observer::{Condition, Evidence, PointEvidence, Verdict, Witness, show};
use crate::system::Network;
use crate::system::properties::PropertyError;

const PAPER: &str = "Ishizaki, Sakai, Kashima and Imura";

/// Up to this many states the PBH test is made on `(alpha_z, gamma_z)` as a whole, beyond it block by block where
/// `Gamma_nu` has a basis of eigenvectors.
const WHOLE: usize = 16;

/// Existence conditions of the hierarchical decentralized observer of a network.
///
/// The inclusions (11) and detectability of `(alpha_z, gamma_z)` and of `(a_I, c_L)` are needed; Theorem 2 and its
/// corollary explain the former and are not.
///
/// # Errors
/// Matrices that do not fit, and decompositions that fail their check.
///
/// # Source
/// Paper 003, (11), Proposition 1 (with detectability, of which the paper's observability is a special case), Theorem
/// 2, Corollary 1.
pub fn conditions(network: &Network, tolerance: &Tolerance) -> Result<Vec<Condition>, PropertyError> {
    let hierarchy = match Hierarchy::of(network, tolerance) {
        Ok(hierarchy) => hierarchy,
        Err(HierarchyError::System(error)) => return Err(error.into()),
        Err(HierarchyError::Numerics(error)) => return Err(error.into()),
        Err(error @ HierarchyError::TooLarge { .. }) => {
            return Ok(vec![too_large(&error), local(network, tolerance)?]);
        }
    };
    let theorem = Theorem::of(network, &hierarchy, tolerance)?;
    let mut result = inclusions(network, &hierarchy, tolerance);
    let mut global = global(&hierarchy, &theorem, tolerance)?;
    if !global.verdict.holds() {
        global.remedies = more_outputs(network, &hierarchy, tolerance)?;
    }
    result.push(global);
    result.push(local(network, tolerance)?);
    result.extend(theorem.conditions()?);
    Ok(result)
}

pub(super) fn condition((id, label): (&str, &str), name: &str, formula: &str) -> Condition {
    Condition::asked((id.to_owned(), label), name, formula, format!("{PAPER}, {label}"))
}

fn too_large(error: &HierarchyError) -> Condition {
    Condition {
        summary: error.to_string(),
        ..condition(
            ("003-P1-global", "Prop. 1"),
            "detectability of the whole",
            "(alpha_z, gamma_z) detectable",
        )
    }
}

/// (11): the global output sees nothing but the whole.
fn inclusions(network: &Network, hierarchy: &Hierarchy, tolerance: &Tolerance) -> Vec<Condition> {
    let Hierarchy { N, M, nu, mu, .. } = hierarchy;
    let one = |which: (&str, &str, &str), outside: f64, rank: (&str, &RankDecision, usize), remedy: &str| {
        let (id, name, formula) = which;
        let mut result = condition((id, "(11)"), name, formula);
        let near = outside > tolerance.residual / tolerance.gap && outside <= tolerance.residual;
        result.verdict = Verdict::of(outside <= tolerance.residual, rank.1.fragile || near);
        result.summary = format!("relative residual {outside:.1e}, {} = {}", rank.0, rank.2);
        let of = if rank.0 == "nu" { "Gamma" } else { "O_n(a_I, b_I c_I)" };
        result.evidence =
            vec![Evidence::Rank { of: of.to_owned(), decision: rank.1.clone(), required: rank.2 }];
        if outside > tolerance.residual {
            result.remedies = vec![remedy.to_owned()];
        }
        result
    };
    vec![
        one(
            ("003-11-Psi", "global output within the coupling", "R(Psi') in R(Gamma')"),
            relative_outside(&network.Psi, N),
            ("nu", nu, N.ncols()),
            "choose each row of Psi as a combination of rows of Gamma, for example a row of Gamma itself",
        ),
        one(
            (
                "003-11-cG",
                "global output within what the coupling output shows",
                "R(c_G') in R(O_n(a_I, b_I c_I)')",
            ),
            relative_outside(&network.c_G, M),
            ("mu", mu, M.ncols()),
            "choose each row of c_G as a combination of rows of c_I, c_I a_I, c_I a_I^2, ...",
        ),
    ]
}

/// Detectability of `(alpha_z, gamma_z)`.
fn global(
    hierarchy: &Hierarchy,
    theorem: &Theorem<'_>,
    tolerance: &Tolerance,
) -> Result<Condition, NumericsError> {
    let mut result = condition(
        ("003-P1-global", "Prop. 1"),
        "detectability of the whole",
        "(alpha_z, gamma_z) detectable",
    );
    let alpha = hierarchy.alpha_z();
    match theorem.block_modes() {
        Some(modes) if hierarchy.order() > WHOLE => {
            let region = StabilityRegion::LeftHalfPlane;
            let margin = region.margin(alpha.norm().max(1.0), tolerance);
            let modes: Vec<Mode> = modes
                .iter()
                .map(|mode| Mode {
                    point: PointEvidence {
                        s: mode.pi,
                        multiplicity: mode.dimension,
                        distance: mode.distance,
                        loses_rank: mode.distance <= tolerance.mode,
                        stable: region.contains(mode.pi, margin),
                    },
                    direction: mode.direction.clone(),
                })
                .collect();
            pair(
                &mut result,
                &alpha,
                &modes,
                "(alpha_z, gamma_z), by the eigenvalues of Gamma_nu",
                false,
                tolerance,
            );
        }
        _ => {
            let modes = pbh_modes(&alpha, &hierarchy.gamma_z(), tolerance)?;
            pair(
                &mut result,
                &alpha,
                &points_of(&modes, &alpha, tolerance),
                "(alpha_z, gamma_z)",
                false,
                tolerance,
            );
        }
    }
    Ok(result)
}

/// Detectability of `(a_I, c_L)`.
// ERRATUM(003, Proposition 1): the print has alpha_I - h_i c_L; it is a_I.
fn local(network: &Network, tolerance: &Tolerance) -> Result<Condition, PropertyError> {
    let mut result =
        condition(("003-P1-local", "Prop. 1"), "detectability of a subsystem", "(a_I, c_L) detectable");
    let Network { a, c_L, .. } = network;
    let test = |c: &DMatrix<f64>| pbh_modes(a, c, tolerance);
    pair(&mut result, a, &points_of(&test(c_L)?, a, tolerance), "(a_I, c_L)", false, tolerance);
    result.needed = !network.local.is_empty();
    if let Some(witness) = &mut result.witness {
        witness.coordinates = (1..=a.nrows()).map(|i| format!("x{i}")).collect();
    }
    const LARGEST: usize = 16;
    if !result.verdict.holds() && a.nrows() <= LARGEST {
        for i in 0..a.nrows() {
            let mut row = DMatrix::zeros(1, a.nrows());
            row[(0, i)] = 1.0;
            let points = points_of(&test(&stack(&[c_L, &row]))?, a, tolerance);
            if points.iter().all(Mode::harmless) {
                result
                    .remedies
                    .push(format!("measuring state x{} of the subsystem locally would restore it", i + 1));
            }
        }
    }
    Ok(result)
}

/// Rows that would make the whole detectable, as sentences.
fn more_outputs(
    network: &Network,
    hierarchy: &Hierarchy,
    tolerance: &Tolerance,
) -> Result<Vec<String>, NumericsError> {
    const LARGEST: usize = 12;
    if hierarchy.order() > LARGEST || network.n_subsystems() > LARGEST {
        return Ok(Vec::new());
    }
    let alpha = hierarchy.alpha_z();
    let detectable = |Psi_N: &DMatrix<f64>, c_GM: &DMatrix<f64>| -> Result<bool, NumericsError> {
        let modes = pbh_modes(&alpha, &Psi_N.kronecker(c_GM), tolerance)?;
        Ok(points_of(&modes, &alpha, tolerance).iter().all(Mode::harmless))
    };
    let mut remedies = Vec::new();
    for i in 0..network.n_subsystems() {
        let row = hierarchy.Gamma_N.rows(i, 1).into_owned();
        if row.norm() > 0.0 && detectable(&stack(&[&hierarchy.Psi_N, &row]), &hierarchy.c_GM)? {
            remedies.push(format!("adding row {} of Gamma to Psi would restore it", i + 1));
        }
    }
    if detectable(&hierarchy.Psi_N, &stack(&[&hierarchy.c_GM, &hierarchy.c_z]))? {
        remedies.push("adding the rows of c_I to c_G would restore it".to_owned());
    }
    Ok(remedies)
}

/// A tested mode and the direction that is seen least.
pub(super) struct Mode {
    point: PointEvidence,
    direction: Vec<Complex64>,
}

impl Mode {
    fn harmless(&self) -> bool {
        !self.point.loses_rank || self.point.stable
    }
}

pub(super) fn points_of(modes: &[PbhMode], A: &DMatrix<f64>, tolerance: &Tolerance) -> Vec<Mode> {
    let region = StabilityRegion::LeftHalfPlane;
    let margin = region.margin(A.norm().max(1.0), tolerance);
    modes
        .iter()
        .map(|mode| Mode {
            point: PointEvidence {
                s: mode.value,
                multiplicity: mode.multiplicity,
                distance: mode.distance,
                loses_rank: mode.unobservable,
                stable: region.contains(mode.value, margin),
            },
            direction: mode.direction.clone(),
        })
        .collect()
}

/// Fills in verdict, summary, evidence and witness of a pair; `observable` asks of stable modes, too.
pub(super) fn pair(
    result: &mut Condition,
    A: &DMatrix<f64>,
    modes: &[Mode],
    of: &str,
    observable: bool,
    tolerance: &Tolerance,
) {
    let hidden: Vec<&Mode> = modes.iter().filter(|mode| mode.point.loses_rank).collect();
    let bad = hidden.iter().find(|mode| observable || !mode.point.stable);
    let narrow = tolerance.mode * tolerance.gap;
    let near = |mode: &Mode| {
        !mode.point.loses_rank && mode.point.distance < narrow && (observable || !mode.point.stable)
    };
    result.verdict = Verdict::of(bad.is_none(), modes.iter().any(near));
    result.summary = match (bad, hidden.len()) {
        (Some(mode), _) if observable => format!("the mode {} is not observable", show(mode.point.s)),
        (Some(mode), _) => format!("the mode {} is not observable and not stable", show(mode.point.s)),
        (None, 0) => {
            let closest = modes.iter().map(|mode| mode.point.distance).fold(f64::INFINITY, f64::min);
            format!("all {} modes are observable (closest distance {closest:.2e})", A.nrows())
        }
        (None, hidden) => format!("{hidden} fixed modes, all stable"),
    };
    result.witness = bad.map(|mode| Witness {
        s: Some(mode.point.s),
        direction: mode.direction.clone(),
        coordinates: (1..=A.nrows()).map(|i| format!("z{i}")).collect(),
    });
    let points = modes.iter().map(|mode| mode.point.clone()).collect();
    result.evidence.push(Evidence::Points { of: of.to_owned(), points });
}
