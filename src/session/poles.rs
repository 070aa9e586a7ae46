//! The list of poles: reading, moving in the plane, providing enough for an order.

use std::collections::BTreeSet;

use nalgebra::DMatrix;

use crate::document::limits::MAX_POLES;
use crate::document::{Document, NetworkData, PlantData};
use crate::numerics::{Complex64, conjugate_pairs, rank};
use crate::observer::hierarchical::{MOST_GLOBAL_STATES, proposed_order};
use crate::observer::{Method, Order, show};
use crate::system::{Network, TimeDomain};

/// Reads `-22, -3+2i, -3-2i`; commas, semicolons or spaces between them, `i` or `j`, brackets are ignored.
pub(super) fn parse(text: &str) -> Result<Vec<Complex64>, String> {
    let cleaned: String =
        text.chars().map(|c| if matches!(c, '[' | ']' | '{' | '}' | ';') { ' ' } else { c }).collect();
    let words: Vec<&str> =
        cleaned.split(|c: char| c == ',' || c.is_whitespace()).filter(|word| !word.is_empty()).collect();
    if words.len() > MAX_POLES {
        return Err(format!("{} poles; at most {MAX_POLES} are possible", words.len()));
    }
    let mut poles = Vec::new();
    for word in words {
        poles.push(pole(word)?);
    }
    conjugate_pairs(&poles).map_err(|error| error.to_string())?;
    Ok(poles)
}

/// Reads one pole; the imaginary part ends in `i` or `j` and may use a constant expression without signs inside.
fn pole(word: &str) -> Result<Complex64, String> {
    let wrong = |why: String| format!("`{word}` is not a pole such as -22 or -3+2i: {why}");
    let constant = |text: &str| crate::expression::constant(text).map_err(|error| wrong(error.to_string()));
    let Some(body) =
        word.strip_suffix(['i', 'j']).filter(|body| !body.ends_with(|c: char| c.is_ascii_alphabetic()))
    else {
        return Ok(Complex64::from(constant(word)?));
    };
    // the last sign that is not an exponent's parts the real from the imaginary part
    let bytes = body.as_bytes();
    let split = (1..bytes.len()).rev().find(|&k| {
        matches!(bytes[k], b'+' | b'-') && !matches!(bytes[k - 1], b'e' | b'E' | b'(' | b'*' | b'/')
    });
    let (re, im) = split.map_or(("0", body), |k| body.split_at(k));
    let im = match im {
        "" | "+" => 1.0,
        "-" => -1.0,
        _ => constant(im.trim_end_matches('*'))?,
    };
    Ok(Complex64::new(constant(re)?, im))
}

/// Writes a list in the form that it is read back from.
pub fn poles_text(poles: &[Complex64]) -> String {
    poles.iter().map(|pole| show(*pole)).collect::<Vec<_>>().join(", ")
}

/// Below this share of its distance from the origin a dragged pole snaps onto the real axis.
const SNAP: f64 = 0.03;

/// Moves one pole; a pair moves together, a pair dropped on the real axis becomes two real poles, and a real pole
/// pulled off the axis takes the nearest other real pole along as its conjugate.
///
/// The partner of one of the first `used` poles, which the order takes, is sought among these.
fn move_pole(poles: &mut [Complex64], index: usize, to: Complex64, (used, discrete): (usize, bool)) {
    let Some(&from) = poles.get(index) else { return };
    let on_axis = to.im.abs() <= SNAP * to.norm();
    let conjugate = |k: &usize| *k != index && (poles[*k] - from.conj()).norm() <= 1e-9 * from.norm();
    let partner = if from.im == 0.0 { None } else { (0..poles.len()).find(conjugate) };
    match (partner, on_axis) {
        (Some(partner), false) => {
            poles[index] = to;
            poles[partner] = to.conj();
        }
        (Some(partner), true) => {
            poles[index] = Complex64::from(to.re);
            poles[partner] = Complex64::from(beside(to.re, discrete));
        }
        (None, true) => poles[index] = Complex64::from(to.re),
        (None, false) => {
            let real = |k: &usize| *k != index && poles[*k].im == 0.0;
            let distance = |k: usize| (poles[k].re - from.re).abs();
            // a partner that the order does not use would leave the pair cut
            let among = if index < used { used.min(poles.len()) } else { poles.len() };
            let nearest = (0..among).filter(real).min_by(|&a, &b| distance(a).total_cmp(&distance(b)));
            match nearest {
                Some(nearest) => {
                    poles[index] = to;
                    poles[nearest] = to.conj();
                }
                None => poles[index] = Complex64::from(to.re),
            }
        }
    }
}

