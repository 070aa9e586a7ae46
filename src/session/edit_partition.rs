//! Edits of the partition into subsystems: borders move only to where `E` and `C` stay block diagonal.

use nalgebra::DMatrix;

use super::model_edits::{PartitionEdit, Share};
use super::update::Edited;
use crate::document::limits::MAX_SUBSYSTEMS;
use crate::document::{Document, PlantData};
use crate::system::{DescriptorSystem, Subsystem, check_partition};

/// Changes the partition of a document.
pub(super) fn change(document: &mut Document, edit: PartitionEdit) -> Edited {
    let PlantData::Descriptor(data) = &mut document.plant else {
        return Edited::Refused(
            "a network has its subsystems already; it is not partitioned further".to_owned(),
        );
    };
    let Ok(system) = data.system() else { return Edited::Done };
    let before = Borders::of(&data.partition, &system);
    let names: Vec<String> = data.partition.iter().map(|subsystem| subsystem.name.clone()).collect();
    let result = match edit {
        PartitionEdit::Clear => {
            data.partition.clear();
            document.design.lmi.decoupled = None;
            return Edited::Done;
        }
        PartitionEdit::Name { subsystem, name } => {
            if let Some(subsystem) = data.partition.get_mut(subsystem) {
                subsystem.name = name;
            }
            return Edited::Done;
        }
        PartitionEdit::Split { subsystem } => split(&system, &before, subsystem),
        PartitionEdit::Join { subsystem } => Ok(before.joined(subsystem)),
        PartitionEdit::Move { border, share, to, .. } => moved(&system, &before, border, share, to),
    };
    let after = match result {
        Ok(after) => after,
        Err(why) => return Edited::Refused(why),
    };
    let joined = after.0.len() < before.0.len();
    let lost = if joined { before.0.iter().position(|at| !after.0.contains(at)) } else { None };
    let added =
        after.0.iter().position(|at| !before.0.contains(at)).filter(|_| after.0.len() > before.0.len());
    let names = renamed(names, &after, lost, added);
    let mut decoupled = document.design.lmi.decoupled.take();
    if let Some(lists) = &mut decoupled {
        follow_lists(lists, lost, added);
    }
    document.design.lmi.decoupled = decoupled.filter(|_| !after.0.is_empty());
    data.partition = after.subsystems(&system, names);
    Edited::Done
}

/// A border: how many states, equations and outputs lie before it.
type Border = [usize; 3];

/// The borders between subsystems, in order.
#[derive(Clone, Debug, PartialEq, Eq)]
struct Borders(Vec<Border>);

impl Borders {
    fn of(partition: &[Subsystem], system: &DescriptorSystem) -> Self {
        let mut sum = [0, 0, 0];
        let mut borders = Vec::new();
        for subsystem in partition {
            let sizes = [subsystem.states, subsystem.equations, subsystem.outputs];
            sum = [sum[0] + sizes[0], sum[1] + sizes[1], sum[2] + sizes[2]];
            borders.push(sum);
        }
        // the last border is the end of the system
        borders.pop_if(|last| *last == end(system));
        Self(borders)
    }

    /// The border before and the border behind subsystem `i`.
    fn around(&self, i: usize, system: &DescriptorSystem) -> (Border, Border) {
        let before = i.checked_sub(1).and_then(|i| self.0.get(i)).copied().unwrap_or([0, 0, 0]);
        (before, self.0.get(i).copied().unwrap_or(end(system)))
    }

    fn joined(&self, subsystem: usize) -> Self {
        let mut borders = self.0.clone();
        if !borders.is_empty() {
            borders.remove(subsystem.min(borders.len() - 1));
        }
        Self(borders)
    }

    /// The subsystems between the borders; none without a border.
    fn subsystems(&self, system: &DescriptorSystem, names: Vec<String>) -> Vec<Subsystem> {
        if self.0.is_empty() {
            return Vec::new();
        }
        let mut names = names.into_iter();
        let mut from = [0, 0, 0];
        let one = |to: Border| {
            let sizes = [to[0] - from[0], to[1] - from[1], to[2] - from[2]];
            from = to;
            let name = names.next().unwrap_or_default();
            Subsystem { name, states: sizes[0], equations: sizes[1], outputs: sizes[2] }
        };
        self.0.iter().copied().chain([end(system)]).map(one).collect()
    }
}

fn end(system: &DescriptorSystem) -> Border {
    [system.n_states(), system.n_equations(), system.n_outputs()]
}

/// Whether no entry lies across the corner of `row` and `column`.
fn parts(matrix: &DMatrix<f64>, row: usize, column: usize) -> bool {
    let (rows, columns) = matrix.shape();
    let zero = |rows: std::ops::Range<usize>, columns: std::ops::Range<usize>| {
        rows.into_iter().all(|i| columns.clone().all(|j| matrix[(i, j)] == 0.0))
    };
    zero(0..row, column..columns) && zero(row..rows, 0..column)
}

