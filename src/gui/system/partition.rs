//! The subsystems: names, sizes, and which of the others' states they decouple.

use egui::{CollapsingHeader, RichText, Sense, Ui, vec2};

use super::super::{Output, formula, theme};
use super::{decoupled, steps};
use crate::document::{DescriptorData, EntryMatrix};
use crate::session::{Edit, PartitionEdit, Session, Share};
use crate::system::{Subsystem, check_partition};

/// Draws the subsystems, or a button that makes some.
pub(super) fn show(ui: &mut Ui, session: &Session, data: &DescriptorData, out: &mut Output) {
    let partition = &data.partition;
    let title = match partition.len() {
        0 => "Subsystems: none".to_owned(),
        count => format!("Subsystems: {count}"),
    };
    CollapsingHeader::new(RichText::new(title).strong())
        .id_salt(("partition", partition.is_empty()))
        .default_open(!partition.is_empty())
        .show_unindented(ui, |ui| {
            if partition.is_empty() {
                formula::remark(
                    ui,
                    "For decentralized observers: E and C must be block diagonal, A may couple.",
                );
                if ui.button("Divide into subsystems").clicked() {
                    out.edit(Edit::Partition(PartitionEdit::Split { subsystem: 0 }));
                }
                return;
            }
            let rectangular = partition.iter().any(|s| s.states != s.equations);
            for k in 0..partition.len() {
                ui.push_id(("subsystem", k), |ui| one(ui, partition, k, rectangular, out));
            }
            violated(ui, data);
            if ui.button("Remove the partition").clicked() {
                out.edit(Edit::Partition(PartitionEdit::Clear));
            }
            decoupled::show(ui, session, partition, out);
        });
}

/// Names the entry that stands in the way, should a document come with one.
fn violated(ui: &mut Ui, data: &DescriptorData) {
    let found = data.system().ok().and_then(|system| check_partition(&system, &data.partition).err());
    if let Some(error) = found {
        ui.colored_label(theme::bad(ui), error.to_string());
    }
}

fn one(ui: &mut Ui, partition: &[Subsystem], k: usize, rectangular: bool, out: &mut Output) {
    let subsystem = &partition[k];
    ui.horizontal(|ui| {
        let (rect, _) = ui.allocate_exact_size(vec2(12.0, 12.0), Sense::hover());
        ui.painter().rect_filled(rect, 3.0, theme::series(ui, k));
        let mut name = subsystem.name.clone();
        let width = (ui.available_width() - 150.0).max(80.0);
        let field = egui::TextEdit::singleline(&mut name)
            .id(egui::Id::unique(("subsystem name", k)))
            .hint_text(format!("subsystem {}", k + 1))
            .desired_width(width);
        let response = ui.add(field);
        response.ctx.accesskit_node_builder(response.id, |node| {
            node.set_label(format!("Name of subsystem {}", k + 1))
        });
        if response.changed() {
            out.edit(Edit::Partition(PartitionEdit::Name { subsystem: k, name }));
        }
        let mut button = |text: &str, word: &str, hint: &str, edit: PartitionEdit| {
            let response = ui.button(text).on_hover_text(hint);
            let label = format!("{word} subsystem {}", k + 1);
            response.ctx.accesskit_node_builder(response.id, |node| node.set_label(label));
            if response.clicked() {
                out.edit(Edit::Partition(edit));
            }
        };
        button("Divide", "Divide", "Into two, where E and C allow it", PartitionEdit::Split { subsystem: k });
        let other = if k + 1 < partition.len() { "With the next one" } else { "With the one before" };
        button("Join", "Join", other, PartitionEdit::Join { subsystem: k });
    });
    ui.horizontal_wrapped(|ui| {
        let mut shares =
            vec![(Share::States, "states", subsystem.states), (Share::Outputs, "outputs", subsystem.outputs)];
        if rectangular {
            shares.insert(1, (Share::Equations, "equations", subsystem.equations));
        }
        for (share, word, count) in shares {
            let label = format!("{word} of subsystem {}", k + 1);
            if let Some(grow) = steps(ui, &label, word, count)
                && let Some(edit) = moved(partition, k, share, grow)
            {
                out.edit(Edit::Partition(edit));
            }
        }
    });
}

/// A subsystem takes from, or gives to, the one behind it; the last one trades with the one before it.
fn moved(partition: &[Subsystem], k: usize, share: Share, grow: bool) -> Option<PartitionEdit> {
    let size = |subsystem: &Subsystem| match share {
        Share::States => subsystem.states,
        Share::Equations => subsystem.equations,
        Share::Outputs => subsystem.outputs,
    };
    let last = k + 1 == partition.len();
    let border = if last { k.checked_sub(1)? } else { k };
    let at: usize = partition.iter().take(border + 1).map(size).sum();
    let forward = grow != last;
    let to = if forward { at + 1 } else { at.checked_sub(1)? };
    Some(PartitionEdit::Move { border, share, to, done: true })
}

/// Rows and columns, for the remark of a matrix.
pub(super) fn shape(matrix: &EntryMatrix) -> String {
    let (rows, columns) = matrix.shape();
    format!("{rows} x {columns}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steppers_move_the_border_that_a_subsystem_has() {
        let one = |states| Subsystem { states, ..Subsystem::default() };
        let partition = [one(2), one(3), one(4)];
        let to = |k, grow| match moved(&partition, k, Share::States, grow) {
            Some(PartitionEdit::Move { border, to, .. }) => (border, to),
            other => unreachable!("{other:?}"),
        };
        assert_eq!((to(0, true), to(1, true), to(2, true)), ((0, 3), (1, 6), (1, 4)), "one more");
        assert_eq!((to(0, false), to(1, false), to(2, false)), ((0, 1), (1, 4), (1, 6)), "one fewer");
    }
}
