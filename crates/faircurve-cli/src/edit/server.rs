//! The server: the page's files, and the one file under `api/file`.

use std::io;
use std::net::{Ipv4Addr, TcpListener};
use std::sync::Arc;

use axum::Router;
use axum::body::{Body, to_bytes};
use axum::extract::Request;
use axum::http::{HeaderMap, Method, Response, StatusCode, header};
use serde_json::json;

use super::file::{EditedFile, Unsaved};
use super::site::Site;
use crate::failure::Failure;

/// The largest file that is taken.
const LARGEST: usize = 64 << 20;

/// What every answer has: nobody else may embed it, guess its type, keep it or learn its address.
const HEADERS: &[(&str, &str)] = &[
    ("X-Content-Type-Options", "nosniff"),
    ("X-Frame-Options", "DENY"),
    ("Cross-Origin-Resource-Policy", "same-origin"),
    ("Cross-Origin-Opener-Policy", "same-origin"),
    ("Referrer-Policy", "no-referrer"),
    ("Cache-Control", "no-store"),
];

type Answer = Response<Body>;

/// A server that isn't running yet.
pub(crate) struct Server {
    listener: TcpListener,
    pages: Pages,
}

/// What is asked for, and who may ask.
struct Pages {
    port: u16,
    token: String,
    site: Site,
    file: Option<EditedFile>,
}

impl Server {
    /// Listens on loopback; port 0 is any that is free.
    pub(crate) fn bind(port: u16, site: Site, file: Option<EditedFile>) -> Result<Self, Failure> {
        let bind = || {
            let listener = TcpListener::bind((Ipv4Addr::LOCALHOST, port))?;
            listener.set_nonblocking(true)?;
            let port = listener.local_addr()?.port();
            Ok((listener, port))
        };
        let (listener, port) = bind().map_err(|error: io::Error| {
            Failure::new(format!("can't listen on port {port}: {error}"))
                .hint("leave --port out to take any that is free")
        })?;
        let mut secret = [0; 16];
        getrandom::fill(&mut secret)
            .map_err(|error| Failure::new(format!("the system has no random numbers: {error}")))?;
        let token = secret.iter().map(|byte| format!("{byte:02x}")).collect();
        Ok(Server { listener, pages: Pages { port, token, site, file } })
    }

    /// Where the page is, with the token.
    pub(crate) fn address(&self) -> String {
        format!("http://127.0.0.1:{}/?token={}", self.pages.port, self.pages.token)
    }

    /// Answers until the program is stopped. One thread does for one user.
    pub(crate) fn serve(self) -> Result<(), Failure> {
        let run = || {
            let runtime = tokio::runtime::Builder::new_current_thread().enable_io().build()?;
            runtime.block_on(async {
                let listener = tokio::net::TcpListener::from_std(self.listener)?;
                let pages = Arc::new(self.pages);
                let router = Router::new().fallback(move |request: Request| {
                    let pages = Arc::clone(&pages);
                    async move { pages.answer(request).await }
                });
                axum::serve(listener, router).await
            })
        };
        run().map_err(|error: io::Error| Failure::new(format!("the server has stopped: {error}")))
    }
}

impl Pages {
    async fn answer(&self, request: Request) -> Answer {
        let mut answer = self.answer_of(request).await;
        for (name, value) in HEADERS {
            answer.headers_mut().insert(*name, header::HeaderValue::from_static(value));
        }
        answer
    }

    async fn answer_of(&self, request: Request) -> Answer {
        let (asked, body) = request.into_parts();
        let hosts = [format!("127.0.0.1:{}", self.port), format!("localhost:{}", self.port)];
        let is_ours = |host: &str| hosts.iter().any(|known| known == host);
        if !value(&asked.headers, "Host").is_some_and(is_ours) {
            return refusal(403, "this address isn't the editor's", "use the printed address");
        }
        let from_us = |origin: &str| origin.strip_prefix("http://").is_some_and(is_ours);
        if asked.headers.contains_key("Origin")
            && !value(&asked.headers, "Origin").is_some_and(from_us)
        {
            return refusal(403, "another page has asked", "use the editor's own page");
        }
        let path = asked.uri.path();
        match path.strip_prefix('/').unwrap_or(path) {
            "api/file" => self.answer_file(&asked.method, &asked.headers, body).await,
            path => self.answer_site(&asked.method, path),
        }
    }

    fn answer_site(&self, method: &Method, path: &str) -> Answer {
        if !matches!(*method, Method::GET | Method::HEAD) {
            return refusal(405, "the page can only be read", "");
        }
        match self.site.file(path) {
            Some((Ok(bytes), kind)) => answer(200, &[("Content-Type", kind)], bytes),
            Some((Err(error), _)) => refusal(500, &format!("the page can't be read: {error}"), ""),
            None => refusal(404, "there is no such page", "use the printed address"),
        }
    }

    async fn answer_file(&self, method: &Method, headers: &HeaderMap, body: Body) -> Answer {
        if !value(headers, "X-Faircurve-Token").is_some_and(|token| same(token, &self.token)) {
            return refusal(
                403,
                "the address has no token, or that of another run",
                "use the address that `faircurve edit` has printed",
            );
        }
        let Some(file) = &self.file else {
            return match *method {
                Method::GET | Method::HEAD => answer(204, &[], []),
                _ => refusal(404, "there is no file to save", "start `faircurve edit FILE`"),
            };
        };
        match *method {
            Method::GET | Method::HEAD => match file.contents() {
                Ok((bytes, version)) => {
                    let name = encoded(&file.name());
                    let kind = ("Content-Type", "application/octet-stream");
                    answer(200, &[kind, ("X-Faircurve-Name", &name), ("ETag", &version)], bytes)
                }
                Err(error) => refusal(500, &format!("{}: {error}", file.name()), ""),
            },
            Method::PUT => save(file, value(headers, "If-Match"), body).await,
            _ => refusal(405, "the file can be read and saved, nothing else", ""),
        }
    }
}

async fn save(file: &EditedFile, version: Option<&str>, body: Body) -> Answer {
    let Some(version) = version else {
        return refusal(428, "the request doesn't say which version it has edited", "");
    };
    // Whole or not at all: what didn't arrive whole is not saved.
    let Ok(bytes) = to_bytes(body, LARGEST).await else {
        let hint = "save again; drawings can have up to 64 MB";
        return refusal(413, "the drawing didn't arrive whole", hint);
    };
    match file.save(&bytes, version) {
        Ok(version) => answer(204, &[("ETag", &version)], []),
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

fn value<'a>(headers: &'a HeaderMap, name: &str) -> Option<&'a str> {
    headers.get(name).and_then(|value| value.to_str().ok())
}

/// An answer. Headers are ASCII: words of our own, or what [`encoded`] has made.
fn answer(status: u16, headers: &[(&str, &str)], body: impl Into<Vec<u8>>) -> Answer {
    let mut answer = Response::builder().status(status);
    for (name, value) in headers {
        answer = answer.header(*name, *value);
    }
    answer.body(Body::from(body.into())).unwrap_or_else(|_| {
        let mut broken = Response::new(Body::empty());
        *broken.status_mut() = StatusCode::INTERNAL_SERVER_ERROR;
        broken
    })
}

fn refusal(status: u16, error: &str, hint: &str) -> Answer {
    let body = json!({ "error": error, "hint": hint }).to_string();
    answer(status, &[("Content-Type", "application/json")], body)
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
