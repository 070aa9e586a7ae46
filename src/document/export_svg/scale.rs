//! From values to pixels, with ticks where people expect them.

/// Ticks on an axis are about this many pixels apart, or more.
const SPACING: f64 = 46.0;

/// A value range mapped to a pixel range.
#[derive(Clone, Copy, Debug)]
pub(super) struct Scale {
    low: f64,
    high: f64,
    logarithmic: bool,
    from: f64,
    to: f64,
}

/// A tick: its value, and its label (mantissa and power of ten) when it has one.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Tick {
    pub(super) value: f64,
    pub(super) label: Option<Label>,
}

/// Text of a label.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Label {
    /// Plain digits.
    Plain(String),
    /// `10` to this power.
    Power(i32),
}

impl Scale {
    /// A scale over `limits`, widened where they leave no room; `pixels` run from the low to the high end.
    pub(super) fn new(limits: [f64; 2], logarithmic: bool, pixels: [f64; 2]) -> Self {
        let (low, high) = if logarithmic { widened_decades(limits) } else { widened(limits) };
        Self { low, high, logarithmic, from: pixels[0], to: pixels[1] }
    }

    /// The pixel of a value, also beyond the ends; `None` for what has no place on the axis.
    pub(super) fn pixel(&self, value: f64) -> Option<f64> {
        let part = if self.logarithmic {
            (value / self.low).ln() / (self.high / self.low).ln()
        } else {
            (value - self.low) / (self.high - self.low)
        };
        let pixel = self.from + part * (self.to - self.from);
        (pixel.is_finite() && (!self.logarithmic || value > 0.0)).then_some(pixel)
    }

    /// Ticks within the range; those without a label belong to the minor grid.
    pub(super) fn ticks(&self, spacing: f64) -> Vec<Tick> {
        let room = ((self.to - self.from).abs() / spacing.max(SPACING / 2.0)).max(1.0);
        let ticks = if self.logarithmic && self.high / self.low >= 10.0 {
            decades(self.low, self.high, room)
        } else {
            even(self.low, self.high, room)
        };
        let slack = 1e-9;
        let inside = |tick: &Tick| {
            let pixel = self.pixel(tick.value);
            pixel.is_some_and(|p| {
                p >= self.from.min(self.to) - slack - 1e-6 && p <= self.from.max(self.to) + slack + 1e-6
            })
        };
        ticks.into_iter().filter(inside).collect()
    }

    /// Ticks at the usual distance.
    pub(super) fn usual_ticks(&self) -> Vec<Tick> {
        self.ticks(SPACING)
    }
}

fn widened([low, high]: [f64; 2]) -> (f64, f64) {
    let size = low.abs().max(high.abs());
    if !(size.is_finite() && high - low > 1e-12 * size) || high - low < f64::MIN_POSITIVE {
        let room = if size > 0.0 && size.is_finite() { 0.1 * size } else { 1.0 };
        let middle = if low.is_finite() { low } else { 0.0 };
        return (middle - room, middle + room);
    }
    (low, high)
}

fn widened_decades([low, high]: [f64; 2]) -> (f64, f64) {
    if !(low > 0.0 && high.is_finite() && high > low * 1.000_001) {
        let middle = if low > 0.0 && low.is_finite() { low } else { 1.0 };
        return (middle / 10.0, middle * 10.0);
    }
    (low, high)
}

/// The smallest of 1, 2, 5 times a power of ten that is at least `least`: mantissa and exponent.
fn nice_step(least: f64) -> (f64, i32) {
    #[expect(clippy::cast_possible_truncation, reason = "exponents of finite numbers are small")]
    let exponent = least.log10().floor() as i32;
    for mantissa in [1.0, 2.0, 5.0] {
        if mantissa * power(exponent) >= least * (1.0 - 1e-9) {
            return (mantissa, exponent);
        }
    }
    (1.0, exponent + 1)
}

fn power(exponent: i32) -> f64 {
    10.0_f64.powi(exponent)
}

/// Even ticks by the 1-2-5 rule; every label has the digits of the step.
fn even(low: f64, high: f64, room: f64) -> Vec<Tick> {
    const MOST: usize = 60;
    let (mantissa, exponent) = nice_step((high - low) / room);
    let step = mantissa * power(exponent);
    let first = (low / step - 1e-9).ceil();
    let values = (0..MOST).map(|k| (first + k as f64) * step).take_while(|x| *x <= high + 1e-9 * step);
    let size = low.abs().max(high.abs());
    values.map(|x| Tick { value: x, label: Some(Label::Plain(digits(x, exponent, size))) }).collect()
}

