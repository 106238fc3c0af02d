//! What is wrong with a file, where, and what to do about it.

use std::fmt;
use std::ops::Range;

/// Why a file can't be read, or a format can't be found.
///
/// ```
/// use faircurve_format::{Kind, read};
/// let error = read(b"0,0\n10,1o\n", Kind::from_name("csv")?).unwrap_err().in_file("a.csv");
/// assert_eq!(error.to_string(), "a.csv:2:4: contour 0, knot 1: `1o` is not a number");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct FormatError {
    /// The file's name, if the caller gave one ([`FormatError::in_file`]).
    pub source_name: Option<String>,
    /// Where in the file; `None` if the problem isn't in a file.
    pub location: Option<Location>,
    /// What is wrong, and in which glyph, contour and knot (counted from 0) if it is in one.
    pub message: String,
    /// What to do about it, if there is something to say.
    pub hint: Option<String>,
}

/// A stretch of a file, for people (line and column) and for programs (bytes).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Location {
    /// The line, counted from 1; lines end at `\n`.
    pub line: usize,
    /// The column in characters, counted from 1. In a line that isn't UTF-8, every byte that
    /// doesn't belong to a character counts as one.
    pub column: usize,
    /// Where the offending token starts: bytes from the start of the file.
    pub offset: usize,
    /// The offending token's length in bytes; 0 where something is missing. Never reaches beyond
    /// the end of the file.
    pub length: usize,
}

impl Location {
    /// The location of a stretch of `bytes`; what lies beyond their end is cut off.
    pub(crate) fn of(bytes: &[u8], stretch: Range<usize>) -> Self {
        let offset = stretch.start.min(bytes.len());
        let end = stretch.end.clamp(offset, bytes.len());
        let line_start = bytes[..offset].iter().rposition(|&b| b == b'\n').map_or(0, |at| at + 1);
        let line = 1 + bytes[..line_start].iter().filter(|&&b| b == b'\n').count();
        let before: usize = bytes[line_start..offset]
            .utf8_chunks()
            .map(|chunk| chunk.valid().chars().count() + chunk.invalid().len())
            .sum();
        Location { line, column: before + 1, offset, length: end - offset }
    }
}

impl FormatError {
    /// An error that isn't in a file.
    pub(crate) fn new(message: impl Into<String>) -> Self {
        FormatError { source_name: None, location: None, message: message.into(), hint: None }
    }

    /// The same error at a stretch of the file's bytes.
    pub(crate) fn at(mut self, bytes: &[u8], stretch: Range<usize>) -> Self {
        self.location = Some(Location::of(bytes, stretch));
        self
    }

    /// The same error with what to do about it.
    pub(crate) fn hint(mut self, hint: impl Into<String>) -> Self {
        self.hint = Some(hint.into());
        self
    }

    /// The same error with the name of the file that it is in.
    pub fn in_file(mut self, name: impl Into<String>) -> Self {
        self.source_name = Some(name.into());
        self
    }
}

impl fmt::Display for FormatError {
    /// `file:line:column: message`, as far as they are known; the hint is left to the caller.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match (&self.source_name, &self.location) {
            (Some(name), Some(place)) => write!(f, "{name}:{}:{}: ", place.line, place.column)?,
            (Some(name), None) => write!(f, "{name}: ")?,
            (None, Some(place)) => write!(f, "{}:{}: ", place.line, place.column)?,
            (None, None) => {}
        }
        f.write_str(&self.message)
    }
}

impl std::error::Error for FormatError {}
