//! The instants at which an expression of time is continuous but not smooth.

use super::function::{Binary, Operation, Unary};
use super::jumps::{MAX_JUMPS, Search, Switch, switches};
use super::program::{Instruction, Program};

/// Slopes beside an instant are compared at this distance, relative to the interval.
const BESIDE: f64 = 1e-9;

/// As documented at [`super::Expression::kinks`]; `time` is the index of t among `variables` variables.
pub(super) fn kinks(program: &Program, time: usize, variables: usize, interval: (f64, f64)) -> Vec<f64> {
    let (from, to) = interval;
    if !(from.is_finite() && to.is_finite() && (to - from).is_finite() && from < to) {
        return Vec::new();
    }
    let mut values = vec![f64::NAN; variables];
    let mut instants: Vec<f64> = Vec::new();
    for switch in switches(program, time, has_kinks) {
        if let Some(line) = switch.operands.first().and_then(|code| line(code))
            && switch.operation == Operation::Binary(Binary::Noise)
        {
            instants.extend(whole_numbers(line, interval));
        } else {
            let branch = |t: f64| {
                values[time] = t;
                side(&switch, program, &values)
            };
            instants.extend(Search::new(branch).over(from, to));
        }
    }
    instants.retain(|t| *t > from && *t < to);
    instants.sort_by(f64::total_cmp);
    instants.dedup_by(|later, earlier| *later - *earlier <= 8.0 * f64::EPSILON * later.abs());
    let mut direction = vec![0.0; variables];
    direction[time] = 1.0;
    let mut slope = |t: f64| {
        values[time] = t;
        program.dual(&values, &direction).1
    };
    let near = BESIDE * (to - from);
    instants.retain(|t| slope(t - near) != slope(t + near));
    instants.truncate(MAX_JUMPS);
    instants
}

fn has_kinks(operation: Operation) -> bool {
    matches!(
        operation,
        Operation::Unary(Unary::Abs | Unary::Ramp)
            | Operation::Binary(Binary::Min | Binary::Max | Binary::Noise)
    )
}

/// A number that changes at a kink.
fn side(switch: &Switch<'_>, program: &Program, values: &[f64]) -> f64 {
    let (a, b) = (switch.operand(0, program, values), switch.operand(1, program, values));
    let side = match switch.operation {
        Operation::Binary(Binary::Noise) => a.floor(),
        Operation::Binary(_) => f64::from(u8::from(a < b)),
        _ => f64::from(u8::from(a < 0.0)),
    };
    // outside the domain counts as one side
    if side.is_nan() { f64::INFINITY } else { side }
}

/// The coefficients `(a, b)` of an operand that is a line `a + b t`; none when it is anything else.
fn line(code: &[Instruction]) -> Option<(f64, f64)> {
    let mut stack: Vec<(f64, f64)> = Vec::new();
    for instruction in code {
        let result = match instruction {
            Instruction::Constant(value) => (*value, 0.0),
            // an operand of a switch knows no other variable than the time
            Instruction::Variable(_) => (0.0, 1.0),
            Instruction::Operation(Operation::Unary(Unary::Negative)) => {
                let x = stack.pop()?;
                (-x.0, -x.1)
            }
            Instruction::Operation(Operation::Binary(operation)) => {
                let (y, x) = (stack.pop()?, stack.pop()?);
                match operation {
                    Binary::Add => (x.0 + y.0, x.1 + y.1),
                    Binary::Subtract => (x.0 - y.0, x.1 - y.1),
                    Binary::Multiply if y.1 == 0.0 => (x.0 * y.0, x.1 * y.0),
                    Binary::Multiply if x.1 == 0.0 => (x.0 * y.0, x.0 * y.1),
                    Binary::Divide if y.1 == 0.0 => (x.0 / y.0, x.1 / y.0),
                    _ => return None,
                }
            }
            _ => return None,
        };
        stack.push(result);
    }
    stack.pop().filter(|(a, b)| a.is_finite() && b.is_finite() && *b != 0.0)
}

/// The instants at which a line takes whole values.
fn whole_numbers((a, b): (f64, f64), (from, to): (f64, f64)) -> impl Iterator<Item = f64> {
    let (start, end) = (a + b * from, a + b * to);
    let (first, last) = (start.min(end).ceil(), start.max(end).floor());
    // the earliest come first, whichever way the line runs
    let whole = move |k: usize| if b > 0.0 { first + k as f64 } else { last - k as f64 };
    let inside = move |whole: &f64| *whole >= first && *whole <= last;
    (0..MAX_JUMPS).map(whole).take_while(inside).map(move |whole| (whole - a) / b)
}

#[cfg(test)]
mod tests {
    use super::super::Expression;

    fn kinks(text: &str, to: f64) -> Vec<f64> {
        Expression::parse(text, &["t"]).unwrap().kinks(0.0, to)
    }

    #[test]
    fn noise_has_a_kink_at_each_whole_argument() {
        let found = kinks("0.1*noise(t/0.05, 7)", 1.0);
        assert_eq!(found.len(), 19, "{found:?}");
        assert!(found.iter().zip(1..).all(|(t, k)| (t - 0.05 * f64::from(k)).abs() < 1e-15), "{found:?}");
        assert_eq!(kinks("noise(3 - 2*t, 1)", 1.2), [0.5, 1.0], "backwards");
        assert_eq!(kinks("noise(t^2, 1)", 2.0).len(), 3, "1, sqrt 2, sqrt 3");
    }

    #[test]
    fn noise_that_is_switched_off_has_none() {
        let found = kinks("noise(t/0.05, 7)*(t < 0.52)", 1.0);
        assert_eq!(found.len(), 10, "{found:?}");
    }

    #[test]
    fn other_kinks_are_found_by_searching() {
        let found = kinks("abs(t - 0.3) + max(t, 0.6) + ramp(t - 0.8)", 1.0);
        let expected = [0.3, 0.6, 0.8];
        assert_eq!(found.len(), 3, "{found:?}");
        assert!(found.iter().zip(expected).all(|(t, e)| (t - e).abs() < 1e-12), "{found:?}");
        assert!(kinks("sin(t) + step(t - 0.5)", 1.0).is_empty(), "smooth, and a jump");
        let found = kinks("noise(1e9*t, 1)", 1.0).len();
        assert!((9_990..=10_000).contains(&found), "no more than can be followed: {found}");
    }
}
