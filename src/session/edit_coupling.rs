//! Edits of the coupling: entries, edges of its graph, the usual forms.

use super::network_edits::{CouplingForm, NetworkCell};
use super::state::{Draft, Field};
use super::update::Edited;
use crate::document::limits::MAX_SPARSE_ENTRIES;
use crate::document::{Coupling, Entry, NetworkData, NetworkMatrix};
use crate::numerics::Random;

/// Replaces one entry.
pub(super) fn set(coupling: &mut Coupling, (row, column): (usize, usize), entry: Entry) -> Edited {
    set_block(coupling, (row, column), 1, vec![entry])
}

/// Replaces a block of entries, row by row.
pub(super) fn set_block(
    coupling: &mut Coupling,
    at: (usize, usize),
    columns: usize,
    block: Vec<Entry>,
) -> Edited {
    coupling.set_block(at, columns, block);
    match coupling {
        Coupling::Sparse { entries, .. } => too_many(entries.len()).unwrap_or(Edited::Done),
        Coupling::Dense(_) => Edited::Done,
    }
}

/// Why a document cannot hold so many entries, if it cannot.
fn too_many(entries: usize) -> Option<Edited> {
    (entries > MAX_SPARSE_ENTRIES).then(|| {
        Edited::Refused(format!(
            "the coupling would have {entries} entries; at most {MAX_SPARSE_ENTRIES} are possible: couple fewer \
             subsystems"
        ))
    })
}

/// Sets what one subsystem receives from another; when balanced, the diagonal keeps the sum of the row.
pub(super) fn edge(
    data: &mut NetworkData,
    (to, from): (usize, usize),
    text: String,
    balanced: bool,
) -> Edited {
    let count = data.n_subsystems();
    if to.max(from) >= count {
        return Edited::Refused(format!(
            "there is no edge from subsystem {} to {}: the network has {count}",
            from + 1,
            to + 1
        ));
    }
    let entry = match Entry::typed(&text) {
        Ok(entry) => entry,
        Err(error) => {
            let cell = NetworkCell { matrix: NetworkMatrix::Gamma, row: to, column: from };
            return Edited::Draft(Field::Network(cell), Draft { text, error });
        }
    };
    let change = entry.value - data.Gamma.value(to, from);
    let own = tidy(data.Gamma.value(to, to) - change);
    let edited = set(&mut data.Gamma, (to, from), entry);
    if balanced && to != from && change != 0.0 && own.is_finite() && matches!(edited, Edited::Done) {
        return set(&mut data.Gamma, (to, to), Entry::number(own));
    }
    edited
}

/// A number without the last digits, which sums and products of typed numbers get by rounding.
fn tidy(x: f64) -> f64 {
    format!("{x:.12e}").parse().map_or(x, |tidied: f64| tidied + 0.0)
}

/// Puts one of the usual forms in place of the coupling.
pub(super) fn apply(data: &mut NetworkData, form: CouplingForm, weight: f64) -> Edited {
    let count = data.n_subsystems();
    if !weight.is_finite() || weight.abs() > 1e6 {
        return Edited::Refused("the weight of an edge is a number up to a million".to_owned());
    }
    if let CouplingForm::Leaders { leaders } = form
        && !(1..=count).contains(&leaders)
    {
        return Edited::Refused(format!(
            "{leaders} leaders of {count} subsystems: at least one, at most all"
        ));
    }
    if form == CouplingForm::Complete
        && let Some(refused) = too_many(count * count).filter(|_| count > 1)
    {
        return refused;
    }
    data.Gamma = formed(form, count, weight);
    Edited::Done
}

/// A coupling of one of the usual forms.
fn formed(form: CouplingForm, count: usize, weight: f64) -> Coupling {
    let mut entries: Vec<(usize, usize, f64)> =
        links(form, count).into_iter().map(|(to, from, share)| (to, from, tidy(share * weight))).collect();
    if !matches!(form, CouplingForm::Leaders { .. }) {
        let mut sums = vec![0.0; count];
        for (to, _, value) in &entries {
            sums[*to] += value;
        }
        entries.extend(sums.into_iter().enumerate().map(|(i, sum)| (i, i, tidy(-sum))));
    }
    Coupling::from_entries(count, count, &entries)
}

