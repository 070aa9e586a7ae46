//! All colours, strokes and distances; no other file of the screen names a colour.

use egui::{Color32, Context, FontFamily, FontId, Stroke, TextStyle, Theme, Ui, Visuals};

use crate::observer::Verdict;
use crate::session::{Light, ThemeChoice};

/// Space between blocks of a panel.
pub const BLOCK_GAP: f32 = 12.0;
/// Space between items of a block.
pub const ITEM_GAP: f32 = 6.0;
/// Width of a matrix cell.
pub const CELL_WIDTH: f32 = 52.0;
/// Below this width of the window one place is shown at a time.
pub const NARROW: f32 = 820.0;

/// The Okabe-Ito colours, which colour-blind people can tell apart; darker or lighter than the print where the
/// background needs it.
const LIGHT_SERIES: [Color32; 8] = [
    Color32::from_rgb(0, 114, 178),
    Color32::from_rgb(213, 94, 0),
    Color32::from_rgb(0, 133, 100),
    Color32::from_rgb(176, 80, 138),
    Color32::from_rgb(40, 40, 40),
    Color32::from_rgb(176, 117, 0),
    Color32::from_rgb(50, 140, 190),
    Color32::from_rgb(140, 60, 20),
];
const DARK_SERIES: [Color32; 8] = [
    Color32::from_rgb(86, 180, 233),
    Color32::from_rgb(240, 128, 60),
    Color32::from_rgb(40, 190, 145),
    Color32::from_rgb(220, 140, 185),
    Color32::from_rgb(225, 225, 225),
    Color32::from_rgb(240, 190, 60),
    Color32::from_rgb(120, 160, 255),
    Color32::from_rgb(240, 228, 100),
];

/// Whether the screen shows one place at a time.
pub fn is_narrow(ui: &Ui) -> bool {
    ui.ctx().content_rect().width() < NARROW
}

/// Colour of a curve by its number.
pub fn series(ui: &Ui, index: usize) -> Color32 {
    let palette = if ui.visuals().dark_mode { &DARK_SERIES } else { &LIGHT_SERIES };
    palette[index % palette.len()]
}

/// Ground of the cells of a subsystem's block: its colour, dimmed so that numbers stay legible; fainter for couplings.
pub fn block(ui: &Ui, index: usize, coupling: bool) -> Color32 {
    let share = if coupling { 0.09 } else { 0.22 };
    ui.visuals().extreme_bg_color.lerp_to_gamma(series(ui, index), share)
}

/// Green, amber, red and grey of lights and verdicts, readable as text on the background.
pub fn good(ui: &Ui) -> Color32 {
    if ui.visuals().dark_mode { Color32::from_rgb(70, 200, 140) } else { Color32::from_rgb(0, 120, 80) }
}

/// Amber: holds narrowly, or a warning.
pub fn near(ui: &Ui) -> Color32 {
    if ui.visuals().dark_mode { Color32::from_rgb(240, 180, 60) } else { Color32::from_rgb(160, 95, 0) }
}

/// Red: fails.
pub fn bad(ui: &Ui) -> Color32 {
    if ui.visuals().dark_mode { Color32::from_rgb(255, 120, 100) } else { Color32::from_rgb(190, 40, 30) }
}

/// Grey: no data, dimmed.
pub fn faint(ui: &Ui) -> Color32 {
    if ui.visuals().dark_mode { Color32::from_gray(140) } else { Color32::from_gray(110) }
}

/// The accent of what is chosen.
pub fn accent(ui: &Ui) -> Color32 {
    series(ui, 0)
}

/// An edge of a network's graph: a positive or a negative weight.
pub fn edge(ui: &Ui, positive: bool) -> Color32 {
    if positive { ui.visuals().text_color().gamma_multiply(0.72) } else { series(ui, 1) }
}

