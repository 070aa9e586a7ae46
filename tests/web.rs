//! The same numbers in a browser as natively.
#![cfg(all(target_arch = "wasm32", feature = "gui"))]
wasm_bindgen_test::wasm_bindgen_test_configure!(run_in_browser);
