//! Independent tasks on all processors.

use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread;

use crate::numerics::Executor;

/// Runs the tasks on as many threads as there are processors; the thread that asks works, too.
///
/// A task that is cancelled through its watch returns at once, so that a cancelled design ends as soon as the tasks that
/// run have heard of it.
#[derive(Clone, Copy, Debug, Default)]
pub struct Threads;

impl Executor for Threads {
    fn run(&self, tasks: usize, task: &(dyn Fn(usize) + Sync)) {
        let next = AtomicUsize::new(0);
        let work = || {
            loop {
                let number = next.fetch_add(1, Ordering::Relaxed);
                if number >= tasks {
                    return;
                }
                task(number);
            }
        };
        let workers = thread::available_parallelism().map_or(1, usize::from).min(tasks);
        thread::scope(|scope| {
            for _ in 1..workers {
                // a thread that cannot be started leaves its share to the others
                drop(thread::Builder::new().name("subsystem".to_owned()).spawn_scoped(scope, work));
            }
            work();
        });
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::Mutex;

    #[test]
    fn every_task_runs_once() {
        let ran = Mutex::new(Vec::new());
        Threads.run(100, &|number| ran.lock().unwrap().push(number));
        let mut ran = ran.into_inner().unwrap();
        ran.sort_unstable();
        assert_eq!(ran, (0..100).collect::<Vec<_>>(), "each number once, in whatever order");
        Threads.run(0, &|_| panic!("there is no task"));
    }
}
