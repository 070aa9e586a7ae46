//! Observer (8): one global observer, and local observers that are plugged in and out.
#![expect(non_snake_case, reason = "matrix letters follow paper 003")]

use nalgebra::DMatrix;
use serde::{Deserialize, Serialize};

use super::composite::global_alone;
use super::verify::verify_network;
use super::{Hierarchy, HierarchyError, LARGEST_COMPOSITE, composite};
use crate::numerics::{
    Complex64, Placement, PlacementError, PlacementOptions, StabilityRegion, Tolerance, observable_quotient,
    place_observer,
};
use crate::observer::design::{chosen_poles, needed};
use crate::observer::{
    Condition, Design, DesignChoice, DesignError, NamedMatrix, Synthesis, Verification, show,
};
use crate::system::Network;

/// The observer of the whole.
///
/// ```text
/// z_hat' = (alpha_z - H gamma_z) z_hat + H y_G
/// ```
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct GlobalObserver {
    /// The gain, nu mu x P p.
    pub H: DMatrix<f64>,
    /// How it was found; fixed modes stay in the spectrum.
    pub placement: Placement,
}

/// The observer of one subsystem; the subsystems are identical, so that one design serves any of them.
///
/// ```text
/// x_hat_i' = (a - h c_L) x_hat_i + beta_i z_hat + h y_i
/// ```
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct LocalObserver {
    /// The gain, n x p.
    pub h: DMatrix<f64>,
    /// How it was found; fixed modes stay in the spectrum.
    pub placement: Placement,
}

/// The global observer with the local observers that are plugged in at present.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct HierarchicalObserver {
    /// What the global observer estimates, and how it drives the local ones.
    pub hierarchy: Hierarchy,
    /// The global observer; nothing that happens to the local ones changes it.
    pub global: GlobalObserver,
    /// One place for each subsystem.
    locals: Vec<Option<LocalObserver>>,
    /// Why local observers that were asked for are missing, in sentences.
    pub left_out: Vec<String>,
}

impl HierarchicalObserver {
    /// The global observer alone.
    pub fn new(hierarchy: Hierarchy, global: GlobalObserver) -> Self {
        let locals = vec![None; hierarchy.N.nrows()];
        Self { hierarchy, global, locals, left_out: Vec::new() }
    }

    /// Plugs a local observer in, in place of the one that may be there.
    ///
    /// # Errors
    /// [`DesignError::Unsuitable`] when the subsystem has no local measurements, or the gain does not fit them.
    pub fn plug_in(
        &mut self,
        network: &Network,
        subsystem: usize,
        local: LocalObserver,
    ) -> Result<(), DesignError> {
        let needed = (network.a.nrows(), network.c_L.nrows());
        if local.h.shape() != needed {
            return Err(DesignError::Unsuitable(format!(
                "the gain of the local observer is {} x {}, but {} x {} is needed: a row for each state of a subsystem \
                 and a column for each local output",
                local.h.nrows(),
                local.h.ncols(),
                needed.0,
                needed.1
            )));
        }
        match self.locals.get_mut(subsystem) {
            Some(place) if network.local.contains(&subsystem) => {
                *place = Some(local);
                Ok(())
            }
            _ => Err(DesignError::Unsuitable(format!(
                "subsystem {} has no local measurements, which a local observer needs: add it to the set I",
                subsystem + 1
            ))),
        }
    }

    /// Takes a local observer out; `None` when there is none.
    pub fn pull_out(&mut self, subsystem: usize) -> Option<LocalObserver> {
        self.locals.get_mut(subsystem).and_then(Option::take)
    }

    /// The local observer of a subsystem, if one is plugged in.
    pub fn local(&self, subsystem: usize) -> Option<&LocalObserver> {
        self.locals.get(subsystem).and_then(Option::as_ref)
    }

    /// All local observers that are plugged in, each with the number of its subsystem, from zero.
    pub fn locals(&self) -> impl Iterator<Item = (usize, &LocalObserver)> {
        self.locals.iter().enumerate().filter_map(|(i, local)| Some((i, local.as_ref()?)))
    }

    /// The gains that differ from each other, each with the subsystems that use it.
    pub fn distinct_locals(&self) -> Vec<(&LocalObserver, Vec<usize>)> {
        let mut result: Vec<(&LocalObserver, Vec<usize>)> = Vec::new();
        for (i, local) in self.locals() {
            match result.iter_mut().find(|(known, _)| known.h == local.h) {
                Some((_, users)) => users.push(i),
                None => result.push((local, vec![i])),
            }
        }
        result
    }
}