/// The border nearest to a wished one, inside `low..=high`, that keeps a fixed share and where `E` and `C` are parted.
fn allowed(
    system: &DescriptorSystem,
    wish: Border,
    fixed: Share,
    (low, high): (Border, Border),
) -> Option<Border> {
    let nearest = |from: usize, to: usize, wish: usize, good: &dyn Fn(usize) -> bool| {
        (from..=to).filter(|k| good(*k)).min_by_key(|k| k.abs_diff(wish))
    };
    // equations that are in step with the states stay in step
    let step = wish[0] == wish[1];
    let completed = |states: usize| {
        let equations = if step { states } else { wish[1] };
        let equation = |e: usize| parts(&system.E, e, states);
        let output = |o: usize| parts(&system.C, o, states);
        let equations = match fixed {
            Share::Equations => equation(wish[1]).then_some(wish[1]),
            Share::States | Share::Outputs => nearest(low[1], high[1], equations, &equation),
        };
        let outputs = match fixed {
            Share::Outputs => output(wish[2]).then_some(wish[2]),
            Share::States | Share::Equations => nearest(low[2], high[2], wish[2], &output),
        };
        Some([states, equations?, outputs?])
    };
    // a subsystem without states is none
    let (first, last) = (low[0] + 1, high[0].checked_sub(1)?);
    match fixed {
        Share::States => completed(wish[0]),
        Share::Equations | Share::Outputs => {
            let possible = (first..=last).filter_map(completed);
            possible.min_by_key(|border| (border[0].abs_diff(wish[0]), border[1].abs_diff(wish[1])))
        }
    }
}

fn split(system: &DescriptorSystem, borders: &Borders, subsystem: usize) -> Result<Borders, String> {
    if borders.0.len() + 2 > MAX_SUBSYSTEMS {
        return Err(format!("at most {MAX_SUBSYSTEMS} subsystems are possible"));
    }
    if subsystem > borders.0.len() {
        return Err(format!("there is no subsystem {}", subsystem + 1));
    }
    let (low, high) = borders.around(subsystem, system);
    let middle = |k: usize| usize::midpoint(low[k], high[k]);
    if high[0] < low[0] + 2 {
        return Err("a subsystem of one state cannot be divided".to_owned());
    }
    let at = |states: usize| {
        let share = (states - low[0]) as f64 / (high[0] - low[0]) as f64;
        let step = high[1] - low[1] == high[0] - low[0];
        let equations = if step { low[1] + states - low[0] } else { middle(1) };
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "a share of a small count"
        )]
        let outputs = low[2] + (share * (high[2] - low[2]) as f64).round() as usize;
        allowed(system, [states, equations, outputs], Share::States, (low, high))
    };
    let found = (low[0] + 1..high[0]).filter_map(at).min_by_key(|border| border[0].abs_diff(middle(0)));
    let mut all = borders.0.clone();
    let place = subsystem.min(all.len());
    if let Some(found) = found {
        all.insert(place, found);
        return Ok(Borders(all));
    }
    all.insert(place, [middle(0), middle(1), middle(2)]);
    Err(format!("this cannot be divided anywhere: {}", reason(system, &Borders(all))))
}

fn moved(
    system: &DescriptorSystem,
    borders: &Borders,
    border: usize,
    share: Share,
    to: usize,
) -> Result<Borders, String> {
    let Some(&from) = borders.0.get(border) else { return Ok(borders.clone()) };
    let (low, _) = borders.around(border, system);
    let (_, high) = borders.around(border + 1, system);
    let mut wish = from;
    let k = match share {
        Share::States => 0,
        Share::Equations => 1,
        Share::Outputs => 2,
    };
    wish[k] = to;
    let room = if k == 0 { low[0] + 1..=high[0].saturating_sub(1) } else { low[k]..=high[k] };
    if !room.contains(&to) {
        return Err(match share {
            Share::States => "every subsystem needs at least one state".to_owned(),
            Share::Equations => "there is no equation left to take".to_owned(),
            Share::Outputs => "there is no output left to take".to_owned(),
        });
    }
    if share == Share::States && from[1] == from[0] {
        // as far as there are equations
        wish[1] = to.clamp(low[1], high[1]);
    }
    let mut all = borders.0.clone();
    all[border] = allowed(system, wish, share, (low, high)).unwrap_or(wish);
    let all = Borders(all);
    if check_partition(system, &all.subsystems(system, Vec::new())).is_ok() {
        return Ok(all);
    }
    Err(format!("this border cannot lie there: {}", reason(system, &all)))
}

/// Which entry stands in the way.
fn reason(system: &DescriptorSystem, borders: &Borders) -> String {
    match check_partition(system, &borders.subsystems(system, Vec::new())) {
        Ok(()) => "the sizes do not fit".to_owned(),
        Err(error) => error.to_string(),
    }
}

/// Names follow their subsystems: of two that are joined the first name stays, a new one gets a number.
fn renamed(
    mut names: Vec<String>,
    after: &Borders,
    lost: Option<usize>,
    added: Option<usize>,
) -> Vec<String> {
    if let Some(border) = lost.filter(|border| border + 1 < names.len()) {
        names.remove(border + 1);
    }
    let count = after.0.len() + 1;
    if names.is_empty() {
        return (1..=count).map(|k| format!("subsystem {k}")).collect();
    }
    if let Some(border) = added {
        let fresh =
            (2..=names.len() + 2).map(|k| format!("subsystem {k}")).find(|name| !names.contains(name));
        names.insert((border + 1).min(names.len()), fresh.unwrap_or_default());
    }
    names
}

/// The lists of decoupled states follow their subsystems.
fn follow_lists(lists: &mut Vec<Vec<usize>>, lost: Option<usize>, added: Option<usize>) {
    if let Some(border) = lost.filter(|border| border + 1 < lists.len()) {
        let gone = lists.remove(border + 1);
        if let Some(list) = lists.get_mut(border) {
            // what both decoupled, the joined one does
            list.retain(|state| gone.contains(state));
        }
    }
    if let Some(border) = added {
        let copy = lists.get(border).cloned().unwrap_or_default();
        lists.insert((border + 1).min(lists.len()), copy);
    }
}
