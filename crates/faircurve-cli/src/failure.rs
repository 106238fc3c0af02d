//! Messages: what is wrong, where, and what to do.

use std::fmt::Write;
use std::process::ExitCode;

use anstyle::{AnsiColor, Style};
use faircurve::catalog::CatalogError;
use faircurve_format::{FormatError, Location};

const ERROR: Style = AnsiColor::Red.on_default().bold();
const HINT: Style = AnsiColor::Cyan.on_default().bold();
const WARNING: Style = AnsiColor::Yellow.on_default().bold();
const FAINT: Style = AnsiColor::Blue.on_default();

/// Why nothing was written.
#[derive(Debug)]
pub(crate) struct Failure {
    message: String,
    excerpt: Option<String>,
    hint: Option<String>,
}

impl Failure {
    pub(crate) fn new(message: impl Into<String>) -> Self {
        Failure { message: message.into(), excerpt: None, hint: None }
    }

    pub(crate) fn hint(mut self, hint: impl Into<String>) -> Self {
        self.hint = Some(hint.into());
        self
    }

    /// The same failure with words before its message that say where.
    pub(crate) fn within(mut self, place: &str) -> Self {
        self.message = format!("{place}: {}", self.message);
        self
    }

    /// What is wrong with a file, with the line that it is in.
    pub(crate) fn in_source(error: FormatError, bytes: &[u8]) -> Self {
        Failure {
            message: error.to_string(),
            excerpt: error.location.map(|place| excerpt(bytes, &place)),
            hint: error.hint,
        }
    }

    /// Prints it; the exit code for bad input.
    pub(crate) fn print(&self) -> ExitCode {
        let mut text = format!("{ERROR}error{ERROR:#}: {}\n", printable(&self.message));
        if let Some(excerpt) = &self.excerpt {
            text.push_str(excerpt);
        }
        if let Some(hint) = &self.hint {
            let _ = writeln!(text, "{HINT}hint{HINT:#}: {}", printable(hint));
        }
        to_stderr(&text);
        ExitCode::from(2)
    }
}

impl From<CatalogError> for Failure {
    fn from(error: CatalogError) -> Self {
        Failure::new(error.to_string()).hint(error.hint())
    }
}

impl From<FormatError> for Failure {
    /// For errors that are in no file.
    fn from(error: FormatError) -> Self {
        Failure::in_source(error, &[])
    }
}

/// Prints a line that is worth knowing though all goes on.
pub(crate) fn note(kind: &str, message: &str) {
    to_stderr(&format!("{WARNING}{kind}{WARNING:#}: {}\n", printable(message)));
}

/// Prints what to do about it.
pub(crate) fn hint(message: &str) {
    to_stderr(&format!("{HINT}hint{HINT:#}: {}\n", printable(message)));
}

/// In colour where stderr is a terminal that wants it. A reader that has gone away is no failure.
fn to_stderr(text: &str) {
    let _ = std::io::Write::write_all(&mut anstream::stderr().lock(), text.as_bytes());
}

/// Text from outside without what would steer a terminal.
fn printable(text: &str) -> String {
    let shown = |c: char| {
        if c.is_control() && c != '\n' { char::REPLACEMENT_CHARACTER } else { c }
    };
    text.chars().map(shown).collect()
}

/// The line of the file with the place underlined.
fn excerpt(bytes: &[u8], place: &Location) -> String {
    /// Longer lines are cut to this many characters around the place.
    const WIDEST: usize = 76;
    /// Of which this many before it.
    const BEFORE: usize = 40;
    let offset = place.offset.min(bytes.len());
    let start = bytes[..offset].iter().rposition(|&b| b == b'\n').map_or(0, |at| at + 1);
    let end =
        bytes[offset..].iter().position(|&b| b == b'\n').map_or(bytes.len(), |at| offset + at);
    let before: Vec<char> = shown(&bytes[start..offset]);
    let after: Vec<char> = shown(&bytes[offset..end]);
    let marked = bytes[offset..end].get(..place.length).map_or(after.len(), |b| shown(b).len());
    let skipped = before.len().saturating_sub(BEFORE);
    let (dots, before) = if skipped > 0 { ("…", &before[skipped..]) } else { ("", &before[..]) };
    let room = WIDEST - before.len();
    let (after, more) = if after.len() > room { (&after[..room], "…") } else { (&after[..], "") };
    let (before, after) = (before.iter().collect::<String>(), after.iter().collect::<String>());

    let number = place.line.to_string();
    let gutter = " ".repeat(number.len());
    let indent = " ".repeat(dots.chars().count() + before.chars().count());
    let carets = "^".repeat(marked.clamp(1, room.max(1)));
    format!(
        " {gutter} {FAINT}|{FAINT:#}\n \
         {FAINT}{number} |{FAINT:#} {dots}{before}{after}{more}\n \
         {gutter} {FAINT}|{FAINT:#} {indent}{ERROR}{carets}{ERROR:#}\n"
    )
}

/// Bytes of a line as characters that take one column each.
fn shown(bytes: &[u8]) -> Vec<char> {
    let text = String::from_utf8_lossy(bytes);
    text.trim_end_matches('\r').chars().map(|c| if c.is_control() { ' ' } else { c }).collect()
}
