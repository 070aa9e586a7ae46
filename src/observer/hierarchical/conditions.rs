//! Existence conditions of the hierarchical observer: (11), Proposition 1, and Theorem 2 as explanation.
#![expect(non_snake_case, reason = "matrix letters follow paper 003")]

use nalgebra::DMatrix;

use super::bases::{row_space, shown_part};
use super::pairs::{Mode, judge, pair, points_of};
use super::theorem::{Theorem, relative_outside};
use super::{Hierarchy, HierarchyError};
use crate::numerics::{NumericsError, PbhMode, RankDecision, Tolerance, pbh_modes, rank, stack};
use crate::observer::{Condition, DesignChoice, Evidence, Verdict};
use crate::system::Network;
use crate::system::properties::PropertyError;

const PAPER: &str = "Ishizaki, Sakai, Kashima and Imura";

/// Existence conditions of the hierarchical decentralized observer of a network, with a local observer wherever there are
/// local measurements; see [`conditions_for`].
///
/// # Errors
/// Matrices that do not fit, and decompositions that fail their check.
pub fn conditions(network: &Network, tolerance: &Tolerance) -> Result<Vec<Condition>, PropertyError> {
    conditions_for(network, &DesignChoice::default(), tolerance)
}

/// Existence conditions of the hierarchical decentralized observer of a network.
///
/// The inclusions (11) and detectability of `(alpha_z, gamma_z)` are needed, that of `(a_I, c_L)` where the choice plugs
/// local observers in; Theorem 2 and its corollary explain the former and are not.
///
/// # Errors
/// Matrices that do not fit, and decompositions that fail their check.
///
/// # Source
/// Paper 003, (11), Proposition 1 (with detectability, of which the paper's observability is a special case), Theorem
/// 2, Corollary 1.
pub fn conditions_for(
    network: &Network,
    choice: &DesignChoice,
    tolerance: &Tolerance,
) -> Result<Vec<Condition>, PropertyError> {
    conditions_of(network, &Hierarchy::of(network, tolerance), choice, tolerance)
}

