//! The application: runs commands and jobs, then draws.

use crate::platform::Runner;
use crate::platform::files::FileRequest;
use crate::session::{Command, Derived, Place, Session, update};

use super::{figures_panel, observer, status_bar, system, theme, top_bar};

/// The whole application on a screen.
pub struct App {
    session: Session,
    derived: Derived,
    runner: Box<dyn Runner>,
    /// State of widgets that is not worth saving: open menus, active cell.
    widgets: super::Widgets,
    /// Time at which a running computation was first seen to be out of date.
    outdated_since: Option<f64>,
    /// What was asked of the platform.
    file_requests: Vec<FileRequest>,
}

impl std::fmt::Debug for App {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("App").field("session", &self.session).finish_non_exhaustive()
    }
}

impl App {
    /// Starts with a session; `runner` performs its computations.
    pub fn new(ctx: &egui::Context, session: Session, runner: Box<dyn Runner>) -> Self {
        theme::install(ctx);
        Self {
            session,
            derived: Derived::default(),
            runner,
            widgets: super::Widgets::default(),
            outdated_since: None,
            file_requests: Vec::new(),
        }
    }

    /// The session.
    pub fn session(&self) -> &Session {
        &self.session
    }

    /// What was computed for it.
    pub fn derived(&self) -> &Derived {
        &self.derived
    }

    /// Carries out a command.
    pub fn command(&mut self, command: Command) {
        update(&mut self.session, command);
    }

    /// Shows a sentence that does not come from a command.
    pub fn tell(&mut self, text: impl Into<String>, error: bool) {
        self.session.tell(text, error);
    }

    /// What was asked of the platform since the last call.
    pub fn take_file_requests(&mut self) -> Vec<FileRequest> {
        std::mem::take(&mut self.file_requests)
    }

    /// Takes replies and starts the next computation.
    pub fn run_jobs(&mut self) {
        while let Some(reply) = self.runner.poll() {
            self.derived.receive_timed(reply, self.runner.elapsed_ms());
        }
        if let Some(note) = self.runner.note() {
            self.session.tell(note, false);
        }
        if let Some(request) = self.derived.next_request(&self.session) {
            self.runner.start(request);
        }
    }

    /// Abandons a long computation whose document has changed; a short one may finish and be shown on the way.
    fn abandon_outdated(&mut self, ctx: &egui::Context) {
        const PATIENCE: f64 = 2.0;
        if !self.derived.is_outdated(self.session.revision()) {
            self.outdated_since = None;
            return;
        }
        let now = ctx.input(|input| input.time);
        let since = *self.outdated_since.get_or_insert(now);
        if now - since > PATIENCE {
            self.outdated_since = None;
            self.runner.cancel();
            self.derived.abandoned();
        } else {
            ctx.request_repaint_after(std::time::Duration::from_secs_f64(0.1 + PATIENCE - (now - since)));
        }
    }

    /// Draws everything and carries out what was asked for.
    pub fn show(&mut self, ui: &mut egui::Ui) {
        self.abandon_outdated(ui.ctx());
        self.run_jobs();
        theme::choose(ui.ctx(), self.session.view().theme);
        let mut out = super::Output::default();
        super::shortcuts::take(ui.ctx(), &mut out);
        super::file_menu::shortcuts(ui.ctx(), &mut out);
        egui::Panel::top("top").show(ui, |ui| top_bar::show(ui, &self.session, &mut self.widgets, &mut out));
        egui::Panel::bottom("status")
            .show(ui, |ui| status_bar::show(ui, &self.session, &self.derived, &mut out));
        if theme::is_narrow(ui) {
            self.narrow(ui, &mut out);
        } else {
            self.wide(ui, &mut out);
        }
        self.carry_out(ui.ctx(), out);
    }

    fn wide(&mut self, ui: &mut egui::Ui, out: &mut super::Output) {
        let total = ui.available_width();
        let Self { session, derived, widgets, .. } = self;
        egui::Panel::left("system")
            .default_size((total * 0.27).clamp(280.0, 440.0))
            .size_range(220.0..=620.0)
            .show(ui, |ui| {
                scroll(ui, "system-scroll", |ui| system::show(ui, session, derived, widgets, out));
            });
        egui::Panel::left("observer")
            .default_size((total * 0.28).clamp(290.0, 440.0))
            .size_range(260.0..=700.0)
            .show(ui, |ui| {
                scroll(ui, "observer-scroll", |ui| observer::show(ui, session, derived, widgets, out));
            });
        egui::CentralPanel::default().show(ui, |ui| figures_panel::show(ui, session, derived, widgets, out));
    }

    fn narrow(&mut self, ui: &mut egui::Ui, out: &mut super::Output) {
        let Self { session, derived, widgets, .. } = self;
        egui::CentralPanel::default().show(ui, |ui| {
            top_bar::places(ui, session, out);
            ui.separator();
            match session.view().place {
                Place::System => {
                    scroll(ui, "system-scroll", |ui| system::show(ui, session, derived, widgets, out));
                }
                Place::Observer => {
                    scroll(ui, "observer-scroll", |ui| {
                        observer::show(ui, session, derived, widgets, out);
                    });
                }
                Place::Figures => figures_panel::show(ui, session, derived, widgets, out),
            }
        });
    }

    fn carry_out(&mut self, ctx: &egui::Context, mut out: super::Output) {
        self.file_requests.append(&mut out.files);
        let any = !out.commands.is_empty();
        for command in out.commands {
            self.command(command);
        }
        if out.cancel {
            self.runner.cancel();
            self.derived.cancelled();
        }
        if out.again {
            self.derived.again();
        }
        if any || out.again {
            // the computation starts in this frame, not with the next event
            self.run_jobs();
            ctx.request_repaint();
        }
    }
}

fn scroll(ui: &mut egui::Ui, id: &str, content: impl FnOnce(&mut egui::Ui)) {
    egui::ScrollArea::vertical().id_salt(id).auto_shrink([false, false]).show(ui, content);
}
