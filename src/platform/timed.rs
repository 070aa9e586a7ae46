//! A computation with its duration and with progress that does not flood the screen.

use std::sync::{Mutex, PoisonError};

use web_time::{Duration, Instant};

use crate::numerics::Watch;
use crate::session::{JobReply, JobRequest, Outcome, perform_with};
use crate::simulation::Memo;

/// Time between two reports: each of them draws the screen anew.
const BETWEEN_REPORTS: Duration = Duration::from_millis(50);

/// Designs of the computations before. One that runs takes it along, so that two never wait for each other: one that is
/// slow to stop leaves the next without a memory, which costs time and nothing else.
static MEMO: Mutex<Memo> = Mutex::new(Memo::new());

/// Performs a request; gives the reply and its duration in milliseconds, or `None` when `report` said stop.
///
/// `report` hears of progress at most every 50 ms and answers whether to go on; `go_on` is asked at every step.
pub(super) fn perform_timed(
    request: &JobRequest,
    report: impl Fn(JobReply) -> bool + Send + Sync + 'static,
    go_on: impl Fn() -> bool + Send + Sync + 'static,
) -> Option<(JobReply, f64)> {
    let start = now();
    let reported = Mutex::new(start);
    let (id, revision) = (request.id, request.revision);
    let watch = Watch::new(move |fraction, what| {
        if !go_on() {
            return false;
        }
        let at = now();
        let mut reported = reported.lock().unwrap_or_else(PoisonError::into_inner);
        if at.duration_since(*reported) < BETWEEN_REPORTS {
            return true;
        }
        *reported = at;
        let outcome = Outcome::Progress { fraction, what: what.to_owned() };
        report(JobReply { id, revision, outcome })
    });
    let mut memo = std::mem::take(&mut *MEMO.lock().unwrap_or_else(PoisonError::into_inner));
    let reply = perform_with(&mut memo, request, &here(watch));
    *MEMO.lock().unwrap_or_else(PoisonError::into_inner) = memo;
    let reply = reply?;
    Some((reply, start.elapsed().as_secs_f64() * 1e3))
}

/// A watch with the processors of this machine; a worker in a browser has one.
fn here(watch: Watch) -> Watch {
    #[cfg(not(target_arch = "wasm32"))]
    let watch = watch.on(super::native::Threads);
    watch
}

/// The clock, which browsers have too.
#[cfg_attr(
    not(target_arch = "wasm32"),
    expect(
        clippy::disallowed_methods,
        reason = "natively web_time's clock is the one of the standard library"
    )
)]
fn now() -> Instant {
    Instant::now()
}
