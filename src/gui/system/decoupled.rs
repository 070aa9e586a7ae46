//! Which states of the others each subsystem decouples exactly.

use egui::{RichText, Ui};

use super::super::{Output, formula, theme};
use crate::session::{Edit, LmiEdit, Session};
use crate::system::Subsystem;

/// Draws the choice, and a button for each state of another subsystem.
pub(super) fn show(ui: &mut Ui, session: &Session, partition: &[Subsystem], out: &mut Output) {
    let chosen = session.document().design.lmi.decoupled.as_ref();
    ui.horizontal_wrapped(|ui| {
        ui.label(RichText::new("Decoupled exactly").strong()).on_hover_text(
            "The influence of these states is kept from the estimates altogether; of the others, attenuated.",
        );
        let greedy = ui.selectable_label(chosen.is_none(), "As many as possible");
        if greedy.clicked() && chosen.is_some() {
            out.edit(Edit::Lmi(LmiEdit::Decoupled(None)));
        }
        let own = ui.selectable_label(chosen.is_some(), "Chosen").on_hover_text("Click on the states");
        if own.clicked() && chosen.is_none() {
            out.edit(Edit::Lmi(LmiEdit::Decoupled(Some(vec![Vec::new(); partition.len()]))));
        }
    });
    let Some(chosen) = chosen else { return };
    let owners: Vec<usize> =
        partition.iter().enumerate().flat_map(|(k, s)| std::iter::repeat_n(k, s.states)).collect();
    for (subsystem, of) in partition.iter().enumerate() {
        ui.horizontal_wrapped(|ui| {
            let number = subsystem + 1;
            let name = if of.name.is_empty() { format!("subsystem {number}") } else { of.name.clone() };
            formula::remark(ui, &format!("{name}:"));
            for (state, owner) in owners.iter().enumerate().filter(|(_, owner)| **owner != subsystem) {
                let exactly = chosen.get(subsystem).is_some_and(|list| list.contains(&state));
                let text = RichText::new(format!("x{}", state + 1)).color(theme::series(ui, *owner));
                let response = ui.selectable_label(exactly, text);
                let label = format!("subsystem {number} decouples x{}", state + 1);
                response.ctx.accesskit_node_builder(response.id, |node| node.set_label(label));
                if response.clicked() {
                    out.edit(Edit::Lmi(LmiEdit::Decouple { subsystem, state, exactly: !exactly }));
                }
            }
        });
    }
}
