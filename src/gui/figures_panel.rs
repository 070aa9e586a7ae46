//! What happens: the views over time and frequency, the figures, the scenario.

use egui::{RichText, ScrollArea, Ui, vec2};

use super::observer::errata;
use super::plot::{Place, figure_ui, notes_ui, panel_ui, panels_ui, short};
use super::pole_plane::{Poles, pole_plane_ui};
use super::{Output, Widgets, compare, scenario, theme};
use crate::document::{figure_to_csv, figure_to_svg};
use crate::numerics::Complex64;
use crate::observer::show as show_pole;
use crate::paper::{FigureRecipe, FigureSpec, Panel};
use crate::platform::files::{FileRequest, SavedFile, file_name};
use crate::session::{Analysis, Derived, Session, Show, Simulation, Tab};

/// Height of the overview's upper row.
const OVERVIEW_TOP: f32 = 240.0;

/// Draws the place of the figures.
pub fn show(ui: &mut Ui, session: &Session, derived: &Derived, widgets: &mut Widgets, out: &mut Output) {
    tabs(ui, session.view().tab, out);
    if let Some(figure) = shown_figure(session, derived) {
        exports(ui, session, figure, out);
    }
    scenario::show(ui, session, derived, widgets, out);
    ui.separator();
    let tab = session.view().tab;
    if tab == Tab::Figures {
        paper_figures(ui, session, derived, out);
        return;
    }
    if tab == Tab::TradeOff {
        trade_off(ui, derived);
        return;
    }
    if tab == Tab::Compare {
        compare::show(ui, session, derived, widgets, out);
        return;
    }
    let Some(analysis) = derived.analysis() else {
        waiting(ui, derived, "computing");
        return;
    };
    match tab {
        Tab::Overview => overview(ui, (session, derived), analysis, out),
        Tab::States => simulated(ui, analysis, |ui, simulation| figure_ui(ui, &simulation.states, "view")),
        Tab::Errors => simulated(ui, analysis, |ui, simulation| figure_ui(ui, &simulation.errors, "view")),
        Tab::UnknownInput => {
            simulated(ui, analysis, |ui, simulation| figure_ui(ui, &simulation.unknown_input, "view"));
        }
        Tab::Poles => poles(ui, session, derived, out),
        Tab::Bode => bode(ui, analysis),
        Tab::TradeOff | Tab::Compare | Tab::Figures => {}
    }
}

/// Designs along a sweep; the last picture stays until the next has arrived.
fn trade_off(ui: &mut Ui, derived: &Derived) {
    match derived.trade_off() {
        Some(Ok(figure)) => figure_ui(ui, figure, "trade-off"),
        Some(Err(why)) => nothing(ui, "Nothing to sweep", why),
        None => waiting(ui, derived, "designing along the sweep"),
    }
}

fn bode(ui: &mut Ui, analysis: &Analysis) {
    match (&analysis.bode, &analysis.simulation) {
        (Some(figure), _) => figure_ui(ui, figure, "view"),
        (None, Err(why)) => no_simulation(ui, why),
        (None, Ok(_)) => {
            ui.label("The system has no unknown input, so there is no response to show.");
        }
    }
}

fn tabs(ui: &mut Ui, current: Tab, out: &mut Output) {
    ui.horizontal_wrapped(|ui| {
        for tab in Tab::ALL {
            if ui.selectable_label(tab == current, tab.title()).clicked() {
                out.show(Show::Tab(tab));
            }
        }
    });
}

/// The figure that is on screen, as far as it is one.
fn shown_figure<'a>(session: &Session, derived: &'a Derived) -> Option<&'a FigureSpec> {
    let analysis = derived.analysis();
    let simulation = analysis.and_then(|analysis| analysis.simulation.as_ref().ok());
    match session.view().tab {
        Tab::Overview | Tab::Poles => None,
        Tab::States => simulation.map(|simulation| &simulation.states),
        Tab::Errors => simulation.map(|simulation| &simulation.errors),
        Tab::UnknownInput => simulation.map(|simulation| &simulation.unknown_input),
        Tab::Bode => analysis?.bode.as_ref(),
        Tab::TradeOff => derived.trade_off()?.as_ref().ok(),
        Tab::Compare => compare::figure(session, derived),
        Tab::Figures => {
            let id = session.view().figure.as_deref()?;
            derived.figure(id)?.as_ref().ok()
        }
    }
}

/// Buttons that save the figure on screen.
fn exports(ui: &mut Ui, session: &Session, figure: &FigureSpec, out: &mut Output) {
    ui.horizontal(|ui| {
        ui.colored_label(theme::faint(ui), "Save this figure as");
        let mut button =
            |name: &str, extension: &str, mime: &'static str, write: fn(&FigureSpec) -> String| {
                if ui.small_button(name).clicked() {
                    let title = format!("{} {}", session.document().title, figure.id);
                    out.files.push(FileRequest::Save(SavedFile {
                        name: file_name(&title, extension),
                        mime,
                        bytes: write(figure).into_bytes(),
                    }));
                }
            };
        button("SVG", "svg", "image/svg+xml", figure_to_svg);
        button("CSV", "csv", "text/csv", figure_to_csv);
    });
}

