//! L4: native and web: where computations run, files, clipboard, storage.

#[cfg(feature = "gui")]
pub mod files;
pub mod message;
#[cfg(not(target_arch = "wasm32"))]
pub mod native;
mod synchronous;
mod timed;
#[cfg(all(feature = "gui", target_arch = "wasm32"))]
pub mod web;

pub use synchronous::SynchronousRunner;

use crate::session::{JobReply, JobRequest};

/// Runs computations away from the screen: a thread natively, a worker in the browser.
pub trait Runner {
    /// Starts a computation; one that still runs is abandoned.
    fn start(&mut self, request: JobRequest);
    /// Stops whatever runs; its replies are never seen afterwards.
    fn cancel(&mut self);
    /// The next reply, when there is one.
    fn poll(&mut self) -> Option<JobReply>;

    /// Milliseconds that the newest finished computation took, without waiting and messages.
    fn elapsed_ms(&self) -> Option<f64> {
        None
    }

    /// What a person should know of the way computations run, once.
    fn note(&mut self) -> Option<String> {
        None
    }
}

/// The runner of this platform; `wake` is called when a reply waits.
#[cfg(not(target_arch = "wasm32"))]
pub fn runner(wake: impl Fn() + Send + Sync + 'static) -> Box<dyn Runner> {
    Box::new(native::ThreadRunner::new(wake))
}

/// The runner of this platform; `wake` is called when a reply waits.
#[cfg(all(target_arch = "wasm32", feature = "gui"))]
pub fn runner(wake: impl Fn() + Send + Sync + 'static) -> Box<dyn Runner> {
    Box::new(web::WorkerRunner::new(wake))
}

/// The runner of this platform; without a page there are no workers.
#[cfg(all(target_arch = "wasm32", not(feature = "gui")))]
pub fn runner(_wake: impl Fn() + Send + Sync + 'static) -> Box<dyn Runner> {
    Box::new(SynchronousRunner::default())
}
