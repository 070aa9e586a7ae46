//! L2: observers: existence conditions, designs, verification.

mod choice;
mod condition;
pub mod decentralized;
mod design;
mod error_system;
pub mod h_infinity;
pub mod hierarchical;
pub mod input_decoupled;
mod light;
mod lmi_choice;
mod network_choice;
pub mod proportional;
pub mod proportional_integral;
mod realization;
mod synthesis;
mod verify;

pub use choice::{Assessment, DesignChoice, Method, Order, assess, assess_knowing, conditions};
pub use condition::{
    Condition, Evidence, Formula, FormulaPart, PointEvidence, SetEvidence, Verdict, Witness,
};
pub use design::{Claim, Design, DesignError, NamedMatrix, chosen_poles, scaled_pole};
pub use error_system::{
    ErrorGain, ErrorGains, ErrorStateSpace, ErrorSystemError, error_system, network_error_system,
};
pub use light::{Known, Light, MethodLight, lights, network_lights};
pub use lmi_choice::{GivenObserver, LmiChoice};
pub use network_choice::{assess_hierarchy, assess_network};
pub use realization::{Injection, LinearObserver};
pub use synthesis::{Certificate, LmiResult, Synthesis};
pub use verify::{Check, Response, Verification, unknown_input_response, verify};

use crate::numerics::Complex64;

/// A bound with seven significant digits that is never below `x`: what is printed is guaranteed, too.
pub fn rounded_up(x: f64) -> String {
    let parsed = |text: &str| text.parse::<f64>().unwrap_or(f64::INFINITY);
    let mut text = format!("{x:.6e}");
    if parsed(&text) < x {
        text = format!("{:.6e}", x * (1.0 + 1e-6));
    }
    let value = parsed(&text);
    if value != 0.0 && !(1e-3..1e6).contains(&value.abs()) { text } else { format!("{value}") }
}

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

#[cfg(test)]
mod tests {
    use super::rounded_up;

    #[test]
    fn a_bound_is_never_printed_below_itself() {
        for (x, text) in
            [(2.0, "2"), (2.313_391_798_170_9, "2.313392"), (1.000_000_4, "1.000001"), (0.0, "0")]
        {
            assert_eq!(rounded_up(x), text, "{x}");
        }
        for k in 1..400 {
            let x = 10.0_f64.powf(f64::from(k) / 13.0 - 15.0) / 3.0;
            let shown: f64 = rounded_up(x).parse().unwrap();
            assert!(shown >= x && shown <= x * 1.000_002, "{x} is shown as {shown}");
        }
    }
}
