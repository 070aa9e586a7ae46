//! The application in a window or a page: files, links, storage.

use eframe::{CreationContext, Frame, Storage};

use super::App;
use crate::document::{to_link_fragment, write_document};
use crate::platform::files::{Arrival, FileRequest, Files, SavedFile, file_name, files, linked};
use crate::platform::runner;
use crate::session::{Command, Session, View, restored_view, view_text};

/// Keys of the platform's storage.
const DOCUMENT: &str = "document";
const VIEW: &str = "view";

/// Time from a change to its place in the storage.
const SAVE_AFTER: std::time::Duration = std::time::Duration::from_secs(1);

/// The application with what surrounds it.
pub struct Window {
    app: App,
    files: Box<dyn Files>,
    frames: u64,
    /// What the storage holds.
    saved: Option<(u64, View)>,
    /// Revision of the document that the page's address holds.
    linked: Option<u64>,
}

impl std::fmt::Debug for Window {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Window").field("app", &self.app).field("frames", &self.frames).finish_non_exhaustive()
    }
}

impl Window {
    /// Starts with the document of the page's address, of the last time, or with the first example.
    ///
    /// # Errors
    /// When the first example cannot be read.
    pub fn new(
        creation: &CreationContext<'_>,
    ) -> Result<Self, Box<dyn std::error::Error + Send + Sync + 'static>> {
        let stored = |key: &str| creation.storage?.get_string(key);
        let link = linked();
        let mut session = Session::begin(link.as_deref(), stored(DOCUMENT).as_deref())?;
        if let Some(text) = stored(VIEW) {
            session.show_again(restored_view(&text));
        }
        let linked = link.is_some().then_some(session.revision());
        let wake = || {
            let ctx = creation.egui_ctx.clone();
            move || ctx.request_repaint()
        };
        let app = App::new(&creation.egui_ctx, session, runner(wake()));
        Ok(Self { app, files: files(wake()), frames: 0, saved: None, linked })
    }

    /// The application.
    pub fn app(&self) -> &App {
        &self.app
    }

    /// How many frames were drawn.
    pub fn frames(&self) -> u64 {
        self.frames
    }

    fn take_dropped(&mut self, ctx: &egui::Context) {
        let dropped = ctx.input(|input| input.raw.dropped_files.clone());
        match dropped.as_slice() {
            [] => {}
            [file] => self.files.read_dropped(std::sync::Arc::clone(file)),
            several => self.app.tell(
                format!("{} files were dropped; one document can be opened at a time", several.len()),
                true,
            ),
        }
    }

    fn take_arrivals(&mut self) {
        while let Some(arrival) = self.files.poll() {
            self.take(arrival);
        }
    }

    /// Opens a document that has arrived, or says what became of a request.
    pub(super) fn take(&mut self, arrival: Arrival) {
        match arrival {
            Arrival::Document { name, text } => self.app.open(&name, text),
            Arrival::Done(sentence) => self.app.tell(sentence, false),
            Arrival::Problem(sentence) => self.app.tell(sentence, true),
        }
    }

    fn carry_out(&mut self, ctx: &egui::Context, request: FileRequest) {
        let session = self.app.session();
        match request {
            FileRequest::Open => self.files.open(),
            FileRequest::SaveDocument => self.files.save(SavedFile {
                name: file_name(&session.document().title, "json"),
                mime: "application/json",
                bytes: write_document(session.document()).into_bytes(),
            }),
            FileRequest::CopyDocument => {
                ctx.copy_text(write_document(session.document()));
                self.app.tell("copied the document's text", false);
            }
            FileRequest::ShareLink => {
                let revision = session.revision();
                match self.files.share(&to_link_fragment(session.document())) {
                    Some(address) => {
                        ctx.copy_text(address);
                        self.linked = Some(revision);
                        self.app.tell("copied the address: it holds the whole document", false);
                    }
                    None => {
                        self.app.tell("the address could not be changed: copy the document instead", true);
                    }
                }
            }
            FileRequest::Save(file) => self.files.save(file),
        }
    }

    fn state(&self) -> (u64, View) {
        (self.app.session().revision(), self.app.session().view().clone())
    }

    /// After an edit the address no longer holds what is shown: loading the page again must not undo the edit.
    fn forget_old_link(&mut self) {
        if self.linked.is_some_and(|revision| revision != self.app.session().revision()) {
            self.linked = None;
            self.files.unshare();
        }
    }
}

impl eframe::App for Window {
    fn ui(&mut self, ui: &mut egui::Ui, _frame: &mut Frame) {
        self.frames += 1;
        let ctx = ui.ctx().clone();
        self.take_dropped(&ctx);
        self.take_arrivals();
        self.app.show(ui);
        for request in self.app.take_file_requests() {
            self.carry_out(&ctx, request);
            ctx.request_repaint();
        }
        self.forget_old_link();
        if self.saved.as_ref() != Some(&self.state()) {
            // the storage is looked after at the end of a frame: make sure that there is one
            ctx.request_repaint_after(SAVE_AFTER + std::time::Duration::from_millis(100));
        }
    }

    fn save(&mut self, storage: &mut dyn Storage) {
        let state = self.state();
        if self.saved.as_ref() != Some(&state) {
            storage.set_string(DOCUMENT, self.app.session().document_text());
            storage.set_string(VIEW, view_text(&state.1));
            storage.flush();
            self.saved = Some(state);
        }
    }

    fn auto_save_interval(&self) -> std::time::Duration {
        SAVE_AFTER
    }

    fn persist_egui_memory(&self) -> bool {
        false
    }

    #[cfg(target_arch = "wasm32")]
    fn as_any_mut(&mut self) -> Option<&mut dyn std::any::Any> {
        Some(self)
    }

    fn clear_color(&self, visuals: &egui::Visuals) -> [f32; 4] {
        visuals.panel_fill.to_normalized_gamma_f32()
    }
}

impl App {
    /// Opens the text of a file.
    fn open(&mut self, name: &str, text: String) {
        let before = self.session().revision();
        self.command(Command::Open { text });
        if self.session().revision() != before {
            self.tell(format!("opened {name}"), false);
        }
    }
}
