//! Figures as data: which designs, which scenario, what is drawn.

use crate::numerics::Complex64;
use crate::observer::{DesignChoice, LmiChoice, Method, Order};
use crate::simulation::FreeVariables;
use crate::system::Signal;

/// A figure that can be computed from a problem.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FigureRecipe {
    /// Key, used for file names: letters, digits, `-` and `_`.
    pub id: String,
    /// Title, for example `Fig. 6: estimate of the unknown input`.
    pub title: String,
    /// What is shown.
    pub caption: String,
    /// What to look for.
    pub see: String,
    /// The simulated designs.
    pub runs: Vec<RunRecipe>,
    /// The panels, in rows of at most `columns`.
    pub panels: Vec<PanelRecipe>,
    /// Panels side by side.
    pub columns: usize,
}

/// One design in one scenario; whatever is `None` is taken from the problem.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct RunRecipe {
    /// Name in legends and in panels.
    pub name: String,
    /// Changes of the design.
    pub design: DesignPatch,
    /// Changes of the scenario.
    pub scenario: ScenarioPatch,
}

/// Changes of a design.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct DesignPatch {
    /// Method.
    pub method: Option<Method>,
    /// Order.
    pub order: Option<Order>,
    /// Poles.
    pub poles: Option<Vec<Complex64>>,
    /// Bandwidth factor, relative to the problem's own.
    pub scale: Option<f64>,
    /// Poles of the local observers.
    pub local_poles: Option<Vec<Complex64>>,
    /// Subsystems whose local observer is plugged in, from zero.
    pub plugged: Option<Vec<usize>>,
    /// Demands on a design by linear matrix inequalities, all of them at once.
    pub lmi: Option<LmiChoice>,
}

impl DesignPatch {
    /// The design with these changes.
    pub fn applied(&self, design: &DesignChoice) -> DesignChoice {
        DesignChoice {
            method: self.method.unwrap_or(design.method),
            order: self.order.unwrap_or(design.order),
            poles: self.poles.clone().unwrap_or_else(|| design.poles.clone()),
            scale: self.scale.map_or(design.scale, |scale| scale * design.scale),
            seed: design.seed,
            local_poles: self.local_poles.clone().unwrap_or_else(|| design.local_poles.clone()),
            plugged: self.plugged.clone().or_else(|| design.plugged.clone()),
            lmi: self.lmi.clone().unwrap_or_else(|| design.lmi.clone()),
        }
    }
}

/// Changes of a scenario.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ScenarioPatch {
    /// Known inputs.
    pub u: Option<Vec<Signal>>,
    /// Unknown inputs.
    pub d: Option<Vec<Signal>>,
    /// Measurement noise.
    pub noise: Option<Vec<Signal>>,
    /// Horizon.
    pub horizon: Option<f64>,
    /// Scale of the parameter uncertainty.
    pub uncertainty_scale: Option<f64>,
    /// What drives the states that the equations leave free.
    pub free: Option<FreeVariables>,
}

/// A panel of a figure.
#[derive(Clone, Debug, PartialEq)]
pub enum PanelRecipe {
    /// Signals over time.
    Time {
        /// Title.
        title: String,
        /// Limits of the value axis.
        range: Option<[f64; 2]>,
        /// The signals.
        series: Vec<SeriesRecipe>,
    },
    /// Magnitude and phase over frequency, one curve per run.
    Bode {
        /// Title.
        title: String,
        /// From where to where.
        transfer: Transfer,
        /// Index of the input, from zero.
        from: usize,
        /// Index of the output, from zero.
        to: usize,
        /// Limits of the frequency axis, rad/s.
        range: [f64; 2],
    },
}

/// Transfer functions that a Bode panel can show.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Transfer {
    /// `f_hat -> x_hat` with the integral loop cut and `y = u = 0`: `M1 (s I - F)^-1 T1 N` (paper 004, Fig. 8).
    EstimateToState,
    /// `d -> d_hat`, plant and observer together.
    UnknownInput,
    /// `d -> e`, plant and observer together.
    UnknownInputToError,
}

