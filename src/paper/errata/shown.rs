//! Where a misprint is shown: beside what it concerns, and only where it concerns that.

use super::{Erratum, errata};
use crate::observer::{Method, Order};

/// Name of the observer's equation, beside which a misprint can stand.
pub const OBSERVER: &str = "observer";
/// Name of the guarantee that matrix inequalities give.
pub const GUARANTEE: &str = "guarantee";
/// Name of the uncertainty of a scenario.
pub const UNCERTAINTY: &str = "uncertainty";

/// What is on screen, as far as it decides which misprints belong there.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shown {
    /// The chosen method.
    pub method: Method,
    /// The chosen order.
    pub order: Order,
    /// The paper whose example the plant is; `None` for any other plant.
    pub example: Option<&'static str>,
}

impl Shown {
    /// The misprints beside a condition, a matrix of the design, its equation or its guarantee.
    ///
    /// `what` is the identifier of a condition, a matrix's letter, [`OBSERVER`] or [`GUARANTEE`]; `subsystem`, from one, is
    /// the one that a matrix of a local observer belongs to.
    pub fn beside(self, what: &str, subsystem: Option<usize>) -> impl Iterator<Item = &'static Erratum> {
        let (what, subsystem) = match subsystem_condition(what) {
            Some((condition, number)) => (condition, Some(number)),
            None => (what, subsystem),
        };
        let paper = self.paper();
        errata(paper.unwrap_or_default()).filter(move |erratum| {
            erratum.concerns(what, subsystem)
                && orders(erratum).contains(&self.order)
                && (!erratum.of_example() || self.example == paper)
        })
    }

    /// The misprints beside what belongs to the paper's example whichever design is chosen: its figures, by their
    /// identifiers, and [`UNCERTAINTY`].
    pub fn beside_example(self, what: &str) -> impl Iterator<Item = &'static Erratum> {
        errata(self.example.unwrap_or_default()).filter(move |erratum| erratum.concerns(what, None))
    }

    /// The paper whose formulas the method uses; none of the five for the proportional observer, to which paper 004
    /// compares its own.
    pub fn paper(self) -> Option<&'static str> {
        (self.method != Method::Proportional).then(|| self.method.paper())
    }
}

impl Erratum {
    fn concerns(&self, what: &str, subsystem: Option<usize>) -> bool {
        self.concerns.split("; ").any(|one| match one.split_once(" of subsystem ") {
            Some((name, number)) => {
                name == what && subsystem.is_some_and(|subsystem| subsystem.to_string() == number)
            }
            None => one == what,
        })
    }
}

/// A condition of paper 000 is asked of each subsystem: `000-A1-2` is `000-A1` of the second.
fn subsystem_condition(id: &str) -> Option<(&str, usize)> {
    let (condition, number) = id.rsplit_once('-')?;
    let number = number.parse().ok()?;
    condition.starts_with("000-").then_some((condition, number))
}

const ALL_ORDERS: &[Order] = &Order::ALL;
const FULL: &[Order] = &[Order::Full];
const REDUCED: &[Order] = &[Order::Reduced];
/// The two orders of paper 004; the third is not the paper's.
const FULL_AND_REDUCED: &[Order] = &[Order::Full, Order::Reduced];
/// In the example of paper 000 the minimal order is the reduced one.
const REDUCED_AND_MINIMAL: &[Order] = &[Order::Reduced, Order::Minimal];

/// Misprints that concern some orders only, by paper and place.
const ORDERS: [(&str, &str, &[Order]); 15] = [
    ("000", "section V, Y_1", REDUCED_AND_MINIMAL),
    ("000", "section V, last entry of Y_1", REDUCED_AND_MINIMAL),
    ("000", "section V, Z_i", REDUCED_AND_MINIMAL),
    ("000", "section V, Q_1 Phi_1 B_1", REDUCED_AND_MINIMAL),
    ("000", "section V, F_1", REDUCED_AND_MINIMAL),
    ("002", "section 4", REDUCED),
    ("004", "after equation (4)", FULL_AND_REDUCED),
    ("004", "equation (5)", FULL_AND_REDUCED),
    ("004", "Theorem 4", REDUCED),
    ("004", "Algorithm 1", FULL),
    ("004", "before equation (16)", REDUCED),
    ("004", "equation (19)", REDUCED),
    ("004", "equations (22), (23) and appendix", REDUCED),
    ("004", "Algorithm 2", REDUCED),
    ("004", "appendix, left factor of (13)", FULL),
];

fn orders(erratum: &Erratum) -> &'static [Order] {
    let own = |(paper, place, _): &&(&str, &str, _)| *paper == erratum.paper && *place == erratum.place;
    ORDERS.iter().find(own).map_or(ALL_ORDERS, |(.., orders)| orders)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn places(shown: Shown, what: &str, subsystem: Option<usize>) -> Vec<&'static str> {
        shown.beside(what, subsystem).map(|erratum| erratum.place).collect()
    }

    const LOCAL: Shown = Shown { method: Method::Decentralized, order: Order::Reduced, example: Some("000") };
    const LOOP: Shown =
        Shown { method: Method::ProportionalIntegral, order: Order::Reduced, example: Some("004") };

    #[test]
    fn orders_are_those_of_known_misprints() {
        for (paper, place, _) in ORDERS {
            assert!(errata(paper).any(|erratum| erratum.place == place), "{place} of paper {paper}");
        }
    }

    #[test]
    fn a_condition_of_each_subsystem_is_one_condition_of_the_paper() {
        for number in 1..=2 {
            let found = places(LOCAL, &format!("000-A1-{number}"), None);
            assert_eq!(found, ["Remark 1", "Remark 2"], "subsystem {number}");
        }
        assert_eq!(subsystem_condition("004-8"), None, "the number of an equation");
        assert_eq!(subsystem_condition("002-assumption-1"), None, "the number of an assumption");
    }

    #[test]
    fn a_matrix_of_one_subsystem_is_not_that_of_another() {
        assert_eq!(places(LOCAL, "Q", Some(1)), ["section V, Q_1 Phi_1 B_1"], "the first");
        assert!(places(LOCAL, "Q", Some(2)).is_empty(), "the second");
        assert!(places(LOCAL, "Q", None).is_empty(), "of no subsystem");
    }

    #[test]
    fn numbers_of_the_example_stand_beside_the_example_alone() {
        let other = Shown { example: None, ..LOCAL };
        assert!(places(other, "Q", Some(1)).is_empty(), "another plant");
        assert_eq!(places(other, "000-R-1", None).len(), 2, "but what concerns the formulas stays");
        assert_eq!(LOOP.beside_example(UNCERTAINTY).count(), 2, "of the example");
        assert_eq!(Shown { example: None, ..LOOP }.beside_example(UNCERTAINTY).count(), 0, "of no example");
    }

    #[test]
    fn a_misprint_of_one_order_is_not_shown_in_another() {
        let of = |order, what| places(Shown { order, ..LOOP }, what, None);
        assert_eq!(of(Order::Full, "T1"), ["Algorithm 1"], "full");
        assert!(of(Order::Reduced, "T1").is_empty(), "T1 = I has nothing to do with Algorithm 1");
        assert!(of(Order::Full, "M1").is_empty(), "M1 = I has nothing to do with (19)");
        assert!(of(Order::General, OBSERVER).is_empty(), "the general form is not the paper's");
    }

    #[test]
    fn the_proportional_observer_inherits_none() {
        let shown = Shown { method: Method::Proportional, ..LOOP };
        assert!(places(shown, "L2", None).is_empty() && shown.paper().is_none(), "it is of another paper");
    }
}
