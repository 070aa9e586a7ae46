//! What was computed for the session, and what is still to be computed.

use std::collections::BTreeMap;

use super::analysis::Analysis;
use super::command::Tab;
use super::comparison::ComparisonView;
use super::job::{JobReply, JobRequest, Outcome, TRADE_OFF, Task};
use super::state::Session;
use crate::paper::FigureSpec;

/// Why a computation broke off that a person stopped.
const CANCELLED: &str = "cancelled";

/// Results by the revision of the document that they belong to; recomputed, never saved.
#[derive(Debug, Default)]
pub struct Derived {
    analysis: Option<(u64, Box<Analysis>)>,
    figures: BTreeMap<String, (u64, Result<FigureSpec, String>)>,
    comparison: Option<(u64, Result<Box<ComparisonView>, String>)>,
    running: Option<JobRequest>,
    progress: (f32, String),
    failure: Option<String>,
    /// What failed or was cancelled, with its revision, so that it is not started again by itself.
    given_up: Vec<(u64, Task)>,
    elapsed_ms: Option<f64>,
    next_id: u64,
}

impl Derived {
    /// The newest analysis; it may belong to an earlier revision while the next is computed.
    pub fn analysis(&self) -> Option<&Analysis> {
        self.analysis.as_ref().map(|(_, analysis)| analysis.as_ref())
    }

    /// Whether the newest analysis belongs to that revision.
    pub fn is_current(&self, revision: u64) -> bool {
        self.analysis.as_ref().is_some_and(|(of, _)| *of == revision)
    }

    /// The newest result for a figure.
    pub fn figure(&self, id: &str) -> Option<&Result<FigureSpec, String>> {
        self.figures.get(id).map(|(_, figure)| figure)
    }

    /// The newest picture of a sweep.
    pub fn trade_off(&self) -> Option<&Result<FigureSpec, String>> {
        self.figure(TRADE_OFF)
    }

    /// The newest comparison, or why there is none; it may belong to an earlier revision while the next is computed.
    pub fn comparison(&self) -> Option<Result<&ComparisonView, &str>> {
        self.comparison.as_ref().map(|(_, found)| found.as_deref().map_err(String::as_str))
    }

    /// Whether the newest comparison belongs to that revision.
    pub fn is_compared(&self, revision: u64) -> bool {
        self.comparison.as_ref().is_some_and(|(of, _)| *of == revision)
    }

    /// What is being computed, how far it is.
    pub fn running(&self) -> Option<(&Task, f32, &str)> {
        self.running.as_ref().map(|job| (&job.task, self.progress.0, self.progress.1.as_str()))
    }

    /// Why the last computation broke off.
    pub fn failure(&self) -> Option<&str> {
        self.failure.as_deref()
    }

    /// How long the newest analysis took, in milliseconds, when the platform has a clock.
    pub fn elapsed_ms(&self) -> Option<f64> {
        self.elapsed_ms
    }

    /// Whether a person stopped the last computation.
    pub fn was_cancelled(&self) -> bool {
        self.failure.as_deref() == Some(CANCELLED)
    }

    /// Whether what is being computed belongs to an earlier revision.
    pub fn is_outdated(&self, revision: u64) -> bool {
        self.running.as_ref().is_some_and(|job| job.revision != revision)
    }

    /// Takes a reply together with the duration of its computation in milliseconds.
    pub fn receive_timed(&mut self, reply: JobReply, elapsed_ms: Option<f64>) {
        let awaited = self.running.as_ref().is_some_and(|job| job.id == reply.id);
        if awaited && matches!(reply.outcome, Outcome::Analysis(_)) {
            self.elapsed_ms = elapsed_ms;
        }
        self.receive(reply);
    }

    /// The next request, when nothing runs and something is out of date.
    ///
    /// The analysis comes first; then the comparison or the chosen figure, when it is on screen. Without an analysis, because
    /// it was given up, the others wait: they would begin with the same design.
    pub fn next_request(&mut self, session: &Session) -> Option<JobRequest> {
        if self.running.is_some() {
            return None;
        }
        let revision = session.revision();
        let given_up =
            |task: &Task| self.given_up.iter().any(|(of, broken)| *of == revision && broken == task);
        let task = if !self.is_current(revision) {
            Task::Analyse
        } else if session.view().tab == Tab::Compare {
            if self.is_compared(revision) {
                return None;
            }
            Task::Compare
        } else {
            let id = match session.view().tab {
                Tab::Figures => session.view().figure.clone()?,
                Tab::TradeOff => TRADE_OFF.to_owned(),
                _ => return None,
            };
            let exists = id == TRADE_OFF || session.document().figures.iter().any(|figure| figure.id == id);
            let current = self.figures.get(&id).is_some_and(|(of, _)| *of == revision);
            if current || !exists {
                return None;
            }
            Task::Figure { id }
        };
        if given_up(&task) {
            return None;
        }
        self.next_id += 1;
        let request = JobRequest { id: self.next_id, revision, document: session.document_text(), task };
        self.progress = (0.0, String::new());
        self.running = Some(request.clone());
        Some(request)
    }

    /// Takes a reply; one that nobody waits for any more is dropped.
    pub fn receive(&mut self, reply: JobReply) {
        if self.running.as_ref().is_none_or(|job| job.id != reply.id) {
            return;
        }
        match reply.outcome {
            Outcome::Progress { fraction, what } => {
                self.progress = (fraction, what);
                return;
            }
            Outcome::Analysis(analysis) => {
                self.analysis = Some((reply.revision, analysis));
                self.failure = None;
            }
            Outcome::Comparison(found) => self.comparison = Some((reply.revision, found)),
            Outcome::Figure { id, figure } => {
                self.figures.insert(id, (reply.revision, figure));
            }
            Outcome::Failed(why) => self.break_off(why),
        }
        self.running = None;
    }

    /// The running computation was cancelled.
    pub fn cancelled(&mut self) {
        self.break_off(CANCELLED.to_owned());
        self.running = None;
    }

    /// The running computation is abandoned, because its document has changed.
    pub fn abandoned(&mut self) {
        self.running = None;
    }

    /// What was stopped or broke off may start again.
    pub fn again(&mut self) {
        self.given_up.clear();
        self.failure = None;
        self.figures.retain(|_, (_, figure)| figure.is_ok());
        self.comparison.take_if(|(_, found)| found.is_err());
    }

    /// Gives the running computation up. The last results stay; only where there are none, the reason takes their place.
    fn break_off(&mut self, why: String) {
        if let Some(JobRequest { task, revision, .. }) = self.running.take() {
            match &task {
                Task::Figure { id } if !self.figures.get(id).is_some_and(|(_, figure)| figure.is_ok()) => {
                    self.figures.insert(id.clone(), (revision, Err(why.clone())));
                }
                Task::Compare if !self.comparison.as_ref().is_some_and(|(_, found)| found.is_ok()) => {
                    self.comparison = Some((revision, Err(why.clone())));
                }
                Task::Analyse | Task::Figure { .. } | Task::Compare => {}
            }
            self.given_up.retain(|(of, _)| *of == revision);
            self.given_up.push((revision, task));
        }
        self.failure = Some(why);
    }
}