impl Transfer {
    /// Keys in documents.
    pub const WORDS: [(&'static str, Self); 3] = [
        ("d_hat to x_hat", Self::EstimateToState),
        ("d to d_hat", Self::UnknownInput),
        ("d to e", Self::UnknownInputToError),
    ];

    /// The key in documents.
    pub fn key(self) -> &'static str {
        Self::WORDS.iter().find(|(_, value)| *value == self).map_or("", |(key, _)| key)
    }
}

/// One curve over time.
#[derive(Clone, Debug, PartialEq)]
pub struct SeriesRecipe {
    /// Index of the run it is taken from.
    pub run: usize,
    /// What is shown.
    pub quantity: Quantity,
    /// Which component, from zero.
    pub index: usize,
    /// Name in the legend; empty for the quantity's own name.
    pub name: String,
}

/// A quantity of a trajectory.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Quantity {
    /// True state `x1`.
    State,
    /// Estimated state `x1_hat`.
    Estimate,
    /// Error `e1 = x1 - x1_hat`.
    Error,
    /// Unknown input `d1`.
    UnknownInput,
    /// Its estimate `d1_hat`.
    UnknownInputEstimate,
    /// Its error `ed1 = d1 - d1_hat`.
    UnknownInputError,
    /// Known input `u1`.
    Input,
    /// Measured output `y1`.
    Output,
    /// State `z1` of a network as a whole.
    Whole,
    /// Its estimate `z1_hat`.
    WholeEstimate,
    /// Its error `ez1 = z1 - z1_hat`.
    WholeError,
}

impl Quantity {
    const PATTERNS: [(&'static str, &'static str, Self); 11] = [
        ("x", "_hat", Self::Estimate),
        ("d", "_hat", Self::UnknownInputEstimate),
        ("ed", "", Self::UnknownInputError),
        ("z", "_hat", Self::WholeEstimate),
        ("ez", "", Self::WholeError),
        ("z", "", Self::Whole),
        ("x", "", Self::State),
        ("e", "", Self::Error),
        ("d", "", Self::UnknownInput),
        ("u", "", Self::Input),
        ("y", "", Self::Output),
    ];

    /// Reads `x1`, `x1_hat`, `e1`, `d1`, `d1_hat`, `ed1`, `u1`, `y1`, `z1`, `z1_hat` or `ez1`: the quantity and its index
    /// from zero.
    ///
    /// States of a network are numbered as in [`Network::expanded`](crate::system::Network::expanded): `x16` is the first
    /// state of subsystem 4 where subsystems have five.
    pub fn parse(text: &str) -> Option<(Self, usize)> {
        Self::PATTERNS.iter().find_map(|(front, back, quantity)| {
            let number = text.strip_prefix(front)?.strip_suffix(back)?;
            let index: usize = number.parse().ok().filter(|_| number.bytes().all(|b| b.is_ascii_digit()))?;
            Some((*quantity, index.checked_sub(1)?))
        })
    }

    /// The name of a component, the inverse of [`Self::parse`].
    pub fn name(self, index: usize) -> String {
        let pattern = Self::PATTERNS.iter().find(|(_, _, quantity)| *quantity == self);
        pattern.map_or(String::new(), |(front, back, _)| format!("{front}{}{back}", index + 1))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_of_quantities_read_back() {
        for (_, _, quantity) in Quantity::PATTERNS {
            assert_eq!(Quantity::parse(&quantity.name(11)), Some((quantity, 11)), "{quantity:?}");
        }
    }

    #[test]
    fn unknown_names_are_refused() {
        for text in ["", "x", "x0", "zz1", "z1_error", "x1_hat_hat", "x-1", "x+1"] {
            assert_eq!(Quantity::parse(text), None, "`{text}` names nothing");
        }
    }
}
