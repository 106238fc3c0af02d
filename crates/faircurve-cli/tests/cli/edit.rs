//! `faircurve edit` as a program that asks it meets it: what it gives, saves, and refuses.

use std::io::{BufRead, BufReader, Read, Write};
use std::net::TcpStream;
use std::path::Path;
use std::process::{Child, Command, Stdio};

use crate::folder::Folder;

const DRAWING: &str =
    r#"{"faircurve": 1, "contours": [{"knots": [{"x": 0, "y": 0}, {"x": 9, "y": 1}]}]}"#;

/// The program on a file, until it is dropped.
struct Editing {
    program: Child,
    port: String,
    token: String,
}

impl Drop for Editing {
    fn drop(&mut self) {
        let _ = self.program.kill();
        let _ = self.program.wait();
    }
}

/// A site that is enough to be served.
fn site(folder: Folder) -> Folder {
    std::fs::create_dir_all(folder.path("site/faircurve")).unwrap();
    folder.with("site/index.html", "<title>page</title>").with("site/faircurve/index.js", "")
}

impl Editing {
    fn start(folder: &Folder, file: &str) -> Editing {
        let mut program = Command::new(assert_cmd::cargo::cargo_bin("faircurve"))
            .current_dir(folder.path("."))
            .args(["edit", "--site", "site", "--no-browser", file])
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
            .unwrap();
        let mut line = String::new();
        BufReader::new(program.stdout.take().unwrap()).read_line(&mut line).unwrap();
        let (address, token) = line.trim().split_once("/?token=").unwrap();
        let port = address.strip_prefix("http://127.0.0.1:").unwrap().to_owned();
        Editing { program, port, token: token.to_owned() }
    }

    /// The answer to a request with these lines between the first and the body.
    fn ask(&self, first: &str, lines: &[&str], body: &str) -> String {
        let mut stream = TcpStream::connect(format!("127.0.0.1:{}", self.port)).unwrap();
        let lines: String = lines.iter().map(|line| format!("{line}\r\n")).collect();
        let length = body.len();
        write!(
            stream,
            "{first} HTTP/1.1\r\nConnection: close\r\nContent-Length: {length}\r\n{lines}\r\n{body}"
        )
        .unwrap();
        let mut answer = Vec::new();
        stream.read_to_end(&mut answer).unwrap();
        String::from_utf8_lossy(&answer).into_owned()
    }

    /// With our own host and token.
    fn ask_as_page(&self, first: &str, lines: &[&str], body: &str) -> String {
        let host = format!("Host: 127.0.0.1:{}", self.port);
        let token = format!("X-Faircurve-Token: {}", self.token);
        self.ask(first, &[&[&*host, &*token], lines].concat(), body)
    }

    /// The file's version.
    fn version(&self) -> String {
        let answer = self.ask_as_page("GET /api/file", &[], "");
        let line = answer.lines().find(|line| line.starts_with("etag: ")).unwrap();
        line["etag: ".len()..].to_owned()
    }
}

fn status(answer: &str) -> &str {
    answer.split(' ').nth(1).unwrap_or_default()
}

fn content(path: &Path) -> String {
    std::fs::read_to_string(path).unwrap()
}

#[test]
fn gives_the_page_and_the_file() {
    let folder = site(Folder::new().with("a.json", DRAWING));
    let editing = Editing::start(&folder, "a.json");
    let page = editing.ask_as_page("GET /", &[], "");
    assert!(status(&page) == "200" && page.contains("<title>page</title>"), "{page}");
    assert!(page.contains("x-frame-options: DENY"), "{page}");
    let file = editing.ask_as_page("GET /api/file", &[], "");
    assert!(status(&file) == "200" && file.ends_with(DRAWING), "{file}");
    assert!(file.contains("x-faircurve-name: a.json"), "{file}");
}

