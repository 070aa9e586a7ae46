//! Buttons for what mends a condition of a network.

use crate::session::{Edit, Measure, NetworkEdit};

/// The button for a remedy of a hierarchical observer's condition, and what it does; `None` for other remedies.
pub(in crate::gui) fn button(condition: &str, remedy: &str) -> Option<(String, Edit)> {
    let (text, measure) = match condition {
        "003-11-Psi" => ("Use row 1 of Gamma".to_owned(), Measure::ReceivedOnly { subsystem: 0 }),
        "003-11-cG" if remedy.ends_with("for example c_I itself") => {
            ("Use c".to_owned(), Measure::CouplingOutputOnly)
        }
        "003-P1-global" if remedy.starts_with("adding the rows of c_I") => {
            ("Add the rows of c".to_owned(), Measure::CouplingOutput)
        }
        "003-P1-global" => {
            let subsystem = number(remedy, "adding row ")?;
            (format!("Add row {} of Gamma", subsystem + 1), Measure::Received { subsystem })
        }
        "003-P1-local" => {
            let state = number(remedy, "measuring state x")?;
            (format!("Measure x{} locally", state + 1), Measure::LocalState { state })
        }
        _ => return None,
    };
    Some((text, Edit::Network(NetworkEdit::Measure(measure))))
}

/// The number behind the first words of a sentence, from zero.
fn number(sentence: &str, words: &str) -> Option<usize> {
    let digits: String = sentence.strip_prefix(words)?.chars().take_while(char::is_ascii_digit).collect();
    digits.parse::<usize>().ok()?.checked_sub(1)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::document::{Document, Entry, PlantData, read_document};
    use crate::numerics::Watch;
    use crate::observer::{Method, assess};
    use crate::session::{Command, Session, update};

    fn broken(how: impl Fn(&mut crate::document::NetworkData)) -> Document {
        let mut document = read_document(include_str!("../../../tests/documents/003-network.json")).unwrap();
        document.design.method = Method::Hierarchical;
        let PlantData::Network(data) = &mut document.plant else { unreachable!("a network") };
        how(data);
        document
    }

    fn failing(document: &Document) -> Vec<(String, Vec<String>)> {
        let model = document.model().unwrap();
        let found = assess(&model, &document.design, &document.tolerance, &Watch::none()).unwrap();
        let failing = found.conditions.into_iter().filter(|c| c.needed && !c.verdict.holds());
        failing.map(|condition| (condition.id, condition.remedies)).collect()
    }

    #[test]
    fn every_remedy_has_a_button_that_mends_its_condition() {
        let psi = broken(|data| data.Psi.set(0, 3, Entry::number(1.0)));
        let output = broken(|data| data.c_G.set(0, 1, Entry::number(1.0)));
        let local = broken(|data| {
            data.a.set(0, 0, Entry::number(3.8));
            data.c_L.set(0, 0, Entry::number(0.0));
            data.c_L.set(1, 1, Entry::number(0.0));
            data.c_L.set(1, 4, Entry::number(1.0));
        });
        // the last row of Gamma alone shows nothing of what the first three do in common with it
        let global = broken(|data| {
            for (column, value) in [0.0, 0.0, 0.0, 0.0].into_iter().enumerate() {
                data.Psi.set(0, column, Entry::number(value));
            }
            data.a.set(0, 0, Entry::number(3.8));
        });
        for (document, id) in
            [(psi, "003-11-Psi"), (output, "003-11-cG"), (local, "003-P1-local"), (global, "003-P1-global")]
        {
            let failed = failing(&document);
            let (_, remedies) = failed.iter().find(|(found, _)| found == id).unwrap();
            assert!(!remedies.is_empty(), "{id} has a remedy");
            for remedy in remedies {
                let (text, edit) = button(id, remedy).unwrap();
                let mut session = Session::new(document.clone());
                update(&mut session, Command::Edit(edit));
                let left = failing(session.document());
                assert!(
                    left.iter().all(|(left, _)| left != id),
                    "{id}: \"{text}\" for \"{remedy}\" mends it"
                );
            }
        }
        assert!(button("004-9", "measure x3: ...").is_none(), "another paper's condition");
    }
}
