//! How a session begins: with the document of a link, of the last time, or with the first example.

use super::command::{ComparedFigure, Place, Tab, ThemeChoice};
use super::state::{Session, View};
use crate::document::{DocumentError, from_link_fragment, is_link_fragment, read_document};

impl Session {
    /// Begins with the document of a link, else with the stored one, else with the first example.
    ///
    /// `link` is the fragment of the page's address; one that does not mean a document is ignored. What cannot be
    /// read is named in the status line, and the next choice is opened instead.
    ///
    /// # Errors
    /// When even the first example cannot be read, which a test excludes.
    pub fn begin(link: Option<&str>, stored: Option<&str>) -> Result<Self, DocumentError> {
        let mut problem = None;
        if let Some(link) = link.filter(|link| is_link_fragment(link)) {
            match from_link_fragment(link) {
                Ok(document) => {
                    let mut session = Self::new(document);
                    session.tell("opened the document of the link", false);
                    return Ok(session);
                }
                Err(error) => problem = Some(format!("the link's document was not opened: {error}")),
            }
        }
        if let Some(stored) = stored {
            match read_document(stored) {
                Ok(document) => return Ok(Self::new(document).with_problem(problem)),
                Err(error) => {
                    let lost = format!("the document of the last time was not opened: {error}");
                    problem = Some(problem.map_or(lost.clone(), |first| format!("{first}; {lost}")));
                }
            }
        }
        Ok(Self::with_first_example()?.with_problem(problem))
    }

    fn with_problem(mut self, problem: Option<String>) -> Self {
        if let Some(problem) = problem {
            self.tell(problem, true);
        }
        self
    }

    /// Shows what was shown the last time, as far as it still exists.
    pub fn show_again(&mut self, view: View) {
        let known = |id: &String| self.document.figures.iter().any(|figure| figure.id == *id);
        let figure = view.figure.filter(known).or_else(|| self.view.figure.take());
        self.view = View { figure, ..view };
    }
}

const THEMES: [(ThemeChoice, &str); 3] =
    [(ThemeChoice::System, "system"), (ThemeChoice::Light, "light"), (ThemeChoice::Dark, "dark")];
const PLACES: [(Place, &str); 3] =
    [(Place::System, "system"), (Place::Observer, "observer"), (Place::Figures, "figures")];

/// What is shown, as text for the platform's storage.
pub fn view_text(view: &View) -> String {
    let name = |found: Option<&str>| found.unwrap_or_default().to_owned();
    let lines = [
        format!("tab {}", view.tab.title()),
        format!("theme {}", name(THEMES.iter().find(|(theme, _)| *theme == view.theme).map(|(_, n)| *n))),
        format!("place {}", name(PLACES.iter().find(|(place, _)| *place == view.place).map(|(_, n)| *n))),
        format!("compared {}", view.compared.title()),
        format!("figure {}", view.figure.as_deref().unwrap_or_default()),
    ];
    lines.join("\n")
}

/// Reads what [`view_text`] wrote; whatever is not understood stays as it is by default.
pub fn restored_view(text: &str) -> View {
    let mut view = View::default();
    for (key, value) in text.lines().filter_map(|line| line.split_once(' ')) {
        match key {
            "tab" => view.tab = Tab::ALL.into_iter().find(|tab| tab.title() == value).unwrap_or_default(),
            "compared" => {
                let found = ComparedFigure::ALL.into_iter().find(|figure| figure.title() == value);
                view.compared = found.unwrap_or_default();
            }
            "theme" => {
                view.theme =
                    THEMES.iter().find(|(_, n)| *n == value).map(|(theme, _)| *theme).unwrap_or_default();
            }
            "place" => {
                view.place =
                    PLACES.iter().find(|(_, n)| *n == value).map(|(place, _)| *place).unwrap_or_default();
            }
            "figure" if !value.is_empty() => view.figure = Some(value.to_owned()),
            _ => {}
        }
    }
    view
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::document::to_link_fragment;
    use crate::paper::EXAMPLES;

    fn titled(title: &str) -> (String, String) {
        let mut document = read_document(EXAMPLES[1].text).unwrap();
        document.title = title.to_owned();
        (crate::document::write_document(&document), to_link_fragment(&document))
    }

    #[test]
    fn a_link_comes_before_the_storage_before_the_example() {
        let ((_, link), (stored, _)) = (titled("linked"), titled("stored"));
        let title = |link, stored| Session::begin(link, stored).unwrap().document().title.clone();
        assert_eq!(title(Some(&link), Some(&stored)), "linked", "both");
        assert_eq!(title(None, Some(&stored)), "stored", "no link");
        assert_eq!(title(Some("#section"), Some(&stored)), "stored", "another fragment is not ours");
        let first = read_document(EXAMPLES[0].text).unwrap().title;
        assert_eq!(title(None, None), first, "nothing");
    }

    #[test]
    fn what_cannot_be_read_is_said() {
        let (stored, link) = titled("stored");
        let session = Session::begin(Some(&link[..20]), Some(&stored)).unwrap();
        assert_eq!(session.document().title, "stored", "the next choice");
        let message = session.message().unwrap();
        assert!(message.error && message.text.contains("cut off"), "{message:?}");
        let session = Session::begin(Some(&link[..20]), Some("{")).unwrap();
        let message = session.message().unwrap();
        assert!(message.text.contains("link") && message.text.contains("last time"), "{message:?}");
    }

    #[test]
    fn the_view_comes_back() {
        for tab in Tab::ALL {
            let view = View {
                tab,
                theme: ThemeChoice::Dark,
                place: Place::Observer,
                figure: Some("figure 3".to_owned()),
                compared: ComparedFigure::Gains,
            };
            assert_eq!(restored_view(&view_text(&view)), view, "{tab:?}");
        }
        assert_eq!(restored_view("nonsense\ntab Nowhere"), View::default(), "damaged storage");
        let mut session = Session::begin(None, None).unwrap();
        let figure = session.view().figure.clone();
        session.show_again(View { figure: Some("gone".to_owned()), ..View::default() });
        assert_eq!(session.view().figure, figure, "a figure that is gone is not shown");
    }
}
