//! A computation with its duration and with progress that does not flood the screen.

use web_time::{Duration, Instant};

use crate::session::{JobReply, JobRequest, Outcome, perform};

/// Time between two reports: each of them draws the screen anew.
const BETWEEN_REPORTS: Duration = Duration::from_millis(50);

/// Performs a request; gives the reply and its duration in milliseconds, or `None` when `report` said stop.
///
/// `report` hears of progress at most every 50 ms and answers whether to go on; `go_on` is asked at every step.
pub(super) fn perform_timed(
    request: &JobRequest,
    report: &mut dyn FnMut(JobReply) -> bool,
    go_on: &dyn Fn() -> bool,
) -> Option<(JobReply, f64)> {
    let start = Instant::now();
    let mut reported = start;
    let reply = perform(request, &mut |fraction, what| {
        if !go_on() {
            return false;
        }
        let now = Instant::now();
        if now.duration_since(reported) < BETWEEN_REPORTS {
            return true;
        }
        reported = now;
        let outcome = Outcome::Progress { fraction, what: what.to_owned() };
        report(JobReply { id: request.id, revision: request.revision, outcome })
    })?;
    Some((reply, start.elapsed().as_secs_f64() * 1e3))
}
