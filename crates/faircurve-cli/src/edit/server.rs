//! The server: the page's files, and the one file under `api/file`.

use std::io::{Cursor, Read};
use std::net::{Ipv4Addr, SocketAddr};

use serde_json::json;
use tiny_http::{Header, Method, Request, Response};

use super::file::{EditedFile, Unsaved};
use super::site::Site;
use crate::failure::Failure;

/// The largest file that is taken.
const LARGEST: u64 = 64 << 20;

/// What every answer has: nobody else may embed it, guess its type, keep it or learn its address.
const HEADERS: &[(&str, &str)] = &[
    ("X-Content-Type-Options", "nosniff"),
    ("X-Frame-Options", "DENY"),
    ("Cross-Origin-Resource-Policy", "same-origin"),
    ("Cross-Origin-Opener-Policy", "same-origin"),
    ("Referrer-Policy", "no-referrer"),
    ("Cache-Control", "no-store"),
];

type Answer = Response<Cursor<Vec<u8>>>;

/// A server that isn't running yet.
pub(crate) struct Server {
    listener: tiny_http::Server,
    port: u16,
    token: String,
    site: Site,
    file: Option<EditedFile>,
}

impl Server {
    /// Listens on loopback; port 0 is any that is free.
    pub(crate) fn bind(port: u16, site: Site, file: Option<EditedFile>) -> Result<Self, Failure> {
        let listener = tiny_http::Server::http((Ipv4Addr::LOCALHOST, port)).map_err(|error| {
            Failure::new(format!("can't listen on port {port}: {error}"))
                .hint("leave --port out to take any that is free")
        })?;
        let port = listener.server_addr().to_ip().as_ref().map_or(port, SocketAddr::port);
        let mut secret = [0; 16];
        getrandom::fill(&mut secret)
            .map_err(|error| Failure::new(format!("the system has no random numbers: {error}")))?;
        let token = secret.iter().map(|byte| format!("{byte:02x}")).collect();
        Ok(Server { listener, port, token, site, file })
    }

    /// Where the page is, with the token.
    pub(crate) fn address(&self) -> String {
        format!("http://127.0.0.1:{}/?token={}", self.port, self.token)
    }

    /// Answers requests one after the other until the program is stopped.
    pub(crate) fn serve(&self) {
        for mut request in self.listener.incoming_requests() {
            let mut answer = self.answer(&mut request);
            for (name, value) in HEADERS {
                answer.add_header(header(name, value));
            }
            // Who has gone away needs no answer.
            let _ = request.respond(answer);
        }
    }

    fn answer(&self, request: &mut Request) -> Answer {
        let hosts = [format!("127.0.0.1:{}", self.port), format!("localhost:{}", self.port)];
        let is_ours = |host: &str| hosts.iter().any(|known| known == host);
        if !value(request, "Host").is_some_and(is_ours) {
            return refusal(403, "this address isn't the editor's", "use the printed address");
        }
        let from_us = |origin: &str| origin.strip_prefix("http://").is_some_and(is_ours);
        if value(request, "Origin").is_some_and(|origin| !from_us(origin)) {
            return refusal(403, "another page has asked", "use the editor's own page");
        }
        let path = request.url().split(['?', '#']).next().unwrap_or_default().to_owned();
        match path.strip_prefix('/').unwrap_or(&path) {
            "api/file" => self.answer_file(request),
            path => self.answer_site(request, path),
        }
    }

    fn answer_site(&self, request: &Request, path: &str) -> Answer {
        if !matches!(request.method(), Method::Get | Method::Head) {
            return refusal(405, "the page can only be read", "");
        }
        match self.site.file(path) {
            Some((Ok(bytes), kind)) => {
                Response::from_data(bytes).with_header(header("Content-Type", kind))
            }
            Some((Err(error), _)) => refusal(500, &format!("the page can't be read: {error}"), ""),
            None => refusal(404, "there is no such page", "use the printed address"),
        }
    }

    fn answer_file(&self, request: &mut Request) -> Answer {
        if !value(request, "X-Faircurve-Token").is_some_and(|token| same(token, &self.token)) {
            return refusal(
                403,
                "the address has no token, or that of another run",
                "use the address that `faircurve edit` has printed",
            );
        }
        let Some(file) = &self.file else {
            return match request.method() {
                Method::Get | Method::Head => Response::from_data([]).with_status_code(204),
                _ => refusal(404, "there is no file to save", "start `faircurve edit FILE`"),
            };
        };
        match request.method() {
            Method::Get | Method::Head => match file.contents() {
                Ok((bytes, version)) => Response::from_data(bytes)
                    .with_header(header("Content-Type", "application/octet-stream"))
                    .with_header(header("X-Faircurve-Name", &encoded(&file.name())))
                    .with_header(header("ETag", &version)),
                Err(error) => refusal(500, &format!("{}: {error}", file.name()), ""),
            },
            Method::Put => self.save(request, file),
            _ => refusal(405, "the file can be read and saved, nothing else", ""),
        }
    }

    fn save(&self, request: &mut Request, file: &EditedFile) -> Answer {
        let Some(version) = value(request, "If-Match").map(str::to_owned) else {
            return refusal(428, "the request doesn't say which version it has edited", "");
        };
        let mut bytes = Vec::new();
        let read = request.as_reader().take(LARGEST + 1).read_to_end(&mut bytes);
        if let Err(error) = read {
            return refusal(400, &format!("what was sent didn't arrive: {error}"), "save again");
        }
        if bytes.len() as u64 > LARGEST {
            return refusal(413, "the drawing is larger than 64 MB", "");
        }
        match file.save(&bytes, &version) {
            Ok(version) => {
                Response::from_data([]).with_status_code(204).with_header(header("ETag", &version))
            }
            Err(Unsaved::Changed) => refusal(
                412,
                &format!("{} has changed on disk since it was opened", file.name()),
                "open it again, or save over it",
            ),
            Err(Unsaved::Refused(error, hint)) => refusal(422, &error, &hint),
            Err(Unsaved::Unwritable(error)) => refusal(
                500,
                &format!("{} can't be written: {error}", file.name()),
                "the file is as it was; save among your downloads meanwhile",
            ),
        }
    }
}

fn value<'a>(request: &'a Request, name: &str) -> Option<&'a str> {
    let found = request.headers().iter().find(|h| h.field.as_str().as_str().eq_ignore_ascii_case(name));
    found.map(|header| header.value.as_str())
}

fn refusal(status: u16, error: &str, hint: &str) -> Answer {
    let body = json!({ "error": error, "hint": hint }).to_string();
    Response::from_data(body)
        .with_status_code(status)
        .with_header(header("Content-Type", "application/json"))
}

/// A header. Names and values are ASCII: words of our own, or what [`encoded`] has made.
fn header(name: &str, value: &str) -> Header {
    #[expect(clippy::expect_used, reason = "nothing else than ASCII is ever given")]
    Header::from_bytes(name, value).expect("names and values are ASCII")
}

/// Compares in a time that doesn't tell how much was right.
fn same(a: &str, b: &str) -> bool {
    a.len() == b.len() && a.bytes().zip(b.bytes()).fold(0, |all, (a, b)| all | (a ^ b)) == 0
}

/// Percent-encoded, but for letters, digits, `.`, `-` and `_`.
fn encoded(text: &str) -> String {
    let plain = |byte: u8| byte.is_ascii_alphanumeric() || b".-_".contains(&byte);
    text.bytes()
        .map(|byte| if plain(byte) { (byte as char).to_string() } else { format!("%{byte:02X}") })
        .collect()
}
