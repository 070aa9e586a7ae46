//! Files and links: what is asked of the platform and what comes back.

use std::sync::Arc;
use std::sync::mpsc::{Receiver, Sender, channel};

use crate::document::limits::MAX_BYTES;

/// What a person asks for.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum FileRequest {
    /// Choose a document and open it.
    Open,
    /// Save the document.
    SaveDocument,
    /// Put the document into the page's address and copy that address.
    ShareLink,
    /// Copy the document's text.
    CopyDocument,
    /// Save something that was exported.
    Save(SavedFile),
}

/// A file to be saved.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SavedFile {
    /// Proposed name.
    pub name: String,
    /// Type, for example `image/svg+xml`.
    pub mime: &'static str,
    /// Contents.
    pub bytes: Vec<u8>,
}

/// What came of a request.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Arrival {
    /// The text of a document to be opened.
    Document {
        /// Name of the file.
        name: String,
        /// Its text.
        text: String,
    },
    /// Something was done, as a sentence.
    Done(String),
    /// Something went wrong, as a sentence.
    Problem(String),
}

/// Files and links of a platform. Nothing here waits: results arrive later.
pub trait Files {
    /// Lets a person choose a document.
    fn open(&mut self);
    /// Reads a file that was dropped.
    fn read_dropped(&mut self, file: egui::DroppedFileHandle);
    /// Saves a file where a person chooses.
    fn save(&mut self, file: SavedFile);
    /// Puts a fragment (with its `#`) into the page's address, which is returned; `None` where there is no address.
    fn share(&mut self, fragment: &str) -> Option<String>;
    /// Takes the fragment out of the page's address: the document is another one now.
    fn unshare(&mut self);
    /// The next result.
    fn poll(&mut self) -> Option<Arrival>;
}

/// Whether documents can be shared by an address.
pub const HAS_LINKS: bool = cfg!(target_arch = "wasm32");

/// The text of a document in a file, or why it cannot be read.
#[cfg(not(target_arch = "wasm32"))]
pub fn read_file(path: &std::path::Path) -> Arrival {
    super::native::dialogs::read(path)
}

/// The fragment in the page's address, with its `#`.
pub fn linked() -> Option<String> {
    #[cfg(target_arch = "wasm32")]
    return super::web::linked();
    #[cfg(not(target_arch = "wasm32"))]
    None
}

/// The files of this platform; `wake` is called when a result waits.
pub fn files(wake: impl Fn() + Send + Sync + 'static) -> Box<dyn Files> {
    let inbox = Inbox::new(wake);
    #[cfg(not(target_arch = "wasm32"))]
    return Box::new(super::native::dialogs::Dialogs::new(inbox));
    #[cfg(target_arch = "wasm32")]
    Box::new(super::web::PageFiles::new(inbox))
}

/// Where results wait.
pub(super) struct Inbox {
    sender: Outbox,
    receiver: Receiver<Arrival>,
}

/// The other end of an [`Inbox`].
#[derive(Clone)]
pub(super) struct Outbox {
    sender: Sender<Arrival>,
    wake: Arc<dyn Fn() + Send + Sync>,
}

impl Inbox {
    fn new(wake: impl Fn() + Send + Sync + 'static) -> Self {
        let (sender, receiver) = channel();
        Self { sender: Outbox { sender, wake: Arc::new(wake) }, receiver }
    }

    pub(super) fn outbox(&self) -> Outbox {
        self.sender.clone()
    }

    pub(super) fn poll(&self) -> Option<Arrival> {
        self.receiver.try_recv().ok()
    }
}

impl Outbox {
    pub(super) fn send(&self, arrival: Arrival) {
        // nobody waits for it any more when the window is closed
        drop(self.sender.send(arrival));
        (self.wake)();
    }
}

/// The sentence for a file that is too large to be a document, before it is read.
pub(super) fn too_large(name: &str, bytes: u64) -> Option<Arrival> {
    let limit = MAX_BYTES as u64;
    (bytes > limit).then(|| {
        Arrival::Problem(format!(
            "{name} has {:.1} MB; a document has at most {:.1} MB",
            bytes as f64 / 1e6,
            limit as f64 / 1e6
        ))
    })
}

/// The bytes of a file as a document's text.
pub(super) fn arrived(name: String, bytes: Vec<u8>) -> Arrival {
    if let Some(problem) = too_large(&name, bytes.len() as u64) {
        return problem;
    }
    match String::from_utf8(bytes) {
        Ok(text) => Arrival::Document { name, text },
        Err(_) => Arrival::Problem(format!("{name} is not a text file; documents are JSON texts")),
    }
}

/// A file name from a title: letters and digits, the rest becomes `-`.
pub fn file_name(title: &str, extension: &str) -> String {
    let mut name = String::new();
    for letter in title.chars().take(60) {
        if letter.is_alphanumeric() {
            name.extend(letter.to_lowercase());
        } else if !name.is_empty() && !name.ends_with('-') {
            name.push('-');
        }
    }
    let name = name.trim_end_matches('-');
    format!("{}.{extension}", if name.is_empty() { "document" } else { name })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_of_files_are_plain() {
        assert_eq!(file_name("A: \"sampled\" machine / 2", "json"), "a-sampled-machine-2.json", "a title");
        assert_eq!(file_name("../..", "json"), "document.json", "nothing usable");
    }

    #[test]
    fn what_cannot_be_a_document_is_named() {
        let big = arrived("big.json".to_owned(), vec![b' '; MAX_BYTES + 1]);
        assert!(matches!(&big, Arrival::Problem(why) if why.contains("big.json")), "too large: {big:?}");
        let binary = arrived("x.png".to_owned(), vec![0xff, 0xfe]);
        assert!(matches!(&binary, Arrival::Problem(why) if why.contains("not a text")), "binary: {binary:?}");
        let text = arrived("x.json".to_owned(), b"{}".to_vec());
        assert!(matches!(text, Arrival::Document { .. }), "a text is for the reader to judge");
    }
}