/// Who listens to whom: `(to, from, share of the weight)`, no place twice.
fn links(form: CouplingForm, count: usize) -> Vec<(usize, usize, f64)> {
    let mut links = Vec::new();
    let mut both = |i: usize, j: usize| links.extend([(i, j, 1.0), (j, i, 1.0)]);
    match form {
        CouplingForm::Chain => (1..count).for_each(|i| both(i - 1, i)),
        CouplingForm::Ring => {
            (1..count).for_each(|i| both(i - 1, i));
            if count > 2 {
                both(count - 1, 0);
            }
        }
        CouplingForm::Star => (1..count).for_each(|i| both(0, i)),
        CouplingForm::Complete => (0..count).for_each(|i| (0..i).for_each(|j| both(j, i))),
        CouplingForm::Random { seed } => return by_chance(count, seed),
        CouplingForm::Leaders { leaders } => {
            let leader = |group: usize| (group % leaders.max(1)) * count / leaders.max(1);
            for i in 0..count {
                // the group whose leader is the last one up to i
                let group = (0..leaders.max(1)).rev().find(|group| leader(*group) <= i).unwrap_or(0);
                let own = leader(group) == i;
                let from = if own { leader(group + 1) } else { leader(group) };
                if from != i {
                    links.push((i, from, 1.0));
                }
            }
        }
    }
    links
}

/// Everybody listens to its neighbour, so that nobody is left alone, and to up to two others by chance.
fn by_chance(count: usize, seed: u64) -> Vec<(usize, usize, f64)> {
    let mut random = Random::new(seed);
    let mut links = Vec::new();
    for i in 0..count {
        let mut from = vec![(i + 1) % count];
        for _ in 0..2 {
            #[expect(
                clippy::cast_possible_truncation,
                clippy::cast_sign_loss,
                reason = "a whole number below the count"
            )]
            let other = (random.uniform() * count as f64) as usize;
            if !from.contains(&other) {
                from.push(other);
            }
        }
        for j in from.into_iter().filter(|j| *j != i) {
            links.push((i, j, (5.0 + (random.uniform() * 11.0).floor()) / 10.0));
        }
    }
    links
}

/// The usual forms that a coupling has, with the weight of an edge; small networks can have several.
pub fn coupling_forms(coupling: &Coupling) -> Vec<(CouplingForm, f64)> {
    let (count, columns) = coupling.shape();
    let entries = coupling.entries();
    let Some(weight) = entries.iter().find(|(i, j, _)| i != j).map(|entry| entry.2) else {
        return Vec::new();
    };
    if count != columns {
        return Vec::new();
    }
    let mut heard = vec![false; count];
    for (_, from, _) in entries.iter().filter(|(to, from, _)| to != from) {
        heard[*from] = true;
    }
    let leaders = heard.into_iter().filter(|heard| *heard).count();
    let mut forms = vec![CouplingForm::Chain, CouplingForm::Ring, CouplingForm::Star, CouplingForm::Complete];
    // everybody but a single leader listens to exactly one other
    if leaders > 0 && entries.len() + usize::from(leaders == 1) == count {
        forms.push(CouplingForm::Leaders { leaders });
    }
    forms.retain(|form| {
        let fits = |edges: usize| entries.len() == edges + count;
        let plausible = match form {
            CouplingForm::Chain | CouplingForm::Star => fits(2 * (count - 1)),
            CouplingForm::Ring => count > 2 && fits(2 * count),
            CouplingForm::Complete => fits(count * (count - 1)),
            CouplingForm::Leaders { .. } | CouplingForm::Random { .. } => true,
        };
        plausible && formed(*form, count, weight).entries() == entries
    });
    forms.into_iter().map(|form| (form, weight)).collect()
}

