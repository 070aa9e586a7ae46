//! Computations in threads.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, Sender, TryRecvError, channel};
use std::thread;

use crate::platform::Runner;
use crate::platform::timed::perform_timed;
use crate::session::{JobReply, JobRequest, Outcome};

/// Runs each computation in a thread of its own, so that one that is slow to stop keeps nobody waiting.
pub(in crate::platform) struct ThreadRunner {
    wake: Arc<dyn Fn() + Send + Sync>,
    running: Option<Running>,
    elapsed_ms: Option<f64>,
}

struct Running {
    id: u64,
    revision: u64,
    replies: Receiver<Sent>,
    stop: Arc<AtomicBool>,
}

/// A reply, with the duration when it is the last one.
struct Sent {
    reply: JobReply,
    elapsed_ms: Option<f64>,
}

impl ThreadRunner {
    pub(in crate::platform) fn new(wake: impl Fn() + Send + Sync + 'static) -> Self {
        Self { wake: Arc::new(wake), running: None, elapsed_ms: None }
    }
}

impl Runner for ThreadRunner {
    fn start(&mut self, request: JobRequest) {
        self.cancel();
        let (sender, replies) = channel();
        let stop = Arc::new(AtomicBool::new(false));
        let (id, revision) = (request.id, request.revision);
        let (wake, stopped, failed) = (Arc::clone(&self.wake), Arc::clone(&stop), sender.clone());
        self.running = Some(Running { id, revision, replies, stop });
        let thread = thread::Builder::new().name("computation".to_owned());
        let spawned = thread.spawn(move || {
            // the thread also wakes the screen when it unwinds: its closed channel is the message
            let woken = Arc::new(Wake(wake));
            work(&request, &sender, stopped, &woken);
        });
        if let Err(error) = spawned {
            let outcome = Outcome::Failed(format!("no thread could be started: {error}"));
            // the receiver is alive: it was stored above
            drop(failed.send(Sent { reply: JobReply { id, revision, outcome }, elapsed_ms: None }));
            (self.wake)();
        }
    }

    fn cancel(&mut self) {
        if let Some(running) = self.running.take() {
            running.stop.store(true, Ordering::Relaxed);
        }
    }

    fn poll(&mut self) -> Option<JobReply> {
        let running = self.running.as_ref()?;
        match running.replies.try_recv() {
            Ok(Sent { reply, elapsed_ms }) => {
                if !matches!(reply.outcome, Outcome::Progress { .. }) {
                    self.running = None;
                    self.elapsed_ms = elapsed_ms;
                }
                Some(reply)
            }
            Err(TryRecvError::Empty) => None,
            Err(TryRecvError::Disconnected) => {
                let why = "the computation stopped at an internal error, which the terminal shows";
                let reply = JobReply {
                    id: running.id,
                    revision: running.revision,
                    outcome: Outcome::Failed(why.to_owned()),
                };
                self.running = None;
                Some(reply)
            }
        }
    }

    fn elapsed_ms(&self) -> Option<f64> {
        self.elapsed_ms
    }
}

/// Wakes the screen when the thread is over, however it ends.
struct Wake(Arc<dyn Fn() + Send + Sync>);

impl Drop for Wake {
    fn drop(&mut self) {
        (self.0)();
    }
}

fn work(request: &JobRequest, sender: &Sender<Sent>, stop: Arc<AtomicBool>, wake: &Arc<Wake>) {
    let report = {
        let (sender, wake) = (sender.clone(), Arc::clone(wake));
        move |reply| {
            let heard = sender.send(Sent { reply, elapsed_ms: None }).is_ok();
            (wake.0)();
            heard
        }
    };
    let done = perform_timed(request, report, move || !stop.load(Ordering::Relaxed));
    if let Some((reply, elapsed_ms)) = done {
        // nobody listens to an abandoned computation
        drop(sender.send(Sent { reply, elapsed_ms: Some(elapsed_ms) }));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::paper::EXAMPLES;
    use crate::session::Task;

    fn request(id: u64) -> JobRequest {
        JobRequest { id, revision: id, document: EXAMPLES[0].text.to_owned(), task: Task::Analyse }
    }

    fn wait(runner: &mut dyn Runner) -> JobReply {
        for _ in 0..6000 {
            match runner.poll() {
                Some(JobReply { outcome: Outcome::Progress { .. }, .. }) => {}
                Some(reply) => return reply,
                None => thread::sleep(std::time::Duration::from_millis(10)),
            }
        }
        panic!("no reply in a minute");
    }

    #[test]
    fn a_thread_replies_and_tells_how_long_it_took() {
        let woken = Arc::new(AtomicBool::new(false));
        let flag = Arc::clone(&woken);
        let mut runner = ThreadRunner::new(move || flag.store(true, Ordering::Relaxed));
        runner.start(request(1));
        let reply = wait(&mut runner);
        assert!(matches!(reply.outcome, Outcome::Analysis(_)), "an analysis comes: {:?}", reply.outcome);
        assert!(runner.elapsed_ms().is_some_and(|ms| ms > 0.0), "its duration is known");
        thread::sleep(std::time::Duration::from_millis(50));
        assert!(woken.load(Ordering::Relaxed), "the screen was woken");
    }

    #[test]
    fn an_abandoned_computation_is_never_heard_of() {
        let mut runner = ThreadRunner::new(|| {});
        runner.start(request(1));
        runner.start(request(2));
        assert_eq!(wait(&mut runner).id, 2, "only the second replies");
        runner.start(request(3));
        runner.cancel();
        thread::sleep(std::time::Duration::from_millis(100));
        assert!(runner.poll().is_none(), "a cancelled computation does not reply");
    }
}
