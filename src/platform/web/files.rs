//! Files by the browser's own picker and downloads.

use wasm_bindgen::prelude::*;
use wasm_bindgen_futures::{JsFuture, spawn_local};

use super::page;
use crate::platform::files::{Arrival, Files, Inbox, Outbox, SavedFile, arrived, too_large};

/// Files of a page.
pub(in crate::platform) struct PageFiles {
    inbox: Inbox,
}

impl PageFiles {
    pub(in crate::platform) fn new(inbox: Inbox) -> Self {
        Self { inbox }
    }

    fn try_open(&self) -> Result<(), JsValue> {
        let input: web_sys::HtmlInputElement = document()?.create_element("input")?.dyn_into()?;
        input.set_type("file");
        input.set_accept(".json,application/json");
        let (chosen, outbox) = (input.clone(), self.inbox.outbox());
        let on_change = Closure::once_into_js(move || {
            if let Some(file) = chosen.files().and_then(|files| files.get(0)) {
                read(file, outbox);
            }
        });
        input.set_onchange(Some(on_change.unchecked_ref()));
        input.click();
        Ok(())
    }
}

impl Files for PageFiles {
    fn open(&mut self) {
        if let Err(error) = self.try_open() {
            let why = format!("no file can be chosen: {}", page::words(&error));
            self.inbox.outbox().send(Arrival::Problem(why));
        }
    }

    fn read_dropped(&mut self, file: egui::DroppedFileHandle) {
        if let Some(file) = file.web_file() {
            read(file.clone(), self.inbox.outbox());
        }
    }

    fn save(&mut self, file: SavedFile) {
        let arrival = match download(&file) {
            Ok(()) => Arrival::Done(format!("saved {}", file.name)),
            Err(error) => Arrival::Problem(format!("{} was not saved: {}", file.name, page::words(&error))),
        };
        self.inbox.outbox().send(arrival);
    }

    fn share(&mut self, fragment: &str) -> Option<String> {
        page::set_fragment(fragment)
    }

    fn unshare(&mut self) {
        drop(page::set_fragment(""));
    }

    fn poll(&mut self) -> Option<Arrival> {
        self.inbox.poll()
    }
}

fn document() -> Result<web_sys::Document, JsValue> {
    web_sys::window().and_then(|window| window.document()).ok_or_else(|| "the page has no document".into())
}

fn read(file: web_sys::File, outbox: Outbox) {
    spawn_local(async move {
        let name = file.name();
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "sizes are whole")]
        let size = file.size() as u64;
        if let Some(problem) = too_large(&name, size) {
            return outbox.send(problem);
        }
        outbox.send(match JsFuture::from(file.array_buffer()).await {
            Ok(buffer) => arrived(name, js_sys::Uint8Array::new(&buffer).to_vec()),
            Err(error) => Arrival::Problem(format!("{name} was not read: {}", page::words(&error))),
        });
    });
}

fn download(file: &SavedFile) -> Result<(), JsValue> {
    let parts = js_sys::Array::of1(&js_sys::Uint8Array::from(file.bytes.as_slice()));
    let options = web_sys::BlobPropertyBag::new();
    options.set_type(file.mime);
    let blob = web_sys::Blob::new_with_u8_array_sequence_and_options(&parts, &options)?;
    let address = web_sys::Url::create_object_url_with_blob(&blob)?;
    let anchor: web_sys::HtmlAnchorElement = document()?.create_element("a")?.dyn_into()?;
    anchor.set_href(&address);
    anchor.set_download(&file.name);
    anchor.click();
    web_sys::Url::revoke_object_url(&address)
}
