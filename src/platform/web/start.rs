//! Starts the page, and says why it cannot start or why it stopped.

use std::cell::RefCell;

use wasm_bindgen::prelude::*;

use super::page;

#[wasm_bindgen]
extern "C" {
    /// Shows why the program cannot go on (boot.js).
    #[wasm_bindgen(catch)]
    fn descry_fail(text: &str) -> Result<(), JsValue>;

    /// Shows screen readers what the canvas shows (boot.js).
    #[wasm_bindgen(catch)]
    fn descry_a11y(json: &str) -> Result<(), JsValue>;
}

type State = Box<dyn Fn() -> Option<String>>;

thread_local! {
    static STATE: RefCell<Option<State>> = const { RefCell::new(None) };
}

/// The program's state as JSON, for tests of the page; nothing before the program runs.
#[wasm_bindgen]
pub fn debug_state() -> Option<String> {
    STATE.with_borrow(|state| state.as_ref()?())
}

/// Hands widgets, as JSON, to the page's mirror for screen readers.
pub fn mirror(json: &str) {
    // a page without a mirror is one that somebody embedded: nothing is lost but the mirror
    drop(descry_a11y(json));
}

/// Starts a program on the page's canvas; `state` describes it for tests of the page.
pub fn start<A: eframe::App + 'static>(
    create: impl FnOnce(&eframe::CreationContext<'_>) -> Result<A, Box<dyn std::error::Error + Send + Sync>>
    + 'static,
    state: impl Fn(&A) -> String + 'static,
) {
    std::panic::set_hook(Box::new(|info| fail(&info.to_string())));
    wasm_bindgen_futures::spawn_local(async move {
        if let Err(error) = try_start(create, state).await {
            fail(&page::words(&error));
        }
    });
}

fn fail(reason: &str) {
    if descry_fail(reason).is_err() {
        web_sys::console::error_1(&reason.into());
    }
}

async fn try_start<A: eframe::App + 'static>(
    create: impl FnOnce(&eframe::CreationContext<'_>) -> Result<A, Box<dyn std::error::Error + Send + Sync>>
    + 'static,
    state: impl Fn(&A) -> String + 'static,
) -> Result<(), JsValue> {
    let window = web_sys::window().ok_or("there is no window")?;
    let document = window.document().ok_or("there is no document")?;
    let canvas = document.get_element_by_id("app").ok_or("the page has no canvas `app`")?;
    let runner = eframe::WebRunner::new();
    let shown = runner.clone();
    runner
        .start(
            canvas.dyn_into()?,
            eframe::WebOptions::default(),
            Box::new(|creation| Ok(Box::new(create(creation)?))),
        )
        .await?;
    // a page that goes away is not asked again: what changed last is saved now
    runner.add_event_listener(&window, "pagehide", |_: web_sys::Event, runner| runner.save())?;
    STATE.set(Some(Box::new(move || shown.app_mut::<A>().map(|app| state(&app)))));
    Ok(())
}
