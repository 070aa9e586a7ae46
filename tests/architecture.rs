//! The rules of ARCHITECTURE.md that a machine can check.

#![cfg(not(target_arch = "wasm32"))]
#![expect(clippy::unwrap_used, reason = "helpers of tests may fail a test")]

use std::fs;
use std::path::{Path, PathBuf};

/// Layers from low to high; a layer may use itself and what stands before it, unless `ALSO_FORBIDDEN` says otherwise.
const LAYERS: [&str; 12] = [
    "expression",
    "numerics",
    "lmi",
    "system",
    "observer",
    "simulation",
    "paper",
    "document",
    "session",
    "headless",
    "platform",
    "gui",
];

/// Peers that stand in a row above but must not know each other.
const ALSO_FORBIDDEN: [(&str, &str); 2] = [("numerics", "expression"), ("headless", "session")];

/// A foreign crate and the files that may name it.
const OWNERS: [(&str, &[&str]); 10] = [
    ("faer", &["src/numerics/svd.rs", "src/numerics/eigen.rs"]),
    ("clarabel", &["src/lmi/clarabel.rs"]),
    ("serde_json", &["src/document/", "src/headless/", "src/gui/state_report.rs"]),
    ("postcard", &["src/platform/message.rs"]),
    ("miniz_oxide", &["src/document/link.rs"]),
    ("base64", &["src/document/link.rs"]),
    ("egui", &["src/gui/", "src/platform/", "src/main.rs"]),
    ("eframe", &["src/gui/", "src/platform/", "src/main.rs"]),
    ("web_sys", &["src/platform/web/", "src/platform/web.rs"]),
    ("lexopt", &["src/platform/native/arguments.rs"]),
];

fn sources(folder: &Path) -> Vec<PathBuf> {
    let mut found = Vec::new();
    for entry in fs::read_dir(folder).unwrap().flatten() {
        let path = entry.path();
        if path.is_dir() {
            found.extend(sources(&path));
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            found.push(path);
        }
    }
    found.sort();
    found
}

fn root() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR"))
}

fn name(path: &Path) -> String {
    path.strip_prefix(root()).unwrap().to_string_lossy().replace('\\', "/")
}

/// Code of a file without comments, so that documentation may mention anything.
fn code(path: &Path) -> String {
    let text = fs::read_to_string(path).unwrap();
    text.lines().map(|line| line.split("//").next().unwrap_or_default()).collect::<Vec<_>>().join("\n")
}

fn uses(code: &str, krate: &str) -> bool {
    let needle = format!("{krate}::");
    code.match_indices(&needle).any(|(at, _)| {
        let before = code[..at].chars().next_back();
        !before.is_some_and(|c| c.is_alphanumeric() || c == '_' || c == ':')
    })
}

#[test]
fn layers_use_only_what_is_below_them() {
    for (height, layer) in LAYERS.iter().enumerate() {
        let mut forbidden: Vec<&str> = LAYERS[height + 1..].to_vec();
        forbidden.extend(ALSO_FORBIDDEN.iter().filter(|(above, _)| above == layer).map(|(_, peer)| *peer));
        for path in sources(&root().join("src").join(layer)) {
            let code = code(&path);
            for other in &forbidden {
                assert!(!code.contains(&format!("crate::{other}")), "{} uses crate::{other}", name(&path));
            }
        }
    }
}

#[test]
fn each_foreign_crate_has_one_owner() {
    for path in sources(&root().join("src")) {
        let code = code(&path);
        let file = name(&path);
        for (krate, owners) in OWNERS {
            let allowed = owners.iter().any(|owner| file.starts_with(owner));
            assert!(allowed || !uses(&code, krate), "{file} names {krate}, which belongs to {owners:?}");
        }
    }
}

#[test]
fn below_the_platform_there_is_no_clock_thread_or_target() {
    let below =
        ["expression", "numerics", "lmi", "system", "observer", "simulation", "paper", "document", "session"];
    for layer in below {
        for path in sources(&root().join("src").join(layer)) {
            let code = code(&path);
            let body = code.split("#[cfg(test)]").next().unwrap_or_default();
            for word in [
                "std::thread",
                "std::fs",
                "std::time",
                "web_time",
                "cfg(target_arch",
                "println!",
                "eprintln!",
            ] {
                assert!(!body.contains(word), "{} contains {word}", name(&path));
            }
        }
    }
}

#[test]
fn every_file_says_what_it_is() {
    for folder in ["src", "tests", "xtask/src"] {
        for path in sources(&root().join(folder)) {
            let text = fs::read_to_string(&path).unwrap();
            assert!(text.starts_with("//!"), "{} does not begin with //!", name(&path));
        }
    }
}

#[test]
fn files_hold_one_idea() {
    const LONGEST: usize = 450;
    for path in sources(&root().join("src")) {
        let lines = fs::read_to_string(&path).unwrap().lines().count();
        assert!(lines <= LONGEST, "{} has {lines} lines, more than {LONGEST}", name(&path));
    }
}

#[test]
fn reference_numbers_are_the_shared_ones() {
    let shared = root().join("../shared/vectors");
    for entry in fs::read_dir(root().join("tests/reference")).unwrap().flatten() {
        let original = shared.join(entry.file_name());
        if original.exists() {
            let same = fs::read(entry.path()).unwrap() == fs::read(&original).unwrap();
            assert!(same, "{} differs from the shared original", name(&entry.path()));
        }
    }
}