/// A number with the digits that a step of `10^exponent` needs; powers of ten for very large and small axes.
fn digits(x: f64, exponent: i32, size: f64) -> String {
    let text = if (1e-4..1e6).contains(&size) {
        format!("{x:.*}", usize::try_from(-exponent).unwrap_or(0))
    } else {
        #[expect(clippy::cast_possible_truncation, reason = "exponents of finite numbers are small")]
        let lead = if x == 0.0 { exponent } else { x.abs().log10().floor() as i32 };
        if x.abs() < 0.5 * power(exponent) {
            return "0".to_owned();
        }
        format!("{x:.*e}", usize::try_from(lead - exponent).unwrap_or(0))
    };
    let zero = text.bytes().all(|b| matches!(b, b'-' | b'0' | b'.'));
    if zero { text.trim_start_matches('-').to_owned() } else { text.replace('-', "\u{2212}") }
}

/// Decades, labelled as many as there is room for, with the minor grid between them.
fn decades(low: f64, high: f64, room: f64) -> Vec<Tick> {
    #[expect(clippy::cast_possible_truncation, reason = "exponents of finite numbers are small")]
    let (first, last) = (low.log10().floor() as i32, high.log10().ceil() as i32);
    let (mantissa, exponent) = nice_step((f64::from(last - first) / room).max(1.0));
    #[expect(clippy::cast_possible_truncation, reason = "at most some hundred decades")]
    let every = (mantissa * power(exponent)) as i32;
    let mut ticks = Vec::new();
    for exponent in first..=last {
        let major = exponent.rem_euclid(every) == 0;
        ticks.push(Tick { value: power(exponent), label: major.then_some(Label::Power(exponent)) });
        if every == 1 {
            let minor = (2..10).map(|m| Tick { value: f64::from(m) * power(exponent), label: None });
            ticks.extend(minor);
        }
    }
    ticks
}

#[cfg(test)]
mod tests {
    use super::*;

    fn labels(limits: [f64; 2], logarithmic: bool) -> Vec<String> {
        let ticks = Scale::new(limits, logarithmic, [0.0, 300.0]).usual_ticks();
        let label = |tick: Tick| match tick.label? {
            Label::Plain(text) => Some(text),
            Label::Power(exponent) => Some(format!("1e{exponent}")),
        };
        ticks.into_iter().filter_map(label).collect()
    }

    #[test]
    fn steps_are_one_two_or_five() {
        assert_eq!(labels([0.0, 6.0], false), ["0", "1", "2", "3", "4", "5", "6"], "seconds");
        assert_eq!(
            labels([-0.06, 0.06], false),
            ["\u{2212}0.06", "\u{2212}0.04", "\u{2212}0.02", "0.00", "0.02", "0.04", "0.06"]
        );
        assert_eq!(labels([0.0, 23.0], false), ["0", "5", "10", "15", "20"], "the step of five");
        assert_eq!(labels([0.0, 3e7], false), ["0", "5e6", "1.0e7", "1.5e7", "2.0e7", "2.5e7", "3.0e7"]);
    }

    #[test]
    fn decades_carry_labels_and_a_minor_grid() {
        assert_eq!(labels([0.1, 1e5], true), ["1e-1", "1e0", "1e1", "1e2", "1e3", "1e4", "1e5"]);
        let ticks = Scale::new([0.1, 1e5], true, [0.0, 300.0]).usual_ticks();
        assert_eq!(ticks.len(), 7 + 6 * 8, "eight minor lines in each of six decades");
        assert_eq!(
            labels([1e-20, 1e20], true),
            ["1e-20", "1e-10", "1e0", "1e10", "1e20"],
            "no more than there is room for"
        );
    }

    #[test]
    fn axes_without_extent_are_widened() {
        for limits in [[3.0, 3.0], [0.0, 0.0], [f64::NAN, 1.0], [1.0, -1.0], [1e300, 1e300], [-1e308, 1e308]]
        {
            let scale = Scale::new(limits, false, [0.0, 100.0]);
            assert!(!scale.usual_ticks().is_empty() || limits[1] >= 1e300, "{limits:?}");
            let scale = Scale::new(limits, true, [0.0, 100.0]);
            assert!(scale.pixel(1.0).is_some(), "{limits:?}");
        }
    }

    #[test]
    fn what_is_not_positive_has_no_place_on_a_logarithmic_axis() {
        let scale = Scale::new([0.1, 10.0], true, [0.0, 100.0]);
        assert_eq!((scale.pixel(0.0), scale.pixel(-1.0), scale.pixel(f64::NAN)), (None, None, None));
        assert!((scale.pixel(1.0).unwrap() - 50.0).abs() < 1e-9, "one is in the middle of 0.1 and 10");
    }
}