/// A real pole beside another: a little faster.
fn beside(pole: f64, discrete: bool) -> f64 {
    match (discrete, pole == 0.0) {
        (true, true) => 0.05,
        (true, false) => pole * 0.95,
        (false, _) => pole * 1.05,
    }
}

/// Moves one pole of the document in the plane.
pub(super) fn drag(document: &mut Document, index: usize, to: Complex64) {
    let Some((used, time)) = needed(document) else { return };
    move_pole(&mut document.design.poles, index, to, (used, time == TimeDomain::Discrete));
}

/// How many poles the chosen design takes, as far as its list has as many; `None` for one without poles.
pub(super) fn used(document: &Document) -> Option<usize> {
    needed(document).map(|(needed, _)| needed.min(document.design.poles.len()))
}

/// Moves one pole of the local observers in the plane.
pub(super) fn drag_local(document: &mut Document, index: usize, to: Complex64) {
    let PlantData::Network(data) = &document.plant else { return };
    move_pole(&mut document.design.local_poles, index, to, (data.a.shape().0, false));
}

/// How many poles the chosen order takes at most, and the time domain.
fn needed(document: &Document) -> Option<(usize, TimeDomain)> {
    if document.design.method == Method::Hierarchical {
        let PlantData::Network(data) = &document.plant else { return None };
        return Some((global_order(data)?, TimeDomain::Continuous));
    }
    let system = document.system().ok()?;
    let rank = rank(&system.E, 0.0, &document.tolerance).ok()?;
    let (n, q) = (system.n_states(), system.n_unknown_inputs());
    let needed = match (document.design.method, document.design.order) {
        (Method::Proportional, Order::Reduced) | (Method::InputDecoupled, _) => rank.rank,
        (Method::Proportional, Order::Full | Order::General) => n,
        (Method::ProportionalIntegral, Order::Reduced) => rank.rank + q,
        (Method::ProportionalIntegral, Order::Full | Order::General) => n + q,
        (_, Order::Minimal) | (Method::HInfinity | Method::Decentralized | Method::Hierarchical, _) => {
            return None;
        }
    };
    Some((needed, system.time))
}

/// States that the global observer of a network will have, as far as they are known without a decomposition, which no
/// keystroke waits for; of a large network at most, by who listens and who is listened to alone. `None` when there is none.
fn global_order(data: &NetworkData) -> Option<usize> {
    const COUNTED: usize = 100;
    let network = data.network().ok()?;
    if network.n_subsystems() <= COUNTED {
        return proposed_order(&network, MOST_GLOBAL_STATES);
    }
    let entries = data.Gamma.entries();
    let count = |of: fn(&(usize, usize, f64)) -> usize| entries.iter().map(of).collect::<BTreeSet<_>>().len();
    let nu = count(|entry| entry.0).min(count(|entry| entry.1));
    let one = DMatrix::from_element(1, 1, 1.0);
    let alone = Network { Gamma: one.clone().into(), Psi: one, local: Vec::new(), ..network };
    let mu = proposed_order(&alone, MOST_GLOBAL_STATES)?;
    Some(nu * mu).filter(|order| *order <= MOST_GLOBAL_STATES)
}

/// Adds poles until the chosen order has enough; never removes or moves one.
///
/// New poles continue the list to the left of its fastest real part (discrete: between 0.3 and 0.7).
pub(super) fn provide(document: &mut Document) {
    if let (Method::Hierarchical, PlantData::Network(data)) = (document.design.method, &document.plant) {
        let needed = data.a.shape().0;
        lengthen(&mut document.design.local_poles, needed, TimeDomain::Continuous);
        pair_up(&mut document.design.local_poles, needed, false);
    }
    let Some((needed, time)) = needed(document) else { return };
    lengthen(&mut document.design.poles, needed, time);
    pair_up(&mut document.design.poles, needed, time == TimeDomain::Discrete);
}

