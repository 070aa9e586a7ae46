//! L4: the application without a screen: state, commands, the one writer, jobs and what is derived.

mod analysis;
mod analysis_network;
mod analysis_properties;
mod apply;
mod command;
mod comparison;
mod derived;
mod edit_compare;
mod edit_coupling;
mod edit_free;
mod edit_lipschitz;
mod edit_lmi;
mod edit_network;
mod edit_partition;
mod edit_plant;
mod edit_scenario;
mod edit_sensor;
mod follow;
mod follow_initial;
mod follow_kept;
mod follow_network;
mod free_report;
mod history;
mod job;
mod model_edits;
mod network_edits;
mod new_network;
mod poles;
mod start;
mod state;
mod update;

pub use analysis::{Analysis, Property, Simulation, analyse};
pub use command::{
    Cell, Command, ComparedFigure, Edit, Fill, Place, Show, SignalList, Size, Tab, ThemeChoice,
};
pub use comparison::ComparisonView;
pub use derived::Derived;
pub use edit_compare::{CompareEdit, why_not_kept};
pub use edit_coupling::coupling_forms;
pub use edit_free::FreeEdit;
pub use free_report::FreeReport;
pub use history::History;
pub use job::{JobReply, JobRequest, Outcome, Task, perform, perform_with};
pub use model_edits::{GivenPart, LipschitzEdit, LipschitzMatrix, LmiEdit, PartitionEdit, Share};
pub use network_edits::{CouplingForm, Measure, NetworkCell, NetworkEdit, NetworkSize};
pub use poles::poles_text;
pub use start::{restored_view, view_text};
pub use state::{Draft, Field, Message, Session, View};
pub use update::{cell_name, update};

pub use crate::observer::{Light, MethodLight};