/// The same with a representation that is known.
pub(in crate::observer) fn conditions_of(
    network: &Network,
    hierarchy: &Result<Hierarchy, HierarchyError>,
    choice: &DesignChoice,
    tolerance: &Tolerance,
) -> Result<Vec<Condition>, PropertyError> {
    let mut local = local(network, tolerance)?;
    local.needed = choice.plugged.as_ref().map_or(!network.local.is_empty(), |plugged| !plugged.is_empty());
    let hierarchy = match hierarchy {
        Ok(hierarchy) => hierarchy,
        Err(HierarchyError::System(error)) => return Err(error.clone().into()),
        Err(HierarchyError::Numerics(error)) => return Err(error.clone().into()),
        Err(error @ HierarchyError::TooLarge { .. }) => {
            let mut result = inclusions_alone(network, tolerance)?;
            result.extend([too_large(error), local]);
            return Ok(result);
        }
    };
    let parts = (&hierarchy.N, &hierarchy.nu, &hierarchy.M, &hierarchy.mu);
    let mut result = inclusions(network, parts, tolerance)?;
    let (alpha, gamma) = (hierarchy.alpha_z(), hierarchy.thin_gamma_z());
    let whole = pbh_modes(&alpha, &gamma, tolerance)?;
    let mut global = global(&whole, (&alpha, &gamma), tolerance)?;
    if !global.verdict.holds() {
        global.remedies = more_outputs(network, hierarchy, tolerance)?;
    }
    result.push(global);
    result.push(local);
    result.extend(Theorem::of(network, hierarchy, &whole, tolerance)?.conditions()?);
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

/// (11) of a network whose whole is too large: what is known of both row spaces.
fn inclusions_alone(network: &Network, tolerance: &Tolerance) -> Result<Vec<Condition>, PropertyError> {
    /// Up to this many subsystems the row space of any coupling is at hand.
    const DENSE: usize = 64;
    let Network { a, b, c, Gamma, .. } = network;
    let shown = shown_part(a, &(b * c), tolerance)?;
    let most = if Gamma.nrows() <= DENSE { DENSE } else { 0 };
    let space = row_space(Gamma, most, tolerance)?;
    let known = space.basis.is_some();
    let N = space.basis.unwrap_or_else(|| DMatrix::zeros(Gamma.nrows(), 0));
    let mut result = inclusions(network, (&N, &space.rank, &shown.M, &shown.printed), tolerance)?;
    if let Some(psi) = result.iter_mut().find(|condition| condition.id == PSI && !known) {
        psi.verdict = Verdict::Undecided;
        "not asked: the rank of Gamma is beyond what a global observer can have".clone_into(&mut psi.summary);
        psi.evidence.clear();
        psi.remedies.clear();
    }
    Ok(result)
}

const PSI: &str = "003-11-Psi";

/// (11): the global output sees nothing but the whole.
fn inclusions(
    network: &Network,
    (N, nu, M, mu): (&DMatrix<f64>, &RankDecision, &DMatrix<f64>, &RankDecision),
    tolerance: &Tolerance,
) -> Result<Vec<Condition>, NumericsError> {
    let one = |which: (&str, &str, &str), outside: f64, rank: (&str, &RankDecision, usize)| {
        let (id, name, formula) = which;
        let mut result = condition((id, "(11)"), name, formula);
        let near = outside > tolerance.residual / tolerance.gap && outside <= tolerance.residual;
        result.verdict = Verdict::of(outside <= tolerance.residual, rank.1.fragile || near);
        result.summary = format!("relative residual {outside:.1e}, {} = {}", rank.0, rank.2);
        let of = if rank.0 == "nu" { "Gamma" } else { "O_n(a_I, b_I c_I)" };
        result.evidence =
            vec![Evidence::Rank { of: of.to_owned(), decision: rank.1.clone(), required: rank.2 }];
        result
    };
    let mut psi = one(
        (PSI, "global output within the coupling", "R(Psi') in R(Gamma')"),
        relative_outside(&network.Psi, N),
        ("nu", nu, N.ncols()),
    );
    let mut output = one(
        (
            "003-11-cG",
            "global output within what the coupling output shows",
            "R(c_G') in R(O_n(a_I, b_I c_I)')",
        ),
        relative_outside(&network.c_G, M),
        ("mu", mu, M.ncols()),
    );
    if M.ncols() == 0 {
        psi.verdict = Verdict::Holds;
        "mu = 0: a subsystem shows nothing, and with c_G = 0 the global output is zero"
            .clone_into(&mut psi.summary);
    }
    if !psi.verdict.holds() {
        let text =
            "choose each row of Psi as a combination of rows of Gamma, for example a row of Gamma itself";
        psi.remedies = vec![text.to_owned()];
    }
    if !output.verdict.holds() {
        output.remedies = shown_outputs(network, M, tolerance)?;
    }
    Ok(vec![psi, output])
}

/// Which rows of `c_G` lie within what the coupling output shows, as a sentence.
///
/// The rows of `c_I` do when `b_I` has independent columns; else only what `b_I` passes on.
fn shown_outputs(
    network: &Network,
    M: &DMatrix<f64>,
    tolerance: &Tolerance,
) -> Result<Vec<String>, NumericsError> {
    let Network { b, c, .. } = network;
    if M.ncols() == 0 {
        let text =
            "choose c_G = 0, since b_I c_I = 0 shows nothing of a subsystem, or let b_I c_I show something";
        return Ok(vec![text.to_owned()]);
    }
    let rows = if rank(b, 0.0, tolerance)?.rank == b.ncols() { "c_I" } else { "b_I c_I" };
    let start =
        format!("choose each row of c_G as a combination of rows of {rows}, {rows} a_I, {rows} a_I^2, ...");
    let fits = c.norm() > 0.0 && relative_outside(c, M) <= tolerance.residual;
    Ok(vec![if fits { format!("{start}, for example c_I itself") } else { start }])
}

/// Detectability of `(alpha_z, gamma_z)`: the PBH test of the whole decides, whatever the eigenvectors of `Gamma_nu` are.
fn global(
    whole: &[PbhMode],
    tested: (&DMatrix<f64>, &DMatrix<f64>),
    tolerance: &Tolerance,
) -> Result<Condition, NumericsError> {
    let mut result = condition(
        ("003-P1-global", "Prop. 1"),
        "detectability of the whole",
        "(alpha_z, gamma_z) detectable",
    );
    judge(&mut result, (whole, tested), ("z", "(alpha_z, gamma_z)"), false, tolerance)?;
    Ok(result)
}

/// Detectability of `(a_I, c_L)`.
// ERRATUM(003, Proposition 1): the print has alpha_I - h_i c_L; it is a_I.
fn local(network: &Network, tolerance: &Tolerance) -> Result<Condition, PropertyError> {
    let mut result =
        condition(("003-P1-local", "Prop. 1"), "detectability of a subsystem", "(a_I, c_L) detectable");
    let Network { a, c_L, .. } = network;
    let test = |c: &DMatrix<f64>| pbh_modes(a, c, tolerance);
    pair(&mut result, (a, c_L), ("x", "(a_I, c_L)"), false, tolerance)?;
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
    let (Psi_N, c_GM) = (hierarchy.thin_Psi_N(), hierarchy.thin_c_GM());
    let mut remedies = Vec::new();
    for i in 0..network.n_subsystems() {
        let row = hierarchy.Gamma_N.rows(i, 1).into_owned();
        if row.norm() > 0.0 && detectable(&stack(&[&Psi_N, &row]), &c_GM)? {
            remedies.push(format!("adding row {} of Gamma to Psi would restore it", i + 1));
        }
    }
    // rows that b_I does not pass on would break (11)
    let fits = relative_outside(&network.c, &hierarchy.M) <= tolerance.residual;
    if fits && detectable(&Psi_N, &stack(&[&c_GM, &hierarchy.c_z]))? {
        remedies.push("adding the rows of c_I to c_G would restore it".to_owned());
    }
    Ok(remedies)
}