/// Adds poles to a list until it has as many as are needed.
fn lengthen(poles: &mut Vec<Complex64>, needed: usize, time: TimeDomain) {
    while poles.len() < needed.min(MAX_POLES) {
        let k = poles.len();
        let next = match time {
            TimeDomain::Continuous => {
                let fastest = poles.iter().map(|pole| pole.re).fold(-1.0, f64::min);
                let next = fastest * 1.2;
                // two significant digits are enough for a proposal
                let unit = 10_f64.powf(next.abs().log10().floor() - 1.0);
                (next / unit).round() * unit
            }
            TimeDomain::Discrete => 0.3 + 0.05 * (k % 9) as f64,
        };
        poles.push(Complex64::from(next));
    }
}

/// Where the first `needed` poles would cut a pair, swaps the pair's first member with the next real pole.
fn pair_up(poles: &mut [Complex64], needed: usize, discrete: bool) {
    let used = needed.min(poles.len());
    if used == 0 || conjugate_pairs(&poles[..used]).is_ok() {
        return;
    }
    let last_pair = (0..used).rev().find(|&k| poles[k].im != 0.0);
    let real = (used..poles.len()).find(|&k| poles[k].im == 0.0);
    match (last_pair, real) {
        (Some(k), Some(real)) => poles.swap(k, real),
        (Some(k), None) => {
            let partner =
                (used..poles.len()).find(|&j| (poles[j] - poles[k].conj()).norm() <= 1e-9 * poles[k].norm());
            if let Some(partner) = partner {
                let re = poles[k].re;
                poles[k] = Complex64::from(re);
                poles[partner] = Complex64::from(beside(re, discrete));
            }
        }
        (None, _) => {}
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn c(re: f64, im: f64) -> Complex64 {
        Complex64::new(re, im)
    }

    #[test]
    fn poles_are_read_in_every_usual_form() {
        let found = parse("[-22; -1e-3, -3+2i -3-2j {-2*pi}]").unwrap();
        assert_eq!(
            found,
            [c(-22.0, 0.0), c(-1e-3, 0.0), c(-3.0, 2.0), c(-3.0, -2.0), c(-2.0 * std::f64::consts::PI, 0.0)]
        );
        assert_eq!(parse("i -i").unwrap(), [c(0.0, 1.0), c(0.0, -1.0)], "the imaginary unit alone");
        assert_eq!(
            parse("-1-1e-2i, -1+1e-2i").unwrap(),
            [c(-1.0, -0.01), c(-1.0, 0.01)],
            "exponents keep their sign"
        );
    }

    #[test]
    fn what_is_not_a_pole_is_named() {
        assert!(parse("-1, fast").unwrap_err().contains("`fast`"), "names the word");
        assert!(parse("-1+2i").unwrap_err().contains("conjugate"), "half a pair");
        assert!(parse("1/0").is_err(), "not finite");
    }

    #[test]
    fn texts_of_poles_read_back() {
        let poles = [c(-22.0, 0.0), c(-3.0, 2.5), c(-3.0, -2.5)];
        assert_eq!(parse(&poles_text(&poles)).unwrap(), poles, "write, then read");
    }

    #[test]
    fn a_pair_moves_together() {
        let mut poles = [c(-1.0, 1.0), c(-5.0, 0.0), c(-1.0, -1.0)];
        move_pole(&mut poles, 2, c(-2.0, -3.0), (3, false));
        assert_eq!(poles, [c(-2.0, 3.0), c(-5.0, 0.0), c(-2.0, -3.0)], "the conjugate follows");
    }

    #[test]
    fn a_real_pole_takes_the_nearest_one_off_the_axis() {
        let mut poles = [c(-1.0, 0.0), c(-9.0, 0.0), c(-2.0, 0.0)];
        move_pole(&mut poles, 0, c(-1.5, 1.0), (3, false));
        assert_eq!(poles, [c(-1.5, 1.0), c(-9.0, 0.0), c(-1.5, -1.0)], "-2 was nearer than -9");
        move_pole(&mut poles, 0, c(-1.5, 0.001), (3, false));
        assert!(poles.iter().all(|pole| pole.im == 0.0), "back on the axis: two real poles again");
    }

    #[test]
    fn the_last_real_pole_stays_on_the_axis() {
        let mut poles = [c(-1.0, 0.0)];
        move_pole(&mut poles, 0, c(-2.0, 5.0), (1, false));
        assert_eq!(poles, [c(-2.0, 0.0)], "there is no partner");
    }
}
