//! L4: native and web: where computations run, files, clipboard, storage.

#[cfg(not(target_arch = "wasm32"))]
pub mod native;

use crate::session::{JobReply, JobRequest};

/// Runs computations away from the screen: a thread natively, a worker in the browser.
pub trait Runner {
    /// Starts a computation; one that still runs is abandoned.
    fn start(&mut self, request: JobRequest);
    /// Stops whatever runs; its replies are never seen afterwards.
    fn cancel(&mut self);
    /// The next reply, when there is one.
    fn poll(&mut self) -> Option<JobReply>;
}
