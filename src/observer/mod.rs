//! L2: observers: existence conditions, designs, verification.

mod choice;
mod condition;
mod design;
pub mod hierarchical;
mod lmi_choice;
pub mod proportional;
pub mod proportional_integral;
mod realization;
mod synthesis;
mod verify;

pub use choice::{Assessment, DesignChoice, Method, Order, assess, conditions};
pub use condition::{Condition, Evidence, Formula, FormulaPart, PointEvidence, Verdict, Witness};
pub use design::{Claim, Design, DesignError, NamedMatrix, chosen_poles, scaled_pole};
pub use lmi_choice::{GivenObserver, LmiChoice};
pub use realization::{Injection, LinearObserver};
pub use synthesis::{Certificate, LmiResult, Synthesis};
pub use verify::{Check, Response, Verification, unknown_input_response, verify};

use crate::numerics::Complex64;

/// A complex number as people write it: `-2`, `-1+3i`, four significant digits.
pub fn show(z: Complex64) -> String {
    let digits = |x: f64| {
        let text = format!("{x:.3e}");
        let value: f64 = text.parse().unwrap_or(x);
        if value != 0.0 && !(1e-4..1e6).contains(&value.abs()) { text } else { format!("{value}") }
    };
    if z.im.abs() <= 1e-9 * z.norm() {
        return digits(z.re);
    }
    format!("{}{}{}i", digits(z.re), if z.im < 0.0 { "-" } else { "+" }, digits(z.im.abs()))
}