/// Designs the global observer: `H` places the poles of `alpha_z - H gamma_z`.
///
/// The wished poles are the first ones of `choice.poles`, times `choice.scale`.
///
/// # Errors
/// Too few poles, half a conjugate pair, or a placement that fails.
pub fn design_global(
    hierarchy: &Hierarchy,
    choice: &DesignChoice,
    tolerance: &Tolerance,
) -> Result<GlobalObserver, DesignError> {
    let mut placement =
        place(&hierarchy.alpha_z(), &hierarchy.thin_gamma_z(), &choice.poles, choice, tolerance)
            .map_err(|error| named("global", error))?;
    placement.gain = hierarchy.full_gain(placement.gain);
    Ok(GlobalObserver { H: placement.gain.clone(), placement })
}

/// Designs a local observer, whatever the global one is: `h` places the poles of `a - h c_L`.
///
/// The wished poles are the first ones of `choice.local_poles`, times `choice.scale`.
///
/// # Errors
/// As [`design_global`].
pub fn design_local(
    network: &Network,
    choice: &DesignChoice,
    tolerance: &Tolerance,
) -> Result<LocalObserver, DesignError> {
    let placement = place(&network.a, &network.c_L, &choice.local_poles, choice, tolerance)
        .map_err(|error| named("local", error))?;
    Ok(LocalObserver { h: placement.gain.clone(), placement })
}

/// Says which of the two lists of poles an error is about.
fn named(which: &str, error: DesignError) -> DesignError {
    match error {
        DesignError::TooFewPoles { .. } | DesignError::Poles(_) => {
            DesignError::Poles(format!("poles of the {which} observer: {error}"))
        }
        other => other,
    }
}

/// Places the first poles of a list on the observable part of a pair.
fn place(
    A: &DMatrix<f64>,
    C: &DMatrix<f64>,
    poles: &[Complex64],
    choice: &DesignChoice,
    tolerance: &Tolerance,
) -> Result<Placement, DesignError> {
    let options = PlacementOptions { seed: choice.seed, ..PlacementOptions::default() };
    // nearly always everything is observable: then the placement's own test is the only one
    if let Ok(wished) = chosen_poles(poles, choice.scale, false, A.nrows()) {
        match place_observer(A, C, &wished, &options, tolerance) {
            Err(PlacementError::PoleCount { .. }) => {}
            Ok(placement) => return Ok(placement),
            Err(error) => return Err(error.into()),
        }
    }
    let free = observable_quotient(A, C, tolerance)?.basis.ncols();
    let wished = chosen_poles(poles, choice.scale, false, free)?;
    Ok(place_observer(A, C, &wished, &options, tolerance)?)
}

/// A designed hierarchical observer with everything needed to show and to check it; its size does not grow with N.
#[derive(Clone, Debug, PartialEq)]
pub struct HierarchicalDesign {
    /// Method and orders in words.
    pub title: String,
    /// The matrices under the paper's names.
    pub matrices: Vec<NamedMatrix>,
    /// The observer; local observers can be plugged in and out.
    pub observer: HierarchicalObserver,
    /// The re-check, made in the network's own matrices.
    pub verification: Verification,
    /// What a user should know: unused poles, ill-conditioned gains, split multiple poles, fixed modes.
    pub notes: Vec<String>,
}

impl HierarchicalDesign {
    /// The design in the common form, with the composite observer of all that is plugged in, or the global observer alone
    /// when the network is too large for that.
    ///
    /// # Errors
    /// As [`composite`].
    pub fn common(&self, network: &Network) -> Result<Design, DesignError> {
        let states = network.a.nrows() * network.n_subsystems();
        let observer = if states > LARGEST_COMPOSITE {
            global_alone(&self.observer)
        } else {
            composite(network, &self.observer)?
        };
        Ok(Design {
            title: self.title.clone(),
            matrices: self.matrices.clone(),
            observer,
            injection: None,
            hierarchical: Some(Box::new(self.observer.clone())),
            claim: None,
            synthesis: Synthesis::Poles(Box::new(self.observer.global.placement.clone())),
            verification: self.verification.clone(),
            notes: self.notes.clone(),
        })
    }
}

/// Designs the global observer and plugs the same local observer into the chosen subsystems, or into all that have local
/// measurements.
///
/// `choice.poles` are the poles of the global observer, `choice.local_poles` those of the local ones; `choice.scale`
/// stretches both. Local observers that cannot be had take nothing from the global one: they are left out, and
/// [`HierarchicalObserver::left_out`] and the notes say why.
///
/// # Errors
/// The first condition of the global observer that fails, poles of it that do not fit, or a decomposition that fails its
/// check.
///
/// # Source
/// Paper 003, (8), Theorem 1, Proposition 1.
pub fn design(
    network: &Network,
    choice: &DesignChoice,
    conditions: &[Condition],
    tolerance: &Tolerance,
) -> Result<HierarchicalDesign, DesignError> {
    design_of(network, Hierarchy::of(network, tolerance), choice, conditions, tolerance)
}

