//! Files by the desktop's own dialogs, each in a thread: a dialog waits for a person.

use std::fs::File;
use std::io::Read as _;
use std::path::Path;
use std::thread;

use crate::document::limits::MAX_BYTES;
use crate::platform::files::{Arrival, Files, Inbox, SavedFile, arrived, too_large};

/// Dialogs of the desktop.
pub(in crate::platform) struct Dialogs {
    inbox: Inbox,
}

impl Dialogs {
    pub(in crate::platform) fn new(inbox: Inbox) -> Self {
        Self { inbox }
    }

    fn in_thread(&self, work: impl FnOnce() -> Option<Arrival> + Send + 'static) {
        let outbox = self.inbox.outbox();
        let spawned = thread::Builder::new().name("files".to_owned()).spawn(move || {
            if let Some(arrival) = work() {
                outbox.send(arrival);
            }
        });
        if let Err(error) = spawned {
            self.inbox.outbox().send(Arrival::Problem(format!("no file dialog can be opened: {error}")));
        }
    }
}

impl Files for Dialogs {
    fn open(&mut self) {
        self.in_thread(|| {
            let dialog =
                rfd::FileDialog::new().set_title("Open a document").add_filter("document", &["json"]);
            dialog.pick_file().map(|path| read(&path))
        });
    }

    fn read_dropped(&mut self, file: egui::DroppedFileHandle) {
        self.in_thread(move || Some(read(file.path())));
    }

    fn save(&mut self, file: SavedFile) {
        self.in_thread(move || {
            let dialog = rfd::FileDialog::new().set_title("Save").set_file_name(&file.name);
            dialog.save_file().map(|path| match std::fs::write(&path, &file.bytes) {
                Ok(()) => Arrival::Done(format!("saved {}", path.display())),
                Err(error) => Arrival::Problem(format!("{} was not saved: {error}", path.display())),
            })
        });
    }

    fn share(&mut self, _fragment: &str) -> Option<String> {
        None
    }

    fn unshare(&mut self) {}

    fn poll(&mut self) -> Option<Arrival> {
        self.inbox.poll()
    }
}

/// The text of a document in a file, or why it cannot be read.
pub(in crate::platform) fn read(path: &Path) -> Arrival {
    let name = path.file_name().unwrap_or(path.as_os_str()).to_string_lossy().into_owned();
    let limited = || -> std::io::Result<Result<Vec<u8>, Arrival>> {
        let file = File::open(path)?;
        if let Some(problem) = too_large(&name, file.metadata()?.len()) {
            return Ok(Err(problem));
        }
        let mut bytes = Vec::new();
        // a pipe or a growing file tells no size: never more than one byte too many is read
        file.take(MAX_BYTES as u64 + 1).read_to_end(&mut bytes)?;
        Ok(Ok(bytes))
    };
    match limited() {
        Ok(Ok(bytes)) => arrived(name, bytes),
        Ok(Err(problem)) => problem,
        Err(error) => Arrival::Problem(format!("{name} was not read: {error}")),
    }
}
