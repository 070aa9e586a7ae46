//! Where independent parts of a computation run: one after the other, or wherever a platform has room.

/// Runs independent tasks.
///
/// The layers below the platform start no threads; what they can run in parallel they hand to one of these.
pub trait Executor: Send + Sync {
    /// Calls `task(0)`, ..., `task(tasks - 1)`, each once, in any order and on any thread, and returns when all are done.
    fn run(&self, tasks: usize, task: &(dyn Fn(usize) + Sync));
}

/// One task after the other on the thread that asks.
#[derive(Clone, Copy, Debug, Default)]
pub struct Sequential;

impl Executor for Sequential {
    fn run(&self, tasks: usize, task: &(dyn Fn(usize) + Sync)) {
        (0..tasks).for_each(task);
    }
}