/// The same with a representation that is known.
pub(in crate::observer) fn design_of(
    network: &Network,
    hierarchy: Result<Hierarchy, HierarchyError>,
    choice: &DesignChoice,
    conditions: &[Condition],
    tolerance: &Tolerance,
) -> Result<HierarchicalDesign, DesignError> {
    let (local, global): (Vec<_>, Vec<_>) =
        conditions.iter().cloned().partition(|condition| condition.id == "003-P1-local");
    needed(&global)?;
    let hierarchy = hierarchy?;
    let global = design_global(&hierarchy, choice, tolerance)?;
    let mut notes = notes("global", &global.placement, choice.poles.len());
    let mut observer = HierarchicalObserver::new(hierarchy, global);
    let plugged = choice.plugged.as_ref().unwrap_or(&network.local);
    if !plugged.is_empty() {
        match needed(&local).and_then(|()| design_local(network, choice, tolerance)) {
            Ok(local) => {
                notes.extend(self::notes("local", &local.placement, choice.local_poles.len()));
                for &subsystem in plugged {
                    if let Err(error) = observer.plug_in(network, subsystem, local.clone()) {
                        observer.left_out.push(error.to_string());
                    }
                }
            }
            Err(error) => observer.left_out.push(format!("no local observer is plugged in: {error}")),
        }
        notes.extend(observer.left_out.iter().cloned());
    }
    let verification = verify_network(network, &observer, tolerance)?;
    let count = observer.locals().count();
    let title = format!(
        "hierarchical observer, global order {}, {count} local {} of order {}",
        observer.hierarchy.order(),
        if count == 1 { "observer" } else { "observers" },
        network.a.nrows()
    );
    Ok(HierarchicalDesign { title, matrices: matrices(&observer), observer, verification, notes })
}

/// Subsystems of one gain whose `beta_z` is listed; of more it follows from `Gamma` in the same way.
const LISTED: usize = 12;

/// The matrices that a person may want to see.
fn matrices(observer: &HierarchicalObserver) -> Vec<NamedMatrix> {
    let HierarchicalObserver { hierarchy, global, .. } = observer;
    let Hierarchy { N, M, Gamma_nu, a_z, b_z, c_z, .. } = hierarchy;
    let mut all = vec![
        ("N".to_owned(), "orthonormal basis of the row space of Gamma", N.clone()),
        ("M".to_owned(), "orthonormal basis of what the coupling output shows", M.clone()),
        ("Gamma_nu".to_owned(), "coupling within the whole, N' Gamma N", Gamma_nu.clone()),
        ("a_z".to_owned(), "subsystem within the whole, M' a_I M", a_z.clone()),
        ("b_z".to_owned(), "its coupling input, M' b_I", b_z.clone()),
        ("c_z".to_owned(), "its coupling output, c_I M", c_z.clone()),
        ("alpha_z".to_owned(), "state matrix of z = sigma_z x", hierarchy.alpha_z()),
        ("gamma_z".to_owned(), "global output, y_G = gamma_z z", hierarchy.gamma_z()),
        ("H".to_owned(), "gain of the global observer", global.H.clone()),
    ];
    for (local, users) in observer.distinct_locals() {
        let Some(&first) = users.first() else { continue };
        let name = if users.len() == 1 { format!("h_{}", first + 1) } else { "h".to_owned() };
        all.push((name, "gain of the local observers", local.h.clone()));
        for &user in users.iter().take(LISTED) {
            let meaning = "how the whole drives this subsystem";
            all.push((format!("beta_z{}", user + 1), meaning, hierarchy.beta(user)));
        }
    }
    let named = |(name, meaning, value): (String, &str, DMatrix<f64>)| NamedMatrix {
        name,
        meaning: meaning.to_owned(),
        value,
    };
    all.into_iter().map(named).collect()
}

/// What a user should know of a placement.
fn notes(which: &str, placement: &Placement, given: usize) -> Vec<String> {
    let mut notes: Vec<String> =
        placement.warnings.iter().map(|warning| format!("{which} observer: {warning}")).collect();
    let used = placement.requested.len();
    if given > used {
        notes.push(format!("{which} observer: the first {used} of {given} poles are used"));
    }
    if !placement.fixed_modes.is_empty() {
        let modes: Vec<String> = placement.fixed_modes.iter().map(|z| show(*z)).collect();
        notes.push(format!("{which} observer: fixed modes that no gain can move: {}", modes.join(", ")));
    }
    let region = StabilityRegion::LeftHalfPlane;
    for pole in placement.requested.iter().filter(|z| region.excess(**z) >= 0.0 && z.im >= 0.0) {
        notes.push(format!(
            "{which} observer: the requested pole {} is not stable: the estimate will not converge",
            show(*pole)
        ));
    }
    notes
}