#[test]
fn saves_whole_and_only_what_was_opened() {
    let folder = site(Folder::new().with("a.json", DRAWING));
    let editing = Editing::start(&folder, "a.json");
    let version = editing.version();
    let changed = DRAWING.replace('9', "7");
    let matches = format!("If-Match: {version}");
    assert_eq!(status(&editing.ask_as_page("PUT /api/file", &[&matches], &changed)), "204");
    assert_eq!(content(&folder.path("a.json")), changed);
    // The version is another one now.
    let again = editing.ask_as_page("PUT /api/file", &[&matches], DRAWING);
    assert!(status(&again) == "412" && again.contains("changed on disk"), "{again}");
    assert_eq!(content(&folder.path("a.json")), changed);
    assert_eq!(status(&editing.ask_as_page("PUT /api/file", &["If-Match: *"], DRAWING)), "204");
    assert_eq!(content(&folder.path("a.json")), DRAWING);
    assert_eq!(folder.files(), ["a.json", "site"]);
}

#[test]
fn refuses_who_is_not_its_page() {
    let folder = site(Folder::new().with("a.json", DRAWING));
    let editing = Editing::start(&folder, "a.json");
    let host = format!("Host: 127.0.0.1:{}", editing.port);
    let token = format!("X-Faircurve-Token: {}", editing.token);
    let refused: &[&[&str]] = &[
        &[&host],
        &[&host, "X-Faircurve-Token: "],
        &[&host, "X-Faircurve-Token: 00000000000000000000000000000000"],
        &["Host: evil.example", &token],
        &[&token],
        &[&host, &token, "Origin: http://evil.example"],
        &[&host, &token, "Origin: null"],
        &[&host, &token, "Origin: https://127.0.0.1"],
    ];
    for lines in refused {
        for first in ["GET /api/file", "PUT /api/file"] {
            let answer = editing.ask(first, &[*lines, &["If-Match: *"]].concat(), "{}");
            // Without a host it isn't a request at all.
            assert!(["403", "400"].contains(&status(&answer)), "{lines:?}: {answer}");
            assert!(!answer.contains("contours"), "{lines:?}: {answer}");
        }
    }
    assert_eq!(content(&folder.path("a.json")), DRAWING);
}

#[test]
fn refuses_other_files_and_what_is_no_drawing() {
    let folder = site(Folder::new().with("a.json", DRAWING).with("secret.json", "secret"));
    let editing = Editing::start(&folder, "a.json");
    for path in [
        "/secret.json",
        "/../secret.json",
        "/site/../secret.json",
        "/%2e%2e/secret.json",
        "//secret.json",
        "/api/file/../../secret.json",
    ] {
        let answer = editing.ask_as_page(&format!("GET {path}"), &[], "");
        assert_eq!(status(&answer), "404", "{path}: {answer}");
        let answer = editing.ask_as_page(&format!("PUT {path}"), &["If-Match: *"], DRAWING);
        assert_eq!(status(&answer), "405", "{path}: {answer}");
    }
    for (body, code) in [("", "422"), ("{}", "422"), (&DRAWING[..30], "422")] {
        let answer = editing.ask_as_page("PUT /api/file", &["If-Match: *"], body);
        assert_eq!(status(&answer), code, "{body}: {answer}");
    }
    assert_eq!(status(&editing.ask_as_page("PUT /api/file", &[], DRAWING)), "428");
    assert_eq!(status(&editing.ask_as_page("DELETE /api/file", &[], "")), "405");
    assert_eq!(content(&folder.path("a.json")), DRAWING);
    assert_eq!(content(&folder.path("secret.json")), "secret");
}

#[test]
fn begins_a_file_that_is_not_there_yet() {
    let folder = site(Folder::new());
    let editing = Editing::start(&folder, "new.json");
    assert!(!folder.path("new.json").exists());
    let matches = format!("If-Match: {}", editing.version());
    assert_eq!(status(&editing.ask_as_page("PUT /api/file", &[&matches], DRAWING)), "204");
    assert_eq!(content(&folder.path("new.json")), DRAWING);
}

#[test]
fn says_what_can_not_be_edited() {
    let folder = site(Folder::new().with("bad.json", "{").with("a.txt", ""));
    let refused = |line: &str| folder.run(line).refused();
    assert!(refused("edit --site site bad.json").starts_with("error: bad.json:1:"));
    assert!(refused("edit --site site a.txt").contains("no input format"));
    assert!(refused("edit --site site none.sfd").contains("there is no such file"));
    assert!(refused("edit --site . new.json").contains("the editor isn't in this folder"));
}
