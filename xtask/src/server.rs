//! A small web server for this machine only.

use std::{
    io::{self, BufRead as _, BufReader, Read as _, Write as _},
    net::{Ipv4Addr, TcpListener, TcpStream},
    path::Path,
    thread,
    time::Duration,
};

use crate::{
    failure::{Failure, Outcome},
    site,
};

/// The first port that is tried.
const FIRST_PORT: u16 = 8080;
/// How many ports are tried.
const PORTS: u16 = 20;
/// A request longer than this is none of a browser's.
const LONGEST_REQUEST: u64 = 64 * 1024;
/// Browsers open connections in advance; one that stays silent this long is closed.
const PATIENCE: Duration = Duration::from_secs(30);

/// Takes the port, or the first free one.
///
/// # Errors
/// When it is taken.
pub(crate) fn listen(port: Option<u16>) -> Outcome<TcpListener> {
    if let Some(port) = port {
        return bind(port).map_err(|reason| {
            Failure::because(format!("port {port}"), reason)
                .advice("Another program uses it? Leave out `--port` and a free one is taken.")
        });
    }
    let last = FIRST_PORT + PORTS - 1;
    (FIRST_PORT..=last).find_map(|port| bind(port).ok()).ok_or_else(|| {
        Failure::new(format!("no port from {FIRST_PORT} to {last} is free")).advice("Choose one: `--port N`.")
    })
}

fn bind(port: u16) -> io::Result<TcpListener> {
    TcpListener::bind((Ipv4Addr::LOCALHOST, port))
}

/// Serves the folder until the program is ended.
///
/// # Errors
/// When the address of the listener is unknown.
pub(crate) fn serve(listener: &TcpListener, folder: &Path) -> Outcome {
    let address = listener.local_addr().map_err(|reason| Failure::because("the server's address", reason))?;
    println!("\nThe page is at  http://{address}/   (Ctrl+C ends the server)");
    for connection in listener.incoming() {
        let folder = folder.to_path_buf();
        // A connection that breaks is the business of the browser at its other end.
        if let Ok(stream) = connection {
            thread::spawn(move || talk(stream, &folder).ok());
        }
    }
    Ok(())
}

/// Reads one request and writes one answer.
fn talk(stream: TcpStream, folder: &Path) -> io::Result<()> {
    stream.set_read_timeout(Some(PATIENCE))?;
    stream.set_write_timeout(Some(PATIENCE))?;
    let Some(request_line) = read_request(&stream)? else { return Ok(()) };
    let answer = site::answer(folder, &request_line);
    let mut stream = stream;
    stream.write_all(answer.head().as_bytes())?;
    if answer.with_body {
        stream.write_all(&answer.body)?;
    }
    stream.flush()
}

/// The first line of a request, once all of its head has been read; `None` when the browser closed without asking.
fn read_request(stream: &TcpStream) -> io::Result<Option<String>> {
    let mut lines = BufReader::new(stream.take(LONGEST_REQUEST)).lines();
    let Some(first) = lines.next().transpose()? else { return Ok(None) };
    for line in lines {
        if line?.is_empty() {
            break;
        }
    }
    Ok(Some(first))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What the server writes for what a browser sends.
    fn exchange(request: &str) -> String {
        let listener = bind(0).expect("the system gives a free port");
        let address = listener.local_addr().expect("a bound listener has an address");
        let server = thread::spawn(move || {
            let (stream, _) = listener.accept().expect("the client connects");
            talk(stream, &Path::new(env!("CARGO_MANIFEST_DIR")).join("../web")).expect("the client reads");
        });
        let mut client = TcpStream::connect(address).expect("the server listens");
        client.write_all(request.as_bytes()).expect("the server reads");
        let mut answer = String::new();
        client.read_to_string(&mut answer).expect("the server closes");
        server.join().expect("the server ends");
        answer
    }

    #[test]
    fn a_browser_gets_the_page() {
        let answer = exchange("GET / HTTP/1.1\r\nHost: localhost\r\n\r\n");
        assert!(answer.starts_with("HTTP/1.1 200 OK\r\n"), "{answer}");
        assert!(answer.contains("<canvas id=\"app\""), "the body follows the head");
    }

    #[test]
    fn a_head_request_gets_no_body() {
        let answer = exchange("HEAD / HTTP/1.1\r\nHost: localhost\r\n\r\n");
        assert!(answer.ends_with("\r\n\r\n"), "nothing follows the head: {answer}");
    }

    #[test]
    fn a_taken_port_is_named() {
        let taken = bind(0).expect("the system gives a free port");
        let port = taken.local_addr().expect("a bound listener has an address").port();
        let message = listen(Some(port)).unwrap_err().to_string();
        assert!(message.contains(&format!("port {port}")), "{message}");
    }
}
