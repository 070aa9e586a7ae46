//! How a long computation tells how far it is, learns that it is no longer wanted, and finds processors for its parts.

use std::fmt;
use std::sync::Arc;

use super::executor::{Executor, Sequential};

/// Receives progress and answers whether to go on; cheap to clone, so that it can be handed into a solver.
///
/// The fraction runs from 0 to 1; [`Self::part`] maps a step's own 0 to 1 into the whole.
#[derive(Clone)]
pub struct Watch {
    listener: Arc<dyn Fn(f32, &str) -> bool + Send + Sync>,
    executor: Arc<dyn Executor>,
    from: f32,
    to: f32,
}

impl Watch {
    /// A watch that tells `listener` the fraction and what is being done, and stops when it answers `false`.
    pub fn new(listener: impl Fn(f32, &str) -> bool + Send + Sync + 'static) -> Self {
        Self { listener: Arc::new(listener), executor: Arc::new(Sequential), from: 0.0, to: 1.0 }
    }

    /// A watch that nobody looks at and that never stops anything.
    pub fn none() -> Self {
        Self::new(|_, _| true)
    }

    /// The same watch, with independent parts of the computation on another executor than one after the other.
    #[must_use]
    pub fn on(self, executor: impl Executor + 'static) -> Self {
        Self { executor: Arc::new(executor), ..self }
    }

    /// Where independent parts of the computation run.
    pub fn executor(&self) -> &dyn Executor {
        self.executor.as_ref()
    }

    /// Tells how far the computation is; `false` when it should stop.
    #[must_use]
    pub fn go_on(&self, fraction: f32, what: &str) -> bool {
        let inside = fraction.clamp(0.0, 1.0);
        (self.listener)(self.from + (self.to - self.from) * inside, what)
    }

    /// A watch for a step that fills the stretch `from..to` of this one.
    pub fn part(&self, from: f32, to: f32) -> Self {
        let place = |x: f32| self.from + (self.to - self.from) * x.clamp(0.0, 1.0);
        Self { from: place(from), to: place(to), ..self.clone() }
    }
}

impl fmt::Debug for Watch {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Watch").field("from", &self.from).field("to", &self.to).finish_non_exhaustive()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::Mutex;

    #[test]
    fn a_part_reports_within_the_whole() {
        let heard = Arc::new(Mutex::new(Vec::new()));
        let ear = Arc::clone(&heard);
        let watch = Watch::new(move |fraction, _| {
            ear.lock().unwrap().push(fraction);
            fraction < 0.9
        });
        let part = watch.part(0.5, 1.0);
        assert!(part.go_on(0.0, "begin"), "half of the whole");
        assert!(part.part(0.0, 0.5).go_on(1.0, "nested"), "three quarters of the whole");
        assert!(!part.go_on(2.0, "end"), "the listener says stop");
        assert_eq!(*heard.lock().unwrap(), [0.5, 0.75, 1.0], "mapped and clamped");
    }
}