/// The coupling of another number of subsystems: one of the usual forms keeps it, any other is cut off or leaves the
/// new subsystems alone.
pub(super) fn continued(coupling: &Coupling, count: usize) -> Coupling {
    for (form, weight) in coupling_forms(coupling) {
        let fits = match form {
            CouplingForm::Complete => count * count <= MAX_SPARSE_ENTRIES,
            CouplingForm::Leaders { leaders } => leaders < count,
            _ => true,
        };
        if fits {
            return formed(form, count, weight);
        }
    }
    coupling.resized(count, count)
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::dmatrix;

    fn matrix(form: CouplingForm, count: usize) -> nalgebra::DMatrix<f64> {
        formed(form, count, 2.0).values()
    }

    #[test]
    fn usual_couplings_are_what_their_names_say() {
        assert_eq!(
            matrix(CouplingForm::Chain, 3),
            dmatrix![-2.0, 2.0, 0.0; 2.0, -4.0, 2.0; 0.0, 2.0, -2.0],
            "chain"
        );
        assert_eq!(matrix(CouplingForm::Ring, 4).row(0), dmatrix![-4.0, 2.0, 0.0, 2.0].row(0), "ring");
        assert_eq!(matrix(CouplingForm::Star, 4).row(0), dmatrix![-6.0, 2.0, 2.0, 2.0].row(0), "star");
        assert_eq!(
            matrix(CouplingForm::Complete, 3),
            matrix(CouplingForm::Ring, 3),
            "three all know each other"
        );
        let leaders = matrix(CouplingForm::Leaders { leaders: 2 }, 4);
        let expected =
            dmatrix![0.0, 0.0, 2.0, 0.0; 2.0, 0.0, 0.0, 0.0; 2.0, 0.0, 0.0, 0.0; 0.0, 0.0, 2.0, 0.0];
        assert_eq!(leaders, expected, "two leaders");
        assert_eq!(matrix(CouplingForm::Chain, 1), dmatrix![0.0], "alone");
    }

    #[test]
    fn a_random_coupling_is_reproducible_and_balanced() {
        let (first, again) =
            (matrix(CouplingForm::Random { seed: 3 }, 30), matrix(CouplingForm::Random { seed: 3 }, 30));
        assert_eq!(first, again, "the same seed");
        assert_ne!(first, matrix(CouplingForm::Random { seed: 4 }, 30), "another seed");
        for (i, row) in first.row_iter().enumerate() {
            assert!(
                row.sum().abs() < 1e-9 && row[i] < 0.0,
                "row {i} has the sum zero and somebody to listen to: {row}"
            );
        }
    }

    #[test]
    fn a_usual_coupling_is_recognised_and_continued() {
        let forms = [
            CouplingForm::Chain,
            CouplingForm::Ring,
            CouplingForm::Star,
            CouplingForm::Complete,
            CouplingForm::Leaders { leaders: 1 },
            CouplingForm::Leaders { leaders: 3 },
        ];
        for form in forms {
            let coupling = formed(form, 6, 0.3);
            assert!(coupling_forms(&coupling).contains(&(form, 0.3)), "{form:?} is recognised");
            assert_eq!(continued(&coupling, 8), formed(form, 8, 0.3), "{form:?} goes on");
            assert_eq!(continued(&coupling, 5), formed(form, 5, 0.3), "{form:?} is cut off");
        }
        let mut other = formed(CouplingForm::Ring, 6, 1.0);
        other.set(0, 3, Entry::number(0.5));
        assert!(coupling_forms(&other).is_empty(), "one edge more is another coupling");
        assert_eq!(continued(&other, 7).value(6, 5), 0.0, "its new subsystem is alone");
    }

    #[test]
    fn sums_stay_without_digits_of_rounding() {
        assert_eq!(tidy(0.1 + 0.2), 0.3, "the last digits go");
        assert_eq!(tidy(1.0 / 3.0 * 3.0), 1.0, "whole");
        assert!((tidy(-0.0)).is_sign_positive(), "no negative zero");
    }
}