/// A quiet word while there is nothing to show yet, or why there never will be.
fn waiting(ui: &mut Ui, derived: &Derived, what: &str) {
    match derived.failure() {
        Some(why) if derived.running().is_none() => {
            ui.colored_label(theme::bad(ui), why);
        }
        _ => {
            ui.add_space(theme::BLOCK_GAP);
            ui.colored_label(theme::faint(ui), what);
        }
    }
}

/// A view of the simulation, or in words why there is none.
fn simulated(ui: &mut Ui, analysis: &Analysis, view: impl FnOnce(&mut Ui, &Simulation)) {
    match &analysis.simulation {
        Ok(simulation) => {
            rms_line(ui, simulation);
            notes_ui(ui, &simulation.notes);
            view(ui, simulation);
        }
        Err(why) => no_simulation(ui, why),
    }
}

fn no_simulation(ui: &mut Ui, why: &str) {
    nothing(ui, "Nothing to simulate", why);
}

/// What there is not, and why.
fn nothing(ui: &mut Ui, what: &str, why: &str) {
    ui.add_space(theme::BLOCK_GAP);
    ui.colored_label(theme::near(ui), RichText::new(what).strong());
    // reasons begin in lower case, since they also stand behind a colon
    let mut letters = why.chars();
    let first = letters.next().map(char::to_uppercase).into_iter().flatten();
    ui.label(first.chain(letters).collect::<String>());
}

/// Root mean square errors, each in the colour of its quantity.
fn rms_line(ui: &mut Ui, simulation: &Simulation) {
    ui.horizontal_wrapped(|ui| {
        ui.spacing_mut().item_spacing.x = 10.0;
        ui.colored_label(theme::faint(ui), "rms error over the second half:");
        if let Some(rms) = simulation.rms_whole {
            ui.label(format!("z {}", short(rms)));
        }
        let states = simulation.estimated.iter().zip(&simulation.rms);
        let states = states.map(|(&k, rms)| (format!("x{}", k + 1), k, rms));
        let unknown =
            simulation.rms_unknown.iter().enumerate().map(|(k, rms)| (format!("d{}", k + 1), 7 + k, rms));
        for (name, colour, rms) in states.chain(unknown) {
            ui.colored_label(theme::series(ui, colour), format!("{name} {}", short(*rms)));
        }
    });
}

/// Unknown input above, on a narrow screen the poles, states below.
fn overview(ui: &mut Ui, (session, derived): (&Session, &Derived), analysis: &Analysis, out: &mut Output) {
    let Ok(simulation) = &analysis.simulation else {
        if let Err(why) = &analysis.simulation {
            no_simulation(ui, why);
        }
        if theme::is_narrow(ui) {
            ui.add_space(theme::BLOCK_GAP);
            pole_plane_ui(ui, session, derived, vec2(ui.available_width(), OVERVIEW_TOP), out);
        }
        return;
    };
    rms_line(ui, simulation);
    notes_ui(ui, &simulation.notes);
    ScrollArea::vertical().id_salt("overview").auto_shrink([false, false]).show(ui, |ui| {
        let unknown = simulation.unknown_input.panels.iter().find(|panel| is_unknown_input(panel));
        let width = ui.available_width();
        let height = OVERVIEW_TOP.min(0.45 * ui.available_height()).max(170.0);
        if let Some(panel) = unknown {
            let place = Place { id_salt: "overview", at: 1000, size: vec2(width, height), x_label: false };
            panel_ui(ui, panel, &place);
        }
        // on a wide screen the plane stands in the observer's place
        if theme::is_narrow(ui) {
            pole_plane_ui(ui, session, derived, vec2(width, height), out);
        }
        let states: Vec<&Panel> = simulation.states.panels.iter().collect();
        panels_ui(ui, &states, simulation.states.columns, "overview");
    });
}

/// Whether a panel shows an unknown input: its title is `d1`, `d2`, ...
fn is_unknown_input(panel: &Panel) -> bool {
    panel
        .title
        .strip_prefix('d')
        .is_some_and(|number| !number.is_empty() && number.bytes().all(|b| b.is_ascii_digit()))
}

