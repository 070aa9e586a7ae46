//! L4: the application without a screen: state, commands, the one writer, jobs and what is derived.

mod analysis;
mod command;
mod derived;
mod edit_plant;
mod edit_scenario;
mod history;
mod job;
mod poles;
mod start;
mod state;
mod update;

pub use analysis::{Analysis, Light, MethodLight, Property, Simulation, analyse};
pub use command::{Cell, Command, Edit, Fill, Place, Show, SignalList, Size, Tab, ThemeChoice};
pub use derived::Derived;
pub use history::History;
pub use job::{JobReply, JobRequest, Outcome, Task, perform};
pub use poles::poles_text;
pub use start::{restored_view, view_text};
pub use state::{Draft, Field, Message, Session, View};
pub use update::{cell_name, update};
