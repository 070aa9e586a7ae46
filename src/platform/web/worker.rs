//! The worker's side: one more instance of the program, which computes and draws nothing.

use wasm_bindgen::prelude::*;

use crate::platform::message::{FromWorker, decode, encode};
use crate::platform::timed::perform_timed;
use crate::session::JobRequest;

/// Whether this instance of the program is a worker.
pub fn in_worker() -> bool {
    js_sys::global().is_instance_of::<web_sys::DedicatedWorkerGlobalScope>()
}

/// Makes a worker tell the page why it stopped, should it stop.
pub fn prepare_worker() {
    std::panic::set_hook(Box::new(|info| post(&FromWorker::Crashed(info.to_string()))));
}

/// Performs a request (bytes from the page); the replies are posted.
#[wasm_bindgen]
pub fn worker_run(bytes: &[u8]) {
    let request: JobRequest = match decode(bytes) {
        Ok(request) => request,
        Err(error) => return post(&FromWorker::Crashed(error.to_string())),
    };
    // a page stops its worker from outside: here nothing has to be asked
    let report = |reply| {
        post(&FromWorker::Reply { reply, elapsed_ms: None });
        true
    };
    if let Some((reply, elapsed_ms)) = perform_timed(&request, report, || true) {
        post(&FromWorker::Reply { reply, elapsed_ms: Some(elapsed_ms) });
    }
}

fn post(message: &FromWorker) {
    let scope: web_sys::DedicatedWorkerGlobalScope = js_sys::global().unchecked_into();
    let bytes = match encode(message) {
        Ok(bytes) => bytes,
        Err(error) => match encode(&FromWorker::Crashed(error.to_string())) {
            Ok(bytes) => bytes,
            Err(_) => return,
        },
    };
    let array = js_sys::Uint8Array::from(bytes.as_slice());
    let transfer = js_sys::Array::of1(&array.buffer());
    drop(scope.post_message_with_transfer(&array, &transfer));
}
