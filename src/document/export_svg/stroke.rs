//! The stroke of a curve by what it stands for.

use super::curve::decimal;
use crate::paper::{Role, Series, colour};

/// Colour, width and dashes of a line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Stroke {
    colour: (u8, u8, u8),
    width: f64,
    dashes: &'static str,
    opacity: f64,
}

impl Stroke {
    /// The stroke of a curve beside the others of its panel.
    ///
    /// A true value that an estimate of the same colour may hide is drawn wide and pale beneath it.
    pub(super) fn of(series: &Series, panel: &[Series]) -> Self {
        let shadow = series.role == Role::Truth
            && panel
                .iter()
                .any(|s| matches!(s.role, Role::Estimate | Role::Other) && s.colour == series.colour);
        let (width, dashes) = match series.role {
            Role::Truth if shadow => (3.6, ""),
            Role::Truth | Role::Response => (1.6, ""),
            Role::Estimate => (1.6, "6 3"),
            Role::Other => (1.6, "1.5 2.5"),
            Role::Error => (0.9, ""),
        };
        Self { colour: colour(series.colour), width, dashes, opacity: if shadow { 0.4 } else { 1.0 } }
    }

    /// A path element.
    pub(super) fn path(&self, d: &str) -> String {
        let (r, g, b) = self.colour;
        let dashes = match self.dashes {
            "" => String::new(),
            dashes => format!(" stroke-dasharray=\"{dashes}\""),
        };
        let opacity = if self.opacity < 1.0 {
            format!(" stroke-opacity=\"{}\"", decimal(self.opacity))
        } else {
            String::new()
        };
        format!(
            "<path d=\"{d}\" fill=\"none\" stroke=\"#{r:02x}{g:02x}{b:02x}\" stroke-width=\"{}\" \
             stroke-linejoin=\"round\"{dashes}{opacity}/>\n",
            decimal(self.width)
        )
    }
}