/// The plane with lists of all poles beside it.
fn poles(ui: &mut Ui, session: &Session, derived: &Derived, out: &mut Output) {
    const LIST: f32 = 200.0;
    let poles = Poles::collect(session, derived);
    let hint = if poles.by_region {
        "The modes of the error lie in the coloured region; the demand on the decay moves its border."
    } else {
        "Drag a cross, or focus it and use the arrow keys (with Shift: finer)."
    };
    ui.colored_label(theme::faint(ui), hint);
    if ui.available_width() > 540.0 {
        let size = vec2(ui.available_width() - LIST - theme::BLOCK_GAP, ui.available_height() - 4.0);
        ui.horizontal_top(|ui| {
            pole_plane_ui(ui, session, derived, size.max(vec2(200.0, 200.0)), out);
            ScrollArea::vertical().id_salt("pole-list").show(ui, |ui| pole_lists(ui, &poles));
        });
    } else {
        let size = vec2(ui.available_width(), (0.6 * ui.available_height()).max(200.0));
        pole_plane_ui(ui, session, derived, size, out);
        ScrollArea::vertical().id_salt("pole-list").show(ui, |ui| pole_lists(ui, &poles));
    }
}

fn pole_lists(ui: &mut Ui, poles: &Poles) {
    ui.vertical(|ui| {
        if !poles.by_region {
            egui::Grid::new("poles").striped(true).spacing([16.0, 3.0]).show(ui, |ui| {
                ui.colored_label(theme::accent(ui), "x  requested");
                ui.colored_label(theme::good(ui), "•  achieved");
                ui.end_row();
                for (k, wished) in poles.wished[..poles.used].iter().enumerate() {
                    ui.monospace(show_pole(*wished));
                    ui.monospace(poles.achieved.get(k).map_or_else(|| "-".to_owned(), |z| show_pole(*z)));
                    ui.end_row();
                }
            });
        }
        let list = |ui: &mut Ui, title: &str, colour: egui::Color32, values: &[Complex64]| {
            if values.is_empty() {
                return;
            }
            ui.add_space(theme::ITEM_GAP);
            ui.colored_label(colour, title);
            for value in values {
                ui.monospace(show_pole(*value));
            }
        };
        if poles.by_region {
            list(ui, "•  modes of the error", theme::good(ui), &poles.achieved);
        }
        list(ui, "waiting, not used by this order", theme::faint(ui), &poles.wished[poles.used..]);
        list(ui, "fixed modes, which no gain moves", theme::near(ui), &poles.fixed);
        list(ui, "finite eigenvalues of the plant", theme::faint(ui), &poles.plant);
    });
}

/// The chosen figure of the document with arrows to its neighbours.
fn paper_figures(ui: &mut Ui, session: &Session, derived: &Derived, out: &mut Output) {
    let figures = &session.document().figures;
    if figures.is_empty() {
        ui.label("This document has no figures of its own. The examples have some.");
        return;
    }
    let current = session.view().figure.as_deref().and_then(|id| figures.iter().position(|f| f.id == id));
    choose_figure(ui, figures, current, out);
    let Some(recipe) = current.map(|k| &figures[k]) else {
        ui.colored_label(theme::faint(ui), "Choose a figure.");
        return;
    };
    errata::beside_example(ui, session, &recipe.id, "the figure");
    match derived.figure(&recipe.id) {
        Some(Ok(figure)) => figure_ui(ui, figure, "paper"),
        Some(Err(why)) => {
            ui.colored_label(theme::bad(ui), RichText::new("This figure could not be drawn").strong());
            ui.label(why);
        }
        None => waiting(ui, derived, "designing and simulating this figure"),
    }
}

fn choose_figure(ui: &mut Ui, figures: &[FigureRecipe], current: Option<usize>, out: &mut Output) {
    let title = |figure: &FigureRecipe| {
        if figure.title.is_empty() { figure.id.clone() } else { figure.title.clone() }
    };
    ui.horizontal_wrapped(|ui| {
        let mut choose = |k: usize| out.show(Show::Figure(figures[k].id.clone()));
        let before = current.and_then(|k| k.checked_sub(1));
        let after = current.map_or(Some(0), |k| Some(k + 1).filter(|k| *k < figures.len()));
        for (label, to) in [("Previous", before), ("Next", after)] {
            if ui.add_enabled(to.is_some(), egui::Button::new(label)).clicked()
                && let Some(k) = to
            {
                choose(k);
            }
        }
        let combo = egui::ComboBox::from_id_salt("figure")
            .selected_text(current.map_or_else(|| "Choose a figure".to_owned(), |k| title(&figures[k])))
            .width(320.0_f32.min(ui.available_width() - 20.0))
            .height(500.0)
            .show_ui(ui, |ui| {
                for (k, figure) in figures.iter().enumerate() {
                    let response = ui.selectable_label(current == Some(k), title(figure));
                    if response.on_hover_text(&figure.caption).clicked() {
                        choose(k);
                    }
                }
            });
        ui.ctx().accesskit_node_builder(combo.response.id, |node| node.set_label("Figure"));
    });
}
