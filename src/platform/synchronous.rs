//! Computing where one stands: for tests, and for pages whose browser gives no worker.

use super::Runner;
use super::timed::perform_timed;
use crate::session::{JobReply, JobRequest};

/// Computes when it is polled; whoever polls waits.
#[derive(Debug, Default)]
pub struct SynchronousRunner {
    request: Option<JobRequest>,
    elapsed_ms: Option<f64>,
}

impl Runner for SynchronousRunner {
    fn start(&mut self, request: JobRequest) {
        self.request = Some(request);
    }

    fn cancel(&mut self) {
        self.request = None;
    }

    fn poll(&mut self) -> Option<JobReply> {
        let request = self.request.take()?;
        let (reply, elapsed_ms) = perform_timed(&request, |_| true, || true)?;
        self.elapsed_ms = Some(elapsed_ms);
        Some(reply)
    }

    fn elapsed_ms(&self) -> Option<f64> {
        self.elapsed_ms
    }
}
