//! The page: its worker, files, address and start. Only this folder names the browser's interfaces.

mod files;
mod page;
mod start;
mod worker;
mod worker_runner;

pub(super) use files::PageFiles;
pub(super) use page::linked;
pub use start::{debug_state, mirror, start};
pub use worker::{in_worker, prepare_worker, worker_run};
pub(super) use worker_runner::WorkerRunner;
