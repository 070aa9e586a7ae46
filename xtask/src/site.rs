//! A folder of files as the answers of a web server. No sockets here.

use std::{
    fs,
    path::{Path, PathBuf},
};

/// One answer.
#[derive(Debug, PartialEq, Eq)]
pub(crate) struct Answer {
    /// Number and words of the status.
    pub(crate) status: &'static str,
    pub(crate) mime: &'static str,
    pub(crate) body: Vec<u8>,
    /// A `HEAD` request gets the length of the body and not the body.
    pub(crate) with_body: bool,
}

impl Answer {
    fn problem(status: &'static str, with_body: bool) -> Self {
        Self { status, mime: "text/plain; charset=utf-8", body: status.as_bytes().to_vec(), with_body }
    }

    /// The lines before the body.
    pub(crate) fn head(&self) -> String {
        let Self { status, mime, body, .. } = self;
        let allow = if status.starts_with("405") { "Allow: GET, HEAD\r\n" } else { "" };
        format!(
            "HTTP/1.1 {status}\r\nContent-Type: {mime}\r\nContent-Length: {}\r\nCache-Control: no-store\r\n\
             X-Content-Type-Options: nosniff\r\n{allow}Connection: close\r\n\r\n",
            body.len()
        )
    }
}

/// Answers the first line of a request (`GET /path HTTP/1.1`) with a file below `root`.
pub(crate) fn answer(root: &Path, request_line: &str) -> Answer {
    let mut words = request_line.split_whitespace();
    let (Some(method), Some(target), Some(version), None) =
        (words.next(), words.next(), words.next(), words.next())
    else {
        return Answer::problem("400 Bad Request", true);
    };
    if !version.starts_with("HTTP/1.") {
        return Answer::problem("400 Bad Request", true);
    }
    let with_body = match method {
        "GET" => true,
        "HEAD" => false,
        _ => return Answer::problem("405 Method Not Allowed", true),
    };
    let Some(path) = relative_path(target) else { return Answer::problem("400 Bad Request", with_body) };
    let Some(file) = file_below(root, &path) else { return Answer::problem("404 Not Found", with_body) };
    match fs::read(&file) {
        Ok(body) => Answer { status: "200 OK", mime: mime(&file), body, with_body },
        Err(_) => Answer::problem("404 Not Found", with_body),
    }
}

/// The path of a request as a path below the root, or `None` when it is malformed or tries to leave the root.
fn relative_path(target: &str) -> Option<PathBuf> {
    let path = target.split(['?', '#']).next()?.strip_prefix('/')?;
    let mut relative = PathBuf::new();
    for segment in path.split('/') {
        let name = decode(segment)?;
        if name == ".." || name.contains(['/', '\\', ':', '\0']) {
            return None;
        }
        if !name.is_empty() && name != "." {
            relative.push(name);
        }
    }
    if path.is_empty() || path.ends_with('/') {
        relative.push("index.html");
    }
    Some(relative)
}

/// Undoes `%20` and its like.
fn decode(segment: &str) -> Option<String> {
    let mut bytes = Vec::with_capacity(segment.len());
    let mut rest = segment.bytes();
    while let Some(byte) = rest.next() {
        bytes.push(match byte {
            b'%' => hexadecimal(rest.next()?)? * 16 + hexadecimal(rest.next()?)?,
            other => other,
        });
    }
    String::from_utf8(bytes).ok()
}

fn hexadecimal(digit: u8) -> Option<u8> {
    match digit {
        b'0'..=b'9' => Some(digit - b'0'),
        b'a'..=b'f' => Some(digit - b'a' + 10),
        b'A'..=b'F' => Some(digit - b'A' + 10),
        _ => None,
    }
}

/// The file, when it exists and, symbolic links followed, lies below the root.
fn file_below(root: &Path, relative: &Path) -> Option<PathBuf> {
    let root = root.canonicalize().ok()?;
    let file = root.join(relative).canonicalize().ok()?;
    (file.starts_with(&root) && file.is_file()).then_some(file)
}

/// Browsers compile WebAssembly while it arrives only when its type is right.
fn mime(file: &Path) -> &'static str {
    match file.extension().and_then(|extension| extension.to_str()) {
        Some("html") => "text/html; charset=utf-8",
        Some("js" | "mjs") => "text/javascript; charset=utf-8",
        Some("css") => "text/css; charset=utf-8",
        Some("json") => "application/json",
        Some("wasm") => "application/wasm",
        Some("svg") => "image/svg+xml",
        Some("png") => "image/png",
        Some("txt" | "md") => "text/plain; charset=utf-8",
        _ => "application/octet-stream",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The project's `web/` folder as a site.
    fn web() -> PathBuf {
        Path::new(env!("CARGO_MANIFEST_DIR")).join("../web")
    }

    fn status(line: &str) -> &'static str {
        answer(&web(), line).status
    }

    #[test]
    fn a_folder_is_its_index() {
        let page = answer(&web(), "GET / HTTP/1.1");
        assert_eq!((page.status, page.mime), ("200 OK", "text/html; charset=utf-8"), "the root is the page");
        assert_eq!(page, answer(&web(), "GET /index.html?x=1 HTTP/1.1"), "a query changes nothing");
    }

    #[test]
    fn head_has_the_length_and_no_body() {
        let head = answer(&web(), "HEAD /boot.js HTTP/1.1");
        assert_eq!((head.status, head.with_body), ("200 OK", false), "no body is sent");
        let length = format!("Content-Length: {}\r\n", head.body.len());
        assert!(head.head().contains(&length), "the length is the one of the file");
    }

    #[test]
    fn other_methods_are_refused() {
        assert_eq!(status("POST / HTTP/1.1"), "405 Method Not Allowed", "nothing can be written");
        assert!(
            answer(&web(), "PUT / HTTP/1.1").head().contains("Allow: GET, HEAD"),
            "what is allowed is said"
        );
    }

    #[test]
    fn nothing_outside_the_folder_is_served() {
        for path in [
            "/../Cargo.toml",
            "/%2e%2e/Cargo.toml",
            "/..%2fCargo.toml",
            "/x/../../Cargo.toml",
            "/..%5cCargo.toml",
        ] {
            let line = format!("GET {path} HTTP/1.1");
            assert_eq!(status(&line), "400 Bad Request", "{path}");
        }
        assert_eq!(status("GET //etc/passwd HTTP/1.1"), "404 Not Found", "a second slash is no root");
        assert_eq!(status("GET /missing HTTP/1.1"), "404 Not Found", "what is not there");
    }

    #[test]
    fn malformed_requests_are_refused() {
        for line in [
            "",
            "GET",
            "GET /",
            "GET / SPDY/3",
            "GET index.html HTTP/1.1",
            "GET /%zz HTTP/1.1",
            "GET /% HTTP/1.1",
        ] {
            assert_eq!(status(line), "400 Bad Request", "{line}");
        }
    }

    #[test]
    fn web_assembly_has_its_type() {
        assert_eq!(
            mime(Path::new("descry_bg.wasm")),
            "application/wasm",
            "else it is not compiled while it arrives"
        );
        assert_eq!(
            mime(Path::new("descry.js")),
            "text/javascript; charset=utf-8",
            "else the module is refused"
        );
    }
}