/// Colour of a light.
pub fn light(ui: &Ui, light: Light) -> Color32 {
    match light {
        Light::Exists => good(ui),
        Light::Near => near(ui),
        Light::Fails => bad(ui),
        Light::Missing => faint(ui),
    }
}

/// Colour of a verdict.
pub fn verdict(ui: &Ui, verdict: Verdict) -> Color32 {
    match verdict {
        Verdict::Holds => good(ui),
        Verdict::Fragile => near(ui),
        Verdict::Fails => bad(ui),
        Verdict::Undecided => faint(ui),
    }
}

/// A word for a verdict, which says it without colour.
pub fn verdict_word(verdict: Verdict) -> &'static str {
    match verdict {
        Verdict::Holds => "holds",
        Verdict::Fragile => "holds narrowly",
        Verdict::Fails => "fails",
        Verdict::Undecided => "not asked",
    }
}

/// Outline of a field whose text is not understood.
pub fn error_stroke(ui: &Ui) -> Stroke {
    Stroke::new(1.5, bad(ui))
}

/// Sets fonts, sizes and colours once.
pub fn install(ctx: &Context) {
    ctx.all_styles_mut(|style| {
        style.spacing.item_spacing = egui::vec2(ITEM_GAP, ITEM_GAP);
        style.spacing.button_padding = egui::vec2(8.0, 4.0);
        style.spacing.interact_size.y = 24.0;
        style.interaction.tooltip_delay = 0.3;
        style.animation_time = 0.08;
        let size = |size| FontId::new(size, FontFamily::Proportional);
        style.text_styles.insert(TextStyle::Body, size(14.0));
        style.text_styles.insert(TextStyle::Button, size(14.0));
        style.text_styles.insert(TextStyle::Small, size(12.0));
        style.text_styles.insert(TextStyle::Heading, size(18.0));
        style.text_styles.insert(TextStyle::Monospace, FontId::new(13.0, FontFamily::Monospace));
    });
    for theme in [Theme::Light, Theme::Dark] {
        ctx.set_visuals_of(theme, visuals(theme));
    }
}

/// Applies the choice of light and dark.
pub fn choose(ctx: &Context, choice: ThemeChoice) {
    let preference = match choice {
        ThemeChoice::System => egui::ThemePreference::System,
        ThemeChoice::Light => egui::ThemePreference::Light,
        ThemeChoice::Dark => egui::ThemePreference::Dark,
    };
    if ctx.options(|options| options.theme_preference) != preference {
        ctx.set_theme(preference);
    }
}

fn visuals(theme: Theme) -> Visuals {
    let mut visuals = match theme {
        Theme::Light => Visuals::light(),
        Theme::Dark => Visuals::dark(),
    };
    match theme {
        Theme::Light => {
            visuals.panel_fill = Color32::from_rgb(250, 250, 248);
            visuals.window_fill = Color32::from_rgb(255, 255, 255);
            visuals.extreme_bg_color = Color32::from_rgb(255, 255, 255);
            visuals.faint_bg_color = Color32::from_rgb(241, 242, 240);
            visuals.override_text_color = Some(Color32::from_rgb(28, 30, 33));
            visuals.selection.bg_fill = Color32::from_rgb(204, 227, 244);
            visuals.selection.stroke = Stroke::new(1.0, Color32::from_rgb(0, 90, 150));
        }
        Theme::Dark => {
            visuals.panel_fill = Color32::from_rgb(24, 26, 29);
            visuals.window_fill = Color32::from_rgb(32, 35, 39);
            visuals.extreme_bg_color = Color32::from_rgb(17, 18, 20);
            visuals.faint_bg_color = Color32::from_rgb(33, 36, 40);
            visuals.override_text_color = Some(Color32::from_rgb(226, 228, 230));
            visuals.selection.bg_fill = Color32::from_rgb(24, 78, 116);
            visuals.selection.stroke = Stroke::new(1.0, Color32::from_rgb(150, 210, 250));
        }
    }
    visuals
}
