//! L5: the screen: reads the session and what is derived, returns commands, writes nothing.

pub mod accessibility;
mod app;
mod blocks;
mod compare;
mod curve;
mod demand;
mod entry_grid;
pub mod figures_panel;
mod file_menu;
mod formula;
#[cfg(not(target_arch = "wasm32"))]
mod icon;
pub mod matrix_grid;
pub mod network;
pub mod observer;
pub mod plot;
pub mod pole_plane;
pub mod scenario;
mod shortcuts;
mod start;
#[cfg(target_arch = "wasm32")]
mod state_report;
mod status_bar;
pub mod system;
pub mod text_field;
pub mod theme;
mod top_bar;
mod window;

pub use app::App;
#[cfg(not(target_arch = "wasm32"))]
pub use start::open_window;
#[cfg(target_arch = "wasm32")]
pub use start::start_page;
pub use window::Window;

use crate::platform::files::FileRequest;
use crate::session::{Cell, Command, Edit, Show};

/// What a frame asks for.
#[derive(Debug, Default)]
pub struct Output {
    /// Commands, in the order of the clicks.
    pub commands: Vec<Command>,
    /// Stop the running computation.
    pub cancel: bool,
    /// Start a computation again that was stopped or broke off.
    pub again: bool,
    /// Files and links.
    pub files: Vec<FileRequest>,
}

impl Output {
    /// Asks for a change of the document.
    pub fn edit(&mut self, edit: Edit) {
        self.commands.push(Command::Edit(edit));
    }

    /// Asks for a change of what is shown.
    pub fn show(&mut self, show: Show) {
        self.commands.push(Command::Show(show));
    }
}

/// State of widgets that is neither document nor view: what is being typed, which cell is active.
#[derive(Debug, Default)]
pub struct Widgets {
    /// The text being typed into the focused field, with the field's id.
    pub typing: Option<(egui::Id, String)>,
    /// The active cell of a matrix, for pasting.
    pub active_cell: Option<Cell>,
    /// The condition whose explanation is open.
    pub open_condition: Option<String>,
    /// What is chosen of a network.
    pub network: network::NetworkWidgets,
}
