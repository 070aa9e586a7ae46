//! The page's side of its worker.

use std::cell::{Cell, RefCell};
use std::collections::VecDeque;
use std::rc::Rc;

use wasm_bindgen::prelude::*;

use super::page;
use crate::platform::message::{FromWorker, decode, encode};
use crate::platform::{Runner, SynchronousRunner};
use crate::session::{JobReply, JobRequest, Outcome};

/// The file that starts the program in a worker.
const SCRIPT: &str = "./worker.js";

/// What the page says when it has to compute itself.
const NO_WORKER: &str = "this browser gives the page no worker, so the page stands still while it computes";

/// Computes in a worker; where none can be started, on the page itself.
pub(in crate::platform) struct WorkerRunner {
    wake: Rc<dyn Fn()>,
    worker: Option<Worker>,
    /// The request that the worker performs, kept for the case that it never starts.
    request: Option<JobRequest>,
    fallback: Option<SynchronousRunner>,
    note: Option<String>,
    elapsed_ms: Option<f64>,
}

/// A worker and what it said.
struct Worker {
    handle: web_sys::Worker,
    heard: Rc<Heard>,
    _on_message: Closure<dyn FnMut(web_sys::MessageEvent)>,
    _on_error: Closure<dyn FnMut(web_sys::ErrorEvent)>,
}

#[derive(Default)]
struct Heard {
    ready: Cell<bool>,
    /// A request for a worker that is not ready yet.
    waiting: RefCell<Option<Vec<u8>>>,
    messages: RefCell<VecDeque<FromWorker>>,
}

impl WorkerRunner {
    pub(in crate::platform) fn new(wake: impl Fn() + 'static) -> Self {
        let wake: Rc<dyn Fn()> = Rc::new(wake);
        let mut runner =
            Self { wake, worker: None, request: None, fallback: None, note: None, elapsed_ms: None };
        // it starts while the page draws its first picture
        runner.ensure_worker();
        runner
    }

    fn ensure_worker(&mut self) {
        if self.worker.is_none() && self.fallback.is_none() {
            match Worker::spawn(&self.wake) {
                Ok(worker) => self.worker = Some(worker),
                Err(error) => self.fall_back(&page::words(&error)),
            }
        }
    }

    fn fall_back(&mut self, why: &str) {
        self.worker = None;
        self.note = Some(format!("{NO_WORKER} ({why})"));
        let mut fallback = SynchronousRunner::default();
        if let Some(request) = self.request.take() {
            fallback.start(request);
        }
        self.fallback = Some(fallback);
        (self.wake)();
    }

    /// The worker stopped: the running computation fails, the next one gets a new worker.
    fn crashed(&mut self, why: String) -> Option<JobReply> {
        let ready = self.worker.take().is_some_and(|worker| worker.heard.ready.get());
        if !ready {
            self.fall_back(&why);
            return self.fallback.as_mut().and_then(Runner::poll);
        }
        let request = self.request.take()?;
        let outcome = Outcome::Failed(why);
        Some(JobReply { id: request.id, revision: request.revision, outcome })
    }
}

impl Runner for WorkerRunner {
    fn start(&mut self, request: JobRequest) {
        self.cancel();
        self.ensure_worker();
        let Some(worker) = &self.worker else {
            if let Some(fallback) = &mut self.fallback {
                fallback.start(request);
                (self.wake)();
            }
            return;
        };
        match encode(&request) {
            Ok(bytes) => worker.send(bytes),
            Err(error) => {
                worker.heard.messages.borrow_mut().push_back(FromWorker::Crashed(error.to_string()));
                (self.wake)();
            }
        }
        self.request = Some(request);
    }

    fn cancel(&mut self) {
        if let Some(fallback) = &mut self.fallback {
            fallback.cancel();
        }
        // a worker hears nothing while it computes: it is ended, and the next computation gets a new one
        if self.request.take().is_some() {
            self.worker = None;
        }
    }

    fn poll(&mut self) -> Option<JobReply> {
        if let Some(fallback) = &mut self.fallback {
            return fallback.poll();
        }
        let message = self.worker.as_ref()?.heard.messages.borrow_mut().pop_front();
        match message? {
            FromWorker::Reply { reply, elapsed_ms } => {
                if !matches!(reply.outcome, Outcome::Progress { .. }) {
                    self.elapsed_ms = elapsed_ms;
                    self.request = None;
                }
                Some(reply)
            }
            FromWorker::Crashed(why) => self.crashed(why),
        }
    }

    fn elapsed_ms(&self) -> Option<f64> {
        self.fallback.as_ref().map_or(self.elapsed_ms, Runner::elapsed_ms)
    }

    fn note(&mut self) -> Option<String> {
        self.note.take()
    }
}

impl Worker {
    fn spawn(wake: &Rc<dyn Fn()>) -> Result<Self, JsValue> {
        let options = web_sys::WorkerOptions::new();
        options.set_type(web_sys::WorkerType::Module);
        let worker = web_sys::Worker::new_with_options(SCRIPT, &options)?;
        let heard = Rc::new(Heard::default());
        let on_message = {
            let (heard, wake, worker) = (Rc::clone(&heard), Rc::clone(wake), worker.clone());
            Closure::<dyn FnMut(_)>::new(move |event: web_sys::MessageEvent| {
                heard.message(&event.data(), &worker);
                wake();
            })
        };
        let on_error = {
            let (heard, wake) = (Rc::clone(&heard), Rc::clone(wake));
            Closure::<dyn FnMut(_)>::new(move |event: web_sys::ErrorEvent| {
                // it is told below, not in the browser's console
                event.prevent_default();
                let reason =
                    js_sys::Reflect::get(&event, &"message".into()).ok().and_then(|text| text.as_string());
                let why = reason.unwrap_or_else(|| format!("{SCRIPT} could not be loaded"));
                heard.messages.borrow_mut().push_back(FromWorker::Crashed(why));
                wake();
            })
        };
        worker.set_onmessage(Some(on_message.as_ref().unchecked_ref()));
        worker.set_onerror(Some(on_error.as_ref().unchecked_ref()));
        // the program as it is already compiled: no second download, no second compilation
        worker.post_message(&wasm_bindgen::module())?;
        Ok(Self { handle: worker, heard, _on_message: on_message, _on_error: on_error })
    }

    fn send(&self, bytes: Vec<u8>) {
        if self.heard.ready.get() {
            post(&self.handle, &bytes);
        } else {
            *self.heard.waiting.borrow_mut() = Some(bytes);
        }
    }
}

impl Drop for Worker {
    fn drop(&mut self) {
        self.handle.set_onmessage(None);
        self.handle.set_onerror(None);
        self.handle.terminate();
    }
}

impl Heard {
    fn message(&self, data: &JsValue, worker: &web_sys::Worker) {
        if data.as_string().as_deref() == Some("ready") {
            self.ready.set(true);
            if let Some(bytes) = self.waiting.borrow_mut().take() {
                post(worker, &bytes);
            }
            return;
        }
        let bytes = js_sys::Uint8Array::new(data).to_vec();
        let message = decode(&bytes).unwrap_or_else(|error| FromWorker::Crashed(error.to_string()));
        self.messages.borrow_mut().push_back(message);
    }
}

/// Hands bytes over without a copy; a worker that ended meanwhile is told of by its error event.
fn post(worker: &web_sys::Worker, bytes: &[u8]) {
    let array = js_sys::Uint8Array::from(bytes);
    let transfer = js_sys::Array::of1(&array.buffer());
    drop(worker.post_message_with_transfer(&array, &transfer));
}
