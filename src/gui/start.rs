//! Opening the window, starting the page.

use super::Window;
#[cfg(not(target_arch = "wasm32"))]
use crate::platform::files::Arrival;

/// Opens the window, with a document that was read for it, and returns when it is closed.
///
/// # Errors
/// When the machine offers no window or no OpenGL.
#[cfg(not(target_arch = "wasm32"))]
pub fn open_window(document: Option<Arrival>) -> eframe::Result {
    let viewport = egui::ViewportBuilder::default()
        .with_title("descry")
        .with_app_id("descry")
        .with_inner_size([1280.0, 800.0])
        .with_min_inner_size([360.0, 480.0])
        .with_icon(super::icon::icon());
    let options = eframe::NativeOptions { viewport, ..eframe::NativeOptions::default() };
    let create: eframe::AppCreator<'_> = Box::new(|creation| {
        let mut window = Window::new(creation)?;
        if let Some(document) = document {
            window.take(document);
        }
        Ok(Box::new(window))
    });
    eframe::run_native("descry", options, create)
}

/// Starts the page; in a worker, makes it ready for computations instead.
#[cfg(target_arch = "wasm32")]
pub fn start_page() {
    use super::accessibility::Mirror;
    use crate::document::to_json;
    use crate::platform::web;
    if web::in_worker() {
        web::prepare_worker();
        return;
    }
    web::start(
        |creation| {
            creation.egui_ctx.add_plugin(Mirror::new(|widgets| web::mirror(&to_json(&widgets))));
            Window::new(creation)
        },
        |window| to_json(&super::state_report::report(window)),
    );
}
