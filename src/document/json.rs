//! Values as JSON for other programs: what a screen reports to tests and to screen readers.

use serde::Serialize;

/// A value as JSON on one line; what JSON cannot say (numbers that are not finite) becomes `null`.
pub fn to_json(value: &impl Serialize) -> String {
    serde_json::to_string(value).unwrap_or_else(|_| "null".to_owned())
}
