//! What the tests of several formats share.

#![allow(dead_code, reason = "not every test file uses all of it")]

use faircurve_format::{Document, FormatError, Kind, read};

/// Reads as that kind.
pub(crate) fn parse(kind: &str, bytes: impl AsRef<[u8]>) -> Result<Document, FormatError> {
    read(bytes.as_ref(), Kind::from_name(kind).unwrap())
}

/// The error as a user sees it: place and message, the offending bytes underlined, the hint.
pub(crate) fn complaint(kind: &str, bytes: impl AsRef<[u8]>) -> String {
    let bytes = bytes.as_ref();
    let error = parse(kind, bytes).expect_err("this must not be read");
    let location = error.location.expect("errors in a file have a place");
    let end = location.offset + location.length;
    assert!(end <= bytes.len(), "the place is inside the file");
    let token: String = String::from_utf8_lossy(&bytes[location.offset..end])
        .chars()
        .map(|c| if c.is_control() { '�' } else { c })
        .collect();
    let mut shown = format!("{error}\n  at: {token}");
    if let Some(hint) = &error.hint {
        shown += &format!("\n  hint: {hint}");
    }
    shown
}
