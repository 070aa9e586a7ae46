//! The page's window, address and words for its errors.

use wasm_bindgen::JsValue;

/// The fragment of the address, with its `#`.
pub(in crate::platform) fn linked() -> Option<String> {
    let fragment = web_sys::window()?.location().hash().ok()?;
    (!fragment.is_empty()).then_some(fragment)
}

/// Replaces the fragment without a new entry in the history; returns the whole address.
pub(super) fn set_fragment(fragment: &str) -> Option<String> {
    let window = web_sys::window()?;
    let location = window.location();
    // an address that ends in a bare path removes the fragment
    let target = if fragment.is_empty() {
        format!("{}{}", location.pathname().ok()?, location.search().ok()?)
    } else {
        fragment.to_owned()
    };
    window.history().ok()?.replace_state_with_url(&JsValue::NULL, "", Some(&target)).ok()?;
    location.href().ok()
}

/// A thrown value in words.
pub(super) fn words(error: &JsValue) -> String {
    let message = js_sys::Reflect::get(error, &"message".into()).ok().and_then(|text| text.as_string());
    message.or_else(|| error.as_string()).unwrap_or_else(|| "the browser gives no reason".to_owned())
}
