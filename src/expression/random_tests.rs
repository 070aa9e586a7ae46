//! Nothing that can be typed panics, and every number reads back.

use super::*;
use proptest::prelude::*;

proptest! {
    #[test]
    fn no_text_panics(text in "\\PC{0,60}") {
        drop(Expression::parse(&text, &["t"]).map(|f| (f.value(&[0.3]), f.jumps(0.0, 0.001))));
    }

    #[test]
    fn no_text_of_tokens_panics(words in prop::collection::vec(prop::sample::select(vec![
        "t", "1", "2.5", "(", ")", ",", "+", "-", "*", "/", "^", "<", "==", "~", "&", "sin(", "mod(", "if(",
        "pulse(", "noise(", "floor(", "step(", "pi", "1e308", ".", "e",
    ]), 0..30)) {
        drop(Expression::parse(&words.concat(), &["t"]).map(|f| (f.dual(&[0.3], &[1.0]), f.jumps(0.0, 1e-3))));
    }

    #[test]
    fn every_number_reads_back(x in prop::num::f64::NORMAL | prop::num::f64::SUBNORMAL | prop::num::f64::ZERO) {
        prop_assert_eq!(constant(&format!("{x:e}")), Ok(x));
        prop_assert_eq!(constant(&format!("{x}")), Ok(x));
    }
}
