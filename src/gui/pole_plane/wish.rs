//! Whose poles are wished: of the only observer, or of the global and the local ones of a network.

use crate::numerics::Complex64;
use crate::observer::{Design, Method};
use crate::session::{Edit, NetworkEdit, Session};

/// A wished pole: whose, and its place in its list.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Wish {
    /// Of the local observers of a network.
    pub local: bool,
    /// Its place, from zero.
    pub index: usize,
}

impl Wish {
    /// What moves it.
    pub(super) fn moved(self, to: Complex64, done: bool) -> Edit {
        let index = self.index;
        if self.local {
            Edit::Network(NetworkEdit::MoveLocalPole { index, to, done })
        } else {
            Edit::MovePole { index, to, done }
        }
    }
}

/// The wished poles of a document with their owners: those that the design uses first, and how many these are.
pub(super) fn wishes(session: &Session, design: Option<&Design>) -> (Vec<(Wish, Complex64)>, usize) {
    let choice = &session.document().design;
    let hierarchical = choice.method == Method::Hierarchical;
    let global = design.and_then(|design| design.synthesis.placement());
    let used = |placed: Option<usize>, listed: usize| placed.map_or(listed, |placed| placed.min(listed));
    let global_used = used(global.map(|placement| placement.requested.len()), choice.poles.len());
    let locals = design.and_then(|design| design.hierarchical.as_deref());
    let placed = locals.map(|all| all.locals().next().map_or(0, |(_, one)| one.placement.requested.len()));
    let of = |local: bool, poles: &[Complex64]| -> Vec<(Wish, Complex64)> {
        poles.iter().enumerate().map(|(index, pole)| (Wish { local, index }, *pole)).collect()
    };
    let mut wishes = of(false, &choice.poles);
    let mut waiting = wishes.split_off(global_used);
    let mut count = global_used;
    if hierarchical {
        let mut local = of(true, &choice.local_poles);
        let local_used = used(placed, local.len());
        waiting.extend(local.split_off(local_used));
        wishes.extend(local);
        count += local_used;
    }
    wishes.extend(waiting);
    (wishes, count)
}
