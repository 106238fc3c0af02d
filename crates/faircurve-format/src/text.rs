//! Text files as bytes.

use crate::error::FormatError;

/// The text in `bytes`, without the byte order mark that some editors put first.
pub(crate) fn text_of(bytes: &[u8]) -> Result<&str, FormatError> {
    match std::str::from_utf8(bytes) {
        Ok(text) => Ok(text.strip_prefix('\u{feff}').unwrap_or(text)),
        Err(error) => {
            let at = error.valid_up_to();
            Err(FormatError::new(format!("the byte {:#04x} is not UTF-8 text", bytes[at]))
                .at(bytes, at..at + 1)
                .hint("save the file as UTF-8"))
        }
    }
}
