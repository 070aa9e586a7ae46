//! Building the page: the program, its JavaScript module and the files of `web/`.

use std::{fs, path::Path};

use crate::{
    bindgen,
    failure::{Failure, Outcome},
    options::Profile,
    process,
    workspace::{PROGRAM, WASM, Workspace},
};

/// What stands beside `index.html` and is copied as it is.
const COPIED: [&str; 3] = ["boot.js", "worker.js", "style.css"];

/// Builds the page into `dist/`, which is replaced.
///
/// # Errors
/// When the program does not compile or a file cannot be written.
pub(crate) fn build(workspace: &Workspace, profile: Profile) -> Outcome {
    let start = process::now();
    println!("Compiling the program for the page (the first time takes some minutes) ...");
    let mut cargo = workspace.cargo();
    cargo.args(["build", "--locked", "--bin", PROGRAM, "--target", WASM]);
    let folder = match profile {
        Profile::Release => {
            cargo.arg("--release");
            "release"
        }
        Profile::Debug => "debug",
    };
    process::run(&mut cargo)?;
    println!("Writing dist/ ...");
    let dist = workspace.dist();
    empty(&dist)?;
    bindgen::generate(&workspace.wasm(folder), &dist, profile)?;
    copy_files(&workspace.web(), &dist)?;
    println!("The page is built ({:.0} s).", start.elapsed().as_secs_f64());
    Ok(())
}

/// Prints every file of the page with its size.
///
/// # Errors
/// When the folder cannot be read.
pub(crate) fn print_sizes(dist: &Path) -> Outcome {
    let mut files = Vec::new();
    for entry in fs::read_dir(dist).map_err(|reason| Failure::because(dist.display(), reason))? {
        let entry = entry.map_err(|reason| Failure::because(dist.display(), reason))?;
        let size = entry.metadata().map_err(|reason| Failure::because(entry.path().display(), reason))?.len();
        files.push((entry.file_name().to_string_lossy().into_owned(), size));
    }
    files.sort();
    for (name, size) in &files {
        println!("{:>10.1} kB  dist/{name}", *size as f64 / 1000.0);
    }
    Ok(())
}

fn empty(folder: &Path) -> Outcome {
    if folder.exists() {
        fs::remove_dir_all(folder).map_err(|reason| Failure::because(folder.display(), reason))?;
    }
    fs::create_dir_all(folder).map_err(|reason| Failure::because(folder.display(), reason))
}

fn copy_files(web: &Path, dist: &Path) -> Outcome {
    for name in COPIED {
        let source = web.join(name);
        fs::copy(&source, dist.join(name)).map_err(|reason| Failure::because(source.display(), reason))?;
    }
    let source = web.join("index.html");
    let html = fs::read_to_string(&source).map_err(|reason| Failure::because(source.display(), reason))?;
    let target = dist.join("index.html");
    fs::write(&target, without_trunk(&html)).map_err(|reason| Failure::because(target.display(), reason))
}

/// Leaves out the lines that tell `trunk` what to build; the page is the same file with and without it.
fn without_trunk(html: &str) -> String {
    let lines = html.lines().filter(|line| !line.contains("data-trunk"));
    lines.flat_map(|line| [line, "\n"]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_for_trunk_are_left_out() {
        let html = "<head>\n<link data-trunk rel=\"rust\">\n<title>x</title>\n</head>\n";
        assert_eq!(without_trunk(html), "<head>\n<title>x</title>\n</head>\n", "only the marked line goes");
    }

    #[test]
    fn the_page_names_the_files_that_are_copied() {
        let html = include_str!("../../web/index.html");
        for name in COPIED {
            let line = format!("<link data-trunk rel=\"copy-file\" href=\"{name}\">");
            assert!(html.contains(&line), "trunk copies {name} too");
        }
        let page = without_trunk(html);
        assert!(page.contains("src=\"boot.js\""), "the page starts by boot.js");
        assert!(!page.contains("data-trunk"), "nothing for trunk is left");
    }
}
